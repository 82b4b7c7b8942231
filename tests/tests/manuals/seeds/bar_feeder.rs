//! G105, servo bar feed: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::{Program, Proof, legal, noticed, on, rule, run, same};
use crate::seeds::sentence::Tests::{By, No};
use crate::seeds::sentence::{Sentence, System, prove};

const LATHE: &str = "haas-lathe";

/// Bars of 1000 mm, one of them.
const ONE_BAR: &[&str] = &["machine.units=\"mm\"", "machine.bar_length=1000", "machine.bars=1"];
/// Bars of 100 mm, two of them: the first feed finds too little after the chuck.
const SHORT_BARS: &[&str] = &["machine.units=\"mm\"", "machine.bar_length=100", "machine.bars=2"];
/// With the lengths of the control's page.
const TOLD: &[&str] = &[
    "machine.units=\"mm\"",
    "machine.bar_length=1000",
    "machine.bars=1",
    "variables={\"#3100\"=25, \"#3101\"=30, \"#3102\"=60}",
];
const TOLD_SHORT: &[&str] = &[
    "machine.units=\"mm\"",
    "machine.bar_length=100",
    "machine.bars=2",
    "variables={\"#3100\"=25, \"#3101\"=30, \"#3102\"=60}",
];

/// A feed with everything, after a cutoff program.
const FULL: Program = on(
    LATHE,
    "\
O1
G21 G18 G40 G80 G99
T0101
G97 S900 M3
G0 X60. Z2.
G1 X0. F0.1
G0 X80. Z80.
G105 I30. J25. K60. P2 R90.
G0 X82.
M30
O2
G0 X60. Z-22.
G1 X-1. F0.05
G0 X80. Z80.
M99
",
);

const BARE: Program = on(LATHE, "O1\nG21 G40 G80 G99\nM5\nG105\nM30\n");

pub(crate) const SYSTEM: System = System {
    title: "G105, servo bar feed",
    key: "G105",
    source: "Haas Bar Feeder Operator's Manual 96-8913A, May 2015, p. 21",
    module: "bar_feeder",
    sentences: &[
        Sentence {
            says: "`G105` commands the bar feeder; all its words are optional.",
            literal: By(&[
                Proof::Legal { program: BARE },
                Proof::Legal { program: FULL },
                Proof::Run { program: BARE.with(TOLD), prints: &["bar push 25"] },
                Proof::Explains { control: LATHE, code: "G105", says: "Brings bar for the next part." },
            ]),
            computed: By(&[same(
                on(LATHE, "G21\nM5\n#100=25.\nG105 I30. J#100 K[#100+35.]\nM30\n").with(ONE_BAR),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
            )]),
            lasting: No("not lasting"),
            missing: By(&[rule(
                "info[bar-length-missing]",
                BARE,
                on(LATHE, "O1\nG21 G40 G80 G99\nM5\nG105 I30. J25. K60.\nM30\n"),
            )]),
            extra: By(&[
                noticed(
                    "info",
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. X10.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
                noticed(
                    "info",
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. Z10.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
                noticed(
                    "info",
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. U5.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
                noticed(
                    "info",
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. L2\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
            ]),
            range: No("see the words"),
        },
        Sentence {
            says: "`I` is the first push of a new bar in the place of #3101, which counts where `I` is left out.",
            literal: By(&[Proof::Run {
                program: FULL.with(SHORT_BARS),
                prints: &["bar load", "bar push 30"],
            }]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#100=15.\nG105 I[#100*2.] J25. K60.\nM30\n").with(SHORT_BARS),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(SHORT_BARS),
                ),
                rule(
                    "warning[computed-value-out-of-range]",
                    on(LATHE, "G21\nM5\n#100=-30.\nG105 I#100 J25. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\n#100=30.\nG105 I#100 J25. K60.\nM30\n"),
                ),
                rule(
                    "warning[maybe-computed-value-out-of-range]",
                    on(
                        LATHE,
                        "G21\nM5\n#100=30.\nIF [#500 EQ 1] GOTO 10\n#100=-30.\nN10 G105 I#100 J25. K60.\nM30\n",
                    ),
                    on(
                        LATHE,
                        "G21\nM5\n#100=30.\nIF [#500 EQ 1] GOTO 10\n#100=35.\nN10 G105 I#100 J25. K60.\nM30\n",
                    ),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\nM5\nG105 I40. J25. K60.\nG105\nM30\n").with(&[
                    "machine.units=\"mm\"",
                    "machine.bar_length=100",
                    "machine.bars=3",
                    "variables={\"#3100\"=25, \"#3101\"=30, \"#3102\"=60}",
                ]),
                &["bar load", "bar push 40", "bar load", "bar push 30"],
            )]),
            missing: By(&[
                Proof::Run { program: BARE.with(TOLD_SHORT), prints: &["bar load", "bar push 30"] },
                rule(
                    "info[bar-length-missing]",
                    on(LATHE, "G21\nM5\nG105 J25. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
            ]),
            extra: By(&[rule(
                "warning[word-given-twice]",
                on(LATHE, "G21\nM5\nG105 I30. I40. J25. K60.\nM30\n"),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
            )]),
            range: By(&[
                Proof::Rule {
                    finding: "warning[number-out-of-range]",
                    violates: on(LATHE, "G21\nM5\nG105 I-30. J25. K60.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[bar-length-not-usable]",
                    violates: on(LATHE, "G21\n#3101=-30.\nM5\nG105 J25. K60.\nM30\n"),
                    conforms: on(LATHE, "G21\n#3101=30.\nM5\nG105 J25. K60.\nM30\n"),
                },
            ]),
        },
        Sentence {
            says: "`J` is the part with its cutoff in the place of #3100, which counts where `J` is left out.",
            literal: By(&[
                Proof::Run { program: FULL.with(ONE_BAR), prints: &["bar push 25"] },
                Proof::Rule {
                    finding: "warning[bar-push-shorter-than-part]",
                    violates: on(
                        LATHE,
                        "G21\nS900 M3\nG0 X60. Z-32.\nG1 X-1. F0.05\nG0 X80.\nM5\nG105 I30. J25. K60.\nM30\n",
                    ),
                    conforms: on(
                        LATHE,
                        "G21\nS900 M3\nG0 X60. Z-22.\nG1 X-1. F0.05\nG0 X80.\nM5\nG105 I30. J25. K60.\nM30\n",
                    ),
                },
            ]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#100=50.\nG105 I30. J[#100/2.] K60.\nM30\n").with(ONE_BAR),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
                ),
                rule(
                    "warning[computed-value-out-of-range]",
                    on(LATHE, "G21\nM5\n#100=1.\nG105 I30. J[#100-1.] K60.\nM30\n"),
                    on(LATHE, "G21\nM5\n#100=26.\nG105 I30. J[#100-1.] K60.\nM30\n"),
                ),
                rule(
                    "warning[computed-value-out-of-range]",
                    on(LATHE, "G21\nM5\n#100=5.\nG105 I30. J[0-#100] K60.\nM30\n"),
                    on(LATHE, "G21\nM5\n#100=5.\nG105 I30. J[#100*5.] K60.\nM30\n"),
                ),
                rule(
                    "warning[maybe-computed-value-out-of-range]",
                    on(
                        LATHE,
                        "G21\nM5\n#100=25.\nIF [#500 EQ 1] GOTO 10\n#100=0\nN10 G105 I30. J#100 K60.\nM30\n",
                    ),
                    on(
                        LATHE,
                        "G21\nM5\n#100=25.\nIF [#500 EQ 1] GOTO 10\n#100=26.\nN10 G105 I30. J#100 K60.\nM30\n",
                    ),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\nM5\nG105 J12.\nG105\nM30\n").with(TOLD),
                &["bar push 12", "bar push 25"],
            )]),
            missing: By(&[
                Proof::Run { program: BARE.with(TOLD), prints: &["bar push 25"] },
                rule(
                    "info[bar-length-missing]",
                    on(LATHE, "G21\nM5\nG105 I30. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
            ]),
            extra: By(&[rule(
                "warning[word-given-twice]",
                on(LATHE, "G21\nM5\nG105 I30. J25. J30. K60.\nM30\n"),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
            )]),
            range: By(&[
                Proof::Rule {
                    finding: "warning[number-out-of-range]",
                    violates: on(LATHE, "G21\nM5\nG105 I30. J0. K60.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[bar-length-not-usable]",
                    violates: on(LATHE, "G21\n#3100=0\nM5\nG105 I30. K60.\nM30\n"),
                    conforms: on(LATHE, "G21\n#3100=25.\nM5\nG105 I30. K60.\nM30\n"),
                },
                rule(
                    "warning[number-out-of-range]",
                    on(LATHE, "G21\nM5\nG105 I30. J-25. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
            ]),
        },
        Sentence {
            says: "`K` is the least length to clamp in the place of #3102, which counts where `K` is left out.",
            literal: By(&[
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K50.\nM30\n").with(SHORT_BARS),
                    prints: &["bar unload, left 70"],
                },
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K40.\nM30\n").with(SHORT_BARS),
                    prints: &["bar push 25"],
                },
            ]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#100=60.\nG105 I30. J25. K#100\nM30\n").with(SHORT_BARS),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(SHORT_BARS),
                ),
                rule(
                    "warning[computed-value-out-of-range]",
                    on(LATHE, "G21\nM5\n#100=60.\nG105 I30. J25. K[0-#100]\nM30\n"),
                    on(LATHE, "G21\nM5\n#100=60.\nG105 I30. J25. K[#100]\nM30\n"),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K5.\nG105\nM30\n").with(TOLD_SHORT),
                &["bar push 25", "bar unload, left 45"],
            )]),
            missing: By(&[
                run(on(LATHE, "G21\nM5\nG105 I30. J25.\nM30\n").with(TOLD_SHORT), &["bar unload, left 70"]),
                rule(
                    "info[bar-length-missing]",
                    on(LATHE, "G21\nM5\nG105 I30. J25.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
            ]),
            extra: By(&[rule(
                "warning[word-given-twice]",
                on(LATHE, "G21\nM5\nG105 I30. J25. K60. K50.\nM30\n"),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
            )]),
            range: By(&[Proof::Rule {
                finding: "warning[number-out-of-range]",
                violates: on(LATHE, "G21\nM5\nG105 I30. J25. K-60.\nM30\n"),
                conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
            }]),
        },
        Sentence {
            says: "`P` is a cutoff subprogram.",
            literal: By(&[
                Proof::Rule {
                    finding: "warning[bar-feed-in-cutoff-program]",
                    violates: on(
                        LATHE,
                        "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nG105 I30. J25. K60.\nM99\n",
                    ),
                    conforms: FULL,
                },
                Proof::Rule {
                    finding: "info[part-cut-off-twice]",
                    violates: on(
                        LATHE,
                        "\
O1
G21
S900 M3
G0 X60. Z-22.
G1 X-1. F0.05
G0 X80.
G105 I30. J25. K60. P2
M30
O2
G0 X60. Z-22.
G1 X-1. F0.05
G0 X80.
M99
",
                    ),
                    conforms: FULL,
                },
                legal(on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nM99\n")),
            ]),
            computed: By(&[
                same(
                    on(LATHE, "O1\nG21\nM5\n#100=2\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n")
                        .with(ONE_BAR),
                    on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nM99\n").with(ONE_BAR),
                ),
                rule(
                    "warning[computed-subprogram-missing]",
                    on(LATHE, "O1\nG21\nM5\n#100=7\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n"),
                    on(LATHE, "O1\nG21\nM5\n#100=2\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n"),
                ),
                rule(
                    "error[computed-value-out-of-range]",
                    on(LATHE, "O1\nG21\nM5\n#100=1234.5\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n"),
                    on(LATHE, "O1\nG21\nM5\n#100=2\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n"),
                ),
                rule(
                    "error[computed-value-out-of-range]",
                    on(LATHE, "O1\nG21\nM5\n#100=-2\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n"),
                    on(LATHE, "O1\nG21\nM5\n#100=2\nG105 I30. J25. K60. P#100\nM30\nO2\nG0 X80.\nM99\n"),
                ),
            ]),
            lasting: No("not lasting"),
            missing: By(&[
                Proof::Rule {
                    finding: "warning[subprogram-missing]",
                    violates: on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P7\nM30\n"),
                    conforms: FULL,
                },
                Proof::Rule {
                    finding: "warning[subprogram-without-return]",
                    violates: on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nM30\n"),
                    conforms: FULL,
                },
                run(
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
                    &["bar unclamp", "bar push 25"],
                ),
            ]),
            extra: By(&[rule(
                "warning[word-given-twice]",
                on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2 P3\nM30\nO2\nG0 X80.\nM99\n"),
                on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nM99\n"),
            )]),
            range: By(&[
                noticed(
                    "warning",
                    on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2.5\nM30\nO2\nG0 X80.\nM99\n"),
                    on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nM99\n"),
                ),
                rule(
                    "error[number-out-of-range]",
                    on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P-2\nM30\nO2\nG0 X80.\nM99\n"),
                    on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P2\nM30\nO2\nG0 X80.\nM99\n"),
                ),
            ]),
        },
        Sentence {
            says: "`Q` is a mode that sets the bar feeder up.",
            literal: By(&[
                Proof::Rule {
                    finding: "warning[bar-setup-mode-in-program]",
                    violates: on(LATHE, "G21\nM5\nG105 Q4 R90.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 Q0 I30. J25. K60.\nM30\n"),
                },
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 Q4 R90.\nM30\n").with(ONE_BAR),
                    prints: &["bar setup, mode 4"],
                },
            ]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#100=4\nG105 Q#100 R90.\nM30\n").with(ONE_BAR),
                    on(LATHE, "G21\nM5\nG105 Q4 R90.\nM30\n").with(ONE_BAR),
                ),
                rule(
                    "warning[bar-setup-mode-in-program]",
                    on(LATHE, "G21\nM5\n#100=4\nG105 Q#100 R90.\nM30\n"),
                    on(LATHE, "G21\nM5\n#100=0\nG105 Q#100 I30. J25. K60.\nM30\n"),
                ),
            ]),
            lasting: By(&[rule(
                "warning[bar-setup-mode-in-program]",
                on(LATHE, "G21\nM5\nG105 Q4 R90.\nG105 I30. J25. K60.\nM30\n"),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
            )]),
            missing: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
                &["bar push 25"],
            )]),
            extra: By(&[rule(
                "warning[word-given-twice]",
                on(LATHE, "G21\nM5\nG105 Q4 Q5\nM30\n"),
                on(LATHE, "G21\nM5\nG105 Q0 I30. J25. K60.\nM30\n"),
            )]),
            range: By(&[
                noticed(
                    "warning",
                    on(LATHE, "G21\nM5\nG105 Q-1 I30. J25. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
                rule(
                    "warning[decimal-point-on-integer]",
                    on(LATHE, "G21\nM5\nG105 Q1.5 I30. J25. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                ),
            ]),
        },
        Sentence {
            says: "`R` is the angle at which the spindle takes a new bar.",
            literal: By(&[Proof::Run {
                program: FULL.with(SHORT_BARS),
                prints: &["spindle to 90 deg", "bar load"],
            }]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#100=45.\nG105 I30. J25. K60. R[#100*2.]\nM30\n").with(SHORT_BARS),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nM30\n").with(SHORT_BARS),
                ),
                rule(
                    "warning[computed-value-out-of-range]",
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. R[400.]\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. R[350.]\nM30\n"),
                ),
                rule(
                    "warning[computed-value-out-of-range]",
                    on(LATHE, "G21\nM5\n#100=-90.\nG105 I30. J25. K60. R#100\nM30\n"),
                    on(LATHE, "G21\nM5\n#100=90.\nG105 I30. J25. K60. R#100\nM30\n"),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nG105 I30. J25. K60.\nM30\n").with(&[
                    "machine.units=\"mm\"",
                    "machine.bar_length=100",
                    "machine.bars=3",
                ]),
                &["spindle to 90 deg", "bar load", "bar unclamp", "bar unload", "bar load"],
            )]),
            missing: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(SHORT_BARS),
                &["bar unload", "bar load"],
            )]),
            extra: By(&[rule(
                "warning[word-given-twice]",
                on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90. R80.\nM30\n"),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nM30\n"),
            )]),
            range: By(&[
                Proof::Rule {
                    finding: "warning[number-out-of-range]",
                    violates: on(LATHE, "G21\nM5\nG105 I30. J25. K60. R720.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nM30\n"),
                },
                rule(
                    "warning[number-out-of-range]",
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. R-90.\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nM30\n"),
                ),
            ]),
        },
        Sentence {
            says: "The values of the three variables are on the control's page of current commands.",
            literal: By(&[
                Proof::Assumes { program: BARE, says: "the value of `#3100` at the start is not known" },
                Proof::Assumes { program: BARE, says: "are set on the control's page" },
                run(
                    on(LATHE, "G21\nM5\n#3100=25.\n#3101=30.\n#3102=60.\nG105\nM30\n").with(ONE_BAR),
                    &["bar push 25"],
                ),
            ]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#1=25.\n#3100=#1\n#3101=[#1+5.]\n#3102=60.\nG105\nM30\n")
                        .with(ONE_BAR),
                    on(LATHE, "G21\nM5\n#3100=25.\n#3101=30.\n#3102=60.\nG105\nM30\n").with(ONE_BAR),
                ),
                rule(
                    "warning[bar-length-not-usable]",
                    on(LATHE, "G21\nM5\n#1=25.\n#3100=[#1-25.]\nG105 I30. K60.\nM30\n"),
                    on(LATHE, "G21\nM5\n#1=25.\n#3100=#1\nG105 I30. K60.\nM30\n"),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\nM5\n#3100=25.\n#3101=30.\n#3102=60.\nG105\nG105\nM30\n").with(ONE_BAR),
                &["bar push 25", "bar push 25"],
            )]),
            missing: By(&[
                Proof::Rule {
                    finding: "info[bar-length-missing]",
                    violates: BARE,
                    conforms: on(LATHE, "O1\nG21 G40 G80 G99\n#3100=25.\nM5\nG105 I30. K60.\nM30\n"),
                },
                Proof::Rule {
                    finding: "warning[bar-length-missing]",
                    violates: BARE.with(ONE_BAR),
                    conforms: BARE.with(TOLD),
                },
            ]),
            extra: No("no other word"),
            range: By(&[rule(
                "warning[bar-length-not-usable]",
                on(LATHE, "G21\nM5\n#3102=-60.\nG105 I30. J25.\nM30\n"),
                on(LATHE, "G21\nM5\n#3102=60.\nG105 I30. J25.\nM30\n"),
            )]),
        },
        Sentence {
            says: "`I`, `J` and `K` count in their own block only; the stored values are not changed.",
            literal: By(&[
                Proof::Explains { control: LATHE, code: "G105", says: "count in this block only" },
                run(on(LATHE, "G21\nM5\nG105 J12. I30. K60.\nM30\n").with(ONE_BAR), &["bar push 12"]),
            ]),
            computed: By(&[run(
                on(LATHE, "G21\nM5\n#100=6.\nG105 J[#100*2.]\nG105\nM30\n").with(TOLD),
                &["bar push 12", "bar push 25"],
            )]),
            lasting: By(&[
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 J12.\nG105\nM30\n").with(TOLD),
                    prints: &["bar push 12", "bar push 25"],
                },
                Proof::Rule {
                    finding: "info[bar-override-does-not-last]",
                    violates: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nG105 K60. I30.\nM30\n"),
                    conforms: on(LATHE, "G21\n#3100=25.\nM5\nG105 J25. K60. I30.\nG105 K60. I30.\nM30\n"),
                },
                rule(
                    "info[bar-override-does-not-last]",
                    on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nG105 J25. I30.\nM30\n"),
                    on(LATHE, "G21\nM5\n#3102=60.\nG105 J25. K60. I30.\nG105 J25. I30.\nM30\n"),
                ),
            ]),
            missing: By(&[rule(
                "info[bar-override-does-not-last]",
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nG105\nM30\n"),
                on(LATHE, "G21\nM5\n#3100=25.\n#3101=30.\n#3102=60.\nG105 I30. J25. K60.\nG105\nM30\n"),
            )]),
            extra: No("no other word"),
            range: No("see the words"),
        },
        Sentence {
            says: "What happens depends on the length of the bar and the sum of clamping length and part.",
            literal: By(&[
                Proof::Run { program: FULL.with(ONE_BAR), prints: &["bar push 25"] },
                Proof::Run { program: FULL.with(SHORT_BARS), prints: &["bar unload, left 70"] },
                Proof::Assumes {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K40.\nM30\n"),
                    says: "in effect at the start",
                },
            ]),
            computed: By(&[
                same(
                    on(LATHE, "G21\nM5\n#100=50.\nG105 I30. J25. K#100\nM30\n").with(SHORT_BARS),
                    on(LATHE, "G21\nM5\nG105 I30. J25. K50.\nM30\n").with(SHORT_BARS),
                ),
                rule(
                    "error[bar-too-short-for-part]",
                    on(LATHE, "G21\nM5\n#100=980.\nG105 I30. J#100 K60.\nM30\n").with(ONE_BAR),
                    on(LATHE, "G21\nM5\n#100=98.\nG105 I30. J#100 K60.\nM30\n").with(ONE_BAR),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K10.\nG105 I30. J25. K10.\nG105 I30. J25. K10.\nM30\n")
                    .with(SHORT_BARS),
                &["bar push 25", "bar push 25", "bar unload, left 20"],
            )]),
            missing: By(&[Proof::Assumes {
                program: on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                says: "in effect at the start",
            }]),
            extra: No("no other word"),
            range: By(&[Proof::Rule {
                finding: "error[bar-too-short-for-part]",
                violates: on(LATHE, "G21\nM5\nG105 I30. J980. K60.\nM30\n").with(ONE_BAR),
                conforms: on(LATHE, "G21\nM5\nG105 I30. J98. K60.\nM30\n").with(ONE_BAR),
            }]),
        },
        Sentence {
            says: "A bar longer than that sum: the cutoff program runs if `P` is there, the spindle stops, the workholding \
                   opens, the bar is pushed by the part, the workholding closes and the program goes on.",
            literal: By(&[
                Proof::Run {
                    program: FULL.with(ONE_BAR),
                    prints: &[
                        "-1.0000 -22.0000",
                        "spindle stop",
                        "bar unclamp",
                        "bar push 25",
                        "bar clamp",
                        "rapid 82.0000",
                    ],
                },
                Proof::Run {
                    program: on(LATHE, "G21\nS900 M3\nG105 J25. K60. I30.\nM30\n").with(ONE_BAR),
                    prints: &[
                        "spindle clockwise",
                        "spindle stop",
                        "bar unclamp",
                        "bar push 25",
                        "bar clamp",
                        "end",
                    ],
                },
            ]),
            computed: By(&[same(
                on(LATHE, "G21\nS900 M3\n#1=25.\nG105 J#1 K[#1+35.] I30.\nM30\n").with(ONE_BAR),
                on(LATHE, "G21\nS900 M3\nG105 J25. K60. I30.\nM30\n").with(ONE_BAR),
            )]),
            lasting: By(&[rule(
                "warning[spindle-stopped-while-cutting]",
                on(LATHE, "G21\nG97 S900 M3\nG0 X60. Z2.\nG105 J25. K60. I30.\nG1 X0. F0.1\nM30\n")
                    .with(ONE_BAR),
                on(LATHE, "G21\nG97 S900 M3\nG0 X60. Z2.\nG105 J25. K60. I30.\nM3\nG1 X0. F0.1\nM30\n")
                    .with(ONE_BAR),
            )]),
            missing: By(&[rule(
                "warning[subprogram-missing]",
                on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60. P9\nM30\n").with(ONE_BAR),
                on(LATHE, "O1\nG21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
            )]),
            extra: By(&[noticed(
                "info",
                on(LATHE, "G21\nM5\nG105 I30. J25. K60. X10.\nM30\n").with(ONE_BAR),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
            )]),
            range: By(&[rule(
                "error[bar-too-short-for-part]",
                on(LATHE, "G21\nM5\nG105 I30. J980. K60.\nM30\n").with(ONE_BAR),
                on(LATHE, "G21\nM5\nG105 I30. J98. K60.\nM30\n").with(ONE_BAR),
            )]),
        },
        Sentence {
            says: "A bar shorter than that sum: the cutoff program runs if `P` is there, the spindle stops, the workholding \
                   opens and the pushrod goes to its unloaded position, the spindle orients if `R` is there, a new bar is \
                   loaded and pushed by its first push.",
            literal: By(&[
                Proof::Run {
                    program: FULL.with(SHORT_BARS),
                    prints: &[
                        "-1.0000 -22.0000",
                        "spindle stop",
                        "bar unclamp",
                        "bar unload, left 70",
                        "spindle to 90 deg",
                        "bar load",
                        "bar push 30",
                        "bar clamp",
                        "rapid 82.0000",
                    ],
                },
                Proof::Stats {
                    program: on(LATHE, "G21\nS900 M3\nG0 X50.\nG1 X0. F0.1\nG105 J25. K10. I30.\nM99\n")
                        .with(SHORT_BARS),
                    prints: &["bar feeder", "6 parts from 2 bars, 3 a bar", "20 mm left of a bar"],
                },
            ]),
            computed: By(&[same(
                on(LATHE, "G21\nM5\n#1=90.\nG105 I30. J25. K60. R#1\nM30\n").with(SHORT_BARS),
                on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nM30\n").with(SHORT_BARS),
            )]),
            lasting: No("not lasting"),
            missing: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(SHORT_BARS),
                &["bar unload, left 70", "bar load", "bar push 30"],
            )]),
            extra: No("no other word"),
            range: By(&[rule(
                "warning[bar-without-second-part]",
                on(LATHE, "G20\nS900 M3\nG0 X2.\nG1 X0. F.005\nG105 I7.5 J1. K4.\nM99\n").with(&[
                    "machine.units=\"inch\"",
                    "machine.bar_length=12",
                    "machine.bars=3",
                ]),
                on(LATHE, "G20\nS900 M3\nG0 X2.\nG1 X0. F.005\nG105 I1. J1. K4.\n/M30\nM99\n").with(&[
                    "machine.units=\"inch\"",
                    "machine.bar_length=12",
                    "machine.bars=3",
                ]),
            )]),
        },
        Sentence {
            says: "The feed stops the spindle.",
            literal: By(&[Proof::Rule {
                finding: "warning[spindle-stopped-while-cutting]",
                violates: on(
                    LATHE,
                    "G21\nG97 S900 M3\nG0 X60. Z2.\nG1 X0. F0.1\nG0 X80. Z80.\nG105 J25. K60. I30. R90.\nG0 X60. Z2.\n\
                     G1 X0.\nM30\n",
                ),
                conforms: on(
                    LATHE,
                    "G21\nG97 S900 M3\nG0 X60. Z2.\nG1 X0. F0.1\nG0 X80. Z80.\nG105 J25. K60. I30. R90.\nM3\n\
                     G0 X60. Z2.\nG1 X0.\nM30\n",
                ),
            }]),
            computed: By(&[rule(
                "warning[spindle-stopped-while-cutting]",
                on(LATHE, "G21\nG97 S900 M3\nG0 X60. Z2.\n#1=25.\nG105 J#1 K60. I30.\nG1 X0. F0.1\nM30\n"),
                on(
                    LATHE,
                    "G21\nG97 S900 M3\nG0 X60. Z2.\n#1=25.\nG105 J#1 K60. I30.\nM3\nG1 X0. F0.1\nM30\n",
                ),
            )]),
            lasting: By(&[rule(
                "info[maybe-spindle-stopped-while-cutting]",
                on(
                    LATHE,
                    "G21\nG97 S900 M3\nG0 X60. Z2.\nIF [#500 EQ 1] GOTO 10\nG105 J25. K60. I30.\nN10 G1 X0. F0.1\nM30\n",
                ),
                on(
                    LATHE,
                    "G21\nG97 S900 M3\nG0 X60. Z2.\nIF [#500 EQ 1] GOTO 10\nG105 J25. K60. I30.\nN10 M3\nG1 X0. F0.1\nM30\n",
                ),
            )]),
            missing: No("no word"),
            extra: No("no other word"),
            range: No("no range"),
        },
        Sentence {
            says: "The feed opens and closes the workholding.",
            literal: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n").with(ONE_BAR),
                &["bar unclamp", "bar push 25", "bar clamp"],
            )]),
            computed: No("no value"),
            lasting: No("not lasting"),
            missing: No("no word"),
            extra: By(&[
                Proof::Rule {
                    finding: "info[chuck-moved-at-bar-feed]",
                    violates: on(LATHE, "G21\nM5\nM11\nG105 J25. K60. I30.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nM30\n"),
                },
                rule(
                    "info[chuck-moved-at-bar-feed]",
                    on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nM10\nM30\n"),
                    on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nM30\n"),
                ),
            ]),
            range: No("no range"),
        },
        Sentence {
            says: "The bar moves forward where the part was: the tool must be out of its way, and nothing of the last part \
                   may be left on (our reading of the page).",
            literal: By(&[Proof::Rule {
                finding: "warning[turret-in-the-way-of-bar]",
                violates: on(
                    LATHE,
                    "G21\nS900 M3\nG0 X60. Z-22.\nG1 X-1. F0.05\nM5\nG105 J25. K60. I30.\nM30\n",
                ),
                conforms: FULL,
            }]),
            computed: By(&[rule(
                "warning[turret-in-the-way-of-bar]",
                on(
                    LATHE,
                    "G21\nS900 M3\n#1=60.\nG0 X#1 Z-22.\nG1 X[#1-61.] F0.05\nM5\nG105 J25. K60. I30.\nM30\n",
                ),
                on(
                    LATHE,
                    "G21\nS900 M3\n#1=60.\nG0 X#1 Z-22.\nG1 X[#1-61.] F0.05\nG0 X80. Z80.\nM5\nG105 J25. K60. I30.\nM30\n",
                ),
            )]),
            lasting: By(&[Proof::Rule {
                finding: "warning[mode-on-at-bar-feed]",
                violates: on(
                    LATHE,
                    "G21\nT0101\nS900 M3\nG42 G0 X60. Z2.\nG1 Z-20. F0.1\nM5\nG105 J25. K60. I30.\nG40 G0 X80.\nM30\n",
                ),
                conforms: on(
                    LATHE,
                    "G21\nT0101\nS900 M3\nG42 G0 X60. Z2.\nG1 Z-20. F0.1\nG40 G0 X80.\nM5\nG105 J25. K60. I30.\nM30\n",
                ),
            }]),
            missing: By(&[rule(
                "warning[turret-in-the-way-of-bar]",
                on(
                    LATHE,
                    "G21\nS900 M3\nG0 X60. Z-22.\nG1 X-1. F0.05\nG0 Z-20.\nM5\nG105 J25. K60. I30.\nM30\n",
                ),
                on(
                    LATHE,
                    "G21\nS900 M3\nG0 X60. Z-22.\nG1 X-1. F0.05\nG0 X80. Z80.\nM5\nG105 J25. K60. I30.\nM30\n",
                ),
            )]),
            extra: No("no other word"),
            range: No("no range"),
        },
        Sentence {
            says: "Where #3101 and `I` are zero, a new bar is pushed by the reference position #3112.",
            literal: By(&[
                Proof::Run {
                    program: on(LATHE, "G21\n#3101=0\nM5\nG105 J25. K90. I0\nM30\n").with(&[
                        "machine.units=\"mm\"",
                        "machine.bar_length=100",
                        "machine.bars=2",
                        "variables={\"#3112\"=40}",
                    ]),
                    prints: &["bar load", "bar push 40"],
                },
                Proof::Rule {
                    finding: "info[bar-initial-push-zero]",
                    violates: on(LATHE, "G21\n#3101=0\nM5\nG105 J25. K60.\nM30\n"),
                    conforms: on(LATHE, "G21\n#3101=30.\nM5\nG105 J25. K60.\nM30\n"),
                },
            ]),
            computed: By(&[
                run(
                    on(LATHE, "G21\n#1=0\n#3101=#1\nM5\nG105 J25. K90. I#1\nM30\n").with(&[
                        "machine.units=\"mm\"",
                        "machine.bar_length=100",
                        "machine.bars=2",
                        "variables={\"#3112\"=40}",
                    ]),
                    &["bar load", "bar push 40"],
                ),
                rule(
                    "warning[bar-length-not-usable]",
                    on(LATHE, "G21\n#1=30.\n#3101=[#1-60.]\nM5\nG105 J25. K60.\nM30\n"),
                    on(LATHE, "G21\n#1=30.\n#3101=[#1-0.]\nM5\nG105 J25. K60.\nM30\n"),
                ),
            ]),
            lasting: By(&[run(
                on(LATHE, "G21\n#3101=0\nM5\nG105 J25. K90.\nM30\n").with(&[
                    "machine.units=\"mm\"",
                    "machine.bar_length=100",
                    "machine.bars=2",
                    "variables={\"#3112\"=40}",
                ]),
                &["bar load", "bar push 40"],
            )]),
            missing: By(&[Proof::Assumes {
                program: on(LATHE, "G21\n#3101=0\nM5\nG105 J25. K60.\nM30\n"),
                says: "#3112",
            }]),
            extra: No("no other word"),
            range: By(&[Proof::Rule {
                finding: "warning[bar-length-not-usable]",
                violates: on(LATHE, "G21\nM5\nG105 J25. K60.\nM30\n")
                    .with(&["variables={\"#3101\"=0, \"#3112\"=0}"]),
                conforms: on(LATHE, "G21\nM5\nG105 J25. K60.\nM30\n")
                    .with(&["variables={\"#3101\"=0, \"#3112\"=40}"]),
            }]),
        },
        Sentence {
            says: "Of a bar just as long as that sum the page says nothing: a new one is taken, and gcheck says so.",
            literal: By(&[
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K45.\nM30\n").with(SHORT_BARS),
                    prints: &["bar unload, left 70", "bar push 30"],
                },
                Proof::Rule {
                    finding: "info[bar-just-long-enough]",
                    violates: on(LATHE, "G21\nM5\nG105 I30. J25. K45.\nM30\n").with(SHORT_BARS),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K44.\nM30\n").with(SHORT_BARS),
                },
                Proof::Explains { control: LATHE, code: "G105", says: "Equal: the manual does not say." },
            ]),
            computed: By(&[rule(
                "info[bar-just-long-enough]",
                on(LATHE, "G21\nM5\n#1=45.\nG105 I30. J25. K#1\nM30\n").with(SHORT_BARS),
                on(LATHE, "G21\nM5\n#1=44.\nG105 I30. J25. K#1\nM30\n").with(SHORT_BARS),
            )]),
            lasting: By(&[rule(
                "info[bar-just-long-enough]",
                on(LATHE, "G21\nM5\nG105 I30. J25. K20.\nG105 I30. J25. K20.\nM30\n").with(SHORT_BARS),
                on(LATHE, "G21\nM5\nG105 I30. J25. K10.\nG105 I30. J25. K10.\nM30\n").with(SHORT_BARS),
            )]),
            missing: By(&[run(
                on(LATHE, "G21\nM5\nG105 I30. J25.\nM30\n").with(&[
                    "machine.units=\"mm\"",
                    "machine.bar_length=100",
                    "machine.bars=2",
                    "variables={\"#3102\"=45}",
                ]),
                &["bar unload, left 70"],
            )]),
            extra: No("no other word"),
            range: No("no range"),
        },
        Sentence {
            says: "A program continues after the feed, so a bar job repeats by `M99` (our reading of the page).",
            literal: By(&[Proof::Stats {
                program: on(LATHE, "G21\nS900 M3\nG0 X50.\nG1 X0. F0.1\nG105 J25. K60. I30.\nM99\n")
                    .with(ONE_BAR),
                prints: &["37 parts from 1 bar, 37 a bar", "70 mm left of a bar"],
            }]),
            computed: By(&[Proof::Stats {
                program: on(LATHE, "G21\nS900 M3\nG0 X50.\nG1 X0. F0.1\n#1=25.\nG105 J#1 K60. I30.\nM99\n")
                    .with(ONE_BAR),
                prints: &["37 parts from 1 bar, 37 a bar"],
            }]),
            lasting: By(&[rule(
                "info[bar-job-without-end]",
                on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nGOTO 1\nN1 M99\n"),
                on(LATHE, "G21\nM5\nG105 J25. K60. I30.\n#1=#1+1\nIF [#1 GT 40] GOTO 9\nM99\nN9 M30\n"),
            )]),
            missing: By(&[Proof::Rule {
                finding: "info[bar-job-without-end]",
                violates: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nM99\n"),
                conforms: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\n/M30\nM99\n"),
            }]),
            extra: No("no other word"),
            range: No("no range"),
        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
