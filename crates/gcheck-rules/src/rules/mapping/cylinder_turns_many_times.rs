//! A cut that turns a cylinder several times in one place.

use std::f64::consts::PI;

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, TravelKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// Under cylindrical mapping one block cuts around the cylinder more than one and a half times, without a move along it. Whole
    /// turns, which clean a groove, and ways back to where the mapped axis began are not judged.
    ///
    /// ## Why it matters
    /// The mapped axis takes the length along the surface. Degrees that are written there are read as millimetres or inches, and the
    /// part turns many times instead of a part of a turn.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0.5 Y0. A0.
    /// S4500 M3
    /// G43 H1 Z1.
    /// G107 A0. Y0. R1.
    /// G0 X0.5 Y0.
    /// G1 Z-0.05 F10.
    /// Y180. F15.
    /// G0 Z1.
    /// G107
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0.5 Y0. A0.
    /// S4500 M3
    /// G43 H1 Z1.
    /// G107 A0. Y0. R1.
    /// G0 X0.5 Y0.
    /// G1 Z-0.05 F10.
    /// Y3.1416 F15.
    /// G0 Z1.
    /// G107
    /// M30
    /// ```
    rule "cylinder-turns-many-times" in "mapping" {
        summary: "cut that goes around the cylinder several times in one place",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES),
            make: || Box::new(CylinderTurnsManyTimes::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CylinderTurnsManyTimes {
    /// The axis that is wrapped, and the circumference: millimetres.
    cylinder: Option<(Axis, f64)>,
}

remembers!(CylinderTurnsManyTimes);

/// Turns: after one the cut is where it began, and a little more closes a groove.
const MOST: f64 = 1.5;
/// Turns that are off by so much are whole, with a length that is rounded.
const WHOLE: f64 = 0.01;
/// No groove is cleaned by as many turns in one block.
const CLEANING: f64 = 8.5;
/// Linear axes that move less do not move: millimetres.
const SLACK: f64 = 0.01;

impl PathRule for CylinderTurnsManyTimes {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::CylinderMapping)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Cylinder(cylinder) = event {
            let known = cylinder.filter(|cylinder| cylinder.diameter.is_finite() && cylinder.diameter > 0.0);
            self.cylinder = known.map(|cylinder| (cylinder.linear, cylinder.diameter * PI));
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let Some((wrapped, around)) = self.cylinder else { return };
        if travel.kind != TravelKind::Feed || !cx.is_on_every_path() {
            return;
        }
        let way = |axis: Axis| (travel.to.raw(axis) - travel.from.raw(axis)).abs();
        let turns = way(wrapped) / around;
        let goes_along =
            Axis::ALL.into_iter().any(|axis| axis != wrapped && !axis.is_rotary() && way(axis) > SLACK);
        // Whole turns clean the bottom of a groove, and a way back unwinds what was cut before.
        let is_whole = (turns - turns.round()).abs() <= WHOLE && turns < CLEANING;
        let unwinds = travel.to.raw(wrapped).abs() < travel.from.raw(wrapped).abs();
        if turns.is_nan() || turns <= MOST || goes_along || is_whole || unwinds {
            return;
        }
        report.add(
            cx.finding(&META, cx.range(), format!("the cut goes around the cylinder {turns:.1} times"))
                .label(format!("{:.0}° in one block, in one place", turns * 360.0))
                .note("the mapped axis takes the length along the surface, not degrees")
                .help("write the length along the surface, or check the size of the cylinder"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn groove(cut: &str) -> String {
        format!(
            "G20 G90 G54 G0 X0.5 Y0. A0.\nS4500 M3\nG43 H1 Z1.\nG107 A0. Y0. R1.\nG0 X0.5 Y0.\nG1 Z-0.05 F10.\n{cut} F15.\nG0 Z1.\nG107\nM30\n"
        )
    }

    #[test]
    fn a_spiral_goes_along() {
        check_rule(
            &RULE,
            "haas-mill",
            &groove("Y180."),
            &expect![[r#"
            7 | Y180. F15.
              | ^^^^^^^^^^ warning[cylinder-turns-many-times] the cut goes around the cylinder 28.6 times
        "#]],
        );
        check_rule(&RULE, "haas-mill", &groove("X2. Y180."), &expect![[""]]);
        check_rule(&RULE, "haas-mill", &groove("Y6.2832"), &expect![[""]]);
    }

    #[test]
    fn grooves_are_cleaned_and_spirals_unwound() {
        let program = |blocks: &str| {
            format!(
                "G20 G90 G54 G0 X0.5 Y0. A0.\nS4500 M3\nG43 H1 Z1.\nG107 A0. Y0. R1.\nG0 X0.5 Y0.\nG1 Z-0.05 F10.\n{blocks}G0 Z1.\nG107\nM30\n"
            )
        };
        check_rule(&RULE, "haas-mill", &program("Y12.5664 F15.\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program("Y6.2832 Z-.1 F15.\nY12.5664 Z-.15\nY18.5 Z-.2\nY0.\n"),
            &expect![[""]],
        );
    }
}
