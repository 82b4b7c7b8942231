//! G73, G80 to G83, G98 and G99 (p. 287, 288, 293 to 298, 304, 305): the sentences of these pages and what proves
//! them.
//!
//! Left out: figures, which the sentences repeat.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Legal, Makes, Rule, Run, Silent};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: drilling cycles and return levels",
    key: "DRL",
    file: "haas_mill/g_cycles_drilling.rs",
    statements: &[
        held(
            "p. 287",
            "G73 drills in pecks of Q and backs off between them.",
            "effect `cycle-chip-break`",
            &[Makes {
                program: cut!("G73 G99 Z-.5 R.1 Q.2 F5.\n"),
                block: "G73 G99 Z-.5 R.1 Q.2 F5.",
                events: &[
                    "feed Z-0.1 F5",
                    "rapid Z0",
                    "feed Z-0.3",
                    "rapid Z-0.2",
                    "feed Z-0.5",
                    "rapid Z0.1",
                ],
            }],
        ),
        held(
            "p. 287, p. 377",
            "Setting 22 is how far G73 backs off.",
            "`clearance-setting` of the control",
            &[Makes {
                program: cut!("G73 G99 Z-.5 R.1 Q.2 F5.\n").with(&["settings.22=0.05"]),
                block: "G73 G99 Z-.5 R.1 Q.2 F5.",
                events: &[
                    "feed Z-0.1",
                    "rapid Z-0.05",
                    "feed Z-0.3",
                    "rapid Z-0.25",
                    "feed Z-0.5",
                    "rapid Z0.1",
                ],
            }],
        ),
        held(
            "p. 288",
            "With I, J and K the first peck is I, each further one is J smaller, none is below K.",
            "effect `cycle-chip-break`",
            &[Run {
                program: cut!("G73 G99 Z-1. R.1 I.5 J.2 K.2 F5.\n"),
                prints: &[
                    "feed 0.0000 0.0000 -0.4000",
                    "feed 0.0000 0.0000 -0.7000",
                    "feed 0.0000 0.0000 -0.9000",
                    "feed 0.0000 0.0000 -1.0000",
                ],
            }],
        ),
        held(
            "p. 288",
            "With K and Q the tool goes back to R whenever the pecks add up to K.",
            "effect `cycle-chip-break`",
            &[Run {
                program: cut!("G73 G99 Z-.9 R.1 Q.2 K.4 F5.\n"),
                prints: &[
                    "feed 0.0000 0.0000 -0.1000",
                    "rapid 0.0000 0.0000 0.0000",
                    "feed 0.0000 0.0000 -0.3000",
                    "rapid 0.0000 0.0000 0.1000",
                    "feed 0.0000 0.0000 -0.5000",
                    "rapid 0.0000 0.0000 -0.4000",
                    "feed 0.0000 0.0000 -0.7000",
                    "rapid 0.0000 0.0000 0.1000",
                    "feed 0.0000 0.0000 -0.9000",
                ],
            }],
        ),
        held(
            "p. 288",
            "With Q alone the tool goes back to R after the last peck only.",
            "effect `cycle-chip-break`",
            &[Makes {
                program: cut!("G73 G99 Z-.3 R.1 Q.2 F5.\n"),
                block: "G73 G99 Z-.3 R.1 Q.2 F5.",
                events: &["feed Z-0.1", "rapid Z0", "feed Z-0.3", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 287, p. 288",
            "P of G73 is a pause at the bottom.",
            "word `P` of `G73`",
            &[Makes {
                program: cut!("G73 G99 Z-.1 R.1 Q.2 P.5 F5.\n"),
                block: "G73 G99 Z-.1 R.1 Q.2 P.5 F5.",
                events: &["feed Z-0.1", "dwell T0.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 287",
            "I, J, K and Q of peck cycles are positive.",
            "ranges of words",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G73 Z-.5 R.1 Q-.2 F5.\n"),
                    conforms: cut!("G73 Z-.5 R.1 Q.2 F5.\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G73 Z-.5 R.1 I-.2 J.1 K.1 F5.\n"),
                    conforms: cut!("G73 Z-.5 R.1 I.2 J.1 K.1 F5.\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G83 Z-.5 R.1 I.2 J-.1 K.1 F5.\n"),
                    conforms: cut!("G83 Z-.5 R.1 I.2 J.1 K.1 F5.\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G83 Z-.5 R.1 I.2 J.1 K-.1 F5.\n"),
                    conforms: cut!("G83 Z-.5 R.1 I.2 J.1 K.1 F5.\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G83 Z-.5 R.1 Q0. F5.\n"),
                    conforms: cut!("G83 Z-.5 R.1 Q.1 F5.\n"),
                },
            ],
        ),
        held(
            "p. 287, p. 296",
            "A peck cycle has pecks: Q, or I, J and K.",
            "rule `lasting-word-never-given`",
            &[
                Rule {
                    finding: "warning[lasting-word-never-given]",
                    violates: cut!("G73 Z-.5 R.1 F5.\n"),
                    conforms: cut!("G73 Z-.5 R.1 Q.2 F5.\n"),
                },
                Rule {
                    finding: "warning[lasting-word-never-given]",
                    violates: cut!("G83 Z-.5 R.1 F5.\n"),
                    conforms: cut!("G83 Z-.5 R.1 I.2 J.1 K.1 F5.\n"),
                },
            ],
        ),
        held(
            "p. 287",
            "L of a drilling cycle counts holes under G91.",
            "`repeat = \"L\"`",
            &[Makes {
                program: cut!("G81 G99 Z-.5 R.1 F5. L0\nG91 X1. L2\nG90\n"),
                block: "G91 X1. L2",
                events: &["rapid X1", "feed Z-0.5", "rapid Z0.1", "rapid X2", "feed Z-0.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 293",
            "G81 feeds to Z and comes out at rapid.",
            "effect `cycle-drill`",
            &[Makes {
                program: cut!("G0 Z1.\nG81 G98 Z-.5 R.1 F5.\n"),
                block: "G81 G98 Z-.5 R.1 F5.",
                events: &["rapid Z0.1", "feed Z-0.5 F5", "rapid Z1"],
            }],
        ),
        not_modelled(
            "p. 293",
            "E of drilling and tapping cycles turns the spindle backward at that speed after each hole, for at least the time of Setting 306.",
            "the path does not change, and the time that chips need is the operator's setting in seconds of no fixed default",
        ),
        held(
            "p. 293",
            "A cycle after M05 runs without spindle: it can crash.",
            "rule `spindle-stopped-while-cutting`",
            &[
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG81 Z-.5 R.1 F5.\n"),
                    conforms: cut!("G81 Z-.5 R.1 F5.\n"),
                },
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG83 Z-.5 R.1 Q.2 F5.\n"),
                    conforms: cut!("G83 Z-.5 R.1 Q.2 F5.\n"),
                },
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG76 Z-.5 R.1 Q.02 F5.\n"),
                    conforms: cut!("G76 Z-.5 R.1 Q.02 F5.\n"),
                },
            ],
        ),
        gap(
            "p. 289, p. 293",
            "A cycle takes the spindle direction commanded last; where none was commanded, M03.",
            "a cycle in a program with S and without M3, M4 or M5 is drilled with a clockwise spindle: `spindle-stopped-while-cutting` is untrue (an assumption that the control starts it, at most info), and the run shows the spindle start",
            &[
                Silent {
                    rule: "spindle-stopped-while-cutting",
                    program: mill(
                        "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. S900\nG43 H1 Z.1\nG81 Z-.5 R.1 F6.5\nG80\nG28 G91 Z0.\nG90\nM30\n%\n",
                    ),
                },
                Makes {
                    program: mill(
                        "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. S900\nG43 H1 Z.1\nG81 G99 Z-.5 R.1 F6.5\nG80\nG28 G91 Z0.\nG90\nM30\n%\n",
                    ),
                    block: "G81 G99 Z-.5 R.1 F6.5",
                    events: &["spindle clockwise", "feed Z-0.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 295",
            "G82 is G81 with a pause P at the bottom.",
            "effect `cycle-drill-dwell`",
            &[
                Makes {
                    program: cut!("G82 G99 Z-.5 R.1 P.3 F5.\n"),
                    block: "G82 G99 Z-.5 R.1 P.3 F5.",
                    events: &["feed Z-0.5", "dwell T0.3", "rapid Z0.1"],
                },
                Makes {
                    program: cut!("G82 G99 Z-.5 R.1 P300 F5.\n"),
                    block: "G82 G99 Z-.5 R.1 P300 F5.",
                    events: &["feed Z-0.5", "dwell T0.3", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 294",
            "P of G82 is optional.",
            "rule `cycle-dwell-missing`",
            &[
                Legal { program: cut!("G82 Z-.5 R.1 F5.\n") },
                Rule {
                    finding: "info[cycle-dwell-missing]",
                    violates: cut!("G82 Z-.5 R.1 F5.\n"),
                    conforms: cut!("G82 Z-.5 R.1 P.3 F5.\n"),
                },
            ],
        ),
        held(
            "p. 296",
            "G83 drills in pecks and comes back to R after each.",
            "effect `cycle-peck`",
            &[Makes {
                program: cut!("G83 G99 Z-.5 R.1 Q.2 F5.\n"),
                block: "G83 G99 Z-.5 R.1 Q.2 F5.",
                events: &[
                    "feed Z-0.1",
                    "rapid Z0.1",
                    "rapid Z0",
                    "feed Z-0.3",
                    "rapid Z0.1",
                    "rapid Z-0.2",
                    "feed Z-0.5",
                    "rapid Z0.1",
                ],
            }],
        ),
        held(
            "p. 297",
            "Setting 22 is how far above the last depth G83 goes on at feed.",
            "`clearance-setting` of the control",
            &[Makes {
                program: cut!("G83 G99 Z-.3 R.1 Q.2 F5.\n").with(&["settings.22=0.05"]),
                block: "G83 G99 Z-.3 R.1 Q.2 F5.",
                events: &["feed Z-0.1", "rapid Z0.1", "rapid Z-0.05", "feed Z-0.3", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 296",
            "With I, J and K of G83 the first peck is I, each further one is J smaller, none is below K.",
            "effect `cycle-peck`",
            &[Run {
                program: cut!("G83 G99 Z-1. R.1 I.5 J.2 K.2 F5.\n"),
                prints: &[
                    "feed 0.0000 0.0000 -0.4000",
                    "feed 0.0000 0.0000 -0.7000",
                    "feed 0.0000 0.0000 -0.9000",
                    "feed 0.0000 0.0000 -1.0000",
                ],
            }],
        ),
        held(
            "p. 296",
            "Q does not stand with I, J and K of G83.",
            "`not-together` of `G83`",
            &[Rule {
                finding: "error[words-exclude-each-other]",
                violates: cut!("G83 Z-.5 R.1 I.3 J.1 K.1 Q.2 F5.\n"),
                conforms: cut!("G83 Z-.5 R.1 I.3 J.1 K.1 F5.\n"),
            }],
        ),
        held(
            "p. 296",
            "P of G83 is a pause after the last peck, in seconds.",
            "word `P` of `G83`",
            &[Makes {
                program: cut!("G83 G99 Z-.3 R.1 Q.2 P1.5 F5.\n"),
                block: "G83 G99 Z-.3 R.1 Q.2 P1.5 F5.",
                events: &["feed Z-0.1", "rapid Z0.1", "rapid Z0", "feed Z-0.3", "dwell T1.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 296",
            "The pause of one block holds for later ones.",
            "words of cycles stay",
            &[Makes {
                program: cut!("G83 G99 Z-.1 R.1 Q.2 P1.5 F5.\nX1.\n"),
                block: "X1.",
                events: &["rapid X1", "feed Z-0.1", "dwell T1.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 296",
            "The last peck is what is left.",
            "effect `cycle-peck`",
            &[Run {
                program: cut!("G83 G99 Z-.72 R.1 Q.175 F15.\n"),
                prints: &[
                    "feed 0.0000 0.0000 -0.0750",
                    "feed 0.0000 0.0000 -0.2500",
                    "feed 0.0000 0.0000 -0.4250",
                    "feed 0.0000 0.0000 -0.6000",
                    "feed 0.0000 0.0000 -0.7200",
                ],
            }],
        ),
        held(
            "p. 296",
            "Pecks that come out even end at Z: no stroke is made twice at one depth.",
            "effects `cycle-peck`, `cycle-chip-break`",
            &[
                Makes {
                    program: cut!("G99 G83 Z-.9 R0. Q.3 F5.\n"),
                    block: "G99 G83 Z-.9 R0. Q.3 F5.",
                    events: &[
                        "rapid Z0",
                        "feed Z-0.3",
                        "rapid Z0",
                        "rapid Z-0.2",
                        "feed Z-0.6",
                        "rapid Z0",
                        "rapid Z-0.5",
                        "feed Z-0.9",
                        "rapid Z0",
                    ],
                },
                Makes {
                    program: cut!("G99 G73 Z-.9 R0. Q.3 F5.\n"),
                    block: "G99 G73 Z-.9 R0. Q.3 F5.",
                    events: &[
                        "rapid Z0",
                        "feed Z-0.3",
                        "rapid Z-0.2",
                        "feed Z-0.6",
                        "rapid Z-0.5",
                        "feed Z-0.9",
                        "rapid Z0",
                    ],
                },
            ],
        ),
        held(
            "p. 297, p. 382",
            "With Setting 52 the tool comes back above R by that distance to clear chips.",
            "`above-r-setting` of the control",
            &[Run {
                program: cut!("G0 Z1.\nG83 G99 Z-.3 R.1 Q.2 F5.\n").with(&["settings.52=0.3"]),
                prints: &[
                    "feed 0.0000 0.0000 -0.1000",
                    "rapid 0.0000 0.0000 0.4000",
                    "feed 0.0000 0.0000 -0.3000",
                    "rapid 0.0000 0.0000 0.1000",
                ],
            }],
        ),
        held(
            "p. 293",
            "R lies above the bottom of the hole.",
            "rule `cycle-r-below-bottom`",
            &[Rule {
                finding: "warning[cycle-r-below-bottom]",
                violates: cut!("G81 Z-.5 R-.9 F15.\n"),
                conforms: cut!("G81 Z-.9 R-.5 F15.\n"),
            }],
        ),
        held(
            "p. 304",
            "With G98 Z goes back to where it was before the cycle.",
            "group `return-level`",
            &[Makes {
                program: cut!("G0 Z2.\nG81 G98 Z-.5 R.1 F5.\nX2.\n"),
                block: "X2.",
                events: &["rapid X2", "rapid Z0.1", "feed Z-0.5", "rapid Z2"],
            }],
        ),
        held(
            "p. 305",
            "With G99 Z stays at R between the holes.",
            "group `return-level`",
            &[Makes {
                program: cut!("G0 Z2.\nG81 G99 Z-.5 R.1 F5.\nX2.\n"),
                block: "X2.",
                events: &["rapid X2", "feed Z-0.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 304",
            "A G98 beside the next position clears after that hole.",
            "group `return-level`",
            &[Makes {
                program: cut!("G0 Z2.\nG81 G99 X1. Z-.5 R.1 F5.\nG98 X2.\nX4.\n"),
                block: "G98 X2.",
                events: &["rapid X2", "feed Z-0.5", "rapid Z2"],
            }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
