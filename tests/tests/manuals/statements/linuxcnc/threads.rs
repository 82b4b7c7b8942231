//! Threads and surface speed: `g-code.adoc`, G33, G33.1, G76, G96, G97; `lathe-user.adoc`, spindle synchronized motion.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: wiring of encoders, how acceleration shifts the start of a pass, figures.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Threads, surface speed",
    key: "THR",
    file: "linuxcnc/threads.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g33",
        "G33 moves K along X, Y and Z for each turn of the spindle",
        "effect `thread`",
        &[
            runs(
                "S100 M3\nG0 X1 Z0.1\nG33 Z-2 K0.125\nG0 X1.25\nM2\n",
                &[
                    "START_SPEED_FEED_SYNC(0.125000, 0)",
                    "STRAIGHT_FEED(1.0000, 0.0000, -2.0000",
                    "STOP_SPEED_FEED_SYNCH()",
                    "STRAIGHT_TRAVERSE(1.2500",
                ],
            ),
            Proof::Stats {
                program: ngc("G21 G90\nS100 M3\nG0 X1 Z0\nG33 Z-15 K1.5\nM2\n"),
                prints: &["0:06.0"],
            },
        ],
    ),
    held(
        "#gcode:g33",
        "K is along the line of the move, not along Z: a taper",
        "effect `thread`",
        &[runs(
            "S100 M3\nG33 X1 Z-2 K0.125\nM2\n",
            &["START_SPEED_FEED_SYNC(0.125000, 0)", "STRAIGHT_FEED(1.0000, 0.0000, -2.0000"],
        )],
    ),
    held(
        "#gcode:g33",
        "A negative K: the interpreter (2.9) hands it on as it is",
        "effect of `G33`, range of `K`",
        &[
            runs("S100 M3\nG33 Z-2 K-0.125\nM2\n", &["START_SPEED_FEED_SYNC(-0.125000, 0)"]),
            rule(
                "warning[number-out-of-range]",
                "S100 M3\nG33 Z-2 K-0.125\nM2\n",
                "S100 M3\nG33 Z-2 K0.125\nM2\n",
            ),
            rule(
                "warning[number-out-of-range]",
                "S100 M3\nG33 Z-2 K0\nM2\n",
                "S100 M3\nG33 Z-2 K0.125\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g33",
        "$ chooses the spindle, 0 without it; a machine with one spindle refuses $1 (interpreter 2.9)",
        "words of `G33`",
        &[
            runs("S100 M3\nG33 Z-2 K1\nM2\n", &["START_SPEED_FEED_SYNC(1.000000, 0)"]),
            runs("S100 M3\nG33 Z-2 K1 $0\nM2\n", &["START_SPEED_FEED_SYNC(1.000000, 0)"]),
            stops("S100 M3\nG33 Z-2 K1 $1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g33",
        "A spindle that the machine does not have is refused (interpreter 2.9)",
        "rule `number-out-of-range`",
        &[refused(
            "info[number-out-of-range]",
            "S100 M3\nG33 Z-2 K1 $1\nM2\n",
            "S100 M3\nG33 Z-2 K1 $0\nM2\n",
        )],
    ),
    held(
        "#gcode:g33",
        "At least one axis word is needed",
        "words of `G33`",
        &[refused("error[word-choice-missing]", "S100 M3\nG33 K1\nM2\n", "S100 M3\nG33 Z-1 K1\nM2\n")],
    ),
    held(
        "#gcode:g33",
        "K is needed in every block while G33 is on",
        "words of `G33`, rule `thread-without-lead`",
        &[
            refused("error[required-word-missing]", "S100 M3\nG33 Z-2\nM2\n", "S100 M3\nG33 Z-2 K1\nM2\n"),
            refused(
                "error[thread-without-lead]",
                "S100 M3\nG33 Z-2 K1\nX1\nM2\n",
                "S100 M3\nG33 Z-2 K1\nX1 K1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g33",
        "F in the block of G33 is refused; an earlier one does not count",
        "words of `G33`",
        &[refused(
            "error[word-forbidden]",
            "S100 M3\nG33 Z-2 K1 F10\nM2\n",
            "S100 M3\nF10\nG33 Z-2 K1\nM2\n",
        )],
    ),
    held(
        "#gcode:g33",
        "G33 while the spindle does not turn is refused",
        "rule `spindle-stopped-while-cutting`",
        &[refused(
            "error[spindle-stopped-while-cutting]",
            "S100 M3\nM5\nG33 Z-2 K0.125\nM2\n",
            "S100 M3\nG33 Z-2 K0.125\nM2\n",
        )],
    ),
    held(
        "#gcode:g33",
        "G33 before any M3 or M4 is reported",
        "rule `spindle-stopped-while-cutting`",
        &[
            rule(
                "warning[spindle-stopped-while-cutting]",
                "G33 Z-2 K0.125\nM2\n",
                "S100 M3\nG33 Z-2 K0.125\nM2\n",
            ),
            stops("G33 Z-2 K0.125\nM2\n"),
        ],
    ),
    held(
        "#gcode:g33",
        "A pitch and speed that ask for more than the machine can feed are not refused",
        "effect `thread`",
        &[runs("S5000 M3\nG33 Z-20 K50\nM2\n", &["STRAIGHT_FEED(0.0000, 0.0000, -20.0000"])],
    ),
    unmodelled(
        "#gcode:g33",
        "Each pass waits for the index of the spindle",
        "the time of waiting depends on where the spindle stands",
    ),
    held(
        "#gcode:g33.1",
        "G33.1 taps in step with the spindle and comes back to where it began; the position after it is that of before",
        "effect `rigid-tap`",
        &[runs(
            "S100 M3\nG0 X1 Y1 Z0.1\nG33.1 Z-0.75 K0.05\nG91 G0 X1\nM2\n",
            &[
                "START_SPEED_FEED_SYNC(0.050000, 0)",
                "RIGID_TAP(1.0000, 1.0000, -0.7500)",
                "STOP_SPEED_FEED_SYNCH()",
                "STRAIGHT_TRAVERSE(2.0000, 1.0000, 0.1000",
            ],
        )],
    ),
    held(
        "#gcode:g33.1",
        "I makes the way back faster; below 1 it counts as 1",
        "words of `G33.1`",
        &[
            runs("S100 M3\nG33.1 Z-0.75 K1 I2\nM2\n", &["RIGID_TAP("]),
            runs("S100 M3\nG33.1 Z-0.75 K1 I0.5\nM2\n", &["RIGID_TAP("]),
        ],
    ),
    held(
        "#gcode:g33.1",
        "With X or Y of another place the tap goes there while it turns: a slanted, synchronized move, which the manual warns of",
        "effect of `G33.1`, rule `tap-moves-sideways`",
        &[
            runs("S100 M3\nG0 X0 Y0 Z5\nG33.1 X10 Z-10 K1\nM2\n", &["RIGID_TAP(10.0000, 0.0000, -10.0000)"]),
            runs(
                "S100 M3\nG0 X10 Y0 Z5\nG33.1 X10 Y0 Z-10 K1\nM2\n",
                &["RIGID_TAP(10.0000, 0.0000, -10.0000)"],
            ),
            rule(
                "warning[tap-moves-sideways]",
                "G17 G21 G90\nS100 M3\nG0 X0 Y0 Z5\nG33.1 X10 Z-10 K1\nM2\n",
                "G17 G21 G90\nS100 M3\nG0 X10 Y0 Z5\nG33.1 X10 Z-10 K1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g33.1",
        "Axis words, K and no F, as with G33",
        "words of `G33.1`",
        &[
            refused("error[word-choice-missing]", "S100 M3\nG33.1 K1\nM2\n", "S100 M3\nG33.1 Z-1 K1\nM2\n"),
            refused(
                "error[required-word-missing]",
                "S100 M3\nG33.1 Z-1\nM2\n",
                "S100 M3\nG33.1 Z-1 K1\nM2\n",
            ),
            refused(
                "error[word-forbidden]",
                "S100 M3\nG33.1 Z-1 K1 F100\nM2\n",
                "S100 M3\nG33.1 Z-1 K1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g33.1",
        "G33.1 while the spindle does not turn is refused",
        "rule `spindle-stopped-while-cutting`",
        &[refused(
            "error[spindle-stopped-while-cutting]",
            "S100 M3\nM5\nG33.1 Z-2 K0.125\nM2\n",
            "S100 M3\nG33.1 Z-2 K0.125\nM2\n",
        )],
    ),
    held(
        "#gcode:g76",
        "G76 cuts a thread in passes along Z: P pitch, Z end, I crest from the drive line, J first depth, K full depth; all are required",
        "effect `thread-cycle`",
        &[
            runs(
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(20.7000, 0.0000, 1.0000",
                    "STRAIGHT_TRAVERSE(17.7000, 0.0000, 1.0000",
                    "START_SPEED_FEED_SYNC(1.500000, 0)",
                    "STRAIGHT_FEED(17.7000, 0.0000, -10.0000",
                    "STRAIGHT_FEED(17.4000, 0.0000, -10.0000",
                    "STRAIGHT_FEED(17.1000, 0.0000, -10.0000",
                    "STRAIGHT_FEED(17.0000, 0.0000, -10.0000",
                    "STRAIGHT_TRAVERSE(20.0000, 0.0000, -10.0000",
                ],
            ),
            refused(
                "error[required-word-missing]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 Z-10 I-2 J0.3 K1\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 J0.3 K1\nM2\n",
            ),
            refused(
                "error[word-choice-missing]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 I-2 J0.3 K1\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 J0.3 K1\nM2\n",
            ),
            refused(
                "error[required-word-missing]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 J0.3 K1\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 J0.3 K1\nM2\n",
            ),
            refused(
                "error[required-word-missing]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 K1\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 J0.3 K1\nM2\n",
            ),
            refused(
                "error[required-word-missing]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 J0.3\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1 Z-10 I-2 J0.3 K1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g76",
        "A negative I is an external thread, a positive one internal",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X10 Z1\nG76 P1.5 Z-10 I2 J0.3 K1\nM2\n",
            &["STRAIGHT_FEED(12.3000, 0.0000, -10.0000", "STRAIGHT_FEED(13.0000, 0.0000, -10.0000"],
        )],
    ),
    held(
        "#gcode:g76",
        "Under G7 the words I, J and K are diameters, under G8 radii",
        "effect `thread-cycle`",
        &[runs(
            "G18 G7\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(10.0000",
                "STRAIGHT_FEED(8.8500, 0.0000, -10.0000",
                "STRAIGHT_FEED(8.5000, 0.0000, -10.0000",
            ],
        )],
    ),
    held(
        "#gcode:g76",
        "R is the degression: 1 keeps the depth of passes, 2 their area; above 1 each pass is shallower",
        "effect `thread-cycle`",
        &[
            runs(
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 R2\nM2\n",
                &[
                    "STRAIGHT_FEED(17.7000",
                    "STRAIGHT_FEED(17.5757",
                    "STRAIGHT_FEED(17.4804",
                    "STRAIGHT_FEED(17.4000",
                ],
            ),
            runs(
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 R1\nM2\n",
                &["STRAIGHT_FEED(17.7000", "STRAIGHT_FEED(17.4000"],
            ),
        ],
    ),
    held(
        "#gcode:g76",
        "An R below 1 is an error, says the documentation; the interpreter (2.9) takes it for 1",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 R0.5\nM2\n",
            &["STRAIGHT_FEED(17.7000", "STRAIGHT_FEED(17.4000"],
        )],
    ),
    held(
        "#gcode:g76",
        "A high R asks for very many passes",
        "rule `cycle-numbers-contradict`",
        &[rule(
            "error[cycle-numbers-contradict]",
            "G18 G21 G90\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 R90\nM2\n",
            "G18 G21 G90\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 R2\nM2\n",
        )],
    ),
    held(
        "#gcode:g76",
        "Q is the angle of the compound slide: passes begin further along by its tangent",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 Q30\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(20.3000, 0.0000, 0.8268",
                "STRAIGHT_FEED(17.7000, 0.0000, -9.8268",
                "STRAIGHT_TRAVERSE(20.0000, 0.0000, 0.6536",
                "STRAIGHT_FEED(17.4000, 0.0000, -10.0000",
            ],
        )],
    ),
    held(
        "#gcode:g76",
        "H is the number of further passes at full depth, none without it",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 H2\nM2\n",
            &[
                "STRAIGHT_FEED(17.7000",
                "STRAIGHT_FEED(17.4000",
                "STRAIGHT_FEED(17.4000",
                "STRAIGHT_FEED(17.4000",
            ],
        )],
    ),
    held(
        "#gcode:g76",
        "E is the length of a taper and L its end: 0 none (the default), 1 entry, 2 exit, 3 both",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X20 Z1\nF100\nG76 P1.5 Z-10 I-2 J0.59 K0.6 E1 L3\nM2\n",
            &["STRAIGHT_FEED("],
        )],
    ),
    held(
        "#gcode:g76",
        "The last position is at the Z end of the drive line",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nG91 G0 X1\nM2\n",
            &["STRAIGHT_TRAVERSE(21.0000, 0.0000, -10.0000"],
        )],
    ),
    held(
        "#gcode:g76",
        "The plane must be ZX, says the documentation; the interpreter (2.9) cuts in XY as well",
        "effect `thread-cycle`",
        &[runs(
            "G17\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
            &["STRAIGHT_FEED(17.4000, 0.0000, -10.0000"],
        )],
    ),
    held(
        "#gcode:g76",
        "Other axis words are an error, says the documentation; the interpreter (2.9) goes to X and Y after the last pass, at rapid and at the end of the thread",
        "effect `thread-cycle`",
        &[runs(
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 X5 Y1 Z-10 I-2 J0.3 K0.6\nM2\n",
            &["STRAIGHT_FEED(17.4000, 0.0000, -10.0000", "STRAIGHT_TRAVERSE(5.0000, 1.0000, -10.0000"],
        )],
    ),
    gap(
        "#gcode:g76",
        "P, J, K and H may not be negative; the interpreter (2.9) refuses J and K, takes a negative P as it is and a negative H for none",
        "`run` makes the passes of a negative P as the interpreter does; `check` reports a negative P or H (warning: refused by the documentation), and words that are not read (X, Y)",
        &[
            refused(
                "error[number-out-of-range]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J-0.3 K1\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1\nM2\n",
            ),
            runs(
                "G18\nS100 M3\nG0 X20 Z1\nG76 P-1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
                &["START_SPEED_FEED_SYNC(-1.500000, 0)"],
            ),
            rule(
                "warning[number-out-of-range]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 H-1\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 H1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g76",
        "K must be above J (interpreter 2.9)",
        "rule `cycle-numbers-contradict`",
        &[
            rule(
                "error[cycle-numbers-contradict]",
                "G18 G21 G90\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J1 K1\nM2\n",
                "G18 G21 G90\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.9 K1\nM2\n",
            ),
            stops("G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J1.5 K1\nM2\n"),
            stops("G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J1 K1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g76",
        "J and K of zero are refused",
        "words of `G76`",
        &[refused(
            "error[number-out-of-range]",
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0 K1\nM2\n",
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1\nM2\n",
        )],
    ),
    held(
        "#gcode:g76",
        "H must be whole (interpreter 2.9)",
        "`whole` of `H` and `L`",
        &[refused(
            "error[number-out-of-range]",
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 H1.5\nM2\n",
            "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 H1\nM2\n",
        )],
    ),
    gap(
        "#gcode:g76",
        "E may not be more than half the drive line, says the documentation; the interpreter (2.9) runs it",
        "`check` reports an E above half the length of the thread (warning: the documentation refuses it, and entry and exit taper would cross)",
        &[
            runs("G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 E6 L3\nM2\n", &["STRAIGHT_FEED("]),
            rule(
                "error[cycle-numbers-contradict]",
                "G18 G21 G90\nS100 M3\nF100\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 E6 L3\nM2\n",
                "G18 G21 G90\nS100 M3\nF100\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K1 E2 L3\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g76",
        "An L above 3 cuts no taper (interpreter 2.9)",
        "words of `G76`, rule `number-out-of-range`",
        &[
            runs("G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 L4\nM2\n", &["STRAIGHT_FEED("]),
            rule(
                "warning[number-out-of-range]",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 L4\nM2\n",
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 L3 E1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g76",
        "G76 needs a turning spindle (interpreter 2.9); $ chooses it",
        "rule `spindle-stopped-while-cutting`",
        &[
            rule(
                "warning[spindle-stopped-while-cutting]",
                "G18 G21 G90\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
                "G18 G21 G90\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
            ),
            stops("G18\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n"),
            runs(
                "G18\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6 $0\nM2\n",
                &["START_SPEED_FEED_SYNC(1.500000, 0)"],
            ),
        ],
    ),
    held(
        "#gcode:g76",
        "The speed must stay: a thread at constant surface speed is a trap",
        "rule `thread-at-surface-speed`",
        &[rule(
            "warning[thread-at-surface-speed]",
            "G18 G21 G90\nG96 D2000 S100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
            "G18 G21 G90\nG97 S100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
        )],
    ),
    held(
        "#gcode:g96-g97",
        "G96 S is a surface speed: m/min under G21, ft/min under G20",
        "effect `surface-speed`",
        &[
            runs(
                "G21\nG96 D2500 S250\nM2\n",
                &["SET_SPINDLE_MODE(0, 2500.0000)", "SET_SPINDLE_SPEED(0, 250.0000)"],
            ),
            Proof::Stats {
                program: ngc("G18 G21 G90 G8\nG96 D5000 S100 M3\nG0 X10 Z1\nG95 F0.1\nG1 Z-10\nM2\n"),
                prints: &["no tool 0:04.2 0:04.1 0:00.0 11 10 0.1/rev 100 m/min"],
            },
            Proof::Stats {
                program: ngc("G18 G20 G90 G8\nG96 D5000 S100 M3\nG0 X0.5 Z.1\nG95 F0.01\nG1 Z-1\nM2\n"),
                prints: &["no tool 0:17.3 0:17.3 0:00.0 1.1 0.5 0.01/rev 100 ft/min"],
            },
        ],
    ),
    held(
        "#gcode:g96-g97",
        "D limits the speed; without it nothing does",
        "words of `G96`, rule `surface-speed-without-limit`",
        &[
            rule(
                "warning[surface-speed-without-limit]",
                "G18 G21 G90\nG96 S100 M3\nG0 X10\nG95 F0.1\nG1 X0\nM2\n",
                "G18 G21 G90\nG96 D2000 S100 M3\nG0 X10\nG95 F0.1\nG1 X0\nM2\n",
            ),
            runs("G96 S100\nM2\n", &["SET_SPINDLE_SPEED(0, 100.0000)"]),
        ],
    ),
    held(
        "#gcode:g96-g97",
        "G96 without S is refused, also when S was given before",
        "words of `G96`",
        &[
            refused("error[required-word-missing]", "S100\nG96\nM2\n", "G96 S100\nM2\n"),
            refused("error[sign-not-accepted]", "G96 S-100\nM2\n", "G96 S100\nM2\n"),
        ],
    ),
    held(
        "#gcode:g96-g97",
        "G97 goes back to turns a minute; S is optional (interpreter 2.9)",
        "effect `constant-speed`",
        &[runs(
            "G96 D1000 S100\nG97 S500\nG97\nM2\n",
            &["SET_SPINDLE_MODE(0, 0.0000)", "SET_SPINDLE_SPEED(0, 500.0000)"],
        )],
    ),
    held(
        "#gcode:g96-g97",
        "A negative D is taken for its amount (interpreter 2.9)",
        "effect `surface-speed`",
        &[runs("G96 D-5 S100\nM2\n", &["SET_SPINDLE_SPEED(0, 100.0000)"])],
    ),
    held(
        "#gcode:g96-g97",
        "X0 must be the centre of rotation",
        "text of `G96`",
        &[explains("G96", "centre")],
    ),
    held(
        "#gcode:g96-g97",
        "Radius and diameter mode do not change the surface speed",
        "effect `surface-speed`",
        &[Proof::Stats {
            program: ngc("G18 G21 G90 G7\nG96 D5000 S100 M3\nG0 X20 Z1\nG95 F0.1\nG1 Z-10\nM2\n"),
            prints: &["no tool 0:04.2 0:04.1 0:00.0 11 10 0.1/rev 100 m/min"],
        }],
    ),
    held(
        "#gcode:g96-g97",
        "$ names the spindle",
        "rule `number-out-of-range`",
        &[
            runs("G96 S100 $0\nG97 S100 $0\nM2\n", &["SET_SPINDLE_SPEED(0, 100.0000)"]),
            refused("info[number-out-of-range]", "G96 S100 $1\nM2\n", "G96 S100 $0\nM2\n"),
        ],
    ),
    unmodelled(
        "#cha:lathe-user-information",
        "Surface speed follows changes of the tool's X offset",
        "where the work offset and the tool's X offset are told, X of `stats` has them; the spindle's rise in speed along a facing cut is averaged",
    ),
    held(
        "#gcode:g76",
        "X and Y do not belong to G76",
        "rule `unwanted-word`",
        &[rule(
            "warning[unwanted-word]",
            "G18 G21\nS100 M3\nG0 X20 Z1\nG76 P1.5 X5 Z-10 I-2 J0.3 K0.6\nM2\n",
            "G18 G21\nS100 M3\nG0 X20 Z1\nG76 P1.5 Z-10 I-2 J0.3 K0.6\nM2\n",
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
