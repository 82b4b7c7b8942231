//! Loops that overlap.

use gcheck_program::Loop;

use crate::declare::declare_rule;
use crate::facts::do_loops::{LoopFault, loop_faults};
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A loop is closed while a loop inside it is still open.
    ///
    /// ## Why it matters
    /// Loops must be nested in each other. The control stops with an alarm, or repeats the wrong blocks.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// WHILE [#1 LT 10] DO1
    /// WHILE [#2 LT 5] DO2
    /// #2=#2+1
    /// END1
    /// END2
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// WHILE [#1 LT 10] DO1
    /// WHILE [#2 LT 5] DO2
    /// #2=#2+1
    /// END2
    /// END1
    /// M30
    /// ```
    rule "crossed-loops" in "macros" {
        summary: "loops overlap",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    for fault in loop_faults(cx) {
        if let LoopFault::Crossed { end, begin, inner } = fault {
            report.add(finding(end, begin, inner));
        }
    }
}

fn finding(end: &Loop, begin: &Loop, inner: &Loop) -> Finding {
    let (number, inside) = (end.number.unwrap_or_default(), inner.number.unwrap_or_default());
    Finding::new(&META, end.range.clone(), format!("loops `DO{number}` and `DO{inside}` overlap"))
        .label(format!("closes loop {number} while loop {inside} is open"))
        .also(begin.range.clone(), format!("loop {number} begins"))
        .also(inner.range.clone(), format!("loop {inside} begins inside it"))
        .help(format!("close loop {inside} first"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_early_end_is_marked() {
        check_rule(
            &RULE,
            "haas-lathe",
            "DO1\nDO2\nDO3\nEND1\nEND3\nEND2\nM30\n",
            &expect![[r#"
                4 | END1
                  | ^^^^ error[crossed-loops] loops `DO1` and `DO2` overlap
            "#]],
        );
    }

    #[test]
    fn both_beginnings_are_shown() {
        let found = findings(&only(&RULE), "fanuc-mill", "DO1\nDO2\nEND1\nEND2\n", &World::default());
        expect![[r#"
            loops `DO1` and `DO2` overlap
              here: closes loop 1 while loop 2 is open
              there: loop 1 begins
              there: loop 2 begins inside it
              help: close loop 2 first
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
