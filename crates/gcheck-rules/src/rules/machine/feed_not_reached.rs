//! A feed that the axes do not reach.

use std::collections::BTreeSet;

use gcheck_engine::{ArcMove, At, Event, Fact, FeedMode, PathMode, Position, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::reach::{self, Holder, Reach};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A move asks for a feed of which the axes reach less than 70 %: their rapid rate is lower (`[machine] rapid`, by axis),
    /// or they do not turn an arc so fast, or do not come to that speed between two stops (`[machine] acceleration`).
    ///
    /// It also holds inverse time to the highest feed: `F` is moves a minute there, so that no number shows the speed. Where
    /// rotary axes move, it holds them to their rate (`[machine] rotary_rapid`): in inverse time, and with a feed a minute where
    /// the control's manual says what that counts. Each `F` is reported once.
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
    /// ## How to fix it
    /// * Lower the feed to what the axes reach, or leave it and reckon with the longer time.
    /// * If the machine is faster, correct `rapid`, `rotary_rapid` or `acceleration` under `[machine]`.
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
        let Some(asked) = asked(cx, event) else { return };
        if asked.share >= ENOUGH || cx.is_called_only() {
            return;
        }
        if !self.told.insert(cx.definitions().set_by(Fact::Feed)) {
            return;
        }
        let finding = cx
            .finding(&META, cx.range(), asked.words)
            .label(format!("{:.0} % of the feed is reached here", (asked.share * 100.0).floor()))
            .help("lower the feed, or correct the machine in the configuration");
        report.add(cx.resting_on(finding, Fact::Feed, "the feed"));
    }
}

/// What a move asks for.
struct Asked {
    /// The part of it that the machine reaches.
    share: f64,
    /// Both as the message says them.
    words: String,
}

fn asked(cx: &PathCx<'_>, event: &Event) -> Option<Asked> {
    let machine = &cx.environment.machine.engine;
    let (from, to): (&Position, &Position) = match event {
        Event::Travel(travel) if travel.kind == TravelKind::Feed => (&travel.from, &travel.to),
        Event::Arc(arc) => return on_arc(cx, arc),
        _ => return None,
    };
    let (_, mode) = reach::feed(cx)?;
    if reach::is_on_the_face(cx) {
        return None;
    }
    let minutes = reach::minutes(cx, from, to)?;
    let asked = reach::length(from, to)? / minutes;
    let (only_turns, is_as_written) = (reach::only_turns(from, to), reach::moves_as_written(cx));
    let by_rate = reach::along_axes(machine, from, to, |axis| is_as_written || axis.is_rotary());
    let is_stopped = is_as_written && cx.state().path_mode(cx.model) == Some(PathMode::ExactStop);
    let stops = if is_stopped { reach::between_stops(machine, from, to) } else { None };
    // A feed a minute above the highest feed is told where it is given.
    let feed = reach::by_feed(machine).filter(|_| mode == FeedMode::InverseTime && !only_turns);
    let reach = [by_rate, stops, feed].into_iter().fold(None, reach::lower)?;
    let share = reach.speed / asked;
    let words = match reach.holder {
        Holder::Axis(axis) if axis.is_rotary() => {
            let speed = reach::way(from, to, axis)? / minutes;
            format!(
                "the feed asks {} for {speed:.0} deg/min, and {} {:.0} deg/min at most",
                axis.name(),
                reach.holder.words(),
                speed * share
            )
        }
        _ if only_turns => format!(
            "the feed comes to {asked:.0} deg/min, and {} {:.0} deg/min at most",
            reach.holder.words(),
            reach.speed
        ),
        _ => in_length(cx, asked, reach),
    };
    Some(Asked { share, words })
}

fn on_arc(cx: &PathCx<'_>, arc: &ArcMove) -> Option<Asked> {
    let machine = &cx.environment.machine.engine;
    let (asked, mode) = reach::feed(cx)?;
    if mode != FeedMode::PerMinute || reach::is_on_the_face(cx) || !reach::moves_as_written(cx) {
        return None;
    }
    let reach = reach::around(machine, arc)?;
    Some(Asked { share: reach.speed / asked, words: in_length(cx, asked, reach) })
}

fn in_length(cx: &PathCx<'_>, asked: f64, reach: Reach) -> String {
    format!(
        "the feed comes to {}/min, and {} {}/min at most",
        cx.shown(Mm(asked)),
        reach.holder.words(),
        cx.shown(Mm(reach.speed))
    )
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

    fn world_with_a_table() -> World<'static> {
        let mut world = World::of_examples(&META);
        world.machine.engine.dynamics.rotary_rapid = Some(3600.0);
        world
    }

    #[test]
    fn inverse_time_holds_the_rotary_axis_of_a_mixed_move() {
        for control in ["haas-mill", "fanuc-mill", "linuxcnc"] {
            check_rule_in(
                &RULE,
                control,
                "G21 G90 G94 G0 X0. Y0. Z5. A0.\nG93 G1 X22. A360. F60.\nX0. A0. F8.\nM30\n",
                &world_with_a_table(),
                &expect![[r#"
                    2 | G93 G1 X22. A360. F60.
                      | ^^^^^^^^^^^^^^^^^^^^^^ hint[feed-not-reached] the feed asks A for 21600 deg/min, and A turns 3600 deg/min at most
                "#]],
            );
        }
    }

    #[test]
    fn a_feed_a_minute_counts_as_the_manual_says() {
        let program = "G21 G90 G94 G0 X0. Y0. Z5. A0.\nG1 X22. A360. F800.\nA0. F9000.\nA100. F3000.\nM30\n";
        check_rule_in(
            &RULE,
            "linuxcnc",
            program,
            &world_with_a_table(),
            &expect![[r#"
            2 | G1 X22. A360. F800.
              | ^^^^^^^^^^^^^^^^^^^ hint[feed-not-reached] the feed asks A for 13091 deg/min, and A turns 3600 deg/min at most
            3 | A0. F9000.
              | ^^^^^^^^^^ hint[feed-not-reached] the feed asks A for 9000 deg/min, and A turns 3600 deg/min at most
        "#]],
        );
        check_rule_in(
            &RULE,
            "fanuc-mill",
            program,
            &world_with_a_table(),
            &expect![[r#"
            3 | A0. F9000.
              | ^^^^^^^^^^ hint[feed-not-reached] the feed asks A for 9000 deg/min, and A turns 3600 deg/min at most
        "#]],
        );
        check_rule_in(&RULE, "haas-mill", program, &world_with_a_table(), &expect![[""]]);
    }

    #[test]
    fn degrees_are_degrees_in_an_inch_program() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G20 G90 G94 G0 X0. Y0. Z5. A0.\nG1 A100. F3000.\nA0. F9000.\nM30\n",
            &world_with_a_table(),
            &expect![[r#"
                3 | A0. F9000.
                  | ^^^^^^^^^^ hint[feed-not-reached] the feed asks A for 9000 deg/min, and A turns 3600 deg/min at most
            "#]],
        );
    }

    #[test]
    fn near_the_pole_the_tip_asks_for_more_than_the_table_turns() {
        let mut world = world_with_a_table();
        world.machine.engine.axes = Some(vec![Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C]);
        check_rule_in(
            &RULE,
            "haas-mill",
            "G21 G90 G94\nG234 H1 X0. Y0. Z10. B1. C0.\nG1 X1. B0.05 C0. F1000.\nX1.5 B.02 C45.\nM30\n",
            &world,
            &expect![[r#"
                4 | X1.5 B.02 C45.
                  | ^^^^^^^^^^^^^^ hint[feed-not-reached] the feed asks C for 90000 deg/min, and C turns 3600 deg/min at most
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
