//! A rapid move straight down from the end of a cut.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Position, Role, Travel, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cuts::SURFACE;
use crate::facts::five_axis::follows_the_tip;
use crate::{Finding, PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A rapid move right after a cut lowers Z and leaves all other axes where they are, and the tool comes up again without a
    /// cut. A stop of the program and a tool change between show that the operator has something to do there, and nothing is
    /// reported. With the length along a tilting tool (`G143`, `G43.4`), the move is reported whatever follows.
    ///
    /// ## Why it matters
    /// A cut ends on the part, and below it is the part: the tool is driven into it at rapid. Mostly the point of a retract
    /// slipped (`Z.3` for `Z3.`), or it has a minus sign.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G94 G54 T1 M6
    /// G0 X0. Y0. S5000 M3
    /// G43 H1 Z5.
    /// G1 Z-4. F200.
    /// X12. F600.
    /// G3 I-12. J0.
    /// G0 Z-25.
    /// G53 Z0.
    /// M30
    /// ```
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
    /// The tool goes down beside the part, to the depth of the next cut.
    /// ```nc,quiet,haas-mill
    /// G21 G90 G94 G54 T1 M6
    /// G0 X-15. Y-10. S5000 M3
    /// G43 H1 Z-2.
    /// G1 X60. F600.
    /// G0 Z-4.
    /// G1 X-15.
    /// G53 G0 Z0.
    /// M30
    /// ```
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
    rule "rapid-down-from-cut" in "motion" {
        summary: "rapid move straight down from the end of a cut",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(RapidDownFromCut::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct RapidDownFromCut {
    /// Where the last move ends as it is programmed, and whether it was a cut: a feed move in more than Z, or an arc.
    last: Option<(Position, bool)>,
    waiting: Option<Waiting>,
}

remembers!(RapidDownFromCut: waiting);

/// A move down after which nothing was cut yet.
#[derive(Clone, PartialEq)]
struct Waiting {
    /// The level that it went to: millimetres.
    z: f64,
    /// The `Z` of the block.
    bytes: Range<u32>,
    finding: Finding,
}

remembers!(Waiting: bytes, finding);

/// Ways down that are shorter may be a last touch: millimetres.
const SHORT: f64 = 0.5;
/// Places that are nearer than this are one: millimetres, or degrees.
const SAME: f64 = 0.001;

impl PathRule for RapidDownFromCut {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        // Places of another work offset or shift are others.
        let is_elsewhere = matches!(event, Event::WorkOffset { .. } | Event::Shift(_));
        if is_elsewhere || matches!(event, Event::Stop(_) | Event::StartChange | Event::ToolChange(_)) {
            (self.last, self.waiting) = (None, None);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if !cx.is_mill() {
            cx.enough();
            return;
        }
        if let Event::Travel(travel) = event
            && travel.kind == TravelKind::Feed
            && !travel.expanded
        {
            self.cut(cx, travel);
            return;
        }
        let (last, waiting) = (self.last.take(), self.waiting.take_if(|_| true));
        let travel = match event {
            // A reference return goes by a point of its block, and on.
            Event::Travel(travel) if !travel.expanded || cx.has_effect(Effect::goes_to_machine_place) => {
                travel
            }
            Event::Arc(arc) if !arc.expanded => {
                self.last = Some((arc.programmed, true));
                return;
            }
            Event::Travel(_) => {
                cx.rest();
                return;
            }
            _ => return,
        };
        if !cx.is_certain() {
            return;
        }
        let is_rapid = travel.kind == TravelKind::Rapid;
        if let Some(waiting) = waiting.filter(|_| is_rapid) {
            self.waiting = goes_on(cx, waiting, &travel.programmed, report);
        }
        let is_cut = travel.kind == TravelKind::Feed && is_across(last.as_ref(), travel);
        self.last = Some((travel.programmed, is_cut));
        if let Some((from, true)) = last
            && is_rapid
            && !cx.has_effect(Effect::goes_to_machine_place)
        {
            self.down(cx, &from, &travel.programmed, report);
        }
    }
}

/// Does a move go on in more than Z?
fn is_across(last: Option<&(Position, bool)>, travel: &Travel) -> bool {
    let Some((before, _)) = last else { return false };
    let differs = |axis: Axis| (travel.programmed.raw(axis) - before.raw(axis)).abs() > SAME;
    Axis::ALL.into_iter().filter(|axis| *axis != Axis::Z).any(differs)
}

impl RapidDownFromCut {
    /// A feed move that the program itself makes: there may be millions.
    fn cut(&mut self, cx: &PathCx<'_>, travel: &Travel) {
        self.waiting = None;
        self.last = if cx.is_certain() {
            Some((travel.programmed, is_across(self.last.as_ref(), travel)))
        } else {
            None
        };
    }

    /// A rapid move from the end of a cut.
    fn down(&mut self, cx: &PathCx<'_>, from: &Position, to: &Position, report: &mut Report<'_>) {
        let stays = |axis: Axis| {
            let (before, after) = (from.raw(axis), to.raw(axis));
            // An axis that the machine does not have is nowhere, before and after.
            let is_nowhere =
                after.is_nan() && before.is_nan() && !cx.origin().letters.contains(axis.letter());
            (after - before).abs() < SAME || is_nowhere
        };
        let others = Axis::ALL.into_iter().filter(|axis| *axis != Axis::Z).all(stays);
        let (z, way) = (to.raw(Axis::Z), from.raw(Axis::Z) - to.raw(Axis::Z));
        // False for a height that is not known.
        let is_down = way > SHORT;
        if !others || !is_down {
            return;
        }
        let bytes = cx.letter_range('Z');
        let finding = cx
            .finding(&META, bytes.clone(), "rapid move straight down from the end of a cut")
            .label(format!("{} lower than the cut, with the tool as it was", cx.shown(Mm(way))))
            .help("check the point and the sign of `Z`; a retract goes up, or along the tool");
        let is_five_axis = cx.state().effect(Role::Length, cx.model).is_some_and(follows_the_tip);
        if is_five_axis {
            report.add(finding);
        } else if z < SURFACE {
            self.waiting = Some(Waiting { z, bytes, finding });
        }
    }
}

/// The rapid move after one down: to the next cut, or up again.
fn goes_on(cx: &PathCx<'_>, waiting: Waiting, to: &Position, report: &mut Report<'_>) -> Option<Waiting> {
    let is_up = cx.has_effect(Effect::goes_to_machine_place) || to.raw(Axis::Z) > waiting.z + SHORT;
    if !is_up {
        return Some(waiting);
    }
    let here = cx.range();
    let is_same_block = here.start <= waiting.bytes.start && waiting.bytes.end <= here.end;
    let finding = waiting.finding;
    report.add(if is_same_block {
        finding
    } else {
        finding.also(here, "the tool comes up again, and has cut nothing there")
    });
    None
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

    fn contour(after: &str) -> String {
        format!(
            "G21 G90 G94 G54 T1 M6\nG0 X0. Y0. S5000 M3\nG43 H1 Z5.\nG1 Z-4. F200.\nX12. F600.\n{after}\nM30\n"
        )
    }

    #[test]
    fn and_up_again_without_a_cut() {
        check_rule(
            &RULE,
            "haas-mill",
            &contour("G0 Z-25.\nX40. Y40.\nG91 Z30."),
            &expect![[r#"
                6 | G0 Z-25.
                  |    ^^^^^ warning[rapid-down-from-cut] rapid move straight down from the end of a cut
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &contour("M98 P7\nG53 G0 Z0.\nM30\nO7\nG3 I-12. J0.\nG0 Z-25.\nM99"),
            &expect![[r#"
                11 | G0 Z-25.
                   |    ^^^^^ warning[rapid-down-from-cut] rapid move straight down from the end of a cut
            "#]],
        );
        for after in [
            // To the next cut.
            "G0 Z-8.\nG1 X0.\nG0 Z25.",
            "G0 Z-8.\nX0.\nG1 Y20.\nG0 Z25.",
            // Up, and above the part.
            "G0 Z25.\nZ2.\nG53 Z0.",
            "G1 Z9. X20.\nG0 Z2.\nZ25.",
            // After a feed move straight down.
            "G1 Z-6.\nG0 Z-8.\nZ25.",
            // The operator moves a clamp, or another work offset counts.
            "G0 Z-12.\nM0\nG0 Z50.",
            "G0 G55 Z-8.\nZ50.",
            // What comes between is unknown.
            "G0 Z-8.\nG65 P9999\nG0 Z25.",
        ] {
            check_rule(&RULE, "haas-mill", &contour(after), &expect![[""]]);
        }
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
