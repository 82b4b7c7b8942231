//! Tool lengths and the tool table: `g-code.adoc`, G43 to G49; `tool-compensation.adoc`, tool table, tool length compensation;
//! `lathe-user.adoc`, lathe tool table; `rs274ngc.adoc`, additions.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: touch-off in the user interface, pins of tool changers, editing of the table.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, ngc, refused, rule, runs, unmodelled, with_table};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Tool lengths, tool table",
    key: "LEN",
    file: "linuxcnc/tool_length.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g43",
        "G43 without H takes the length of the tool in the spindle",
        "effect `length-plus`, `length-from-tool = true`",
        &[
            runs(
                "T1 M6\nG43\nG0 Z10\nM2\n",
                &[
                    "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 10.0000",
                ],
            ),
            Proof::Moves {
                program: ngc("G21 G90\nT1 M6\nG43\nG0 Z10\nM2\n").with(&["tools.1.length=50"]),
                are: &["rapid Z10. MZ60."],
            },
        ],
    ),
    held(
        "#gcode:g43",
        "G43 moves nothing; the next move of the axis goes to the compensated place",
        "effect `length-plus`",
        &[runs(
            "T1 M6\nG0 X1\nG43\nG0 X2\nG0 Z0\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000, 0.0000, 0.0000",
                "USE_TOOL_LENGTH_OFFSET(",
                "STRAIGHT_TRAVERSE(2.0000, 0.0000, -12.9794",
                "STRAIGHT_TRAVERSE(2.0000, 0.0000, 0.0000",
            ],
        )],
    ),
    held(
        "#gcode:g43",
        "G43 Hn takes the length of tool n",
        "words of `G43`",
        &[runs("T1 M6\nG43 H2\nG0 Z1\nM2\n", &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 38.1000"])],
    ),
    held(
        "#gcode:g43",
        "G43 with the number of another tool works with a wrong length",
        "rule `length-offset-of-another-tool`",
        &[rule(
            "warning[length-offset-of-another-tool]",
            "G17 G21 G90 G54\nT1 M6\nG43 H2\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1 F100\nG0 Z5\nM2\n",
            "G17 G21 G90 G54\nT1 M6\nG43 H1\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1 F100\nG0 Z5\nM2\n",
        )],
    ),
    held(
        "#gcode:g43",
        "#5081 to #5089 hold the offset in effect, says the documentation; in the interpreter of 2.9 they stay 0",
        "no system variable for 5081 to 5089",
        &[runs(
            "T1 M6 G43\nG0 Z5\nG0 X#5083\nM2\n",
            &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 5.0000", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 5.0000"],
        )],
    ),
    held(
        "#gcode:g43",
        "#5401 to #5409 hold the entry of the loaded tool, whether G43 is on or not",
        "system variables `tool-length`",
        &[runs(
            "T1 M6\nG0 X#5403\nG49\nG0 Y#5403\nM2\n",
            &["STRAIGHT_TRAVERSE(0.5110, 0.0000", "STRAIGHT_TRAVERSE(0.5110, 0.5110"],
        )],
    ),
    held(
        "#gcode:g43",
        "G43 H0 takes the tool in the spindle, and 0 without one (nonrandom changer)",
        "effect `length-plus`",
        &[
            runs("T1 M6\nG43 H0\nG0 Z1\nM2\n", &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794"]),
            runs("G43 H0\nG0 Z1\nM2\n", &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 0.0000"]),
        ],
    ),
    held(
        "#gcode:g43",
        "A negative H is refused, and so is a tool that the table does not have",
        "words of `G43`, rule `tool-not-in-table`",
        &[
            refused("error[number-out-of-range]", "G43 H-2\nM2\n", "G43 H2\nM2\n"),
            Proof::Refused {
                finding: "error[tool-not-in-table]",
                violates: with_table("G43 H77\nM2\n"),
                conforms: with_table("G43 H1\nM2\n"),
            },
        ],
    ),
    held(
        "#gcode:g43",
        "H must be whole",
        "`whole` of `H`",
        &[refused("error[number-out-of-range]", "G43 H1.5\nM2\n", "G43 H1\nM2\n")],
    ),
    held(
        "#cha:rs274ngc-programs",
        "G43 without a tool is an error, says the documentation; the interpreter (2.9) takes a length of 0",
        "effect `length-plus`",
        &[runs("G43\nG0 Z10\nM2\n", &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 0.0000"])],
    ),
    held(
        "#gcode:g43.1",
        "G43.1 replaces the offsets by its axis words and moves nothing",
        "effect `length-from-block`",
        &[
            runs(
                "T1 M6 G43\nG43.1 Z0.25\nG0 Z1\nM2\n",
                &[
                    "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 0.2500",
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000",
                ],
            ),
            runs("G43.1 X1 Z2\nG0 X0 Z0\nM2\n", &["USE_TOOL_LENGTH_OFFSET(1.0000, 0.0000, 2.0000"]),
        ],
    ),
    held(
        "#gcode:g43.1",
        "An axis that G43.1 leaves out keeps its offset (interpreter 2.9)",
        "effect `length-from-block`",
        &[runs("G43.1 X1 Z2\nG43.1 Z3\nG0 X0 Z0\nM2\n", &["USE_TOOL_LENGTH_OFFSET(1.0000, 0.0000, 3.0000"])],
    ),
    held(
        "#gcode:g43.1",
        "Motion in the block of G43.1 is an error, says the documentation; the interpreter (2.9) takes the words for the offset and moves on",
        "effect `length-from-block`",
        &[runs("G43.1 Z0.25 G0 X1\nM2\n", &["USE_TOOL_LENGTH_OFFSET(1.0000, 0.0000, 0.2500"])],
    ),
    held(
        "#gcode:g43.1",
        "An axis word beside G43.1 that was meant as a move changes the tool's offset along that axis",
        "rule `offset-words-beside-motion`",
        &[rule(
            "warning[offset-words-beside-motion]",
            "G21 G90\nG43.1 Z0.25 G0 X1\nM2\n",
            "G21 G90\nG43.1 Z0.25\nG0 X1\nM2\n",
        )],
    ),
    held(
        "#gcode:g43.1",
        "G43.1 writes nothing into the tool table",
        "effect `length-from-block`",
        &[runs(
            "T1 M6 G43\nG43.1 Z0.25\nG43\nG0 Z1\nM2\n",
            &[
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 0.2500",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
            ],
        )],
    ),
    held(
        "#cha:rs274ngc-programs",
        "G43.1 I K, says the documentation of differences; the interpreter (2.9) reads axis words, and refuses K",
        "words of `G43.1`",
        &[refused("error[word-not-read]", "G43.1 K0.25\nM2\n", "G43.1 Z0.25\nM2\n")],
    ),
    held(
        "#gcode:g43.2",
        "G43.2 Hn adds the offset of tool n; it can be used again and again",
        "effect `length-add`",
        &[runs(
            "T1 M6 G43\nG43.2 H2\nG43.2 H4\nG0 Z1\nM2\n",
            &[
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 51.0794",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 127.2794",
            ],
        )],
    ),
    held(
        "#gcode:g43.2",
        "G43.2 with axis words adds their values, says the documentation; the interpreter (2.9) refuses it without H",
        "effect `length-add`, `late-words`",
        &[
            Proof::RunRefused { program: ngc("T1 M6 G43\nG43.2 X0.01 Z0.02\nM2\n") },
            explains("G43.2", "axis"),
        ],
    ),
    held(
        "#gcode:g43.2",
        "H and axis words together are refused, and so is neither",
        "words of `G43.2`",
        &[
            refused("error[words-exclude-each-other]", "G43.2 H1 Z1\nM2\n", "G43.2 H1\nM2\n"),
            refused("error[word-choice-missing]", "G43.2\nM2\n", "G43.2 H1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g43.2",
        "A tool that the table does not have is refused",
        "rule `tool-not-in-table`",
        &[Proof::Refused {
            finding: "error[tool-not-in-table]",
            violates: with_table("G43.2 H77\nM2\n"),
            conforms: with_table("G43.2 H1\nM2\n"),
        }],
    ),
    held(
        "#gcode:g43.2",
        "G43.2 writes nothing into the tool table",
        "effect `length-add`",
        &[runs(
            "T1 M6 G43\nG43.2 H2\nG43\nG0 Z1\nM2\n",
            &[
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 51.0794",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
            ],
        )],
    ),
    held(
        "#gcode:g49",
        "G49 ends the compensation, and may be repeated",
        "effect `length-off`",
        &[
            runs(
                "T1 M6 G43\nG0 Z1\nG49\nG49\nG0 Z0\nM2\n",
                &[
                    "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 0.0000",
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000",
                ],
            ),
            rule(
                "warning[tool-length-missing]",
                "G17 G21 G90 G54\nT1 M6 G43\nG49\nG0 Z1\nM2\n",
                "G17 G21 G90 G54\nT1 M6 G43\nG0 Z1\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g49",
        "After G49 a Z of work coordinates takes the spindle nose where the tip was meant: the tool runs into the part by its length",
        "rule `length-cancelled-before-cut`",
        &[
            rule(
                "warning[length-cancelled-before-cut]",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-5 F100\nG49\nG0 Z5\nM2\n",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-5 F100\nG49\nG53 G0 Z0\nM2\n",
            ),
            rule(
                "warning[length-cancelled-before-cut]",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-5 F100\nG49 G0 Z5\nM2\n",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-5 F100\nG0 Z5\nG49\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m6",
        "A tool change does not change the length in effect; G43 must follow it",
        "rule `length-offset-of-another-tool`",
        &[
            runs(
                "T1 M6 G43\nG0 Z1\nT2 M6\nG0 Z2\nM2\n",
                &["CHANGE_TOOL(2)", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 2.0000"],
            ),
            rule(
                "warning[length-offset-of-another-tool]",
                "G17 G21 G90 G54\nT1 M6\nG43\nS100 M3\nG0 X0 Y0\nZ5\nF100 G1 Z-5\nG0 Z50\nT2 M6\nS100 M3\nG0 X10\nZ5\nG1 Z-5\nG0 Z50\nM2\n",
                "G17 G21 G90 G54\nT1 M6\nG43\nS100 M3\nG0 X0 Y0\nZ5\nF100 G1 Z-5\nG0 Z50\nT2 M6\nG43\nS100 M3\nG0 X10\nZ5\nG1 Z-5\nG0 Z50\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m61",
        "M61 does not change the length in effect either",
        "rule `length-offset-of-another-tool`",
        &[rule(
            "warning[length-offset-of-another-tool]",
            "G17 G21 G90 G54\nT1 M6\nG43\nS100 M3\nG0 X0 Y0\nZ5\nF100 G1 Z-5\nG0 Z50\nM61 Q2\nG0 X10\nZ5\nG1 Z-5\nG0 Z50\nM2\n",
            "G17 G21 G90 G54\nT1 M6\nG43\nS100 M3\nG0 X0 Y0\nZ5\nF100 G1 Z-5\nG0 Z50\nM61 Q2\nG43\nG0 X10\nZ5\nG1 Z-5\nG0 Z50\nM2\n",
        )],
    ),
    held(
        "#sec:tool-table",
        "A turning tool's entry offsets X and Z",
        "effect `length-plus`",
        &[runs("T3 M6 G43\nG0 X0 Z0\nM2\n", &["USE_TOOL_LENGTH_OFFSET(2.5400, 0.0000, -6.3500"])],
    ),
    held(
        "#cha:rs274ngc-programs",
        "Negative lengths work",
        "effect `length-plus`",
        &[runs("G10 L1 P1 Z-5\nT1 M6 G43\nG0 Z0\nM2\n", &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, -5.0000"])],
    ),
    held(
        "#sec:tool-table",
        "A tool table on disk has T, P, axes, D, I, J, Q in any order, a comment after `;`",
        "`tools.table` of the configuration",
        &[Proof::Moves {
            program: ngc("G21 G90\nT7 M6 G43\nG0 Z0 X0\nM2\n")
                .with(&["tools.table=\"tool.tbl\"", "machine.table_units=\"mm\""])
                .beside(&[("tool.tbl", "; tools\nT7 P3 D6 Z+40.5 X-1 Q2 I10 J20 ;an end mill\n")]),
            are: &["rapid X0. Z0. MX-1. MZ40.5"],
        }],
    ),
    held(
        "#sec:tool-table",
        "D of the table is the diameter, also a small difference that may be negative",
        "`radius-from-tool = true`",
        &[runs(
            "G17 G21 G90\nG10 L1 P1 R-0.1\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, -0.1000"],
        )],
    ),
    unmodelled(
        "#sub:tool-table-format",
        "Tool and pocket numbers must be unique, pockets at most 1000",
        "the table on disk is the operator's; gcheck reads it and takes the last entry of a number",
    ),
    unmodelled(
        "#sec:lathe-tool-table",
        "At most 56 tools, numbers up to 99999",
        "a limit of the table file, which the control checks when it loads it; versions differ",
    ),
    held(
        "#sec:lathe-tool-orientation",
        "Orientations are 0 to 9",
        "words of `G10`",
        &[Proof::Explains { control: "linuxcnc", code: "G10", says: "orientation" }],
    ),
    held(
        "#gcode:g43",
        "The mode ends with G49 alone: M2 leaves it on (interpreter 2.9)",
        "`at-end` of `[semantics]`",
        &[runs(
            "T1 M6 G43\nG0 Z1\nM2\n",
            &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000"],
        )],
    ),
    held(
        "#sub:ini:sec:emcio",
        "Setting the length in machine coordinates: G53 leaves the offset out",
        "effect `machine-coordinates`",
        &[Proof::Moves {
            program: ngc("G21 G90\nT1 M6 G43\nG53 G0 Z0\nG0 Z0\nM2\n").with(&["tools.1.length=50"]),
            are: &["rapid MZ0.", "rapid MZ50."],
        }],
    ),
    gap(
        "#mcode:m61",
        "M61 Q and G43 in one block: the length is that of the new tool (interpreter 2.9)",
        "`run` takes the length of the tool that M61 names in the same block (it takes none today), as a program shipped with LinuxCNC shows",
        &[runs("M61 Q1 G43\nG0 Z5\nM2\n", &["USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794"])],
    ),
    held(
        "#gcode:g43",
        "G43 in the block of the move and of the tool change acts before the move",
        "`phases` of `control.toml`",
        &[runs(
            "T1 M6 G43 G0 Z1\nM2\n",
            &[
                "CHANGE_TOOL(1)",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000",
            ],
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
