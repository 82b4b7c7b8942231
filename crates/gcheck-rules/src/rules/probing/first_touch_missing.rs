//! A measurement between two touches without the first one.

use gcheck_controls::Effect;
use gcheck_engine::Touch;

use crate::declare::declare_rule;
use crate::facts::probing::{is_second_touch, keeping_code, probing_code};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A code measures between two touches (`G136`, `G35`), and on every path that comes here no first touch is kept.
    ///
    /// ## Why it matters
    /// The control uses the point that it kept last, perhaps one of another part. It writes the middle between that
    /// point and the new touch into the work offset, or the distance into the tool's size, without an alarm; the next
    /// cut relies on that.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10.
    /// G0 Z2.
    /// Y-10.
    /// Z-2.
    /// G136 Y1. F10.
    /// G90 G0 Y0.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G31 Y-1. F10. M75
    /// G0 Z2.
    /// Y-10.
    /// Z-2.
    /// G136 Y1. F10.
    /// G90 G0 Y0.
    /// M30
    /// ```
    rule "first-touch-missing" in "probing" {
        summary: "measures between two touches without the first",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(FirstTouchMissing) },
    }
}

struct FirstTouchMissing;

impl PathRule for FirstTouchMissing {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // A called program may measure from a touch of its caller.
        if cx.has_effect(is_second_touch) && cx.state().kept_touch() == Touch::None && !cx.is_called_only() {
            report.add(finding(cx));
        }
    }
}

fn finding(cx: &PathCx<'_>) -> crate::Finding {
    let range = cx.effect_range(is_second_touch);
    let name = probing_code(cx).map(|code| cx.name_of(code)).unwrap_or_default();
    let keep = keeping_code(cx);
    let message = format!("`{name}` measures between two touches, but no first touch was kept");
    let finding = cx.finding(&META, range, message).label("the second touch; the first is missing");
    if let Some(passed) = passed_by(cx) {
        return finding.also(passed, "this way skips the first touch").help(
            "make every way to the second touch run the first: without `/` and without a jump over it",
        );
    }
    let note = if cx.state().touched() == Touch::None {
        "there is no probing move before it".to_owned()
    } else {
        format!("the probing moves before it keep no point: they have no `{keep}`")
    };
    finding
        .note(note)
        .help(format!("touch the first side with `G31 … F… {keep}`, move to the other side, then measure"))
}

/// A code in the text before the block that keeps a touch; no path to the block executes it.
fn passed_by(cx: &PathCx<'_>) -> Option<std::ops::Range<u32>> {
    let control = cx.control();
    let mut codes = cx.file_index.codes.iter();
    let keeps = |number| {
        control.code_at(control.code_ix(number)).is_some_and(|code| code.effect() == Effect::KeepTouch)
    };
    codes.find(|(number, at)| keeps(*number) && at.end <= cx.range().start).map(|(_, at)| at.clone())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_second_touch_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 Y-1. F10.\nG136 Y1. F10.\nG90\nM30\n",
            &expect![[r#"
                2 | G136 Y1. F10.
                  | ^^^^ error[first-touch-missing] `G136` measures between two touches, but no first touch was kept
            "#]],
        );
    }

    #[test]
    fn a_touch_kept_too_late_does_not_count() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G136 Y1. F10.\nG31 Y-1. F10. M75\nG90\nM30\n",
            &expect![[r#"
                1 | G91 G136 Y1. F10.
                  |     ^^^^ error[first-touch-missing] `G136` measures between two touches, but no first touch was kept
            "#]],
        );
    }

    #[test]
    fn a_first_touch_that_the_way_leads_past_is_shown() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            "G91\n/G31 Y-1. F10. M75\nG136 Y1. F10.\nG90\nM30\n",
            &World::default(),
        );
        expect![[r#"
            `G136` measures between two touches, but no first touch was kept
              here: the second touch; the first is missing
              there: this way skips the first touch
              note: it holds with block delete on, when the control skips blocks with `/`
              help: make every way to the second touch run the first: without `/` and without a jump over it
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn a_tool_is_measured_between_two_touches_too() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G35 X1. D1 F10.\nG90\nM30\n",
            &expect![[r#"
                1 | G91 G35 X1. D1 F10.
                  |     ^^^ error[first-touch-missing] `G35` measures between two touches, but no first touch was kept
            "#]],
        );
    }

    #[test]
    fn a_touch_kept_by_a_subprogram_counts() {
        check_rule(
            &RULE,
            "haas-mill",
            "M97 P100\nG91 G136 Y1. F10.\nG90\nM30\nN100 G91 G31 Y-1. F10. M75\nM99\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_program_that_is_not_at_hand_may_have_kept_one() {
        check_rule(&RULE, "haas-mill", "G65 P9100\nG91 G136 Y1. F10.\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_is_called_may_have_the_touch_of_its_caller() {
        check_rule(&RULE, "haas-mill", "O9100\nG91 G136 Y1. F10.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_touch_kept_on_some_path_is_another_rules() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [#100 EQ 1] GOTO10\nG91 G31 Y-1. F10. M75\nN10 G91 G136 Y1. F10.\nG90\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn words_say_what_the_first_touch_lacks() {
        let found = findings(
            &only(&RULE),
            "haas-mill",
            "G91 G31 Y-1. F10.\nG136 Y1. F10.\nG90\nM30\n",
            &World::default(),
        );
        let text = words(&found[0]);
        assert!(
            text.contains("note: the probing moves before it keep no point: they have no `M75`"),
            "{text}"
        );
    }
}
