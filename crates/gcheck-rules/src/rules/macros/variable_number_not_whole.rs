//! A computed variable number that is not a whole number.

use gcheck_engine::{Fault, FrameKind};
use gcheck_program::{Op, StatementKind, Target};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The number of a variable is computed (`#[…]`), and its value is not a whole number from zero up.
    ///
    /// ## Why it matters
    /// There is no such variable: the control stops, or reads the wrong one.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #1=3
    /// #2=#[100+#1/2]
    /// M30
    /// ```
    /// ```nc,reported,linuxcnc
    /// #1=5
    /// #[#1-6]=1
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #1=4
    /// #2=#[100+#1/2]
    /// #3=#[100+#500/2]
    /// M30
    /// ```
    rule "variable-number-not-whole" in "macros" {
        summary: "computed variable number that names no variable",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(VariableNumberNotWhole) },
    }
}

struct VariableNumberNotWhole;

impl PathRule for VariableNumberNotWhole {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::VariableNumber {
            return;
        }
        // A number that is written is reported as a variable that does not exist.
        if !computes_a_number(cx) {
            return;
        }
        let is_main = cx.state().frames().iter().all(|frame| frame.kind == FrameKind::Main);
        if is_main && cx.file_index.is_called_from_elsewhere() {
            return;
        }
        let finding = cx
            .finding(&META, cx.range(), "computed number names no variable (`#[…]`)")
            .label("is a fraction, below zero, or a number that the control does not have")
            .help("check the expression of the number, or round it with `FIX` or `ROUND`");
        report.add(finding);
    }
}

/// Does the block compute the number of a variable?
fn computes_a_number(cx: &PathCx<'_>) -> bool {
    let target = cx.place().is_some_and(|place| {
        let mut statements = place.table.statements(place.ix);
        statements.any(|one| matches!(one.kind, StatementKind::Assign { target: Target::Computed(_), .. }))
    });
    target
        || cx.expressions().is_some_and(|(table, expressions)| {
            expressions.iter().any(|expr| table.ops(table.expr(*expr)).contains(&Op::Indirect))
        })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_block_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#1= 0.5\n#[100 + #1]= 3\nM30\n",
            &expect![[r#"
            3 | #[100 + #1]= 3
              | ^^^^^^^^^^^^^^ warning[variable-number-not-whole] computed number names no variable (`#[…]`)
        "#]],
        );
    }

    #[test]
    fn a_caller_gives_the_numbers_of_a_subprogram() {
        check_rule(&RULE, "haas-mill", "O9000\n#2= #[#1 - 1]\nM99\n", &expect![[""]]);
    }
}
