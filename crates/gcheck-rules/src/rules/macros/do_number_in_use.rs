//! A loop inside a loop of the same number.

use gcheck_program::Loop;

use crate::declare::declare_rule;
use crate::facts::do_loops::{LoopFault, loop_faults};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// `DO` uses the number of a loop around it.
    ///
    /// ## Why it matters
    /// An `END` can then belong to either loop: the control stops with an alarm, or leaves the wrong loop.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// WHILE [#1 LT 10] DO1
    /// WHILE [#2 LT 5] DO1
    /// #2= #2 + 1
    /// END1
    /// #1= #1 + 1
    /// END1
    /// ```
    /// ## Not reported
    /// One loop after another.
    /// ```nc,quiet,haas-mill
    /// WHILE [#1 LT 10] DO1
    /// #1= #1 + 1
    /// END1
    /// WHILE [#2 LT 5] DO1
    /// #2= #2 + 1
    /// END1
    /// ```
    rule "do-number-in-use" in "macros" {
        summary: "loop inside a loop of the same number",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for fault in loop_faults(cx) {
        if let LoopFault::NumberInUse { begin, outer } = fault {
            report.add(finding(begin, outer));
        }
    }
}

fn finding(begin: &Loop, outer: &Loop) -> Finding {
    let number = begin.number.unwrap_or_default();
    Finding::new(
        &META,
        begin.range.clone(),
        format!("loop number {number} is in use by the loop around it (`DO{number}`)"),
    )
    .label("begins inside a loop of the same number")
    .also(outer.range.clone(), "the outer loop begins here")
    .help("give the inner loop, and its `END`, another number")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_inner_loop_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "DO2\nDO2\nEND2\nEND2\n",
            &expect![[r#"
                2 | DO2
                  | ^^^ error[do-number-in-use] loop number 2 is in use by the loop around it (`DO2`)
            "#]],
        );
    }

    #[test]
    fn the_outer_loop_is_shown() {
        let found = findings(&only(&RULE), "fanuc-lathe", "DO1\nDO1\nEND1\nEND1\n", &World::default());
        expect![[r#"
            loop number 1 is in use by the loop around it (`DO1`)
              here: begins inside a loop of the same number
              there: the outer loop begins here
              help: give the inner loop, and its `END`, another number
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
