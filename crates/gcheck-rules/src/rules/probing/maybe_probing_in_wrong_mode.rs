//! A probing code in a mode that it does not work in, on some path.

use super::probing_in_wrong_mode::{Demand, demands, worded};
use crate::meta::declare_rule;
use crate::probing::ModeInBlock;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A probing or measuring code runs, on some path that comes here, in a mode that it must not run in: cutter compensation
    /// on, tool length compensation on where a work offset is measured (`G36`, `G136`), or off where a tool length is
    /// (`G37`).
    ///
    /// ## Why it matters
    /// On that path the control stops with an alarm, or writes a table with the tool's length or radius in it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// IF [#100 EQ 1] GOTO10
    /// G43 H1 Z1.
    /// N10 G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// IF [#100 EQ 1] GOTO10
    /// G43 H1 Z1.
    /// N10 G49
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    rule "maybe-probing-in-wrong-mode" in "probing" {
        summary: "probing code that may run in a wrong mode",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeProbingInWrongMode) },
    }
}

struct MaybeProbingInWrongMode;

impl PathRule for MaybeProbingInWrongMode {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        for Demand { role, code, is_wrong, .. } in demands(cx) {
            let ModeInBlock::Several(modes) = cx.mode_in_block(role) else { continue };
            let Some(wrong) = modes.iter().copied().find(|mode| is_wrong(*mode)) else { continue };
            let mode = cx.name_of(wrong);
            let mut finding = worded(cx.finding(&META, cx.range(), String::new()), role, code, &mode, cx);
            finding.message = format!("on some path: {}", finding.message);
            report.add(cx.with_path(finding));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn compensation_that_a_condition_leaves_on() {
        check_rule(
            &RULE,
            "haas-mill",
            "G41 D1 G1 X1. F10.\nIF [#100 EQ 1] GOTO10\nG40 X2.\nN10 G91 G31 Y-1. F10.\nG40 X1.\nG90\nM30\n",
            &expect![[r#"
                4 | N10 G91 G31 Y-1. F10.
                  |         ^^^ warning[maybe-probing-in-wrong-mode] on some path: probing with cutter compensation on (`G41`)
            "#]],
        );
    }

    #[test]
    fn a_mode_that_nobody_knows_is_no_evidence() {
        check_rule(&RULE, "haas-mill", "G65 P9100\nG91 G36 Y-1. F10.\nG90\nM30\n", &expect![[""]]);
    }
}
