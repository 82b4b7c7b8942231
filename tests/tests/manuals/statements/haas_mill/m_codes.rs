//! Chapter 8 (p. 345 to 364): its sentences and what proves them. M75, M78 and M79 stand with probing.
//!
//! Left out: wiring and pins of relays, keys, cautions about coolant and maintenance codes beyond their words.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Legal, Makes, Rule, Run, Same, Silent};
use crate::statements::statement::{Chapter, prove};

/// Blocks after the start of the first tool.
macro_rules! first_tool {
    ($blocks:literal) => {
        mill(concat!(
            "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0. S1000 M3\nG43 H1 Z.1 M8\n",
            $blocks,
            "G0 Z1. M9\nM5\nG28 G91 Z0.\nG90\nM30\n%\n"
        ))
    };
}

/// A short program.
macro_rules! short {
    ($blocks:literal) => {
        mill(concat!("O1 (A)\nG20 G90 G54 G0 X0.\n", $blocks, ""))
    };
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "M codes",
    key: "M",
    file: "haas_mill/m_codes.rs",
    statements: &[
        held(
            "p. 345, p. 349",
            "M codes move no axis, but M06 moves Z to where tools are changed.",
            "effects of M codes",
            &[
                Makes { program: cut!("M8\nG0 X1.\n"), block: "M8", events: &["coolant flood-on"] },
                Makes { program: cut!("M5\nG0 X1.\n"), block: "M5", events: &["spindle stop"] },
            ],
        ),
        held(
            "p. 345",
            "One M code a block.",
            "rule `too-many-m-codes`",
            &[Rule {
                finding: "error[too-many-m-codes]",
                violates: cut!("M3 M8\n"),
                conforms: cut!("M3\nM8\n"),
            }],
        ),
        held(
            "p. 345",
            "M codes act at the end of their block.",
            "`phases`",
            &[
                Makes {
                    program: cut!("M8 G0 X1.\n"),
                    block: "M8 G0 X1.",
                    events: &["rapid X1", "coolant flood-on"],
                },
                Makes {
                    program: cut!("G1 X1. F10. M9\n"),
                    block: "G1 X1. F10. M9",
                    events: &["feed X1", "coolant mist-off", "coolant flood-off"],
                },
            ],
        ),
        held(
            "p. 348",
            "M03 is the exception seen in every program: the spindle turns for the move of its block.",
            "`phases`",
            &[Makes {
                program: cut!("M5\nG1 X1. F10. M3\n"),
                block: "G1 X1. F10. M3",
                events: &["spindle clockwise", "feed X1"],
            }],
        ),
        held(
            "p. 348",
            "M00 stops the program; it goes on with the next block.",
            "effect `stop`",
            &[
                Makes {
                    program: cut!("M0\nG1 X1. F10.\n"),
                    block: "M0",
                    events: &["spindle stop", "coolant flood-off", "stop program"],
                },
                Legal { program: first_tool!("M0\nS1000 M3\nM8\nG1 Z-1. F10.\n") },
            ],
        ),
        held(
            "p. 348",
            "M00 stops the spindle and the coolant.",
            "rule `spindle-stopped-while-cutting`",
            &[
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: first_tool!("M0\nG1 Z-1. F10.\n"),
                    conforms: first_tool!("M0\nS1000 M3\nG1 Z-1. F10.\n"),
                },
                Makes {
                    program: cut!("M0\nS1000 M3\n"),
                    block: "M0",
                    events: &["spindle stop", "coolant flood-off", "stop program"],
                },
            ],
        ),
        held(
            "p. 348",
            "M01 stops like M00 where the operator has switched optional stop on.",
            "effect `optional-stop`",
            &[Legal { program: first_tool!("M1\nS1000 M3\nM8\nG1 Z-1. F10.\n") }],
        ),
        held(
            "p. 348",
            "So with M01 in that case.",
            "rule `maybe-spindle-stopped-while-cutting`",
            &[Rule {
                finding: "warning[maybe-spindle-stopped-while-cutting]",
                violates: first_tool!("M1\nG1 Z-1. F10.\n"),
                conforms: first_tool!("M1\nS1000 M3\nG1 Z-1. F10.\n"),
            }],
        ),
        held(
            "p. 348",
            "M02 ends the program.",
            "effect `program-end`",
            &[
                Rule {
                    finding: "warning[unreachable-block]",
                    violates: short!("M2\nX1.\n"),
                    conforms: short!("X1.\nM2\n"),
                },
                Makes { program: short!("M2\n"), block: "M2", events: &["spindle stop", "end"] },
            ],
        ),
        held(
            "p. 348",
            "M03 turns the spindle clockwise, M04 counter-clockwise, M05 stops it.",
            "effects `spindle-clockwise`, `spindle-counter-clockwise`, `spindle-stop`",
            &[
                Makes { program: cut!("M3\n"), block: "M3", events: &["spindle clockwise"] },
                Makes { program: cut!("M4\n"), block: "M4", events: &["spindle counter-clockwise"] },
                Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: cut!("M5\nG1 X1. F10.\n"),
                    conforms: cut!("M4\nG1 X1. F10.\n"),
                },
            ],
        ),
        held(
            "p. 348",
            "S gives the speed in turns a minute.",
            "effect of `S`",
            &[
                Makes { program: cut!("S5000\n"), block: "S5000", events: &["spindle 5000"] },
                Rule {
                    finding: "warning[speed-above-machine-limit]",
                    violates: cut!("S5000\n").with(&["machine.max_rpm=4000"]),
                    conforms: cut!("S3000\n").with(&["machine.max_rpm=4000"]),
                },
            ],
        ),
        held(
            "p. 348",
            "A spindle that no code starts does not turn.",
            "rule `spindle-stopped-while-cutting`",
            &[Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: mill(
                    "%\nO1 (A)\nG20 G17 G40 G49 G80 G90\nG0 G54 X0. Y0.\nG43 H1 Z.1\nG1 Z-1. F10.\nG0 Z1.\nG28 G91 Z0.\nG90\nM30\n%\n",
                ),
                conforms: first_tool!("G1 Z-1. F10.\n"),
            }],
        ),
        held(
            "p. 349",
            "M06 puts tool T in the spindle; T may stand in its block.",
            "effect `tool-change`",
            &[
                Makes {
                    program: short!("M6 T12\nM30\n"),
                    block: "M6 T12",
                    events: &["spindle stop", "tool 12"],
                },
                Rule {
                    finding: "warning[tool-change-without-t]",
                    violates: short!("M6\nM30\n"),
                    conforms: short!("M6 T12\nM30\n"),
                },
            ],
        ),
        held(
            "p. 349",
            "T before or after M06 calls a tool ahead: the next M06 changes to it.",
            "effect `tool-change`",
            &[
                Makes {
                    program: short!("T12\nM6\nT3\nM30\n"),
                    block: "M6",
                    events: &["spindle stop", "tool 12"],
                },
                Makes {
                    program: short!("M6 T1\nT2\nX1.\nM6\nM30\n"),
                    block: "M6",
                    events: &["spindle stop", "tool 2"],
                },
            ],
        ),
        held(
            "p. 349",
            "M06 stops the spindle.",
            "`change-stops-spindle`",
            &[Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: first_tool!("T2 M6\nG43 H2 Z.1\nG1 Z-1. F10.\n"),
                conforms: first_tool!("T2 M6\nG43 H2 Z.1\nS500 M3\nG1 Z-1. F10.\n"),
            }],
        ),
        held(
            "p. 349",
            "M06 stops the coolant, through the spindle too.",
            "`change-stops-coolant`",
            &[Makes {
                program: first_tool!("T2 M6\nG43 H2 Z.1\nS500 M3\nG1 Z-1. F10.\n"),
                block: "T2 M6",
                events: &["spindle stop", "coolant flood-off", "tool 2"],
            }],
        ),
        held(
            "p. 349",
            "Shower coolant (M07) starts again after a tool change.",
            "`change-stops-coolant`",
            &[Makes {
                program: first_tool!("M7\nT2 M6\nG43 H2 Z.1\n"),
                block: "T2 M6",
                events: &[
                    "spindle stop",
                    "coolant mist-off",
                    "coolant flood-off",
                    "tool 2",
                    "coolant mist-on",
                ],
            }],
        ),
        held(
            "p. 349",
            "M06 moves Z to the tool change position itself: after it Z is not where the last tool was.",
            "effect `tool-change`",
            &[Run {
                program: first_tool!("T2 M6\nX5.\nG43 H2 Z.1\n"),
                prints: &["tool", "T2", "rapid 5.0000 0.0000 ?"],
            }],
        ),
        not_modelled(
            "p. 349, p. 396, p. 406",
            "Settings 247 and 293 to 298 shape the way to the tool change position.",
            "the way of a tool change is the machine's",
        ),
        held(
            "p. 349",
            "M07 starts shower coolant; M09 stops it and the flood.",
            "effects `mist-on`, `coolant-off`",
            &[
                Makes { program: cut!("M7\nM9\n"), block: "M7", events: &["coolant mist-on"] },
                Makes {
                    program: cut!("M7\nM9\n"),
                    block: "M9",
                    events: &["coolant mist-off", "coolant flood-off"],
                },
            ],
        ),
        held(
            "p. 350",
            "M08 starts the coolant, M09 stops it.",
            "effects `flood-on`, `coolant-off`",
            &[
                Makes { program: cut!("M8\nM9\n"), block: "M8", events: &["coolant flood-on"] },
                Makes {
                    program: cut!("M8\nM9\n"),
                    block: "M9",
                    events: &["coolant mist-off", "coolant flood-off"],
                },
            ],
        ),
        held(
            "p. 350",
            "M10 and M11 hold and free the 4th axis, M12 and M13 the 5th.",
            "words of the codes",
            &[Legal { program: cut!("M11\nG0 A90.\nM10\nM13\nG0 B9.\nM12\n") }],
        ),
        gap(
            "p. 350",
            "The brakes are on until M11 or M13 frees them: a rotary cut under M10 or M12.",
            "a feed of the braked axis after M10 or M12 in the program: info (positioning frees the brake by itself on most machines)",
            &[Rule {
                finding: "info[rotary-feed-against-brake]",
                violates: cut!("M10\nG0 A0.\nG1 A90. F10.\n"),
                conforms: cut!("M11\nG0 A0.\nG1 A90. F10.\nM10\n"),
            }],
        ),
        held(
            "p. 350",
            "M16 is M06.",
            "effect `tool-change`",
            &[Same {
                one: short!("M16 T12\nG43 H12 Z1.\nM30\n"),
                other: short!("M6 T12\nG43 H12 Z1.\nM30\n"),
            }],
        ),
        held(
            "p. 350",
            "M19 turns the spindle to an angle: P in degrees, R with two places.",
            "effect `spindle-orient`",
            &[
                Legal { program: cut!("M19 P270\nM3\n") },
                Legal { program: cut!("M19 R123.45\nM3\n") },
                Run { program: cut!("M19 R123.45\nM3\n"), prints: &["to 123.45 deg"] },
            ],
        ),
        held(
            "p. 350",
            "P of M19 is written with its point: P270.",
            "type of `P`",
            &[Legal { program: cut!("M19 P270.\nM3\n") }, Legal { program: cut!("M19 P270\nM3\n") }],
        ),
        held(
            "p. 350",
            "P of M19 is the angle.",
            "`orients-to-p` of the control",
            &[
                Run { program: cut!("M19 P270.\nM3\n"), prints: &["to 270 deg"] },
                Run { program: cut!("M19 P270\nM3\n"), prints: &["to 270 deg"] },
            ],
        ),
        held(
            "p. 350",
            "P and R of M19 are 0 to 360.",
            "ranges of words",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("M19 P361\nM3\n"),
                    conforms: cut!("M19 P360\nM3\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("M19 R361.\nM3\n"),
                    conforms: cut!("M19 R360.\nM3\n"),
                },
            ],
        ),
        held(
            "p. 350",
            "M19 leaves the spindle standing.",
            "rule `spindle-stopped-while-cutting`: an info, as a tool that is held may broach",
            &[Rule {
                finding: "info[spindle-stopped-while-cutting]",
                violates: cut!("M19\nG1 X1. F10.\n"),
                conforms: cut!("M19\nM3\nG1 X1. F10.\n"),
            }],
        ),
        held(
            "p. 351",
            "M21 to M25 switch a relay and wait for its answer.",
            "codes of the control",
            &[Legal { program: cut!("M21\nM22\nM23\nM24\nM25\n") }],
        ),
        held(
            "p. 352",
            "M29 P switches an output and waits: P is required, 0 to 255.",
            "range of `P`",
            &[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("M29\n"),
                    conforms: cut!("M29 P90\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("M29 P256\n"),
                    conforms: cut!("M29 P255\n"),
                },
            ],
        ),
        held(
            "p. 352",
            "M30 ends the program, stops the spindle and turns off the coolant.",
            "effect `program-end`",
            &[
                Makes {
                    program: short!("S100 M3\nM8\nM30\n"),
                    block: "M30",
                    events: &["spindle stop", "coolant flood-off", "end"],
                },
                Rule {
                    finding: "warning[unreachable-block]",
                    violates: short!("M30\nX1.\n"),
                    conforms: short!("X1.\nM30\n"),
                },
            ],
        ),
        held(
            "p. 352",
            "M30 turns off coolant through the spindle as well.",
            "codes that the end brings back",
            &[Makes {
                program: short!("M88\nS100 M3\nM30\n"),
                block: "M30",
                events: &["spindle stop", "coolant through-off", "end"],
            }],
        ),
        not_modelled(
            "p. 276, p. 352",
            "M30 cancels the tool length, but no longer from software 100.16.000.1041 on.",
            "a program that begins with G43 does not depend on it; `tool-length-missing` speaks of one that does not",
        ),
        held(
            "p. 353",
            "M31 and M33 start and stop the chip conveyor, M34 and M35 move the coolant spigot.",
            "codes of the control",
            &[Legal { program: cut!("M31\nM34\nM35\nM33\n") }],
        ),
        held(
            "p. 353",
            "M36 makes the part ready for a pallet change, M50 changes it.",
            "codes of the control",
            &[Legal { program: short!("M36\nM1\nM50\nG0 X1.\nM30\n") }],
        ),
        held(
            "p. 354",
            "M39 turns the tool changer to the pocket T without a tool change.",
            "no effect of `M39`",
            &[Makes { program: cut!("T3\nM39\n"), block: "M39", events: &[] }],
        ),
        held(
            "p. 354",
            "The T of M39 is a pocket, not a tool that is called.",
            "effect `turn-carousel`",
            &[Silent { rule: "tool-called-not-changed", program: cut!("M39 T3\n") }],
        ),
        held(
            "p. 354",
            "M41 and M42 hold the low and the high gear; with S before M03.",
            "codes of the control",
            &[Legal { program: cut!("S1200 M41\nM3\n") }, Legal { program: cut!("S1200 M42\nM3\n") }],
        ),
        held(
            "p. 354, p. 355",
            "M51 to M55 switch relays on, M61 to M65 off.",
            "codes of the control",
            &[Legal { program: cut!("M51\nM61\nM55\nM65\n") }],
        ),
        held(
            "p. 354",
            "M59 P switches an output on, M69 P off; P is required.",
            "effects `output-on`, `output-off`",
            &[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("M59\n"),
                    conforms: cut!("M59 P12003\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: cut!("M69\n"),
                    conforms: cut!("M69 P12003\n"),
                },
            ],
        ),
        held(
            "p. 354, p. 355",
            "P goes up to 12255.",
            "range of `P`",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("M59 P12256\n"),
                    conforms: cut!("M59 P12255\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("M69 P12256\n"),
                    conforms: cut!("M69 P12255\n"),
                },
            ],
        ),
        not_modelled(
            "p. 354, p. 355",
            "P is 0 to 255 or 12000 to 12255.",
            "the manual itself uses P1133 and P1134 for its probe: numbers between the ranges cannot be refused",
        ),
        held(
            "p. 354",
            "#12003=1 does what M59 P12003 does.",
            "common variables",
            &[Legal { program: cut!("#12003=1\n#12003=0\n") }],
        ),
        held(
            "p. 355",
            "M73 and M74 switch the air blast on and off.",
            "codes of the control",
            &[Legal { program: cut!("M73\nM74\n") }],
        ),
        held(
            "p. 356",
            "M80 and M81 open and close the door; M83 and M84 switch the air gun or the mist; M82 and M86 free and clamp the tool.",
            "codes of the control",
            &[
                Legal { program: cut!("M80\nM81\nM83 P500\nM84\nM83\nM84\n") },
                Legal { program: short!("M82\nM86\nM30\n") },
            ],
        ),
        held(
            "p. 356",
            "M88 and M89 switch coolant through the spindle on and off.",
            "effects `through-coolant-on`, `through-coolant-off`",
            &[
                Makes { program: cut!("M88\nM3\nM89\n"), block: "M88", events: &["coolant through-on"] },
                Makes {
                    program: cut!("M88\nM3\nM89\n"),
                    block: "M89",
                    events: &["spindle stop", "coolant through-off"],
                },
            ],
        ),
        held(
            "p. 356",
            "M89 stops the spindle and does not start it again.",
            "`through-off-stops-spindle`",
            &[Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: cut!("M88\nS1000 M3\nG1 X1. F10.\nM89\nX2.\n"),
                conforms: cut!("M88\nS1000 M3\nG1 X1. F10.\nM89\nS1000 M3\nX2.\n"),
            }],
        ),
        held(
            "p. 357",
            "M88 before the speed saves a stop: with a spindle that turns it stops, and starts again.",
            "effect `through-coolant-on`",
            &[Legal { program: cut!("S1000 M3\nM88\nG1 X1. F10.\nM89\nM3\n") }],
        ),
        held(
            "p. 357",
            "M95 sleeps for the hours and minutes of its comment.",
            "words of `M95`",
            &[Legal { program: short!("M95 (12:30)\nX1.\nM30\n") }],
        ),
        held(
            "p. 357",
            "The comment (hh:mm) must follow M95.",
            "`reads-comment` of `M95`",
            &[
                Rule {
                    finding: "warning[comment-missing]",
                    violates: short!("M95\nX1.\nM30\n"),
                    conforms: short!("M95 (12:30)\nX1.\nM30\n"),
                },
                Rule {
                    finding: "warning[comment-missing]",
                    violates: short!("M95 (SLEEP)\nX1.\nM30\n"),
                    conforms: short!("M95 (00:01)\nX1.\nM30\n"),
                },
            ],
        ),
        held(
            "p. 357",
            "M96 jumps to N P of the same program when input Q is off.",
            "effect `jump-unless-input`",
            &[
                Legal {
                    program: short!("N5 M96 P10 Q18\nX1.\nM99 P100\nN10 G4 P1.\nM99 P5\nN100 X2.\nM30\n"),
                },
                Rule {
                    finding: "error[jump-target-missing]",
                    violates: short!("M96 P11 Q5\nN10\nM30\n"),
                    conforms: short!("M96 P10 Q5\nN10\nM30\n"),
                },
            ],
        ),
        held(
            "p. 357",
            "Q of M96 is 0 to 255; P and Q are required.",
            "range and needs of words",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M96 P10 Q256\nN10\nM30\n"),
                    conforms: short!("M96 P10 Q255\nN10\nM30\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: short!("M96 P10\nN10\nM30\n"),
                    conforms: short!("M96 P10 Q5\nN10\nM30\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: short!("M96 Q5\nN10\nM30\n"),
                    conforms: short!("M96 P10 Q5\nN10\nM30\n"),
                },
            ],
        ),
        held(
            "p. 358",
            "M97 P calls the blocks from N P of the same program, to M99.",
            "effect `call-local`",
            &[
                Run {
                    program: short!("M97 P100\nX9.\nM30\nN100 X1.\nM99\n"),
                    prints: &["rapid 1.0000", "rapid 9.0000"],
                },
                Rule {
                    finding: "error[jump-target-missing]",
                    violates: short!("M97 P100\nM30\nN200 X1.\nM99\n"),
                    conforms: short!("M97 P100\nM30\nN100 X1.\nM99\n"),
                },
                Rule {
                    finding: "error[required-word-missing]",
                    violates: short!("M97 L4\nM30\nN100 X1.\nM99\n"),
                    conforms: short!("M97 P100\nM30\nN100 X1.\nM99\n"),
                },
            ],
        ),
        held(
            "p. 358",
            "L repeats the call 1 to 99 times.",
            "range of `L`",
            &[
                Run {
                    program: short!("M97 P100 L4\nM30\nN100 G91 X1.\nG90\nM99\n"),
                    prints: &["rapid 1.0000", "rapid 2.0000", "rapid 3.0000", "rapid 4.0000", "end"],
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M97 P100 L100\nM30\nN100 X1.\nM99\n"),
                    conforms: short!("M97 P100 L99\nM30\nN100 X1.\nM99\n"),
                },
            ],
        ),
        held(
            "p. 358",
            "The subprogram ends with M99.",
            "rule `subprogram-without-return`",
            &[Rule {
                finding: "error[subprogram-without-return]",
                violates: short!("M97 P100\nM30\nN100 X1.\n"),
                conforms: short!("M97 P100\nM30\nN100 X1.\nM99\n"),
            }],
        ),
        held(
            "p. 358",
            "A local subprogram stands after M30.",
            "rule `fall-into-subprogram`",
            &[Rule {
                finding: "warning[fall-into-subprogram]",
                violates: short!("M97 P100\nX3.\nN100 X1.\nM99\n"),
                conforms: short!("M97 P100\nX3.\nM30\nN100 X1.\nM99\n"),
            }],
        ),
        held(
            "p. 359",
            "M98 P calls program P, L times (1 to 99).",
            "effect `call-program`",
            &[
                Run {
                    program: short!("M98 P100 L3\nM30\nO100\nG91 X1.\nG90\nM99\n"),
                    prints: &["rapid 1.0000", "rapid 2.0000", "rapid 3.0000", "end"],
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M98 P100 L100\nM30\nO100\nX1.\nM99\n"),
                    conforms: short!("M98 P100 L9\nM30\nO100\nX1.\nM99\n"),
                },
            ],
        ),
        held(
            "p. 359",
            "A called program contains M99.",
            "rule `subprogram-without-return`",
            &[Rule {
                finding: "warning[subprogram-without-return]",
                violates: short!("M98 P100\nM30\nO100\nX1.\nM30\n"),
                conforms: short!("M98 P100\nM30\nO100\nX1.\nM99\n"),
            }],
        ),
        held(
            "p. 359, p. 396",
            "The control looks in the main program's folder, then where Setting 251 says; an alarm where nothing is found.",
            "rule `subprogram-missing`",
            &[Rule {
                finding: "warning[subprogram-missing]",
                violates: short!("M98 P777\nM30\n"),
                conforms: short!("M98 P777\nM30\nO777\nX1.\nM99\n"),
            }],
        ),
        held(
            "p. 359",
            "M98 may name the program by a path in parentheses.",
            "word `P` of `M98`",
            &[Legal { program: short!("M98 (USB0/O00001.nc) L4\nM30\n") }],
        ),
        gap(
            "p. 359",
            "What a path names is called like a number.",
            "M98 with a path: the file is looked for in the search folders, and one that is not found is reported as `subprogram-missing` (warning); `run` goes on after it as after an unknown program. At present the run ends there",
            &[
                Rule {
                    finding: "warning[subprogram-missing]",
                    violates: short!("M98 (USB0/O00001.nc)\nX1.\nM30\n"),
                    conforms: short!("M98 P777\nX1.\nM30\nO777\nM99\n"),
                },
                Run { program: short!("M98 (USB0/O00001.nc)\nX1.\nM30\n"), prints: &["rapid 1.0000", "end"] },
            ],
        ),
        held(
            "p. 359",
            "M98 needs P or a path.",
            "rule `required-word-missing`",
            &[Rule {
                finding: "error[required-word-missing]",
                violates: short!("M98\nM30\n"),
                conforms: short!("M98 P777\nM30\nO777\nM99\n"),
            }],
        ),
        held(
            "p. 360",
            "M99 in a subprogram goes back to the program that called it.",
            "effect `return`",
            &[Run {
                program: short!("M98 P2\nX9.\nM30\nO2\nX5.\nM99\n"),
                prints: &["rapid 5.0000", "rapid 9.0000"],
            }],
        ),
        held(
            "p. 360",
            "M99 P jumps to N P of the program.",
            "effect `return`",
            &[
                Run { program: short!("M99 P100\nX1.\nN100 X2.\nM30\n"), prints: &["5 rapid 2.0000"] },
                Rule {
                    finding: "error[jump-target-missing]",
                    violates: short!("M99 P300\nX1.\nN100 X2.\nM30\n"),
                    conforms: short!("M99 P100\nX1.\nN100 X2.\nM30\n"),
                },
            ],
        ),
        held(
            "p. 360",
            "M99 in the main program begins it again.",
            "effect `return`",
            &[Legal { program: short!("X1.\nM99\n") }],
        ),
        held(
            "p. 361",
            "P of M109 is required: 500 to 549 or 10500 to 10549.",
            "range of `P`",
            &[
                Rule {
                    finding: "error[required-word-missing]",
                    violates: short!("M109\nM30\n"),
                    conforms: short!("M109 P501\nM30\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M109 P499\nM30\n"),
                    conforms: short!("M109 P500\nM30\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M109 P10550\nM30\n"),
                    conforms: short!("M109 P10549\nM30\n"),
                },
            ],
        ),
        held(
            "p. 361",
            "Numbers between the two ranges are no variables of M109.",
            "`gaps` of `P`",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M109 P550\nM30\n"),
                    conforms: short!("M109 P549\nM30\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M109 P10499\nM30\n"),
                    conforms: short!("M109 P10500\nM30\n"),
                },
            ],
        ),
        held(
            "p. 361",
            "The operator's answer comes into the variable while the program waits in a loop.",
            "effect `ask-operator`",
            &[
                Silent {
                    rule: "endless-loop",
                    program: short!(
                        "N1 #10501=0.\nN5 M109 P10501 (GO ON?)\nIF [#10501 EQ 0.] GOTO5\nIF [#10501 EQ 89.] GOTO10\nGOTO1\nN10 X1.\nM30\n"
                    ),
                },
                Silent {
                    rule: "endless-loop",
                    program: short!("N1 #10501=0\nN5 M109 P501 (1,2,3)\nIF [#10501 EQ 0] GOTO5\nX1.\nM30\n"),
                },
                Silent {
                    rule: "unreachable-block",
                    program: short!(
                        "N1 #10501=0.\nN5 M109 P10501 (GO ON?)\nIF [#10501 EQ 0.] GOTO5\nIF [#10501 EQ 89.] GOTO10\nGOTO1\nN10 X1.\nM30\n"
                    ),
                },
            ],
        ),
        held(
            "p. 362",
            "M130 shows the file in its comment, M131 clears it.",
            "codes of the control",
            &[Legal { program: short!("M130 (PART.PNG)\nX1.\nM131\nM30\n") }],
        ),
        held(
            "p. 363",
            "M130 names a file: MP4, MOV, PNG or JPEG.",
            "`reads-comment` of `M130`",
            &[Rule {
                finding: "info[comment-missing]",
                violates: short!("M130\nX1.\nM131\nM30\n"),
                conforms: short!("M130 (PART.PNG)\nX1.\nM131\nM30\n"),
            }],
        ),
        held(
            "p. 364",
            "M138 varies the spindle speed by P turns in a cycle of E seconds, or by Settings 165 and 166; M139 ends it.",
            "words of `M138`",
            &[Legal {
                program: short!(
                    "S1000 M3\nM138 P500 E1.5\nM139\nM138 P500\nM139\nM138 E1.5\nM139\nM5\nM30\n"
                ),
            }],
        ),
        held(
            "p. 364, p. 393, p. 394",
            "Both are positive.",
            "ranges of words",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M138 P-5\nM139\nM30\n"),
                    conforms: short!("M138 P5\nM139\nM30\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: short!("M138 E-1.\nM139\nM30\n"),
                    conforms: short!("M138 E1.\nM139\nM30\n"),
                },
            ],
        ),
        held(
            "p. 364",
            "M138 stays on until M139 or M30, whatever the spindle does.",
            "no effect of `M138`",
            &[Legal { program: short!("M138 P500 E1.5\nS1000 M3\nG1 X1. F10.\nM5\nM139\nM30\n") }],
        ),
        held(
            "p. 358, p. 362",
            "#3000 raises an alarm, #3006 stops with a message.",
            "`system-variables`",
            &[
                Rule {
                    finding: "error[alarm-reached]",
                    violates: short!("#3000=10(NO SIGNAL)\nM30\n"),
                    conforms: short!("#3006=10(TURN PART)\nM30\n"),
                },
                Run {
                    program: short!("#3006=25(TURN PART)\nX1.\nM30\n"),
                    prints: &["TURN PART", "rapid 1.0000"],
                },
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
