//! Machine files: `ini-config.adoc`, what changes the meaning of a program; `rs274ngc.adoc`, additions.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: displays, hardware, homing, limits of following errors, tuning, filters; what other chapters hold: SPINDLES,
//! `ORIENT_OFFSET`, `DISABLE_FANUC_STYLE_SUB`, `DISABLE_AUTO_G54`, `OWORD_NARGS`, `SUBROUTINE_PATH`, planners, tool changers.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, ngc, refused, rule, runs, runs_with, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Machine files", key: "MCH", file: "linuxcnc/machine.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#sub:ini:sec:traj",
        "`LINEAR_UNITS` is the machine's unit, not that of programs",
        "`machine.units`",
        &[
            runs_with(
                ngc("G0 X1\nM2\n")
                    .with(&["machine.units=\"inch\""])
                    .beside(&[("machine.ini", "[TRAJ]\nLINEAR_UNITS=inch\n")]),
                &["STRAIGHT_TRAVERSE(1.0000"],
            ),
            Proof::Moves {
                program: ngc("G21 G90 G54 G0 X25.4\nM2\n")
                    .with(&["machine.units=\"inch\"", "offsets.G54={ X = 1.0 }"]),
                are: &["rapid X25.4 MX50.8"],
            },
        ],
    ),
    held(
        "#sub:ini:sec:traj",
        "Angles in programs are degrees, whatever `ANGULAR_UNITS` says",
        "address `A`",
        &[runs("G20 G0 A90\nM2\n", &["0.0000, 90.0000"])],
    ),
    held(
        "#sub:ini:sec:traj",
        "`COORDINATES` lists the axes; words of others are refused",
        "`machine.axes`",
        &[
            Proof::Stops {
                program: ngc("G21 G90 G0 A1\nM2\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\"]"]),
                says: "the machine has no axis `A`",
            },
            Proof::Moves {
                program: ngc("G21 G90 G0 U1\nM2\n").with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"U\"]"]),
                are: &["rapid U1."],
            },
        ],
    ),
    gap(
        "#sub:ini:sec:traj",
        "Without a list of axes the interpreter alone has X Y Z A B C",
        "a move of U, V or W on a machine whose axes nobody told is possible: `run` goes on and says the assumption instead of refusing it; `check` is silent, as it is",
        &[Proof::Moves { program: ngc("G21 G90 G0 U1\nM2\n"), are: &["rapid U1."] }],
    ),
    held(
        "#sub:ini:sec:traj",
        "Rapid rate and largest feed are the machine's",
        "`machine.rapid`, `machine.max_feed`",
        &[
            Proof::Stats {
                program: ngc("G21 G90\nG0 X0\nG0 X100\nM2\n")
                    .with(&["machine.units=\"mm\"", "machine.rapid=6000"]),
                prints: &["cycle time 0:01.0"],
            },
            Proof::Rule {
                finding: "warning[feed-above-machine-limit]",
                violates: ngc("G21 G90\nF9000 G1 X1\nM2\n")
                    .with(&["machine.units=\"mm\"", "machine.max_feed=6000"]),
                conforms: ngc("G21 G90\nF900 G1 X1\nM2\n")
                    .with(&["machine.units=\"mm\"", "machine.max_feed=6000"]),
            },
        ],
    ),
    held(
        "#sub:ini:sec:traj",
        "`MIN_LIMIT` and `MAX_LIMIT` end the travel of an axis: a move beyond is stopped",
        "`machine.travel`, rule `move-outside-travel`",
        &[Proof::Rule {
            finding: "error[move-outside-travel]",
            violates: ngc("G21 G90 G54\nG0 X500\nM2\n").with(&[
                "machine.units=\"mm\"",
                "machine.travel.X=[-100, 400]",
                "offsets.G54={ X = 0.0 }",
            ]),
            conforms: ngc("G21 G90 G54\nG0 X300\nM2\n").with(&[
                "machine.units=\"mm\"",
                "machine.travel.X=[-100, 400]",
                "offsets.G54={ X = 0.0 }",
            ]),
        }],
    ),
    gap(
        "#sub:ini:sec:traj",
        "… also in machine coordinates",
        "`move-outside-travel` (error) speaks of a G53 move beyond the travel when no work offset is told, as its page says",
        &[Proof::Rule {
            finding: "error[move-outside-travel]",
            violates: ngc("G21 G90\nG53 G0 X500\nM2\n")
                .with(&["machine.units=\"mm\"", "machine.travel.X=[-100, 400]"]),
            conforms: ngc("G21 G90\nG53 G0 X300\nM2\n")
                .with(&["machine.units=\"mm\"", "machine.travel.X=[-100, 400]"]),
        }],
    ),
    unmodelled(
        "#sub:ini:sec:traj",
        "`LOCKING_INDEXER_JOINT`: a locked rotary axis moves alone, by G0",
        "machine configuration without a key; `check` cannot know which axis locks",
    ),
    gap(
        "#sub:ini:sec:rs274ngc",
        "`CENTER_ARC_RADIUS_TOLERANCE_MM` and `_INCH` are how far an arc's radii may differ",
        "`settings.CENTER_ARC_RADIUS_TOLERANCE_MM=0.001` makes `run` and `check` as strict (the setting is in the data and changes nothing)",
        &[Proof::RunRefused {
            program: ngc("G0 X0 Y0\nF100 G2 X2.02 Y0 I1\nM2\n")
                .with(&["settings.CENTER_ARC_RADIUS_TOLERANCE_MM=0.001"])
                .beside(&[("machine.ini", "[RS274NGC]\nCENTER_ARC_RADIUS_TOLERANCE_MM=0.001\n")]),
        }],
    ),
    gap(
        "#sub:ini:sec:rs274ngc",
        "`RETAIN_G43 = 1`: once G43 is on each tool change loads the new tool's length; T0 M6 ends it",
        "`settings.RETAIN_G43=1`: lengths follow tool changes in `run` and `check` (no `length-offset-of-another-tool`)",
        &[Proof::Moves {
            program: ngc("G21 G90\nT1 M6 G43\nT2 M6\nG0 Z1\nM2\n").with(&[
                "settings.RETAIN_G43=1",
                "tools.1.length=10",
                "tools.2.length=20",
            ]),
            are: &["rapid Z1. MZ21."],
        }],
    ),
    gap(
        "#sub:ini:sec:rs274ngc",
        "`RS274NGC_STARTUP_CODE` is run at power-on: units, plane, path mode and others may begin otherwise",
        "`settings.RS274NGC_STARTUP_CODE=\"G18 G20\"` gives the modes at the start",
        &[
            Proof::Moves {
                program: ngc("G90 G0 X1\nM2\n").with(&[
                    "settings.RS274NGC_STARTUP_CODE=\"G18 G20\"",
                    "machine.units=\"mm\"",
                    "offsets.G54={ X = 0.0 }",
                ]),
                are: &["rapid X1. F?"],
            },
            Proof::Stats {
                program: ngc("G90 G0 X1\nM2\n")
                    .with(&["settings.RS274NGC_STARTUP_CODE=\"G18 G20\"", "machine.units=\"mm\""]),
                prints: &["extents, inch"],
            },
        ],
    ),
    gap(
        "#sub:ini:sec:rs274ngc",
        "`G73_PECK_CLEARANCE` and `G83_PECK_CLEARANCE` (newer versions) are the ways back of these cycles",
        "`settings.G83_PECK_CLEARANCE=0.5` (and G73) gives the clearance in `run`; the interpreter of 2.9 does not know them",
        &[Proof::Moves {
            program: ngc("G17 G21 G90\nF100\nG0 X0 Z5\nG99 G83 Z-3 R1 Q2\nG80\nM2\n")
                .with(&["settings.G83_PECK_CLEARANCE=0.5"]),
            are: &[
                "rapid Z5.",
                "rapid Z5.",
                "rapid Z1.",
                "feed Z-1.",
                "rapid Z1.",
                "rapid Z-0.5",
                "feed Z-3.",
                "rapid Z1.",
            ],
        }],
    ),
    held(
        "#sub:ini:sec:rs274ngc",
        "The interpreter of 2.9 passes over G73_PECK_CLEARANCE, G83_PECK_CLEARANCE and the defaults of G64",
        "effects of the cycles, `path-blending`",
        &[runs_with(
            ngc("F100 G0 Z5\nG83 X1 Z-5 R1 Q2\nG80\nG64\nM2\n").beside(&[(
                "machine.ini",
                "[RS274NGC]\nG83_PECK_CLEARANCE=0.5\nG64_DEFAULT_TOLERANCE=0.05\n",
            )]),
            &["STRAIGHT_TRAVERSE(1.0000, 0.0000, -0.7460"],
        )],
    ),
    gap(
        "#sub:ini:sec:rs274ngc",
        "`G64_DEFAULT_TOLERANCE` and `G64_DEFAULT_NAIVETOLERANCE` (newer versions) are P and Q of a bare G64",
        "both are among the settings of the data, and `explain G64` names them",
        &[Proof::Explains { control: "linuxcnc", code: "G64", says: "G64_DEFAULT_TOLERANCE" }],
    ),
    unmodelled(
        "#sub:ini:sec:rs274ngc",
        "`REMAP` gives codes a new meaning or a first one",
        "the body is a program or Python of the machine; `codes` of the configuration declares such codes",
    ),
    held(
        "#sub:ini:sec:rs274ngc",
        "A remapped M code can be declared",
        "`codes` of the configuration, rule `unknown-code`",
        &[Proof::Rule {
            finding: "info[unknown-code]",
            violates: ngc("G21 G90\nM400\nG0 X1\nM2\n"),
            conforms: ngc("G21 G90\nM400\nG0 X1\nM2\n").with(&["codes.M400.title=\"loads a pallet\""]),
        }],
    ),
    unmodelled(
        "#sub:ini:sec:rs274ngc",
        "`PARAMETER_FILE` keeps parameters between runs",
        "the file is the machine's; `variables` and `offsets` of the configuration give values",
    ),
    unmodelled(
        "#sub:ini:sec:rs274ngc",
        "`ON_ABORT_COMMAND` runs when a program is aborted",
        "an abort is an operator's action",
    ),
    unmodelled(
        "#sub:ini:sec:rs274ngc",
        "`NO_DOWNCASE_OWORD`, `INI_VARS`, `HAL_PIN_VARS` change which names can be read",
        "names of pins and of the machine file are unknown here in either case",
    ),
    unmodelled(
        "#sub:ini:sec:traj",
        "`NO_FORCE_HOMING = 1` lets programs run before homing",
        "an operator's action",
    ),
    held(
        "#cha:rs274ngc-programs",
        "G28 and G30 with some axes move only these: two lines are needed to go over a point with all",
        "effect `return-reference`",
        &[runs(
            "G0 X5 Y5\nG28 X2\nG0 Z1\nG28\nM2\n",
            &[
                "STRAIGHT_TRAVERSE(2.0000, 5.0000",
                "STRAIGHT_TRAVERSE(0.0000, 5.0000",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000",
            ],
        )],
    ),
    held(
        "#cha:rs274ngc-programs",
        "G84 and G87 are not implemented, says the list of differences; the interpreter (2.9) carries both out",
        "effects `cycle-tap`, `cycle-back-bore`",
        &[runs(
            "G17 G21 G90\nS100 M3\nG0 Z10\nF125\nG84 X1 Z-5 R2\nG80\nM2\n",
            &["STRAIGHT_FEED(1.0000, 0.0000, -5.0000"],
        )],
    ),
    held(
        "#cha:rs274ngc-programs",
        "U V W are three more linear axes",
        "`machine.axes`",
        &[Proof::Moves {
            program: ngc("G20 G90 G0 U1\nM2\n")
                .with(&["machine.axes=[\"X\", \"Y\", \"Z\", \"U\", \"V\", \"W\"]"]),
            are: &["rapid U1."],
        }],
    ),
    held(
        "#gcode:best-practices",
        "A preamble sets the modes: units above all",
        "rules of the sets `strict` and `restart-safe`",
        &[
            refused("error[two-codes-of-one-group]", "G17 G20 G21\nM2\n", "G17 G20\nM2\n"),
            rule("info[units-changed]", "G90 G20 G0 X1\nG21 G0 X1\nM2\n", "G90 G21 G0 X1\nM2\n"),
        ],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
