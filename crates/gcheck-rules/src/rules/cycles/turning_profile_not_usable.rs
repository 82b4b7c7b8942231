//! A turning cycle whose profile cannot be used.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fault};

use crate::declare::declare_rule;
use crate::facts::cycles::cycle_name;
use crate::facts::offset_schemes::whole;
use crate::{Finding, PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// The profile that a turning cycle names is not in the file, ends before it begins, or the cycle is inside its own
    /// profile.
    ///
    /// ## Why it matters
    /// The control stops with an alarm before it cuts.
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
    /// The profile is a subroutine that the file does not have.
    /// ```nc,reported,linuxcnc
    /// G18 G7 G21 G90 F100
    /// G0 X40 Z1
    /// G71 Q100 D1
    /// M2
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
        if *fault == Fault::NoSuchProgram && cx.has_effect(is_turning_operation) {
            report.add(absent(cx));
        }
        if *fault != Fault::Profile {
            return;
        }
        let Some(file) = cx.program.file(0) else { return };
        let here = cx.origin().at.block;
        let label = |letter: char, from: u32| {
            file.loaded.flow_graph().label(cx.known_number(letter).and_then(whole)?, from, true)
        };
        let Some(first) = label('P', here) else { return };
        let Some(last) = label('Q', first) else { return };
        // Other profiles that the engine cannot follow may work on the machine.
        let (message, label) = if last < first {
            ("profile of the turning cycle ends before it begins", "`Q` names a block before that of `P`")
        } else if (first..=last).contains(&here) {
            ("turning cycle is inside its own profile", "lies between the blocks that `P` and `Q` name")
        } else {
            return;
        };
        let mut finding = cx
            .finding(&META, cx.range(), message)
            .label(label)
            .help("let `P` name the first block of the profile and `Q` the last")
            .at_most(Severity::Warning);
        for (block, what) in [(first, "the profile begins here"), (last, "the profile ends here")] {
            if let Some(range) = cx.range_of(At { file: 0, block }) {
                finding = finding.also(range, what);
            }
        }
        report.add(finding);
    }
}

/// Is it a cycle whose profile may be a subroutine?
fn is_turning_operation(effect: Effect) -> bool {
    matches!(effect, Effect::FinishProfile | Effect::RoughAlongZ | Effect::RoughAlongX)
}

fn absent(cx: &PathCx<'_>) -> Finding {
    let name = cycle_name(cx);
    cx.finding(
        &META,
        cx.letter_range('Q'),
        format!("profile of the turning cycle is not in the file (`{name}`)"),
    )
    .label("no subroutine has this number")
    .note("the profile of the cycle is the subroutine that `Q` names")
    .help("write the profile as a subroutine before the cycle, or correct `Q`")
    .at_most(Severity::Warning)
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
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[turning-profile-not-usable] profile of the turning cycle ends before it begins
            "#]],
        );
    }
}
