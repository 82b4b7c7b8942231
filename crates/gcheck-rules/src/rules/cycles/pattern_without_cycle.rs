//! A pattern of holes without a canned cycle.

use gcheck_controls::Effect;
use gcheck_engine::Role;

use crate::declare::declare_rule;
use crate::facts::cycles::is_cycle;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A pattern of holes (`G70`, `G71`, `G72`) is called, and no canned cycle is in effect.
    ///
    /// ## Why it matters
    /// The tool goes round the pattern and makes no hole.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. Z1.
    /// G70 I5. J15. L3
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0. Z1.
    /// G81 G99 Z-.5 R.1 F6.5 L0
    /// G70 I5. J15. L3
    /// G80
    /// M30
    /// ```
    rule "pattern-without-cycle" in "cycles" {
        summary: "pattern of holes without a canned cycle",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(PatternWithoutCycle) },
    }
}

struct PatternWithoutCycle;

impl PathRule for PatternWithoutCycle {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(Effect::is_hole_pattern)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(Effect::is_hole_pattern) || cx.is_called_only() || cx.is_after_unknown_program() {
            return;
        }
        let own = cx.code_of_role(Role::Cycle).is_some_and(|code| is_cycle(cx.model.effect(code)));
        let active = cx.state().active_cycle(cx.model);
        // A cycle that may be in effect makes its holes.
        if own || active.is_none_or(gcheck_controls::CodeIx::is_some) {
            return;
        }
        let finding = cx
            .finding(
                &META,
                cx.effect_range(Effect::is_hole_pattern),
                "a pattern of holes without a canned cycle",
            )
            .label("moves from point to point and makes no hole")
            .help(
                "give the cycle with `L0` in the block before, so that the pattern makes its holes with it",
            );
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_cycle_that_ended_makes_no_holes() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0. Y0. Z1.\nG81 G99 Z-.5 R.1 F6.5 L0\nG80\nG71 I5. K30. L3\nG81 G72 I5. L3 Z-.5 R.1\nM30\n",
            &expect![[r#"
                4 | G71 I5. K30. L3
                  | ^^^ warning[pattern-without-cycle] a pattern of holes without a canned cycle
            "#]],
        );
    }
}
