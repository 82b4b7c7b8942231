//! Tool groups, their macro variables, and calling the next tool: pages 99, 100 and 106.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: how tools are
//! loaded, moved and recovered (pages 101–105, 107), and saving tables: work at the machine, which no program sees.

use super::mill::{explains, held, legal, moves, not_modelled, reports, rule, run, variables};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Tool management and tool changers",
    key: "TM",
    file: "haas_mill/tool_management.rs",
    statements: &[
        held(
            "p. 99",
            "A group of tools is called by its number in place of the tool's: in T beside M6, in H and in D.",
            "letters `T`, `H`, `D` and word `T` of `M6` take 1000 to 2999",
            &[
                legal(
                    "O1\nT1000 M6\nG54 G0 G90 X0. Y0.\nS1000 M3\nG43 H1000 Z.1\nG1 Z-1. F5.\nG41 D1000 X1.\nY1.\nG40 X0.\nG0 Z1.\nM30\n",
                ),
                run("O1\nT2000 M6\nM30\n", &["2 tool 5.000 T2000"]),
            ],
        ),
        held(
            "p. 97",
            "A group has a number from 1000 to 2999; a tool has one from 1 to 200.",
            "`gaps` of `T`",
            &[
                rule("error[number-out-of-range]", "O1\nT201 M6\nM30\n", "O1\nT200 M6\nM30\n"),
                rule("error[number-out-of-range]", "O1\nT999 M6\nM30\n", "O1\nT1000 M6\nM30\n"),
                rule("error[number-out-of-range]", "O1\nT3000 M6\nM30\n", "O1\nT2999 M6\nM30\n"),
            ],
        ),
        held(
            "p. 99",
            "#8001 to #8200 belong to tools 1 to 200: 1 makes the tool expire, 0 makes it available again.",
            "variables 8001–8200",
            &[
                legal("O1\n#8001=1\n#8200=0\n#100=#8100\nM30\n"),
                variables([8001, 8200], "makes the tool expire", "read-write"),
            ],
        ),
        held(
            "p. 99",
            "#8500 chooses a group; #8501 to #8515 then tell about it and cannot be written.",
            "variables 8500–8515, rule assignment-to-read-only-variable",
            &[
                legal("O1\n#8500=1000\n#100=#8501\n#101=#8515\nM30\n"),
                rule(
                    "error[assignment-to-read-only-variable]",
                    "O1\n#8501=50\nM30\n",
                    "O1\n#8500=1000\nM30\n",
                ),
                rule(
                    "error[assignment-to-read-only-variable]",
                    "O1\n#8510=5\nM30\n",
                    "O1\n#101=#8510\nM30\n",
                ),
            ],
        ),
        held(
            "p. 99",
            "#8550 chooses a tool, or a group and so its current tool; #8551 to #8564 then tell about it.",
            "variables 8550–8567",
            &[
                legal("O1\n#8550=5\n#100=#8551\n#8550=1000\n#101=#8564\nM30\n"),
                rule("error[assignment-to-read-only-variable]", "O1\n#8553=50\nM30\n", "O1\n#8550=5\nM30\n"),
            ],
        ),
        held(
            "p. 99",
            "Of single tools, #1601, #1801, #2001, #2201, #2401, #2601, #3201 and #3401 on tell about tools 1 to 200.",
            "variables 1601–2800, 3201–3600",
            &[
                legal(
                    "O1\n#100=#1601+#1800+#1801+#2000+#2001+#2200+#2201+#2400+#2401+#2600+#2601+#2800\n#101=#3201+#3400+#3401+#3600\nM30\n",
                ),
                variables([1601, 1800], "flutes of tools 1 to 200", "read-write"),
                variables([3401, 3600], "tools 1 to 200", "read-write"),
            ],
        ),
        held(
            "p. 99",
            "#5401, #5501, #5601, #5701, #5801 and #5901 on tell about tools 1 to 100.",
            "variables 5401–6000",
            &[
                legal("O1\n#100=#5401+#5500+#5501+#5600+#5601+#5701+#5800+#5801+#5900+#5901+#6000\nM30\n"),
                variables([5401, 5500], "tool feed timers", "read-write"),
                variables([5901, 6000], "load limit", "read-write"),
            ],
        ),
        not_modelled(
            "p. 106",
            "The control reads up to 80 lines ahead and turns the next tool into place when it finds its change.",
            "changes the time of a tool change only; how long a change takes is told by `machine.tool_change_seconds`",
        ),
        not_modelled(
            "p. 106",
            "Work offsets, G103 with P other than 0 or without P, M0, M1 and block delete stop reading ahead for the next tool.",
            "changes the time of a tool change only; where reading ahead changes what a macro reads, see the macro chapters",
        ),
        held(
            "p. 106",
            "T alone after a change gets the next tool ready; the tool in the spindle stays.",
            "effect of `M6`; system variable 3026",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nT1 M6\nT2\nX#3026\nM6\nX#3026\nM30\n",
                    &["rapid X1.", "rapid X2."],
                ),
                explains("M6", "`T` alone later on gets the next tool ready"),
            ],
        ),
        held(
            "p. 99",
            "Work is drilled with tools of a group as with any tool: the cycle goes on at each further position until G80.",
            "effects of `G83`, `G80`",
            &[reports(
                "O1\nT1000 M6\nG54 G0 G90 X0. Y0.\nS1000 M3\nG43 H1000 Z.1\nM8\nG83 Z-.6 F15. R.1 Q.2\nX1. Y-2.\nG80\nG0 Z1. M9\nG53 G49 Z0.\nM30\n",
                &[],
            )],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
