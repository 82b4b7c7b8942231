//! A tapping cycle whose spindle turns the wrong way.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Spindle};

use crate::declare::declare_rule;
use crate::facts::tool_comment::{ToolComment, comment_at_work};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch, limit};

declare_rule! {
    /// A tapping cycle begins while the spindle turns in the wrong direction for its thread: a right-hand tap under
    /// `M4`, a left-hand tap under `M3`. On controls that set the direction themselves, a left-hand cycle after `M3` is reported if the
    /// tool's comment names a tap and no left-hand thread.
    ///
    /// ## Why it matters
    /// A control that checks the direction refuses the cycle. A control that does not would unscrew the tap while it
    /// feeds in.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G20 G90 G0 X0 Y0 Z1
    /// M4 S100
    /// G84 Z-1 R.1 F10
    /// G80
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G20 G90 G0 X0 Y0 Z1
    /// M3 S100
    /// G84 Z-1 R.1 F10
    /// G80
    /// M2
    /// ```
    /// Other controls set the direction themselves.
    /// ```nc,quiet,haas-mill
    /// G20 G90 G54 G0 X0. Y0.
    /// M4 S100
    /// G84 Z-1. R.1 F10.
    /// G80
    /// M30
    /// ```
    rule "tap-in-wrong-direction" in "spindle" {
        summary: "spindle turns the wrong way for a tapping cycle",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TapInWrongDirection) },
    }
}

struct TapInWrongDirection;

impl PathRule for TapInWrongDirection {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| wanted(effect).is_some())
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // A control that does not check the direction sets it itself.
        if !cx.model.semantics().cycles.tap_needs_spindle {
            judge_by_comment(cx, report);
            return;
        }
        let wanted = cx.codes().iter().find_map(|code| wanted(cx.model.effect(*code)));
        let (Some(wanted), Some(turns)) = (wanted, cx.state().spindle()) else { return };
        let starts = |effect| {
            matches!(effect, Effect::SpindleClockwise | Effect::SpindleCounterClockwise | Effect::SpindleStop)
        };
        if turns == wanted || turns == Spindle::Stopped || cx.has_effect(starts) {
            return;
        }
        let finding = cx
            .finding(
                &META,
                cx.effect_range(Effect::is_tapping_cycle),
                "the spindle turns the wrong way for this tapping cycle",
            )
            .label("the control refuses the cycle")
            .note("a right-hand thread needs the spindle clockwise (`M3`), a left-hand one counter-clockwise (`M4`)")
            .help("start the spindle in the other direction, or use the cycle for the other thread")
            .at_most(limit(cx.model.semantics().confidence));
        report.add(cx.resting_on(finding, Fact::Spindle, "the direction"));
    }
}

/// A left-hand cycle after `M3`, with a tap whose comment says nothing of a left-hand thread.
fn judge_by_comment(cx: &PathCx<'_>, report: &mut Report<'_>) {
    let is_left = |effect: Effect| wanted(effect) == Some(Spindle::CounterClockwise);
    if !cx.has_effect(is_left) || cx.state().spindle() != Some(Spindle::Clockwise) {
        return;
    }
    let is_right_hand = |comment: &ToolComment| comment.has(&["TAP", "TAPPING"]) && !comment.is_left_hand();
    if comment_at_work(cx).is_some_and(|comment| is_right_hand(&comment)) {
        let right = cx.name_of_effect(Effect::CycleTap).unwrap_or_default();
        report.add(
            cx.finding(&META, cx.effect_range(is_left), "left-hand tapping with a tap that is not called left-hand")
                .label("drives the tap in backwards")
                .note("the spindle was started clockwise, and the tool's comment says nothing of a left-hand thread")
                .help(format!("tap with `{right}`, or write the hand into the tool's comment"))
                .at_most(Severity::Warning),
        );
    }
}

/// The direction in which the spindle must turn.
fn wanted(effect: Effect) -> Option<Spindle> {
    match effect {
        Effect::CycleTap => Some(Spindle::Clockwise),
        Effect::CycleLeftTap => Some(Spindle::CounterClockwise),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_comment_tells_the_hand_where_the_control_sets_the_direction() {
        let program = |comment: &str| {
            format!(
                "({comment})\nG21 G90 G54 T5 M6\nG0 X0. Y0. S300 M3\nG43 H5 Z5.\nG74 Z-20. R5. F525.\nG80\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("T5 M12 TAP"),
            &expect![[r#"
            5 | G74 Z-20. R5. F525.
              | ^^^ warning[tap-in-wrong-direction] left-hand tapping with a tap that is not called left-hand
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program("T5 M12 LH TAP"), &expect![[""]]);
    }

    #[test]
    fn left_hand_threads_too() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G20 G90 G0 X0 Y0 Z1\nM3 S100\nG74 Z-1 R.1 F10\nG80\nM2\n",
            &expect![[r#"
                3 | G74 Z-1 R.1 F10
                  | ^^^ error[tap-in-wrong-direction] the spindle turns the wrong way for this tapping cycle
            "#]],
        );
    }

    #[test]
    fn hands_in_one_word_with_the_size() {
        for comment in ["M12X1.75LH TAP", "M12X1.75L TAP", "TAP M12 LH"] {
            let program = format!(
                "G21 G90 G54\nT5 M6 ({comment})\nG0 X0. Y0. S200 M3\nG43 H5 Z5.\nG74 Z-20. R5. F350.\nG80\nM30\n"
            );
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
    }
}
