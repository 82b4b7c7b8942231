//! A `DO` without `END`.

use gcheck_program::Loop;

use crate::declare::declare_rule;
use crate::facts::do_loops::{LoopFault, loop_faults};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// `DO` begins a loop that no `END` with its number closes.
    ///
    /// ## Why it matters
    /// The control searches for the `END` and stops with an alarm when it does not find it, with the tool wherever it
    /// was when the loop began.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// WHILE [#1 LT 10] DO1
    /// #1=#1+1
    /// END2
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// WHILE [#1 LT 10] DO1
    /// #1=#1+1
    /// END1
    /// M30
    /// ```
    rule "loop-end-missing" in "macros" {
        summary: "`DO` without `END`",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for fault in loop_faults(cx) {
        if let LoopFault::EndMissing(begin) = fault {
            report.add(finding(begin));
        }
    }
}

fn finding(begin: &Loop) -> Finding {
    let number = begin.number.unwrap_or_default();
    Finding::new(&META, begin.range.clone(), format!("loop `DO{number}` has no `END{number}`"))
        .label("this loop is never closed")
        .note("the loop must be closed in the same program")
        .help(format!("close the loop with `END{number}`"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_end_in_another_program_does_not_close() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nWHILE [#1 LT 2] DO1\nM30\nO2\nEND1\nM99\n",
            &expect![[r#"
            2 | WHILE [#1 LT 2] DO1
              | ^^^^^^^^^^^^^^^^^^^ error[loop-end-missing] loop `DO1` has no `END1`
        "#]],
        );
    }

    #[test]
    fn only_the_loop_that_lacks_its_end_is_told() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "DO1\nDO2\nEND1\nDO2\nEND2\nM30\n",
            &expect![[r#"
            2 | DO2
              | ^^^ error[loop-end-missing] loop `DO2` has no `END2`
        "#]],
        );
    }

    #[test]
    fn a_computed_number_could_be_any() {
        check_rule(&RULE, "fanuc-mill", "DO1\nEND#5\nM30\n", &expect![[""]]);
    }
}
