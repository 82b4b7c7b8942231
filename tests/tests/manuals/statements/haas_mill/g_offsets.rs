//! G10, G52, G54 to G59, G92, G110 to G129 and G154 (p. 259, 280, 281, 302, 308, 323): the sentences of these pages
//! and what proves them.
//!
//! Left out: the offset pages of the screen.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{held, mill};
use crate::proof::Proof::{Legal, Makes, Rule, Run, Silent, Stands};
use crate::statements::statement::{Chapter, prove};

/// Where the part lies.
const G54: &str = "offsets.G54={X=-10.0,Y=-5.0,Z=-8.0}";

/// Tool 1 as the operator has measured it.
const TOOL: &str = "tools.1={length=4.0,diameter=0.5}";

/// Where another part lies.
const G55: &str = "offsets.G55={X=-20.0,Y=-6.0,Z=-8.0}";

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: offsets and work coordinates",
    key: "OFS",
    file: "haas_mill/g_offsets.rs",
    statements: &[
        held(
            "p. 259",
            "G10 sets offsets from the program; nothing moves.",
            "effect `write-offsets`",
            &[
                Makes { program: cut!("G10 L2 P1 X6. Y1.\n"), block: "G10 L2 P1 X6. Y1.", events: &[] },
                Legal { program: cut!("G10 L2 P1 X6. Y1.\n") },
            ],
        ),
        held(
            "p. 259",
            "L chooses the table.",
            "word `L` of `G10`",
            &[Rule {
                finding: "error[required-word-missing]",
                violates: cut!("G10 P1 X1.\n"),
                conforms: cut!("G10 L2 P1 X1.\n"),
            }],
        ),
        held(
            "p. 259",
            "P chooses the line of the table.",
            "word `P` of `G10`",
            &[Rule {
                finding: "error[required-word-missing]",
                violates: cut!("G10 L2 X1.\n"),
                conforms: cut!("G10 L2 P1 X1.\n"),
            }],
        ),
        held(
            "p. 259",
            "L2 P1 to P6 write G54 to G59.",
            "effect `write-offsets`",
            &[
                Stands {
                    program: cut!("G10 L2 P1 X6. Y1.\nX0. Y0.\n").with(&[G54]),
                    after: "X0. Y0.",
                    at: "MX6 MY1",
                },
                Stands {
                    program: cut!("G10 L2 P6 X6. Y1.\nG59 X0. Y0.\n").with(&[G54]),
                    after: "G59 X0. Y0.",
                    at: "MX6 MY1",
                },
            ],
        ),
        held(
            "p. 259",
            "L2 P0 writes the shift of G52.",
            "effect `write-offsets`",
            &[Stands { program: cut!("G10 L2 P0 X1.\nX0.\n").with(&[G54]), after: "X0.", at: "MX-9" }],
        ),
        held(
            "p. 259",
            "L20 P1 to P20 write G110 to G129.",
            "effect `write-offsets`",
            &[Stands {
                program: cut!("G10 L20 P2 G90 X10. Y8.\nG111 X0. Y0.\n"),
                after: "G111 X0. Y0.",
                at: "MX10 MY8",
            }],
        ),
        held(
            "p. 259",
            "L20 P1 to P99 write G154 P1 to P99.",
            "effect `write-offsets`",
            &[Stands {
                program: cut!("G10 L20 P50 G90 X10. Y20.\nG154 P50 X0. Y0.\n"),
                after: "G154 P50 X0. Y0.",
                at: "MX10 MY20",
            }],
        ),
        held(
            "p. 259",
            "L10 writes the length of tool P.",
            "effect `write-offsets`",
            &[Stands {
                program: cut!("G10 L10 G90 P5 R2.5\nG43 H5 Z1.\n").with(&[G54]),
                after: "G43 H5 Z1.",
                at: "MZ-4.5",
            }],
        ),
        held(
            "p. 259",
            "L1 and L11 write the wear of the length, which counts with it.",
            "effect `write-offsets`; a wear that nobody wrote counts as none",
            &[
                Stands {
                    program: cut!("G10 L11 G90 P1 R.1\nG43 H1 Z1.\n").with(&[G54, TOOL]),
                    after: "G43 H1 Z1.",
                    at: "MZ-2.9",
                },
                Stands {
                    program: cut!("G10 L1 G90 P1 R.1\nG43 H1 Z1.\n").with(&[G54, TOOL]),
                    after: "G43 H1 Z1.",
                    at: "MZ-2.9",
                },
            ],
        ),
        held(
            "p. 259",
            "L12 writes the diameter of offset P.",
            "effect `write-offsets`",
            &[Makes {
                program: cut!("G10 L12 G90 P1 R.375\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\n"),
                block: "G41 D1 G1 X1. F10.",
                events: &["feed X0.8125"],
            }],
        ),
        held(
            "p. 259",
            "L13 writes the wear of the diameter, which counts with it.",
            "effect `write-offsets`",
            &[Makes {
                program: cut!("G10 L12 P1 R.375\nG10 L13 P1 R.025\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\n"),
                block: "G41 D1 G1 X1. F10.",
                events: &["feed X0.8"],
            }],
        ),
        held(
            "p. 259",
            "P of tool offsets is 1 to 200.",
            "range of `P`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G10 L10 P201 R1.\n"),
                conforms: cut!("G10 L10 P200 R1.\n"),
            }],
        ),
        held(
            "p. 259",
            "P is 0 to 6 with L2, 1 to 99 with L20, 1 to 200 with L10 to L13.",
            "word `P` of `G10` beside `L`; rule `word-unfit-for-another`",
            &[
                Rule {
                    finding: "error[word-unfit-for-another]",
                    violates: cut!("G10 L2 P7 X1.\n"),
                    conforms: cut!("G10 L2 P6 X1.\n"),
                },
                Rule {
                    finding: "error[word-unfit-for-another]",
                    violates: cut!("G10 L20 P0 X1.\n"),
                    conforms: cut!("G10 L20 P1 X1.\n"),
                },
                Rule {
                    finding: "error[word-unfit-for-another]",
                    violates: cut!("G10 L20 P100 X1.\n"),
                    conforms: cut!("G10 L20 P99 X1.\n"),
                },
                Rule {
                    finding: "error[word-unfit-for-another]",
                    violates: cut!("G10 L10 P0 R1.\n"),
                    conforms: cut!("G10 L10 P1 R1.\n"),
                },
            ],
        ),
        held(
            "p. 259",
            "L is 1, 2, 10 to 13 or 20.",
            "word `L` of `G10`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G10 L3 P1 R1.\n"),
                conforms: cut!("G10 L2 P1 X1.\n"),
            }],
        ),
        held(
            "p. 259",
            "Under G91 G10 adds to the offset, under G90 it replaces it.",
            "effect `write-offsets`",
            &[
                Stands {
                    program: cut!("G10 L2 P1 G91 X6.\nG90 X0.\n").with(&[G54]),
                    after: "G90 X0.",
                    at: "MX-4",
                },
                Stands { program: cut!("G10 L2 P1 G90 X6.\nX0.\n").with(&[G54]), after: "X0.", at: "MX6" },
                Stands {
                    program: cut!("G10 L10 G91 P1 R.1\nG90 G43 H1 Z1.\n").with(&[G54, TOOL]),
                    after: "G90 G43 H1 Z1.",
                    at: "MZ-2.9",
                },
            ],
        ),
        held(
            "p. 259",
            "A work offset is given by X, Y, Z, A, B, C.",
            "words of `G10`",
            &[Stands {
                program: cut!("G10 L2 P2 X1. Y2. Z3. A4. B5. C6.\nG55 X0. Y0. Z0. A0. B0. C0.\n"),
                after: "G55 X0. Y0. Z0. A0. B0. C0.",
                at: "MX1 MY2 MA4 MB5 MC6",
            }],
        ),
        held(
            "p. 280, p. 281",
            "G52 shifts every work coordinate system.",
            "effect `local-shift`",
            &[
                Stands {
                    program: cut!("G52 X1. Y1.\nX0. Y0.\nG55 X0.\nG52 X0. Y0.\n").with(&[G54, G55]),
                    after: "X0. Y0.",
                    at: "MX-9 MY-4",
                },
                Stands {
                    program: cut!("G52 X1. Y1.\nX0. Y0.\nG55 X0.\nG52 X0. Y0.\n").with(&[G54, G55]),
                    after: "G55 X0.",
                    at: "MX-19",
                },
            ],
        ),
        held(
            "p. 280",
            "G52 moves nothing.",
            "`takes-axes` of `G52`",
            &[Makes {
                program: cut!("G52 X1. Y1.\nX0. Y0.\nG52 X0. Y0.\n"),
                block: "G52 X1. Y1.",
                events: &[],
            }],
        ),
        held(
            "p. 280",
            "G52 with zeros clears the shift.",
            "rule `shift-left-on`",
            &[Rule {
                finding: "warning[shift-left-on]",
                violates: cut!("G52 X1. Y1.\nX0. Y0.\n"),
                conforms: cut!("G52 X1. Y1.\nX0. Y0.\nG52 X0. Y0.\n"),
            }],
        ),
        held(
            "p. 280, p. 379",
            "With Setting 33 at FANUC M30 clears G52.",
            "rule `shift-left-on`, `shift-cleared-at-end`",
            &[
                Silent {
                    rule: "shift-left-on",
                    program: cut!("G52 X1. Y1.\nX0. Y0.\n").with(&["settings.33=\"fanuc\""]),
                },
                Rule {
                    finding: "warning[shift-left-on]",
                    violates: cut!("G52 X1. Y1.\nX0. Y0.\n").with(&["settings.33=\"haas\""]),
                    conforms: cut!("G52 X1. Y1.\nX0. Y0.\nG52 X0. Y0.\n").with(&["settings.33=\"haas\""]),
                },
            ],
        ),
        held(
            "p. 281, p. 379",
            "With Setting 33 at HAAS the shift outlives M30 until it is set to zero.",
            "rule `shift-left-on`",
            &[Rule {
                finding: "warning[shift-left-on]",
                violates: cut!("G52 X1. Y1.\nX0. Y0.\n").with(&["settings.33=\"haas\""]),
                conforms: cut!("G52 X1. Y1.\nX0. Y0.\nG52 X0. Y0.\n").with(&["settings.33=\"haas\""]),
            }],
        ),
        held(
            "p. 280, p. 302",
            "A G92 drops the G52 of the axes that it names, and of no other.",
            "effect `set-position`",
            &[Stands {
                program: cut!("G52 X1.\nX0.\nG92 X5.\nG52 X0.\nX5.\n").with(&[G54]),
                after: "X5.",
                at: "MX-9",
            }],
        ),
        held(
            "p. 302",
            "A G92 leaves the G52 of the axes that it does not name.",
            "effect `set-position`",
            &[Stands {
                program: cut!("G52 X1. Y1.\nX0. Y0.\nG92 X5.\nY0.\n").with(&[G54]),
                after: "Y0.",
                at: "MY-4",
            }],
        ),
        held(
            "p. 302",
            "G92 moves nothing; the present position reads as the words say.",
            "effect `set-position`",
            &[
                Makes { program: cut!("X2. Y2.\nG92 X1. Y1.\nX2.\n"), block: "G92 X1. Y1.", events: &[] },
                Stands {
                    program: cut!("X2. Y2.\nG92 X1. Y1.\nX2.\n").with(&[G54]),
                    after: "X2.",
                    at: "MX-7 MY-3",
                },
            ],
        ),
        held(
            "p. 302",
            "G92 shifts all work coordinate systems.",
            "effect `set-position`",
            &[Stands {
                program: cut!("X2. Y2.\nG92 X1. Y1.\nG55 X0.\n").with(&[G54, G55]),
                after: "G55 X0.",
                at: "MX-19",
            }],
        ),
        held(
            "p. 302",
            "A second G92 can shift back to the original offset.",
            "effect `set-position`",
            &[Stands {
                program: cut!("G92 X2. Y2.\nG0 X0. Y0.\nG92 X-2. Y-2.\nX0. Y0.\n").with(&[G54]),
                after: "X0. Y0.",
                at: "MX-10 MY-5",
            }],
        ),
        held(
            "p. 302",
            "Power-up and zero return of an axis end G92; the end of a program does not.",
            "rule `shift-left-on`; its words still assume that a setting decides",
            &[Rule {
                finding: "warning[shift-left-on]",
                violates: cut!("X2.\nG92 X1.\nX2.\n"),
                conforms: cut!("X2.\nG92 X1.\nX1.\nG92 X2.\nX1.\n"),
            }],
        ),
        held(
            "p. 281",
            "G54 to G59 choose one of six coordinate systems for all later positions.",
            "effect `work-offset`",
            &[
                Stands { program: cut!("G55 X0.\nX1.\n").with(&[G54, G55]), after: "X1.", at: "MX-19" },
                Stands {
                    program: cut!("G55 X0.\nG54 X0.\n").with(&[G54, G55]),
                    after: "G54 X0.",
                    at: "MX-10",
                },
            ],
        ),
        held(
            "p. 308",
            "G110 to G129 choose further coordinate systems and work as G54 to G59.",
            "effect `work-offset`",
            &[Stands {
                program: cut!("G110 X1.\nX2.\n").with(&["offsets.G110={X=-3.0,Y=0.0,Z=0.0}"]),
                after: "X2.",
                at: "MX-1",
            }],
        ),
        held(
            "p. 323",
            "G154 P1 to P99 choose 99 more coordinate systems.",
            "effect `work-offset-by-p`",
            &[
                Stands {
                    program: cut!("G154 P10 X1.\n").with(&["offsets.\"G154 P10\"={X=-3.0,Y=0.0,Z=0.0}"]),
                    after: "G154 P10 X1.",
                    at: "MX-2",
                },
                Legal { program: cut!("G154 P99 X1.\nG54\n") },
            ],
        ),
        held(
            "p. 323",
            "P of G154 is 1 to 99.",
            "range of `P`",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G154 P100 X1.\n"),
                    conforms: cut!("G154 P99 X1.\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G154 P0 X1.\n"),
                    conforms: cut!("G154 P1 X1.\n"),
                },
            ],
        ),
        held(
            "p. 323",
            "G154 needs P.",
            "need of `P`",
            &[Rule {
                finding: "error[required-word-missing]",
                violates: cut!("G154 X1.\n"),
                conforms: cut!("G154 P1 X1.\n"),
            }],
        ),
        held(
            "p. 323",
            "G110 to G129 are G154 P1 to P20.",
            "effects of both",
            &[
                Stands {
                    program: cut!("G110 X1.\n").with(&["offsets.\"G154 P1\"={X=-3.0,Y=0.0,Z=0.0}"]),
                    after: "G110 X1.",
                    at: "MX-2",
                },
                Stands {
                    program: cut!("G154 P20 X1.\n").with(&["offsets.G129={X=-3.0,Y=0.0,Z=0.0}"]),
                    after: "G154 P20 X1.",
                    at: "MX-2",
                },
            ],
        ),
        held(
            "p. 323",
            "#14001 to #14006 hold the axes of G154 P1, also #7001 and G110; the next ones follow every 20.",
            "`system-variables`",
            &[
                Run {
                    program: mill("O1 (A)\nG20 G90 G54\n#14041=-3.\nG154 P3 G0 X#7041\nM30\n"),
                    prints: &["rapid -3.0000"],
                },
                Run {
                    program: mill("O1 (A)\nG20 G90 G54\n#7381=-2.\nG129 G0 X#14381\nM30\n"),
                    prints: &["rapid -2.0000"],
                },
                Stands {
                    program: mill("O1 (A)\nG20 G90 G54\n#15961=-2.\nG154 P99 G0 X1.\nM30\n"),
                    after: "G154 P99 G0 X1.",
                    at: "MX-1",
                },
                Stands {
                    program: mill("O1 (A)\nG20 G90 G54\n#14042=-2.\nG112 G0 Y1.\nM30\n"),
                    after: "G112 G0 Y1.",
                    at: "MY-1",
                },
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
