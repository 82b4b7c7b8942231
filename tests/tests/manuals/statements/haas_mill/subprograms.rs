//! Subprograms: pages 148 to 156.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: how the list of
//! search locations is filled on the screen (page 156).

use super::mill::{gap, held, legal, mill, moves, moves_told, reports, rule, told};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Subprograms",
    key: "SUB",
    file: "haas_mill/subprograms.rs",
    statements: &[
        held(
            "p. 149, 152",
            "M97 P calls the lines of this program from N of that number to M99, and goes on after the call.",
            "effect of `M97`; rules jump-target-missing, required-word-missing",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM97 P10\nX3.\nM97 P10\nM30\nN10 Y1.\nY2.\nM99\n",
                    &[
                        "rapid X0.",
                        "rapid X0. Y1.",
                        "rapid X0. Y2.",
                        "rapid X3. Y2.",
                        "rapid X3. Y1.",
                        "rapid X3. Y2.",
                    ],
                ),
                rule(
                    "error[jump-target-missing]",
                    "O1\nM97 P11\nM30\nN10 G4 P1.\nM99\n",
                    "O1\nM97 P10\nM30\nN10 G4 P1.\nM99\n",
                ),
                rule("error[required-word-missing]", "O1\nM97\nM30\n", "O1\nM97 P10\nM30\nN10 M99\n"),
            ],
        ),
        held(
            "p. 149",
            "The lines that M97 calls are in the same program.",
            "rule jump-target-missing",
            &[rule(
                "error[jump-target-missing]",
                "O1\nM97 P10\nM30\nO2\nN10 G4 P1.\nM99\n",
                "O1\nM98 P2\nM30\nO2\nN10 G4 P1.\nM99\n",
            )],
        ),
        held(
            "p. 149",
            "M98 P calls the program of that number.",
            "effect of `M98`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM98 P2\nX3.\nM30\nO2\nX1.\nM99\n",
                    &["rapid X0.", "rapid X1.", "rapid X3."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM98 P40008\nM30\nO40008\nX1.\nM99\n",
                    &["rapid X0.", "rapid X1."],
                ),
                rule(
                    "error[decimal-point-on-integer]",
                    "O1\nM98 P2.\nM30\nO2\nM99\n",
                    "O1\nM98 P2\nM30\nO2\nM99\n",
                ),
            ],
        ),
        held(
            "p. 149",
            "M98 names its program by P, or by a path.",
            "word `P` of `M98`; rule `required-word-missing`",
            &[rule("error[required-word-missing]", "O1\nM98\nM30\n", "O1\nM98 P2\nM30\nO2\nM99\n")],
        ),
        held(
            "p. 149",
            "L repeats the call so often before the program goes on.",
            "`call-repeats`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM97 P10 L3\nX9.\nM30\nN10 G91 X1.\nG90\nM99\n",
                    &["rapid X0.", "rapid X1.", "rapid X2.", "rapid X3.", "rapid X9."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM98 P2 L2\nX9.\nM30\nO2\nG91 X1.\nG90\nM99\n",
                    &["rapid X0.", "rapid X1.", "rapid X2.", "rapid X9."],
                ),
            ],
        ),
        held(
            "p. 149",
            "The control looks for the program of M98 in the folder of the main program.",
            "search of called programs",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0.\nM98 P40008\nX3.\nM30\n")
                        .beside(&[("O40008.nc", "%\nO40008\nX1.\nM99\n%\n")]),
                    are: &["rapid X0.", "rapid X1.", "rapid X3."],
                },
                Proof::Reports {
                    program: mill("O1\nG20 G54 G0 G90 X0.\nM98 P40008\nX3.\nM30\n")
                        .beside(&[("O40008.nc", "%\nO40008\nX1.\nM99\n%\n")]),
                    findings: &[],
                },
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0.\nM98 P8\nX3.\nM30\n")
                        .beside(&[("O00008.nc", "%\nO00008\nX1.\nM99\n%\n")]),
                    are: &["rapid X0.", "rapid X1.", "rapid X3."],
                },
            ],
        ),
        held(
            "p. 149, 156",
            "Where it is not there, the control looks in the place of setting 251, then in those of setting 252.",
            "`search.paths` of the configuration, in its order",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 X0.\nM98 P7\nM98 P8\nX3.\nM30\n")
                    .with(&["search.paths=[\"memory\", \"usb\"]"])
                    .beside(&[
                        ("memory/O00007.nc", "%\nO00007\nX1.\nM99\n%\n"),
                        ("usb/O00007.nc", "%\nO00007\nX5.\nM99\n%\n"),
                        ("usb/O00008.nc", "%\nO00008\nX2.\nM99\n%\n"),
                    ]),
                are: &["rapid X0.", "rapid X1.", "rapid X2.", "rapid X3."],
            }],
        ),
        held(
            "p. 149",
            "A program that is found nowhere raises an alarm.",
            "rule subprogram-missing",
            &[
                rule("warning[subprogram-missing]", "O1\nM98 P2\nM30\n", "O1\nM98 P2\nM30\nO2\nM99\n"),
                Proof::Assumes {
                    program: mill("O1\nM98 P2\nM30\n"),
                    says: "what program 2 does is not known",
                },
            ],
        ),
        held(
            "p. 149, 150",
            "A cycle that is active when a subprogram is called is done at each of its positions, and at the position of the cycle's own block.",
            "state over calls; `[semantics.cycles] needs-axis`, setting 28",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G81 Z-.5 R.1 F5.\nM98 P2\nG80\nM30\nO2\nX1.\nY1.\nM99\n",
                    &[
                        "rapid",
                        "rapid X0. Z.1",
                        "feed X0. Z-.5",
                        "rapid Z.1",
                        "rapid X1. Z.1",
                        "feed Z-.5",
                        "rapid Z.1",
                        "rapid X1. Y1.",
                        "feed Z-.5",
                        "rapid Z.1",
                    ],
                ),
                reports(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG99 G81 Z-.5 R.1 F5.\nM98 P2\nG80\nM30\nO2\nX1.\nY1.\nM99\n",
                    &[],
                ),
            ],
        ),
        held(
            "p. 149, 151",
            "G98 in the subprogram takes the tool back to the initial level for that hole and those after it, G99 to R again.",
            "effects of `G98`, `G99`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G81 Z-.5 R.1 F5.\nM98 P2\nG80\nM30\nO2\nG98 X1.\nG99 X2.\nM99\n",
                &[
                    "rapid",
                    "rapid Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                    "rapid X1. Z.1",
                    "feed Z-.5",
                    "rapid X1. Z1.",
                    "rapid X2. Z1.",
                    "rapid X2. Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                ],
            )],
        ),
        held(
            "p. 150, p. 248",
            "G0 ends the cycle, here after the subprogram with its positions: the next move does not drill.",
            "`[semantics.cycles] motion-ends-cycle`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G81 Z-.5 R.1 F5.\nM98 P2\nG0 Z1.\nX5.\nM30\nO2\nX1.\nM99\n",
                &[
                    "rapid",
                    "rapid Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                    "rapid X1.",
                    "feed Z-.5",
                    "rapid Z.1",
                    "rapid Z1.",
                    "rapid X5. Z1.",
                ],
            )],
        ),
        held(
            "p. 152",
            "The main program ends with M30, and local subprograms are written after it.",
            "rule fall-into-subprogram",
            &[rule(
                "warning[fall-into-subprogram]",
                "O1\nM97 P10\nG4 P2.\nN10 G4 P1.\nM99\n",
                "O1\nM97 P10\nG4 P2.\nM30\nN10 G4 P1.\nM99\n",
            )],
        ),
        held(
            "p. 134, 152",
            "A subprogram ends with M99.",
            "rule `subprogram-without-return`",
            &[
                rule(
                    "error[subprogram-without-return]",
                    "%\nO1\nM97 P10\nM30\nN10 G4 P1.\n%\n",
                    "%\nO1\nM97 P10\nM30\nN10 G4 P1.\nM99\n%\n",
                ),
                rule(
                    "warning[subprogram-without-return]",
                    "O1\nM97 P10\nM30\nN10 G4 P1.\nO2\nG4 P2.\nM30\n",
                    "O1\nM97 P10\nM30\nN10 G4 P1.\nM99\nO2\nG4 P2.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 155, 156",
            "The same subprogram works at every work offset that is chosen before its call.",
            "state over calls",
            &[moves_told(
                "O1\nG20 G54 G0 G90 X0. Y0.\nM98 P2\nG55\nM98 P2\nM30\nO2\nX1. Y0.\nM99\n",
                &["rapid MX-10.", "rapid X1. MX-9.", "rapid X1. MX-19."],
            )],
        ),
        held(
            "p. 155",
            "Modes that a subprogram changes stay changed after it.",
            "state over calls; rule incremental-left-on",
            &[
                Proof::Moves {
                    program: told("O1\nG20 G54 G0 G90 X0.\nM98 P2\nX1.\nM30\nO2\nG55\nM99\n"),
                    are: &["rapid X0. MX-10.", "rapid X1. MX-19."],
                },
                rule(
                    "warning[incremental-left-on]",
                    "O1\nG20 G54 G0 G90 X0.\nM98 P2\nX1.\nM30\nO2\nG91 X1.\nM99\n",
                    "O1\nG20 G54 G0 G90 X0.\nM98 P2\nX1.\nM30\nO2\nG91 X1.\nG90\nM99\n",
                ),
            ],
        ),
        gap(
            "p. 122, 149",
            "M98 may name a path in parentheses in place of P.",
            "the file of the path is looked for, in the folder of the program and in `search.paths`, and executed; one that is not there is warning[subprogram-missing]. Now the call is passed over in silence",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0.\nM98 (part.nc)\nX3.\nM30\n")
                        .beside(&[("part.nc", "%\nO5\nX1.\nM99\n%\n")]),
                    are: &["rapid X0.", "rapid X1.", "rapid X3."],
                },
                rule("warning[subprogram-missing]", "O1\nM98 (part.nc)\nM30\n", "O1\nM98 P2\nM30\nO2\nM99\n"),
            ],
        ),
        held(
            "p. 194",
            "/M99 before M30 makes a program that is a subprogram with block delete off and a main program with it on.",
            "block delete: each position of the switch is a run of its own",
            &[
                legal("O2\nG54 G0 G90 X1.\n/M99\nM30\n"),
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM98 P2\nX3.\nM30\nO2\nX1.\n/M99\nM30\n",
                    &["rapid X0.", "rapid X1.", "rapid X3."],
                ),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
