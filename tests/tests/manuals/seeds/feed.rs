//! Feed modes, dwell and helices: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use std::fmt::Write as _;

use crate::proof::{Program, Proof, legal, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

/// A milling control of which the page is all that is known.
const fn mill(text: &'static str) -> Program {
    on("generic-mill", text)
}

const fn haas(text: &'static str) -> Program {
    on("haas-mill", text)
}

const fn linuxcnc(text: &'static str) -> Program {
    on("linuxcnc", text)
}

const fn fanuc(text: &'static str) -> Program {
    on("fanuc-mill", text)
}

/// A quarter, a full turn down, and a dwell: what a thread mill does.
const HELIX: &str = "G21 G17 G90 G94 G54\nS3000 M3\nG0 X10. Y0. Z5.\nG1 Z0. F300.\nG2 X10. Y0. I-10. J0. Z-8. F200.\nG1 X0.\nM5\nM30\n";

pub(crate) const SYSTEM: System = System {
    title: "Feed modes, dwell and helices",
    key: "Feed",
    source: "General milling control, feed functions and circular interpolation",
    module: "feed",
    sentences: &[
        // ---- helices ----
        Sentence {
            says: "The first two words of an arc are the end point on the two axes of the active plane.",
            literal: By(&[
                Proof::Run {
                    program: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. R15. F200.\nG18 G3 X0. Z-4. R30.\nG19 G2 Y8. Z0. R20.\nM30\n",
                    ),
                    prints: &[
                        "arc 20.0000 0.0000 0.0000",
                        "arc 0.0000 0.0000 -4.0000",
                        "arc 0.0000 8.0000 0.0000",
                    ],
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G2",
                    says: "The two words of the active plane give the end point",
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G3",
                    says: "The two words of the active plane give the end point",
                },
]),
computed: By(&[
same(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=20.\nG2 X#100 Y[#100-20.] R[#100*0.75] F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. R15. F200.\nM30\n")),
]),
lasting: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG18\nG2 X20. Z0. R15. F200.\nM30\n"), &["arc 20.0000 0.0000 0.0000"]),
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG19\nG2 Y8. Z0. R20. F200.\nM30\n"), &["arc 0.0000 8.0000 0.0000"]),
]),
missing: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. R15. F200.\nM30\n"), &["arc 20.0000 0.0000 0.0000"]),
rule("warning[full-circle-by-radius]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 R15. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 Y0. X20. R15. F200.\nM30\n")),
]),
extra: By(&[
rule("warning[arc-wrong-plane-word]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. I10. J0. K5. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. I10. J0. F200.\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "The third word is a linear axis beside the plane; its value is the height that the spiral reaches.",
            literal: By(&[
                Proof::Run {
                    program: mill(HELIX),
                    prints: &["arc 10.0000 0.0000 -8.0000 200 19.002 cw 360 deg about X0 Y0"],
                },
                Proof::Run {
                    program: mill(
                        "G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG18 G2 X10. Z10. Y-5. R10. F200.\nM30\n",
                    ),
                    prints: &["arc 10.0000 -5.0000 10.0000"],
                },
                Proof::Legal { program: mill(HELIX) },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G2",
                    says: "helix**, and its value is the height reached at the end",
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G3",
                    says: "helix**, and its value is the height reached at the end",
                },
]),
computed: By(&[
same(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=-8.\nG2 X20. Y0. Z#100 I10. J0. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0. F200.\nM30\n")),
]),
lasting: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nZ-3.\nG2 X20. Y0. I10. J0. F200.\nM30\n"), &["arc 20.0000 0.0000 -3.0000"]),
]),
missing: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. I10. J0. F200.\nM30\n"), &["arc 20.0000 0.0000 0.0000"]),
]),
extra: By(&[
rule("info[axis-word-unsure]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0. A0.\nG2 X20. Y0. A90. I10. J0. F200.\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0. A0.\nG2 X20. Y0. Z-8. I10. J0. F200.\nG0 Z5.\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"])),
]),
range: No("no range"),

        },
        Sentence {
            says: "Everything else of a helix, words and limits, is as for circular interpolation.",
            literal: By(&[
legal(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R11. F200.\nG3 X0. Y0. Z0. I-10. J0.\nM30\n")),
]),
computed: By(&[
rule("warning[arc-radius-too-small]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=18.\nG2 X20. Y0. Z-5. R[#100/2] F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=22.\nG2 X20. Y0. Z-5. R[#100/2] F200.\nM30\n")),
rule("warning[arc-end-off-circle]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=3.\nG2 X20. Y#100 I10. J0. Z-5. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=0\nG2 X20. Y#100 I10. J0. Z-5. F200.\nM30\n")),
]),
lasting: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R11.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nF200.\nG2 X20. Y0. Z-5. R11.\nM30\n")),
rule("info[arc-mode-left-on]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. I10. J0. F200.\nX0. Y0. Z-10.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. I10. J0. F200.\nX0. Y0. Z-10. I-10. J0.\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "warning[arc-without-centre]",
                    violates: mill("G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. F200.\nM30\n"),
                    conforms: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R#500 F200.\nM30\n",
                    ),
                },
                Proof::Rule {
                    finding: "error[feed-missing]",
                    violates: mill("G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R11.\nM30\n"),
                    conforms: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R11. F200.\nM30\n",
                    ),
                },
rule("warning[arc-wrong-plane-word]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG18\nG2 X20. Z0. Y-5. J10. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG18\nG2 X20. Z0. Y-5. I10. F200.\nM30\n")),
]),
extra: By(&[
rule("warning[arc-centre-and-radius]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. I10. J0. R11. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R11. F200.\nM30\n")),
rule("warning[arc-wrong-plane-word]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. K10. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. I10. F200.\nM30\n")),
]),
range: By(&[
                Proof::Rule {
                    finding: "warning[arc-end-off-circle]",
                    violates: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y3. I10. J0. Z-5. F200.\nM30\n",
                    ),
                    conforms: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. I10. J0. Z-5. F200.\nM30\n",
                    ),
                },
                Proof::Rule {
                    finding: "warning[arc-radius-too-small]",
                    violates: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R9. F200.\nM30\n",
                    ),
                    conforms: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-5. R11. F200.\nM30\n",
                    ),
                },
                Proof::Rule {
                    finding: "warning[full-circle-by-radius]",
                    violates: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X0. Y0. Z-5. R10. F200.\nM30\n",
                    ),
                    conforms: mill(
                        "G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X0. Y0. Z-5. I10. J0. F200.\nM30\n",
                    ),
                },
]),

        },
        // ---- feed modes ----
        Sentence {
            says: "Under G94 F is millimetres or inches per minute.",
            literal: By(&[
                Proof::Run {
                    program: mill("G21 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n"),
                    prints: &["feed 100.0000 0.0000 0.0000 300 20.000"],
                },
                Proof::Run {
                    program: mill("G20 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X4. F12.\nM30\n"),
                    prints: &["feed 4.0000 0.0000 0.0000 12 20.000"],
                },
                Proof::Stats {
                    program: mill("G21 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n"),
                    prints: &["300/min"],
                },
                Proof::Explains { control: "generic-mill", code: "G94", says: "feed in mm/min or inch/min" },
]),
computed: By(&[
same(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=300.\nG1 X100. F#100\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n")),
rule("error[feed-zero]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=0\nG1 X100. F#100\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=300.\nG1 X100. F#100\nM30\n")),
]),
lasting: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nF300.\nG1 X100.\nM30\n"), &["feed 100.0000 0.0000 0.0000 300 20.000"]),
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X50. F300.\nG0 X0.\nG1 X100.\nM30\n"), &["feed 100.0000 0.0000 0.0000 300 20.000"]),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300. F200.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n")),
]),
range: By(&[
rule("error[feed-zero]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F0.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F1.\nM30\n")),
rule("warning[sign-not-accepted]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F-300.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n")),
]),

        },
        Sentence {
            says: "Under G95 F is millimetres or inches for each turn of the spindle.",
            literal: By(&[
                Proof::Run {
                    program: mill("G21 G90 G54\nS1200 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n"),
                    prints: &["feed 60.0000 0.0000 0.0000 0.25 12.000"],
                },
                Proof::Run {
                    program: mill("G20 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X2. F0.01\nM30\n"),
                    prints: &["feed 2.0000 0.0000 0.0000 0.01 20.000"],
                },
                Proof::Stats {
                    program: mill("G21 G90 G54\nS1200 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n"),
                    prints: &["0.25/rev"],
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G95",
                    says: "feed in mm or inch per revolution",
                },
]),
computed: By(&[
same(mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\n#100=0.25\nG95 G1 X60. F#100\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n")),
rule("error[feed-zero]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\n#100=0\nG95 G1 X60. F#100\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\n#100=0.25\nG95 G1 X60. F#100\nM30\n")),
]),
lasting: By(&[
run(mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 F0.25\nG1 X60.\nM30\n"), &["feed 60.0000 0.0000 0.0000 0.25 24.000"]),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60.\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25 F0.2\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n")),
]),
range: By(&[
rule("error[feed-zero]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.01\nM30\n")),
rule("warning[sign-not-accepted]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F-0.25\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n")),
]),

        },
        Sentence {
            says: "The feed is held along the path: the speed along the tangent is the one that F says.",
            literal: By(&[
                Proof::Run {
                    program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X30. Y40. F100.\nM30\n"),
                    prints: &["feed 30.0000 40.0000 0.0000 100 30.000"],
                },
                Proof::Run {
                    program: mill(
                        "G21 G17 G90 G94 G54\nS900 M3\nG0 X10. Y0. Z0.\nG3 X-10. Y0. I-10. J0. F314.159\nM30\n",
                    ),
                    prints: &["arc -10.0000 0.0000 0.0000 314.159 6.000"],
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G94",
                    says: "**along the path**: each axis gets its share",
                },
]),
computed: By(&[
same(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=100.\nG1 X30. Y[#100*0.4] F#100\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X30. Y40. F100.\nM30\n")),
]),
lasting: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X10. F100.\nX40. Y40.\nM30\n"), &["feed 40.0000 40.0000 0.0000 100 30.000"]),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X30. Y40.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X30. Y40. F100.\nM30\n")),
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "Along a helix F is the speed on the path of the tool, or on its circle, as the control has it.",
            literal: By(&[
                // 2 pi 10 = 62.832 along the circle, 63.339 with 8 of height.
                Proof::Run { program: mill(HELIX), prints: &["arc 10.0000 0.0000 -8.0000 200 19.002"] },
                Proof::Run { program: haas(HELIX), prints: &["arc 10.0000 0.0000 -8.0000 200 19.002"] },
                Proof::Run { program: linuxcnc(HELIX), prints: &["arc 10.0000 0.0000 -8.0000 200 19.002"] },
                Proof::Run { program: fanuc(HELIX), prints: &["arc 10.0000 0.0000 -8.0000 200 18.850"] },
                Proof::Run {
                    program: fanuc(HELIX).with(&["settings.\"1403#5\"=\"path\""]),
                    prints: &["arc 10.0000 0.0000 -8.0000 200 19.002"],
                },
                Proof::Stats { program: fanuc(HELIX), prints: &["1403#5 (feed of a helix) is `circle`"] },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G2",
                    says: "speed along the path of the tool, the helix included",
                },
                Proof::Explains {
                    control: "fanuc-mill",
                    code: "G2",
                    says: "measured along the circle in the plane",
                },
]),
computed: By(&[
same(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=200.\nG2 X20. Y0. Z-8. I10. J0. F#100\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0. F200.\nM30\n")),
]),
lasting: By(&[
same(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nF200.\nG2 X20. Y0. Z-8. I10. J0.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0. F200.\nM30\n")),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0. F200.\nM30\n")),
]),
extra: No("no other word"),
range: By(&[
rule("error[feed-zero]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0. F0.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG2 X20. Y0. Z-8. I10. J0. F200.\nM30\n")),
]),

        },
        Sentence {
            says: "At power-on the feed is per minute.",
            literal: By(&[
                Proof::Assumes {
                    program: mill("G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n"),
                    says: "in effect at the start, as at power-on: G0 G80 G17 G90 G94",
                },
                Proof::Run {
                    program: mill("G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n"),
                    prints: &["feed 100.0000 0.0000 0.0000 300 20.000"],
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G94",
                    says: "stays in effect, active at power-on",
                },
]),
computed: By(&[
run(mill("G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=300.\nG1 X100. F#100\nM30\n"), &["feed 100.0000 0.0000 0.0000 300 20.000"]),
]),
lasting: By(&[
run(mill("G21 G90 G54 F300.\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100.\nM30\n"), &["feed 100.0000 0.0000 0.0000 300 20.000"]),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100.\nM30\n"), mill("G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n")),
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "G94 is modal: the feed is per minute until G95.",
            literal: By(&[
                Proof::Explains { control: "generic-mill", code: "G94", says: "stays until `G95`" },
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG94 G1 X10. F300.\nM30\n"), &["feed 10.0000 0.0000 0.0000 300 2.000"]),
]),
computed: No("code, no value"),
lasting: By(&[
                Proof::Run {
                    program: mill(
                        "G21 G90 G94 G54\nS600 M3\nG0 X0. Y0. Z0.\nG1 X10. F300.\nG0 X0.\nG1 X30.\nG95 G1 X60. F0.1\nM30\n",
                    ),
                    prints: &[
                        "feed 10.0000 0.0000 0.0000 300 2.000",
                        "feed 30.0000 0.0000 0.0000 300 6.000",
                        "feed 60.0000 0.0000 0.0000 0.1 30.000",
                    ],
                },
run(mill("G21 G17 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG95 F0.1\nG94\nG1 X10. F300.\nG2 X20. Y0. R5.\nG1 X50.\nM30\n"), &["feed 10.0000 0.0000 0.0000 300 2.000", "feed 50.0000 0.0000 0.0000 300 6.000"]),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG94\nG1 X10.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG94\nG1 X10. F300.\nM30\n")),
]),
extra: By(&[
rule("warning[two-codes-of-one-group]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG94 G95 G1 X10. F300.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG94 G1 X10. F300.\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "G95 is modal: the feed is per turn until G94.",
            literal: By(&[
                Proof::Explains { control: "generic-mill", code: "G95", says: "Stays until `G94`" },
run(mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X6. F0.1\nM30\n"), &["feed 6.0000 0.0000 0.0000 0.1 6.000"]),
]),
computed: No("code, no value"),
lasting: By(&[
                Proof::Run {
                    program: mill(
                        "G21 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X6. F0.1\nG0 X0.\nG1 X3.\nG94 G1 X33. F300.\nM30\n",
                    ),
                    prints: &[
                        "feed 6.0000 0.0000 0.0000 0.1 6.000",
                        "feed 3.0000 0.0000 0.0000 0.1 3.000",
                        "feed 33.0000 0.0000 0.0000 300 6.000",
                    ],
                },
run(mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95\nG0 X10.\nG1 X16. F0.1\nM30\n"), &["feed 16.0000 0.0000 0.0000 0.1 6.000"]),
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95\nG1 X10.\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95\nG1 X10. F0.1\nM30\n")),
]),
extra: By(&[
rule("warning[two-codes-of-one-group]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G94 G1 X10. F0.1\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X10. F0.1\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "Under G95 the feed follows the turns, so the spindle has to turn.",
            literal: By(&[
                Proof::Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: mill("G21 G90 G95 G54\nT1 M6\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n"),
                    conforms: mill(
                        "G21 G90 G95 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n",
                    ),
                },
                // Per turn the way out needs turns too, per minute it does not.
                Proof::Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: mill(
                        "G21 G90 G95 G54\nS600 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nM5\nG1 Z5.\nM30\n",
                    ),
                    conforms: mill(
                        "G21 G90 G95 G54\nS600 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nM5\nG94 G1 Z5. F500.\nM30\n",
                    ),
                },
                Proof::Rule {
                    finding: "warning[spindle-stopped-while-cutting]",
                    violates: linuxcnc("G21 G90 G95\nG0 X0 Y0\nG1 X10 F0.1\nM2\n"),
                    conforms: linuxcnc("G21 G90 G95\nS600 M3\nG0 X0 Y0\nG1 X10 F0.1\nM2\n"),
                },
                Proof::Explains { control: "generic-mill", code: "G95", says: "The spindle must turn" },
]),
computed: By(&[
rule("warning[speed-missing]", mill("G21 G90 G95 G54\n#100=0\nS#100 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n"), mill("G21 G90 G95 G54\n#100=600\nS#100 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n")),
]),
lasting: By(&[
rule("warning[spindle-stopped-while-cutting]", mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X10. F0.1\nM5\nG1 X20.\nM30\n"), mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X10. F0.1\nM5\nS600 M3\nG1 X20.\nM30\n")),
]),
missing: By(&[
rule("info[speed-missing]", mill("G21 G90 G95 G54\nT1 M6\nM3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n"), mill("G21 G90 G95 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n")),
]),
extra: No("no other word"),
range: By(&[
rule("warning[speed-missing]", mill("G21 G90 G95 G54\nT1 M6\nS0 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n"), mill("G21 G90 G95 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z5.\nG1 Z-5. F0.1\nG0 Z50.\nM30\n")),
]),

        },
        Sentence {
            says: "A number that was given for F under one feed mode means something else under another; each control keeps or forgets it in its own way.",
            literal: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG94 G1 X10. F300.\nG95 G1 X16. F0.1\nM30\n"), &["feed 10.0000 0.0000 0.0000 300 2.000", "feed 16.0000 0.0000 0.0000 0.1 4.000"]),
]),
computed: By(&[
rule("warning[feed-of-another-mode]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=300.\nG1 X10. F#100\nG95\nG1 X20.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=300.\nG1 X10. F#100\nG95\nG1 X20. F[#100/1000]\nM30\n")),
]),
lasting: By(&[
                Proof::Rule {
                    finding: "warning[feed-of-another-mode]",
                    violates: mill("G21 G90 G94 G54\nS600 M3\nG0 X0.\nG1 X10. F300.\nG95\nG1 X20.\nM30\n"),
                    conforms: mill(
                        "G21 G90 G94 G54\nS600 M3\nG0 X0.\nG1 X10. F300.\nG95\nG1 X20. F0.2\nM30\n",
                    ),
                },
                Proof::Rule {
                    finding: "warning[feed-of-another-mode]",
                    violates: haas(
                        "G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. A0.\nG93 G1 X10. A5. F40.\nG94\nG1 X20.\nM30\n",
                    ),
                    conforms: haas(
                        "G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. A0.\nG93 G1 X10. A5. F40.\nG94 F300.\nG1 X20.\nM30\n",
                    ),
                },
                Proof::Rule {
                    finding: "info[maybe-feed-of-another-mode]",
                    violates: mill(
                        "G21 G90 G54\nS600 M3\nG0 X0.\nG1 X10. F300.\nIF [#500 EQ 1] GOTO 10\nG95 G1 X20. F0.2\nN10 G94 G1 X30.\nM30\n",
                    ),
                    conforms: mill(
                        "G21 G90 G54\nS600 M3\nG0 X0.\nG1 X10. F300.\nIF [#500 EQ 1] GOTO 10\nG95 G1 X20. F0.2\nN10 G94 G1 X30. F300.\nM30\n",
                    ),
                },
rule("warning[maybe-feed-of-another-mode]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X10. F300.\nIF [#500 EQ 1] GOTO 10\nG95\nN10 G1 X20.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X10. F300.\nIF [#500 EQ 1] GOTO 10\nG95\nN10 G94 G1 X20. F300.\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "error[feed-missing]",
                    violates: linuxcnc("G21 G90 G94\nS600 M3\nG0 X0 Y0\nG1 X10 F300\nG95\nG1 X20\nM2\n"),
                    conforms: linuxcnc("G21 G90 G94\nS600 M3\nG0 X0 Y0\nG1 X10 F300\nG95\nG1 X20 F0.2\nM2\n"),
                },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "Under G93 every cutting block has its own F.",
            literal: By(&[
                Proof::Run {
                    program: haas(
                        "G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 G1 X10. A5. F40.\nG94 F300.\nM30\n",
                    ),
                    prints: &["feed 10.0000 0.0000 0.0000 5.0000 40 1.500"],
                },
]),
computed: By(&[
same(haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\n#100=40.\nG93 G1 X10. A5. F#100\nG94 F300.\nM30\n"), haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 G1 X10. A5. F40.\nG94 F300.\nM30\n")),
]),
lasting: By(&[
rule("error[inverse-time-feed-missing]", haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 F40.\nG1 X10. A5.\nG94 F300.\nM30\n"), haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93\nG1 X10. A5. F40.\nG94 F300.\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "error[inverse-time-feed-missing]",
                    violates: haas(
                        "G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. A0.\nG93 G1 X10. A5. F40.\nX20. A9.\nG94 F300.\nM30\n",
                    ),
                    conforms: haas(
                        "G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. A0.\nG93 G1 X10. A5. F40.\nX20. A9. F30.\nG94 F300.\nM30\n",
                    ),
                },
]),
extra: By(&[
rule("warning[word-given-twice]", haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 G1 X10. A5. F40. F30.\nG94 F300.\nM30\n"), haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 G1 X10. A5. F40.\nG94 F300.\nM30\n")),
]),
range: By(&[
rule("error[feed-zero]", haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 G1 X10. A5. F0.\nG94 F300.\nM30\n"), haas("G21 G90 G54\nT1 M6\nS600 M3\nG0 X0. Y0. Z0. A0.\nG93 G1 X10. A5. F40.\nG94 F300.\nM30\n")),
]),

        },
        Sentence {
            says: "The override switch changes the feed per minute from 0 to 150 % in steps of 10 %.",
            literal: By(&[
                Proof::Explains {
                    control: "generic-mill",
                    code: "G94",
                    says: "override switch works from 0 to 150 % in steps of 10 %",
                },
                Proof::Stats {
                    program: mill("G21 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n")
                        .with(&["machine.feed_override=150"]),
                    prints: &["cutting 0:13.3", "the feed override is at 150 %"],
                },
]),
computed: No("a switch"),
lasting: By(&[
Proof::Stats { program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X50. F300.\nX100.\nM30\n").with(&["machine.feed_override=50"]), prints: &["cutting 0:40.0"] },
]),
missing: By(&[
Proof::Stats { program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n"), prints: &["cutting 0:20.0"] },
]),
extra: No("a switch"),
range: By(&[
Proof::Refuses { program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n").with(&["machine.feed_override=160"]), says: "0 to 150 percent in steps of 10" },
Proof::Refuses { program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n").with(&["machine.feed_override=85"]), says: "0 to 150 percent in steps of 10" },
Proof::Accepts { program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nM30\n").with(&["machine.feed_override=0"]) },
]),

        },
        Sentence {
            says: "It changes the feed per turn in the same way.",
            literal: By(&[
                Proof::Explains {
                    control: "generic-mill",
                    code: "G95",
                    says: "override switch works from 0 to 150 % in steps of 10 %",
                },
                Proof::Stats {
                    program: mill("G21 G90 G54\nS1200 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n")
                        .with(&["machine.feed_override=50"]),
                    prints: &["cutting 0:24.0"],
                },
]),
computed: No("a switch"),
lasting: By(&[
Proof::Stats { program: mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 F0.25\nG1 X30.\nX60.\nM30\n").with(&["machine.feed_override=50"]), prints: &["cutting 0:48.0"] },
]),
missing: By(&[
Proof::Stats { program: mill("G21 G17 G90 G54\nS600 M3\nG0 X0. Y0. Z0.\nG95 G1 X60. F0.25\nM30\n"), prints: &["cutting 0:24.0"] },
]),
extra: No("a switch"),
range: No("see Feed-14"),

        },
        Sentence {
            says: "Some codes leave the override no say: tapping cycles keep their feed.",
            literal: By(&[
                Proof::Explains {
                    control: "generic-mill",
                    code: "G94",
                    says: "Some codes ignore it, tapping cycles for one",
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G84",
                    says: "Override switches have no effect in the cut",
                },
                Proof::Stats {
                    program: mill(
                        "G21 G90 G94 G54\nS500 M3\nG0 X0. Y0. Z5.\nG84 X0. Y0. Z-20. R5. F500.\nG80\nM30\n",
                    )
                    .with(&["machine.feed_override=50"]),
                    prints: &["cutting 0:06.0"],
                },
                Proof::Stats {
                    program: mill(
                        "G21 G90 G94 G54\nS500 M3\nG0 X0. Y0. Z5.\nG81 X0. Y0. Z-20. R5. F500.\nG80\nM30\n",
                    )
                    .with(&["machine.feed_override=50"]),
                    prints: &["cutting 0:06.0"],
                },
]),
computed: By(&[
Proof::Stats { program: mill("G21 G90 G94 G54\nS500 M3\nG0 X0. Y0. Z5.\n#100=500.\nG84 X0. Y0. Z-20. R5. F#100\nG80\nM30\n").with(&["machine.feed_override=50"]), prints: &["cutting 0:06.0"] },
]),
lasting: By(&[
Proof::Stats { program: mill("G21 G90 G94 G54\nS500 M3\nF500.\nG0 X0. Y0. Z5.\nG84 X0. Y0. Z-20. R5.\nG80\nM30\n").with(&["machine.feed_override=50"]), prints: &["cutting 0:06.0"] },
]),
missing: By(&[
rule("error[feed-missing]", mill("G21 G90 G94 G54\nS500 M3\nG0 X0. Y0. Z5.\nG84 X0. Y0. Z-20. R5.\nG80\nM30\n"), mill("G21 G90 G94 G54\nS500 M3\nG0 X0. Y0. Z5.\nG84 X0. Y0. Z-20. R5. F500.\nG80\nM30\n")),
]),
extra: No("a switch"),
range: No("no range"),

        },
        // ---- dwell ----
        Sentence {
            says: "G04 with P waits milliseconds.",
            literal: By(&[
                Proof::Run { program: mill("G04 P500\nM30\n"), prints: &["dwell 0.500"] },
                Proof::Explains { control: "generic-mill", code: "G4", says: "**P** is milliseconds" },
]),
computed: By(&[
same(mill("G21 G90 G54\n#100=500\nG04 P#100\nM30\n"), mill("G21 G90 G54\nG04 P500\nM30\n")),
rule("warning[computed-value-out-of-range]", mill("G21 G90 G54\n#100=-1\nG04 P#100\nM30\n"), mill("G21 G90 G54\n#100=500\nG04 P#100\nM30\n")),
]),
lasting: By(&[
rule("info[dwell-without-time]", mill("G21 G90 G54\nG04 P500\nG04\nM30\n"), mill("G21 G90 G54\nG04 P500\nG04 P500\nM30\n")),
]),
missing: By(&[
rule("info[dwell-without-time]", mill("G21 G90 G54\nG04\nM30\n"), mill("G21 G90 G54\nG04 P500\nM30\n")),
]),
extra: By(&[
rule("warning[dwell-without-time]", mill("G21 G90 G54\nG04 F500.\nM30\n"), mill("G21 G90 G54\nG04 P500\nM30\n")),
rule("warning[axis-word-passed-over]", mill("G21 G90 G54\nG04 P500 Z5.\nM30\n"), mill("G21 G90 G54\nG04 P500\nM30\n")),
]),
range: By(&[
rule("warning[number-out-of-range]", mill("G21 G90 G54\nG04 P0\nM30\n"), mill("G21 G90 G54\nG04 P1\nM30\n")),
rule("warning[decimal-point-on-integer]", mill("G21 G90 G54\nG04 P0.5\nM30\n"), mill("G21 G90 G54\nG04 P500\nM30\n")),
]),

        },
        Sentence {
            says: "G04 with X waits seconds.",
            literal: By(&[
                Proof::Run { program: mill("G04 X0.5\nM30\n"), prints: &["dwell 0.500"] },
                Proof::Explains { control: "generic-mill", code: "G4", says: "**X** or **U** seconds" },
]),
computed: By(&[
same(mill("G21 G90 G54\n#100=0.5\nG04 X#100\nM30\n"), mill("G21 G90 G54\nG04 X0.5\nM30\n")),
rule("error[computed-value-out-of-range]", mill("G21 G90 G54\n#100=100000.\nG04 X#100\nM30\n"), mill("G21 G90 G54\n#100=0.5\nG04 X#100\nM30\n")),
]),
lasting: By(&[
rule("info[dwell-without-time]", mill("G21 G90 G54\nG04 X0.5\nG04\nM30\n"), mill("G21 G90 G54\nG04 X0.5\nG04 X0.5\nM30\n")),
]),
missing: By(&[
rule("warning[dwell-without-time]", mill("G21 G90 G54\nG04 S500\nM30\n"), mill("G21 G90 G54\nG04 X0.5\nM30\n")),
]),
extra: By(&[
rule("warning[axis-word-passed-over]", mill("G21 G90 G54\nG04 X0.5 Y2.\nM30\n"), mill("G21 G90 G54\nG04 X0.5\nM30\n")),
rule("warning[dwell-beside-motion]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG01 G04 X10. F100.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG04 X10.\nG01 X10. F100.\nM30\n")),
]),
range: By(&[
rule("error[number-out-of-range]", mill("G21 G90 G54\nG04 X100000.\nM30\n"), mill("G21 G90 G54\nG04 X99999.999\nM30\n")),
]),

        },
        Sentence {
            says: "G04 with U waits seconds; neither U nor X is an axis word then.",
            literal: By(&[
                Proof::Run {
                    program: mill("G21 G90 G54\nG0 X1.\nG04 U0.5\nG04 X2.\nG91 G0 X1.\nM30\n"),
                    prints: &["dwell 0.500", "dwell 2.000", "rapid 2.0000"],
                },
                Proof::Legal {
                    program: mill("G21 G90 G54\nG1 X1. F100. S900 M3\nG04 U0.5\nG04 X2.\nG1 X2.\nM30\n"),
                },
]),
computed: By(&[
same(mill("G21 G90 G54\n#100=0.5\nG04 U#100\nM30\n"), mill("G21 G90 G54\nG04 U0.5\nM30\n")),
rule("error[computed-value-out-of-range]", mill("G21 G90 G54\n#100=-2.\nG04 U[#100/2]\nM30\n"), mill("G21 G90 G54\n#100=2.\nG04 U[#100/2]\nM30\n")),
]),
lasting: By(&[
run(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X10. F100.\nG04 U2.\nX20.\nM30\n"), &["dwell 2.000", "feed 20.0000 0.0000 0.0000"]),
]),
missing: By(&[
rule("info[dwell-without-time]", mill("G21 G90 G54\nG04\nM30\n"), mill("G21 G90 G54\nG04 U0.5\nM30\n")),
]),
extra: By(&[
rule("warning[words-exclude-each-other]", mill("G21 G90 G54\nG04 X0.5 U0.5\nM30\n"), mill("G21 G90 G54\nG04 U0.5\nM30\n")),
]),
range: By(&[
rule("error[number-out-of-range]", mill("G21 G90 G54\nG04 U-0.5\nM30\n"), mill("G21 G90 G54\nG04 U0.5\nM30\n")),
]),

        },
        Sentence {
            says: "The next block begins when the time is over, so the dwell is part of the cycle time.",
            literal: By(&[
Proof::Stats {
                program: mill("G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\nG1 X100. F300.\nG04 X10.\nM30\n"),
                prints: &["cutting 0:20.0 (67 %), dwell 0:10.0 (33 %)"],
            },
]),
computed: By(&[
Proof::Stats { program: mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=10.\nG1 X100. F300.\nG04 X#100\nM30\n"), prints: &["dwell 0:10.0 (33 %)"] },
]),
lasting: No("not lasting"),
missing: No("see Feed-17"),
extra: No("no other word"),
range: No("see Feed-21"),

        },
        Sentence {
            says: "The time is from 0.001 to 99999.999.",
            literal: By(&[
                Proof::Explains {
                    control: "generic-mill",
                    code: "G4",
                    says: "From 0.001 to 99999.999 seconds",
                },
legal(mill("G21 G90 G54\nG04 P1\nG04 X0.001\nG04 U10.\nM30\n")),
]),
computed: By(&[
rule("error[computed-value-out-of-range]", mill("G21 G90 G54\n#100=0\nG04 X#100\nM30\n"), mill("G21 G90 G54\n#100=0.001\nG04 X#100\nM30\n")),
rule("error[computed-value-out-of-range]", mill("G21 G90 G54\n#100=50000.\nG04 U[#100*2.]\nM30\n"), mill("G21 G90 G54\n#100=40000.\nG04 U[#100*2.]\nM30\n")),
rule("warning[computed-value-out-of-range]", mill("G21 G90 G54\n#100=0\nG04 P#100\nM30\n"), mill("G21 G90 G54\n#100=1\nG04 P#100\nM30\n")),
rule("warning[maybe-computed-value-out-of-range]", mill("G21 G90 G54\n#100=0\nIF [#500 EQ 1] GOTO 10\n#100=2.\nN10 G04 X#100\nM30\n"), mill("G21 G90 G54\n#100=1.\nIF [#500 EQ 1] GOTO 10\n#100=2.\nN10 G04 X#100\nM30\n")),
]),
lasting: No("not lasting"),
missing: No("see Feed-17"),
extra: No("see Feed-22"),
range: By(&[
                Proof::Rule {
                    finding: "error[number-out-of-range]",
                    violates: mill("G04 X0.\nM30\n"),
                    conforms: mill("G04 X0.001\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[number-out-of-range]",
                    violates: mill("G04 U100000.\nM30\n"),
                    conforms: mill("G04 U99999.999\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[number-out-of-range]",
                    violates: mill("G04 X-1.5\nM30\n"),
                    conforms: mill("G04 X1.5\nM30\n"),
                },
rule("warning[number-out-of-range]", mill("G21 G90 G54\nG04 P0\nM30\n"), mill("G21 G90 G54\nG04 P1\nM30\n")),
rule("warning[number-out-of-range]", mill("G21 G90 G54\nG04 P100000000\nM30\n"), mill("G21 G90 G54\nG04 P99999999\nM30\n")),
]),

        },
        Sentence {
            says: "The format has one of the three words; two of them contradict each other.",
            literal: By(&[
run(mill("G21 G90 G54\nG04 X0.5\nG04 P500\nG04 U0.5\nM30\n"), &["dwell 0.500", "dwell 0.500", "dwell 0.500"]),
]),
computed: By(&[
rule("warning[words-exclude-each-other]", mill("G21 G90 G54\n#100=0.5\nG04 X#100 P[#100*1000]\nM30\n"), mill("G21 G90 G54\n#100=0.5\nG04 X#100\nG04 P[#100*1000]\nM30\n")),
]),
lasting: No("not lasting"),
missing: By(&[
rule("info[dwell-without-time]", mill("G21 G90 G54\nG04\nM30\n"), mill("G21 G90 G54\nG04 X0.5\nM30\n")),
]),
extra: By(&[
                Proof::Rule {
                    finding: "warning[words-exclude-each-other]",
                    violates: mill("G04 X0.5 P500\nM30\n"),
                    conforms: mill("G04 X0.5\nG04 P500\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[words-exclude-each-other]",
                    violates: fanuc("G04 X0.5 U0.5\nM30\n"),
                    conforms: fanuc("G04 U0.5\nM30\n"),
                },
rule("warning[words-exclude-each-other]", mill("G21 G90 G54\nG04 U0.5 P500\nM30\n"), mill("G21 G90 G54\nG04 P500\nM30\n")),
]),
range: No("see Feed-21"),

        },
        Sentence {
            says: "A pause cleans flat bottoms and countersinks.",
            literal: By(&[
Proof::Explains {
                control: "generic-mill",
                code: "G4",
                says: "For a clean bottom in flat boring and countersinking",
            },
]),
computed: No("no word"),
lasting: No("no word"),
missing: No("no word"),
extra: No("no word"),
range: No("no word"),

        },
        Sentence {
            says: "In cutting mode (G64) a pause makes an exact stop.",
            literal: By(&[
                Proof::Explains {
                    control: "generic-mill",
                    code: "G4",
                    says: "In cutting mode `G64` a pause also makes the axes stop in position",
                },
                Proof::Explains {
                    control: "generic-mill",
                    code: "G64",
                    says: "A `G4` between two blocks makes the axes stop",
                },
                Proof::Legal {
                    program: mill(
                        "G21 G90 G64 G54\nS900 M3\nG0 X0. Y0. Z2.\nG1 Z-1. F100.\nG1 X10.\nG04 X0.1\nG1 Y10.\nM30\n",
                    ),
                },
                // Without a time it is that stop alone: assumed to be legal here.
                Proof::Legal {
                    program: mill(
                        "G21 G90 G64 G54\nS900 M3\nG0 X0. Y0. Z2.\nG1 Z-1. F100.\nG1 X10.\nG04\nG1 Y10.\nM30\n",
                    ),
                },
]),
computed: By(&[
legal(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\n#100=0.1\nG64 G1 Z-1. F100.\nG04 X#100\nG1 Y10.\nM30\n")),
]),
lasting: By(&[
legal(mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG64\nG1 Z-1. F100.\nX10.\nG04 X0.1\nG1 Y10.\nM30\n")),
]),
missing: By(&[
rule("info[dwell-without-time]", mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG64 G1 Z-1. F100.\nG04\nG1 Y10.\nM30\n"), mill("G21 G17 G90 G94 G54\nS900 M3\nG0 X0. Y0. Z0.\nG64 G1 Z-1. F100.\nG04 X0.1\nG1 Y10.\nM30\n")),
]),
extra: No("see Feed-18"),
range: No("see Feed-21"),

        },
        Sentence {
            says: "Other controls read the time from other words: P alone on Haas and LinuxCNC.",
            literal: By(&[
run(haas("G21 G90\nG4 P2.\nM30\n"), &["dwell 2.000"]),
run(linuxcnc("G21 G90\nG4 P2.\nM2\n"), &["dwell 2.000"]),
]),
computed: By(&[
rule("error[dwell-time-in-other-word]", linuxcnc("G21 G90\n#1=2.\nG4 X#1\nM2\n"), linuxcnc("G21 G90\n#1=2.\nG4 P#1\nM2\n")),
rule("error[computed-value-out-of-range]", linuxcnc("G21 G90\n#1=-2.\nG4 P#1\nM2\n"), linuxcnc("G21 G90\n#1=2.\nG4 P#1\nM2\n")),
]),
lasting: By(&[
rule("error[required-word-missing]", linuxcnc("G21 G90\nG4 P2.\nG4\nM2\n"), linuxcnc("G21 G90\nG4 P2.\nG4 P2.\nM2\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "error[required-word-missing]",
                    violates: linuxcnc("G21 G90\nG4\nM2\n"),
                    conforms: linuxcnc("G21 G90\nG4 P0\nM2\n"),
                },
rule("warning[required-word-missing]", haas("G21 G90\nG4\nM30\n"), haas("G21 G90\nG4 P2.\nM30\n")),
]),
extra: By(&[
                Proof::Rule {
                    finding: "error[dwell-time-in-other-word]",
                    violates: linuxcnc("G21 G90\nG4 X2.\nM2\n"),
                    conforms: linuxcnc("G21 G90\nG4 P2.\nM2\n"),
                },
                Proof::Rule {
                    finding: "warning[dwell-time-in-other-word]",
                    violates: haas("G21 G90\nG4 U2.\nM30\n"),
                    conforms: haas("G21 G90\nG4 P2.\nM30\n"),
                },
]),
range: By(&[
rule("error[number-out-of-range]", linuxcnc("G21 G90\nG4 P-2.\nM2\n"), linuxcnc("G21 G90\nG4 P2.\nM2\n")),
rule("warning[number-out-of-range]", haas("G21 G90\nG4 P-2.\nM30\n"), haas("G21 G90\nG4 P2.\nM30\n")),
]),

        },
        Sentence {
            says: "The same number is another time on another control, and a decimal point may decide it.",
            literal: By(&[
                Proof::Assumes {
                    program: mill("G4 X500\nM30\n"),
                    says: "numbers without a decimal point count as the control usually reads them",
                },
                Proof::Run { program: mill("G4 P500\nM30\n"), prints: &["dwell 0.500"] },
                Proof::Run {
                    program: haas("G4 P500\nG4 P0.5\nM30\n"),
                    prints: &["dwell 0.500", "dwell 0.500"],
                },
                Proof::Run {
                    program: linuxcnc("G4 P500\nG4 P0.5\nM2\n"),
                    prints: &["dwell 500.000", "dwell 0.500"],
                },
                Proof::Run {
                    program: fanuc("G4 P500\nG4 X500\nG4 X0.5\nM30\n"),
                    prints: &["dwell 0.500", "dwell 0.500", "dwell 0.500"],
                },
]),
computed: By(&[
run(linuxcnc("#1=500\nG4 P#1\nM2\n"), &["dwell 500.000"]),
run(fanuc("#100=0.5\nG4 X#100\nM30\n"), &["dwell 0.500"]),
run(mill("G21 G90 G54\n#100=500\nG4 P#100\nM30\n"), &["dwell 0.500"]),
]),
lasting: No("not lasting"),
missing: No("see Feed-17"),
extra: No("see Feed-25"),
range: By(&[
                Proof::Rule {
                    finding: "warning[dwell-very-long]",
                    violates: linuxcnc("G21 G90 F100\nG1 X1\nG4 P500\nM2\n"),
                    conforms: linuxcnc("G21 G90 F100\nG1 X1\nG4 P0.5\nM2\n"),
                },
                Proof::Rule {
                    finding: "info[dwell-very-short]",
                    violates: haas("G4 P2\nM30\n"),
                    conforms: haas("G4 P2.\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[decimal-point-on-integer]",
                    violates: fanuc("G4 P0.5\nM30\n"),
                    conforms: fanuc("G4 P500\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[decimal-point-on-integer]",
                    violates: mill("G4 P0.5\nM30\n"),
                    conforms: mill("G4 X0.5\nM30\n"),
                },
]),

        },
        Sentence {
            says: "Rapid moves pay no attention to F.",
            literal: By(&[
                Proof::Explains { control: "generic-mill", code: "G0", says: "**F** has no influence" },
run(mill("G21 G90 G54\nG0 X0. Y0. Z0.\nG0 X254.\nM30\n"), &["rapid 254.0000 0.0000 0.0000 0.600"]),
]),
computed: By(&[
run(mill("G21 G90 G54\nG0 X0. Y0. Z0.\n#100=100.\nF#100\nG0 X254.\nM30\n"), &["rapid 254.0000 0.0000 0.0000 0.600"]),
]),
lasting: By(&[
                Proof::Run {
                    program: mill("G21 G90 G54\nG0 X0. Y0. Z0.\nF100.\nG0 X254.\nM30\n"),
                    prints: &["rapid 254.0000 0.0000 0.0000 0.600"],
                },
]),
missing: By(&[
run(mill("G21 G90 G54\nG0 X0. Y0. Z0.\nG0 X254.\nM30\n"), &["rapid 254.0000 0.0000 0.0000 0.600"]),
]),
extra: By(&[
legal(mill("G21 G90 G54\nG0 X0. Y0. Z0.\nG0 X254. F100.\nM30\n")),
]),
range: No("no range"),

        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}

/// What is said of every mistake with `F` and the words of a dwell: missing, doubled, negative, zero, huge, no number,
/// computed from what nobody knows, in a subprogram, after a block skip, in a loop.
#[test]
#[expect(clippy::too_many_lines, reason = "one table of mistakes and of what is said of them")]
fn bad_input() {
    let head = "G21 G90 G54\nS900 M3\nG0 X0. Y0. Z0.\n";
    let cuts = [
        ("F missing", "G1 X1."),
        ("F doubled", "G1 X1. F100. F200."),
        ("F negative", "G1 X1. F-100."),
        ("F zero", "G1 X1. F0."),
        ("F huge", "G1 X1. F999999999."),
        ("F without a number", "G1 X1. F"),
        ("F of letters", "G1 X1. FAST"),
        ("F unknown", "G1 X1. F#500"),
        ("F computed zero", "#1=0\nG1 X1. F[#1*2]"),
        ("F in a subprogram", "M98 P20\nG1 X1."),
        ("F behind a block skip", "/F100.\nG1 X1."),
        ("F in a loop", "#1=0\nWHILE [#1 LT 3] DO1\nG1 X#1 F[100.*#1]\n#1=#1+1\nEND1"),
        ("mode in a subprogram", "G1 X1. F100.\nM98 P30\nG1 X2."),
        ("mode behind a block skip", "G1 X1. F100.\n/G95\nG1 X2."),
        ("mode in a loop", "#1=0\nWHILE [#1 LT 3] DO1\nG94 G1 X1. F100.\nG95 G1 X2.\n#1=#1+1\nEND1"),
        ("both modes", "G94 G95 G1 X1. F100."),
        ("helix without centre", "G2 X20. Y0. Z-5. F100."),
        ("helix of a zero radius", "G2 X20. Y0. Z-5. R0. F100."),
        ("helix of an unknown radius", "G2 X20. Y0. Z-5. R#500 F100."),
        ("helix to an unknown height", "G2 X20. Y0. Z#500 R15. F100."),
        ("helix with the height twice", "G2 X20. Y0. Z-5. Z-6. R15. F100."),
        ("dwell without a time", "G4"),
        ("dwell with a time twice", "G4 P500 P600"),
        ("dwell with two times", "G4 P500 X0.5"),
        ("dwell of a negative time", "G4 X-1."),
        ("dwell of no time", "G4 P0"),
        ("dwell of a huge time", "G4 X1000000."),
        ("dwell without a number", "G4 P"),
        ("dwell of letters", "G4 PAUSE"),
        ("dwell of an unknown time", "G4 P#500\nG4 X#500"),
        ("dwell of a computed time", "#1=-1\nG4 X[#1]"),
        ("dwell in a subprogram", "M98 P40"),
        ("dwell behind a block skip", "/G4 X1000."),
        ("dwell in a loop", "#1=0\nWHILE [#1 LT 3] DO1\nG4 X1000.\n#1=#1+1\nEND1"),
    ];
    let subprograms = [("P20", "F100."), ("P30", "G95"), ("P40", "G4 X-1.")];
    let mut table = String::new();
    for (name, block) in cuts {
        for control in ["generic-mill", "haas-mill", "fanuc-mill"] {
            let called = subprograms.iter().filter(|(name, _)| block.contains(name));
            let called: String =
                called.map(|(name, text)| format!("{}\n{text}\nM99\n", name.replace('P', "O"))).collect();
            let text = format!("O10\n{head}{block}\nM30\n{called}");
            let program = on(control, Box::leak(text.into_boxed_str()));
            let found = crate::product::check(&program);
            let _ = writeln!(table, "{name}, {control}: {}", found.join(" "));
        }
    }
    expect_test::expect![[r#"
        F missing, generic-mill: error[feed-missing]
        F missing, haas-mill: error[feed-missing]
        F missing, fanuc-mill: error[feed-missing]
        F doubled, generic-mill: warning[word-given-twice]
        F doubled, haas-mill: warning[word-given-twice]
        F doubled, fanuc-mill: warning[word-given-twice]
        F negative, generic-mill: warning[sign-not-accepted]
        F negative, haas-mill: error[sign-not-accepted]
        F negative, fanuc-mill: error[sign-not-accepted]
        F zero, generic-mill: error[feed-zero]
        F zero, haas-mill: error[feed-zero]
        F zero, fanuc-mill: error[feed-zero]
        F huge, generic-mill: 
        F huge, haas-mill: 
        F huge, fanuc-mill: warning[too-many-digits]
        F without a number, generic-mill: error[address-without-value]
        F without a number, haas-mill: error[address-without-value]
        F without a number, fanuc-mill: error[address-without-value]
        F of letters, generic-mill: error[unexpected-text]
        F of letters, haas-mill: error[unexpected-text]
        F of letters, fanuc-mill: error[unexpected-text]
        F unknown, generic-mill: 
        F unknown, haas-mill: 
        F unknown, fanuc-mill: 
        F computed zero, generic-mill: error[feed-zero]
        F computed zero, haas-mill: error[feed-zero]
        F computed zero, fanuc-mill: error[feed-zero]
        F in a subprogram, generic-mill: 
        F in a subprogram, haas-mill: 
        F in a subprogram, fanuc-mill: 
        F behind a block skip, generic-mill: warning[feed-missing]
        F behind a block skip, haas-mill: warning[feed-missing]
        F behind a block skip, fanuc-mill: warning[feed-missing]
        F in a loop, generic-mill: error[feed-zero]
        F in a loop, haas-mill: error[feed-zero]
        F in a loop, fanuc-mill: error[feed-zero]
        mode in a subprogram, generic-mill: warning[feed-of-another-mode]
        mode in a subprogram, haas-mill: warning[feed-of-another-mode]
        mode in a subprogram, fanuc-mill: warning[feed-of-another-mode]
        mode behind a block skip, generic-mill: info[modal-change-in-skipped-block] warning[feed-of-another-mode]
        mode behind a block skip, haas-mill: info[modal-change-in-skipped-block] warning[feed-of-another-mode]
        mode behind a block skip, fanuc-mill: info[modal-change-in-skipped-block] warning[feed-of-another-mode]
        mode in a loop, generic-mill: warning[feed-of-another-mode]
        mode in a loop, haas-mill: warning[feed-of-another-mode]
        mode in a loop, fanuc-mill: warning[feed-of-another-mode]
        both modes, generic-mill: warning[two-codes-of-one-group] warning[feed-implausible]
        both modes, haas-mill: error[two-codes-of-one-group] warning[feed-implausible]
        both modes, fanuc-mill: warning[two-codes-of-one-group] warning[feed-implausible]
        helix without centre, generic-mill: warning[arc-without-centre] info[tool-down-at-end]
        helix without centre, haas-mill: error[arc-without-centre] info[tool-down-at-end]
        helix without centre, fanuc-mill: warning[arc-without-centre] info[tool-down-at-end]
        helix of a zero radius, generic-mill: warning[zero-radius-arc] info[tool-down-at-end]
        helix of a zero radius, haas-mill: warning[zero-radius-arc] info[tool-down-at-end]
        helix of a zero radius, fanuc-mill: warning[zero-radius-arc] info[tool-down-at-end]
        helix of an unknown radius, generic-mill: info[tool-down-at-end]
        helix of an unknown radius, haas-mill: info[tool-down-at-end]
        helix of an unknown radius, fanuc-mill: info[tool-down-at-end]
        helix to an unknown height, generic-mill: 
        helix to an unknown height, haas-mill: 
        helix to an unknown height, fanuc-mill: 
        helix with the height twice, generic-mill: warning[word-given-twice] info[tool-down-at-end]
        helix with the height twice, haas-mill: warning[word-given-twice] info[tool-down-at-end]
        helix with the height twice, fanuc-mill: warning[word-given-twice] info[tool-down-at-end]
        dwell without a time, generic-mill: info[dwell-without-time]
        dwell without a time, haas-mill: warning[required-word-missing]
        dwell without a time, fanuc-mill: info[dwell-without-time]
        dwell with a time twice, generic-mill: warning[word-given-twice]
        dwell with a time twice, haas-mill: warning[word-given-twice]
        dwell with a time twice, fanuc-mill: warning[word-given-twice]
        dwell with two times, generic-mill: warning[words-exclude-each-other]
        dwell with two times, haas-mill: warning[axis-word-unsure]
        dwell with two times, fanuc-mill: warning[words-exclude-each-other]
        dwell of a negative time, generic-mill: error[number-out-of-range]
        dwell of a negative time, haas-mill: warning[dwell-time-in-other-word]
        dwell of a negative time, fanuc-mill: warning[number-out-of-range]
        dwell of no time, generic-mill: warning[number-out-of-range]
        dwell of no time, haas-mill: 
        dwell of no time, fanuc-mill: 
        dwell of a huge time, generic-mill: error[number-out-of-range]
        dwell of a huge time, haas-mill: warning[dwell-time-in-other-word]
        dwell of a huge time, fanuc-mill: info[dwell-very-long]
        dwell without a number, generic-mill: error[address-without-value]
        dwell without a number, haas-mill: error[address-without-value]
        dwell without a number, fanuc-mill: error[address-without-value]
        dwell of letters, generic-mill: error[unexpected-text]
        dwell of letters, haas-mill: error[unexpected-text]
        dwell of letters, fanuc-mill: error[unexpected-text]
        dwell of an unknown time, generic-mill: 
        dwell of an unknown time, haas-mill: warning[dwell-time-in-other-word]
        dwell of an unknown time, fanuc-mill: 
        dwell of a computed time, generic-mill: error[computed-value-out-of-range]
        dwell of a computed time, haas-mill: warning[dwell-time-in-other-word]
        dwell of a computed time, fanuc-mill: warning[computed-value-out-of-range]
        dwell in a subprogram, generic-mill: error[number-out-of-range]
        dwell in a subprogram, haas-mill: warning[dwell-time-in-other-word]
        dwell in a subprogram, fanuc-mill: warning[number-out-of-range]
        dwell behind a block skip, generic-mill: info[dwell-very-long]
        dwell behind a block skip, haas-mill: warning[dwell-time-in-other-word]
        dwell behind a block skip, fanuc-mill: info[dwell-very-long]
        dwell in a loop, generic-mill: info[dwell-very-long]
        dwell in a loop, haas-mill: warning[dwell-time-in-other-word]
        dwell in a loop, fanuc-mill: info[dwell-very-long]
    "#]].assert_eq(&table);
}
