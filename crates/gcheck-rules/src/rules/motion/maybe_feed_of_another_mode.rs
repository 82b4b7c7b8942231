//! A cut that some paths reach with a feed of another feed mode.

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Role};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::feed::{goes_by_feed, meaning_of_feed};
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts, and on some paths that come here its feed was given under another feed mode; or the feed mode itself
    /// depends on the path, while the number of `F` does not.
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
    /// ```nc,reported,fanuc-mill
    /// G21 G90 G54 S1200 M3
    /// G94 G1 X1. F200.
    /// IF [#500 EQ 1] GOTO 10
    /// G95
    /// N10 G1 X40.
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
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(MaybeFeedOfAnotherMode::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct MaybeFeedOfAnotherMode {
    /// The change of mode that was reported last.
    told: Option<At>,
    /// The feed that was reported last under a mode that is not known.
    unsure: Option<At>,
}

remembers!(MaybeFeedOfAnotherMode: told, unsure);

impl PathRule for MaybeFeedOfAnotherMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let Some(now) = state.mode(Role::FeedMode).only() else {
            self.under_several(cx, event, report);
            return;
        };
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
        let (Some((other, before)), Some(changed)) =
            (other, cx.definitions().set_by(Fact::Mode(Role::FeedMode)))
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
        report.add(cx.with_path(finding.at_most(Severity::Info)));
    }
}

impl MaybeFeedOfAnotherMode {
    /// One number of `F`, and a mode that depends on the path.
    fn under_several(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        // Where the number depends on the path too, mode and number may have been chosen together.
        let is_one = Abstract::known(state.feed_word()).is_some_and(|feed| feed > 0.0);
        let (true, true, Some(given)) = (is_one, goes_by_feed(event), cx.definitions().set_by(Fact::Feed))
        else {
            return;
        };
        let modes = state.mode(Role::FeedMode).alternatives();
        let means = |code: &CodeIx| Some((*code, meaning_of_feed(cx.model.effect(*code))?));
        let mut readings = modes.iter().filter_map(means);
        let Some((first, meaning)) = readings.next() else { return };
        let Some((second, other)) = readings.find(|(_, other)| *other != meaning) else { return };
        // Under inverse time every cut has its own `F`.
        let is_inverse = |code: CodeIx| cx.model.effect(code) == Effect::FeedInverseTime;
        if is_inverse(first) || is_inverse(second) || self.unsure.replace(given) == Some(given) {
            return;
        }
        let (first, second) = (cx.name_of(first), cx.name_of(second));
        let is_feed = |word: &Word| word.letter == Letter::of('F');
        let mut finding = cx
            .finding(
                &META,
                cx.range(),
                format!("the feed mode depends on the path, and `F` does not (`{first}`, `{second}`)"),
            )
            .label(format!("the same number means {meaning} on one path and {other} on another"))
            .help(format!(
                "choose the feed mode on every path: write `{first}` or `{second}` with `F` in this block"
            ));
        if given != cx.origin().at
            && let Some(range) = cx.find_word(given, is_feed)
        {
            finding = finding.also(range, "`F` given here");
        }
        report.add(cx.with_path(finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only};

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
    fn one_number_under_a_mode_that_some_paths_change() {
        for (program, line) in [
            (
                "G21 S900 M3\nG94 G1 X1. F300.\nIF [#500 EQ 1] GOTO 10\nG95\nN10 G1 X3.\nX4.\nM30\n",
                "N10 G1 X3.",
            ),
            (
                "G21 S900 M3\nG95 G1 X1. F0.2\nIF [#500 EQ 1] GOTO 10\nG94\nN10 G1 X3. F200.\nX4.\nM30\n",
                "N10 G1 X3. F200.",
            ),
        ] {
            let found = findings(&only(&RULE), "fanuc-mill", program, &World::default());
            let at = found.iter().map(|one| &program[one.range.start as usize..one.range.end as usize]);
            assert_eq!(at.collect::<Vec<_>>(), [line], "{program}");
            assert!(found.iter().all(|one| one.severity == crate::Severity::Warning));
        }
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 S900 M3\nG95 G1 X1. F0.2\nIF [#500 EQ 1] GOTO 10\nG94\nN10 G94 G1 X3. F200.\nX4.\nM30\n",
            &expect![[""]],
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
