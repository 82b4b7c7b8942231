//! A cut on a cylinder that goes down to its axis.

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// While a drawing is wrapped around a cylinder (`G107`), a cut goes as far below the zero of the part as the radius of
    /// the cylinder, or farther.
    ///
    /// ## Why it matters
    /// With the zero on the surface, that is the axis of the cylinder: the tool is fed through the whole part. Mostly a point or
    /// a zero of the depth is missing.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G94 G54 S5000 M3
    /// G0 X0.5 Y0. Z0.1 A0.
    /// G107 A0. Y0. R1.
    /// G1 Z-1. F10.
    /// Y3. F20.
    /// G0 Z1.
    /// G107
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G94 G54 S5000 M3
    /// G0 X0.5 Y0. Z0.1 A0.
    /// G107 A0. Y0. R1.
    /// G1 Z-0.1 F10.
    /// Y3. F20.
    /// G0 Z1.
    /// G107
    /// M30
    /// ```
    rule "cylinder-cut-to-axis" in "mapping" {
        summary: "cut on a cylinder goes down to its axis",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(CylinderCutToAxis::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct CylinderCutToAxis {
    /// The block that began the mapping, and the radius of the cylinder: millimetres.
    cylinder: Option<(At, f64)>,
}

remembers!(CylinderCutToAxis: cylinder);

/// Lengths that differ by less are one: millimetres.
const SLACK: f64 = 0.001;

impl PathRule for CylinderCutToAxis {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::CylinderMapping)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if let Event::Cylinder(cylinder) = event {
            let known = cylinder.filter(|cylinder| cylinder.diameter.is_finite());
            self.cylinder = known.map(|cylinder| (cx.origin().at, cylinder.diameter / 2.0));
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some((begun, radius)) = self.cylinder else { return };
        let Event::Travel(travel) = event else { return };
        let (from, to) = (travel.from.raw(Axis::Z), travel.to.raw(Axis::Z));
        // False where a height or the radius is not known.
        let is_at_axis = radius > SLACK && to < from - SLACK && to <= SLACK - radius;
        if !is_at_axis || travel.kind == TravelKind::Rapid || !cx.is_on_every_path() || cx.is_called_only() {
            return;
        }
        self.cylinder = None;
        let mut finding =
            cx.finding(&META, cx.range(), "the cut goes down to the axis of the cylinder").label(format!(
                "{} below the zero of the part, and the radius is {}",
                cx.shown(Mm(-to)),
                cx.shown(Mm(radius))
            ));
        if let Some(range) = cx.range_of(begun) {
            finding = finding.also(range, "the cylinder is given here");
        }
        report.add(
            finding
                .assuming("the zero of the part is on the surface of the cylinder")
                .help("check the point and the digits of the depth"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn once_for_each_cylinder() {
        let program = |depth: &str| {
            format!(
                "G21 G90 G94 G54 S500 M3\nG0 X5. Y0. Z2. A0.\nG107 A0. Y0. R20.\nG1 Z{depth} F100.\nY30.\nG0 Z2.\nG1 Z-25.\nG107\nG0 Z50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "haas-mill",
            &program("-20."),
            &expect![[r#"
                4 | G1 Z-20. F100.
                  | ^^^^^^^^^^^^^^ warning[cylinder-cut-to-axis] the cut goes down to the axis of the cylinder
            "#]],
        );
        check_rule(&RULE, "haas-mill", &program("-2.").replace("G1 Z-25.\n", ""), &expect![[""]]);
    }
}
