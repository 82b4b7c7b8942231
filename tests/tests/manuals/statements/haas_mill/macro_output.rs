//! DPRNT: pages 230 and 231.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: how DPRNT is edited
//! at the control.

use super::mill::{gap, held, legal, not_modelled, rule, run};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Macros: DPRNT",
    key: "DPR",
    file: "haas_mill/macro_output.rs",
    statements: &[
        held(
            "p. 230",
            "DPRNT prints text and variables; an asterisk prints as a blank.",
            "statement DPRNT",
            &[
                run("O1\n#1=1.5\nDPRNT[X#1[21]]\nM30\n", &["3 message X1.5"]),
                run("O1\nDPRNT[A*B+1/2]\nM30\n", &["2 message A B+1/2"]),
                run("O1\nDPRNT[]\nG4 P1.\nM30\n", &["2 message", "3 dwell"]),
            ],
        ),
        held(
            "p. 230",
            "The second digit of the format is the number of decimals, to which the value is rounded; zeros at the end are printed.",
            "statement DPRNT",
            &[
                run("O1\n#1=123.456789\nDPRNT[X-#1[35]]\nM30\n", &["3 message X-123.45679"]),
                run("O1\n#1=1.5436\nDPRNT[Z#1[03]]\nM30\n", &["3 message Z1.544"]),
                run("O1\n#1=2.5\nDPRNT[Z#1[13]]\nM30\n", &["3 message Z2.500"]),
            ],
        ),
        held(
            "p. 230",
            "No decimals print no point; a value with more digits before the point than are reserved is printed whole.",
            "statement DPRNT",
            &[
                run("O1\n#1=5\nDPRNT[V#1[20]]\nM30\n", &["3 message V"]),
                run("O1\n#1=123.4\nDPRNT[A#1[11]]\nM30\n", &["3 message A123.4"]),
            ],
        ),
        gap(
            "p. 230",
            "The first digit reserves places before the point: blanks lead where the value has fewer digits.",
            "runs print the blanks: `X#1[44]` of 1.5436 is X, three blanks, 1.5436. Now they are left out, and columns of a report do not line up",
            &[run("O1\n#1=1.5436\nDPRNT[X#1[44]]\nM30\n", &["3 message X 1.5436"])],
        ),
        gap(
            "p. 230",
            "1.5436 with [40] prints as 1, in the manual's example.",
            "without decimals the fraction is cut off, as the example shows, not rounded to 2; the sentence on rounding speaks of places that are there",
            &[run("O1\n#1=1.5436\nDPRNT[T#1[40]]\nM30\n", &["3 message T 1"])],
        ),
        gap(
            "p. 230",
            "DPRNT is the only command of its block.",
            "error for words beside DPRNT in its block; now they are read without a finding",
            &[rule(
                "error[code-must-stand-alone]",
                "O1\n#1=1.\nG54 G0 G90 X1. DPRNT[X#1[44]]\nM30\n",
                "O1\n#1=1.\nG54 G0 G90 X1.\nDPRNT[X#1[44]]\nM30\n",
            )],
        ),
        gap(
            "p. 230",
            "Each variable has a format of two digits in brackets.",
            "error for a variable without format, or with one of another number of digits",
            &[
                rule(
                    "error[dprnt-format]",
                    "O1\n#1=1.\nDPRNT[X#1]\nM30\n",
                    "O1\n#1=1.\nDPRNT[X#1[44]]\nM30\n",
                ),
                rule(
                    "error[dprnt-format]",
                    "O1\n#1=1.\nDPRNT[X#1[4]]\nM30\n",
                    "O1\n#1=1.\nDPRNT[X#1[40]]\nM30\n",
                ),
            ],
        ),
        gap(
            "p. 230",
            "Text is letters A to Z, + - / * and blanks.",
            "warning for other characters in the text of DPRNT (a comma, a colon): the control refuses or drops them",
            &[rule("warning[dprnt-text]", "O1\nDPRNT[A,B]\nM30\n", "O1\nDPRNT[A*B]\nM30\n")],
        ),
        held(
            "p. 231",
            "The bracket of DPRNT is closed in its block.",
            "rule unclosed-bracket",
            &[rule(
                "error[unclosed-bracket]",
                "O1\n#1=1.\nDPRNT[A#1[44]\nM30\n",
                "O1\n#1=1.\nDPRNT[A#1[44]]\nM30\n",
            )],
        ),
        held(
            "p. 230",
            "Any variable may be printed.",
            "statement DPRNT",
            &[
                legal("O1\nDPRNT[X#5041[34]*T#3026[30]*A#10500[22]]\nM30\n"),
                run("O1\nT7 M6\nDPRNT[TOOL#3026[10]]\nM30\n", &["3 message TOOL7"]),
            ],
        ),
        not_modelled(
            "p. 231",
            "Setting 261 sends the text to a file or a port, settings 262 and 263 say which.",
            "where text goes does not change what the machine does; a run shows it",
        ),
        gap(
            "p. 231",
            "DPRNT is executed while blocks are read ahead; G103 P1 holds it back, and is cancelled by G103 P0.",
            "info where DPRNT prints a position (#5021 on, #5041 on, #5061 on) after a move without G103 P1: it is printed before the machine is there",
            &[rule(
                "info[position-read-in-motion]",
                "O1\nG54 G0 G90 X1.\nDPRNT[X#5041[34]]\nM30\n",
                "O1\nG103 P1\nG54 G0 G90 X1.\n;\n;\nDPRNT[X#5041[34]]\nG103 P0\nM30\n",
            )],
        ),
        held(
            "p. 231",
            "A variable that nobody knows is printed as such, and stops nothing.",
            "messages of runs",
            &[run("O1\nDPRNT[X#500[34]]\nG4 P1.\nM30\n", &["2 message X?", "3 dwell"])],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
