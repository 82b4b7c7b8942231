//! Parameters: `overview.adoc`, numbered, named, predefined and system parameters; INI and HAL values.
//!
//! Knows: statements, programs. Must not know: how they are checked.
//!
//! Left out: the parameter file and what is kept when the control is off.

use super::super::statement::{Chapter, Statement, prove};
use super::row::{gap, held, legal, ngc, refused, rule, runs, runs_with, stops, unmodelled};
use crate::proof::Proof;

pub(super) const CHAPTER: Chapter =
    Chapter { title: "Parameters", key: "PAR", file: "linuxcnc/parameters.rs", statements: STATEMENTS };

const STATEMENTS: &[Statement] = &[
    held(
        "#sec:overview-parameters",
        "All values are floating-point numbers",
        "values of the engine",
        &[runs("#1=[7/2]\nG0 X#1\nM2\n", &["STRAIGHT_TRAVERSE(3.5000"])],
    ),
    held(
        "#sec:overview-parameters",
        "A numbered parameter that was never set is zero, also an argument that was not given",
        "`unset = \"zero\"`",
        &[
            runs("G0 X#100 Y#1\nM2\n", &["STRAIGHT_TRAVERSE(0.0000, 0.0000"]),
            runs("O100 SUB\nG0 X#1\nO100 ENDSUB\nO100 CALL\nM2\n", &["STRAIGHT_TRAVERSE(0.0000"]),
        ],
    ),
    held(
        "#sec:overview-parameters",
        "A named parameter that was never set is refused",
        "rule `named-parameter-unset`",
        &[
            refused("error[named-parameter-unset]", "G0 X#<nope>\nM2\n", "#<nope>=1\nG0 X#<nope>\nM2\n"),
            refused("error[named-parameter-unset]", "#<x>=#<nope>\nM2\n", "#<nope>=1\n#<x>=#<nope>\nM2\n"),
            stops("G0 X#<_nope>\nM2\n"),
            rule("warning[named-parameter-unset]", "G0 X#<_nope>\nM2\n", "#<_nope>=1\nG0 X#<_nope>\nM2\n"),
        ],
    ),
    held(
        "#sub:numbered-parameters",
        "# and a number from 1 to 5602 name a parameter, says the documentation; in the interpreter (2.9) 5601 is the last",
        "`last-variable = 5601`, rule `variable-unlisted`",
        &[
            stops("#0=5\nM2\n"),
            stops("#5602=5\nM2\n"),
            stops("G0 X#5603\nM2\n"),
            rule("error[variable-unlisted]", "#5602=5\nM2\n", "#5000=5\nM2\n"),
        ],
    ),
    held(
        "#sub:numbered-parameters",
        "A parameter number that does not exist is refused",
        "rule `variable-unlisted`",
        &[
            refused("error[variable-unlisted]", "#5700=5\nM2\n", "#5000=5\nM2\n"),
            refused("error[variable-unlisted]", "G0 X#0\nM2\n", "G0 X#1\nM2\n"),
        ],
    ),
    gap(
        "#sub:numbered-parameters",
        "#5601 is read only zero (interpreter 2.9)",
        "`run` keeps #5601 at zero as the interpreter does, or the row of deliberate differences says why not",
        &[runs("#5601=5\nG0 X#5601\nM2\n", &["STRAIGHT_TRAVERSE(0.0000"])],
    ),
    held(
        "#sub:numbered-parameters",
        "The number of a parameter is whole: #30003.078 is refused",
        "rules `malformed-number`, `assignment-without-equals`",
        &[
            refused("error[malformed-number]", "G0 X#30003.078\nM2\n", "G0 X#300\nM2\n"),
            refused("error[malformed-number]", "G0 X#1.5\nM2\n", "G0 X#1\nM2\n"),
            refused("error[assignment-without-equals]", "#30003.078=5\nM2\n", "#300=5\nM2\n"),
        ],
    ),
    gap(
        "#sub:numbered-parameters",
        "A mistake in a parameter's number is named as such",
        "one finding that says that the number of a parameter is not whole; `#30003.078=5` is called a variable that is assigned nothing today, and `X#30003.078` gets two findings",
        &[
            Proof::Reports {
                program: ngc("#30003.078=5\nM2\n"),
                findings: &["error[variable-number-not-whole] 1"],
            },
            Proof::Reports {
                program: ngc("G21 G90 G0 X#30003.078\nM2\n"),
                findings: &["error[variable-number-not-whole] 1"],
            },
        ],
    ),
    held(
        "#sub:numbered-parameters",
        "= sets a parameter",
        "assignment",
        &[runs("#3 = 15\nG0 X#3\nM2\n", &["STRAIGHT_TRAVERSE(15.0000"])],
    ),
    held(
        "#sub:numbered-parameters",
        "Settings of a line take effect after the whole line was read",
        "`assignments-after-block = true`",
        &[
            runs(
                "#3=15\n#3=6 G0 X#3\nG0 Y#3\nM2\n",
                &["STRAIGHT_TRAVERSE(15.0000, 0.0000", "STRAIGHT_TRAVERSE(15.0000, 6.0000"],
            ),
            runs("#3=1\n#3=2 #4=#3\nG0 X#4\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"]),
        ],
    ),
    held(
        "#sub:numbered-parameters",
        "# binds tighter than operations, and may be repeated",
        "expressions",
        &[runs(
            "#1=3 #2=1 #3=9\nG0 X[#1+2] Y##2 Z#[1+2]\nM2\n",
            &["STRAIGHT_TRAVERSE(5.0000, 3.0000, 9.0000"],
        )],
    ),
    held(
        "#sub:numbered-parameters",
        "#31 to #5000 are the user's, global",
        "variables of `variables.toml`",
        &[runs("#31=1 #5000=2\nG0 X#31 Y#5000\nM2\n", &["STRAIGHT_TRAVERSE(1.0000, 2.0000"])],
    ),
    held(
        "#sub:numbered-parameters",
        "#5021 to #5029 are the machine's position (newer versions); in the interpreter of 2.9 they are plain parameters",
        "no system variable for 5021",
        &[
            runs("G0 X5\nG0 Y#5021\nM2\n", &["STRAIGHT_TRAVERSE(5.0000, 0.0000"]),
            rule("error[assignment-to-read-only-variable]", "#5021=3\nM2\n", "#31=3\nM2\n"),
        ],
    ),
    held(
        "#sub:numbered-parameters",
        "#5161 and #5181 are the positions of G28 and G30, #5211 the shift, #5220 the system, #5221 and up its origins",
        "system variables",
        &[runs("G10 L2 P3 X25.4\nG56 G0 X0\nG0 X#5220 Y#5261\nM2\n", &["STRAIGHT_TRAVERSE(3.0000, 1.0000"])],
    ),
    held(
        "#sub:numbered-parameters",
        "#5400 is the tool, #5401 to #5409 its offsets, #5410 its diameter",
        "system variables `tool-number`, `tool-length`, `tool-diameter`",
        &[runs("T1 M6\nG0 X#5400 Y#5403 Z#5410\nM2\n", &["STRAIGHT_TRAVERSE(1.0000, 0.5110, 0.1250"])],
    ),
    gap(
        "#sub:numbered-parameters",
        "#5411 to #5413 are front angle, back angle and orientation of the tool",
        "`run` knows them from the tool table and from G10 (0 today)",
        &[runs("T3 M6\nG0 X#5411 Y#5412 Z#5413\nM2\n", &["STRAIGHT_TRAVERSE(90.0000, 30.0000, 2.0000"])],
    ),
    held(
        "#sub:numbered-parameters",
        "#5420 to #5428 are the present position in the active system, and cannot be set",
        "system variables `work-position`",
        &[
            runs("G0 X5 Y6\nG0 Z#5420 A#5421\nM2\n", &["STRAIGHT_TRAVERSE(5.0000, 6.0000, 5.0000, 6.0000"]),
            refused("error[assignment-to-read-only-variable]", "#5420=3\nM2\n", "#31=3\nM2\n"),
        ],
    ),
    gap(
        "#sub:numbered-parameters",
        "#5599 is 1: (DEBUG, …) prints unless the program sets it to 0",
        "`run` starts with 1 in #5599, and prints no DEBUG after `#5599=0`",
        &[runs("G0 X#5599\nM2\n", &["STRAIGHT_TRAVERSE(1.0000"])],
    ),
    held(
        "#gcode:named-parameters",
        "Names are read in small letters and without blanks",
        "named parameters",
        &[
            runs("#<P a R am>=5\nG0 X#<param> Y#<PARAM>\nM2\n", &["STRAIGHT_TRAVERSE(5.0000, 5.0000"]),
            refused("error[missing-operand]", "G0 X#<_call_level\nM2\n", "G0 X#<_call_level>\nM2\n"),
        ],
    ),
    held(
        "#gcode:named-parameters",
        "A name is local to its subroutine, one that begins with _ is global",
        "named parameters",
        &[
            refused(
                "error[named-parameter-unset]",
                "O100 SUB\nG0 X#<p>\nO100 ENDSUB\n#<p>=1\nO100 CALL\nM2\n",
                "O100 SUB\nG0 X#<_p>\nO100 ENDSUB\n#<_p>=1\nO100 CALL\nM2\n",
            ),
            refused(
                "error[named-parameter-unset]",
                "O100 SUB\n#<p>=1\nO100 ENDSUB\nO100 CALL\nG0 X#<p>\nM2\n",
                "O100 SUB\n#<_p>=1\nO100 ENDSUB\nO100 CALL\nG0 X#<_p>\nM2\n",
            ),
        ],
    ),
    held(
        "#gcode:named-parameters",
        "Two subroutines may use the same local name",
        "named parameters",
        &[runs(
            "O100 SUB\n#<v>=1\nO101 CALL\nG0 X#<v>\nO100 ENDSUB\nO101 SUB\n#<v>=2\nO101 ENDSUB\nO100 CALL\nM2\n",
            &["STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    unmodelled(
        "#gcode:named-parameters",
        "Global names keep their values into the next program",
        "each program is judged alone; `variables` of the configuration gives names a value",
    ),
    held(
        "#gcode:named-parameters",
        "Names that a configuration sets are known",
        "`variables` of the configuration",
        &[Proof::Moves {
            program: ngc("G21 G90 G0 X#<_width>\nM2\n").with(&["variables.\"#<_width>\"=12.5"]),
            are: &["rapid X12.5"],
        }],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "Predefined names cannot be set",
        "rule `assignment-to-read-only-variable`",
        &[refused("error[assignment-to-read-only-variable]", "#<_x>=5\nM2\n", "#<_my_x>=5\nM2\n")],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_vmajor> and #<_vminor> are the version; they cannot be set",
        "`system-variables`",
        &[
            refused("error[assignment-to-read-only-variable]", "#<_vmajor>=5\nM2\n", "#<_my>=5\nM2\n"),
            Proof::Rule {
                finding: "hint[unreachable-block]",
                violates: ngc("G21 G90\n#5=1\nO1 IF [#5 GT 2.8]\nG0 X1\nO1 ENDIF\nM2\n"),
                conforms: ngc("G21 G90\nO1 IF [#<_vmajor> GT 2.8]\nG0 X1\nO1 ENDIF\nM2\n"),
            },
        ],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_line> is the number of the line",
        "system variable `line-number`",
        &[runs("G0 X1\nG0 X#<_line>\nM2\n", &["STRAIGHT_TRAVERSE(1.0000", "STRAIGHT_TRAVERSE(2.0000"])],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_motion_mode> is ten times the code of the motion mode",
        "system variable `modal-code`",
        &[runs(
            "F100 G1 X1\nG1 X#<_motion_mode>\nG80\n#1=#<_motion_mode>\nG0 Y#1\nG38.3 Z-1\n#1=#<_motion_mode>\nG0 Z#1\nM2\n",
            &[
                "STRAIGHT_FEED(10.0000",
                "STRAIGHT_TRAVERSE(10.0000, 800.0000",
                "STRAIGHT_TRAVERSE(10.0000, 800.0000, 383.0000",
            ],
        )],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_plane>, #<_ccomp> and #<_coord_system> are ten times the code",
        "system variable `modal-code`",
        &[
            runs(
                "G18 G59.1\nG0 X#<_plane> Y#<_ccomp> Z#<_coord_system>\nM2\n",
                &["STRAIGHT_TRAVERSE(180.0000, 400.0000, 591.0000"],
            ),
            runs("G17\nT1 M6\nG42\n#1=#<_ccomp>\nG40\nG0 X#1\nM2\n", &["STRAIGHT_TRAVERSE(420.0000"]),
        ],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_ccomp> is 411 and 421 under G41.1 and G42.1, says the documentation; the interpreter (2.9) gives 410 and 420",
        "`system-variables`",
        &[
            runs("G17\nT1 M6\nG42.1 D3\n#1=#<_ccomp>\nG40\nG0 X#1\nM2\n", &["STRAIGHT_TRAVERSE(420.0000"]),
            runs("G17\nT1 M6\nG41.1 D3\n#1=#<_ccomp>\nG40\nG0 X#1\nM2\n", &["STRAIGHT_TRAVERSE(410.0000"]),
        ],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_metric>, #<_imperial>, #<_absolute>, #<_incremental>, #<_inverse_time>, #<_units_per_minute>, #<_units_per_rev> are 1 or 0",
        "system variables by name",
        &[
            runs(
                "G20 G91\n#1=#<_metric> #2=#<_imperial> #3=#<_absolute> #4=#<_incremental>\nG21 G90\nG0 X#1 Y#2 Z#3 A#4\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 1.0000, 0.0000, 1.0000"],
            ),
            runs(
                "G93\nG0 X#<_inverse_time> Y#<_units_per_minute> Z#<_units_per_rev>\nG95\nX#<_inverse_time> Y#<_units_per_minute> Z#<_units_per_rev>\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 0.0000, 0.0000", "STRAIGHT_TRAVERSE(0.0000, 0.0000, 1.0000"],
            ),
        ],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_tool_offset> is 1 while a length offset is on",
        "system variable `length-offset-on`",
        &[runs(
            "G0 X#<_tool_offset>\nG43.1 Z1\nG0 X#<_tool_offset> Z0\nM2\n",
            &["STRAIGHT_TRAVERSE(0.0000", "STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    held(
        "#gcode:predefined-named-parameters",
        "#<_retract_r_plane> is 1 under G98 and #<_retract_old_z> under G99, says the documentation; the interpreter (2.9) has them the other way round, as their names say",
        "system variables `code-active`",
        &[runs(
            "G98\nG0 X#<_retract_r_plane> Y#<_retract_old_z>\nG99\nX#<_retract_r_plane> Y#<_retract_old_z>\nM2\n",
            &["STRAIGHT_TRAVERSE(0.0000, 1.0000", "STRAIGHT_TRAVERSE(1.0000, 0.0000"],
        )],
    ),
    held(
        "#sub:system-parameters",
        "Names tell the spindle mode, arc mode, diameter mode, spindle, coolant and overrides",
        "system variables by name",
        &[
            runs(
                "G96 S100\nG90.1 G7\nM3\nM8\nG0 X#<_spindle_css_mode> Y#<_ijk_absolute_mode> Z#<_lathe_diameter_mode>\nG8\nX#<_spindle_on> Y#<_spindle_cw> Z#<_flood> A#<_mist>\nM2\n",
                &[
                    "STRAIGHT_TRAVERSE(0.5000, 1.0000, 1.0000",
                    "STRAIGHT_TRAVERSE(1.0000, 1.0000, 1.0000, 0.0000",
                ],
            ),
            runs(
                "M49\nG0 X#<_speed_override> Y#<_feed_override>\nM48\nM52\nX#<_speed_override> Y#<_adaptive_feed> Z#<_feed_hold>\nM2\n",
                &["STRAIGHT_TRAVERSE(0.0000, 0.0000", "STRAIGHT_TRAVERSE(1.0000, 1.0000"],
            ),
        ],
    ),
    held(
        "#sub:system-parameters",
        "#<_feed> and #<_rpm> are F and S",
        "system variables `feed`, `speed`",
        &[runs("F50 S300\nG0 X#<_feed> Y#<_rpm>\nM2\n", &["STRAIGHT_TRAVERSE(50.0000, 300.0000"])],
    ),
    held(
        "#sub:system-parameters",
        "#<_x> and the like are the position in the active system, a radius also under G7; #<_abs_x> and the like in the machine's",
        "system variables `work-position`, `machine-position`",
        &[
            runs(
                "G10 L2 P1 X5\nG0 X1\nG0 Y#<_x> Z#<_abs_x>\nM2\n",
                &["STRAIGHT_TRAVERSE(1.0000, 1.0000, 6.0000"],
            ),
            runs("G7\nG0 X10\nG0 Z#<_x> Y#5420\nM2\n", &["STRAIGHT_TRAVERSE(5.0000, 5.0000, 5.0000"]),
        ],
    ),
    held(
        "#sub:system-parameters",
        "#<_current_tool> and #<_selected_tool> are the tool in the spindle and the selected one",
        "system variables `tool-number`, `selected-tool`",
        &[runs(
            "T2\nG0 X#<_selected_tool> Y#<_current_tool>\nM6\nX#<_selected_tool> Y#<_current_tool>\nM2\n",
            &["STRAIGHT_TRAVERSE(2.0000, 0.0000", "STRAIGHT_TRAVERSE(2.0000, 2.0000"],
        )],
    ),
    gap(
        "#sub:system-parameters",
        "#<_selected_pocket> is -1 before any T, and #<_current_pocket> is the place of the tool",
        "`run` knows them, or takes them as unknown; it takes 0 for both",
        &[
            runs(
                "T2\nM6\nG0 X#<_selected_pocket> Y#<_current_pocket>\nM2\n",
                &["STRAIGHT_TRAVERSE(2.0000, 2.0000"],
            ),
            runs("G0 X#<_selected_pocket>\nM2\n", &["STRAIGHT_TRAVERSE(-1.0000"]),
        ],
    ),
    held(
        "#sub:system-parameters",
        "#<_task> is 0 outside the machine, #<_call_level> the depth of calls, #<_remap_level> 0",
        "system variables by name",
        &[runs(
            "O100 SUB\nG0 X#<_call_level>\nO100 ENDSUB\nG0 X#<_task> Y#<_call_level> Z#<_remap_level>\nO100 CALL\nM2\n",
            &["STRAIGHT_TRAVERSE(0.0000, 0.0000, 0.0000", "STRAIGHT_TRAVERSE(1.0000"],
        )],
    ),
    gap(
        "#gcode:ini-hal-params",
        "#<_ini[section]name> is a value of the machine file; without it it is refused",
        "a key gives such values (`variables.\"#<_ini[setup]xpos>\"`), `run` follows it and says what is missing instead of printing `nan`",
        &[
            runs_with(
                ngc("G0 X#<_ini[setup]xpos>\nM2\n")
                    .with(&["variables.\"#<_ini[setup]xpos>\"=3.5"])
                    .beside(&[("machine.ini", "[SETUP]\nXPOS=3.5\n[RS274NGC]\nINI_VARS=1\n")]),
                &["STRAIGHT_TRAVERSE(3.5000"],
            ),
            Proof::Stops { program: ngc("G21 G90 G0 X#<_ini[setup]xpos>\nM2\n"), says: "_ini[setup]xpos" },
        ],
    ),
    gap(
        "#gcode:ini-hal-params",
        "#<_hal[pin]> is the value of a pin",
        "`run` says that the value is unknown and stops, or goes on with an unknown that is printed as such: `SET_FEED_RATE(nan)` and `STRAIGHT_TRAVERSE(nan, …)` are no functions of a machine",
        &[Proof::Stops { program: ngc("G21 G90 G0 X#<_hal[motion.time]>\nM2\n"), says: "_hal[motion.time]" }],
    ),
    held(
        "#gcode:ini-hal-params",
        "EXISTS tells whether a value of the machine file or a pin is there",
        "function `EXISTS`",
        &[
            legal("G21 G90\nO100 IF [EXISTS[#<_ini[setup]xpos>]]\nG0 X1\nO100 ELSE\nG0 X2\nO100 ENDIF\nM2\n"),
            Proof::Rule {
                finding: "hint[unreachable-block]",
                violates: ngc(
                    "G21 G90\n#<a>=1\nO100 IF [EXISTS[#<a>]]\nG0 X1\nO100 ELSE\nG0 X2\nO100 ENDIF\nM2\n",
                ),
                conforms: ngc(
                    "G21 G90\nO100 IF [EXISTS[#<_ini[setup]xpos>]]\nG0 X1\nO100 ELSE\nG0 X2\nO100 ENDIF\nM2\n",
                ),
            },
        ],
    ),
    unmodelled(
        "#gcode:ini-hal-params",
        "Values of pins are those at the start of the program; M66 E0 L0 brings them up to date",
        "pins are hardware",
    ),
    held(
        "#sub:numbered-parameters",
        "A parameter that is set twice on a line has the last value",
        "assignment",
        &[
            runs("#3=15 #3=6\nG0 X#3\nM2\n", &["STRAIGHT_TRAVERSE(6.0000"]),
            legal("#3=15 #4=6\nG0 X[#3+#4]\nM2\n"),
        ],
    ),
    gap(
        "#gcode:best-practices",
        "Setting and using a parameter on one line is a trap",
        "`check` says (info) that a word of the block reads the old value of a parameter that the block sets",
        &[rule(
            "info[parameter-set-and-read]",
            "G21 G90\n#3=15\n#3=6 G0 X#3\nM2\n",
            "G21 G90\n#3=15\n#3=6\nG0 X#3\nM2\n",
        )],
    ),
];

#[test]
fn holds() {
    prove(&CHAPTER);
}
