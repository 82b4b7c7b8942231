//! A canned cycle while cutter compensation is on.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{At, CycleFault, Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::{cycle_range, is_cycle};
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A canned cycle is called while cutter compensation (`G41`, `G42`) is on.
    ///
    /// ## Why it matters
    /// The hole would be off its position by the radius of the cutter. Controls stop with an alarm, or drill at the
    /// position and lose the offset path. A `G40` is missing before the cycle.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0 Z10
    /// G41.1 D4
    /// G1 X10 F100
    /// X20
    /// G81 X30 Y0 Z-5 R2
    /// G40
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G20 G17 G90 G54 G0 X0 Y0 Z1.
    /// G41 D1 G1 X1. F10.
    /// X2.
    /// G81 X3. Z-.5 R.1
    /// G80
    /// G40
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G17 G90 G54 G0 X0 Y0 Z1.
    /// G41 D1 G1 X1. F10.
    /// X2.
    /// G40 X3.
    /// G81 X3. Z-.5 R.1
    /// G80
    /// M30
    /// ```
    rule "cycle-under-compensation" in "cycles" {
        summary: "canned cycle while cutter compensation is on",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::BLOCKS),
            make: || Box::new(CycleUnderCompensation::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CycleUnderCompensation {
    /// Blocks that switched compensation on: one finding for each.
    told: BTreeSet<Option<At>>,
}

remembers!(CycleUnderCompensation: told);

impl PathRule for CycleUnderCompensation {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault == Fault::Cycle(CycleFault::Compensated) {
            self.tell(cx, Severity::Error, report);
        }
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // Controls that refuse it alarm when the cycle runs.
        if cx.model.semantics().compensation.freezes_modes || !cx.has_effect(is_cycle) {
            return;
        }
        let changes = cx.has_effect(|effect| Role::of(effect) == Some(Role::Compensation));
        let on = Effect::offsets_path;
        if !changes && cx.state().effect(Role::Compensation, cx.model).is_some_and(on) {
            self.tell(cx, Severity::Warning, report);
        }
    }
}

impl CycleUnderCompensation {
    fn tell(&mut self, cx: &PathCx<'_>, severity: Severity, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::Compensation);
        if !self.told.insert(cx.definitions().set_by(fact)) {
            return;
        }
        let name = cx.code_name(Role::Compensation).unwrap_or_default();
        let finding: Finding = cx
            .finding(
                &META,
                cycle_range(cx),
                format!("canned cycle while cutter compensation is on (`{name}`)"),
            )
            .label("the position of a hole cannot be offset")
            .help("switch compensation off (`G40`) before the cycle")
            .at_most(severity);
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_cycle_is_marked_once() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G17 G90 G54 G0 X0 Y0 Z10.\nG41 D1 G1 X10. F100.\nX20.\nG81 X30. Z-5. R2.\nG81 X40.\nG80 G40\nM30\n",
            &expect![[r#"
                4 | G81 X30. Z-5. R2.
                  | ^^^ warning[cycle-under-compensation] canned cycle while cutter compensation is on (`G41`)
            "#]],
        );
    }

    #[test]
    fn a_control_that_refuses_it_stops() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G21 G90 G0 X0 Y0 Z10\nG42.1 D4\nG1 X10 F100\nX20\nG81 X30 Y0 Z-5 R2\nG40\nM2\n",
            &expect![[r#"
                5 | G81 X30 Y0 Z-5 R2
                  | ^^^ error[cycle-under-compensation] canned cycle while cutter compensation is on (`G42.1`)
            "#]],
        );
    }
}
