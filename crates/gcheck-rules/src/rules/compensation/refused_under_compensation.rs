//! An operation that the control refuses while cutter compensation is on.

use gcheck_engine::{CompensationFault, Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};

declare_rule! {
    /// A block asks for something that the control refuses while cutter compensation is on, or switches compensation on
    /// twice, or in a plane in which it does not work.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, with the tool at the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 F100
    /// G41.1 D6 G1 X10
    /// G1 Y10
    /// G28
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// G21 G90 G17 F100
    /// G41.1 D6 G1 X10
    /// G41.1 D6 Y10
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G17 F100
    /// G41.1 D6 G1 X10
    /// G1 Y10
    /// G40 X20
    /// G28
    /// M2
    /// ```
    rule "refused-under-compensation" in "compensation" {
        summary: "refused while cutter compensation is on",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(RefusedUnderCompensation) },
    }
}

struct RefusedUnderCompensation;

impl PathRule for RefusedUnderCompensation {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Compensation(fault) = fault else { return };
        let semantics = cx.model.semantics();
        let is_of_plane = semantics.compensation.freezes_plane && cx.code_of_role(Role::Plane).is_some();
        let (message, label, help) = match fault {
            CompensationFault::NotWhileOn if is_of_plane => (
                "the plane changes while cutter compensation is on",
                "the contour is offset in the plane that was active before",
                "switch compensation off (`G40`) with a move away from the part before the plane changes",
            ),
            CompensationFault::NotWhileOn => (
                "the control refuses this while cutter compensation is on",
                "refused with compensation on",
                "switch compensation off (`G40`) with a move away from the part before this block",
            ),
            CompensationFault::AlreadyOn => (
                "cutter compensation is on already",
                "switched on a second time",
                "switch compensation off (`G40`) before it is switched on again",
            ),
            CompensationFault::Plane => (
                "cutter compensation does not work in this plane",
                "switched on in a plane in which it does not work",
                "select `G17` (`G18` on a lathe) before compensation is switched on",
            ),
            // Other rules report these.
            CompensationFault::EntryTooShort { .. }
            | CompensationFault::EntryIsArc
            | CompensationFault::ExitIsArc
            | CompensationFault::Gouge => return,
        };
        let finding = cx.finding(&META, cx.range(), message).label(label).help(help);
        let code =
            cx.code_name(Role::Compensation).map_or_else(|| "compensation".to_owned(), |c| format!("`{c}`"));
        let finding = if is_of_plane { finding.at_most(limit(semantics.confidence)) } else { finding };
        report.add(match fault {
            CompensationFault::Plane => finding,
            _ => cx.resting_on(finding, Fact::Mode(Role::Compensation), &code),
        });
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
            "G21 G90 F100\nG41.1 D6 G1 X10\nG1 Y10\nG28\nM2\n",
            &expect![[r#"
            4 | G28
              | ^^^ error[refused-under-compensation] the control refuses this while cutter compensation is on
        "#]],
        );
    }

    #[test]
    fn the_plane_stays_as_it_is() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G17\nG41 D6 G1 X10. F100.\nG17 Y10.\nG18 Y20.\nG40 X20.\nG18\nM30\n",
            &expect![[r#"
                4 | G18 Y20.
                  | ^^^^^^^^ warning[refused-under-compensation] the plane changes while cutter compensation is on
            "#]],
        );
    }

    #[test]
    fn other_planes() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G19 F100\nG41.1 D6 G1 Y10\nM2\n",
            &expect![[r#"
            2 | G41.1 D6 G1 Y10
              | ^^^^^^^^^^^^^^^ error[refused-under-compensation] cutter compensation does not work in this plane
        "#]],
        );
    }
}
