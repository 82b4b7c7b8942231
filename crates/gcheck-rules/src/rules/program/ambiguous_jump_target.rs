//! A jump to a sequence number that stands twice in its program.

use std::collections::BTreeSet;

use gcheck_controls::{Motion, WordKind};
use gcheck_program::{Jump, Label};

use crate::meta::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A jump names a sequence number that stands more than once in the program.
    ///
    /// ## Why it matters
    /// Which block the control finds depends on where it begins to search: most search forward first and then from the top.
    /// A block inserted by hand can send the jump to the wrong tool.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// IF [#100 GT 5] GOTO 20
    /// N20 G0 Z1.
    /// N20 M30
    /// ```
    /// ## Not reported
    /// Numbers that nothing jumps to may repeat; so may the profile blocks of lathe cycles, which are searched forward.
    /// ```nc,quiet,fanuc-lathe
    /// O0001
    /// GOTO 30
    /// G70 P10 Q20
    /// N10 G0 X10.
    /// N20 G1 Z-5. F0.1
    /// G70 P10 Q20
    /// N10 G0 X20.
    /// N20 G1 Z-5. F0.1
    /// N30 M30
    /// ```
    rule "ambiguous-jump-target" in "program" {
        summary: "jump target stands more than once",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.survey.jumps.is_empty() {
        return;
    }
    let index = cx.label_index();
    let mut told: BTreeSet<(u32, u32)> = BTreeSet::new();
    for jump in &cx.survey.jumps {
        let Some(target) = jump.target else { continue };
        let word = cx.target_word(jump.code, WordKind::Label, cx.slice(jump.range.clone()));
        if word.is_some_and(|(code, word)| word.elsewhere || code.motion() != Motion::None) {
            continue;
        }
        let program = cx.program_around(jump.range.start);
        if let [first, second, ..] = index.within(target, &program)
            && told.insert((program.start, target))
        {
            report.add(finding(jump, first, second));
        }
    }
}

fn finding(jump: &Jump, first: &Label, second: &Label) -> Finding {
    Finding::new(&META, jump.range.clone(), format!("jump target `N{}` stands more than once", first.number))
        .label("goes to whichever of them the search meets first")
        .also(first.range.clone(), "one of them")
        .also(second.range.clone(), "another")
        .note("most controls search forward from the jump, then from the top of the program  [general knowledge]")
        .help("give the blocks different numbers")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::Selection;
    use crate::testing::{World, check_rule, findings, words};

    #[test]
    fn one_finding_for_each_number() {
        check_rule(
            &RULE,
            "haas-mill",
            "M97 P10\nM97 P10\nM30\nN10 M99\nN10 M99\n",
            &expect![[r#"
                1 | M97 P10
                  |     ^^^ warning[ambiguous-jump-target] jump target `N10` stands more than once
            "#]],
        );
    }

    #[test]
    fn the_same_number_in_two_programs_is_no_doubt() {
        check_rule(&RULE, "fanuc-mill", "O1\nGOTO 10\nN10 M30\nO2\nN10 M99\nGOTO#1\n", &expect![[""]]);
    }

    #[test]
    fn both_blocks_are_shown() {
        let found = findings(&Selection::only(&RULE), "fanuc-mill", "GOTO 1\nN1\nN1\n", &World::default());
        expect![[r#"
            jump target `N1` stands more than once
              here: goes to whichever of them the search meets first
              there: one of them
              there: another
              note: most controls search forward from the jump, then from the top of the program  [general knowledge]
              help: give the blocks different numbers
        "#]].assert_eq(&words(&found[0]));
    }
}
