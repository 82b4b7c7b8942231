//! Cutter compensation: pages 137 to 146.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: figures without a
//! statement of their own; what changes the offset page by hand.

use super::mill::{explains, gap, held, mill, moves_told, reports, told};
use crate::proof::{Program, Proof};
use crate::statements::statement::{Chapter, prove};

/// As [`told`], with one setting.
const fn set(text: &'static str, config: &'static [&'static str]) -> Program {
    mill(text).with(config)
}

const fn rule_told(finding: &'static str, violates: &'static str, conforms: &'static str) -> Proof {
    Proof::Rule { finding, violates: told(violates), conforms: told(conforms) }
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Cutter compensation",
    key: "CC",
    file: "haas_mill/cutter_compensation.rs",
    statements: &[
        held(
            "p. 137",
            "G41 shifts the tool to the left of the path, seen in the direction of travel; G42 to the right.",
            "effects of `G41`, `G42`",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nX2.\nG40 X3.\nM30\n",
                    &["rapid", "feed X.75 Y0.", "feed X.75 Y1.25", "feed X2. Y1.25", "feed X3. Y1."],
                ),
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X1. F10.\nY1.\nX2.\nG40 X3.\nM30\n",
                    &["rapid", "feed X1.25 Y0.", "feed X1.25 Y.75", "feed X2. Y.75", "feed X3. Y1."],
                ),
            ],
        ),
        held(
            "p. 137",
            "Setting 40 says whether an offset is a diameter, of which half is the shift, or a radius.",
            "`[semantics.compensation] setting`",
            &[
                Proof::Moves {
                    program: set(
                        "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG10 L12 P1 R.5\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                        &["machine.units=\"inch\"", "settings.40=\"diameter\""],
                    ),
                    are: &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
                },
                Proof::Moves {
                    program: set(
                        "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG10 L12 P1 R.25\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                        &["machine.units=\"inch\"", "settings.40=\"radius\""],
                    ),
                    are: &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
                },
            ],
        ),
        held(
            "p. 137",
            "The offset in effect is the sum of geometry and wear.",
            "effect `write-offsets`; `tool-diameter-wear` of the system variables; a wear that nobody wrote counts as none",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG10 L12 P1 R.4\nG10 L13 P1 R.1\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                    &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
                ),
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\n#2401=.4\n#2601=.1\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                    &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
                ),
            ],
        ),
        held(
            "p. 137",
            "Compensation is in the plane of X and Y only; in space there is G141.",
            "effects of `G41`, `G141`",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1. Z-1.\nG40 X-1. Z0.\nM30\n",
                    &["rapid", "feed X.75 Y0. Z0.", "feed X.75 Y1. Z-1.", "feed X-1. Y1. Z0."],
                ),
                explains("G141", "Moves of two axes are shifted too"),
            ],
        ),
        held(
            "p. 137",
            "Under G41 and G42 arcs are in G17 only.",
            "rule `refused-under-compensation`",
            &[
                rule_told(
                    "error[refused-under-compensation]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X2. F10.\nY1.\nG18 G2 X3. Z-1. R1.\nG17 G1 X5.\nG40 Y5.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X2. F10.\nY1.\nG2 X3. Y2. R1.\nG1 X5.\nG40 Y5.\nM30\n",
                ),
                rule_told(
                    "error[refused-under-compensation]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG19 G1 G41 D1 Y2. F10.\nZ1.\nG40 Y5.\nG17\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG17 G1 G41 D1 Y2. F10.\nX1.\nG40 Y5.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 137, 140",
            "G41 and G42 need a D that is not zero.",
            "word `D` of `G41`, rules lasting-word-never-given and compensation-offset-missing",
            &[
                rule_told(
                    "warning[lasting-word-never-given]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                ),
                rule_told(
                    "warning[compensation-offset-missing]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D0 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 137",
            "A negative offset acts as the other of G41 and G42.",
            "effect of `G41`",
            &[Proof::Moves {
                program: set(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nX2.\nG40 X3.\nM30\n",
                    &["machine.units=\"inch\"", "tools.1.diameter=-0.5"],
                ),
                are: &["rapid", "feed X1.25 Y0.", "feed X1.25 Y.75", "feed X2. Y.75", "feed X3. Y1."],
            }],
        ),
        held(
            "p. 137",
            "G40 cancels compensation, and is in effect at power-on.",
            "effect of `G40`, default of its group",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 X1. F10.\nG41 D1 X2.\nX3.\nG40 X4.\nY1.\nM30\n",
                    &[
                        "rapid",
                        "feed X1. Y0.",
                        "feed X2. Y.25",
                        "feed X3. Y.25",
                        "feed X4. Y0.",
                        "feed X4. Y1.",
                    ],
                ),
                explains("G40", "active at power-on"),
            ],
        ),
        held(
            "p. 137, 140",
            "A program may not end by M30, M2, M0 or M1 with compensation on; one that is terminated so raises an alarm.",
            "rule `compensation-left-on`",
            &[
                rule_told(
                    "error[compensation-left-on]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG0 Z1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                ),
                rule_told(
                    "error[compensation-left-on]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG0 Z1.\nM2\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM2\n",
                ),
                rule_told(
                    "error[compensation-left-on]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nM0\nG40 X-1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM0\nM30\n",
                ),
                rule_told(
                    "warning[compensation-left-on]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nM1\nG40 X-1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM1\nM30\n",
                ),
            ],
        ),
        held(
            "p. 138",
            "The control looks at the two next blocks with X or Y for interference: a block without X or Y between does no harm.",
            "compensation of the engine reads to the next move in the plane",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nZ-1.\nX2.\nG40 X3.\nM30\n",
                &[
                    "rapid",
                    "feed X.75 Y0.",
                    "feed X.75 Y1.25 Z0.",
                    "feed X.75 Y1.25 Z-1.",
                    "feed X2. Y1.25",
                    "feed X3. Y1.",
                ],
            )],
        ),
        held(
            "p. 138",
            "With setting 58 on Fanuc, outside corners up to 270° are sharp, and beyond that get one more straight move.",
            "`[semantics.compensation] style`",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nX2.\nG40 Y2.\nM30\n",
                    &["rapid", "feed X.75", "feed X.75 Y1.25", "feed X2. Y1.25", "feed X2. Y2."],
                ),
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 Y1. F10.\nY3.\nX3.\nX1. Y1.\nX-2.\nG40 Y0.\nM30\n",
                    &[
                        "rapid",
                        "feed X-.25 Y1.",
                        "feed X-.25 Y3.25",
                        "feed X3.25 Y3.25",
                        "feed X3.353553 Y3.",
                        "feed X1.103553 Y.75",
                        "feed X-2. Y.75",
                        "feed X-2. Y0.",
                    ],
                ),
            ],
        ),
        gap(
            "p. 138",
            "With setting 58 on Yasnac, an arc joins every outside corner.",
            "with `settings.58` told to be yasnac: arcs around outside corners (the strategy the engine has for LinuxCNC); as long as it is not followed, an assumption says so",
            &[Proof::Moves {
                program: set(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nX2.\nG40 Y2.\nM30\n",
                    &["machine.units=\"inch\"", "tools.1.diameter=0.5", "settings.58=\"yasnac\""],
                ),
                are: &[
                    "rapid",
                    "feed X.75",
                    "feed X.75 Y1.",
                    "arc X1. Y1.25 I1. J1. S-90.",
                    "feed X2. Y1.25",
                    "feed X2. Y2.",
                ],
            }],
        ),
        gap(
            "p. 138, 141",
            "With setting 58 on Yasnac, the tool's side must reach every edge: a step shorter than its radius at a right angle raises an alarm; on Fanuc it works.",
            "with `settings.58` told to be yasnac: warning[compensation-gouge] for an edge that the tool cannot touch; silent on fanuc",
            &[Proof::Rule {
                finding: "warning[compensation-gouge]",
                violates: set(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nX.9\nY3.\nX0.\nG40 Y5.\nM30\n",
                    &["machine.units=\"inch\"", "tools.1.diameter=0.5", "settings.58=\"yasnac\""],
                ),
                conforms: set(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nX.9\nY3.\nX0.\nG40 Y5.\nM30\n",
                    &["machine.units=\"inch\"", "tools.1.diameter=0.5", "settings.58=\"fanuc\""],
                ),
            }],
        ),
        held(
            "p. 138",
            "With setting 58 on Fanuc the control alarms where the cutter would cut into the contour.",
            "rule compensation-gouge",
            &[rule_told(
                "warning[compensation-gouge]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X1. F10.\nY2.\nX1.4\nY0.\nX5.\nG40 Y-5.\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X1. F10.\nY2.\nX1.9\nY0.\nX5.\nG40 Y-5.\nM30\n",
            )],
        ),
        held(
            "p. 140",
            "The entry move begins at the programmed point and ends offset; the exit move begins offset and ends at the programmed point.",
            "effects of `G41`, `G40`",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y-1. Z0.\nG1 G42 D1 Y0. F10.\nX2.\nG40 Y-1.\nM30\n",
                &["rapid X0. Y-1.", "feed X0. Y-.25", "feed X2. Y-.25", "feed X2. Y-1."],
            )],
        ),
        held(
            "p. 140",
            "A change from one side to the other is a move that begins offset to one side and ends offset to the other.",
            "effect of `G42` after `G41`",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nG42 X3.\nX4.\nG40 X5.\nM30\n",
                &[
                    "rapid",
                    "feed X1. Y.25",
                    "feed X2. Y.25",
                    "feed X3. Y-.25",
                    "feed X4. Y-.25",
                    "feed X5. Y0.",
                ],
            )],
        ),
        held(
            "p. 140",
            "G41 or G42 in a block without X or Y changes nothing before the next move in X or Y.",
            "effects of `G41`, `G42`",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG41 D1\nG1 Z-1. F10.\nX1.\nY1.\nG40 X-1.\nM30\n",
                &["rapid", "feed X0. Y0. Z-1.", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
            )],
        ),
        held(
            "p. 140",
            "G40 in a block without X or Y changes nothing before the next move in X or Y.",
            "effect `compensation-off`: the axes of the plane stand still until a move names one",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40\nZ1.\nX-1.\nM30\n",
                &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X.75 Y1. Z1.", "feed X-1. Y1."],
            )],
        ),
        held(
            "p. 140, 144",
            "Compensation cannot begin or end on an arc: alarm.",
            "conflicts of `G41`, `G42`, `G40` with `G2`, `G3`; rules codes-conflict, compensation-on-in-arc, compensation-off-in-arc",
            &[
                rule_told(
                    "error[codes-conflict]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG2 G41 D1 X2. Y0. R1. F10.\nG1 Y-3.\nG40 X5.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X2. Y0. F10.\nG2 Y-3. R1.5\nG1 G40 X5.\nM30\n",
                ),
                rule_told(
                    "error[codes-conflict]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X2. F10.\nX3.\nG2 G40 X4. Y1. R1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X2. F10.\nX3.\nG1 G40 X4. Y1.\nM30\n",
                ),
                rule_told(
                    "warning[compensation-on-in-arc]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG41 D1\nG2 X2. Y0. R1. F10.\nG1 Y-3.\nG40 X5.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG41 D1\nG1 X2. Y0. F10.\nG1 Y-3.\nG40 X5.\nM30\n",
                ),
                rule_told(
                    "warning[compensation-off-in-arc]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X2. F10.\nX3.\nG40\nG2 X4. Y1. R1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G42 D1 X2. F10.\nX3.\nG40\nG1 X4. Y1.\nM30\n",
                ),
            ],
        ),
        gap(
            "p. 141",
            "D0 counts as an offset of zero and acts like G40.",
            "a D word while compensation is on changes the offset; D0 makes it zero. Now the first D stays in effect to G40, and nothing says so",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nX3. D0\nX4.\nG40 X5.\nM30\n",
                &["rapid", "feed X1. Y.25", "feed X2. Y.25", "feed X3. Y0.", "feed X4. Y0.", "feed X5. Y0."],
            )],
        ),
        gap(
            "p. 141",
            "Another D while compensation is on acts from the end of the move before.",
            "the moves after the D word are offset by the new size; now the first D stays in effect",
            &[Proof::Run {
                program: told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nX3. D2\nX4.\nG40 X5.\nM30\n",
                ),
                prints: &["4 feed 2.0000", "6 feed 4.0000 0.5000", "7 feed 5.0000 0.0000"],
            }],
        ),
        held(
            "p. 141",
            "D and the side cannot change on an arc.",
            "rules `refused-under-compensation`, `codes-conflict`",
            &[
                rule_told(
                    "error[refused-under-compensation]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nG2 X4. Y-2. R2. D2\nG1 Y-5.\nG40 X8.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nG2 X4. Y-2. R2.\nG1 Y-5. D2\nG40 X8.\nM30\n",
                ),
                rule_told(
                    "error[codes-conflict]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nG2 G42 X4. Y-2. R2.\nG1 Y-5.\nG40 X8.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nX2.\nG2 X4. Y-2. R2.\nG1 G42 Y-5.\nG40 X8.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 141",
            "With setting 43 on A, as delivered, the entry goes straight to the point where the second cut begins offset.",
            "`[semantics.compensation] style`",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 X-1. Y1. F10.\nG41 D1 X0.\nX-1. Y2.\nX-2.\nG40 Y5.\nM30\n",
                &[
                    "rapid",
                    "feed X-1. Y1.",
                    "feed X-.176777 Y.823223",
                    "feed X-1.103553 Y1.75",
                    "feed X-2. Y1.75",
                    "feed X-2. Y5.",
                ],
            )],
        ),
        gap(
            "p. 141, 142",
            "With setting 43 on B, an entry that is followed by an angle below 90° goes around with extra moves, for clearance.",
            "with `settings.43` told to be b: the extra moves, or an assumption that says the entry is drawn as type A; now neither",
            &[Proof::Assumes {
                program: set(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 X-1. Y1. F10.\nG42 D1 X0.\nX-1. Y2.\nX-2.\nG40 Y5.\nM30\n",
                    &["machine.units=\"inch\"", "tools.1.diameter=0.5", "settings.43=\"b\""],
                ),
                says: "setting 43",
            }],
        ),
        gap(
            "p. 141",
            "On the inside of arcs the feed is lowered so that the surface moves at F, but not below the percentage of setting 44; at 100 it is not changed.",
            "with `settings.44` told below 100: the feed of an inside arc is F · (R − r) / R, not below that percentage; without it an assumption",
            &[
                Proof::Moves {
                    program: set(
                        "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nG3 X0. Y3. R1.\nG1 X-3.\nG40 Y5.\nM30\n",
                        &["machine.units=\"inch\"", "tools.1.diameter=0.5", "settings.44=1"],
                    ),
                    are: &["rapid", "feed F10.", "feed F10.", "arc F7.5", "feed F10.", "feed F10."],
                },
                Proof::Moves {
                    program: set(
                        "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nG3 X0. Y3. R1.\nG1 X-3.\nG40 Y5.\nM30\n",
                        &["machine.units=\"inch\"", "tools.1.diameter=0.5", "settings.44=100"],
                    ),
                    are: &["rapid", "feed F10.", "feed F10.", "arc F10.", "feed F10.", "feed F10."],
                },
            ],
        ),
        held(
            "p. 141",
            "On the outside of arcs the feed is not raised.",
            "feeds of arcs under compensation",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nG2 X2. Y3. R1.\nG1 X5.\nG40 Y5.\nM30\n",
                &["rapid", "feed", "feed", "arc X2. Y3.25 F10. S-90.", "feed", "feed"],
            )],
        ),
        held(
            "p. 144",
            "The entry move must not be shorter than the tool's radius.",
            "rule lead-in-too-short",
            &[rule_told(
                "warning[lead-in-too-short]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X.24 F10.\nY1.\nG40 X-1.\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X.25 F10.\nY1.\nG40 X-1.\nM30\n",
            )],
        ),
        gap(
            "p. 144",
            "The way out follows the rules of the way in: a straight move that is not shorter than the tool's radius.",
            "a warning like lead-in-too-short for the block of G40",
            &[rule_told(
                "warning[lead-out-too-short]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X.9\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X.5\nM30\n",
            )],
        ),
        gap(
            "p. 144",
            "Compensation is switched on in a block of G1 with X or Y.",
            "info for an entry at rapid (G0 G41 D X Y): the manual asks for G1; the control accepts it, so no more than info",
            &[rule_told(
                "info[compensation-on-in-rapid]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG41 D1 X1.\nG1 Y1. F10.\nG40 X-1.\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
            )],
        ),
        held(
            "p. 144",
            "An inside arc whose radius is smaller than the tool's raises an alarm.",
            "rule compensation-gouge",
            &[rule_told(
                "warning[compensation-gouge]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nG3 X.8 Y2.2 R.2\nG1 X-3.\nG40 Y5.\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nY2.\nG3 X.7 Y2.3 R.3\nG1 X-3.\nG40 Y5.\nM30\n",
            )],
        ),
        held(
            "p. 143",
            "Arcs between straight moves keep their centre; full circles under compensation need I or J.",
            "effects of `G2`, `G3`; rule full-circle-by-radius",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. Y-1. F10.\nY0.\nG3 I-1.\nG1 Y1.\nG40 X-1.\nM30\n",
                    &[
                        "rapid",
                        "feed X.75 Y-1.",
                        "feed X.75 Y0.",
                        "arc X.75 Y0. I0. J0. S360.",
                        "feed X.75 Y1.",
                        "feed X-1. Y1.",
                    ],
                ),
                reports(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG3 X0. Y0. R1. F10.\nM30\n",
                    &["warning[full-circle-by-radius] 3"],
                ),
            ],
        ),
        held(
            "p. 192, 231",
            "G103 cannot be used while compensation is on.",
            "rule `refused-under-compensation`",
            &[
                rule_told(
                    "error[refused-under-compensation]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D1 X1. F10.\nG103 P1\nY1.\nG103\nG40 X-1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG103 P1\nG103\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                ),
                rule_told(
                    "error[refused-under-compensation]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG103 P1\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nG103\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG103 P1\nG103 P0\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                ),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
