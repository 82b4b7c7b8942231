//! Coordinate systems and shifts: `g-code.adoc`, G52 to G59.3, G92 to G92.3; `coordinates.adoc`; `user-concepts.adoc`,
//! coordinate systems.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: homing, touch-off and displays of the user interface, editing of the parameter file.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Coordinate systems, shifts",
    key: "CRD",
    file: "linuxcnc/coordinates.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g53",
        "G53 takes the axis words of its block as machine coordinates, whatever systems, shifts and lengths are on",
        "effect `machine-coordinates`",
        &[
            Proof::Moves {
                program: ngc("G21 G90\nG10 L2 P1 X10 Y20\nG52 X3\nG53 G0 X0 Y0 Z0\nG52 X0\nM2\n"),
                are: &["rapid X-13. Y-20. MX0. MY0. MZ0."],
            },
            runs(
                "G10 L2 P1 X10\nG52 X3\nT1 M6 G43\nG0 Z50\nG53 G0 X0 Z0\nM2\n",
                &["STRAIGHT_TRAVERSE(-13.0000, 0.0000, -12.9794"],
            ),
        ],
    ),
    held(
        "#gcode:g53",
        "G53 holds for its block only",
        "effect `machine-coordinates`",
        &[runs(
            "G10 L2 P1 X5\nG0 X1\nG53 X2\nX2\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(-3.0000", "STRAIGHT_TRAVERSE(2.0000"],
        )],
    ),
    held(
        "#gcode:g53",
        "G0 and G1 need not be in the block of G53 when one is on",
        "effect `machine-coordinates`",
        &[runs("F100 G1 X1\nG53 X2\nM2\n", &["STRAIGHT_FEED(2.0000"])],
    ),
    held(
        "#gcode:g53",
        "G53 while neither G0 nor G1 is on is refused",
        "rules `axis-words-without-motion-mode`, `codes-conflict`",
        &[
            refused(
                "error[axis-words-without-motion-mode]",
                "G17 G21 G90\nG0 X0 Y0\nF100 G2 X1 Y1 I1\nG53 X2\nM2\n",
                "G17 G21 G90\nG0 X0 Y0\nF100 G2 X1 Y1 I1\nG53 G0 X2\nM2\n",
            ),
            refused("error[codes-conflict]", "G53 G2 X1 I1 F100\nM2\n", "G53 G1 X1 F100\nM2\n"),
            refused("error[codes-conflict]", "G53 G81 Z-1 R1 F100\nM2\n", "G53 G0 Z-1\nM2\n"),
            stops("G80\nG53 X2\nM2\n"),
            rule("warning[axis-words-without-motion-mode]", "G80\nG53 X2\nM2\n", "G0\nG53 X2\nM2\n"),
        ],
    ),
    held(
        "#gcode:g53",
        "G53 under cutter compensation is refused",
        "rule `refused-under-compensation`",
        &[refused(
            "error[refused-under-compensation]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG53 G0 X0\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG53 G0 X0\nM2\n",
        )],
    ),
    held(
        "#gcode:g53",
        "The move right after G40 may be one in machine coordinates: the other axes go to their programmed places (interpreter 2.9)",
        "effect of `G53`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG53 G0 X30\nM2\n",
            &["STRAIGHT_TRAVERSE(30.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:g53",
        "G53 under G91 is refused (interpreter 2.9)",
        "rule `machine-coordinates-in-increments`",
        &[refused("error[machine-coordinates-in-increments]", "G91 G53 G0 X5\nM2\n", "G90 G53 G0 X5\nM2\n")],
    ),
    held(
        "#gcode:g53",
        "G53 without axis words moves nothing",
        "effect `machine-coordinates`",
        &[runs("G53 G0\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#gcode:g53",
        "G53 with polar words is refused (interpreter 2.9)",
        "words of `G53`",
        &[refused("error[word-forbidden]", "G53 G0 @1^90\nM2\n", "G53 G0 X1\nM2\n")],
    ),
    held(
        "#gcode:g54-g59.3",
        "G54 to G59, G59.1 to G59.3 choose coordinate systems 1 to 9 and last",
        "effects `work-offset`",
        &[runs(
            "G59.3\nG0 X#5220 Y#<_coord_system>\nG56\nX#5220\nM2\n",
            &[
                "SET_G5X_OFFSET(9",
                "STRAIGHT_TRAVERSE(9.0000, 593.0000",
                "SET_G5X_OFFSET(3",
                "STRAIGHT_TRAVERSE(3.0000",
            ],
        )],
    ),
    held(
        "#gcode:g54-g59.3",
        "Their origins are #5221 and up, 20 apart, X Y Z A B C U V W and the rotation",
        "system variables `work-offset`, `work-rotation`",
        &[
            runs(
                "#5241=2 #5242=1 #5243=-2\nG55\nG0 X0\nM2\n",
                &["SET_G5X_OFFSET(2, 50.8000, 25.4000, -50.8000"],
            ),
            runs(
                "G10 L2 P2 X25.4 R10\nG0 X#5241 Y#5250\nG10 L2 P9 X25.4 A5\nX#5381 Y#5384\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 10.0000", "STRAIGHT_TRAVERSE(1.0000, 5.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g54-g59.3",
        "Choosing one under cutter compensation is refused",
        "rule `refused-under-compensation`",
        &[refused(
            "error[refused-under-compensation]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG55\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG55\nM2\n",
        )],
    ),
    held(
        "#cha:coordinate-system",
        "Choosing a system shifts the zero for the moves that follow; the block itself moves nothing (interpreter 2.9)",
        "effect `work-offset`",
        &[
            runs(
                "G10 L2 P2 X3\nG0 X10\nG55\nG0 Y#5420\nM2\n",
                &["STRAIGHT_TRAVERSE(10.0000", "STRAIGHT_TRAVERSE(7.0000, 7.0000"],
            ),
            Proof::Moves { program: ngc("G21 G90\nG10 L2 P2 X3\nG0 X10\nG55\nM2\n"), are: &["rapid X10."] },
        ],
    ),
    held(
        "#gcode:g54-g59.3",
        "There is no G59.4",
        "rule `unknown-code`",
        &[stops("G59.4\nM2\n"), rule("warning[unknown-code]", "G59.4\nM2\n", "G59.3\nM2\n")],
    ),
    held(
        "#gcode:g52",
        "G52 shifts the active system by its axis words; an axis that is left out keeps its shift",
        "effect `local-shift`",
        &[Proof::Moves {
            program: ngc(
                "G21 G90\nG10 L2 P1 X10 Y0 Z0\nG52 X1 Y2\nG0 X0 Y0 Z0\nG52 X0\nG0 X0 Y0\nG52 Y0\nM2\n",
            ),
            are: &["rapid MX11. MY2. MZ0.", "rapid MX10. MY2."],
        }],
    ),
    held(
        "#sec:g52",
        "G52 with zero ends the shift of that axis only",
        "rule `shift-left-on`",
        &[rule(
            "warning[shift-left-on]",
            "G21 G90\nG52 X1 Y2\nG0 X0 Y0\nG52 X0\nG0 X0 Y0\nM2\n",
            "G21 G90\nG52 X1 Y2\nG0 X0 Y0\nG52 X0 Y0\nG0 X0 Y0\nM2\n",
        )],
    ),
    held(
        "#sec:g52",
        "G52 counts after the rotation of the system",
        "effect `local-shift`",
        &[Proof::Moves {
            program: ngc("G21 G90\nG10 L2 P1 X0 Y0 R90\nG52 X5\nG0 X0 Y0\nG52 X0\nM2\n"),
            are: &["rapid MX0. MY5."],
        }],
    ),
    held(
        "#sec:g52",
        "The position reads less by the shift",
        "effect `local-shift`",
        &[runs(
            "G0 X10 Y10\nG52 X1 Y2\nG0 Z#5420\nG0 A#5421\nM2\n",
            &["STRAIGHT_TRAVERSE(9.0000, 8.0000, 9.0000", "STRAIGHT_TRAVERSE(9.0000, 8.0000, 9.0000, 8.0000"],
        )],
    ),
    held(
        "#sec:g52",
        "G52 without axis words is refused (interpreter 2.9)",
        "words of `G52`",
        &[refused("error[word-choice-missing]", "G52\nM2\n", "G52 X0\nM2\n")],
    ),
    held(
        "#sec:g52-and-g92-offsets",
        "G52 and G92 share their registers: G52 replaces what G92 has set, axis by axis",
        "`local-shift = \"shared\"`",
        &[runs(
            "G92 X5\nG52 X1\nG0 X0\nG92.1\nM2\n",
            &["SET_G92_OFFSET(-5.0000", "SET_G92_OFFSET(1.0000", "SET_G92_OFFSET(0.0000"],
        )],
    ),
    held(
        "#sec:g92-g52-interaction-cautions",
        "G52 outlives M2 and M30, as G92 does",
        "rule `shift-left-on`",
        &[rule(
            "warning[shift-left-on]",
            "G21 G90\nG52 X5\nG0 X0\nM30\n",
            "G21 G90\nG52 X5\nG0 X0\nG92.1\nM30\n",
        )],
    ),
    held(
        "#gcode:g92",
        "G92 makes the present point have the coordinates that its words say, without moving",
        "effect `set-position`",
        &[
            runs("G0 X4\nG92 X7\nG0 X8\nM2\n", &["SET_G92_OFFSET(-3.0000", "STRAIGHT_TRAVERSE(8.0000"]),
            Proof::Moves {
                program: ngc("G21 G90\nG10 L2 P1 X0 Y0 Z0\nG0 X4\nG92 X7\nG0 X8\nG92.1\nM2\n"),
                are: &["rapid MX4.", "rapid X8. MX5."],
            },
        ],
    ),
    held(
        "#gcode:g92",
        "An axis that G92 leaves out has no shift, says the documentation; with the interpreter (2.9) it keeps its shift",
        "effect `set-position`",
        &[runs(
            "G0 X4 Y5\nG92 X0\nG92 Y0\nG0 X4 Y0\nM2\n",
            &["SET_G92_OFFSET(4.0000, 0.0000", "SET_G92_OFFSET(4.0000, 5.0000"],
        )],
    ),
    held(
        "#gcode:g92",
        "All coordinate systems move by the same distance",
        "effect `set-position`",
        &[Proof::Moves {
            program: ngc("G21 G90\nG10 L2 P1 X0\nG10 L2 P2 X100\nG0 X4\nG92 X0\nG55 G0 X0\nG92.1\nM2\n"),
            are: &["rapid MX4.", "rapid MX104."],
        }],
    ),
    held(
        "#gcode:g92",
        "The shift is in #5211 to #5219, in the machine's unit; #5210 says that it is on",
        "system variables `shift`, `shift-active`",
        &[runs("G0 X25.4\nG92 X0\nG0 Y#5211 Z#5210\nM2\n", &["STRAIGHT_TRAVERSE(0.0000, 1.0000, 1.0000"])],
    ),
    held(
        "#gcode:g92",
        "G91 has no effect on G92",
        "effect `set-position`",
        &[runs(
            "G0 X4\nG91 G92 X7\nG90 G0 X7\nM2\n",
            &["SET_G92_OFFSET(-3.0000", "STRAIGHT_TRAVERSE(7.0000"],
        )],
    ),
    held(
        "#gcode:g92",
        "A further G92 replaces the shift so that the point reads as told",
        "effect `set-position`",
        &[runs("G0 X2\nG92 X0\nG92 X5\nM2\n", &["SET_G92_OFFSET(2.0000", "SET_G92_OFFSET(-3.0000"])],
    ),
    held(
        "#gcode:g92",
        "G92 without axis words is refused, and so it is under cutter compensation",
        "words of `G92`, rule `refused-under-compensation`",
        &[
            refused("error[word-choice-missing]", "G92\nM2\n", "G92 X0\nM2\n"),
            refused(
                "error[refused-under-compensation]",
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG92 X0\nM2\n",
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG92 X0\nM2\n",
            ),
        ],
    ),
    gap(
        "#sec:g92-persistence-cautions",
        "The shift of G92 is kept for the next program unless G92.1 or G92.2 ends it",
        "`check` warns (`shift-left-on`) of a G92 that is still on at the end, also where the shift itself is unknown: it is silent for `G92 X0` after a move",
        &[
            rule(
                "warning[shift-left-on]",
                "G17 G21 G90\nG0 X4\nG92 X0\nG0 X1\nM2\n",
                "G17 G21 G90\nG0 X4\nG92 X0\nG0 X1\nG92.1\nM2\n",
            ),
            rule(
                "warning[shift-left-on]",
                "G17 G21 G90\nG92 X0 Y0\nG0 X1\nM2\n",
                "G17 G21 G90\nG92 X0 Y0\nG0 X1\nG92.1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g92.1-g92.2",
        "G92.1 ends the shift and sets #5211 to #5219 to zero, G92.2 ends it and keeps them; G92.3 takes it up again",
        "effects `clear-shift`, `suspend-shift`, `restore-shift`",
        &[runs(
            "G0 X25.4\nG92 X0\nG92.2\nG0 X#5211 Y#5210\nG92.3\nG0 X#5211 Y#5210\nG92.1\nG0 X#5211 Y#5210\nM2\n",
            &[
                "SET_G92_OFFSET(25.4000",
                "SET_G92_OFFSET(0.0000",
                "STRAIGHT_TRAVERSE(1.0000, 0.0000",
                "SET_G92_OFFSET(25.4000",
                "STRAIGHT_TRAVERSE(1.0000, 1.0000",
                "SET_G92_OFFSET(0.0000",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000",
            ],
        )],
    ),
    held(
        "#gcode:g92.1-g92.2",
        "G92.1 leaves the origins of G54 to G59.3 alone",
        "effect `clear-shift`",
        &[Proof::Moves {
            program: ngc("G21 G90\nG10 L2 P1 X9\nG92.1\nG0 X0\nM2\n"),
            are: &["rapid X0. MX9."],
        }],
    ),
    held(
        "#gcode:g92.1-g92.2",
        "Axis words beside G92.1 have no code to read them",
        "rule `axis-words-without-motion-mode`",
        &[
            stops("G92.1 X5\nM2\n"),
            rule("warning[axis-words-without-motion-mode]", "G92.1 X5\nM2\n", "G92.1\nM2\n"),
        ],
    ),
    gap(
        "#gcode:order-of-execution",
        "G92.1 to G92.3 in one block with G52 or G92: the interpreter (2.9) carries out G92 first, so that its shift is gone at once",
        "`run` carries out G52 or G92 before G92.1 to G92.3, as `control.toml` says; `check` warns that the shift of this block ends in it",
        &[
            runs("G92.1 G92 X5\nG0 X1\nM2\n", &["SET_G92_OFFSET(-5.0000", "SET_G92_OFFSET(0.0000"]),
            rule(
                "warning[codes-conflict]",
                "G92.1 G52 X5\nG0 X1\nM2\n",
                "G92.1\nG52 X5\nG0 X1\nG52 X0\nM2\n",
            ),
        ],
    ),
    unmodelled(
        "#gcode:g92.1-g92.2",
        "G92.1 under cutter compensation is accepted (interpreter 2.9); its change is lost when the program ends in compensation",
        "the program is unfinished: `compensation-left-on` speaks, and `run` prints the change of the shift",
    ),
    held(
        "#sec:machine-coordinate-system",
        "The machine's origin is where its axes were homed; all systems count from it",
        "`[offsets]` of the configuration",
        &[Proof::Moves {
            program: ngc("G21 G90\nG54 G0 X1\nG55 X1\nM2\n")
                .with(&["offsets.G54={ X = -400.0 }", "offsets.G55={ X = -200.0 }"]),
            are: &["rapid X1. MX-399.", "rapid X1. MX-199."],
        }],
    ),
    held(
        "#cha:coordinate-system",
        "Unknown offsets are said",
        "assumption of the verdict",
        &[Proof::Assumes {
            program: ngc("G21 G90\nG55 G0 X0\nM2\n"),
            says: "the work offset G55 is not known",
        }],
    ),
    unmodelled(
        "#cha:coordinate-system",
        "#5220 of the parameter file chooses the system at start-up, 1 where it is missing or not 1 to 9",
        "the parameter file is the machine's; `run` starts with G54, and says so",
    ),
    unmodelled(
        "#sec:g92-persistence-cautions",
        "What G92 left in the parameter file is on when the machine starts, and shifts what homing shows",
        "the parameter file is the machine's; `run` starts without a shift",
    ),
    unmodelled(
        "#sec:g92-commands",
        "`DISABLE_G92_PERSISTENCE = 1` clears the shift at start-up, reset and the end of the program",
        "the interpreter alone (2.9) shows no difference; what is kept between programs is not followed",
    ),
    held(
        "#cha:coordinate-system",
        "Several identical parts: one program runs in several systems",
        "effects `work-offset`, `call-program`",
        &[runs(
            "G10 L2 P1 X0\nG10 L2 P2 X50\nO100 SUB\nG0 X-1\nG1 X1 F10\nO100 ENDSUB\nG54\nO100 CALL\nG55\nO100 CALL\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(-1.0000",
                "STRAIGHT_FEED(1.0000",
                "SET_G5X_OFFSET(2, 50.0000",
                "STRAIGHT_TRAVERSE(-1.0000",
                "STRAIGHT_FEED(1.0000",
            ],
        )],
    ),
    held(
        "#cha:important-user-concepts",
        "G10 L2 P1 X0 Y0 Z0 R0 makes G54 the machine's system",
        "effect `write-offsets`",
        &[
            Proof::Moves {
                program: ngc("G21 G90\nG10 L2 P1 X5 Y5 Z5 R30\nG10 L2 P1 X0 Y0 Z0 R0\nG0 X1 Y2 Z3\nM2\n"),
                are: &["rapid MX1. MY2. MZ3."],
            },
            legal("G21 G90\nG10 L2 P1 X0 Y0 Z0 R0\nG0 X1\nM2\n"),
        ],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
