//! Tools, outputs, inputs, user commands: `m-code.adoc`, M6, M61 to M68, M100 to M199; `other-code.adoc`, T;
//! `ini-config.adoc`, tool changer and user commands.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: pins, how changers are wired, how user commands are written and made executable.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{
    explains, gap, held, legal, ngc, refused, rule, runs, runs_with, stops, unmodelled, with_table,
};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Tools, outputs, inputs, user commands",
    key: "TOL",
    file: "linuxcnc/tools.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#sec:select-tool",
        "T prepares a tool; it is changed by the next M6, in the same block or later",
        "effects `tool-change`, `change-by-t = false`",
        &[runs(
            "T1\nG0 X1\nM6\nT2 M6\nM2\n",
            &[
                "SELECT_TOOL(1)",
                "STRAIGHT_TRAVERSE(1.0000",
                "START_CHANGE",
                "CHANGE_TOOL(1)",
                "SELECT_TOOL(2)",
                "CHANGE_TOOL(2)",
            ],
        )],
    ),
    held(
        "#sec:select-tool",
        "Of several T only the last counts at the change",
        "phase `tool-select`, rule `tool-called-not-changed`",
        &[
            runs("T1\nT2\nM6\nG0 X#5400\nM2\n", &["CHANGE_TOOL(2)", "STRAIGHT_TRAVERSE(2.0000"]),
            rule("info[tool-called-not-changed]", "T1\nT2\nM6\nM2\n", "T2\nM6\nM2\n"),
        ],
    ),
    held(
        "#sec:select-tool",
        "T0 selects no tool (nonrandom changer): the spindle is empty after M6",
        "effect `tool-change`",
        &[
            runs("T1 M6\nT0 M6\nM2\n", &["SELECT_TOOL(0)", "CHANGE_TOOL(0)"]),
            Proof::Moves { program: ngc("G21 G90\nT1 M6\nT0 M6\nG0 X#5400\nM2\n"), are: &["rapid X0."] },
        ],
    ),
    gap(
        "#gcode:g43",
        "G43 with an empty spindle is a length of 0",
        "after `T0 M6` the length is that of what the spindle held, which is not known without the whole tool table",
        &[
            Proof::Moves {
                program: ngc("G21 G90\nT1 M6 G43\nT0 M6 G43\nG0 Z1\nM2\n").with(&["tools.1.length=50"]),
                are: &["rapid Z1. MZ1."],
            },
            Proof::Moves {
                program: ngc("G21 G90\nT1 M6\nM61 Q0\nG43\nG0 Z1\nM2\n").with(&["tools.1.length=50"]),
                are: &["rapid Z1. MZ1."],
            },
        ],
    ),
    gap(
        "#gcode:g43",
        "G43 with an empty spindle is a length of 0, also with a tool table on disk",
        "`run` has no length after `T0 M6` with a table on disk either: it keeps that of the tool before, as the interpreter alone does without a machine (a row of deliberate differences)",
        &[
            Proof::Moves {
                program: with_table("G21 G90\nT1 M6 G43\nT0 M6 G43\nG0 Z1\nM2\n"),
                are: &["rapid Z1. MZ1."],
            },
            Proof::Moves {
                program: with_table("G21 G90\nM61 Q1\nG43\nG0 Z0\nM2\n"),
                are: &["rapid Z0. MZ12.7"],
            },
        ],
    ),
    held(
        "#sec:select-tool",
        "A negative T is refused",
        "address `T`",
        &[refused("error[sign-not-accepted]", "T-1\nM2\n", "T1\nM2\n")],
    ),
    held(
        "#sec:select-tool",
        "A T that the table does not have is refused",
        "rule `tool-not-in-table`",
        &[Proof::Refused {
            finding: "error[tool-not-in-table]",
            violates: with_table("T77 M6\nM2\n"),
            conforms: with_table("T1 M6\nM2\n"),
        }],
    ),
    held(
        "#sec:select-tool",
        "T must be whole (interpreter 2.9)",
        "`whole` of `T`",
        &[refused("error[number-out-of-range]", "T1.5\nM2\n", "T1\nM2\n")],
    ),
    held(
        "#mcode:m6",
        "M6 stops the spindle and puts the selected tool into it; coolant goes on",
        "`change-stops-spindle = true`",
        &[
            runs(
                "S100 M3\nM8\nT1 M6\nG0 X#<_spindle_on> Y#<_flood>\nM2\n",
                &[
                    "START_CHANGE",
                    "STOP_SPINDLE_TURNING(0)",
                    "CHANGE_TOOL(1)",
                    "STRAIGHT_TRAVERSE(0.0000, 1.0000",
                ],
            ),
            rule(
                "warning[spindle-stopped-while-cutting]",
                "G17 G21 G90 G54\nS100 M3\nT1 M6 G43\nG0 X0 Y0\nZ5\nG1 Z-1 F10\nG0 Z5\nM2\n",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1 F10\nG0 Z5\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m6",
        "A change to the tool that is in is fine",
        "effect `tool-change`",
        &[runs("T1 M6\nT1 M6\nM2\n", &["CHANGE_TOOL(1)", "CHANGE_TOOL(1)"]), legal("T1 M6\nT1 M6\nM2\n")],
    ),
    held(
        "#mcode:m6",
        "M6 without any T is reported; the interpreter (2.9) puts no tool in",
        "rules `tool-change-without-t`, `lasting-word-never-given`",
        &[
            runs("M6\nM2\n", &["CHANGE_TOOL(0)"]),
            rule("warning[tool-change-without-t]", "M6\nM2\n", "T1 M6\nM2\n"),
        ],
    ),
    held(
        "#mcode:m6",
        "Modes stay over a tool change",
        "effect `tool-change`",
        &[runs("G91 G18\nT1 M6\nG0 X1\nX1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000"])],
    ),
    gap(
        "#sub:ini:sec:emcio",
        "`TOOL_CHANGE_QUILL_UP`, `TOOL_CHANGE_AT_G30` and `TOOL_CHANGE_POSITION` move axes at the change",
        "settings that say so, and moves at M6 (rapid to machine Z0; to the G30 position; to the place) in `run`, `stats`, `plot`",
        &[runs_with(
            ngc("G0 Z-5\nT1 M6\nG0 X1\nM2\n")
                .with(&["settings.TOOL_CHANGE_QUILL_UP=1"])
                .beside(&[("machine.ini", "[EMCIO]\nTOOL_CHANGE_QUILL_UP=1\n")]),
            &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000", "CHANGE_TOOL(1)"],
        )],
    ),
    unmodelled(
        "#sub:ini:sec:emcio",
        "`TOOL_CHANGE_WITH_SPINDLE_ON = 1` leaves the spindle on at the change",
        "the interpreter alone (2.9) has no such switch to compare with; `change-stops-spindle` is the control as delivered",
    ),
    unmodelled(
        "#sub:ini:sec:emcio",
        "`RANDOM_TOOLCHANGER = 1`: T0 is a tool, D0 and H0 name it, pockets change with tools",
        "a machine's configuration; the control as delivered has a nonrandom changer",
    ),
    unmodelled("#sub:tool-io", "Signals between changer and control", "hardware"),
    held(
        "#mcode:m61",
        "M61 Q makes Q the number of the tool in the spindle without a change; meant for MDI and manual mode, it works in a program as well (interpreter 2.9)",
        "effect `set-tool-number`",
        &[
            runs("M61 Q2\nM2\n", &["CHANGE_TOOL_NUMBER(2)"]),
            Proof::Moves { program: ngc("G21 G90\nM61 Q2\nG0 X#5400\nM2\n"), are: &["rapid X2."] },
            Proof::Moves { program: ngc("G21 G90\nT1 M6\nM61 Q0\nG0 X#5400\nM2\n"), are: &["rapid X0."] },
        ],
    ),
    gap(
        "#mcode:m61",
        "G43 after M61 takes the length of the new tool",
        "the length is that of what the spindle held, as the interpreter alone has it, and is not known without the whole tool table",
        &[Proof::Moves {
            program: ngc("G21 G90\nM61 Q1\nG43\nG0 Z1\nM2\n").with(&["tools.1.length=50"]),
            are: &["rapid Z1. MZ51."],
        }],
    ),
    held(
        "#mcode:m61",
        "Q is required, not negative, and a tool of the table",
        "words of `M61`, rule `tool-not-in-table`",
        &[
            refused("error[required-word-missing]", "M61\nM2\n", "M61 Q1\nM2\n"),
            refused("error[number-out-of-range]", "M61 Q-1\nM2\n", "M61 Q1\nM2\n"),
            Proof::Refused {
                finding: "error[tool-not-in-table]",
                violates: with_table("M61 Q77\nM2\n"),
                conforms: with_table("M61 Q1\nM2\n"),
            },
        ],
    ),
    held(
        "#tbl:mcodes-modal-groups",
        "M6 and M61 in one block are refused",
        "rule `two-codes-of-one-group`",
        &[refused("error[two-codes-of-one-group]", "M6 T1 M61 Q1\nM2\n", "M6 T1\nM61 Q1\nM2\n")],
    ),
    held(
        "#mcode:m62-m65",
        "M62 and M63 switch output P on and off with the next move, M64 and M65 at once",
        "effects `output-on-with-move`, `output-on`",
        &[runs(
            "M62 P0\nG0 X1\nM63 P0\nG0 X2\nM64 P1\nM65 P1\nM2\n",
            &[
                "SET_MOTION_OUTPUT_BIT(0)",
                "STRAIGHT_TRAVERSE(1.0000",
                "CLEAR_MOTION_OUTPUT_BIT(0)",
                "STRAIGHT_TRAVERSE(2.0000",
                "SET_AUX_OUTPUT_BIT(1)",
                "CLEAR_AUX_OUTPUT_BIT(1)",
            ],
        )],
    ),
    held(
        "#mcode:m62-m65",
        "P is required",
        "words of `M62`",
        &[
            refused("error[required-word-missing]", "M62\nM2\n", "M62 P0\nG0 X1\nM2\n"),
            refused("error[required-word-missing]", "M64\nM2\n", "M64 P0\nM2\n"),
        ],
    ),
    gap(
        "#mcode:m62-m65",
        "P is 0 to 3 unless the machine has more outputs; the interpreter (2.9) takes any number, also a negative one",
        "`check` reports P of 4 and above, and of 64 and above (info, and warning: more than the motion controller can have), a negative P (warning), one that is not whole; `run` runs `P-1` as the interpreter does",
        &[
            rule("info[number-out-of-range]", "M62 P4\nG0 X1\nM2\n", "M62 P3\nG0 X1\nM2\n"),
            rule("warning[number-out-of-range]", "M64 P100\nM2\n", "M64 P3\nM2\n"),
            runs("M62 P-1\nG0 X1\nM2\n", &["SET_MOTION_OUTPUT_BIT(-1)"]),
        ],
    ),
    held(
        "#mcode:m62-m65",
        "Without a move after it, what M62, M63 and M67 queued never happens",
        "rule `output-without-move`",
        &[
            rule(
                "warning[output-without-move]",
                "G21 G90\nG0 X1\nM62 P1\nM2\n",
                "G21 G90\nM62 P1\nG0 X1\nM2\n",
            ),
            rule(
                "warning[output-without-move]",
                "G21 G90\nG0 X1\nM67 E1 Q5\nM2\n",
                "G21 G90\nM67 E1 Q5\nG0 X1\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m62-m65",
        "A later command for the same output before the move replaces the first",
        "effects of outputs",
        &[runs(
            "M62 P1\nM63 P1\nG0 X1\nM2\n",
            &["SET_MOTION_OUTPUT_BIT(1)", "CLEAR_MOTION_OUTPUT_BIT(1)", "STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    held(
        "#mcode:m66",
        "M66 waits for digital input P or reads analog input E; L is how: 0 read, 1 rise, 2 fall, 3 on, 4 off; Q the seconds to wait; #5399 the answer",
        "effect `wait-for-input`",
        &[
            runs("M66 P0 L3 Q5\nM66 E0 L0\nM66 P1 L1 Q2\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            explains("M66", "the result is in #5399"),
        ],
    ),
    held(
        "#mcode:m66",
        "P and E together are refused, and so is neither",
        "words of `M66`",
        &[
            refused("error[words-exclude-each-other]", "M66 P0 E0 L0\nM2\n", "M66 P0 L0\nM2\n"),
            refused("error[word-choice-missing]", "M66 L0\nM2\n", "M66 P0 L0\nM2\n"),
        ],
    ),
    held(
        "#mcode:m66",
        "Without L it reads at once (interpreter 2.9)",
        "words of `M66`",
        &[runs("M66 P0\nM66 E0\nM66 P0 L0 Q0\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#mcode:m66",
        "A wait without Q, or with Q0, is refused",
        "`beside` of `Q`",
        &[
            refused("error[required-word-missing]", "M66 P0 L3\nM2\n", "M66 P0 L3 Q1\nM2\n"),
            refused("error[word-unfit-for-another]", "M66 P0 L3 Q0\nM2\n", "M66 P0 L3 Q1\nM2\n"),
        ],
    ),
    held(
        "#mcode:m66",
        "An analog input can only be read",
        "`beside` of `E`",
        &[refused("error[word-unfit-for-another]", "M66 E0 L3 Q1\nM2\n", "M66 E0 L0\nM2\n")],
    ),
    held(
        "#mcode:m66",
        "L is 0 to 4; the interpreter (2.9) passes over a block with a larger one",
        "effect of `M66`, words of `M66`",
        &[
            runs("M66 P0 L5 Q1\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            refused("error[number-out-of-range]", "M66 P-1 L0\nM2\n", "M66 P1 L0\nM2\n"),
        ],
    ),
    unmodelled(
        "#mcode:m66",
        "After a time-out #5399 is -1",
        "what the input does is not in the program; #5399 is unknown after M66",
    ),
    held(
        "#mcode:m67",
        "M67 sets analog output E to Q with the next move, M68 at once",
        "effects `analog-output-with-move`, `analog-output`",
        &[runs(
            "M67 E0 Q5\nG0 X1\nM68 E1 Q2.5\nM2\n",
            &[
                "SET_MOTION_OUTPUT_VALUE(0, 5.000000)",
                "STRAIGHT_TRAVERSE(1.0000",
                "SET_AUX_OUTPUT_VALUE(1, 2.500000)",
            ],
        )],
    ),
    held(
        "#mcode:m67",
        "E is required and not negative",
        "words of `M67`",
        &[
            refused("error[required-word-missing]", "M67 Q5\nG0 X1\nM2\n", "M67 E0 Q5\nG0 X1\nM2\n"),
            refused("error[number-out-of-range]", "M68 E-1 Q2\nM2\n", "M68 E1 Q2\nM2\n"),
            refused("error[required-word-missing]", "M68 Q1\nM2\n", "M68 E1 Q1\nM2\n"),
        ],
    ),
    held(
        "#mcode:m67",
        "Q is required; without it the interpreter (2.9) sends -1",
        "words of `M67` and `M68`",
        &[
            runs(
                "M67 E0\nG0 X1\nM68 E1\nM2\n",
                &["SET_MOTION_OUTPUT_VALUE(0, -1.000000)", "SET_AUX_OUTPUT_VALUE(1, -1.000000)"],
            ),
            rule("warning[required-word-missing]", "M68 E1\nM2\n", "M68 E1 Q0\nM2\n"),
        ],
    ),
    held(
        "#tbl:mcodes-modal-groups",
        "Two of M62 to M68 in one block are refused (interpreter 2.9)",
        "rule `two-codes-of-one-group`",
        &[refused("error[two-codes-of-one-group]", "M62 P1 M64 P1\nM2\n", "M62 P1\nM64 P1\nG0 X1\nM2\n")],
    ),
    held(
        "#mcode:m100-m199",
        "M100 to M199 are programs of the machine, with P and Q as arguments; without them the code is unknown",
        "effect `user-command`, `codes.M110` of the configuration",
        &[
            stops("M110 P1 Q2\nM2\n"),
            legal("G21 G90\nM110 P1 Q2\nG0 X1\nM2\n"),
            Proof::Moves {
                program: ngc("G21 G90\nM110 P1 Q2\nG0 X1\nM2\n")
                    .with(&["codes.M110.title=\"opens the vice\""]),
                are: &["rapid X1."],
            },
        ],
    ),
    held(
        "#mcode:m100-m199",
        "M200 and above do not exist",
        "rule `unknown-code`",
        &[
            stops("M200\nM2\n"),
            rule("info[unknown-code]", "M200\nM2\n", "M100\nM2\n"),
            refused("error[unknown-code]", "M1000\nM2\n", "G0 X1\nM2\n"),
        ],
    ),
    unmodelled(
        "#mcode:m100-m199",
        "The program waits for the command, and stops when it fails",
        "what a command does is not in the program",
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
