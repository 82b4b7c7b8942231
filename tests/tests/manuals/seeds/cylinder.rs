//! G107, cylindrical mapping: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::Proof::{Assumes, Explains, Legal, Rule, Run, Stats};
use crate::proof::{Program, Proof, legal, noticed, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G107, cylindrical mapping",
    key: "G107",
    source: "Haas 96-8000, June 1999, p. 203",
    module: "cylinder",
    sentences: SENTENCES,
};

const CONTROL: &str = "haas-mill";

/// A wrapped slot with rounded ends, compensated, on a diameter of 4 inches: what the page's own example does.
const SLOT: &str = "\
%
O00081 (WRAPPED SLOT)
T1 M6
G0 G20 G40 G49 G80 G90 G17
G54 X2. Y0. A0.
S4500 M3
G107 Y0. A0. R2.
G43 H1 Z0.2
G1 Z-0.1 F20.
G41 D1 X2.5 Y0.4
G3 X2. Y0.9 R0.5
G1 X-2.
G3 X-2.5 Y0.4 R0.5
G1 Y-0.4
G3 X-2. Y-0.9 R0.5
G1 X2.
G3 X2.5 Y-0.4 R0.5
G1 Y0.
G40 X2.
G0 Z0.5
M9
M5
G91 G28 Z0.
G28 Y0.
G90
G107
M30
%
";

/// Moves after `G107` blocks, millimetres: 31.4159 mm of a 100 mm cylinder are 36 degrees.
const fn wrapped(text: &'static str) -> Program {
    on(CONTROL, text)
}

const SENTENCES: &[Sentence] = &[
    Sentence {
        says: "Motion of a linear axis becomes the equivalent motion along the surface of a cylinder on a rotary axis, in both directions",
        literal: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nY-31.4159\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "feed 0.0000 31.4159 ? 36.0000", "feed 0.0000 -31.4159 ? -36.0000"],
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. B0.\nG107 X0. B0. Q100.\nG1 X31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, X on B", "feed 31.4159 0.0000 ? 36.0000"],
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG2 X20. Y0. I10. J0. F100.\nG3 Y40. J20.\nG107\nM30\n",
                ),
                prints: &[
                    "arc 20.0000 0.0000 ? 0.0000",
                    "arc 20.0000 40.0000 ? 45.8366",
                ],
            },
]),
computed: By(&[
same(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#100=100.\nG107 Y0. A0. Q#100\nG1 Y[#100*0.314159] F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.416 F100.\nG107\nM30\n")),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 X5. F100.\nY31.4159\nG0 Y0.\nG107\nM30\n"), &["5.0000 31.4159 0.0000 36.0000", "rapid 5.0000 0.0000 0.0000 0.0000"]),
]),
missing: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["feed 0.0000 31.4159 0.0000 0.0000"]),
]),
extra: No("see G107-11"),
range: No("no range"),

    },
    Sentence {
        says: "The linear axis itself does not move: its machine coordinate stays, and counts again when mapping ends",
        literal: By(&[
Run {
            program: wrapped(
                "O1\nG21 G90 G54 G0 X0. Y5. A0.\nG107 Y0. A0. Q100.\nG1 Y36.4159 F100.\nX#5022\nG107\nG91 G0 Y0.\nM30\n",
            )
            .with(&["machine.units=\"mm\"", "offsets.G54={ X = 0.0, Y = 100.0, Z = 0.0, A = 0.0 }"]),
            prints: &["feed 0.0000 36.4159 ? 36.0000", "feed 105.0000 36.4159 ? 36.0000", "wrap off", "rapid 105.0000 5.0000 ? 36.0000"],
        },
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#100=100.\nG107 Y0. A0. Q#100\nG1 Y31.4159 F100.\nG107\nG91 G0 Y1.\nG107\nM30\n"), &["feed 0.0000 31.4159 0.0000 36.0000", "wrap off", "rapid 0.0000 1.0000 0.0000 36.0000"]),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG1 Y5. F100.\nG107 Y0. A0. Q100.\nX10.\nG107\nM30\n"), &["0.0000 5.0000", "10.0000 5.0000"]),
]),
missing: No("no word"),
extra: No("no other word"),
range: No("no range"),

    },
    Sentence {
        says: "The feed is the speed along the surface, in a feed a minute",
        literal: By(&[
            Stats {
                program: wrapped(
                    "O1\nG21 G90 G94 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG1 X30. Y40. F50.\nG107\nM30\n",
                ),
                prints: &["cutting 1:00.0"],
            },
]),
computed: By(&[
Proof::Stats { program: wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=50.\nG107 Y0. A0. Q100.\nG1 X30. Y40. F#1\nG107\nM30\n"), prints: &["cutting 1:00.0"] },
]),
lasting: By(&[
Proof::Stats { program: wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nF50.\nG107 Y0. A0. Q100.\nG1 X30. Y40.\nG107\nM30\n"), prints: &["cutting 1:00.0"] },
]),
missing: By(&[
rule("error[feed-missing]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 X30. Y40.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 X30. Y40. F50.\nG107\nM30\n")),
]),
extra: By(&[
            Rule {
                finding: "info[cylinder-feed-mode]",
                violates: wrapped("O1\nG21 G54 G90\nG93\nG107 Y0. A0. Q100.\nG1 Y10. F2.\nG107\nG94\nM30\n"),
                conforms: wrapped("O1\nG21 G54 G90\nG94\nG107 Y0. A0. Q100.\nG1 Y10. F100.\nG107\nM30\n"),
            },
rule("info[cylinder-feed-mode]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG93 G1 Y40. F2.\nG94 F50.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y40. F50.\nG107\nM30\n")),
]),
range: By(&[
rule("error[feed-zero]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 X30. F0.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 X30. F50.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "The diameter can be redefined in a program, so that mapping goes on along another surface",
        literal: By(&[
Run {
            program: wrapped(
                "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nY0.\nG107 Y0. A0. Q50.\nY31.4159\nG107\nM30\n",
            ),
            prints: &["diameter 100, Y on A", "31.4159 ? 36.0000", "diameter 50, Y on A", "31.4159 ? 71.9999"],
        },
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=100.\nG107 Y0. A0. Q#1\nG1 Y31.4159 F100.\nY0.\nG107 Y0. A0. Q[#1/2.]\nY31.4159\nG107\nM30\n"), &["diameter 100, Y on A", "diameter 50, Y on A", "31.4159 0.0000 71.9999"]),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107 Y0. A0. Q50.\nG1 X1. F100.\nY31.4159\nG107\nM30\n"), &["diameter 50, Y on A", "71.9999"]),
]),
missing: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q50.\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["diameter 50, Y on A", "diameter 50, Y on A", "71.9999"]),
]),
extra: By(&[
rule("error[words-exclude-each-other]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107 Y0. A0. Q50. R25.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107 Y0. A0. R25.\nG107\nM30\n")),
]),
range: By(&[
rule("error[number-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107 Y0. A0. Q-50.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107 Y0. A0. Q50.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "An X, Y or Z word begins mapping and names the linear axis; only one of them is allowed",
        literal: By(&[
legal(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
]),
computed: By(&[
same(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y#1 A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
]),
lasting: No("not lasting"),
missing: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["feed 0.0000 31.4159 0.0000 0.0000"]),
]),
extra: By(&[
Rule {
            finding: "error[words-exclude-each-other]",
            violates: wrapped("G107 X0. Y0. A0. Q2.\nG107\nM30\n"),
            conforms: wrapped("G107 X0. A0. Q2.\nG107\nM30\n"),
        },
rule("error[words-exclude-each-other]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 X0. Y0. Z0. A0. Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Z0. A0. Q100.\nG107\nM30\n")),
]),
range: No("value ignored"),

    },
    Sentence {
        says: "The value of that word is ignored",
        literal: By(&[
            Rule {
                finding: "warning[cylinder-word-value-ignored]",
                violates: wrapped("G107 Y1.5 A0. Q2.\nG107\nM30\n"),
                conforms: wrapped("G107 Y0. A0. Q2.\nG107\nM30\n"),
            },
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y7. A90. Q100.\nG1 X1. F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "feed 1.0000 0.0000 ? 0.0000"],
            },
]),
computed: By(&[
same(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=7.\nG107 Y#1 A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
rule("warning[cylinder-word-value-ignored]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=7.\nG107 Y#1 A0. Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y#1 A0. Q100.\nG107\nM30\n")),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nY5.\nG107 Y0. A0. Q100.\nX10.\nG107\nM30\n"), &["0.0000 5.0000", "10.0000 5.0000"]),
]),
missing: No("see G107-5"),
extra: No("see G107-5"),
range: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y99999. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100, Y on A", "feed 0.0000 31.4159 0.0000 36.0000"]),
]),

    },
    Sentence {
        says: "A linear axis without a rotary axis is an alarm",
        literal: By(&[
legal(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
]),
computed: By(&[
rule("error[cylinder-without-rotary-axis]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y#1\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y#1 A#1 Q100.\nG107\nM30\n")),
]),
lasting: By(&[
rule("error[cylinder-without-rotary-axis]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nA90.\nG107 Y0. Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nA90.\nG107 Y0. A0. Q100.\nG107\nM30\n")),
]),
missing: By(&[
Rule {
            finding: "error[cylinder-without-rotary-axis]",
            violates: wrapped("G107 Y0.\nM30\n"),
            conforms: wrapped("G107 Y0. A0. Q2.\nG107\nM30\n"),
        },
]),
extra: By(&[
rule("warning[cylinder-without-rotary-axis]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. C0. Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107\nM30\n")),
]),
range: No("no range"),

    },
    Sentence {
        says: "A or B names the rotary axis that carries the cylinder; only one of them is allowed",
        literal: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. B0.\nG107 Y0. B0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100, Y on B"]),
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y0. A#1 Q100.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100, Y on A"]),
]),
lasting: No("not lasting"),
missing: By(&[
rule("error[cylinder-without-rotary-axis]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. B0. Q100.\nG107\nM30\n")),
]),
extra: By(&[
Rule {
            finding: "error[words-exclude-each-other]",
            violates: wrapped("G107 Y0. A0. B0. Q2.\nG107\nM30\n"),
            conforms: wrapped("G107 Y0. B0. Q2.\nG107\nM30\n"),
        },
rule("error[words-exclude-each-other]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y0. A#1 B#1 Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y0. B#1 Q100.\nG107\nM30\n")),
]),
range: No("value ignored"),

    },
    Sentence {
        says: "The rotary axis must be one that the machine has",
        literal: By(&[
legal(wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"])),
]),
computed: By(&[
rule("error[cylinder-axis-not-on-machine]", wrapped("O1\nG20 G54 G90\n#1=0\nG107 Y0. B#1 Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]), wrapped("O1\nG20 G54 G90\n#1=0\nG107 Y0. A#1 Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"])),
]),
lasting: No("not lasting"),
missing: By(&[
rule("error[cylinder-without-rotary-axis]", wrapped("O1\nG20 G54 G90\nG107 Y0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]), wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"])),
]),
extra: By(&[
Rule {
            finding: "error[cylinder-axis-not-on-machine]",
            violates: wrapped("G107 Y0. B0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
            conforms: wrapped("G107 Y0. A0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]),
        },
noticed("error", wrapped("O1\nG20 G54 G90\nG107 Y0. C0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"]), wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG107\nM30\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]"])),
]),
range: No("no range"),

    },
    Sentence {
        says: "The value of the rotary word is ignored: nothing turns",
        literal: By(&[
Rule {
            finding: "warning[cylinder-word-value-ignored]",
            violates: wrapped("G107 Y0. A90. Q2.\nG107\nM30\n"),
            conforms: wrapped("G0 A90.\nG107 Y0. A0. Q2.\nG107\nM30\n"),
        },
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A90. Q100.\nG1 X10. F100.\nG107\nM30\n"), &["10.0000 0.0000 0.0000 0.0000"]),
]),
computed: By(&[
rule("warning[cylinder-word-value-ignored]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=45.\nG107 Y0. A[#1*2.] Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 Y0. A[#1*2.] Q100.\nG107\nM30\n")),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nA90.\nG107 Y0. A0. Q100.\nG1 X10. F100.\nG107\nM30\n"), &["10.0000 0.0000 0.0000 90.0000"]),
]),
missing: No("see G107-7"),
extra: No("see G107-8"),
range: By(&[
rule("warning[cylinder-word-value-ignored]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A720. Q100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "Q is the diameter; without a rotary axis it is an alarm when the block runs",
        literal: By(&[
legal(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
]),
computed: By(&[
same(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=50.\nG107 Y0. A0. Q[#1*2.]\nG1 Y31.4159 F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
rule("error[cylinder-without-rotary-axis]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=2.\nG107 Q#1\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=2.\nG107 A0. Q#1\nG107\nM30\n")),
rule("error[computed-value-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=-4.\nG107 Y0. A0. Q#1\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=4.\nG107 Y0. A0. Q#1\nG107\nM30\n")),
rule("warning[maybe-computed-value-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=4.\nIF [#500 EQ 1] GOTO 10\n#1=-4.\nN10 G107 Y0. A0. Q#1\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=4.\nIF [#500 EQ 1] GOTO 10\n#1=5.\nN10 G107 Y0. A0. Q#1\nG107\nM30\n")),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q100.\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100", "36.0000"]),
]),
missing: By(&[
Rule {
            finding: "error[cylinder-without-rotary-axis]",
            violates: wrapped("G107 Q2.\nM30\n"),
            conforms: wrapped("G107 A0. Q2.\nM30\n"),
        },
]),
extra: By(&[
rule("warning[word-given-twice]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100. Q50.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
noticed("info", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100. I2.\nG1 Y31.4159 F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
rule("info[word-passed-over]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100. D2\nG1 Y31.4159 F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG1 Y31.4159 F100.\nG107\nM30\n")),
]),
range: By(&[
rule("error[number-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q-4.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q4.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "R is the radius, in place of Q, and needs a rotary axis as well",
        literal: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. R50.\nG1 Y31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "feed 0.0000 31.4159 ? 36.0000"],
            },
]),
computed: By(&[
same(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=25.\nG107 Y0. A0. R[#1*2.]\nG1 Y31.4159 F100.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. R50.\nG1 Y31.4159 F100.\nG107\nM30\n")),
rule("error[cylinder-without-rotary-axis]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=2.\nG107 R#1\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=2.\nG107 A0. R#1\nG107\nM30\n")),
rule("error[computed-value-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=-4.\nG107 Y0. A0. R#1\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=4.\nG107 Y0. A0. R#1\nG107\nM30\n")),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. R50.\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100", "36.0000"]),
]),
missing: By(&[
            Rule {
                finding: "error[cylinder-without-rotary-axis]",
                violates: wrapped("G107 R1.\nM30\n"),
                conforms: wrapped("G107 A0. R1.\nM30\n"),
            },
]),
extra: By(&[
            Rule {
                finding: "error[words-exclude-each-other]",
                violates: wrapped("G107 Y0. A0. Q2. R1.\nG107\nM30\n"),
                conforms: wrapped("G107 Y0. A0. R1.\nG107\nM30\n"),
            },
]),
range: By(&[
rule("error[number-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. R-4.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. R4.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "Without Q and R the last size that a G107 gave this rotary axis since power-on counts",
        literal: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107 Y0. A0. Q50.\nG107\nM30\n"), &["wrap diameter 50, Y on A"]),
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=100.\nG107 A0. Q#1\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100", "36.0000"]),
]),
lasting: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 A0. Q100.\nG107 B0. Q50.\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "31.4159 ? 36.0000"],
            },
            Rule {
                finding: "info[cylinder-diameter-from-setting]",
                violates: wrapped("G107 A0. Q2.\nG107 Y0. B0.\nG107\nM30\n"),
                conforms: wrapped("G107 A0. Q2.\nG107 Y0. A0.\nG107\nM30\n"),
            },
]),
missing: By(&[
rule("info[cylinder-diameter-from-setting]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG107\nM30\n")),
]),
extra: No("see G107-11"),
range: By(&[
rule("info[cylinder-diameter-from-setting]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q0.\nG107 Y0. A0.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q100.\nG107 Y0. A0.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "If none was given, or the last one was zero, the diameter is that of the settings for this axis: 34 for the 4th, 79 for the 5th",
        literal: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 A0. Q30.\nG107 Y0. A0. Q0.\nG107\nM30\n",
                )
                .with(&["machine.units=\"mm\"", "settings.34=100"]),
                prints: &["wrap diameter 100, Y on A"],
            },
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=0\nG107 A0. Q30.\nG107 Y0. A0. Q#1\nG107\nM30\n").with(&["machine.units=\"mm\"", "settings.34=100"]), &["wrap diameter 100, Y on A"]),
rule("warning[cylinder-without-diameter]", wrapped("O1\nG20 G54 G90\n#1=0\nG107 Y0. A0. Q#1\nG107\nM30\n").with(&["settings.34=0"]), wrapped("O1\nG20 G54 G90\n#1=2.\nG107 Y0. A0. Q#1\nG107\nM30\n").with(&["settings.34=0"])),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q30.\nG107 A0. Q0.\nG107 Y0. A0.\nG107\nM30\n").with(&["machine.units=\"mm\"", "settings.34=100"]), &["wrap diameter 100, Y on A"]),
]),
missing: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0. B0.\nG107 Y0. A0.\nG107\nG107 Y0. B0.\nG107\nM30\n",
                )
                .with(&["machine.units=\"mm\"", "settings.34=100", "settings.79=50"]),
                prints: &["wrap diameter 100, Y on A", "wrap off", "wrap diameter 50, Y on B"],
            },
            Assumes {
                program: wrapped("O1\nG54 G90 G0 X0. Y0. A0.\nG107 Y0. A0.\nG107\nM30\n"),
                says: "setting 34 (4th axis diameter) is not known",
            },
            Assumes {
                program: wrapped("O1\nG54 G90 G0 X0. Y0. A0.\nG107 Y0. A0.\nG107\nM30\n").with(&["settings.34=4"]),
                says: "no program before this one gave cylinders on A a diameter",
            },
]),
extra: No("see G107-11"),
range: By(&[
            Rule {
                finding: "warning[cylinder-without-diameter]",
                violates: wrapped("G107 Y0. A0. Q0.\nG107\nM30\n").with(&["settings.34=0"]),
                conforms: wrapped("G107 Y0. A0. Q0.\nG107\nM30\n").with(&["settings.34=4"]),
            },
]),

    },
    Sentence {
        says: "A size becomes the axis' default until power off, also where the code only names a rotary axis and a size; mapping that is on stays as it is",
        literal: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG107 A0. Q50.\nG1 Y31.4159 F100.\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100, Y on A", "31.4159 ? 36.0000", "wrap off"],
            },
            Rule {
                finding: "warning[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG107 A0. Q3.\nT2 M6\nG107\nM30\n"),
                conforms: wrapped("G107 A0. Q3.\nT2 M6\nM30\n"),
            },
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=50.\nG107 Y0. A0. Q[#1*2.]\nG107 A0. Q#1\nG1 Y31.4159 F100.\nG107\nM30\n"), &["wrap diameter 100, Y on A", "36.0000"]),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q50.\nM98 P2\nG107 Y0. A0.\nG1 Y31.4159 F100.\nG107\nM30\nO2\nG107 A0. Q100.\nM99\n"), &["wrap diameter 100, Y on A", "36.0000"]),
]),
missing: No("see G107-13"),
extra: No("see G107-11"),
range: By(&[
rule("error[number-out-of-range]", wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q-50.\nG107\nM30\n"), wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q50.\nG107\nM30\n")),
]),

    },
    Sentence {
        says: "In sync with the settings: while no size was given, it was zero, or it equals the setting, a new setting changes the default too",
        literal: By(&[
Explains {
            control: CONTROL,
            code: "G107",
            says: "as long as the last size equals the setting (or is 0, or none was given), a new setting changes the default too",
        },
]),
computed: No("no word"),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 A0. Q0.\nG107 Y0. A0.\nG107\nM30\n").with(&["machine.units=\"mm\"", "settings.34=80"]), &["wrap diameter 80, Y on A"]),
]),
missing: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0.\nG107\nM30\n").with(&["machine.units=\"mm\"", "settings.34=80"]), &["wrap diameter 80, Y on A"]),
]),
extra: No("no other word"),
range: No("no range"),

    },
    Sentence {
        says: "Out of sync: a last size other than zero and the setting is kept, whatever becomes of the setting, until the two are equal",
        literal: By(&[
            Explains {
                control: CONTROL,
                code: "G107",
                says: "A different size is out of sync: it keeps its own value until the two are equal again",
            },
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=15.\nG107 A0. Q[#1*2.]\nG107 Y0. A0.\nG107\nM30\n").with(&["machine.units=\"mm\"", "settings.34=100"]), &["wrap diameter 30, Y on A"]),
]),
lasting: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 A0. Q30.\nG107 Y0. A0.\nG107\nM30\n",
                )
                .with(&["machine.units=\"mm\"", "settings.34=100"]),
                prints: &["wrap diameter 30, Y on A"],
            },
]),
missing: No("see G107-14"),
extra: No("no other word"),
range: No("no range"),

    },
    Sentence {
        says: "The code alone ends mapping, without forgetting the default",
        literal: By(&[
            Run {
                program: wrapped(
                    "O1\nG21 G90 G54 G0 X0. Y0. A0.\nG107 Y0. A0. Q100.\nG107\nG1 Y31.4159 F100.\nY0.\nG107 Y0. A0.\nG1 Y31.4159\nG107\nM30\n",
                ),
                prints: &["wrap diameter 100", "wrap off", "31.4159 ? 0.0000", "wrap diameter 100", "31.4159 ? 36.0000"],
            },
]),
computed: No("no word"),
lasting: By(&[
rule("info[maybe-cylinder-left-on]", wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG1 Y1. F10.\nIF [#500 EQ 1] GOTO 10\nG107\nN10 T2 M6\nG107\nM30\n"), wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG1 Y1. F10.\nIF [#500 EQ 1] GOTO 10\nG1 X1.\nN10 G107\nT2 M6\nG107\nM30\n")),
]),
missing: By(&[
            Rule {
                finding: "warning[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nT2 M6\nG107\nM30\n"),
                conforms: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\nT2 M6\nM30\n"),
            },
]),
extra: No("no word"),
range: No("no range"),

    },
    Sentence {
        says: "Group 00, but lasting: Setting 56 decides whether the end of the program ends it",
        literal: By(&[
legal(wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\nM30\n").with(&["settings.56=false"])),
]),
computed: No("no word"),
lasting: By(&[
            Rule {
                finding: "warning[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nM30\n").with(&["settings.56=false"]),
                conforms: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nM30\n").with(&["settings.56=true"]),
            },
]),
missing: By(&[
            Rule {
                finding: "info[cylinder-left-on]",
                violates: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nM30\n"),
                conforms: wrapped("G107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\nM30\n"),
            },
]),
extra: No("no word"),
range: No("no range"),

    },
    Sentence {
        says: "An existing program of a linear axis is wrapped by a G107 at its beginning, cutter compensation and all",
        literal: By(&[
            Legal { program: on(CONTROL, SLOT) },
            Run {
                program: on(CONTROL, SLOT).with(&[
                    "machine.units=\"inch\"",
                    "tools.1.diameter=0.5",
                    "tools.1.length=4",
                ]),
                prints: &[
                    "wrap diameter 4, Y on A",
                    "feed 2.2500 0.4000 -0.1000 11.4592",
                    "arc 2.0000 0.6500 -0.1000 18.6211",
                    "feed -2.0000 0.6500 -0.1000 18.6211",
                    "wrap off",
                ],
            },
]),
computed: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\n#1=100.\nG107 Y0. A0. Q#1\n#2=0\nWHILE [#2 LT 3] DO1\n#2=#2+1\nG1 Y[31.4159*#2] F100.\nEND1\nG107\nM30\n"), &["36.0001", "72.0002", "108.0003"]),
]),
lasting: By(&[
run(wrapped("O1\nG21 G90 G54 G0 X0. Y0. Z0. A0.\nG107 Y0. A0. Q100.\nG91 G1 Y31.4159 F100.\nY31.4159\nG90\nG107\nM30\n"), &["36.0000", "71.9999"]),
]),
missing: By(&[
rule("warning[cylinder-left-on]", wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG1 Y1. F10.\nT2 M6\nG107\nM30\n"), wrapped("O1\nG20 G54 G90\nG107 Y0. A0. Q2.\nG1 Y1. F10.\nG107\nT2 M6\nG107\nM30\n")),
]),
extra: No("see G107-11"),
range: No("no range"),

    },
];

#[test]
fn holds() {
    prove(&SYSTEM);
}
