//! Canned cycles: `g-code.adoc`, G73, G74, G80 to G89, G98, G99.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: why cycles are used, figures.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Canned cycles", key: "CYC", file: "linuxcnc/canned_cycles.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g80-g89",
        "A cycle works across the plane that is on: along Z in XY, along Y in ZX, along X in YZ",
        "`all-planes = true` of `[semantics.cycles]`",
        &[
            runs(
                "F100\nG18 G81 X1 Z1 Y-5 R1\nG80\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 1.0000, 1.0000", "STRAIGHT_FEED(1.0000, -5.0000, 1.0000"],
            ),
            runs(
                "F100\nG19 G81 Y1 Z1 X-5 R1\nG80\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 1.0000, 1.0000", "STRAIGHT_FEED(-5.0000, 1.0000, 1.0000"],
            ),
        ],
    ),
    unmodelled(
        "#gcode:g80-g89",
        "In G17.1, G18.1 and G19.1 a cycle works along W, V or U",
        "the interpreter alone (2.9) has no U V W to compare with; `run` refuses these axes there, as it does",
    ),
    held(
        "#gcode:g80-g89",
        "Rotary axis words are refused in a cycle",
        "rule `cycle-with-rotary-word`",
        &[refused(
            "error[cycle-with-rotary-word]",
            "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-2 R1 A90\nG80\nM2\n",
            "G17 G21 G90\nF100\nG0 Z5 A90\nG81 X1 Z-2 R1\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:g80-g89",
        "U V W are refused in a cycle of an XYZ plane",
        "words of `G81`",
        &[stops("F100\nG17 G81 X1 U1 Z-2 R1\nG80\nM2\n")],
    ),
    held(
        "#gcode:g80-g89",
        "Sticky words: R, and the depth and Q P of a cycle, last while the same cycle goes on",
        "words of `G81` and others (`need = \"modal\"`)",
        &[
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-2 R1\nX2\nX3 Z-3\nX4 R2\nX5\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -2.0000",
                    "STRAIGHT_FEED(2.0000, 0.0000, -2.0000",
                    "STRAIGHT_FEED(3.0000, 0.0000, -3.0000",
                    "STRAIGHT_TRAVERSE(4.0000, 0.0000, 2.0000",
                    "STRAIGHT_FEED(4.0000, 0.0000, -3.0000",
                    "STRAIGHT_FEED(5.0000, 0.0000, -3.0000",
                ],
            ),
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG82 X1 Z-2 R1 P1\nX2\nX3 P2\nG80\nM2\n",
                &["DWELL(1.0000", "DWELL(1.0000", "DWELL(2.0000"],
            ),
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q3\nX2\nX3 Q6\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -2.0000",
                    "STRAIGHT_FEED(2.0000, 0.0000, -2.0000",
                    "STRAIGHT_FEED(3.0000, 0.0000, -5.0000",
                ],
            ),
        ],
    ),
    held(
        "#gcode:g80-g89",
        "Another cycle needs its words anew",
        "rule `cycle-words-lost`, `[semantics.cycles]`",
        &[
            stops("G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG82 X2 P1\nG80\nM2\n"),
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG82 X2 Z-1 R2 P1\nG80\nM2\n",
                &["STRAIGHT_FEED(2.0000, 0.0000, -1.0000", "DWELL(1.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g80-g89",
        "A new cycle without R or Z is refused, though the cycle before had them (interpreter 2.9)",
        "rule `cycle-words-lost`",
        &[
            refused(
                "error[cycle-words-lost]",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG82 X2 P1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG82 X2 Z-1 R2 P1\nG80\nM2\n",
            ),
            refused(
                "error[cycle-words-lost]",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG82 X2 Z-1 P1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG82 X2 Z-1 R2 P1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g80-g89",
        "Under G91 X, Y and R count from the present position and Z from R",
        "`incremental-r = true`",
        &[runs(
            "F100\nG0 X1 Y2 Z3\nG91 G98 G81 X4 Y5 Z-0.6 R1.8\nG80\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000, 2.0000, 4.8000",
                "STRAIGHT_TRAVERSE(5.0000, 7.0000, 4.8000",
                "STRAIGHT_FEED(5.0000, 7.0000, 4.2000",
                "STRAIGHT_TRAVERSE(5.0000, 7.0000, 4.8000",
            ],
        )],
    ),
    held(
        "#gcode:g80-g89",
        "Under G90 X, Y, Z and R are positions",
        "`[semantics.cycles]`",
        &[
            runs(
                "F100\nG0 X1 Y2 Z3\nG90 G98 G81 X4 Y5 Z1.5 R2.8\nG80\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 3.0000",
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 2.8000",
                    "STRAIGHT_FEED(4.0000, 5.0000, 1.5000",
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 3.0000",
                ],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nF100\nG0 X1 Y2 Z3\nG98 G81 X4 Y5 Z1.5 R2.8\nG80\nM2\n"),
                are: &["rapid X1. Y2. Z3.", "rapid X4. Y5. Z3.", "rapid Z2.8", "feed Z1.5", "rapid Z3."],
            },
        ],
    ),
    held(
        "#gcode:g80-g89",
        "L repeats the cycle; under G91 each repeat starts X and Y further, and R and Z stay",
        "`repeat = \"L\"`",
        &[runs(
            "F100\nG0 X1 Y2 Z3\nG91 G98 G81 X4 Y5 Z-0.6 R1.8 L3\nG80\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000, 2.0000, 4.8000",
                "STRAIGHT_TRAVERSE(5.0000, 7.0000, 4.8000",
                "STRAIGHT_FEED(5.0000, 7.0000, 4.2000",
                "STRAIGHT_TRAVERSE(9.0000, 12.0000, 4.8000",
                "STRAIGHT_FEED(9.0000, 12.0000, 4.2000",
                "STRAIGHT_TRAVERSE(13.0000, 17.0000, 4.8000",
                "STRAIGHT_FEED(13.0000, 17.0000, 4.2000",
            ],
        )],
    ),
    held(
        "#gcode:g80-g89",
        "Under G90 L drills the same hole again",
        "rule `cycle-repeated-in-place`",
        &[
            runs(
                "F100\nG0 X0 Y0 Z5\nG81 X4 Y5 Z-1 R2 L2\nG80\nM2\n",
                &["STRAIGHT_FEED(4.0000, 5.0000, -1.0000", "STRAIGHT_FEED(4.0000, 5.0000, -1.0000"],
            ),
            rule(
                "warning[cycle-repeated-in-place]",
                "G17 G21 G90\nF100\nG0 X0 Y0 Z5\nG81 X4 Y5 Z-1 R2 L2\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 X0 Y0 Z5\nG91 G81 X4 Y5 Z-3 R-3 L2\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g80-g89",
        "L is for its block only",
        "words of `G81`",
        &[
            runs(
                "F100\nG0 Z5\nG91 G81 X1 Z-1 R-1 L2\nX1\nG80\nM2\n",
                &["STRAIGHT_FEED(1.0000", "STRAIGHT_FEED(2.0000", "STRAIGHT_FEED(3.0000"],
            ),
            legal("G17 G21 G90\nF100\nG0 Z5\nG91 G81 X1 Z-1 R-1 L2\nX1\nG80\nG90\nM2\n"),
        ],
    ),
    held(
        "#gcode:g80-g89",
        "Under G91 an R in a later block of the series counts from the height at which the series began (interpreter 2.9)",
        "`incremental-r = true`",
        &[runs(
            "F50\nG0 X0 Y0 Z0\nG91 G81 X1 Y0 Z-0.5 R1 L2\nX0 Y1 R0 L2\nG80\nM2\n",
            &[
                "STRAIGHT_FEED(1.0000, 0.0000, 0.5000",
                "STRAIGHT_FEED(2.0000, 0.0000, 0.5000",
                "STRAIGHT_TRAVERSE(2.0000, 1.0000, 0.0000",
                "STRAIGHT_FEED(2.0000, 1.0000, -0.5000",
                "STRAIGHT_FEED(2.0000, 2.0000, -0.5000",
            ],
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "L0 and a negative L are refused",
        "words of `G81`",
        &[
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-5 R2 L0\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-5 R2 L1\nG80\nM2\n",
            ),
            refused(
                "error[sign-not-accepted]",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-5 R2 L-1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-5 R2 L1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "L must be whole",
        "`whole` of `L`",
        &[refused(
            "error[number-out-of-range]",
            "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-5 R2 L1.5\nG80\nM2\n",
            "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-5 R2 L1\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "A cycle block without any axis word is refused",
        "words of `G81`",
        &[refused(
            "error[word-choice-missing]",
            "G17 G21 G90\nF100\nG0 Z5\nG81 R1\nG80\nM2\n",
            "G17 G21 G90\nF100\nG0 Z5\nG81 Z-1 R1\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "X and Y may be missing: the hole is where the tool is",
        "words of `G81`",
        &[runs(
            "F100\nG0 X3 Y4 Z5\nG81 Z-5 R2\nG80\nM2\n",
            &["STRAIGHT_TRAVERSE(3.0000, 4.0000, 2.0000", "STRAIGHT_FEED(3.0000, 4.0000, -5.0000"],
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "A negative P where P is needed is refused",
        "words of `G82`",
        &[refused(
            "error[number-out-of-range]",
            "G17 G21 G90\nF100\nG0 Z5\nG82 X1 Z-2 R1 P-1\nG80\nM2\n",
            "G17 G21 G90\nF100\nG0 Z5\nG82 X1 Z-2 R1 P1\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "A cycle under inverse-time feed is refused",
        "rule `cycle-in-inverse-time`",
        &[refused(
            "error[cycle-in-inverse-time]",
            "G17 G21 G90\nG93\nG0 Z5\nG81 X1 Z-2 R1 F10\nG80\nM2\n",
            "G17 G21 G90\nG94\nG0 Z5\nG81 X1 Z-2 R1 F10\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "A cycle under cutter compensation is refused",
        "rule `cycle-under-compensation`",
        &[refused(
            "error[cycle-under-compensation]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG81 X11 Z-2 R1\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG81 X31 Z-2 R1\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "The first block of a cycle needs the depth",
        "rule `cycle-word-missing`",
        &[
            refused(
                "error[cycle-word-missing]",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 R2\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-1 R2\nG80\nM2\n",
            ),
            stops("G18\nF100\nG81 X1 Z-5 R2\nM2\n"),
        ],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "In ZX the depth is Y: a Z alone is refused",
        "rule `cycle-word-missing`",
        &[refused(
            "error[cycle-word-missing]",
            "G18 G21 G90\nF100\nG81 X1 Z-5 R2\nG80\nM2\n",
            "G18 G21 G90\nF100\nG81 X1 Y-5 R2\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:g73",
        "R is needed in the first block",
        "rule `lasting-word-never-given`",
        &[
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-2\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-2 R1\nG80\nM2\n",
            ),
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-2 Q1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-2 Q1 R1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:canned-cycle-errors",
        "An R below the depth is refused; equal is taken",
        "rule `cycle-r-below-bottom`",
        &[refused(
            "error[cycle-r-below-bottom]",
            "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z3 R2\nG80\nM2\n",
            "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z2 R2\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:preliminary-motion",
        "Below R the tool first rises to R, once, whatever L says",
        "`rise-to-r = true`",
        &[
            runs(
                "F100\nG0 X0 Y0 Z0\nG90 G98 G81 X4 Y5 Z1.5 R2.8\nG80\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 2.8000",
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 2.8000",
                    "STRAIGHT_FEED(4.0000, 5.0000, 1.5000",
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 2.8000",
                ],
            ),
            runs(
                "F100\nG0 X0 Y0 Z0\nG91 G98 G81 X4 Y5 Z-0.6 R1.8 L2\nG80\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.8000",
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 1.8000",
                    "STRAIGHT_FEED(4.0000, 5.0000, 1.2000",
                    "STRAIGHT_TRAVERSE(8.0000, 10.0000, 1.8000",
                ],
            ),
        ],
    ),
    held(
        "#gcode:preliminary-motion",
        "Each hole begins with a rapid move over it, then one to R",
        "`[semantics.cycles]`",
        &[Proof::Moves {
            program: ngc("G17 G21 G90\nF100\nG0 X0 Y0 Z5\nG99 G81 X1 Y1 Z-1 R1\nX2\nG80\nM2\n"),
            are: &[
                "rapid Z5.",
                "rapid X1. Y1. Z5.",
                "rapid Z1.",
                "feed Z-1.",
                "rapid Z1.",
                "rapid X2. Z1.",
                "feed Z-1.",
                "rapid Z1.",
            ],
        }],
    ),
    held(
        "#gcode:g80",
        "G80 ends the cycle; so does every other code of its group",
        "effect `cycle-cancel`, `motion-ends-cycle = true`",
        &[
            runs(
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nG80\nG0 X5\nM2\n",
                &["STRAIGHT_FEED(1.0000, 0.0000, -1.0000", "STRAIGHT_TRAVERSE(5.0000"],
            ),
            runs(
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nG0 X5\nM2\n",
                &["STRAIGHT_FEED(1.0000, 0.0000, -1.0000", "STRAIGHT_TRAVERSE(5.0000"],
            ),
        ],
    ),
    held(
        "#gcode:g80",
        "Axis words while G80 is on are refused",
        "rule `axis-words-without-motion-mode`",
        &[
            refused(
                "error[axis-words-without-motion-mode]",
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nG80 X5\nM2\n",
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nG80\nM2\n",
            ),
            refused(
                "error[axis-words-without-motion-mode]",
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nG80\nX5\nM2\n",
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nG80\nG0 X5\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g80",
        "A cycle that is not ended drills at every later X or Y",
        "rule `cycle-left-on`",
        &[
            runs(
                "F100\nG0 Z5\nG81 X1 Z-1 R1\nX2\nY2\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -1.0000",
                    "STRAIGHT_FEED(2.0000, 0.0000, -1.0000",
                    "STRAIGHT_FEED(2.0000, 2.0000, -1.0000",
                ],
            ),
            rule(
                "warning[cycle-left-on]",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nZ5\nG81 X1 Z-1 R1\nT2 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1\nG0 Z5\nM2\n",
                "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nF100\nG0 X0 Y0\nZ5\nG81 X1 Z-1 R1\nG80\nT2 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nG1 Z-1\nG0 Z5\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g80",
        "G80 and a motion code of its group in one block: the other counts (interpreter 2.9)",
        "effect `cycle-cancel`",
        &[
            runs("G80 G0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            runs("G80 G81 X1 Z-1 R1 F10\nM2\n", &["STRAIGHT_FEED(1.0000, 0.0000, -1.0000"]),
        ],
    ),
    held(
        "#gcode:g81",
        "G81 feeds to the depth and comes back at rapid rate",
        "effect `cycle-drill`",
        &[runs(
            "F100\nG0 Z5\nG99 G81 X1 Z-5 R2\nG80\nM2\n",
            &["STRAIGHT_FEED(1.0000, 0.0000, -5.0000", "STRAIGHT_TRAVERSE(1.0000, 0.0000, 2.0000"],
        )],
    ),
    held(
        "#gcode:g82",
        "G82 waits P seconds at the bottom",
        "effect `cycle-drill-dwell`",
        &[
            runs(
                "F100\nG0 Z3\nG90 G82 G98 X4 Y5 Z1.5 R2.8 P2\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(4.0000, 5.0000, 1.5000",
                    "DWELL(2.0000",
                    "STRAIGHT_TRAVERSE(4.0000, 5.0000, 3.0000",
                ],
            ),
            Proof::Stats {
                program: ngc("G17 G21 G90\nF100\nG0 Z3\nG82 X4 Z1.5 R2.8 P20\nG80\nM2\n"),
                prints: &["dwell 0:20.0"],
            },
        ],
    ),
    held(
        "#gcode:g82",
        "The first block of G82, G86, G88 and G89 needs P (interpreter 2.9)",
        "rule `lasting-word-never-given`",
        &[
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nG0 Z5\nG82 X1 Z-2 R1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG82 X1 Z-2 R1 P1\nG80\nM2\n",
            ),
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nS100 M3\nG0 Z5\nG86 X1 Z-2 R1\nG80\nM2\n",
                "G17 G21 G90\nF100\nS100 M3\nG0 Z5\nG86 X1 Z-2 R1 P1\nG80\nM2\n",
            ),
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nG0 Z5\nG89 X1 Z-2 R1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG89 X1 Z-2 R1 P1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g83",
        "G83 drills in pecks of Q, each time back to R at rapid rate, and in again to just above the last depth: 0.254 mm or 0.010 inch, where neither D nor `G83_PECK_CLEARANCE` (newer versions) gives another distance",
        "effect `cycle-peck`, `peck-clearance = 0.254`",
        &[
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG98 G83 X1 Z-5 R1 Q2\nG80\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000",
                    "STRAIGHT_FEED(1.0000, 0.0000, -1.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, -0.7460",
                    "STRAIGHT_FEED(1.0000, 0.0000, -3.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, -2.7460",
                    "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 5.0000",
                ],
            ),
            runs(
                "G17 G20 G90\nF10\nG0 Z1\nG99 G83 X1 Z-.2 R.1 Q.2\nG80\nM2\n",
                &["STRAIGHT_FEED(1.0000, 0.0000, -0.1000", "STRAIGHT_TRAVERSE(1.0000, 0.0000, -0.0900"],
            ),
        ],
    ),
    held(
        "#gcode:g83",
        "Between pecks G83 goes to R also under G98; the last way back heeds G98 and G99",
        "effect `cycle-peck`",
        &[Proof::Moves {
            program: ngc("G17 G21 G90\nF100\nG0 X0 Z5\nG99 G83 X1 Z-3 R1 Q2\nG80\nM2\n"),
            are: &[
                "rapid Z5.",
                "rapid X1. Z5.",
                "rapid Z1.",
                "feed Z-1.",
                "rapid Z1.",
                "rapid Z-0.746",
                "feed Z-3.",
                "rapid Z1.",
            ],
        }],
    ),
    held(
        "#gcode:g83",
        "The last peck of G83 is at Z, never deeper",
        "effect `cycle-peck`",
        &[
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-0.9 R0 Q0.3\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -0.3000",
                    "STRAIGHT_FEED(1.0000, 0.0000, -0.6000",
                    "STRAIGHT_FEED(1.0000, 0.0000, -0.9000",
                ],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nF100\nG0 X0 Z5\nG99 G83 Z-0.3 R0 Q0.1\nG80\nM2\n"),
                are: &[
                    "rapid Z5.",
                    "rapid Z5.",
                    "rapid Z0.",
                    "feed Z-0.1",
                    "rapid Z0.",
                    "rapid Z0.154",
                    "feed Z-0.2",
                    "rapid Z0.",
                    "rapid Z0.054",
                    "feed Z-0.3",
                    "rapid Z0.",
                ],
            },
        ],
    ),
    held(
        "#gcode:g83",
        "A Q above the depth drills in one go",
        "effect `cycle-peck`",
        &[runs(
            "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q10\nG80\nM2\n",
            &["STRAIGHT_FEED(1.0000, 0.0000, -5.0000"],
        )],
    ),
    held(
        "#gcode:g83",
        "Q of zero or less is refused",
        "words of `G83`",
        &[
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q0\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q1\nG80\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q-1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g83",
        "The first block of G83 and G73 needs Q (interpreter 2.9)",
        "rule `lasting-word-never-given`",
        &[
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q2\nG80\nM2\n",
            ),
            refused(
                "error[lasting-word-never-given]",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1 Q2\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g83",
        "D of G83 and G73 is the clearance (newer versions); the interpreter of 2.9 refuses it",
        "`newer-words`",
        &[
            stops("G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q2 D0.5\nG80\nM2\n"),
            stops("G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1 Q2 D0.5\nG80\nM2\n"),
            legal("G17 G21 G90\nF100\nG0 Z5\nG83 X1 Z-5 R1 Q2 D0.5\nG80\nM2\n"),
        ],
    ),
    gap(
        "#gcode:g83",
        "D of G83 says how far above the last depth the rapid move back stops",
        "`run` on a newer version (a setting that says so): `D` takes the place of the clearance; today no run knows it",
        &[Proof::Moves {
            program: ngc("G17 G21 G90\nF100\nG0 X0 Z5\nG99 G83 Z-3 R1 Q2 D0.5\nG80\nM2\n"),
            are: &[
                "rapid Z5.",
                "rapid Z5.",
                "rapid Z1.",
                "feed Z-1.",
                "rapid Z1.",
                "rapid Z-0.5",
                "feed Z-3.",
                "rapid Z1.",
            ],
        }],
    ),
    held(
        "#gcode:g73",
        "G73 breaks chips: after each Q it backs off by 0.254 mm or 0.010 inch",
        "effect `cycle-chip-break`, `chip-break-retract = 0.254`",
        &[runs(
            "G17 G21 G90\nF100\nG0 Z10\nG99 G73 X1 Y1 Z-5 R2 Q3\nG80\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000, 1.0000, 2.0000",
                "STRAIGHT_FEED(1.0000, 1.0000, -1.0000",
                "STRAIGHT_TRAVERSE(1.0000, 1.0000, -0.7460",
                "STRAIGHT_FEED(1.0000, 1.0000, -4.0000",
                "STRAIGHT_TRAVERSE(1.0000, 1.0000, -3.7460",
                "STRAIGHT_FEED(1.0000, 1.0000, -5.0000",
                "STRAIGHT_TRAVERSE(1.0000, 1.0000, 2.0000",
            ],
        )],
    ),
    held(
        "#gcode:g73",
        "The last peck of G73 is at Z, never deeper; where Q goes into the depth evenly, rounding can make the interpreter (2.9) stroke there twice, and `run` shows it",
        "effect `cycle-chip-break`",
        &[
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG99 G73 X1 Z-0.3 R0 Q0.1\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -0.1000",
                    "STRAIGHT_FEED(1.0000, 0.0000, -0.2000",
                    "STRAIGHT_FEED(1.0000, 0.0000, -0.3000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 0.0000",
                ],
            ),
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nG99 G73 X0 Z-0.9 R0 Q0.3\nG80\nM2\n",
                &["STRAIGHT_FEED(0.0000, 0.0000, -0.9000", "STRAIGHT_FEED(0.0000, 0.0000, -0.9000"],
            ),
            Proof::Moves {
                program: ngc("G17 G21 G90\nF100\nG0 X0 Z5\nG99 G73 Z-0.9 R0 Q0.3\nG80\nM2\n"),
                are: &[
                    "rapid Z5.",
                    "rapid Z5.",
                    "rapid Z0.",
                    "feed Z-0.3",
                    "rapid Z-0.046",
                    "feed Z-0.6",
                    "rapid Z-0.346",
                    "feed Z-0.9",
                    "rapid Z-0.646",
                    "feed Z-0.9",
                    "rapid Z0.",
                ],
            },
        ],
    ),
    held(
        "#gcode:g73",
        "G73 comes back by G98 and G99 as other cycles do; the manual speaks of R alone",
        "effect `cycle-chip-break`",
        &[runs(
            "G17 G21 G90\nF100\nG0 Z10\nG98 G73 X1 Z-5 R2 Q10\nG80\nM2\n",
            &["STRAIGHT_FEED(1.0000, 0.0000, -5.0000", "STRAIGHT_TRAVERSE(1.0000, 0.0000, 10.0000"],
        )],
    ),
    held(
        "#gcode:g73",
        "Q of zero or less is refused",
        "words of `G73`",
        &[
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1 Q0\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1 Q1\nG80\nM2\n",
            ),
            refused(
                "error[number-out-of-range]",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1 Q-1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nG73 X1 Z-5 R1 Q1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g84",
        "G84 taps right-hand with a floating chuck: overrides off, feed down, spindle stopped and turned counter-clockwise, dwell P, feed up, spindle as before, overrides back",
        "effect `cycle-tap`",
        &[runs(
            "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG99 G84 X1 Z-5 R2 P1\nG80\nM2\n",
            &[
                "DISABLE_FEED_OVERRIDE",
                "DISABLE_SPEED_OVERRIDE",
                "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                "STOP_SPINDLE_TURNING",
                "START_SPINDLE_COUNTERCLOCKWISE",
                "DWELL(1.0000",
                "STRAIGHT_FEED(1.0000, 0.0000, 2.0000",
                "STOP_SPINDLE_TURNING",
                "START_SPINDLE_CLOCKWISE",
                "ENABLE_FEED_OVERRIDE",
                "ENABLE_SPEED_OVERRIDE",
            ],
        )],
    ),
    held(
        "#gcode:g84",
        "Overrides that were off stay off after it",
        "effect `cycle-tap`",
        &[runs(
            "G17 G21 G90\nM49\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2 P1\nG80\nM2\n",
            &["STRAIGHT_FEED(1.0000, 0.0000, -5.0000", "START_SPINDLE_CLOCKWISE", "SET_MOTION_CONTROL_MODE"],
        )],
    ),
    held(
        "#gcode:g84",
        "P is not needed for tapping: without it the dwell is 0 (interpreter 2.9)",
        "words of `G84`",
        &[
            runs("G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n", &["DWELL(0.0000"]),
            runs("G17 G21 G90\nS100 M4\nG0 Z10\nF125\nG74 X1 Z-5 R2 P-1\nG80\nM2\n", &["DWELL(0.0000"]),
        ],
    ),
    held(
        "#gcode:g74",
        "G74 taps left-hand: the same with the directions exchanged",
        "effect `cycle-left-tap`",
        &[runs(
            "G17 G21 G90\nS100 M4\nG0 Z10\nF125\nG99 G74 X1 Z-5 R2 P1\nG80\nM2\n",
            &[
                "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                "STOP_SPINDLE_TURNING",
                "START_SPINDLE_CLOCKWISE",
                "DWELL(1.0000",
                "STRAIGHT_FEED(1.0000, 0.0000, 2.0000",
                "START_SPINDLE_COUNTERCLOCKWISE",
            ],
        )],
    ),
    held(
        "#gcode:g84",
        "A spindle that turns the wrong way is refused (interpreter 2.9)",
        "rule `tap-in-wrong-direction`",
        &[
            refused(
                "error[tap-in-wrong-direction]",
                "G17 G21 G90\nS100 M4\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
                "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
            ),
            refused(
                "error[tap-in-wrong-direction]",
                "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG74 X1 Z-5 R2\nG80\nM2\n",
                "G17 G21 G90\nS100 M4\nG0 Z10\nF125\nG74 X1 Z-5 R2\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g84",
        "A spindle that stands is refused (interpreter 2.9)",
        "rule `spindle-stopped-while-cutting`",
        &[
            refused(
                "error[spindle-stopped-while-cutting]",
                "G17 G21 G90\nS100 M3\nM5\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
                "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
            ),
            rule(
                "warning[spindle-stopped-while-cutting]",
                "G17 G21 G90\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
                "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
            ),
            rule(
                "warning[spindle-stopped-while-cutting]",
                "G17 G21 G90\nG0 Z10\nF125\nG86 X1 Z-5 R2 P1\nG80\nM2\n",
                "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG86 X1 Z-5 R2 P1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g84",
        "The feed must be speed times pitch, as nothing is synchronized",
        "rule `tapping-feed-off-pitch`",
        &[
            rule(
                "warning[tapping-feed-off-pitch]",
                "(T1 M8X1.25 TAP)\nG17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ10\nF100\nG84 X1 Z-5 R2\nG80\nM2\n",
                "(T1 M8X1.25 TAP)\nG17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
            ),
            explains("G84", "floating"),
        ],
    ),
    held(
        "#gcode:g74",
        "L repeats the tapping, $ names the spindle (newer versions); the interpreter of 2.9 refuses both for G74",
        "`newer-words`",
        &[
            stops("G17 G21 G90\nS100 M4\nG0 Z10\nF125\nG91 G74 X1 Z-5 R-2 L2\nG80\nM2\n"),
            stops("G17 G21 G90\nS100 M4\nG0 Z10\nF125\nG74 X1 Z-5 R2 $0\nG80\nM2\n"),
        ],
    ),
    held(
        "#gcode:g84",
        "$ of G84 and G86 names the spindle (newer versions); the interpreter of 2.9 refuses it",
        "`newer-words`",
        &[
            stops("G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2 $0\nG80\nM2\n"),
            stops("G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG86 X1 Z-5 R2 P1 $0\nG80\nM2\n"),
        ],
    ),
    held(
        "#gcode:g85",
        "G85 bores and comes back to R at feed rate, on to the clear height at rapid rate",
        "effect `cycle-bore-feed-out`",
        &[runs(
            "G17 G21 G90\nF100\nG0 Z5\nG98 G85 X1 Z-5 R1\nG80\nM2\n",
            &[
                "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                "STRAIGHT_FEED(1.0000, 0.0000, 1.0000",
                "STRAIGHT_TRAVERSE(1.0000, 0.0000, 5.0000",
            ],
        )],
    ),
    held(
        "#gcode:g86",
        "G86 bores, waits P seconds, stops the spindle, comes back at rapid rate, starts the spindle again as before",
        "effect `cycle-bore-stop`",
        &[
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG98 G86 X1 Z-5 R1 P1\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                    "DWELL(1.0000",
                    "STOP_SPINDLE_TURNING",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 5.0000",
                    "START_SPINDLE_CLOCKWISE",
                ],
            ),
            stops("G17 G21 G90\nF100\nG0 Z5\nG86 X1 Z-5 R1 P1\nG80\nM2\n"),
        ],
    ),
    held(
        "#gcode:g87",
        "G87 and G88 are not implemented: they are accepted, and what they do is undefined",
        "rule `undefined-code`",
        &[
            rule(
                "warning[undefined-code]",
                "G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG87 X1 Z-5 R1 I1 J1 K-4\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG89 X1 Z-5 R1 P1\nG80\nM2\n",
            ),
            rule(
                "warning[undefined-code]",
                "G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG88 X1 Z-5 R1 P1\nG80\nM2\n",
                "G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG89 X1 Z-5 R1 P1\nG80\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:g87",
        "What the interpreter (2.9) does for G87 and G88",
        "effects `cycle-back-bore`, `cycle-bore-dwell-manual`",
        &[
            runs("G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG98 G87 X1 Z-5 R1 I1 J1 K-4\nG80\nM2\n", &["STRAIGHT_"]),
            runs(
                "G17 G21 G90\nF100\nG0 Z5\nS100 M3\nG98 G88 X1 Z-5 R1 P1\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                    "DWELL(1.0000",
                    "STOP_SPINDLE_TURNING",
                    "PROGRAM_STOP",
                ],
            ),
        ],
    ),
    held(
        "#gcode:g89",
        "G89 bores, waits P seconds and comes back to the clear height at feed rate",
        "effect `cycle-bore-dwell`",
        &[runs(
            "G17 G21 G90\nF100\nG0 Z5\nG98 G89 X1 Z-5 R1 P1\nG80\nM2\n",
            &[
                "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                "DWELL(1.0000",
                "STRAIGHT_FEED(1.0000, 0.0000, 5.0000",
            ],
        )],
    ),
    held(
        "#gcode:g98-g99",
        "Under G98 the tool comes back to where it was before the series of cycles, if that is above R, else to R; under G99 to R",
        "effects `return-to-initial`, `return-to-r`",
        &[
            runs(
                "F100\nG0 Z5\nG98 G81 X1 Z-5 R1\nG99 X2\nG98 X3\nG80\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 5.0000",
                    "STRAIGHT_TRAVERSE(2.0000, 0.0000, 1.0000",
                    "STRAIGHT_TRAVERSE(3.0000, 0.0000, 5.0000",
                ],
            ),
            runs(
                "F100\nG0 Z0.5\nG98 G81 X1 Z-5 R1\nX2\nG80\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000",
                    "STRAIGHT_FEED(1.0000, 0.0000, -5.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000",
                ],
            ),
        ],
    ),
    held(
        "#gcode:g98-g99",
        "The height of G98 is set anew when a code that is no cycle ends the series; going from one cycle to another keeps it",
        "`[semantics.cycles]`",
        &[runs(
            "F100\nG0 Z5\nG98 G81 X1 Z-5 R1\nG83 X2 Z-5 R2 Q9\nG0 Z8\nG81 X4 Z-5 R1\nG80\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(2.0000, 0.0000, 5.0000",
                "STRAIGHT_TRAVERSE(2.0000, 0.0000, 8.0000",
                "STRAIGHT_TRAVERSE(4.0000, 0.0000, 8.0000",
            ],
        )],
    ),
    held(
        "#gcode:g98-g99",
        "G98 and G99 last, also beyond G80 and M2",
        "group `return-level`",
        &[runs(
            "F100\nG98\nG0 Z5\nG81 X1 Z-5 R1\nG80\nG0 Z6\nG81 X2 Z-5 R1\nG80\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 0.0000, 5.0000", "STRAIGHT_TRAVERSE(2.0000, 0.0000, 6.0000"],
        )],
    ),
    held(
        "#gcode:g80-g89",
        "A cycle needs a feed rate",
        "rule `feed-missing`",
        &[refused(
            "error[feed-missing]",
            "G17 G21 G90\nG0 Z5\nG81 X1 Z-2 R1\nG80\nM2\n",
            "G17 G21 G90\nF100\nG0 Z5\nG81 X1 Z-2 R1\nG80\nM2\n",
        )],
    ),
    held(
        "#gcode:polar-coordinates",
        "A cycle can take its hole by polar words",
        "effects of cycles",
        &[
            runs(
                "F100\nG0 Z5\nG98 G81 @10^30 Z-5 R1\n^60\nG80\nM2\n",
                &["STRAIGHT_FEED(8.6603, 5.0000, -5.0000", "STRAIGHT_FEED(5.0000, 8.6603, -5.0000"],
            ),
            runs(
                "F100\nG0 X1 Y0 Z5\nG91 G81 ^30 Z-5 R-1 L3\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(0.8660, 0.5000, -1.0000",
                    "STRAIGHT_FEED(0.5000, 0.8660, -1.0000",
                    "STRAIGHT_FEED(0.0000, 1.0000, -1.0000",
                ],
            ),
            runs(
                "F100\nG0 X1 Y0 Z5\nG91 G81 @1^30 Z-5 R-1\n^30\n^30\nG80\nM2\n",
                &[
                    "STRAIGHT_FEED(1.7321, 1.0000, -1.0000",
                    "STRAIGHT_FEED(1.0000, 1.7321, -1.0000",
                    "STRAIGHT_FEED(0.0000, 2.0000, -1.0000",
                ],
            ),
        ],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
