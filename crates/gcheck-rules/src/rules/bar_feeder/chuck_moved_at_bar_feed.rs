//! The chuck opened or closed by hand around a bar feed.

use gcheck_controls::Effect;
use gcheck_engine::{Event, Fact, Truth};

use crate::declare::declare_rule;
use crate::facts::bar_feed::{bar_feed_range, bar_feeder, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The program opens the chuck before a bar feed (`M11`), or closes it after one (`M10`): the feed does both
    /// itself.
    ///
    /// ## Why it matters
    /// A chuck that is open before the feeder holds the bar lets it slip, and the bar is no longer where the feeder knows it.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// M5
    /// M11
    /// G105 J1.75
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    rule "chuck-moved-at-bar-feed" in "bar_feeder" {
        summary: "chuck moved by the program around a bar feed",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::BLOCKS),
            make: || Box::new(ChuckMovedAtBarFeed),
        },
    }
}

struct ChuckMovedAtBarFeed;

impl PathRule for ChuckMovedAtBarFeed {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if bar_feeder(cx).is_none() || lengths(event).is_none() || cx.state().bar().clamped() != Truth::False
        {
            return;
        }
        let opener = cx.name_of_effect(Effect::ChuckUnclamp).unwrap_or_default();
        let finding = cx
            .finding(&META, bar_feed_range(cx), format!("chuck is open before the bar is fed (`{opener}`)"))
            .label("the feed opens and closes the chuck itself")
            .help(format!("remove `{opener}`"));
        report.add(cx.resting_on(finding, Fact::Chuck, &format!("`{opener}`")));
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if bar_feeder(cx).is_none() || !cx.has_effect(|effect| effect == Effect::ChuckClamp) {
            return;
        }
        let Some(at) = cx.definitions().set_by(Fact::Chuck) else { return };
        let feed = cx.find_word(at, |word| cx.model.effect(word.code) == Effect::BarFeed);
        let Some(feed) = feed.filter(|_| cx.state().bar().clamped() == Truth::True) else { return };
        let closer = cx.name_of_effect(Effect::ChuckClamp).unwrap_or_default();
        report.add(
            cx.finding(
                &META,
                cx.effect_range(|effect| effect == Effect::ChuckClamp),
                format!("bar feed has closed the chuck already (`{closer}`)"),
            )
            .label("closes what is closed")
            .also(feed, "opens and closes the chuck itself")
            .help(format!("remove `{closer}`")),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn before_and_behind() {
        check_rule(
            &RULE,
            "haas-lathe",
            "M5\nM11\nG105 J1.75\nM10\nM99\n",
            &expect![[r#"
            3 | G105 J1.75
              | ^^^^ info[chuck-moved-at-bar-feed] chuck is open before the bar is fed (`M11`)
            4 | M10
              | ^^^ info[chuck-moved-at-bar-feed] bar feed has closed the chuck already (`M10`)
        "#]],
        );
    }

    #[test]
    fn away_from_the_feed_the_chuck_is_the_programs() {
        check_rule(&RULE, "haas-lathe", "M5\nG105 J1.75\nM11\nG4 P1.\nM10\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "M5\nM11\nG4 P1.\nM10\nG105 J1.75\nM30\n", &expect![[""]]);
    }
}
