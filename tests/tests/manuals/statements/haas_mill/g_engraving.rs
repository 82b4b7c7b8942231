//! G47 (p. 271 to 275): the sentences of these pages and what proves them.
//!
//! Left out: keys that enter characters, the screen of macro variables, tables of characters beyond their range.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{explains, held, not_modelled};
use crate::proof::Proof::{Legal, Rule, Run, Stats};
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "G codes: engraving",
    key: "ENG",
    file: "haas_mill/g_engraving.rs",
    statements: &[
        held(
            "p. 271",
            "With Setting 29 or 73 on G47 cannot be used.",
            "`refused-with` of `G47`",
            &[
                Rule {
                    finding: "warning[code-refused-by-setting]",
                    violates: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n")
                        .with(&["settings.29=true"]),
                    conforms: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n")
                        .with(&["settings.29=false"]),
                },
                Rule {
                    finding: "warning[code-refused-by-setting]",
                    violates: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n")
                        .with(&["settings.73=true"]),
                    conforms: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n")
                        .with(&["settings.73=false"]),
                },
            ],
        ),
        held(
            "p. 271",
            "P0 engraves the text of the comment in the block.",
            "word `P` of `G47`",
            &[
                Legal { program: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n") },
                explains("G47", "`P0` the text in the comment of the block"),
            ],
        ),
        held(
            "p. 271",
            "P0 without a comment has nothing to engrave.",
            "`reads-comment` of `G47`",
            &[Rule {
                finding: "warning[comment-missing]",
                violates: cut!("G47 P0 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                conforms: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
            }],
        ),
        held(
            "p. 271",
            "P is required.",
            "need of `P`",
            &[Rule {
                finding: "warning[required-word-missing]",
                violates: cut!("G47 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                conforms: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
            }],
        ),
        held(
            "p. 271, p. 273",
            "P1 engraves a serial number, P32 to P126 one character; the highest is 126.",
            "range of `P`",
            &[
                Legal { program: cut!("G47 P1 (####) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n") },
                Legal { program: cut!("G47 P32 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n") },
                Rule {
                    finding: "error[number-out-of-range]",
                    violates: cut!("G47 P127 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                    conforms: cut!("G47 P126 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                },
            ],
        ),
        held(
            "p. 271, p. 273",
            "P2 to P31 are no characters.",
            "word `P` of `G47`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G47 P31 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                conforms: cut!("G47 P32 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
            }],
        ),
        held(
            "p. 271",
            "E, I, J, R, X, Y and Z are optional.",
            "needs of the words of `G47`",
            &[
                Legal { program: cut!("G47 P0 (AB) F15.\nG0 Z1.\n") },
                Legal { program: cut!("G47 P1 (0001) F15.\nG0 Z1.\n") },
            ],
        ),
        held(
            "p. 271",
            "I, the angle, is -360 to 360 degrees.",
            "range of `I`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G47 P0 (AB) I361. X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                conforms: cut!("G47 P0 (AB) I-360. X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
            }],
        ),
        held(
            "p. 271",
            "Without I the text is not turned, without J it is 1 inch high.",
            "defaults of the words",
            &[explains("G47", "optional, else 0"), explains("G47", "optional, else 1 inch")],
        ),
        held(
            "p. 271",
            "Letters are at least 0.001 inch high.",
            "range of `J`",
            &[Rule {
                finding: "error[number-out-of-range]",
                violates: cut!("G47 P0 (AB) X2. Y2. J.0005 R0.05 Z-0.005 F15.\nG0 Z1.\n"),
                conforms: cut!("G47 P0 (AB) X2. Y2. J.001 R0.05 Z-0.005 F15.\nG0 Z1.\n"),
            }],
        ),
        held(
            "p. 271",
            "F is the feed of engraving: it is programmed.",
            "effect `engrave`; rule `feed-missing`",
            &[Rule {
                finding: "error[feed-missing]",
                violates: cut!("G47 P0 (AB) X2. Y2. J.5 R0.05 Z-0.005\nG0 Z1.\n"),
                conforms: cut!("G47 P0 (AB) X2. Y2. J.5 R0.05 Z-0.005 F15.\nG0 Z1.\n"),
            }],
        ),
        held(
            "p. 273",
            "Engraving goes to X Y, plunges to Z at feed E, cuts at feed F, and goes back to R.",
            "effect `engrave`: the levels; the letters are an assumption",
            &[
                Run {
                    program: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                    prints: &["rapid 2.0000 2.0000", "feed 2.0000 2.0000 -0.0050 10", "0.0500"],
                },
                Stats {
                    program: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"),
                    prints: &["T1 cutting", "-0.0050"],
                },
            ],
        ),
        held(
            "p. 273",
            "After engraving the tool stands at R, somewhere along the text.",
            "effect `engrave`",
            &[Run {
                program: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nX3.\n"),
                prints: &["rapid 3.0000 ? 0.0500"],
            }],
        ),
        held(
            "p. 271",
            "G47 acts in its own block.",
            "group `one-shot`",
            &[Run {
                program: cut!("G47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nX3. Y0.\n"),
                prints: &["rapid 3.0000 0.0000"],
            }],
        ),
        not_modelled(
            "p. 271, p. 273",
            "The characters 32 to 126 can be engraved; text along an arc cannot.",
            "the shapes of the characters are the control's own",
        ),
        not_modelled(
            "p. 274",
            "P1 counts the serial number up with each part; with digits in the comment it only sets the number.",
            "the number lives in the control from part to part; a run cannot tell which part it is",
        ),
        held(
            "p. 275",
            "The serial number is #599, which a program may set back.",
            "common variables",
            &[Legal {
                program: cut!(
                    "G47 P1 (####) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\n#599=[#599-1]\nG47 P1 (####) X3. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"
                ),
            }],
        ),
        held(
            "p. 274",
            "One character by its number is a block of its own, the text after it another.",
            "word `P` of `G47`",
            &[Legal {
                program: cut!(
                    "G47 P36 X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG47 P0 (2.00) X2.5 Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 Z1.\n"
                ),
            }],
        ),
        held(
            "p. 275",
            "G47 may be wrapped around a cylinder by G107.",
            "effects `engrave`, `cylinder-mapping`",
            &[Legal {
                program: cut!(
                    "G107 Y0. A0. R1.\nG47 P1 (####) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG107\nG0 Z1.\n"
                ),
            }],
        ),
        held(
            "p. 271",
            "G187 E before the text sharpens its corners; G187 alone brings the usual rounding back.",
            "no effect of `G187`",
            &[Legal {
                program: cut!(
                    "G187 E.002\nG47 P0 (AB) X2. Y2. J0.5 R0.05 Z-0.005 F15. E10.\nG0 G80 Z.1\nG187\n"
                ),
            }],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
