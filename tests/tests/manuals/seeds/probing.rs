//! G136, automatic work offset centre measurement, and G31, G35, G36, G37: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use std::fmt::Write as _;

use expect_test::expect;

use crate::proof::Proof::{Assumes, Explains, Legal, Rule, Run};
use crate::proof::{Program, Proof, legal, noticed, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

const MILL: &str = "haas-mill";

const fn mill(text: &'static str) -> Program {
    on(MILL, text)
}

const fn explains(code: &'static str, says: &'static str) -> crate::proof::Proof {
    Explains { control: MILL, code, says }
}

/// Both sides of a block along Y, from above, in our own numbers: the order of the page's example.
const CENTRE: Program = mill(
    "%\nO2136 (CENTRE OF A BLOCK)\nM53\nG04 P100\nM63\nG00 G90 G54 X0 Y3.5\nZ-4.\nG91 G01 Z-.75 F15.\nG31 Y-.8 F8. M75\n\
     G01 Y.5 F15.\nG00 Z1.5\nY-6.5\nG01 Z-1.5 F15.\nG136 Y.8 F8.\nG01 Y-.5\nM53\nG04 P100\nM63\nG00 G90 G53 Z0\nM30\n%\n",
);

/// As [`CENTRE`], with a first touch that is not kept.
const NOT_KEPT: Program =
    mill("O1\nG90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10.\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n");
/// As [`CENTRE`], from end to end in increments.
const KEPT: Program =
    mill("O1\nG90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n");
/// A surface becomes work zero.
const SURFACE: Program = mill("O1\nG90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10. M79\nG90\nM30\n");
/// A tool's length is measured.
const LENGTH: Program = mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 H1 Z0. F10. M79\nM30\n");
/// A tool's size is measured.
const SIZE: Program = mill(
    "O1\nT1 M6\nS200 M4\nG90 G54 G0 X0. Y2.\nG43 H1 Z1.\nG91 G31 Y-1. F5. M75\nG0 Y1.\nZ1.\nY-4.\nZ-1.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n",
);

pub(crate) const SYSTEM: System = System {
    title: "G136, automatic work offset centre measurement, and G31, G35, G36, G37",
    key: "G136",
    source: "Haas 96-8000 rev R, June 2007, pp. 152–153; June 1999, pp. 169–170; mill operator's manual 2017, pp. 264–269, 308, 355–356",
    module: "probing",
    sentences: &[
        Sentence {
            says: "The centre of a part is probed by: probe on, to the first side, `G31 … M75`, back, up and over, `G136` at the other side, \
                   back, probe off. A program in this order is legal as it stands.",
            literal: By(&[
                Legal { program: CENTRE },
                Run {
                    program: CENTRE,
                    prints: &[
                        "4 dwell 0.100",
                        "9 probe 0.0000 2.7000 -4.7500 8",
                        "12 rapid 0.0000 ? -3.2500",
                        "14 probe 0.0000 ? -4.7500 8",
                        "15 feed 0.0000 ? -4.7500 8",
                        "17 dwell 0.100",
                    ],
                },
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=1.\nG31 Y[0-#1] F10. M75\nG0 Z2.\nY-8.\nG136 Y#1 F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
lasting: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"), &["probe 0.0000 4.0000"]),
]),
missing: By(&[
rule("error[required-word-missing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. Y-2. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
range: No("see G136-17"),

        },
        Sentence {
            says: "User relay 3 (`M53` on, `M63` off) with a dwell of `G04 P100` between switches the probe; the codes are the \
                   control's own, and the dwell is 0.1 seconds.",
            literal: By(&[
                Legal { program: mill("O1\nM53\nG04 P100\nM63\nM30\n") },
                Run { program: mill("O1\nM53\nG04 P100\nM63\nM30\n"), prints: &["3 dwell 0.100"] },
                explains("M53", "switches its spindle probe on, and off again, by `M53`, `G4 P100`, `M63`"),
                explains("M63", "Switches off what M53 switched on"),
                explains("G136", "Switch the probe on before"),
]),
computed: By(&[
run(mill("O1\n#1=0.1\nM53\nG04 P#1\nM63\nM30\n"), &["dwell 0.100"]),
]),
lasting: No("not lasting"),
missing: By(&[
rule("warning[required-word-missing]", mill("O1\nM53\nG04\nM63\nM30\n"), mill("O1\nM53\nG04 P100\nM63\nM30\n")),
]),
extra: By(&[
rule("warning[axis-word-unsure]", mill("O1\nM53\nG04 P100 Z2.\nM63\nM30\n"), mill("O1\nM53\nG04 P100\nM63\nM30\n")),
]),
range: By(&[
rule("warning[number-out-of-range]", mill("O1\nM53\nG04 P-100\nM63\nM30\n"), mill("O1\nM53\nG04 P100\nM63\nM30\n")),
]),

        },
        Sentence {
            says: "`M75` on the `G31` block keeps its touch as the first point; without one, `G136` has nothing to measure from.",
            literal: By(&[
                explains("M75", "Belongs on the G31 block of the **first** touch"),
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
computed: By(&[
rule("error[first-touch-missing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10.\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
lasting: By(&[
rule("error[first-touch-missing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nM98 P2\nG91 G0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\nO2\nG91 G31 Y-1. F10.\nM99\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nM98 P2\nG91 G0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\nO2\nG91 G31 Y-1. F10. M75\nM99\n")),
]),
missing: By(&[
                Rule { finding: "error[first-touch-missing]", violates: NOT_KEPT, conforms: KEPT },
                Rule {
                    finding: "error[first-touch-missing]",
                    violates: mill("O1\nG91 G136 Y1. F10.\nG31 Y-1. F10. M75\nG90\nM30\n"),
                    conforms: CENTRE,
                },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "A first touch on some paths only may be missing; after a block delete it is missing when the switch is on.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nIF [#100 EQ 1] GOTO10\nG91 G31 Y-1. F10. M75\nGOTO20\nN10 G91 G31 Y-2. F10. M75\nN20 G0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
computed: No("a path, no value"),
lasting: By(&[
                Rule {
                    finding: "warning[maybe-first-touch-missing]",
                    violates: mill("O1\nIF [#100 EQ 1] GOTO10\nG91 G31 Y-1. F10. M75\nN10 G91 G136 Y1. F10.\nG90\nM30\n"),
                    conforms: mill(
                        "O1\nIF [#100 EQ 1] GOTO10\nG91 G31 Y-1. F10. M75\nGOTO20\nN10 G91 G31 Y-2. F10. M75\nN20 G136 Y1. F10.\nG90\nM30\n",
                    ),
                },
]),
missing: By(&[
                Rule {
                    finding: "warning[first-touch-missing]",
                    violates: mill("O1\nG91\n/G31 Y-1. F10. M75\nG0 Y-5.\nG136 Y1. F10.\nG90\nM30\n"),
                    conforms: mill("O1\nG91\nG31 Y-1. F10. M75\n/G0 Y-5.\nG136 Y1. F10.\nG90\nM30\n"),
                },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "A first touch that a subprogram keeps counts, in a loop as well; a program that gcheck does not have is not judged.",
            literal: By(&[
                Rule {
                    finding: "error[first-touch-missing]",
                    violates: mill(
                        "O1\n#1 = 0\nWHILE [#1 LT 3] DO1\nG91 G31 Y-1. F10.\nG136 Y1. F10.\n#1 = #1 + 1\nEND1\nG90\nM30\n",
                    ),
                    conforms: mill(
                        "O1\n#1 = 0\nWHILE [#1 LT 3] DO1\nG91 G31 Y-1. F10. M75\nG136 Y1. F10.\n#1 = #1 + 1\nEND1\nG90\nM30\n",
                    ),
                },
]),
computed: No("a path, no value"),
lasting: By(&[
                Legal {
                    program: mill(
                        "O1\nG90 G54 G0 X0. Y5.\nM97 P100\nG91 G0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\nN100 G91 G31 Y-1. F10. M75\nM99\n",
                    ),
                },
                Rule {
                    finding: "error[first-touch-missing]",
                    violates: mill("O1\nM97 P100 L2\nM30\nN100 G91 G36 Y-1. F10.\nG136 Y1. F10.\nG90\nM99\n"),
                    conforms: mill("O1\nM97 P100 L2\nM30\nN100 G91 G31 Y-1. F10. M75\nG136 Y1. F10.\nG90\nM99\n"),
                },
]),
missing: By(&[
                Rule {
                    finding: "error[first-touch-missing]",
                    violates: NOT_KEPT,
                    conforms: mill("O1\nG65 P9700\nG91 G136 Y1. F10.\nG90\nM30\n"),
                },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "`M75` belongs to a probing move: on another move, or before any, it keeps nothing.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
computed: By(&[
rule("error[touch-code-without-probing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=-1.\nG91 G1 Y#1 F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=-1.\nG91 G31 Y#1 F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
lasting: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10.\nM75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
missing: By(&[
                Rule {
                    finding: "error[touch-code-without-probing]",
                    violates: mill("O1\nM75\nM30\n"),
                    conforms: mill("O1\nG91 G31 Y-1. F10.\nM75\nG136 Y1. F10.\nG90\nM30\n"),
                },
]),
extra: By(&[
                Rule {
                    finding: "error[touch-code-without-probing]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G1 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"),
                    conforms: KEPT,
                },
]),
range: No("no range"),

        },
        Sentence {
            says: "A touch is kept for a second one that measures from it.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
computed: By(&[
rule("warning[kept-touch-never-used]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10. M75\nG0 Z2.\nY-8.\nG31 Y1. F10. M79\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
lasting: No("a path"),
missing: By(&[
Rule {
                finding: "warning[kept-touch-never-used]",
                violates: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG31 Y1. F10.\nG90\nM30\n"),
                conforms: KEPT,
            },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "The work zero comes to the middle of the line between the two points: they are touched along one axis, from two sides.",
            literal: By(&[
                Rule {
                    finding: "warning[touches-do-not-meet]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y-1. F10.\nG90\nM30\n"),
                    conforms: KEPT,
                },
                Rule {
                    finding: "warning[touches-do-not-meet]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 X1. F10.\nG90\nM30\n"),
                    conforms: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y#100 F10.\nG90\nM30\n"),
                },
                explains("G136", "halfway between the two"),
]),
computed: By(&[
rule("warning[touches-do-not-meet]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10. M75\nG0 Z2.\nY-8.\nG136 Y#1 F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10. M75\nG0 Z2.\nY-8.\nG136 Y[0-#1] F10.\nG90\nM30\n")),
]),
lasting: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
missing: By(&[
rule("error[word-choice-missing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
extra: By(&[
noticed("warning", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. X1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "The active work offset is set, on each axis that the block names. Which value it gets is known to nobody beforehand; the other \
                   axes keep theirs.",
            literal: By(&[
                Run {
                    program: mill(
                        "O1\nG21 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90 G0 Y0.\nG0 X#5221\nY#5222\nM30\n",
                    )
                    .with(&["machine.units=\"mm\"", "offsets.G54={ X = 30.0, Y = 40.0, Z = 0.0 }"]),
                    prints: &["6 probe 0.0000 ?", "7 rapid 0.0000 0.0000", "8 rapid 30.0000 0.0000", "9 rapid 30.0000 ?"],
                },
                Run {
                    program: mill("O1\nG21 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90 G0 Y0.\nG0 Y#5222\nM30\n")
                        .with(&["machine.units=\"mm\"", "offsets.G54={ X = 30.0, Y = 40.0, Z = 0.0 }"]),
                    prints: &["3 probe 0.0000 4.0000", "4 rapid 0.0000 0.0000", "5 rapid 0.0000 ?"],
                },
                Assumes { program: KEPT, says: "work offset G54" },
]),
computed: By(&[
Proof::Assumes { program: mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG36 Y#1 F10.\nG90\nM30\n"), says: "work offset G54" },
]),
lasting: By(&[
run(mill("O1\nG21 G90 G55 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90 G0 Y#5242\nM30\n").with(&["machine.units=\"mm\"", "offsets.G55={ X = 30.0, Y = 40.0, Z = 0.0 }"]), &["rapid 0.0000 ?"]),
]),
missing: By(&[
rule("error[word-choice-missing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "The work offset may be selected in the block itself, or before it.",
            literal: By(&[
                Legal { program: mill("O1\nG90 G55 G0 X0. Y5.\nG91 G55 G36 Y-1. F10.\nG90\nM30\n") },
                explains("G36", "Choose the offset (G54 ...) in the block or before it"),
]),
computed: By(&[
legal(mill("O1\nG90 G55 G0 X0. Y5.\n#1=-1.\nG91 G55 G36 Y#1 F10.\nG90\nM30\n")),
]),
lasting: By(&[
legal(mill("O1\nG90 G55 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
missing: No("no word"),
extra: By(&[
rule("error[two-codes-of-one-group]", mill("O1\nG90 G55 G0 X0. Y5.\nG91 G54 G55 G36 Y-1. F10.\nG90\nM30\n"), mill("O1\nG90 G55 G0 X0. Y5.\nG91 G55 G36 Y-1. F10.\nG90\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "`I`, `J`, `K` shift the measured offset along X, Y and Z.",
            literal: By(&[
                Legal { program: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G36 Y-1. J.5 F10.\nG90\nM30\n") },
                explains("G136", "`I`, `J`, `K` shift the result along X, Y, Z"),
]),
computed: By(&[
rule("warning[shift-of-axis-not-probed]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=0.5\nG36 Y-1. I#1 F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=0.5\nG36 Y-1. J#1 F10.\nG90\nM30\n")),
]),
lasting: No("not lasting"),
missing: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
extra: By(&[
                Rule {
                    finding: "warning[shift-of-axis-not-probed]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G36 Y-1. I.5 F10.\nG90\nM30\n"),
                    conforms: mill("O1\nG90 G54 G0 X0. Y5.\nG91 G36 Y-1. J.5 F10.\nG90\nM30\n"),
                },
]),
range: No("no range"),

        },
        Sentence {
            says: "The points are corrected for the tip of the probe by settings 59 to 62.",
            literal: By(&[
                explains("G36", "Settings 59 to 62 correct for the tip of the probe"),
                explains("G136", "Settings 59 to 62 correct for the probe tip"),
]),
computed: No("no word"),
lasting: No("no word"),
missing: No("no word"),
extra: No("no word"),
range: No("no word"),

        },
        Sentence {
            says: "The axis words are read in the offset that is about to be set, so that increments (`G91`) are the way to write them.",
            literal: By(&[
                Rule {
                    finding: "info[measures-in-positions]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG31 Y4. F10. M75\nG0 Y-5.\nG136 Y-4. F10.\nM30\n"),
                    conforms: KEPT,
                },
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
computed: By(&[
rule("info[measures-in-positions]", mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=4.\nG36 Y#1 F10.\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=-1.\nG91 G36 Y#1 F10.\nG90\nM30\n")),
]),
lasting: By(&[
                Rule {
                    finding: "info[measures-in-positions]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG36 Y4. F10.\nM30\n"),
                    conforms: SURFACE,
                },
rule("info[measures-in-positions]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG90\nG136 Y-2. F10.\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n")),
]),
missing: No("no word"),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "No tool length compensation is in effect while a work offset is measured (`G36`, `G136`).",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
computed: By(&[
rule("error[probing-in-wrong-mode]", mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=1\nG43 H#1 Z1.\nG91 G36 Y-1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=1\nG43 H#1 Z1.\nG49\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
lasting: By(&[
                Rule {
                    finding: "error[probing-in-wrong-mode]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG43 H1 Z1.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. F10.\nG90\nM30\n"),
                    conforms: mill("O1\nG90 G54 G0 X0. Y5.\nG43 H1 Z1.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG49 G136 Y1. F10.\nG90\nM30\n"),
                },
                Rule {
                    finding: "error[probing-in-wrong-mode]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG44 H1 Z1.\nG91 G36 Y-1. F10.\nG90\nM30\n"),
                    conforms: SURFACE,
                },
                Rule {
                    finding: "warning[maybe-probing-in-wrong-mode]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nIF [#100 EQ 1] GOTO10\nG43 H1 Z1.\nN10 G91 G36 Y-1. F10.\nG90\nM30\n"),
                    conforms: mill("O1\nG90 G54 G0 X0. Y5.\nIF [#100 EQ 1] GOTO10\nG43 H1 Z1.\nN10 G49\nG91 G36 Y-1. F10.\nG90\nM30\n"),
                },
]),
missing: No("no word"),
extra: By(&[
rule("error[probing-in-wrong-mode]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G43 H1 G36 Y-1. F10.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "No cutter compensation is in effect while a probe touches (`G31`, `G35`, `G36`, `G37`, `G136`).",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M79\nG90\nM30\n")),
]),
computed: By(&[
rule("error[probing-in-wrong-mode]", mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=1\nG41 D#1 G1 X1. F10.\nG91 G31 Y-1. F10. M79\nG40 X1.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=1\nG41 D#1 G1 X1. F10.\nG40 X1.\nG91 G31 Y-1. F10. M79\nG90\nM30\n")),
]),
lasting: By(&[
                Rule {
                    finding: "error[probing-in-wrong-mode]",
                    violates: mill("O1\nG41 D1 G1 X1. F10.\nG91 G31 Y-1. F10.\nG40 X1.\nG90\nM30\n"),
                    conforms: mill("O1\nG41 D1 G1 X1. F10.\nG40 X1.\nG91 G31 Y-1. F10.\nG90\nM30\n"),
                },
                Rule {
                    finding: "error[probing-in-wrong-mode]",
                    violates: mill("O1\nG43 H1 Z1.\nG42 D1 G1 X1. F10.\nG37 H1 Z0. F10.\nG40 X1.\nM30\n"),
                    conforms: LENGTH,
                },
                Rule {
                    finding: "warning[maybe-probing-in-wrong-mode]",
                    violates: mill("O1\nG41 D1 G1 X1. F10.\nIF [#100 EQ 1] GOTO10\nG40 X2.\nN10 G91 G31 Y-1. F10.\nG40 X1.\nG90\nM30\n"),
                    conforms: mill("O1\nG41 D1 G1 X1. F10.\nIF [#100 EQ 1] GOTO10\nG1 Y2.\nN10 G40 X2.\nG91 G31 Y-1. F10.\nG90\nM30\n"),
                },
]),
missing: No("no word"),
extra: By(&[
rule("error[probing-in-wrong-mode]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G41 D1 G31 Y-1. F10. M79\nG40 X1.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M79\nG90\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "A probing move needs an axis and a feed in its block.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M79\nG90\nM30\n")),
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=10.\nG31 Y-1. F#1\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10.\nG90\nM30\n")),
]),
lasting: By(&[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: mill("O1\nG91 G1 Y2. F10.\nG31 Y-1.\nG90\nM30\n"),
                    conforms: mill("O1\nG91 G1 Y2. F10.\nG31 Y-1. F10.\nG90\nM30\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: mill("O1\nG91 G31 Y-1. F10. M75\nG136 Y1.\nG90\nM30\n"),
                    conforms: KEPT,
                },
]),
missing: By(&[
                Rule {
                    finding: "error[word-choice-missing]",
                    violates: mill("O1\nG91 G31 F10.\nG90\nM30\n"),
                    conforms: mill("O1\nG91 G31 Y-1. F10. M79\nG90\nM30\n"),
                },
                Rule {
                    finding: "error[word-choice-missing]",
                    violates: mill("O1\nG91 G36 F10.\nG90\nM30\n"),
                    conforms: SURFACE,
                },
]),
extra: By(&[
rule("info[word-passed-over]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. Q2. M79\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M79\nG90\nM30\n")),
noticed("info", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10. R2.\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nG90\nM30\n")),
]),
range: No("see G136-17"),

        },
        Sentence {
            says: "The feed of a probing move is above zero and has no sign.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M79\nG90\nM30\n")),
]),
computed: By(&[
rule("error[computed-value-out-of-range]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=0\nG31 Y-1. F#1 M79\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=10.\nG31 Y-1. F#1 M79\nG90\nM30\n")),
rule("error[computed-value-out-of-range]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-10.\nG31 Y-1. F#1 M79\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=10.\nG31 Y-1. F#1 M79\nG90\nM30\n")),
rule("warning[maybe-computed-value-out-of-range]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=10.\nIF [#500 EQ 1] GOTO 10\n#1=-10.\nN10 G31 Y-1. F#1 M79\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=10.\nIF [#500 EQ 1] GOTO 10\n#1=12.\nN10 G31 Y-1. F#1 M79\nG90\nM30\n")),
]),
lasting: No("see G136-16"),
missing: No("see G136-16"),
extra: By(&[
                Rule {
                    finding: "warning[word-given-twice]",
                    violates: mill("O1\nG91 G31 Y-1. F10. F12. M79\nG90\nM30\n"),
                    conforms: mill("O1\nG91 G31 Y-1. F10. M79\nG90\nM30\n"),
                },
]),
range: By(&[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: mill("O1\nG91 G31 Y-1. F0. M79\nG90\nM30\n"),
                    conforms: mill("O1\nG91 G31 Y-1. F#100 M79\nG90\nM30\n"),
                },
                Rule {
                    finding: "error[sign-not-accepted]",
                    violates: mill("O1\nG91 G31 Y-1. F-10. M79\nG90\nM30\n"),
                    conforms: mill("O1\nG91 G31 Y-1. F10. M79\nG90\nM30\n"),
                },
]),

        },
        Sentence {
            says: "The feed of a probing move stays below 100 inch (2500 mm) a minute.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F99. M79\nG90\nM30\n")),
]),
computed: By(&[
rule("warning[probe-feed-too-high]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=12.\nG31 Y-1. F[#1*10.] M79\nG90\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=12.\nG31 Y-1. F#1 M79\nG90\nM30\n")),
]),
lasting: No("see G136-16"),
missing: No("see G136-16"),
extra: No("no other word"),
range: By(&[
                Rule {
                    finding: "warning[probe-feed-too-high]",
                    violates: mill("O1\nG20 G91 G31 Y-1. F120. M79\nG90\nM30\n"),
                    conforms: mill("O1\nG20 G91 G31 Y-1. F12. M79\nG90\nM30\n"),
                },
                Rule {
                    finding: "warning[probe-feed-too-high]",
                    violates: mill("O1\nG21 G91 G36 Y-1. F99999.\nG90\nM30\n"),
                    conforms: mill("O1\nG21 G91 G36 Y-1. F250.\nG90\nM30\n"),
                },
]),

        },
        Sentence {
            says: "`G31` moves as feed does until the touch, or to its end point, and the program goes on either way; the point is in `#5061` and up, \
                   which nobody knows beforehand.",
            literal: By(&[
                Run {
                    program: mill("O1\nG21 G90 G54 G0 X0. Y5.\nG31 Y-5. F100.\nX1.\nY#5062\nX#5061\nM30\n"),
                    prints: &["3 probe 0.0000 -5.0000", "4 rapid 1.0000 ?", "5 rapid 1.0000 ?", "6 rapid 0.0000 ?"],
                },
                explains("G31", "the program goes on either way"),
]),
computed: By(&[
run(mill("O1\nG21 G90 G54 G0 X0. Y5.\n#1=-5.\nG31 Y#1 F100.\nX1.\nM30\n"), &["probe 0.0000 -5.0000", "rapid 1.0000 ?"]),
rule("warning[probe-goes-nowhere]", mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=5.\nG31 Y#1 F10. M79\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\n#1=4.\nG31 Y#1 F10. M79\nM30\n")),
]),
lasting: By(&[
run(mill("O1\nG21 G90 G54 G1 X0. Y5. F200.\nG31 Y-5. F100.\nY9.\nM30\n"), &["probe 0.0000 -5.0000", "feed 0.0000 9.0000"]),
]),
missing: By(&[
rule("error[word-choice-missing]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG31 F10. M79\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG31 Y4. F10. M79\nM30\n")),
]),
extra: By(&[
rule("info[word-passed-over]", mill("O1\nG20 G90 G54 G0 X0. Y5.\nG31 Y4. F10. K2. M79\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y5.\nG31 Y4. F10. M79\nM30\n")),
]),
range: By(&[
                Rule {
                    finding: "warning[probe-goes-nowhere]",
                    violates: mill("O1\nG90 G54 G0 X0. Y5.\nG31 Y5. F10. M79\nM30\n"),
                    conforms: mill("O1\nG90 G54 G0 X0. Y5.\nG31 Y4. F10. M79\nM30\n"),
                },
]),

        },
        Sentence {
            says: "`M79` makes no touch an alarm, `M78` a touch; they are in the probing block or after it.",
            literal: By(&[
                Legal { program: mill("O1\nG91 G31 Y-1. F10.\nM79\nG90\nM30\n") },
                Run {
                    program: mill("O1\nG21 G90 G54 G0 X0. Y5.\nG31 Y-5. F100. M78\nX1.\nM30\n"),
                    prints: &["3 probe 0.0000 -5.0000", "4 rapid 1.0000 -5.0000"],
                },
                explains("M78", "it turns a touch into an alarm"),
                explains("M79", "no touch on the way is an alarm then"),
]),
computed: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 #1=-1.\nG31 Y#1 F10. M79\nG90\nM30\n")),
]),
lasting: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10.\nM78\nG90\nM30\n")),
]),
missing: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10.\nG90\nM30\n")),
]),
extra: By(&[
                Rule {
                    finding: "warning[touch-code-without-probing]",
                    violates: mill("O1\nG91 G1 Y-1. F10. M79\nG90\nM30\n"),
                    conforms: mill("O1\nG91 G31 Y-1. F10. M79\nG90\nM30\n"),
                },
]),
range: No("no range"),

        },
        Sentence {
            says: "`G35` is the second touch of a tool's size, which becomes the offset `D`: one that is not 0.",
            literal: By(&[
                Legal { program: SIZE },
                explains("G35", "less the width of the probe (Setting 63)"),
]),
computed: By(&[
same(mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\n#1=1\nG35 Y1. D#1 F5.\nM5\nG90\nM30\n"), mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n")),
rule("error[computed-value-out-of-range]", mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\n#1=0\nG35 Y1. D#1 F5.\nM5\nG90\nM30\n"), mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\n#1=1\nG35 Y1. D#1 F5.\nM5\nG90\nM30\n")),
]),
lasting: By(&[
rule("error[required-word-missing]", mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nD1\nG35 Y1. F5.\nM5\nG90\nM30\n"), mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nD1\nG35 Y1. D1 F5.\nM5\nG90\nM30\n")),
]),
missing: By(&[
                Rule {
                    finding: "error[first-touch-missing]",
                    violates: mill("O1\nS200 M4\nG91 G31 Y-1. F5.\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nG90\nM30\n"),
                    conforms: SIZE,
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. F5.\nG90\nM30\n"),
                    conforms: SIZE,
                },
]),
extra: By(&[
noticed("info", mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5. Q1.\nM5\nG90\nM30\n"), mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n")),
]),
range: By(&[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D0 F5.\nG90\nM30\n"),
                    conforms: SIZE,
                },
noticed("error", mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1.5 F5.\nM5\nG90\nM30\n"), mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n")),
noticed("error", mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D-1 F5.\nM5\nG90\nM30\n"), mill("O1\nS200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n")),
]),

        },
        Sentence {
            says: "A right-hand cutter turns backward (`M4`) while its size is measured; a spindle probe does not turn.",
            literal: By(&[
legal(SIZE),
]),
computed: By(&[
rule("warning[spindle-turns-while-probing]", mill("O1\n#1=200\nS#1 M3\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n"), mill("O1\n#1=200\nS#1 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n")),
]),
lasting: By(&[
                Rule {
                    finding: "warning[spindle-turns-while-probing]",
                    violates: mill("O1\nS200 M3\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n"),
                    conforms: SIZE,
                },
                Rule {
                    finding: "warning[spindle-turns-while-probing]",
                    violates: mill("O1\nS500 M3\nG90 G54 G0 X0. Y5.\nG91 G36 Y-1. F10.\nM5\nG90\nM30\n"),
                    conforms: SURFACE,
                },
]),
missing: No("no word"),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "`G37` needs `G43` or `G44` with an `H` that is not 0, in its block or before it.",
            literal: By(&[
                Legal { program: LENGTH },
]),
computed: By(&[
same(mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\n#1=1\nG37 H#1 Z0. F10. M79\nM30\n"), mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 H1 Z0. F10. M79\nM30\n")),
rule("error[computed-value-out-of-range]", mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\n#1=0\nG37 H#1 Z0. F10. M79\nM30\n"), mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\n#1=1\nG37 H#1 Z0. F10. M79\nM30\n")),
]),
lasting: By(&[
legal(mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 Z0. F10. M79\nM30\n")),
]),
missing: By(&[
                Rule {
                    finding: "error[probing-in-wrong-mode]",
                    violates: mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG49\nG37 H1 Z0. F10.\nM30\n"),
                    conforms: mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 Z0. F10. M79\nM30\n"),
                },
]),
extra: By(&[
                Rule {
                    finding: "warning[length-written-for-another-tool]",
                    violates: mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 H2 Z0. F10. M79\nM30\n"),
                    conforms: LENGTH,
                },
]),
range: By(&[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 H0 Z0. F10.\nM30\n"),
                    conforms: LENGTH,
                },
]),

        },
        Sentence {
            says: "`G37` names Z, and no X, Y or A. Its Z is what the touched point shall read, not where the move ends: 0 for no shift.",
            literal: By(&[
                Run {
                    program: mill("O1\nG21 G90 G54 G0 X0. Y0.\nG43 H1 Z20.\nG37 H1 Z0. F100.\nG0 Z20.\nM30\n"),
                    prints: &["3 rapid 0.0000 0.0000 20.0000", "4 probe 0.0000 0.0000 ?", "5 rapid 0.0000 0.0000 20.0000"],
                },
                explains("G37", "writes length offset `H` so that the touched point reads the `Z` of the block"),
]),
computed: By(&[
rule("error[word-forbidden]", mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\n#1=1.\nG37 H1 X#1 Z0. F10. M79\nM30\n"), LENGTH),
same(mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\n#1=0\nG37 H1 Z#1 F10. M79\nM30\n"), mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 H1 Z0. F10. M79\nM30\n")),
]),
lasting: No("not lasting"),
missing: By(&[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: mill("O1\nG90 G43 H1 Z2.\nG37 H1 F10.\nM30\n"),
                    conforms: LENGTH,
                },
]),
extra: By(&[
                Rule {
                    finding: "error[word-forbidden]",
                    violates: mill("O1\nG90 G43 H1 Z2.\nG37 H1 X1. Z0. F10.\nM30\n"),
                    conforms: LENGTH,
                },
rule("error[word-forbidden]", mill("O1\nT1 M6\nG90 G54 G0 X0. Y0.\nG43 H1 Z2.\nG37 H1 A1. Z0. F10. M79\nM30\n"), LENGTH),
]),
range: No("no range"),

        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}

/// Programs with a probing block, and that block.
const BLOCKS: [(Program, &str); 5] = [
    (mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M79\nG90\nM30\n"), "G31 Y-1. F10."),
    (
        mill("O1\nG20 S200 M4\nG91 G31 Y-1. F5. M75\nG0 Z2.\nY-4.\nG35 Y1. D1 F5.\nM5\nG90\nM30\n"),
        "G35 Y1. D1 F5.",
    ),
    (mill("O1\nG20 G90 G54 G0 X0. Y5.\nG91 G36 Y-1. J.5 F10.\nG90\nM30\n"), "G36 Y-1. J.5 F10."),
    (mill("O1\nG20 G90 G54 G0 X0. Y5.\nG43 H1 Z2.\nG37 H1 Z0. F10.\nM30\n"), "G37 H1 Z0. F10."),
    (
        mill(
            "O1\nG20 G90 G54 G0 X0. Y5.\nG91 G31 Y-1. F10. M75\nG0 Z2.\nY-8.\nG136 Y1. I0. F10.\nG90\nM30\n",
        ),
        "G136 Y1. I0. F10.",
    ),
];

/// How a word is made wrong.
type Mistake = fn(&str) -> String;

const MISTAKES: [(&str, Mistake); 7] = [
    ("missing", |_| String::new()),
    ("doubled", |word| format!("{word} {word}")),
    ("negative", |word| format!("{}-2{}", &word[..1], if word.starts_with(['D', 'H']) { "" } else { "." })),
    ("zero", |word| format!("{}0", &word[..1])),
    ("huge", |word| format!("{}99999999{}", &word[..1], if word.starts_with(['D', 'H']) { "" } else { "." })),
    ("no number", |word| word[..1].to_owned()),
    ("unknown", |word| format!("{}#100", &word[..1])),
];

#[test]
#[expect(clippy::too_many_lines, reason = "the table of what is found, a line for each word and mistake")]
fn words_made_wrong() {
    let mut table = String::new();
    for (program, block) in BLOCKS {
        let (code, words) = block.split_once(' ').unwrap();
        let words: Vec<&str> = words.split(' ').collect();
        for word in &words {
            for (name, mistake) in MISTAKES {
                let bad: Vec<String> =
                    words.iter().map(|w| if w == word { mistake(w) } else { (*w).to_owned() }).collect();
                let text = program.text.replacen(block, &format!("{code} {}", bad.join(" ")), 1);
                let found = crate::product::check(&on(MILL, text.leak()));
                if name == "unknown" {
                    assert!(!found.iter().any(|one| one.starts_with("error")), "{block} {word}: {found:?}");
                }
                writeln!(table, "{code} {} {name}: {}", &word[..1], found.join(" ")).unwrap();
            }
        }
    }
    expect![[r#"
        G31 Y missing: error[word-choice-missing]
        G31 Y doubled: warning[word-given-twice]
        G31 Y negative: 
        G31 Y zero: warning[probe-goes-nowhere]
        G31 Y huge: 
        G31 Y no number: error[address-without-value]
        G31 Y unknown: 
        G31 F missing: error[required-word-missing]
        G31 F doubled: warning[word-given-twice]
        G31 F negative: error[sign-not-accepted]
        G31 F zero: error[number-out-of-range]
        G31 F huge: warning[probe-feed-too-high]
        G31 F no number: error[address-without-value]
        G31 F unknown: 
        G35 Y missing: warning[probe-goes-nowhere]
        G35 Y doubled: warning[word-given-twice]
        G35 Y negative: warning[touches-do-not-meet]
        G35 Y zero: warning[probe-goes-nowhere]
        G35 Y huge: 
        G35 Y no number: error[address-without-value]
        G35 Y unknown: 
        G35 D missing: error[required-word-missing]
        G35 D doubled: warning[word-given-twice]
        G35 D negative: error[sign-not-accepted]
        G35 D zero: error[number-out-of-range]
        G35 D huge: error[number-out-of-range]
        G35 D no number: error[address-without-value]
        G35 D unknown: 
        G35 F missing: error[required-word-missing]
        G35 F doubled: warning[word-given-twice]
        G35 F negative: error[sign-not-accepted]
        G35 F zero: error[number-out-of-range]
        G35 F huge: warning[probe-feed-too-high]
        G35 F no number: error[address-without-value]
        G35 F unknown: 
        G36 Y missing: error[word-choice-missing]
        G36 Y doubled: warning[word-given-twice]
        G36 Y negative: 
        G36 Y zero: warning[probe-goes-nowhere]
        G36 Y huge: 
        G36 Y no number: error[address-without-value]
        G36 Y unknown: 
        G36 J missing: 
        G36 J doubled: warning[word-given-twice]
        G36 J negative: 
        G36 J zero: 
        G36 J huge: 
        G36 J no number: error[address-without-value]
        G36 J unknown: 
        G36 F missing: error[required-word-missing]
        G36 F doubled: warning[word-given-twice]
        G36 F negative: error[sign-not-accepted]
        G36 F zero: error[number-out-of-range]
        G36 F huge: warning[probe-feed-too-high]
        G36 F no number: error[address-without-value]
        G36 F unknown: 
        G37 H missing: 
        G37 H doubled: warning[word-given-twice]
        G37 H negative: error[sign-not-accepted]
        G37 H zero: error[number-out-of-range]
        G37 H huge: error[number-out-of-range]
        G37 H no number: error[address-without-value]
        G37 H unknown: 
        G37 Z missing: error[required-word-missing] warning[probe-goes-nowhere]
        G37 Z doubled: warning[word-given-twice]
        G37 Z negative: 
        G37 Z zero: 
        G37 Z huge: 
        G37 Z no number: error[address-without-value]
        G37 Z unknown: 
        G37 F missing: error[required-word-missing]
        G37 F doubled: warning[word-given-twice]
        G37 F negative: error[sign-not-accepted]
        G37 F zero: error[number-out-of-range]
        G37 F huge: warning[probe-feed-too-high]
        G37 F no number: error[address-without-value]
        G37 F unknown: 
        G136 Y missing: error[word-choice-missing]
        G136 Y doubled: warning[word-given-twice]
        G136 Y negative: warning[touches-do-not-meet]
        G136 Y zero: warning[probe-goes-nowhere]
        G136 Y huge: 
        G136 Y no number: error[address-without-value]
        G136 Y unknown: 
        G136 I missing: 
        G136 I doubled: warning[word-given-twice]
        G136 I negative: warning[shift-of-axis-not-probed]
        G136 I zero: 
        G136 I huge: warning[shift-of-axis-not-probed]
        G136 I no number: error[address-without-value]
        G136 I unknown: warning[shift-of-axis-not-probed]
        G136 F missing: error[required-word-missing]
        G136 F doubled: warning[word-given-twice]
        G136 F negative: error[sign-not-accepted]
        G136 F zero: error[number-out-of-range]
        G136 F huge: warning[probe-feed-too-high]
        G136 F no number: error[address-without-value]
        G136 F unknown: 
    "#]]
    .assert_eq(&table);
}

#[test]
fn a_mistake_is_found_wherever_its_block_stands() {
    let places = [
        "O1\nG20\nM97 P100\nM30\nN100 G91\nBLOCK\nG90\nM99\n",
        "O1\nG20 G91\n/BLOCK\nG90\nM30\n",
        "O1\nG20 G91\n#1 = 0\nWHILE [#1 LT 5] DO1\nBLOCK\n#1 = #1 + 1\nEND1\nG90\nM30\n",
        "O1\nG20 G91\nIF [#100 EQ 1] GOTO10\nBLOCK\nN10 G90\nM30\n",
    ];
    let mistakes = [
        ("G36 Y-1. F150.", "warning[probe-feed-too-high]"),
        ("G136 Y-1. F10.", "error[first-touch-missing]"),
        ("G49 G37 H1 Z0. F10.", "error[probing-in-wrong-mode]"),
        ("G31 Y0. F10. M79", "warning[probe-goes-nowhere]"),
        ("G36 Y-1. I2. F10.", "warning[shift-of-axis-not-probed]"),
    ];
    for place in places {
        for (block, finding) in mistakes {
            let text = place.replace("BLOCK", block);
            let found = crate::product::check(&on(MILL, text.clone().leak()));
            assert_eq!(found.iter().filter(|one| *one == finding).count(), 1, "{found:?} in\n{text}");
        }
    }
}
