//! G150, general purpose pocket milling: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::Proof::{Assumes, Explains, Legal, Rule, Run, Stats};
use crate::proof::{Program, on};
use crate::seeds::sentence::{Sentence, System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G150, general purpose pocket milling",
    key: "G150",
    source: "Haas 96-8000 rev AC, May 2010, p. 184; June 1999, p. 208",
    module: "pockets",
    sentences: SENTENCES,
};

const CONTROL: &str = "haas-mill";

/// A pocket as a machinist writes it: hole drilled, end mill, compensation, outline.
const POCKET: &str = "\
%
O00082 (POCKET)
(T1 - 7/16 DRILL)
(T2 - 3/8 END MILL)
G20 G17 G40 G49 G80 G90
T1 M6
G0 G54 X0. Y0. S1800 M3
G43 H1 Z0.5 M8
G83 Z-0.375 R0.1 Q0.1 F6.
G80 M9
T2 M6
G0 G54 X0. Y0. S4200 M3
G43 H2 Z0.5 M8
G150 P83 G41 D2 X0. Y0. Z-0.375 Q0.125 R0.1 J0.2 K0.015 F18.
G40 G1 X0. Y0.
G0 Z0.5 M9
M5
G91 G28 Z0.
G90
M30
O00083 (OUTLINE)
G1 Y0.75
X-1.
G3 X-1.25 Y0.5 J-0.25
G1 Y-0.5
G3 X-1. Y-0.75 I0.25
G1 X1.
G3 X1.25 Y-0.5 J0.25
G1 Y0.5
G3 X1. Y0.75 I-0.25
G1 X0.
M99
%
";

const fn pocket(text: &'static str) -> Program {
    on(CONTROL, text)
}

const SENTENCES: &[Sentence] = &[
    Sentence {
        says: "Clears a pocket of any outline; the start hole is drilled before",
        proofs: &[
            Legal { program: on(CONTROL, POCKET) },
            Explains { control: CONTROL, code: "G150", says: "Drill the start hole first" },
        ],
    },
    Sentence {
        says: "D selects the offset of the tool's size, for cutter compensation on the outline",
        proofs: &[
            Rule {
                finding: "info[pocket-without-compensation]",
                violates: pocket(
                    "G20 G54 G90 G0 X0. Y0.\nG150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
                ),
                conforms: pocket(
                    "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
                ),
            },
            Assumes { program: on(CONTROL, POCKET), says: "the diameter of tool 2 is not known" },
        ],
    },
    Sentence {
        says: "G41 or G42 belongs to it and is cancelled by G40",
        proofs: &[Rule {
            finding: "warning[compensation-left-on]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG0 X.1\nT2 M6\nG40\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X.1\nT2 M6\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        }],
    },
    Sentence {
        says: "F is the feed",
        proofs: &[Rule {
            finding: "error[feed-missing]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2\nG40 X.1\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X.1\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        }],
    },
    Sentence {
        says: "I is the step in X, J the step in Y: exactly one of them",
        proofs: &[
            Rule {
                finding: "error[words-exclude-each-other]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 J.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
            },
            Rule {
                finding: "error[word-choice-missing]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 J.2 F10.\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "I and J are positive",
        proofs: &[
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I-.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
            },
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 J0. F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 J#1 F10.\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "A step above the tool's diameter leaves ridges",
        proofs: &[Rule {
            finding: "warning[pocket-step-above-tool]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.6 F10.\nG40 X0.\nM30\n",
            )
            .with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"]),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.4 F10.\nG40 X0.\nM30\n",
            )
            .with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"]),
        }],
    },
    Sentence {
        says: "K is the width of the finishing pass on the wall, not below zero; the floor has none",
        proofs: &[
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K-.01 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K.01 F10.\nM30\n"),
            },
            Explains { control: CONTROL, code: "G150", says: "The floor gets no finishing pass" },
        ],
    },
    Sentence {
        says: "P names the program that holds the outline",
        proofs: &[
            Rule {
                finding: "error[required-word-missing]",
                violates: pocket("G150 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
            },
            Assumes {
                program: pocket(
                    "O1\nG54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0.\nM30\n",
                ),
                says: "what program 9 does is not known",
            },
        ],
    },
    Sentence {
        says: "The outline is closed: its last move ends where its first one leads",
        proofs: &[Rule {
            finding: "error[pocket-outline-open]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        }],
    },
    Sentence {
        says: "The outline holds straight moves and arcs in X and Y, no cycle and no tool change, and ends with M99",
        proofs: &[
            Rule {
                finding: "error[pocket-outline-unfit]",
                violates: pocket(
                    "G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nG81 Z-1. R.1\nM99\n",
                ),
                conforms: pocket(
                    "G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nG2 X1. Y0. R1.\nG3 X0. Y1. R1.\nM99\n",
                ),
            },
            Rule {
                finding: "error[pocket-outline-unfit]",
                violates: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nT3 M6\nM99\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nM99\n"),
            },
            Rule {
                finding: "error[pocket-outline-unfit]",
                violates: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nM99\n"),
            },
        ],
    },
    Sentence {
        says: "An outline has at most so many moves: 40 in the older books",
        proofs: &[Rule {
            finding: "warning[pocket-outline-too-long]",
            violates: pocket(concat!(
                "G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\n",
                "X1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\n",
                "X1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\n",
                "M99\n"
            )),
            conforms: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nM99\n"),
        }],
    },
    Sentence {
        says: "Q is the depth of a layer, positive, needed for one layer too",
        proofs: &[
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 X0. Y0. Z-1. Q0. R.1 I.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q1. R.1 I.2 F10.\nM30\n"),
            },
            Rule {
                finding: "error[required-word-missing]",
                violates: pocket("G150 P9 X0. Y0. Z-1. R.1 I.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q1. R.1 I.2 F10.\nM30\n"),
            },
            Run {
                program: on(CONTROL, POCKET).with(&[
                    "machine.units=\"inch\"",
                    "tools.1.length=4",
                    "tools.2={ length = 4.0, diameter = 0.375 }",
                ]),
                prints: &[
                    "rapid 0.0000 0.0000 0.1000",
                    "feed 0.0000 0.0000 -0.0250",
                    "feed 0.0000 0.0000 -0.1500",
                    "feed 0.0000 0.0000 -0.2750",
                    "feed 0.0000 0.0000 -0.3750",
                    "an estimate: the path is the control's own",
                    "rapid 0.0000 0.0000 0.1000",
                ],
            },
        ],
    },
    Sentence {
        says: "R is the level of rapid moves, above the floor",
        proofs: &[Rule {
            finding: "warning[cycle-r-below-bottom]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z.5 Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z-.5 Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        }],
    },
    Sentence {
        says: "S may give the spindle's speed",
        proofs: &[Legal {
            program: pocket(
                "O1\nG20 G54 G90 G0 X0. Y0.\nM3\nG150 P9 G41 D1 S3000 X0. Y0. Z-.5 Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        }],
    },
    Sentence {
        says: "X and Y name the start hole, which lies inside the outline",
        proofs: &[Rule {
            finding: "error[pocket-start-outside]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X2. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X.5 Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        }],
    },
    Sentence {
        says: "How the control clears the pocket is its own: levels and extents are computed, the time is an estimate and said to be one",
        proofs: &[
            Stats {
                program: on(CONTROL, POCKET).with(&[
                    "machine.units=\"inch\"",
                    "tools.1.length=4",
                    "tools.2={ length = 4.0, diameter = 0.375 }",
                ]),
                prints: &[
                    "T2 cutting -1.0625 1.0625 -0.5625 0.5625 -0.3750 0.1000",
                    "of cutting are an estimate",
                ],
            },
            Assumes {
                program: on(CONTROL, POCKET),
                says: "a pocket that the control clears leaves the tool over its start hole, at the rapid level",
            },
        ],
    },
    Sentence {
        says: "L with G91 repeats the pocket at a distance",
        proofs: &[Run {
            program: pocket(
                "O1\nG21 G54 G90 G0 X0. Y0.\nG91 G150 P9 X20. Z-5. Q2. R1. I2. L3 F100.\nG90 G0 Y5.\nM30\nO9\nG1 Y9.\nX9.\nM99\n",
            ),
            prints: &["rapid 60.0000 5.0000"],
        }],
    },
];

#[test]
fn holds() {
    prove(&SYSTEM);
}
