//! A tilted working plane, dynamic offset or tool centre point control that is not switched off.

use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::boundary::{Boundary, boundary, boundary_range, ends_at_tape_mark};
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A tilted working plane (`G68.2`, `G268`), a dynamic work offset (`G254`) or tool centre point control (`G43.4`,
    /// `G234`) is still on when the tool is changed or the program ends.
    ///
    /// ## Why it matters
    /// Coordinates no longer follow the machine's axes: the move to the tool change is tilted, and a rotary axis that
    /// moves takes the linear axes with it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G254
    /// G1 X1. F10.
    /// T2 M6
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G254
    /// G1 X1. F10.
    /// G255
    /// T2 M6
    /// M30
    /// ```
    rule "tool-tilt-left-on" in "offsets" {
        summary: "tilted plane, dynamic offset or tool centre point control left on",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS.union(Watch::ENDS), make: || Box::new(ToolTiltLeftOn { told: [None; 3] }) },
    }
}

#[derive(Clone, PartialEq)]
struct ToolTiltLeftOn {
    /// By frame: the block that switched on what was reported last.
    told: [Option<At>; 3],
}

remembers!(ToolTiltLeftOn: told);

impl PathRule for ToolTiltLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if let Some(place) = boundary(cx) {
            self.judge(cx, place, report);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.judge(cx, Boundary::ProgramEnd, report);
        }
    }
}

/// The mode, what switches it on, what switches it off, its name.
const FRAMES: [(Role, Effect, Effect, &str); 3] = [
    (Role::TiltedPlane, Effect::TiltedPlaneOn, Effect::TiltedPlaneOff, "the tilted plane"),
    (Role::DynamicOffset, Effect::DynamicOffsetOn, Effect::DynamicOffsetOff, "the dynamic work offset"),
    (Role::Length, Effect::ToolCentrePoint, Effect::LengthOff, "tool centre point control"),
];

impl ToolTiltLeftOn {
    fn judge(&mut self, cx: &PathCx<'_>, place: Boundary, report: &mut Report<'_>) {
        for ((role, on, off, what), told) in FRAMES.into_iter().zip(&mut self.told) {
            if place == Boundary::ProgramEnd && cx.end_resets(role) {
                continue;
            }
            let Some(ActiveMode::Certain(code)) = left_on(cx, role, |effect| effect == on) else { continue };
            let set_by = cx.definitions().set_by(Fact::Mode(role));
            if set_by.is_none() || set_by == *told {
                continue;
            }
            *told = set_by;
            let name = cx.name_of(code);
            let message = format!("{what} is still on {} (`{name}`)", place.words());
            // Some controls end it with the code that ends a rotation.
            let cancel =
                cx.name_of_effect(off).or_else(|| cx.name_of_effect(Effect::RotationOff)).unwrap_or_default();
            let finding = cx
                .finding(&META, boundary_range(cx, place), message)
                .label("coordinates do not follow the machine's axes here")
                .help(format!("switch it off with `{cancel}` before the tool moves away"))
                .fix_if(cx.block_before(Some(&cancel)));
            report.add(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_frame_is_named() {
        check_rule(
            &RULE,
            "haas-mill",
            "G234 H1 X0. Y0. Z1.\nG1 X1. F10.\nT2 M6\nG254\nG1 X1.\nT3 M6\nM30\n",
            &expect![[r#"
                3 | T2 M6
                  |    ^^ warning[tool-tilt-left-on] tool centre point control is still on at the tool change (`G234`)
                6 | T3 M6
                  |    ^^ warning[tool-tilt-left-on] the dynamic work offset is still on at the tool change (`G254`)
            "#]],
        );
    }

    #[test]
    fn the_end_of_a_rotation_ends_a_tilted_plane_of_its_group() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G68.2 X0 Y0 Z0 I30. J0 K0\nG1 X1. F10.\nG69\nT2 M6\nG68.2 X0 Y0 Z0 I30. J0 K0\nT3 M6\nM30\n",
            &expect![[r#"
                6 | T3 M6
                  |    ^^ warning[tool-tilt-left-on] the tilted plane is still on at the tool change (`G68.2`)
            "#]],
        );
    }

    #[test]
    fn an_end_that_resets_it_is_silent() {
        check_rule(&RULE, "haas-mill", "G254\nG1 X1. F10.\nM30\n", &expect![[""]]);
    }
}
