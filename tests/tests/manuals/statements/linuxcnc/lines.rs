//! Lines, numbers, comments: `overview.adoc`, format of a line, numbers, comments and messages.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: where messages are shown, size of files, advice on style.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Lines, numbers, comments",
    key: "LIN",
    file: "linuxcnc/lines.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#cha:overview-of-g-code-programming",
        "A line is: slash, block number, then words, settings of parameters, O-code and comments in any order",
        "grammar of blocks",
        &[runs(
            "/N10 G0 #1=3 (a) X1 #2=4 Y2\nG0 Z[#1+#2]\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 2.0000, 0.0000", "STRAIGHT_TRAVERSE(1.0000, 2.0000, 7.0000"],
        )],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "A line has at most 256 characters, says the documentation; the interpreter (2.9) takes 255",
        "`line-length = 255`, rule `line-too-long`",
        &[refused(
            "error[line-too-long]",
            "G0 X1 (aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa)\nM2\n",
            "G0 X1 (aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa)\nM2\n",
        )],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Blanks and tabs mean nothing outside comments, also inside numbers",
        "`blanks-in-numbers = true`, rule `blank-inside-number`",
        &[
            runs(
                "G0X +0. 12 34Y 7\n G 0\tX 2\nM2\n",
                &["STRAIGHT_TRAVERSE(0.1234, 7.0000", "STRAIGHT_TRAVERSE(2.0000, 7.0000"],
            ),
            rule("warning[blank-inside-number]", "G21 G90 G0 X1 2\nM2\n", "G21 G90 G0 X 12\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Blank lines are ignored, letters may be small",
        "`lower-case = true`",
        &[runs("\n\ng0 x1\n\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]), legal("g21 g90\n\ng0 x1\nm2\n")],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "Anything else on a line is refused",
        "rule `unexpected-text`",
        &[stops("G0 X1 !\nM2\n"), stops("G0 X1 ;fine\n? \nM2\n")],
    ),
    held(
        "#sub:block-delete",
        "A slash at the head of a line skips it while block delete is on",
        "`gcheck run --block-skip`",
        &[runs("/G0 X1\nG0 X2\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000"])],
    ),
    held(
        "#sub:block-delete",
        "The slash must be first: elsewhere it is refused, and there are no levels",
        "`block-delete-inside = false`, rule `block-delete-level`",
        &[
            refused("error[block-delete-level]", "G0 /X1\nM2\n", "/G0 X1\nM2\n"),
            refused("error[block-delete-level]", "N10 /G0 X1\nM2\n", "/N10 G0 X1\nM2\n"),
            stops("/2 G0 X1\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "A block number is whole, or has a point and another whole number; it may repeat and be out of order",
        "grammar of blocks",
        &[
            runs(
                "N1234 G0 X1\nN56.78 G0 X2\nN56.78 G0 X3\nN1 G0 X4\nM2\n",
                &["N1234", "N56 ", "N56 ", "N1 "],
            ),
            legal("N1234 G21 G90 G0 X1\nN56.78 G0 X2\nN1 G0 X4\nM2\n"),
        ],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "A block number with a minus sign, with two points, or without digits is refused",
        "rules `sign-not-accepted`, `malformed-number`, `address-without-value`",
        &[
            refused("error[sign-not-accepted]", "N-5 G0 X1\nM2\n", "N5 G0 X1\nM2\n"),
            refused("error[malformed-number]", "N1.2.3 G0 X1\nM2\n", "N1.2 G0 X1\nM2\n"),
            refused("error[address-without-value]", "N G0 X1\nM2\n", "N1 G0 X1\nM2\n"),
        ],
    ),
    gap(
        "#cha:overview-of-g-code-programming",
        "A block number with a plus sign is refused (interpreter 2.9)",
        "`run` and `check` refuse it (error: sign not accepted)",
        &[refused("error[sign-not-accepted]", "N+5 G0 X1\nM2\n", "N5 G0 X1\nM2\n")],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "A block number after other words is refused",
        "rule `block-number-not-first`",
        &[refused("error[block-number-not-first]", "G0 N10 X1\nM2\n", "N10 G0 X1\nM2\n")],
    ),
    gap(
        "#cha:overview-of-g-code-programming",
        "A block number is what was written, leading zeros and all",
        "`run --output-format canonical` prints `N0080` for `N0080`, as the interpreter does (it prints `N80`; a program shipped with LinuxCNC shows it)",
        &[runs("N0080 G0 X1\nM2\n", &["N0080  STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#gcode:numbers",
        "A number has a sign or none, digits, and a point or none, with at least one digit",
        "grammar of numbers",
        &[
            runs(
                "G0 X-.5 Y+5. Z.5\nX007.50\nM2\n",
                &["STRAIGHT_TRAVERSE(-0.5000, 5.0000, 0.5000", "STRAIGHT_TRAVERSE(7.5000"],
            ),
            refused("error[missing-operand]", "G0 X-\nM2\n", "G0 X-1\nM2\n"),
            refused("error[address-without-value]", "G0 X.\nM2\n", "G0 X.1\nM2\n"),
            refused("error[malformed-number]", "G0 X1.2.3\nM2\n", "G0 X1.2\nM2\n"),
        ],
    ),
    held(
        "#gcode:numbers",
        "Numbers may be long; about 17 figures count",
        "numbers as doubles",
        &[runs("G0 X1.123456789012345678901\nM2\n", &["STRAIGHT_TRAVERSE(1.1235"])],
    ),
    held(
        "#gcode:numbers",
        "A point changes no value: X6. is X6",
        "`unpointed = \"as-written\"`",
        &[runs("G0 X5\nX6.\nM2\n", &["STRAIGHT_TRAVERSE(5.0000", "STRAIGHT_TRAVERSE(6.0000"])],
    ),
    held(
        "#gcode:numbers",
        "There are no exponents: E is a word",
        "rule `word-not-read`",
        &[refused("error[word-not-read]", "G0 X1e3\nM2\n", "G0 X1000\nM2\n")],
    ),
    held(
        "#gcode:numbers",
        "Two signs before a number are accepted (interpreter 2.9): the second belongs to the number",
        "rule `sign-given-twice`",
        &[
            runs("G0 X--5\nM2\n", &["STRAIGHT_TRAVERSE(5.0000"]),
            rule("warning[sign-given-twice]", "G21 G90 G0 X--5\nM2\n", "G21 G90 G0 X-5\nM2\n"),
        ],
    ),
    gap(
        "#gcode:numbers",
        "A number that is to be whole may be off by 0.0001: G1.00005 is G1, M2.00005 is M2",
        "`run` takes codes and parameter numbers that are within 0.0001 of a whole number (tenths for G) for it; `check` warns of the way of writing instead of an unknown code (error today)",
        &[
            runs("G1.00005 X1 F100\nM2\n", &["STRAIGHT_FEED(1.0000"]),
            runs("G0 X1\nM2.00005\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"]),
            runs("#1.00005=5\nG0 X#1\nM2\n", &["STRAIGHT_TRAVERSE(5.0000"]),
        ],
    ),
    held(
        "#gcode:numbers",
        "Beyond that it is refused",
        "rule `unknown-code`",
        &[refused("error[unknown-code]", "G1.001 X1 F100\nM2\n", "G1 X1 F100\nM2\n"), stops("M2.5\n")],
    ),
    held(
        "#gcode:comments",
        "Comments stand in parentheses, or follow a semicolon; a semicolon in parentheses is text",
        "`semicolon = \"comment\"`",
        &[runs(
            "G0 (Rapid to start) X1 Y1\nG0 X2 (don't; forget) Y2\nM2 ; End\n",
            &["STRAIGHT_TRAVERSE(1.0000, 1.0000", "STRAIGHT_TRAVERSE(2.0000, 2.0000"],
        )],
    ),
    held(
        "#gcode:comments",
        "A comment may stand between words, not between a letter and its number",
        "rule `address-without-value`",
        &[
            runs(
                "S100(set speed)F200(feed)\nM2\n",
                &["SET_FEED_RATE(200.0000", "SET_SPINDLE_SPEED(0, 100.0000)"],
            ),
            refused("error[address-without-value]", "S(speed)100F200\nM2\n", "S100(speed)F200\nM2\n"),
        ],
    ),
    held(
        "#gcode:comments",
        "A parenthesis that is not closed, nested, or closed without opening is refused (interpreter 2.9)",
        "rules `unclosed-comment`, `nested-comment`, `stray-parenthesis`",
        &[
            refused("error[unclosed-comment]", "G0 X1 (unclosed\nM2\n", "G0 X1 (closed)\nM2\n"),
            refused("error[nested-comment]", "G0 X1 (a (nested) b)\nM2\n", "G0 X1 (a) (b)\nM2\n"),
            refused("error[stray-parenthesis]", "G0 X1 )\nM2\n", "G0 X1\nM2\n"),
        ],
    ),
    gap(
        "#gcode:comments",
        "Of several comments on a line only the last acts: a plain one after (DEBUG, …) switches it off",
        "`check` says (info) that an active comment is followed by another comment and does nothing; for `(ABORT, …)` and probe logs it is a warning",
        &[
            rule("info[active-comment-without-effect]", "(DEBUG,#1)(foo)\nM2\n", "(foo)(DEBUG,#1)\nM2\n"),
            rule(
                "warning[active-comment-without-effect]",
                "G0 X1 (ABORT,tool broken)(why)\nM2\n",
                "G0 X1 (ABORT,tool broken)\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:messages",
        "(MSG, …) shows a message, also with blanks and small letters",
        "`message-comments` of `[semantics]`",
        &[
            runs("(MSG, hello)\n( m s g , hello)\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            Proof::Run {
                program: ngc("G21 G90\n(MSG, change the part)\nG0 X1\nM2\n"),
                prints: &["change the part"],
            },
        ],
    ),
    held(
        "#gcode:debug",
        "(DEBUG, …) and (PRINT, …) put the values of parameters in; a name that does not exist prints as #######",
        "`message-comments` of `[semantics]`",
        &[runs(
            "#1=5\n(DEBUG, value #1)\n(PRINT, #<nope>)\n(LOG, #2 %d#1 %.2f#1)\nG0 X1\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    held(
        "#gcode:logging",
        "(LOGOPEN, …), (LOGAPPEND, …), (LOG, …) and (LOGCLOSE) write a file; nothing moves",
        "comments",
        &[runs("(LOGOPEN,/dev/null)\n(LOG,#1)\n(LOGCLOSE)\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#cha:overview-of-g-code-programming",
        "(ABORT, …) shows a message and stops the program",
        "`message-comments`, rule `alarm-reached`",
        &[
            stops("G0 X1\n(ABORT,stop)\nG0 X2\nM2\n"),
            rule(
                "error[alarm-reached]",
                "G21 G90\nG0 X1\n(ABORT,stop)\nG0 X2\nM2\n",
                "G21 G90\nG0 X1\n(MSG,stop)\nG0 X2\nM2\n",
            ),
        ],
    ),
    unmodelled(
        "#gcode:comment-parameters",
        "%d, %f and %.xf format the values that follow",
        "messages are for people; their values are shown in full",
    ),
    held(
        "#gcode:best-practices",
        "Blanks before words and decimals enough are advice",
        "formatter, `house-style` rules",
        &[legal("G21 G90\nG0X1Y2\nG0 X1.5 Y2\nM2\n")],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
