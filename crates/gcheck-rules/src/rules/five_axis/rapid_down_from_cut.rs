//! A rapid move straight down from the end of a five-axis cut.

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Position, Role, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::five_axis::is_along_tool;
use crate::facts::turned::goes_home;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// With the length along a tilting tool (`G143`, `G43.4`), a rapid move right after a cut lowers Z and leaves all other axes
    /// where they are.
    ///
    /// ## Why it matters
    /// A cut ends on the part, and below it is the part: the tool is driven into it at rapid. Mostly the point of a retract
    /// slipped (`Z.3` for `Z3.`), or its minus sign is wrong.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G94 G54 T1 M6
    /// G0 X1. Y0. S8000 M3
    /// G143 H1 X1. Y0. Z3. A0. B0.
    /// G1 G93 X1. Y0. Z2. A5. B0. F40.
    /// X1.5 Y0. Z2.1 A6. B0. F40.
    /// G94
    /// G0 X1.5 Y0. Z.3 A6. B0.
    /// G49
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G94 G54 T1 M6
    /// G0 X1. Y0. S8000 M3
    /// G143 H1 X1. Y0. Z3. A0. B0.
    /// G1 G93 X1. Y0. Z2. A5. B0. F40.
    /// X1.5 Y0. Z2.1 A6. B0. F40.
    /// G94
    /// G0 X1.5 Y0. Z3. A6. B0.
    /// G49
    /// M30
    /// ```
    rule "rapid-down-from-cut" in "five_axis" {
        summary: "rapid move straight down from the end of a five-axis cut",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(RapidDownFromCut::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidDownFromCut {
    /// Where the last move ends as it is programmed, and whether it was a cut: a feed move in more than Z.
    last: Option<(Position, bool)>,
}

remembers!(RapidDownFromCut);

/// Ways down that are shorter may be a last touch: millimetres.
const SHORT: f64 = 0.5;
/// Places that are nearer than this are one: millimetres, or degrees.
const SAME: f64 = 0.001;

impl PathRule for RapidDownFromCut {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| is_along_tool(effect) || effect == Effect::ToolCentrePoint)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let last = self.last.take();
        let Event::Travel(travel) = event else { return };
        if !cx.is_on_every_path() || cx.is_called_only() || travel.expanded {
            return;
        }
        let differs = |axis: Axis| {
            let before = last.map_or(f64::NAN, |(before, _)| before.raw(axis));
            (travel.programmed.raw(axis) - before).abs() > SAME
        };
        let is_across = Axis::ALL.into_iter().filter(|axis| *axis != Axis::Z).any(differs);
        self.last = Some((travel.programmed, travel.kind == TravelKind::Feed && is_across));
        let follows = |effect| is_along_tool(effect) || effect == Effect::ToolCentrePoint;
        let is_five_axis = cx.state().effect(Role::Length, cx.model).is_some_and(follows);
        let Some((from, true)) = last else { return };
        if !is_five_axis || travel.kind != TravelKind::Rapid || goes_home(cx) {
            return;
        }
        let stays = |axis: Axis| {
            let (before, after) = (from.raw(axis), travel.programmed.raw(axis));
            // An axis that the machine does not have is nowhere, before and after.
            let is_nowhere =
                after.is_nan() && before.is_nan() && !cx.origin().letters.contains(axis.letter());
            (after - before).abs() < SAME || is_nowhere
        };
        let others = Axis::ALL.into_iter().filter(|axis| *axis != Axis::Z).all(stays);
        let way = from.raw(Axis::Z) - travel.programmed.raw(Axis::Z);
        // False for a height that is not known.
        if others && way > SHORT {
            report.add(
                cx.finding(&META, cx.letter_range('Z'), "rapid move straight down from the end of a cut")
                    .label(format!("{} lower than the cut, with the tool as it was", cx.shown(Mm(way))))
                    .help("check the point and the sign of `Z`; a retract goes up, or along the tool"),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(retract: &str) -> String {
        format!(
            "G20 G90 G94 G54 T1 M6\nG0 X1. Y0. S8000 M3\nG143 H1 X1. Y0. Z3. A0. B0.\nG1 G93 X1.5 Y0. Z2. A5. B0. F40.\nG94\n{retract}\nG49\nM30\n"
        )
    }

    #[test]
    fn with_the_tool_as_it_was() {
        check_rule(
            &RULE,
            "haas-mill",
            &program("G0 X1.5 Y0. Z.3 A5. B0."),
            &expect![[r#"
                6 | G0 X1.5 Y0. Z.3 A5. B0.
                  |             ^^^ warning[rapid-down-from-cut] rapid move straight down from the end of a cut
            "#]],
        );
        for retract in [
            "G0 X1.5 Y0. Z3. A5. B0.",
            "G0 X4. Y0. Z.3 A5. B0.",
            "G53 G0 Z0.",
            "G1 X1.5 Y0. Z9. A5. B0. F90.\nG0 X1.5 Y0. Z1. A5. B0.",
        ] {
            check_rule(&RULE, "haas-mill", &program(retract), &expect![[""]]);
        }
    }
}
