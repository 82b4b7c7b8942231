//! A bar feed inside the cutoff program of another bar feed.

use gcheck_engine::Event;

use crate::declare::declare_rule;
use crate::facts::bar_feed::{bar_feed_name, bar_feed_range, bar_feeder, is_bar_feed, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// The cutoff program that a bar feed calls (`G105 P…`) feeds the bar itself.
    ///
    /// ## Why it matters
    /// When the cutoff program returns, the bar feed that called it goes on: the bar is pushed twice, and the second
    /// part hangs out of the chuck.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// O1
    /// G105 J1.75 P2
    /// M99
    /// O2
    /// G1 X0. F0.004
    /// G0 X3.
    /// G105 J1.75
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// O1
    /// G105 J1.75 P2
    /// M99
    /// O2
    /// G1 X0. F0.004
    /// G0 X3.
    /// M99
    /// ```
    rule "bar-feed-in-cutoff-program" in "bar_feeder" {
        summary: "bar feed inside a cutoff program",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES.union(Watch::BLOCKS), make: || Box::new(BarFeedInCutoffProgram) },
    }
}

struct BarFeedInCutoffProgram;

impl PathRule for BarFeedInCutoffProgram {
    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if lengths(event).is_some() {
            check(cx, report);
        }
    }

    /// A feed that calls its own program never comes to feed.
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.has_effect(is_bar_feed) {
            check(cx, report);
        }
    }
}

fn check(cx: &PathCx<'_>, report: &mut Report<'_>) {
    if bar_feeder(cx).is_none() {
        return;
    }
    let Some(caller) = cx.state().frames().iter().rev().find(|frame| frame.is_cutoff()) else { return };
    let name = bar_feed_name(cx);
    let mut finding = cx
        .finding(&META, bar_feed_range(cx), format!("cutoff program feeds the bar itself (`{name}`)"))
        .label("feeds the bar, and the bar feed that called this program feeds it again")
        .help("part off and return with `M99`; leave the feed to the block that calls");
    // If the program is in another file than its caller, the call cannot be shown.
    if cx.range_of(caller.caller).is_none() {
        finding = finding.assuming("this program is called by a bar feed");
    }
    report.add(finding);
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_feed_that_calls_itself() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG105 J1.75 P2\nM30\nO2\nG105 J1.75 P2\nM99\n",
            &expect![[r#"
            5 | G105 J1.75 P2
              | ^^^^ warning[bar-feed-in-cutoff-program] cutoff program feeds the bar itself (`G105`)
        "#]],
        );
    }

    #[test]
    fn deeper_calls_count_too() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nG105 J1.75 P2\nM30\nO2\nM98 P3\nM99\nO3\nG105 J1.75\nM99\n",
            &expect![[r#"
                8 | G105 J1.75
                  | ^^^^ warning[bar-feed-in-cutoff-program] cutoff program feeds the bar itself (`G105`)
            "#]],
        );
    }

    #[test]
    fn a_program_called_by_others_may_feed() {
        check_rule(&RULE, "haas-lathe", "O1\nM98 P2\nM30\nO2\nG105 J1.75\nM99\n", &expect![[""]]);
    }
}
