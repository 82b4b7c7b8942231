//! A rotation that begins or ends under cutter compensation.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::is_on;
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A rotation of the coordinates begins or ends while cutter compensation is on.
    ///
    /// ## Why it matters
    /// The path beside the contour belongs to the old directions: the tool goes over to the new ones on a way that no
    /// manual gives, and may cut into the part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G17 G90 G54 G0 X0. Y0.
    /// G41 D1 G1 X1. F10.
    /// G68 X0. Y0. R90.
    /// Y1.
    /// G69
    /// G40 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G17 G90 G54 G0 X0. Y0.
    /// G68 X0. Y0. R90.
    /// G41 D1 G1 X1. F10.
    /// Y1.
    /// G40 X2.
    /// G69
    /// M30
    /// ```
    /// A Fanuc mill turns a path that is offset, unless it is scaled too.
    /// ```nc,quiet,fanuc-mill
    /// G17 G90 G54 G0 X0. Y0.
    /// G41 D1 G1 X10. F100.
    /// G68 X0. Y0. R90.
    /// Y10.
    /// G69
    /// G40 X20.
    /// M30
    /// ```
    rule "rotation-under-compensation" in "offsets" {
        summary: "rotation that begins or ends under cutter compensation",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(RotationUnderCompensation) },
    }
}

struct RotationUnderCompensation;

impl PathRule for RotationUnderCompensation {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::RotationOn) && program.may(is_on)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(code) = cx.code_of_role(Role::Rotation) else { return };
        let begins = cx.model.effect(code) == Effect::RotationOn;
        // What ends nothing changes nothing.
        if !begins && cx.state().effect(Role::Rotation, cx.model) != Some(Effect::RotationOn) {
            return;
        }
        if cx.has_effect(|effect| effect == Effect::CompensationOff) {
            return;
        }
        let is_scaled = cx.state().effect(Role::Scaling, cx.model) == Some(Effect::ScalingOn);
        if cx.control().semantics().compensation.rotates_within && !is_scaled {
            return;
        }
        let Some(ActiveMode::Certain(compensation)) = left_on(cx, Role::Compensation, is_on) else { return };
        let (name, compensation) = (cx.name_of(code), cx.name_of(compensation));
        let verb = if begins { "begins" } else { "ends" };
        let finding = cx
            .finding(
                &META,
                cx.word_range(|word| word.code == code),
                format!("a rotation {verb} under cutter compensation (`{name}` under `{compensation}`)"),
            )
            .label("turns the directions of a path that is offset")
            .help("switch compensation on after the rotation begins, and off before it ends");
        report.add(cx.resting_on(finding, Fact::Mode(Role::Compensation), &format!("`{compensation}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn both_ends_are_judged() {
        check_rule(
            &RULE,
            "haas-mill",
            "G17 G90 G54\nG68 X0. Y0. R30.\nG41 D1 G1 X10. F100.\nG69\nG40 X0.\nG69\nM30\n",
            &expect![[r#"
                4 | G69
                  | ^^^ warning[rotation-under-compensation] a rotation ends under cutter compensation (`G69` under `G41`)
            "#]],
        );
    }

    #[test]
    fn a_control_may_turn_the_path_unless_it_is_scaled() {
        let program = "G17 G90 G54\nG41 D1 G1 X10. F100.\nG68 X0. Y0. R30.\nY10.\nG69\nG40 X0.\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
        let scaled = format!("G51 X0. Y0. P2000\n{program}");
        check_rule(
            &RULE,
            "fanuc-mill",
            &scaled,
            &expect![[r#"
            4 | G68 X0. Y0. R30.
              | ^^^ warning[rotation-under-compensation] a rotation begins under cutter compensation (`G68` under `G41`)
            6 | G69
              | ^^^ warning[rotation-under-compensation] a rotation ends under cutter compensation (`G69` under `G41`)
        "#]],
        );
    }
}
