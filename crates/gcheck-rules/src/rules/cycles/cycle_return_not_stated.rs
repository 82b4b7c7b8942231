//! A canned cycle whose return level nobody chose.

use gcheck_controls::Effect;
use gcheck_engine::{Fact, Role};

use super::cycle_words_lost::is_cycle;
use crate::memory::{Remembers, remembers};
use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};

declare_rule! {
    /// A program drills before it says to which level a cycle returns: the starting level (`G98`) or R (`G99`).
    ///
    /// ## Why it matters
    /// From hole to hole the tool goes at that level. With R left over from what ran before, it goes through the clamps that
    /// the starting level would clear.
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
            || cx.trace().set_by(Fact::Mode(Role::ReturnLevel)).is_some()
            || cx.is_behind_unknown_program()
            || cx.is_called_only()
        {
            return;
        }
        let (Some(initial), Some(r)) =
            (cx.cancel_of(Effect::ReturnToInitial), cx.cancel_of(Effect::ReturnToR))
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
            .label("returns to the level that is in effect at the moment")
            .help(format!("state `{initial}` or `{r}` with the cycle")),
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
