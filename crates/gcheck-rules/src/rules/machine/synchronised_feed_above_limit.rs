//! A feed that the spindle drives, above what the machine's axes reach.

use std::collections::BTreeSet;

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, FeedMode, Position, TravelKind, Truth};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::facts::cutting::is_thread;
use crate::facts::reach::{self, Reach};
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A thread, a tap or a feed per turn asks for more than the machine's highest feed (`[machine] max_feed`), or than the
    /// rapid rate of an axis that moves.
    ///
    /// The speed of the axes is the lead, or the feed per turn, times the speed of the spindle. Under constant surface speed it
    /// is highest where the tool is nearest to the centre. A speed of the spindle above `max_rpm` counts as `max_rpm`.
    ///
    /// ## Why it matters
    /// Axes that cannot follow the spindle spoil the thread, or the control stops with an alarm. With a feed per turn the
    /// control runs slower than the program says, and each tooth cuts less. Often `S` is a digit too high, or a feed per
    /// minute follows a code for a feed per turn.
    ///
    /// ## Reported
    /// On a machine with 10,000 mm a minute:
    /// ```nc,reported,linuxcnc
    /// G21 G90 G97 S3000 M3
    /// G0 X0 Z5
    /// G33 Z-30 K6
    /// M2
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G21 G90 S8000 M3
    /// G0 X0.
    /// G95 G1 X100. F4.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G97 S1000 M3
    /// G0 X0 Z5
    /// G33 Z-30 K6
    /// M2
    /// ```
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 S8000 M3
    /// G0 X0.
    /// G95 G1 X100. F.4
    /// M30
    /// ```
    /// ## How to fix it
    /// * Turn slower: the finding gives the highest speed at which the axes follow.
    /// * Look for a feed per minute after a code for a feed per turn.
    /// * If the machine is faster, correct `max_feed` or `rapid` under `[machine]`.
    rule "synchronised-feed-above-limit" in "machine" {
        summary: "thread, tap or feed per turn above what the axes reach",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::MOVES.union(Watch::CHANGES),
            make: || Box::new(SynchronisedFeedAboveLimit::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct SynchronisedFeedAboveLimit {
    /// Millimetres a turn that the axes are tied to the spindle with.
    lead: Option<f64>,
    /// The blocks whose speed, or feed, was reported.
    told: BTreeSet<Option<At>>,
}

remembers!(SynchronisedFeedAboveLimit: told);

/// A move as the spindle drives it.
struct Driven {
    /// As messages name it.
    what: &'static str,
    /// Millimetres a turn.
    lead: f64,
    from: Position,
    to: Position,
    /// A path that is not straight is held to the highest feed alone.
    is_straight: bool,
}

impl PathRule for SynchronisedFeedAboveLimit {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        let machine = &program.environment.machine.engine;
        let is_held =
            machine.max_feed.is_some() || machine.rapid.is_some() || !machine.dynamics.rapid.is_empty();
        is_held && program.may(|effect| is_thread(effect) || is_tied(effect))
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::SpindleSync { lead, .. } => self.lead = lead.map(|lead| lead.0.abs()),
            // Blocks of other files are judged when those files are checked.
            Event::RigidTap { .. } if cx.origin().at.file == 0 => self.judge(cx, event, report),
            _ => {}
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.judge(cx, event, report);
    }
}

/// Does the code tie the feed to the turns of the spindle?
fn is_tied(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::FeedPerRevolution
            | Effect::CycleTap
            | Effect::CycleLeftTap
            | Effect::TapHere
            | Effect::LeftTapHere
    )
}

impl SynchronisedFeedAboveLimit {
    fn judge(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(driven) = self.driven(cx, event) else { return };
        let Some(turns) = reach::turns(cx, &driven.from, &driven.to) else { return };
        let machine = &cx.environment.machine.engine;
        let straight = reach::along(machine, &driven.from, &driven.to).filter(|_| driven.is_straight);
        let Some(reach) = reach::lower(reach::by_feed(machine), straight) else { return };
        let asked = driven.lead * turns;
        if asked <= reach.speed * (1.0 + 1e-6) || cx.is_called_only() {
            return;
        }
        let set_by =
            [Fact::Speed, Fact::Feed].map(|fact| cx.definitions().set_by(fact)).into_iter().max().flatten();
        if self.told.insert(set_by) {
            report.add(finding(cx, &driven, reach, asked, turns));
        }
    }

    fn driven(&self, cx: &PathCx<'_>, event: &Event) -> Option<Driven> {
        // Without a lead of its own a thread is cut at the feed, which is then a lead.
        let lead = || self.lead.or_else(|| Abstract::bounds(cx.state().feed()).map(|(lowest, _)| lowest));
        // Of a live tool the speed of the spindle tells nothing.
        let per_turn = || {
            let (feed, mode) = reach::feed(cx)?;
            (mode == FeedMode::PerRevolution && cx.state().live_tool() == Truth::False).then_some(feed)
        };
        let driven = |what, lead, from: &Position, to: &Position, is_straight| Driven {
            what,
            lead,
            from: *from,
            to: *to,
            is_straight,
        };
        Some(match event {
            Event::Travel(travel) if travel.kind == TravelKind::Thread => {
                driven("the thread", lead()?, &travel.from, &travel.to, true)
            }
            Event::RigidTap { from, to, .. } => driven("the tap", lead()?, from, to, true),
            Event::Travel(travel) if travel.kind == TravelKind::Feed => {
                driven("the feed per turn", per_turn()?, &travel.from, &travel.to, true)
            }
            Event::Arc(arc) => driven("the feed per turn", per_turn()?, &arc.from, &arc.to, false),
            _ => return None,
        })
    }
}

fn finding(cx: &PathCx<'_>, driven: &Driven, reach: Reach, asked: f64, turns: f64) -> crate::Finding {
    let lead = cx.shown(Mm(driven.lead));
    let finding = cx
        .finding(
            &META,
            cx.range(),
            format!(
                "{} asks for {}/min, and {} {}/min at most",
                driven.what,
                cx.shown(Mm(asked)),
                reach.holder.words(),
                cx.shown(Mm(reach.speed))
            ),
        )
        .label(format!("{turns:.0} rpm times {lead} a turn"))
        .help(format!(
            "turn at no more than {:.0} rpm, or correct the limits in the configuration",
            (reach.speed / driven.lead).floor()
        ));
    cx.resting_on(finding, Fact::Speed, "the speed")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn a_rigid_tap_is_a_thread() {
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G21 G90 S5000 M3\nG0 X0 Y0 Z5\nG33.1 Z-20 K3\nM2\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G33.1 Z-20 K3
                  | ^^^^^^^^^^^^^ warning[synchronised-feed-above-limit] the tap asks for 15000 mm/min, and the machine feeds 10000 mm/min at most
            "#]],
        );
    }

    #[test]
    fn surface_speed_is_fastest_at_the_smallest_diameter() {
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            "G21 G50 S6000\nG96 S300 M3\nG0 X50. Z2.\nG99 G1 X4. F2.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                4 | G99 G1 X4. F2.
                  | ^^^^^^^^^^^^^^ warning[synchronised-feed-above-limit] the feed per turn asks for 12000 mm/min, and the machine feeds 10000 mm/min at most
            "#]],
        );
    }

    #[test]
    fn one_speed_is_one_finding() {
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "G21 G90 S8000 M3\nG0 X0.\nG95 G1 X100. F4.\nX200.\nG2 X210. Y10. R10.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                3 | G95 G1 X100. F4.
                  | ^^^^^^^^^^^^^^^^ warning[synchronised-feed-above-limit] the feed per turn asks for 32000 mm/min, and the machine feeds 10000 mm/min at most
            "#]],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "linuxcnc", "G21 S3000 M3\nG0 X0 Z5\nG33 Z-30 K6\nM2\n", &expect![[""]]);
    }
}
