//! Splines: `g-code.adoc`, G5, G5.1, G5.2 and G5.3.
//!
//! Knows: statements, programs. Must not know: how they are checked.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, refused, runs};

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Splines", key: "SPL", file: "linuxcnc/splines.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g5",
        "G5 is a cubic spline in X and Y: I J lead from the start to the first control point, P Q from the end to the second",
        "effect `spline-cubic`",
        &[runs("G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n", &["NURBS_FEED(", "PROGRAM_END"])],
    ),
    held(
        "#gcode:g5",
        "P and Q are required in every G5 block",
        "words of `G5`",
        &[
            refused(
                "error[required-word-missing]",
                "G17 G90\nF100 G5 I0 J3 P0 X1 Y1\nM2\n",
                "G17 G90\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
            ),
            refused(
                "error[required-word-missing]",
                "G17 G90\nF100 G5 I0 J3 Q-3 X1 Y1\nM2\n",
                "G17 G90\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g5",
        "I and J are given both or not at all",
        "rule `needed-word-missing`",
        &[
            refused(
                "error[needed-word-missing]",
                "G17 G90\nG0 X0 Y0\nF100 G5 I0 P0 Q-3 X1 Y1\nM2\n",
                "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
            ),
            refused(
                "error[needed-word-missing]",
                "G17 G90\nG0 X0 Y0\nF100 G5 J3 P0 Q-3 X1 Y1\nM2\n",
                "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g5",
        "Without I and J a later spline goes on in the direction of the one before",
        "effect `spline-cubic`",
        &[runs(
            "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nG5 P0 Q-3 X2 Y2\nM2\n",
            &["NURBS_FEED(", "NURBS_FEED("],
        )],
    ),
    held(
        "#gcode:g5",
        "The first spline of a series needs I and J, says the documentation; the interpreter (2.9) runs it without",
        "effect `spline-cubic`",
        &[
            runs("G17 G90\nG0 X0 Y0\nF100 G5 P0 Q-3 X1 Y1\nM2\n", &["NURBS_FEED("]),
            runs(
                "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nG1 X2\nG5 P0 Q-3 X3 Y1\nM2\n",
                &["NURBS_FEED(", "STRAIGHT_FEED(2.0000", "NURBS_FEED("],
            ),
        ],
    ),
    held(
        "#gcode:g5",
        "No axis but X and Y may be in a G5 block",
        "`word-forbidden`",
        &[refused(
            "error[word-forbidden]",
            "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1 Z1\nM2\n",
            "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
        )],
    ),
    held(
        "#gcode:g5",
        "G5 outside G17 is refused",
        "rule `refused-in-plane`",
        &[refused(
            "error[refused-in-plane]",
            "G18 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
            "G17 G90\nG0 X0 Y0\nF100 G5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
        )],
    ),
    held(
        "#gcode:g5",
        "X or Y is required (interpreter 2.9), and a feed rate",
        "words of `G5`, rule `feed-missing`",
        &[
            refused(
                "error[word-choice-missing]",
                "G17 G90\nF100 G5 I0 J3 P0 Q-3\nM2\n",
                "G17 G90\nF100 G5 I0 J3 P0 Q-3 X1\nM2\n",
            ),
            refused(
                "error[feed-missing]",
                "G17 G90\nG5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
                "G17 G90 F100\nG5 I0 J3 P0 Q-3 X1 Y1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g5.1",
        "G5.1 is a quadratic spline in X and Y: I J lead from the start to the control point",
        "effect `spline-quadratic`",
        &[runs("G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8\nM2\n", &["NURBS_FEED("])],
    ),
    held(
        "#gcode:g5.1",
        "An offset that is left out is zero, says the documentation; the interpreter (2.9) refuses G5.1 without both",
        "words of `G5.1`",
        &[
            refused(
                "error[required-word-missing]",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2\nM2\n",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8\nM2\n",
            ),
            refused(
                "error[required-word-missing]",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2\nM2\n",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g5.1",
        "I and J of zero both are an error, says the documentation; the interpreter (2.9) runs it",
        "effect `spline-quadratic`",
        &[runs("G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I0 J0\nM2\n", &["NURBS_FEED("])],
    ),
    held(
        "#gcode:g5.1",
        "No axis but X and Y may be in a G5.1 block, and the plane is G17",
        "rules `word-forbidden`, `refused-in-plane`",
        &[
            refused(
                "error[word-forbidden]",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8 Z1\nM2\n",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8\nM2\n",
            ),
            refused(
                "error[refused-in-plane]",
                "G18 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8\nM2\n",
                "G17 G90\nG0 X-2 Y4\nF100 G5.1 X2 I2 J-8\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g5.2-g5.3",
        "G5.2 opens a NURBS, the blocks after it give its control points with X Y and their weights with P, G5.3 closes it and the curve is cut",
        "effects `nurbs-open`, `nurbs-close`",
        &[runs(
            "G0 X0 Y0\nF10\nG5.2 P1 L3\nX0 Y1 P1\nX2 Y2 P1\nX2 Y0 P1\nX0 Y0 P2\nG5.3\nM2\n",
            &["NURBS_FEED("],
        )],
    ),
    held(
        "#gcode:g5.2-g5.3",
        "The point before G5.2 is the first control point; P of G5.2 without X Y is its weight",
        "effect `nurbs-open`",
        &[runs("G0 X5 Y5\nF10\nG5.2 P3 L3\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nM2\n", &["NURBS_FEED("])],
    ),
    gap(
        "#gcode:g5.2-g5.3",
        "The default weight is 1, says the documentation; the interpreter (2.9) refuses a control point without a positive P",
        "`check` reports the control point without P, and one with a P of zero or less (errors), as `run` refuses it",
        &[
            refused(
                "error[required-word-missing]",
                "G0 X0 Y0\nF10\nG5.2 P1 L3\nX0 Y1\nX2 Y2 P1\nG5.3\nM2\n",
                "G0 X0 Y0\nF10\nG5.2 P1 L3\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G0 X0 Y0\nF10\nG5.2 P1 L3\nX0 Y1 P-1\nX2 Y2 P1\nG5.3\nM2\n",
                "G0 X0 Y0\nF10\nG5.2 P1 L3\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g5.2-g5.3",
        "The default order is 3",
        "effect `nurbs-open`",
        &[
            runs("G0 X0 Y0\nF10\nG5.2 P1\nX0 Y1 P1\nX2 Y2 P1\nX2 Y0 P1\nG5.3\nM2\n", &["NURBS_FEED("]),
            runs("G0 X0 Y0\nF10\nG5.2 P1 L4\nX0 Y1 P1\nX2 Y2 P1\nX2 Y0 P1\nG5.3\nM2\n", &["NURBS_FEED("]),
        ],
    ),
    held(
        "#gcode:g5.2-g5.3",
        "G5.3 without G5.2 is refused (interpreter 2.9)",
        "rule `curve-not-complete`",
        &[refused(
            "error[curve-not-complete]",
            "F10\nG5.3\nM2\n",
            "F10\nG5.2 P1\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nM2\n",
        )],
    ),
    held(
        "#gcode:g5.2-g5.3",
        "A NURBS needs a feed rate",
        "rule `feed-missing`",
        &[refused(
            "error[feed-missing]",
            "G0 X0 Y0\nG5.2 P1\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nM2\n",
            "G0 X0 Y0\nF10\nG5.2 P1\nX0 Y1 P1\nX2 Y2 P1\nG5.3\nM2\n",
        )],
    ),
    held(
        "#gcode:g5.2-g5.3",
        "G5.2 and G5.3 are experimental",
        "text of `G5.2`",
        &[explains("G5.2", "experimental")],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
