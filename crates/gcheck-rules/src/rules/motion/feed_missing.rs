//! A cut before a feed is given.

use std::collections::BTreeSet;

use gcheck_controls::Letter;
use gcheck_engine::{At, Fact, Fault, FeedMode};

use crate::declare::declare_rule;
use crate::facts::earlier_rates::last_rate_of_tool;
use crate::facts::feed::{is_probing_motion, zero_feed_given};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts while no feed is in effect: no earlier block on this path gives `F`, or a change of the feed mode
    /// cleared it.
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
    /// G95 F0.1 X15.
    /// G94
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
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(FeedMissing::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct FeedMissing {
    /// What left the blocks reported without feed: one finding for each.
    causes: BTreeSet<Option<At>>,
}

remembers!(FeedMissing: causes);

impl PathRule for FeedMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let inverse_time = cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime);
        if *fault != Fault::NoFeed || inverse_time || is_probing_motion(cx) || zero_feed_given(cx).is_some() {
            return;
        }
        let cause = cx.definitions().set_by(Fact::Feed);
        // A called program has the feed of its caller.
        if cause.is_none() && cx.is_called_only() || !self.causes.insert(cause) {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), "cut without a feed (`F`)")
            .label("no feed is in effect here")
            .note("a cutting move needs a feed; every control of this family stops with an alarm without one")
            .help("give `F` in this block or before it");
        if let Some(range) = cause.and_then(|at| cx.range_of(at)) {
            // LinuxCNC forgets the feed when its meaning changes.
            finding = finding.also(range, "this clears the feed: the meaning of `F` changes here");
        }
        if cause.is_none() && !cx.environment.control_is_chosen() {
            finding = finding.at_most(Severity::Warning);
        }
        report.add(finding.fix_if(last_rate_of_tool(cx, Letter::of('F'), cx.origin().at)));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{check_rule, fixes_of};

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
    fn the_last_feed_of_the_tool_in_this_mode_is_offered() {
        let fixed = |program: &str| fixes_of(&RULE, "linuxcnc", program);
        let program =
            "G21 G94\nT1 M6\nF300 G1 X1\nT2 M6\nF500 X2\nG95 F0.1 X3\nT1 M6\nG94\nG1 X4 (cut)\nM2\n";
        assert_eq!(fixed(program), program.replace("X4 (cut)", "X4 F300 (cut)"));
        assert_eq!(
            fixed("G94F100G1X1\nG95F.1X2\nG94\nG1X3\nM2\n"),
            "G94F100G1X1\nG95F.1X2\nG94\nG1X3F100\nM2\n"
        );
    }

    #[test]
    fn where_no_feed_is_known_none_is_offered() {
        for program in [
            "G21 G94\nG1 X1\nX2 F100\nM2\n",
            "G94 F100 G1 X10\nG95\nG1 X20\nM2\n",
            // Of another tool, in other units, and computed.
            "G94\nT1 M6\nF100 G1 X1\nG95 F.1 X2\nT2 M6\nG94\nX3\nM2\n",
            "G20 G94\nF10 G1 X1\nG95 F.1 X2\nG21 G94\nX3\nM2\n",
            "G94 F100 G1 X1\nF#1 X2\nG95 F.1 X3\nG94\nX4\nM2\n",
        ] {
            assert_eq!(fixes_of(&RULE, "linuxcnc", program), program, "{program}");
        }
    }

    #[test]
    fn a_feed_in_a_subprogram_counts() {
        check_rule(&RULE, "haas-mill", "M97 P10\nG1 X2.\nM30\nN10 F10.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn one_finding_for_each_loss_of_the_feed() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G1 X1\nX2\nF100 X3\nG95 G1 X4 F0.1\nG94\nX5\nX6\nM2\n",
            &expect![[r#"
                1 | G1 X1
                  | ^^^^^ error[feed-missing] cut without a feed (`F`)
                6 | X5
                  | ^^ error[feed-missing] cut without a feed (`F`)
            "#]],
        );
    }

    #[test]
    fn a_subprogram_alone_takes_the_feed_of_its_caller() {
        check_rule(&RULE, "haas-mill", "O100\nG1 X1.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_feed_of_unknown_value_is_a_feed() {
        check_rule(&RULE, "haas-mill", "G1 X2. F#100\nM30\n", &expect![[""]]);
    }
}
