//! Spindle, coolant, overrides, feed and speed words: `m-code.adoc`, M3 to M9, M19, M48 to M53; `other-code.adoc`, F and S;
//! `machining-center.adoc`, spindle, coolant, overrides.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: pins of the hardware layer.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, legal, ngc, refused, rule, runs, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter = Chapter {
    title: "Spindle, coolant, overrides",
    key: "SPN",
    file: "linuxcnc/spindle.rs",
    statements: STATEMENTS,
};

const STATEMENTS: &[Statement] = &[
    held(
        "#mcode:m3-m4-m5",
        "M3 starts the spindle clockwise at S, M4 counter-clockwise, M5 stops it",
        "effects `spindle-clockwise`, `spindle-counter-clockwise`, `spindle-stop`",
        &[runs(
            "S100 M3\nM4\nM5\nM2\n",
            &[
                "SET_SPINDLE_SPEED(0, 100.0000)",
                "START_SPINDLE_CLOCKWISE(0)",
                "START_SPINDLE_COUNTERCLOCKWISE(0)",
                "STOP_SPINDLE_TURNING(0)",
            ],
        )],
    ),
    held(
        "#mcode:m3-m4-m5",
        "Without $ they mean spindle 0; $-1 means all",
        "words of `M3`",
        &[runs(
            "S100 M3 $0\nM5 $-1\nM3 $-1\nM2\n",
            &["START_SPINDLE_CLOCKWISE(0)", "STOP_SPINDLE_TURNING(0)", "START_SPINDLE_CLOCKWISE(0)"],
        )],
    ),
    held(
        "#mcode:m3-m4-m5",
        "$ names one of the machine's spindles (up to 8); another is refused",
        "setting `SPINDLES`; with the default of one `check` gives an info and the assumption",
        &[refused("info[number-out-of-range]", "M3 $1\nM2\n", "M3 $0\nM2\n")],
    ),
    gap(
        "#mcode:m3-m4-m5",
        "With `SPINDLES=3` spindles 1 and 2 turn by themselves",
        "`run` and the state tell several spindles apart, and `check` reports `$1` beside `S` alone",
        &[Proof::AsInterpreter {
            program: ngc("S100 $1\nM3 $1\nM2\n")
                .with(&["settings.SPINDLES=3"])
                .beside(&[("machine.ini", "[TRAJ]\nSPINDLES=3\n")]),
            prints: &["SET_SPINDLE_SPEED(1, 100.0000)", "START_SPINDLE_CLOCKWISE(1)"],
        }],
    ),
    held(
        "#mcode:m3-m4-m5",
        "M3 with a speed of zero is fine; the spindle turns once S is above zero",
        "rule `speed-missing`",
        &[
            runs(
                "S0 M3\nS100\nM2\n",
                &[
                    "SET_SPINDLE_SPEED(0, 0.0000)",
                    "START_SPINDLE_CLOCKWISE(0)",
                    "SET_SPINDLE_SPEED(0, 100.0000)",
                ],
            ),
            rule(
                "warning[speed-missing]",
                "G17 G21 G90\nS0 M3\nF10 G1 X1\nM2\n",
                "G17 G21 G90\nS0 M3\nS100\nF10 G1 X1\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m3-m4-m5",
        "M3 and M4 may be repeated while it turns, M5 while it stands",
        "effects of the spindle",
        &[legal("S100 M3\nM3\nM4\nM5\nM5\nM2\n")],
    ),
    held(
        "#tbl:mcodes-modal-groups, #mcode:m19",
        "M3 with M4, M5 or M19 in one block is refused: they are one modal group",
        "rule `two-codes-of-one-group`",
        &[
            refused("error[two-codes-of-one-group]", "S1 M3 M4\nM2\n", "S1 M3\nM4\nM2\n"),
            refused("error[two-codes-of-one-group]", "S1 M3 M5\nM2\n", "S1 M3\nM5\nM2\n"),
            refused("error[two-codes-of-one-group]", "S1 M3 M19 R5\nM2\n", "S1 M3\nM19 R5\nM2\n"),
        ],
    ),
    held(
        "#sec:set-spindle-speed",
        "S is turns a minute, also while the spindle stands",
        "phase `spindle-speed`",
        &[runs(
            "S100\nM3\nS200\nM2\n",
            &[
                "SET_SPINDLE_SPEED(0, 100.0000)",
                "START_SPINDLE_CLOCKWISE(0)",
                "SET_SPINDLE_SPEED(0, 200.0000)",
            ],
        )],
    ),
    held(
        "#sec:set-spindle-speed",
        "A negative S is refused",
        "address `S`",
        &[refused("error[sign-not-accepted]", "S-5\nM2\n", "S5\nM2\n")],
    ),
    held(
        "#sec:set-feed-rate",
        "F is the feed rate, as the feed mode says",
        "phase `feed`",
        &[runs("F12.5\nG1 X1\nM2\n", &["SET_FEED_RATE(12.5000", "STRAIGHT_FEED(1.0000"])],
    ),
    held(
        "#sec:set-feed-rate",
        "A negative F is refused (interpreter 2.9)",
        "address `F`",
        &[refused("error[sign-not-accepted]", "F-5\nM2\n", "F5\nM2\n")],
    ),
    held(
        "#mcode:m7-m8-m9",
        "M7 switches mist on, M8 flood, M9 both off; they may be repeated",
        "effects `mist-on`, `flood-on`, `coolant-off`",
        &[
            runs("M7\nM8\nM8\nM9\nM9\nM2\n", &["MIST_ON", "FLOOD_ON", "MIST_OFF", "FLOOD_OFF"]),
            legal("M7\nM8\nM9\nM9\nM2\n"),
        ],
    ),
    held(
        "#tbl:mcodes-modal-groups",
        "M7 and M8 can both be on, but not from one block (interpreter 2.9)",
        "rule `two-codes-of-one-group`",
        &[
            refused("error[two-codes-of-one-group]", "M7 M8\nM2\n", "M7\nM8\nM2\n"),
            refused("error[two-codes-of-one-group]", "M8 M9\nM2\n", "M8\nM9\nM2\n"),
        ],
    ),
    held(
        "#mcode:m19",
        "M19 turns the spindle to the angle R; P0 the short way (the default), P1 clockwise, P2 counter-clockwise; Q is how long to wait",
        "effect `spindle-orient`",
        &[runs(
            "M19 R45\nM19 R90 P1 Q2\nM2\n",
            &[
                "ORIENT_SPINDLE(0, 45.0000, 0)",
                "ORIENT_SPINDLE(0, 90.0000, 1)",
                "SPINDLE.0.WAIT_ORIENT_COMPLETE(2.0000)",
            ],
        )],
    ),
    held(
        "#mcode:m19",
        "R is from 0 to 360, P 0, 1 or 2, Q above zero",
        "words of `M19`",
        &[
            refused("error[number-out-of-range]", "M19 R361\nM2\n", "M19 R360\nM2\n"),
            refused("error[number-out-of-range]", "M19 R-5\nM2\n", "M19 R0\nM2\n"),
            refused("error[number-out-of-range]", "M19 R5 P3\nM2\n", "M19 R5 P2\nM2\n"),
            refused("error[number-out-of-range]", "M19 R5 Q0\nM2\n", "M19 R5 Q1\nM2\n"),
        ],
    ),
    held(
        "#mcode:m19",
        "P must be whole (interpreter 2.9), and $ one of the machine's spindles",
        "rule `number-out-of-range`",
        &[
            refused("error[number-out-of-range]", "M19 R5 P1.5\nM2\n", "M19 R5 P1\nM2\n"),
            refused("info[number-out-of-range]", "M19 R5 $1\nM2\n", "M19 R5 $0\nM2\n"),
        ],
    ),
    held(
        "#mcode:m19",
        "M19 without R: the interpreter (2.9) does nothing",
        "effect of `M19`, words of `M19`",
        &[
            runs("M19\nG0 X1\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
            rule("warning[required-word-missing]", "M19\nM2\n", "M19 R0\nM2\n"),
        ],
    ),
    held(
        "#mcode:m19",
        "M19 is of the group of M3 to M5: after it the spindle stands until M3 or M4",
        "rule `spindle-stopped-while-cutting`",
        &[rule(
            "info[spindle-stopped-while-cutting]",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nM19 R0\nF100 G1 Z-5\nG0 Z5\nM2\n",
            "G17 G21 G90 G54\nT1 M6 G43\nS100 M3\nG0 X0 Y0\nZ5\nM19 R0\nM3\nF100 G1 Z-5\nG0 Z5\nM2\n",
        )],
    ),
    gap(
        "#mcode:m19",
        "`ORIENT_OFFSET` is added to R",
        "`settings.ORIENT_OFFSET` is added to R in `run`; the setting is in the data",
        &[Proof::AsInterpreter {
            program: ngc("M19 R10\nM2\n")
                .with(&["settings.ORIENT_OFFSET=30"])
                .beside(&[("machine.ini", "[RS274NGC]\nORIENT_OFFSET=30\n")]),
            prints: &["ORIENT_SPINDLE(0, 40.0000, 0)"],
        }],
    ),
    held(
        "#mcode:m48-m49",
        "M48 enables the overrides of speed and feed, M49 disables both",
        "effects `overrides-on`, `overrides-off`",
        &[runs(
            "M49\nM48\nM2\n",
            &[
                "DISABLE_FEED_OVERRIDE",
                "DISABLE_SPEED_OVERRIDE",
                "ENABLE_FEED_OVERRIDE",
                "ENABLE_SPEED_OVERRIDE",
            ],
        )],
    ),
    held(
        "#mcode:m48-m49",
        "$ of M48 and M49 names the spindle (newer versions); the interpreter of 2.9 refuses it",
        "`newer-words`, words of the codes",
        &[stops("M49 $0\nM2\n"), explains("M49", "newer versions")],
    ),
    held(
        "#mcode:m50",
        "M50 or M50 P1 enables the feed override, M50 P0 disables it",
        "effect `feed-override`",
        &[runs(
            "M50 P0\nM50\nM50 P0\nM50 P1\nM2\n",
            &[
                "DISABLE_FEED_OVERRIDE",
                "ENABLE_FEED_OVERRIDE",
                "DISABLE_FEED_OVERRIDE",
                "ENABLE_FEED_OVERRIDE",
            ],
        )],
    ),
    held(
        "#mcode:m51",
        "M51 does the same for the speed",
        "effect `speed-override`",
        &[
            runs("M51 P0\nM51\nM2\n", &["DISABLE_SPEED_OVERRIDE", "ENABLE_SPEED_OVERRIDE"]),
            stops("M51 P0 $0\nM2\n"),
            legal("M51 P0 $0\nM2\n"),
        ],
    ),
    held(
        "#mcode:m52",
        "M52 uses the adaptive feed, M52 P0 does not",
        "effect `adaptive-feed`",
        &[runs(
            "M52\nM52 P0\nM52 P1\nM2\n",
            &["ENABLE_ADAPTIVE_FEED", "DISABLE_ADAPTIVE_FEED", "ENABLE_ADAPTIVE_FEED"],
        )],
    ),
    held(
        "#mcode:m53",
        "M53 enables the feed stop input, M53 P0 disables it",
        "effect `feed-stop-input`",
        &[runs("M53\nM53 P0\nM2\n", &["ENABLE_FEED_HOLD", "DISABLE_FEED_HOLD"])],
    ),
    held(
        "#mcode:m50",
        "P of M50 to M53 is 0 or 1; the interpreter (2.9) takes any other number for 1",
        "words of `M50`, rule `number-out-of-range`",
        &[
            runs("M50 P2\nM51 P2\nM2\n", &["ENABLE_FEED_OVERRIDE", "ENABLE_SPEED_OVERRIDE"]),
            rule("warning[number-out-of-range]", "M50 P2\nM2\n", "M50 P1\nM2\n"),
        ],
    ),
    held(
        "#mcode:m50",
        "An override that the program switches off does not count in times",
        "`machine.feed_override`",
        &[
            Proof::Stats {
                program: ngc("G21 G90\nF60\nG0 X0\nG1 X10\nM2\n").with(&["machine.feed_override=50"]),
                prints: &["cutting 0:20.0"],
            },
            Proof::Stats {
                program: ngc("G21 G90\nF60\nM50 P0\nG0 X0\nG1 X10\nM2\n").with(&["machine.feed_override=50"]),
                prints: &["cutting 0:10.0"],
            },
        ],
    ),
    held(
        "#tbl:mcodes-modal-groups",
        "M48 to M53 are one group: two in a block are refused (interpreter 2.9)",
        "rule `two-codes-of-one-group`",
        &[
            refused("error[two-codes-of-one-group]", "M48 M49\nM2\n", "M48\nM49\nM2\n"),
            refused("error[two-codes-of-one-group]", "M50 M53\nM2\n", "M50\nM53\nM2\n"),
        ],
    ),
    held(
        "#cha:cnc-machine-overview",
        "Lengths can be millimetres or inches; speeds are turns a minute and angles degrees always",
        "effects `inch`, `millimetre`",
        &[runs("G20 G0 A90\nG21 G0 A180\nM2\n", &["0.0000, 90.0000", "0.0000, 180.0000"])],
    ),
    held(
        "#cha:cnc-machine-overview",
        "Changing units, the tool's length or the offsets adjusts the position that is read, without moving",
        "system variables `work-position`",
        &[runs(
            "G21\nG0 X25.4\nG20\nG0 Y#5420\nM2\n",
            &["STRAIGHT_TRAVERSE(25.4000", "STRAIGHT_TRAVERSE(1.0000, 1.0000"],
        )],
    ),
    held(
        "#cha:cnc-machine-overview",
        "Rotary axes count on without limit, in degrees",
        "effect `rapid`",
        &[runs("G0 A720\nG91 A-1080\nM2\n", &["0.0000, 720.0000", "0.0000, -360.0000"])],
    ),
    unmodelled(
        "#sub:ini:sec:rs274ngc",
        "`WRAPPED_ROTARY = 1`: the axis goes to an angle below 360, and the sign is the direction",
        "axis configuration without a key in `[machine]`; moves of rotary axes are those of an axis that counts on",
    ),
    unmodelled(
        "#cha:cnc-machine-overview",
        "Positive rotation is counter-clockwise seen from the positive end of the axis, from the part",
        "the direction changes no number of a program; `plot` turns the part by it",
    ),
    unmodelled(
        "#sec:set-spindle-speed",
        "With the speed override on the speed is another than programmed",
        "an operator's action",
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
