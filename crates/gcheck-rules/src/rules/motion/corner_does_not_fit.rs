//! A chamfer or rounding for which the cuts at the corner have no room.

use gcheck_controls::{Letter, LetterSet};
use gcheck_engine::{CornerFault, Fault};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Watch};

declare_rule! {
    /// A block asks for a chamfer or a rounding to the next cut (`,C`, `,R`), and one of the two cuts is too short for
    /// it, no second cut in the plane comes, or it goes straight on.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block, in the middle of the contour.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G20 G17 G90 G54 G0 X0. Y0.
    /// G1 X1. ,R3. F10.
    /// Y1.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20 G17 G90 G54 G0 X0. Y0.
    /// G1 X1. ,R.3 F10.
    /// Y1.
    /// M30
    /// ```
    rule "corner-does-not-fit" in "motion" {
        summary: "chamfer or rounding that the cuts at the corner have no room for",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(CornerDoesNotFit) },
    }
}

struct CornerDoesNotFit;

impl PathRule for CornerDoesNotFit {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        let Fault::Corner(corner) = *fault else { return };
        let range = cx.word_range(shapes_corner);
        report.add(match corner {
            CornerFault::RapidAfter => return,
            CornerFault::NoCutAfter => cx
                .finding(&META, range, "chamfer or rounding without a second cut")
                .label("no straight cut in this plane comes after it")
                .help("write the cut that the corner leads to, or remove the word"),
            CornerFault::NoTurn => cx
                .finding(&META, range, "chamfer or rounding where the path does not turn")
                .label("the next cut goes on in the same direction")
                .help("check the end points of the two cuts, or remove the word"),
            CornerFault::TooLong { needed, available } => cx
                .finding(&META, range, "chamfer or rounding does not fit between its two cuts")
                .label(if needed.is_finite() {
                    format!(
                        "takes {} of each cut, and the shorter one has {}",
                        cx.shown(Mm(needed)),
                        cx.shown(Mm(available))
                    )
                } else {
                    "the next cut goes straight back".to_owned()
                })
                .help("make the corner smaller, or check the end points of the two cuts"),
        });
    }
}

/// Does a word of a straight cut shape its end?
fn shapes_corner(word: &Word) -> bool {
    let letters: LetterSet = [Letter::CORNER_R, Letter::CORNER_C].into_iter().collect();
    letters.or(const { LetterSet::of("RIK") }).contains(word.letter)
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
            "fanuc-mill",
            "G21 G17 G90 G54 G0 X0. Y0.\nG1 X10. ,R12. F100.\nY10. ,C2.\nX9.\nX20. ,C1.\nM30\n",
            &expect![[r#"
                2 | G1 X10. ,R12. F100.
                  |         ^^^^^ warning[corner-does-not-fit] chamfer or rounding does not fit between its two cuts
                3 | Y10. ,C2.
                  |      ^^^^ warning[corner-does-not-fit] chamfer or rounding does not fit between its two cuts
                5 | X20. ,C1.
                  |      ^^^^ warning[corner-does-not-fit] chamfer or rounding without a second cut
            "#]],
        );
    }

    #[test]
    fn two_corners_share_the_cut_between_them() {
        let program = |second: &str| {
            format!("G20 G17 G90 G54 G0 X0. Y0.\nG1 X1. ,R.6 F10.\nY1. ,R{second}\nX0.\nM30\n")
        };
        check_rule(&RULE, "haas-mill", &program(".4"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program(".5"),
            &expect![[r#"
            3 | Y1. ,R.5
              |     ^^^^ warning[corner-does-not-fit] chamfer or rounding does not fit between its two cuts
        "#]],
        );
    }

    #[test]
    fn a_pause_and_coolant_may_be_between_the_cuts() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G17 G90 G54 G0 X0. Y0.\nG1 X1. ,R.3 F10.\nG4 P1.\nM8\nY1.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn haas_mills_make_no_corner_with_an_arc_or_on_a_straight_line() {
        let program = |next: &str| format!("G20 G17 G90 G54 G0 X0. Y0.\nG1 X1. ,C.3 F10.\n{next}\nM30\n");
        for next in ["G2 X2. Y-1. R1.", "X2."] {
            check_rule(&RULE, "fanuc-mill", &program(next), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-mill",
            &program("G2 X2. Y-1. R1."),
            &expect![[r#"
            2 | G1 X1. ,C.3 F10.
              |        ^^^^ warning[corner-does-not-fit] chamfer or rounding without a second cut
        "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            &program("X2."),
            &expect![[r#"
            2 | G1 X1. ,C.3 F10.
              |        ^^^^ warning[corner-does-not-fit] chamfer or rounding where the path does not turn
        "#]],
        );
    }

    #[test]
    fn a_cut_along_the_tool_is_none_in_the_plane() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G17 G90 G54 G0 X0. Y0. Z1.\nG1 X1. ,C.3 F10.\nZ-1.\nY1.\nM30\n",
            &expect![[r#"
                2 | G1 X1. ,C.3 F10.
                  |        ^^^^ warning[corner-does-not-fit] chamfer or rounding without a second cut
            "#]],
        );
    }
}
