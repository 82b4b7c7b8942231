//! A cut at a feed that was given while `F` meant something else.

use gcheck_controls::Effect;
use gcheck_engine::{Abstract, Domain, Event, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::earlier_rates::last_rate_of_tool;
use crate::facts::feed::{goes_by_feed, meaning_of_feed};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The feed mode changed (`G93`, `G94`, `G95`; `G98`, `G99` on lathes), the program cuts, and no `F` was given since.
    ///
    /// ## Why it matters
    /// The number remains and gets a new meaning: a feed of 0.2 mm per turn becomes 0.2 mm per minute, an inverse time
    /// of 40 moves per minute becomes 40 mm per minute, 300 mm per minute becomes 300 mm per turn. Controls that clear
    /// the feed instead stop with an alarm; see `feed-missing`.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21 G90 G54 S2000 M3
    /// G94 G1 X5. F300.
    /// G93 G1 X10. A5. F40.
    /// G94
    /// G1 X20.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90 G54 S2000 M3
    /// G93 G1 X10. A5. F40.
    /// G94 F300.
    /// G1 X20.
    /// M30
    /// ```
    /// The feed was given under this mode, and nothing was cut under the other mode in between.
    /// ```nc,quiet,generic-mill
    /// G21 G90 G54 S2000 M3
    /// G94 G1 X10. F300.
    /// G95
    /// G94
    /// G1 X20.
    /// M30
    /// ```
    rule "feed-of-another-mode" in "motion" {
        summary: "cut at a feed that was given under another feed mode",
        severity: Warning,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(FeedOfAnotherMode::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct FeedOfAnotherMode {
    /// The change of mode that was reported last: what comes after it is its consequence.
    told: Option<gcheck_engine::At>,
}

remembers!(FeedOfAnotherMode: told);

impl PathRule for FeedOfAnotherMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let state = cx.state();
        let (Some(now), Some(given)) = (state.mode(Role::FeedMode).only(), state.feed_given_under().only())
        else {
            return;
        };
        let (Some(means), Some(before)) =
            (meaning_of_feed(cx.model.effect(now)), meaning_of_feed(cx.model.effect(given)))
        else {
            return;
        };
        // Under inverse time every cut has its own `F`; another rule reports a missing one.
        if means == before || cx.model.effect(now) == Effect::FeedInverseTime {
            return;
        }
        if !goes_by_feed(event) || Abstract::known(state.feed()) == Some(0.0) {
            return;
        }
        let (Some(changed), Some(at)) =
            (cx.definitions().set_by(Fact::Mode(Role::FeedMode)), cx.definitions().set_by(Fact::Feed))
        else {
            return;
        };
        if self.told.replace(changed) == Some(changed) {
            return;
        }
        let (now, given) = (cx.name_of(now), cx.name_of(given));
        let is_feed = |word: &gcheck_program::Word| word.letter == gcheck_controls::Letter::of('F');
        let feed = cx.find_word(at, is_feed);
        let mut finding = cx
            .finding(&META, cx.range(), format!("the feed was given under another feed mode (`{given}`)"))
            .label(format!("here the same number means {means} (`{now}`)"))
            .note("as far as is known, this control keeps the number of `F` when its meaning changes")
            .help(format!("give `F` again with `{now}`"));
        if let Some(range) = feed {
            finding = finding.also(range, format!("given as {before} (`{given}`)"));
        }
        finding = finding.fix_if(last_rate_of_tool(cx, gcheck_controls::Letter::of('F'), cx.origin().at));
        report.add(cx.resting_on(finding, Fact::Mode(Role::FeedMode), &format!("`{now}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn each_change_is_reported_once() {
        check_rule(
            &RULE,
            "generic-mill",
            "G21 G90 S900 M3\nG1 X1. F300.\nG95\nX2.\nX3.\nG94\nX4.\nG95 X5. F0.2\nG94 G0 X9.\nG2 X5. R2.\nM30\n",
            &expect![[r#"
                4 | X2.
                  | ^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G94`)
                10 | G2 X5. R2.
                   | ^^^^^^^^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G95`)
            "#]],
        );
    }

    #[test]
    fn lathes_have_codes_of_their_own() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G21 G97 S900 M3\nG99 G1 X10. F0.2\nG98\nG1 X20.\nM30\n",
            &expect![[r#"
                4 | G1 X20.
                  | ^^^^^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G99`)
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G97 S900 M3\nG1 X10. F0.2\nG98 G1 X20. F100.\nG1 G99 X30.\nM30\n",
            &expect![[r#"
                4 | G1 G99 X30.
                  | ^^^^^^^^^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G98`)
            "#]],
        );
    }

    #[test]
    fn the_mode_at_the_start_is_the_controls() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 S900 M3\nF100.\nG95\nG1 X1.\nM30\n",
            &expect![[r#"
            4 | G1 X1.
              | ^^^^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G94`)
        "#]],
        );
    }

    #[test]
    fn a_control_that_forgets_the_feed_has_none_of_another_mode() {
        check_rule(&RULE, "linuxcnc", "G21 S900 M3\nG93 G1 X1 F2\nG94\nG1 X2\nM2\n", &expect![[""]]);
    }

    #[test]
    fn a_computed_feed_counts_as_any_other() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 S900 M3\nG93 G1 X1. F#100\nG94\nG1 X2.\nM30\n",
            &expect![[r#"
                4 | G1 X2.
                  | ^^^^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G93`)
            "#]],
        );
    }

    #[test]
    fn modes_and_feeds_of_subprograms_count() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 S900 M3\nG93\nM97 P10\nG94\nM97 P10\nG1 X9.\nM30\nN10 G1 X1. F9.\nM99\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G21 S900 M3\nG93 G1 X1. F9.\nM97 P10\nG1 X9.\nM30\nN10 G94\nM99\n",
            &expect![[r#"
                4 | G1 X9.
                  | ^^^^^^ warning[feed-of-another-mode] the feed was given under another feed mode (`G93`)
            "#]],
        );
    }

    #[test]
    fn a_program_that_is_not_at_hand_may_have_given_one() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 S900 M3\nG93 G1 X1. F9.\nG94\nM98 P7000\nG1 X2.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn threads_and_taps_have_their_lead() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 S900 M3\nG98 G1 X1. F100.\nG99\nG32 Z-10. F1.5\nG1 X5. F0.1\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn words_say_what_the_number_counts() {
        let program = "G21 S900 M3\nG93 G1 X1. F40.\nG94\nG1 X2.\nM30\n";
        let found = findings(&only(&RULE), "haas-mill", program, &World::default());
        expect![[r#"
            the feed was given under another feed mode (`G93`)
              here: here the same number means a length per minute (`G94`)
              there: given as moves per minute (`G93`)
              there: `G94` set here
              note: as far as is known, this control keeps the number of `F` when its meaning changes
              help: give `F` again with `G94`
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
