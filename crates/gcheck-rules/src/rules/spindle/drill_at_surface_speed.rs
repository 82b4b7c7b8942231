//! A drill on the centre of a lathe at constant surface speed.

use std::ops::Range;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Axis, Event, Fact, Role, Spindle, TravelKind};

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::live_tool::Executed;
use crate::facts::tool_words::ToolWords;
use crate::facts::turning::{is_turned, turns_the_part};
use crate::{Finding, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A lathe drills along its centre while the spindle keeps a constant surface speed (`G96`): a feed move along Z at `X0` into
    /// the part, after which the tool comes straight out. A low limit of the speed that the tool gets after it came in (`G50 S800`) is
    /// the drill's own speed, and nothing is reported.
    ///
    /// ## Why it matters
    /// The control computes the speed from the distance to the centre, and there it is as high as the limit allows: several
    /// times the speed of the drill, which burns or breaks. Mostly the mode of the turning tool before is still on.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S4000
    /// G96 S200 M3
    /// G0 X54. Z0.
    /// G1 X-1.6 F.2
    /// G0 X150. Z100.
    /// T0404 (DRILL 20)
    /// G0 X0. Z3.
    /// G1 Z-40. F.15
    /// G0 Z5.
    /// X150. Z100.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0101
    /// G50 S4000
    /// G96 S200 M3
    /// G0 X54. Z0.
    /// G1 X-1.6 F.2
    /// G0 X150. Z100.
    /// T0404 (DRILL 20)
    /// G97 S800 M3
    /// G0 X0. Z3.
    /// G1 Z-40. F.15
    /// G0 Z5.
    /// X150. Z100.
    /// M30
    /// ```
    rule "drill-at-surface-speed" in "spindle" {
        summary: "drill on the centre at constant surface speed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::ALL_BLOCKS).union(Watch::CHANGES),
            make: || Box::new(DrillAtSurfaceSpeed::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct DrillAtSurfaceSpeed {
    /// The tool change whose tool was reported last.
    told: Option<At>,
    /// The tool is in the part, on its centre: it may be a bar that turns outward from there.
    waiting: Option<Waiting>,
    /// The block that last limited the speed.
    limited: Option<At>,
    executed: Executed,
}

remembers!(DrillAtSurfaceSpeed: told, waiting, limited, executed);

#[derive(Clone, PartialEq)]
struct Waiting {
    tool: Option<At>,
    bytes: Range<u32>,
    finding: Finding,
}

remembers!(Waiting: tool, bytes, finding);

/// The centre, as a radius: millimetres.
const CENTRE: f64 = 0.02;
/// Turns a minute: up to this a limit may be meant as the speed of the drill.
const FASTEST: f64 = 2000.0;
/// So far into the part: millimetres.
const DEEP: f64 = 1.0;

impl PathRule for DrillAtSurfaceSpeed {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        is_turned(program) && program.may(|effect| effect == Effect::SurfaceSpeed)
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        let limits = |effect| effect == Effect::SpeedLimitOrSetPosition;
        if cx.has_effect(limits) && cx.origin().letters.contains(Letter::of('S')) {
            self.limited = Some(cx.origin().at);
        }
        self.executed.block(cx);
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.executed.changed(cx, event);
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let waiting = self.waiting.take();
        let Event::Travel(travel) = event else { return };
        if travel.kind == TravelKind::Rapid {
            self.executed.rapid(cx);
        }
        let (from, to) = (&travel.from, &travel.to);
        let is_centre = |x: f64| x.abs() < CENTRE;
        // A place that is not known is not the centre.
        let is_along = is_centre(from.raw(Axis::X)) && is_centre(to.raw(Axis::X));
        let down = from.raw(Axis::Z) - to.raw(Axis::Z);
        if let Some(waiting) = waiting.filter(|_| is_along) {
            // A bar that turns outward from the bottom of a bore does not come out along the centre.
            let is_out = down < 0.0 && (travel.kind == TravelKind::Rapid || to.raw(Axis::Z) > -DEEP);
            if is_out || cx.has_effect(Effect::goes_to_machine_place) {
                self.told = waiting.tool;
                report.add(waiting.finding);
            } else {
                self.waiting = Some(waiting);
            }
            return;
        }
        let is_hole = is_along && down > DEEP && to.raw(Axis::Z) < -DEEP;
        if travel.kind == TravelKind::Feed && is_hole {
            self.waiting = self.drills(cx);
        }
    }
}

impl DrillAtSurfaceSpeed {
    fn drills(&self, cx: &PathCx<'_>) -> Option<Waiting> {
        let state = cx.state();
        let turns = state.spindle().is_some_and(Spindle::turns);
        let fact = Fact::Mode(Role::SpindleMode);
        let tool = cx.definitions().set_by(Fact::Tool);
        let is_told = tool.is_some() && tool == self.told;
        let is_by_surface = state.effect(Role::SpindleMode, cx.model) == Some(Effect::SurfaceSpeed);
        let is_set = cx.definitions().set_by(fact).is_some();
        let may_be_live = self.executed.may_be_live(cx);
        if !is_by_surface || !is_set || is_told || !turns || !turns_the_part(cx) || may_be_live {
            return None;
        }
        let is_own_limit = self.limited.zip(tool).is_some_and(|(limited, tool)| is_before(tool, limited));
        if is_own_limit && state.speed_limit() <= FASTEST || ToolWords::of(cx).needs_no_spindle() {
            return None;
        }
        let name = cx.code_name(Role::SpindleMode)?;
        let constant = cx.name_of_effect(Effect::ConstantSpeed)?;
        let limit = state.speed_limit();
        let label = if limit.is_finite() {
            format!("on the centre the spindle turns at its limit of {limit:.0} per minute")
        } else {
            "on the centre the spindle turns as fast as it can".to_owned()
        };
        let finding = cx
            .finding(&META, cx.range(), format!("the centre is drilled at constant surface speed (`{name}`)"))
            .label(label)
            .help(format!("change to a constant spindle speed (`{constant} S…`) before the hole"));
        let finding = cx.resting_on(finding, fact, &format!("`{name}`"));
        Some(Waiting { tool, bytes: cx.range(), finding })
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    fn program(mode: &str, hole: &str) -> String {
        format!("G21 G99 T0404\n{mode} M3\nG0 X0. Z3.\n{hole}\nG0 Z50.\nX150. Z100.\nM30\n")
    }

    #[test]
    fn in_one_go_in_pecks_and_by_a_cycle() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("G96 S150", "G1 Z-10. F.1\nG0 Z1.\nZ-9.\nG1 Z-20."),
            &expect![[r#"
                4 | G1 Z-10. F.1
                  | ^^^^^^^^^^^^ warning[drill-at-surface-speed] the centre is drilled at constant surface speed (`G96`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G96 S150", "G83 Z-30. R2. Q5. F.1\nG80"),
            &expect![[r#"
                4 | G83 Z-30. R2. Q5. F.1
                  | ^^^^^^^^^^^^^^^^^^^^^ warning[drill-at-surface-speed] the centre is drilled at constant surface speed (`G96`)
            "#]],
        );
        for hole in ["G1 Z-10. F.1\nG0 Z1.", "G83 Z-30. R2. Q5. F.1\nG80"] {
            check_rule(&RULE, "haas-lathe", &program("G97 S900", hole), &expect![[""]]);
        }
    }

    #[test]
    fn however_the_drill_comes_out() {
        for out in ["G1 Z5. F2.\nG0 X150. Z100.", "G28 W0.\nG28 U0."] {
            check_rule(
                &RULE,
                "fanuc-lathe",
                &format!("G21 G99 T0404\nG50 S4000\nG96 S150 M3\nG0 X0. Z3.\nG1 Z-40. F.1\n{out}\nM30\n"),
                &expect![[r#"
                    5 | G1 Z-40. F.1
                      | ^^^^^^^^^^^^ warning[drill-at-surface-speed] the centre is drilled at constant surface speed (`G96`)
                "#]],
            );
        }
    }

    #[test]
    fn a_limit_of_its_own_and_a_live_centre() {
        for (comment, limit) in [("(DRILL 20)", "G50 S800\n"), ("(LIVE CENTER)", "")] {
            check_rule(
                &RULE,
                "fanuc-lathe",
                &format!(
                    "G21 G99 T0404 {comment}\n{limit}G96 S150 M3\nG0 X0. Z3.\nG1 Z-40. F.1\nG0 Z5.\nX150. Z100.\nM30\n"
                ),
                &expect![[""]],
            );
        }
    }

    #[test]
    fn a_contour_that_begins_on_the_centre() {
        for contour in [
            "G1 Z0. F.1\nG3 X30. Z-15. R15.\nG1 X40.",
            // The bottom of a bore, from its middle outward.
            "G1 Z-20. F.1\nX30.\nZ2.\nX0.",
            "G1 Z-20. F.1\nG2 X30. Z-5. R18.",
        ] {
            check_rule(&RULE, "fanuc-lathe", &program("G96 S150", contour), &expect![[""]]);
        }
        check_rule(&RULE, "fanuc-lathe", &program("G96 S150\nM45", "G1 Z-10. F.1"), &expect![[""]]);
        // The C axis is engaged in a called program.
        let called = program("G96 S150", "M98 P200\nG1 Z-10. F.1");
        check_rule(&RULE, "fanuc-lathe", &format!("O1\n{called}O200\nM45\nM99\n"), &expect![[""]]);
    }
}
