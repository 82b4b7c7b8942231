//! A probing move without a feed.

use std::collections::BTreeSet;

use gcheck_controls::{CodeIx, Letter, Need};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Fault, FeedMode, Role, TravelKind};

use crate::declare::declare_rule;
use crate::facts::feed::{is_probing_motion, zero_feed_given};
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A probing move begins while no feed is in effect, or under inverse-time feed.
    ///
    /// ## Why it matters
    /// The control stops with an alarm before the probe moves, or the probe moves at whatever feed is left from before,
    /// which can break it.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G38.2 Z-10
    /// M2
    /// ```
    /// ```nc,reported,fanuc-mill
    /// G90 G0 X0 Y0 Z1.
    /// G31 Z-1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G38.2 Z-10 F50
    /// M2
    /// ```
    rule "probe-without-feed" in "motion" {
        summary: "probing move without a feed",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FAULTS.union(Watch::CUTS),
            make: || Box::new(ProbeWithoutFeed::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ProbeWithoutFeed {
    /// The causes of the reported probing moves without feed: one finding for each.
    told: BTreeSet<Option<At>>,
}

remembers!(ProbeWithoutFeed: told);

impl PathRule for ProbeWithoutFeed {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::NoFeed || !is_probing_motion(cx) || zero_feed_given(cx).is_some() {
            return;
        }
        if cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime) {
            let finding =
                self::finding(cx, "probing move under inverse-time feed", "needs a feed per minute")
                    .help("go back to feed per minute (`G94`) before probing");
            report.add(cx.resting_on(finding, Fact::Mode(Role::FeedMode), "inverse time"));
            return;
        }
        let finding = self::finding(cx, "probing move without a feed (`F`)", "no feed is in effect here");
        self.tell(cx, finding, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Event::Travel(travel) = event else { return };
        let skips = matches!(travel.kind, TravelKind::Probe { skip: true, .. });
        // Another rule reports a code that needs `F` in its own block.
        let needs_feed = |code: &CodeIx| {
            cx.code_of(*code).is_some_and(|code| {
                code.entry().words.iter().any(|word| word.letter == "F" && word.need == Need::Required)
            })
        };
        if cx.codes().iter().any(needs_feed) && !cx.origin().letters.contains(Letter::of('F')) {
            return;
        }
        let none = Abstract::known(cx.state().feed()).is_some_and(|feed| feed.abs() <= 0.0);
        if skips && none && zero_feed_given(cx).is_none() {
            let finding = self::finding(cx, "probing move without a feed (`F`)", "no feed is in effect here")
                .at_most(Severity::Warning);
            self.tell(cx, finding, report);
        }
    }
}

impl ProbeWithoutFeed {
    fn tell(&mut self, cx: &PathCx<'_>, finding: Finding, report: &mut Report<'_>) {
        let cause = cx.definitions().set_by(Fact::Feed);
        // A called program has the feed of its caller.
        if !(cause.is_none() && cx.is_called_only()) && self.told.insert(cause) {
            report.add(finding.help("give `F` in this block or before it"));
        }
    }
}

fn finding(cx: &PathCx<'_>, message: &str, label: &str) -> Finding {
    cx.finding(&META, cx.range(), message).label(label)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_probing_move_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG38.2 Z-10\nG38.4 Z10\nG94 F10\nG38.2 Z-10\nM2\n",
            &expect![[r#"
                2 | G38.2 Z-10
                  | ^^^^^^^^^^ error[probe-without-feed] probing move without a feed (`F`)
            "#]],
        );
    }

    #[test]
    fn inverse_time_gives_no_speed_to_probe_at() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG93\nG38.2 Z-10 F5\nM2\n",
            &expect![[r#"
                3 | G38.2 Z-10 F5
                  | ^^^^^^^^^^^^^ error[probe-without-feed] probing move under inverse-time feed
            "#]],
        );
    }

    #[test]
    fn a_code_that_needs_its_own_feed_is_another_rules() {
        check_rule(&RULE, "haas-mill", "G90 G0 Z1.\nG31 Z-1.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_macro_that_is_called_has_its_callers_feed() {
        check_rule(&RULE, "fanuc-mill", "O9010\nG31 Z-10.\nM99\n", &expect![[""]]);
    }
}
