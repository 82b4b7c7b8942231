//! Machine coordinates while increments are on.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch, limit};

declare_rule! {
    /// A move in machine coordinates (`G53`) is programmed under increments (`G91`), on a control that refuses it.
    ///
    /// ## Why it matters
    /// Machine coordinates are positions. The control stops here: often at a safe retract such as `G53 Z0`.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G20 G91
    /// G53 G0 Z0
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G20 G90
    /// G53 G0 Z0
    /// M2
    /// ```
    rule "machine-coordinates-in-increments" in "motion" {
        summary: "machine coordinates while increments are on",
        severity: Error,
        tier: Path,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(MachineCoordinatesInIncrements) },
    }
}

struct MachineCoordinatesInIncrements;

impl PathRule for MachineCoordinatesInIncrements {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::MachineCoordinates)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let is_machine = |effect| effect == Effect::MachineCoordinates;
        let is_incremental = cx.state().is_incremental(cx.model) == Some(true);
        if *fault != Fault::Conflict || !cx.has_effect(is_machine) || !is_incremental {
            return;
        }
        // A mode in the block itself is not judged here.
        if cx.code_of_role(Role::Distance).is_some_and(|code| cx.model.effect(code) == Effect::Absolute) {
            return;
        }
        let name = cx.name_of_effect(Effect::MachineCoordinates).unwrap_or_default();
        let incremental = cx.name_of_effect(Effect::Incremental).unwrap_or_default();
        let absolute = cx.name_of_effect(Effect::Absolute).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_machine),
                format!("machine coordinates under increments (`{name}` under `{incremental}`)"),
            )
            .label("the control refuses the block")
            .help(format!("state `{absolute}` before this block"))
            .fix_if(cx.block_before(Some(&absolute)))
            .at_most(limit(cx.model.semantics().confidence));
        report.add(cx.resting_on(finding, Fact::Mode(Role::Distance), &format!("`{incremental}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90\nG0 X1\nG91 G53 G0 Z0\nM2\n",
            &expect![[r#"
            3 | G91 G53 G0 Z0
              |     ^^^ error[machine-coordinates-in-increments] machine coordinates under increments (`G53` under `G91`)
        "#]],
        );
    }
}
