//! G74, G76, G77, G84 to G86, G89, G174 and G184 (p. 288 to 292, 298 to 302, 334): the sentences of these pages and
//! what proves them.
//!
//! Of G77 the manual says three things: the shift comes before the cut and after it, so that the tool clears the hole on
//! its way in and out (p. 147, 291); Setting 27 is the direction that clears the tool (p. 377); and, in an example, the
//! tool moves by Q when it has reached R and back towards the centre after the cut (p. 292). The first two are taken: the
//! tool is off the axis on its way through the hole and cuts on it. Taken at its word, the example would cut Q off the
//! axis of the hole.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill};
use crate::proof::Proof::{Assumes, Legal, Makes, Rule, Run, Stats};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: tapping and boring cycles",
    key: "BOR",
    file: "haas_mill/g_cycles_tapping_boring.rs",
    statements: &[
        held(
            "p. 288",
            "G74 taps a left-hand thread: the spindle turns backward on the way in, forward on the way out.",
            "effect `cycle-left-tap`",
            &[Makes {
                program: cut!("G74 G99 Z-.6 R.1 F56.25 S900\n"),
                block: "G74 G99 Z-.6 R.1 F56.25 S900",
                events: &[
                    "spindle 900",
                    "spindle counter-clockwise",
                    "feed Z-0.6 F56.25",
                    "spindle clockwise",
                    "feed Z0.1 F56.25",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 298",
            "G84 taps a right-hand thread.",
            "effect `cycle-tap`",
            &[Makes {
                program: cut!("G84 G99 Z-.6 R.1 F56.25 S900\n"),
                block: "G84 G99 Z-.6 R.1 F56.25 S900",
                events: &[
                    "spindle 900",
                    "spindle clockwise",
                    "feed Z-0.6 F56.25",
                    "spindle counter-clockwise",
                    "feed Z0.1 F56.25",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 298",
            "G84 starts and stops the spindle itself: no M03 or M04 before it.",
            "`tap-needs-spindle` of `semantics.cycles`",
            &[
                Legal {
                    program: mill(
                        "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG84 Z-.6 R.1 F56.25 S900\nG80\nG28 G91 Z0.\nG90\nM30\n%\n",
                    ),
                },
                Makes {
                    program: cut!("M5\nG84 G99 Z-.6 R.1 F56.25 S900\n"),
                    block: "G84 G99 Z-.6 R.1 F56.25 S900",
                    events: &[
                        "spindle 900",
                        "spindle clockwise",
                        "feed Z-0.6",
                        "spindle counter-clockwise",
                        "feed Z0.1",
                        "spindle stop",
                    ],
                },
            ],
        ),
        held(
            "p. 288, p. 298",
            "Z is required, R, X and Y are not.",
            "needs of words",
            &[
                Rule {
                    finding: "error[cycle-word-missing]",
                    violates: cut!("G84 R.1 F56.25 S900\n"),
                    conforms: cut!("G84 Z-.6 R.1 F56.25 S900\n"),
                },
                Rule {
                    finding: "error[cycle-word-missing]",
                    violates: cut!("G74 R.1 F56.25 S900\n"),
                    conforms: cut!("G74 Z-.6 R.1 F56.25 S900\n"),
                },
            ],
        ),
        held(
            "p. 288, p. 298",
            "F is required.",
            "rule `feed-missing`",
            &[Rule {
                finding: "error[feed-missing]",
                violates: cut!("G84 Z-.6 R.1 S900\n"),
                conforms: cut!("G84 Z-.6 R.1 F56.25 S900\n"),
            }],
        ),
        held(
            "p. 288, p. 298, p. 391",
            "J is how many times faster than in the tap comes out.",
            "`tap-out-setting` of the control",
            &[
                Makes {
                    program: cut!("G84 G99 Z-.6 R.1 F60. S960 J2\n"),
                    block: "G84 G99 Z-.6 R.1 F60. S960 J2",
                    events: &[
                        "spindle 960",
                        "spindle clockwise",
                        "feed Z-0.6 T0.7",
                        "spindle 1920",
                        "spindle counter-clockwise",
                        "feed Z0.1 T0.35 F120",
                        "spindle 960",
                        "spindle clockwise",
                    ],
                },
                Stats { program: cut!("G84 G99 Z-.6 R.1 F60. S960 J2\n"), prints: &["cutting 0:01.0"] },
            ],
        ),
        held(
            "p. 391",
            "Setting 130 does the same where no J is given; 0 and 1 change nothing; J wins.",
            "`tap-out-setting` of the control",
            &[
                Stats {
                    program: cut!("G84 G99 Z-.6 R.1 F60. S960\n").with(&["settings.130=2"]),
                    prints: &["cutting 0:01.0"],
                },
                Stats {
                    program: cut!("G84 G99 Z-.6 R.1 F60. S960\n").with(&["settings.130=1"]),
                    prints: &["cutting 0:01.4"],
                },
                Stats {
                    program: cut!("G84 G99 Z-.6 R.1 F60. S960\n").with(&["settings.130=0"]),
                    prints: &["cutting 0:01.4"],
                },
                Stats {
                    program: cut!("G84 G99 Z-.6 R.1 F60. S960 J1\n").with(&["settings.130=2"]),
                    prints: &["cutting 0:01.4"],
                },
            ],
        ),
        held(
            "p. 288, p. 298",
            "L counts holes under G91.",
            "`repeat = \"L\"`",
            &[Makes {
                program: cut!("G84 G99 Z-.6 R.1 F56.25 S900 L0\nG91 X1. L2\nG90\n"),
                block: "G91 X1. L2",
                events: &[
                    "rapid X1",
                    "spindle clockwise",
                    "feed Z-0.6",
                    "spindle counter-clockwise",
                    "feed Z0.1",
                    "spindle clockwise",
                    "rapid X2",
                    "spindle clockwise",
                    "feed Z-0.6",
                    "spindle counter-clockwise",
                    "feed Z0.1",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 298",
            "S may stand in the block of G84.",
            "word `S` of `G84`",
            &[Makes {
                program: cut!("S100\nG84 G99 Z-.6 R.1 F56.25 S900\n"),
                block: "G84 G99 Z-.6 R.1 F56.25 S900",
                events: &[
                    "spindle 900",
                    "spindle clockwise",
                    "feed Z-0.6",
                    "spindle counter-clockwise",
                    "feed Z0.1",
                    "spindle clockwise",
                ],
            }],
        ),
        gap(
            "p. 392",
            "Peck tapping, or tapping a hole twice, needs Setting 133 on.",
            "two taps in one hole with `133 = false`: warning; silent so far",
            &[Rule {
                finding: "warning[repeated-tap-without-setting]",
                violates: cut!("G84 G99 Z-.3 R.1 F56.25 S900\nX0. Z-.6\n").with(&["settings.133=false"]),
                conforms: cut!("G84 G99 Z-.3 R.1 F56.25 S900\nX0. Z-.6\n").with(&["settings.133=true"]),
            }],
        ),
        held(
            "p. 290",
            "G76 bores, stops and orients the spindle, shifts off the wall, comes out, and goes back over the hole.",
            "effect `cycle-fine-bore`",
            &[Makes {
                program: cut!("G76 G99 Z-.6 R.1 F5. Q.02\n").with(&["settings.27=\"x+\""]),
                block: "G76 G99 Z-.6 R.1 F5. Q.02",
                events: &[
                    "feed Z-0.6 F5",
                    "spindle stop",
                    "spindle orient",
                    "rapid X0.02",
                    "rapid Z0.1",
                    "rapid X0",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 290, p. 377",
            "With Q the direction of the shift is Setting 27: X+, X-, Y+ or Y-.",
            "`shift-setting` of the control",
            &[
                Makes {
                    program: cut!("G76 G99 Z-.6 R.1 F5. Q.02\n").with(&["settings.27=\"y-\""]),
                    block: "G76 G99 Z-.6 R.1 F5. Q.02",
                    events: &[
                        "feed Z-0.6",
                        "spindle stop",
                        "spindle orient",
                        "rapid Y-0.02",
                        "rapid Z0.1",
                        "rapid Y0",
                        "spindle clockwise",
                    ],
                },
                Assumes { program: cut!("G76 G99 Z-.6 R.1 F5. Q.02\n"), says: "setting 27" },
            ],
        ),
        held(
            "p. 290",
            "Without Q the shift is I along X and J along Y.",
            "effect `cycle-fine-bore`",
            &[Makes {
                program: cut!("G76 G99 Z-.6 R.1 F5. I.02 J-.01\n"),
                block: "G76 G99 Z-.6 R.1 F5. I.02 J-.01",
                events: &[
                    "feed Z-0.6",
                    "spindle stop",
                    "spindle orient",
                    "rapid X0.02 Y-0.01",
                    "rapid Z0.1",
                    "rapid X0 Y0",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 289",
            "I and J count only where Q is not given.",
            "`shift-setting` of the control",
            &[Makes {
                program: cut!("G76 G99 Z-.6 R.1 F5. Q.03 I.02 J-.01\n").with(&["settings.27=\"x+\""]),
                block: "G76 G99 Z-.6 R.1 F5. Q.03 I.02 J-.01",
                events: &[
                    "feed Z-0.6",
                    "spindle stop",
                    "spindle orient",
                    "rapid X0.03",
                    "rapid Z0.1",
                    "rapid X0",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 289",
            "Q, I and J are all optional: without any the tool comes out along the wall.",
            "`shift-optional` of the control, rule bore-without-shift",
            &[
                Rule {
                    finding: "warning[bore-without-shift]",
                    violates: cut!("G76 G99 Z-.6 R.1 F5.\n"),
                    conforms: cut!("G76 G99 Z-.6 R.1 F5. Q.02\n"),
                },
                Run { program: cut!("G76 G99 Z-.6 R.1 F5.\nG80 X3.\n"), prints: &["rapid 3.0000"] },
            ],
        ),
        held(
            "p. 289",
            "P of G76 is a pause at the bottom.",
            "word `P` of `G76`",
            &[Makes {
                program: cut!("G76 G99 Z-.6 R.1 F5. P.3 I.02\n"),
                block: "G76 G99 Z-.6 R.1 F5. P.3 I.02",
                events: &[
                    "feed Z-0.6",
                    "dwell T0.3",
                    "spindle stop",
                    "spindle orient",
                    "rapid X0.02",
                    "rapid Z0.1",
                    "rapid X0",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 289, p. 300, p. 301",
            "G76, G86 and G89 after M05 run without spindle.",
            "rule `spindle-stopped-while-cutting`",
            &[
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG76 Z-.5 R.1 Q.02 F10.\n"),
                    conforms: cut!("G76 Z-.5 R.1 Q.02 F10.\n"),
                },
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG86 Z-.5 R.1 F10.\n"),
                    conforms: cut!("G86 Z-.5 R.1 F10.\n"),
                },
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG89 Z-.5 R.1 P.1 F10.\n"),
                    conforms: cut!("G89 Z-.5 R.1 P.1 F10.\n"),
                },
            ],
        ),
        held(
            "p. 290",
            "G77 after M05 runs without spindle as well.",
            "rule spindle-stopped-while-cutting",
            &[Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: cut!("M5\nG77 Z-.5 R-1.6 Q.1 F10.\n"),
                conforms: cut!("G77 Z-.5 R-1.6 Q.1 F10.\n"),
            }],
        ),
        held(
            "p. 291, p. 292",
            "G77 shifts by Q before it goes in and again after the cut, to clear the tool both ways; the cut goes from R, past the bottom of the part, up to Z. (The example shifts at R and back towards the centre after the cut, which would put the cut off the hole's axis.)",
            "effect `cycle-back-bore`",
            &[Makes {
                program: cut!("G77 Z-.5 R-1.6 Q.1 F10.\n").with(&["settings.27=\"x+\""]),
                block: "G77 Z-.5 R-1.6 Q.1 F10.",
                events: &[
                    "spindle stop",
                    "spindle orient",
                    "rapid X0.1",
                    "rapid Z-1.6",
                    "rapid X0",
                    "spindle clockwise",
                    "feed Z-0.5 F10",
                    "spindle stop",
                    "spindle orient",
                    "rapid X0.1",
                    "rapid Z0.1",
                    "rapid X0",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 291",
            "The direction of the shift of G77 is Setting 27 as well.",
            "`shift-setting` of the control",
            &[Run {
                program: cut!("G77 Z-.5 R-1.6 Q.1 F10.\n").with(&["settings.27=\"y-\""]),
                prints: &["feed 0.0000 0.0000 -0.5000", "rapid 0.0000 -0.1000 -0.5000"],
            }],
        ),
        held(
            "p. 292",
            "G77 goes back to the initial level, G98 or not.",
            "effect `cycle-back-bore`",
            &[Run {
                program: cut!("G99 G77 Z-.5 R-1.6 I.1 F10.\nX-2.\n"),
                prints: &[
                    "feed 0.0000 0.0000 -0.5000",
                    "rapid 0.0000 0.0000 0.1000",
                    "rapid -2.0000 0.0000 0.1000",
                ],
            }],
        ),
        held(
            "p. 292",
            "R of G77 lies below Z: past the bottom of the part.",
            "rule back-bore-r-above-z",
            &[Rule {
                finding: "warning[back-bore-r-above-z]",
                violates: cut!("G77 Z-1.6 R-.5 Q.1 F10.\n"),
                conforms: cut!("G77 Z-.5 R-1.6 Q.1 F10.\n"),
            }],
        ),
        held(
            "p. 292",
            "It repeats at each further position.",
            "words of cycles stay",
            &[Run {
                program: cut!("G77 Z-.5 R-1.6 I.1 F10.\nX-2.\n"),
                prints: &["rapid -2.0000 0.0000 0.1000", "feed -2.0000 0.0000 -0.5000"],
            }],
        ),
        held(
            "p. 300",
            "G85 feeds in and feeds out to R.",
            "effect `cycle-bore-feed-out`",
            &[
                Makes {
                    program: cut!("G85 G99 Z-.6 R.1 F5.\n"),
                    block: "G85 G99 Z-.6 R.1 F5.",
                    events: &["feed Z-0.6 F5", "feed Z0.1 F5"],
                },
                Makes {
                    program: cut!("G0 Z1.\nG85 G98 Z-.6 R.1 F5.\n"),
                    block: "G85 G98 Z-.6 R.1 F5.",
                    events: &["rapid Z0.1", "feed Z-0.6", "feed Z0.1", "rapid Z1"],
                },
            ],
        ),
        held(
            "p. 301",
            "G86 stops the spindle at the bottom and comes out with it stopped.",
            "effect `cycle-bore-stop`",
            &[Makes {
                program: cut!("G86 G99 Z-.6 R.1 F5.\n"),
                block: "G86 G99 Z-.6 R.1 F5.",
                events: &["feed Z-0.6 F5", "spindle stop", "rapid Z0.1", "spindle clockwise"],
            }],
        ),
        held(
            "p. 301",
            "G89 feeds in, pauses P, and feeds out.",
            "effect `cycle-bore-dwell`",
            &[Makes {
                program: cut!("G89 G99 Z-.6 R.1 P.3 F5.\n"),
                block: "G89 G99 Z-.6 R.1 P.3 F5.",
                events: &["feed Z-0.6", "dwell T0.3", "feed Z0.1 F5"],
            }],
        ),
        held(
            "p. 334",
            "G184 taps from the start position to X Y Z and back, G174 a left-hand thread; neither is modal.",
            "effects `tap-here`, `left-tap-here`",
            &[
                Makes {
                    program: cut!("G184 X0. Y0. Z-.5 F20. S400\n"),
                    block: "G184 X0. Y0. Z-.5 F20. S400",
                    events: &[
                        "spindle 400",
                        "spindle clockwise",
                        "feed Z-0.5 F20",
                        "spindle counter-clockwise",
                        "feed Z0.1 F20",
                        "spindle stop",
                    ],
                },
                Makes {
                    program: cut!("G174 X1. F20. S400\n"),
                    block: "G174 X1. F20. S400",
                    events: &[
                        "spindle 400",
                        "spindle counter-clockwise",
                        "feed X1 F20",
                        "spindle clockwise",
                        "feed X0 F20",
                        "spindle stop",
                    ],
                },
                Makes {
                    program: cut!("G184 X0. Y0. Z-.5 F20. S400\nX1.\n"),
                    block: "X1.",
                    events: &["rapid X1"],
                },
            ],
        ),
        held(
            "p. 334",
            "They tap along any line: X, Y and Z name the bottom.",
            "effect `tap-here`",
            &[Makes {
                program: cut!("G184 X1. Y-1. Z-.9 F20. S400\n"),
                block: "G184 X1. Y-1. Z-.9 F20. S400",
                events: &[
                    "spindle 400",
                    "spindle clockwise",
                    "feed X1 Y-1 Z-0.9 F20",
                    "spindle counter-clockwise",
                    "feed X0 Y0 Z0.1 F20",
                    "spindle stop",
                ],
            }],
        ),
        held(
            "p. 334",
            "F is required; feed and speed keep the ratio of the pitch.",
            "rule `feed-missing`",
            &[Rule {
                finding: "error[feed-missing]",
                violates: cut!("G184 Z-.5 S400\n"),
                conforms: cut!("G184 Z-.5 F20. S400\n"),
            }],
        ),
        held(
            "p. 334",
            "The control starts the spindle for G174 and G184.",
            "effect `tap-here`",
            &[
                Legal {
                    program: mill(
                        "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG184 Z-.6 F20. S400\nG28 G91 Z0.\nG90\nM30\n%\n",
                    ),
                },
                Legal {
                    program: mill(
                        "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG174 Z-.6 F20. S400\nG28 G91 Z0.\nG90\nM30\n%\n",
                    ),
                },
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
