//! How the manual writes its codes, straight moves and the dwell: `g-code.adoc`, conventions, G0, G1, G4.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: the table of codes (each code has its own rows), the figures on the velocity of rapid moves.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{held, legal, ngc, refused, rule, runs, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Conventions, straight moves, dwell",
    key: "MOV",
    file: "linuxcnc/moves.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#cha:g-codes",
        "A value after a letter may be a number, an expression, a parameter or a function, also for G and L",
        "lowering of words (`gcheck-program`), effect `write-offsets`",
        &[
            runs(
                "#100=2\nG[5*2] L[1+1] P1 X3\nG10 L#100 P2 X4\nG0 X1\nG55 X1\nM2\n",
                &["SET_G5X_OFFSET(1, 3.0000", "STRAIGHT_TRAVERSE(1.0000", "SET_G5X_OFFSET(2, 4.0000"],
            ),
            runs("G0 XACOS[0] Y#5 Z[1+2]\nM2\n", &["STRAIGHT_TRAVERSE(90.0000, 0.0000, 3.0000"]),
        ],
    ),
    held(
        "#cha:g-codes",
        "Axis words name the point the move goes to, in the active coordinate system",
        "effects `rapid`, `work-offset`",
        &[runs(
            "G10 L2 P1 X10 Y20\nG0 X1 Y2 Z3\nG55 G0 X1 Y2\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000, 2.0000, 3.0000",
                "SET_G5X_OFFSET(2, 0.0000",
                "STRAIGHT_TRAVERSE(1.0000, 2.0000, 3.0000",
            ],
        )],
    ),
    held(
        "#cha:g-codes",
        "An axis that is left out keeps its place",
        "effect `rapid`",
        &[runs(
            "G0 X1 Y2 Z3\nY5\nZ7\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 5.0000, 3.0000", "STRAIGHT_TRAVERSE(1.0000, 5.0000, 7.0000"],
        )],
    ),
    held(
        "#cha:g-codes",
        "What a prototype does not mark as optional is required",
        "`need = \"required\"` of words, rule `required-word-missing`",
        &[
            refused("error[required-word-missing]", "G4\nM2\n", "G4 P1\nM2\n"),
            refused("error[required-word-missing]", "G10 P1 X1\nM2\n", "G10 L2 P1 X1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g0",
        "G0 moves all axes together at rapid rate",
        "effect `rapid`",
        &[
            runs("G0 X1 Y-2.3\nM2\n", &["STRAIGHT_TRAVERSE(1.0000, -2.3000, 0.0000"]),
            Proof::Moves { program: ngc("G21 G90 G0 X1 Y-2.3\nM2\n"), are: &["rapid X1. Y-2.3"] },
        ],
    ),
    held(
        "#gcode:g0",
        "G0 without axis words is a mode only; the mode lasts, so later blocks need no G0",
        "group `motion`",
        &[
            runs(
                "G0\nX1\nY2\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 0.0000", "STRAIGHT_TRAVERSE(1.0000, 2.0000"],
            ),
            legal("G21 G90 G0\nX1\nY2\nM2\n"),
        ],
    ),
    held(
        "#gcode:g0",
        "Cutter compensation changes where a rapid move ends",
        "`[semantics.compensation]`",
        &[runs(
            "G17 G21 G90\nT2 M6\nF100\nG0 X0 Y0\nG41\nG0 X20 Y0\nG1 Y20\nX40\nG40\nG0 X60 Y60\nM2\n",
            &["STRAIGHT_TRAVERSE(13.6500, 6.3500", "STRAIGHT_FEED(13.6500, 20.0000"],
        )],
    ),
    held(
        "#gcode:g0",
        "G53 in the block makes the axis words machine coordinates",
        "effect `machine-coordinates`",
        &[runs("G10 L2 P1 X10\nG53 G0 X0\nM2\n", &["STRAIGHT_TRAVERSE(-10.0000"])],
    ),
    unmodelled(
        "#gcode:g0",
        "The largest rapid rate is that of the trajectory section, less where an axis limits it",
        "rates are machine configuration; `stats` takes `[machine] rapid` and `rotary_rapid`, shown under `MCH`",
    ),
    unmodelled(
        "#gcode:g0",
        "A rapid path can be rounded where its direction changes, by path control and acceleration",
        "blending is not simulated: `docs/executing.md` says that corners are sharp",
    ),
    held(
        "#gcode:g0",
        "An axis letter without a number is refused",
        "rule `address-without-value`",
        &[refused("error[address-without-value]", "G0 X\nM2\n", "G0 X1\nM2\n")],
    ),
    held(
        "#gcode:g0",
        "An axis letter that is not configured is refused",
        "rule `axis-not-on-machine`",
        &[Proof::Rule {
            finding: "error[axis-not-on-machine]",
            violates: ngc("G21 G90 G0 X1 A90\nM2\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\"]"]),
            conforms: ngc("G21 G90 G0 X1 A90\nM2\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
        }],
    ),
    held(
        "#gcode:g1",
        "G1 moves in a straight line at the feed rate, all axes together",
        "effect `linear`",
        &[
            runs(
                "F10\nG1 X1.2 Y-3\nZ-2.3\nZ1 F25\nM2\n",
                &[
                    "SET_FEED_RATE(10.0000",
                    "STRAIGHT_FEED(1.2000, -3.0000, 0.0000",
                    "STRAIGHT_FEED(1.2000, -3.0000, -2.3000",
                    "SET_FEED_RATE(25.0000",
                    "STRAIGHT_FEED(1.2000, -3.0000, 1.0000",
                ],
            ),
            Proof::Moves {
                program: ngc("G21 G90\nG1 X30 F10\nZ1 F25\nM2\n"),
                are: &["feed X30. F10.", "feed Z1. F25."],
            },
        ],
    ),
    held(
        "#gcode:g1",
        "The axis words of G1 are optional",
        "group `motion`",
        &[runs("F5 G1\nX1\nM2\n", &["STRAIGHT_FEED(1.0000"])],
    ),
    held(
        "#gcode:g1",
        "G1 without a feed rate is refused",
        "rules `feed-missing`, `feed-zero`",
        &[
            refused("error[feed-missing]", "G1 X1\nM2\n", "G1 X1 F10\nM2\n"),
            refused("error[feed-zero]", "F0\nG1 X1\nM2\n", "F10\nG1 X1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g1",
        "An axis letter without a number is refused",
        "rule `address-without-value`",
        &[refused("error[address-without-value]", "G1 F10 X1 Y\nM2\n", "G1 F10 X1 Y1\nM2\n")],
    ),
    held(
        "#gcode:g4",
        "G4 keeps all axes still for P seconds; fractions count",
        "effect `dwell`, `dwell = { P = \"seconds\" }`",
        &[
            runs("G4 P0.5\nM2\n", &["DWELL(0.5000"]),
            Proof::Stats { program: ngc("G21 G90 G0 X0\nG4 P2.5\nM2\n"), prints: &["dwell", "0:02.5"] },
        ],
    ),
    held(
        "#gcode:g4",
        "A dwell changes neither spindle nor coolant nor outputs",
        "effect `dwell`",
        &[runs(
            "S100 M3\nM8\nG4 P1\nF10 G1 X1\nM2\n",
            &["START_SPINDLE_CLOCKWISE", "FLOOD_ON", "DWELL(1.0000", "STRAIGHT_FEED(1.0000"],
        )],
    ),
    held(
        "#gcode:g4",
        "G4 without P, or with a negative one, is refused",
        "words of `G4`",
        &[
            refused("error[required-word-missing]", "G4\nM2\n", "G4 P0\nM2\n"),
            refused("error[number-out-of-range]", "G4 P-1\nM2\n", "G4 P1\nM2\n"),
        ],
    ),
    held(
        "#gcode:g4",
        "Axis words beside G4 belong to the motion mode, or to nothing",
        "rules `dwell-time-in-other-word`, `axis-words-without-motion-mode`",
        &[
            refused("error[dwell-time-in-other-word]", "G4 X1\nM2\n", "G4 P1\nM2\n"),
            runs("G0\nG4 P1 X5\nM2\n", &["DWELL(1.0000", "STRAIGHT_TRAVERSE(5.0000"]),
            rule("warning[axis-words-without-motion-mode]", "G4 P0.5 X1\nM2\n", "G0\nG4 P0.5 X1\nM2\n"),
        ],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
