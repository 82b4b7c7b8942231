//! G50, G51, G68, G69, G100, G101 and G107 (p. 276 to 285, 306 to 308): the sentences of these pages and what proves
//! them.
//!
//! Left out: how options are bought and tried out; the figures of the window.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Assumes, Legal, Makes, Rule, Run, Same, Silent, Stands};
use crate::statements::statement::{Chapter, prove};

/// Tool 1 as the operator has measured it.
const TOOL: &str = "tools.1={length=4.0,diameter=0.5}";

/// Where the part lies.
const G54: &str = "offsets.G54={X=-10.0,Y=-5.0,Z=-8.0}";

/// A part whose zero is machine zero.
const G54_AT_HOME: &str = "offsets.G54={X=0.0,Y=0.0,Z=0.0,A=0.0}";

/// Blocks over a cylinder that A turns.
macro_rules! on_cylinder {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. A0. S1000 M3\nG43 H1 Z.1\n",
            $blocks,
            "G0 Z1.\nG28 G91 Z0.\nG90\nM30\n"
        ))
    };
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: scaling, rotation, mirror image, cylinder",
    key: "TRF",
    file: "haas_mill/g_scaling_rotation_mirror.rs",
    statements: &[
        held(
            "p. 276",
            "G51 multiplies the end points of later rapids, feeds and arcs by P about a centre.",
            "effect `scaling-on`",
            &[
                Makes {
                    program: cut!("G51 X1.5 Y1.5 P2.\nG1 X1. Y1. F10.\nX2.\nG50\n"),
                    block: "G1 X1. Y1. F10.",
                    events: &["feed X0.5 Y0.5"],
                },
                Makes {
                    program: cut!("G51 X1.5 Y1.5 P2.\nG1 X1. Y1. F10.\nX2.\nG50\n"),
                    block: "X2.",
                    events: &["feed X2.5"],
                },
                Makes { program: cut!("G51 X0. Y0. P2.\nX1.\nG50\n"), block: "X1.", events: &["rapid X2"] },
            ],
        ),
        held(
            "p. 276",
            "Arc words I, J, K and R are scaled with them.",
            "effect `scaling-on`",
            &[
                Makes {
                    program: cut!("G51 X0. Y0. P2.\nG2 X1. Y1. I1. F10.\nG50\n"),
                    block: "G2 X1. Y1. I1. F10.",
                    events: &["arc X2 Y2 S-90 I2 J0"],
                },
                Makes {
                    program: cut!("G51 X0. Y0. P2.\nG2 X1. Y1. R1. F10.\nG50\n"),
                    block: "G2 X1. Y1. R1. F10.",
                    events: &["arc X2 Y2 S-90 I2 J0"],
                },
            ],
        ),
        held(
            "p. 276",
            "Without a centre the last commanded position is the centre.",
            "effect `scaling-on`",
            &[Makes {
                program: cut!("G0 X1. Y1.\nG51 P2.\nG1 X2. F10.\nG50\n"),
                block: "G1 X2. F10.",
                events: &["feed X3"],
            }],
        ),
        held(
            "p. 276",
            "Z is scaled as well.",
            "effect `scaling-on`",
            &[Makes {
                program: cut!("G51 X0. Y0. Z0. P2.\nG1 Z-1. F10.\nG50\n"),
                block: "G1 Z-1. F10.",
                events: &["feed Z-2"],
            }],
        ),
        gap(
            "p. 276",
            "A, B and C are scaled as well.",
            "`G51 P2.` doubles the end points of rotary axes; at present they stay",
            &[Makes {
                program: cut!("G0 A0.\nG51 X0. Y0. P2.\nA10.\nG50\n"),
                block: "A10.",
                events: &["rapid A20"],
            }],
        ),
        held(
            "p. 276",
            "G50 ends scaling.",
            "effect `scaling-off`",
            &[Makes {
                program: cut!("G51 X0. Y0. P2.\nG1 X1. F10.\nG50\nX3.\n"),
                block: "X3.",
                events: &["feed X3"],
            }],
        ),
        held(
            "p. 276",
            "P is at most 999.999.",
            "range of `P`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G51 X0. Y0. P1000.\nG1 X1. F10.\nG50\n"),
                conforms: cut!("G51 X0. Y0. P2000\nG1 X1. F10.\nG50\n"),
            }],
        ),
        held(
            "p. 276",
            "P is at least 0.001.",
            "range of `P`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G51 X0. Y0. P0.0001\nG1 X1. F10.\nG50\n"),
                conforms: cut!("G51 X0. Y0. P0.001\nG1 X1. F10.\nG50\n"),
            }],
        ),
        held(
            "p. 276",
            "P has three places: without a point it counts thousandths.",
            "`G51` in the numbers of the control",
            &[
                Makes {
                    program: cut!("G51 X0. Y0. P2000\nG1 X1. F10.\nG50\n"),
                    block: "G1 X1. F10.",
                    events: &["feed X2"],
                },
                Legal { program: cut!("G51 X0. Y0. P2000\nG1 X1. F10.\nG50\n") },
            ],
        ),
        gap(
            "p. 276",
            "A factor written without its point shrinks the part to nothing.",
            "`G51 P2` (0.002): `missing-decimal-point` speaks of P of G51 as well: warning",
            &[Rule {
                finding: "warning[missing-decimal-point]",
                violates: cut!("G51 X0. Y0. P2\nG1 X1. F10.\nG50\n"),
                conforms: cut!("G51 X0. Y0. P2.\nG1 X1. F10.\nG50\n"),
            }],
        ),
        held(
            "p. 276, p. 383",
            "Without P Setting 71 is the factor; it is 1 as delivered.",
            "Setting 71 by `transform-settings`",
            &[
                Makes {
                    program: cut!("G51 X0. Y0.\nG1 X2. F10.\nG50\n").with(&["settings.71=3.0"]),
                    block: "G1 X2. F10.",
                    events: &["feed X6"],
                },
                Assumes { program: cut!("G51 X0. Y0.\nG1 X2. F10.\nG50\n"), says: "setting 71" },
            ],
        ),
        held(
            "p. 276, p. 394",
            "Without P and with Setting 71 at 0, Settings 188 to 190 scale X, Y and Z each by its own factor.",
            "Settings 188 to 190 by `transform-settings`",
            &[Makes {
                program: cut!("G51 X0. Y0.\nG1 X2. Y2. F10.\nG50\n").with(&[
                    "settings.71=0",
                    "settings.188=2.0",
                    "settings.189=3.0",
                    "settings.190=1.0",
                ]),
                block: "G1 X2. Y2. F10.",
                events: &["feed X4 Y6"],
            }],
        ),
        gap(
            "p. 276, p. 394",
            "With unequal Settings 188 to 190 an arc alarms (467).",
            "an arc under factors that differ is refused: error",
            &[Rule {
                finding: "error[arc-under-unequal-scales]",
                violates: cut!("G51 X0. Y0.\nG2 X2. Y2. R2. F10.\nG50\n").with(&[
                    "settings.71=0",
                    "settings.188=2.0",
                    "settings.189=3.0",
                    "settings.190=1.0",
                ]),
                conforms: cut!("G51 X0. Y0.\nG2 X2. Y2. R2. F10.\nG50\n").with(&["settings.71=2.0"]),
            }],
        ),
        held(
            "p. 280",
            "Tool length offsets are not scaled.",
            "effect `scaling-on`",
            &[Stands {
                program: cut!("G51 X0. Y0. Z0. P2.\nG43 H1 Z1.\nG50\n").with(&[TOOL, G54]),
                after: "G43 H1 Z1.",
                at: "MZ-2",
            }],
        ),
        held(
            "p. 280",
            "The size of the tool is not scaled by G51: compensation is by the true radius of the scaled path.",
            "compensation acts after scaling",
            &[Makes {
                program: cut!("G51 X0. Y0. P2.\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\nG50\n").with(&[TOOL]),
                block: "G41 D1 G1 X1. F10.",
                events: &["feed X1.75"],
            }],
        ),
        held(
            "p. 280",
            "In canned cycles depth and R plane are scaled.",
            "effect `scaling-on`",
            &[Makes {
                program: cut!("G0 Z1.\nG51 X0. Y0. Z0. P2.\nG99 G81 Z-.5 R.1 F5.\nG80 G50\n"),
                block: "G99 G81 Z-.5 R.1 F5.",
                events: &["rapid Z0.2", "feed Z-1", "rapid Z0.2"],
            }],
        ),
        gap(
            "p. 280",
            "G51 scales the initial level of a cycle as well.",
            "with G98 the tool goes back to the scaled initial level",
            &[Makes {
                program: cut!("G0 Z1.\nG51 X0. Y0. Z0. P2.\nG98 G81 X1. Z-.5 R.1 F5.\nG80 G50\n"),
                block: "G98 G81 X1. Z-.5 R.1 F5.",
                events: &["rapid X2", "rapid Z0.2", "feed Z-1", "rapid Z2"],
            }],
        ),
        held(
            "p. 280",
            "Pecks of G73 and G83 (Q, I, J, K) are not scaled.",
            "pecks are counted after scaling",
            &[
                Run {
                    program: cut!("G51 X0. Y0. Z0. P2.\nG99 G83 Z-.5 R.1 Q.4 F5.\nG80 G50\n"),
                    prints: &[
                        "feed 0.0000 0.0000 -0.2000",
                        "feed 0.0000 0.0000 -0.6000",
                        "feed 0.0000 0.0000 -1.0000",
                    ],
                },
                Run {
                    program: cut!("G51 X0. Y0. Z0. P2.\nG99 G73 Z-.5 R.1 I.6 J.2 K.2 F5.\nG80 G50\n"),
                    prints: &[
                        "feed 0.0000 0.0000 -0.4000",
                        "feed 0.0000 0.0000 -0.8000",
                        "feed 0.0000 0.0000 -1.0000",
                    ],
                },
            ],
        ),
        held(
            "p. 280",
            "The shift Q of G76 and G77 is not scaled.",
            "the shift is counted after scaling",
            &[Run {
                program: cut!("G51 X0. Y0. Z0. P2.\nG99 G76 Z-.5 R.1 Q.02 F5.\nG80 G50\n")
                    .with(&["settings.27=\"x+\""]),
                prints: &["rapid 0.0200 0.0000 -1.0000"],
            }],
        ),
        not_modelled(
            "p. 280",
            "Scaled results are rounded to the last place of the axis.",
            "rounding to 0.0001 inch is below what any figure or rule of gcheck depends on",
        ),
        held(
            "p. 276, p. 382",
            "Scaling stays on after M30 when Setting 56 is off.",
            "rule `scaling-left-on`; Setting 56",
            &[Rule {
                finding: "warning[scaling-left-on]",
                violates: cut!("G51 P2. X0. Y0.\nG0 X1.\n").with(&["settings.56=false"]),
                conforms: cut!("G51 P2. X0. Y0.\nG0 X1.\nG50\n").with(&["settings.56=false"]),
            }],
        ),
        held(
            "p. 282",
            "G68 turns later X and Y about its centre by R, counter-clockwise when positive.",
            "effect `rotation-on`",
            &[
                Makes {
                    program: cut!("G68 X1. Y1. R90.\nG1 X2. Y1. F10.\nG69\n"),
                    block: "G1 X2. Y1. F10.",
                    events: &["feed X1 Y2"],
                },
                Makes {
                    program: cut!("G68 X0. Y0. R-90.\nG0 X1.\nG69\n"),
                    block: "G0 X1.",
                    events: &["rapid Y-1"],
                },
            ],
        ),
        held(
            "p. 282",
            "Centres of arcs turn with them.",
            "effect `rotation-on`",
            &[Makes {
                program: cut!("G68 X0. Y0. R90.\nG2 X1. Y1. I1. F10.\nG69\n"),
                block: "G2 X1. Y1. I1. F10.",
                events: &["arc X-1 Y1 S-90 I0 J1"],
            }],
        ),
        held(
            "p. 282",
            "Without a centre the present position is the centre.",
            "effect `rotation-on`",
            &[Makes {
                program: cut!("G0 X1. Y1.\nG68 R90.\nX2. Y1.\nG69\n"),
                block: "X2. Y1.",
                events: &["rapid Y2"],
            }],
        ),
        held(
            "p. 282",
            "Only the axes of the plane turn: Z stays under G17.",
            "effect `rotation-on`",
            &[Makes {
                program: cut!("G68 X0. Y0. R90.\nG1 X1. Z-.5 F10.\nG69\n"),
                block: "G1 X1. Z-.5 F10.",
                events: &["feed Y1 Z-0.5"],
            }],
        ),
        held(
            "p. 282",
            "A plane code before G68, or in its block, chooses the plane that turns.",
            "effect `rotation-on`",
            &[Makes {
                program: cut!("G18 G68 X0. Z.1 R90.\nG0 X1. Y1. Z.1\nG69\nG17\n"),
                block: "G0 X1. Y1. Z.1",
                events: &["rapid Y1 Z-0.9"],
            }],
        ),
        held(
            "p. 282",
            "R is -360 to 360 degrees.",
            "range of `R`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G68 X0. Y0. R361.\nG0 X1.\nG69\n"),
                conforms: cut!("G68 X0. Y0. R360.\nG0 X1.\nG69\n"),
            }],
        ),
        held(
            "p. 282, p. 383",
            "Without R Setting 72 is the angle.",
            "Setting 72 by `transform-settings`",
            &[
                Makes {
                    program: cut!("G68 X0. Y0.\nG0 X1. Y0.\nG69\n").with(&["settings.72=90.0"]),
                    block: "G0 X1. Y0.",
                    events: &["rapid Y1"],
                },
                Assumes { program: cut!("G68 X0. Y0.\nG0 X1. Y0.\nG69\n"), says: "setting 72" },
            ],
        ),
        gap(
            "p. 282, p. 384",
            "With Setting 73 on, G68 under G91 adds R to the angle in force.",
            "Setting 73 is read: the second `G91 G68 R30.` turns by 60",
            &[Makes {
                program: cut!("G91 G68 X0. Y0. R30.\nG91 G68 X0. Y0. R30.\nG90 G0 X1. Y0.\nG69\n")
                    .with(&["settings.73=true"]),
                block: "G90 G0 X1. Y0.",
                events: &["rapid X0.5 Y0.866"],
            }],
        ),
        held(
            "p. 282",
            "With Setting 73 off each G68 sets its own angle.",
            "effect `rotation-on`",
            &[Makes {
                program: cut!("G91 G68 X0. Y0. R30.\nG91 G68 X0. Y0. R30.\nG90 G0 X1. Y0.\nG69\n")
                    .with(&["settings.73=false"]),
                block: "G90 G0 X1. Y0.",
                events: &["rapid X0.866 Y0.5"],
            }],
        ),
        held(
            "p. 282",
            "The angle is 0 at the start of a program.",
            "default of group `rotation`",
            &[Makes {
                program: mill("O1 (A)\nG20 G90 G54 G0 X0. Y0.\nX1.\nM30\n"),
                block: "X1.",
                events: &["rapid X1"],
            }],
        ),
        held(
            "p. 285",
            "The plane does not change while G68 is on.",
            "rule `plane-changed-under-rotation`",
            &[Rule {
                finding: "warning[plane-changed-under-rotation]",
                violates: cut!("G68 X0. Y0. R30.\nG18\nG0 X1.\nG17\nG69\n"),
                conforms: cut!("G68 X0. Y0. R30.\nG0 X1.\nG69\n"),
            }],
        ),
        held(
            "p. 285",
            "Scaling goes on before rotation and off after it.",
            "effects of both",
            &[
                Makes {
                    program: cut!("G51 X0. Y0. P2.\nG68 X0. Y0. R90.\nG0 X1. Y0.\nG69\nG50\n"),
                    block: "G0 X1. Y0.",
                    events: &["rapid Y2"],
                },
                Legal { program: cut!("G51 X0. Y0. P2.\nG68 X0. Y0. R90.\nG0 X1. Y0.\nG69\nG50\n") },
            ],
        ),
        held(
            "p. 285",
            "The other order, and both in one block, are not to be written.",
            "rule `scaling-under-rotation`",
            &[Rule {
                finding: "warning[scaling-under-rotation]",
                violates: cut!("G68 X0. Y0. R90.\nG51 X0. Y0. P2.\nG0 X1. Y0.\nG50\nG69\n"),
                conforms: cut!("G51 X0. Y0. P2.\nG68 X0. Y0. R90.\nG0 X1. Y0.\nG69\nG50\n"),
            }],
        ),
        held(
            "p. 285",
            "Cutter compensation goes on after rotation and off before it.",
            "rule `rotation-under-compensation`",
            &[Rule {
                finding: "warning[rotation-under-compensation]",
                violates: cut!("G41 D1 G1 X1. F10.\nG68 X0. Y0. R90.\nY1.\nG69\nG40 X2.\n"),
                conforms: cut!("G68 X0. Y0. R90.\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\nG69\n"),
            }],
        ),
        held(
            "p. 285",
            "Compensation goes on after rotation and off before it: in between it acts on the turned path (the manual gives the order only).",
            "compensation acts after rotation",
            &[
                Makes {
                    program: cut!("G68 X0. Y0. R90.\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\nG69\n").with(&[TOOL]),
                    block: "G41 D1 G1 X1. F10.",
                    events: &["feed Y0.75"],
                },
                Makes {
                    program: cut!("G68 X0. Y0. R90.\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\nG69\n").with(&[TOOL]),
                    block: "Y1.",
                    events: &["feed X-1"],
                },
            ],
        ),
        held(
            "p. 285",
            "G69 ends rotation.",
            "effect `rotation-off`",
            &[Makes {
                program: cut!("G68 X0. Y0. R90.\nG0 X1. Y0.\nG69\nX2. Y0.\n"),
                block: "X2. Y0.",
                events: &["rapid X2 Y0"],
            }],
        ),
        held(
            "p. 285, p. 382",
            "Rotation stays on after M30 when Setting 56 is off.",
            "rule `rotation-left-on`; Setting 56",
            &[Rule {
                finding: "warning[rotation-left-on]",
                violates: cut!("G68 R20. X0. Y0.\nG0 X1.\n").with(&["settings.56=false"]),
                conforms: cut!("G68 R20. X0. Y0.\nG0 X1.\nG69\n").with(&["settings.56=false"]),
            }],
        ),
        held(
            "p. 306",
            "G101 mirrors the axes it names about the work zero, G100 ends it for the axes it names.",
            "effects `mirror-on`, `mirror-off`",
            &[
                Makes {
                    program: cut!("G101 X0.\nG1 X1. Y1. F10.\nG100 X0.\nX2.\n"),
                    block: "G1 X1. Y1. F10.",
                    events: &["feed X-1 Y1"],
                },
                Makes {
                    program: cut!("G101 X0.\nG1 X1. Y1. F10.\nG100 X0.\nX2.\n"),
                    block: "X2.",
                    events: &["feed X2"],
                },
                Makes {
                    program: cut!("G101 X0. Y0.\nG1 X1. Y1. F10.\nG100 X0.\nX2. Y2.\nG100 Y0.\n"),
                    block: "X2. Y2.",
                    events: &["feed X2 Y-2"],
                },
            ],
        ),
        held(
            "p. 306",
            "Any axis may be mirrored.",
            "effect `mirror-on`",
            &[Makes {
                program: cut!("G101 Z0.\nG0 Z1.\nG100 Z0.\n"),
                block: "G0 Z1.",
                events: &["rapid Z-1"],
            }],
        ),
        gap(
            "p. 306",
            "Rotary axes may be mirrored too.",
            "`G101 A0.` turns A the other way about its work zero; at present A is not mirrored",
            &[Makes {
                program: cut!("G0 A0.\nG101 A0.\nG0 A10.\nG100 A0.\n"),
                block: "G0 A10.",
                events: &["rapid A-10"],
            }],
        ),
        held(
            "p. 306",
            "One mirrored axis of the plane turns the sense of arcs round, two keep it.",
            "effect `mirror-on`",
            &[
                Makes {
                    program: cut!("G101 X0.\nG2 X1. Y1. I1. F10.\nG100 X0.\n"),
                    block: "G2 X1. Y1. I1. F10.",
                    events: &["arc X-1 Y1 S90"],
                },
                Makes {
                    program: cut!("G101 X0. Y0.\nG2 X1. Y1. I1. F10.\nG100 X0. Y0.\n"),
                    block: "G2 X1. Y1. I1. F10.",
                    events: &["arc X-1 Y-1 S-90"],
                },
            ],
        ),
        held(
            "p. 306",
            "Mirror image and cutter compensation together follow the mirrored path on its other side.",
            "compensation acts after mirrors, on the other side",
            &[Makes {
                program: cut!("G101 X0.\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\nG100 X0.\n").with(&[TOOL]),
                block: "G41 D1 G1 X1. F10.",
                events: &["feed X-0.75"],
            }],
        ),
        held(
            "p. 306",
            "G100 and G101 stand in a block without other G codes.",
            "rule `code-must-stand-alone`",
            &[Rule {
                finding: "error[code-must-stand-alone]",
                violates: cut!("G101 X0. G0\nG100 X0.\n"),
                conforms: cut!("G101 X0.\nG100 X0.\n"),
            }],
        ),
        held(
            "p. 306",
            "They move nothing.",
            "`takes-axes` of `G101`",
            &[
                Makes { program: cut!("G101 X0.\nG0 X1.\nG100 X0.\n"), block: "G101 X0.", events: &[] },
                Makes { program: cut!("G101 X0.\nG0 X1.\nG100 X0.\n"), block: "G100 X0.", events: &[] },
            ],
        ),
        held(
            "p. 306",
            "An axis is named to be mirrored.",
            "`one-of` of `G101`",
            &[Rule {
                finding: "warning[word-choice-missing]",
                violates: cut!("G101\nG0 X1.\nG100 X0.\n"),
                conforms: cut!("G101 X0.\nG0 X1.\nG100 X0.\n"),
            }],
        ),
        held(
            "p. 306, p. 381, p. 385, p. 396",
            "Settings 45, 46, 47, 48, 80 and 250 mirror an axis without a code.",
            "Settings 45 to 47 by `transform-settings`, where they are told; those of A, B and C are not followed",
            &[Makes {
                program: cut!("G0 X1.\n").with(&["settings.45=true"]),
                block: "G0 X1.",
                events: &["rapid X-1"],
            }],
        ),
        held(
            "p. 306",
            "A mirrored axis left on mirrors what comes next.",
            "rule `mirror-left-on`",
            &[Rule {
                finding: "warning[mirror-left-on]",
                violates: cut!("G101 X0.\nG0 X1.\n"),
                conforms: cut!("G101 X0.\nG0 X1.\nG100 X0.\n"),
            }],
        ),
        held(
            "p. 307",
            "G107 turns the motion of one linear axis into motion along a cylinder on a rotary axis.",
            "effect `cylinder-mapping`",
            &[
                Stands {
                    program: on_cylinder!("G107 Y0. A0. R1.\nG1 Y3.14159 F10.\nG107\n").with(&[G54_AT_HOME]),
                    after: "G1 Y3.14159 F10.",
                    at: "MA179.9998",
                },
                Stands {
                    program: on_cylinder!("G107 Y0. A0. R1.\nG1 Y3.14159 F10.\nG107\n").with(&[G54_AT_HOME]),
                    after: "G1 Y3.14159 F10.",
                    at: "MY0",
                },
            ],
        ),
        held(
            "p. 307",
            "Q is the diameter, R the radius of the cylinder.",
            "words of `G107`",
            &[
                Same {
                    one: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\nG107\n").with(&[G54_AT_HOME]),
                    other: on_cylinder!("G107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\n").with(&[G54_AT_HOME]),
                },
                Rule {
                    finding: "error[words-exclude-each-other]",
                    violates: on_cylinder!("G107 Y0. A0. R1. Q2.\nG1 Y1. F10.\nG107\n"),
                    conforms: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\nG107\n"),
                },
            ],
        ),
        held(
            "p. 307",
            "Any linear axis may be mapped to any rotary axis.",
            "words of `G107`",
            &[Stands {
                program: on_cylinder!("G107 X0. A0. R1.\nG1 X3.14159 F10.\nG107\n").with(&[G54_AT_HOME]),
                after: "G1 X3.14159 F10.",
                at: "MA179.9998",
            }],
        ),
        held(
            "p. 307",
            "One rotary axis at a time.",
            "effect `cylinder-mapping`",
            &[Run {
                program: on_cylinder!("G107 Y0. A0. R1.\nG107 X0. B0. R1.\nG107\n"),
                prints: &["diameter 2, Y on A", "off", "diameter 2, X on B"],
            }],
        ),
        held(
            "p. 307",
            "G107 is used to begin and to end mapping.",
            "rule `cylinder-left-on`",
            &[Rule {
                finding: "warning[cylinder-left-on]",
                violates: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\n").with(&["settings.56=false"]),
                conforms: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\nG107\n").with(&["settings.56=false"]),
            }],
        ),
        held(
            "p. 307",
            "Setting 56 decides whether M30 ends mapping.",
            "`ended-by-setting` of `semantics.cylinder`",
            &[
                Silent {
                    rule: "cylinder-left-on",
                    program: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\n").with(&["settings.56=true"]),
                },
                Rule {
                    finding: "warning[cylinder-left-on]",
                    violates: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\n").with(&["settings.56=false"]),
                    conforms: on_cylinder!("G107 Y0. A0. R1.\nG1 Y1. F10.\n").with(&["settings.56=true"]),
                },
            ],
        ),
        held(
            "p. 308",
            "The size may be that of Settings 34 and 79, or its own.",
            "`settings` of `semantics.cylinder`",
            &[
                Stands {
                    program: on_cylinder!("G107 Y0. A0.\nG1 Y3.14159 F10.\nG107\n")
                        .with(&[G54_AT_HOME, "settings.34=2.0"]),
                    after: "G1 Y3.14159 F10.",
                    at: "MA179.9998",
                },
                Stands {
                    program: on_cylinder!("G107 Y0. A0. R2.\nG1 Y3.14159 F10.\nG107\n")
                        .with(&[G54_AT_HOME, "settings.34=2.0"]),
                    after: "G1 Y3.14159 F10.",
                    at: "MA89.9999",
                },
            ],
        ),
        held(
            "p. 308",
            "G107 with a rotary axis and a size only sets the size for later.",
            "effect `cylinder-mapping`",
            &[
                Stands {
                    program: on_cylinder!("G107 A0. R1.\nG107 Y0. A0.\nG1 Y3.14159 F10.\nG107\n")
                        .with(&[G54_AT_HOME]),
                    after: "G1 Y3.14159 F10.",
                    at: "MA179.9998",
                },
                Makes {
                    program: on_cylinder!("G107 A0. R1.\nG1 Y1. F10.\n").with(&[G54_AT_HOME]),
                    block: "G1 Y1. F10.",
                    events: &["feed Y1"],
                },
            ],
        ),
        held(
            "p. 307",
            "The size may be given again while the program runs.",
            "effect `cylinder-mapping`",
            &[Stands {
                program: on_cylinder!("G107 Y0. A0. R1.\nG1 Y0. F10.\nG107 Y0. A0. R2.\nG1 Y3.14159\nG107\n")
                    .with(&[G54_AT_HOME]),
                after: "G1 Y3.14159",
                at: "MA89.9999",
            }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
