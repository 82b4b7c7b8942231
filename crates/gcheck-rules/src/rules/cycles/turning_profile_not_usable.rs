//! A turning cycle whose profile cannot be read.

use gcheck_engine::Fault;

use crate::meta::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// The profile that a turning cycle names is not found, turns back on itself, or holds what a profile cannot hold.
    ///
    /// ## Why it matters
    /// The control alarms before it cuts, or cuts into the part on the way.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G54 T0101
    /// G0 X2. Z.1
    /// G71 P20 Q10 D.05 U.02 W.005 F.01
    /// N10 G0 X1.
    /// G1 Z-1. F.005
    /// N20 X2.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G54 T0101
    /// G0 X2. Z.1
    /// G71 P10 Q20 D.05 U.02 W.005 F.01
    /// N10 G0 X1.
    /// G1 Z-1. F.005
    /// N20 X2.
    /// G70 P10 Q20
    /// M30
    /// ```
    rule "turning-profile-not-usable" in "cycles" {
        summary: "turning cycle whose profile cannot be used",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(TurningProfileNotUsable) },
    }
}

struct TurningProfileNotUsable;

impl PathRule for TurningProfileNotUsable {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Profile {
            return;
        }
        let code = cx.codes().iter().copied().find_map(|code| {
            use gcheck_controls::Effect as E;
            let is_cycle = matches!(
                cx.model.effect(code),
                E::RoughAlongX | E::RoughAlongZ | E::RepeatPattern | E::FinishProfile
            );
            cx.scene.control().code_at(code).filter(|_| is_cycle).map(|code| code.entry().code.clone())
        });
        let name = code.map_or_else(String::new, |code| format!(" (`{code}`)"));
        let finding = cx
            .finding(&META, cx.range(), format!("profile of the turning cycle cannot be used{name}"))
            .label("not found, or not a profile that can be cut")
            .help("check the first and last block of the profile, and that it does not turn back on itself")
            .at_most(Severity::Warning);
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_cycle_is_marked() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20 G54 T0101\nG0 X2. Z.1\nG71 P20 Q10 D.05 U.02 W.005 F.01\nN10 G0 X1.\nG1 Z-1. F.005\nN20 X2.\nM30\n",
            &expect![[r#"
                3 | G71 P20 Q10 D.05 U.02 W.005 F.01
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[turning-profile-not-usable] profile of the turning cycle cannot be used (`G71`)
            "#]],
        );
    }
}
