//! A chamfer or rounding before a rapid move.

use gcheck_controls::{Effect, Letter, LetterSet};
use gcheck_engine::{At, CornerFault, Fault};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::turning::{is_roughing, profile_blocks};
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};

declare_rule! {
    /// A block asks for a chamfer or a rounding to the next move (`,C`, `,R`; on lathes also `C`, `R`, `I`, `K`), and the next
    /// move is a rapid one.
    ///
    /// ## Why it matters
    /// The corner needs a cut on both sides: before a rapid move it does not exist, and the control stops with an
    /// alarm.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-lathe
    /// G21 T0101
    /// G97 S500 M3
    /// G99 G0 X20. Z2.
    /// G1 X10. ,R2. F.1
    /// G0 Z5.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-lathe
    /// G21 T0101
    /// G97 S500 M3
    /// G99 G0 X20. Z2.
    /// G1 X10. ,R2. F.1
    /// G1 Z-5.
    /// G0 X30.
    /// M30
    /// ```
    rule "corner-before-rapid" in "motion" {
        summary: "chamfer or rounding before a rapid move",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS.union(Watch::BLOCKS), make: || Box::new(CornerBeforeRapid) },
    }
}

struct CornerBeforeRapid;

impl PathRule for CornerBeforeRapid {
    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.file_index.letters.intersects(ON_LATHES.or(corners()))
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_roughing) {
            return;
        }
        // A cycle does not make its passes block by block.
        let last = profile_blocks(cx).map(|(_, last)| last);
        // A rapid move at the end takes the tool away from the profile.
        let is_rapid = |word: &Word| cx.model.effect(word.code) == Effect::Rapid;
        let last_cut = last.map(|last| match last.block.checked_sub(1) {
            Some(block) if cx.find_word(last, is_rapid).is_some() => At { block, ..last },
            _ => last,
        });
        if let Some(corner) = last_cut.and_then(|at| cx.find_word(at, is_corner)) {
            report.add(
                cx.finding(&META, corner, "chamfer or rounding at the end of a turning profile")
                    .label("needs another cut of the profile after it")
                    .also(cx.range(), "the cycle that follows the profile")
                    .help("end the profile with a cut after the corner, or remove the word")
                    .at_most(Severity::Warning),
            );
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::Corner(CornerFault::RapidAfter) {
            return;
        }
        let has_comma = cx.origin().letters.intersects(corners());
        let is_corner_here =
            |word: &Word| if has_comma { is_corner(word) } else { ON_LATHES.contains(word.letter) };
        report.add(
            cx.finding(&META, cx.word_range(is_corner_here), "chamfer or rounding before a rapid move")
                .label("needs a cut after it")
                .help("end the contour with a cut after the corner, or remove the word")
                .at_most(Severity::Warning),
        );
    }
}

/// A programmed corner of some size.
fn is_corner(word: &Word) -> bool {
    corners().contains(word.letter) && word.number() != Some(0.0)
}

/// Words of a straight cut that lathes read as a corner, without a comma.
const ON_LATHES: LetterSet = LetterSet::of("RCIK");

fn corners() -> LetterSet {
    [Letter::CORNER_R, Letter::CORNER_C].into_iter().collect()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_profile_ends_with_a_cut() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG0 X60. Z5.\nG71 U2. R1.\nG71 P10 Q20 U0.5 W0.1 F0.25\nN10 G0 X30.\nG1 Z-20. ,R1.\nN20 X60. ,R1.\nG0 X80.\nM30\n",
            &expect![[r#"
                8 | N20 X60. ,R1.
                  |          ^^^^ warning[corner-before-rapid] chamfer or rounding at the end of a turning profile
            "#]],
        );
    }

    #[test]
    fn a_rapid_move_at_the_end_of_a_profile_is_no_cut() {
        check_rule(
            &RULE,
            "haas-lathe",
            "G20 G18 G99 T0101\nG97 S500 M3\nG0 X3. Z.1\nG71 P10 Q20 U.01 W.005 D.05 F.01\nN10 G0 X-.06\nG1 Z0.\nX3. ,R.1\nN20 G0 Z.1\nM30\n",
            &expect![[r#"
                7 | X3. ,R.1
                  |     ^^^^ warning[corner-before-rapid] chamfer or rounding at the end of a turning profile
            "#]],
        );
    }

    #[test]
    fn lathes_write_corners_without_a_comma() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 T0101\nG97 S500 M3\nG99 G0 X40. Z2.\nG1 Z-10. F.1\nX50. R1.\nG0 X100. Z100.\nM30\n",
            &expect![[r#"
                5 | X50. R1.
                  |      ^^^ warning[corner-before-rapid] chamfer or rounding before a rapid move
            "#]],
        );
    }

    #[test]
    fn an_arc_takes_the_corner() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G17 G90 G54 G0 X0. Y0.\nG1 X10. ,R2. F100.\nG2 X20. Y10. R10.\nG0 Z5.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn the_word_is_marked() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G17 G90 G54 G0 X0. Y0.\nG1 X10. ,C2. F100.\nG0 Z5.\nM30\n",
            &expect![[r#"
                2 | G1 X10. ,C2. F100.
                  |         ^^^^ warning[corner-before-rapid] chamfer or rounding before a rapid move
            "#]],
        );
    }
}
