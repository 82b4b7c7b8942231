//! Basic programming: the parts of a program, absolute and incremental, offsets, frequent M codes, straight and circular
//! cuts: pages 124 to 137.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: editing and
//! background editing (pages 117–124), and advice that no program shows (which codes belong into which part).

use super::mill::{
    assumes, explains, held, legal, mill, moves, moves_told, not_modelled, reports, rule, run, says,
};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Basic programming",
    key: "BAS",
    file: "haas_mill/basics.rs",
    statements: &[
        held(
            "p. 125",
            "A block takes several G codes of different groups, never two of one group.",
            "modal groups, rule two-codes-of-one-group",
            &[
                rule(
                    "error[two-codes-of-one-group]",
                    "O1\nG0 G1 X1. F5.\nM30\n",
                    "O1\nG0 G90 G17 G40 G49 G54\nX1.\nM30\n",
                ),
                rule(
                    "error[two-codes-of-one-group]",
                    "O1\nG90 G91 G0 X1.\nM30\n",
                    "O1\nG91 G28 Z0.\nG90\nM30\n",
                ),
                rule("error[two-codes-of-one-group]", "O1\nG54 G55\nM30\n", "O1\nG55 G43 H1\nM30\n"),
            ],
        ),
        held(
            "p. 125, 133",
            "A block takes one M code only.",
            "limit `m-codes-per-block`, rule too-many-m-codes",
            &[rule("error[too-many-m-codes]", "O1\nM3 S500 M8\nM30\n", "O1\nM3 S500\nM8\nM30\n")],
        ),
        held(
            "p. 126, 127",
            "A percent sign opens and closes a program that was written outside the control.",
            "rule tape-mark-missing",
            &[
                legal("%\nO1\nG4 P1.\nM30\n%\n"),
                rule("info[tape-mark-missing]", "O1\nM30\n%\n", "%\nO1\nM30\n%\n"),
                rule(
                    "info[stray-tape-mark]",
                    "%\nO1\nG4 P1.\n%\nG4 P2.\nM30\n%\n",
                    "%\nO1\nG4 P1.\nG4 P2.\nM30\n%\n",
                ),
            ],
        ),
        held(
            "p. 126",
            "A program is named by the letter O or o and five digits.",
            "letter `O`; rule `number-out-of-range`",
            &[
                legal("O12345\nG4 P1.\nM30\n"),
                legal("o00012\nG4 P1.\nM30\n"),
                rule("error[number-out-of-range]", "O123456\nG4 P1.\nM30\n", "O12345\nG4 P1.\nM30\n"),
            ],
        ),
        held(
            "p. 126, 133",
            "T selects the tool that comes next and changes nothing; M6 puts it into the spindle.",
            "effect of `M6`; rule tool-called-not-changed",
            &[
                run("O1\nT3 M6\nM30\n", &["2 tool 5.000 T3"]),
                moves("O1\nG20 G54 G0 G90\nT1 M6\nT2\nX#3026\nM30\n", &["rapid X1."]),
                rule("info[tool-called-not-changed]", "O1\nT1 M6\nT2\nM30\n", "O1\nT1 M6\nT2\nM6\nM30\n"),
            ],
        ),
        held(
            "p. 126",
            "G0 makes the moves that follow rapid, until another motion code.",
            "effects of `G0`, `G1`",
            &[moves(
                "O1\nG20 G54 G90\nG0 X1.\nY1.\nG1 X2. F5.\nY2.\nG0 X3.\nM30\n",
                &["rapid X1.", "rapid Y1.", "feed X2. F5.", "feed Y2. F5.", "rapid X3."],
            )],
        ),
        held(
            "p. 126, 128",
            "After G90 a word is a position in the coordinate system in use.",
            "effect of `G90`",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X1. Y2. Z3.\nX1.\nM30\n",
                    &["rapid MX-9. MY-3. MZ-5.", "rapid MX-9. MY-3."],
                ),
                moves_told(
                    "O1\nG20 G55 G0 G90 X1.\nG54 X1.\nM30\n",
                    &["rapid MX-19. X1.", "rapid MX-9. X1."],
                ),
            ],
        ),
        held(
            "p. 128",
            "After G91 a word is the distance from the present position.",
            "effect of `G91`",
            &[moves(
                "O1\nG20 G54 G0 G90 X1. Y1.\nG91 X1.\nX1. Y-1.\nG90 X0.\nM30\n",
                &["rapid X1. Y1.", "rapid X2. Y1.", "rapid X3. Y0.", "rapid X0. Y0."],
            )],
        ),
        held(
            "p. 126",
            "G17 chooses the plane of X and Y.",
            "effect of `G17`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG18\nG17\nG2 X1. Y1. R1. F5.\nM30\n",
                &["rapid X0. Y0.", "arc X1. Y1. S-90. I1. J0."],
            )],
        ),
        held(
            "p. 126",
            "G54 puts the zero where the offset of G54 says.",
            "effect of `G54`",
            &[
                moves_told("O1\nG20 G54 G0 G90 X0. Y0.\nM30\n", &["rapid MX-10. MY-5."]),
                assumes("O1\nG54 G0 G90 X0. Y0.\nM30\n", "the work offset G54 is not known"),
            ],
        ),
        held(
            "p. 126, 134",
            "M3 turns the spindle clockwise with S revolutions a minute, M4 the other way.",
            "effects of `M3`, `M4`",
            &[
                run("O1\nS1000 M3\nM30\n", &["2 spindle 1000 rpm", "2 spindle clockwise"]),
                run("O1\nS800 M4\nM30\n", &["2 spindle 800 rpm", "2 spindle counter-clockwise"]),
            ],
        ),
        held(
            "p. 134",
            "S goes up to the highest speed of the spindle.",
            "rule speed-above-machine-limit",
            &[Proof::Rule {
                finding: "warning[speed-above-machine-limit]",
                violates: mill("O1\nS8001 M3\nM30\n").with(&["machine.max_rpm=8000"]),
                conforms: mill("O1\nS8000 M3\nM30\n").with(&["machine.max_rpm=8000"]),
            }],
        ),
        held(
            "p. 134",
            "M5 stops the spindle, and the program waits until it has stopped.",
            "effect of `M5`; rule spindle-stopped-while-cutting",
            &[
                run("O1\nS800 M3\nM5\nM30\n", &["3 spindle stop"]),
                explains("M5", "waits until it has nearly stopped"),
                rule(
                    "warning[spindle-stopped-while-cutting]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS800 M3\nG1 X1. F5.\nM5\nX2.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS800 M3\nG1 X1. F5.\nM5\nG0 X2.\nM30\n",
                ),
            ],
        ),
        not_modelled(
            "p. 126",
            "A machine with a gearbox takes the gear that fits the speed; M41 and M42 choose it instead.",
            "the gear changes torque, not what the program makes the axes and the spindle do",
        ),
        held(
            "p. 126, 133",
            "G43 with H adds the length of that number to Z.",
            "effect of `G43`",
            &[
                moves_told(
                    "O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\nG43 H1 Z.1\nM30\n",
                    &["rapid", "rapid Z.1 MZ-4.9"],
                ),
                moves_told(
                    "O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\nG43 H2 Z.1\nM30\n",
                    &["rapid", "rapid Z.1 MZ-3.9"],
                ),
            ],
        ),
        held(
            "p. 132",
            "G43 with H belongs after every tool change.",
            "rule tool-length-missing",
            &[rule(
                "warning[tool-length-missing]",
                "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nS800 M3\nG43 H1 Z.1\nG1 Z-1. F5.\nG0 Z1.\nG49\nT2 M6\nX1. S800 M3\nZ.1\nG1 Z-1.\nG0 Z1.\nM30\n",
                "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nS800 M3\nG43 H1 Z.1\nG1 Z-1. F5.\nG0 Z1.\nG49\nT2 M6\nX1. S800 M3\nG43 H2 Z.1\nG1 Z-1.\nG0 Z1.\nM30\n",
            )],
        ),
        held(
            "p. 132",
            "H should be the number of the tool in the spindle, or there may be a collision.",
            "rule `length-offset-of-another-tool`",
            &[
                rule(
                    "warning[length-offset-of-another-tool]",
                    "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nS800 M3\nG43 H2 Z.1\nG1 Z-1. F5.\nG0 Z1.\nM30\n",
                    "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nS800 M3\nG43 H1 Z.1\nG1 Z-1. F5.\nG0 Z1.\nM30\n",
                ),
                rule(
                    "warning[length-offset-of-another-tool]",
                    "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nS800 M3\nG43 H1 Z.1\nG1 Z-1. F5.\nG0 Z1.\nT2 M6\nX1. S800 M3\nG43 H1 Z.1\nG1 Z-1.\nG0 Z1.\nM30\n",
                    "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nS800 M3\nG43 H1 Z.1\nG1 Z-1. F5.\nG0 Z1.\nT2 M6\nX1. S800 M3\nG43 H2 Z.1\nG1 Z-1.\nG0 Z1.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 132",
            "With setting 15 on, H and T that differ raise alarm 332.",
            "rule `length-offset-of-another-tool`",
            &[
                Proof::Rule {
                    finding: "error[length-offset-of-another-tool]",
                    violates: mill("O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nG43 H2 Z.1\nM30\n")
                        .with(&["settings.15=\"on\""]),
                    conforms: mill("O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nG43 H1 Z.1\nM30\n")
                        .with(&["settings.15=\"on\""]),
                },
                Proof::Says {
                    program: mill("O1\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nG43 H2 Z.1\nM30\n")
                        .with(&["settings.15=\"on\""]),
                    finding: "error[length-offset-of-another-tool]",
                    words: "332",
                },
            ],
        ),
        held(
            "p. 126, 135",
            "M8 turns coolant on, M9 off.",
            "effects of `M8`, `M9`",
            &[run("O1\nM8\nM9\nM30\n", &["2 coolant flood-on", "3 coolant flood-off"])],
        ),
        held(
            "p. 135",
            "Coolant through the spindle, where fitted, is switched by M88 and M89.",
            "effects of `M88`, `M89`",
            &[
                run("O1\nM88\nM89\nM30\n", &["2 coolant through-on", "3 coolant through-off"]),
                explains("M88", "needs the option: through-spindle coolant"),
            ],
        ),
        held(
            "p. 127, 135",
            "G1 needs a feed: F in its block or before; it holds for later moves.",
            "rule feed-missing",
            &[
                rule(
                    "error[feed-missing]",
                    "O1\nG20 G54 G90 G0 X0.\nG1 X1.\nM30\n",
                    "O1\nG20 G54 G90 G0 X0.\nG1 X1. F5.\nM30\n",
                ),
                moves(
                    "O1\nG20 G54 G90 G0 X0. Y0. Z0.\nG1 X1. F5.\nY1.\nG2 X2. Y0. R1.\nG1 X3. F6.\nM30\n",
                    &["rapid", "feed F5.", "feed F5.", "arc F5.", "feed F6."],
                ),
            ],
        ),
        held(
            "p. 135",
            "G1 cuts straight in X, Y, Z and A, as far as its words name them.",
            "effect of `G1`",
            &[moves(
                "O1\nG20 G54 G90 G0 X0. Y0. Z0. A0.\nG1 X1. F5.\nY1. Z-.5\nA10.\nM30\n",
                &["rapid", "feed X1. Y0. Z0. A0.", "feed X1. Y1. Z-.5 A0.", "feed X1. Y1. Z-.5 A10."],
            )],
        ),
        held(
            "p. 127",
            "F20. is 20 inches (508 mm) a minute.",
            "effect of `G94`, units",
            &[
                moves(
                    "O1\nG20 G54 G90 G0 X0. Y0. Z0.\nG1 X20. F20.\nM30\n",
                    &["rapid", "feed X20. F20. T60."],
                ),
                moves(
                    "O1\nG21 G54 G90 G0 X0. Y0. Z0.\nG1 X508. F508.\nM30\n",
                    &["rapid", "feed X508. F508. T60."],
                ),
            ],
        ),
        held(
            "p. 127",
            "G53 makes the words of the block machine coordinates, at the motion code in effect.",
            "effect of `G53`",
            &[
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG53 Y0.\nM30\n",
                    &["rapid MX-10. MY-5.", "rapid MX-10. MY0. Y5."],
                ),
                moves_told(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG1 X1. F10.\nG53 Y0.\nM30\n",
                    &["rapid", "feed X1.", "feed MY0. F10."],
                ),
            ],
        ),
        held(
            "p. 127",
            "G53 G49 Z0 cancels the length and brings the spindle, not the tool's tip, to machine zero.",
            "effects of `G53`, `G49`",
            &[moves_told(
                "O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\nG43 H1 Z.1\nG53 G49 Z0.\nM30\n",
                &["rapid", "rapid Z.1 MZ-4.9", "rapid MZ0. Z8."],
            )],
        ),
        held(
            "p. 127, 134",
            "M30 ends the program and goes back to its head; M2 ends it at its own block.",
            "effects of `M30`, `M2`; rule unreachable-block",
            &[
                run("O1\nM30\n", &["2 end"]),
                run("O1\nM2\n", &["2 end"]),
                explains("M2", "the cursor stays where it is"),
                rule("warning[unreachable-block]", "O1\nM30\nG4 P1.\nM30\n", "O1\nG4 P1.\nM30\n"),
            ],
        ),
        held(
            "p. 128, 132",
            "A cycle with L in G91 repeats, each time by the distance that X and Y name; without R, feeding begins where Z is.",
            "need of `R` in canned cycles",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0.\nZ.1\nG99 G91 G81 F8. X1.25 Z-.3 L3\nG80\nM30\n",
                    &[
                        "rapid",
                        "rapid X0. Z.1",
                        "rapid X1.25 Z.1",
                        "feed X1.25 Z-.2",
                        "rapid X1.25 Z.1",
                        "rapid X2.5 Z.1",
                        "feed X2.5 Z-.2",
                        "rapid X2.5 Z.1",
                        "rapid X3.75 Z.1",
                        "feed X3.75 Z-.2",
                        "rapid X3.75 Z.1",
                    ],
                ),
                reports(
                    "O1\nG20 G54 G0 G90 X0. Y0.\nS500 M3\nZ.1\nG99 G91 G81 F8. X1.25 Z-.3 L3\nG80\nG90\nM30\n",
                    &[],
                ),
            ],
        ),
        held(
            "p. 132",
            "A cycle with L in G91 repeats, each time by the distance that X and Y name.",
            "`[semantics.cycles] repeat`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0.\nZ1.\nG99 G91 G81 F8. X1.25 Z-.3 R-.9 L3\nG80\nM30\n",
                &[
                    "rapid",
                    "rapid X0. Z1.",
                    "rapid X1.25 Z1.",
                    "rapid X1.25 Z.1",
                    "feed X1.25 Z-.2",
                    "rapid X1.25 Z.1",
                    "rapid X2.5 Z.1",
                    "feed X2.5 Z-.2",
                    "rapid X2.5 Z.1",
                    "rapid X3.75 Z.1",
                    "feed X3.75 Z-.2",
                    "rapid X3.75 Z.1",
                ],
            )],
        ),
        held(
            "p. 132",
            "In G90 the cycle names the depth as a position, and is done at each position until G80.",
            "effects of `G81`, `G80`; rule cycle-repeated-in-place for `L` in G90",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0.\nZ.1\nG99 G81 F8. X1. Z-.2 R.1\nX2.\nG80\nX3.\nM30\n",
                    &[
                        "rapid",
                        "rapid Z.1",
                        "rapid X1.",
                        "feed X1. Z-.2",
                        "rapid Z.1",
                        "rapid X2.",
                        "feed X2. Z-.2",
                        "rapid Z.1",
                        "rapid X3. Z.1",
                    ],
                ),
                rule(
                    "warning[cycle-repeated-in-place]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG81 X1. Z-.2 R.1 F8. L3\nG80\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG91 G81 X1. Z-.2 R-.9 F8. L3\nG80\nG90\nM30\n",
                ),
            ],
        ),
        held(
            "p. 132",
            "Work offsets are G54 to G59, G110 to G129 and G154 P1 to P99.",
            "effects of these codes, range of `P` of `G154`",
            &[
                legal("O1\nG0 G90\nG54 X1.\nG59 X1.\nG110 X1.\nG129 X1.\nG154 P1 X1.\nG154 P99 X1.\nM30\n"),
                rule(
                    "error[number-out-of-range]",
                    "O1\nG154 P100 G0 X1.\nM30\n",
                    "O1\nG154 P99 G0 X1.\nM30\n",
                ),
                rule("error[number-out-of-range]", "O1\nG154 P0 G0 X1.\nM30\n", "O1\nG154 P1 G0 X1.\nM30\n"),
                rule("error[required-word-missing]", "O1\nG154 G0 X1.\nM30\n", "O1\nG154 P1 G0 X1.\nM30\n"),
                rule("error[unknown-code]", "O1\nG130 G0 X1.\nM30\n", "O1\nG129 G0 X1.\nM30\n"),
            ],
        ),
        held(
            "p. 132",
            "G110 to G129 are the same offsets as G154 P1 to P20.",
            "effects `work-offset`",
            &[Proof::Moves {
                program: mill("O1\nG20 G0 G90\nG154 P1 X1.\nG110 X1.\nG154 P20 X1.\nG129 X1.\nM30\n")
                    .with(&["machine.units=\"inch\"", "offsets.G110={X=-10}", "offsets.G129={X=-20}"]),
                are: &["rapid MX-9.", "rapid MX-9.", "rapid MX-19.", "rapid MX-19."],
            }],
        ),
        held(
            "p. 133, 134",
            "A tool may be changed wherever the axes are.",
            "no rule asks for a position before `M6`",
            &[legal("O1\nT1 M6\nG20 G54 G0 G90 X5. Y5.\nG43 H1 Z-1.\nT2 M6\nG43 H2 Z1.\nM30\n")],
        ),
        held(
            "p. 134",
            "M6 brings Z to machine zero by itself; after the change Z is there.",
            "`change-at-zero`: machine Z is 0 after the change",
            &[Proof::Run {
                program: super::mill::told("O1\nG20 G54 G0 G90 X0. Y0. Z1.\nT1 M6\nX1.\nM30\n"),
                prints: &["2 rapid 0.0000 0.0000 1.0000", "3 tool", "4 rapid 1.0000 0.0000 8.0000"],
            }],
        ),
        held(
            "p. 134",
            "M99 ends a subprogram; the program that called it goes on.",
            "effect of `M99`",
            &[moves("O1\nG20 G54 G0 G90\nM97 P10\nX2.\nM30\nN10 X1.\nM99\n", &["rapid X1.", "rapid X2."])],
        ),
        held(
            "p. 134",
            "A subprogram that does not end with M99 raises alarm 312.",
            "rule `subprogram-without-return`, alarm 312",
            &[
                rule(
                    "error[subprogram-without-return]",
                    "O1\nM97 P10\nM30\nN10 G4 P1.\n",
                    "O1\nM97 P10\nM30\nN10 G4 P1.\nM99\n",
                ),
                says("O1\nM97 P10\nM30\nN10 G4 P1.\n", "error[subprogram-without-return]", "312"),
                rule(
                    "error[subprogram-without-return]",
                    "%\nO1\nM98 P2\nM30\nO2\nG4 P1.\n%\n",
                    "%\nO1\nM98 P2\nM30\nO2\nG4 P1.\nM99\n%\n",
                ),
            ],
        ),
        held(
            "p. 135",
            "The corner to the next straight move is chamfered by ,C or rounded by ,R in a block of G1.",
            "words `,C` and `,R` of `G1`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 X1. ,C.25 F10.\nY1.\nM30\n",
                    &["rapid", "feed X.75 Y0.", "feed X1. Y.25", "feed X1. Y1."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 X1. ,R.25 F10.\nY1.\nM30\n",
                    &["rapid", "feed X.75 Y0.", "arc X1. Y.25 I.75 J.25 S90.", "feed X1. Y1."],
                ),
            ],
        ),
        held(
            "p. 135",
            "The centre of an arc is given by I, J, K from its start; X, Y, Z are its end.",
            "effects of `G2`, `G3`",
            &[moves(
                "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG3 F20. I-2. J0. X0. Y2.\nM30\n",
                &["rapid", "arc X0. Y2. I2. J2. S180. F20."],
            )],
        ),
        held(
            "p. 135, 136",
            "An arc may be given by its end and R.",
            "effects of `G2`, `G3`",
            &[moves(
                "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG3 F20. X0. Y2. R2.\nM30\n",
                &["rapid", "arc X0. Y2. I2. J2. S180."],
            )],
        ),
        held(
            "p. 135, 137",
            "I, J, K without an end cut a full circle; a radius cannot.",
            "effects of `G2`, `G3`; rule full-circle-by-radius",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG2 F20. I2. J0.\nM30\n",
                    &["rapid", "arc X4. Y2. I6. J2. S-360."],
                ),
                rule(
                    "warning[full-circle-by-radius]",
                    "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG2 X4. Y2. R2. F20.\nM30\n",
                    "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG2 X4. Y2. I2. F20.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 135",
            "An arc needs its centre or its radius.",
            "rule arc-without-centre",
            &[rule(
                "error[arc-without-centre]",
                "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG2 X5. Y3. F20.\nM30\n",
                "O1\nG20 G54 G0 G90 X4. Y2. Z0.\nG2 X5. Y3. I1. F20.\nM30\n",
            )],
        ),
        held(
            "p. 135",
            "I belongs to X, J to Y, K to Z: an arc with only the centre word of the other plane has no centre.",
            "rule `arc-wrong-plane-word`",
            &[
                rule(
                    "warning[arc-wrong-plane-word]",
                    "O1\nG20 G54 G17 G0 G90 X4. Y2. Z0.\nG2 X5. Y3. K1. F20.\nM30\n",
                    "O1\nG20 G54 G17 G0 G90 X4. Y2. Z0.\nG2 X5. Y3. I1. F20.\nM30\n",
                ),
                rule(
                    "warning[arc-wrong-plane-word]",
                    "O1\nG20 G54 G18 G0 G90 X4. Y2. Z0.\nG2 X5. Z1. J1. F20.\nM30\n",
                    "O1\nG20 G54 G18 G0 G90 X4. Y2. Z0.\nG2 X5. Z1. I1. F20.\nM30\n",
                ),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
