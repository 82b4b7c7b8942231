//! G141, 3D+ cutter compensation: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::{Program, Proof, on};
use crate::seeds::sentence::{Sentence, System, prove};

/// A program for the mill of the page.
const fn mill(text: &'static str) -> Program {
    on("haas-mill", text)
}

/// A cutter of half an inch.
const HALF: &[&str] = &["tools.1.diameter=0.5"];

/// The page's forms of a block: with the code, then `G01` and `G00` without it.
const FORMS: &str = "\
%
O0141
T1 M06
G00 G90 G54 X0. Y0. S9000 M03
G43 H01 Z1.
G01 G141 X1. Y0.2 Z0.5 I0. J0.6 K0.8 F20. D01
G01 X2. Y0.3 Z0.4 I0. J0. K1. F25.
G00 X2. Y0.3 Z2. I0. J0. K1.
G40
G49 G53 G00 Z0.
M30
%
";

const INVERSE_TIME: &str = "\
G90 G93 G01 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.
X2. Y0. Z0. I0. J0. K1. F60.
G94 F20.
G40
M30
";

pub(crate) const SYSTEM: System = System {
    title: "G141, 3D+ cutter compensation",
    key: "G141",
    source: "Haas 96-8000 rev R, June 2007, p. 153",
    module: "cutter_3d",
    sentences: &[
        Sentence {
            says: "X, Y and Z are the point of the block; A and B may be given too.",
            proofs: &[
                Proof::Run {
                    program: mill(FORMS).with(HALF),
                    prints: &["programmed point X1 Y0.2 Z0.5, axes at X1 Y0.35 Z0.7"],
                },
                Proof::Run {
                    program: mill("G90 G1 G141 D1 X1. Y0. Z0. A10. B-5. I0. J0. K1. F20.\nG40\nM30\n").with(HALF),
                    prints: &["feed 1.0000 0.0000 0.2500 10.0000 -5.0000"],
                },
            ],
        },
        Sentence {
            says: "D selects the size of the cutter and stays in effect.",
            proofs: &[
                Proof::Rule {
                    finding: "error[cutter-vector-without-size]",
                    violates: mill("G90 G1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nG1 G141 X2. Y0. Z0. I0. J0. K1.\nG40\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[cutter-vector-without-size]",
                    violates: mill("G90 G1 G141 D0 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nD2 X3. I0. J0. K1.\nG40\nM30\n")
                        .with(&["tools.1.diameter=0.5", "tools.2.diameter=1.0"]),
                    prints: &["axes at X1 Y0 Z0.25", "axes at X2 Y0 Z0.25", "axes at X3 Y0 Z0.5"],
                },
                Proof::Assumes { program: mill(FORMS), says: "the diameter of tool 1 is not known" },
            ],
        },
        Sentence {
            says: "The word table calls I, J and K depths of pecks; the text makes them the direction of the compensation.",
            proofs: &[Proof::Explains {
                control: "haas-mill",
                code: "G141",
                says: "The 2007 manual's word table explains I, J, K as peck depths; its text is right.",
            }],
        },
        Sentence {
            says: "F is the feed under G93 or G94; under G94 it stays in effect.",
            proofs: &[
                Proof::Legal { program: mill("G90 G94 G01 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nG40\nM30\n") },
                Proof::Legal { program: mill(INVERSE_TIME) },
            ],
        },
        Sentence {
            says: "The form: G141 with X Y Z, I J K, F and D; then G01 with X Y Z, I J K, F, or G00 with X Y Z, I J K.",
            proofs: &[
                Proof::Legal { program: mill(FORMS) },
                Proof::Run {
                    program: mill(FORMS).with(HALF),
                    prints: &[
                        "feed 1.0000 0.3500 0.7000 20",
                        "feed 2.0000 0.3000 0.6500 25",
                        "rapid 2.0000 0.3000 2.2500",
                    ],
                },
            ],
        },
        Sentence {
            says: "I, J and K give the direction of the compensation: between the centre of the tool and its contact point.",
            proofs: &[
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y1. Z1. I1. J0. K0. F20.\nX1. Y1. Z1. I0. J-1. K0.\nX1. Y1. Z1. I0. J0. K1.\nG40\nM30\n")
                        .with(HALF),
                    prints: &["axes at X1.25 Y1 Z1", "axes at X1 Y0.75 Z1", "axes at X1 Y1 Z1.25"],
                },
                Proof::Explains {
                    control: "haas-mill",
                    code: "G141",
                    says: "X part of the unit vector between tool centre and contact point",
                },
            ],
        },
        Sentence {
            says: "The control needs the vector to shift the path in the right direction.",
            proofs: &[
                Proof::Rule {
                    finding: "warning[cutter-vector-incomplete]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Rule {
                    finding: "warning[cutter-vector-incomplete]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.6 K0.8 F20.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y1. Z1. I0. J0. K1. F20.\nX2. Y1. Z1.\nG40\nM30\n").with(HALF),
                    prints: &["programmed point X2 Y1 Z1, axes at X? Y? Z?"],
                },
            ],
        },
        Sentence {
            says: "The compensation may be positive or negative.",
            proofs: &[Proof::Run {
                program: mill(FORMS).with(&["tools.1.diameter=-0.5"]),
                prints: &["programmed point X1 Y0.2 Z0.5, axes at X1 Y0.05 Z0.3"],
            }],
        },
        Sentence {
            says: "The offset is entered as radius or diameter (Setting 40), and the path is compensated by it.",
            proofs: &[
                Proof::Run {
                    program: mill("G20 G90 G10 L12 P1 R0.5\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")
                        .with(&["settings.40=\"radius\""]),
                    prints: &["axes at X1 Y0 Z0.5"],
                },
                Proof::Run {
                    program: mill("G20 G90 G10 L12 P1 R0.5\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")
                        .with(&["settings.40=\"diameter\""]),
                    prints: &["axes at X1 Y0 Z0.25"],
                },
            ],
        },
        Sentence {
            says: "The whole amount counts, though a move is one of two or three axes.",
            proofs: &[Proof::Run {
                program: mill("G20 G90 G1 G141 D1 X1. Y1. Z1. I0. J0. K1. F20.\nX2. Y2. I0. J0.6 K0.8\nX3. I0. J0.6 K0.8\nG40\nM30\n")
                    .with(HALF),
                prints: &[
                    "programmed point X2 Y2 Z1, axes at X2 Y2.15 Z1.2",
                    "programmed point X3 Y2 Z1, axes at X3 Y2.15 Z1.2",
                ],
            }],
        },
        Sentence {
            says: "Only G00 and G01 can be used with G141.",
            proofs: &[
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG3 X2. Y1. R1.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG81 X1. Z-1. R0.1\nG80\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Rule {
                    finding: "warning[refused-in-five-axis-mode]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG41 D1 X2.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
            ],
        },
        Sentence {
            says: "D chooses which offset is used.",
            proofs: &[Proof::Run {
                program: mill("G20 G90 G1 G141 D2 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")
                    .with(&["tools.1.diameter=0.5", "tools.2.diameter=1.0"]),
                prints: &["axes at X1 Y0 Z0.5"],
            }],
        },
        Sentence {
            says: "Under G93 a feed is required in each block.",
            proofs: &[Proof::Rule {
                finding: "error[inverse-time-feed-missing]",
                violates: mill("G90 G93 G01 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nX2. I0. J0. K1.\nG40\nM30\n"),
                conforms: mill(INVERSE_TIME),
            }],
        },
        Sentence {
            says: "The vector is a unit vector: I² + J² + K² must equal 1.",
            proofs: &[
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.5 J0.5 K0.5 F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.5774 J0.5774 K0.5774 F20.\nG40\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.580 J0.580 K0.580 F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.58 J0.58 K0.58 F20.\nG40\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("#1=0.9\nG90 G1 G141 D1 X1. Y0. Z0. I#1 J#1 K0. F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I#501 J#502 K0. F20.\nG40\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("G21 G90 G1 G141 D1 X1. Y0. Z0. I0 J0 K1 F20.\nG40\nM30\n"),
                    conforms: mill("G21 G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"),
                },
                Proof::Run {
                    program: mill("G21 G90 G1 G141 D1 X1. Y0. Z0. I0. J0.6 K0.8 F20.\nG40\nM30\n")
                        .with(&["machine.units=\"mm\"", "tools.1.diameter=10.0"]),
                    prints: &["axes at X1 Y3 Z4"],
                },
            ],
        },
        Sentence {
            says: "The modal group of cutter compensation (07) holds it until G40; it is not to be left on.",
            proofs: &[
                Proof::Rule {
                    finding: "warning[compensation-left-on]",
                    violates: mill("T1 M6\nG90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nT2 M6\nG40\nM30\n"),
                    conforms: mill("T1 M6\nG90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nT2 M6\nM30\n"),
                },
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nG0 X0. Y0. Z3.\nM30\n").with(HALF),
                    prints: &["feed 1.0000 0.0000 0.2500", "rapid 0.0000 0.0000 3.0000"],
                },
            ],
        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
