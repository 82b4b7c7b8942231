//! A centre of rotation along the axis that a rotation leaves alone.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A rotation of the coordinates names the axis across its plane. The centre lies in the plane, and the control ignores
    /// this word.
    ///
    /// A rotation about a direction of its own (`I`, `J`, `K`) has a centre in space and is not looked at.
    ///
    /// ## Why it matters
    /// The rotation may be meant in another plane: then the contour is turned about the wrong axis.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G17 G90 G54 G0 X0. Y0. Z1.
    /// G68 X0. Y0. Z3. R45.
    /// G1 X1. F10.
    /// G69
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G18 G90 G54 G0 X0. Y0. Z1.
    /// G68 X0. Z3. R45.
    /// G1 X1. F10.
    /// G69
    /// M30
    /// ```
    rule "rotation-centre-outside-plane" in "offsets" {
        summary: "centre of a rotation along the axis across its plane",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(RotationCentreOutsidePlane) },
    }
}

struct RotationCentreOutsidePlane;

/// The words of a direction in space.
const DIRECTION: LetterSet = LetterSet::of("IJK");

impl PathRule for RotationCentreOutsidePlane {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::RotationOn)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(|effect| effect == Effect::RotationOn) {
            return;
        }
        let Some(plane) = cx.code_of_role(Role::Plane).or_else(|| cx.state().mode(Role::Plane).only()) else {
            return;
        };
        let across = match cx.model.effect(plane) {
            Effect::PlaneXy => 'Z',
            Effect::PlaneZx => 'Y',
            Effect::PlaneYz => 'X',
            _ => return,
        };
        if !cx.has_word(|word| word.letter == Letter::of(across)) || cx.origin().letters.intersects(DIRECTION)
        {
            return;
        }
        let plane = cx.name_of(plane);
        let finding = cx
            .finding(
                &META,
                cx.letter_range(across),
                format!("`{across}` does not move the centre of this rotation (`{plane}`)"),
            )
            .label("the axis that the rotation leaves alone")
            .note(format!("the centre lies in the plane of `{plane}`, and the control ignores this word"))
            .help(format!("remove `{across}`, or choose the plane of the rotation before it"));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Plane), &format!("`{plane}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_direction_in_space_has_a_centre_in_space() {
        let program = "G17 G90 G54\nG68 X0. Y0. Z3. I0. J1. K0. R30.\nG69\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![[""]]);
    }

    #[test]
    fn the_plane_in_effect_decides() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G17 G90 G54\nG68 X0. Y0. Z3. R30.\nG69\nG19 G68 Y0. Z3. R30.\nG69\nG68 X0. Y0. R30.\nG69\nM30\n",
            &expect![[r#"
                2 | G68 X0. Y0. Z3. R30.
                  |             ^^^ info[rotation-centre-outside-plane] `Z` does not move the centre of this rotation (`G17`)
                6 | G68 X0. Y0. R30.
                  |     ^^^ info[rotation-centre-outside-plane] `X` does not move the centre of this rotation (`G19`)
            "#]],
        );
    }
}
