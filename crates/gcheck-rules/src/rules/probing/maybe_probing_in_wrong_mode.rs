//! A probing code in a mode in which it does not work, on some paths.

use crate::declare::declare_rule;
use crate::facts::modes::{ModeInBlock, mode_in_block};
use crate::facts::probing::{ModeDemand, mode_demands, mode_finding};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// On some paths that come here, a probing or measuring code runs in a wrong mode: with cutter compensation on,
    /// with tool length compensation on while it measures a work offset (`G36`, `G136`), or off while it measures a
    /// tool length (`G37`).
    ///
    /// ## Why it matters
    /// On such a path the control stops with an alarm, or writes a value to its table that is wrong by the tool's
    /// length or radius.
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
        for ModeDemand { role, code, is_wrong, .. } in mode_demands(cx) {
            let ModeInBlock::Several(modes) = mode_in_block(cx, role) else { continue };
            let Some(wrong) = modes.iter().copied().find(|mode| is_wrong(*mode)) else { continue };
            let mode = cx.name_of(wrong);
            let mut finding =
                mode_finding(cx.finding(&META, cx.range(), String::new()), role, code, &mode, cx);
            finding.message = format!("on some paths: {}", finding.message);
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
                  |         ^^^ warning[maybe-probing-in-wrong-mode] on some paths: probing with cutter compensation on (`G41`)
            "#]],
        );
    }

    #[test]
    fn a_mode_that_nobody_knows_is_no_evidence() {
        check_rule(&RULE, "haas-mill", "G65 P9100\nG91 G36 Y-1. F10.\nG90\nM30\n", &expect![[""]]);
    }
}
