//! Segments that come faster than the control prepares blocks.

use gcheck_engine::{Abstract, At, Axis, Domain, Event, Fact, FeedMode, Position, TravelKind};
use gcheck_geometry::{Mm, MmPerMin, Seconds};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// Short moves at a feed at which each takes less time than the control needs to prepare a block, until nothing is
    /// prepared ahead any more.
    ///
    /// Only `[machine] block_time` tells how long the control takes; without it the rule says nothing. It prepares as many
    /// blocks ahead as it looks ahead (`[machine] look_ahead`, or what gcheck knows of the control), so that a few short
    /// moves do no harm.
    ///
    /// ## Why it matters
    /// The axes wait for blocks: the feed is not reached, it varies from block to block, and the surface shows it.
    ///
    /// ## Reported
    /// On a machine whose control takes 0.01 s for a block and prepares two ahead:
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G94
    /// G0 X0. Y0.
    /// G1 X0.1 F6000.
    /// X0.2
    /// X0.3
    /// X0.4
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G94
    /// G0 X0. Y0.
    /// G1 X0.1 F300.
    /// X0.2
    /// X0.3
    /// X0.4
    /// M30
    /// ```
    /// ## How to fix it
    /// * Post longer segments: a wider tolerance in CAM, or arcs in place of short lines.
    /// * Or lower the feed.
    /// * If the control prepares blocks faster, correct `block_time` or `look_ahead` under `[machine]`.
    rule "data-starved" in "machine" {
        summary: "segments come faster than the control prepares blocks",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(DataStarved::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct DataStarved {
    /// How much less is prepared ahead than could be.
    late: Seconds,
    /// The moves since everything was prepared that could be.
    moves: u32,
    length: Mm,
    seconds: Seconds,
    /// The block that set the feed of the last finding.
    told: Option<At>,
}

remembers!(DataStarved: told);

impl PathRule for DataStarved {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.machine.engine.dynamics.block_time.is_some()
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let dynamics = &cx.environment.machine.engine.dynamics;
        let Some(block_time) = dynamics.block_time else { return };
        let look_ahead = dynamics.look_ahead.unwrap_or(cx.control().motion().look_ahead);
        let full = block_time * f64::from(look_ahead);
        let Some((length, seconds)) = move_at_feed(cx, event) else {
            self.prepare_all();
            return;
        };
        self.late = self.late + block_time - seconds;
        if self.late <= Seconds::ZERO {
            self.prepare_all();
            return;
        }
        self.moves += 1;
        self.length += length;
        self.seconds += seconds;
        let set_by = cx.definitions().set_by(Fact::Feed);
        if self.late <= full || (self.told.is_some() && self.told == set_by) {
            return;
        }
        self.told = set_by;
        let moves = f64::from(self.moves);
        let reached = self.length.0 / moves / block_time.0 * 60.0;
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!(
                    "data starved: {:.0} blocks/s, and the control prepares {:.0}",
                    moves / self.seconds.0,
                    1.0 / block_time.0
                ),
            )
            .label(format!(
                "the last {} moves are {} long on average: no more than {}/min is reached",
                self.moves,
                cx.shown(Mm(self.length.0 / moves)),
                cx.shown(Mm(reached))
            ))
            .help("post longer segments (a wider tolerance, arcs), or lower the feed");
        report.add(cx.resting_on(finding, Fact::Feed, "the feed"));
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        // The axes do not move, and the control goes on reading.
        if matches!(event, Event::Dwell(_) | Event::ToolChange(_) | Event::Stop(_)) {
            self.prepare_all();
        }
    }
}

impl DataStarved {
    fn prepare_all(&mut self) {
        *self = Self { told: self.told, ..Self::default() };
    }
}

/// Length and time of a block's own move at a feed a minute, where both are known.
fn move_at_feed(cx: &PathCx<'_>, event: &Event) -> Option<(Mm, Seconds)> {
    let way = |from: &Position, to: &Position| {
        let part = |axis: Axis| match (from.get(axis), to.get(axis)) {
            (Some(from), Some(to)) => Some(to - from),
            // An axis that has not moved yet, and does not move here.
            (None, None) => Some(0.0),
            _ => None,
        };
        Some(part(Axis::X)?.hypot(part(Axis::Y)?).hypot(part(Axis::Z)?))
    };
    let length = match event {
        Event::Travel(travel) if travel.kind == TravelKind::Feed && !travel.expanded => {
            way(&travel.from, &travel.to)?
        }
        // At least: a helix is longer.
        Event::Arc(arc) if !arc.expanded => {
            let (first, second, _) = arc.plane.axes();
            let from = arc.from.values();
            let dx = from.get(first)? - arc.centre.0.0;
            let dy = from.get(second)? - arc.centre.1.0;
            dx.hypot(dy) * arc.sweep.abs()
        }
        _ => return None,
    };
    if cx.state().feed_mode(cx.model) != Some(FeedMode::PerMinute) {
        return None;
    }
    // A feed that is one of several is at least the lowest: the moves take no longer than with that.
    let (lowest, _) = Abstract::bounds(cx.state().feed())?;
    (lowest > 0.0 && length > 0.0).then_some((Mm(length), Mm(length) / MmPerMin(lowest)))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn long_moves_in_between_let_the_control_prepare_ahead() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G90 G94\nG0 X0.\nG1 X0.1 F6000.\nX0.2\nX20.\nX20.1\nX20.2\nM30\n",
            &World::of_examples(&META),
            &expect![""],
        );
    }

    #[test]
    fn one_feed_is_one_finding() {
        let short =
            |x: f64| (0..8).map(|ix| format!("X{:.1}\n", x + f64::from(ix) * 0.1)).collect::<String>();
        let program = format!("G21 G90 G94\nG1 F6000. X0.\n{}G4 P100\n{}M30\n", short(0.1), short(0.9));
        check_rule_in(
            &RULE,
            "fanuc-mill",
            &program,
            &World::of_examples(&META),
            &expect![[r#"
                5 | X0.3
                  | ^^^^ info[data-starved] data starved: 1000 blocks/s, and the control prepares 100
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        let program = "G21 G90 G94\nG0 X0.\nG1 X0.1 F6000.\nX0.2\nX0.3\nX0.4\nX0.5\nM30\n";
        check_rule(&RULE, "fanuc-mill", program, &expect![""]);
    }
}
