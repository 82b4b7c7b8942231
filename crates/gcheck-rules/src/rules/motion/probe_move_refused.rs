//! A probing move that the control refuses.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A probing move begins under cutter compensation, or its target is the probe's present position.
    ///
    /// ## Why it matters
    /// The control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G38.2 Z10 F50
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G38.2 Z-10 F50
    /// M2
    /// ```
    rule "probe-move-refused" in "motion" {
        summary: "probing move that the control refuses",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ProbeMoveRefused) },
    }
}

struct ProbeMoveRefused;

impl PathRule for ProbeMoveRefused {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Probe {
            return;
        }
        let on = |effect| !matches!(effect, Effect::CompensationOff | Effect::None);
        if cx.state().effect(Role::Compensation, cx.model).is_some_and(on) {
            let code = cx.code_name(Role::Compensation).unwrap_or_default();
            let finding = cx
                .finding(
                    &META,
                    cx.range(),
                    format!("probing move while cutter compensation is on (`{code}`)"),
                )
                .label("the path of a probe cannot be offset")
                .help("switch compensation off (`G40`) before probing");
            report.add(cx.resting_on(finding, Fact::Mode(Role::Compensation), &format!("`{code}`")));
            return;
        }
        report.add(
            cx.finding(&META, cx.range(), "probing move that goes nowhere")
                .label("the target is the probe's present position")
                .help("give a target beyond the surface to be touched"),
        );
    }
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
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG91 G38.3 Z0 F50\nG90 G38.2 Z0\nM2\n",
            &expect![[r#"
                2 | G91 G38.3 Z0 F50
                  | ^^^^^^^^^^^^^^^^ error[probe-move-refused] probing move that goes nowhere
            "#]],
        );
    }

    #[test]
    fn compensation_is_named() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0 Z10\nG41.1 D0\nG38.2 Z0 F50\nG40\nM2\n",
            &expect![[r#"
                3 | G38.2 Z0 F50
                  | ^^^^^^^^^^^^ error[probe-move-refused] probing move while cutter compensation is on (`G41.1`)
            "#]],
        );
    }
}
