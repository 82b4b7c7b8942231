//! Arcs: `g-code.adoc`, G2 and G3.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: advice on drawing and computing arcs, how the refusal's message is read.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, held, legal, ngc, refused, runs, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Arcs", key: "ARC", file: "linuxcnc/arcs.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g2-g3",
        "G2 turns clockwise and G3 counter-clockwise, seen from the positive end of the axis of rotation",
        "effects `arc-clockwise`, `arc-counter-clockwise`",
        &[
            runs(
                "F25\nG2 X0 Y1 I1 J0.5\nG3 X0 Y0 I1 J-0.5\nM2\n",
                &[
                    "ARC_FEED(0.0000, 1.0000, 1.0000, 0.5000, -1, 0.0000",
                    "ARC_FEED(0.0000, 0.0000, 1.0000, 0.5000, 1, 0.0000",
                ],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nG0 X0 Y0 Z0\nF25\nG2 X1 Y1 I1\nG3 X0 Y0 J-1\nM2\n"),
                are: &["rapid X0. Y0.", "arc X1. Y1. I1. J0. S-90", "arc X0. Y0. I1. J0. S90"],
            },
        ],
    ),
    held(
        "#gcode:g2-g3",
        "G17, G18 and G19 choose the plane of the arc, and so its axis",
        "group `plane`",
        &[runs(
            "F25\nG18 G2 X2 Z0 I1\nG19 G3 Y2 Z0 J1\nM2\n",
            &[
                "SELECT_PLANE(CANON_PLANE_XZ)",
                "ARC_FEED(0.0000, 2.0000, 0.0000, 1.0000, -1",
                "SELECT_PLANE(CANON_PLANE_YZ)",
                "ARC_FEED(2.0000, 0.0000, 1.0000, 0.0000, 1",
            ],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "There is no arc in the planes G17.1, G18.1 and G19.1",
        "rule `refused-in-plane`",
        &[refused(
            "error[refused-in-plane]",
            "G21 G90 G17.1\nG0 X0 Y0\nG2 X2 Y0 I1 F100\nM2\n",
            "G21 G90 G17\nG0 X0 Y0\nG2 X2 Y0 I1 F100\nM2\n",
        )],
    ),
    held(
        "#gcode:g2-g3",
        "A word of the axis across the plane makes a helix",
        "effect of `G2`",
        &[
            runs(
                "G0 X0 Y0 Z0\nF10 G17 G2 X6 Y8 I3 J4 Z-1\nM2\n",
                &["ARC_FEED(6.0000, 8.0000, 3.0000, 4.0000, -1, -1.0000"],
            ),
            runs("F10 G18 G2 X2 Z0 I1 Y5\nM2\n", &["ARC_FEED(0.0000, 2.0000, 0.0000, 1.0000, -1, 5.0000"]),
            runs("F10 G19 G2 Y2 Z0 J1 X5\nM2\n", &["ARC_FEED(2.0000, 0.0000, 1.0000, 0.0000, -1, 5.0000"]),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "P adds full turns: P1 is the arc alone, each further one a circle more",
        "`turns = true` of `[semantics.arcs]`",
        &[
            runs(
                "G0 X0 Y0 Z0\nF25\nG2 X0 Y1 Z-1 I1 J0.5 P2\nM2\n",
                &["ARC_FEED(0.0000, 1.0000, 1.0000, 0.5000, -2, -1.0000"],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nG0 X0 Y0 Z0\nF25\nG2 X2 Y0 I1 P2\nM2\n"),
                are: &["rapid X0.", "arc X2. Y0. S-540"],
            },
        ],
    ),
    held(
        "#gcode:g2-g3",
        "Without P there is one turn or part of one",
        "`turns = true` of `[semantics.arcs]`",
        &[runs(
            "F25\nG2 I1\nG3 I1 P1\nM2\n",
            &["ARC_FEED(0.0000, 0.0000, 1.0000, 0.0000, -1", "ARC_FEED(0.0000, 0.0000, 1.0000, 0.0000, 1"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "P must be whole, and at least 1",
        "rules `arc-turns-not-whole`, `number-out-of-range`",
        &[
            refused(
                "error[arc-turns-not-whole]",
                "G17 G21 G90 F100 G2 X1 Y1 I1 P1.5\nM2\n",
                "G17 G21 G90 F100 G2 X1 Y1 I1 P2\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90 F100 G2 X1 Y1 I1 P0\nM2\n",
                "G17 G21 G90 F100 G2 X1 Y1 I1 P1\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90 F100 G2 X1 Y1 I1 P-1\nM2\n",
                "G17 G21 G90 F100 G2 X1 Y1 I1 P1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "A multi-turn helix sinks over all its turns",
        "`turns = true` of `[semantics.arcs]`",
        &[
            runs(
                "G0 X0 Y0 Z0\nF25\nG3 I5 Z-6 P3\nM2\n",
                &["ARC_FEED(0.0000, 0.0000, 5.0000, 0.0000, 3, -6.0000"],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nG0 X0 Y0 Z0\nF25\nG3 I5 Z-6 P3\nM2\n"),
                are: &["rapid Z0.", "arc Z-6. S1080"],
            },
        ],
    ),
    unmodelled(
        "#gcode:g2-g3",
        "A helix of tiny pitch can become a straight line (naive CAM tolerance)",
        "what the planner makes of the functions is not followed; it is a defect of the trajectory planner",
    ),
    held(
        "#gcode:g2-g3",
        "A rotary axis turns at a constant rate along the arc",
        "effect of `G2`",
        &[runs(
            "F100\nG2 X2 Y0 A90 I1\nM2\n",
            &["ARC_FEED(2.0000, 0.0000, 1.0000, 0.0000, -1, 0.0000, 90.0000"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Cutter compensation changes the arc",
        "`[semantics.compensation]`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG3 X30 Y10 J10\nG40\nG1 X40 Y30\nM2\n",
            &["ARC_FEED(28.4125, 10.0000, 20.0000, 10.0000, 1"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "An arc without a feed rate is refused",
        "rule `feed-missing`",
        &[refused(
            "error[feed-missing]",
            "G17 G21 G90\nG0 X0 Y0\nG2 X2 Y0 I1\nM2\n",
            "G17 G21 G90\nG0 X0 Y0\nG2 X2 Y0 I1 F10\nM2\n",
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Centre format: the end may be the start",
        "effect of `G2`",
        &[
            runs(
                "G17 G21 G90\nG0 X0 Y0\nF10\nG2 X0 Y0 I1\nM2\n",
                &["ARC_FEED(0.0000, 0.0000, 1.0000, 0.0000, -1"],
            ),
            legal("G17 G21 G90\nG0 X0 Y0\nF10\nG2 X0 Y0 I1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "A full circle needs no axis word, only a centre word",
        "effect of `G2`",
        &[
            runs("G17 G21 G90\nG0 X0 Y0\nF10\nG2 J3\nM2\n", &["ARC_FEED(0.0000, 0.0000, 0.0000, 3.0000, -1"]),
            Proof::Moves {
                program: ngc("G17 G21 G90\nG0 X0 Y0\nF10\nG2 J3\nM2\n"),
                are: &["rapid X0.", "arc X0. Y0. S-360"],
            },
        ],
    ),
    held(
        "#gcode:g2-g3",
        "Centre words are distances from the start while G91.1 is on, which is the default",
        "group `arc-distance`",
        &[runs(
            "G17 G21 G90\nG0 X10 Y10\nF10\nG2 X12 Y10 I1\nM2\n",
            &["ARC_FEED(12.0000, 10.0000, 11.0000, 10.0000, -1"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "A centre word that is left out is zero under G91.1",
        "effect of `G2`",
        &[runs(
            "G17 G21 G90\nG0 X10 Y10\nF10\nG2 X10 Y12 J1\nM2\n",
            &["ARC_FEED(10.0000, 12.0000, 10.0000, 11.0000, -1"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Under G90.1 centre words are positions from the zero of the axes",
        "effect `arc-centre-absolute`",
        &[runs(
            "G17 G21 G90\nG0 X10 Y10\nF10\nG90.1 G2 X12 Y10 I11 J10\nG2 I11 J10\nM2\n",
            &[
                "ARC_FEED(12.0000, 10.0000, 11.0000, 10.0000, -1",
                "ARC_FEED(12.0000, 10.0000, 11.0000, 10.0000, -1",
            ],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Under G90.1 both centre words of the plane are required",
        "rule `needed-word-missing`",
        &[
            refused(
                "error[needed-word-missing]",
                "G17 G21 G90\nG0 X0 Y0\nF10 G90.1 G2 X2 Y0 I1\nM2\n",
                "G17 G21 G90\nG0 X0 Y0\nF10 G90.1 G2 X2 Y0 I1 J0\nM2\n",
            ),
            refused(
                "error[needed-word-missing]",
                "G18 G21 G90\nG0 X0 Z0\nF10 G90.1 G2 X2 Z0 I1\nM2\n",
                "G18 G21 G90\nG0 X0 Z0\nF10 G90.1 G2 X2 Z0 I1 K0\nM2\n",
            ),
            refused(
                "error[needed-word-missing]",
                "G19 G21 G90\nG0 Y0 Z0\nF10 G90.1 G2 Y2 Z0 J1\nM2\n",
                "G19 G21 G90\nG0 Y0 Z0\nF10 G90.1 G2 Y2 Z0 J1 K0\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "I and J belong to an arc in XY, I and K in ZX, J and K in YZ: the third is refused",
        "rule `arc-wrong-plane-word`",
        &[
            refused(
                "error[arc-wrong-plane-word]",
                "G17 G21 G90\nF10 G2 X1 Y0 K1\nM2\n",
                "G17 G21 G90\nF10 G2 X1 Y0 I.5\nM2\n",
            ),
            refused(
                "error[arc-wrong-plane-word]",
                "G18 G21 G90\nF10 G2 X1 Z0 J.5\nM2\n",
                "G18 G21 G90\nF10 G2 X1 Z0 I.5\nM2\n",
            ),
            refused(
                "error[arc-wrong-plane-word]",
                "G19 G21 G90\nF10 G2 Y1 Z0 I.5\nM2\n",
                "G19 G21 G90\nF10 G2 Y1 Z0 J.5\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "An arc with neither centre nor radius is refused",
        "rule `arc-without-centre`",
        &[refused(
            "error[arc-without-centre]",
            "G17 G21 G90\nF10 G2 X1 Y0\nM2\n",
            "G17 G21 G90\nF10 G2 X1 Y0 I.5\nM2\n",
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Start and end may differ in radius by a tolerance: the documentation prints 0.5 mm / 0.05 inch, or 0.005 mm / 0.0005 inch with 0.1 %; the interpreter (2.9) takes 0.02828 mm / 0.00283 inch and 0.1 % of the radius",
        "`[semantics.arcs] radius-difference`, rule `arc-end-off-circle`",
        &[
            refused(
                "error[arc-end-off-circle]",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X2.03 Y0 I1\nM2\n",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X2.02 Y0 I1\nM2\n",
            ),
            refused(
                "error[arc-end-off-circle]",
                "G17 G20 G90\nG0 X0 Y0\nF10 G2 X2.003 Y0 I1\nM2\n",
                "G17 G20 G90\nG0 X0 Y0\nF10 G2 X2.002 Y0 I1\nM2\n",
            ),
            refused(
                "error[arc-end-off-circle]",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X200.9 Y0 I100\nM2\n",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X200.09 Y0 I100\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "An arc whose centre is its start is refused",
        "rule `zero-radius-arc`",
        &[refused(
            "error[zero-radius-arc]",
            "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 I0 J0\nM2\n",
            "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 I5 J0\nM2\n",
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Radius format: a positive R turns less than half a circle, a negative one more",
        "effect of `G2`",
        &[
            runs(
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X5 Y5 R5\nM2\n",
                &["ARC_FEED(5.0000, 5.0000, 5.0000, 0.0000, -1"],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nG0 X0 Y0\nF10 G2 X5 Y5 R5\nM2\n"),
                are: &["rapid X0.", "arc I5. J0. S-90"],
            },
            Proof::Moves {
                program: ngc("G17 G21 G90\nG0 X0 Y0\nF10 G2 X5 Y5 R-5\nM2\n"),
                are: &["rapid X0.", "arc I0. J5. S-270"],
            },
        ],
    ),
    held(
        "#gcode:g2-g3",
        "Radius format makes a helix with the word of the third axis",
        "effect of `G2`",
        &[runs(
            "G17 G21 G90\nF10\nG0 X0 Y0 Z5\nG17 G2 X10 Y15 R20 Z0\nM2\n",
            &["ARC_FEED(10.0000, 15.0000, 19.8551, -2.4034, -1, 0.0000"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "P counts turns in the radius format too",
        "effect of `G2`",
        &[runs(
            "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 R5 P2\nM2\n",
            &["ARC_FEED(10.0000, 0.0000, 5.0000, 0.0000, -2"],
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Radius format without an end word of the plane is refused",
        "rule `motion-without-axis-words`",
        &[
            refused(
                "error[motion-without-axis-words]",
                "G17 G21 G90\nF10 G2 R5\nM2\n",
                "G17 G21 G90\nF10 G2 X5 R5\nM2\n",
            ),
            refused(
                "error[motion-without-axis-words]",
                "G17 G21 G90\nF10 G2 Z5 R5\nM2\n",
                "G17 G21 G90\nF10 G2 X5 Z5 R5\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "Radius format whose end is its start is refused",
        "rule `full-circle-by-radius`",
        &[refused(
            "error[full-circle-by-radius]",
            "G17 G21 G90\nG0 X0 Y0\nF10 G2 X0 Y0 R5\nM2\n",
            "G17 G21 G90\nG0 X0 Y0\nF10 G2 X1 Y0 R5\nM2\n",
        )],
    ),
    held(
        "#gcode:g2-g3",
        "A radius that does not reach the end is refused (interpreter 2.9; a shortfall of a micrometre is taken)",
        "`radius-slack`, rule `arc-radius-too-small`",
        &[
            refused(
                "error[arc-radius-too-small]",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 R4.99\nM2\n",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 R4.9995\nM2\n",
            ),
            refused(
                "error[zero-radius-arc]",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 R0\nM2\n",
                "G17 G21 G90\nG0 X0 Y0\nF10 G2 X10 Y0 R5\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g2-g3",
        "Centre and radius in one block are refused",
        "`not-together` of `G2`",
        &[refused(
            "error[words-exclude-each-other]",
            "G17 G21 G90\nF10 G2 X10 Y0 R5 I5\nM2\n",
            "G17 G21 G90\nF10 G2 X10 Y0 R5\nM2\n",
        )],
    ),
    held(
        "#gcode:g2-g3",
        "Arcs of nearly half or nearly a full circle by R are ill-conditioned",
        "text of `G2`",
        &[explains("G2", "Near 180 and 360 degrees the centre form is safer")],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
