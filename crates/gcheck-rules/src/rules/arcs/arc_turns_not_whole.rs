//! An arc whose number of turns is not whole.

use gcheck_engine::{ArcFault, Fault};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// On this control `P` of an arc counts its turns, and its computed value is not a whole number above zero.
    ///
    /// ## Why it matters
    /// The control stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 P[3/2] F100
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// G17 G21 G90 G0 X0 Y0
    /// G2 X10 Y0 I5 P[4/2] F100
    /// M2
    /// ```
    rule "arc-turns-not-whole" in "arcs" {
        summary: "arc whose number of turns is not whole",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(ArcTurnsNotWhole) },
    }
}

struct ArcTurnsNotWhole;

impl PathRule for ArcTurnsNotWhole {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault == Fault::Arc(ArcFault::Turns) {
            let is_whole = cx.known_number('P').is_some_and(|turns| turns.fract() == 0.0);
            let what = if is_whole { "above zero" } else { "whole" };
            report.add(
                cx.finding(
                    &META,
                    cx.letter_range('P'),
                    format!("number of turns of an arc (`P`) that is not {what}"),
                )
                .label("counts turns; a turn that is begun counts as one")
                .help("give a whole number above zero"),
            );
        }
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
            "G17 G21 G90 G0 X0 Y0\nG2 X10 I5 P[1-1] F100\nG3 X0 I-5 P#1\nM2\n",
            &expect![[r#"
                2 | G2 X10 I5 P[1-1] F100
                  |           ^^^^^^ error[arc-turns-not-whole] number of turns of an arc (`P`) that is not above zero
                3 | G3 X0 I-5 P#1
                  |           ^^^ error[arc-turns-not-whole] number of turns of an arc (`P`) that is not above zero
            "#]],
        );
    }

    #[test]
    fn elsewhere_the_word_is_none_of_the_arc() {
        check_rule(
            &RULE,
            "haas-mill",
            "G17 G20 G90 G0 X0. Y0.\nG2 X1. I.5 F10. P[3/2]\nM30\n",
            &expect![[""]],
        );
    }
}
