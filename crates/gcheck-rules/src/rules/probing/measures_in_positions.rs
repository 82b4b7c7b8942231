//! A work offset that is measured in positions.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::facts::modes::{ModeInBlock, mode_in_block};
use crate::facts::probing::probing_code;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A work offset is measured (`G36`, `G136`) in positions (`G90`), and the manual asks for increments (`G91`).
    ///
    /// ## Why it matters
    /// The end of the move counts in the offset that the block measures, so the old offset decides where it is, perhaps
    /// short of the surface or far behind it. An increment always begins at the probe's position.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G36 Y4. F10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y5.
    /// G91 G36 Y-1. F10.
    /// G90
    /// M30
    /// ```
    rule "measures-in-positions" in "probing" {
        summary: "work offset measured in positions, not increments",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(MeasuresInPositions) },
    }
}

struct MeasuresInPositions;

impl PathRule for MeasuresInPositions {
    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_offset = |effect| matches!(effect, Effect::ProbeOffset | Effect::ProbeCentre);
        if !cx.has_effect(is_offset) {
            return;
        }
        let (mode, is_written) = match mode_in_block(cx, Role::Distance) {
            ModeInBlock::Written(mode) => (mode, true),
            ModeInBlock::Before(mode) => (mode, false),
            ModeInBlock::Several(_) => return,
        };
        let fact = Fact::Mode(Role::Distance);
        let is_callers = !is_written && cx.is_called_only() && cx.definitions().set_by(fact).is_none();
        let Some(code) = probing_code(cx).and_then(|ix| cx.code_of(ix)) else { return };
        let wanted = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
        if cx.model.effect(mode) != Effect::Absolute
            || is_callers
            || !code.entry().recommends.contains(&wanted)
        {
            return;
        }
        let (name, mode) = (code.number(), cx.name_of(mode));
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_offset),
                format!("`{name}` in positions (`{mode}`) instead of increments"),
            )
            .label("the end of the move counts in the offset that this block sets")
            .note(format!("the manual asks for `{wanted}` with `{name}`  [{}]", code.entry().source))
            .help(format!("write the distance to the surface as an increment: `{wanted} {name} …`"));
        report.add(if is_written { finding } else { cx.resting_on(finding, fact, &format!("`{mode}`")) });
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_measuring_code_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G91 G31 Y-1. F10. M75\nG90 G0 Y-5.\nG90 G136 Y-4. F10.\nG91 G136 Y1. F10.\nG90\nM30\n",
            &expect![[r#"
                3 | G90 G136 Y-4. F10.
                  |     ^^^^ info[measures-in-positions] `G136` in positions (`G90`) instead of increments
            "#]],
        );
    }

    #[test]
    fn a_caller_may_count_in_increments() {
        check_rule(&RULE, "haas-mill", "O9100\nG36 Y-1. F10.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn other_probing_moves_may_count_as_they_like() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G31 Y-1. F10.\nG43 H1 Z1.\nG37 H1 Z0. F10.\nM30\n",
            &expect![[""]],
        );
    }
}
