//! Another plane while a rotation is on.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A plane is chosen while a rotation of the coordinates is on.
    ///
    /// ## Why it matters
    /// The rotation is about an axis of the plane in which it began. Some controls refuse another plane, others go on
    /// rotating in the old one, and the contour is cut in another place.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G17 G90 G54 G0 X0. Y0.
    /// G68 X0. Y0. R30.
    /// G18
    /// G1 X1. Z-1. F10.
    /// G69
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G18 G90 G54 G0 X0. Y0.
    /// G17
    /// G68 X0. Y0. R30.
    /// G17 G1 X1. F10.
    /// G69
    /// M30
    /// ```
    rule "plane-changed-under-rotation" in "offsets" {
        summary: "another plane while a rotation is on",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PlaneChangedUnderRotation) },
    }
}

struct PlaneChangedUnderRotation;

impl PathRule for PlaneChangedUnderRotation {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::RotationOn)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(new) = cx.code_of_role(Role::Plane) else { return };
        let Some(old) = cx.state().mode(Role::Plane).only() else { return };
        let is_on = |effect| effect == Effect::RotationOn;
        let Some(ActiveMode::Certain(rotation)) = left_on(cx, Role::Rotation, is_on) else { return };
        if cx.model.effect(new) == cx.model.effect(old) {
            return;
        }
        let (plane, rotation) = (cx.name_of(new), cx.name_of(rotation));
        let off = cx.name_of_effect(Effect::RotationOff).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.word_range(|word| word.code == new),
                format!("another plane while the coordinates are rotated (`{plane}` under `{rotation}`)"),
            )
            .label("the rotation was begun in another plane")
            .help(format!("end the rotation with `{off}` before this, and begin it again in the new plane"));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Rotation), &format!("`{rotation}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_plane_in_effect_may_be_stated_again() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G90 G54\nG68 X0. Y0. R30.\nG17\nG19\nG69\nG18\nM30\n",
            &expect![[r#"
                4 | G19
                  | ^^^ warning[plane-changed-under-rotation] another plane while the coordinates are rotated (`G19` under `G68`)
            "#]],
        );
    }
}
