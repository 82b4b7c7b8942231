//! Probing: pages 165 to 170.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: lights and sounds
//! of the probes, batteries and wiring, templates of the visual programming system, the remote jog handle (pages 170–175).

use super::mill::{held, legal, not_modelled, reports, rule, run, variables};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Probing",
    key: "PRO",
    file: "haas_mill/probing.rs",
    statements: &[
        held(
            "p. 165, 166",
            "M59 P2 chooses the tool probe, M69 P2 the work probe; M59 P3 switches the chosen one on, M69 P3 off.",
            "effects of `M59`, `M69`",
            &[
                legal("O1\nM59 P2\nG4 P1.\nM59 P3\nG4 P1.\nM69 P3\nM69 P2\nM30\n"),
                rule("error[required-word-missing]", "O1\nM59\nM30\n", "O1\nM59 P3\nM30\n"),
                rule("error[number-out-of-range]", "O1\nM59 P12256\nM30\n", "O1\nM59 P255\nM30\n"),
            ],
        ),
        held(
            "p. 165",
            "G4 P1. waits for one second.",
            "effect of `G4`",
            &[run("O1\nM59 P2\nG4 P1.\nM59 P3\nM30\n", &["3 dwell 1.000"])],
        ),
        held(
            "p. 168",
            "#12002 and #12003 are the outputs that choose and enable the probe; programs read and write them.",
            "variables 12000–12255",
            &[
                variables([12002, 12003], "outputs", "read-write"),
                legal("O1\n#12002=1\n#12003=1\n#10003=#12003\nM30\n"),
            ],
        ),
        held(
            "p. 168",
            "M59 sets the variable of its output to 1, M69 to 0.",
            "`output-variables`",
            &[Proof::Moves {
                program: super::mill::mill(
                    "O1\nG20 G54 G0 G90\nM59 P3\n#10003=#12003\nX#10003\nM69 P3\nX[2.+#12003]\nM30\n",
                ),
                are: &["rapid X1.", "rapid X2."],
            }],
        ),
        not_modelled(
            "p. 165, 166",
            "RESET switches the probe off.",
            "a key of the operator; programs do not see it",
        ),
        held(
            "p. 167",
            "Probing is done by G65 with macros of the 9000s that are in the control.",
            "word `P` of `G65`; assumption about what they do",
            &[
                reports(
                    "O1\nT20 M6\nG20 G0 G90 G54 X0. Y0.\nG43 H20 Z6.\nG65 P9832\nG65 P9810 Z-.5 F100.\nG65 P9843 Y-.5 D.5 A15.\nG65 P9810 Z6. F100.\nG65 P9833\nG0 G90 G53 Z0.\nM1\nM30\n",
                    &[],
                ),
                super::mill::assumes("O1\nG65 P9832\nM30\n", "what program 9832 does is not known"),
            ],
        ),
        held(
            "p. 168",
            "What a probing macro measured is in a variable afterwards, and may turn the part's program: G68 R#189.",
            "variables that a called program may set are unknown after it, not unset",
            &[reports(
                "O1\nT2 M6\nG20 G54 G0 G90 X0. Y0.\nS500 M3\nG43 H2 Z1.5\nG65 P9843 Y-.5 D.5 A15.\nG90 G54 G0 X0. Y0.\nG43 H2 Z1.5\nG68 X0. Y0. R#189\nG1 X-2. F50.\nG69\nG0 Z1.5\nM30\n",
                &[],
            )],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
