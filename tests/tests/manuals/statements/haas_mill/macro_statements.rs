//! Use of variables, expressions and control statements: pages 218 to 229.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::mill::{gap, held, legal, mill, moves, not_modelled, reports, rule, run, stops};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Macros: expressions and statements",
    key: "MST",
    file: "haas_mill/macro_statements.rs",
    statements: &[
        held(
            "p. 218",
            "A variable is # and a positive number; #[expression] is the variable whose number the expression gives.",
            "variables, indirect variables",
            &[
                moves("O1\nG20 G54 G0 G90\n#1=3\n#[#1]=3.5+#1\nX#3\nM30\n", &["rapid X6.5"]),
                moves("O1\nG20 G54 G0 G90\n#1=5\n#[#1+2]=4.\nX#7\nM30\n", &["rapid X4."]),
                rule("error[missing-operand]", "O1\n#-1=2\nM30\n", "O1\n#1=-2\nM30\n"),
            ],
        ),
        held(
            "p. 219",
            "A variable may stand for the number of any address, G and M among them.",
            "computed words",
            &[
                moves(
                    "O1\nG20 G54\n#7=0\n#11=90\n#1=1.\n#2=0.\nN1 G#7 G#11 X#1 Y#2\nM30\n",
                    &["rapid X1. Y0."],
                ),
                run("O1\n#1=8\nM#1\nM30\n", &["3 coolant flood-on"]),
            ],
        ),
        held(
            "p. 219",
            "An address takes a variable, an expression in brackets, or the negative of either.",
            "computed words",
            &[
                moves(
                    "O1\nG20 G54 G90\n#1=1\n#2=1.5\n#3=3.7\n#4=20\nG#1 X[#1+#2] Y#3 F#4\nM30\n",
                    &["feed X2.5 Y3.7 F20."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\n#101=2.\n#1=30.\nX-#101\nX-[SIN[#1]]\nX[#101+3.5]\nM30\n",
                    &["rapid X-2.", "rapid X-.5", "rapid X5.5"],
                ),
            ],
        ),
        held(
            "p. 219",
            "N and O take no variable.",
            "rule expression-in-label",
            &[
                rule(
                    "error[expression-in-label]",
                    "O1\n#1=5\nN#1 G4 P1.\nM30\n",
                    "O1\n#1=5\nN5 G4 P1.\nM30\n",
                ),
                rule("error[expression-in-label]", "O#1\nG4 P1.\nM30\n", "O1\nG4 P1.\nM30\n"),
            ],
        ),
        held(
            "p. 220",
            "A value outside the range of its address is an alarm: D takes 0 to 200, so D#1 with 250 in #1 is one.",
            "gaps of `D`, `H` and `T`, rules `computed-value-out-of-range` and `number-out-of-range`",
            &[
                rule(
                    "error[computed-value-out-of-range]",
                    "O1\nG20 G54 G0 G90 X0. Y0.\n#1=250\nG1 G41 D#1 X1. F5.\nG40 X0.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0.\n#1=200\nG1 G41 D#1 X1. F5.\nG40 X0.\nM30\n",
                ),
                rule("error[number-out-of-range]", "O1\nG43 H250\nM30\n", "O1\nG43 H200\nM30\n"),
            ],
        ),
        held(
            "p. 220",
            "A computed value of an address is rounded to its last digit: .123456 goes to .1235 in inches and .123 in metric.",
            "`computed-lengths-round`",
            &[
                moves("O1\nG20 G54 G0 G90\n#1=.123456\nX#1\nM30\n", &["rapid X.1235"]),
                moves("O1\nG21 G54 G0 G90\n#1=.123456\nX#1\nM30\n", &["rapid X.123"]),
                moves(
                    "O1\nG20 G54 G0 G90\n#1=1.00333\nX[#1+#1]\nA[#1+#1]\nM30\n",
                    &["rapid X2.0067", "rapid A2.007"],
                ),
            ],
        ),
        held(
            "p. 221",
            "A whole number is rounded too: D[1.67] is D2.",
            "`computed-counts-round`; rule computed-value-out-of-range warns of the fraction",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG1 G41 D[1.67] X1. F5.\nY1.\nG40 X-1.\nM30\n")
                    .with(&["machine.units=\"inch\"", "tools.2.diameter=0.5"]),
                are: &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
            }],
        ),
        held(
            "p. 220",
            "An address that is given an unset variable counts as not written.",
            "vacant values; rule variable-read-before-set",
            &[
                moves("O1\nG20 G54 G0 G90 X0. Y0.\nX1. Y#1\nM30\n", &["rapid X0. Y0.", "rapid X1. Y0."]),
                rule(
                    "warning[variable-read-before-set]",
                    "O1\nG20 G54 G0 G90 X0. Y0.\nX1. Y#1\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0.\n#1=2.\nX1. Y#1\nM30\n",
                ),
            ],
        ),
        held(
            "p. 220, 221",
            "SIN, COS, TAN take degrees; ASIN, ACOS, ATAN of one number give degrees; SQRT, ABS, ROUND and FIX are there.",
            "functions",
            &[moves(
                "O1\nG20 G54 G0 G90\nX[SIN[30]]\nX[COS[60]+.1]\nX[TAN[45]]\nX[ASIN[.5]]\nX[ACOS[.5]]\nX[ATAN[1]]\nX[SQRT[9]]\nX[ABS[-2]]\nM30\n",
                &[
                    "rapid X.5",
                    "rapid X.6",
                    "rapid X1.",
                    "rapid X30.",
                    "rapid X60.",
                    "rapid X45.",
                    "rapid X3.",
                    "rapid X2.",
                ],
            )],
        ),
        held(
            "p. 221",
            "ATAN takes one number, like the ATAN[ ]/[1] of other controls: a slash after it divides.",
            "`atan-takes-one`",
            &[moves(
                "O1\nG20 G54 G0 G90\nX[ATAN[1]/[-1]]\nX[ATAN[1]/2]\nM30\n",
                &["rapid X-45.", "rapid X22.5"],
            )],
        ),
        held(
            "p. 221",
            "In an expression ROUND goes to the next whole number, a half up; FIX cuts the fraction off.",
            "functions ROUND, FIX",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\n#1=1.714\n#2=ROUND[#1]\nX#2\n#1=3.1416\n#2=ROUND[#1]\nX#2\n#2=ROUND[3.5]\nX#2\nM30\n",
                    &["rapid X2.", "rapid X3.", "rapid X4."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\n#1=3.54\n#2=ROUND[#1]\n#3=FIX[#1]\nX#2\nX#3\nM30\n",
                    &["rapid X4.", "rapid X3."],
                ),
            ],
        ),
        gap(
            "p. 221",
            "In a word ROUND goes to four places in inches, three in metric and of angles.",
            "ROUND inside the expression of a word rounds to the last digit of that word",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\n#1=1.00333\nX[ROUND[#1]]\nA[ROUND[#1]]\nM30\n",
                    &["rapid X1.0033", "rapid A1.003"],
                ),
                moves("O1\nG21 G54 G0 G90\n#1=1.00333\nX[ROUND[#1]]\nM30\n", &["rapid X1.003"]),
            ],
        ),
        not_modelled(
            "p. 221",
            "ROUND[#1]+ROUND[#1] with 1.00333 in a word goes to 2.0067 in the manual's example, and to 2.007 for an angle.",
            "contradicts the sentence above, by which it is 2.0066 and 2.006, as older editions print; which of them a machine does needs the machine",
        ),
        held(
            "p. 222",
            "EQ, NE, GT, LT, GE and LE give 1 or 0, and may stand in any expression.",
            "operators",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\n#10001=[1.0 LT 5.0]\nX#10001\nX[5 GT 5]\nX[5 GE 5]\nX[[5 LE 4]+2]\nX[[3 EQ 3]+2]\nX[[3 NE 3]+1]\nM30\n",
                    &["rapid X1.", "rapid X0.", "rapid X1.", "rapid X2.", "rapid X3.", "rapid X1."],
                ),
                moves(
                    "O1\nG20 G54 G0 G90\n#10001=0\nIF [#10001 EQ 0.0] GOTO100\nX1.\nN100 X2.\nM30\n",
                    &["rapid X2."],
                ),
            ],
        ),
        held(
            "p. 222",
            "AND binds closer than EQ: #1 AND #2 EQ #3 compares what #1 AND #2 give with #3.",
            "order of operators",
            &[moves(
                "O1\nG20 G54 G0 G90\n#10001=5\n#10002=3\n#10003=1\nIF [#10001 AND #10002 EQ #10003] GOTO1\nX1.\nN1 X2.\nM30\n",
                &["rapid X2."],
            )],
        ),
        held(
            "p. 223",
            "There are signs, + - * /, and MOD for the remainder.",
            "operators",
            &[moves(
                "O1\nG20 G54 G0 G90\nX[+1.23]\nX-[COS[60]]\n#1=27 MOD 20\nX#1\n#1=#1+5\nX#1\n#1=#1-1\nX#1\n#1=#1*2\nX#1\n#1=#1/4\nX#1\n#2=2+3*4\nX#2\nM30\n",
                &[
                    "rapid X1.23",
                    "rapid X-.5",
                    "rapid X7.",
                    "rapid X12.",
                    "rapid X11.",
                    "rapid X22.",
                    "rapid X5.5",
                    "rapid X14.",
                ],
            )],
        ),
        held(
            "p. 223",
            "OR, XOR and AND work on the bits of the whole parts.",
            "`logic-on-bits`",
            &[moves(
                "O1\nG20 G54 G0 G90\n#1=1.0\n#2=2.0\n#3=#1 OR #2\nX#3\nX[5 XOR 1]\nX[5.9 AND 3.9]\nM30\n",
                &["rapid X3.", "rapid X4.", "rapid X1."],
            )],
        ),
        held(
            "p. 223",
            "Two comparisons joined by AND hold when both do.",
            "operators",
            &[moves(
                "O1\nG20 G54 G0 G90\n#1=5.0\n#2=3.0\nIF [[#1 GT 3.0] AND [#2 LT 10]] GOTO1\nX1.\nN1 X2.\nIF [[#1 GT 3.0] AND [#2 GT 10]] GOTO2\nX3.\nN2 X4.\nM30\n",
                &["rapid X2.", "rapid X3.", "rapid X4."],
            )],
        ),
        held(
            "p. 224, 227",
            "Any expression is a condition: zero and an unset variable are false, any other number is true.",
            "conditions",
            &[moves(
                "O1\nG20 G54 G0 G90\n#1=.5\nIF [#1] GOTO5\nX1.\nN5 X2.\n#2=0\nIF [#2] GOTO6\nX3.\nN6 X4.\nIF [#3] GOTO7\nX5.\nN7 M30\n",
                &["rapid X2.", "rapid X3.", "rapid X4.", "rapid X5."],
            )],
        ),
        held(
            "p. 224, 226",
            "M99 P goes on at that block of the same program, and does not return to the caller.",
            "effect of `M99`, `return-to`",
            &[
                moves("O1\nG20 G54 G0 G90 X0.\nM99 P10\nX1.\nN10 X2.\nM30\n", &["rapid X0.", "rapid X2."]),
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nM98 P2\nX5.\nM30\nN10 X9.\nM30\nO2\nX1.\nM99 P10\nX2.\nN10 X3.\nM99\n",
                    &["rapid X0.", "rapid X1.", "rapid X3.", "rapid X5."],
                ),
            ],
        ),
        held(
            "p. 224",
            "A condition before M99 P makes it branch only where it holds.",
            "conditions before M99",
            &[moves(
                "O1\nG20 G54 G0 G90\n#1=3.\nN50 [#1 LT 10] M99 P10\nX1.\nN10 X2.\n[#1 GT 10] M99 P20\nX3.\nN20 X4.\nM30\n",
                &["rapid X2.", "rapid X3.", "rapid X4."],
            )],
        ),
        held(
            "p. 227",
            "A condition before M99 is for M99 alone: the moves of the block are made whether it holds or not.",
            "`words-before-conditions`",
            &[moves(
                "O1\nG20 G54 G0 G90 X9. Y9.\n#1=1\n#2=2\nG0 X0. Y0. [#1 EQ #2] M99 P5\nX1.\nG0 X5. Y5. [#1 NE #2] M99 P5\nX2.\nN5 X3.\nM30\n",
                &["rapid X9. Y9.", "rapid X0. Y0.", "rapid X1.", "rapid X5. Y5.", "rapid X3."],
            )],
        ),
        held(
            "p. 225",
            "The left side of an assignment is a variable, written or computed.",
            "rules value-without-address, unexpected-text",
            &[
                rule("error[value-without-address]", "O1\n1=#1\nM30\n", "O1\n#1=1\nM30\n"),
                rule("error[unexpected-text]", "O1\n#1=5\n[#1]=2\nM30\n", "O1\n#1=5\n#[#1]=2\nM30\n"),
            ],
        ),
        held(
            "p. 225",
            "NE #0 asks whether an argument was given.",
            "comparison with #0",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P300 B101. S3 V1.\nX#101\nX[#103+1.]\nM30\nO300\nN1 IF [#2 NE #0] GOTO2\n#3000=1 (NO BASE)\nN2 IF [#19 NE #0] GOTO3\n#3000=2 (NO SIZE)\nN3 WHILE [#19 GT 0] DO1\n#19=#19-1\n#[#2+#19]=#22\nEND1\nM99\n",
                    &["rapid X1.", "rapid X2."],
                ),
                stops(
                    "O1\nG65 P300 S3\nM30\nO300\nN1 IF [#2 NE #0] GOTO2\n#3000=1 (NO BASE)\nN2 M99\n",
                    "NO BASE",
                ),
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P2 B0\nM30\nO2\nIF [#2 NE #0] GOTO2\nX1.\nN2 X2.\nM99\n",
                    &["rapid X2."],
                ),
            ],
        ),
        held(
            "p. 226",
            "GOTO n goes on at block N n.",
            "jumps; rule jump-target-missing",
            &[
                moves("O1\nG20 G54 G0 G90\nGOTO15\nX1.\nN15 X2.\nM30\n", &["rapid X2."]),
                rule("error[jump-target-missing]", "O1\nGOTO16\nN15 M30\n", "O1\nGOTO15\nN15 M30\n"),
            ],
        ),
        held(
            "p. 226",
            "GOTO may stand in a block with other codes; it is executed after all of them, M codes too.",
            "`words-before-conditions`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0.\nX1. GOTO15\nX2.\nN15 X3.\nM30\n",
                    &["rapid X0.", "rapid X1.", "rapid X3."],
                ),
                run("O1\nM8 GOTO16\nG4 P1.\nN16 M9\nM30\n", &["2 coolant flood-on", "4 coolant flood-off"]),
            ],
        ),
        held(
            "p. 226",
            "GOTO takes a variable or an expression, and rounds it: 4.49 goes to N4, 4.5 to N5.",
            "computed jumps",
            &[
                moves("O1\nG20 G54 G0 G90\n#1=4.49\nGOTO#1\nN4 X4.\nGOTO9\nN5 X5.\nN9 M30\n", &["rapid X4."]),
                moves("O1\nG20 G54 G0 G90\n#1=4.5\nGOTO#1\nN4 X4.\nGOTO9\nN5 X5.\nN9 M30\n", &["rapid X5."]),
                moves(
                    "O1\nG20 G54 G0 G90\n#1=1\nGOTO[[#1*2]+1]\nN2 X2.\nGOTO9\nN3 X3.\nN9 M30\n",
                    &["rapid X3."],
                ),
            ],
        ),
        held(
            "p. 226, 227",
            "N0 is a target like any other.",
            "labels",
            &[
                moves("O1\nG20 G54 G0 G90\n#1=0\nGOTO#1\nN1 X1.\nN0 X4.\nM30\n", &["rapid X4."]),
                legal("O1\n#1=0\nGOTO#1\nN1 G4 P1.\nGOTO9\nN0 G4 P2.\nN9 M30\n"),
            ],
        ),
        held(
            "p. 227",
            "The condition of IF is in brackets.",
            "rule condition-missing",
            &[rule(
                "error[condition-missing]",
                "O1\n#1=1\nIF #1 EQ 1 GOTO5\nN5 M30\n",
                "O1\n#1=#500\nIF [#1 EQ 1] GOTO5\nN5 M30\n",
            )],
        ),
        held(
            "p. 227, 228",
            "IF with THEN executes the rest of its block only where the condition holds.",
            "statement IF THEN",
            &[moves(
                "O1\nG20 G54 G0 G90 X0.\n#1=5\n#590=101.\nIF [#590 GT 100] THEN #590=0.0\nX#590\nIF [#1 NE #0] THEN G1 X1. F5.\nIF [#2 NE #0] THEN G1 X2.\nX3.\nM30\n",
                &["rapid X0.", "rapid X0.", "feed X1. F5.", "feed X3."],
            )],
        ),
        held(
            "p. 228",
            "An assignment and M99 may follow THEN together.",
            "statement IF THEN",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 A200.\nX#101\nG65 P2 A20.\nM30\nO2\n#101=5.\nIF [#1 GE 180] THEN #101=7.0 M99\nX9.\nM99\n",
                &["rapid X7.", "rapid X9."],
            )],
        ),
        held(
            "p. 228",
            "THEN does not go with GOTO.",
            "rule `then-before-jump`",
            &[rule(
                "warning[then-before-jump]",
                "O1\n#1=#500\nIF [#1 EQ 2] THEN GOTO5\nG4 P1.\nN5 M30\n",
                "O1\n#1=#500\nIF [#1 EQ 2] GOTO5\nG4 P1.\nN5 M30\n",
            )],
        ),
        held(
            "p. 228",
            "Blanks between the parts of a condition may be left out.",
            "reading of expressions",
            &[moves(
                "O1\nG20 G54 G0 G90\nG65 P2 F5.\nM30\nO2\nN1 IF [#9NE#0] GOTO3 (F THERE)\nN2 #3000=11(NO FEED)\nN3 X1.\nM99\n",
                &["rapid X1."],
            )],
        ),
        held(
            "p. 228",
            "Of a false IF the remainder of the block is passed over: calls and moves may be conditioned.",
            "`words-after-if`",
            &[
                reports("O1\nG65 P2 A1.\nM30\nO2\nIF [#1 EQ 1] G65 P3 A2.\nM99\nO3\n#100=#1\nM99\n", &[]),
                moves(
                    "O1\nG20 G54 G0 G90\n#1=1\nIF [#1 EQ 1] G65 P3 A2.\nIF [#1 EQ 2] G65 P3 A3.\nM30\nO3\nX#1\nM99\n",
                    &["rapid X2."],
                ),
            ],
        ),
        held(
            "p. 228, 229",
            "WHILE or WH with a condition in brackets, DO n and END n repeat what is between while the condition holds; else the block after END comes next.",
            "loops",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\n#1=1\nWH [#1 LE 3] DO1\nX#1\n#1=#1+1\nEND1\nWHILE [#1 LE 3] DO1\nX9.\nEND1\nX5.\nM30\n",
                    &["rapid X1.", "rapid X2.", "rapid X3.", "rapid X5."],
                ),
                rule(
                    "error[condition-missing]",
                    "O1\n#1=1\nWHILE #1 LE 3 DO1\n#1=#1+1\nEND1\nM30\n",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO1\n#1=#1+1\nEND1\nM30\n",
                ),
                rule(
                    "error[loop-end-missing]",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO1\n#1=#1+1\nM30\n",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO1\n#1=#1+1\nEND1\nM30\n",
                ),
            ],
        ),
        held(
            "p. 229",
            "n is 1 to 3, so that loops nest three deep in a program.",
            "limit `do-numbers`, `loop-depth`; rules do-number-out-of-range, do-number-in-use",
            &[
                rule(
                    "error[do-number-out-of-range]",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO4\n#1=#1+1\nEND4\nM30\n",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO3\n#1=#1+1\nEND3\nM30\n",
                ),
                rule(
                    "error[do-number-in-use]",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO1\nWHILE [#1 LE 3] DO1\n#1=#1+1\nEND1\nEND1\nM30\n",
                    "O1\n#1=1\nWHILE [#1 LE 3] DO1\nWHILE [#1 LE 3] DO2\n#1=#1+1\nEND2\nEND1\nM30\n",
                ),
            ],
        ),
        held(
            "p. 229",
            "A subprogram has three levels of its own.",
            "loops of called programs",
            &[legal(
                "O1\n#1=1\nWHILE [#1 LE 2] DO1\nWHILE [#1 LE 2] DO2\nWHILE [#1 LE 2] DO3\nG65 P2\n#1=#1+1\nEND3\nEND2\nEND1\nM30\nO2\n#1=1\nWHILE [#1 LE 2] DO1\n#1=#1+1\nEND1\nM99\n",
            )],
        ),
        held(
            "p. 229",
            "Two loops one after the other may have the same number.",
            "loops",
            &[legal(
                "O1\n#1=1\nWHILE [#1 LE 3] DO1\n#1=#1+1\nEND1\nWHILE [#1 LE 6] DO1\n#1=#1+1\nEND1\nM30\n",
            )],
        ),
        held(
            "p. 229",
            "GOTO may leave a loop and move about in it, but not jump into it.",
            "rule jump-into-loop",
            &[
                rule(
                    "warning[jump-into-loop]",
                    "O1\nGOTO5\nDO1\nN5 G4 P1.\nIF [#500 EQ 1] GOTO9\nEND1\nN9 M30\n",
                    "O1\nDO1\nGOTO5\nN5 G4 P1.\nIF [#500 EQ 1] GOTO9\nEND1\nN9 M30\n",
                ),
                moves(
                    "O1\nG20 G54 G0 G90\n#1=0\nWHILE [#1 LT 5] DO1\n#1=#1+1\nIF [#1 EQ 2] GOTO7\nIF [#1 EQ 4] GOTO9\nX#1\nN7\nEND1\nN9 X9.\nM30\n",
                    &["rapid X1.", "rapid X3.", "rapid X9."],
                ),
            ],
        ),
        held(
            "p. 229",
            "DO without WHILE repeats until RESET.",
            "rule endless-loop",
            &[rule(
                "warning[endless-loop]",
                "O1\nDO1\nG4 P1.\nEND1\nM30\n",
                "O1\nDO1\nG4 P1.\nIF [#11018 EQ 1] GOTO9\nEND1\nN9 M30\n",
            )],
        ),
        held(
            "p. 229",
            "D01 with a zero is not DO1: alarm.",
            "rule while-without-do",
            &[
                rule(
                    "error[while-without-do]",
                    "O1\n#1=1\nWH [#1] D01\n#1=0\nEND1\nM30\n",
                    "O1\n#1=1\nWH [#1] DO1\n#1=0\nEND1\nM30\n",
                ),
                super::mill::says(
                    "O1\n#1=1\nWH [#1] D01\n#1=0\nEND1\nM30\n",
                    "error[while-without-do]",
                    "write the letter O in `DO`",
                ),
            ],
        ),
        held(
            "p. 228",
            "L repeats a subprogram a number of times that is fixed.",
            "`call-repeats`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0.\nM98 P2000 L5\nM30\nO2000\nG91 X1.\nG90\nM99\n",
                &["rapid X0.", "rapid X1.", "rapid X2.", "rapid X3.", "rapid X4.", "rapid X5."],
            )],
        ),
        held(
            "p. 231",
            "Brackets are balanced.",
            "rules unclosed-bracket, stray-bracket",
            &[
                rule("error[unclosed-bracket]", "O1\n#1=[1+2\nM30\n", "O1\n#1=[1+2]\nM30\n"),
                rule("error[stray-bracket]", "O1\n#1=1]+2\nM30\n", "O1\n#1=[1]+2\nM30\n"),
            ],
        ),
        held(
            "p. 231",
            "Between an address and its expression there may be a blank.",
            "reading of words",
            &[moves("O1\nG20 G54 G1 G90 X [COS[90]] Y3.0 F5.\nM30\n", &["feed X0. Y3."])],
        ),
        gap(
            "p. 231",
            "An address and its number are written without a blank between them: X 0 is an alarm.",
            "warning[blank-inside-number] for a blank between a letter and its number, as between digits: the manual says that it alarms at run time, of a program edited at the control",
            &[rule(
                "warning[blank-inside-number]",
                "O1\nG20 G54 G1 G90 X 0 Y3.0 F5.\nM30\n",
                "O1\nG20 G54 G1 G90 X0 Y3.0 F5.\nM30\n",
            )],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
