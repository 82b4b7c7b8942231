//! A cut that some paths reach with a feed of another feed mode.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::feed::{goes_by_feed, meaning_of_feed};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts, and on some paths that come here its feed was given under another feed mode.
    ///
    /// ## Why it matters
    /// The program runs well until the other path is taken; then the same number is a feed per turn instead of per
    /// minute, or an inverse time. See `feed-of-another-mode`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 S2000 M3
    /// G1 X1. F300.
    /// IF [#100 EQ 1] GOTO10
    /// G93 G1 X10. A5. F40.
    /// N10 G94
    /// G1 X20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 S2000 M3
    /// G1 X1. F300.
    /// IF [#100 EQ 1] GOTO10
    /// G93 G1 X10. A5. F40.
    /// N10 G94 F300.
    /// G1 X20.
    /// M30
    /// ```
    rule "maybe-feed-of-another-mode" in "motion" {
        summary: "cut that some paths reach with a feed of another feed mode",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(MaybeFeedOfAnotherMode::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeFeedOfAnotherMode {
    /// The change of mode that was reported last.
    told: Option<At>,
}

remembers!(MaybeFeedOfAnotherMode: told);

impl PathRule for MaybeFeedOfAnotherMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let Some(now) = state.mode(Role::FeedMode).only() else { return };
        let Some(means) = meaning_of_feed(cx.model.effect(now)) else { return };
        let given = state.feed_given_under();
        if given.only().is_some() || cx.model.effect(now) == Effect::FeedInverseTime {
            return;
        }
        let other = given.alternatives().iter().find_map(|code| {
            let before = meaning_of_feed(cx.model.effect(*code)).filter(|before| *before != means)?;
            Some((*code, before))
        });
        if !goes_by_feed(event) || Abstract::known(state.feed()) == Some(0.0) {
            return;
        }
        let (Some((other, before)), Some(changed)) = (other, cx.trace().set_by(Fact::Mode(Role::FeedMode)))
        else {
            return;
        };
        if self.told.replace(changed) == Some(changed) {
            return;
        }
        let (name, from) = (cx.name_of(now), cx.name_of(other));
        let finding = cx
            .finding(&META, cx.range(), format!("the feed may have been given under another mode (`{from}`)"))
            .label(format!("a number that was given as {before} means {means} here"))
            .help(format!("give `F` again with `{name}`"));
        let finding = cx.resting_on(finding, Fact::Mode(Role::FeedMode), &format!("`{name}`"));
        report.add(cx.with_path(finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_cut_behind_the_meeting_is_marked() {
        check_rule(
            &RULE,
            "generic-mill",
            "G21 S900 M3\nG1 X1. F300.\nIF [#500 EQ 1] GOTO 10\nG95 G1 X2. F0.2\nN10 G94 G1 X3.\nX4.\nM30\n",
            &expect![[r#"
                5 | N10 G94 G1 X3.
                  | ^^^^^^^^^^^^^^ info[maybe-feed-of-another-mode] the feed may have been given under another mode (`G95`)
            "#]],
        );
    }

    #[test]
    fn mode_and_feed_that_change_together_are_one_choice() {
        check_rule(
            &RULE,
            "generic-mill",
            "G21 S900 M3\nG1 X1. F300.\nIF [#500 EQ 1] GOTO 10\nG95 G1 X2. F0.2\nN10 G1 X3.\nX4.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_block_delete_makes_two_programs_that_are_judged_apart() {
        check_rule(
            &RULE,
            "generic-mill",
            "G21 S900 M3\nG95 G1 X1. F0.3\n/G94 F300.\nG94 G1 X3.\nM30\n",
            &expect![[""]],
        );
    }
}
