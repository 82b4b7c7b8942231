//! A measurement between two touches without the first one, on some paths.

use gcheck_engine::Touch;

use crate::declare::declare_rule;
use crate::facts::probing::{is_second_touch, keeping_code, probing_code};
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A code measures between two touches (`G136`, `G35`), and on some paths that come here no first touch is kept.
    ///
    /// ## Why it matters
    /// On such a path the control measures from a point that another program kept, and writes the result without an
    /// alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// IF [#100 EQ 1] GOTO10
    /// G91 G31 Y-1. F10. M75
    /// N10 G91 G136 Y1. F10.
    /// G90
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// IF [#100 EQ 1] GOTO10
    /// G91 G31 Y-1. F10. M75
    /// GOTO20
    /// N10 G91 G31 Y-2. F10. M75
    /// N20 G91 G136 Y1. F10.
    /// G90
    /// M30
    /// ```
    rule "maybe-first-touch-missing" in "probing" {
        summary: "may measure between two touches without the first",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MaybeFirstTouchMissing) },
    }
}

struct MaybeFirstTouchMissing;

impl PathRule for MaybeFirstTouchMissing {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_open = cx.state().kept_touch() == Touch::Unknown;
        if !is_open || !cx.has_effect(is_second_touch) || cx.is_called_only() || cx.is_after_unknown_program()
        {
            return;
        }
        let name = probing_code(cx).map(|code| cx.name_of(code)).unwrap_or_default();
        let keep = keeping_code(cx);
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_second_touch),
                format!("`{name}` may have no first touch to measure from (`{keep}`)"),
            )
            .label("the second touch; on some paths the first is missing")
            .help(format!("touch the first side with `{keep}` on every path that comes here"));
        report.add(cx.with_path(finding));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_first_touch_behind_a_condition() {
        check_rule(
            &RULE,
            "haas-mill",
            "IF [#100 EQ 1] GOTO10\nG91 G31 Y-1. F10. M75\nN10 G91 G136 Y1. F10.\nG90\nM30\n",
            &expect![[r#"
                3 | N10 G91 G136 Y1. F10.
                  |         ^^^^ warning[maybe-first-touch-missing] `G136` may have no first touch to measure from (`M75`)
            "#]],
        );
    }

    #[test]
    fn a_program_that_is_not_at_hand_is_no_evidence() {
        check_rule(&RULE, "haas-mill", "G65 P9100\nG91 G136 Y1. F10.\nG90\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_missing_touch_on_every_path_is_another_rules() {
        check_rule(&RULE, "haas-mill", "G91 G136 Y1. F10.\nG90\nM30\n", &expect![[""]]);
    }
}
