//! A thread at constant surface speed.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fact, Role};

use crate::declare::declare_rule;
use crate::facts::cutting::is_thread;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A thread is cut while the spindle keeps a constant surface speed (`G96`).
    ///
    /// ## Why it matters
    /// Each pass is deeper, so the spindle turns at another speed in each. The slide starts its move at an angle of the
    /// spindle and needs some distance to catch up, which depends on the speed: the passes do not follow one groove.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// T0101
    /// G50 S2000
    /// G96 S150 M3
    /// G0 X22. Z5.
    /// G92 X19.2 Z-20. F1.5
    /// X18.6
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// T0101
    /// G97 S800 M3
    /// G0 X22. Z5.
    /// G92 X19.2 Z-20. F1.5
    /// X18.6
    /// M30
    /// ```
    rule "thread-at-surface-speed" in "spindle" {
        summary: "thread cut at constant surface speed",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(ThreadAtSurfaceSpeed { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct ThreadAtSurfaceSpeed {
    /// The block that set the mode where it was reported last.
    told: Option<At>,
}

remembers!(ThreadAtSurfaceSpeed: told);

impl PathRule for ThreadAtSurfaceSpeed {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::SurfaceSpeed) && program.may(is_thread)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let is_broken = cx.origin().flags.contains(gcheck_program::BlockFlags::ERROR);
        if is_broken || !cx.has_effect(is_thread) || cx.code_of_role(Role::SpindleMode).is_some() {
            return;
        }
        let Some(Effect::SurfaceSpeed) = cx.state().effect(Role::SpindleMode, cx.model) else { return };
        let fact = Fact::Mode(Role::SpindleMode);
        let set_by = cx.definitions().set_by(fact);
        if set_by.is_none() || set_by == self.told {
            return;
        }
        let Some(code) = cx.state().mode(Role::SpindleMode).only() else { return };
        self.told = set_by;
        let name = cx.name_of(code);
        let constant = cx.name_of_effect(Effect::ConstantSpeed).unwrap_or_default();
        let finding = cx
            .finding(
                &META,
                cx.effect_range(is_thread),
                format!("the thread is cut at constant surface speed (`{name}`)"),
            )
            .label("the spindle's speed changes from pass to pass")
            .help(format!("change to a constant spindle speed (`{constant} S…`) before the thread"))
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
    fn one_mode_forgotten_is_told_once() {
        check_rule(
            &RULE,
            "haas-lathe",
            "T101\nG50 S2000\nG96 S400 M3\nG0 X1. Z.2\nG76 X.9 Z-1. K.05 D.01 F.0625\nG76 X.9 Z-1. K.05 D.01 F.0625\nM30\n",
            &expect![[r#"
                5 | G76 X.9 Z-1. K.05 D.01 F.0625
                  | ^^^ warning[thread-at-surface-speed] the thread is cut at constant surface speed (`G96`)
            "#]],
        );
    }

    #[test]
    fn the_spindle_mode_at_power_on_is_not_the_programs() {
        check_rule(&RULE, "linuxcnc", "G21\nG33 Z-10 K1\nM2\n", &expect![[""]]);
    }
}
