//! A jump to a sequence number that its program has more than once.

use std::collections::BTreeSet;

use gcheck_controls::{Motion, WordKind};
use gcheck_program::{Jump, Label};

use crate::declare::declare_rule;
use crate::facts::sections::{label_index, program_around, target_word};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A jump names a sequence number that is in the program more than once.
    ///
    /// ## Why it matters
    /// Which block the control finds depends on where its search begins: most controls search forward first and then
    /// from the top. A block that was inserted by hand can send the jump to the wrong tool.
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
        summary: "jump target exists more than once",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.file_index.jumps.is_empty() {
        return;
    }
    let index = label_index(cx);
    let mut told: BTreeSet<(u32, u32)> = BTreeSet::new();
    let places =
        cx.places(cx.file_index.jumps.iter().filter_map(|jump| Some((jump.target?, jump.range.clone()))));
    for jump in &cx.file_index.jumps {
        let Some(target) = jump.target else { continue };
        let word = target_word(cx, jump.code, WordKind::Label, cx.slice(jump.range.clone()));
        if word.is_some_and(|(code, word)| word.elsewhere || code.motion() != Motion::None) {
            continue;
        }
        let program = program_around(cx, jump.range.start);
        if let [first, second, ..] = index.within(target, &program)
            && told.insert((program.start, target))
        {
            let same = places.get(&target).map_or(&[][..], Vec::as_slice);
            report.add(cx.if_run(finding(jump, first, second), same));
        }
    }
}

fn finding(jump: &Jump, first: &Label, second: &Label) -> Finding {
    Finding::new(&META, jump.range.clone(), format!("jump target `N{}` exists more than once", first.number))
        .label("goes to whichever one the search finds first")
        .also(first.range.clone(), "one of them")
        .also(second.range.clone(), "another")
        .note("most controls search forward from the jump, then from the top of the program  [general knowledge]")
        .help("give the blocks different numbers")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn one_finding_for_each_number() {
        check_rule(
            &RULE,
            "haas-mill",
            "M97 P10\nM97 P10\nM30\nN10 M99\nN10 M99\n",
            &expect![[r#"
                1 | M97 P10
                  |     ^^^ warning[ambiguous-jump-target] jump target `N10` exists more than once
            "#]],
        );
    }

    #[test]
    fn the_same_number_in_two_programs_is_no_doubt() {
        check_rule(&RULE, "fanuc-mill", "O1\nGOTO 10\nN10 M30\nO2\nN10 M99\nGOTO#1\n", &expect![[""]]);
    }

    #[test]
    fn both_blocks_are_shown() {
        let found = findings(&only(&RULE), "fanuc-mill", "GOTO 1\nN1\nN1\n", &World::default());
        expect![[r#"
            jump target `N1` exists more than once
              here: goes to whichever one the search finds first
              there: one of them
              there: another
              note: most controls search forward from the jump, then from the top of the program  [general knowledge]
              help: give the blocks different numbers
        "#]].assert_eq(&words(&found[0]));
    }
}
