//! An `END` without `DO`.

use gcheck_program::Loop;

use crate::declare::declare_rule;
use crate::facts::do_loops::{LoopFault, loop_faults};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// `END` closes a loop that no `DO` with its number began.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the `END`, or returns to a loop that should have ended.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// WHILE [#1 LT 10] DO1
    /// #1= #1 + 1
    /// END1
    /// END1
    /// M30
    /// ```
    /// ## Not reported
    /// Loops that follow each other may use the same number.
    /// ```nc,quiet,haas-mill
    /// WHILE [#1 LT 10] DO1
    /// #1= #1 + 1
    /// END1
    /// WHILE [#2 LT 10] DO1
    /// #2= #2 + 1
    /// END1
    /// M30
    /// ```
    rule "loop-begin-missing" in "macros" {
        summary: "`END` without `DO`",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for fault in loop_faults(cx) {
        if let LoopFault::BeginMissing(end) = fault {
            report.add(finding(end));
        }
    }
}

fn finding(end: &Loop) -> Finding {
    let number = end.number.unwrap_or_default();
    Finding::new(&META, end.range.clone(), format!("loop end `END{number}` has no `DO{number}`"))
        .label("closes no loop that is open here")
        .note("the loop must begin before this block, in the same program")
        .help(format!("begin the loop with `DO{number}`, or remove this `END{number}`"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn an_end_in_front_of_its_do_closes_nothing() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "END1\nWHILE [#1 EQ 1] DO1\nEND1\n",
            &expect![[r#"
            1 | END1
              | ^^^^ error[loop-begin-missing] loop end `END1` has no `DO1`
        "#]],
        );
    }

    #[test]
    fn controls_without_such_loops_have_another_rule() {
        check_rule(&RULE, "linuxcnc", "END1\n", &expect![[""]]);
    }
}
