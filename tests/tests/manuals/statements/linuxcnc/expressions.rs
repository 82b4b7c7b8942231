//! Expressions and functions: `overview.adoc`, expressions, binary operators, equality, functions.
//!
//! Knows: statements, programs. Must not know: how they are checked.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, refused, runs, stops};

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Expressions", key: "EXP", file: "linuxcnc/expressions.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#gcode:expressions",
        "An expression stands in brackets, and may hold numbers, parameters, functions and other expressions",
        "expressions",
        &[
            runs("G0 X[1 + acos[0] - [2 ** [4.0/2]]]\nM2\n", &["STRAIGHT_TRAVERSE(87.0000"]),
            refused("error[unclosed-bracket]", "G0 X[1\nM2\n", "G0 X[1]\nM2\n"),
            refused("error[expression-needs-brackets]", "G0 X1+2\nM2\n", "G0 X[1+2]\nM2\n"),
        ],
    ),
    held(
        "#gcode:expressions",
        "Expressions of a line are worked out when it is read, before anything of it acts",
        "`assignments-after-block = true`",
        &[runs("G0 X1\nG91 G0 X2 Y[#5420]\nM2\n", &["STRAIGHT_TRAVERSE(3.0000, 1.0000"])],
    ),
    held(
        "#gcode:binary-operators",
        "+ - * / and ** are sum, difference, product, quotient and power",
        "expressions",
        &[runs(
            "G0 X[2.0 / 3 * 1.5 - 5.5 / 11.0] Y[2 + 3 * 4 ** 2]\nM2\n",
            &["STRAIGHT_TRAVERSE(0.5000, 50.0000"],
        )],
    ),
    held(
        "#gcode:binary-operators",
        "Operations of one group go from left to right, ** too",
        "expressions",
        &[runs(
            "G0 X[2 ** 3 ** 2] Y[10 - 4 - 3] Z[100 / 10 / 5]\nM2\n",
            &["STRAIGHT_TRAVERSE(64.0000, 3.0000, 2.0000"],
        )],
    ),
    held(
        "#gcode:operators-precedence",
        "** binds before * / MOD, then + -, then comparisons, then AND OR XOR",
        "`logic-binds-last = true`",
        &[
            runs(
                "G0 X[1 + 2 EQ 3 AND 1] Y[2 * 3 MOD 4] Z[1 AND 0 OR 1]\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 2.0000, 1.0000"],
            ),
            runs("G0 X[1 OR 1 AND 0]\nM2\n", &["STRAIGHT_TRAVERSE("]),
        ],
    ),
    held(
        "#gcode:operators-precedence",
        "A sign binds tighter than **: -2 ** 2 is 4 (interpreter 2.9)",
        "expressions",
        &[runs("G0 X[-2 ** 2]\nM2\n", &["STRAIGHT_TRAVERSE(4.0000"])],
    ),
    held(
        "#gcode:binary-operators",
        "MOD works on any numbers, and its result is never below zero (interpreter 2.9)",
        "expressions",
        &[runs(
            "G0 X[7 MOD 3] Y[-7 MOD 3] Z[7.5 MOD 2]\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 2.0000, 1.5000"],
        )],
    ),
    held(
        "#gcode:binary-operators",
        "Zero is false and everything else true, also for numbers that are not whole",
        "`logic-on-bits = false`",
        &[runs(
            "G0 X[0.5 AND 2] Y[0.5 OR 0] Z[2 XOR 0]\nX[1 XOR 1] Y[1 AND 0] Z[0 OR 0]\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 1.0000, 1.0000", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:binary-operators",
        "EQ NE GT GE LT LE give 1 or 0",
        "expressions",
        &[runs(
            "G0 X[1 EQ 1] Y[1 NE 1] Z[2 GT 1]\nX[1 GE 1] Y[1 LT 1] Z[2 LE 1]\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000", "STRAIGHT_TRAVERSE(1.0000, 0.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:binary-operators",
        "Values are equal within 1e-6, says the documentation; the interpreter (2.9) takes 1e-4",
        "`equal-within = 1e-4`",
        &[runs("G0 X[1 EQ 1.00009] Y[1 EQ 1.00011] Z[1 LT 1.00005]\nM2\n", &["STRAIGHT_TRAVERSE("])],
    ),
    held(
        "#gcode:functions",
        "Angles of functions are degrees",
        "expressions",
        &[runs(
            "G0 XSIN[30] YCOS[60] ZTAN[45]\nXASIN[1] YACOS[0] ZATAN[1]/[1]\nM2\n",
            &["STRAIGHT_TRAVERSE(0.5000, 0.5000, 1.0000", "STRAIGHT_TRAVERSE(90.0000, 90.0000, 45.0000"],
        )],
    ),
    held(
        "#gcode:functions",
        "ATAN takes two arguments and knows the quadrant",
        "`atan-alone = false`",
        &[runs(
            "G0 XATAN[1]/[0] YATAN[-1]/[-1] ZATAN[1]/[-1]\nM2\n",
            &["STRAIGHT_TRAVERSE(90.0000, -135.0000, 135.0000"],
        )],
    ),
    held(
        "#gcode:functions",
        "ATAN takes two arguments with a slash between them; with one it is refused (interpreter 2.9)",
        "rule `function-unknown`",
        &[refused("error[function-unknown]", "G0 XATAN[1]\nM2\n", "G0 XATAN[1]/[1]\nM2\n")],
    ),
    held(
        "#gcode:functions",
        "ABS EXP LN SQRT",
        "expressions",
        &[runs(
            "G0 XABS[-5] YEXP[1] ZLN[2]\nXSQRT[16]\nM2\n",
            &["STRAIGHT_TRAVERSE(5.0000, 2.7183, 0.6931", "STRAIGHT_TRAVERSE(4.0000"],
        )],
    ),
    held(
        "#gcode:functions",
        "FIX goes down and FUP up on the number line, also below zero",
        "`fix = \"number-line\"`",
        &[runs(
            "G0 XFIX[2.8] YFIX[-2.8] ZFUP[2.8]\nXFUP[-2.8]\nM2\n",
            &["STRAIGHT_TRAVERSE(2.0000, -3.0000, 3.0000", "STRAIGHT_TRAVERSE(-2.0000"],
        )],
    ),
    held(
        "#gcode:functions",
        "ROUND goes to the nearest whole number, halves away from zero (interpreter 2.9)",
        "expressions",
        &[runs(
            "G0 XROUND[2.5] YROUND[-2.5] ZROUND[3.5]\nXROUND[2.4] YROUND[0.5] ZROUND[-0.4]\nM2\n",
            &["STRAIGHT_TRAVERSE(3.0000, -3.0000, 4.0000", "STRAIGHT_TRAVERSE(2.0000, 1.0000, 0.0000"],
        )],
    ),
    held(
        "#gcode:functions",
        "What has no value is refused: roots of negative numbers, logarithms of zero, sines above 1, division by zero",
        "rule `expression-without-value`",
        &[
            refused("error[expression-without-value]", "G0 XSQRT[-1]\nM2\n", "G0 XSQRT[1]\nM2\n"),
            refused("error[expression-without-value]", "G0 XLN[0]\nM2\n", "G0 XLN[1]\nM2\n"),
            refused("error[expression-without-value]", "G0 XACOS[2]\nM2\n", "G0 XACOS[1]\nM2\n"),
            refused("error[expression-without-value]", "G0 X[1/0]\nM2\n", "G0 X[1/1]\nM2\n"),
            refused("error[expression-without-value]", "G0 X[5 MOD 0]\nM2\n", "G0 X[5 MOD 1]\nM2\n"),
            refused("error[expression-without-value]", "G0 X[[-8] ** [1/3]]\nM2\n", "G0 X[[-8] ** 3]\nM2\n"),
        ],
    ),
    held(
        "#gcode:functions",
        "EXISTS tells whether a named parameter exists",
        "expressions",
        &[
            runs(
                "#<a>=1\nG0 X[EXISTS[#<a>]] Y[EXISTS[#<b>]] Z[EXISTS[#<_metric>]]\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000"],
            ),
            runs(
                "O100 SUB\n#1=EXISTS[#<_global>]\nG0 X#1\nO100 ENDSUB\nO100 CALL\n#<_global>=4711\nO100 CALL\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000", "STRAIGHT_TRAVERSE(1.0000"],
            ),
        ],
    ),
    held(
        "#gcode:functions",
        "EXISTS of a numbered parameter is an error, says the documentation; the interpreter (2.9) takes it",
        "expressions",
        &[
            runs("G0 X[EXISTS[#1]]\nM2\n", &["STRAIGHT_TRAVERSE("]),
            stops("G0 X[EXISTS[#<a>+1]]\nM2\n"),
            stops("G0 X[EXISTS #<a>]\nM2\n"),
        ],
    ),
    gap(
        "#gcode:functions",
        "EXISTS of a number or an expression is refused",
        "`run` and `check` refuse it (error): it is read as the number today",
        &[
            refused(
                "error[exists-of-expression]",
                "G0 X[EXISTS[5]]\nM2\n",
                "#<a>=1\nG0 X[EXISTS[#<a>]]\nM2\n",
            ),
            refused(
                "error[exists-of-expression]",
                "G0 X[EXISTS[1+1]]\nM2\n",
                "#<a>=1\nG0 X[EXISTS[#<a>]]\nM2\n",
            ),
        ],
    ),
    gap(
        "#gcode:functions",
        "EXISTS with an operation on the name is refused as such",
        "one finding that says what EXISTS takes (`named-parameter-unset` today, which is beside the point)",
        &[refused(
            "error[exists-of-expression]",
            "G0 X[EXISTS[#<a>+1]]\nM2\n",
            "#<a>=1\nG0 X[EXISTS[#<a>]]\nM2\n",
        )],
    ),
    held(
        "#gcode:expressions",
        "Signs may stand before parameters, brackets and functions (interpreter 2.9)",
        "expressions",
        &[runs(
            "#1=3\nG0 X-#1 Y-[5] Z-ABS[-5]\nX+[5]\nM2\n",
            &["STRAIGHT_TRAVERSE(-3.0000, -5.0000, -5.0000", "STRAIGHT_TRAVERSE(5.0000"],
        )],
    ),
    held(
        "#gcode:expressions",
        "A comment inside an expression is refused (interpreter 2.9)",
        "rule `missing-operand`",
        &[refused("error[missing-operand]", "G0 X[(comment)1]\nM2\n", "G0 X[1] (comment)\nM2\n")],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
