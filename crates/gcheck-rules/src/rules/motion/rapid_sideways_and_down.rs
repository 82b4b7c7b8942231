//! A rapid move that goes sideways and down at once.

use gcheck_controls::LetterSet;
use gcheck_engine::{Axis, Event, TravelKind};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A rapid move goes sideways and down in one block. Reported once per program.
    ///
    /// ## Why it matters
    /// At rapid each axis runs at its own speed: the tool does not move in a straight line, and Z often arrives before
    /// X and Y. Clamps may be in that way. Careful programs move sideways above the part, and then down.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. Z5.
    /// X10. Y10. Z0.1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. Z5.
    /// X10. Y10.
    /// Z0.1
    /// X0. Z5.
    /// M30
    /// ```
    rule "rapid-sideways-and-down" in "motion" {
        summary: "rapid move sideways and down in one block",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict],
        since: "0.1.0",
        run: Run::Path { watch: Watch::RAPIDS, make: || Box::new(RapidSidewaysAndDown) },
    }
}

struct RapidSidewaysAndDown;

/// Millimetres: less is not a move.
const WAY: f64 = 0.01;

impl PathRule for RapidSidewaysAndDown {
    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if travel.expanded {
            cx.rest();
            return;
        }
        let letters = cx.origin().letters;
        let is_named = letters.intersects(LetterSet::of("XY")) && letters.intersects(LetterSet::of("Z"));
        if !is_named || !cx.is_mill() || travel.kind != TravelKind::Rapid {
            return;
        }
        let way = |axis: Axis| travel.to.raw(axis) - travel.from.raw(axis);
        // An unknown distance is NaN, and not a move.
        if way(Axis::X).hypot(way(Axis::Y)) > WAY && way(Axis::Z) < -WAY {
            report.add(
                cx.finding(&META, cx.range(), "rapid move sideways and down in one block (`G0`)")
                    .label("Z may arrive before X and Y")
                    .help("move sideways first, and down in a separate block"),
            );
            cx.enough();
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn told_once() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90\nG0 X0 Y0 Z50\nX10 Z5\nX0 Z50\nX10 Z5\nM2\n",
            &expect![[r#"
                3 | X10 Z5
                  | ^^^^^^ info[rapid-sideways-and-down] rapid move sideways and down in one block (`G0`)
            "#]],
        );
    }
}
