//! G93 to G95 (p. 303), G103 (p. 307), G187 and G188 (p. 334, 335): the sentences of these pages and what proves them.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Legal, Makes, Rule};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: feed modes, look-ahead, accuracy, pallets",
    key: "FED",
    file: "haas_mill/g_feed_and_accuracy.rs",
    statements: &[
        held(
            "p. 303",
            "Under G93 F is how often a minute the move could be made: it takes 60/F seconds.",
            "effect `feed-inverse-time`",
            &[
                Makes {
                    program: cut!("G93 G1 X1. F60.\nX3. F30.\nG94 F10.\n"),
                    block: "G93 G1 X1. F60.",
                    events: &["feed X1 T1"],
                },
                Makes {
                    program: cut!("G93 G1 X1. F60.\nX3. F30.\nG94 F10.\n"),
                    block: "X3. F30.",
                    events: &["feed X3 T2"],
                },
            ],
        ),
        gap(
            "p. 303",
            "The time of a block under G93 does not depend on its axes: a turn of A takes 60/F seconds as well.",
            "a move with a rotary axis whose start is known or not takes 60/F: the time is known; at present it is not counted where the rotary start is unknown",
            &[Makes {
                program: cut!("G93 G1 X1. A10. F60.\nG94 F10.\n"),
                block: "G93 G1 X1. A10. F60.",
                events: &["feed X1 A10 F60 T1"],
            }],
        ),
        held(
            "p. 303",
            "Under G93 every block that is no rapid has its own F.",
            "rule `inverse-time-feed-missing`",
            &[
                Rule {
                    finding: "error[inverse-time-feed-missing]",
                    violates: cut!("G93 G1 X1. F60.\nX2.\nG94 F10.\n"),
                    conforms: cut!("G93 G1 X1. F60.\nX2. F60.\nG94 F10.\n"),
                },
                Rule {
                    finding: "error[inverse-time-feed-missing]",
                    violates: cut!("G93 G1 X1. F60.\nG2 X2. Y1. R1.\nG94 F10.\n"),
                    conforms: cut!("G93 G1 X1. F60.\nG2 X2. Y1. R1. F9.\nG94 F10.\n"),
                },
                Legal { program: cut!("G93 G0 X1.\nX2.\nG94 F10.\n") },
            ],
        ),
        held(
            "p. 303",
            "G94 ends G93 and counts feed per minute again.",
            "rule `feed-of-another-mode`",
            &[
                Makes {
                    program: cut!("G93 G1 X1. F60.\nG94 X2. F10.\n"),
                    block: "G94 X2. F10.",
                    events: &["feed X2 F10 T6"],
                },
                Rule {
                    finding: "warning[feed-of-another-mode]",
                    violates: cut!("G93 G1 X1. F60.\nG94\nX2.\n"),
                    conforms: cut!("G93 G1 X1. F60.\nG94 F10.\nX2.\n"),
                },
            ],
        ),
        not_modelled("p. 303", "RESET ends G93.", "keys of the operator are not part of a program"),
        held(
            "p. 303",
            "Under G95 F is the way of one turn of the spindle, in inch or millimetre.",
            "effect `feed-per-revolution`",
            &[
                Makes {
                    program: cut!("G95 G1 X1. F.01\nG94 F10.\n"),
                    block: "G95 G1 X1. F.01",
                    events: &["feed X1 F0.01 T6"],
                },
                Makes {
                    program: mill("O1 (A)\nG21 G90 G54 G0 X0.\nS500 M3\nG95 G1 X10. F.2\nM30\n"),
                    block: "G95 G1 X10. F.2",
                    events: &["feed X10 F0.2 T6"],
                },
            ],
        ),
        held(
            "p. 303",
            "A feed of one mode is not one of another.",
            "rules `feed-of-another-mode`, `feed-implausible`",
            &[
                Rule {
                    finding: "warning[feed-of-another-mode]",
                    violates: cut!("G95 G1 X1. F.01\nG94 X2.\n"),
                    conforms: cut!("G95 G1 X1. F.01\nG94 X2. F10.\n"),
                },
                Rule {
                    finding: "warning[feed-implausible]",
                    violates: cut!("G95 G1 X1. F10.\nG94 F10.\n"),
                    conforms: cut!("G95 G1 X1. F.01\nG94 F10.\n"),
                },
            ],
        ),
        held(
            "p. 303",
            "Under G95 nothing feeds while the spindle is stopped.",
            "rule `spindle-stopped-while-cutting`",
            &[Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: mill("O1 (A)\nG20 G90 G54 G0 X0.\nG95 G1 X1. F.01\nG94 F10.\nM30\n"),
                conforms: mill("O1 (A)\nG20 G90 G54 G0 X0.\nS500 M3\nG95 G1 X1. F.01\nG94 F10.\nM5\nM30\n"),
            }],
        ),
        gap(
            "p. 303, p. 379, p. 385",
            "Feeds are inches or millimetres a minute; for a rotary axis Settings 34 and 79 give the diameter that makes degrees of them.",
            "Setting 34 = 2 inch: 90 degrees of A are 1.5708 inch of its surface, 9.42 s at F10",
            &[Makes {
                program: cut!("G0 A0.\nG1 A90. F10.\n").with(&["settings.34=2.0"]),
                block: "G1 A90. F10.",
                events: &["feed A90 F10 T9.4248"],
            }],
        ),
        held(
            "p. 307",
            "P of G103, the blocks that are read ahead, is 0 to 15.",
            "range of `P`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G103 P16\nG0 X1.\nG103\n"),
                conforms: cut!("G103 P15\nG0 X1.\nG103\n"),
            }],
        ),
        held(
            "p. 307",
            "G103 alone and G103 P0 end the limit; the code moves nothing.",
            "no effect of `G103`",
            &[
                Legal { program: cut!("G103 P1\n\n\n#100=#5041\nG0 X1.\nG103\n") },
                Legal { program: cut!("G103 P1\nG0 X1.\nG103 P0\n") },
                Makes { program: cut!("G103 P1\nG0 X1.\nG103\n"), block: "G103 P1", events: &[] },
            ],
        ),
        not_modelled(
            "p. 307",
            "G103 P1 keeps macro expressions from being read before they are reached; empty lines after it help; it affects cutter compensation.",
            "when the control evaluates a block shows only in what the operator or a signal changes meanwhile; gcheck evaluates in order",
        ),
        held(
            "p. 334",
            "P of G187 is 1 to 3: rough, medium, finish.",
            "range of `P`",
            &[
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G187 P4\nG1 X1. F10.\nG187\n"),
                    conforms: cut!("G187 P3\nG1 X1. F10.\nG187\n"),
                },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G187 P0\nG1 X1. F10.\nG187\n"),
                    conforms: cut!("G187 P1\nG1 X1. F10.\nG187\n"),
                },
            ],
        ),
        held(
            "p. 334, p. 335",
            "P and E may stand alone or together; G187 alone goes back to the settings.",
            "words of `G187`",
            &[Legal { program: cut!("G187 P1\nG187 E.01\nG187 P1 E.01\nG1 X1. F10.\nG187\n") }],
        ),
        not_modelled(
            "p. 334, p. 335, p. 387",
            "E of G187 and Setting 85 round corners, P and Setting 191 smooth the path; RESET, M30 and M02 end G187.",
            "how far a servo rounds a corner is within a tolerance that gcheck does not draw; paths meet in their programmed points",
        ),
        held(
            "p. 335",
            "G188 calls the program of the loaded pallet.",
            "effect `user-command`",
            &[Legal { program: cut!("G188\n") }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
