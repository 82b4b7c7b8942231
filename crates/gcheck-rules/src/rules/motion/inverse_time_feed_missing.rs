//! A cut under inverse-time feed without a feed of its own.

use std::collections::BTreeSet;

use gcheck_engine::{At, Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// Inverse-time feed (`G93`) is active, and a cutting block has no `F`.
    ///
    /// ## Why it matters
    /// Under `G93` an `F` gives the time of its own block, so it does not last. The control stops with an alarm; if a
    /// control kept the word, it would cut a long move in the time of a short one.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G93 G1 X10 F2
    /// X20
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G93 G1 X10 F2
    /// X20 F2
    /// G0 X0
    /// G94 G1 X10 F200
    /// X20
    /// M2
    /// ```
    rule "inverse-time-feed-missing" in "motion" {
        summary: "cut under inverse-time feed without a feed of its own",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(InverseTimeFeedMissing::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct InverseTimeFeedMissing {
    /// Blocks that chose inverse time: the first cut without feed stands for all after it.
    told: BTreeSet<Option<At>>,
}

remembers!(InverseTimeFeedMissing: told);

impl PathRule for InverseTimeFeedMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let fact = Fact::Mode(Role::FeedMode);
        if *fault != Fault::NoInverseTimeFeed || !self.told.insert(cx.definitions().set_by(fact)) {
            return;
        }
        let Some(code) = cx.state().mode(Role::FeedMode).only().and_then(|ix| cx.control().code_at(ix))
        else {
            return;
        };
        let (name, entry) = (code.number(), code.entry());
        let finding = cx
            .finding(
                &META,
                cx.range(),
                format!("cut without a feed of its own under inverse time (`{name}`)"),
            )
            .label("`F` is missing")
            .note(format!(
                "under `{name}` ({}) every cutting block needs its own `F`  [{}]",
                entry.title, entry.source
            ))
            .help("give `F` in every block, or go back to feed per minute (`G94`)")
            .at_most(limit(entry.confidence));
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_block_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G93 G1 X1. F2.\nX2.\nX3.\nG94 G1 X4. F10.\nG93 X5.\nM30\n",
            &expect![[r#"
                2 | X2.
                  | ^^^ error[inverse-time-feed-missing] cut without a feed of its own under inverse time (`G93`)
                5 | G93 X5.
                  | ^^^^^^^ error[inverse-time-feed-missing] cut without a feed of its own under inverse time (`G93`)
            "#]],
        );
    }

    #[test]
    fn arcs_need_a_feed_too() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G90 G0 X0 Y0\nG93 G2 X10 I5 F2\nG2 X20 I5\nM2\n",
            &expect![[r#"
            3 | G2 X20 I5
              | ^^^^^^^^^ error[inverse-time-feed-missing] cut without a feed of its own under inverse time (`G93`)
        "#]],
        );
    }
}
