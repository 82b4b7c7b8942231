//! A probing move too fast for the probe.

use gcheck_engine::{Abstract, Domain, Event, FeedMode, Units};

use crate::declare::declare_rule;
use crate::facts::compensation::may_be_on;
use crate::facts::probing::{is_probing_move, is_touch};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A probing move has a feed above the limit in the control's manual.
    ///
    /// ## Why it matters
    /// After the touch the axes need some distance to stop. Above this feed the stylus may break, and the measurement
    /// is off by that distance.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G90 G54 G0 X0. Y5.
    /// G31 Y4. F150. M79
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y5.
    /// G31 Y4. F15. M79
    /// M30
    /// ```
    rule "probe-feed-too-high" in "probing" {
        summary: "probing move too fast for the probe",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::CUTS, make: || Box::new(ProbeFeedTooHigh) },
    }
}

struct ProbeFeedTooHigh;

impl PathRule for ProbeFeedTooHigh {
    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(limit) = cx.model.semantics().probe_feed else {
            cx.enough();
            return;
        };
        if !is_probing_move(event) || !cx.has_effect(is_touch) || may_be_on(cx) {
            return;
        }
        let (Some(FeedMode::PerMinute), Some(units)) =
            (cx.state().feed_mode(cx.model), cx.state().units(cx.model))
        else {
            return;
        };
        let (fastest, unit) = match units {
            Units::Inch => (limit.inch, "inch/min"),
            Units::Mm => (limit.mm, "mm/min"),
        };
        // Of several possible feeds the lowest counts.
        let Some((lowest, _)) = Abstract::bounds(cx.state().feed()) else { return };
        let feed = lowest / units.in_mm();
        // The limit itself is too fast.
        if feed < fastest * (1.0 - 1e-9) {
            return;
        }
        let finding = cx
            .finding(&META, cx.letter_range('F'), format!("probing at {feed:.0} {unit} (`F`)"))
            .label("too fast for the probe")
            .note(format!("the manual asks for less than {fastest:.0} {unit} for a touch"))
            .help("approach with a protected move, and touch slowly");
        // A protected move may be as fast as its stopping distance allows.
        let guards = cx.has_effect(|effect| effect == gcheck_controls::Effect::AlarmIfTouched);
        if !guards {
            report.add(finding);
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_feed_is_marked_in_the_units_of_the_program() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G91 G31 Y-1. F3000. M79\nG31 Y-1. F2499.\nG31 Y-1. F2500.\nG36 Y-1. F4000.\nG90\nM30\n",
            &expect![[r#"
                1 | G21 G91 G31 Y-1. F3000. M79
                  |                  ^^^^^^ warning[probe-feed-too-high] probing at 3000 mm/min (`F`)
                3 | G31 Y-1. F2500.
                  |          ^^^^^^ warning[probe-feed-too-high] probing at 2500 mm/min (`F`)
                4 | G36 Y-1. F4000.
                  |          ^^^^^^ warning[probe-feed-too-high] probing at 4000 mm/min (`F`)
            "#]],
        );
    }

    #[test]
    fn a_feed_that_nobody_knows_is_no_mistake() {
        check_rule(&RULE, "haas-mill", "G20 G91 G31 Y-1. F#100\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_move_that_must_not_touch_may_be_fast() {
        check_rule(&RULE, "haas-mill", "G20 G91 G31 Y-1. F150. M78\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_control_without_such_a_limit_says_nothing() {
        check_rule(&RULE, "fanuc-mill", "G21 G91 G31 Y-1. F9000.\nG90\nM30\n", &expect![[""]]);
    }
}
