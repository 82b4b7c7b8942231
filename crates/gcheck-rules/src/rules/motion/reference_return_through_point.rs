//! A reference return that passes through the part.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{At, Axis, Event, Fact, Role, Travel};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::{Finding, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A return to the reference position (`G28`, `G30`) has axis words in absolute mode (`G90`), and their point is
    /// lower than the tool, or the tool reaches it at depth.
    ///
    /// ## Why it matters
    /// The axis words of a reference return give a point that the tool passes on the way. `G90 G28 Z0` does not
    /// retract: it first moves at rapid to Z0 of the work, into the part or the vice. To retract, write `G91 G28 Z0`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0 Y0
    /// G43 H1 Z1.
    /// G28 Z0
    /// M30
    /// ```
    /// The tool's position is unknown, but it moves to Z0 of the part.
    /// ```nc,reported,fanuc-mill
    /// G90 G28 Z0
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0 Y0
    /// G43 H1 Z1.
    /// G91 G28 Z0
    /// G90
    /// M30
    /// ```
    /// The point is above the tool.
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0 Y0
    /// G43 H1 Z1.
    /// G28 Z4.
    /// M30
    /// ```
    rule "reference-return-through-point" in "motion" {
        summary: "reference return that passes through the part",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::RAPIDS,
            make: || Box::new(ReferenceReturnThroughPoint::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ReferenceReturnThroughPoint {
    /// The block whose first move was seen: the second one leads on from the point.
    seen: Option<At>,
}

remembers!(ReferenceReturnThroughPoint: seen);

/// Heights in millimetres that differ by less are equal.
const SAME: f64 = 0.001;

impl PathRule for ReferenceReturnThroughPoint {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(returns)
    }

    fn rapid(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        if !travel.expanded || !cx.origin().flags.contains(gcheck_program::BlockFlags::CODE) {
            return;
        }
        let at = cx.origin().at;
        if !cx.has_effect(returns) || self.seen.replace(at) == Some(at) {
            return;
        }
        if cx.state().is_incremental(cx.model) != Some(false) {
            return;
        }
        let found = if cx.origin().letters.contains(Axis::Z.letter()) {
            down(cx, travel)
        } else {
            across(cx, travel)
        };
        if let Some(finding) = found {
            let finding = cx.resting_on(finding, Fact::Mode(Role::Distance), "absolute mode");
            report
                .add(finding.help(
                    "write the return in increments (`G91 G28 Z0`), or give a point clear of the part",
                ));
        }
    }
}

fn returns(effect: Effect) -> bool {
    matches!(effect, Effect::ReturnReference(_))
}

/// Z goes down to the point.
fn down(cx: &PathCx<'_>, travel: &Travel) -> Option<Finding> {
    // Zero and below is where the part is, whatever the units.
    let is_at_part = travel.programmed.get(Axis::Z).map_or_else(|| zero_or_less(cx), |z| z <= SAME);
    let (message, label) = match (travel.from.get(Axis::Z), travel.programmed.get(Axis::Z)) {
        (Some(from), Some(to)) if to < from - SAME => (
            "reference return first goes down to a point of the part",
            "the tool moves down to this height at rapid",
        ),
        (Some(_), Some(_)) => return None,
        _ if is_at_part => (
            "reference return first goes to a point of the part",
            "the tool moves to this height of the part at rapid",
        ),
        _ => return None,
    };
    Some(cx.finding(&META, cx.letter_range('Z'), message).label(label).note(PASSES))
}

/// Is the height given as zero or less?
fn zero_or_less(cx: &PathCx<'_>) -> bool {
    cx.known_number('Z').is_some_and(|z| z <= 0.0)
}

/// X and Y go to the point while Z stays below the zero of the part.
fn across(cx: &PathCx<'_>, travel: &Travel) -> Option<Finding> {
    let depth = travel.from.get(Axis::Z).filter(|z| *z < -SAME)?;
    if !cx.is_mill() {
        return None;
    }
    let stays = |axis: Axis| (travel.programmed.raw(axis) - travel.from.raw(axis)).abs() < SAME;
    if !cx.origin().letters.intersects(LetterSet::of("XY")) || stays(Axis::X) && stays(Axis::Y) {
        return None;
    }
    let depth = cx.shown(Mm(-depth));
    Some(
        cx.finding(&META, cx.effect_range(returns), "reference return crosses the part at depth")
            .label(format!(
                "the tool is {depth} below the zero of the part, and moves to this point at rapid"
            ))
            .note(PASSES),
    )
}

const PASSES: &str = "axis words of a reference return give a point that the tool passes on the way";

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_height_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0 Y0\nG43 H1 Z1.\nG28 X0 Y0 Z.5\nG43 H1 Z1.\nG28 Z1.\nM30\n",
            &expect![[r#"
                3 | G28 X0 Y0 Z.5
                  |           ^^^ warning[reference-return-through-point] reference return first goes down to a point of the part
            "#]],
        );
    }

    #[test]
    fn increments_and_returns_without_words_pass_no_point() {
        check_rule(&RULE, "haas-mill", "G90 G0 X0 Y0 Z1.\nG28\nM30\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", "G0 X10. Z1.\nG28 U0 W0\nM30\n", &expect![[""]]);
    }

    #[test]
    fn crossing_at_depth_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G90 G54 G0 X50. Y0\nG43 H1 Z-5.\nG1 X60. F100.\nG28 X0 Y0\nM30\n",
            &expect![[r#"
                4 | G28 X0 Y0
                  | ^^^ warning[reference-return-through-point] reference return crosses the part at depth
            "#]],
        );
    }

    #[test]
    fn high_above_the_part_crossing_does_no_harm() {
        check_rule(&RULE, "fanuc-mill", "G21 G90 G54 G0 X50. Y0 Z50.\nG28 X0 Y0\nM30\n", &expect![[""]]);
    }
}
