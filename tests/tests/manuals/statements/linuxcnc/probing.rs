//! Probing: `g-code.adoc`, G38.2 to G38.5; `overview.adoc`, probe logging.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: wiring of the probe.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Probing", key: "PRB", file: "linuxcnc/probing.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:g38",
        "G38.2 and G38.3 move towards the part and stop at contact, G38.4 and G38.5 away from it until contact is lost",
        "effects `probe-toward`, `probe-away`",
        &[runs(
            "F100\nG38.2 Z-10\nG38.3 Z-20\nG38.4 Z-5\nG38.5 Z0\nM2\n",
            &[
                "TURN_PROBE_ON()",
                "STRAIGHT_PROBE(0.0000, 0.0000, -10.0000",
                "TURN_PROBE_OFF()",
                "STRAIGHT_PROBE(0.0000, 0.0000, -20.0000",
                "STRAIGHT_PROBE(0.0000, 0.0000, -5.0000",
                "STRAIGHT_PROBE(0.0000, 0.0000, 0.0000",
            ],
        )],
    ),
    held(
        "#gcode:g38",
        "At least one axis word is needed",
        "words of `G38.2`",
        &[refused("error[word-choice-missing]", "F100\nG38.2\nM2\n", "F100\nG38.2 Z-1\nM2\n")],
    ),
    held(
        "#gcode:g38",
        "The probe moves in a straight line at the feed rate",
        "effect `probe-toward`",
        &[
            runs(
                "F50\nG38.2 X3 Z-10\nM2\n",
                &["SET_FEED_RATE(50.0000", "STRAIGHT_PROBE(3.0000, 0.0000, -10.0000"],
            ),
            Proof::Stats { program: ngc("G21 G90\nG0 Z0\nF60\nG38.2 Z-10\nM2\n"), prints: &["0:10.0"] },
        ],
    ),
    held(
        "#gcode:g38",
        "A feed of zero is refused",
        "rule `probe-without-feed`",
        &[refused("error[probe-without-feed]", "G38.2 Z-10\nM2\n", "F10\nG38.2 Z-10\nM2\n")],
    ),
    held(
        "#gcode:g38",
        "In inverse time the whole move takes that time, says the documentation; the interpreter (2.9) refuses to probe under G93",
        "rule `probe-without-feed`",
        &[
            refused("error[probe-without-feed]", "G93\nG38.2 Z-10 F2\nM2\n", "F2\nG38.2 Z-10\nM2\n"),
            refused("error[probe-without-feed]", "G93\nF2\nG38.2 Z-10\nM2\n", "F2\nG38.2 Z-10\nM2\n"),
        ],
    ),
    held(
        "#gcode:g38",
        "After success #5061 to #5069 are the point of contact in work coordinates, after failure the programmed point; #5070 is 1 or 0",
        "system variables `probe-position`, `probe-result`",
        &[runs(
            "F100\nG38.3 Z-10\n#1=#5063 #2=#5070\nG0 X#1 Y#2\nM2\n",
            &["STRAIGHT_PROBE(0.0000, 0.0000, -10.0000"],
        )],
    ),
    gap(
        "#gcode:g38",
        "G38.2 and G38.4 stop the program when nothing is touched; after G38.3 and G38.5 the program must look at #5070 itself",
        "`check` warns when `#5061` to `#5069` of a `G38.3` or `G38.5` are used, or the tool moves on in that direction, and no block on the way looks at `#5070`",
        &[rule(
            "warning[probe-result-unchecked]",
            "G21 G90\nM5\nF100\nG38.3 Z-5\nG10 L20 P1 Z0\n#100=#5063\nM2\n",
            "G21 G90\nM5\nF100\nG38.2 Z-5\nG10 L20 P1 Z0\n#100=#5063\nM2\n",
        )],
    ),
    held(
        "#gcode:g38",
        "Results are in work coordinates, not machine coordinates",
        "system variables `probe-position`",
        &[runs(
            "G10 L2 P1 Z4\nF100\nG38.2 Z-10\nG0 Z0\nG0 X#5063\nM2\n",
            &["STRAIGHT_PROBE(0.0000, 0.0000, -10.0000", "STRAIGHT_TRAVERSE(-10.0000"],
        )],
    ),
    held(
        "#gcode:probe-machine-coordinates",
        "#5021 to #5029 less #5420 to #5428 lead from work to machine coordinates while nothing is rotated, by the documentation; #5021 reads 0 in the interpreter of 2.9",
        "variables `5021` to `5029`",
        &[runs("G0 X5\nG0 Y#5021\nM2\n", &["STRAIGHT_TRAVERSE(5.0000, 0.0000"])],
    ),
    held(
        "#gcode:probe-logging",
        "(PROBEOPEN name) opens a file for the points of contact, (PROBECLOSE) closes it; nothing moves",
        "comments",
        &[runs(
            "(PROBEOPEN x.txt)\nF100 G38.2 Z-5\n(PROBECLOSE)\nM2\n",
            &["STRAIGHT_PROBE(0.0000, 0.0000, -5.0000"],
        )],
    ),
    held(
        "#gcode:g38",
        "A probing move that ends where it begins is refused",
        "rule `probe-move-refused`",
        &[refused(
            "error[probe-move-refused]",
            "G17 G21 G90\nF100\nG0 X0 Y0 Z0\nG38.2 Z0\nM2\n",
            "G17 G21 G90\nF100\nG0 X0 Y0 Z0\nG38.2 Z-1\nM2\n",
        )],
    ),
    held(
        "#gcode:g38",
        "Probing under cutter compensation is refused",
        "rule `probe-move-refused`",
        &[refused(
            "error[probe-move-refused]",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG38.2 Z-5\nM2\n",
            "G17 G21 G90\nT1 M6\nF100\nG0 X0 Y0\nG41\nG1 X10\nG40\nG0 X30\nG38.2 Z-5\nM2\n",
        )],
    ),
    unmodelled(
        "#gcode:g38",
        "Probing when the probe already is as the code wants it is refused",
        "the state of the input is not in the program",
    ),
    held(
        "#gcode:g38",
        "The tool in the spindle must be a probe: it does not turn",
        "rule `spindle-turns-while-probing`",
        &[rule(
            "warning[spindle-turns-while-probing]",
            "G17 G21 G90\nS100 M3\nF100 G38.2 Z-10\nM2\n",
            "G17 G21 G90\nS100 M3\nM5\nF100 G38.2 Z-10\nM2\n",
        )],
    ),
    held(
        "#gcode:g38",
        "G38 is a motion mode: axis words in later blocks probe again (interpreter 2.9)",
        "group `motion`",
        &[runs(
            "F100\nG38.3 Z-10\nX5 Z0\nM2\n",
            &["STRAIGHT_PROBE(0.0000, 0.0000, -10.0000", "STRAIGHT_PROBE(5.0000, 0.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:g38",
        "A probing move of rotary axes alone runs (interpreter 2.9)",
        "effect of `G38.2`",
        &[runs("F100\nG38.2 A-10\nM2\n", &["STRAIGHT_PROBE(0.0000, 0.0000, 0.0000, -10.0000"])],
    ),
    held(
        "#gcode:g38",
        "There is no G38.1 and no G38.6",
        "rule `unknown-code`",
        &[
            rule("warning[unknown-code]", "F100\nG38.6 Z-10\nM2\n", "F100\nG38.5 Z-10\nM2\n"),
            stops("F100\nG38.6 Z-10\nM2\n"),
            stops("F100\nG38.1 Z-10\nM2\n"),
        ],
    ),
    held(
        "#cha:rs274ngc-programs",
        "G38.2 does not draw the probe back: it stays where it touched",
        "effect `probe-toward`",
        &[runs(
            "F100\nG38.2 Z-10\nG91 G0 Z2\nM2\n",
            &["STRAIGHT_PROBE(0.0000, 0.0000, -10.0000", "STRAIGHT_TRAVERSE(0.0000, 0.0000, -7.7460"],
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
