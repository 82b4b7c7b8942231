//! Saved modes: `m-code.adoc`, M70 to M73.
//!
//! Knows: statements, programs. Must not know: how they are checked.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{explains, gap, held, legal, refused, rule, runs};

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Saved modes", key: "SAV", file: "linuxcnc/saved_modes.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#mcode:m70",
        "M70 saves the modes, M72 brings them back",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "M70\nG91 G18\nM72\nG0 X1\nX1\nM2\n",
            &[
                "SELECT_PLANE(CANON_PLANE_XZ)",
                "SELECT_PLANE(CANON_PLANE_XY)",
                "STRAIGHT_TRAVERSE(1.0000",
                "STRAIGHT_TRAVERSE(1.0000",
            ],
        )],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved are plane, distance mode, feed mode, return level, arc mode, diameter mode and path mode",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "M70\nG19 G91 G98 G90.1 G7 G61\nM72\nG0 X#<_plane> Y#<_absolute> Z#<_retract_old_z>\nG0 X#<_ijk_absolute_mode> Y#<_lathe_diameter_mode>\nM2\n",
            &[
                "SELECT_PLANE(CANON_PLANE_YZ)",
                "SELECT_PLANE(CANON_PLANE_XY)",
                "STRAIGHT_TRAVERSE(170.0000, 1.0000, 0.0000",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000",
            ],
        )],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved is the coordinate system",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "G10 L2 P2 X5\nM70\nG55\nM72\nG0 X#5220\nM2\n",
            &["SET_G5X_OFFSET(2, 5.0000", "SET_G5X_OFFSET(1, 0.0000", "STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved are cutter compensation and tool length",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "T1 M6 G43\nG0 Z9\nM70\nG49\nM72\nG0 Z5\nM2\n",
            &[
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 0.0000",
                "USE_TOOL_LENGTH_OFFSET(0.0000, 0.0000, 12.9794",
                "STRAIGHT_TRAVERSE(0.0000, 0.0000, 5.0000",
            ],
        )],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved are spindle and coolant",
        "effects `save-modes`, `restore-modes`",
        &[
            runs("M8\nM70\nM9\nM72\nM2\n", &["FLOOD_ON", "FLOOD_OFF", "FLOOD_ON"]),
            runs(
                "S100 M4\nM70\nM5\nM72\nM2\n",
                &["START_SPINDLE_COUNTERCLOCKWISE", "STOP_SPINDLE_TURNING", "START_SPINDLE_COUNTERCLOCKWISE"],
            ),
        ],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved are the adaptive feed and the feed stop",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "M52\nM53\nM70\nM52 P0\nM53 P0\nM72\nM2\n",
            &["ENABLE_ADAPTIVE_FEED", "DISABLE_ADAPTIVE_FEED", "ENABLE_ADAPTIVE_FEED"],
        )],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved are the overrides, says the documentation; the interpreter (2.9) does not switch them off again",
        "effects `save-modes`, `restore-modes`",
        &[
            runs(
                "M50 P0\nM70\nM50 P1\nM72\nM2\n",
                &["DISABLE_FEED_OVERRIDE", "ENABLE_FEED_OVERRIDE", "ENABLE_SPEED_OVERRIDE"],
            ),
            runs("M51 P0\nM70\nM51 P1\nM72\nM2\n", &["DISABLE_SPEED_OVERRIDE", "ENABLE_SPEED_OVERRIDE"]),
            runs("M49\nM70\nM48\nM72\nM2\n", &["DISABLE_FEED_OVERRIDE", "ENABLE_FEED_OVERRIDE"]),
        ],
    ),
    held(
        "#mcode:m70-saved-state",
        "Saved are F and S",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "F10 S100\nM70\nF200 S500\nM72\nG1 X1\nM2\n",
            &[
                "SET_FEED_RATE(200.0000",
                "SET_FEED_RATE(10.0000",
                "SET_SPINDLE_SPEED(0, 100.0000)",
                "STRAIGHT_FEED(1.0000",
            ],
        )],
    ),
    gap(
        "#mcode:m72",
        "An F given in the block that changed the units comes back as its number in the new units (interpreter 2.9)",
        "`run` gives F the meaning of the restored units as the interpreter does: 10 mm a minute comes back as 10 inches a minute; `check` warns of F in a block that changes the units (see ORD)",
        &[runs(
            "G20 F10\nM70\nG21\nF200\nM72\nG1 X1\nM2\n",
            &["USE_LENGTH_UNITS(CANON_UNITS_INCHES)", "SET_FEED_RATE(10.0000", "STRAIGHT_FEED(1.0000"],
        )],
    ),
    held(
        "#mcode:m72",
        "Where M72 changes the units, F and lengths are restored in their own units",
        "effects `save-modes`, `restore-modes`",
        &[
            runs(
                "G20\nF10\nM70\nG21\nF200\nM72\nG1 X1\nM2\n",
                &["USE_LENGTH_UNITS(CANON_UNITS_INCHES)", "SET_FEED_RATE(10.0000", "STRAIGHT_FEED(1.0000"],
            ),
            runs(
                "G21 F100\nM70\nG20\nF5\nM72\nG1 X1\nM2\n",
                &["USE_LENGTH_UNITS(CANON_UNITS_MM)", "SET_FEED_RATE(100.0000", "STRAIGHT_FEED(1.0000"],
            ),
        ],
    ),
    gap(
        "#mcode:m70-saved-state",
        "Saved is the spindle mode with its limit; the interpreter (2.9) loses the limit D of G96 and restores none",
        "`run` prints the interpreter's limit (none), and `check` warns that a restored G96 has no limit on this version",
        &[runs(
            "G96 S200 D1000\nM70\nG97 S500\nM72\nM2\n",
            &["SET_SPINDLE_MODE(0, 1000000000000000019884624838656.0000)"],
        )],
    ),
    held(
        "#mcode:m70-saved-state",
        "The motion mode is not restored",
        "effects `save-modes`, `restore-modes`",
        &[runs(
            "F100 G1 X1\nM70\nG0 X2\nM72\nX3\nM2\n",
            &["STRAIGHT_FEED(1.0000", "STRAIGHT_TRAVERSE(2.0000", "STRAIGHT_TRAVERSE(3.0000"],
        )],
    ),
    held(
        "#mcode:m70",
        "Of several M70 at one level the last counts",
        "effect `save-modes`",
        &[runs(
            "M70\nG91\nM70\nM72\nG0 X1\nX1\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000"],
        )],
    ),
    held(
        "#mcode:m70",
        "Each call of a subroutine has a place of its own, that goes away with it",
        "rule `saved-modes-missing`",
        &[
            runs(
                "O100 SUB\nM70\nG91\nM72\nO100 ENDSUB\nO100 CALL\nG0 X1\nX1\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(1.0000"],
            ),
            refused(
                "error[saved-modes-missing]",
                "O100 SUB\nG91\nM72\nO100 ENDSUB\nM70\nO100 CALL\nM2\n",
                "O100 SUB\nM70\nG91\nM72\nO100 ENDSUB\nO100 CALL\nM2\n",
            ),
        ],
    ),
    held(
        "#mcode:m72",
        "M72 without M70 at its level is refused",
        "rule `saved-modes-missing`",
        &[refused("error[saved-modes-missing]", "M72\nM2\n", "M70\nM72\nM2\n")],
    ),
    held(
        "#mcode:m71",
        "M71 makes what was saved invalid: a later M72 is refused",
        "effect `forget-modes`",
        &[refused("error[saved-modes-missing]", "M70\nM71\nM72\nM2\n", "M70\nM72\nM71\nM2\n")],
    ),
    held(
        "#mcode:m71",
        "M71 without M70 is fine (interpreter 2.9)",
        "effect `forget-modes`",
        &[legal("M71\nM2\n"), runs("M71\nM2\n", &["PROGRAM_END"])],
    ),
    held(
        "#mcode:m71",
        "In a subroutine with M73 M71 keeps the modes from coming back",
        "effect `forget-modes`, rule `incremental-left-on`",
        &[
            runs(
                "O100 SUB\nM73\nG91\nM71\nO100 ENDSUB\nO100 CALL\nG0 X1\nX1\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000"],
            ),
            rule(
                "warning[incremental-left-on]",
                "O100 SUB\nM73\nG91\nM71\nO100 ENDSUB\nO100 CALL\nG0 X1\nX1\nM2\n",
                "O100 SUB\nM73\nG91\nO100 ENDSUB\nO100 CALL\nG0 X1\nX1\nM2\n",
            ),
        ],
    ),
    held("#mcode:m71", "M71 is of doubtful use and may go away", "text of `M71`", &[explains("M71", "M71")]),
    held(
        "#mcode:m73",
        "M73 saves the modes of the caller and brings them back at endsub and at every return",
        "effect `save-modes-until-return`",
        &[
            runs(
                "O100 SUB\nM73\nG91 G18\nF50\nO100 ENDSUB\nF100\nO100 CALL\nG0 X1\nX1\nM2\n",
                &[
                    "SET_FEED_RATE(100.0000",
                    "SET_FEED_RATE(50.0000",
                    "SET_FEED_RATE(100.0000",
                    "SELECT_PLANE(CANON_PLANE_XY)",
                    "STRAIGHT_TRAVERSE(1.0000",
                    "STRAIGHT_TRAVERSE(1.0000",
                ],
            ),
            runs(
                "O100 SUB\nM73\nG91\nO101 IF [1 GT 0]\nO100 RETURN\nO101 ENDIF\nO100 ENDSUB\nO100 CALL\nG0 X1\nX1\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(1.0000"],
            ),
        ],
    ),
    held(
        "#mcode:m73",
        "M73 brings a feed of other units back as it was",
        "effect `save-modes-until-return`",
        &[runs(
            "O100 SUB\nM73\nG20\nF5\nO100 ENDSUB\nG21 F200\nO100 CALL\nG1 X1\nM2\n",
            &[
                "SET_FEED_RATE(200.0000",
                "USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
                "SET_FEED_RATE(5.0000",
                "USE_LENGTH_UNITS(CANON_UNITS_MM)",
                "SET_FEED_RATE(200.0000",
            ],
        )],
    ),
    held(
        "#mcode:m73",
        "The end of a main program with M73 brings nothing back",
        "effect `save-modes-until-return`",
        &[runs("G98\nM73\nG99\nM2\n", &["PROGRAM_END"])],
    ),
    held(
        "#mcode:m98-m99",
        "Single modes can be kept with parameters: #<_absolute> and others tell what is on",
        "system variables by name",
        &[runs(
            "O100 SUB\n#<absolute>=#<_absolute>\nG91 G0 Z1\nO101 IF [#<absolute>]\nG90\nO101 ENDIF\nO100 ENDSUB\nO100 CALL\nG0 X1\nX1\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000", "STRAIGHT_TRAVERSE(1.0000, 0.0000, 1.0000"],
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
