//! A feed that the axes do not reach.

use std::collections::BTreeSet;

use gcheck_engine::{At, Event, Fact, FeedMode, PathMode, Position, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::reach::{self, Holder, Reach};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A move asks for a feed of which the axes reach less than 70 %: their rapid rate is lower (`[machine] rapid`, by axis),
    /// or they do not turn an arc so fast, or do not come to that speed between two stops (`[machine] acceleration`).
    ///
    /// It also holds inverse time to the highest feed: `F` is moves a minute there, so that no number shows the speed.
    /// Each `F` is reported once.
    ///
    /// ## Why it matters
    /// The control runs slower than the program says: each tooth cuts less, the tool rubs, and times are longer than the feed
    /// suggests.
    ///
    /// ## Reported
    /// On a machine that accelerates by 100 mm/s², which turns an arc of 0.5 mm with 424 mm a minute:
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G94 G17
    /// G0 X0. Y0.
    /// G1 X10. F3000.
    /// G2 X10.5 Y-.5 R.5
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94 G17
    /// G0 X0. Y0.
    /// G1 X10. F300.
    /// G2 X10.5 Y-.5 R.5
    /// M30
    /// ```
    rule "feed-not-reached" in "machine" {
        summary: "the axes stay far below the feed",
        severity: Hint,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::MOVES, make: || Box::new(FeedNotReached::default()) },
    }
}

/// Above this part of the feed the rule is silent.
const ENOUGH: f64 = 0.7;

#[derive(Default, Clone, PartialEq)]
struct FeedNotReached {
    /// The blocks that gave the feeds that were reported.
    told: BTreeSet<Option<At>>,
}

remembers!(FeedNotReached: told);

impl PathRule for FeedNotReached {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let machine = &program.environment.machine.engine;
        let dynamics = &machine.dynamics;
        machine.rapid.is_some()
            || !dynamics.rapid.is_empty()
            || dynamics.rotary_rapid.is_some()
            || !dynamics.acceleration.is_empty()
            || machine.max_feed.is_some()
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some((asked, reach)) = speeds(cx, event) else { return };
        if reach.speed >= asked * ENOUGH || cx.is_called_only() {
            return;
        }
        if !self.told.insert(cx.definitions().set_by(Fact::Feed)) {
            return;
        }
        let only_turns = matches!(reach.holder, Holder::Axis(axis) if axis.is_rotary());
        let rate = |speed: f64| {
            if only_turns { format!("{speed:.0} deg/min") } else { format!("{}/min", cx.shown(Mm(speed))) }
        };
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!(
                    "the feed comes to {}, and {} {} at most",
                    rate(asked),
                    reach.holder.words(),
                    rate(reach.speed)
                ),
            )
            .label(format!("{:.0} % of the feed is reached here", (reach.speed / asked * 100.0).floor()))
            .help("lower the feed, or correct the machine in the configuration");
        report.add(cx.resting_on(finding, Fact::Feed, "the feed"));
    }
}

/// The speed along the path that a move asks for, and the highest one that the axes reach.
fn speeds(cx: &PathCx<'_>, event: &Event) -> Option<(f64, Reach)> {
    let machine = &cx.environment.machine.engine;
    let (from, to): (&Position, &Position) = match event {
        Event::Travel(travel) if travel.kind == TravelKind::Feed => (&travel.from, &travel.to),
        Event::Arc(arc) => (&arc.from, &arc.to),
        _ => return None,
    };
    let (number, mode) = reach::feed(cx)?;
    let is_straight = matches!(event, Event::Travel(_));
    let asked = match mode {
        FeedMode::PerMinute => {
            // Without linear axes the number of the feed counts degrees, in whatever units the program is.
            let only_turns = reach::along(machine, from, to)
                .is_some_and(|reach| matches!(reach.holder, Holder::Axis(axis) if axis.is_rotary()));
            if only_turns {
                return None;
            }
            number
        }
        FeedMode::InverseTime => number * reach::length(from, to).filter(|_| is_straight)?,
        FeedMode::PerRevolution => return None,
    };
    let axes = if is_straight { reach::along(machine, from, to) } else { None };
    let turn = if let Event::Arc(arc) = event { reach::around(machine, arc) } else { None };
    let is_stopped = is_straight && cx.state().path_mode(cx.model) == Some(PathMode::ExactStop);
    let stops = if is_stopped { reach::between_stops(machine, from, to) } else { None };
    // A feed a minute above the highest feed is told where it is given.
    let feed = reach::by_feed(machine).filter(|_| mode == FeedMode::InverseTime);
    let reach = [axes, turn, stops, feed].into_iter().fold(None, reach::lower)?;
    Some((asked, reach))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_engine::Axis;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn a_slow_axis_holds_the_others() {
        let mut world = World::of_examples(&META);
        world.machine.engine.dynamics.rapid.insert(Axis::Z, 500.0);
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 G90 G94\nG0 X0 Y0 Z5\nG1 X10 F1000\nG1 Z-5\nX100\nX0 Z0 F500\nM2\n",
            &world,
            &expect![[r#"
                4 | G1 Z-5
                  | ^^^^^^ hint[feed-not-reached] the feed comes to 1000 mm/min, and Z moves 500 mm/min at most
            "#]],
        );
    }

    #[test]
    fn inverse_time_is_held_to_the_highest_feed() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 G90 G93\nG0 X0 Y0 Z5\nG1 X100 F200\nG1 X0 F50\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G1 X100 F200
                  | ^^^^^^^^^^^^ hint[feed-not-reached] the feed comes to 20000 mm/min, and the machine feeds 10000 mm/min at most
            "#]],
        );
    }

    #[test]
    fn between_two_stops_short_moves_are_slow() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20 G90 G94\nG0 X0. Y0.\nG1 X.01 F100.\nG61\nX.02\nX.03\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                5 | X.02
                  | ^^^^ hint[feed-not-reached] the feed comes to 100 in/min, and the axes come to 11.9051 in/min at most
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "fanuc-mill", "G21 G94 G0 Z0.\nG1 Z-5. F90000.\nM30\n", &expect![[""]]);
    }
}
