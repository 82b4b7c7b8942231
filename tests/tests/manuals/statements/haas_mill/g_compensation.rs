//! G40 to G44, G49, G141 and G143 (p. 270, 276, 310 to 314): the sentences of these pages and what proves them.
//!
//! Left out: how a unit vector is computed, with its figures; how the tool's side is found by looking along the path.
//! The chapter on cutter compensation (p. 151) stands with chapter 5.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Legal, Makes, Rule, Silent, Stands};
use crate::statements::statement::{Chapter, prove};

/// Tool 1 as the operator has measured it.
const TOOL: &str = "tools.1={length=4.0,diameter=0.5}";

/// Where the part lies.
const G54: &str = "offsets.G54={X=-10.0,Y=-5.0,Z=-8.0}";

/// A part whose zero is machine zero, with the tool upright.
const G54_AT_HOME: &str = "offsets.G54={X=0.0,Y=0.0,Z=0.0,A=0.0,B=0.0}";

/// Both rotary axes move the tool.
const TILTING_HEAD: &str = "machine.rotary=\"head-head\"";

/// Blocks of a machine whose head tilts by A and B.
macro_rules! tilting {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. Z0. A0. B0. S1000 M3\n",
            $blocks,
            "G0 G53 G49 Z0. M5\nM30\n"
        ))
    };
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: cutter and tool length compensation",
    key: "CMP",
    file: "haas_mill/g_compensation.rs",
    statements: &[
        held(
            "p. 270",
            "G41 leads the tool on the left of the path, G42 on the right, by the size in offset D.",
            "effects `compensation-left`, `compensation-right`",
            &[
                Makes {
                    program: cut!("G41 D1 G1 X1. F10.\nY1.\nG40 X2.\n").with(&[TOOL]),
                    block: "G41 D1 G1 X1. F10.",
                    events: &["feed X0.75 F10"],
                },
                Makes {
                    program: cut!("G42 D1 G1 X1. F10.\nY1.\nG40 X2.\n").with(&[TOOL]),
                    block: "G42 D1 G1 X1. F10.",
                    events: &["feed X1.25 F10"],
                },
            ],
        ),
        held(
            "p. 270",
            "G40 ends it.",
            "effect `compensation-off`",
            &[
                Makes {
                    program: cut!("G41 D1 G1 X1. F10.\nY1.\nG40 X2.\nY2.\n").with(&[TOOL]),
                    block: "Y2.",
                    events: &["feed Y2"],
                },
                Rule {
                    finding: "warning[compensation-left-on]",
                    violates: cut!("G41 D1 G1 X1. F10.\nY1.\nX2.\nT2 M6\n").with(&[TOOL]),
                    conforms: cut!("G41 D1 G1 X1. F10.\nY1.\nG40 X2.\nT2 M6\n").with(&[TOOL]),
                },
            ],
        ),
        held(
            "p. 270",
            "D must be programmed.",
            "rules `lasting-word-never-given`, `compensation-offset-missing`",
            &[
                Rule {
                    finding: "warning[lasting-word-never-given]",
                    violates: cut!("G41 G1 X1. F10.\nY1.\nG40 X2.\n"),
                    conforms: cut!("G41 D1 G1 X1. F10.\nY1.\nG40 X2.\n"),
                },
                Rule {
                    finding: "warning[compensation-offset-missing]",
                    violates: cut!("G41 D0 G1 X1. F10.\nY1.\nG40 X2.\n"),
                    conforms: cut!("G41 D1 G1 X1. F10.\nY1.\nG40 X2.\n"),
                },
            ],
        ),
        held(
            "p. 270",
            "A negative offset changes the side: G41 acts as G42.",
            "effect of compensation",
            &[Makes {
                program: cut!("G41 D1 G1 X1. F10.\nY1.\nG40 X2.\n").with(&["tools.1={diameter=-0.5}"]),
                block: "G41 D1 G1 X1. F10.",
                events: &["feed X1.25 F10"],
            }],
        ),
        held(
            "p. 380",
            "With Setting 40 the register D holds a radius or a diameter.",
            "`setting` of `semantics.compensation`",
            &[
                Makes {
                    program: cut!("G10 L12 P1 R.25\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\n")
                        .with(&["settings.40=\"radius\""]),
                    block: "G41 D1 G1 X1. F10.",
                    events: &["feed X0.75"],
                },
                Makes {
                    program: cut!("G10 L12 P1 R.25\nG41 D1 G1 X1. F10.\nY1.\nG40 X2.\n")
                        .with(&["settings.40=\"diameter\""]),
                    block: "G41 D1 G1 X1. F10.",
                    events: &["feed X0.875"],
                },
            ],
        ),
        held(
            "p. 259, p. 269, p. 270",
            "D and H select one of 200 offsets (tool groups, from 1000 on, aside).",
            "gaps of `D` and `H`, rule `number-out-of-range`",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G43 H201 Z1.\n"),
                    conforms: cut!("G43 H200 Z1.\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G41 D201 G1 X1. F10.\nY1.\nG40 X2.\n"),
                    conforms: cut!("G41 D200 G1 X1. F10.\nY1.\nG40 X2.\n"),
                },
            ],
        ),
        held(
            "p. 270",
            "G43 adds the length of offset H to the commanded Z.",
            "effect `length-plus`",
            &[Stands { program: cut!("G43 H1 Z1.\n").with(&[TOOL, G54]), after: "G43 H1 Z1.", at: "MZ-3" }],
        ),
        held(
            "p. 270",
            "G44 subtracts it.",
            "effect `length-minus`; rule `length-subtracted`",
            &[
                Stands { program: cut!("G44 H1 Z1.\n").with(&[TOOL, G54]), after: "G44 H1 Z1.", at: "MZ-11" },
                Rule {
                    finding: "warning[length-subtracted]",
                    violates: cut!("G44 H1 Z1.\n"),
                    conforms: cut!("G43 H1 Z1.\n"),
                },
            ],
        ),
        held(
            "p. 270",
            "H is not 0.",
            "rule `length-offset-zero`",
            &[Rule {
                finding: "warning[length-offset-zero]",
                violates: cut!("G43 H0 Z1.\n"),
                conforms: cut!("G43 H1 Z1.\n"),
            }],
        ),
        held(
            "p. 276",
            "G49 ends tool length compensation.",
            "effect `length-off`",
            &[
                Stands { program: cut!("G49 Z1.\n").with(&[TOOL, G54]), after: "G49 Z1.", at: "MZ-7" },
                Stands { program: cut!("G49\nZ1.\n").with(&[TOOL, G54]), after: "Z1.", at: "MZ-7" },
            ],
        ),
        held(
            "p. 276",
            "After G49 Z counts from the spindle: without G53 the tool comes down by its length.",
            "rule `length-cancelled-before-move`",
            &[
                Rule {
                    finding: "warning[length-cancelled-before-move]",
                    violates: cut!("G0 G49 Z1.\nX2.\n"),
                    conforms: cut!("G0 Z1.\nG53 G49 Z0.\n"),
                },
                Rule {
                    finding: "warning[length-cancelled-before-move]",
                    violates: cut!("G49\nG0 Z1.\nG1 Z-1. F10.\nX1.\nG0 Z1.\n"),
                    conforms: cut!("G0 Z1.\nG1 Z-1. F10.\nX1.\nG0 Z1.\n"),
                },
            ],
        ),
        held(
            "p. 276",
            "H0 ends tool length compensation.",
            "`zero-length-number-cancels`",
            &[Stands { program: cut!("H0\nZ1.\n").with(&[TOOL, G54]), after: "Z1.", at: "MZ-7" }],
        ),
        gap(
            "p. 276, p. 352",
            "M30 ends it, or does not from software 100.16.000.1041 on: what the length is at the start depends on the software.",
            "a first plunge of a tool without any length (`tool-length-missing`, an info at present) is a crash: warning, naming both readings",
            &[Rule {
                finding: "warning[tool-length-missing]",
                violates: mill(
                    "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. S1000 M3\nZ.1 M8\nG1 Z-1. F10.\nG0 Z1. M9\nG28 G91 Z0. M5\nG90\nM30\n%\n",
                ),
                conforms: cut!("G1 Z-1. F10.\n"),
            }],
        ),
        held(
            "p. 310",
            "G141 shifts the end of each move along I, J, K by the size of the tool.",
            "effect `compensation-vector`",
            &[
                Makes {
                    program: cut!(
                        "G141 D1 X0. Y0. Z0. I0. J0. K1.\nG1 X2. Y1. Z1. I0. J-1. K0. F30.\nG40 G0 Z2.\n"
                    )
                    .with(&[TOOL]),
                    block: "G1 X2. Y1. Z1. I0. J-1. K0. F30.",
                    events: &["feed X2 Y0.75 Z1"],
                },
                Makes {
                    program: cut!(
                        "G141 D1 X0. Y0. Z0. I0. J0. K1.\nG1 X2. Y1. Z1. I.6 J0. K.8 F30.\nG40 G0 Z2.\n"
                    )
                    .with(&[TOOL]),
                    block: "G1 X2. Y1. Z1. I.6 J0. K.8 F30.",
                    events: &["feed X2.15 Y1 Z1.2"],
                },
            ],
        ),
        held(
            "p. 310, p. 311",
            "The size is that of offset D, which must be programmed; half of it with diameters (Setting 40).",
            "rule `cutter-vector-without-size`",
            &[Rule {
                finding: "error[cutter-vector-without-size]",
                violates: cut!("G141 X0. Y0. Z0.\nG1 X1. Y1. Z1. I0. J-1. K0. F30.\nG40 G0 Z2.\n"),
                conforms: cut!("G141 D1 X0. Y0. Z0.\nG1 X1. Y1. Z1. I0. J-1. K0. F30.\nG40 G0 Z2.\n"),
            }],
        ),
        held(
            "p. 310, p. 311",
            "The first block may be `G141 D X Y Z` without a vector: it goes to its point.",
            "effect `compensation-vector`",
            &[
                Legal {
                    program: cut!("G141 D1 X0. Y0. Z0.\nG1 X1. Y1. Z1. I0. J-1. K0. F30.\nG40 G0 Z2.\n")
                        .with(&[TOOL]),
                },
                Makes {
                    program: cut!("G141 D1 X.5 Y0. Z0.\nG1 X1. Y1. Z1. I0. J-1. K0. F30.\nG40 G0 Z2.\n")
                        .with(&[TOOL]),
                    block: "G141 D1 X.5 Y0. Z0.",
                    events: &["rapid X0.5 Z0"],
                },
            ],
        ),
        held(
            "p. 310",
            "Only G00 and G01 go with G141.",
            "rule `refused-in-five-axis-mode`",
            &[
                Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: cut!("G141 D1 X0. Y0. Z0.\nG2 X1. Y1. R1. F30.\nG40 G0 Z2.\n"),
                    conforms: cut!("G141 D1 X0. Y0. Z0.\nG1 X1. Y1. Z0. I0. J-1. K0. F30.\nG40 G0 Z2.\n"),
                },
                Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: cut!("G141 D1 X0. Y0. Z0.\nG81 Z-1. R.1 F10.\nG80 G40 G0 Z2.\n"),
                    conforms: cut!("G141 D1 X0. Y0. Z0.\nG0 X1. Y1. Z0. I0. J-1. K0.\nG40 G0 Z2.\n"),
                },
            ],
        ),
        held(
            "p. 310",
            "Under G93 each line has its F.",
            "rule `inverse-time-feed-missing`",
            &[Rule {
                finding: "error[inverse-time-feed-missing]",
                violates: cut!(
                    "G141 D1 X0. Y0. Z0.\nG1 G93 X1. Y1. Z1. I0. J-1. K0. F300.\nX2. I0. J-1. K0.\nG94 G40 G0 Z2.\n"
                ),
                conforms: cut!(
                    "G141 D1 X0. Y0. Z0.\nG1 G93 X1. Y1. Z1. I0. J-1. K0. F300.\nX2. I0. J-1. K0. F300.\nG94 G40 G0 Z2.\n"
                ),
            }],
        ),
        held(
            "p. 310",
            "The vector has the length 1.",
            "rule `cutter-vector-not-unit`",
            &[Rule {
                finding: "error[cutter-vector-not-unit]",
                violates: cut!("G141 D1 X0. Y0. Z0.\nG1 X1. Y1. Z1. I0. J-1. K.5 F30.\nG40 G0 Z2.\n"),
                conforms: cut!("G141 D1 X0. Y0. Z0.\nG1 X1. Y1. Z1. I.15 J.25 K.9566 F30.\nG40 G0 Z2.\n"),
            }],
        ),
        held(
            "p. 310, p. 313",
            "The size may be negative: the shift goes the other way.",
            "effect `compensation-vector`",
            &[Makes {
                program: cut!("G141 D1 X0. Y0. Z0.\nG1 X5. Y0. I0. J-1. K0. F30.\nG40 G0 Z1.\n")
                    .with(&["tools.1={length=4.0,diameter=-0.02}"]),
                block: "G1 X5. Y0. I0. J-1. K0. F30.",
                events: &["feed X5 Y0.01 Z0"],
            }],
        ),
        held(
            "p. 313",
            "A part of the vector that is not written is 0: J-1. alone is enough.",
            "effect `compensation-vector`; rule `cutter-vector-not-unit`",
            &[Silent {
                rule: "cutter-vector-incomplete",
                program: cut!("G141 D1 X0. Y0. Z0. I0. J0. K1.\nG1 X5. Y0. J-1. F30.\nG40 G0 Z1.\n")
                    .with(&[TOOL]),
            }],
        ),
        held(
            "p. 313",
            "An axis is shifted only where its own word stands in the block: Y for J.",
            "effect `compensation-vector`; rule `cutter-vector-without-axis`",
            &[
                Makes {
                    program: cut!("G141 D1 X0. Y0. Z0. I0. J0. K1.\nG1 X5. I0. J-1. K0. F30.\nG40 G0 Z1.\n")
                        .with(&[TOOL]),
                    block: "G1 X5. I0. J-1. K0. F30.",
                    events: &["feed X5 F30"],
                },
                Rule {
                    finding: "warning[cutter-vector-without-axis]",
                    violates: cut!("G141 D1 X0. Y0. Z0. I0. J0. K1.\nG1 X5. I0. J-1. K0. F30.\nG40 G0 Z1.\n")
                        .with(&[TOOL]),
                    conforms: cut!(
                        "G141 D1 X0. Y0. Z0. I0. J0. K1.\nG1 X5. Y0. Z0. I0. J-1. K0. F30.\nG40 G0 Z1.\n"
                    )
                    .with(&[TOOL]),
                },
            ],
        ),
        held(
            "p. 310",
            "A and B may stand in the blocks of G141.",
            "words of `G141`",
            &[Legal {
                program: cut!(
                    "G141 D1 X0. Y0. Z0. A0. B0. I0. J0. K1.\nG1 G93 X1. Y1. Z1. A5. B5. I0. J-1. K0. F300.\nG94 F50.\nG40 G0 Z2.\n"
                ),
            }],
        ),
        not_modelled(
            "p. 311",
            "G141 does not keep a path from crossing itself when too much is compensated; the path between points is not corrected.",
            "no rule looks for crossings of three-dimensional paths; ends of moves are exact",
        ),
        held(
            "p. 313",
            "G143 adds the length of offset H along the tilted tool.",
            "effect `length-five-axis`",
            &[Stands {
                program: tilting!("G143 H1 X0. Y0. Z0. A-20. B-20.\n").with(&[
                    TOOL,
                    G54_AT_HOME,
                    TILTING_HEAD,
                ]),
                after: "G143 H1 X0. Y0. Z0. A-20. B-20.",
                at: "MX-1.3681 MY1.2856 MZ3.5321",
            }],
        ),
        held(
            "p. 313",
            "A positive length moves Z up.",
            "effect `length-five-axis`",
            &[Stands {
                program: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\n").with(&[TOOL, G54_AT_HOME, TILTING_HEAD]),
                after: "G143 H1 X0. Y0. Z0. A0. B0.",
                at: "MX0 MY0 MZ4",
            }],
        ),
        held(
            "p. 313",
            "H is required.",
            "rule `five-axis-length-without-offset`",
            &[Rule {
                finding: "error[five-axis-length-without-offset]",
                violates: tilting!("G143 X0. Y0. Z0. A0. B0.\n"),
                conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\n"),
            }],
        ),
        held(
            "p. 313",
            "G49 or H00 ends it.",
            "effect `length-off`",
            &[
                Stands {
                    program: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG49\nG0 Z5.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    after: "G0 Z5.",
                    at: "MZ5",
                },
                Stands {
                    program: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nH0\nG0 Z5.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    after: "G0 Z5.",
                    at: "MZ5",
                },
            ],
        ),
        held(
            "p. 313",
            "G143 is for machines whose two rotary axes A and B both move the tool.",
            "rule `five-axis-length-on-another-machine`",
            &[
                Rule {
                    finding: "error[five-axis-length-on-another-machine]",
                    violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        "machine.rotary=\"table-table\"",
                    ]),
                    conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                },
                Rule {
                    finding: "error[five-axis-length-on-another-machine]",
                    violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\n")
                        .with(&["machine.axes=[\"X\",\"Y\",\"Z\",\"A\"]"]),
                    conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\n")
                        .with(&["machine.axes=[\"X\",\"Y\",\"Z\",\"A\",\"B\"]"]),
                },
            ],
        ),
        held(
            "p. 313",
            "G90 is in effect under G143; G91 cannot be used.",
            "rule `five-axis-length-in-incremental`",
            &[Rule {
                finding: "error[five-axis-length-in-incremental]",
                violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG91 G1 X1. F10.\nG90\n"),
                conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG1 X1. F10.\n"),
            }],
        ),
        gap(
            "p. 328 to 334",
            "A return to machine zero by `G28 G91 Z0.` is written with G143 in effect.",
            "`five-axis-length-in-incremental` is silent about blocks of G28 and G53: the way home is in increments in the manual's own programs",
            &[Silent {
                rule: "five-axis-length-in-incremental",
                program: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG28 G91 Z0.\nG28 A0. B0.\nG90\n"),
            }],
        ),
        held(
            "p. 313",
            "With work positions A0 B0 the tool is parallel to Z.",
            "rule `five-axis-zero-not-upright`",
            &[Rule {
                finding: "warning[five-axis-zero-not-upright]",
                violates: mill(
                    "O1 (A)\nG20 G10 L2 P1 A5. B0.\nG90 G54\nG143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n",
                ),
                conforms: mill(
                    "O1 (A)\nG20 G10 L2 P1 A0. B0.\nG90 G54\nG143 H1 X0. Y0. Z1. A0. B0.\nG49\nM30\n",
                ),
            }],
        ),
        held(
            "p. 313",
            "Under G143 only G00 and G01 move; G02, G03 and drilling cycles are refused.",
            "rule `refused-in-five-axis-mode`",
            &[
                Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG2 X1. Y1. R1. F10.\n"),
                    conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG1 X1. Y1. F10.\n"),
                },
                Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG81 Z-1. R.1 F10.\nG80\n"),
                    conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG0 Z-1.\n"),
                },
            ],
        ),
        held(
            "p. 326 to 334",
            "The cycles G153 to G169 are meant for G143.",
            "`forbids` of `G143`",
            &[
                Silent {
                    rule: "refused-in-five-axis-mode",
                    program: tilting!("G143 H1 X0. Y0. Z2. A10. B10.\nG1 X.1 F30.\nG161 E.52 F7.\nG80\n"),
                },
                Silent {
                    rule: "refused-in-five-axis-mode",
                    program: tilting!("G143 H1 X0. Y0. Z2. A10. B10.\nG1 X.1 F30.\nG163 E1. Q.15 F7.\nG80\n"),
                },
            ],
        ),
        held(
            "p. 313",
            "An axis X, Y or Z that is not programmed does not move, though A or B turned the length elsewhere.",
            "rule `five-axis-axis-left-out`",
            &[
                Makes {
                    program: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG0 A-30.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    block: "G0 A-30.",
                    events: &["rapid A-30"],
                },
                Rule {
                    finding: "warning[five-axis-axis-left-out]",
                    violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG0 A-30.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                    conforms: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG0 X0. Y0. Z0. A-30.\n").with(&[
                        TOOL,
                        G54_AT_HOME,
                        TILTING_HEAD,
                    ]),
                },
            ],
        ),
        held(
            "p. 313",
            "G93 is recommended under G143.",
            "rule `five-axis-feed-per-minute`",
            &[Rule {
                finding: "warning[five-axis-feed-per-minute]",
                violates: tilting!("G143 H1 X0. Y0. Z0. A0. B0.\nG1 X1. Y0. Z0. A5. B5. F10.\n"),
                conforms: tilting!(
                    "G143 H1 X0. Y0. Z0. A0. B0.\nG1 G93 X1. Y0. Z0. A5. B5. F30.\nG94 F10.\n"
                ),
            }],
        ),
        held(
            "p. 313, p. 327",
            "Straight moves without A and B keep their feed per minute.",
            "rule `five-axis-feed-per-minute`",
            &[Silent {
                rule: "five-axis-feed-per-minute",
                program: tilting!("G143 H1 X0. Y0. Z2. A10. B10.\nG1 X.1 Y.1 Z1. F360.\n"),
            }],
        ),
        not_modelled(
            "p. 391",
            "Setting 117 adds the difference of pivot lengths to G143.",
            "the pivot length is the machine's (`machine.pivot_length`); the difference between machines is the operator's to set",
        ),
        not_modelled(
            "p. 313",
            "G143 makes up for the difference between the length that was posted and that of the tool in use.",
            "what the posted length was is not in the program",
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
