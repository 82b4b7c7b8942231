//! Stops and ends: `m-code.adoc`, M0, M1, M2, M30, M60; `overview.adoc`, file requirements.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: buttons, and the change from automatic to manual input.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Stops and ends", key: "STP", file: "linuxcnc/stops.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#mcode:m0-m1",
        "M0 stops the program, M1 where the optional stop is on; it goes on with the next line",
        "effects `stop`, `optional-stop`",
        &[runs(
            "G0 X1\nM0\nG0 X2\nM1\nG0 X3\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000",
                "PROGRAM_STOP",
                "STRAIGHT_TRAVERSE(2.0000",
                "OPTIONAL_PROGRAM_STOP",
                "STRAIGHT_TRAVERSE(3.0000",
            ],
        )],
    ),
    held(
        "#mcode:m60",
        "M60 changes pallets and stops, whatever the optional stop says",
        "effect `pallet-stop`",
        &[runs("G0 X1\nM60\nG0 X2\nM2\n", &["PALLET_SHUTTLE", "PROGRAM_STOP", "STRAIGHT_TRAVERSE(2.0000"])],
    ),
    held(
        "#mcode:m0-m1",
        "A stop in the block of a move comes after it",
        "`phases` of `control.toml`",
        &[runs("M0 G0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_STOP"])],
    ),
    held(
        "#mcode:m0-m1",
        "A stop changes no mode: spindle and coolant go on",
        "effect `stop`",
        &[runs(
            "S100 M3\nM8\nM0\nF10 G1 X1\nM2\n",
            &["FLOOD_ON", "PROGRAM_STOP", "STRAIGHT_FEED(1.0000", "STOP_SPINDLE_TURNING"],
        )],
    ),
    held(
        "#mcode:m2-m30",
        "M2 and M30 end the program; M30 also changes pallets",
        "effects `program-end`, `program-end-with-pallet`",
        &[
            runs("G0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"]),
            runs("G0 X1\nM30\n", &["STRAIGHT_TRAVERSE(1.0000", "PALLET_SHUTTLE", "PROGRAM_END"]),
        ],
    ),
    held(
        "#mcode:m2-m30",
        "The end goes back to G54, G17, G90, G94, M48, G40, M5, G1 and M9",
        "`at-end` of `[semantics]`",
        &[
            runs(
                "G55 G18 G91\nM49\nS100 M3\nM8\nG0 X1\nM2\n",
                &[
                    "SET_G5X_OFFSET(1",
                    "SELECT_PLANE(CANON_PLANE_XY)",
                    "ENABLE_FEED_OVERRIDE",
                    "STOP_SPINDLE_TURNING",
                    "FLOOD_OFF",
                    "PROGRAM_END",
                ],
            ),
            runs("M98 P100\nM30\nO100\nG93 G0 X1\nM99\n", &["SET_FEED_MODE(0, 0)", "PROGRAM_END"]),
        ],
    ),
    held(
        "#mcode:m2-m30",
        "Units, return level, tool length, arc mode, path mode and shifts stay as they are (interpreter 2.9)",
        "`at-end` of `[semantics]`",
        &[runs("G20 G98 G90.1 G61\nT1 M6 G43\nG52 X1\nG0 X0 Z1\nM2\n", &["PROGRAM_END"])],
    ),
    gap(
        "#mcode:m2-m30",
        "What the end leaves as it is meets the next program",
        "`check` says (info) that G7, which the end does not switch off, is still on at the end: the next program's X are diameters",
        &[rule("info[mode-left-on]", "G21 G90 G7\nG0 X1\nM2\n", "G21 G90 G7\nG0 X1\nG8\nM2\n")],
    ),
    held(
        "#mcode:m2-m30",
        "`DISABLE_AUTO_G54 = 1` keeps the system at the end (newer versions); the interpreter of 2.9 chooses G54 all the same",
        "setting `DISABLE_AUTO_G54`",
        &[Proof::AsInterpreter {
            program: ngc("G55\nG0 X1\nM2\n").beside(&[("machine.ini", "[RS274NGC]\nDISABLE_AUTO_G54=1\n")]),
            prints: &["SET_G5X_OFFSET(2", "SET_G5X_OFFSET(1", "PROGRAM_END"],
        }],
    ),
    held(
        "#mcode:m2-m30",
        "Lines after M2 and M30 are not read, not even for mistakes",
        "rule `unreachable-block`",
        &[
            runs("G0 X1\nM2\nG0 X5\nQ Q Q\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"]),
            rule("warning[unreachable-block]", "G21 G90 G0 X1\nM2\nG0 X5\n", "G21 G90 G0 X1\nG0 X5\nM2\n"),
        ],
    ),
    held(
        "#mcode:m2-m30",
        "Lines after the end are not judged as code",
        "what is wrong with a block after the end is an info",
        &[legal("G21 G90 G0 X1\nM2\n(notes of the operator)\nQ Q Q\n")],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "A file between two lines of `%` needs no M2; what follows the second is ignored",
        "`tape-marks-end = true`",
        &[runs("%\nG0 X1\n%\nG0 X2\n", &["STRAIGHT_TRAVERSE(1.0000"]), legal("%\nG21 G90 G0 X1\n%\n")],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "The first line of `%` may follow blank lines",
        "`tape-marks-end = true`",
        &[runs("\n\n%\nG0 X1\n%\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "With M2 or M30 the lines of `%` are optional, and a `%` at the head alone is fine",
        "rule `tape-mark-missing`",
        &[runs("%\nG0 X1\nM2\nG0 X2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"])],
    ),
    held(
        "#gcode:file-requirements",
        "A file with neither M2, M30 nor a pair of `%` is refused at its end",
        "rule `program-end-missing`",
        &[
            rule("warning[program-end-missing]", "G21 G90 G0 X1\n", "G21 G90 G0 X1\nM2\n"),
            stops("G0 X1\n"),
            stops("%\nG0 X1\n"),
        ],
    ),
    gap(
        "#cha:overview-of-g-code-programming",
        "A `%` after the first lines of a file that did not begin with one is refused (interpreter 2.9)",
        "`run` and `check` refuse it (error: character not allowed); today it counts as the end",
        &[
            stops("G0 X1\n%\nG0 X2\n"),
            Proof::Refused {
                finding: "error[stray-tape-mark]",
                violates: ngc("G21 G90 G0 X1\n%\n"),
                conforms: ngc("%\nG21 G90 G0 X1\n%\n"),
            },
        ],
    ),
    held(
        "#gcode:file-requirements",
        "An end by `%` leaves spindle, coolant and modes as they are",
        "rule `spindle-left-on`",
        &[
            runs(
                "%\nS100 M3\nM8\nG0 X1\n%\n",
                &["START_SPINDLE_CLOCKWISE", "FLOOD_ON", "STRAIGHT_TRAVERSE(1.0000"],
            ),
            rule(
                "warning[spindle-left-on]",
                "%\nG21 G90\nS100 M3\nF10 G1 X1\n%\n",
                "%\nG21 G90\nS100 M3\nF10 G1 X1\nM5\n%\n",
            ),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "M2 in a subroutine ends the program",
        "rule `subprogram-without-return`",
        &[
            runs("O100 SUB\nM2\nO100 ENDSUB\nO100 CALL\nG0 X1\nM2\n", &["PROGRAM_END"]),
            rule(
                "warning[subprogram-without-return]",
                "G21 G90\nO100 SUB\nG0 X5\nM2\nO100 ENDSUB\nO100 CALL\nG0 X1\nM2\n",
                "G21 G90\nO100 SUB\nG0 X5\nO100 ENDSUB\nO100 CALL\nG0 X1\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m2-m30",
        "After the end the feed is cleared (interpreter 2.9)",
        "`end-clears-feed = true`",
        &[runs("F100 G1 X1\nM2\n", &["SET_FEED_RATE(100.0000", "SET_FEED_RATE(0.0000", "PROGRAM_END"])],
    ),
    unmodelled(
        "#mcode:m2-m30",
        "Cycle start begins again at the head of the file",
        "an operator's action; passes of a main program that ends in M99 are one run each",
    ),
    held(
        "#sub:optional-program-stop",
        "Whether M1 stops is the switch's to say",
        "`gcheck run --optional-stop`",
        &[Proof::Run {
            program: ngc("G21 G90\nG0 X1\nM1\nG0 X2\nM2\n"),
            prints: &["rapid 1.0000", "rapid 2.0000"],
        }],
    ),
    held(
        "#mcode:m2-m30",
        "Two of M0, M1, M2, M30, M60 in one block are refused",
        "rule `two-codes-of-one-group`",
        &[refused("error[two-codes-of-one-group]", "M0 M2\n", "M0\nM2\n")],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
