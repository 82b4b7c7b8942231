//! More nested loops than the control allows.

use gcheck_program::Loop;

use crate::declare::declare_rule;
use crate::facts::do_loops::{LoopFault, loop_faults};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A loop begins inside the highest number of loops that the control can nest.
    ///
    /// ## Why it matters
    /// The control has a loop number for each level and stops with an alarm when all are in use.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// DO1
    /// DO2
    /// DO3
    /// WHILE [#1 LT 5] DO1
    /// END1
    /// END3
    /// END2
    /// END1
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// DO1
    /// DO2
    /// DO3
    /// END3
    /// END2
    /// END1
    /// DO1
    /// END1
    /// ```
    rule "loops-nested-too-deep" in "macros" {
        summary: "loops are nested too deep",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let Some([lowest, highest]) = cx.control().limits().do_numbers else { return };
    for fault in loop_faults(cx) {
        // In that case the number out of range is the mistake.
        if let LoopFault::TooDeep { begin, outermost } = fault
            && begin.number.is_some_and(|n| (f64::from(lowest)..=f64::from(highest)).contains(&n))
        {
            report.add(finding(cx, begin, outermost, highest - lowest + 1));
        }
    }
}

fn finding(cx: &FileCx<'_>, begin: &Loop, outermost: &Loop, depth: u8) -> Finding {
    let source = cx.control().limits().source.as_deref().unwrap_or("general knowledge");
    Finding::new(&META, begin.range.clone(), format!("more than {depth} loops are nested in each other"))
        .label(format!("this loop is one level deeper than {depth}"))
        .also(outermost.range.clone(), "the outermost loop begins here")
        .note(format!("this control nests {depth} loops  [{source}]"))
        .help("move the inner loop into a subprogram, or use `IF` and `GOTO`")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    const FOUR: &str = "DO1\nDO2\nDO3\nDO1\nEND1\nEND3\nEND2\nEND1\n";

    #[test]
    fn the_fourth_loop_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            FOUR,
            &expect![[r#"
            4 | DO1
              | ^^^ error[loops-nested-too-deep] more than 3 loops are nested in each other
        "#]],
        );
    }

    #[test]
    fn the_limit_and_its_source_are_said() {
        let found = findings(&only(&RULE), "haas-mill", FOUR, &World::default());
        expect![[r#"
            more than 3 loops are nested in each other
              here: this loop is one level deeper than 3
              there: the outermost loop begins here
              note: this control nests 3 loops  [HM17 p.125, p.133 (one M code), 6.14.10 (DO numbers), 6.14.12 (nine nested G65 calls), p.234 (aliases); the rest general knowledge]
              help: move the inner loop into a subprogram, or use `IF` and `GOTO`
        "#]].assert_eq(&words(&found[0]));
    }

    #[test]
    fn a_number_out_of_range_is_another_rules_matter() {
        check_rule(&RULE, "fanuc-mill", "DO1\nDO2\nDO3\nDO4\nEND4\nEND3\nEND2\nEND1\n", &expect![[""]]);
    }
}
