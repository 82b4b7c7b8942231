//! A word that the control ignores or refuses, because no active mode reads it.

use gcheck_controls::{
    Code, CodeIx, Control, Effect, Handling, LastingFrom, LastingWords, Letter, LetterSet, Motion,
};
use gcheck_engine::Role;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::facts::turning::profile_blocks;
use crate::facts::word_sets::read_by_modes;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch, limit};

declare_rule! {
    /// Neither a code of the block nor the motion in effect reads this word.
    ///
    /// ## Why it matters
    /// Some controls stop with an alarm. Others silently ignore the word. Most often the word is left from another block: a `Q` after the end of a peck
    /// cycle, a `P` without its dwell. Its intended effect does not happen.
    ///
    /// `word-not-read` reports a word that no mode of the control reads.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G1 X1. Q0.1 F10.
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G90 G0 X0. Y0. R2.
    /// ```
    /// ## Not reported
    /// The cycle in effect reads it:
    /// ```nc,quiet,fanuc-mill
    /// G99 G83 X0. Y0. Z-20. R2. Q3. F100.
    /// G98 X10. Q2.
    /// ```
    /// A builder's code may read it:
    /// ```nc,quiet,fanuc-mill
    /// M45 Q2
    /// ```
    rule "word-passed-over" in "words" {
        summary: "word that nothing in effect reads",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::ALL_BLOCKS, make: || Box::new(WordPassedOver) },
    }
}

struct WordPassedOver;

impl PathRule for WordPassedOver {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        let control = program.environment.control();
        let file_index = program.file_index;
        // A macro that is called for every block accepts any word.
        let is_plain = |code: Option<Code<'_>>| code.is_some_and(|code| !code.is_user() && !takes_all(code));
        !file_index.has_computed_codes
            && file_index.codes.iter().all(|(number, _)| is_plain(control.code(*number)))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for letter in cx.origin().letters.and(OFFSETS).iter().filter(|letter| is_idle(cx, *letter)) {
            tell_idle(cx, letter, report);
        }
        let flags = cx.origin().flags;
        if !flags.contains(BlockFlags::UNREAD_WORD)
            || flags.intersects(BlockFlags::ERROR | BlockFlags::STATEMENT | BlockFlags::UNKNOWN_CODE)
        {
            return;
        }
        let Some(unread) = unread(cx).filter(|unread| !unread.is_empty()) else { return };
        let control = cx.control();
        let is_refused = control.block_rules().unread_word == Handling::Refused;
        let (does, severity) = if is_refused {
            ("refuses a block with a word that no code reads", Severity::Error)
        } else {
            ("ignores a word that no code reads", Severity::Info)
        };
        // The first and the last block of a profile: what was meant is a roughing cycle, of another control or system of codes.
        let profile = LetterSet::of("PQ");
        let rough = cx.name_of_effect(Effect::RoughAlongZ);
        let profile_cycle =
            rough.filter(|_| profile.without(unread).is_empty() && profile_blocks(cx).is_some());
        let severity = if profile_cycle.is_some() { severity.max(Severity::Warning) } else { severity };
        for letter in unread.iter() {
            let Some(entry) = control.letter(letter) else { continue };
            let Some(range) = cx.find_word(cx.origin().at, |word| word.letter == letter) else { continue };
            let rules = control.block_rules();
            let finding = cx
                .finding(&META, range, format!("nothing reads `{letter}` in this block"))
                .label(entry.is.as_str())
                .note(format!("this control {does}  [{}]", rules.source))
                .at_most(severity)
                .at_most(limit(rules.confidence));
            report.add(if let Some(cycle) = &profile_cycle {
                finding
                    .note("`P` and `Q` name blocks of the program, as those of a roughing cycle do, and nothing is roughed here")
                    .help(format!("on this control the roughing cycle is `{cycle}`"))
            } else {
                finding.help(format!("remove `{letter}`, or add the code that it belongs to"))
            });
        }
    }
}

/// Numbers of offsets.
const OFFSETS: LetterSet = LetterSet::of("DH");

/// Does the word stay for codes that the program does not have?
fn is_idle(cx: &PathCx<'_>, letter: Letter) -> bool {
    let control = cx.control();
    let stays = |row: &LastingWords| {
        LetterSet::of(&row.letters).contains(letter) && row.from == LastingFrom::AnyBlock
    };
    let mut codes = cx.file_index.codes.iter().filter_map(|(number, _)| control.code(*number));
    control.lasting().iter().any(stays)
        && control.letter(letter).is_some_and(|entry| entry.free && !entry.axis)
        && cx.file_index.calls.is_empty()
        && !cx.is_malformed()
        && !codes.any(|code| code.reads().contains(letter) || code.entry().any_words)
}

fn tell_idle(cx: &PathCx<'_>, letter: Letter, report: &mut Report<'_>) {
    let control = cx.control();
    let Some(entry) = control.letter(letter) else { return };
    let Some(range) = cx.find_word(cx.origin().at, |word| word.letter == letter) else { return };
    report.add(
        cx.finding(&META, range, format!("no code of the program uses `{letter}`"))
            .label(entry.is.as_str())
            .note(format!("the control keeps the number for a later code  [{}]", entry.source))
            .help(format!("remove `{letter}`, or add the code that it belongs to"))
            .at_most(Severity::Info),
    );
}

/// Addresses of the block that nothing reads; `None` where that is not known.
fn unread(cx: &PathCx<'_>) -> Option<LetterSet> {
    let control = cx.control();
    let mut read = LetterSet::EMPTY;
    let mut replaced = false;
    for ix in cx.codes().iter() {
        let code = control.code_at(*ix)?;
        // Where a machine builder makes M codes, he decides about their words.
        let is_builders = code.number().letter() == b'M' && control.code_list().builder_m_codes;
        if is_builders || code.entry().any_words {
            return None;
        }
        replaced |= code.entry().takes_axes || code.motion() != Motion::None;
        read = read.or(code.reads());
    }
    let is_refused = control.block_rules().unread_word == Handling::Refused;
    if !replaced {
        read = read.or(of_motion(cx, is_refused)?);
    }
    // A compensation may read the words of its code again in later blocks: its vector.
    let lasting = |code: &Code<'_>| {
        matches!(Role::of(code.effect()), Some(Role::Compensation | Role::Length))
            && !matches!(code.effect(), Effect::CompensationOff | Effect::LengthOff)
    };
    let codes_of_file = cx.file_index.codes.iter().filter_map(|(number, _)| control.code(*number));
    for code in codes_of_file.filter(|code| !is_refused && lasting(code)) {
        read = read.or(code.reads());
    }
    // `word-not-read` reports a word that no mode of the control reads.
    let codes = cx.codes();
    let by_modes = read_by_modes(control, || codes.iter().filter_map(|ix| control.code_at(*ix)));
    let unread = cx.origin().letters.and(by_modes).without(read);
    Some(unread.iter().filter(|letter| is_bound(control, *letter)).collect())
}

/// Does the address need a code that reads it?
fn is_bound(control: &Control, letter: Letter) -> bool {
    let is_bound = control.letter(letter).is_some_and(|entry| !entry.free && !entry.axis);
    is_bound && !matches!(letter.ascii(), b'N' | b'O')
}

/// Does the block name an axis, or a centre while arcs are the mode?
fn may_move(cx: &PathCx<'_>) -> bool {
    const MOVING: LetterSet = LetterSet::of("IJK");
    let polar = LetterSet::from_iter([Letter::AT, Letter::CARET]);
    cx.names_axes() || cx.origin().letters.intersects(MOVING.or(polar))
}

/// Addresses that the motion or the cycle in effect reads; `None` if it may be any.
///
/// Motion reads its words in a block that moves. A cycle keeps words of other blocks for later ones, where the control does not
/// refuse them.
fn of_motion(cx: &PathCx<'_>, is_refused: bool) -> Option<LetterSet> {
    let control = cx.control();
    let cycle = cx.state().active_cycle(cx.model)?;
    let motion = cx.state().mode(Role::Motion).only()?;
    let reads = |ix: CodeIx| match control.code_at(ix) {
        Some(code) if code.entry().any_words => None,
        Some(code) => Some(code.reads()),
        None => Some(LetterSet::EMPTY),
    };
    let (cycle, motion) = (reads(cycle)?, reads(motion)?);
    Some(match (may_move(cx), is_refused) {
        (true, _) => cycle.or(motion),
        (false, false) => cycle,
        (false, true) => LetterSet::EMPTY,
    })
}

/// Does the code, while it is active, read words of any block?
fn takes_all(code: Code<'_>) -> bool {
    code.effect() == Effect::MacroModal || code.group().modal && code.entry().any_words
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn rows_of_data_have_words_of_their_own() {
        let program = |end: &str| format!("G10 L3\nP1 L20\nT5 H5\n{end}G0 X1. Q2.\nM30\n");
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G11\n"),
            &expect![[r#"
            5 | G0 X1. Q2.
              |        ^^^ info[word-passed-over] nothing reads `Q` in this block
        "#]],
        );
        // The block that ends the rows is a command.
        check_rule(
            &RULE,
            "fanuc-mill",
            "G10 L3\nP1 L20\nG11 G0 X1. Q2.\nM30\n",
            &expect![[r#"
            3 | G11 G0 X1. Q2.
              |            ^^^ info[word-passed-over] nothing reads `Q` in this block
        "#]],
        );
    }

    #[test]
    fn a_roughing_cycle_of_another_system() {
        check_rule(
            &RULE,
            "fanuc-lathe-c",
            "G71 G90\nG0 X64. Z2.\nG71 U2. R1.\nG71 P100 Q200 U.4 W.1 F.3\nN100 G0 X26.\nG1 Z-20.\nN200 X62.\nM30\n",
            &expect![[r#"
                3 | G71 U2. R1.
                  |         ^^^ info[word-passed-over] nothing reads `R` in this block
                4 | G71 P100 Q200 U.4 W.1 F.3
                  |     ^^^^ warning[word-passed-over] nothing reads `P` in this block
                4 | G71 P100 Q200 U.4 W.1 F.3
                  |          ^^^^ warning[word-passed-over] nothing reads `Q` in this block
            "#]],
        );
    }

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0. Y0. Z1.\nG83 Z-1. R.1 Q.2 F10.\nX1. Q.3\nG80\nG1 X2. Q.3\nG4 P1. R2.\nM30\n",
            &expect![[r#"
                5 | G1 X2. Q.3
                  |        ^^^ info[word-passed-over] nothing reads `Q` in this block
                6 | G4 P1. R2.
                  |        ^^^ info[word-passed-over] nothing reads `R` in this block
            "#]],
        );
    }

    #[test]
    fn words_of_a_cycle_and_of_the_motion_in_effect_are_read() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G0 X0. Y0.\nG83 Z-1. R.1 Q.2 F10.\nG98 R.5\nG80\nG2 X1. R1.\nG90 X3. R2.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn words_of_the_motion_in_effect_need_a_move() {
        let program = |block: &str| format!("G21 G54 G0 X50. Z5.\nG1 X40. F.1\n{block}\nX30.\nM30\n");
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G55 R2."),
            &expect![[r#"
                3 | G55 R2.
                  |     ^^^ info[word-passed-over] nothing reads `R` in this block
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("G55 X35. R2."), &expect![[""]]);
    }

    #[test]
    fn a_vector_of_the_tool_is_read_in_every_block() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 A0. Y0. Q3.\nG1 X1. Q2.\nG141 D1 X1. I1. J0. K0.\nG1 X2. I0. J1. K0.\nM30\n",
            &expect![[r#"
                2 | G1 X1. Q2.
                  |        ^^^ info[word-passed-over] nothing reads `Q` in this block
            "#]],
        );
    }

    #[test]
    fn a_control_that_refuses_unread_words_refuses_them_beside_m_codes() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 G2 X1. R5. F100.\nM8 R5.\nX2. R5.\nM2\n",
            &expect![[r#"
                2 | M8 R5.
                  |    ^^^ error[word-passed-over] nothing reads `R` in this block
            "#]],
        );
    }

    #[test]
    fn a_word_in_a_block_without_a_code_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G0 X0. Y0.\nJ0.\nX1. Q2.\nG83 Z-1. R.1 Q.2 F10.\nX2. Q.3\nM30\n",
            &expect![[r#"
                2 | J0.
                  | ^^^ info[word-passed-over] nothing reads `J` in this block
                3 | X1. Q2.
                  |     ^^^ info[word-passed-over] nothing reads `Q` in this block
            "#]],
        );
    }

    #[test]
    fn a_number_of_an_offset_that_no_code_of_the_program_uses_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G107 A0. Y0. D50\nG0 X1.\nM30\n",
            &expect![[r#"
            1 | G107 A0. Y0. D50
              |              ^^^ info[word-passed-over] no code of the program uses `D`
        "#]],
        );
        check_rule(&RULE, "haas-mill", "D1\nG41 X1. F5.\nG40 X0.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "D1\nM98 P100\nM30\n", &expect![[""]]);
    }

    #[test]
    fn words_of_m_codes_are_judged_where_no_builder_adds_codes() {
        check_rule(&RULE, "haas-mill", "G0 X1.\nM8 P2\nM3 S500\nM30\n", &expect![""]);
        check_rule(&RULE, "fanuc-mill", "M8 P2\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_macro_for_every_block_takes_any_word() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G66.1 P9010 A1.\nG1 X1. Q2.\nG67\nG1 X2. Q1.\nM30\n",
            &expect![[""]],
        );
    }
}
