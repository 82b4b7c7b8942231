//! Several assignments in a block.

use std::ops::Range;

use gcheck_program::{BlockFlags, Statement, StatementKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A block assigns to more than one variable, and the control accepts one assignment per block.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block, or carries out only the first assignment.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// #1= 5. #2= 6.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// #1= 5.
    /// #2= 6.
    /// ```
    /// ```nc,quiet,linuxcnc
    /// #1=5 #2=6
    /// ```
    rule "several-assignments" in "macros" {
        summary: "several assignments in a block",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.control().syntax().several_assignments || cx.block().flags.contains(BlockFlags::ERROR) {
        return;
    }
    let mut assignments = cx.statements().filter(|s| matches!(s.kind, StatementKind::Assign { .. }));
    if let (Some(first), Some(second)) = (assignments.next(), assignments.next()) {
        report.add(finding(cx, first, second, 2 + assignments.count()));
    }
}

fn finding(cx: &BlockCx<'_>, first: &Statement, second: &Statement, count: usize) -> Finding {
    let range = |s: &Statement| -> Range<u32> { cx.in_file(s.range.clone()) };
    Finding::new(&META, range(second), format!("{count} assignments in one block"))
        .label("the second assignment of the block")
        .also(range(first), "the first")
        .note("this control accepts one assignment per block  [general knowledge]")
        .help("put each assignment in a block of its own")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_second_assignment_is_marked() {
        check_rule(
            &RULE,
            "haas-lathe",
            "N10 #1= 1. #2= 2. #3= 3.\nIF [#1 EQ 1] THEN #2= 5.\n",
            &expect![[r#"
                1 | N10 #1= 1. #2= 2. #3= 3.
                  |            ^^^^^^ warning[several-assignments] 3 assignments in one block
            "#]],
        );
    }

    #[test]
    fn the_first_is_shown() {
        let found = findings(&only(&RULE), "haas-mill", "#1= 1 #2= 2\n", &World::default());
        expect![[r#"
            2 assignments in one block
              here: the second assignment of the block
              there: the first
              note: this control accepts one assignment per block  [general knowledge]
              help: put each assignment in a block of its own
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
