//! An assignment to a variable that programs may only read.

use std::ops::Range;

use gcheck_controls::{Access, Variable, VariableEntry};
use gcheck_program::{BlockFlags, StatementKind, Target};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A program assigns to a variable that it may only read: the null variable, a position, a modal state.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block, or silently ignores the assignment.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #0=10.
    /// ```
    /// ```nc,reported,linuxcnc
    /// #5420=0
    /// #<_metric>=1
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #100=#5001
    /// #[#1+100]=0
    /// ```
    rule "assignment-to-read-only-variable" in "macros" {
        summary: "assignment to a variable that is read only",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for statement in cx.statements() {
        let StatementKind::Assign { target, .. } = &statement.kind else { continue };
        let entry = match target {
            Target::Variable(number) => match cx.control().variable(*number) {
                Variable::Known(entry) => Some(entry),
                Variable::Unlisted => None,
            },
            Target::Named(name) => cx.control().named_parameter(cx.slice(name.clone())),
            Target::Computed(_) | Target::Invalid => None,
        };
        if let Some(entry) = entry.filter(|e| e.access == Access::Read) {
            let name = cx.slice(statement.range.clone()).split('=').next().unwrap_or_default().trim_end();
            let start = statement.range.start;
            report.add(finding(name, cx.in_file(start..start + name.len() as u32), entry));
        }
    }
}

fn finding(name: &str, place: Range<u32>, entry: &VariableEntry) -> Finding {
    Finding::new(&META, place, format!("variable `{name}` can only be read"))
        .label("assigned to here")
        .note(format!("`{name}`: {}  [{}]", entry.title, entry.source))
        .help("assign to a common or local variable")
        .at_most(limit(entry.confidence))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn facts_that_are_assumed_give_a_warning() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "#0 = 1\n#5021=2\n#5221=3\n",
            &expect![[r#"
            1 | #0 = 1
              | ^^ error[assignment-to-read-only-variable] variable `#0` can only be read
            2 | #5021=2
              | ^^^^^ warning[assignment-to-read-only-variable] variable `#5021` can only be read
        "#]],
        );
    }

    #[test]
    fn the_variable_behind_then_is_found() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [#1 EQ 1] THEN #0= 2\n",
            &expect![[r#"
            1 | IF [#1 EQ 1] THEN #0= 2
              |                   ^^ error[assignment-to-read-only-variable] variable `#0` can only be read
        "#]],
        );
    }

    #[test]
    fn names_are_compared_without_case() {
        let found = findings(&only(&RULE), "linuxcnc", "#<_Metric> = 1\n", &World::default());
        expect![[r#"
            variable `#<_Metric>` can only be read
              here: assigned to here
              note: `#<_Metric>`: 1 under G21  [LCNC-OVERVIEW; RS274-2.9]
              help: assign to a common or local variable
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
