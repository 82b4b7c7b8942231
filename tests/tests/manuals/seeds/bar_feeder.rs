//! G105, servo bar feed: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::proof::{Program, Proof, on};
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
            proofs: &[
                Proof::Legal { program: BARE },
                Proof::Legal { program: FULL },
                Proof::Run { program: BARE.with(TOLD), prints: &["bar push 25"] },
                Proof::Explains { control: LATHE, code: "G105", says: "Brings bar for the next part." },
            ],
        },
        Sentence {
            says: "`I` is the first push of a new bar in the place of #3101, which counts where `I` is left out.",
            proofs: &[
                Proof::Run { program: FULL.with(SHORT_BARS), prints: &["bar load", "bar push 30"] },
                Proof::Run { program: BARE.with(TOLD_SHORT), prints: &["bar load", "bar push 30"] },
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
            ],
        },
        Sentence {
            says: "`J` is the part with its cutoff in the place of #3100, which counts where `J` is left out.",
            proofs: &[
                Proof::Run { program: FULL.with(ONE_BAR), prints: &["bar push 25"] },
                Proof::Run { program: BARE.with(TOLD), prints: &["bar push 25"] },
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
            ],
        },
        Sentence {
            says: "`K` is the least length to clamp in the place of #3102, which counts where `K` is left out.",
            proofs: &[
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K50.\nM30\n").with(SHORT_BARS),
                    prints: &["bar unload, left 70"],
                },
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K40.\nM30\n").with(SHORT_BARS),
                    prints: &["bar push 25"],
                },
                Proof::Rule {
                    finding: "warning[number-out-of-range]",
                    violates: on(LATHE, "G21\nM5\nG105 I30. J25. K-60.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K60.\nM30\n"),
                },
            ],
        },
        Sentence {
            says: "`P` is a cutoff subprogram.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "`Q` is a mode that sets the bar feeder up.",
            proofs: &[
                Proof::Rule {
                    finding: "warning[bar-setup-mode-in-program]",
                    violates: on(LATHE, "G21\nM5\nG105 Q4 R90.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 Q0 I30. J25. K60.\nM30\n"),
                },
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 Q4 R90.\nM30\n").with(ONE_BAR),
                    prints: &["bar setup, mode 4"],
                },
            ],
        },
        Sentence {
            says: "`R` is the angle at which the spindle takes a new bar.",
            proofs: &[
                Proof::Run { program: FULL.with(SHORT_BARS), prints: &["spindle to 90 deg", "bar load"] },
                Proof::Rule {
                    finding: "warning[number-out-of-range]",
                    violates: on(LATHE, "G21\nM5\nG105 I30. J25. K60. R720.\nM30\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J25. K60. R90.\nM30\n"),
                },
            ],
        },
        Sentence {
            says: "The values of the three variables are on the control's page of current commands.",
            proofs: &[
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
                Proof::Assumes { program: BARE, says: "the value of `#3100` at the start is not known" },
                Proof::Assumes { program: BARE, says: "are set on the control's page" },
            ],
        },
        Sentence {
            says: "`I`, `J` and `K` count in their own block only; the stored values are not changed.",
            proofs: &[
                Proof::Run {
                    program: on(LATHE, "G21\nM5\nG105 J12.\nG105\nM30\n").with(TOLD),
                    prints: &["bar push 12", "bar push 25"],
                },
                Proof::Rule {
                    finding: "info[bar-override-does-not-last]",
                    violates: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nG105 K60. I30.\nM30\n"),
                    conforms: on(LATHE, "G21\n#3100=25.\nM5\nG105 J25. K60. I30.\nG105 K60. I30.\nM30\n"),
                },
                Proof::Explains { control: LATHE, code: "G105", says: "count in this block only" },
            ],
        },
        Sentence {
            says: "What happens depends on the length of the bar and the sum of clamping length and part.",
            proofs: &[
                Proof::Run { program: FULL.with(ONE_BAR), prints: &["bar push 25"] },
                Proof::Run { program: FULL.with(SHORT_BARS), prints: &["bar unload, left 70"] },
                Proof::Rule {
                    finding: "error[bar-too-short-for-part]",
                    violates: on(LATHE, "G21\nM5\nG105 I30. J980. K60.\nM30\n").with(ONE_BAR),
                    conforms: on(LATHE, "G21\nM5\nG105 I30. J98. K60.\nM30\n").with(ONE_BAR),
                },
                Proof::Assumes {
                    program: on(LATHE, "G21\nM5\nG105 I30. J25. K40.\nM30\n"),
                    says: "in effect at the start",
                },
            ],
        },
        Sentence {
            says: "A bar longer than that sum: the cutoff program runs if `P` is there, the spindle stops, the workholding \
                   opens, the bar is pushed by the part, the workholding closes and the program goes on.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "A bar shorter than that sum: the cutoff program runs if `P` is there, the spindle stops, the workholding \
                   opens and the pushrod goes to its unloaded position, the spindle orients if `R` is there, a new bar is \
                   loaded and pushed by its first push.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "The feed stops the spindle.",
            proofs: &[Proof::Rule {
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
            }],
        },
        Sentence {
            says: "The feed opens and closes the workholding.",
            proofs: &[Proof::Rule {
                finding: "info[chuck-moved-at-bar-feed]",
                violates: on(LATHE, "G21\nM5\nM11\nG105 J25. K60. I30.\nM30\n"),
                conforms: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nM30\n"),
            }],
        },
        Sentence {
            says: "The bar moves forward where the part was: the tool must be out of its way, and nothing of the last part \
                   may be left on (our reading of the page).",
            proofs: &[
                Proof::Rule {
                    finding: "warning[turret-in-the-way-of-bar]",
                    violates: on(
                        LATHE,
                        "G21\nS900 M3\nG0 X60. Z-22.\nG1 X-1. F0.05\nM5\nG105 J25. K60. I30.\nM30\n",
                    ),
                    conforms: FULL,
                },
                Proof::Rule {
                    finding: "warning[mode-on-at-bar-feed]",
                    violates: on(
                        LATHE,
                        "G21\nT0101\nS900 M3\nG42 G0 X60. Z2.\nG1 Z-20. F0.1\nM5\nG105 J25. K60. I30.\nG40 G0 X80.\nM30\n",
                    ),
                    conforms: on(
                        LATHE,
                        "G21\nT0101\nS900 M3\nG42 G0 X60. Z2.\nG1 Z-20. F0.1\nG40 G0 X80.\nM5\nG105 J25. K60. I30.\nM30\n",
                    ),
                },
            ],
        },
        Sentence {
            says: "Where #3101 and `I` are zero, a new bar is pushed by the reference position #3112.",
            proofs: &[
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
                Proof::Rule {
                    finding: "warning[bar-length-not-usable]",
                    violates: on(LATHE, "G21\nM5\nG105 J25. K60.\nM30\n")
                        .with(&["variables={\"#3101\"=0, \"#3112\"=0}"]),
                    conforms: on(LATHE, "G21\nM5\nG105 J25. K60.\nM30\n")
                        .with(&["variables={\"#3101\"=0, \"#3112\"=40}"]),
                },
            ],
        },
        Sentence {
            says: "Of a bar just as long as that sum the page says nothing: a new one is taken, and gcheck says so.",
            proofs: &[
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
            ],
        },
        Sentence {
            says: "A program continues after the feed, so a bar job repeats by `M99` (our reading of the page).",
            proofs: &[
                Proof::Stats {
                    program: on(LATHE, "G21\nS900 M3\nG0 X50.\nG1 X0. F0.1\nG105 J25. K60. I30.\nM99\n")
                        .with(ONE_BAR),
                    prints: &["37 parts from 1 bar, 37 a bar", "70 mm left of a bar"],
                },
                Proof::Rule {
                    finding: "info[bar-job-without-end]",
                    violates: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\nM99\n"),
                    conforms: on(LATHE, "G21\nM5\nG105 J25. K60. I30.\n/M30\nM99\n"),
                },
            ],
        },
    ],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
