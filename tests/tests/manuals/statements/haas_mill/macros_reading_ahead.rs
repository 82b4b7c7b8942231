//! Macros: what they are for, rounding off, reading ahead, block delete: pages 190 to 195.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: buying the option,
//! display pages for variables, labels and timers, and what outlines of uses are given.

use super::mill::{explains, gap, held, legal, mill, moves, not_modelled, reports, rule, variables};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Macros: reading ahead, rounding, block delete",
    key: "MRA",
    file: "haas_mill/macros_reading_ahead.rs",
    statements: &[
        not_modelled(
            "p. 191",
            "Macros are an option.",
            "which options a machine has is not told; the entry of G65 names this one",
        ),
        held(
            "p. 192",
            "M29, M59 and M69 switch outputs, M96 P Q branches when an input is 0, M109 asks the operator.",
            "entries of these codes",
            &[
                legal("O1\nM29 P90\nM59 P90\nM69 P90\nN5 M96 P5 Q8\nM30\n"),
                rule("error[required-word-missing]", "O1\nN5 M96 P5\nM30\n", "O1\nN5 M96 P5 Q8\nM30\n"),
                rule("error[jump-target-missing]", "O1\nM96 P6 Q8\nM30\n", "O1\nM96 P6 Q8\nN6 M30\n"),
                explains("M109", "code of the key pressed arrives in `#P`"),
            ],
        ),
        held(
            "p. 192, 361",
            "M109 puts the operator's answer into the variable of P.",
            "effect `ask-operator`",
            &[
                reports(
                    "O1\n#501=0\nM109 P501 (GO ON)\nWHILE [#501 EQ 0] DO1\nEND1\nIF [#501 EQ 89] GOTO5\nG4 P1.\nN5 M30\n",
                    &[],
                ),
                super::mill::stops(
                    "O1\n#501=0\nM109 P501 (GO ON)\nIF [#501 EQ 89] GOTO5\nG4 P1.\nN5 M30\n",
                    "depends on `#501`",
                ),
            ],
        ),
        not_modelled(
            "p. 192",
            "A number in a variable may be off by a last digit, so that EQ fails; IF [ROUND[#n] EQ 7] is safe.",
            "which results are off cannot be known; EQ and NE take numbers within 1e-8 as equal, so that no difference of ours is shown as one of the control's",
        ),
        held(
            "p. 192",
            "ROUND makes a number whole before it is compared.",
            "function ROUND",
            &[moves(
                "O1\nG20 G54 G0 G90\n#10000=6.9999\nIF [ROUND[#10000] EQ 7] GOTO5\nX1.\nN5 X2.\nM30\n",
                &["rapid X2."],
            )],
        ),
        gap(
            "p. 193",
            "Outputs and variables are worked out while blocks are read, long before the machine is there; G103 P1 holds reading back.",
            "warning where an output (#12000 to #12255) is assigned after a dwell or a move without G103 P1: it is switched before them. Switched on and off about a dwell it never shows",
            &[rule(
                "warning[output-ahead-of-motion]",
                "O1\n#12012=1\nG4 P1.\n#12012=0\nM30\n",
                "O1\nG103 P1\n;\n#12012=1\nG4 P1.\n;\n;\n;\n#12012=0\nG103\nM30\n",
            )],
        ),
        held(
            "p. 193, 195",
            "G103 P says how many blocks are read ahead; without P, or with P0, there is no limit.",
            "entry of `G103`",
            &[
                legal("O1\nG103 P1\nG103\nG103 P15\nG103 P0\nM30\n"),
                rule("error[number-out-of-range]", "O1\nG103 P16\nM30\n", "O1\nG103 P15\nM30\n"),
                explains("G103", "`G103` or `G103 P0` lifts the limit"),
            ],
        ),
        not_modelled(
            "p. 231",
            "With G103 P1 the control still reads two blocks ahead.",
            "how far the machine is when a block is read is not modelled; the text of G103 tells it. Findings about reading ahead (the gaps here) ask for the limit, not for empty blocks",
        ),
        held(
            "p. 193",
            "A slash at the beginning of a block has it passed over while block delete is on.",
            "block delete: each position of the switch is a run of its own",
            &[
                moves("O1\nG20 G54 G0 G90 X0.\n/X1.\nX2.\nM30\n", &["rapid X0.", "rapid X1.", "rapid X2."]),
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0.\n/X1.\nX2.\nM30\n").skipping(),
                    are: &["rapid X0.", "rapid X2."],
                },
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0.\n/M97 P10\nX2.\nM30\nN10 X1.\nM99\n").skipping(),
                    are: &["rapid X0.", "rapid X2."],
                },
                moves(
                    "O1\nG20 G54 G0 G90 X0.\n/M97 P10\nX2.\nM30\nN10 X1.\nM99\n",
                    &["rapid X0.", "rapid X1.", "rapid X2."],
                ),
            ],
        ),
        gap(
            "p. 193",
            "What block delete changes holds with the switch on only.",
            "a mistake that only one position of the switch shows is a warning of certainty `maybe` that names the position, not an error",
            &[rule(
                "warning[maybe-feed-missing]",
                "O1\nG20 G54 G0 G90 X0.\n/G1 F5.\nG1 X1.\nM30\n",
                "O1\nG20 G54 G0 G90 X0.\nG1 F5.\n/G1 X1.\nG1 X2.\nM30\n",
            )],
        ),
        held(
            "p. 194, 199",
            "A variable of three digits and the one 10000 above are the same: #100 is #10100.",
            "`mirrored-variables`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\n#100=5.\nX#10100\n#10501=6.\nX#501\n#800=7.\nX#10800\nM30\n",
                    &["rapid X5.", "rapid X6.", "rapid X7."],
                ),
                moves("O1\nG20 G54 G0 G90\n#10100=2.\n#100=3.\nX#10100\nM30\n", &["rapid X3."]),
            ],
        ),
        held(
            "p. 194",
            "Programs use #1 to #33 and #10000 to #10999.",
            "variables 1–33, 10000–10999",
            &[
                variables([1, 33], "local variables", "read-write"),
                legal("O1\n#10000=1\n#10200=1\n#10999=1\nM30\n"),
                rule("warning[variable-unlisted]", "O1\n#34=1\nM30\n", "O1\n#33=1\nM30\n"),
            ],
        ),
        not_modelled(
            "p. 195",
            "The page of variables shows values up to 15 blocks ahead of the machine.",
            "a display; what is computed is what the blocks say",
        ),
        gap(
            "p. 218",
            "An unset variable counts as undefined or as 0, by where it is used.",
            "one reading in words and in runs, with an assumption, as no page says which is right: a run takes an unset variable in EQ 0 and NE 0 as not zero, while the label of variable-read-before-set says that it counts as zero",
            &[Proof::Says {
                program: super::mill::mill("O1\nG20 G54 G0 G90\nIF [#1 EQ 0] GOTO5\nX1.\nN5 M30\n"),
                finding: "warning[variable-read-before-set]",
                words: "is not zero",
            }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
