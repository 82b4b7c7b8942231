//! A cut at a feed of zero.

use std::collections::BTreeSet;

use gcheck_engine::{At, Event, Fault, FeedMode};

use crate::declare::declare_rule;
use crate::facts::feed::zero_feed_given;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts, and the last feed is zero.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or the tool dwells in the part with the spindle turning.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G54 S1000 M3
    /// G1 X10. F0
    /// M2
    /// ```
    /// ```nc,reported,haas-mill
    /// G20
    /// #1 = 0
    /// G1 X1. F[#1 * 2]
    /// M30
    /// ```
    /// ## Not reported
    /// The value is unknown.
    /// ```nc,quiet,haas-mill
    /// G1 X1. F#100
    /// M30
    /// ```
    rule "feed-zero" in "motion" {
        summary: "cut at a feed of zero",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS.union(Watch::CUTS), make: || Box::new(FeedZero::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct FeedZero {
    /// Blocks that gave the feed of zero: one finding for each.
    told: BTreeSet<At>,
}

remembers!(FeedZero: told);

impl PathRule for FeedZero {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        // A control with a slowest move of inverse time makes that of a feed of zero.
        let takes_zero = cx.model.semantics().least_inverse_feed > 0.0
            && cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime);
        if !takes_zero || cx.known_number('F') != Some(0.0) {
            return;
        }
        if self.told.insert(cx.origin().at) {
            report.add(
                cx.finding(&META, cx.letter_range('F'), "inverse time feed of zero (`F`)")
                    .label("the control takes its slowest feed: the move lasts minutes")
                    .help("give a feed above zero")
                    .at_most(Severity::Warning),
            );
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::NoFeed {
            return;
        }
        let Some(at) = zero_feed_given(cx) else { return };
        if !self.told.insert(at) {
            return;
        }
        let here = at == cx.origin().at;
        let range = if here { cx.letter_range('F') } else { cx.range() };
        let mut finding = cx
            .finding(&META, range, "cut at a feed of zero (`F`)")
            .label("the tool does not move at this feed")
            .help("give a feed above zero");
        if !here && let Some(range) = cx.range_of(at) {
            finding = finding.also(range, "the feed was set here");
        }
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_or_the_first_cut_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20\nG1 X1. F0.\nX2.\nG1 X3. F5.\nF0\nG0 X4.\nG1 X5.\nX6.\nM30\n",
            &expect![[r#"
                2 | G1 X1. F0.
                  |        ^^^ error[feed-zero] cut at a feed of zero (`F`)
                7 | G1 X5.
                  | ^^^^^^ error[feed-zero] cut at a feed of zero (`F`)
            "#]],
        );
    }

    #[test]
    fn a_slowest_move_of_inverse_time() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G93\nG1 X1 F0\nG1 X2 F2\nM2\n",
            &expect![[r#"
                2 | G1 X1 F0
                  |       ^^ warning[feed-zero] inverse time feed of zero (`F`)
            "#]],
        );
    }

    #[test]
    fn a_feed_that_nobody_gave_is_judged_by_another_rule() {
        check_rule(&RULE, "linuxcnc", "G1 X1\nG95 G1 X2\nM2\n", &expect![[""]]);
    }
}
