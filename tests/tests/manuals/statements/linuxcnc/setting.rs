//! Diameter mode, tool and work offset entries, planes, units, reference positions: `g-code.adoc`, G7, G8, G10, G17 to G19.1,
//! G20, G21, G28, G30; `rs274ngc.adoc`, units of offsets.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: what jogging does under a rotation.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{
    explains, gap, held, legal, ngc, refused, rule, runs, runs_with, stops, unmodelled, with_table,
};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Diameter mode, G10, planes, units, reference positions",
    key: "SET",
    file: "linuxcnc/setting.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g7",
        "Under G7 an X word is a diameter: the axis goes half as far",
        "effect `diameter-on`",
        &[
            runs("G7 G0 X10 Z1\nM2\n", &["STRAIGHT_TRAVERSE(5.0000, 0.0000, 1.0000"]),
            runs("G7 G91 G0 X10\nX-4\nM2\n", &["STRAIGHT_TRAVERSE(5.0000", "STRAIGHT_TRAVERSE(3.0000"]),
        ],
    ),
    held(
        "#gcode:g8",
        "Under G8 an X word is a radius; this is the mode at power-on",
        "effect `diameter-off`",
        &[runs(
            "G0 X10\nG7 X10\nG8 X10\nM2\n",
            &["STRAIGHT_TRAVERSE(10.0000", "STRAIGHT_TRAVERSE(5.0000", "STRAIGHT_TRAVERSE(10.0000"],
        )],
    ),
    gap(
        "#gcode:g10-l0",
        "G10 L0 reads the whole tool table again",
        "`gcheck run --output-format canonical` prints `RELOAD_TOOLDATA()` for `G10 L0`",
        &[runs("G10 L0\nM2\n", &["RELOAD_TOOLDATA("])],
    ),
    gap(
        "#gcode:g10-l0",
        "G10 L0 is refused while a tool is in the spindle",
        "`check` reports `G10 L0` with a tool loaded in the same program (error), as `run` refuses it",
        &[refused("error[codes-conflict]", "T1 M6\nG10 L0\nM2\n", "T0 M6\nT1\nM2\n")],
    ),
    unmodelled(
        "#gcode:g10-l0",
        "After G10 L0 #5401 to #5413 and compensation radii are the new ones, a length in effect stays",
        "the table on disk does not change while gcheck reads it",
    ),
    held(
        "#gcode:g10-l1",
        "G10 L1 writes the axis words into the table's entry for tool P",
        "effect `write-offsets`",
        &[runs(
            "G10 L1 P1 Z1.5\nT1 M6\nG43\nG0 Z10\nM2\n",
            &[
                "SET_TOOL_TABLE_ENTRY(1, 1, 0.0000, 0.0000, 0.0591",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 1.5000",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000, 10.0000",
            ],
        )],
    ),
    held(
        "#gcode:g10-l1",
        "R is the radius of the tool, I and J its front and back angle, Q its orientation",
        "effect `write-offsets`",
        &[
            runs(
                "G10 L1 P2 R0.5 Q3\nT2 M6\nG0 X#5410\nM2\n",
                &["0.0000, 0.0000, 3)", "STRAIGHT_TRAVERSE(0.0394"],
            ),
            runs("G10 L1 P1 Z1 I20 J-30 Q2 R0.4\nM2\n", &["20.0000, -30.0000, 2)"]),
        ],
    ),
    held(
        "#gcode:g10-l1",
        "R written by G10 L1 is what cutter compensation takes",
        "`radius-from-tool = true`",
        &[runs(
            "G17 G21 G90\nG10 L1 P1 R2\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, 2.0000"],
        )],
    ),
    held(
        "#gcode:g10-l1",
        "Under cutter compensation G10 L1 is an error, says the documentation; the interpreter (2.9) runs it",
        "effect `write-offsets`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41 D1\nG1 X10\nG10 L1 P1 Z1\nX20\nG40\nG1 X40 Y9\nM2\n",
            &["SET_TOOL_TABLE_ENTRY(1"],
        )],
    ),
    held(
        "#gcode:g10-l1",
        "G10 L1 without P is refused",
        "`required-with` of P",
        &[refused("error[required-word-missing]", "G10 L1 Z1\nM2\n", "G10 L1 P1 Z1\nM2\n")],
    ),
    held(
        "#gcode:g10-l1",
        "P0 is refused, and so is a negative P",
        "rules `tool-not-in-table`, `number-out-of-range`",
        &[
            refused("error[tool-not-in-table]", "G10 L1 P0 Z1\nM2\n", "G10 L1 P1 Z1\nM2\n"),
            refused("error[number-out-of-range]", "G10 L1 P-1 Z1\nM2\n", "G10 L1 P1 Z1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g10-l1",
        "A tool that the table does not have is refused",
        "rule `tool-not-in-table`",
        &[Proof::Refused {
            finding: "error[tool-not-in-table]",
            violates: with_table("G10 L1 P77 Z1\nM2\n"),
            conforms: with_table("G10 L1 P1 Z1\nM2\n"),
        }],
    ),
    held(
        "#gcode:g10-l1",
        "P must be whole; the interpreter (2.9) refuses a fraction below a half and rounds one above",
        "effect of `G10`, rule `number-out-of-range`",
        &[
            stops("G10 L1 P1.4 Z1\nM2\n"),
            runs("G10 L1 P1.5 Z1\nM2\n", &["SET_TOOL_TABLE_ENTRY(2"]),
            rule("warning[number-out-of-range]", "G10 L1 P1.5 Z1\nM2\n", "G10 L1 P1 Z1\nM2\n"),
        ],
    ),
    gap(
        "#gcode:g10-l1",
        "G10 L1 that sets nothing is refused (interpreter 2.9)",
        "`run` and `check` refuse `G10 L1 P1` with neither an axis nor R, I, J, Q (error)",
        &[refused("error[word-choice-missing]", "G10 L1 P1\nM2\n", "G10 L1 P1 Z1\nM2\n")],
    ),
    gap(
        "#gcode:g10-l1",
        "Q is an orientation from 0 to 9; the interpreter (2.9) takes Q-1 for no Q",
        "`check` reports Q10 (error) as `run` does; `run` takes `Q-1` for no word, as the interpreter does",
        &[
            refused("error[number-out-of-range]", "G10 L1 P1 Q10\nM2\n", "G10 L1 P1 Q9\nM2\n"),
            runs("G10 L1 P1 Z1 Q-1\nM2\n", &["SET_TOOL_TABLE_ENTRY(1, 1, 0.0000, 0.0000, 0.0394"]),
        ],
    ),
    held(
        "#gcode:g10-l2",
        "G10 L2 puts the origin of coordinate system P, counted from the machine's origin, where the axis words say; others stay",
        "effect `write-offsets`",
        &[
            runs(
                "G10 L2 P1 X3.5 Y17.2\nG0 X0 Y0\nG10 L2 P1 X0 Z2\nG53 G0 X0 Y0 Z0\nM2\n",
                &[
                    "SET_G5X_OFFSET(1, 3.5000, 17.2000, 0.0000",
                    "SET_G5X_OFFSET(1, 0.0000, 17.2000, 2.0000",
                    "STRAIGHT_TRAVERSE(0.0000, -17.2000, -2.0000",
                ],
            ),
            Proof::Moves {
                program: ngc("G21 G90 G10 L2 P1 X3.5 Y17.2\nG0 X0 Y0\nM2\n"),
                are: &["rapid X0. Y0. MX3.5 MY17.2"],
            },
        ],
    ),
    held(
        "#gcode:g10-l2",
        "P1 to P9 are G54 to G59.3, P0 is the active system",
        "effect `write-offsets`",
        &[
            runs(
                "G10 L2 P6 X6\nG10 L2 P7 X7\nG10 L2 P9 X9\nG59 G0 X0\nG59.1 X0\nG59.3 X0\nM2\n",
                &["SET_G5X_OFFSET(6, 6.0000", "SET_G5X_OFFSET(7, 7.0000", "SET_G5X_OFFSET(9, 9.0000"],
            ),
            runs(
                "G55\nG10 L2 P0 X3.5\nG54 G0 X0\nM2\n",
                &["SET_G5X_OFFSET(2, 3.5000", "SET_G5X_OFFSET(1, 0.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g10-l2",
        "R turns X and Y around Z, counter-clockwise seen from the positive end of Z",
        "effect `write-offsets`",
        &[
            runs(
                "G10 L2 P1 R90\nG0 X10 Y0\nM2\n",
                &["SET_XY_ROTATION(90.0000)", "STRAIGHT_TRAVERSE(10.0000, 0.0000"],
            ),
            Proof::Moves {
                program: ngc("G21 G90 G10 L2 P1 X0 Y0 R90\nG0 X10 Y0\nM2\n"),
                are: &["rapid X10. Y0. MX0. MY10."],
            },
        ],
    ),
    held(
        "#gcode:g10-l2",
        "G91 has no effect on G10 L2",
        "effect `write-offsets`",
        &[runs(
            "G10 L2 P1 X2\nG91\nG10 L2 P1 X3\nG90 G0 X0\nM2\n",
            &["SET_G5X_OFFSET(1, 2.0000", "SET_G5X_OFFSET(1, 3.0000"],
        )],
    ),
    held(
        "#gcode:g10-l2",
        "G10 L2 does not choose the system it writes",
        "effect `write-offsets`",
        &[Proof::Moves {
            program: ngc("G21 G90\nG10 L2 P1 X1\nG10 L2 P2 X3\nG0 X0\nG55 X0\nM2\n"),
            are: &["rapid X0. MX1.", "rapid X0. MX3."],
        }],
    ),
    held(
        "#gcode:g10-l2",
        "If the system is active the new origin counts at once, and the position reads anew",
        "effect `write-offsets`",
        &[runs(
            "G0 X10\nG10 L2 P1 X4\nG0 Y#5420\nM2\n",
            &["SET_G5X_OFFSET(1, 4.0000", "STRAIGHT_TRAVERSE(6.0000, 6.0000"],
        )],
    ),
    held(
        "#gcode:g10-l2",
        "A shift of G52 or G92 stays in effect, and is applied after the rotation",
        "effects `write-offsets`, `local-shift`",
        &[
            Proof::Moves {
                program: ngc("G21 G90\nG52 X5\nG10 L2 P1 X3\nG0 X0\nG52 X0\nM2\n"),
                are: &["rapid X0. MX8."],
            },
            Proof::Moves {
                program: ngc("G21 G90\nG10 L2 P1 X0 Y0 R90\nG52 X5\nG0 X0 Y0\nG52 X0\nM2\n"),
                are: &["rapid X0. Y0. MX0. MY5."],
            },
        ],
    ),
    held(
        "#gcode:g10-l2",
        "P must be whole and from 0 to 9; the interpreter (2.9) refuses a fraction below a half only",
        "effect of `G10`, `beside` of `P`",
        &[
            refused("error[word-unfit-for-another]", "G10 L2 P10 X1\nM2\n", "G10 L2 P9 X1\nM2\n"),
            refused("error[number-out-of-range]", "G10 L2 P-1 X1\nM2\n", "G10 L2 P0 X1\nM2\n"),
            runs("G10 L2 P1.5 X1\nM2\n", &["SET_G5X_OFFSET(1, 1.0000"]),
            stops("G10 L2 P1.2 X1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g10-l2",
        "All axis words of G10 L2 are optional",
        "words of `G10`",
        &[runs("G10 L2 P1\nM2\n", &["SET_G5X_OFFSET(1, 0.0000"]), legal("G10 L2 P1\nM2\n")],
    ),
    held(
        "#gcode:g10-l10",
        "G10 L10 sets the tool's entry so that, with the offset loaded again, the present position reads as the axis words say, under the present systems",
        "effect `write-offsets`",
        &[
            runs(
                "T1 M6 G43\nG0 Z10\nG10 L10 P1 Z1.5\nG43\nG0 Z1.5\nM2\n",
                &[
                    "SET_TOOL_TABLE_ENTRY(1",
                    "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 21.4794",
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.5000",
                ],
            ),
            runs(
                "G10 L2 P1 Z3\nG52 Z1\nT1 M6 G43\nG0 Z10\nG10 L10 P1 Z1.5\nG43\nG0 Z1.5\nM2\n",
                &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 21.4794"],
            ),
        ],
    ),
    held(
        "#gcode:g10-l10",
        "Axes that are not named keep their entry",
        "effect `write-offsets`",
        &[runs("T3 M6 G43\nG0 X10 Z10\nG10 L10 P3 Z1\nM2\n", &["SET_TOOL_TABLE_ENTRY(3, 3, 0.1000"])],
    ),
    held(
        "#gcode:g10-l10",
        "P is required, not 0, and a tool of the table",
        "words of `G10`, rule `tool-not-in-table`",
        &[
            refused("error[required-word-missing]", "G10 L10 Z1\nM2\n", "G10 L10 P1 Z1\nM2\n"),
            refused(
                "error[tool-not-in-table]",
                "T1 M6 G43\nG0 Z9\nG10 L10 P0 Z1\nM2\n",
                "T1 M6 G43\nG0 Z9\nG10 L10 P1 Z1\nM2\n",
            ),
            Proof::Refused {
                finding: "error[tool-not-in-table]",
                violates: with_table("G10 L10 P77 Z1\nM2\n"),
                conforms: with_table("G10 L10 P1 Z1\nM2\n"),
            },
        ],
    ),
    held(
        "#gcode:g10-l11",
        "G10 L11 sets the entry so that the present position would read as given in G59.3 without G52 and G92",
        "effect `write-offsets`",
        &[runs(
            "G10 L2 P9 Z5\nG10 L2 P1 Z30\nT1 M6\nG0 Z10\nG52 Z7\nG10 L11 P1 Z1\nG52 Z0\nG43 G59.3\nG0 Z1\nM2\n",
            &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 34.0000"],
        )],
    ),
    held(
        "#gcode:g10-l11",
        "P is required, not 0, and a tool of the table",
        "words of `G10`, rule `tool-not-in-table`",
        &[
            refused("error[required-word-missing]", "G10 L11 Z1\nM2\n", "G10 L11 P1 Z1\nM2\n"),
            refused("error[tool-not-in-table]", "G10 L11 P0 Z1\nM2\n", "G10 L11 P1 Z1\nM2\n"),
            Proof::Refused {
                finding: "error[tool-not-in-table]",
                violates: with_table("G10 L11 P77 Z1\nM2\n"),
                conforms: with_table("G10 L11 P1 Z1\nM2\n"),
            },
        ],
    ),
    held(
        "#gcode:g10-l20",
        "G10 L20 puts the origin so that the present position reads as the axis words say",
        "effect `write-offsets`",
        &[
            runs(
                "G0 X2 Y3\nG10 L20 P1 X1.5\nG0 X0 Y0\nM2\n",
                &["SET_G5X_OFFSET(1, 0.5000, 0.0000", "STRAIGHT_TRAVERSE(0.0000, 0.0000"],
            ),
            runs("G55\nG0 X2\nG10 L20 P0 X1.5\nM2\n", &["SET_G5X_OFFSET(2, 0.5000"]),
            runs(
                "T1 M6 G43\nG0 Z20\nG10 L20 P3 Z0\nG56 G0 Z0\nM2\n",
                &["SET_G5X_OFFSET(3, 0.0000, 0.0000, 20.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g10-l20",
        "P must be whole and from 0 to 9; R is refused (interpreter 2.9)",
        "`beside` of `P` and `R`",
        &[
            refused("error[word-unfit-for-another]", "G10 L20 P10 X1\nM2\n", "G10 L20 P9 X1\nM2\n"),
            refused("error[word-unfit-for-another]", "G10 L20 P1 R45\nM2\n", "G10 L20 P1 X4\nM2\n"),
        ],
    ),
    held(
        "#gcode:g10-l0 to #gcode:g10-l20",
        "L of G10 is 0, 1, 2, 10, 11 or 20, each with a section of its own; another is refused (interpreter 2.9)",
        "`values` and `whole` of `L`",
        &[
            refused("error[number-out-of-range]", "G10 L3 P1 X1\nM2\n", "G10 L2 P1 X1\nM2\n"),
            refused("error[number-out-of-range]", "G10 L2.5 P1 X1\nM2\n", "G10 L2 P1 X1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g17-g19.1",
        "G17 is XY and the default, G18 ZX, G19 YZ, G17.1 UV, G18.1 WU, G19.1 VW",
        "group `plane`",
        &[runs(
            "G18\nG0 X#<_plane>\nG19\nX#<_plane>\nG17.1\nX#<_plane>\nG18.1\nX#<_plane>\nG19.1\nX#<_plane>\nG17\nX#<_plane>\nM2\n",
            &[
                "SELECT_PLANE(CANON_PLANE_XZ)",
                "STRAIGHT_TRAVERSE(180",
                "STRAIGHT_TRAVERSE(190",
                "STRAIGHT_TRAVERSE(171",
                "STRAIGHT_TRAVERSE(181",
                "STRAIGHT_TRAVERSE(191",
                "STRAIGHT_TRAVERSE(170",
            ],
        )],
    ),
    held(
        "#gcode:g20-g21",
        "Under G20 lengths are inches, under G21 millimetres",
        "effects `inch`, `millimetre`",
        &[
            runs(
                "G20 G0 X1\nG21 G0 X1\nM2\n",
                &[
                    "USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
                    "STRAIGHT_TRAVERSE(1.0000",
                    "USE_LENGTH_UNITS(CANON_UNITS_MM)",
                    "STRAIGHT_TRAVERSE(1.0000",
                ],
            ),
            Proof::Moves {
                program: ngc("G90 G20 G0 X1\nG21 G0 Y1\nM2\n").with(&["machine.units=\"mm\""]),
                are: &["rapid X1.", "rapid X25.4 Y1."],
            },
        ],
    ),
    held(
        "#gcode:g20-g21",
        "A preamble should state the units",
        "rule `units-not-stated` (set `strict`)",
        &[Proof::Explains { control: "linuxcnc", code: "G21", says: "head of every program" }],
    ),
    held(
        "#gcode:g28-g28.1",
        "G28 moves all axes at rapid rate to the stored position, in machine coordinates; nothing stored is the machine's origin",
        "effect `return-reference`",
        &[
            runs(
                "G0 X5 Y5 Z5\nG28.1\nG0 X0 Y0 Z0\nG28\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000", "STRAIGHT_TRAVERSE(5.0000, 5.0000, 5.0000"],
            ),
            runs(
                "G0 X5\nG28\nM2\n",
                &["STRAIGHT_TRAVERSE(5.0000", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000"],
            ),
            runs("G10 L2 P1 X10\nG0 X0\nG28\nM2\n", &["STRAIGHT_TRAVERSE(-10.0000"]),
        ],
    ),
    held(
        "#gcode:g28-g28.1",
        "G28 with axis words first makes a rapid move to the point they name, offsets included, then takes only these axes to the stored position",
        "effect `return-reference`",
        &[
            runs(
                "G0 X5 Y5 Z5\nG28.1\nG0 X0 Y0 Z0\nG28 Z2.5\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 2.5000", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 5.0000"],
            ),
            runs(
                "G0 X5 Z5\nG91 G28 Z0\nM2\n",
                &["STRAIGHT_TRAVERSE(5.0000, 0.0000, 5.0000", "STRAIGHT_TRAVERSE(5.0000, 0.0000, 0.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g28-g28.1",
        "The way through the named point can pass through the part",
        "rule `reference-return-through-point`",
        &[rule(
            "warning[reference-return-through-point]",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-5 F100\nX9\nG28 Z-8\nM2\n",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-5 F100\nX9\nG91 G28 Z0\nM2\n",
        )],
    ),
    held(
        "#gcode:g28-g28.1",
        "G28.1 stores the present machine position in #5161 to #5169, in the machine's unit",
        "effect `store-reference`",
        &[
            runs(
                "G10 L2 P1 X2\nG0 X4 Z7\nG28.1\nG0 Y#5161 Z#5163\nM2\n",
                &["STRAIGHT_TRAVERSE(4.0000, 0.2362, 0.2756"],
            ),
            runs(
                "G20\nG0 X1\nG28.1\nG0 X#5161\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(1.0000"],
            ),
            Proof::Moves {
                program: ngc("G90 G20\nG0 X1\nG28.1\nG0 Y#5161\nM2\n").with(&["machine.table_units=\"mm\""]),
                are: &["rapid X1.", "rapid Y25.4"],
            },
        ],
    ),
    held(
        "#gcode:g28-g28.1",
        "Writing #5161 to #5169 moves the stored position",
        "system variables `reference1`",
        &[
            runs("#5161=3\nG0 X9\nG28 X5\nM2\n", &["STRAIGHT_TRAVERSE(5.0000", "STRAIGHT_TRAVERSE(76.2000"]),
            Proof::Moves {
                program: ngc("G90 G21\n#5161=3\nG0 X9\nG28 X5\nM2\n").with(&["machine.units=\"mm\""]),
                are: &["rapid X9.", "rapid X5.", "rapid X3."],
            },
        ],
    ),
    held(
        "#gcode:g28-g28.1",
        "G28 under cutter compensation is refused",
        "rule `refused-under-compensation`",
        &[refused(
            "error[refused-under-compensation]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG28\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG28\nM2\n",
        )],
    ),
    held(
        "#gcode:g28-g28.1",
        "Axis words beside G28.1 are not read (interpreter 2.9)",
        "rule `axis-words-without-motion-mode`",
        &[
            rule("warning[axis-words-without-motion-mode]", "G28.1 X1\nM2\n", "G28.1\nM2\n"),
            stops("G28.1 X1\nM2\n"),
        ],
    ),
    unmodelled(
        "#gcode:g28-g28.1",
        "G28 is for a machine that was homed, with a position that was stored",
        "whether the machine was homed is not in the program; where the position is unknown `check` assumes nothing about it",
    ),
    held(
        "#gcode:g30-g30.1",
        "G30 does the same with #5181 to #5189, G30.1 stores them",
        "effects `return-reference`, `store-reference`",
        &[
            runs(
                "G0 X5 Y4\nG30.1\nG0 X0 Y0\nG30 X1\nG0 Z#5182\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000",
                    "STRAIGHT_TRAVERSE(5.0000, 0.0000",
                    "STRAIGHT_TRAVERSE(5.0000, 0.0000, 0.1575",
                ],
            ),
            runs(
                "G0 X5 Y4\nG30.1\nG0 X0 Y0\nG30\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000", "STRAIGHT_TRAVERSE(5.0000, 4.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g30-g30.1",
        "G30 under cutter compensation is refused",
        "rule `refused-under-compensation`",
        &[refused(
            "error[refused-under-compensation]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG30 Z0\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG30 Z0\nM2\n",
        )],
    ),
    held(
        "#cha:rs274ngc-programs",
        "Values of G28, G30, coordinate systems and G92 in parameters are in the machine's unit, whatever G20 or G21 says",
        "system variables `work-offset`, `shift`, `reference1`",
        &[
            runs(
                "G20\nG10 L2 P1 X1\nG0 X#5221\nG0 X4\nG92 X0\nG0 Y#5211\nM2\n",
                &[
                    "SET_G5X_OFFSET(1, 1.0000",
                    "STRAIGHT_TRAVERSE(1.0000",
                    "SET_G92_OFFSET(4.0000",
                    "STRAIGHT_TRAVERSE(0.0000, 4.0000",
                ],
            ),
            runs(
                "G21\nG10 L2 P1 X1\nG0 X#5221\nM2\n",
                &["SET_G5X_OFFSET(1, 1.0000", "STRAIGHT_TRAVERSE(0.0394"],
            ),
            Proof::Moves {
                program: ngc("G90 G20\nG10 L2 P1 X1\nG0 X#5221\nM2\n").with(&["machine.table_units=\"mm\""]),
                are: &["rapid X25.4"],
            },
        ],
    ),
    gap(
        "#cha:rs274ngc-programs",
        "The machine's unit is that of `LINEAR_UNITS`",
        "where `[machine] units` is told and `table_units` is not, parameters of offsets count in `units`, as the configuration's description says; they count in the program's unit today",
        &[Proof::Moves {
            program: ngc("G90 G20\nG10 L2 P1 X1\nG0 X#5221\nM2\n").with(&["machine.units=\"mm\""]),
            are: &["rapid X25.4"],
        }],
    ),
    held(
        "#cha:rs274ngc-programs",
        "Offsets and diameters of the tool table are in the machine's unit",
        "`machine.table_units`",
        &[Proof::Moves {
            program: ngc("G20 G90\nT1 M6 G43\nG0 Z1\nM2\n")
                .with(&["machine.units=\"mm\"", "tools.1.length=25.4"]),
            are: &["rapid Z1. MZ2."],
        }],
    ),
    held(
        "#cha:rs274ngc-programs",
        "After a tool change the machine does not go back to where it was",
        "effect `tool-change`",
        &[runs("G0 X5\nT1 M6\nG91 G0 X1\nM2\n", &["CHANGE_TOOL(1)", "STRAIGHT_TRAVERSE(6.0000"])],
    ),
    held(
        "#gcode:g10-l2",
        "The active system and its shift also follow when a parameter of the system is written (interpreter 2.9: from the next choice of the system on)",
        "system variables `work-offset`",
        &[runs("#5221=5\nG0 X0\nG54 G0 X0\nG55\nG54 G0 X0\nM2\n", &["STRAIGHT_TRAVERSE(0.0000"])],
    ),
    held(
        "#gcode:g10-l1",
        "What G10 writes in a program stays for the next ones",
        "text of `G10`",
        &[explains("G10", "L1")],
    ),
    held(
        "#gcode:g10-l2",
        "An axis that is not configured is refused",
        "effect of `G10`",
        &[
            stops("G10 L2 P1 U5\nM2\n"),
            Proof::Stops {
                program: ngc("G10 L2 P1 A5\nM2\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\"]"]),
                says: "the machine has no axis `A`",
            },
        ],
    ),
    held(
        "#gcode:g10-l10",
        "L10 and L11 take the values of R, I, J, Q as L1 does",
        "effect `write-offsets`",
        &[runs(
            "T1 M6 G43\nG0 Z9\nG10 L10 P1 Z1 R3 I10 J20 Q4\nG10 L11 P2 Z1 R2\nM2\n",
            &["10.0000, 20.0000, 4)", "SET_TOOL_TABLE_ENTRY(2"],
        )],
    ),
    held(
        "#gcode:g10-l10",
        "A tool entry that is written counts for the length only when it is loaded again",
        "effect `write-offsets`",
        &[runs_with(
            ngc("T1 M6 G43\nG10 L1 P1 Z99\nG0 Z0\nG43\nG0 Z0\nM2\n"),
            &[
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 99.0000",
            ],
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
