//! A condition without a variable.

use gcheck_program::{BlockFlags, ExprIx, OKeyword, Op, StatementKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A condition has no variable, so its value never changes.
    ///
    /// ## Why it matters
    /// One of the two branches is never taken. Either the condition is left from testing, or a variable lost its `#`.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// IF [1 EQ 1] GOTO 10
    /// N10 M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// o1 if [0]
    /// G0 X1
    /// o1 endif
    /// M2
    /// ```
    /// ## Not reported
    /// A loop that a block inside it ends.
    /// ```nc,quiet,linuxcnc
    /// o1 while [1]
    /// o2 if [#100 GT 5]
    /// o1 break
    /// o2 endif
    /// o1 endwhile
    /// M2
    /// ```
    rule "condition-always-same" in "macros" {
        summary: "condition without a variable",
        severity: Hint,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for statement in cx.statements() {
        let condition = match &statement.kind {
            StatementKind::If { condition } => *condition,
            StatementKind::OWord { keyword: OKeyword::If | OKeyword::ElseIf, arguments, .. } => {
                StatementKind::arguments(arguments).next()
            }
            _ => None,
        };
        let Some(condition) = condition else { continue };
        if is_fixed(cx, condition) {
            report.add(
                Finding::new(&META, cx.in_file(statement.range.clone()), "condition is the same every time")
                    .label("it has no variable")
                    .help("compare with a variable, or remove the condition"),
            );
        }
    }
}

fn is_fixed(cx: &BlockCx<'_>, condition: ExprIx) -> bool {
    let expr = cx.table().expr(condition);
    let ops = cx.table().ops(expr);
    let varies = |op: &Op| matches!(op, Op::Variable(_) | Op::Named { .. } | Op::Indirect);
    expr.well_formed && !ops.is_empty() && !ops.iter().any(varies)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_condition_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [100 GT 5] GOTO 10\nN10 M30\n",
            &expect![[r#"
            1 | IF [100 GT 5] GOTO 10
              | ^^^^^^^^^^^^^ hint[condition-always-same] condition is the same every time
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 if [1 GT 5]\no1 elseif [2]\no1 endif\n",
            &expect![[r#"
            1 | o1 if [1 GT 5]
              | ^^^^^^^^^^^^^^ hint[condition-always-same] condition is the same every time
            2 | o1 elseif [2]
              | ^^^^^^^^^^^^^ hint[condition-always-same] condition is the same every time
        "#]],
        );
    }

    #[test]
    fn any_variable_makes_it_a_question() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [#100 GT 5] GOTO 10\nIF [#0 EQ #1] GOTO 10\nN10 M30\n",
            &expect![[""]],
        );
    }
}
