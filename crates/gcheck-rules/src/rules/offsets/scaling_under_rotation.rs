//! Scaling that begins while the coordinates are rotated.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// Scaling begins while the coordinates are rotated.
    ///
    /// ## Why it matters
    /// Scaling comes before rotation: its centre is a point of the drawing that is not rotated yet. In the other order
    /// the contour is cut in another place, or the control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G17 G90 G54 G0 X0. Y0.
    /// G68 X0. Y0. R90.
    /// G51 X0. Y0. P2.
    /// X1. Y0.
    /// G50
    /// G69
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G17 G90 G54 G0 X0. Y0.
    /// G51 X0. Y0. P2.
    /// G68 X0. Y0. R90.
    /// X1. Y0.
    /// G69
    /// G50
    /// M30
    /// ```
    rule "scaling-under-rotation" in "offsets" {
        summary: "scaling that begins under a rotation",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ScalingUnderRotation) },
    }
}

struct ScalingUnderRotation;

impl PathRule for ScalingUnderRotation {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::RotationOn)
            && program.may(|effect| effect == Effect::ScalingOn)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(scaling) = cx.code_of_role(Role::Scaling) else { return };
        if cx.model.effect(scaling) != Effect::ScalingOn
            || cx.has_effect(|effect| effect == Effect::RotationOff)
        {
            return;
        }
        let is_on = |effect| effect == Effect::RotationOn;
        let Some(ActiveMode::Certain(rotation)) = left_on(cx, Role::Rotation, is_on) else { return };
        let (name, rotation) = (cx.name_of(scaling), cx.name_of(rotation));
        let finding = cx
            .finding(
                &META,
                cx.word_range(|word| word.code == scaling),
                format!("scaling begins while the coordinates are rotated (`{name}` under `{rotation}`)"),
            )
            .label("comes after the rotation")
            .help("scale first, then rotate; end the rotation before the scaling");
        report.add(cx.resting_on(finding, Fact::Mode(Role::Rotation), &format!("`{rotation}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_rotation_that_ended_is_over() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G90 G54\nG68 X0. Y0. R30.\nG69\nG51 X0. Y0. P2000\nG50\nM30\n",
            &expect![[""]],
        );
    }
}
