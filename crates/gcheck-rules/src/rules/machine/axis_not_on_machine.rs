//! A move of an axis that the machine does not have.

use std::collections::BTreeSet;

use gcheck_controls::{Effect, Letter, Unset};
use gcheck_engine::Fault;

use crate::declare::declare_rule;
use crate::{Certainty, PathCx, PathRule, Report, Run, Severity, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block moves an axis that the machine file does not list. Reported once for each axis.
    ///
    /// The rule needs `[machine] axes` in the configuration. Without it a machine may have any axis of its control.
    ///
    /// ## Why it matters
    /// The control stops with an alarm. The program may be for another machine, or for one whose rotary axis has another
    /// letter.
    ///
    /// A word whose variable may hold nothing (`B#500`) is reported as *maybe*: the control ignores it while the variable is
    /// empty.
    ///
    /// ## Reported
    /// With `axes = ["X", "Y", "Z", "A"]` in the machine file:
    /// ```nc,reported,haas-mill
    /// G21 G90
    /// G0 X1. B10.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G21 G90
    /// G0 X1. A10.
    /// M30
    /// ```
    /// Polar interpolation makes the moves of a `Y` that the machine need not have from those of X and the rotary axis.
    /// ```nc,quiet,haas-lathe
    /// G21 G98 G18
    /// G112
    /// G17 G1 X10. Y5. F100.
    /// G2 X5. Y10. I-10. J-5.
    /// G113
    /// M30
    /// ```
    /// ## How to fix it
    /// * If the program is for another machine, post it for this one.
    /// * If the machine has the axis, add it to `[machine] axes` in `gcheck.toml`.
    /// * If the rotary axis has another letter on this machine, correct the word.
    rule "axis-not-on-machine" in "machine" {
        summary: "move of an axis that the machine does not have",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(AxisNotOnMachine::default()) },
    }
}

#[derive(Default, Clone, PartialEq)]
struct AxisNotOnMachine {
    /// Axes that were reported for words that act on every path.
    told: BTreeSet<Letter>,
    /// Axes that were reported for words that may hold nothing.
    told_maybe: BTreeSet<Letter>,
}

remembers!(AxisNotOnMachine: told, told_maybe);

impl PathRule for AxisNotOnMachine {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::NoSuchAxis(letter) = *fault else { return };
        let Some(axes) = cx.environment.machine.axes else { return };
        let acts = acts_for_certain(cx, letter);
        // Where the axis of a cylinder has a value, a rule of its own reports it.
        if acts && cx.has_effect(|effect| effect == Effect::CylinderMapping) {
            return;
        }
        let told = if acts { &mut self.told } else { &mut self.told_maybe };
        if !told.insert(letter) || self.told.contains(&letter) && !acts {
            return;
        }
        let names: Vec<String> =
            "XYZABCUVW".chars().filter(|axis| axes.contains(Letter::of(*axis))).map(String::from).collect();
        let at = cx.word_range(|word| word.letter == letter);
        let finding = if acts {
            cx.finding(&META, at, format!("the machine has no axis `{letter}`"))
        } else {
            let mut finding = cx
                .finding(&META, at, format!("this word may move `{letter}`, which the machine does not have"))
                .note("the control ignores the word while its variable holds nothing, and stops once it has a value")
                .at_most(Severity::Warning);
            finding.certainty = Certainty::Maybe;
            finding
        };
        report.add(
            finding
                .label("not among the axes of the machine file")
                .note(format!("the machine file lists {}", names.join(" ")))
                .help("name an axis that the machine has, or correct `axes` in the machine file"),
        );
    }
}

/// Does the word act on every path? Many controls ignore one whose variable holds nothing.
fn acts_for_certain(cx: &PathCx<'_>, letter: Letter) -> bool {
    if cx.model.semantics().unset == Unset::Zero {
        return true;
    }
    let is_written = cx.has_word(|word| word.letter == letter && word.number().is_some());
    let computed = cx.computed_words();
    let mut values = computed.iter().filter(|(word, _)| word.letter == letter);
    is_written || values.any(|(_, value)| !value.may_be_vacant())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_controls::LetterSet;
    use gcheck_engine::Axis;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    #[test]
    fn once_for_each_axis_whatever_the_control() {
        for control in ["haas-mill", "fanuc-mill", "linuxcnc", "generic-mill"] {
            check_rule_in(
                &RULE,
                control,
                "G21 G90\nG0 X1. B10.\nB20.\n#2=5.\nG1 C#2 F100.\nM30\n",
                &World::of_examples(&META),
                &expect![[r#"
                    2 | G0 X1. B10.
                      |        ^^^^ error[axis-not-on-machine] the machine has no axis `B`
                    5 | G1 C#2 F100.
                      |    ^^^ error[axis-not-on-machine] the machine has no axis `C`
                "#]],
            );
        }
    }

    #[test]
    fn a_word_whose_variable_holds_nothing_moves_no_axis() {
        let program = "G21 G90\nG0 X1. B#1\nM30\n";
        check_rule_in(&RULE, "haas-mill", program, &World::of_examples(&META), &expect![[""]]);
    }

    #[test]
    fn a_word_whose_variable_may_hold_something_may_move_one() {
        for block in ["G0 X1. B#500", "G28 B#500", "G107 Y0. B#500 Q2.5", "G1 B[#500] F10."] {
            let program = format!("G21 G90\n{block}\nM30\n");
            let found = findings(&only(&RULE), "haas-mill", &program, &World::of_examples(&META));
            expect![[r#"
                this word may move `B`, which the machine does not have
                  here: not among the axes of the machine file
                  note: the control ignores the word while its variable holds nothing, and stops once it has a value
                  note: the machine file lists X Y Z A
                  help: name an axis that the machine has, or correct `axes` in the machine file
            "#]]
            .assert_eq(&found.iter().map(words).collect::<String>());
        }
    }

    #[test]
    fn polar_interpolation_brings_the_axis_of_its_control() {
        let mut world = World::of_examples(&META);
        world.machine.axes = Some(LetterSet::of("XZC"));
        world.machine.engine.axes = Some(vec![Axis::X, Axis::Z, Axis::C]);
        let program =
            |on: &str, off: &str| format!("G21 G18 G98\n{on}\nG1 X10. Y5. F100.\nV5.\n{off}\nG1 Y1.\nM30\n");
        check_rule_in(
            &RULE,
            "haas-lathe",
            &program("G112", "G113"),
            &world,
            &expect![[r#"
            6 | G1 Y1.
              |    ^^^ error[axis-not-on-machine] the machine has no axis `Y`
        "#]],
        );
        check_rule_in(
            &RULE,
            "fanuc-lathe",
            &program("G12.1", "G13.1"),
            &world,
            &expect![[r#"
            3 | G1 X10. Y5. F100.
              |         ^^^ error[axis-not-on-machine] the machine has no axis `Y`
            4 | V5.
              | ^^^ error[axis-not-on-machine] the machine has no axis `V`
        "#]],
        );
    }

    #[test]
    fn an_unset_variable_that_counts_as_zero_moves_it_for_certain() {
        let program = "G21 G90\nG0 X1. B#500\nM2\n";
        check_rule_in(
            &RULE,
            "linuxcnc",
            program,
            &World::of_examples(&META),
            &expect![[r#"
            2 | G0 X1. B#500
              |        ^^^^^ error[axis-not-on-machine] the machine has no axis `B`
        "#]],
        );
    }

    #[test]
    fn a_machine_that_nobody_described_may_have_any() {
        check_rule(&RULE, "haas-mill", "G21 G90\nG0 X1. B10.\nM30\n", &expect![[""]]);
    }
}
