//! G65 and aliases: pages 232 to 234.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: how aliases are
//! entered on the screen.

use super::mill::{gap, held, legal, mill, moves, not_modelled, reports, rule};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

const ALIAS_G: &[&str] = &["codes.G6={alias=\"O9010\"}"];
const ALIAS_M: &[&str] = &["codes.M15={alias=\"O9000\"}"];
/// A program that calls nothing.
const PLAIN: &str = "O1\nG20 G54 G0 G90\nM30\n";

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Macros: G65 and aliases",
    key: "CALL",
    file: "haas_mill/macro_calls.rs",
    statements: &[
        held(
            "p. 232",
            "G65 P calls the program of that number with its words as arguments; M99 returns.",
            "effect of `G65`",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nG65 P1000 A1. B2.\nX9.\nM30\nO01000\nX#1 Y#2\nM99\n",
                    &["rapid X1. Y2.", "rapid X9."],
                ),
                legal("O1\nG65 P1000\nM30\nO01000\nG4 P1.\nM99\n"),
            ],
        ),
        held(
            "p. 232",
            "G65 needs P, or a path.",
            "word `P` of `G65`; rule `required-word-missing`",
            &[rule(
                "error[required-word-missing]",
                "O1\nG65 A1.\nM30\n",
                "O1\nG65 P2 A1.\nM30\nO2\n#100=#1\nM99\n",
            )],
        ),
        held(
            "p. 232",
            "L repeats the call.",
            "word `L` of `G65`",
            &[moves(
                "O1\nG20 G54 G0 G90 X0.\nG65 P2 L3\nX9.\nM30\nO2\nG91 X1.\nG90\nM99\n",
                &["rapid X0.", "rapid X1.", "rapid X2.", "rapid X3.", "rapid X9."],
            )],
        ),
        held(
            "p. 232",
            "The program is looked for beside the main program, then where settings 251 and 252 say.",
            "search of called programs",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90\nG65 P9100 A1.\nX9.\nM30\n")
                        .beside(&[("O9100.nc", "%\nO9100\nX#1\nM99\n%\n")]),
                    are: &["rapid X1.", "rapid X9."],
                },
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90\nG65 P9100 A1.\nM30\n")
                        .with(&["search.paths=[\"macros\"]"])
                        .beside(&[("macros/O9100.nc", "%\nO9100\nX#1\nM99\n%\n")]),
                    are: &["rapid X1."],
                },
            ],
        ),
        held(
            "p. 232",
            "A program that is found nowhere raises an alarm.",
            "rule subprogram-missing; macros of the 9000s may well be in the control",
            &[
                rule(
                    "warning[subprogram-missing]",
                    "O1\nG65 P1000 A1.\nM30\n",
                    "O1\nG65 P1000 A1.\nM30\nO1000\n#100=#1\nM99\n",
                ),
                rule(
                    "warning[subprogram-missing]",
                    "O1\nG65 P1000 A1.\nM30\n",
                    "O1\nG65 P9810 Z1. F100.\nM30\n",
                ),
            ],
        ),
        held(
            "p. 232",
            "G65 calls nest nine deep.",
            "limit `call-depth`, rule calls-nested-too-deep",
            &[rule(
                "error[calls-nested-too-deep]",
                "O1\nG65 P2\nM30\nO2\nG65 P3\nM99\nO3\nG65 P4\nM99\nO4\nG65 P5\nM99\nO5\nG65 P6\nM99\nO6\nG65 P7\nM99\nO7\nG65 P8\nM99\nO8\nG65 P9\nM99\nO9\nG65 P10\nM99\nO10\nG65 P11\nM99\nO11\nM99\n",
                "O1\nG65 P2\nM30\nO2\nG65 P3\nM99\nO3\nG65 P4\nM99\nO4\nG65 P5\nM99\nO5\nG65 P6\nM99\nO6\nG65 P7\nM99\nO7\nG65 P8\nM99\nO8\nG65 P9\nM99\nO9\nG65 P10\nM99\nO10\nM99\n",
            )],
        ),
        gap(
            "p. 232",
            "G65 may name a path in parentheses in place of P, with arguments after it; paths tell capitals from small letters.",
            "the file is looked for by its path, in the folder of the program and in `search.paths`, and executed; one that is not there is reported",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90\nG65 (Part.nc) A1. B2.\nX9.\nM30\n")
                        .beside(&[("Part.nc", "%\nO5\nX#1 Y#2\nM99\n%\n")]),
                    are: &["rapid X1. Y2.", "rapid X9."],
                },
                rule(
                    "warning[subprogram-missing]",
                    "O1\nG65 (Part.nc) A1.\nM30\n",
                    "O1\nG65 P2 A1.\nM30\nO2\n#100=#1\nM99\n",
                ),
            ],
        ),
        held(
            "p. 233",
            "A macro may use F, Z and other arguments in its own words, and moves from where the tool is.",
            "computed words, loops",
            &[moves(
                "O1\nG20 G90 G54 G0 X1. Y1. Z.05\nG65 P9010 X.5 Y.25 Z.05 F10. T2\nM30\nO09010\nF#9\nWHILE [#20 GT 0] DO1\nG91 G81 Z-[#26+.05] R0.\n#20=#20-1\nIF [#20 EQ 0] GOTO5\nG0 X#24 Y#25\nN5 END1\nG90\nM99\n",
                &[
                    "rapid",
                    "feed X1. Y1. Z-.05 F10.",
                    "rapid Z.05",
                    "rapid X1.5 Y1.25",
                    "feed X1.5 Y1.25 Z-.05",
                    "rapid Z.05",
                ],
            )],
        ),
        held(
            "p. 233",
            "In G91 the Z of a cycle is a distance, and R may be left out.",
            "need of `R` in canned cycles",
            &[reports(
                "O1\nG20 G90 G54 G0 X1. Y1. Z.05\nS1000 M3\nG65 P9010 X.5 Y.25 Z-.05 F10. T3\nM30\nO09010\nF#9\nWHILE [#20 GT 0] DO1\nG91 G81 Z#26\n#20=#20-1\nIF [#20 EQ 0] GOTO5\nG0 X#24 Y#25\nN5 END1\nM99\n",
                &[],
            )],
        ),
        held(
            "p. 233",
            "A G code may stand for G65 with a macro: its words are the arguments.",
            "`codes.G…` of the configuration with `alias`",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90\nG6 X.5 Y.25\nM30\nO9010\nG0 X#24 Y#25\nM99\n")
                        .with(ALIAS_G),
                    are: &["rapid X.5 Y.25"],
                },
                Proof::Rule {
                    finding: "error[unknown-code]",
                    violates: mill("O1\nG20 G54 G0 G90\nG6 X.5 Y.25\nM30\n"),
                    conforms: mill("O1\nG20 G54 G0 G90\nG6 X.5 Y.25\nM30\nO9010\nG0 X#24 Y#25\nM99\n")
                        .with(ALIAS_G),
                },
            ],
        ),
        held(
            "p. 213, 233",
            "An M code may stand for a macro.",
            "`codes.M…` of the configuration with `alias`",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 X0.\nM15\nX9.\nM30\nO9000\nX1.\nM99\n").with(ALIAS_M),
                are: &["rapid X0.", "rapid X1.", "rapid X9."],
            }],
        ),
        gap(
            "p. 213, 233",
            "Words do not pass to a macro that an M code calls: #1 to #33 are not set by them.",
            "the words of the block are the block's own (an X moves), and #24 stays unset in the macro",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 X0. Y0.\nM15 X5.\nM30\nO9000\nX1. Y#24\nM99\n")
                    .with(ALIAS_M),
                are: &["rapid X0. Y0.", "rapid X5. Y0.", "rapid X1. Y0."],
            }],
        ),
        gap(
            "p. 213",
            "A macro that an M code calls takes its values from #4101 to #4126.",
            "#4124 and the others of axes are known in the macro (see the table of variables)",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 X3. Y0.\nM15\nM30\nO9000\nY#4124\nM99\n").with(ALIAS_M),
                are: &["rapid X3. Y0.", "rapid Y3."],
            }],
        ),
        held(
            "p. 234",
            "G0, G65, G66 and G67 cannot be aliased; other codes from 1 to 255 can, to O9010 to O9019 for G and O9000 to O9009 for M codes.",
            "the configuration: `alias` of a code",
            &[
                Proof::Refuses {
                    program: mill(PLAIN).with(&["codes.G65={alias=\"O9010\"}"]),
                    says: "haas-mill does not let `G65` call a program of your own",
                },
                Proof::Refuses {
                    program: mill(PLAIN).with(&["codes.G256={alias=\"O9010\"}"]),
                    says: "haas-mill lets codes up to 255 call programs, not `G256`",
                },
                Proof::Accepts { program: mill(PLAIN).with(ALIAS_G) },
                Proof::Open {
                    says: "an alias of a G code to another program than O9010 to O9019 is refused",
                    demand: &Proof::Refuses {
                        program: mill(PLAIN).with(&["codes.G6={alias=\"O9020\"}"]),
                        says: "O9020",
                    },
                },
            ],
        ),
        gap(
            "p. 234",
            "An alias whose program is not there raises an alarm.",
            "as for G65: said where the program of a configured alias is not found; now an assumption only",
            &[Proof::Rule {
                finding: "warning[subprogram-missing]",
                violates: mill("O1\nG20 G54 G0 G90\nG6 X.5\nM30\n").with(ALIAS_G),
                conforms: mill("O1\nG20 G54 G0 G90\nG6 X.5\nM30\nO9010\nG0 X#24\nM99\n").with(ALIAS_G),
            }],
        ),
        not_modelled(
            "p. 234",
            "The value 0 switches an alias off.",
            "an alias that is off is left out of the configuration",
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
