//! G70, G71 and G72 (p. 285 to 287): the sentences of these pages and what proves them.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::held;
use crate::proof::Proof::{Makes, Rule};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: patterns of holes",
    key: "PAT",
    file: "haas_mill/g_patterns.rs",
    statements: &[
        held(
            "p. 285",
            "G70 works L holes spread evenly on a circle of radius I about the present position, the first at angle J from 3 o'clock, counter-clockwise.",
            "effect `bolt-circle`",
            &[Makes {
                program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J90. L4\n"),
                block: "G70 I5. J90. L4",
                events: &[
                    "rapid Y5",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                    "rapid X-5 Y0",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                    "rapid X0 Y-5",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                    "rapid X5 Y0",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                ],
            }],
        ),
        held(
            "p. 285",
            "J of G70 is the angle of the first hole, counted from 3 o'clock; it is optional, and 0 without it (the 0 is our reading).",
            "default of `J`",
            &[Makes {
                program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. L2\n"),
                block: "G70 I5. L2",
                events: &[
                    "rapid X5",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                    "rapid X-5",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                ],
            }],
        ),
        held(
            "p. 285",
            "J of G70 is 0 to 360 degrees.",
            "range of `J`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J361. L4\n"),
                conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J360. L4\n"),
            }],
        ),
        held(
            "p. 285",
            "I and L of G70 are required.",
            "needs of words",
            &[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 J15. L4\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J15. L4\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J15.\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J15. L4\n"),
                },
            ],
        ),
        held(
            "p. 286",
            "G71 works L holes on an arc: radius I, first angle J, K degrees from hole to hole, clockwise when negative.",
            "effect `bolt-arc`",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. J90. K90. L2\n"),
                    block: "G71 I5. J90. K90. L2",
                    events: &[
                        "rapid Y5",
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                        "rapid X-5 Y0",
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                    ],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. J90. K-90. L2\n"),
                    block: "G71 I5. J90. K-90. L2",
                    events: &[
                        "rapid Y5",
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                        "rapid X5 Y0",
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                    ],
                },
            ],
        ),
        held(
            "p. 286",
            "I, K and L of G71 are required; J may be left out.",
            "needs of words",
            &[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. L3\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. K30. L3\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 K30. L3\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. K30. L3\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. K30.\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. K30. L3\n"),
                },
            ],
        ),
        held(
            "p. 286",
            "G72 works L holes on a line from the present position at angle J, I apart.",
            "effect `bolt-line`",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 I1. J90. L3\n"),
                    block: "G72 I1. J90. L3",
                    events: &[
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                        "rapid Y1",
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                        "rapid Y2",
                        "feed Z-0.5 F6.5",
                        "rapid Z0.1",
                    ],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 I1. L2\n"),
                    block: "G72 I1. L2",
                    events: &["feed Z-0.5 F6.5", "rapid Z0.1", "rapid X1", "feed Z-0.5 F6.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 286",
            "I and L of G72 are required.",
            "needs of words",
            &[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 J90. L3\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 I1. J90. L3\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 I1. J90.\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 I1. J90. L3\n"),
                },
            ],
        ),
        held(
            "p. 285, p. 286",
            "G70, G71 and G72 need an active canned cycle.",
            "rule `pattern-without-cycle`",
            &[
                Rule {
                    finding: "warning[pattern-without-cycle]",
                    violates: cut!("G70 I5. J15. L3\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. J15. L3\n"),
                },
                Rule {
                    finding: "warning[pattern-without-cycle]",
                    violates: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG80\nG71 I5. K30. L3\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG71 I5. K30. L3\n"),
                },
                Rule {
                    finding: "warning[pattern-without-cycle]",
                    violates: cut!("G72 I5. L3\n"),
                    conforms: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG72 I5. L3\n"),
                },
            ],
        ),
        held(
            "p. 285",
            "Any of G73, G74, G76, G77 and G81 to G89 may be the cycle of a pattern.",
            "effect `bolt-circle`",
            &[
                Makes {
                    program: cut!("G73 G99 Z-.3 R.1 Q.2 F5. L0\nG70 I1. L1\n").with(&["settings.22=0.1"]),
                    block: "G73 G99 Z-.3 R.1 Q.2 F5. L0",
                    events: &[],
                },
                Makes {
                    program: cut!("G82 G99 Z-.3 R.1 P.5 F5. L0\nG70 I1. L1\n"),
                    block: "G70 I1. L1",
                    events: &["rapid X1", "feed Z-0.3", "dwell T0.5", "rapid Z0.1"],
                },
                Makes {
                    program: cut!("G85 G99 Z-.3 R.1 F5. L0\nG70 I1. L1\n"),
                    block: "G70 I1. L1",
                    events: &["rapid X1", "feed Z-0.3", "feed Z0.1"],
                },
            ],
        ),
        held(
            "p. 285, p. 286",
            "They are not modal: the next position of the cycle is a hole by itself.",
            "group `one-shot`",
            &[Makes {
                program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. L2\nX1. Y0.\n"),
                block: "X1. Y0.",
                events: &["rapid X1", "feed Z-0.5 F6.5", "rapid Z0.1"],
            }],
        ),
        held(
            "p. 244, p. 286",
            "L0 in the cycle's block keeps the centre from being drilled.",
            "`repeat = \"L\"`",
            &[
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5 L0\nG70 I5. L2\n"),
                    block: "G81 G99 Z-.5 R.1 F6.5 L0",
                    events: &[],
                },
                Makes {
                    program: cut!("G81 G99 Z-.5 R.1 F6.5\nG70 I5. L2\n"),
                    block: "G81 G99 Z-.5 R.1 F6.5",
                    events: &["feed Z-0.5 F6.5", "rapid Z0.1"],
                },
            ],
        ),
        held(
            "p. 244",
            "The centre may be reached by X and Y before the cycle.",
            "effect `bolt-circle`",
            &[Makes {
                program: cut!("X1.25 Y-.75\nG81 G99 Z-.5 R.1 F6.5 L0\nG70 I.75 J0. L2\n"),
                block: "G70 I.75 J0. L2",
                events: &[
                    "rapid X2",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                    "rapid X0.5",
                    "feed Z-0.5 F6.5",
                    "rapid Z0.1",
                ],
            }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
