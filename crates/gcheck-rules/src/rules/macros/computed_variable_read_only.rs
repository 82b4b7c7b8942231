//! An assignment by computed number to a variable that programs may only read.

use gcheck_controls::Variable;
use gcheck_engine::Fault;
use gcheck_program::{StatementKind, Target};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// The number of the assigned variable is computed, and its value is that of a variable that a program may only
    /// read.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block, or silently ignores the assignment. Often a loop over variables
    /// goes one too far.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// #1=5000
    /// #[#1+1]=0
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// #1=500
    /// #[#1+1]=0
    /// #[#500]=0
    /// M30
    /// ```
    rule "computed-variable-read-only" in "macros" {
        summary: "computed assignment to a variable that is read only",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ComputedVariableReadOnly) },
    }
}

struct ComputedVariableReadOnly;

impl PathRule for ComputedVariableReadOnly {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::ReadOnlyVariable(number) = fault else { return };
        let Some(place) = cx.place() else { return };
        let mut statements = place.table.statements(place.ix);
        let computed =
            statements.find(|s| matches!(&s.kind, StatementKind::Assign { target: Target::Computed(_), .. }));
        // Another rule reports a written number without executing the block.
        let Some(statement) = computed else { return };
        let range = place.base + statement.range.start..place.base + statement.range.end;
        let mut finding = cx
            .finding(&META, range, format!("computed assignment to `#{number}`, which can only be read"))
            .label(format!("the number is {number} here"))
            .help("check the expression of the number");
        if let Variable::Known(entry) = cx.control().variable(*number) {
            finding = finding
                .note(format!("`#{number}`: {}  [{}]", entry.title, entry.source))
                .at_most(limit(entry.confidence));
        }
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_loop_that_goes_one_too_far() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\n#30= 1\nWHILE [#30 GE 0] DO1\n#[#30]= 5\n#30= #30 - 1\nEND1\nM30\n",
            &expect![[r#"
                4 | #[#30]= 5
                  | ^^^^^^^^^ error[computed-variable-read-only] computed assignment to `#0`, which can only be read
            "#]],
        );
    }

    #[test]
    fn a_number_as_it_stands_is_told_elsewhere() {
        check_rule(&RULE, "haas-mill", "#0= 1\nM30\n", &expect![[""]]);
    }
}
