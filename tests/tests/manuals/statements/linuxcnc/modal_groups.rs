//! Repeated items, polar words, modal groups, order of execution, refusals: `overview.adoc`.
//!
//! Knows: statements, programs. Must not know: how they are checked.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Polar words, modal groups, order of execution",
    key: "ORD",
    file: "linuxcnc/modal_groups.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#cha:overview-of-g-code-programming",
        "A line may hold any number of G codes, but not two of one group",
        "rule `two-codes-of-one-group`",
        &[
            refused("error[two-codes-of-one-group]", "G0 G1 X1 F1\nM2\n", "G1 X1 F1\nM2\n"),
            refused("error[code-given-twice]", "G0 G0 X1\nM2\n", "G0 X1\nM2\n"),
            refused("error[two-codes-of-one-group]", "G17 G18\nM2\n", "G17\nG18\nM2\n"),
            refused("error[two-codes-of-one-group]", "G90 G91\nM2\n", "G90\nG91\nM2\n"),
            refused("error[two-codes-of-one-group]", "G54 G55\nM2\n", "G54\nG55\nM2\n"),
            refused("error[two-codes-of-one-group]", "G20 G21\nM2\n", "G20\nG21\nM2\n"),
        ],
    ),
    held(
        "#cap:modal-groups",
        "Codes of different groups may share a line",
        "groups of `groups.toml`",
        &[
            legal("G17 G20 G40 G49 G54 G80 G90 G94\nM2\n"),
            runs("G90 G91.1 G94\nG90.1 G91 G0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
        ],
    ),
    held(
        "#cap:modal-groups",
        "The codes without mode (G4, G10, G28, G30, G52, G53, G92) are one group (interpreter 2.9)",
        "rule `two-codes-of-one-group`",
        &[
            refused("error[two-codes-of-one-group]", "G4 P1 G53 G0 X1\nM2\n", "G4 P1\nG53 G0 X1\nM2\n"),
            refused("error[two-codes-of-one-group]", "G4 P1 G28\nM2\n", "G4 P1\nG28\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "A line has at most four M codes, no two of one group",
        "`m-codes-per-block = 4`, rule `too-many-m-codes`",
        &[refused("error[too-many-m-codes]", "M3 M8 M48 M0 M6 T1 S1\nM2\n", "M3 M8 M48 M0 S1\nM2\n")],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Any other letter stands once on a line",
        "rule `word-given-twice`",
        &[
            refused("error[word-given-twice]", "G0 X1 Y2 X3\nM2\n", "G0 X1 Y2\nM2\n"),
            refused("error[word-given-twice]", "F1 F2\nM2\n", "F1\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "The order of words on a line changes nothing",
        "order of a block",
        &[runs(
            "X1 F10 G1 Y2\nY5 G0 X3 S100 M3\nM2\n",
            &[
                "SET_FEED_RATE(10.0000",
                "STRAIGHT_FEED(1.0000, 2.0000",
                "START_SPINDLE_CLOCKWISE",
                "STRAIGHT_TRAVERSE(3.0000, 5.0000",
            ],
        )],
    ),
    held(
        "#cap:modal-groups",
        "A motion code and a code without mode that both want the axis words are refused",
        "rule `codes-conflict`",
        &[
            refused("error[codes-conflict]", "G28 X1 G1 F100\nM2\n", "G28 X1\nM2\n"),
            refused("error[codes-conflict]", "G0 X1 G28\nM2\n", "G0 X1\nG28\nM2\n"),
        ],
    ),
    held(
        "#cap:modal-groups",
        "A motion mode that is on pauses in a block of G10, G28, G30, G52 or G92",
        "phase `setting`",
        &[
            runs(
                "F10 G1 X1\nG10 L2 P1 X5\nX2\nM2\n",
                &["STRAIGHT_FEED(1.0000", "SET_G5X_OFFSET(1, 5.0000", "STRAIGHT_FEED(2.0000"],
            ),
            runs(
                "F10 G1 X1\nG92 X0\nX2\nM2\n",
                &["STRAIGHT_FEED(1.0000", "SET_G92_OFFSET(1.0000", "STRAIGHT_FEED(2.0000"],
            ),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Modes last until changed; a code without mode acts on its own line",
        "groups of `groups.toml`",
        &[runs(
            "F10 G1 X1\nG4 P1\nX2\nM2\n",
            &["STRAIGHT_FEED(1.0000", "DWELL(1.0000", "STRAIGHT_FEED(2.0000"],
        )],
    ),
    held(
        "#cap:modal-groups",
        "At power-on no motion is on (interpreter 2.9): axis words alone are refused",
        "rule `axis-words-without-motion-mode`",
        &[stops("X5\nM2\n"), rule("warning[axis-words-without-motion-mode]", "X5\nM2\n", "G0\nX5\nM2\n")],
    ),
    held(
        "#gcode:polar-coordinates",
        "@ is a distance from X0 Y0 and ^ an angle from +X, counter-clockwise",
        "words `@` and `^`",
        &[
            runs(
                "F100 G1 @.5 ^90\nG0 @2 ^-90\nM2\n",
                &["STRAIGHT_FEED(0.0000, 0.5000", "STRAIGHT_TRAVERSE(0.0000, -2.0000"],
            ),
            runs("G10 L2 P1 X5\nG0 @1^90\nM2\n", &["STRAIGHT_TRAVERSE(0.0000, 1.0000"]),
        ],
    ),
    held(
        "#gcode:polar-coordinates",
        "One of the two that is left out keeps its value",
        "words `@` and `^`",
        &[runs(
            "G0 @5^90\n^0\n@2\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(0.0000, 5.0000",
                "STRAIGHT_TRAVERSE(5.0000, 0.0000",
                "STRAIGHT_TRAVERSE(2.0000, 0.0000",
            ],
        )],
    ),
    held(
        "#gcode:polar-coordinates",
        "Under G91 both are added to those of the present point",
        "words `@` and `^`",
        &[
            runs(
                "F100 G1 @.5 ^90\nG91 @.5 ^90\n@.5 ^90\nM2\n",
                &[
                    "STRAIGHT_FEED(0.0000, 0.5000",
                    "STRAIGHT_FEED(-1.0000, 0.0000",
                    "STRAIGHT_FEED(0.0000, -1.5000",
                ],
            ),
            runs(
                "F100 G1 @.5 ^90\nG91 ^90\n^90\n^90\n^90\nM2\n",
                &[
                    "STRAIGHT_FEED(0.0000, 0.5000",
                    "STRAIGHT_FEED(-0.5000, 0.0000",
                    "STRAIGHT_FEED(0.0000, -0.5000",
                    "STRAIGHT_FEED(0.5000, 0.0000",
                    "STRAIGHT_FEED(0.0000, 0.5000",
                ],
            ),
        ],
    ),
    gap(
        "#gcode:polar-coordinates",
        "An incremental polar move that begins at the origin is refused",
        "`run` refuses it, and `check` where the position is known (error)",
        &[refused(
            "error[polar-without-angle]",
            "G17 G21 G90\nG0 X0 Y0\nG91 G0 @1^45\nM2\n",
            "G17 G21 G90\nG0 X1 Y0\nG91 G0 @1^45\nM2\n",
        )],
    ),
    held(
        "#gcode:polar-coordinates",
        "@ alone at the origin is refused (interpreter 2.9)",
        "rule `needed-word-missing`",
        &[refused(
            "error[needed-word-missing]",
            "G17 G21 G90\nG0 X0 Y0\nG0 @1\nM2\n",
            "G17 G21 G90\nG0 X1 Y0\nG0 @2\nM2\n",
        )],
    ),
    held(
        "#gcode:polar-coordinates",
        "Polar words and X or Y in one block are refused",
        "rule `polar-word-refused`",
        &[
            refused("error[polar-word-refused]", "G0 @1^5 X1\nM2\n", "G0 @1^5 Z1\nM2\n"),
            refused("error[polar-word-refused]", "G0 @1^5 Y1\nM2\n", "G0 @1^5 Z1\nM2\n"),
        ],
    ),
    gap(
        "#gcode:polar-coordinates",
        "Polar words are for moves only: not for G10, G28 and G92 (interpreter 2.9)",
        "`check` reports them (error), as `run` refuses them",
        &[
            refused("error[word-not-read]", "G10 L2 P1 @1^90\nM2\n", "G10 L2 P1 X1\nM2\n"),
            refused("error[word-not-read]", "G28 @1^90\nM2\n", "G28 X1\nM2\n"),
            refused("error[word-not-read]", "G92 @1^90\nM2\n", "G92 X1\nM2\n"),
        ],
    ),
    held(
        "#gcode:polar-coordinates",
        "A negative @ goes the other way, the plane does not matter, and Z and rotary words may be beside (interpreter 2.9)",
        "words `@` and `^`",
        &[
            runs(
                "G0 @-1^0\nG18 G0 @1^90 Z5 A5\nM2\n",
                &["STRAIGHT_TRAVERSE(-1.0000, 0.0000", "STRAIGHT_TRAVERSE(0.0000, 1.0000, 5.0000, 5.0000"],
            ),
            runs(
                "F100\nG0 X1 Y0\nG2 @1^90 R1\nG38.3 @5^45\nM2\n",
                &["ARC_FEED(0.0000, 1.0000", "STRAIGHT_PROBE(3.5355, 3.5355"],
            ),
            runs("G7\nG0 @2^0\nM2\n", &["STRAIGHT_TRAVERSE("]),
        ],
    ),
    held(
        "#gcode:order-of-execution",
        "Feed mode, feed and speed act before the spindle, the spindle before coolant, these before the dwell and the move",
        "`phases` of `control.toml`",
        &[runs(
            "G1 X1 G4 P1 M8 M3 S500 F100\nM2\n",
            &[
                "SET_FEED_RATE(100.0000",
                "SET_SPINDLE_SPEED(0, 500.0000)",
                "START_SPINDLE_CLOCKWISE",
                "FLOOD_ON",
                "DWELL(1.0000",
                "STRAIGHT_FEED(1.0000",
            ],
        )],
    ),
    held(
        "#gcode:order-of-execution",
        "T, then outputs, then M6, then the spindle",
        "`phases` of `control.toml`",
        &[runs(
            "M3 S100 M6 T1 M64 P1\nM2\n",
            &[
                "SET_SPINDLE_SPEED(0, 100.0000)",
                "SELECT_TOOL(1)",
                "SET_AUX_OUTPUT_BIT(1)",
                "CHANGE_TOOL(1)",
                "START_SPINDLE_CLOCKWISE",
            ],
        )],
    ),
    held(
        "#gcode:order-of-execution",
        "Plane, units, compensation, length, system, path mode, distance mode and return level act before the move",
        "`phases` of `control.toml`",
        &[runs(
            "G10 L2 P2 X10\nT1 M6\nG0 X1 Z5 G91 G61 G55 G43 G20 G18\nM2\n",
            &[
                "SELECT_PLANE",
                "USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
                "USE_TOOL_LENGTH_OFFSET",
                "SET_G5X_OFFSET(2",
                "SET_MOTION_CONTROL_MODE",
                "STRAIGHT_TRAVERSE(",
            ],
        )],
    ),
    held(
        "#gcode:order-of-execution",
        "The move comes before a stop or an end",
        "`phases` of `control.toml`",
        &[runs("M2 G0 X1\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"])],
    ),
    held(
        "#gcode:order-of-execution",
        "M5 and M9 act before the move of their block",
        "`phases` of `control.toml`",
        &[runs(
            "S100 M3\nM8\nF10 G1 X1 M5 M9\nM2\n",
            &["STOP_SPINDLE_TURNING", "FLOOD_OFF", "STRAIGHT_FEED(1.0000"],
        )],
    ),
    held(
        "#gcode:order-of-execution",
        "M5 in the block of a cut stops the spindle before it",
        "rule `spindle-stopped-while-cutting`",
        &[rule(
            "warning[spindle-stopped-while-cutting]",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1 F10\nX9 M5\nG0 Z5\nM2\n",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1 F10\nX9\nG0 Z5 M5\nM2\n",
        )],
    ),
    held(
        "#gcode:order-of-execution",
        "F acts before the units of its block change: `G20 F10` after millimetres is 10 mm a minute",
        "rule `feed-before-units`",
        &[
            rule(
                "warning[feed-before-units]",
                "G17 G21 G90\nF100\nG1 X1\nG20 G1 X2 F10\nM2\n",
                "G17 G21 G90\nF100\nG1 X1\nG20\nG1 X2 F10\nM2\n",
            ),
            Proof::Says {
                program: ngc("G17 G20 G90\nF10\nG1 X1\nG21 G1 X2 F100\nM2\n"),
                finding: "warning[feed-before-units]",
                words: "G21",
            },
        ],
    ),
    held(
        "#gcode:order-of-execution",
        "… and so it moves",
        "`phases` of `control.toml`",
        &[
            runs(
                "G21\nF100\nG1 X1\nG20 G1 X2 F10\nM2\n",
                &["SET_FEED_RATE(10.0000", "USE_LENGTH_UNITS(CANON_UNITS_INCHES)", "STRAIGHT_FEED(2.0000"],
            ),
            Proof::Stats {
                program: ngc("G21 G90\nF100\nG0 X0\nG20 G1 X1 F10\nM2\n"),
                prints: &["cutting 2:32.4"],
            },
        ],
    ),
    held(
        "#gcode:order-of-execution",
        "A message comes first",
        "phase `message`",
        &[Proof::Run {
            program: ngc("G21 G90\nG0 X1 (MSG, first)\nM2\n"),
            prints: &["first", "rapid 1.0000"],
        }],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "G codes above 99 are out of range; others that do not exist are unknown",
        "rule `unknown-code`",
        &[
            stops("G100\nM2\n"),
            stops("G3.5 X1\nM2\n"),
            stops("M25\nM2\n"),
            rule("warning[unknown-code]", "G100\nM2\n", "G99\nM2\n"),
            rule("warning[unknown-code]", "M25\nM2\n", "M9\nM2\n"),
            refused("error[unknown-code]", "G-1\nM2\n", "G0\nM2\n"),
        ],
    ),
    gap(
        "#cha:overview-of-g-code-programming",
        "Words that no code of the block reads are refused",
        "`check` reports H, D, L, Q, R, K, I, E, P and $ of a block without a code that reads them also where the block has no code at all, or another (error): it is silent for these today",
        &[
            refused("error[word-not-read]", "H5\nM2\n", "G43 H1\nM2\n"),
            refused("error[word-not-read]", "R5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "I5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "Q5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "L5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "D5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "E5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "G0 X1 $0\nM2\n", "G0 X1\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Where a code of the block does not read it, the word is reported",
        "rule `word-not-read`",
        &[
            refused("error[word-not-read]", "G0 X1 I5\nM2\n", "G0 X1\nM2\n"),
            refused("error[word-not-read]", "G0 X1 P5\nM2\n", "G0 X1\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Axis words need a code that uses them",
        "rule `axis-words-without-motion-mode`",
        &[refused("error[axis-words-without-motion-mode]", "G0 X1\nG80\nX5\nM2\n", "G0 X1\nX5\nM2\n")],
    ),
    unmodelled(
        "#gcode:file-size",
        "Size of a file is bounded by the disk",
        "gcheck reads files of any size; its bounds are in docs/dev/execution-model.md",
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
