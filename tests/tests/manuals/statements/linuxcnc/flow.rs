//! Loops and conditions: `o-code.adoc`, looping, conditional, repeat, errors.
//!
//! Knows: statements, programs. Must not know: how they are checked.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, ngc, refused, rule, runs, stops};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Loops and conditions", key: "FLW", file: "linuxcnc/flow.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#ocode:looping",
        "while tests before each turn",
        "O-word while",
        &[
            runs(
                "#1=0\nO101 WHILE [#1 LT 3]\nG0 X#1\n#1=[#1+1]\nO101 ENDWHILE\nG0 Z1\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(0.0000",
                    "STRAIGHT_TRAVERSE(1.0000",
                    "STRAIGHT_TRAVERSE(2.0000",
                    "STRAIGHT_TRAVERSE(2.0000, 0.0000, 1.0000",
                ],
            ),
            runs(
                "O101 WHILE [#1 GT 3]\nG0 X9\nO101 ENDWHILE\nG0 Z1\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000"],
            ),
        ],
    ),
    held(
        "#ocode:looping",
        "do … while tests after each turn",
        "O-word do",
        &[
            runs(
                "#1=0\nO101 DO\nG0 X#1\n#1=[#1+1]\nO101 WHILE [#1 LT 2]\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000", "STRAIGHT_TRAVERSE(1.0000"],
            ),
            runs(
                "O101 DO\nG0 X7\nO101 WHILE [#1 GT 3]\nG0 Z1\nM2\n",
                &["STRAIGHT_TRAVERSE(7.0000", "STRAIGHT_TRAVERSE(7.0000, 0.0000, 1.0000"],
            ),
        ],
    ),
    held(
        "#ocode:looping",
        "break leaves the loop",
        "O-word break",
        &[runs(
            "#1=0\nO101 WHILE [#1 LT 5]\n#1=[#1+1]\nO102 IF [#1 EQ 3]\nO101 BREAK\nO102 ENDIF\nG0 X#1\nO101 ENDWHILE\nG0 Z#1\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000",
                "STRAIGHT_TRAVERSE(2.0000",
                "STRAIGHT_TRAVERSE(2.0000, 0.0000, 3.0000",
            ],
        )],
    ),
    held(
        "#ocode:looping",
        "continue goes to the next test",
        "O-word continue",
        &[
            runs(
                "#1=0\nO101 WHILE [#1 LT 4]\n#1=[#1+1]\nO102 IF [#1 EQ 2]\nO101 CONTINUE\nO102 ENDIF\nG0 X#1\nO101 ENDWHILE\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(3.0000", "STRAIGHT_TRAVERSE(4.0000"],
            ),
            runs(
                "#1=0\nO100 DO\nO110 IF [#1 EQ 2]\n#1=3\nO100 CONTINUE\nO110 ENDIF\n#1=[#1+1]\nG0 X#1\nO100 WHILE [#1 LT 3]\nG0 Y1\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000", "STRAIGHT_TRAVERSE(2.0000, 1.0000"],
            ),
        ],
    ),
    held(
        "#ocode:errors",
        "break and continue of a repeat are refused (interpreter 2.9)",
        "O-word break and continue; rule `o-word-unmatched`",
        &[
            stops(
                "#1=1\nO103 REPEAT [5]\nG91 G0 X1\nO104 IF [#1 GT 0]\nO103 BREAK\nO104 ENDIF\nO103 ENDREPEAT\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "#1=1\nO103 REPEAT [3]\nG91 G0 X1\nO104 IF [#1 GT 0]\nO103 CONTINUE\nO104 ENDIF\nO103 ENDREPEAT\nM2\n",
                "O103 REPEAT [3]\nG91 G0 X1\nO103 ENDREPEAT\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:looping",
        "A loop that never ends is said",
        "rule `endless-loop`",
        &[rule(
            "warning[endless-loop]",
            "G21 G90\n#1=1\nO101 WHILE [#1 GT 0]\nG0 X1\nO101 ENDWHILE\nM2\n",
            "G21 G90\n#1=1\nO101 WHILE [#1 GT 0]\nG0 X1\n#1=[#1-1]\nO101 ENDWHILE\nM2\n",
        )],
    ),
    held(
        "#ocode:conditional",
        "if, elseif and else: the first condition that is true counts, no more are tested",
        "O-word if",
        &[
            runs(
                "#2=1\nO102 IF [#2 GT 5]\nF100\nO102 ELSEIF [#2 LT 2]\nF200\nO102 ELSEIF [#2 LT 3]\nF300\nO102 ELSE\nF150\nO102 ENDIF\nG1 X1\nM2\n",
                &["SET_FEED_RATE(200.0000"],
            ),
            runs(
                "#2=3\nO102 IF [#2 GT 5]\nF100\nO102 ELSEIF [#2 LT 2]\nF200\nO102 ELSE\nF150\nO102 ENDIF\nG1 X1\nM2\n",
                &["SET_FEED_RATE(150.0000"],
            ),
            runs(
                "#2=9\nO102 IF [#2 GT 5]\nF100\nO102 ELSE\nF150\nO102 ENDIF\nG1 X1\nM2\n",
                &["SET_FEED_RATE(100.0000"],
            ),
        ],
    ),
    gap(
        "#ocode:conditional",
        "The expression of an elseif that is passed over is worked out all the same (interpreter 2.9): one without a value is refused",
        "`run` refuses it as the interpreter does; `check` reports an expression without a value also there (`expression-without-value`)",
        &[refused(
            "error[expression-without-value]",
            "#2=1\nO102 IF [#2 LT 2]\nG0 X1\nO102 ELSEIF [1/0]\nG0 X2\nO102 ENDIF\nM2\n",
            "#2=1\nO102 IF [#2 LT 2]\nG0 X1\nO102 ELSEIF [1/1]\nG0 X2\nO102 ENDIF\nM2\n",
        )],
    ),
    held(
        "#ocode:conditional",
        "else and elseif are optional",
        "O-word if",
        &[runs("O102 IF [#2 GT 5]\nF100\nO102 ENDIF\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#ocode:conditional",
        "What is not zero is true",
        "O-word if",
        &[runs(
            "#2=0.5\nO102 IF [#2]\nG0 X1\nO102 ENDIF\nO103 IF [-1]\nG0 Y1\nO103 ENDIF\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(1.0000, 1.0000"],
        )],
    ),
    held(
        "#ocode:repeat",
        "repeat runs its lines as many times as its value says",
        "O-word repeat",
        &[runs(
            "G91\nO103 REPEAT [3]\nG0 X1 Y1\nO103 ENDREPEAT\nG90 G0 Z1\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(1.0000, 1.0000",
                "STRAIGHT_TRAVERSE(2.0000, 2.0000",
                "STRAIGHT_TRAVERSE(3.0000, 3.0000",
                "STRAIGHT_TRAVERSE(3.0000, 3.0000, 1.0000",
            ],
        )],
    ),
    held(
        "#ocode:repeat",
        "Zero and less repeat nothing (interpreter 2.9)",
        "O-word repeat",
        &[
            Proof::Moves {
                program: ngc(
                    "G21 G90\nO103 REPEAT [0]\nG0 X1\nO103 ENDREPEAT\nO104 REPEAT [-2]\nG0 X1\nO104 ENDREPEAT\nG0 Z1\nM2\n",
                ),
                are: &["rapid X0. Z1."],
            },
            runs(
                "O103 REPEAT [0]\nG0 X1\nO103 ENDREPEAT\nO104 REPEAT [-2]\nG0 X1\nO104 ENDREPEAT\nG0 Z1\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000"],
            ),
        ],
    ),
    held(
        "#ocode:repeat",
        "A number of turns that is not whole is rounded, a half to the even neighbour (interpreter 2.9)",
        "statement `repeat`",
        &[
            runs("G91\nO103 REPEAT [2.5]\nG0 X1\nO103 ENDREPEAT\nM2\n", &["STRAIGHT_TRAVERSE(2.0000"]),
            runs("G91\nO103 REPEAT [3.5]\nG0 X1\nO103 ENDREPEAT\nM2\n", &["STRAIGHT_TRAVERSE(4.0000"]),
            runs("G91\nO103 REPEAT [2.6]\nG0 X1\nO103 ENDREPEAT\nM2\n", &["STRAIGHT_TRAVERSE(3.0000"]),
        ],
    ),
    held(
        "#ocode:errors",
        "return or endsub outside a subroutine is refused",
        "rule `return-outside-subroutine`",
        &[
            refused(
                "error[return-outside-subroutine]",
                "O100 RETURN\nM2\n",
                "O100 SUB\nO100 RETURN\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
            refused(
                "error[return-outside-subroutine]",
                "O100 ENDSUB\nM2\n",
                "O100 SUB\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:errors",
        "else, elseif and endif without their if are refused",
        "rule `o-word-unmatched`",
        &[
            refused(
                "error[o-word-unmatched]",
                "O100 ELSE\nM2\n",
                "O100 IF [#5]\nO100 ELSE\nO100 ENDIF\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 ELSEIF [1]\nM2\n",
                "O100 IF [#5]\nO100 ELSEIF [#6]\nO100 ENDIF\nM2\n",
            ),
            refused("error[o-word-unmatched]", "O100 ENDIF\nM2\n", "O100 IF [#5]\nO100 ENDIF\nM2\n"),
            refused(
                "error[o-word-unmatched]",
                "O100 IF [#5 EQ 0]\nO101 ENDIF\nM2\n",
                "O100 IF [#5 EQ 0]\nO100 ENDIF\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:errors",
        "break and continue without a loop of their number are refused",
        "rule `o-word-unmatched`",
        &[
            refused(
                "error[o-word-unmatched]",
                "O100 BREAK\nM2\n",
                "O100 WHILE [#5 EQ 0]\nO100 BREAK\nO100 ENDWHILE\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 CONTINUE\nM2\n",
                "O100 WHILE [#5 GT 0]\nO100 CONTINUE\nO100 ENDWHILE\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:errors",
        "endwhile and endrepeat without their beginning, or with another's number, are refused",
        "rule `o-word-unmatched`",
        &[
            refused(
                "error[o-word-unmatched]",
                "O100 ENDWHILE\nM2\n",
                "O100 WHILE [#5 GT 0]\nO100 ENDWHILE\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 ENDREPEAT\nM2\n",
                "O100 REPEAT [2]\nO100 ENDREPEAT\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 IF [#5 EQ 0]\nO100 ENDWHILE\nM2\n",
                "O100 WHILE [#5 GT 0]\nO100 ENDWHILE\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 REPEAT [2]\nO100 ENDWHILE\nM2\n",
                "O100 REPEAT [2]\nO100 ENDREPEAT\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:looping, #ocode:repeat, #ocode:subroutines",
        "A sub without its end is refused; a loop without its end is refused where it is skipped, left or continued, else the program runs on past it (interpreter 2.9)",
        "rule `o-word-unmatched`",
        &[
            runs("#5=1\nO100 WHILE [#5 GT 0]\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END()"]),
            runs("O100 DO\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END()"]),
            runs("O100 REPEAT [2]\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END()"]),
            stops("O100 REPEAT [0]\nG0 X1\nM2\n"),
            stops("O100 DO\nG0 X1\nO100 BREAK\nM2\n"),
            stops("O100 WHILE [1]\nG0 X1\nO100 CONTINUE\nM2\n"),
            refused(
                "error[o-word-unmatched]",
                "O100 WHILE [#5 GT 0]\nG0 X1\nM2\n",
                "O100 WHILE [#5 GT 0]\nG0 X1\nO100 ENDWHILE\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 SUB\nG0 X1\nM2\n",
                "O100 SUB\nG0 X1\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:conditional",
        "An if without endif runs as long as its branch is taken, and is refused where blocks have to be skipped (interpreter 2.9)",
        "rule `o-word-unmatched`",
        &[
            runs("#5=1\nO100 IF [#5]\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END()"]),
            runs(
                "O100 IF [#5]\nG0 X1\nO100 ELSE\nG0 X5\nM2\n",
                &["STRAIGHT_TRAVERSE(5.0000", "PROGRAM_END()"],
            ),
            stops("#5=1\nO100 IF [#5]\nG0 X1\nO100 ELSE\nG0 X5\nM2\n"),
            refused(
                "warning[o-word-unmatched]",
                "O100 IF [#5]\nG0 X1\nM2\n",
                "O100 IF [#5]\nG0 X1\nO100 ENDIF\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:conditional",
        "The condition is in brackets",
        "rule `condition-missing`",
        &[refused(
            "error[condition-missing]",
            "O100 IF 1\nO100 ENDIF\nM2\n",
            "O100 IF [#5]\nO100 ENDIF\nM2\n",
        )],
    ),
    held(
        "#cha:o-codes",
        "An unknown keyword after an O-word is refused (interpreter 2.9)",
        "rules `unexpected-text`, `o-word-without-keyword`",
        &[
            refused("error[unexpected-text]", "O100 BAR\nM2\n", "O100 SUB\nO100 ENDSUB\nO100 CALL\nM2\n"),
            refused(
                "error[o-word-without-keyword]",
                "O<slot> BAR\nM2\n",
                "O<slot> SUB\nO<slot> ENDSUB\nO<slot> CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#cha:o-codes",
        "A block number or a slash may stand before an O-word",
        "grammar of blocks",
        &[
            runs("#5=1\nN10 O100 IF [#5]\nN20 G0 X1\nN30 O100 ENDIF\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            runs("#5=1\n/O100 IF [#5]\nG0 X1\nO100 ENDIF\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
        ],
    ),
    held(
        "#ocode:conditional",
        "An elseif after else never counts (interpreter 2.9)",
        "O-word if",
        &[runs(
            "O100 IF [#5]\nG0 X3\nO100 ELSE\nG0 X1\nO100 ELSEIF [1]\nG0 X2\nO100 ENDIF\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    held(
        "#ocode:looping",
        "A loop that nothing ends is counted, not run for ever",
        "fuel of a run",
        &[Proof::Stats {
            program: ngc("G21 G90\n#1=0\nO101 WHILE [#1 LT 1000]\n#1=[#1+1]\nO101 ENDWHILE\nG0 X1\nM2\n"),
            prints: &["cycle time"],
        }],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
