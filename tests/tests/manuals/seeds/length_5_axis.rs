//! G143, 5-axis tool length compensation: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::{Program, Proof, on};
use crate::seeds::sentence::{Sentence, System, prove};

/// A program for the mill of the page.
const fn mill(text: &'static str) -> Program {
    on("haas-mill", text)
}

/// The offset of tool 1 holds 4 inches.
const FOUR: &[&str] = &["tools.1.length=4.0"];

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
            proofs: &[
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
            ],
        },
        Sentence {
            says: "It corrects for another length of the tool without a new run of the CAM system.",
            proofs: &[
                Proof::Run {
                    program: mill(EXAMPLE).with(FOUR),
                    prints: &[
                        "posted point X0 Y0 Z1, axes at X-1.3681 Y1.2856 Z4.5321",
                        "posted point X0.015 Y0.01 Z0.98, axes at X-1.3465 Y1.284 Z4.5188",
                    ],
                },
                Proof::Explains { control: "haas-mill", code: "G143", says: "nothing is posted again" },
            ],
        },
        Sentence {
            says: "An H is required: it selects the length in the table of offsets.",
            proofs: &[
                Proof::Rule {
                    finding: "error[five-axis-length-without-offset]",
                    violates: mill("T1 M6\nG0 G90 G54 X0. Y0. Z1. A0. B0.\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
                Proof::Rule {
                    finding: "error[five-axis-length-without-offset]",
                    violates: mill("T1 M6\nG0 G90 G54 X0. Y0. Z1. A0. B0.\nG143 H00 X0. Y0. Z1. A-20. B-20.\nM30\n"),
                    conforms: mill("T1 M6\nG0 G90 G54 X0. Y0. A0. B0.\nG43 H1 Z1.\nG143 X0. Y0. Z1. A-20. B-20.\nG49\nM30\n"),
                },
                Proof::Run {
                    program: mill(UPRIGHT).with(FOUR),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z5"],
                },
                Proof::Assumes { program: mill(EXAMPLE), says: "the length of tool 1 is not known" },
            ],
        },
        Sentence {
            says: "G49 or H00 cancels it.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "The machine must have two rotary axes, A and B.",
            proofs: &[Proof::Rule {
                finding: "error[five-axis-length-on-another-machine]",
                violates: mill("G90 G143 H1 X0. Y0. Z1. A0.\nG49\nM30\n")
                    .with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
                conforms: mill(EXAMPLE).with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\", \"B\"]"]),
            }],
        },
        Sentence {
            says: "Absolute positioning (G90) must be active; G91 cannot be used.",
            proofs: &[
                Proof::Rule {
                    finding: "error[five-axis-length-in-incremental]",
                    violates: mill("G90 G143 H1 X0. Y0. Z1. A0. B0.\nG91 G0 Z1.\nG90 G49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
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
            ],
        },
        Sentence {
            says: "Where the work positions of A and B read zero, the tool must be parallel to the motion of Z.",
            proofs: &[
                Proof::Assumes {
                    program: mill(EXAMPLE),
                    says: "the tool is parallel to Z where the work positions of A and B are zero",
                },
                Proof::Rule {
                    finding: "warning[five-axis-zero-not-upright]",
                    violates: mill(EXAMPLE).with(&["offsets.G54={ X = 1.0, A = 0.0, B = 3.5 }"]),
                    conforms: mill(EXAMPLE).with(&["offsets.G54={ X = 1.0, A = 0.0, B = 0.0 }"]),
                },
            ],
        },
        Sentence {
            says: "It makes up for the difference in length between the tool that the program was posted for and another one.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "Only rapid (G00) and straight feed (G01) moves work: no G02 or G03, no canned cycles.",
            proofs: &[
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
                Proof::Rule {
                    finding: "warning[maybe-refused-in-five-axis-mode]",
                    violates: mill("G90 G0 X0. Y0. Z1. A0. B0.\nIF [#500 EQ 1] GOTO 10\nG143 H1 X0. Y0. Z1. A0. B0.\nN10 G2 X1. Y1. R1. F20.\nG49\nM30\n"),
                    conforms: mill(EXAMPLE),
                },
            ],
        },
        Sentence {
            says: "A positive length moves Z upward, in the + direction.",
            proofs: &[
                Proof::Run {
                    program: mill(UPRIGHT).with(FOUR),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z5"],
                },
                Proof::Run {
                    program: mill(UPRIGHT).with(&["tools.1.length=-0.5"]),
                    prints: &["posted point X0 Y0 Z1, axes at X0 Y0 Z0.5"],
                },
            ],
        },
        Sentence {
            says: "X, Y or Z that a block leaves out does not move, even if A or B turn the length elsewhere.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "A block of a typical program names all five axes.",
            proofs: &[
                Proof::Legal { program: mill(EXAMPLE) },
                Proof::Explains { control: "haas-mill", code: "G143", says: "write all five words" },
            ],
        },
        Sentence {
            says: "The code may move every axis, to make up for A and B.",
            proofs: &[Proof::Run {
                program: mill(EXAMPLE).with(FOUR),
                prints: &["rapid -1.3681 1.2856 4.5321 -20.0000 -20.0000"],
            }],
        },
        Sentence {
            says: "Inverse time feed (G93) is recommended.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "The example: approach under G143, feed moves in inverse time with F in each, back to G94 with a new F, away with G49.",
            proofs: &[
                Proof::Legal { program: mill(EXAMPLE) },
                Proof::Legal { program: mill(EXAMPLE).with(FOUR) },
                Proof::Run {
                    program: mill(EXAMPLE).with(FOUR),
                    prints: &["posted point X1.8 Y0.2 Z0.5, axes at X1.0094 Y0.6235 Z4.3982", "1.0094 0.6235 5.0000"],
                },
            ],
        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
