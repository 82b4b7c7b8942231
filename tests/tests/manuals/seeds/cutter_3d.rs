//! G141, 3D+ cutter compensation: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::{Program, Proof, legal, noticed, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

/// A program for the mill of the page.
const fn mill(text: &'static str) -> Program {
    on("haas-mill", text)
}

/// Cutters of half an inch and of an inch.
const TWO: &[&str] = &["tools.1.diameter=0.5", "tools.2.diameter=1.0"];

/// A cutter of half an inch.
const HALF: &[&str] = &["tools.1.diameter=0.5"];

/// The page's forms of a block: with the code, then `G01` and `G00` without it.
const FORMS: &str = "\
%
O0141
T1 M06
G00 G90 G54 X0. Y0. S9000 M03
G43 H01 Z1.
G01 G141 X1. Y0.2 Z0.5 I0. J0.6 K0.8 F20. D01
G01 X2. Y0.3 Z0.4 I0. J0. K1. F25.
G00 X2. Y0.3 Z2. I0. J0. K1.
G40
G49 G53 G00 Z0.
M30
%
";

const INVERSE_TIME: &str = "\
G90 G93 G01 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.
X2. Y0. Z0. I0. J0. K1. F60.
G94 F20.
G40
M30
";

pub(crate) const SYSTEM: System = System {
    title: "G141, 3D+ cutter compensation",
    key: "G141",
    source: "Haas 96-8000 rev R, June 2007, p. 153",
    module: "cutter_3d",
    sentences: &[
        Sentence {
            says: "X, Y and Z are the point of the block; A and B may be given too.",
            literal: By(&[
                Proof::Run {
                    program: mill(FORMS).with(HALF),
                    prints: &["programmed point X1 Y0.2 Z0.5, axes at X1 Y0.35 Z0.7"],
                },
                Proof::Run {
                    program: mill("G90 G1 G141 D1 X1. Y0. Z0. A10. B-5. I0. J0. K1. F20.\nG40\nM30\n").with(HALF),
                    prints: &["feed 1.0000 0.0000 0.2500 10.0000 -5.0000"],
                },
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1.\nG1 G141 D1 X#1 Y[#1-1.] Z0. A[#1*10.] I0. J0. K1. F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. A10. I0. J0. K1. F20.\nG40\nM30\n").with(HALF)),
]),
lasting: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nG40\nM30\n").with(HALF), &["programmed point X2 Y0 Z0, axes at X2 Y0 Z0.25"]),
]),
missing: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. I0. J0. K1. F20.\nG40\nM30\n").with(HALF), &["programmed point X1 Y0 Z0, axes at X1 Y0 Z0"]),
rule("warning[cutter-vector-without-axis]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
extra: By(&[
noticed("info", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20. Q2.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
noticed("info", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. R1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
range: By(&[
rule("error[axis-not-on-machine]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. A5. I0. J0. K1. F20.\nG40\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\"]"]), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\"]"])),
]),

        },
        Sentence {
            says: "D selects the size of the cutter and stays in effect.",
            literal: By(&[
                Proof::Assumes { program: mill(FORMS), says: "the diameter of tool 1 is not known" },
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(HALF), &["axes at X1 Y0 Z0.25"]),
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1\nG1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(HALF)),
rule("warning[cutter-vector-without-size]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=0\nG1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1\nG1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
rule("info[computed-value-out-of-range]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1.5\nG1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1\nG1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1.5\nG1 G141 D#1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(TWO), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D2 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(TWO)),
]),
lasting: By(&[
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nD2 X3. Z0. I0. J0. K1.\nG40\nM30\n")
                        .with(&["tools.1.diameter=0.5", "tools.2.diameter=1.0"]),
                    prints: &["axes at X1 Y0 Z0.25", "axes at X2 Y0 Z0.25", "axes at X3 Y0 Z0.5"],
                },
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nD1\nG1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(HALF)),
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nD1\nG1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G41 D1 X-1. F20.\nG40 X0.\nG1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
missing: By(&[
                Proof::Rule {
                    finding: "error[cutter-vector-without-size]",
                    violates: mill("G90 G1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nG1 G141 X2. Y0. Z0. I0. J0. K1.\nG40\nM30\n"),
                },
]),
extra: By(&[
rule("warning[word-given-twice]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 D2 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
range: By(&[
                Proof::Rule {
                    finding: "warning[cutter-vector-without-size]",
                    violates: mill("G90 G1 G141 D0 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
noticed("error", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D-1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
noticed("error", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1.5 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),

        },
        Sentence {
            says: "The word table calls I, J and K depths of pecks; the text makes them the direction of the compensation.",
            literal: By(&[
Proof::Explains {
                control: "haas-mill",
                code: "G141",
                says: "The 2007 manual's word table explains I, J, K as peck depths; its text is right.",
            },
]),
computed: No("no word"),
lasting: No("no word"),
missing: No("no word"),
extra: No("no word"),
range: No("no word"),

        },
        Sentence {
            says: "F is the feed under G93 or G94; under G94 it stays in effect.",
            literal: By(&[
                Proof::Legal { program: mill(INVERSE_TIME) },
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=20.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F#1\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(HALF)),
rule("error[feed-zero]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=0\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F#1\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=20.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F#1\nG40\nM30\n")),
]),
lasting: By(&[
                Proof::Legal { program: mill("G90 G94 G01 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nG40\nM30\n") },
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nF20.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1.\nX2. I0. J0. K1.\nG40\nM30\n").with(HALF), &["feed 1.0000 0.0000 0.2500 20", "feed 2.0000 0.0000 0.2500 20"]),
rule("error[inverse-time-feed-missing]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93 F60.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1.\nG94 F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nG94 F20.\nG40\nM30\n")),
]),
missing: By(&[
rule("error[feed-missing]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20. F30.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
range: By(&[
rule("error[feed-zero]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F0.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
rule("error[sign-not-accepted]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F-20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),

        },
        Sentence {
            says: "The form: G141 with X Y Z, I J K, F and D; then G01 with X Y Z, I J K, F, or G00 with X Y Z, I J K.",
            literal: By(&[
                Proof::Legal { program: mill(FORMS) },
                Proof::Run {
                    program: mill(FORMS).with(HALF),
                    prints: &[
                        "feed 1.0000 0.3500 0.7000 20",
                        "feed 2.0000 0.3000 0.6500 25",
                        "rapid 2.0000 0.3000 2.2500",
                    ],
                },
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=0.6\n#2=0.8\nG1 G141 D1 X1. Y0. Z0. I0. J#1 K#2 F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0.6 K0.8 F20.\nG40\nM30\n").with(HALF)),
]),
lasting: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. Y0. Z0. I0. J0. K1.\nG0 X3. Y0. Z0. I0. J0. K1.\nG40\nM30\n")),
]),
missing: By(&[
rule("error[cutter-vector-without-size]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. F20.\nX2. Y0. Z0. I0. J0. K1.\nG40\nM30\n")),
rule("warning[cutter-vector-incomplete]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. F20.\nX2. Y0. Z0.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. F20.\nX2. Y0. Z0. I0. J0. K1.\nG40\nM30\n")),
]),
extra: By(&[
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG2 X2. Y1. R1.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG1 X2. Y1. Z0. I0. J0. K1.\nG40\nM30\n")),
noticed("info", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20. Q2.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
range: No("see the words"),

        },
        Sentence {
            says: "I, J and K give the direction of the compensation: between the centre of the tool and its contact point.",
            literal: By(&[
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y1. Z1. I1. J0. K0. F20.\nX1. Y1. Z1. I0. J-1. K0.\nX1. Y1. Z1. I0. J0. K1.\nG40\nM30\n")
                        .with(HALF),
                    prints: &["axes at X1.25 Y1 Z1", "axes at X1 Y0.75 Z1", "axes at X1 Y1 Z1.25"],
                },
                Proof::Explains {
                    control: "haas-mill",
                    code: "G141",
                    says: "X part of the unit vector between tool centre and contact point",
                },
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=30.\nG1 G141 D1 X1. Y1. Z1. I0. J[SIN[#1]] K[COS[#1]] F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. I0. J0.5 K[COS[30.]] F20.\nG40\nM30\n").with(HALF)),
]),
lasting: By(&[
rule("warning[cutter-vector-incomplete]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nG40\nM30\n")),
]),
missing: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. K1. F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. I0. J0. K1. F20.\nG40\nM30\n").with(HALF)),
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. K1. F20.\nG40\nM30\n")),
rule("error[cutter-vector-not-unit]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. K.8 F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. J.6 K.8 F20.\nG40\nM30\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. K-1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
range: By(&[
rule("error[cutter-vector-not-unit]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K2. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),

        },
        Sentence {
            says: "The control needs the vector to shift the path in the right direction.",
            literal: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y1. Z1. I0. J-0.6 K0.8 F20.\nG40\nM30\n").with(HALF), &["axes at X1 Y0.85 Z1.2"]),
]),
computed: By(&[
rule("error[cutter-vector-not-unit]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=0.6\nG1 G141 D1 X1. Y0. Z0. J#1 F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=0.6\nG1 G141 D1 X1. Y0. Z0. J#1 K[0.8] F20.\nG40\nM30\n")),
]),
lasting: By(&[
                Proof::Rule {
                    finding: "warning[cutter-vector-incomplete]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y1. Z1. I0. J0. K1. F20.\nX2. Y1. Z1.\nG40\nM30\n").with(HALF),
                    prints: &["programmed point X2 Y1 Z1, axes at X? Y? Z?"],
                },
]),
missing: By(&[
                Proof::Rule {
                    finding: "warning[cutter-vector-incomplete]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG0 X2. Y0. Z1.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
]),
extra: No("see G141-5"),
range: No("see G141-14"),

        },
        Sentence {
            says: "The compensation may be positive or negative.",
            literal: By(&[
Proof::Run {
                program: mill(FORMS).with(&["tools.1.diameter=-0.5"]),
                prints: &["programmed point X1 Y0.2 Z0.5, axes at X1 Y0.05 Z0.3"],
            },
]),
computed: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\n#1=-0.5\nG10 L12 P1 R#1\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(&["settings.40=\"radius\""]), &["axes at X1 Y0 Z-0.5"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. I0. J0. K1.\nG40\nM30\n").with(&["tools.1.diameter=-0.5"]), &["axes at X1 Y0 Z-0.25", "axes at X2 Y0 Z-0.25"]),
]),
missing: No("see G141-2"),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "The offset is entered as radius or diameter (Setting 40), and the path is compensated by it.",
            literal: By(&[
                Proof::Run {
                    program: mill("G20 G90 G10 L12 P1 R0.5\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")
                        .with(&["settings.40=\"radius\""]),
                    prints: &["axes at X1 Y0 Z0.5"],
                },
                Proof::Run {
                    program: mill("G20 G90 G10 L12 P1 R0.5\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")
                        .with(&["settings.40=\"diameter\""]),
                    prints: &["axes at X1 Y0 Z0.25"],
                },
]),
computed: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\n#1=0.25\nG10 L12 P1 R[#1*2.]\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(&["settings.40=\"radius\""]), &["axes at X1 Y0 Z0.5"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nG10 L12 P1 R0.5\nT2 M6\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(&["settings.40=\"radius\""]), &["axes at X1 Y0 Z0.5"]),
]),
missing: By(&[
Proof::Assumes { program: mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), says: "diameter of" },
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "The whole amount counts, though a move is one of two or three axes.",
            literal: By(&[
Proof::Run {
                program: mill("G20 G90 G1 G141 D1 X1. Y1. Z1. I0. J0. K1. F20.\nX2. Y2. Z1. I0. J0.6 K0.8\nX3. Y2. I0. J0.6 K0.8\nG40\nM30\n")
                    .with(HALF),
                prints: &[
                    "programmed point X2 Y2 Z1, axes at X2 Y2.15 Z1.2",
                    "programmed point X3 Y2 Z1, axes at X3 Y2.15 Z1.2",
                ],
            },
]),
computed: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=0.6\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nX2. Y1. Z0. I0. J#1 K[#1+0.2]\nG40\nM30\n").with(HALF), &["programmed point X2 Y1 Z0, axes at X2 Y1.15 Z0.2"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z3. I0. J0. K1. F20.\nX2. I0. J0. K1.\nG40\nM30\n").with(HALF), &["axes at X2 Y0 Z3.25"]),
]),
missing: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. I0. J0.6 K0.8 F20.\nG40\nM30\n").with(HALF), &["axes at X1 Y0.15 Z0"]),
]),
extra: No("no other word"),
range: No("no range"),

        },
        Sentence {
            says: "Only G00 and G01 can be used with G141.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG0 X2. Y0. Z0. I0. J0. K1.\nG40\nM30\n")),
]),
computed: By(&[
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=2\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG#1 X2. Y1. R1.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG#1 X2. Y1. Z0. I0. J0. K1.\nG40\nM30\n")),
]),
lasting: By(&[
rule("warning[maybe-refused-in-five-axis-mode]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nIF [#500 EQ 1] GOTO 10\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nN10 G2 X2. Y1. R1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nIF [#500 EQ 1] GOTO 10\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nN10 G40\nG2 X2. Y1. R1. F20.\nM30\n")),
]),
missing: No("no word"),
extra: By(&[
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG3 X2. Y1. R1.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Rule {
                    finding: "error[refused-in-five-axis-mode]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG81 X1. Z-1. R0.1\nG80\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
                Proof::Rule {
                    finding: "warning[refused-in-five-axis-mode]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG41 D1 X2.\nG40\nM30\n"),
                    conforms: mill(FORMS),
                },
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG2 X2. Y1. R1.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
rule("error[refused-in-five-axis-mode]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG12 I0.5 D1 Z-0.1\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
noticed("error", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG31 Y-1. F10. M79\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
noticed("error", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
range: No("no range"),

        },
        Sentence {
            says: "D chooses which offset is used.",
            literal: By(&[
Proof::Run {
                program: mill("G20 G90 G1 G141 D2 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")
                    .with(&["tools.1.diameter=0.5", "tools.2.diameter=1.0"]),
                prints: &["axes at X1 Y0 Z0.5"],
            },
]),
computed: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1\nG1 G141 D[#1+1] X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(&["tools.1.diameter=0.5", "tools.2.diameter=1.0"]), &["axes at X1 Y0 Z0.5"]),
]),
lasting: By(&[
run(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nD2\nG1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n").with(&["tools.1.diameter=0.5", "tools.2.diameter=1.0"]), &["axes at X1 Y0 Z0.5"]),
]),
missing: By(&[
rule("error[cutter-vector-without-size]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
extra: No("see G141-2"),
range: No("see G141-2"),

        },
        Sentence {
            says: "Under G93 a feed is required in each block.",
            literal: By(&[
legal(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nX2. I0. J0. K1. F60.\nG94 F20.\nG40\nM30\n")),
]),
computed: By(&[
same(mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=60.\nG93 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F#1\nG94 F20.\nG40\nM30\n").with(HALF), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nG94 F20.\nG40\nM30\n").with(HALF)),
]),
lasting: By(&[
rule("error[inverse-time-feed-missing]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93 F60.\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1.\nG94 F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nG94 F20.\nG40\nM30\n")),
]),
missing: By(&[
Proof::Rule {
                finding: "error[inverse-time-feed-missing]",
                violates: mill("G90 G93 G01 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nX2. I0. J0. K1.\nG40\nM30\n"),
                conforms: mill(INVERSE_TIME),
            },
]),
extra: No("see G141-4"),
range: By(&[
rule("error[feed-zero]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F0.\nG94 F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG93 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F60.\nG94 F20.\nG40\nM30\n")),
]),

        },
        Sentence {
            says: "The vector is a unit vector: I² + J² + K² must equal 1.",
            literal: By(&[
                Proof::Run {
                    program: mill("G21 G90 G1 G141 D1 X1. Y0. Z0. I0. J0.6 K0.8 F20.\nG40\nM30\n")
                        .with(&["machine.units=\"mm\"", "tools.1.diameter=10.0"]),
                    prints: &["axes at X1 Y3 Z4"],
                },
]),
computed: By(&[
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("#1=0.9\nG90 G1 G141 D1 X1. Y0. Z0. I#1 J#1 K0. F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I#501 J#502 K0. F20.\nG40\nM30\n"),
                },
rule("warning[cutter-vector-not-unit]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1.\nIF [#500 EQ 1] GOTO 10\n#1=0.5\nN10 G1 G141 D1 X1. Y0. Z0. I0. J0. K#1 F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\n#1=1.\nIF [#500 EQ 1] GOTO 10\n#1=-1.\nN10 G1 G141 D1 X1. Y0. Z0. I0. J0. K#1 F20.\nG40\nM30\n")),
]),
lasting: No("not lasting"),
missing: No("see G141-7"),
extra: No("see G141-6"),
range: By(&[
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.5 J0.5 K0.5 F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.5774 J0.5774 K0.5774 F20.\nG40\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.580 J0.580 K0.580 F20.\nG40\nM30\n"),
                    conforms: mill("G90 G1 G141 D1 X1. Y0. Z0. I0.58 J0.58 K0.58 F20.\nG40\nM30\n"),
                },
                Proof::Rule {
                    finding: "error[cutter-vector-not-unit]",
                    violates: mill("G21 G90 G1 G141 D1 X1. Y0. Z0. I0 J0 K1 F20.\nG40\nM30\n"),
                    conforms: mill("G21 G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n"),
                },
rule("error[cutter-vector-not-unit]", mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K0. F20.\nG40\nM30\n"), mill("O1\nG20 G90 G54 G0 X0. Y0. Z0.\nS900 M3\nG1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),

        },
        Sentence {
            says: "The modal group of cutter compensation (07) holds it until G40; it is not to be left on.",
            literal: By(&[
                Proof::Run {
                    program: mill("G20 G90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nG0 X0. Y0. Z3.\nM30\n").with(HALF),
                    prints: &["feed 1.0000 0.0000 0.2500", "rapid 0.0000 0.0000 3.0000"],
                },
]),
computed: No("no word"),
lasting: By(&[
                Proof::Rule {
                    finding: "warning[compensation-left-on]",
                    violates: mill("T1 M6\nG90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nT2 M6\nG40\nM30\n"),
                    conforms: mill("T1 M6\nG90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nT2 M6\nM30\n"),
                },
]),
missing: By(&[
rule("error[compensation-left-on]", mill("T1 M6\nG90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nM30\n"), mill("T1 M6\nG90 G1 G141 D1 X1. Y0. Z0. I0. J0. K1. F20.\nG40\nM30\n")),
]),
extra: No("no other word"),
range: No("no range"),

        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
