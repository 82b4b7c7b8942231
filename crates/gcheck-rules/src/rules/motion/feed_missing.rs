//! A cut before any feed was given.

use gcheck_engine::{Fact, Fault, FeedMode};

use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A block cuts while no feed is in effect: no `F` was given on the way here, or a change of the feed mode took it away.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the first cut, with the tool at the part.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G54
    /// S1000 M3
    /// G1 X10.
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// G94 F100 G1 X10.
    /// G95
    /// G1 X20.
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. Y1.
    /// G1 Z-.1 F10.
    /// X2.
    /// M30
    /// ```
    rule "feed-missing" in "motion" {
        summary: "cut without a feed",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(FeedMissing) },
    }
}

struct FeedMissing;

impl PathRule for FeedMissing {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::NoFeed || cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime) {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), "cut without a feed (`F`)")
            .label("no feed is in effect here")
            .note("a cutting move needs a feed; every control of this family stops with an alarm without one")
            .help("give `F` in this block or before it");
        if let Some(at) = cx.trace().set_by(Fact::Feed)
            && let Some(range) = cx.range_of(at)
        {
            // LinuxCNC forgets the feed when its meaning changes.
            finding = finding.also(range, "the feed was last set here, and taken away or zero since");
        }
        if cx.trace().set_by(Fact::Feed).is_none() && cx.scene.control_is_guessed {
            finding = finding.at_most(Severity::Warning);
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
    fn the_first_cut_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1.\nG1 X2.\nX3. F5.\nM30\n",
            &expect![[r#"
                2 | G1 X2.
                  | ^^^^^^ error[feed-missing] cut without a feed (`F`)
            "#]],
        );
    }

    #[test]
    fn a_feed_in_a_subprogram_counts() {
        check_rule(&RULE, "haas-mill", "M97 P10\nG1 X2.\nM30\nN10 F10.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_feed_of_unknown_value_is_a_feed() {
        check_rule(&RULE, "haas-mill", "G1 X2. F#100\nM30\n", &expect![[""]]);
    }
}
