//! G codes in general and how canned cycles work (p. 239 to 248): the sentences of these pages and what proves them.
//!
//! Left out: the list of codes, whose facts stand with each code, and the notes on sample programs.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Assumes, Legal, Makes, Rule};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes and canned cycles in general",
    key: "GEN",
    file: "haas_mill/g_codes_and_cycles.rs",
    statements: &[
        held(
            "p. 242",
            "A modal code holds until a code of its group or the end of the program replaces it.",
            "groups of `groups.toml`",
            &[
                Makes {
                    program: cut!("G1 X1. F10.\nX2.\nG0 X3.\nX4.\n"),
                    block: "X2.",
                    events: &["feed X2 F10"],
                },
                Makes {
                    program: cut!("G1 X1. F10.\nX2.\nG0 X3.\nX4.\n"),
                    block: "X4.",
                    events: &["rapid X4"],
                },
            ],
        ),
        held(
            "p. 242",
            "A non-modal code (group 00) acts in its own block only.",
            "group `one-shot`",
            &[
                Makes { program: cut!("G1 X1. F10.\nG4 P1.\nX2.\n"), block: "G4 P1.", events: &["dwell T1"] },
                Makes { program: cut!("G1 X1. F10.\nG4 P1.\nX2.\n"), block: "X2.", events: &["feed X2 F10"] },
            ],
        ),
        held(
            "p. 243",
            "A block holds several G codes, but not two of one group.",
            "rule `two-codes-of-one-group`",
            &[
                Rule {
                    finding: "error[two-codes-of-one-group]",
                    violates: cut!("G0 G1 X1. F10.\n"),
                    conforms: cut!("G90 G1 X1. F10.\n"),
                },
                Rule {
                    finding: "error[two-codes-of-one-group]",
                    violates: cut!("G54 G55 X1.\n"),
                    conforms: cut!("G54 G17 X1.\n"),
                },
                Rule {
                    finding: "error[two-codes-of-one-group]",
                    violates: cut!("G90 G91 X1.\n"),
                    conforms: cut!("G91 X1.\nG90\n"),
                },
            ],
        ),
        held(
            "p. 243",
            "An active canned cycle machines at every new X or Y position.",
            "cycle effects, `needs-axis`",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1", "feed Z-0.5 F6.5", "rapid Z0.1"],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nY2.\n"),
                    block: "Y2.",
                    events: &["rapid Y2", "feed Z-0.5 F6.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 243",
            "Positions of a canned cycle may be absolute or incremental; L repeats an increment.",
            "`repeat = \"L\"`",
            &[Makes {
                program: cut!("G81 G99 Z-.5 R.1 F6.5\nG91 X-.5625 L3\n"),
                block: "G91 X-.5625 L3",
                events: &[
                    "rapid X-0.5625",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                    "rapid X-1.125",
                    "feed Z-0.5",
                    "rapid Z0.1",
                    "rapid X-1.6875",
                    "feed Z-0.5",
                    "rapid Z0.1",
                ],
            }],
        ),
        held(
            "p. 244",
            "L repeats a cycle by an incremental move in X or Y; with an absolute position every repeat is at the same place (our conclusion).",
            "rule `cycle-repeated-in-place`",
            &[
                Rule {
                    finding: "warning[cycle-repeated-in-place]",
                    violates: cut!("G81 X1. Z-.5 R.1 F6.5 L3\n"),
                    conforms: cut!("G81 Z-.5 R.1 F6.5\nG91 X1. L3\n"),
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX1. L2\n"),
                    block: "X1. L2",
                    events: &["rapid X1", "feed Z-0.5", "rapid Z0.1", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 243",
            "The same in a later block of the cycle.",
            "rule `cycle-repeated-in-place`",
            &[Rule {
                finding: "warning[cycle-repeated-in-place]",
                violates: cut!("G81 Z-.5 R.1 F6.5\nX1. L3\n"),
                conforms: cut!("G81 Z-.5 R.1 F6.5\nG91 X1. L3\n"),
            }],
        ),
        held(
            "p. 243",
            "With Setting 28 on a cycle's own block machines where the tool stands, without X or Y.",
            "setting 28",
            &[Makes {
                program: cut!("G81 G99 Z-.5 R.1 F6.5\n").with(&["settings.28=true"]),
                block: "G81 G99 Z-.5 R.1 F6.5",
                events: &["feed Z-0.5 F6.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 243",
            "With Setting 28 off a cycle's own block machines with X or Y.",
            "setting 28",
            &[Makes {
                program: cut!("G81 G99 X0. Z-.5 R.1 F6.5\n").with(&["settings.28=false"]),
                block: "G81 G99 X0. Z-.5 R.1 F6.5",
                events: &["feed Z-0.5 F6.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 243, p. 378",
            "With Setting 28 off a cycle's own block without X or Y machines nothing.",
            "Setting 28, where it is told",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX1.\n").with(&["settings.28=false"]),
                    block: "G81 G99 Z-.5 R.1 F6.5",
                    events: &[],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX1.\n").with(&["settings.28=false"]),
                    block: "X1.",
                    events: &["rapid X1", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 244",
            "Examples take Setting 28 to be on.",
            "default of setting 28",
            &[Assumes {
                program: cut!("G81 Z-.5 R.1 F6.5\n"),
                says: "setting 28 (canned cycle act without X/Y) is `on`",
            }],
        ),
        held(
            "p. 243",
            "L0 in the cycle's own block: no cycle there, whatever Setting 28 says.",
            "`repeat = \"L\"`",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nX1.\n").with(&["settings.28=true"]),
                    block: "G81 G99 Z-.5 R.1 F6.5 L0",
                    events: &[],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nX1.\n").with(&["settings.28=false"]),
                    block: "G81 G99 Z-.5 R.1 F6.5 L0",
                    events: &[],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 243, p. 247",
            "L0 beside X or Y makes the move at rapid without the cycle, so that the tool goes round an obstacle.",
            "`zero-repeats-move`",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX4.\nX5.5 L0\nY-2.\n"),
                    block: "X5.5 L0",
                    events: &["rapid X5.5"],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX4.\nX5.5 L0\nY-2.\n"),
                    block: "Y-2.",
                    events: &["rapid Y-2", "feed Z-0.5", "rapid Z0.1"],
                },
                Makes {
                    program: cut!("G81 G99 X2. Z-.5 R.1 F6.5 L0\nX3.\n"),
                    block: "G81 G99 X2. Z-.5 R.1 F6.5 L0",
                    events: &["rapid X2"],
                },
            ],
        ),
        held(
            "p. 244",
            "New R or Z in a block with X or Y holds from that hole on.",
            "words of cycles stay",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX1. R.2 Z-.7\nX2.\n"),
                    block: "X1. R.2 Z-.7",
                    events: &["rapid X1", "rapid Z0.2", "feed Z-0.7", "rapid Z0.2"],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nX1. R.2 Z-.7\nX2.\n"),
                    block: "X2.",
                    events: &["rapid X2", "feed Z-0.7", "rapid Z0.2"],
                },
            ],
        ),
        held(
            "p. 244",
            "X and Y of a canned cycle move at rapid.",
            "cycle effects",
            &[Makes {
                program: cut!("G1 X.5 F5.\nG81 G99 X1. Y1. Z-.5 R.1 F6.5\n"),
                block: "G81 G99 X1. Y1. Z-.5 R.1 F6.5",
                events: &["rapid X1 Y1", "feed Z-0.5 F6.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 244",
            "With G98 Z returns after each hole to the level before the cycle, with G99 to R.",
            "group `return-level`",
            &[
                Makes {
                    program: cut!("G0 Z1.\nG81 G98 Z-.5 R.1 F6.5\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1", "rapid Z0.1", "feed Z-0.5", "rapid Z1"],
                },
                Makes {
                    program: cut!("G0 Z1.\nG81 G99 Z-.5 R.1 F6.5\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 244",
            "G98 and G99 may change after the cycle was given and hold for later holes.",
            "group `return-level`",
            &[
                Makes {
                    program: cut!("G0 Z1.\nG81 G99 Z-.5 R.1 F6.5\nG98 X1.\nX2.\n"),
                    block: "G98 X1.",
                    events: &["rapid X1", "feed Z-0.5", "rapid Z1"],
                },
                Makes {
                    program: cut!("G0 Z1.\nG81 G99 Z-.5 R.1 F6.5\nG98 X1.\nX2.\n"),
                    block: "X2.",
                    events: &["rapid X2", "rapid Z0.1", "feed Z-0.5", "rapid Z1"],
                },
            ],
        ),
        held(
            "p. 244",
            "P is a pause at the bottom, for some cycles.",
            "word `P` of the cycles",
            &[Makes {
                program: cut!("G82 G99 Z-.5 R.1 P.5 F6.5\n"),
                block: "G82 G99 Z-.5 R.1 P.5 F6.5",
                events: &["feed Z-0.5", "dwell T0.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 244",
            "The P of one cycle serves later cycles.",
            "words of cycles stay",
            &[Makes {
                program: cut!("G82 G99 Z-.5 R.1 P.5 F6.5\nG81 X1. Z-.5 R.1\nG82 X2. Z-.5 R.1\n"),
                block: "G82 X2. Z-.5 R.1",
                events: &["rapid X2", "feed Z-0.5", "dwell T0.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 244",
            "G80, G0 or G1 ends what P a cycle had.",
            "words of cycles end with the cycle",
            &[
                Makes {
                    program: cut!("G82 G99 Z-.5 R.1 P.5 F6.5\nG80\nG82 G99 X2. Z-.5 R.1\n"),
                    block: "G82 G99 X2. Z-.5 R.1",
                    events: &["rapid X2", "feed Z-0.5", "rapid Z0.1"],
                },
                Makes {
                    program: cut!("G82 G99 Z-.5 R.1 P.5 F6.5\nG0 Z.2\nG82 G99 X2. Z-.5 R.1\n"),
                    block: "G82 G99 X2. Z-.5 R.1",
                    events: &["rapid X2", "rapid Z0.1", "feed Z-0.5", "rapid Z0.1"],
                },
                Makes {
                    program: cut!("G82 G99 Z-.5 R.1 P.5 F6.5\nG1 Z.2\nG82 G99 X2. Z-.5 R.1\n"),
                    block: "G82 G99 X2. Z-.5 R.1",
                    events: &["rapid X2", "rapid Z0.1", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 244",
            "The spindle speed may stand in the block of the cycle.",
            "order of execution",
            &[Legal {
                program: mill(
                    "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG84 Z-.5 R.1 F6.5 S130\nG80\nG28 G91 Z0.\nG90\nM30\n%\n",
                ),
            }],
        ),
        gap(
            "p. 244",
            "A spindle speed is given before or in the block of the cycle.",
            "`speed-missing` is an info; a cycle in a program without any S drills with a spindle that does not turn: warning",
            &[
                Rule {
                    finding: "warning[speed-missing]",
                    violates: mill(
                        "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nM3\nG81 Z-.5 R.1 F6.5\nG80\nM30\n",
                    ),
                    conforms: mill(
                        "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nS900 M3\nG81 Z-.5 R.1 F6.5\nG80\nM30\n",
                    ),
                },
                Rule {
                    finding: "warning[speed-missing]",
                    violates: mill(
                        "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG84 Z-.5 R.1 F6.5\nG80\nM30\n",
                    ),
                    conforms: mill(
                        "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG84 Z-.5 R.1 F6.5 S130\nG80\nM30\n",
                    ),
                },
            ],
        ),
        held(
            "p. 245",
            "The feed of a tap is spindle speed by threads an inch, or by pitch in millimetres.",
            "rule `tapping-feed-off-pitch`",
            &[
                Rule {
                    finding: "warning[tapping-feed-off-pitch]",
                    violates: mill(
                        "O1 (A)\nG20 G17 G40 G49 G80 G90\n(T1 3/8-16 TAP)\nT1 M6\nG0 G54 X0. Y0. S900\nG43 H1 Z.1\nG84 Z-.5 R.1 F50.\nG80\nM30\n",
                    ),
                    conforms: mill(
                        "O1 (A)\nG20 G17 G40 G49 G80 G90\n(T1 3/8-16 TAP)\nT1 M6\nG0 G54 X0. Y0. S900\nG43 H1 Z.1\nG84 Z-.5 R.1 F56.25\nG80\nM30\n",
                    ),
                },
                Rule {
                    finding: "warning[tapping-feed-off-pitch]",
                    violates: mill(
                        "O1 (A)\nG21 G17 G40 G49 G80 G90\n(T1 M8X1.25 TAP)\nT1 M6\nG0 G54 X0. Y0. S800\nG43 H1 Z3.\nG84 Z-9. R3. F100.\nG80\nM30\n",
                    ),
                    conforms: mill(
                        "O1 (A)\nG21 G17 G40 G49 G80 G90\n(T1 M8X1.25 TAP)\nT1 M6\nG0 G54 X0. Y0. S800\nG43 H1 Z3.\nG84 Z-9. R3. F1000.\nG80\nM30\n",
                    ),
                },
            ],
        ),
        not_modelled(
            "p. 245",
            "With Setting 57 on the machine stops between the XY move and the plunge of a cycle.",
            "how far servo axes lag at a corner is not followed; moves are taken to end at their points",
        ),
        held(
            "p. 245",
            "Z, R and F are required for every canned cycle.",
            "needs of words; rules `cycle-word-missing`, `feed-missing`",
            &[
                Rule {
                    finding: "error[cycle-word-missing]",
                    violates: cut!("G81 R.1 F5.\n"),
                    conforms: cut!("G81 Z-.5 R.1 F5.\n"),
                },
                Rule {
                    finding: "info[cycle-word-missing]",
                    violates: cut!("G81 Z-.5 F5.\n"),
                    conforms: cut!("G81 Z-.5 R.1 F5.\n"),
                },
                Rule {
                    finding: "error[feed-missing]",
                    violates: cut!("G81 Z-.5 R.1\n"),
                    conforms: cut!("G81 Z-.5 R.1 F5.\n"),
                },
                Legal { program: cut!("G81 Z-.5 R.1 F5.\nG83 X1. Z-.5 R.1 Q.1\n") },
            ],
        ),
        held(
            "p. 245, p. 293",
            "G80, G0 or G1 ends a cycle; nothing else does.",
            "`motion-ends-cycle`",
            &[
                Makes {
                    program: cut!("G81 Z-.5 R.1 F5.\nG80\nG0\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1"],
                },
                Makes {
                    program: cut!("G81 Z-.5 R.1 F5.\nG0 Z.5\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1"],
                },
                Makes {
                    program: cut!("G81 Z-.5 R.1 F5.\nG1 Z.5\nX1.\n"),
                    block: "X1.",
                    events: &["feed X1 F5"],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F5.\nG4 P1.\nM8\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 248",
            "G0 ends a cycle as G80 does.",
            "`motion-ends-cycle`",
            &[Makes { program: cut!("G81 Z-.5 R.1 F5.\nG0 X1.\n"), block: "G0 X1.", events: &["rapid X1"] }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
