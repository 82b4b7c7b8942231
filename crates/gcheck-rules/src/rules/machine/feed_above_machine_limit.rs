//! A feed above the configured limit of the machine.

use gcheck_engine::{Abstract, Domain, Event, FeedMode};
use gcheck_geometry::Mm;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A feed per minute (`F`) is above the configured highest feed of the machine.
    ///
    /// ## Why it matters
    /// The control runs slower than the program says, or stops with an alarm. A feed ten times too high often is a missing
    /// decimal point, or a feed in millimetres in an inch program.
    ///
    /// ## Reported
    /// On a machine with 10,000 mm a minute:
    /// ```nc,reported,fanuc-mill
    /// G21
    /// G94 G1 X10. F12000.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G21
    /// G94 G1 X10. F8000.
    /// M30
    /// ```
    rule "feed-above-machine-limit" in "machine" {
        summary: "feed above the machine's limit",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CHANGES, make: || Box::new(FeedAboveMachineLimit) },
    }
}

struct FeedAboveMachineLimit;

impl PathRule for FeedAboveMachineLimit {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.environment.machine.engine.max_feed.is_some()
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let (Event::FeedRate(rate), Some(highest)) = (event, cx.environment.machine.engine.max_feed) else {
            return;
        };
        if cx.state().feed_mode(cx.model) != Some(FeedMode::PerMinute) {
            return;
        }
        // Of several possible feeds the lowest counts.
        let lowest = if rate.is_nan() {
            Abstract::bounds(cx.state().feed()).map(|(lowest, _)| lowest)
        } else {
            Some(*rate)
        };
        let Some(lowest) = lowest else { return };
        if lowest <= highest.0 * (1.0 + 1e-9) {
            return;
        }
        report.add(
            cx.finding(
                &META,
                cx.letter_range('F'),
                format!(
                    "feed of {}/min is above the machine's {}/min (`F`)",
                    cx.shown(Mm(lowest)),
                    cx.shown(Mm(highest.0))
                ),
            )
            .label("above the configured highest feed")
            .help("lower the feed, or correct the limit in the configuration"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn inches_are_compared_as_millimetres() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20\nG94 G1 X1. F500.\nG1 X2. F300.\nM30\n",
            &World::of_examples(&META),
            &expect![[r#"
                2 | G94 G1 X1. F500.
                  |            ^^^^^ warning[feed-above-machine-limit] feed of 500 in/min is above the machine's 393.7008 in/min (`F`)
            "#]],
        );
    }

    #[test]
    fn inverse_time_is_no_speed() {
        check_rule_in(
            &RULE,
            "haas-mill",
            "G20\nG93 G1 X1. F90000.\nM30\n",
            &World::of_examples(&META),
            &expect![""],
        );
    }

    #[test]
    fn nothing_configured_nothing_said() {
        check_rule(&RULE, "haas-mill", "G20 G94 G1 X1. F9000.\nM30\n", &expect![[""]]);
    }
}
