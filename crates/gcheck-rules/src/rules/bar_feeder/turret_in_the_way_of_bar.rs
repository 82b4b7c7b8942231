//! A tool in the way of the bar that is fed.

use gcheck_engine::{Axis, Event};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{bar_feed_range, bar_feeder, is_bar_feed, lengths};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The bar is fed (`G105`) while the tool is still in its way: behind the face and near the centre, as after a
    /// parting cut without a retract.
    ///
    /// ## Why it matters
    /// The bar is pushed into the tool.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20
    /// T404
    /// G97 S900 M3
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20
    /// T404
    /// G97 S900 M3
    /// G0 X2.1 Z-1.625
    /// G1 X-0.04 F0.004
    /// G0 X6.
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    rule "turret-in-the-way-of-bar" in "bar_feeder" {
        summary: "tool in the way of the bar that is fed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES),
            make: || Box::new(TurretInTheWayOfBar { radius: 0.0 }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct TurretInTheWayOfBar {
    /// The farthest from the centre that a cut of this part began or ended, millimetres.
    radius: f64,
}

remembers!(TurretInTheWayOfBar);

impl PathRule for TurretInTheWayOfBar {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_bar_feed)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if bar_feeder(cx).is_none() {
            return;
        }
        if let Event::Travel(travel) = event
            && travel.kind != gcheck_engine::TravelKind::Rapid
        {
            for x in [travel.from.raw(Axis::X), travel.to.raw(Axis::X)] {
                // An unknown place is not farther.
                self.radius = self.radius.max(x.abs());
            }
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if lengths(event).is_none() {
            return;
        }
        let radius = std::mem::take(&mut self.radius);
        let (x, z) = (cx.state().actual().raw(Axis::X), cx.state().actual().raw(Axis::Z));
        // Cuts begin in the air, so that only what is far inside is certainly in the bar.
        if !(z < -1e-3 && x.abs() <= radius / 2.0 && radius > 0.0) {
            return;
        }
        let diameter = if cx.state().is_diameter(cx.model) == Some(false) { x } else { 2.0 * x };
        report.add(
            cx.finding(&META, bar_feed_range(cx), "tool is in the way of the bar")
                .label(format!("the tool is at `X` {}, `Z` {}", cx.shown(Mm(diameter)), cx.shown(Mm(z))))
                .assuming("`Z0` is at the face of the part")
                .help("move the tool clear of the bar before it is fed: first in X, then in Z"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_cutoff_program_that_does_not_go_back() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG20\nG105 J2. P2\nM99\nO2\nG0 X2.1 Z-1.625\nG1 X-0.04 F0.004\nM99\n",
            &expect![[r#"
                3 | G105 J2. P2
                  | ^^^^ warning[turret-in-the-way-of-bar] tool is in the way of the bar
            "#]],
        );
    }

    #[test]
    fn a_stop_in_front_of_the_bar_is_no_obstacle() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z-1.625\nG1 X-0.04 F0.004\nG0 X3.\nT909\nG0 X0. Z0.05\nM5\nG105 J2.\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_place_that_is_not_known() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z-1.625\nG1 X-0.04 F0.004\nG28 U0. W0.\nM5\nG105 J2.\nM99\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            "G20\nG0 X2.1 Z-1.625\nG1 X0. F0.004\nX#500\nM5\nG105 J2.\nM99\n",
            &expect![[""]],
        );
    }
}
