//! Path control, distance modes and feed modes: `g-code.adoc`, G61 to G64, G90, G91, G90.1, G91.1, G93 to G95;
//! `user-concepts.adoc`, trajectory control; `machining-center.adoc`, feed rate; `ini-config.adoc`, planner.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: how the planner accelerates, and figures that show what its tolerances do.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Path control, distance modes, feed modes",
    key: "PTH",
    file: "linuxcnc/path_control.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g61",
        "G61 follows the path exactly, G61.1 stops at the end of each move, G64 blends",
        "effects `exact-path`, `exact-stop`, `path-blending`",
        &[runs(
            "G61\nG0 X1\nG61.1\nX2\nG64\nX3\nM2\n",
            &[
                "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH",
                "STRAIGHT_TRAVERSE(1.0000",
                "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP",
                "STRAIGHT_TRAVERSE(2.0000",
                "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS",
                "STRAIGHT_TRAVERSE(3.0000",
            ],
        )],
    ),
    held(
        "#gcode:g64",
        "P of G64 is the tolerance of blending, Q that of joining lines; without Q it is P",
        "words of `G64`",
        &[runs(
            "G64 P0.1\nG64 P0.1 Q0.2\nG64\nM2\n",
            &[
                "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.100000)",
                "SET_NAIVECAM_TOLERANCE(0.1000",
                "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.100000)",
                "SET_NAIVECAM_TOLERANCE(0.2000",
                "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.000000)",
            ],
        )],
    ),
    held(
        "#gcode:g64",
        "Without P the tool may stray as far as the speed asks, and the mode of before is no matter",
        "text of `G64`",
        &[explains("G64", "Without P the machine strays as far as the speed asks")],
    ),
    held(
        "#gcode:g64",
        "Q0 switches the joining of lines off",
        "words of `G64`",
        &[runs("G64 P0.1 Q0\nM2\n", &["SET_NAIVECAM_TOLERANCE(0.0000"])],
    ),
    held(
        "#gcode:g64",
        "G64 P0 is G64",
        "effect `path-blending`",
        &[runs("G64 P0\nM2\n", &["SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.000000)"])],
    ),
    held(
        "#gcode:g64",
        "The same mode may be programmed again",
        "effect `path-blending`",
        &[legal("G64 P0.01\nG64 P0.01\nM2\n")],
    ),
    unmodelled(
        "#gcode:g64",
        "Straight feed moves in X, Y and Z at one feed that lie closer to a line than Q are joined into one; an arc in G17 that lies closer to a line than P becomes two lines before that",
        "the canonical functions are those of the program; the planner joins them afterwards",
    ),
    held(
        "#gcode:g64",
        "R of G64 chooses the planner (newer versions); the interpreter of 2.9 refuses it",
        "`newer-words`",
        &[
            stops("G64 R0.5\nM2\n"),
            stops("G64 P0.1 R0\nM2\n"),
            legal("G64 P0.1 R0.5\nM2\n"),
            explains("G64", "choice of planner (newer versions)"),
        ],
    ),
    gap(
        "#gcode:g64",
        "R of G64 beside M19 is refused: whose R it is would be unsure",
        "`check` reports R in a block with G64 and M19 (warning; the newer documentation calls it an error)",
        &[rule("warning[codes-conflict]", "G64 P0.1 M19 R0.5\nM2\n", "G64 P0.1\nM19 R0.5\nM2\n")],
    ),
    held(
        "#gcode:g61",
        "Changing the mode under cutter compensation is refused",
        "rule `refused-under-compensation`",
        &[
            refused(
                "error[refused-under-compensation]",
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG61\nM2\n",
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG61\nM2\n",
            ),
            refused(
                "error[refused-under-compensation]",
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG64 P0.1\nM2\n",
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG64 P0.1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g61",
        "G61 reads no P (interpreter 2.9)",
        "rule `word-passed-over`",
        &[refused("error[word-passed-over]", "G61 P0.1\nM2\n", "G61\nM2\n")],
    ),
    held(
        "#gcode:g64",
        "G64 is the mode at power-on",
        "`at-start` of `[semantics]`",
        &[Proof::Stats {
            program: ngc("G21 G90 G0 X1\nM2\n"),
            prints: &["as at power-on: G80 G17 G90 G91.1 G94 G21 G40 G49 G99 G54 G64"],
        }],
    ),
    held(
        "#gcode:g64",
        "A tolerance below zero counts as none (interpreter 2.9)",
        "effect `path-blending`",
        &[runs("G64 P-1\nM2\n", &["SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, 0.000000)"])],
    ),
    unmodelled(
        "#sub:planning-moves",
        "A move must be long enough for its feed: distance F²/A",
        "acceleration is not in the program; `[machine] acceleration` is for times",
    ),
    held(
        "#gcode:g90-g91",
        "Under G90 axis words are positions, under G91 distances from the present one",
        "effects `absolute`, `incremental`",
        &[
            runs(
                "G90\nG0 X2.5\nX1\nG91\nX2.5\nY1 X-1\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(2.5000",
                    "STRAIGHT_TRAVERSE(1.0000",
                    "STRAIGHT_TRAVERSE(3.5000",
                    "STRAIGHT_TRAVERSE(2.5000, 1.0000",
                ],
            ),
            runs("G91 G0 A90\nA90\nM2\n", &["0.0000, 90.0000", "0.0000, 180.0000"]),
        ],
    ),
    held(
        "#gcode:g90.1-g91.1",
        "G90.1 makes I, J, K of arcs positions, G91.1 distances, which is the default",
        "effects `arc-centre-absolute`, `arc-centre-incremental`",
        &[runs(
            "G0 X10 Y10\nF10\nG90.1 G2 X12 Y10 I11 J10\nG91.1 G2 X10 Y10 I-1\nM2\n",
            &["ARC_FEED(12.0000, 10.0000, 11.0000, 10.0000", "ARC_FEED(10.0000, 10.0000, 11.0000, 10.0000"],
        )],
    ),
    held(
        "#gcode:g90.1-g91.1",
        "The arc mode does not change with G90 and G91",
        "group `arc-distance`",
        &[runs("F10\nG90.1\nG91 G2 X2 Y0 I1 J0\nM2\n", &["ARC_FEED(2.0000, 0.0000, 1.0000, 0.0000"])],
    ),
    held(
        "#gcode:g93-g94-g95",
        "Under G93 a move takes 1/F minutes",
        "effect `feed-inverse-time`",
        &[
            runs(
                "G93\nG1 X1 F2\nM2\n",
                &["SET_FEED_MODE(0, 0)", "SET_FEED_RATE(2.0000", "STRAIGHT_FEED(1.0000"],
            ),
            Proof::Stats {
                program: ngc("G21 G90\nG0 X0\nG93\nG1 X100 F2\nM2\n"),
                prints: &["cutting 0:30.0"],
            },
        ],
    ),
    held(
        "#gcode:g93-g94-g95",
        "Under G93 each block with G1, G2 or G3 needs its F, also where the code is only in effect",
        "rule `inverse-time-feed-missing`",
        &[
            refused(
                "error[inverse-time-feed-missing]",
                "G93\nG1 X1 F2\nX2\nM2\n",
                "G93\nG1 X1 F2\nX2 F2\nM2\n",
            ),
            refused(
                "error[inverse-time-feed-missing]",
                "F100\nG93\nG1 X1\nM2\n",
                "F100\nG93\nG1 X1 F2\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g93-g94-g95",
        "Under G93 an F in a block that does not cut is ignored, and G0 is not changed",
        "effect `feed-inverse-time`",
        &[runs(
            "G93\nG0 X1\nF5\nG1 X2 F2\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000", "SET_FEED_RATE(2.0000", "STRAIGHT_FEED(2.0000"],
        )],
    ),
    held(
        "#gcode:g93-g94-g95",
        "F0 under G93: the interpreter (2.9) takes 0.1",
        "rule `feed-zero`, effect of `G93`",
        &[
            runs("G93\nG1 X1 F0\nM2\n", &["SET_FEED_RATE(0.1000", "STRAIGHT_FEED(1.0000"]),
            rule("warning[feed-zero]", "G93\nG1 X1 F0\nM2\n", "G93\nG1 X1 F2\nM2\n"),
        ],
    ),
    held(
        "#gcode:g93-g94-g95, #sub:feed-rate",
        "Under G94 F is units a minute, or degrees where only rotary axes move",
        "effect `feed-per-minute`",
        &[
            Proof::Stats {
                program: ngc("G21 G90\nG0 X0\nG94 F60\nG1 X10\nM2\n"),
                prints: &["cutting 0:10.0"],
            },
            Proof::Stats {
                program: ngc("G21 G90\nG0 A0\nG94 F60\nG1 A10\nM2\n"),
                prints: &["cutting 0:10.0"],
            },
        ],
    ),
    held(
        "#sub:feed-rate",
        "Where X, Y or Z moves F is along their path, and the other axes keep in step; else U V W, else A B C together",
        "effect `linear`",
        &[
            Proof::Stats {
                program: ngc("G21 G90\nG0 X0 A0\nG94 F60\nG1 X10 A720\nM2\n"),
                prints: &["cutting 0:10.0"],
            },
            Proof::Stats {
                program: ngc("G21 G90\nG0 X0 Y0\nG94 F60\nG1 X3 Y4\nM2\n"),
                prints: &["cutting 0:05.0"],
            },
            Proof::Stats {
                program: ngc("G21 G90\nG0 A0 B0\nG94 F60\nG1 A3 B4\nM2\n"),
                prints: &["cutting 0:05.0"],
            },
            Proof::Stats {
                program: ngc("G21 G90\nG0 U0 V0\nG94 F60\nG1 U3 V4 A90\nM2\n")
                    .with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"U\", \"V\"]"]),
                prints: &["cutting 0:05.0"],
            },
        ],
    ),
    held(
        "#gcode:g93-g94-g95",
        "Under G95 F is units per turn of the spindle",
        "effect `feed-per-revolution`",
        &[
            runs(
                "G95 F0.1\nS100 M3\nG1 X1\nM2\n",
                &["SET_FEED_MODE(0, 1)", "START_SPINDLE_CLOCKWISE", "STRAIGHT_FEED(1.0000"],
            ),
            Proof::Stats {
                program: ngc("G21 G90\nG0 X0\nG95 F0.1\nS100 M3\nG1 X10\nM2\n"),
                prints: &["cutting 1:00.0"],
            },
        ],
    ),
    held(
        "#gcode:g93-g94-g95",
        "Feed a turn at a speed of zero is refused (interpreter 2.9); with a spindle that was stopped the machine waits",
        "rule `spindle-stopped-while-cutting`",
        &[
            stops("G95 F0.1 S0 M3\nG1 X1\nM2\n"),
            stops("G95 F0.1\nG1 X1\nM2\n"),
            runs("G95 F0.1\nS100 M3\nM5\nG1 X1\nM2\n", &["STRAIGHT_FEED(1.0000"]),
            rule(
                "warning[spindle-stopped-while-cutting]",
                "G95 F0.1\nS100 M3\nM5\nG1 X1\nM2\n",
                "G95 F0.1\nS100 M3\nG1 X1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g93-g94-g95",
        "A cut needs a new F after G94 or G95 was switched on",
        "`feed-mode-clears-feed = true`, rule `feed-missing`",
        &[
            refused(
                "error[feed-missing]",
                "G93\nG1 X1 F2\nG94\nG1 X2\nM2\n",
                "G93\nG1 X1 F2\nG94\nG1 X2 F10\nM2\n",
            ),
            refused(
                "error[feed-missing]",
                "F100\nG95\nS100 M3\nG1 X1\nM2\n",
                "F100\nG95 F0.1\nS100 M3\nG1 X1\nM2\n",
            ),
            refused("error[feed-missing]", "F100\nG94\nG1 X1\nM2\n", "G94\nF100\nG1 X1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g93-g94-g95",
        "$ of G95 names the spindle (newer versions); the interpreter of 2.9 refuses it",
        "`newer-words`",
        &[stops("G95 F0.1 $0\nM2\n"), legal("G95 F0.1 $0\nM2\n")],
    ),
    held("#gcode:g93-g94-g95", "G95 is not for threads", "text of `G95`", &[explains("G95", "thread")]),
    held(
        "#sub:feed-rate",
        "F is read before the move of its block, and lasts",
        "`phases` of `control.toml`",
        &[runs(
            "G1 X1 F10\nX2\nX3 F20\nM2\n",
            &[
                "SET_FEED_RATE(10.0000",
                "STRAIGHT_FEED(1.0000",
                "STRAIGHT_FEED(2.0000",
                "SET_FEED_RATE(20.0000",
                "STRAIGHT_FEED(3.0000",
            ],
        )],
    ),
    held(
        "#sec:path-control-mode",
        "A dwell ends the move before it exactly, whatever the path mode",
        "effect `dwell`",
        &[runs(
            "G64 P0.1\nF10\nG1 X1\nG4 P1\nY1\nM2\n",
            &["STRAIGHT_FEED(1.0000", "DWELL(1.0000", "STRAIGHT_FEED(1.0000, 1.0000"],
        )],
    ),
    unmodelled(
        "#sub:ini:sec:traj",
        "`PLANNER_TYPE`, `SMOOTH_PLANNER`, `SCURVE_PEAK_SCALE`, `MAX_LINEAR_JERK` choose and bound the planner",
        "machine configuration that changes times and corners, not what a program says",
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
