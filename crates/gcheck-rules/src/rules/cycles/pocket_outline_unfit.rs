//! A pocket outline with something other than moves in its plane.

use std::ops::Range;

use gcheck_controls::{Code, Effect, LetterSet};
use gcheck_engine::{At, Role};
use gcheck_program::{BlockFlags, Word};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_code;
use crate::facts::pockets::outline_of;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// The program with the outline of a pocket contains something other than straight moves and arcs in X and Y, or
    /// does not return.
    ///
    /// ## Why it matters
    /// The control only reads the outline; it does not execute it. A rapid move, a cycle, a tool change or a depth in
    /// it is refused with an alarm, or ignored. Macro variables cannot be used in it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G0 Y1.
    /// G1 X1.
    /// Y-1.
    /// X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// G43 H1 Z.1
    /// G150 P100 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
    /// G40 X0. Y0.
    /// M30
    /// O100
    /// G1 Y1.
    /// X1.
    /// G2 X1. Y-1. J-1.
    /// G1 X-1.
    /// Y1.
    /// X0.
    /// M99
    /// ```
    rule "pocket-outline-unfit" in "cycles" {
        summary: "pocket outline with something other than moves in its plane",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PocketOutlineUnfit) },
    }
}

/// Blocks of an outline that are looked at.
const MOST_BLOCKS: usize = 5_000;

struct PocketOutlineUnfit;

impl PathRule for PocketOutlineUnfit {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(|effect| effect == Effect::GeneralPocket) {
            return;
        }
        let (Some(blocks), Some(code)) = (outline_of(cx), cycle_code(cx)) else { return };
        judge(cx, blocks, code, report);
    }
}

fn judge(cx: &PathCx<'_>, blocks: Range<u32>, code: Code<'_>, report: &mut Report<'_>) {
    let name = code.number().to_string();
    for (count, block) in blocks.enumerate() {
        if count >= MOST_BLOCKS {
            return;
        }
        let Some(place) = cx.place_of(At { file: 0, block }) else { return };
        let range = |word: &Word| place.base + word.range().start..place.base + word.range().end;
        let read = place.block();
        if read.flags.contains(BlockFlags::TAPE_MARK) {
            break;
        }
        let words = place.table.words(read);
        if words.iter().any(|word| cx.model.effect(word.code) == Effect::Return) {
            return;
        }
        if read.flags.contains(BlockFlags::STATEMENT) {
            let finding = cx
                .finding(&META, place.range(), "the pocket's outline has a macro statement")
                .label("the control takes no variables in an outline")
                .help("write the outline with numbers")
                .at_most(Severity::Warning);
            report.add(of_pocket(cx, finding, code));
            return;
        }
        if let Some(word) = words.iter().find(|word| place.table.reads_variable(word)) {
            let letter = word.letter;
            let finding = cx
                .finding(
                    &META,
                    range(word),
                    format!("the pocket's outline has a macro variable (`{letter}`)"),
                )
                .label("the control takes no variables in an outline")
                .help("write the outline with numbers")
                .at_most(limit(code.entry().confidence));
            report.add(of_pocket(cx, finding, code));
            return;
        }
        if let Some((word, what)) = words.iter().find_map(|word| Some((word, unfit(cx, word)?))) {
            let finding = cx
                .finding(&META, range(word), format!("the pocket's outline has {}", what.words))
                .label("an outline is only read: straight moves and arcs in X and Y")
                .help(what.help)
                .at_most(if what.is_certain { limit(code.entry().confidence) } else { Severity::Warning });
            report.add(of_pocket(cx, finding, code));
            // What follows the end of a program does not belong to it.
            if what.ends {
                return;
            }
        }
    }
    let finding = cx
        .finding(&META, cx.letter_range('P'), format!("the pocket's outline does not return (`{name}`)"))
        .label("no `M99` ends the program that `P` names")
        .help("end the outline with `M99`")
        .note(format!("an outline ends with a return  [{}]", code.entry().source))
        .at_most(limit(code.entry().confidence));
    report.add(finding);
}

/// The pocket that takes the outline.
fn of_pocket(cx: &PathCx<'_>, finding: Finding, code: Code<'_>) -> Finding {
    finding.also(cx.letter_range('P'), "the outline of this pocket").note(format!(
        "`{}` ({}) reads its outline from a program of straight moves and arcs that ends with a return  [{}]",
        code.entry().code,
        code.entry().title,
        code.entry().source
    ))
}

struct Unfit {
    words: String,
    help: &'static str,
    /// The control cannot use it as a move of the outline.
    is_certain: bool,
    /// Nothing after it belongs to the outline.
    ends: bool,
}

/// What a word does that does not belong in an outline.
fn unfit(cx: &PathCx<'_>, word: &Word) -> Option<Unfit> {
    const OTHER_AXES: LetterSet = LetterSet::of("ZABCUVW");
    let plain = |words: String, help, is_certain| Some(Unfit { words, help, is_certain, ends: false });
    if OTHER_AXES.contains(word.letter) && !word.letter.is_corner() {
        let letter = word.letter;
        return plain(
            format!("a word `{letter}`"),
            "keep the outline in X and Y; the pocket's block gives the depth",
            false,
        );
    }
    let code = cx.control().code_at(word.code)?;
    let name = code.number();
    let away = "remove it from the outline";
    match code.effect() {
        Effect::Rapid => plain(
            format!("a rapid move (`{name}`)"),
            "write the outline, and the move that leads to it, with straight moves at feed and arcs",
            false,
        ),
        Effect::ToolChange => plain(format!("a tool change (`{name}`)"), away, true),
        Effect::GeneralPocket | Effect::CircularPocketClockwise | Effect::CircularPocketCounterClockwise => {
            plain(format!("another pocket (`{name}`)"), away, true)
        }
        Effect::ProgramEnd | Effect::ProgramEndWithPallet => Some(Unfit {
            words: format!("the end of the program (`{name}`)"),
            help: "end the outline with `M99`",
            is_certain: true,
            ends: true,
        }),
        Effect::CallProgram | Effect::CallLocal | Effect::MacroCall | Effect::MacroModal => {
            plain(format!("a call (`{name}`)"), "write the whole outline in one program", false)
        }
        effect if Role::of(effect) == Some(Role::Cycle) && effect != Effect::CycleCancel => {
            plain(format!("a canned cycle (`{name}`)"), away, true)
        }
        Effect::SpindleClockwise
        | Effect::SpindleCounterClockwise
        | Effect::SpindleStop
        | Effect::Stop
        | Effect::OptionalStop
        | Effect::Dwell
        | Effect::ReturnReference(_) => plain(format!("`{name}` ({})", code.entry().title), away, false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    const HEAD: &str = "G20 G90 G54 G0 X0. Y0.\nZ.1\nG150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nM30\nO100\n";

    #[test]
    fn each_kind_is_named() {
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}G0 Y1.\nG1 X1. Z-1.\nG81 R.1\nT2 M6\nG150 P7\n#1=3\nM99\n"),
            &expect![[r#"
                6 | G0 Y1.
                  | ^^ warning[pocket-outline-unfit] the pocket's outline has a rapid move (`G0`)
                7 | G1 X1. Z-1.
                  |        ^^^^ warning[pocket-outline-unfit] the pocket's outline has a word `Z`
                8 | G81 R.1
                  | ^^^ error[pocket-outline-unfit] the pocket's outline has a canned cycle (`G81`)
                9 | T2 M6
                  |    ^^ error[pocket-outline-unfit] the pocket's outline has a tool change (`M6`)
                10 | G150 P7
                   | ^^^^ error[pocket-outline-unfit] the pocket's outline has another pocket (`G150`)
                11 | #1=3
                   | ^^^^ warning[pocket-outline-unfit] the pocket's outline has a macro statement
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}G1 Y1.\nM97 P8\nM5\nG4 P1.\nM99\n"),
            &expect![[r#"
                7 | M97 P8
                  | ^^^ warning[pocket-outline-unfit] the pocket's outline has a call (`M97`)
                8 | M5
                  | ^^ warning[pocket-outline-unfit] the pocket's outline has `M5` (spindle stop)
                9 | G4 P1.
                  | ^^ warning[pocket-outline-unfit] the pocket's outline has `G4` (dwell)
            "#]],
        );
    }

    #[test]
    fn an_outline_returns() {
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}G1 Y1.\nX1.\n"),
            &expect![[r#"
            3 | G150 P100 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.
              |      ^^^^ error[pocket-outline-unfit] the pocket's outline does not return (`G150`)
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &format!("{HEAD}G1 Y1.\nX1.\nM30\nM99\n"),
            &expect![[r#"
                8 | M30
                  | ^^^ error[pocket-outline-unfit] the pocket's outline has the end of the program (`M30`)
            "#]],
        );
    }

    #[test]
    fn variables_are_refused_though_their_value_is_known() {
        check_rule(
            &RULE,
            "haas-mill",
            &format!("#110=2.\n{HEAD}G1 Y1.\nX-#110\nY[-1.]\nM99\n"),
            &expect![[r#"
                8 | X-#110
                  | ^^^^^^ error[pocket-outline-unfit] the pocket's outline has a macro variable (`X`)
            "#]],
        );
        check_rule(&RULE, "haas-mill", &format!("{HEAD}G1 Y1.\nX[1.+1.]\nM99\n"), &expect![[""]]);
    }

    #[test]
    fn modes_of_the_plane_and_a_label_are_fine() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\nG150 P50 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nM30\nN50 G91 G1 Y1. F10.\nG3 X1. Y0. R.5 ,R.1\nG90\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn an_outline_elsewhere_or_unknown_is_not_looked_at() {
        check_rule(
            &RULE,
            "haas-mill",
            "G150 P#1 X0. Y0. Z-.5 Q.25 R.1 I.2 F20.\nG150 P7 X0.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn what_it_says() {
        let program = format!("{HEAD}G1 Y1.\nG81 Z-1. R.1\nM99\n");
        let found = findings(&only(&RULE), "haas-mill", &program, &World::default());
        expect![[r#"
            the pocket's outline has a canned cycle (`G81`)
              here: an outline is only read: straight moves and arcs in X and Y
              there: the outline of this pocket
              note: `G150` (general pocket) reads its outline from a program of straight moves and arcs that ends with a return  [Haas 96-8000 rev AC May 2010 p.184; Haas 96-8000 June 1999 (easymanua.ls page 208); HM17 p.314-316]
              help: remove it from the outline
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }
}
