//! A canned cycle, or a subprogram, that is repeated at one place.

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_engine::{At, Event, Fact, Role};
use gcheck_program::{BlockFlags, Place};

use crate::declare::declare_rule;
use crate::facts::cycles::{is_cycle, is_drilling, is_round_pocket};
use crate::facts::offset_schemes::whole;
use crate::{Finding, PathCx, PathRule, Remembers, Report, Run, Severity, Uses, Watch, remembers};

declare_rule! {
    /// A canned cycle repeats (`L`, `K`) while positions are absolute (`G90`).
    ///
    /// It is an information where a call repeats a subprogram three times or more that cuts, and all of whose moves go to absolute
    /// positions. A subprogram that does anything else (a stop, a dwell, a bar feed, a shift, arithmetic) is not judged.
    ///
    /// ## Why it matters
    /// The same hole is drilled again and again: a tap cuts its thread away, a drill rubs. A row of holes by a repeat
    /// count needs increments (`G91`).
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 G0 X0. Y0. Z10.
    /// G81 X10. Z-5. R2. K5 F100.
    /// G80
    /// M30
    /// ```
    /// ```nc,reported,haas-mill
    /// O1
    /// G21 G90 G54 G0 X0. Y0. Z2. S900 M3
    /// M98 P100 L5
    /// M30
    /// O100
    /// G1 Z-1. F100.
    /// X20.
    /// G0 Z2.
    /// X0.
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G54 G0 X0. Y0. Z10.
    /// G91 G81 X10. Z-7. R-8. K5 F100.
    /// G90 G80
    /// M30
    /// ```
    rule "cycle-repeated-in-place" in "cycles" {
        summary: "canned cycle repeated at one place",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS),
            make: || Box::new(CycleRepeatedInPlace::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleRepeatedInPlace {
    /// The call whose subprogram was looked at last.
    call: Option<At>,
}

remembers!(CycleRepeatedInPlace: call);

/// So often a cut is repeated for its surface.
const FEW: u32 = 2;
/// Blocks of a subprogram that are looked at.
const MOST_BLOCKS: u32 = 2000;

impl PathRule for CycleRepeatedInPlace {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| is_cycle(effect) || is_round_pocket(effect) || effect.calls())
    }

    /// The first cut of a subprogram.
    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let Some(frame) = cx.state().frames().last().filter(|_| cx.depth() > 1) else { return };
        let times = frame.repeats().map_or(0, |further| further.saturating_add(1));
        let (call, entry) = (frame.caller, frame.entry);
        if times <= FEW || call.file != 0 || entry.file != 0 || self.call.replace(call) == Some(call) {
            return;
        }
        let is_absolute = cx.state().is_incremental(cx.model) == Some(false);
        if is_absolute
            && cx.is_certain()
            && does_the_same_again(cx, entry)
            && let Some(finding) = repeated_call(cx, call, times)
        {
            report.add(finding);
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        judge(cx, report);
    }

    /// A block without a code: its first move goes to the hole.
    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let repeat = Letter::of(cx.model.semantics().cycles.repeat);
        if cx.origin().letters.contains(repeat) && cx.codes().is_empty() {
            judge(cx, report);
        }
    }
}

/// Does a subprogram go to absolute positions alone, so that it does the same again?
fn does_the_same_again(cx: &PathCx<'_>, entry: At) -> bool {
    let Some(file) = cx.program.file(entry.file) else { return false };
    let part = file.loaded.flow_graph().part_of(entry.block);
    let blocks = entry.block..part.end;
    blocks.end.saturating_sub(blocks.start) <= MOST_BLOCKS
        && blocks
            .clone()
            .all(|block| cx.place_of(At { block, ..entry }).is_some_and(|place| is_plain(cx, &place)))
}

/// Does a block do nothing but move to positions, drill, or switch the spindle or coolant?
fn is_plain(cx: &PathCx<'_>, place: &Place) -> bool {
    let odd = BlockFlags::STATEMENT | BlockFlags::EXPRESSION | BlockFlags::ERROR | BlockFlags::BLOCK_DELETE;
    let block = place.block();
    if block.flags.intersects(odd) || block.letters.intersects(LetterSet::of("TUVW")) {
        return false;
    }
    let is_code = |letter: Letter| matches!(letter.ascii(), b'G' | b'M');
    let codes = || place.table.words(block).iter().filter(|word| is_code(word.letter));
    codes().all(|word| {
        let effect = cx.model.effect(word.code);
        effect.is_plain_move()
            || effect.starts_spindle()
            || effect.switches_coolant()
            || is_drilling(effect)
            || matches!(
                effect,
                Effect::Absolute
                    | Effect::Return
                    | Effect::SpindleStop
                    | Effect::CycleCancel
                    | Effect::ReturnToInitial
                    | Effect::ReturnToR
                    | Effect::CompensationLeft
                    | Effect::CompensationRight
                    | Effect::CompensationOff
            )
    })
}

fn repeated_call(cx: &PathCx<'_>, call: At, times: u32) -> Option<Finding> {
    let range = cx.find_word(call, |word| word.letter == Letter::of('L')).or_else(|| cx.range_of(call))?;
    let finding = Finding::new(&META, range, format!("the subprogram runs {times} times at one place"))
        .label("every pass does the same: all its moves go to absolute positions")
        .help("move the start of each pass on, with increments or a shift, or remove the repeats")
        .at_most(Severity::Info);
    Some(finding)
}

fn judge(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let letter = cx.model.semantics().cycles.repeat;
    if !cx.origin().letters.contains(Letter::of(letter)) {
        return;
    }
    let Some(cycle) = repeated(cx) else { return };
    let is_absolute = match cx.code_of_role(Role::Distance) {
        Some(code) => cx.model.effect(code) == Effect::Absolute,
        None => cx.state().is_incremental(cx.model) == Some(false),
    };
    let reads = cx.control().code_at(cycle).is_some_and(|code| code.reads().contains(Letter::of(letter)));
    // A cycle that gives the letter another meaning has no repeats.
    if !is_absolute || !reads {
        return;
    }
    let Some(times) = cx.known_number(letter).and_then(whole).filter(|times| *times > 1) else { return };
    // Words that are always increments move each repeat on.
    let own = cx.model.semantics().increments.keys().filter_map(|key| Letter::parse(key));
    if own.into_iter().any(|letter| cx.origin().letters.contains(letter)) {
        return;
    }
    let name = cx.name_of(cycle);
    let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
    let incremental = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
    let finding = cx
        .finding(
            &META,
            cx.letter_range(letter),
            format!("the cycle runs {times} times at one place (`{name}` under `{absolute}`)"),
        )
        .label("every repeat goes to the same position")
        .help(format!(
            "give the distance from hole to hole in increments (`{incremental}`), or remove `{letter}`"
        ))
        .at_most(Severity::Warning);
    report.add(match cx.code_of_role(Role::Distance) {
        Some(_) => finding,
        None => cx.resting_on(finding, Fact::Mode(Role::Distance), &format!("`{absolute}`")),
    });
}

/// The cycle that the block runs: its own, or the one in effect in a block that only goes to a position.
fn repeated(cx: &PathCx<'_>) -> Option<CodeIx> {
    let pocket = cx.codes().iter().copied().find(|code| is_round_pocket(cx.model.effect(*code)));
    let own = pocket.or_else(|| cx.code_of_role(Role::Cycle));
    let cycle = match own {
        Some(own) => own,
        None if cx.names_axes()
            && cx.codes().iter().all(|code| cx.model.role(*code) == Some(Role::Distance)) =>
        {
            cx.state().active_cycle(cx.model)?
        }
        None => return None,
    };
    let effect = cx.model.effect(cycle);
    (is_cycle(effect) || is_round_pocket(effect)).then_some(cycle)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_is_no_repeat_and_nought_drills_nothing() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1.\nG81 X1. Z-1. R.1 L1 F10.\nG83 X2. Z-1. R.1 Q.1 L0\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_subprogram_that_does_the_same_again() {
        let program = |call: &str, moves: &str| {
            format!("O1\nG21 G90 G54 G0 X0. Y0. Z2. S900 M3\n{call}\nM30\nO100\n{moves}\nM99\n")
        };
        let cut = "G1 Z-1. F100.\nX20.\nG0 Z2.\nX0.";
        check_rule(
            &RULE,
            "haas-mill",
            &program("M98 P100 L5", cut),
            &expect![[r#"
                3 | M98 P100 L5
                  |          ^^ info[cycle-repeated-in-place] the subprogram runs 5 times at one place
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("M98 P100 L3", "G99 G81 X10. Z-5. R2. F100.\nX20.\nG80"),
            &expect![[r#"
                3 | M98 P100 L3
                  |          ^^ info[cycle-repeated-in-place] the subprogram runs 3 times at one place
            "#]],
        );
        for (call, moves) in [
            ("M98 P100", cut),
            ("M98 P100 L2", cut),
            ("M98 P100 L5", "G91 G1 Z-1. F100.\nG90 X20.\nX0."),
            ("G91\nM98 P100 L5", cut),
            ("M98 P100 L5", "G1 Z#500 F100.\nX20.\nG0 Z2.\nX0."),
            ("M98 P100 L5", "#500=#500-1.\nG1 Z-1. F100.\nX20.\nG0 Z2.\nX0."),
            ("M98 P100 L5", "G1 Z-1. F100.\nX20.\nG0 Z2.\nX0.\nM0"),
            ("M98 P100 L5", "G1 Z-1. F100.\nX20.\nG0 Z2.\nX0.\nG52 X30."),
            ("M98 P100 L5", "G1 Z-1. F100.\nX20.\nG0 Z2.\nX0.\nM21"),
            ("M98 P100 L5", "G1 Z-1. F100.\nX20.\nG0 Z2.\nX0.\nG91 G0 A60.\nG90"),
            ("M98 P100 L5", "G0 X10.\nX0."),
            ("M98 P100 L5", "T2 M6\nG1 Z-1. F100.\nX20.\nG0 Z2.\nX0."),
        ] {
            check_rule(&RULE, "haas-mill", &program(call, moves), &expect![[""]]);
        }
        // A part from a bar in each pass.
        let part = "O1\nG21 G99 T0101\nG97 S900 M3\nM98 P100 L20\nM30\nO100\nG0 X20. Z2.\nG1 Z-20. F.2\nX30.\nG0 Z2.\nG105\nM99\n";
        check_rule(&RULE, "haas-lathe", part, &expect![[""]]);
    }

    #[test]
    fn a_mode_of_the_block_itself_counts() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G91 G0 X0 Y0\nG90 G81 X10 Z-5 R2 L3 F100\nG80\nM2\n",
            &expect![[r#"
                2 | G90 G81 X10 Z-5 R2 L3 F100
                  |                    ^^ warning[cycle-repeated-in-place] the cycle runs 3 times at one place (`G81` under `G90`)
            "#]],
        );
    }
}
