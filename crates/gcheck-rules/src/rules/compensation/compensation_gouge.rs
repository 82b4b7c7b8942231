//! A contour that the tool cannot follow.

use gcheck_engine::{CompensationFault, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch, limit};

declare_rule! {
    /// Under cutter compensation the tool does not fit into a corner or an arc of the contour.
    ///
    /// The rule needs the tool's size: from a configured tool table, from `G10`, or from the block itself (`G41.1 D6`).
    ///
    /// ## Why it matters
    /// The control stops with an alarm in the middle of the contour, or the tool gouges the other side of the contour.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 G0 X-30 Y0 Z5
    /// G42.1 D20 G1 X0 F100
    /// Y50
    /// G2 X5 Y50 I2.5
    /// G1 Y0
    /// G40 X60
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 G0 X-30 Y0 Z5
    /// G42.1 D4 G1 X0 F100
    /// Y50
    /// G2 X5 Y50 I2.5
    /// G1 Y0
    /// G40 X60
    /// M2
    /// ```
    rule "compensation-gouge" in "compensation" {
        summary: "tool does not fit into the contour",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(CompensationGouge) },
    }
}

struct CompensationGouge;

impl PathRule for CompensationGouge {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Compensation(CompensationFault::Gouge) {
            return;
        }
        let name = cx.code_name(Role::Compensation).unwrap_or_default();
        let finding = cx
            .finding(&META, cx.range(), format!("the tool does not fit into the contour (`{name}`)"))
            .label("with this size of tool the path gouges the other side of the contour here")
            .help("use a smaller tool, or open the corner");
        // The control shapes the path: the finding is as certain as what is known of that.
        let confidence = cx.model.semantics().confidence;
        let is_refused = cx.model.semantics().compensation.freezes_modes;
        report.add(finding.at_most(if is_refused { limit(confidence) } else { Severity::Warning }));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_tool_of_unknown_size_may_fit() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X-30. Y0. Z5.\nG42 D1 G1 X0. F100.\nY50.\nG2 X5. Y50. I2.5\nG1 Y0.\nG40 X60.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_slot_narrower_than_the_tool() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G0 X-30. Y0. Z5.\nG10 L12 P1 R8.\nG41 D1 G1 X0. F100.\nX30.\nY4.\nX0.\nG40 X-30.\nM30\n",
            &expect![[r#"
                6 | X0.
                  | ^^^ warning[compensation-gouge] the tool does not fit into the contour (`G41`)
            "#]],
        );
    }
}
