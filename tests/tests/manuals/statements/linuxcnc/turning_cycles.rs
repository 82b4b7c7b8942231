//! Turning cycles and lathes: `g-code.adoc`, G70 to G72; `lathe-user.adoc`, lathe mode, arcs.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: tool orientations as figures, touch-off, how nose radius shows on a part.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Turning cycles, lathes",
    key: "TRN",
    file: "linuxcnc/turning_cycles.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g70",
        "G70 follows the profile of subroutine Q: rapid to its start, then its moves, and stays at its end",
        "effect `finish-profile`",
        &[runs(
            "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nG91 G0 X1\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(15.0000, 0.0000, 2.0000",
                "STRAIGHT_TRAVERSE(4.0000, 0.0000, 0.0000",
                "STRAIGHT_FEED(4.0000, 0.0000, -5.0000",
                "STRAIGHT_FEED(10.0000, 0.0000, -5.0000",
                "STRAIGHT_FEED(10.0000, 0.0000, -10.0000",
                "STRAIGHT_TRAVERSE(11.0000, 0.0000, -10.0000",
            ],
        )],
    ),
    held(
        "#gcode:g70",
        "X and Z of G70 are where it starts and goes between passes; without them the present place is",
        "effect `finish-profile`",
        &[runs(
            "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100 X12 Z1\nM2\n",
            &["STRAIGHT_TRAVERSE(12.0000, 0.0000, 1.0000", "STRAIGHT_TRAVERSE(4.0000, 0.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:g70",
        "P passes approach the profile from D to E",
        "effect `finish-profile`",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100 D1 E0.2 P3\nM2\n",
                &[
                    "STRAIGHT_FEED(",
                    "STRAIGHT_TRAVERSE(15.0000, 0.0000, 2.0000",
                    "STRAIGHT_FEED(",
                    "STRAIGHT_TRAVERSE(15.0000, 0.0000, 2.0000",
                    "STRAIGHT_FEED(4.2000, 0.0000, -4.8000",
                ],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100 P0\nM2\n",
                &["PROGRAM_END"],
            ),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "G71 takes layers of I off along Z, from X inward, backing off by R, and stays at D from the profile",
        "effect `rough-along-z`",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 D0.5 I2 R0.5\nM2\n",
                &["STRAIGHT_FEED(13.0000", "STRAIGHT_TRAVERSE(13.5000", "STRAIGHT_FEED(11.0000"],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 X14 Z1 I2\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(14.0000, 0.0000, 1.0000",
                    "STRAIGHT_FEED(12.0000, 0.0000, -10.0000",
                    "STRAIGHT_TRAVERSE(12.5000, 0.0000, -9.5000",
                    "STRAIGHT_FEED(8.0000, 0.0000, -5.0000",
                    "STRAIGHT_FEED(10.0000, 0.0000, -10.0000",
                ],
            ),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "I is 1, R 0.5 and D 0 without their words, in millimetres and in inches alike (interpreter 2.9)",
        "effect `rough-along-z`",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100\nM2\n",
                &["STRAIGHT_FEED(14.0000", "STRAIGHT_TRAVERSE(14.5000", "STRAIGHT_FEED(13.0000"],
            ),
            runs(
                "G18 G20\nO100 SUB\nG0 X0 Z0\nG1 X.5\nG1 Z-.5\nG1 X1\nO100 ENDSUB\nF10\nG0 X1.5 Z.2\nG71 Q100\nM2\n",
                &["STRAIGHT_FEED("],
            ),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "G72 does the same with layers along X",
        "effect `rough-along-x`",
        &[runs(
            "G18\nO100 SUB\nG0 X12 Z-12\nG1 Z-5\nG1 X6\nG1 Z0\nG1 X1\nO100 ENDSUB\nF100\nG0 X15 Z2\nG72 Q100 I1\nM2\n",
            &["STRAIGHT_FEED(1.0000, 0.0000, 1.0000", "STRAIGHT_FEED(1.0000, 0.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:g71-g72",
        "G71 and G72 cut the whole profile with its pockets, G71.1 and G72.1 none of them, G71.2 and G72.2 only what follows the first pocket",
        "effects `rough-along-z`, `rough-along-x`",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X2\nG1 Z-7\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I1\nM2\n",
                &["STRAIGHT_FEED("],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X2\nG1 Z-7\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71.1 Q100 I1 D1\nG71.2 Q100 I1 D0.5\nG70 Q100\nM2\n",
                &["STRAIGHT_FEED("],
            ),
            runs(
                "G18\nO100 SUB\nG0 X12 Z-12\nG1 Z-5\nG1 X6\nG1 Z0\nG1 X1\nO100 ENDSUB\nF100\nG0 X15 Z2\nG72.1 Q100 I1\nG72.2 Q100 I1\nM2\n",
                &["STRAIGHT_FEED("],
            ),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "The profile holds G0 to G3; G0 counts as G1; feeds, speeds and other codes in it are ignored",
        "effect `rough-along-z`",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG0 Z-5 F10 S300\nM8\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I2\nM2\n",
                &["SET_FEED_RATE(100.0000", "STRAIGHT_FEED(4.0000, 0.0000, -5.0000", "SET_FEED_RATE(0.0000"],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG2 X8 Z-9 I4\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
                &["ARC_FEED("],
            ),
        ],
    ),
    gap(
        "#gcode:g71-g72",
        "A of a move in the profile puts a fillet of that radius at its end",
        "`run` rounds the corner with an arc of radius A in G70, G71 and G72 (today A is read as an angle of the line, which makes wild moves, or the profile is not found); a fillet that does not fit is refused as a profile that turns back",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5 A1\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
                &["STRAIGHT_FEED(4.0000, 0.0000, -4.0000", "ARC_FEED(-5.0000, 5.0000, -4.0000, 5.0000, -1"],
            ),
            runs(
                "G18\nO100 SUB\nG0 X0 Z0\nG1 X5 A1\nG1 Z-5\nG1 X10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
                &["STRAIGHT_FEED(4.0000, 0.0000, 0.0000", "ARC_FEED("],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5 A1\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I2\nM2\n",
                &["ARC_FEED("],
            ),
            stops(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5 A9\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I2\nM2\n",
            ),
        ],
    ),
    gap(
        "#gcode:g71-g72",
        "C of a move in the profile puts a chamfer at its end, with the end points that a fillet of that size would have",
        "`run` cuts the corner in G70, G71 and G72 (today the corner stays sharp)",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5 C1\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
                &["STRAIGHT_FEED(4.0000, 0.0000, -4.0000", "STRAIGHT_FEED(5.0000, 0.0000, -5.0000"],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5 C1\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I2\nM2\n",
                &["STRAIGHT_FEED(5.0000, 0.0000, -5.0000"],
            ),
        ],
    ),
    gap(
        "#gcode:g71-g72",
        "U and W of the profile are increments of X and Z under G90",
        "`run` moves X and Z by U and W in a profile (today they are not read and the profile collapses)",
        &[
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 W-5\nG1 U6\nG1 W-5\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
                &[
                    "STRAIGHT_FEED(4.0000, 0.0000, -5.0000",
                    "STRAIGHT_FEED(10.0000, 0.0000, -5.0000",
                    "STRAIGHT_FEED(10.0000, 0.0000, -10.0000",
                ],
            ),
            runs(
                "G18\nO100 SUB\nG0 X4 Z0\nG1 W-5\nG1 U6\nG1 W-5\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I2\nM2\n",
                &["STRAIGHT_FEED(10.0000, 0.0000, -10.0000"],
            ),
        ],
    ),
    gap(
        "#gcode:g71-g72",
        "G90 and G91 in the profile: the interpreter (2.9) ignores a change of mode made there",
        "`run` reads the profile in the mode that is on at the cycle, as all codes but moves are ignored",
        &[runs(
            "G18\nO100 SUB\nG0 X4 Z0\nG91 G1 Z-5\nG1 X6\nG1 Z-5\nG90\nO100 ENDSUB\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
            &["STRAIGHT_FEED(4.0000, 0.0000, -5.0000", "STRAIGHT_FEED(6.0000, 0.0000, -5.0000"],
        )],
    ),
    held(
        "#gcode:g71-g72",
        "Q is required, whole and the number of a subroutine",
        "words of `G71`",
        &[
            refused(
                "error[required-word-missing]",
                "G18\nF100\nG71 I1\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q-1 I1\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "A subroutine that does not exist is refused",
        "rule `turning-profile-not-usable`, `whole` of `Q`",
        &[
            refused(
                "warning[turning-profile-not-usable]",
                "G18\nF100\nG0 X15 Z2\nG71 Q100 I1\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
            refused(
                "warning[turning-profile-not-usable]",
                "G18\nF100\nG0 X15 Z2\nG70 Q100\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG70 Q100\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100.5 I1\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
        ],
    ),
    gap(
        "#gcode:g71-g72",
        "A profile that turns back is refused: in Z for G71, in X for G72",
        "`check` reports a profile of a subroutine that turns back (error where its numbers are known), as `run` refuses it",
        &[refused(
            "error[turning-profile-turns-back]",
            "G18 G21 G90\nO100 SUB\nG0 X0 Z0\nG1 X5\nG1 Z-5\nG1 X10\nG1 Z-3\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I1\nM2\n",
            "G18 G21 G90\nO100 SUB\nG0 X0 Z0\nG1 X5\nG1 Z-5\nG1 X10\nG1 Z-8\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I1\nM2\n",
        )],
    ),
    held(
        "#gcode:g71-g72",
        "The plane must be ZX",
        "rule `cycle-numbers-contradict`",
        &[
            rule(
                "error[cycle-numbers-contradict]",
                "G17 G21 G90\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
                "G18 G21 G90\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
            stops("G17\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n"),
            stops("G17\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG70 Q100\nM2\n"),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "Under cutter compensation they are refused",
        "rule `refused-under-compensation`",
        &[refused(
            "error[refused-under-compensation]",
            "G18 G21 G90\nT1 M6\nO100 SUB\nG0 X0 Z0\nG1 X5\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X35 Z2\nG41\nG1 X15\nG71 Q100 I1\nM2\n",
            "G18 G21 G90\nT1 M6\nO100 SUB\nG0 X0 Z0\nG1 X5\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X35 Z2\nG1 X15\nG71 Q100 I1\nM2\n",
        )],
    ),
    held(
        "#gcode:g71-g72",
        "I of zero or less is refused (interpreter 2.9)",
        "words of `G71`",
        &[
            refused(
                "error[number-out-of-range]",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I0\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I-1\nM2\n",
                "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g71-g72",
        "P and L are not words of G71 (interpreter 2.9)",
        "words of `G71`",
        &[refused(
            "error[word-not-read]",
            "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1 P2\nM2\n",
            "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nO100 ENDSUB\nF100\nG0 X5\nG71 Q100 I1\nM2\n",
        )],
    ),
    held(
        "#gcode:g71-g72",
        "Under G7 X of the profile is a diameter; D, I and R count as they stand (interpreter 2.9)",
        "effect `rough-along-z`",
        &[runs(
            "G18 G7\nO100 SUB\nG0 X8 Z0\nG1 Z-5\nG1 X20\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X30 Z2\nG71 Q100 I1 D0.5 R0.5\nM2\n",
            &["STRAIGHT_FEED("],
        )],
    ),
    held(
        "#gcode:g71-g72",
        "The passes are made and timed, not the profile alone",
        "effect `rough-along-z`",
        &[Proof::Stats {
            program: ngc(
                "G18 G21 G90\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X10 Z2\nG71 Q100 I2 R0\nM2\n",
            ),
            prints: &["no tool 0:21.1 0:21.0 0:00.1 35"],
        }],
    ),
    held(
        "#gcode:g71-g72",
        "The motion mode after the cycle is as before it (interpreter 2.9)",
        "effect `rough-along-z`",
        &[runs(
            "G18\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 X15 Z2\nG71 Q100 I2\nX20\nM2\n",
            &["STRAIGHT_FEED(10.0000, 0.0000, -10.0000"],
        )],
    ),
    held(
        "#cha:lathe-user-information",
        "A lathe starts in G17 too: the program must say G18",
        "`at-start` of `[semantics]`",
        &[runs("G0 X#<_plane>\nM2\n", &["STRAIGHT_TRAVERSE(170.0000"]), explains("G18", "lathe")],
    ),
    held(
        "#cha:lathe-user-information",
        "Arcs in ZX take I along X and K along Z, and G2 and G3 turn as seen along Y: for a tool before the centre they look exchanged",
        "effects `arc-clockwise`, `arc-counter-clockwise`",
        &[runs(
            "G18 G0 X10 Z0\nF10 G2 X12 Z-2 I2\nG3 X14 Z-4 K-2\nM2\n",
            &[
                "ARC_FEED(-2.0000, 12.0000, 0.0000, 12.0000, -1",
                "ARC_FEED(-4.0000, 14.0000, -4.0000, 12.0000, 1",
            ],
        )],
    ),
    held(
        "#cha:lathe-user-information",
        "Under G7 the end X of an arc is a diameter and I a radius",
        "effect `diameter-on`",
        &[
            runs(
                "G18 G7 G0 X20 Z0\nF100 G3 X0 Z-10 I-10\nM2\n",
                &["STRAIGHT_TRAVERSE(10.0000", "ARC_FEED(-10.0000, 0.0000, 0.0000, 0.0000, 1"],
            ),
            runs(
                "G18 G7 G0 X20 Z0\nF100 G3 X0 Z-10 R10\nM2\n",
                &["ARC_FEED(-10.0000, 0.0000, 0.0000, 0.0000, 1"],
            ),
        ],
    ),
    unmodelled(
        "#cha:lathe-user-information",
        "A finishing cut to the centre must go past it by the nose radius",
        "the part is not simulated",
    ),
    unmodelled("#cha:lathe-user-information", "`LATHE = TRUE` changes the display", "user interface"),
    gap(
        "#gcode:g71-g72",
        "The cycles remove layers of material: none of them is a hole",
        "`stats` counts no holes for G70 to G72 (it counts each layer as one today)",
        &[Proof::Stats {
            program: ngc(
                "G17 G21 G90\nO100 SUB\nG0 X4 Z0\nG1 Z-5\nG1 X10\nG1 Z-10\nO100 ENDSUB\nF100\nG0 Z2\nG81 Z-1 R1\nG80\nG18 G0 X10 Z2\nG71 Q100 I2 R0\nM2\n",
            ),
            prints: &["100/min 0 rpm 1"],
        }],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
