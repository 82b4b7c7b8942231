//! G150, general purpose pocket milling: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::Proof::{Assumes, Explains, Legal, Rule, Run, Stats};
use crate::proof::{Program, Proof, legal, noticed, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G150, general purpose pocket milling",
    key: "G150",
    source: "Haas 96-8000 rev AC, May 2010, p. 184; June 1999, p. 208",
    module: "pockets",
    sentences: SENTENCES,
};

const CONTROL: &str = "haas-mill";

/// A pocket as a machinist writes it: hole drilled, end mill, compensation, outline.
const POCKET: &str = "\
%
O00082 (POCKET)
(T1 - 7/16 DRILL)
(T2 - 3/8 END MILL)
G20 G17 G40 G49 G80 G90
T1 M6
G0 G54 X0. Y0. S1800 M3
G43 H1 Z0.5 M8
G83 Z-0.375 R0.1 Q0.1 F6.
G80 M9
T2 M6
G0 G54 X0. Y0. S4200 M3
G43 H2 Z0.5 M8
G150 P83 G41 D2 X0. Y0. Z-0.375 Q0.125 R0.1 J0.2 K0.015 F18.
G40 G1 X0. Y0.
G0 Z0.5 M9
M5
G91 G28 Z0.
G90
M30
O00083 (OUTLINE)
G1 Y0.75
X-1.
G3 X-1.25 Y0.5 J-0.25
G1 Y-0.5
G3 X-1. Y-0.75 I0.25
G1 X1.
G3 X1.25 Y-0.5 J0.25
G1 Y0.5
G3 X1. Y0.75 I-0.25
G1 X0.
M99
%
";

const fn pocket(text: &'static str) -> Program {
    on(CONTROL, text)
}

const SENTENCES: &[Sentence] = &[
    Sentence {
        says: "Clears a pocket of any outline; the start hole is drilled before",
        literal: By(&[
            Legal { program: on(CONTROL, POCKET) },
            Explains { control: CONTROL, code: "G150", says: "Drill the start hole first" },
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-1.\nG150 P9 G41 D1 X0. Y0. Z#1 Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("see the words"),
missing: By(&[
rule("warning[subprogram-missing]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
extra: By(&[
noticed("info", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. A1.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: No("see the words"),

    },
    Sentence {
        says: "D selects the offset of the tool's size, for cutter compensation on the outline",
        literal: By(&[
            Assumes { program: on(CONTROL, POCKET), says: "the diameter of tool 2 is not known" },
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=1\nG150 P9 G41 D#1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
noticed("error", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-1\nG150 P9 G41 D#1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=1\nG150 P9 G41 D#1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nD1\nG150 P9 G41 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
missing: By(&[
            Rule {
                finding: "info[pocket-without-compensation]",
                violates: pocket(
                    "G20 G54 G90 G0 X0. Y0.\nG150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
                ),
                conforms: pocket(
                    "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
                ),
            },
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 D2 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
noticed("error", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1.5 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
noticed("error", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D-1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),

    },
    Sentence {
        says: "G41 or G42 belongs to it and is cancelled by G40",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: No("no value"),
lasting: No("see G150-2"),
missing: By(&[
Rule {
            finding: "warning[compensation-left-on]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG0 X.1\nT2 M6\nG40\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X.1\nT2 M6\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
        },
]),
extra: By(&[
rule("error[two-codes-of-one-group]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 G42 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: No("no range"),

    },
    Sentence {
        says: "F is the feed",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=10.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F#1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[feed-zero]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F#1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=10.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F#1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nF10.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
missing: By(&[
Rule {
            finding: "error[feed-missing]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2\nG40 X.1\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X.1\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
        },
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. F20.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
rule("error[feed-zero]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F0.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[sign-not-accepted]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F-10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),

    },
    Sentence {
        says: "I is the step in X, J the step in Y: exactly one of them",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 J.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[words-exclude-each-other]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 J#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 J#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("not lasting"),
missing: By(&[
            Rule {
                finding: "error[word-choice-missing]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 J.2 F10.\nM30\n"),
            },
]),
extra: By(&[
            Rule {
                finding: "error[words-exclude-each-other]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 J.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
            },
]),
range: No("see G150-6"),

    },
    Sentence {
        says: "I and J are positive",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 J[#1*0.5] F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.4\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 J[#1*0.5] F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("warning[maybe-computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nIF [#500 EQ 1] GOTO 10\n#1=0\nN10 G150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nIF [#500 EQ 1] GOTO 10\n#1=.3\nN10 G150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("not lasting"),
missing: No("see G150-5"),
extra: No("see G150-5"),
range: By(&[
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I-.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
            },
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 J0. F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 J#1 F10.\nM30\n"),
            },
]),

    },
    Sentence {
        says: "A step above the tool's diameter leaves ridges",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.4 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n").with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"])),
]),
computed: By(&[
rule("warning[pocket-step-above-tool]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.6\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n").with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"]), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.4\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n").with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"])),
]),
lasting: By(&[
rule("warning[pocket-step-above-tool]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nD1\nG150 P9 G41 X0. Y0. Z-1. Q.2 R.1 I.6 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n").with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"]), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nD1\nG150 P9 G41 X0. Y0. Z-1. Q.2 R.1 I.4 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n").with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"])),
]),
missing: No("see G150-5"),
extra: No("see G150-5"),
range: By(&[
Rule {
            finding: "warning[pocket-step-above-tool]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.6 F10.\nG40 X0.\nM30\n",
            )
            .with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"]),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.4 F10.\nG40 X0.\nM30\n",
            )
            .with(&["machine.units=\"inch\"", "tools.1.diameter=0.5"]),
        },
]),

    },
    Sentence {
        says: "K is the width of the finishing pass on the wall, not below zero; the floor has none",
        literal: By(&[
            Explains { control: CONTROL, code: "G150", says: "The floor gets no finishing pass" },
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.01\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K.01 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-0.01\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.01\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K#1 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("not lasting"),
missing: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K.01 K.02 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K.01 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K-.01 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 K.01 F10.\nM30\n"),
            },
]),

    },
    Sentence {
        says: "P names the program that holds the outline",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=9\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=9.5\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=9\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-9\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=9\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("warning[computed-subprogram-missing]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=8\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=9\nG150 P#1 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("not lasting"),
missing: By(&[
            Rule {
                finding: "error[required-word-missing]",
                violates: pocket("G150 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\n"),
            },
            Assumes {
                program: pocket(
                    "O1\nG54 G90 G0 X0. Y0.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0.\nM30\n",
                ),
                says: "what program 9 does is not known",
            },
rule("warning[subprogram-missing]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P8 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 P8 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
noticed("error", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9.5 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[number-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P-9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),

    },
    Sentence {
        says: "The outline is closed: its last move ends where its first one leads",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: No("see G150-11"),
lasting: No("no word"),
missing: By(&[
Rule {
            finding: "error[pocket-outline-open]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
        },
]),
extra: No("no other word"),
range: No("no range"),

    },
    Sentence {
        says: "The outline holds straight moves and arcs in X and Y, no cycle and no tool change, and ends with M99",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
rule("warning[pocket-outline-unfit]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\n#2=1.\nG1 Y#2\nX#2\nY[0-#2]\nX[0-#2]\nY#2\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("no word"),
missing: By(&[
            Rule {
                finding: "error[pocket-outline-unfit]",
                violates: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nM99\n"),
            },
]),
extra: By(&[
            Rule {
                finding: "error[pocket-outline-unfit]",
                violates: pocket(
                    "G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nG81 Z-1. R.1\nM99\n",
                ),
                conforms: pocket(
                    "G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nG2 X1. Y0. R1.\nG3 X0. Y1. R1.\nM99\n",
                ),
            },
            Rule {
                finding: "error[pocket-outline-unfit]",
                violates: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nT3 M6\nM99\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nM99\n"),
            },
rule("warning[pocket-outline-unfit]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX1.\nZ-2.\nY-1.\nX-1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: No("no range"),

    },
    Sentence {
        says: "An outline has at most so many moves: 40 in the older books",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: No("no word"),
lasting: No("no word"),
missing: No("no word"),
extra: No("no word"),
range: By(&[
Rule {
            finding: "warning[pocket-outline-too-long]",
            violates: pocket(concat!(
                "G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\n",
                "X1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\n",
                "X1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\nX1.\nX2.\n",
                "M99\n"
            )),
            conforms: pocket("G150 P9 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX1.\nM99\n"),
        },
]),

    },
    Sentence {
        says: "Q is the depth of a layer, positive, needed for one layer too",
        literal: By(&[
            Run {
                program: on(CONTROL, POCKET).with(&[
                    "machine.units=\"inch\"",
                    "tools.1.length=4",
                    "tools.2={ length = 4.0, diameter = 0.375 }",
                ]),
                prints: &[
                    "rapid 0.0000 0.0000 0.1000",
                    "feed 0.0000 0.0000 -0.0250",
                    "feed 0.0000 0.0000 -0.1500",
                    "feed 0.0000 0.0000 -0.2750",
                    "feed 0.0000 0.0000 -0.3750",
                    "an estimate: the path is the control's own",
                    "rapid 0.0000 0.0000 0.1000",
                ],
            },
]),
computed: By(&[
same(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q#1 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q#1 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q#1 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
rule("error[computed-value-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q[#1-#1] R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.2\nG150 P9 G41 D1 X0. Y0. Z-1. Q[#1+#1] R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("not lasting"),
missing: By(&[
            Rule {
                finding: "error[required-word-missing]",
                violates: pocket("G150 P9 X0. Y0. Z-1. R.1 I.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q1. R.1 I.2 F10.\nM30\n"),
            },
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 Q.3 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
            Rule {
                finding: "error[number-out-of-range]",
                violates: pocket("G150 P9 X0. Y0. Z-1. Q0. R.1 I.2 F10.\nM30\n"),
                conforms: pocket("G150 P9 X0. Y0. Z-1. Q1. R.1 I.2 F10.\nM30\n"),
            },
rule("error[number-out-of-range]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q-.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),

    },
    Sentence {
        says: "R is the level of rapid moves, above the floor",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
rule("warning[cycle-r-below-bottom]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-2.\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R#1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.1\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R#1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: No("not lasting"),
missing: By(&[
rule("warning[lasting-word-never-given]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 R.2 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
Rule {
            finding: "warning[cycle-r-below-bottom]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z.5 Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X0. Y0. Z-.5 Q.2 R.1 I.2 F10.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
        },
]),

    },
    Sentence {
        says: "S may give the spindle's speed",
        literal: By(&[
Legal {
            program: pocket(
                "O1\nG20 G54 G90 G0 X0. Y0.\nM3\nG150 P9 G41 D1 S3000 X0. Y0. Z-.5 Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n",
            ),
        },
]),
computed: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=3000\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S#1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
noticed("warning", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-3000\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S#1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=3000\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S#1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
lasting: By(&[
run(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S3000\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), &["3000 rpm"]),
]),
missing: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S3000 S2000\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S3000\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
noticed("warning", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S-3000\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. S3000\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),

    },
    Sentence {
        says: "X and Y name the start hole, which lies inside the outline",
        literal: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
computed: By(&[
rule("error[pocket-start-outside]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=2.\nG150 P9 G41 D1 X#1 Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=0.5\nG150 P9 G41 D1 X#1 Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n")),
]),
lasting: By(&[
legal(pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
missing: By(&[
noticed("info", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG0 X5.\nG150 P9 G41 D1 Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. X.5 Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
Rule {
            finding: "error[pocket-start-outside]",
            violates: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X2. Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
            conforms: pocket(
                "G20 G54 G90 G0 X0. Y0.\nG150 P9 X.5 Y0. Z-1. Q.2 R.1 I.2 F10.\nM30\nO9\nG1 X0. Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n",
            ),
        },
]),

    },
    Sentence {
        says: "How the control clears the pocket is its own: levels and extents are computed, the time is an estimate and said to be one",
        literal: By(&[
            Stats {
                program: on(CONTROL, POCKET).with(&[
                    "machine.units=\"inch\"",
                    "tools.1.length=4",
                    "tools.2={ length = 4.0, diameter = 0.375 }",
                ]),
                prints: &[
                    "T2 cutting -1.0625 1.0625 -0.5625 0.5625 -0.3750 0.1000",
                    "of cutting are an estimate",
                ],
            },
            Assumes {
                program: on(CONTROL, POCKET),
                says: "a pocket that the control clears leaves the tool over its start hole, at the rapid level",
            },
]),
computed: By(&[
Proof::Stats { program: pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\n#1=-1.\nG150 P9 G41 D1 X0. Y0. Z#1 Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n").with(&["machine.units=\"inch\"", "tools.1={ length = 4.0, diameter = 0.375 }"]), prints: &["of cutting are an estimate"] },
]),
lasting: No("no word"),
missing: By(&[
Proof::Assumes { program: pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10.\nG40 X0. Y0.\nM30\n"), says: "what program 9 does is not known" },
]),
extra: No("no other word"),
range: No("no range"),

    },
    Sentence {
        says: "L with G91 repeats the pocket at a distance",
        literal: By(&[
Run {
            program: pocket(
                "O1\nG21 G54 G90 G0 X0. Y0.\nG91 G150 P9 X20. Z-5. Q2. R1. I2. L3 F100.\nG90 G0 Y5.\nM30\nO9\nG1 Y9.\nX9.\nM99\n",
            ),
            prints: &["rapid 60.0000 5.0000"],
        },
]),
computed: By(&[
run(pocket("O1\nG21 G54 G90 G0 X0. Y0.\n#1=3\nG91 G150 P9 X20. Z-5. Q2. R1. I2. L#1 F100.\nG90 G0 Y5.\nM30\nO9\nG1 Y9.\nX9.\nM99\n"), &["rapid 60.0000 5.0000"]),
]),
lasting: No("not lasting"),
missing: By(&[
run(pocket("O1\nG21 G54 G90 G0 X0. Y0.\nG91 G150 P9 X20. Z-5. Q2. R1. I2. F100.\nG90 G0 Y5.\nM30\nO9\nG1 Y9.\nX9.\nM99\n"), &["rapid 20.0000 5.0000"]),
]),
extra: By(&[
rule("warning[word-given-twice]", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. L1 L2\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. L1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),
range: By(&[
noticed("error", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. L1.5\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. L1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
noticed("warning", pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. L-1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n"), pocket("O1\nG20 G90 G54 G0 X0. Y0.\nS900 M3\nG150 P9 G41 D1 X0. Y0. Z-1. Q.2 R.1 I.2 F10. L1\nG40 X0. Y0.\nM30\nO9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n")),
]),

    },
];

#[test]
fn holds() {
    prove(&SYSTEM);
}
