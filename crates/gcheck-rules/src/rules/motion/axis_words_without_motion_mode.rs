//! Axis words while no motion mode is active.

use std::collections::BTreeSet;

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{At, Fact, Fault, Role};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block has axis words, and no code says how to move: the motion mode was cancelled, or never chosen.
    ///
    /// ## Why it matters
    /// The control stops with an alarm. After a canned cycle, `G80` has cancelled the motion mode together with the
    /// cycle.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z5
    /// G81 X10 Y10 Z-5 R2 F100
    /// G80
    /// X20
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z5
    /// G81 X10 Y10 Z-5 R2 F100
    /// G80
    /// G0 X20
    /// M2
    /// ```
    rule "axis-words-without-motion-mode" in "motion" {
        summary: "axis words while no motion mode is active",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(AxisWordsWithoutMotionMode::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct AxisWordsWithoutMotionMode {
    /// What cancelled the motion mode: the first block after each stands for the others.
    told: BTreeSet<Option<At>>,
    unknown_code: bool,
}

remembers!(AxisWordsWithoutMotionMode: told);

impl PathRule for AxisWordsWithoutMotionMode {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        // An unknown code may have chosen a motion mode.
        self.unknown_code |= *fault == Fault::UnknownCode;
        if *fault != Fault::NoMotionMode || cx.has_effect(|effect| effect == Effect::NurbsClose) {
            return;
        }
        let is_axis = |word: &gcheck_program::Word| cx.control().axes().contains(word.letter);
        let mode = cx.state().mode(Role::Motion).only();
        if mode != Some(CodeIx::NONE) || cx.has_effect(|effect| effect == Effect::MachineCoordinates) {
            // What a control does whose documentation does not refuse it is not known. The passes of a lathe are moves as well, and
            // machines go on with them.
            let is_documented = cx.model.semantics().strict || machine_alarm(cx).is_some();
            let passes = Effect::is_turning_pass;
            if !is_documented && mode.is_some_and(|code| passes(cx.model.effect(code))) {
                return;
            }
            let machine = cx.effect_range(|effect| effect == Effect::MachineCoordinates);
            let code =
                cx.code_name(Role::Motion).map_or_else(String::new, |code| format!(" (`{code}` is active)"));
            let finding = cx
                .finding(
                    &META,
                    machine,
                    format!("machine coordinates in a move that is neither `G0` nor `G1`{code}"),
                )
                .label("needs `G0` or `G1`")
                .alarm(machine_alarm(cx))
                .help("write `G0` or `G1` in this block");
            let finding = if is_documented { finding } else { finding.at_most(crate::Severity::Warning) };
            report.add(cx.resting_on(finding, Fact::Mode(Role::Motion), "the motion mode"));
            return;
        }
        let set = |role| cx.definitions().set_by(Fact::Mode(role));
        let cause = set(Role::Cycle).max(set(Role::Motion));
        if cause.is_none() && (self.unknown_code || cx.is_called_only()) || !self.told.insert(cause) {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.word_range(is_axis), "axis words while no motion mode is active")
            .label("no code says how to move")
            .help("write `G0` or `G1` in this block");
        match cause.and_then(|at| cx.range_of(at)) {
            Some(range) => finding = finding.also(range, "the motion mode was cancelled here"),
            None if cause.is_none() => {
                finding = finding
                    .at_most(crate::Severity::Warning)
                    .assuming("no motion mode is active at the start of the program");
            }
            None => {}
        }
        report.add(finding);
    }
}

/// What the control answers to machine coordinates under another motion mode.
fn machine_alarm(cx: &PathCx<'_>) -> Option<String> {
    let code = cx.name_of_effect(Effect::MachineCoordinates)?;
    let alarm = cx.control().alarm_of(META.id, &code)?;
    Some(alarm.number.clone().unwrap_or_else(|| alarm.text.clone()))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_first_axis_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 G0 X0 Y0 Z5\nG80\nN5 X20 Y5\nX30\nG1 X5 F100\nG80 Z2\nM2\n",
            &expect![[r#"
                3 | N5 X20 Y5
                  |    ^^^ error[axis-words-without-motion-mode] axis words while no motion mode is active
                6 | G80 Z2
                  |     ^^ error[axis-words-without-motion-mode] axis words while no motion mode is active
            "#]],
        );
    }

    #[test]
    fn at_the_start_it_is_an_assumption() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90\nX10 Y10\nM2\n",
            &expect![[r#"
            2 | X10 Y10
              | ^^^ warning[axis-words-without-motion-mode] axis words while no motion mode is active
        "#]],
        );
    }

    #[test]
    fn behind_a_code_that_nobody_knows_nothing_is_certain() {
        check_rule(&RULE, "linuxcnc", "G21 G90\nG84.2 X1\nX10 Y10\nM2\n", &expect![[""]]);
    }

    #[test]
    fn where_the_motion_mode_goes_on_behind_a_cycle_nothing_is_wrong() {
        check_rule(&RULE, "haas-mill", "G0 X0 Y0\nG81 Z-1. R.1 F10.\nG80\nX2.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn machine_coordinates_need_a_rapid_or_straight_move() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G17 G90 G0 X0 Y0\nG2 X10 I5 F100\nG53 Z0\nG53 G0 Z0\nM2\n",
            &expect![[r#"
                3 | G53 Z0
                  | ^^^ error[axis-words-without-motion-mode] machine coordinates in a move that is neither `G0` nor `G1` (`G2` is active)
            "#]],
        );
        let program = |pass: &str| format!("G20 T101\nG97 S500 M3\nG0 X1.1 Z.2\n{pass}\nG53 X0\nM30\n");
        for pass in ["G92 X.9 Z-1. F.0625", "G90 X.9 Z-1. F.01", "G94 X.9 Z-1. F.01"] {
            check_rule(&RULE, "haas-lathe", &program(pass), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-lathe",
            &program("G2 X1.3 Z.1 R.1 F.01"),
            &expect![[r#"
            5 | G53 X0
              | ^^^ warning[axis-words-without-motion-mode] machine coordinates in a move that is neither `G0` nor `G1` (`G2` is active)
        "#]],
        );
    }
}
