//! A thread under nose or cutter compensation.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::compensation::is_on;
use crate::facts::cutting::is_thread;
use crate::facts::modes::{ActiveMode, left_on};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A thread is cut while the path is offset by the nose radius of the tool (`G41`, `G42`).
    ///
    /// ## Why it matters
    /// Threading needs no nose compensation: the control shifts the thread along the part, or ignores the offset in
    /// these blocks and returns to it with a jump. Most often the `G40` after the turning is missing.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// T0101
    /// G97 S800 M3
    /// G42 G0 X22. Z5.
    /// G1 Z4. F0.2
    /// G92 X19.2 Z-20. F1.5
    /// G40 G0 X50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// T0101
    /// G97 S800 M3
    /// G42 G0 X22. Z5.
    /// G1 Z4. F0.2
    /// G40 G0 X24.
    /// G92 X19.2 Z-20. F1.5
    /// M30
    /// ```
    rule "compensation-in-thread" in "compensation" {
        summary: "thread cut under nose compensation",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(CompensationInThread { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct CompensationInThread {
    /// The block that switched on what was reported last.
    told: Option<At>,
}

remembers!(CompensationInThread: told);

impl PathRule for CompensationInThread {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_on) && program.may(is_thread)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_broken = cx.origin().flags.contains(gcheck_program::BlockFlags::ERROR);
        if is_broken || !cx.has_effect(is_thread) {
            return;
        }
        let Some(ActiveMode::Certain(code)) = left_on(cx, Role::Compensation, is_on) else { return };
        let fact = Fact::Mode(Role::Compensation);
        let set_by = cx.definitions().set_by(fact);
        if set_by.is_none() || set_by == self.told {
            return;
        }
        self.told = set_by;
        let name = cx.name_of(code);
        let off = cx.name_of_effect(Effect::CompensationOff).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_thread),
                format!("the thread is cut under nose compensation (`{name}`)"),
            )
            .label("the path is offset by the nose radius of the tool")
            .help(format!("leave the contour with `{off}` before the thread"))
            .at_most(Severity::Warning);
        report.add(cx.resting_on(finding, fact, &format!("`{name}`")));
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_block_that_ends_it_is_no_thread_under_it() {
        check_rule(
            &RULE,
            "haas-lathe",
            "T101\nG97 S400 M3\nG42 G0 X1. Z.2\nG1 Z.1 F.01\nG40 G32 Z-1. F.05\nM30\n",
            &expect![[""]],
        );
    }
}
