//! A canned cycle with a rotary axis in its block.

use gcheck_engine::{Axis, CycleFault, Fault};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A block of a canned cycle has a word of a rotary axis (`A`, `B`, `C`), on a control that refuses it.
    ///
    /// ## Why it matters
    /// The control stops with an alarm between two holes.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10
    /// G81 X10 Z-5 R2 A90 F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G21 G90 G0 X0 Y0 Z10 A90
    /// G81 X10 Z-5 R2 F100
    /// M2
    /// ```
    rule "cycle-with-rotary-word" in "cycles" {
        summary: "canned cycle with a rotary axis in its block",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(CycleWithRotaryWord) },
    }
}

struct CycleWithRotaryWord;

impl PathRule for CycleWithRotaryWord {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Cycle(CycleFault::Rotary) {
            return;
        }
        let is_rotary = |word: &gcheck_program::Word| Axis::of(word.letter).is_some_and(Axis::is_rotary);
        report.add(
            cx.finding(&META, cx.word_range(is_rotary), "rotary axis in a block of a canned cycle")
                .label("a cycle cannot turn a rotary axis")
                .help("end the cycle, turn the axis with `G0`, and begin the cycle again"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_rotary_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z10\nG81 X10 Z-5 R2 F100\nX20 B45\nM2\n",
            &expect![[r#"
                3 | X20 B45
                  |     ^^^ error[cycle-with-rotary-word] rotary axis in a block of a canned cycle
            "#]],
        );
    }

    #[test]
    fn other_controls_turn_the_axis_first() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0 Y0 Z1.\nG81 X1. Z-.5 R.1 A90. F10.\nG80\nM30\n",
            &expect![[""]],
        );
    }
}
