//! G00 to G04, G09, G60, G61 and G64 (p. 248 to 258, 281): the sentences of these pages and what proves them.
//!
//! Left out: figures, the arithmetic of thread milling as a technique, advice on climb cutting.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{explains, held, not_modelled};
use crate::proof::Proof::{Legal, Makes, Rule, Run, Silent};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: moves, corners, arcs, dwell",
    key: "MOV",
    file: "haas_mill/g_moves.rs",
    statements: &[
        held(
            "p. 248",
            "G00 moves the named axes at their highest speed and holds until another code of group 01.",
            "effect `rapid`",
            &[
                Makes { program: cut!("G0 X1. Y2.\nX3.\n"), block: "G0 X1. Y2.", events: &["rapid X1 Y2"] },
                Makes { program: cut!("G0 X1. Y2.\nX3.\n"), block: "X3.", events: &["rapid X3"] },
            ],
        ),
        held(
            "p. 248",
            "Rotary axes may be named in a rapid move.",
            "words of `G0`",
            &[Makes {
                program: cut!("G0 X1. A90. B10. C5.\n"),
                block: "G0 X1. A90. B10. C5.",
                events: &["rapid X1 A90 B10 C5"],
            }],
        ),
        held(
            "p. 248",
            "At rapid each axis goes at its own highest speed; the longest way of one axis decides when the next block starts.",
            "times of rapid moves",
            &[Makes {
                program: cut!("G0 X1. Y2.\n").with(&["machine.rapid=1000.0"]),
                block: "G0 X1. Y2.",
                events: &["rapid X1 Y2 T0.12"],
            }],
        ),
        not_modelled(
            "p. 248, p. 249",
            "In general the way of a rapid move is not one straight line: each axis goes at its own highest speed.",
            "which way depends on the machine and on Setting 335; ends and times of rapid moves are what gcheck states, and pictures draw straight lines",
        ),
        held(
            "p. 249",
            "G01 moves straight at feed F, in one axis or several that arrive together, until G00, G02 or G03.",
            "effect `linear`",
            &[
                Makes {
                    program: cut!("G1 X1. Y1. Z-1. F10.\nX2.\nG0 X3.\n"),
                    block: "G1 X1. Y1. Z-1. F10.",
                    events: &["feed X1 Y1 Z-1 F10 T10.7499"],
                },
                Makes {
                    program: cut!("G1 X1. Y1. Z-1. F10.\nX2.\nG0 X3.\n"),
                    block: "X2.",
                    events: &["feed X2 F10"],
                },
            ],
        ),
        held(
            "p. 249",
            "F stays in effect until another F.",
            "feed of the state",
            &[
                Makes {
                    program: cut!("G1 X1. F10.\nX2.\nX3. F20.\nX4.\n"),
                    block: "X2.",
                    events: &["feed X2 F10"],
                },
                Makes {
                    program: cut!("G1 X1. F10.\nX2.\nX3. F20.\nX4.\n"),
                    block: "X4.",
                    events: &["feed X4 F20"],
                },
            ],
        ),
        held(
            "p. 249",
            "F counts per minute under G94, per revolution under G95.",
            "effects of group `feed-mode`",
            &[
                Makes {
                    program: cut!("G95 G1 X1. F.01\nG94\n"),
                    block: "G95 G1 X1. F.01",
                    events: &["feed X1 F0.01 T6"],
                },
                Makes {
                    program: cut!("G94 G1 X1. F10.\n"),
                    block: "G94 G1 X1. F10.",
                    events: &["feed X1 F10 T6"],
                },
            ],
        ),
        held(
            "p. 249",
            "A feed above what an axis can do alarms.",
            "rule `feed-above-machine-limit`",
            &[Rule {
                finding: "warning[feed-above-machine-limit]",
                violates: cut!("G1 X1. F600.\n").with(&["machine.max_feed=500"]),
                conforms: cut!("G1 X1. F400.\n").with(&["machine.max_feed=500"]),
            }],
        ),
        held(
            "p. 250, p. 251",
            ",C between two straight moves cuts a chamfer: its value is the distance from the corner to where it begins and to where it ends.",
            "words `,C` and `,R` of `G1`",
            &[Run {
                program: cut!("G1 Y-5. ,C1. F20.\nX-5.\n"),
                prints: &["feed 0.0000 -4.0000", "feed -1.0000 -5.0000", "feed -5.0000 -5.0000"],
            }],
        ),
        held(
            "p. 250, p. 251",
            ",R between two straight moves cuts an arc of that radius, tangent to both.",
            "words `,C` and `,R` of `G1`",
            &[
                Run {
                    program: cut!("G1 X-5. ,R1. F20.\nY5.\n"),
                    prints: &["feed -4.0000 0.0000", "arc -5.0000 1.0000", "feed -5.0000 5.0000"],
                },
                Makes {
                    program: cut!("G1 X-5. ,R1. F20.\nY5.\n"),
                    block: "Y5.",
                    events: &["feed Y5 F20 T12"],
                },
            ],
        ),
        held(
            "p. 251",
            "Blocks with corners may follow each other.",
            "words `,C` and `,R` of `G1`",
            &[Run {
                program: cut!("G1 Y-5. ,C1. F20.\nX-5. ,R1.\nY0.\n"),
                prints: &[
                    "feed 0.0000 -4.0000",
                    "feed -1.0000 -5.0000",
                    "feed -4.0000 -5.0000",
                    "-5.0000 -4.0000",
                    "feed -5.0000 0.0000",
                ],
            }],
        ),
        held(
            "p. 250",
            "A corner needs a straight move as the next one.",
            "rule `corner-before-rapid`",
            &[
                Rule {
                    finding: "warning[corner-before-rapid]",
                    violates: cut!("G1 X1. ,C.2 F10.\nG0 Y1.\n"),
                    conforms: cut!("G1 X1. ,C.2 F10.\nY1.\n"),
                },
                Rule {
                    finding: "warning[corner-before-rapid]",
                    violates: cut!("G1 X1. ,R.2 F10.\nG0 Y1.\n"),
                    conforms: cut!("G1 X1. ,R.2 F10.\nY1.\n"),
                },
            ],
        ),
        held(
            "p. 250",
            "An arc or the end of the cut cannot close a corner either.",
            "rule `corner-does-not-fit`",
            &[Rule {
                finding: "warning[corner-does-not-fit]",
                violates: cut!("G1 X1. ,C.2 F10.\nG2 X2. Y-1. R1.\n"),
                conforms: cut!("G1 X1. ,C.2 F10.\nY1.\n"),
            }],
        ),
        held(
            "p. 250",
            "A G04 may stand between the two blocks of a corner.",
            "rule `corner-before-rapid`",
            &[Legal { program: cut!("G1 X1. ,C.2 F10.\nG4 P1.\nY1.\n") }],
        ),
        held(
            "p. 251",
            "Both moves of a corner must move in the axes of the active plane.",
            "rule `corner-does-not-fit`",
            &[Rule {
                finding: "warning[corner-does-not-fit]",
                violates: cut!("G1 X1. ,R.2 F10.\nZ-1.\n"),
                conforms: cut!("G1 X1. ,R.2 F10.\nY1.\n"),
            }],
        ),
        held(
            "p. 251",
            "Corners are cut in XZ under G18 and in YZ under G19.",
            "words `,C` and `,R` of `G1`",
            &[
                Run {
                    program: cut!("G18 G1 X1. ,C.2 F10.\nZ-.9\nG17\n"),
                    prints: &[
                        "feed 0.8000 0.0000 0.1000",
                        "feed 1.0000 0.0000 -0.1000",
                        "feed 1.0000 0.0000 -0.9000",
                    ],
                },
                Run {
                    program: cut!("G19 G1 Y1. ,C.2 F10.\nZ-.9\nG17\n"),
                    prints: &[
                        "feed 0.0000 0.8000 0.1000",
                        "feed 0.0000 1.0000 -0.1000",
                        "feed 0.0000 1.0000 -0.9000",
                    ],
                },
            ],
        ),
        held(
            "p. 251",
            "G02 is clockwise, G03 counter-clockwise; both hold until another code of group 01.",
            "effects `arc-clockwise`, `arc-counter-clockwise`",
            &[
                Makes {
                    program: cut!("G2 X1. Y1. I1. F10.\nX2. Y0. J-1.\n"),
                    block: "G2 X1. Y1. I1. F10.",
                    events: &["arc X1 Y1 S-90 I1 J0"],
                },
                Makes {
                    program: cut!("G2 X1. Y1. I1. F10.\nX2. Y0. J-1.\n"),
                    block: "X2. Y0. J-1.",
                    events: &["arc X2 Y0 S-90"],
                },
                Makes {
                    program: cut!("G3 X1. Y1. J1. F10.\n"),
                    block: "G3 X1. Y1. J1. F10.",
                    events: &["arc X1 Y1 S90 I0 J1"],
                },
            ],
        ),
        held(
            "p. 251",
            "I, J, K lead from the start to the centre.",
            "words of `G2`",
            &[Makes {
                program: cut!("G0 X1. Y1.\nG2 X3. I1. F10.\n"),
                block: "G2 X3. I1. F10.",
                events: &["arc X3 S-180 I2 J1"],
            }],
        ),
        held(
            "p. 251",
            "Under G17 an arc takes I and J; another centre word is refused.",
            "rule `arc-wrong-plane-word`",
            &[
                Rule {
                    finding: "warning[arc-wrong-plane-word]",
                    violates: cut!("G2 X2. I1. K1. F10.\n"),
                    conforms: cut!("G2 X2. I1. J0. F10.\n"),
                },
                Rule {
                    finding: "warning[arc-wrong-plane-word]",
                    violates: cut!("G18 G2 X2. I1. J1. F10.\nG17\n"),
                    conforms: cut!("G18 G2 X2. I1. K0. F10.\nG17\n"),
                },
                Rule {
                    finding: "warning[arc-wrong-plane-word]",
                    violates: cut!("G19 G2 Y2. J1. I1. F10.\nG17\n"),
                    conforms: cut!("G19 G2 Y2. J1. K0. F10.\nG17\n"),
                },
            ],
        ),
        held(
            "p. 251",
            "An arc with the centre word of another plane only has no centre.",
            "rule `arc-wrong-plane-word`",
            &[
                Rule {
                    finding: "warning[arc-wrong-plane-word]",
                    violates: cut!("G2 X1. Y1. K1. F10.\n"),
                    conforms: cut!("G2 X1. Y1. I1. F10.\n"),
                },
                Rule {
                    finding: "warning[arc-wrong-plane-word]",
                    violates: cut!("G18 G2 X1. Z-.9 J1. F10.\nG17\n"),
                    conforms: cut!("G18 G2 X1. Z-.9 I1. F10.\nG17\n"),
                },
            ],
        ),
        held(
            "p. 251",
            "An arc needs a centre or a radius.",
            "rule `arc-without-centre`",
            &[Rule {
                finding: "error[arc-without-centre]",
                violates: cut!("G2 X1. Y1. F10.\n"),
                conforms: cut!("G2 X1. Y1. R1. F10.\n"),
            }],
        ),
        held(
            "p. 251",
            "Without a word for an axis of the plane the arc ends at the start's coordinate of that axis.",
            "effect of arcs",
            &[Makes {
                program: cut!("G2 X2. I1. F10.\n"),
                block: "G2 X2. I1. F10.",
                events: &["arc X2 S-180"],
            }],
        ),
        held(
            "p. 251",
            "A full circle names no end point and takes I, J or K.",
            "effect of arcs",
            &[Makes {
                program: cut!("G2 I3. J4. F10.\n"),
                block: "G2 I3. J4. F10.",
                events: &["arc F10 S-360 I3 J4 T188.4956"],
            }],
        ),
        held(
            "p. 251",
            "A full circle by R does not work.",
            "rule `full-circle-by-radius`",
            &[
                Rule {
                    finding: "error[full-circle-by-radius]",
                    violates: cut!("G2 R1. F10.\n"),
                    conforms: cut!("G2 I1. F10.\n"),
                },
                Rule {
                    finding: "error[full-circle-by-radius]",
                    violates: cut!("G2 X0. Y0. R1. F10.\n"),
                    conforms: cut!("G2 X1. Y1. R1. F10.\n"),
                },
            ],
        ),
        held(
            "p. 252",
            "R above zero is the arc of at most 180 degrees, R below zero the one of more.",
            "words of `G2`",
            &[
                Makes {
                    program: cut!("G2 X1. Y1. R1. F10.\n"),
                    block: "G2 X1. Y1. R1. F10.",
                    events: &["arc X1 Y1 S-90 I1 J0"],
                },
                Makes {
                    program: cut!("G2 X1. Y1. R-1. F10.\n"),
                    block: "G2 X1. Y1. R-1. F10.",
                    events: &["arc X1 Y1 S-270 I0 J1"],
                },
                Makes {
                    program: cut!("G3 X2. R1. F10.\n"),
                    block: "G3 X2. R1. F10.",
                    events: &["arc X2 S180 I1 J0"],
                },
            ],
        ),
        held(
            "p. 251",
            "R and I, J, K are two ways to give one arc, not for one block.",
            "rule `arc-centre-and-radius`",
            &[Rule {
                finding: "warning[arc-centre-and-radius]",
                violates: cut!("G2 X1. Y1. I1. R1. F10.\n"),
                conforms: cut!("G2 X1. Y1. R1. F10.\n"),
            }],
        ),
        held(
            "p. 253",
            "A linear axis outside the plane makes a helix: a thread mill climbs or sinks by one pitch a turn.",
            "effect of arcs",
            &[Makes {
                program: cut!("G2 I-1. Z-.05 F5.\n"),
                block: "G2 I-1. Z-.05 F5.",
                events: &["arc Z-0.05 S-360 I-1"],
            }],
        ),
        held(
            "p. 258",
            "The feed of a helix is the speed along the helix.",
            "times of arcs",
            &[Makes {
                program: cut!("G3 I-1. Z-.5 F10.\n"),
                block: "G3 I-1. Z-.5 F10.",
                events: &["arc Z-0.5 T37.8706"],
            }],
        ),
        held(
            "p. 258",
            "A helix is possible in the other planes too.",
            "effect of arcs",
            &[Makes {
                program: cut!("G18 G2 X1. Z-.9 I1. Y.5 F10.\nG17\n"),
                block: "G18 G2 X1. Z-.9 I1. Y.5 F10.",
                events: &["arc X1 Y0.5 Z-0.9"],
            }],
        ),
        held(
            "p. 257, p. 258",
            "L repeats an arc or helix: under G91 each turn goes on from the last.",
            "word `L` of `G2` and `G3`",
            &[
                Run {
                    program: cut!("G0 X.5\nG91 G3 I-.5 J0 Z.125 L3 F20.\nG90\n"),
                    prints: &["0.5000 0.0000 0.2250", "0.5000 0.0000 0.3500", "0.5000 0.0000 0.4750"],
                },
                Silent {
                    rule: "word-not-read",
                    program: cut!("G0 X.5\nG91 G3 I-.5 J0 Z.125 L3 F20.\nG90\n"),
                },
            ],
        ),
        held(
            "p. 257",
            "L on a straight move repeats it, under G91 step by step.",
            "word `L` of `G1`",
            &[Run {
                program: cut!("G91 G1 X.5 L3 F20.\nG90\n"),
                prints: &["feed 0.5000", "feed 1.0000", "feed 1.5000"],
            }],
        ),
        held(
            "p. 254",
            "Cutter compensation cannot begin or end on an arc.",
            "rules `compensation-on-in-arc`, `compensation-off-in-arc`",
            &[
                Rule {
                    finding: "warning[compensation-on-in-arc]",
                    violates: cut!("G41 D1 G2 X1. Y1. R1. F10.\nG40 G1 X3.\n"),
                    conforms: cut!("G41 D1 G1 X1. F10.\nG2 X2. Y-1. R1.\nG40 G1 X3.\n"),
                },
                Rule {
                    finding: "warning[compensation-off-in-arc]",
                    violates: cut!("G41 D1 G1 X1. F10.\nG2 X2. Y-1. R1.\nG40 G2 X1. Y-2. R1.\n"),
                    conforms: cut!("G41 D1 G1 X1. F10.\nG2 X2. Y-1. R1.\nG40 G1 X3.\n"),
                },
                Rule {
                    finding: "error[codes-conflict]",
                    violates: cut!("G41 D1 G2 X1. Y1. R1. F10.\nG40 G1 X3.\n"),
                    conforms: cut!("G41 D1 G1 X1. F10.\nG2 X2. Y-1. R1.\nG40 G1 X3.\n"),
                },
            ],
        ),
        held(
            "p. 254, p. 257",
            "A move that begins or ends compensation may go any way in X or Y, as long as it is longer than the offset.",
            "rule `lead-in-too-short`",
            &[Rule {
                finding: "warning[lead-in-too-short]",
                violates: cut!("G41 D1 G1 X.05 F10.\nY1.\nX2.\nG40 Y2.\n").with(&["tools.1={diameter=0.5}"]),
                conforms: cut!("G41 D1 G1 X.5 F10.\nY1.\nX2.\nG40 Y2.\n").with(&["tools.1={diameter=0.5}"]),
            }],
        ),
        not_modelled(
            "p. 253, p. 254",
            "Inside right-hand threads are milled upwards with G03, outside ones downwards with G02.",
            "a technique, not what the control does: hand of the thread, cutter and side of the cut are not in the program",
        ),
        held(
            "p. 258",
            "G04 waits; P counts seconds with a decimal point, milliseconds without.",
            "`dwell` of `execution.toml`",
            &[
                Makes { program: cut!("G4 P10.\n"), block: "G4 P10.", events: &["dwell T10"] },
                Makes { program: cut!("G4 P10\n"), block: "G4 P10", events: &["dwell T0.01"] },
                Makes { program: cut!("G4 P1500\n"), block: "G4 P1500", events: &["dwell T1.5"] },
                Rule {
                    finding: "info[dwell-very-short]",
                    violates: cut!("G4 P10\n"),
                    conforms: cut!("G4 P10.\n"),
                },
            ],
        ),
        held(
            "p. 258",
            "The time of G04 stands in P.",
            "rules `required-word-missing`, `dwell-time-in-other-word`",
            &[
                Rule {
                    finding: "warning[required-word-missing]",
                    violates: cut!("G4\n"),
                    conforms: cut!("G4 P1.\n"),
                },
                Rule {
                    finding: "warning[dwell-time-in-other-word]",
                    violates: cut!("G4 X1.\n"),
                    conforms: cut!("G4 P1.\n"),
                },
            ],
        ),
        held(
            "p. 258",
            "G09 stops exactly at the end of its own block; it is not modal and changes no point.",
            "no effect; text of `G9`",
            &[
                Legal { program: cut!("G9 G1 X1. F10.\nX2.\n") },
                Makes {
                    program: cut!("G9 G1 X1. F10.\nX2.\n"),
                    block: "G9 G1 X1. F10.",
                    events: &["feed X1 F10"],
                },
                explains("G9", "for its own block"),
            ],
        ),
        held(
            "p. 281",
            "G60 arrives from the positive side at rapid; it is not modal.",
            "effect `rapid`, group `one-shot`",
            &[
                Makes {
                    program: cut!("G1 F10. X.5\nG60 X1.\nX2.\n"),
                    block: "G60 X1.",
                    events: &["rapid X1"],
                },
                Makes {
                    program: cut!("G1 F10. X.5\nG60 X1.\nX2.\n"),
                    block: "X2.",
                    events: &["feed X2 F10"],
                },
            ],
        ),
        not_modelled(
            "p. 281, p. 379",
            "Setting 35 is how far G60 runs past the point before it comes back.",
            "the overshoot stays within the move's end by a fraction of a millimetre on machines that no longer need it; the code is kept for old programs",
        ),
        held(
            "p. 281",
            "G61 stops exactly after every move until G64.",
            "group `path-control`",
            &[
                Legal { program: cut!("G61\nG1 X1. F10.\nX2.\nG64\n") },
                Rule {
                    finding: "error[two-codes-of-one-group]",
                    violates: cut!("G61 G64 X1.\n"),
                    conforms: cut!("G61 X1.\nG64\n"),
                },
                explains("G61", "ended by: G64"),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
