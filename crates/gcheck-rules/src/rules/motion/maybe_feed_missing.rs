//! A cut that some paths reach without a feed.

use std::collections::BTreeSet;

use gcheck_engine::{AbstractValue, At, Event, Fact, FeedMode};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts, and on some paths that come here no feed is in effect.
    ///
    /// ## Why it matters
    /// The program runs well until the other path is taken; then the control stops with an alarm, with the tool at the
    /// part.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20
    /// IF [#100 EQ 1] GOTO10
    /// G1 X1. F10.
    /// N10 G1 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 F10.
    /// IF [#100 EQ 1] GOTO10
    /// G1 X1. F20.
    /// N10 G1 X2.
    /// M30
    /// ```
    rule "maybe-feed-missing" in "motion" {
        summary: "cut that some paths reach without a feed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(MaybeFeedMissing::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeFeedMissing {
    /// Blocks that gave the feed on the other path: one finding for each.
    told: BTreeSet<At>,
}

remembers!(MaybeFeedMissing: told);

impl PathRule for MaybeFeedMissing {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let AbstractValue::Set(feeds) = cx.state().feed() else { return };
        let may_be_none = feeds.numbers().iter().any(|feed| feed.abs() <= 0.0);
        if !may_be_none || cx.state().feed_mode(cx.model) == Some(FeedMode::InverseTime) {
            return;
        }
        let Some(at) = cx.definitions().set_by(Fact::Feed).filter(|at| *at != cx.origin().at) else { return };
        // A computed feed may be zero for other reasons.
        if !is_plain(cx, at) || !self.told.insert(at) {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), "cut that may be without a feed (`F`)")
            .label("on some paths no feed is in effect here")
            .help("give `F` after the paths have joined, or before they separate");
        if let Some(range) = cx.range_of(at) {
            finding = finding.also(range, "the other path has its feed from here");
        }
        report.add(cx.with_path(finding));
    }
}

/// Is the block's `F` written as a number?
fn is_plain(cx: &PathCx<'_>, at: At) -> bool {
    let Some(place) = cx.place_of(at) else { return false };
    let f = gcheck_controls::Letter::of('F');
    place.table.words(place.block()).iter().any(|word| word.letter == f && word.number().is_some())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_first_cut_behind_the_meeting_of_the_paths_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21\nIF [#500 EQ 1] THEN #1=5\nIF [#500 EQ 2] GOTO 10\nF100.\nN10 G1 X1.\nX2.\nG1 Y2. F50.\nX3.\nM30\n",
            &expect![[r#"
                5 | N10 G1 X1.
                  | ^^^^^^^^^^ warning[maybe-feed-missing] cut that may be without a feed (`F`)
            "#]],
        );
    }

    #[test]
    fn words_show_the_path() {
        let program = "G21\nIF [#500 EQ 2] GOTO 10\nF100.\nN10 G1 X1.\nM30\n";
        let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
        expect![[r#"
            cut that may be without a feed (`F`)
              here: on some paths no feed is in effect here
              there: the other path has its feed from here
              there: when this is taken
              help: give `F` after the paths have joined, or before they separate
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn a_computed_feed_is_not_judged() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21\n#1=0\nIF [#500 EQ 2] THEN #1=50.\nG1 X1. F#1\nM30\n",
            &expect![[""]],
        );
    }
}
