//! G107, cylindrical mapping: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::Proof::{Assumes, Explains, Legal, Rule, Run, Stats};
use crate::proof::{Program, on};
use crate::seeds::sentence::{Sentence, System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G107, cylindrical mapping",
    key: "G107",
    source: "Haas 96-8000, June 1999, p. 203",
    module: "cylinder",
    sentences: SENTENCES,
};

const CONTROL: &str = "haas-mill";

/// A wrapped slot with rounded ends, compensated, on a diameter of 4 inches: what the page's own example does.
const SLOT: &str = "\
%
O00081 (WRAPPED SLOT)
T1 M6
G0 G20 G40 G49 G80 G90 G17
G54 X2. Y0. A0.
S4500 M3
G107 Y0. A0. R2.
G43 H1 Z0.2
G1 Z-0.1 F20.
G41 D1 X2.5 Y0.4
G3 X2. Y0.9 R0.5
G1 X-2.
G3 X-2.5 Y0.4 R0.5
G1 Y-0.4
G3 X-2. Y-0.9 R0.5
G1 X2.
G3 X2.5 Y-0.4 R0.5
G1 Y0.
G40 X2.
G0 Z0.5
M9
M5
G91 G28 Z0.
G28 Y0.
G90
G107
M30
%
";

/// Moves after `G107` blocks, millimetres: 31.4159 mm of a 100 mm cylinder are 36 degrees.
const fn wrapped(text: &'static str) -> Program {
    on(CONTROL, text)
}

const SENTENCES: &[Sentence] = &[
    Sentence {
        says: "Motion of a linear axis becomes the equivalent motion along the surface of a cylinder on a rotary axis, in both directions",
        proofs: &[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nY-31.4159\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "feed 0.0000 31.4159 ? 36.0000", "feed 0.0000 -31.4159 ? -36.0000"],
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. B0.\nG107 X0. B0. Q100.\nG1 X31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, X on B", "feed 31.4159 0.0000 ? 36.0000"],
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG2 X20. Y0. I10. J0. F100.\nG3 Y40. J20.\nG107\nM30\n",
                ),
                prints: &[
                    "arc 20.0000 0.0000 ? 0.0000",
                    "arc 20.0000 40.0000 ? 45.8366",
                ],
            },
        ],
    },
    Sentence {
        says: "The linear axis itself does not move: its machine coordinate stays, and counts again when mapping ends",
        proofs: &[Run {
            program: wrapped(
                "O1\nG21 G90 G54 G0 X0. Y5. A0.\nG107 Y0. A0. Q100.\nG1 Y36.4159 F100.\nX#5022\nG107\nG91 G0 Y0.\nM30\n",
            )
            .with(&["machine.units=\"mm\"", "offsets.G54={ X = 0.0, Y = 100.0, Z = 0.0, A = 0.0 }"]),
            prints: &["feed 0.0000 36.4159 ? 36.0000", "feed 105.0000 36.4159 ? 36.0000", "wrap off", "rapid 105.0000 5.0000 ? 36.0000"],
        }],
    },
    Sentence {
        says: "The feed is the speed along the surface, in a feed a minute",
        proofs: &[
            Stats {
                program: wrapped(
                    "O1\nG21 G90 G94 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG1 X30. Y40. F50.\nG107\nM30\n",
                ),
                prints: &["cutting 1:00.0"],
            },
            Rule {
                finding: "info[cylinder-feed-mode]",
                violates: wrapped("O1\nG21 G54 G90\nG93\nG107 Y0. A0. Q100.\nG1 Y10. F2.\nG107\nG94\nM30\n"),
                conforms: wrapped("O1\nG21 G54 G90\nG94\nG107 Y0. A0. Q100.\nG1 Y10. F100.\nG107\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "The diameter can be redefined in a program, so that mapping goes on along another surface",
        proofs: &[Run {
            program: wrapped(
                "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nY0.\nG107 Y0. A0. Q50.\nY31.4159\nG107\nM30\n",
            ),
            prints: &["diameter 100, Y on A", "31.4159 ? 36.0000", "diameter 50, Y on A", "31.4159 ? 71.9999"],
        }],
    },
    Sentence {
        says: "An X, Y or Z word begins mapping and names the linear axis; only one of them is allowed",
        proofs: &[Rule {
            finding: "error[words-exclude-each-other]",
            violates: wrapped("G107 X0. Y0. A0. Q2.\nG107\nM30\n"),
            conforms: wrapped("G107 X0. A0. Q2.\nG107\nM30\n"),
        }],
    },
    Sentence {
        says: "The value of that word is ignored",
        proofs: &[
            Rule {
                finding: "warning[cylinder-word-value-ignored]",
                violates: wrapped("G107 Y1.5 A0. Q2.\nG107\nM30\n"),
                conforms: wrapped("G107 Y0. A0. Q2.\nG107\nM30\n"),
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y7. A90. Q100.\nG1 X1. F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "feed 1.0000 0.0000 ? 0.0000"],
            },
        ],
    },
    Sentence {
        says: "A linear axis without a rotary axis is an alarm",
        proofs: &[Rule {
            finding: "error[cylinder-without-rotary-axis]",
            violates: wrapped("G107 Y0.\nM30\n"),
            conforms: wrapped("G107 Y0. A0. Q2.\nG107\nM30\n"),
        }],
    },
    Sentence {
        says: "A or B names the rotary axis that carries the cylinder; only one of them is allowed",
        proofs: &[Rule {
            finding: "error[words-exclude-each-other]",
            violates: wrapped("G107 Y0. A0. B0. Q2.\nG107\nM30\n"),
            conforms: wrapped("G107 Y0. B0. Q2.\nG107\nM30\n"),
        }],
    },
    Sentence {
        says: "The rotary axis must be one that the machine has",
        proofs: &[Rule {
            finding: "error[cylinder-axis-not-on-machine]",
            violates: wrapped("G107 Y0. B0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
            conforms: wrapped("G107 Y0. A0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
        }],
    },
    Sentence {
        says: "The value of the rotary word is ignored: nothing turns",
        proofs: &[Rule {
            finding: "warning[cylinder-word-value-ignored]",
            violates: wrapped("G107 Y0. A90. Q2.\nG107\nM30\n"),
            conforms: wrapped("G0 A90.\nG107 Y0. A0. Q2.\nG107\nM30\n"),
        }],
    },
    Sentence {
        says: "Q is the diameter; without a rotary axis it is an alarm when the block runs",
        proofs: &[Rule {
            finding: "error[cylinder-without-rotary-axis]",
            violates: wrapped("G107 Q2.\nM30\n"),
            conforms: wrapped("G107 A0. Q2.\nM30\n"),
        }],
    },
    Sentence {
        says: "R is the radius, in place of Q, and needs a rotary axis as well",
        proofs: &[
            Rule {
                finding: "error[cylinder-without-rotary-axis]",
                violates: wrapped("G107 R1.\nM30\n"),
                conforms: wrapped("G107 A0. R1.\nM30\n"),
            },
            Rule {
                finding: "error[words-exclude-each-other]",
                violates: wrapped("G107 Y0. A0. Q2. R1.\nG107\nM30\n"),
                conforms: wrapped("G107 Y0. A0. R1.\nG107\nM30\n"),
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. R50.\nG1 Y31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "feed 0.0000 31.4159 ? 36.0000"],
            },
        ],
    },
    Sentence {
        says: "Without Q and R the last size that a G107 gave this rotary axis since power-on counts",
        proofs: &[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 A0. Q100.\nG107 B0. Q50.\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "31.4159 ? 36.0000"],
            },
            Rule {
                finding: "info[cylinder-diameter-from-setting]",
                violates: wrapped("G107 A0. Q2.\nG107 Y0. B0.\nG107\nM30\n"),
                conforms: wrapped("G107 A0. Q2.\nG107 Y0. A0.\nG107\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "If none was given, or the last one was zero, the diameter is that of the settings for this axis: 34 for the 4th, 79 for the 5th",
        proofs: &[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0. B0.\nG107 Y0. A0.\nG107\nG107 Y0. B0.\nG107\nM30\n",
                )
                .with(&["machine.units=\"mm\"", "settings.34=100", "settings.79=50"]),
                prints: &["wrap diameter 100, Y on A", "wrap off", "wrap diameter 50, Y on B"],
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 A0. Q30.\nG107 Y0. A0. Q0.\nG107\nM30\n",
                )
                .with(&["machine.units=\"mm\"", "settings.34=100"]),
                prints: &["wrap diameter 100, Y on A"],
            },
            Assumes {
                program: wrapped("O1\nG54 G90 G0 X0. Y0. A0.\nG107 Y0. A0.\nG107\nM30\n"),
                says: "setting 34 (4th axis diameter) is not known",
            },
            Assumes {
                program: wrapped("O1\nG54 G90 G0 X0. Y0. A0.\nG107 Y0. A0.\nG107\nM30\n").with(&["settings.34=4"]),
                says: "no program before this one gave cylinders on A a diameter",
            },
            Rule {
                finding: "warning[cylinder-without-diameter]",
                violates: wrapped("G107 Y0. A0. Q0.\nG107\nM30\n").with(&["settings.34=0"]),
                conforms: wrapped("G107 Y0. A0. Q0.\nG107\nM30\n").with(&["settings.34=4"]),
            },
        ],
    },
    Sentence {
        says: "A size becomes the axis' default until power off, also where the code only names a rotary axis and a size; mapping that is on stays as it is",
        proofs: &[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG107 A0. Q50.\nG1 Y31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "31.4159 ? 36.0000", "wrap off"],
            },
            Rule {
                finding: "warning[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG107 A0. Q3.\nT2 M6\nG107\nM30\n"),
                conforms: wrapped("G107 A0. Q3.\nT2 M6\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "In sync with the settings: while no size was given, it was zero, or it equals the setting, a new setting changes the default too",
        proofs: &[Explains {
            control: CONTROL,
            code: "G107",
            says: "as long as the last size equals the setting (or is 0, or none was given), a new setting changes the default too",
        }],
    },
    Sentence {
        says: "Out of sync: a last size other than zero and the setting is kept, whatever becomes of the setting, until the two are equal",
        proofs: &[
            Explains {
                control: CONTROL,
                code: "G107",
                says: "A different size is out of sync: it keeps its own value until the two are equal again",
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 A0. Q30.\nG107 Y0. A0.\nG107\nM30\n",
                )
                .with(&["machine.units=\"mm\"", "settings.34=100"]),
                prints: &["wrap diameter 30, Y on A"],
            },
        ],
    },
    Sentence {
        says: "The code alone ends mapping, without forgetting the default",
        proofs: &[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG107\nG1 Y31.4159 F100.\nY0.\nG107 Y0. A0.\nG1 Y31.4159\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100", "wrap off", "31.4159 ? 0.0000", "wrap diameter 100", "31.4159 ? 36.0000"],
            },
            Rule {
                finding: "warning[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nT2 M6\nG107\nM30\n"),
                conforms: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\nT2 M6\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "Group 00, but lasting: Setting 56 decides whether the end of the program ends it",
        proofs: &[
            Rule {
                finding: "warning[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nM30\n").with(&["settings.56=false"]),
                conforms: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nM30\n").with(&["settings.56=true"]),
            },
            Rule {
                finding: "info[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nM30\n"),
                conforms: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\nM30\n"),
            },
        ],
    },
    Sentence {
        says: "An existing program of a linear axis is wrapped by a G107 at its beginning, cutter compensation and all",
        proofs: &[
            Legal { program: on(CONTROL, SLOT) },
            Run {
                program: on(CONTROL, SLOT).with(&[
                    "machine.units=\"inch\"",
                    "tools.1.diameter=0.5",
                    "tools.1.length=4",
                ]),
                prints: &[
                    "wrap diameter 4, Y on A",
                    "feed 2.2500 0.4000 -0.1000 11.4592",
                    "arc 2.0000 0.6500 -0.1000 18.6211",
                    "feed -2.0000 0.6500 -0.1000 18.6211",
                    "wrap off",
                ],
            },
        ],
    },
];

#[test]
fn holds() {
    prove(&SYSTEM);
}
