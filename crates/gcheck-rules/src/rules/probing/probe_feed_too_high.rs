//! A probing move too fast for the probe.

use gcheck_controls::{Effect, SystemValue, SystemVariable};
use gcheck_engine::{Abstract, Axis, Domain, Event, FeedMode, Touch, Units, Way};
use gcheck_program::{BlockFlags, Op};

use crate::declare::declare_rule;
use crate::facts::compensation::may_be_on;
use crate::facts::probing::{driven, is_measurement, is_probing_move, is_touch};
use crate::facts::usage::blocks_with;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A probing move that measures has a feed above the limit in the control's manual. A protected move may be fast: the probe
    /// goes up, or nobody reads where it has touched (`#5061`).
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
    /// On its way the probe stops if it touches, and nothing is measured.
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y5.
    /// G31 Z-1. F150.
    /// G31 Y4. F15. M79
    /// M30
    /// ```
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
        let guards = cx.has_effect(|effect| effect == Effect::AlarmIfTouched);
        if !guards && !is_protected(cx) {
            report.add(finding);
        }
    }
}

/// Does the probe go up, or is its touch never read, so that it only guards the way?
fn is_protected(cx: &PathCx<'_>) -> bool {
    let measures = |effect| is_measurement(effect) || effect == Effect::AlarmIfNotTouched;
    if cx.has_effect(measures) {
        return false;
    }
    let goes_up = match cx.state().touched() {
        Touch::Made(ways) => driven(ways).all(|(axis, way)| axis == Axis::Z && way == Way::Up),
        _ => false,
    };
    goes_up || !reads_touch(cx)
}

/// Does the file read where a probe has touched, as far as the numbers of its variables show?
fn reads_touch(cx: &PathCx<'_>) -> bool {
    let variables = &cx.control().semantics().system_variables;
    let is_touch = |number: u32| {
        let of_touch = |variable: &SystemVariable| {
            variable.holds == SystemValue::ProbePosition && variable.cell(number).is_some()
        };
        variables.iter().any(of_touch)
    };
    let flags = BlockFlags::STATEMENT | BlockFlags::EXPRESSION;
    blocks_with(cx.program, cx.environment, flags).any(|(_, place)| {
        place.expressions().any(|expr| {
            place.table.ops(place.table.expr(expr)).iter().any(|op| match op {
                Op::Variable(number) => is_touch(*number),
                Op::Indirect => true,
                _ => false,
            })
        })
    })
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
            "G21 G91 G31 Y-1. F3000. M79\nG31 Y-1. F2499.\nG31 Y-1. F2500.\nG36 Y-1. F4000.\nG31 Z1. F4000.\n#100= #5062\nG90\nM30\n",
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
    fn a_protected_move_may_be_fast() {
        check_rule(&RULE, "haas-mill", "G21 G91 G31 Y-1. F4000.\nG90\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G91 G31 Y-1. F4000.\n#1= #[5060+2]\nG90\nM30\n",
            &expect![[r#"
            1 | G21 G91 G31 Y-1. F4000.
              |                  ^^^^^^ warning[probe-feed-too-high] probing at 4000 mm/min (`F`)
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
