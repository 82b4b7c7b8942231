//! Subroutines and numbered programs: `o-code.adoc`, numbering, subroutines, Fanuc-style programs, indirection, calling files,
//! return values.
//!
//! Knows: statements, programs. Must not know: how they are checked.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, legal, ngc, refused, rule, runs, runs_with, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Subroutines and numbered programs",
    key: "SUB",
    file: "linuxcnc/subroutines.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#cha:o-codes",
        "O-codes are written with the letter O, large or small",
        "grammar of O-words",
        &[
            runs("o100 sub\ng0 x1\nO100 endsub\nO100 Call\nm2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            refused("error[letter-o-for-zero]", "GO X1\nM2\n", "G0 X1\nM2\n"),
        ],
    ),
    held(
        "#ocode:subroutines",
        "Lines between sub and endsub run only when called",
        "O-word call",
        &[runs(
            "O100 SUB\nG0 X5\nO100 ENDSUB\nG0 X1\nO100 CALL\nO100 CALL\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(5.0000", "STRAIGHT_TRAVERSE(5.0000"],
        )],
    ),
    held(
        "#ocode:subroutines",
        "return ends the subroutine at once",
        "O-word return",
        &[runs(
            "O100 SUB\nG0 X1\nO110 IF [#1 GT 5]\nO100 RETURN\nO110 ENDIF\nG0 X2\nO100 ENDSUB\nO100 CALL [9]\nO100 CALL [1]\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000"],
        )],
    ),
    held(
        "#ocode:subroutines",
        "Up to 30 arguments in brackets are #1, #2 and so on",
        "O-word call",
        &[
            stops(
                "O100 SUB\nG0 X#30\nO100 ENDSUB\nO100 CALL [1] [2] [3] [4] [5] [6] [7] [8] [9] [10] [11] [12] [13] [14] [15] [16] [17] [18] [19] [20] [21] [22] [23] [24] [25] [26] [27] [28] [29] [30] [31]\nM2\n",
            ),
            runs(
                "O100 SUB\nG0 X#1 Y#2 Z#3\nO100 ENDSUB\nO100 CALL [100] [2] [1+1]\nM2\n",
                &["STRAIGHT_TRAVERSE(100.0000, 2.0000, 2.0000"],
            ),
            runs(
                "O100 SUB\nG0 X#30\nO100 ENDSUB\nO100 CALL [1] [2] [3] [4] [5] [6] [7] [8] [9] [10] [11] [12] [13] [14] [15] [16] [17] [18] [19] [20] [21] [22] [23] [24] [25] [26] [27] [28] [29] [30]\nM2\n",
                &["STRAIGHT_TRAVERSE(30.0000"],
            ),
        ],
    ),
    held(
        "#ocode:subroutines",
        "More than 30 arguments are refused",
        "rule `too-many-arguments`",
        &[refused(
            "error[too-many-arguments]",
            "O100 SUB\nG0 X#30\nO100 ENDSUB\nO100 CALL [1] [2] [3] [4] [5] [6] [7] [8] [9] [10] [11] [12] [13] [14] [15] [16] [17] [18] [19] [20] [21] [22] [23] [24] [25] [26] [27] [28] [29] [30] [31]\nM2\n",
            "O100 SUB\nG0 X#30\nO100 ENDSUB\nO100 CALL [1]\nM2\n",
        )],
    ),
    held(
        "#ocode:subroutines",
        "Arguments stand in brackets: 1 2 3 alone would be 123",
        "rule `value-without-address`",
        &[refused(
            "error[value-without-address]",
            "O100 SUB\nG0 X#1\nO100 ENDSUB\nO100 CALL 1 2 3\nM2\n",
            "O100 SUB\nG0 X#1\nO100 ENDSUB\nO100 CALL [1]\nM2\n",
        )],
    ),
    held(
        "#ocode:subroutines",
        "Parameters beyond the arguments, up to #30, keep the caller's values, says the documentation; in the interpreter (2.9) they are 0",
        "`locals = [1, 30]`",
        &[runs(
            "#2=8 #30=9\nO100 SUB\nG0 X#1 Y#2 Z#30\nO100 ENDSUB\nO100 CALL [1]\nM2\n",
            &["STRAIGHT_TRAVERSE("],
        )],
    ),
    held(
        "#ocode:subroutines",
        "On return #1 to #30 are as before the call",
        "`locals = [1, 30]`",
        &[runs(
            "O100 SUB\n#1=7 #31=9\nO100 ENDSUB\n#1=3\nO100 CALL [5]\nG0 X#1 Y#31\nM2\n",
            &["STRAIGHT_TRAVERSE(3.0000, 9.0000"],
        )],
    ),
    held(
        "#ocode:subroutines",
        "Parameters above #30 and global names are seen by the caller",
        "`locals = [1, 30]`",
        &[runs(
            "O100 SUB\n#100=4\n#<_g>=5\nO100 ENDSUB\nO100 CALL\nG0 X#100 Y#<_g>\nM2\n",
            &["STRAIGHT_TRAVERSE(4.0000, 5.0000"],
        )],
    ),
    held(
        "#ocode:subroutines",
        "A subroutine may not be defined in another",
        "rule `subroutine-inside-subroutine`",
        &[refused(
            "error[subroutine-inside-subroutine]",
            "O100 SUB\nO101 SUB\nG0 X1\nO101 ENDSUB\nO100 ENDSUB\nO100 CALL\nM2\n",
            "O100 SUB\nO101 CALL\nO100 ENDSUB\nO101 SUB\nG0 X1\nO101 ENDSUB\nO100 CALL\nM2\n",
        )],
    ),
    held(
        "#ocode:subroutines",
        "A subroutine may call others, and itself",
        "O-word call",
        &[
            runs(
                "O<outer> SUB\nO<helper> CALL [1] [2]\nO<outer> ENDSUB\nO<helper> SUB\nG0 X#2\nO<helper> ENDSUB\nO<outer> CALL\nM2\n",
                &["STRAIGHT_TRAVERSE(2.0000"],
            ),
            runs(
                "O100 SUB\nG0 X#1\nO101 IF [#1 GT 0]\nO100 CALL [#1-1]\nO101 ENDIF\nO100 ENDSUB\nO100 CALL [3]\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(3.0000",
                    "STRAIGHT_TRAVERSE(2.0000",
                    "STRAIGHT_TRAVERSE(1.0000",
                    "STRAIGHT_TRAVERSE(0.0000",
                ],
            ),
        ],
    ),
    held(
        "#ocode:subroutines",
        "Calls nest 10 deep, says the documentation; the interpreter (2.9) takes 9, one inside the other",
        "`call-depth = 9`, rule `calls-nested-too-deep`",
        &[refused(
            "error[calls-nested-too-deep]",
            "O100 SUB\nG0 X#1\nO101 IF [#1 GT 0]\nO100 CALL [#1-1]\nO101 ENDIF\nO100 ENDSUB\nO100 CALL [9]\nM2\n",
            "O100 SUB\nG0 X#1\nO101 IF [#1 GT 0]\nO100 CALL [#1-1]\nO101 ENDIF\nO100 ENDSUB\nO100 CALL [8]\nM2\n",
        )],
    ),
    gap(
        "#ocode:subroutines",
        "A subroutine may be called only after it is defined; the interpreter (2.9) runs it when called from before and then refuses the definition that it comes to",
        "`run` and `check` refuse a definition that was run before it was passed (error)",
        &[
            stops("O100 CALL\nO100 SUB\nG0 X1\nO100 ENDSUB\nM2\n"),
            refused(
                "error[o-word-unmatched]",
                "G21 G90\nO100 CALL\nO100 SUB\nG0 X1\nO100 ENDSUB\nM2\n",
                "G21 G90\nO100 SUB\nG0 X1\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
        ],
    ),
    gap(
        "#ocode:numbering",
        "Each subroutine has a number or name of its own",
        "an error: the second definition of a subroutine is refused (a warning today, and `run` takes the first)",
        &[refused(
            "error[o-word-label-reused]",
            "O100 SUB\nG0 X1\nO100 ENDSUB\nO100 SUB\nG0 X2\nO100 ENDSUB\nO100 CALL\nM2\n",
            "O100 SUB\nG0 X1\nO100 ENDSUB\nO101 SUB\nG0 X2\nO101 ENDSUB\nO100 CALL\nM2\n",
        )],
    ),
    held(
        "#ocode:numbering",
        "Numbers of if, while and the like count within one subroutine",
        "outline of labels by program",
        &[
            runs(
                "O100 SUB\nO101 IF [#1 GT 0]\nG0 X1\nO101 ENDIF\nO100 ENDSUB\n#5=1\nO101 IF [#5 GT 0]\nG0 Y1\nO101 ENDIF\nO100 CALL [1]\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 1.0000", "STRAIGHT_TRAVERSE(1.0000, 1.0000"],
            ),
            legal(
                "G21 G90\nO100 SUB\nO101 IF [#1 GT 0]\nG0 X1\nO101 ENDIF\nO100 ENDSUB\n#5=1\nO101 IF [#5 GT 0]\nG0 Y1\nO101 ENDIF\nO100 CALL [1]\nM2\n",
            ),
        ],
    ),
    gap(
        "#ocode:numbering",
        "Within one subroutine, or the main program, each number names one block",
        "an error: a second if of one number is refused by the interpreter (2.9); a warning today, and `run` goes on",
        &[refused(
            "error[o-word-label-reused]",
            "G21 G90\n#5=1\nO100 IF [#5 GT 0]\nG0 X1\nO100 ENDIF\nO100 IF [#5 GT 0]\nG0 X2\nO100 ENDIF\nM2\n",
            "G21 G90\n#5=1\nO100 IF [#5 GT 0]\nG0 X1\nO100 ENDIF\nO101 IF [#5 GT 0]\nG0 X2\nO101 ENDIF\nM2\n",
        )],
    ),
    held(
        "#ocode:comments",
        "Comments behind O-words are accepted (interpreter 2.9); the documentation warns of them",
        "grammar of O-words",
        &[runs(
            "#5=1\nO100 IF [#5 GT 0] (comment)\nG0 X1\nO100 ENDIF (comment)\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    held(
        "#ocode:comments",
        "Other words in the block of an O-word are undefined; the interpreter (2.9) refuses them",
        "rule `words-beside-o-word`",
        &[
            refused(
                "error[words-beside-o-word]",
                "#5=1\nO100 IF [#5] G0 X1\nO100 ENDIF\nM2\n",
                "#5=1\nO100 IF [#5]\nG0 X1\nO100 ENDIF\nM2\n",
            ),
            refused(
                "error[words-beside-o-word]",
                "O100 SUB\nO100 ENDSUB\nO100 CALL G0 X1\nM2\n",
                "O100 SUB\nO100 ENDSUB\nO100 CALL\nG0 X1\nM2\n",
            ),
            refused(
                "error[words-beside-o-word]",
                "O100 SUB\nO100 ENDSUB\nG0 X1 O100 CALL\nM2\n",
                "O100 SUB\nO100 ENDSUB\nG0 X1\nO100 CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "M98 P calls the program that begins with O of that number and ends with M99",
        "effects `call-program`, `return`",
        &[
            runs("M98 P100\nM30\nO100\nG0 X1\nM99\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"]),
            runs(
                "O1 (TITLE)\nM98 P100\nM30\nO100\nG0 X1\nM99\n",
                &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"],
            ),
            legal("O1 (TITLE)\nG21 G90\nM98 P100\nM30\nO100\nG0 X1\nM99\n"),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "L is how often it runs: once without it, not at all for 0",
        "`call-repeats = \"L\"`, `zero-repeats-skip = true`",
        &[
            runs(
                "M98 P100 L3\nM2\nO100\nG91 G0 X1\nM99\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000", "STRAIGHT_TRAVERSE(3.0000"],
            ),
            Proof::Moves {
                program: ngc("G21 G90\nM98 P100 L0\nG0 Y1\nM2\nO100\nG91 G0 X1\nM99\n"),
                are: &["rapid X0. Y1."],
            },
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "#1 to #30 are shared with the program that M98 calls",
        "`locals-per-subprogram = false`",
        &[runs(
            "#1=0\nM98 P100 L5\nG0 X#1\nM30\nO100\n#1=[#1+1]\nM98 P200 L5\nM99\nO200\n#1=[#1+0.01]\nM99\n",
            &["STRAIGHT_TRAVERSE(5.2500"],
        )],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "M98 needs a whole P; L is not negative",
        "words of `M98`",
        &[
            refused("error[required-word-missing]", "M98 L2\nM2\n", "M98 P100\nM2\nO100\nM99\n"),
            refused("error[sign-not-accepted]", "M98 P100 L-1\nM2\nO100\nM99\n", "M98 P100\nM2\nO100\nM99\n"),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "P and L of M98 must be whole",
        "`whole` of `P` and `L`",
        &[
            refused("error[number-out-of-range]", "M98 P100.5\nM2\nO100\nM99\n", "M98 P100\nM2\nO100\nM99\n"),
            refused(
                "error[number-out-of-range]",
                "M98 P100 L1.5\nM2\nO100\nM99\n",
                "M98 P100 L1\nM2\nO100\nM99\n",
            ),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "A program that M98 does not find is refused",
        "rule `subprogram-missing`",
        &[
            stops("M98 P1\nM2\n"),
            rule("warning[subprogram-missing]", "M98 P1\nM2\n", "M98 P1\nM2\nO1\nM99\n"),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "The program must follow the call; the interpreter (2.9) runs one in front of it as the beginning of the main program",
        "effect `call-program`, rule `unreachable-block`",
        &[
            runs("O100\nG0 X1\nM99\nM98 P100\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "PROGRAM_END"]),
            rule(
                "warning[unreachable-block]",
                "O100\nG0 X1\nM99\nM98 P100\nM2\n",
                "M98 P100\nM2\nO100\nG0 X1\nM99\n",
            ),
        ],
    ),
    gap(
        "#ocode:fanuc-style-programs",
        "The two styles do not mix: M98 of a sub and call of a numbered program are refused",
        "`check` reports both (errors), as `run` refuses them; M99 inside sub and endsub is refused by both",
        &[
            refused(
                "error[o-word-unmatched]",
                "O100 SUB\nG0 X1\nO100 ENDSUB\nM98 P100\nM2\n",
                "O100 SUB\nG0 X1\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 CALL\nM2\nO100\nG0 X1\nM99\n",
                "M98 P100\nM2\nO100\nG0 X1\nM99\n",
            ),
            refused(
                "error[o-word-unmatched]",
                "O100 SUB\nG0 X1\nM99\nO100 ENDSUB\nO100 CALL\nM2\n",
                "O100 SUB\nG0 X1\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "M99 in the main program begins it again; a run makes one pass, and M30 behind a slash ends it",
        "effect `return`",
        &[
            runs("G0 X1\nM99\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            runs("G0 X1\n/M30\nM99\n", &["STRAIGHT_TRAVERSE(1.0000"]),
        ],
    ),
    gap(
        "#ocode:fanuc-style-programs",
        "`DISABLE_FANUC_STYLE_SUB = 1` takes M98, M99 and numbered programs away",
        "`settings.DISABLE_FANUC_STYLE_SUB=1` makes `run` and `check` refuse M98 (it changes nothing today, though the data lists it)",
        &[Proof::RunRefused {
            program: ngc("M98 P100\nM2\nO100\nG0 X1\nM99\n")
                .with(&["settings.DISABLE_FANUC_STYLE_SUB=1"])
                .beside(&[("machine.ini", "[RS274NGC]\nDISABLE_FANUC_STYLE_SUB=1\n")]),
        }],
    ),
    held(
        "#ocode:fanuc-style-programs",
        "M98 in a block with a move: the call comes first (interpreter 2.9)",
        "`first-only`, phase `call`",
        &[runs("M98 P100 G0 X1\nM2\nO100\nG0 Y1\nM99\n", &["STRAIGHT_TRAVERSE("])],
    ),
    held(
        "#ocode:indirection",
        "The number of an O-word may be a parameter or an expression",
        "O-word call by value",
        &[
            runs(
                "O103 SUB\nG0 X1\nO103 ENDSUB\n#101=101\nO[#101+2] CALL\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000"],
            ),
            stops("O#1 CALL\nM2\n"),
        ],
    ),
    gap(
        "#ocode:numbering",
        "The number of an O-word must be whole (interpreter 2.9)",
        "`check` reports it (error), as `run` refuses it",
        &[refused(
            "error[o-word-unmatched]",
            "#5=1\nO100.5 IF [#5]\nO100.5 ENDIF\nM2\n",
            "#5=1\nO100 IF [#5]\nO100 ENDIF\nM2\n",
        )],
    ),
    held(
        "#ocode:calling-files",
        "A subroutine that is not in the file is looked for in a file of its name, in the folder of programs and those of `SUBROUTINE_PATH`",
        "`search.paths` of the configuration",
        &[
            runs_with(
                ngc("O<mine> CALL [3]\nM2\n").with(&["search.paths=[\"subs\"]"]).beside(&[
                    ("subs/mine.ngc", "O<mine> SUB\nG0 X#1\nO<mine> ENDSUB\nM2\n"),
                    ("machine.ini", "[RS274NGC]\nSUBROUTINE_PATH=subs\n"),
                ]),
                &["STRAIGHT_TRAVERSE(3.0000"],
            ),
            runs_with(
                ngc("O123 CALL\nM2\n").with(&["search.paths=[\"subs\"]"]).beside(&[
                    ("subs/123.ngc", "O123 SUB\nG0 X7\nO123 ENDSUB\nM2\n"),
                    ("machine.ini", "[RS274NGC]\nSUBROUTINE_PATH=subs\n"),
                ]),
                &["STRAIGHT_TRAVERSE(7.0000"],
            ),
        ],
    ),
    held(
        "#ocode:calling-files",
        "A file that is not found is refused",
        "rule `o-word-subroutine-missing`",
        &[
            stops("O<mine> CALL\nM2\n"),
            rule(
                "info[o-word-subroutine-missing]",
                "G21 G90\nO<mine> CALL\nM2\n",
                "G21 G90\nO<mine> SUB\nO<mine> ENDSUB\nO<mine> CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#ocode:calling-files",
        "Names are read in small letters and without blanks",
        "grammar of O-words",
        &[runs(
            "O<MyFile> SUB\nG0 X1\nO<MYFILE> ENDSUB\nO<my file> CALL\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    gap(
        "#ocode:calling-files",
        "A file of a named subroutine holds that subroutine alone",
        "`check` warns of a numbered subroutine in the file of a named one: numbers are shared by all files",
        &[Proof::Rule {
            finding: "warning[o-word-label-reused]",
            violates: ngc("O<mine> SUB\nO100 CALL\nO<mine> ENDSUB\nO100 SUB\nG0 X1\nO100 ENDSUB\nM2\n"),
            conforms: ngc("O<mine> SUB\nG0 X1\nO<mine> ENDSUB\nM2\n"),
        }],
    ),
    held(
        "#ocode:calling-files",
        "A named program without keyword (`O<abc>` alone) is read and does nothing (interpreter 2.9)",
        "rule `o-word-without-keyword`",
        &[rule(
            "warning[o-word-without-keyword]",
            "O<abc>\nG0 X1\nM2\n",
            "O<abc> SUB\nG0 X1\nO<abc> ENDSUB\nO<abc> CALL\nM2\n",
        )],
    ),
    gap(
        "#ocode:calling-files",
        "A line with the name of a program alone is accepted",
        "`run` passes over `O<abc>` alone, as the interpreter (2.9) does; it refuses the block today",
        &[runs("O<abc>\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#cha:o-codes",
        "endsub and return may give a value: #<_value>, and #<_value_returned> is 1",
        "system variables `_value`",
        &[
            runs(
                "O123 SUB\nO123 ENDSUB [3*4]\nO123 CALL\nG0 X#<_value> Y#<_value_returned>\nM2\n",
                &["STRAIGHT_TRAVERSE(12.0000, 1.0000"],
            ),
            runs(
                "O123 SUB\nO123 RETURN [5*2]\nO123 ENDSUB [3*4]\nO123 CALL\nG0 X#<_value>\nM2\n",
                &["STRAIGHT_TRAVERSE(10.0000"],
            ),
        ],
    ),
    held(
        "#cha:o-codes",
        "Both are cleared by the next call",
        "system variables `_value`",
        &[
            runs(
                "O123 SUB\nO123 ENDSUB [3*4]\nO124 SUB\nO124 ENDSUB\nO123 CALL\nO124 CALL\nG0 X#<_value> Y#<_value_returned>\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000"],
            ),
            runs("G0 X#<_value> Y#<_value_returned>\nM2\n", &["STRAIGHT_TRAVERSE(0.0000, 0.0000"]),
        ],
    ),
    unmodelled(
        "#ocode:calling-files",
        "At most 10 folders in `SUBROUTINE_PATH`, the first file that fits counts",
        "`search.paths` takes any number of folders in their order",
    ),
    gap(
        "#sub:ini:sec:rs274ngc",
        "`OWORD_NARGS = 1` gives #<n_args>, the number of arguments",
        "`settings.OWORD_NARGS=1`, and then `#<n_args>` in subroutines",
        &[runs_with(
            ngc("O100 SUB\nG0 X#<n_args>\nO100 ENDSUB\nO100 CALL [1] [2]\nM2\n")
                .with(&["settings.OWORD_NARGS=1"])
                .beside(&[("machine.ini", "[RS274NGC]\nOWORD_NARGS=1\n")]),
            &["STRAIGHT_TRAVERSE(2.0000"],
        )],
    ),
    unmodelled(
        "#sub:ini:sec:rs274ngc",
        "`OWORD_WARNONLY = 1` makes mistakes of O-words warnings",
        "what the program then does is not said; `gcheck` keeps reporting them",
    ),
    held(
        "#ocode:fanuc-style-programs",
        "M99 P is not read on this control",
        "words of `M99`",
        &[explains("M99", "M99")],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
