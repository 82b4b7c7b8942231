//! Cutter compensation: `g-code.adoc`, G40 to G42.1; `tool-compensation.adoc`, cutter radius compensation; `lathe-user.adoc`,
//! tool path.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: figures of profiles, how turning without compensation departs from the drawing.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, legal, ngc, refused, rule, runs, unmodelled, with_table};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Cutter compensation",
    key: "CMP",
    file: "linuxcnc/compensation.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g41-g42",
        "G41 keeps the tool left of the path, G42 right of it, seen from the positive end of the axis across the plane",
        "effects `compensation-left`, `compensation-right`",
        &[
            runs(
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
                &[
                    "STRAIGHT_FEED(10.0000, 1.5875",
                    "STRAIGHT_FEED(20.0000, 1.5875",
                    "STRAIGHT_FEED(40.0000, 9.0000",
                ],
            ),
            runs(
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG42\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
                &["STRAIGHT_FEED(10.0000, -1.5875", "STRAIGHT_FEED(20.0000, -1.5875"],
            ),
        ],
    ),
    held(
        "#gcode:g41-g42",
        "Without D the radius is that of the tool in the spindle",
        "`radius-from-tool = true`",
        &[runs(
            "G17 G21 G90\nT2 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X60 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, 6.3500"],
        )],
    ),
    held(
        "#gcode:g41-g42",
        "Without D and without a tool the radius is 0",
        "`radius-from-tool = true`",
        &[runs(
            "G17 G21 G90\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X60 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:g41-g42",
        "D is a tool number; it need not be the tool in the spindle",
        "words of `G41`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG42 D2\nG1 X10\nX20\nG40\nG1 X60 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, -6.3500"],
        )],
    ),
    held(
        "#gcode:g41-g42",
        "D of another tool in a program of one tool cuts with the wrong radius",
        "rule `diameter-offset-of-another-tool`",
        &[rule(
            "warning[diameter-offset-of-another-tool]",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nZ5\nG1 Z-1\nG41 D2\nG1 X20\nX40\nG40\nG1 X60 Y9\nG0 Z5\nM2\n",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nZ5\nG1 Z-1\nG41 D1\nG1 X20\nX40\nG40\nG1 X60 Y9\nG0 Z5\nM2\n",
        )],
    ),
    held(
        "#gcode:g41-g42",
        "D is normally the number of the tool in the spindle",
        "rule `diameter-offset-of-another-tool`",
        &[rule(
            "warning[diameter-offset-of-another-tool]",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nZ5\nG1 Z-1\nG41 D2\nG1 X20\nX40\nG40\nG1 X60 Y9\nG0 Z5\nT2 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1\nG0 Z5\nM2\n",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nZ5\nG1 Z-1\nG41 D1\nG1 X20\nX40\nG40\nG1 X60 Y9\nG0 Z5\nM2\n",
        )],
    ),
    held(
        "#gcode:g41-g42",
        "G41 D0 takes the tool in the spindle (nonrandom changer)",
        "`zero-is-loaded`",
        &[
            runs(
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41 D0\nG1 X10\nX20\nG40\nG1 X60 Y9\nM2\n",
                &["STRAIGHT_FEED(10.0000, 1.5875"],
            ),
            legal(
                "G17 G21 G90\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nG41 D0\nG1 X10\nX20\nG40\nG1 X60 Y9\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g41-g42",
        "A tool that the table does not have is refused",
        "rule `tool-not-in-table`",
        &[Proof::Refused {
            finding: "error[tool-not-in-table]",
            violates: with_table("G17 G21 G90\nT1 M6\nG41 D77\nM2\n"),
            conforms: with_table("G17 G21 G90\nT1 M6\nG41 D1\nG40\nM2\n"),
        }],
    ),
    held(
        "#gcode:g41-g42",
        "A negative D is refused",
        "words of `G41`",
        &[refused(
            "error[number-out-of-range]",
            "G17 G21 G90\nG41 D-1\nM2\n",
            "G17 G21 G90\nG41 D1\nG40\nM2\n",
        )],
    ),
    held(
        "#gcode:g41-g42",
        "D must be whole",
        "`whole` of `D`",
        &[refused(
            "error[number-out-of-range]",
            "G17 G21 G90\nG41 D1.5\nM2\n",
            "G17 G21 G90\nG41 D1\nG40\nM2\n",
        )],
    ),
    held(
        "#gcode:g41-g42",
        "The first move must be longer than the radius",
        "rule `lead-in-too-short`",
        &[Proof::Refused {
            finding: "error[lead-in-too-short]",
            violates: with_table("G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X1\nX20\nG40\nG1 X60 Y9\nM2\n"),
            conforms: with_table(
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X40\nX50\nG40\nG1 X95 Y9\nM2\n",
            ),
        }],
    ),
    held(
        "#gcode:g41-g42",
        "The first move can be a rapid one",
        "`style = \"tangent-entry\"`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG0 X10\nG1 X20\nG40\nG1 X40 Y9\nM2\n",
            &["STRAIGHT_TRAVERSE(10.0000, 1.5875", "STRAIGHT_FEED(20.0000, 1.5875"],
        )],
    ),
    held(
        "#gcode:g41-g42",
        "Compensation works in XY and ZX; in YZ it is refused",
        "rule `refused-under-compensation`",
        &[
            runs(
                "G18 G21 G90\nT1 M6\nF100\nG0 X0 Z0\nG41\nG1 X10\nX20\nG40\nG1 X40 Z9\nM2\n",
                &["STRAIGHT_FEED(10.0000, 0.0000, -1.5875"],
            ),
            refused(
                "error[refused-under-compensation]",
                "G19 G21 G90\nT1 M6\nG41\nM2\n",
                "G17 G21 G90\nT1 M6\nG41\nG40\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g41-g42",
        "Switching on while it is on is refused, for the same side and for the other",
        "rule `refused-under-compensation`",
        &[
            refused(
                "error[refused-under-compensation]",
                "G17 G21 G90\nT1 M6\nG41\nG41\nM2\n",
                "G17 G21 G90\nT1 M6\nG41\nG40\nG41\nG40\nM2\n",
            ),
            refused(
                "error[refused-under-compensation]",
                "G17 G21 G90\nT1 M6\nG41\nG42\nM2\n",
                "G17 G21 G90\nT1 M6\nG41\nG40\nG42\nG40\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g41-g42",
        "User commands M100 to M199 are allowed under compensation",
        "codes `M100` to `M199`",
        &[legal(
            "G17 G21 G90\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nG41\nG1 X10\nM101\nX20\nG40\nG1 X40 Y9\nM2\n",
        )],
    ),
    held(
        "#gcode:g40",
        "G40 ends it; the next move goes from the compensated end straight to its programmed end",
        "effect `compensation-off`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG0 X25 Y0\nM2\n",
            &["STRAIGHT_FEED(20.0000, 1.5875", "STRAIGHT_TRAVERSE(25.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:g40",
        "G40 is fine when compensation is off",
        "effect `compensation-off`",
        &[runs("G40\nG40\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]), legal("G40\nG40\nM2\n")],
    ),
    held(
        "#gcode:g40",
        "The move after G40 may not be an arc",
        "rule `compensation-off-in-arc`",
        &[refused(
            "error[compensation-off-in-arc]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG2 X30 Y10 J10\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X30 Y0\nG2 X40 Y10 J10\nM2\n",
        )],
    ),
    held(
        "#gcode:g40",
        "The move after G40 must be longer than the tool's diameter, says the documentation; the interpreter (2.9) takes any",
        "effect `compensation-off`",
        &[runs(
            "G17 G21 G90\nT2 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X21\nM2\n",
            &["STRAIGHT_FEED(21.0000, 0.0000"],
        )],
    ),
    gap(
        "#gcode:g40",
        "A move after G40 that is shorter than the diameter lets the tool turn into the wall it just cut",
        "`check` says it (info or warning) where the tool's size is told: the documentation calls it an error",
        &[Proof::Rule {
            finding: "warning[lead-out-too-short]",
            violates: ngc(
                "G17 G21 G90\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nG41\nG1 X20\nX40\nG40\nG1 X41\nM2\n",
            )
            .with(&["tools.1.diameter=12"]),
            conforms: ngc(
                "G17 G21 G90\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nG41\nG1 X20\nX40\nG40\nG1 X60\nM2\n",
            )
            .with(&["tools.1.diameter=12"]),
        }],
    ),
    held(
        "#gcode:g41.1-g42.1",
        "G41.1 and G42.1 do the same with D the diameter itself",
        "effects `compensation-left-by-diameter`, `compensation-right-by-diameter`",
        &[
            runs(
                "G17 G21 G90\nF100\nG0 X0 Y0\nG41.1 D4\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
                &["STRAIGHT_FEED(10.0000, 2.0000"],
            ),
            runs(
                "G17 G20 G90\nF10\nG0 X0 Y0\nG42.1 D.5\nG1 X1\nX2\nG40\nG1 X4 Y1\nM2\n",
                &["STRAIGHT_FEED(1.0000, -0.2500"],
            ),
        ],
    ),
    held(
        "#gcode:g41.1-g42.1",
        "D is required",
        "words of `G41.1`",
        &[refused("error[required-word-missing]", "G17 G41.1\nM2\n", "G17 G41.1 D3\nG40\nM2\n")],
    ),
    held(
        "#gcode:g41.1-g42.1",
        "A negative diameter changes the side (interpreter 2.9)",
        "effect `compensation-left-by-diameter`",
        &[runs(
            "G17 G21 G90\nF100\nG0 X0 Y0\nG41.1 D-4\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, -2.0000"],
        )],
    ),
    held(
        "#gcode:g41.1-g42.1",
        "L is the orientation of a turning tool, 0 without it, and only for ZX",
        "words of `G41.1`, rule `refused-under-compensation`",
        &[
            runs(
                "G18 G21 G90\nF100\nG0 X0 Z0\nG41.1 D3 L2\nG1 X10\nX20\nG40\nG1 X40 Z9\nM2\n",
                &["STRAIGHT_FEED(", "STRAIGHT_FEED("],
            ),
            refused(
                "error[refused-under-compensation]",
                "G17 G21 G90\nG41.1 D3 L1\nM2\n",
                "G18 G21 G90\nG41.1 D3 L1\nG40\nM2\n",
            ),
        ],
    ),
    gap(
        "#gcode:g41.1-g42.1",
        "L is from 0 to 9; the interpreter (2.9) takes more",
        "`run` runs `L10` as the interpreter does, or the row of deliberate differences says why not; `check` keeps its warning",
        &[runs("G18 G21 G90\nT1 M6\nG41.1 D3 L10\nG40\nM2\n", &["CHANGE_TOOL(1)"])],
    ),
    held(
        "#gcode:g41.1-g42.1",
        "YZ and a second switching on are refused as with G41",
        "rule `refused-under-compensation`",
        &[
            refused("error[refused-under-compensation]", "G19 G41.1 D3\nM2\n", "G17 G41.1 D3\nG40\nM2\n"),
            refused(
                "error[refused-under-compensation]",
                "G17 G41.1 D3\nG42.1 D3\nM2\n",
                "G17 G41.1 D3\nG40\nM2\n",
            ),
        ],
    ),
    held(
        "#sec:cutter-radius-compensation",
        "The diameter comes from the tool table, also as G10 L1 has changed it",
        "`radius-from-tool = true`",
        &[runs(
            "G17 G21 G90\nT1 M6\nG10 L1 P1 R3\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
            &["STRAIGHT_FEED(10.0000, 3.0000"],
        )],
    ),
    held(
        "#sec:cutter-radius-compensation",
        "A compensated move ends by the next one: beyond its end at an outside corner, short of it at an inside corner",
        "`style = \"tangent-entry\"`",
        &[
            runs(
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nY10\nX10\nG40\nG1 X-10 Y30\nM2\n",
                &["STRAIGHT_FEED(18.4125, 1.5875", "STRAIGHT_FEED(18.4125, 8.4125"],
            ),
            runs(
                "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG42\nG1 X10\nX20\nY10\nG40\nG1 X-10 Y30\nM2\n",
                &["STRAIGHT_FEED(20.0000, -1.5875", "ARC_FEED(21.5875, 0.0000, 20.0000, 0.0000, 1"],
            ),
        ],
    ),
    held(
        "#sec:cutter-radius-compensation",
        "Of several rapid moves after G41 only the last brings the tool to the compensated place, says the documentation; with the interpreter (2.9) it is the first",
        "`style = \"tangent-entry\"`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG0 X10\nG0 X20\nG1 X30\nG40\nG1 X50 Y9\nM2\n",
            &["STRAIGHT_TRAVERSE(10.0000, 1.5875", "STRAIGHT_TRAVERSE(20.0000, 1.5875"],
        )],
    ),
    held(
        "#sec:cutter-radius-compensation",
        "Z may move while the contour is followed",
        "`[semantics.compensation]`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10 Z-1\nG0 Z5\nG1 X20 Z-2\nG40\nG1 X40 Y9\nM2\n",
            &[
                "STRAIGHT_FEED(10.0000, 1.5875, -1.0000",
                "STRAIGHT_TRAVERSE(10.0000, 1.5875, 5.0000",
                "STRAIGHT_FEED(20.0000, 1.5875, -2.0000",
            ],
        )],
    ),
    held(
        "#sec:cutter-radius-compensation",
        "Rapid moves are allowed under compensation",
        "`[semantics.compensation]`",
        &[runs(
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG0 X20\nG1 X30\nG40\nG1 X50 Y9\nM2\n",
            &["STRAIGHT_TRAVERSE(20.0000, 1.5875"],
        )],
    ),
    held(
        "#cha:important-user-concepts",
        "A path in which the tool does not fit is refused",
        "rule `compensation-gouge`",
        &[Proof::Refused {
            finding: "error[compensation-gouge]",
            violates: ngc(
                "G17 G21 G90\nF100\nG0 X0 Y0\nG41.1 D12\nG1 X20\nX40\nY2\nX20\nG40\nG1 X-20 Y30\nM2\n",
            ),
            conforms: ngc(
                "G17 G21 G90\nF100\nG0 X0 Y0\nG41.1 D12\nG1 X20\nX40\nY30\nX20\nG40\nG1 X-20 Y60\nM2\n",
            ),
        }],
    ),
    held(
        "#cha:important-user-concepts",
        "Each move is judged against the two beside it: a slot whose walls and bottom follow each other is refused when it is narrower than the cutter; a neck whose walls do not follow each other is not found",
        "`[semantics.compensation]`, rule compensation-gouge",
        &[
            refused(
                "error[compensation-gouge]",
                "G17 G21 G90\nF100\nG0 X-20 Y20\nG41.1 D12\nG1 X-20 Y0\nX40\nY-30\nX46\nY0\nX80\nG40\nG1 X120 Y60\nM2\n",
                "G17 G21 G90\nF100\nG0 X-20 Y20\nG41.1 D4\nG1 X-20 Y0\nX40\nY-30\nX46\nY0\nX80\nG40\nG1 X120 Y60\nM2\n",
            ),
            runs(
                "G17 G21 G90\nF100\nG0 X-20 Y20\nG41.1 D12\nG1 X-20 Y0\nX40\nY-30\nX20\nY-60\nX66\nY-30\nX46\nY0\nX80\nG40\nG1 X120 Y60\nM2\n",
                &["STRAIGHT_FEED(46.0000, -30.0000", "STRAIGHT_FEED(40.0000, 0.0000"],
            ),
        ],
    ),
    held(
        "#sec:cutter-radius-compensation",
        "A program starts with G40",
        "rule `safe-start-missing` (set `restart-safe`)",
        &[explains("G40", "G40")],
    ),
    held(
        "#mcode:m2-m30",
        "The end of the program switches compensation off; the last move is not finished",
        "rule `compensation-left-on`",
        &[rule(
            "info[compensation-left-on]",
            "G17 G21 G90\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nM2\n",
            "G17 G21 G90\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nG41\nG1 X10\nX20\nG40\nG1 X40 Y9\nM2\n",
        )],
    ),
    unmodelled(
        "#cha:lathe-user-information",
        "Without compensation the tip cuts beside the drawing on tapers and radii",
        "the part is not simulated",
    ),
    held(
        "#cha:lathe-user-information",
        "On a lathe the path must leave room for the tip as for a round cutter",
        "rule `compensation-gouge`",
        &[refused(
            "error[compensation-gouge]",
            "G18 G21 G90\nF100\nG0 X0 Z0\nG41.1 D12\nG1 X20\nX40\nZ-2\nX20\nG40\nG1 X-20 Z-30\nM2\n",
            "G18 G21 G90\nF100\nG0 X0 Z0\nG41.1 D12\nG1 X20\nX40\nZ-30\nX20\nG40\nG1 X-20 Z-60\nM2\n",
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
