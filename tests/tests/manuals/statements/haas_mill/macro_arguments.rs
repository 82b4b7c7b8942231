//! Arguments of macro calls and local variables: pages 195 to 199.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::mill::{gap, held, moves, not_modelled, reports, rule};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Macros: arguments and local variables",
    key: "ARG",
    file: "haas_mill/macro_arguments.rs",
    statements: &[
        held(
            "p. 195, 196",
            "A, B, C arrive in #1 to #3, I, J, K in #4 to #6, D, E, F in #7 to #9, H in #11, Q to Z in #17 to #26.",
            "`argument-letters`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 A1. B2. C3. I4. J5. K6. D7. H11.\nM30\nO2\nX#1\nX#2\nX#3\nX#4\nX#5\nX#6\nX#7\nX#11\nM99\n",
                    &[
                        "rapid X1.",
                        "rapid X2.",
                        "rapid X3.",
                        "rapid X4.",
                        "rapid X5.",
                        "rapid X6.",
                        "rapid X7.",
                        "rapid X11.",
                    ],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 E8. F9. Q17. R18. S19. T20. U21. V22. W23. X24. Y25. Z26.\nM30\nO2\nX#8\nX#9\nX#17\nX#18\nX#19\nX#20\nX#21\nX#22\nX#23\nX#24\nX#25\nX#26\nM99\n",
                    &[
                        "rapid X8.",
                        "rapid X9.",
                        "rapid X17.",
                        "rapid X18.",
                        "rapid X19.",
                        "rapid X20.",
                        "rapid X21.",
                        "rapid X22.",
                        "rapid X23.",
                        "rapid X24.",
                        "rapid X25.",
                        "rapid X26.",
                    ],
                ),
            ],
        ),
        held(
            "p. 196, 197",
            "M in a block of G65 is an argument: it arrives in #13, without a point as a whole number.",
            "`m-is-argument`",
            &[
                moves("O1\nG20 G54 G0 G90\nG65 P2 M8\nM30\nO2\nX#13\nM99\n", &["rapid X8."]),
                moves("O1\nG20 G54 G0 G90\nG65 P2 M3.5\nM30\nO2\nX#13\nM99\n", &["rapid X3.5"]),
                reports("O1\nG20 G54 G0 G90\nG65 P2 M30\nX1.\nM30\nO2\nX#13\nM99\n", &[]),
            ],
        ),
        gap(
            "p. 195, 198",
            "G, L, N, O and P are no arguments.",
            "error for G, N or O (and a second P) after G65 in its block (alarm 529); L is the repeat count",
            &[
                rule(
                    "error[word-forbidden]",
                    "O1\nG65 P2 A1. O5\nM30\nO2\n#100=#1\nM99\n",
                    "O1\nG65 P2 A1. H5.\nM30\nO2\n#100=#1\nM99\n",
                ),
                rule(
                    "error[word-forbidden]",
                    "O1\nG65 P2 A1. N5\nM30\nO2\n#100=#1\nM99\n",
                    "O1\nN5 G65 P2 A1.\nM30\nO2\n#100=#1\nM99\n",
                ),
                rule(
                    "error[word-given-twice]",
                    "O1\nG65 P2 A1. P5\nM30\nO2\n#100=#1\nM99\nO5\nM99\n",
                    "O1\nG65 P2 A1.\nM30\nO2\n#100=#1\nM99\nO5\nM99\n",
                ),
            ],
        ),
        held(
            "p. 196",
            "I, J and K given more than once fill #4 to #33 three by three, each letter in its own place.",
            "arguments of macro calls",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 I4. J5. K6. I7. J8. K9.\nM30\nO2\nX#4\nX#5\nX#6\nX#7\nX#8\nX#9\nM99\n",
                    &["rapid X4.", "rapid X5.", "rapid X6.", "rapid X7.", "rapid X8.", "rapid X9."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 K1. K2.\nM30\nO2\nX#6\nX#9\nM99\n",
                    &["rapid X1.", "rapid X2."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 I1. J2. K3. I4. J5. K6. I7. J8. K9. I10. J11. K12. I13. J14. K15. I16. J17. K18. I19. J20. K21. I22. J23. K24. I25. J26. K27. I28. J29. K30.\nM30\nO2\nX#10\nX#12\nX#16\nX#27\nX#31\nX#32\nX#33\nM99\n",
                    &[
                        "rapid X7.",
                        "rapid X9.",
                        "rapid X13.",
                        "rapid X24.",
                        "rapid X28.",
                        "rapid X29.",
                        "rapid X30.",
                    ],
                ),
            ],
        ),
        held(
            "p. 197",
            "In inches an argument without a point counts 0.0001 in A, B, C, I, J, K, Q, R and U to Z.",
            "`whole-arguments`: all other letters count least increments of length",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 A1 B2 C3\nM30\nO2\nX[#1*1000]\nX[#2*1000]\nX[#3*1000]\nM99\n",
                    &["rapid X.1", "rapid X.2", "rapid X.3"],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 I1 Q2 R3 U4 V5 W6 X7 Y8 Z9\nM30\nO2\nX[#4*1000]\nX[#17*1000]\nX[#18*1000]\nX[#21*1000]\nX[#22*1000]\nX[#23*1000]\nX[#24*1000]\nX[#25*1000]\nX[#26*1000]\nM99\n",
                    &[
                        "rapid X.1",
                        "rapid X.2",
                        "rapid X.3",
                        "rapid X.4",
                        "rapid X.5",
                        "rapid X.6",
                        "rapid X.7",
                        "rapid X.8",
                        "rapid X.9",
                    ],
                ),
            ],
        ),
        held(
            "p. 197, 198",
            "A set of I, J, K given more than once counts 0.0001 without a point as well.",
            "`whole-arguments`",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 I1 J2 K3 I4 J5 K6\nM30\nO2\nX[#4*1000]\nX[#5*1000]\nX[#6*1000]\nX[#7*1000]\nX[#8*1000]\nX[#9*1000]\nM99\n",
                &["rapid X.1", "rapid X.2", "rapid X.3", "rapid X.4", "rapid X.5", "rapid X.6"],
            )],
        ),
        held(
            "p. 197",
            "D, H, S and T without a point are whole numbers.",
            "kinds of the letters",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 D4 H7 S11 T12\nM30\nO2\nX#7\nX#11\nX#19\nX#20\nM99\n",
                &["rapid X4.", "rapid X7.", "rapid X11.", "rapid X12."],
            )],
        ),
        held(
            "p. 197",
            "E and F without a point are whole numbers too.",
            "`whole-arguments`",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 E5 F6\nM30\nO2\nX#8\nX#9\nM99\n",
                &["rapid X5.", "rapid X6."],
            )],
        ),
        held(
            "p. 197",
            "In metric an argument without a point counts 0.001.",
            "`whole-arguments`",
            &[moves(
                "O1\nG21 G54 G0 G90\nG65 P2 A1 X2 D3 E4 F5\nM30\nO2\nX[#1*1000]\nX[#24*1000]\nX#7\nX#8\nX#9\nM99\n",
                &["rapid X1.", "rapid X2.", "rapid X3.", "rapid X4.", "rapid X5."],
            )],
        ),
        held(
            "p. 197",
            "An argument without a point is easily ten thousand times too small.",
            "rule `missing-decimal-point`",
            &[rule(
                "warning[missing-decimal-point]",
                "O1\nG65 P2 X1\nM30\nO2\n#100=#24\nM99\n",
                "O1\nG65 P2 X1.\nM30\nO2\n#100=#24\nM99\n",
            )],
        ),
        not_modelled(
            "p. 197",
            "Arguments have up to four decimals, three in metric.",
            "whether further decimals are rounded, cut or refused is not said",
        ),
        held(
            "p. 198",
            "G65 gives the macro a new set of #1 to #33, unset but for its arguments; the caller's come back with M99.",
            "locals of macro calls",
            &[moves(
                "O1\nG20 G54 G0 G90\n#1=5.\n#2=6.\nG65 P2 B7.\nX#1\nX#2\nM30\nO2\nX1. Y#1\nX#2\n#2=9.\nM99\n",
                &["rapid X1. Y?", "rapid X7.", "rapid X5.", "rapid X6."],
            )],
        ),
        held(
            "p. 199",
            "#10, #12, #14 to #16 and #27 to #33 are no argument's, but for sets of I, J, K.",
            "`argument-letters`",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 I1. J2. K3. I4. J5. K6. I7. J8. K9.\nM30\nO2\nX#10\nX#11\nX#12\nM99\n",
                &["rapid X7.", "rapid X8.", "rapid X9."],
            )],
        ),
        held(
            "p. 199",
            "With L the arguments are set once: what the first call leaves in #1 to #33 is what the next one finds.",
            "repeats of macro calls",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 A1. L3\nM30\nO2\nX#1\n#1=#1+1\nM99\n",
                &["rapid X1.", "rapid X2.", "rapid X3."],
            )],
        ),
        held(
            "p. 199",
            "M97 and M98 give no new set: the subprogram reads and writes its caller's variables.",
            "`locals-per-subprogram`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\n#1=5.\nM97 P10\nX#1\nM30\nN10 X#1\n#1=6.\nM99\n",
                    &["rapid X5.", "rapid X6."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\n#1=5.\nM98 P2\nX#1\nM30\nO2\nX#1\n#1=6.\nM99\n",
                    &["rapid X5.", "rapid X6."],
                ),
            ],
        ),
        gap(
            "p. 198, 220",
            "An argument that the call does not give is unset in the macro, and a word that is given it is left out of its block.",
            "warning[variable-read-before-set] for a local variable of a macro that a call in the same file leaves out, where a word of a move is given it alone",
            &[rule(
                "warning[variable-read-before-set]",
                "O1\nG65 P2\nM30\nO2\nG54 G0 G90 X#24\nM99\n",
                "O1\nG65 P2 X1.\nM30\nO2\nG54 G0 G90 X#24\nM99\n",
            )],
        ),
        held(
            "p. 199, 200",
            "There is one copy of each global variable for all programs.",
            "scope of variables",
            &[moves(
                "O1\nG20 G54 G0 G90\n#10000=1.\nG65 P2\nX#10000\nM30\nO2\nX#10000\n#10000=2.\nM99\n",
                &["rapid X1.", "rapid X2."],
            )],
        ),
        held(
            "p. 199",
            "Global variables keep their values when the power is off: a program may find values of others in them.",
            "kind `retained` of the variables; rules common-variable-never-set, unset variables of runs",
            &[
                super::mill::variables([10000, 10149], "common variables", "read-write"),
                moves("O1\nG20 G54 G0 G90 X1.\nX#10000\nM30\n", &["rapid X1.", "rapid X?"]),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
