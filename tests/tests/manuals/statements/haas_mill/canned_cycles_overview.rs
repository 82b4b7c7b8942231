//! Canned cycles and special G codes as chapter 5 introduces them: pages 146 to 148, and rotation, scaling, tapping and the
//! other options of pages 160 to 164.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: the pages of the
//! single codes (chapter 7), buying and trying options (page 160), and screens of the visual programming system.

use super::mill::{explains, gap, held, legal, mill, moves, not_modelled, reports, rule, run};
use crate::proof::{Program, Proof};
use crate::statements::statement::{Chapter, prove};

const fn set(text: &'static str, config: &'static [&'static str]) -> Program {
    mill(text).with(config)
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Canned cycles and special codes, overview",
    key: "CYC",
    file: "haas_mill/canned_cycles_overview.rs",
    statements: &[
        held(
            "p. 146",
            "While a cycle is active the machine does it at every position that is commanded.",
            "effects of cycles",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G85 X1. Z-.5 R.1 F10.\nY1.\nG80\nX2.\nM30\n",
                &[
                    "rapid",
                    "rapid X1. Y0. Z1.",
                    "rapid Z.1",
                    "feed Z-.5",
                    "feed Z.1",
                    "rapid X1. Y1. Z.1",
                    "feed Z-.5",
                    "feed Z.1",
                    "rapid X2. Y1. Z.1",
                ],
            )],
        ),
        held(
            "p. 146, 147",
            "The cycles for drilling, tapping and boring repeat by L in G91.",
            "word `L`, `[semantics.cycles] repeat`",
            &[
                reports(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG91\nG81 X1. Z-.6 R-.9 F25. L2\nG82 X1. Z-.6 R-.9 P.1 L2\nG83 X1. Z-.6 R-.9 Q.2 L2\nG73 X1. Z-.6 R-.9 Q.2 L2\nG84 X1. Z-.6 R-.9 L2\nG85 X1. Z-.6 R-.9 L2\nG86 X1. Z-.6 R-.9 L2\nG89 X1. Z-.6 R-.9 P.1 L2\nG76 X1. Z-.6 R-.9 Q.02 L2\nG80\nG90\nM30\n",
                    &[],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG91 G99 G85 X1. Y.5 Z-.6 R-.9 F10. L2\nG80\nM30\n",
                    &[
                        "rapid",
                        "rapid X1. Y.5",
                        "rapid Z.1",
                        "feed Z-.5",
                        "feed Z.1",
                        "rapid X2. Y1.",
                        "feed Z-.5",
                        "feed Z.1",
                    ],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG91 G98 G81 X1. Z-.6 R-.9 F10. L2\nG80\nM30\n",
                    &[
                        "rapid",
                        "rapid X1.",
                        "rapid Z.1",
                        "feed Z-.5",
                        "rapid Z1.",
                        "rapid X2.",
                        "rapid Z.1",
                        "feed Z-.5",
                        "rapid Z1.",
                    ],
                ),
            ],
        ),
        held(
            "p. 146",
            "G82 is G81 with a dwell of P seconds at the bottom; P may be left out.",
            "effect of `G82`; rule cycle-dwell-missing",
            &[
                run(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG82 X1. Z-.5 R.1 P.5 F10.\nG80\nM30\n",
                    &["feed 1.0000 0.0000 -0.5000", "dwell 0.500", "rapid 1.0000 0.0000 1.0000"],
                ),
                rule(
                    "info[cycle-dwell-missing]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG82 X1. Z-.5 R.1 F10.\nG80\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG82 X1. Z-.5 R.1 P.5 F10.\nG80\nM30\n",
                ),
            ],
        ),
        held(
            "p. 146",
            "G83 pecks by Q, a distance whatever the mode, and clears the hole after each peck.",
            "effect of `G83`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G83 X1. Z-.5 R.1 Q.25 F10.\nG80\nM30\n",
                    &[
                        "rapid",
                        "rapid X1. Z1.",
                        "rapid Z.1",
                        "feed Z-.15",
                        "rapid Z.1",
                        "rapid Z-.05",
                        "feed Z-.4",
                        "rapid Z.1",
                        "rapid Z-.3",
                        "feed Z-.5",
                        "rapid Z.1",
                    ],
                ),
                rule(
                    "error[number-out-of-range]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG83 X1. Z-.5 R.1 Q-.25 F10.\nG80\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG83 X1. Z-.5 R.1 Q.25 F10.\nG80\nM30\n",
                ),
            ],
        ),
        held(
            "p. 146",
            "Pecks may get smaller: I is the first, J how much less each time, K the least.",
            "effect `cycle-peck`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G83 X1. Z-.55 R.1 I.3 J.1 K.15 F10.\nG80\nM30\n",
                &[
                    "rapid",
                    "rapid X1.",
                    "rapid Z.1",
                    "feed Z-.2",
                    "rapid Z.1",
                    "rapid Z-.1",
                    "feed Z-.4",
                    "rapid Z.1",
                    "rapid Z-.3",
                    "feed Z-.55",
                    "rapid Z.1",
                ],
            )],
        ),
        held(
            "p. 146",
            "Q does not go with I, J and K in G83.",
            "`not-together` of `G83`, rule words-exclude-each-other",
            &[rule(
                "error[words-exclude-each-other]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG83 X1. Z-.5 R.1 Q.2 I.3 J.1 K.1 F10.\nG80\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG83 X1. Z-.5 R.1 I.3 J.1 K.1 F10.\nG80\nM30\n",
            )],
        ),
        held(
            "p. 146",
            "G73 pecks as G83, but backs off between pecks by the distance of setting 22 only.",
            "effect of `G73`; `[semantics.cycles] chip-break-retract`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G73 X1. Z-.5 R.1 Q.3 F10.\nG80\nM30\n",
                &["rapid", "rapid X1.", "rapid Z.1", "feed Z-.2", "rapid Z-.1", "feed Z-.5", "rapid Z.1"],
            )],
        ),
        held(
            "p. 146",
            "Setting 22 is the distance by which G73 backs off.",
            "`settings.22`, and the assumption of a program that rests on it",
            &[
                Proof::Moves {
                    program: set(
                        "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G73 X1. Z-.5 R.1 Q.3 F10.\nG80\nM30\n",
                        &["machine.units=\"inch\"", "settings.22=0.05"],
                    ),
                    are: &[
                        "rapid",
                        "rapid X1.",
                        "rapid Z.1",
                        "feed Z-.2",
                        "rapid Z-.15",
                        "feed Z-.5",
                        "rapid Z.1",
                    ],
                },
                Proof::Assumes {
                    program: mill(
                        "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G73 X1. Z-.5 R.1 Q.3 F10.\nG80\nM30\n",
                    ),
                    says: "setting 22",
                },
            ],
        ),
        held(
            "p. 146",
            "G84 taps right-hand threads, G74 left-hand threads: so the spindle turns clockwise into the hole for the one, the other way for the other, and out again in reverse.",
            "effects of `G84`, `G74`",
            &[
                run(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500\nG84 X1. Z-.5 R.1 F25.\nG80\nM30\n",
                    &[
                        "spindle clockwise",
                        "feed 1.0000 0.0000 -0.5000",
                        "spindle counter-clockwise",
                        "feed 1.0000 0.0000 0.1000",
                    ],
                ),
                run(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500\nG74 X1. Z-.5 R.1 F25.\nG80\nM30\n",
                    &[
                        "spindle counter-clockwise",
                        "feed 1.0000 0.0000 -0.5000",
                        "spindle clockwise",
                        "feed 1.0000 0.0000 0.1000",
                    ],
                ),
            ],
        ),
        held(
            "p. 147, p. 300",
            "G85 bores down and returns; its title, Bore In, Bore Out, tells that it feeds both ways.",
            "effect of `G85`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG98 G85 X1. Z-.5 R.1 F10.\nG80\nM30\n",
                &["rapid", "rapid X1.", "rapid Z.1", "feed Z-.5", "feed Z.1", "rapid Z1."],
            )],
        ),
        held(
            "p. 147",
            "G86 stops the spindle at the bottom and goes out at rapid.",
            "effect of `G86`",
            &[run(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG99 G86 X1. Z-.5 R.1 F10.\nG80\nM30\n",
                &[
                    "feed 1.0000 0.0000 -0.5000",
                    "spindle stop",
                    "rapid 1.0000 0.0000 0.1000",
                    "spindle clockwise",
                ],
            )],
        ),
        held(
            "p. 147",
            "G89 bores in, dwells, and bores out at feed.",
            "effect of `G89`",
            &[run(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G89 X1. Z-.5 R.1 P.5 F10.\nG80\nM30\n",
                &["feed 1.0000 0.0000 -0.5000", "dwell 0.500", "feed 1.0000 0.0000 0.1000"],
            )],
        ),
        held(
            "p. 147",
            "G76 bores to depth and moves off the wall before it comes out.",
            "effect of `G76`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG99 G76 X1. Z-.5 R.1 I.02 J0. F10.\nG80\nM30\n",
                &[
                    "rapid",
                    "rapid X1.",
                    "rapid Z.1",
                    "feed Z-.5",
                    "rapid X1.02 Z-.5",
                    "rapid X1.02 Z.1",
                    "rapid X1. Z.1",
                ],
            )],
        ),
        held(
            "p. 147",
            "G77 moves the tool off the wall before it goes down into the hole, then bores to depth.",
            "effect of `G77`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG98 G77 X1. Z-.5 R-1. I.02 J0. F10.\nG80\nM30\n",
                &[
                    "rapid",
                    "rapid X1. Z1.",
                    "rapid X1.02 Z1.",
                    "rapid X1.02 Z-1.",
                    "rapid X1. Z-1.",
                    "feed X1. Z-.5",
                    "rapid X1.02 Z-.5",
                    "rapid X1.02 Z1.",
                    "rapid X1. Z1.",
                ],
            )],
        ),
        held(
            "p. 147",
            "G98 goes back to where Z was before the cycle, G99 to R; they may change from hole to hole.",
            "effects of `G98`, `G99`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G81 X1. Z-.5 R.1 F10.\nG98 X2.\nG99 X3.\nG80\nM30\n",
                &[
                    "rapid",
                    "rapid X1.",
                    "rapid Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                    "rapid X2. Z.1",
                    "feed Z-.5",
                    "rapid Z1.",
                    "rapid X3. Z1.",
                    "rapid Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                ],
            )],
        ),
        held(
            "p. 147",
            "G98 and G99 are in effect as long as the cycle that they go with.",
            "effects of `G98`, `G99`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG99 G81 X1. Z-.5 R.1 F10.\nX2.\nX3.\nG80\nM30\n",
                &[
                    "rapid",
                    "rapid X1.",
                    "rapid Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                    "rapid X2. Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                    "rapid X3. Z.1",
                    "feed Z-.5",
                    "rapid Z.1",
                ],
            )],
        ),
        held(
            "p. 148",
            "The outline of G150 is a closed shape in a subprogram, and the start lies inside; otherwise alarm 370 may come.",
            "rules pocket-outline-open, pocket-start-outside",
            &[
                rule(
                    "error[pocket-outline-open]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG150 P2 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO2\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX.5\nM99\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG150 P2 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO2\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
                ),
                rule(
                    "error[pocket-start-outside]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG150 P2 G41 D1 X3. Y0. Z-.5 Q.25 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO2\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG150 P2 G41 D1 X0. Y0. Z-.5 Q.25 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO2\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
                ),
                explains("G150", "370"),
            ],
        ),
        held(
            "p. 148, 160",
            "Rotation and scaling are an option; G68 turns what follows, G69 ends it; G51 scales what follows, G50 ends it.",
            "effects of `G68`, `G69`, `G51`, `G50`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG68 X0. Y0. R90.\nX1. Y0.\nG69\nX1. Y0.\nM30\n",
                    &["rapid", "rapid X0. Y1.", "rapid X1. Y0."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG51 X0. Y0. Z0. P2.\nX1. Y.5\nG50\nX1. Y0.\nM30\n",
                    &["rapid", "rapid X2. Y1.", "rapid X1. Y0."],
                ),
                explains("G68", "needs the option: rotation and scaling"),
                explains("G51", "needs the option: rotation and scaling"),
            ],
        ),
        held(
            "p. 148",
            "Scaling is commanded before rotation.",
            "rule `scaling-under-rotation`",
            &[rule(
                "warning[scaling-under-rotation]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG68 X0. Y0. R90.\nG51 X0. Y0. P2.\nX1. Y0.\nG50\nG69\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG51 X0. Y0. P2.\nG68 X0. Y0. R90.\nX1. Y0.\nG69\nG50\nM30\n",
            )],
        ),
        held(
            "p. 148",
            "G101 mirrors the axis that its block names about the position given there; G100 ends it.",
            "effects of `G101`, `G100`; rule mirror-left-on",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG101 X0.\nX1. Y1.\nG100 X0.\nX1.\nM30\n",
                    &["rapid", "rapid X-1. Y1.", "rapid X1. Y1."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG101 Y2.\nX1. Y1.\nG100 Y0.\nY1.\nM30\n",
                    &["rapid", "rapid X1. Y3.", "rapid X1. Y1."],
                ),
                rule(
                    "warning[mirror-left-on]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG101 X0.\nX1. Y1.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG101 X0.\nX1. Y1.\nG100 X0.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 148",
            "Settings 45 to 48, 80 and 250 mirror X, Y, Z, A, B and C.",
            "Settings 45 to 47 by `transform-settings`, where they are told; those of A, B and C are not followed",
            &[Proof::Moves {
                program: set(
                    "O1\nG20 G54 G0 G90 X1. Y1. Z1.\nM30\n",
                    &["machine.units=\"inch\"", "settings.45=\"on\""],
                ),
                are: &["rapid X-1. Y1. Z1."],
            }],
        ),
        held(
            "p. 147",
            "G47 engraves text or a serial number in one block.",
            "entry and effect of `G47`",
            &[
                legal(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG47 P0 X1. Y1. J.5 R.1 Z-.01 F10. E5. (AB)\nG0 X0. Y0. Z1.\nM30\n",
                ),
                legal(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG47 P1 X1. Y1. J.5 R.1 Z-.01 F10. E5. (####)\nG0 X0. Y0. Z1.\nM30\n",
                ),
                explains("G47", "serial number"),
            ],
        ),
        held(
            "p. 163",
            "Without J the letters of G47 get a default height, without I the text is level; X, Y, R, Z and F are given.",
            "words of `G47`",
            &[
                explains("G47", "I degrees, -360 to 360 optional, else 0"),
                rule(
                    "warning[required-word-missing]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG47 X1. Y1. J.5 R.1 Z-.01 F10. (AB)\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG47 P0 X1. Y1. J.5 R.1 Z-.01 F10. (AB)\nM30\n",
                ),
            ],
        ),
        held(
            "p. 164",
            "Rigid tapping ties the feed to the spindle's speed: a tap needs F of pitch times S.",
            "rule tapping-feed-off-pitch",
            &[rule(
                "warning[tapping-feed-off-pitch]",
                "O1\n(1/4-20 TAP)\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nG43 H1 Z1.\nS500\nG84 X1. Z-.5 R.1 F20.\nG80\nM30\n",
                "O1\n(1/4-20 TAP)\nT1 M6\nG20 G54 G0 G90 X0. Y0.\nG43 H1 Z1.\nS500\nG84 X1. Z-.5 R.1 F25.\nG80\nM30\n",
            )],
        ),
        held(
            "p. 164",
            "M19 stops the spindle at an angle.",
            "effect of `M19`",
            &[
                run("O1\nS500 M3\nM19\nM30\n", &["3 spindle to 0 deg"]),
                run("O1\nM19 R45.5\nM30\n", &["2 spindle to 45.5 deg"]),
                legal("O1\nM19 P90\nM30\n"),
            ],
        ),
        held(
            "p. 164",
            "P of M19 is the angle in whole degrees.",
            "`orients-to-p` of the control",
            &[run("O1\nM19 P90\nM30\n", &["2 spindle to 90 deg"])],
        ),
        gap(
            "p. 164",
            "After M19 the spindle does not turn.",
            "warning[spindle-stopped-while-cutting] for a cut after M19 without a new M3 or M4",
            &[rule(
                "warning[spindle-stopped-while-cutting]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG1 X1. F10.\nM19\nG1 X2.\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG1 X1. F10.\nM19\nG0 X2.\nM3\nG1 X3.\nM30\n",
            )],
        ),
        held(
            "p. 164",
            "With high-speed machining contours may be fed at up to 1200 inches (30.5 m) a minute.",
            "rule feed-above-machine-limit for the limit of the machine at hand",
            &[Proof::Rule {
                finding: "warning[feed-above-machine-limit]",
                violates: set(
                    "O1\nG20 G54 G90 G1 X1. F1201.\nM30\n",
                    &["machine.units=\"inch\"", "machine.max_feed=1200"],
                ),
                conforms: set(
                    "O1\nG20 G54 G90 G1 X1. F1200.\nM30\n",
                    &["machine.units=\"inch\"", "machine.max_feed=1200"],
                ),
            }],
        ),
        not_modelled(
            "p. 170",
            "Compensation tables take small errors of the rotary axis and of X, Y and Z out of the positions.",
            "an accuracy of the machine; no program sees it",
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
