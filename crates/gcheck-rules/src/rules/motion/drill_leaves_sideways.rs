//! A drill that moves in X while it is in its hole.

use gcheck_controls::Effect;
use gcheck_engine::{At, Event, Fact, Spindle, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::tool_words::ToolWords;
use crate::facts::turned::{SLACK, Spot, Turned, UNDER, end, is_other_part};
use crate::facts::turning::is_turned;
use crate::{MakeShared, PathCx, PathRule, Remembers, Report, Run, Uses, Watch, remembers};

declare_rule! {
    /// A tool of a lathe drilled along the centre, deeper than any tool before it, and moves in X at rapid before it has
    /// left the hole along Z.
    ///
    /// ## Why it matters
    /// The drill is as wide as its hole. It breaks, and the turret may be pushed out of line. Mostly `G0 Z…` is missing
    /// before the move in X or the return to the machine's zero.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0505 (DRILL 12)
    /// G97 S900 M3
    /// G0 X0 Z2.
    /// G1 Z-40. F0.1
    /// G28 U0
    /// G28 W0
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20 G99 T505
    /// G97 S900 M3
    /// G0 X0. Z0.1
    /// G1 Z-1.5 F0.004
    /// G0 X6. Z4.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0505 (DRILL 12)
    /// G97 S900 M3
    /// G0 X0 Z2.
    /// G1 Z-40. F0.1
    /// G0 Z2.
    /// G28 U0 W0
    /// M30
    /// ```
    rule "drill-leaves-sideways" in "motion" {
        summary: "drill of a lathe moves in X while it is in its hole",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(DrillLeavesSideways::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct DrillLeavesSideways {
    hole: Option<Hole>,
}

remembers!(DrillLeavesSideways: hole);

/// The hole that the present tool drills.
#[derive(Clone, PartialEq)]
struct Hole {
    tool: Option<At>,
    /// Z where its first feed began, and its lowest one.
    top: f64,
    bottom: f64,
    /// The block of the last feed into it.
    at: At,
}

remembers!(Hole: tool, at);

/// Shorter moves bring a drill to the centre: millimetres.
const SHORT: f64 = 0.5;

impl PathRule for DrillLeavesSideways {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn shares(&self) -> Option<MakeShared> {
        Some(Turned::shared)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program)
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        if is_other_part(cx, event) {
            self.hole = None;
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(turned) = Turned::of(cx) else {
            self.hole = None;
            return;
        };
        if let (Event::Travel(travel), Some(here)) = (event, turned.here())
            && turned.knows(cx)
        {
            let to = end(cx, travel);
            match travel.kind {
                TravelKind::Feed | TravelKind::Thread => self.feed(cx, here, to),
                TravelKind::Rapid if !travel.expanded || cx.has_effect(Effect::goes_to_machine_place) => {
                    self.leave(cx, turned, here, to, report);
                }
                _ => {}
            }
        }
    }
}

impl DrillLeavesSideways {
    fn feed(&mut self, cx: &PathCx<'_>, from: Spot, to: Spot) {
        let tool = cx.definitions().set_by(Fact::Tool);
        let is_along = from[0].abs() < SLACK && to[0].abs() < SLACK;
        let turns = cx.state().spindle().is_some_and(|spindle| spindle != Spindle::Stopped);
        if !is_along || !turns {
            self.hole = None;
        } else if from[1] - to[1] > SLACK {
            let at = cx.origin().at;
            let hole = self.hole.take().filter(|hole| hole.tool == tool);
            let hole = hole.unwrap_or(Hole { tool, top: from[1], bottom: to[1], at });
            self.hole = Some(Hole { bottom: hole.bottom.min(to[1]), at, ..hole });
        }
    }

    fn leave(&mut self, cx: &PathCx<'_>, turned: &Turned, from: Spot, to: Spot, report: &mut Report<'_>) {
        let tool = cx.definitions().set_by(Fact::Tool);
        let Some(hole) = self.hole.as_ref().filter(|hole| hole.tool == tool) else { return };
        let is_sideways = if to[0].is_nan() {
            cx.has_effect(Effect::goes_to_machine_place)
        } else {
            (to[0] - from[0]).abs() > SHORT
        };
        let is_inside = from[0].abs() < SLACK && from[1] < -UNDER && from[1] < hole.top - UNDER;
        if !is_sideways || !is_inside {
            return;
        }
        // Where a tool drilled before, another one may be a boring bar.
        let is_solid = hole.bottom < turned.depth_at_centre(tool) - UNDER;
        let words = ToolWords::of(cx);
        if !is_solid && !words.drills() || words.bores() || words.needs_no_spindle() {
            return;
        }
        let at = cx.shown(Mm(from[1]));
        let mut finding = cx
            .finding(&META, cx.range(), "the drill moves in X while it is in its hole")
            .label(format!("the tool is at Z {at}, and this moves X at rapid"));
        if let Some(range) = cx.range_of(hole.at) {
            finding = finding.also(range, "the tool drills along the centre");
        }
        report.add(
            finding
                .assuming("the hole is not wider than the tool")
                .help("retract along Z first, in a block of its own (`G0 Z…`)"),
        );
        self.hole = None;
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(before: &str, drill: &str) -> String {
        format!("G21 G99 G40\n{before}T0505\nG97 S900 M3\nG0 X0 Z2.\n{drill}\nM30\n")
    }

    #[test]
    fn every_way_out_in_x_counts() {
        for way in ["G0 X3.", "G28 U0", "G28 U0 W0", "G0 X100. Z50."] {
            let found = program("", &format!("G1 Z-40. F.1\n{way}"));
            let found = crate::testing::findings(
                &crate::testing::only(&RULE),
                "fanuc-lathe",
                &found,
                &crate::testing::World::default(),
            );
            assert_eq!(found.len(), 1, "{way}");
        }
    }

    #[test]
    fn a_drill_that_pecks_is_still_in_its_hole() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("", "G1 Z-10. F.1\nG0 Z2.\nZ-9.\nG1 Z-20.\nG0 Z-15.\nX50."),
            &expect![[r#"
                10 | X50.
                   | ^^^^ warning[drill-leaves-sideways] the drill moves in X while it is in its hole
            "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &program("", "G1 Z-10. F.1\nG0 Z2.\nX50."), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("", "G83 Z-40. R2. Q5. F.1\nG80\nG0 X50."), &expect![[""]]);
    }

    #[test]
    fn a_face_and_a_bar_stop_are_no_holes() {
        check_rule(&RULE, "fanuc-lathe", &program("", "G1 Z0. F.1\nX50."), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &program("", "M5\nG98 G1 Z-40. F500.\nG0 X50."), &expect![[""]]);
    }

    #[test]
    fn in_a_hole_that_was_drilled_before_a_tool_may_bore() {
        let drilled = "T0303\nG97 S900 M3\nG0 X0 Z2.\nG1 Z-50. F.1\nG0 Z2.\n";
        check_rule(&RULE, "fanuc-lathe", &program(drilled, "G1 Z-40. F1.\nG0 X8."), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program(drilled, "G1 Z-40. F1.\nG0 X8.").replace("T0505", "T0505 (REAMER 12H7)"),
            &expect![[r#"
                11 | G0 X8.
                   | ^^^^^^ warning[drill-leaves-sideways] the drill moves in X while it is in its hole
            "#]],
        );
    }
}
