//! A feed above the configured limit of the machine.

use std::ops::Range;

use gcheck_controls::Letter;
use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, FeedMode, TravelKind};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::reach;
use crate::{Finding, PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A feed per minute (`F`) is above the configured highest feed of the machine.
    ///
    /// A feed for moves of rotary axes alone counts degrees: it is reported where a linear axis moves with it.
    ///
    /// ## Why it matters
    /// The control runs slower than the program says, or stops with an alarm. A feed ten times too high often is a missing
    /// decimal point, or a feed in millimetres in an inch program.
    ///
    /// ## Reported
    /// On a machine with 10,000 mm a minute:
    /// ```nc,reported,fanuc-mill
    /// G21
    /// G94 G1 X10. F12000.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21
    /// G94 G1 X10. F8000.
    /// M30
    /// ```
    /// ## How to fix it
    /// * Lower the feed; first look for a missing decimal point, and for a feed in millimetres in an inch program.
    /// * If the machine is faster, correct `max_feed` under `[machine]`.
    rule "feed-above-machine-limit" in "machine" {
        summary: "feed above the machine's limit",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::MOVES),
            make: || Box::new(FeedAboveMachineLimit::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct FeedAboveMachineLimit {
    /// A feed above the limit with which only rotary axes have moved: the block that gave it, and its word.
    turning: Option<(At, Range<u32>)>,
}

remembers!(FeedAboveMachineLimit: turning);

impl PathRule for FeedAboveMachineLimit {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.machine.engine.max_feed.is_some()
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let (Event::FeedRate(rate), Some(highest)) = (event, cx.environment.machine.engine.max_feed) else {
            return;
        };
        if cx.state().feed_mode(cx.model) != Some(FeedMode::PerMinute) {
            return;
        }
        // Of several possible feeds the lowest counts.
        let lowest = if rate.is_nan() {
            Abstract::bounds(cx.state().feed()).map(|(lowest, _)| lowest)
        } else {
            Some(*rate)
        };
        let Some(lowest) = lowest else { return };
        if lowest <= highest.0 * (1.0 + 1e-9) {
            return;
        }
        let range = cx.letter_range('F');
        let letters = cx.origin().letters;
        let names = |rotary: bool| {
            letters.iter().filter_map(|letter| moved_by(cx, letter)).any(|axis| axis.is_rotary() == rotary)
        };
        if names(true) && !names(false) && !reach::is_on_the_face(cx) {
            self.turning = Some((cx.origin().at, range));
            return;
        }
        self.turning = None;
        report.add(finding(cx, range, lowest, highest.0));
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some((at, range)) = self.turning.clone() else { return };
        let (Some(highest), Some((feed, mode))) = (cx.environment.machine.engine.max_feed, reach::feed(cx))
        else {
            return;
        };
        if cx.definitions().set_by(Fact::Feed) != Some(at) || mode != FeedMode::PerMinute {
            return;
        }
        let moves_linear = match event {
            Event::Travel(travel) if travel.kind == TravelKind::Feed => {
                reach::length(&travel.from, &travel.to).is_some()
                    && !reach::only_turns(&travel.from, &travel.to)
            }
            Event::Arc(_) => true,
            _ => false,
        };
        if moves_linear {
            self.turning = None;
            report.add(
                finding(cx, range, feed, highest.0).also(cx.range(), "a linear axis moves with it here"),
            );
        }
    }
}

/// The axis that an address moves: on lathes `H` moves C by an increment.
fn moved_by(cx: &PathCx<'_>, letter: Letter) -> Option<Axis> {
    let increments = &cx.model.semantics().increments;
    let of_increment = increments.get(&letter.to_string()).and_then(|axis| Letter::parse(axis));
    Axis::of(of_increment.unwrap_or(letter))
}

fn finding(cx: &PathCx<'_>, range: Range<u32>, feed: f64, highest: f64) -> Finding {
    let (feed, highest) = (cx.shown(Mm(feed)), cx.shown(Mm(highest)));
    cx.finding(&META, range, format!("feed of {feed}/min is above the machine's {highest}/min (`F`)"))
        .label("above the configured highest feed")
        .help("lower the feed, or correct the limit in the configuration")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn inches_are_compared_as_millimetres() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20\nG94 G1 X1. F500.\nG1 X2. F300.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | G94 G1 X1. F500.
                  |            ^^^^^ warning[feed-above-machine-limit] feed of 500 in/min is above the machine's 393.7008 in/min (`F`)
            "#]],
        );
    }

    #[test]
    fn degrees_are_no_millimetres() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G94 G0 X0. A0.\nG1 A90. F12000.\nA180.\nM30\n",
            &World::of_examples(&META),
            &expect![[""]],
        );
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G94 G0 X0. A0.\nG1 A90. F12000.\nA180.\nX10.\nX20.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | G1 A90. F12000.
                  |         ^^^^^^^ warning[feed-above-machine-limit] feed of 12000 mm/min is above the machine's 10000 mm/min (`F`)
            "#]],
        );
    }

    #[test]
    fn an_increment_of_a_rotary_axis_counts_degrees_too() {
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "G21 G98 G0 X10. Z0. C0.\nG1 H90. F12000.\nC0. F13000.\nW-1. F14000.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                4 | W-1. F14000.
                  |      ^^^^^^^ warning[feed-above-machine-limit] feed of 14000 mm/min is above the machine's 10000 mm/min (`F`)
            "#]],
        );
    }

    #[test]
    fn inverse_time_is_no_speed() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20\nG93 G1 X1. F90000.\nM30\n",
            &World::of_examples(&META),
            &expect![""],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "haas-mill", "G20 G94 G1 X1. F9000.\nM30\n", &expect![[""]]);
    }
}
