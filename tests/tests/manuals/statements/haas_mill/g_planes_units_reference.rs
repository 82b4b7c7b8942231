//! G17 to G21, G28, G29, G53, G90 and G91 (p. 262, 263, 281, 302): the sentences of these pages and what proves them.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{held, mill, not_modelled};
use crate::proof::Proof::{Makes, Rule, Run, Stands};
use crate::statements::statement::{Chapter, prove};

/// Where the part lies.
const G54: &str = "offsets.G54={X=-10.0,Y=-5.0,Z=-8.0}";

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: planes, units, reference points, machine coordinates",
    key: "REF",
    file: "haas_mill/g_planes_units_reference.rs",
    statements: &[
        held(
            "p. 262",
            "G17 selects XY for arcs, G18 XZ, G19 YZ; each holds for all later arcs.",
            "effects `plane-xy`, `plane-zx`, `plane-yz`",
            &[
                Makes {
                    program: cut!("G18\nG2 X1. Z-.9 I1. F10.\nX2. Z-1.9 I1.\nG17\n"),
                    block: "X2. Z-1.9 I1.",
                    events: &["arc X2 Z-1.9 S-90 I2 K-0.9"],
                },
                Makes {
                    program: cut!("G19 G2 Y1. Z-.9 J1. F10.\nG17\n"),
                    block: "G19 G2 Y1. Z-.9 J1. F10.",
                    events: &["arc Y1 Z-0.9 S-270 J1 K0.1"],
                },
            ],
        ),
        held(
            "p. 262",
            "G17 is in effect without being written.",
            "default of group `plane`",
            &[Makes {
                program: mill("O1 (A)\nG20 G90 G54 G0 X0. Y0.\nG2 X1. Y1. I1. F10.\nM30\n"),
                block: "G2 X1. Y1. I1. F10.",
                events: &["arc X1 Y1 S-90"],
            }],
        ),
        held(
            "p. 262",
            "G12 and G13 cut in XY whatever the plane.",
            "effects `circular-pocket-clockwise`",
            &[Makes {
                program: cut!("G18 G13 I.5 Z-.2 F10. D0\nG17\n"),
                block: "G18 G13 I.5 Z-.2 F10. D0",
                events: &["feed Z-0.2", "arc X0.5 S180 I0.25 J0", "arc S360 I0 J0", "arc X0 S180 I0.25 J0"],
            }],
        ),
        held(
            "p. 262",
            "With cutter compensation arcs are allowed in XY only.",
            "rule `refused-under-compensation`",
            &[Rule {
                finding: "error[refused-under-compensation]",
                violates: cut!("G18\nG41 D1 G1 X1. F10.\nG3 X2. Z-.9 R1.\nG40 G1 X3.\nG17\n")
                    .with(&["tools.1={diameter=0.2}"]),
                conforms: cut!("G41 D1 G1 X1. F10.\nG2 X2. Y-1. R1.\nG40 G1 X3.\n")
                    .with(&["tools.1={diameter=0.2}"]),
            }],
        ),
        held(
            "p. 262",
            "G17 arcs are seen from above: G02 turns from +X towards -Y.",
            "effects of arcs",
            &[Makes {
                program: cut!("G0 X1.\nG2 X0. Y-1. I-1. F10.\n"),
                block: "G2 X0. Y-1. I-1. F10.",
                events: &["arc X0 Y-1 S-90"],
            }],
        ),
        held(
            "p. 262",
            "G18 arcs are seen from the rear of the machine: G02 turns from +X towards +Z.",
            "effects of arcs",
            &[Makes {
                program: cut!("G0 X1.\nG18 G2 X0. Z1.1 I-1. F10.\nG17\n"),
                block: "G18 G2 X0. Z1.1 I-1. F10.",
                events: &["arc X0 Z1.1 S-90"],
            }],
        ),
        held(
            "p. 262",
            "G19 arcs are seen from the control's side: G02 turns from +Y towards -Z.",
            "effects of arcs",
            &[Makes {
                program: cut!("G0 Y1.\nG19 G2 Y0. Z-.9 J-1. F10.\nG17\n"),
                block: "G19 G2 Y0. Z-.9 J-1. F10.",
                events: &["arc Y0 Z-0.9 S-90"],
            }],
        ),
        held(
            "p. 263",
            "G20 and G21 say the units of the program.",
            "effects `inch`, `millimetre`",
            &[
                Run {
                    program: mill("O1 (A)\nG21 G90 G54 G0 X25.4\nM30\n"),
                    prints: &["stdin, mm", "rapid 25.400"],
                },
                Run {
                    program: mill("O1 (A)\nG20 G90 G54 G0 X1.\nM30\n"),
                    prints: &["stdin, inch", "rapid 1.0000"],
                },
            ],
        ),
        held(
            "p. 263",
            "G20 alarms when Setting 9 is not inch.",
            "rule `units-against-setting`",
            &[Rule {
                finding: "error[units-against-setting]",
                violates: cut!("G0 X1.\n").with(&["settings.9=\"mm\""]),
                conforms: cut!("G0 X1.\n").with(&["settings.9=\"inch\""]),
            }],
        ),
        held(
            "p. 263",
            "G20 and G21 are checked against one setting, so that one program cannot have both.",
            "rule `units-changed`",
            &[Rule {
                finding: "warning[units-changed]",
                violates: cut!("G20\nG0 X1.\nG21\nG0 X25.\n"),
                conforms: cut!("G20\nG0 X1.\n"),
            }],
        ),
        held(
            "p. 263",
            "G28 with axis words goes to that point, absolute under G90.",
            "effect `return-reference`",
            &[
                Run { program: cut!("G90 G28 X1. Y1. Z1.\n"), prints: &["rapid 1.0000 1.0000 1.0000"] },
                Run {
                    program: cut!("G0 X3.\nG28 G91 X-1. Y-1. Z1.\nG90\n"),
                    prints: &["rapid 2.0000 -1.0000 1.1000"],
                },
            ],
        ),
        held(
            "p. 263, p. 281",
            "G28 ends at machine zero, which is where G53 counts from.",
            "`reference-at-zero`",
            &[
                Stands {
                    program: cut!("G28 G91 X0. Y0. Z0.\nG90\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "G28 G91 X0. Y0. Z0.",
                    at: "MX0 MY0 MZ0",
                },
                Stands {
                    program: cut!("G28 G91 X0. Y0.\nG90\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "G28 G91 X0. Y0.",
                    at: "X10 Y5",
                },
            ],
        ),
        held(
            "p. 263",
            "G28 without axis words sends all axes.",
            "`reference-without-axes`",
            &[Run {
                program: cut!("G28\n").with(&[G54, "tools.1={length=4.0}"]),
                prints: &["7 rapid 10.0000 5.0000 4.0000"],
            }],
        ),
        held(
            "p. 263",
            "G28 with words sends only the axes it names.",
            "effect `return-reference`",
            &[Run {
                program: cut!("G28 G91 Z0.\nG90\n").with(&[G54, "tools.1={length=4.0}"]),
                prints: &["7 rapid 0.0000 0.0000 4.0000"],
            }],
        ),
        held(
            "p. 263",
            "G28 under G90 with X0 Y0 Z0 goes to the part's zero first: into the part.",
            "rule `reference-return-through-point`",
            &[Rule {
                finding: "warning[reference-return-through-point]",
                violates: cut!("G28 G90 Z0.\n"),
                conforms: cut!("G28 G91 Z0.\nG90\n"),
            }],
        ),
        held(
            "p. 263",
            "G28 keeps its point for G29, which goes there and then to its own point.",
            "effect `return-from-reference`",
            &[Makes {
                program: cut!("G28 G91 X-1. Y-1.\nG90 G29 X2. Y3.\n"),
                block: "G90 G29 X2. Y3.",
                events: &["rapid X-1 Y-1", "rapid X2 Y3"],
            }],
        ),
        held(
            "p. 263",
            "G29 needs the point of an earlier G28.",
            "rule `reference-point-never-set`",
            &[Rule {
                finding: "warning[reference-point-never-set]",
                violates: cut!("G29 X1.\n"),
                conforms: cut!("G28 G91 X0.\nG90 G29 X1.\n"),
            }],
        ),
        not_modelled(
            "p. 263, p. 389",
            "With Setting 108 on rotary axes go home by less than one turn.",
            "turns of a rotary axis above 360 degrees are not followed to machine zero, whose place depends on the table",
        ),
        held(
            "p. 281",
            "G53 reads its words in machine coordinates, without work offset.",
            "effect `machine-coordinates`",
            &[
                Stands {
                    program: cut!("G53 X-1. Y-2.\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "G53 X-1. Y-2.",
                    at: "MX-1 MY-2",
                },
                Stands {
                    program: cut!("G53 X-1. Y-2.\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "G53 X-1. Y-2.",
                    at: "X9 Y3",
                },
            ],
        ),
        held(
            "p. 281",
            "G53 holds for its own block.",
            "group `one-shot`",
            &[
                Stands {
                    program: cut!("G53 X-1.\nX1.\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "X1.",
                    at: "X1",
                },
                Stands {
                    program: cut!("G53 X-1.\nX1.\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "X1.",
                    at: "MX-9",
                },
            ],
        ),
        held(
            "p. 281",
            "Z machine zero is where Zero Return puts the spindle: G53 Z0 goes to the top whatever the tool's length.",
            "effect `machine-coordinates`",
            &[
                Stands {
                    program: cut!("G53 Z0.\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "G53 Z0.",
                    at: "MZ0",
                },
                Stands {
                    program: cut!("G53 Z0.\n").with(&[G54, "tools.1={length=4.0}"]),
                    after: "G53 Z0.",
                    at: "Z4",
                },
            ],
        ),
        held(
            "p. 302",
            "After G90 axis words are positions, after G91 distances from the present point.",
            "effects `absolute`, `incremental`",
            &[
                Makes {
                    program: cut!("G0 X1.\nG91 X1.\nX1. Y1.\nG90 X0.\n"),
                    block: "X1. Y1.",
                    events: &["rapid X3 Y1"],
                },
                Makes {
                    program: cut!("G0 X1.\nG91 X1.\nX1. Y1.\nG90 X0.\n"),
                    block: "G90 X0.",
                    events: &["rapid X0"],
                },
            ],
        ),
        held(
            "p. 302, p. 313",
            "G91 does not go with G143.",
            "rule `five-axis-length-in-incremental`",
            &[Rule {
                finding: "error[five-axis-length-in-incremental]",
                violates: mill(
                    "O1 (A)\nG20 G90 G54 G0 X0. Y0. Z5. A0. B0.\nG143 H1 Z2.\nG91 G1 X1. F10.\nG90 G49\nM30\n",
                ),
                conforms: mill(
                    "O1 (A)\nG20 G90 G54 G0 X0. Y0. Z5. A0. B0.\nG143 H1 Z2.\nG1 X1. F10.\nG49\nM30\n",
                ),
            }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
