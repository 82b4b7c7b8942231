//! G143, 5-axis tool length compensation: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::{Program, Proof, legal, noticed, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

/// A program for the mill of the page.
const fn mill(text: &'static str) -> Program {
    on("haas-mill", text)
}

/// The offset of tool 1 holds 4 inches.
const FOUR: &[&str] = &["tools.1.length=4.0"];

/// Offsets of two tools.
const TWO: &[&str] = &["tools.1.length=4.0", "tools.2.length=5.0"];

const UPRIGHT: &str = "\
%
O0143
T1 M06
G00 G90 G54 X0. Y0. Z1. A0. B0.
G143 H01 X0. Y0. Z1. A0. B0.
G49
M30
%
";

/// The page's example in numbers of our own.
const EXAMPLE: &str = "\
%
O0143
T1 M06
G00 G90 G54 X0. Y0. Z2. A0. B0. S8000 M03
G143 H01 X0. Y0. Z1. A-20. B-20.
G01 G93 X0.015 Y0.01 Z0.98 A-19.8 B-19.9 F250.
X0.03 Y0.03 Z0.97 A-19.6 B-19.7 F250.
X1.8 Y0.2 Z0.5 A-6.2 B-11.4 F180.
G94 F40.
G00 G90 G49 Z5.
X0. Y0.
M30
%
";

pub(crate) const SYSTEM: System = System {
    title: "G143, 5-axis tool length compensation",
    key: "G143",
    source: "Haas 96-8000 rev AC, May 2010, p. 184",
    module: "length_5_axis",
    sentences: &[
        Sentence {
            says: "The code is an option, for machines on which every rotary axis moves the tool.",
            literal: By(&[
                Proof::Rule {
                    finding: "error[five-axis-length-on-another-machine]",
                    violates: mill(EXAMPLE).with(&["machine.rotary=\"table-table\""]),
                    conforms: mill(EXAMPLE).with(&["machine.rotary=\"head-head\""]),
                },
                Proof::Explains {
                    control: "haas-mill",
                    code: "G143",
                    says: "needs the option: 5-axis compensation, machines on which both rotary axes move the tool",
                },
]),
computed: By(&[
rule("error[five-axis-length-on-another-machine]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["machine.rotary=\"table-table\""]), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["machine.rotary=\"head-head\""])),
]),
lasting: No("no word"),
missing: No("no word"),
extra: No("no word"),
range: No("no range"),

        },
        Sentence {
            says: "It corrects for another length of the tool without a new run of the CAM system.",
            literal: By(&[
                Proof::Run {
                    program: mill(EXAMPLE).with(FOUR),
                    prints: &[
                        "posted point X0 Y0 Z1, axes at X-1.3681 Y1.2856 Z4.5321",
                        "posted point X0.015 Y0.01 Z0.98, axes at X-1.3465 Y1.284 Z4.5188",
                    ],
                },
                Proof::Explains { control: "haas-mill", code: "G143", says: "nothing is posted again" },
]),
computed: By(&[
same(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=-20.\nG143 H1 X0. Y0. Z1. A#1 B#1\nG49\nM30\n").with(FOUR), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR)),
]),
lasting: No("see G143-3"),
missing: No("see G143-3"),
extra: By(&[
noticed("info", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20. Q1.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
range: No("see G143-3"),

        },
        Sentence {
            says: "An H is required: it selects the length in the table of offsets.",
            literal: By(&[
                Proof::Run {
                    program: mill(UPRIGHT).with(FOUR),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z5"],
                },
                Proof::Assumes { program: mill(EXAMPLE), says: "the length of tool 1 is not known" },
]),
computed: By(&[
same(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR)),
rule("error[five-axis-length-without-offset]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=0\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
rule("info[computed-value-out-of-range]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1.5\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
same(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1.5\nG143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(TWO), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H2 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(TWO)),
rule("warning[five-axis-length-without-offset]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nIF [#500 EQ 1] GOTO 10\n#1=0\nN10 G143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=1\nIF [#500 EQ 1] GOTO 10\n#1=1\nN10 G143 H#1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
lasting: By(&[
rule("warning[five-axis-length-without-offset]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nH0\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nH1\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
same(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nH1\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR)),
same(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG43 H1 Z2.\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG43 H1 Z2.\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR)),
rule("warning[five-axis-length-without-offset]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nH00\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nH00\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "error[five-axis-length-without-offset]",
                    violates: mill("T1 M6\nG0 G90 G54 X0. Y0. Z1. A0. B0.\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
]),
extra: By(&[
rule("warning[word-given-twice]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 H2 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
range: By(&[
                Proof::Rule {
                    finding: "error[five-axis-length-without-offset]",
                    violates: mill("T1 M6\nG0 G90 G54 X0. Y0. Z1. A0. B0.\nG143 H00 X0. Y0. Z1. A-20. B-20.\nM30\n"),
                    conforms: mill("T1 M6\nG0 G90 G54 X0. Y0. A0. B0.\nG43 H1 Z1.\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"),
                },
noticed("error", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1.5 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
noticed("error", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H-1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),

        },
        Sentence {
            says: "G49 or H00 cancels it.",
            literal: By(&[
                Proof::Run {
                    program: mill("G20 G90 G54\nG143 H1 X1. Y1. Z1. A0. B90.\nG49 G0 X1. Y1. Z1.\nG143 H1 X1. Y1. Z1. A0. B90.\nH00 X1. Y1. Z1.\nM30\n")
                        .with(FOUR),
                    prints: &[
                        "rapid 5.0000 1.0000 1.0000",
                        "rapid 1.0000 1.0000 1.0000",
                        "rapid 5.0000 1.0000 1.0000",
                        "rapid 1.0000 1.0000 1.0000",
                    ],
                },
]),
computed: By(&[
rule("warning[five-axis-length-left-on]", mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\n#1=1\nH#1\nG28\nG49\nM30\n"), mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\n#1=0\nH#1\nG28\nM30\n")),
]),
lasting: By(&[
rule("info[five-axis-length-left-on]", mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nIF [#500 EQ 1] GOTO 10\nG49\nN10 T2 M6\nG43 H2 Z1.\nM30\n"), mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nIF [#500 EQ 1] GOTO 10\nG0 X0. Y0. Z2. A0. B0.\nN10 G49\nT2 M6\nG43 H2 Z1.\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "warning[five-axis-length-left-on]",
                    violates: mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nT2 M6\nG43 H2 Z1.\nM30\n"),
                    conforms: mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nG49\nT2 M6\nG43 H2 Z1.\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[five-axis-length-left-on]",
                    violates: mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nG28\nG49\nM30\n"),
                    conforms: mill("T1 M6\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nH00\nG28\nM30\n"),
                },
]),
extra: No("no other word"),
range: No("see G143-3"),

        },
        Sentence {
            says: "The machine must have two rotary axes, A and B.",
            literal: By(&[
legal(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"B\"]"])),
]),
computed: By(&[
rule("error[five-axis-length-on-another-machine]", mill("#1=1\nG90 G143 H#1 X0. Y0. Z1. A0.\nG49\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]), mill("#1=1\nG90 G143 H#1 X0. Y0. Z1. A0. B0.\nG49\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"B\"]"])),
]),
lasting: No("no word"),
missing: By(&[
Proof::Rule {
                finding: "error[five-axis-length-on-another-machine]",
                violates: mill("G90 G143 H1 X0. Y0. Z1. A0.\nG49\nM30\n")
                    .with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
                conforms: mill(EXAMPLE).with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"B\"]"]),
            },
]),
extra: By(&[
rule("error[axis-not-on-machine]", mill("G90 G143 H1 X0. Y0. Z1. A0. B0. C5.\nG49\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"B\"]"]), mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"B\"]"])),
]),
range: No("no range"),

        },
        Sentence {
            says: "Absolute positioning (G90) must be active; G91 cannot be used.",
            literal: By(&[
legal(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
computed: By(&[
rule("error[five-axis-length-in-incremental]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=91\nG#1 G0 X1. Y0. Z1. A0. B0.\nG90\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=90\nG#1 G0 X1. Y0. Z1. A0. B0.\nG49\nM30\n")),
]),
lasting: By(&[
                Proof::Rule {
                    finding: "error[five-axis-length-in-incremental]",
                    violates: mill("G91\nG143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n"),
                    conforms: mill("G91\nG90 G143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[maybe-five-axis-length-in-incremental]",
                    violates: mill("G90\nIF [#500 EQ 1] GOTO 10\nG91\nN10 G143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n"),
                    conforms: mill("G90\nIF [#500 EQ 1] GOTO 10\nG91\nN10 G90 G143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n"),
                },
]),
missing: No("no word"),
extra: By(&[
                Proof::Rule {
                    finding: "error[five-axis-length-in-incremental]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG91 G0 Z1.\nG90 G49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
rule("error[two-codes-of-one-group]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG90 G91 G143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "Where the work positions of A and B read zero, the tool must be parallel to the motion of Z.",
            literal: By(&[
run(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n").with(FOUR), &["posted point X0 Y0 Z1, axes at X0 Y0 Z5"]),
]),
computed: By(&[
rule("warning[five-axis-zero-not-upright]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\n#1=3.5\nG10 L2 P1 B#1\nG54\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["offsets.G54={ X = 1.0, A = 0.0, B = 0.0 }"]), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["offsets.G54={ X = 1.0, A = 0.0, B = 0.0 }"])),
]),
lasting: By(&[
rule("warning[five-axis-zero-not-upright]", mill("O1\nG20 G90\nT1 M6\nG0 G55 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["offsets.G55={ A = 0.0, B = 3.5 }"]), mill("O1\nG20 G90\nT1 M6\nG0 G55 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(&["offsets.G55={ A = 0.0, B = 0.0 }"])),
]),
missing: By(&[
                Proof::Assumes {
                    program: mill(EXAMPLE),
                    says: "the tool is parallel to Z where the work positions of A and B are zero",
                },
]),
extra: No("no other word"),
range: By(&[
                Proof::Rule {
                    finding: "warning[five-axis-zero-not-upright]",
                    violates: mill(EXAMPLE).with(&["offsets.G54={ X = 1.0, A = 0.0, B = 3.5 }"]),
                    conforms: mill(EXAMPLE).with(&["offsets.G54={ X = 1.0, A = 0.0, B = 0.0 }"]),
                },
]),

        },
        Sentence {
            says: "It makes up for the difference in length between the tool that the program was posted for and another one.",
            literal: By(&[
                Proof::Run {
                    program: mill(EXAMPLE).with(&["tools.1.length=0.0"]),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z1"],
                },
                Proof::Run {
                    program: mill(EXAMPLE).with(&[
                        "tools.1.length=4.0",
                        "tools.1.posted_length=6.0",
                        "machine.pivot_length=10.0",
                    ]),
                    prints: &["posted point X0 Y0 Z1, axes at X-1.3681 Y1.2856 Z4.5321, tip at X5.4723 Y-5.1423 Z2.8716"],
                },
                Proof::Explains {
                    control: "haas-mill",
                    code: "G143",
                    says: "length offset: this tool less the posted one",
                },
]),
computed: By(&[
run(mill("O1\nG20 G90\n#1=4.\nG10 L10 P1 R#1\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), &["posted point X0 Y0 Z1, axes at X-1.3681 Y1.2856 Z4.5321"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG0 X0. Y0. Z1. A0. B0.\nG49\nM30\n").with(FOUR), &["axes at X-1.3681 Y1.2856 Z4.5321", "axes at X0 Y0 Z5"]),
]),
missing: By(&[
Proof::Assumes { program: mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"), says: "the length of tool 1 is not known" },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "Only rapid (G00) and straight feed (G01) moves work: no G02 or G03, no canned cycles.",
            literal: By(&[
legal(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F20.\nG94 F20.\nG49\nM30\n")),
]),
computed: By(&[
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=3\nG#1 X1. Y1. R1. F20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=1\nG93 G#1 X1. Y1. Z1. A0. B0. F20.\nG94\nG49\nM30\n")),
]),
lasting: By(&[
                Proof::Rule {
                    finding: "warning[maybe-refused-in-five-axis-mode]",
                    violates: mill("G90 G0 X0. Y0. Z1. A0. B0.\nIF [#500 EQ 1] GOTO 10\nG143 H1 X0. Y0. Z1. A0. B0.\nN10 G2 X1. Y1. R1. F20.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG2 X1. Y1. R1. F20.\nG143 H1\nX2. Y2. R1.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG2 X1. Y1. R1. F20.\nG143 H1 G0 X1. Y1. Z1. A0. B0.\nG49\nM30\n")),
]),
missing: No("no word"),
extra: By(&[
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG02 X1. Y1. R1. F20.\nG49\nM30\n"),
                    conforms: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG49\nG02 X1. Y1. R1. F20.\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG84 X1. Y1. Z-1. R0.1 F20.\nG80\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG13 I0.5 D1 Z-0.1 F20.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG83 X1. Y1. Z-1. R0.1 Q0.2 F20.\nG80\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nM5\nG31 Y-1. F10. M79\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
noticed("error", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG12 I0.5 D1 Z-0.1 F20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
noticed("error", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG70 I1. J0. L6\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
noticed("error", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG49\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "A positive length moves Z upward, in the + direction.",
            literal: By(&[
                Proof::Run {
                    program: mill(UPRIGHT).with(FOUR),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z5"],
                },
                Proof::Run {
                    program: mill(UPRIGHT).with(&["tools.1.length=-0.5"]),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z0.5"],
                },
]),
computed: By(&[
run(mill("O1\nG20 G90\n#1=-0.5\nG10 L10 P1 R#1\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nG143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n"), &["posted point X0 Y0 Z1, axes at X0 Y0 Z0.5"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nG0 X1. Y0. Z3. A0. B0.\nG49\nM30\n").with(FOUR), &["axes at X1 Y0 Z7"]),
]),
missing: No("see G143-11"),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "X, Y or Z that a block leaves out does not move, even if A or B turn the length elsewhere.",
            literal: By(&[
legal(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG0 X0. Y0. Z1. A90. B0.\nG49\nM30\n")),
]),
computed: By(&[
rule("warning[five-axis-axis-left-out]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=90.\nG0 X0. A#1 B0.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=90.\nG0 X0. Y0. Z1. A#1 B0.\nG49\nM30\n")),
rule("warning[five-axis-axis-left-out]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=90.\nG0 X0. Y0. A#1 B0.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=90.\nG0 X0. Y0. Z[#1/90.] A#1 B0.\nG49\nM30\n")),
]),
lasting: By(&[
rule("warning[five-axis-axis-left-out]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nG93 G1 X0. Y0. A-5. B-5. F50.\nG94 F20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nG93 G1 X0. Y0. Z1. A-5. B-5. F50.\nG94 F20.\nG49\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "warning[five-axis-axis-left-out]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG0 X0. A90. B0.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
                Proof::Run {
                    program: mill("G20 G90 G143 H1 X0. Y0. Z1. A0. B0.\nG0 X0. A90. B0.\nG0 X0. Y0. Z1. A90. B0.\nG49\nM30\n")
                        .with(FOUR),
                    prints: &[
                        "rapid 0.0000 0.0000 5.0000 0.0000 0.0000",
                        "rapid 0.0000 0.0000 5.0000 90.0000 0.0000",
                        "rapid 0.0000 -4.0000 1.0000 90.0000 0.0000",
                    ],
                },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "A block of a typical program names all five axes.",
            literal: By(&[
                Proof::Legal { program: mill(EXAMPLE) },
                Proof::Explains { control: "haas-mill", code: "G143", says: "write all five words" },
]),
computed: By(&[
legal(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=-20.\nG143 H1 X[#1+20.] Y0. Z1. A#1 B#1\nG49\nM30\n")),
]),
lasting: No("see G143-11"),
missing: No("see G143-11"),
extra: No("see G143-2"),
range: No("no range"),

        },
        Sentence {
            says: "The code may move every axis, to make up for A and B.",
            literal: By(&[
Proof::Run {
                program: mill(EXAMPLE).with(FOUR),
                prints: &["rapid -1.3681 1.2856 4.5321 -20.0000 -20.0000"],
            },
]),
computed: By(&[
run(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=-20.\nG143 H1 X0. Y0. Z1. A#1 B#1\nG49\nM30\n").with(FOUR), &["rapid -1.3681 1.2856 4.5321 -20.0000 -20.0000"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A0. B0.\nG0 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n").with(FOUR), &["rapid -1.3681 1.2856 4.5321 -20.0000 -20.0000"]),
]),
missing: No("see G143-11"),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "Inverse time feed (G93) is recommended.",
            literal: By(&[
                Proof::Rule {
                    finding: "warning[five-axis-feed-per-minute]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG94 G1 X1. Y0. Z0. A1. B1. F20.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
                Proof::Explains { control: "haas-mill", code: "G143", says: "recommends: G93" },
                Proof::Run {
                    program: mill(EXAMPLE).with(FOUR),
                    prints: &["250 0.240 inverse time"],
                },
]),
computed: By(&[
same(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\n#1=250.\nG93 G1 X1. Y0. Z1. A-10. B-10. F#1\nG94 F20.\nG49\nM30\n").with(FOUR), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nG94 F20.\nG49\nM30\n").with(FOUR)),
]),
lasting: By(&[
rule("error[inverse-time-feed-missing]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nX2. Y0. Z1. A-9. B-9.\nG94 F20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nX2. Y0. Z1. A-9. B-9. F250.\nG94 F20.\nG49\nM30\n")),
rule("warning[five-axis-feed-per-minute]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nF20.\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG1 X1. Y0. Z1. A-10. B-10.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nG94 F20.\nG49\nM30\n")),
]),
missing: By(&[
rule("error[inverse-time-feed-missing]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10.\nG94 F20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nG94 F20.\nG49\nM30\n")),
]),
extra: No("no other word"),
range: By(&[
rule("error[feed-zero]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F0.\nG94 F20.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nG94 F20.\nG49\nM30\n")),
]),

        },
        Sentence {
            says: "The example: approach under G143, feed moves in inverse time with F in each, back to G94 with a new F, away with G49.",
            literal: By(&[
                Proof::Legal { program: mill(EXAMPLE) },
                Proof::Legal { program: mill(EXAMPLE).with(FOUR) },
                Proof::Run {
                    program: mill(EXAMPLE).with(FOUR),
                    prints: &["posted point X1.8 Y0.2 Z0.5, axes at X1.0094 Y0.6235 Z4.3982", "1.0094 0.6235 5.0000"],
                },
]),
computed: By(&[
legal(mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\n#1=-20.\nG143 H1 X0. Y0. Z1. A#1 B#1\nG93 G1 X1. Y0. Z1. A[#1+10.] B#1 F250.\nG94 F20.\nG49\nM30\n")),
]),
lasting: By(&[
rule("warning[feed-of-another-mode]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nG94\nG49\nG1 X2.\nG49\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG93 G1 X1. Y0. Z1. A-10. B-10. F250.\nG94\nG49\nG1 X2. F20.\nG49\nM30\n")),
]),
missing: By(&[
rule("warning[five-axis-length-left-on]", mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nT2 M6\nG43 H2 Z1.\nM30\n"), mill("O1\nG20 G90\nT1 M6\nG0 G54 X0. Y0. Z2. A0. B0.\nS900 M3\nG143 H1 X0. Y0. Z1. A-20. B-20.\nG49\nT2 M6\nG43 H2 Z1.\nM30\n")),
]),
extra: No("no other word"),
range: No("no range"),

        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
