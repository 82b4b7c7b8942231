//! G153, G155, G161 to G166, G169 (p. 322, 325 to 334), G234 (p. 335 to 338), G254 and G255 (p. 339 to 342): the
//! sentences of these pages and what proves them. G143 stands with the compensations, G174 and G184 with tapping.
//!
//! Left out: keys that end TCPC and DWO; the pictures of a workpiece out of place.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::mill::{explains, gap, held, mill, not_modelled};
use crate::proof::Proof::{Assumes, Legal, Makes, Rule, Run, Silent, Stands};
use crate::statements::statement::{Chapter, prove};

/// Tool 1 as the operator has measured it.
const TOOL: &str = "tools.1={length=4.0,diameter=0.5}";

/// A part whose zero is machine zero, with the tool upright.
const G54_AT_HOME: &str = "offsets.G54={X=0.0,Y=0.0,Z=0.0,A=0.0,B=0.0}";

/// Both rotary axes move the tool.
const TILTING_HEAD: &str = "machine.rotary=\"head-head\"";

/// Blocks at the start position of a hole along the tilted tool.
macro_rules! along_tool {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X8. Y-8. B23. A22. S1000 M3\nG143 H1 Z15.\nG1 G93 X7. Y-7. Z11. F60.\nG94 F10.\n",
            $blocks,
            "G0 Z15.\nG49 G53 Z0. M5\nM30\n"
        ))
    };
}

/// Blocks over a table that B and C have turned.
macro_rules! tilted_table {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G90 G54 B47. C116.\nX-.97 Y1.97 S1000 M3\n",
            $blocks,
            "G0 G53 Z0. M5\nM30\n"
        ))
    };
}

/// Blocks over a turned table, with the length on.
macro_rules! turned_table {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G90 G54 X0. Y0. B90. C0. S1000 M3\nG43 H1 Z5.\n",
            $blocks,
            "G0 G53 Z0. M5\nM30\n"
        ))
    };
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: cycles along the tool, TCPC, DWO",
    key: "FIV",
    file: "haas_mill/g_five_axis.rs",
    statements: &[
        held(
            "p. 326",
            "G161 feeds from the start position by E along the tilted tool, and comes back.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G161 E.52 F7.",
                events: &["feed X8.3597 Y-8.2 Z13.9701 F7", "rapid X8.5629 Y-8.3793 Z14.4139"],
            }],
        ),
        held(
            "p. 327",
            "G162 pauses P at the bottom.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G162 E.52 P2. F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G162 E.52 P2. F7.",
                events: &["feed X8.3597 Y-8.2 Z13.9701", "dwell T2", "rapid X8.5629 Y-8.3793 Z14.4139"],
            }],
        ),
        held(
            "p. 328",
            "G163 drills in pecks of Q along the tool, or with I, J, K as G83 does, and pauses P after the last one.",
            "effect `cycle-along-tool`",
            &[
                Run {
                    program: along_tool!("G163 E.6 Q.2 F12.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                    prints: &[
                        "feed 8.4848 -8.3103",
                        "feed 8.4066 -8.2414",
                        "feed 8.3285 -8.1724",
                        "rapid 8.5629 -8.3793",
                    ],
                },
                Run {
                    program: along_tool!("G163 E.6 I.3 J.1 K.1 P1.5 F12.\nG80\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    prints: &["feed 8.4457 -8.2759", "feed 8.3676", "feed 8.3285 -8.1724", "dwell"],
                },
            ],
        ),
        held(
            "p. 329",
            "Setting 52 takes G163 above its start position to clear chips.",
            "effect `cycle-along-tool`, Setting 52",
            &[Run {
                program: along_tool!("G163 E.6 Q.3 F12.\nG80\n").with(&[
                    TOOL,
                    G54_AT_HOME,
                    TILTING_HEAD,
                    "settings.52=1.0",
                ]),
                prints: &["feed 8.4457 -8.2759", "rapid 8.9537 -8.7241", "feed 8.3285 -8.1724"],
            }],
        ),
        held(
            "p. 322",
            "G153 drills in pecks and backs off by Setting 22 only.",
            "effect `cycle-along-tool`",
            &[Run {
                program: along_tool!("G153 E.6 Q.3 F12.\nG80\n").with(&[
                    TOOL,
                    G54_AT_HOME,
                    TILTING_HEAD,
                    "settings.22=0.1",
                ]),
                prints: &[
                    "feed 8.4457 -8.2759",
                    "rapid 8.4848 -8.3103",
                    "feed 8.3285 -8.1724",
                    "rapid 8.5629 -8.3793",
                ],
            }],
        ),
        held(
            "p. 330",
            "G164 taps right-hand threads with a floating holder; the control starts the spindle.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G164 E1. F38.46\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G164 E1. F38.46",
                events: &[
                    "spindle clockwise",
                    "feed X8.1722 Y-8.0345 Z13.5604 F38.46",
                    "spindle counter-clockwise",
                    "feed X8.5629 Y-8.3793 Z14.4139",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 325",
            "G155 taps left-hand threads with a floating holder; the control starts the spindle.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G155 E1. F38.46\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G155 E1. F38.46",
                events: &[
                    "spindle counter-clockwise",
                    "feed X8.1722 Y-8.0345 Z13.5604 F38.46",
                    "spindle clockwise",
                    "feed X8.5629 Y-8.3793 Z14.4139",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 331",
            "G165 feeds in and feeds out.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G165 E1. F12.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G165 E1. F12.",
                events: &["feed X8.1722 Y-8.0345 Z13.5604 F12", "feed X8.5629 Y-8.3793 Z14.4139 F12"],
            }],
        ),
        held(
            "p. 332",
            "G166 stops the spindle at the bottom before it comes out.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G166 E1. F12.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G166 E1. F12.",
                events: &[
                    "feed X8.1722 Y-8.0345 Z13.5604 F12",
                    "spindle stop",
                    "rapid X8.5629 Y-8.3793 Z14.4139",
                    "spindle clockwise",
                ],
            }],
        ),
        held(
            "p. 333",
            "G169 feeds in, pauses P and feeds out.",
            "effect `cycle-along-tool`",
            &[Makes {
                program: along_tool!("G169 E1. P.5 F12.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                block: "G169 E1. P.5 F12.",
                events: &[
                    "feed X8.1722 Y-8.0345 Z13.5604 F12",
                    "dwell T0.5",
                    "feed X8.5629 Y-8.3793 Z14.4139 F12",
                ],
            }],
        ),
        held(
            "p. 326",
            "The cycles are used with G143 in effect.",
            "`forbids` of `G143`",
            &[
                Legal {
                    program: along_tool!("G161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                },
                Legal {
                    program: along_tool!("G163 E1. Q.15 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                },
                Legal {
                    program: along_tool!("G169 E1. P.5 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                },
            ],
        ),
        held(
            "p. 326",
            "E, the depth from the start position, is needed.",
            "rule `lasting-word-never-given`",
            &[Rule {
                finding: "warning[lasting-word-never-given]",
                violates: along_tool!("G161 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                conforms: along_tool!("G161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
            }],
        ),
        held(
            "p. 322",
            "E, I, J, K and Q are positive.",
            "ranges of words",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: along_tool!("G161 E-.5 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                    conforms: along_tool!("G161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: along_tool!("G163 E1. Q-.1 F7.\nG80\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    conforms: along_tool!("G163 E1. Q.1 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: along_tool!("G153 E1. I-.3 J.1 K.1 F7.\nG80\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    conforms: along_tool!("G153 E1. I.3 J.1 K.1 F7.\nG80\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                },
            ],
        ),
        held(
            "p. 322 to 333",
            "A feed is programmed for them.",
            "rule `feed-missing`",
            &[Rule {
                finding: "error[feed-missing]",
                violates: mill(
                    "O1 (A)\nG20 G90 G54 G0 X8. Y-8. B23. A22. S1000 M3\nG43 H1 Z15.\nG161 E.5\nG80\nG49 G53 Z0.\nM30\n",
                ),
                conforms: mill(
                    "O1 (A)\nG20 G90 G54 G0 X8. Y-8. B23. A22. S1000 M3\nG43 H1 Z15.\nG161 E.5 F7.\nG80\nG49 G53 Z0.\nM30\n",
                ),
            }],
        ),
        held(
            "p. 322 to 333",
            "A position in X, Y, Z, A and B is programmed before the cycle.",
            "rule `tool-direction-unknown`",
            &[Rule {
                finding: "warning[tool-direction-unknown]",
                violates: mill(
                    "O1 (A)\nG20 G90 G54 G0 X8. Y-8. S1000 M3\nG43 H1 Z15.\nG161 E.5 F7.\nG80\nG49 G53 Z0.\nM30\n",
                ),
                conforms: mill(
                    "O1 (A)\nG20 G90 G54 G0 X8. Y-8. B23. A22. S1000 M3\nG43 H1 Z15.\nG161 E.5 F7.\nG80\nG49 G53 Z0.\nM30\n",
                ),
            }],
        ),
        held(
            "p. 326",
            "After M05 G161 runs without spindle.",
            "rule `spindle-stopped-while-cutting`",
            &[Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: along_tool!("M5\nG161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                conforms: along_tool!("G161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
            }],
        ),
        held(
            "p. 327",
            "After G80 the G01 before the cycle is in effect again: the way back to clearance is at feed.",
            "group `motion`",
            &[Run {
                program: along_tool!("G1 X7. F360.\nG161 E.52 F7.\nG80\nX8. Y-8. B23. A22. Z15.\n").with(&[
                    TOOL,
                    G54_AT_HOME,
                    TILTING_HEAD,
                ]),
                prints: &["feed 9.5629 -9.3793 18.4139"],
            }],
        ),
        held(
            "p. 322, p. 328",
            "P of one block holds for later ones; L repeats.",
            "words of the cycles",
            &[Legal {
                program: mill(
                    "O1 (A)\nG20 G90 G54 G0 X8. Y-8. Z15. B23. A22. S1000 M3\nG43 H1 Z11.\nG163 E.5 Q.2 P1.5 L1 F7.\nG80\nG0 Z15.\nG49 G53 Z0. M5\nM30\n",
                ),
            }],
        ),
        held(
            "p. 242, p. 326",
            "They belong to the group of canned cycles and end with G80.",
            "group `canned-cycle`",
            &[
                Rule {
                    finding: "error[two-codes-of-one-group]",
                    violates: along_tool!("G161 G81 E.52 F7.\nG80\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    conforms: along_tool!("G161 E.52 F7.\nG80\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                },
                explains("G161", "ended by: G80, G0, G1"),
            ],
        ),
        held(
            "p. 335, p. 337",
            "G234 keeps the programmed tip path while rotary axes turn the part; its X, Y, Z are those of the part.",
            "effect `tool-centre-point`",
            &[
                Legal {
                    program: tilted_table!("G234 H1 Z1.09\nG1 X-.5 Y1.1 Z.2 F40.\nX-.3 B46. C117.\nG49\n"),
                },
                Makes {
                    program: tilted_table!("G234 H1 Z1.09\nG1 X-.5 Y1.1 Z.2 F40.\nX-.3 B46. C117.\nG49\n"),
                    block: "X-.3 B46. C117.",
                    events: &["feed X-0.3 B46 C117"],
                },
            ],
        ),
        held(
            "p. 338",
            "H stands in the block of G234.",
            "need of `H`",
            &[Rule {
                finding: "error[required-word-missing]",
                violates: tilted_table!("G234 Z1.09\nG1 X-.5 F40.\nG49\n"),
                conforms: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\n"),
            }],
        ),
        held(
            "p. 338",
            "G43, G44 and G49 end G234, and G234 ends G43: they are one group.",
            "group `tool-length`",
            &[
                Rule {
                    finding: "error[two-codes-of-one-group]",
                    violates: tilted_table!("G234 G43 H1 Z1.09\nG49\n"),
                    conforms: tilted_table!("G234 H1 Z1.09\nG49\n"),
                },
                explains("G234", "ended by: G49, G43, G44"),
                Silent {
                    rule: "tool-tilt-left-on",
                    program: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\nT2 M6\n"),
                },
            ],
        ),
        held(
            "p. 338",
            "M00 and M01 do not end it.",
            "effect `tool-centre-point`",
            &[
                Legal { program: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\nM1\n") },
                Rule {
                    finding: "warning[tool-tilt-left-on]",
                    violates: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nM1\nT2 M6\nG49\n"),
                    conforms: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\nM1\nT2 M6\n"),
                },
            ],
        ),
        held(
            "p. 338",
            "G234 and G254 do not go together.",
            "rule `tilt-modes-conflict`",
            &[
                Rule {
                    finding: "error[tilt-modes-conflict]",
                    violates: tilted_table!("G254\nG234 H1 Z1.09\nG1 X-.5 F40.\nG49\nG255\n"),
                    conforms: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\n"),
                },
                Rule {
                    finding: "error[tilt-modes-conflict]",
                    violates: tilted_table!("G234 H1 Z1.09\nG254\nG1 X-.5 F40.\nG255\nG49\n"),
                    conforms: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\n"),
                },
            ],
        ),
        held(
            "p. 338",
            "M02 and M30 end G234.",
            "`at-end`",
            &[Legal { program: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG0 Z1.\n") }],
        ),
        gap(
            "p. 338",
            "G53 ignores G234.",
            "a G53 under G234 puts the axes it names where it says in machine coordinates: known afterwards",
            &[Stands {
                program: tilted_table!("G234 H1 Z1.09\nG53 Z-1.\nG49\n"),
                after: "G53 Z-1.",
                at: "MZ-1",
            }],
        ),
        held(
            "p. 338",
            "A tool change ignores G234, so that it is ended before.",
            "rules `tool-tilt-left-on`, `reference-return-under-tilt`",
            &[Rule {
                finding: "info[reference-return-under-tilt]",
                violates: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG28 G91 Z0.\nG90 G49\n"),
                conforms: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\nG28 G91 Z0.\nG90\n"),
            }],
        ),
        held(
            "p. 338",
            "G234 needs a work offset in effect.",
            "rule `work-offset-never-chosen`",
            &[Rule {
                finding: "warning[work-offset-never-chosen]",
                violates: mill(
                    "O1 (A)\nG20 G90 G0 B47. C116.\nT1 M6\nS1000 M3\nG234 H1 Z1.09\nG1 X-.5 F40.\nG49\nG53 Z0.\nM30\n",
                ),
                conforms: tilted_table!("G234 H1 Z1.09\nG1 X-.5 F40.\nG49\n"),
            }],
        ),
        not_modelled(
            "p. 338",
            "G234 turns the work envelope: near the limits of travel it can alarm.",
            "the rotary zero point of the machine (Settings 255 to 257, 300 to 305) is not part of the configuration; machine coordinates under G234 are unknown",
        ),
        not_modelled(
            "p. 335, p. 398 to 400",
            "Settings 255 to 257 say where the rotary axes turn; Settings 300 to 305 win over them where two rotary axes stand on one another.",
            "as above: gcheck states the tip's path in the part, which does not depend on them",
        ),
        held(
            "p. 339",
            "G254 carries the work offset along with the rotary axes for positioned work; G255 ends it.",
            "effects `dynamic-offset-on`, `dynamic-offset-off`",
            &[
                Legal { program: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n") },
                Makes {
                    program: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
                    block: "X1. Y0.",
                    events: &["rapid X1 Y0"],
                },
            ],
        ),
        held(
            "p. 339",
            "After G254 X, Y and Z are programmed before a cut, even where the tool stands already.",
            "rule `dynamic-offset-without-position`",
            &[Rule {
                finding: "warning[dynamic-offset-without-position]",
                violates: turned_table!("G254\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
            }],
        ),
        held(
            "p. 339",
            "X and Y stand in one block, Z in the next.",
            "rule `dynamic-offset-approach-in-one-block`",
            &[Rule {
                finding: "info[dynamic-offset-approach-in-one-block]",
                violates: turned_table!("G254\nX1. Y0. Z2.\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
            }],
        ),
        held(
            "p. 339, p. 342",
            "G255 comes before any rotary motion.",
            "rule `rotary-motion-under-dynamic-offset`",
            &[Rule {
                finding: "warning[rotary-motion-under-dynamic-offset]",
                violates: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nB0. C0.\nG255\n"),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\nG53 Z0.\nB0. C0.\n"),
            }],
        ),
        held(
            "p. 339, p. 342",
            "G254 is not for cutting with rotary axes.",
            "rule `rotary-motion-under-dynamic-offset`",
            &[Rule {
                finding: "warning[rotary-motion-under-dynamic-offset]",
                violates: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. B85. F20.\nG0 Z2.\nG255\n"),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
            }],
        ),
        gap(
            "p. 339",
            "The B value of the work offset is zero for G254.",
            "a work offset that is configured with B other than 0 under G254: warning",
            &[Rule {
                finding: "warning[dynamic-offset-with-tilted-zero]",
                violates: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n")
                    .with(&["offsets.G54={X=0.0,Y=0.0,Z=0.0,B=5.0,C=0.0}"]),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n")
                    .with(&["offsets.G54={X=0.0,Y=0.0,Z=0.0,B=0.0,C=0.0}"]),
            }],
        ),
        held(
            "p. 342",
            "A work offset is in effect before G254.",
            "rule `work-offset-never-chosen`",
            &[Rule {
                finding: "warning[work-offset-never-chosen]",
                violates: mill(
                    "O1 (A)\nG20 G90 G0 B90. C0.\nT1 M6\nS1000 M3\nG43 H1 Z5.\nG254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG255\nG53 G0 Z0.\nM30\n",
                ),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\n"),
            }],
        ),
        held(
            "p. 342",
            "G28 and G29 are not to be used while G254 is on.",
            "rule `reference-return-under-tilt`",
            &[Rule {
                finding: "info[reference-return-under-tilt]",
                violates: turned_table!("G254\nX1. Y0.\nZ2.\nG28 G91 Z0.\nG90 G255\n"),
                conforms: turned_table!("G254\nX1. Y0.\nZ2.\nG1 Z0. F20.\nG0 Z2.\nG255\nG28 G91 Z0.\nG90\n"),
            }],
        ),
        gap(
            "p. 342",
            "G53 ignores G254: the tool retracts in machine coordinates.",
            "a G53 under G254 puts the axes it names where it says in machine coordinates: known afterwards",
            &[Stands {
                program: turned_table!("G254\nX1. Y0.\nZ2.\nG53 Z-1.\nG255\n"),
                after: "G53 Z-1.",
                at: "MZ-1",
            }],
        ),
        held(
            "p. 342",
            "M00 and M01 do not end G254, M02 and M30 do.",
            "`at-end`",
            &[Legal { program: turned_table!("G254\nX1. Y0.\nZ2.\nM1\nS1000 M3\nG1 Z0. F20.\nG0 Z2.\n") }],
        ),
        held(
            "p. 342",
            "G254 is off at the start.",
            "default of group `dynamic-offset`",
            &[Assumes { program: turned_table!("G1 Z4. F10.\n"), says: "G255" }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
