//! A canned cycle whose return level is not stated.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cycles::is_cycle;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A program drills before it states the level to which a cycle returns: the initial level (`G98`) or the R level
    /// (`G99`).
    ///
    /// ## Why it matters
    /// From hole to hole the tool moves at that level. If `G99` is left over from an earlier program, the tool hits the
    /// clamps that the initial level would clear.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// G43 H1 Z1.
    /// G81 Z-1. R0.1 F10.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// G43 H1 Z1.
    /// G98 G81 Z-1. R0.1 F10.
    /// G80
    /// M30
    /// ```
    rule "cycle-return-not-stated" in "cycles" {
        summary: "canned cycle before `G98` or `G99` is stated",
        severity: Info,
        tier: Path,
        recommended: false,
        sets: [Strict, RestartSafe],
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CycleReturnNotStated { is_told: false }) },
    }
}

#[derive(Clone, PartialEq)]
struct CycleReturnNotStated {
    is_told: bool,
}

remembers!(CycleReturnNotStated);

impl PathRule for CycleReturnNotStated {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_cycle)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if self.is_told
            || !cx.has_effect(is_cycle)
            || cx.code_of_role(Role::ReturnLevel).is_some()
            || cx.definitions().set_by(Fact::Mode(Role::ReturnLevel)).is_some()
            || cx.is_after_unknown_program()
            || cx.is_called_only()
        {
            return;
        }
        let (Some(initial), Some(r)) =
            (cx.name_of_effect(Effect::ReturnToInitial), cx.name_of_effect(Effect::ReturnToR))
        else {
            return;
        };
        self.is_told = true;
        report.add(
            cx.finding(
                &META,
                cx.effect_range(is_cycle),
                format!("canned cycle before its return level is stated (`{initial}`, `{r}`)"),
            )
            .label("returns to whichever level an earlier program left active")
            .help(format!("write `{initial}` or `{r}` with the cycle")),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn stated_once_it_holds() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G99\nG81 Z-5. R2. F100.\nG80\nG83 Z-5. R2. Q1.\nG80\nM30\n",
            &expect![[""]],
        );
    }
}
