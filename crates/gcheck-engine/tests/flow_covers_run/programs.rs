//! Programs written for each field of the state: two ways that leave the field otherwise, and meet.
//!
//! Knows: which codes change which field. Must not know: what is compared.

use gcheck_engine::{Axis, BarFeeder, Machine, Position, Tool, WorkOffset};
use gcheck_geometry::Mm;

use crate::material::{Folder, Source};

/// Programs for which the law does not hold yet: name, control, text.
pub(crate) const GAPS: &[(&str, &str, &str)] = &[
    // After a call of a number that nobody knows the analysis knows hardly anything, but it does not follow the programs of the
    // file that the number may be.
    (
        "a call of a computed number",
        MILL,
        "O1\nG21 G90\nM98 P[1000+#100]\nM30\nO1001\nG0 X1.\nM99\nO1002\nG0 X2.\nM99\nO1003\nG0 X3.\nM99\n",
    ),
];

/// Fields that no program shows when they are forgotten, with the reason.
#[cfg(feature = "forgetful")]
pub(crate) const UNSEEN: &[(&str, &str, &str)] = &[
    ("BarCommand", "part", BY_ONE_BLOCK),
    ("BarCommand", "initial", BY_ONE_BLOCK),
    ("BarCommand", "clamping", BY_ONE_BLOCK),
    ("BarCommand", "orient", BY_ONE_BLOCK),
    ("Kept", "bar_feed", BY_ONE_BLOCK),
    (
        "Kept",
        "wanted_branch",
        "a state that wants a branch waits at that branch, apart from those that run into it",
    ),
    ("Calls", "elsewhere", "states with other calls under way are kept apart and never become one"),
];

#[cfg(feature = "forgetful")]
const BY_ONE_BLOCK: &str =
    "the block that calls the cutoff program makes it, and before that block all paths are one";

/// Two ways of a condition on `#100`.
struct Ways {
    name: &'static str,
    control: &'static str,
    before: &'static str,
    one: &'static str,
    other: &'static str,
    after: &'static str,
}

const fn ways(
    name: &'static str,
    control: &'static str,
    [before, one, other, after]: [&'static str; 4],
) -> Ways {
    Ways { name, control, before, one, other, after }
}

const MILL: &str = "fanuc-mill";
const HAAS: &str = "haas-mill";
const LATHE: &str = "fanuc-lathe";
const HAAS_LATHE: &str = "haas-lathe";
const CNC: &str = "linuxcnc";

const ALL: &[Ways] = &[
    // Points, variables, calls.
    ways("position", MILL, ["", "G0 X1.", "G0 X2.", "G91 X1."]),
    ways("passed point", MILL, ["", "G28 X10.", "G28 X20.", "G29 X5."]),
    ways("actual under scaling", MILL, ["G51 X0. Y0. Z0. P2.", "G0 X1.", "G0 X2.", "G50"]),
    ways("common variable", MILL, ["", "#110=1.", "#110=2.", "G0 X#110"]),
    ways("variable of unknown number", MILL, ["", "#[500+#101]=1.", "", "G0 X1."]),
    ways("program that is not here", MILL, ["", "G65 P9999", "", "G0 X1."]),
    ways("local variable", MILL, ["", "#1=1.", "#1=2.", "G0 X#1"]),
    ways("global parameter", CNC, ["", "#<_g>=1", "#<_g>=2", "G0 X#<_g>"]),
    ways("local parameter", CNC, ["", "#<a>=1", "#<a>=2", "G0 X#<a>"]),
    ways("modal call", MILL, ["", "G66 P1001 A1.", "", "G0 X1.\nG67\nM30\nO1001\n#110=#1\nM99"]),
    ways(
        "words of a modal call",
        MILL,
        ["", "G66 P1001 A1.", "G66 P1001 A2.", "G0 X1.\nG67\nM30\nO1001\n#110=#1\nM99"],
    ),
    ways("modes saved", CNC, ["", "M70", "", "G0 X1."]),
    // Modes and offsets.
    ways("distance mode", MILL, ["", "G90", "G91", "G0 X1."]),
    ways("work offset in the table", MILL, ["", "G10 L2 P3 X1.", "G10 L2 P3 X2.", "G56 G0 X1."]),
    ways("work offset", MILL, ["", "G54", "G55", "G0 X1."]),
    ways("rotation of an offset", CNC, ["", "G10 L2 P1 R30", "G10 L2 P1 R0", "G0 X1."]),
    ways("shift", MILL, ["", "G92 X5.", "G92 X6.", "G0 X1."]),
    ways("shift suspended", CNC, ["G92 X5.", "G92.2", "", "G0 X1."]),
    ways("local shift", MILL, ["", "G52 X1.", "G52 X2.", "G0 X1."]),
    ways("reference position", CNC, ["", "G0 X1.\nG28.1", "G0 X2.\nG28.1", "G0 X0."]),
    ways("length in the table", MILL, ["", "G10 L10 P1 R5.", "G10 L10 P1 R6.", "G0 X1."]),
    ways("size in the table", MILL, ["", "G10 L12 P1 R5.", "G10 L12 P1 R6.", "G0 X1."]),
    ways("wear in the table", MILL, ["", "G10 L11 P1 R.1", "G10 L11 P1 R.2", "G0 X1."]),
    ways("tool that is new in the table", MILL, ["", "G10 L10 P40 R5.", "", "G0 X1."]),
    ways("tool of unknown number in the table", HAAS, ["", "", "G10 L10 P#[3000+1] R1.", "G0 X1."]),
    // Tool, feed, spindle.
    ways("tool", MILL, ["", "T1 M6", "T2 M6", "G0 X1."]),
    ways("tool of a lathe", LATHE, ["", "T0101", "T0202", "G0 X1."]),
    ways("tool of the table", CNC, ["", "T1 M6", "T3 M6", "G43\nG0 X1."]),
    ways("tool selected", MILL, ["", "T1", "T2", "G0 X1."]),
    ways("length", MILL, ["", "G43 H1", "G43 H2", "G0 Z1."]),
    ways("number of the size", MILL, ["", "D1", "D2", "G0 X1."]),
    ways("feed", MILL, ["", "F100.", "F200.", "G1 X1."]),
    ways("feed mode", MILL, ["", "G94 F100.", "G95 F0.2", "G1 X1."]),
    ways("feed override", CNC, ["", "M48", "M49", "G0 X1."]),
    ways("adaptive feed", CNC, ["", "M52 P1", "M52 P0", "G0 X1."]),
    ways("feed stop", CNC, ["", "M53 P0", "M53 P1", "G0 X1."]),
    ways("speed override", CNC, ["", "M51 P0", "M51 P1", "G0 X1."]),
    ways("spindle", MILL, ["", "S500 M3", "S600 M4", "G0 X1."]),
    ways("cylinder by a radius that may be zero", MILL, ["", "G107 C#101", "G107 C[#102*0.]", "G0 X1."]),
    ways("limit of the speed", LATHE, ["", "G50 S2000", "G50 S3000", "G0 X1."]),
    ways("live tool", HAAS_LATHE, ["", "M133 P500", "M135", "G0 X1."]),
    ways("mist", CNC, ["", "M7", "M9", "G0 X1."]),
    ways("flood", MILL, ["", "M8", "M9", "G0 X1."]),
    ways("coolant through the spindle", HAAS, ["", "M88", "M89", "G0 X1."]),
    // Words that stay.
    ways("levels of a cycle", MILL, ["G0 Z5.", "G81 Z-1. R1. F50.", "G81 Z-2. R2. F50.", "X1.\nG80"]),
    ways("peck", MILL, ["G0 Z5.", "G83 Z-3. R1. Q1. F50.", "G83 Z-3. R1. Q2. F50.", "X1.\nG80"]),
    ways(
        "dwell of a cycle",
        MILL,
        ["G0 Z5.", "G82 Z-3. R1. P500 F50.", "G82 Z-3. R1. P700 F50.", "X1.\nG80"],
    ),
    ways(
        "shift of a bore",
        HAAS,
        ["S500 M3\nG0 Z5.", "G76 Z-3. R1. I.1 F50.", "G76 Z-3. R1. I.2 F50.", "X1.\nG80"],
    ),
    ways("depth along the tool", HAAS, ["", "G161 E5. F100.", "G161 E6. F100.", "G80"]),
    ways(
        "begin of a series",
        MILL,
        ["", "G0 Z5.\nG81 Z-1. R1. F50.", "G0 Z6.\nG81 Z-1. R1. F50.", "X1.\nG80"],
    ),
    ways(
        "plane of a pocket",
        HAAS,
        ["", POCKET, POCKET_FROM_HIGHER, "G0 Z9.\nM30\nO7000\nG1 X0. Y0.\nX9.\nY9.\nX0.\nY0.\nM99"],
    ),
    ways("feed override of a tap", CNC, ["S500 M3 F100\nG0 Z5", "G84 X1 Z-1 R1", "", "G80\nG0 X1"]),
    ways(
        "feed override of a thread",
        CNC,
        ["S500 M3 F100\nG0 X0 Z5", "G76 P1 Z-5 I-1 J.2 K1 Q30", "", "G0 X1"],
    ),
    ways("a pass", LATHE, ["S500 M3 F.2\nG0 X50. Z5.", "G90 X40. Z-10.", "G90 X38. Z-12. R-1.", "X30."]),
    ways(
        "start of a pass",
        LATHE,
        ["S500 M3 F.2", "G0 X50. Z5.\nG90 X40. Z-10.", "G0 X52. Z5.\nG90 X40. Z-10.", "G0 X60."],
    ),
    ways(
        "lead of a thread",
        LATHE,
        ["S500 M3\nG0 X50. Z5.", "G92 X40. Z-10. F1.", "G92 X40. Z-10. F2.", "X39."],
    ),
    ways("depth of roughing", LATHE, ["", "G71 U1. R.5", "G71 U2. R.5", "G0 X1."]),
    ways("pattern", LATHE, ["", "G73 U5. W2. R3", "G73 U6. W2. R3", "G0 X1."]),
    ways("retract of pecks", LATHE, ["", "G74 R1.", "G74 R2.", "G0 X1."]),
    ways("thread in many passes", LATHE, ["", "G76 P021060 Q100 R.05", "G76 P031060 Q100 R.05", "G0 X1."]),
    // Where the axes go otherwise.
    ways("scaling", MILL, ["", "G51 X0. Y0. Z0. P2.", "G51 X0. Y0. Z0. P3.", "G0 X1."]),
    ways("centre of scaling", MILL, ["", "G51 X0. Y0. Z0. P2.", "G51 X5. Y0. Z0. P2.", "G0 X1."]),
    ways("rotation", MILL, ["", "G68 X0. Y0. R30.", "G68 X0. Y0. R40.", "G0 X1."]),
    ways("centre of rotation", MILL, ["", "G68 X0. Y0. R30.", "G68 X5. Y0. R30.", "G0 X1."]),
    ways("mirror", MILL, ["", "G51.1 X0.", "G51.1 X5.", "G0 X1."]),
    ways("cylinder", HAAS, ["", "G107 Y0. A0. Q50.", "G107 Y0. A0. Q60.", "G1 Y1. F100."]),
    ways(
        "place of the wrapped axis",
        HAAS,
        ["", "G0 Y1. A10.\nG107 Y0. A0. Q50.", "G0 Y2. A20.\nG107 Y0. A0. Q50.", "G1 Y1. F100."],
    ),
    ways("face of the part", LATHE, ["G0 X20. C0.", "G12.1", "", "G1 X10. F100."]),
    ways("angle of the face", LATHE, ["G0 X20.", "G0 C10.\nG12.1", "G0 C20.\nG12.1", "G1 C5. F100."]),
    ways("place beside the face", LATHE, ["G0 X20. C0.", "G0 Y1.\nG12.1", "G0 Y2.\nG12.1", "G13.1"]),
    ways("tilted plane", MILL, ["", "G68.2 X10. J30.", "", "G0 X1."]),
    ways("origin of a tilted plane", MILL, ["", "G68.2 X10. J30.", "G68.2 X20. J30.", "G0 X1."]),
    ways("turns of a tilted plane", MILL, ["", "G68.2 X10. J30.", "G68.2 X10. J40.", "G0 X1."]),
    ways("level of smoothing", HAAS, ["", "G187 P1", "G187 P3", "G0 X1."]),
    ways("tolerance of smoothing", HAAS, ["", "G187 E0.1", "G187 E0.2", "G0 X1."]),
    ways("contour control", MILL, ["", "G5.1 Q1 R1", "G5.1 Q1 R5", "G0 X1."]),
    ways("compensation", MILL, ["F100.", "G41 D1 G1 X10.\nY10.", "", "G1 X20.\nG40 G0 X0. Y0."]),
    ways("compensation left", MILL, ["F100.", "G41 D1 G1 X10.\nY10.\nG40", "", "G0 Z10.\nX0. Y0."]),
    ways("tolerance of blending", CNC, ["", "G64 P0.1", "G64 P0.2", "G0 X1."]),
    ways("second tolerance of blending", CNC, ["", "G64 P0.1 Q0.01", "G64 P0.1 Q0.02", "G0 X1."]),
    ways(
        "control points",
        CNC,
        ["F100", "G5.2 X1 Y1 P1 L3", "G5.2 X1 Y2 P1 L3", "X2 Y2 P1\nX3 Y0 P1\nG5.3\nG0 X0"],
    ),
    ways("touch", HAAS, ["", "G31 X5. F50. M78", "G31 Y5. F50. M79", "G0 Z1."]),
    ways("touch that is kept", HAAS, ["", "G31 X5. F50. M75", "G31 Y5. F50. M75", "G0 Z1."]),
    ways("length along the tool", HAAS, ["", "G143 H1 G0 Z1. A10. B5.", "G143 H2 G0 Z1. A10. B5.", "G49"]),
    ways(
        "size along vectors",
        HAAS,
        ["F100.", "G141 D1 G1 X1. I0. J.6 K.8", "G141 D2 G1 X1. I0. J.6 K.8", "G40"],
    ),
    ways("beside the point", HAAS, ["F100.\nG141 D1", "G1 X1. I0. J.6 K.8", "G1 X1. I0. J.8 K.6", "G40"]),
    ways("bar", HAAS_LATHE, ["M5", "G105 J25. K60. I30.", "", "G0 X1."]),
    ways("chuck", HAAS_LATHE, ["", "M10", "M11", "G0 X1."]),
];

const POCKET: &str = "G0 Z5.\nG150 P7000 X5. Y5. Z-5. I2. K.1 Q2. R1. D1 F100.";
const POCKET_FROM_HIGHER: &str = "G0 Z5.\nG150 P7000 X5. Y5. Z-5. I2. K.1 Q2. R2. D1 F100.";

/// Programs of another shape: name, control, text.
const OTHERS: &[(&str, &str, &str)] = &[
    (
        "turns of a repeated call",
        MILL,
        "O1\nG21 G90\nM98 P1001 L3\nM30\nO1001\nIF [#100 GT 0.] GOTO 10\nG0 X1.\nN10\nG0 Y1.\nM99\n",
    ),
    (
        "turns of a counted loop",
        CNC,
        "o1 repeat [3]\no2 if [#100 GT 0]\nG0 X1\no2 endif\nG0 Y1\no1 endrepeat\nM2\n",
    ),
    (
        "modes restored on return",
        CNC,
        "o100 sub\no1 if [#100 GT 0]\nM73\no1 endif\nG0 X1\no100 endsub\nG21 G90\no100 call\nG0 X2\nM2\n",
    ),
    (
        "modal calls of many programs",
        MILL,
        "O1\nG21 G90\nIF [#100 EQ 0.] GOTO 10\nIF [#100 EQ 1.] GOTO 20\nIF [#100 EQ 2.] GOTO 30\nIF [#100 EQ 3.] GOTO 40\n\
         G66 P1001\nGOTO 90\nN10 G66 P1002\nGOTO 90\nN20 G66 P1003\nGOTO 90\nN30 G66 P1004\nGOTO 90\nN40 G66 P1005\n\
         N90\nG4 P1\nG67\nM30\nO1001\nM99\nO1002\nM99\nO1003\nM99\nO1004\nM99\nO1005\nM99\n",
    ),
];

/// Programs for which the law did not hold: name, control, text. Nothing is told of their machine.
const FOUND: &[(&str, &str, &str)] = &[
    ("a condition writes no variable", MILL, "IF [#110 NE #0] GOTO 10\n#111=1.\nN10\n#111=#110\nM30\n"),
    ("a jump without its label leaves both ways", MILL, "IF [#112 EQ 0.] GOTO 50\nF[0.]\nG1 X#112\nM30\n"),
    ("a tool that nobody listed has an entry", MILL, "T1 M6\nG10 L10 P1 R5.\nG43 H1\nM30\n"),
    ("smoothing of an unknown tolerance", HAAS, "G187 P1\nG187 E#110\nG0 X1.\nM30\n"),
    ("contour control that may be on", MILL, "G5.1 Q#110 R5\nG0 X1.\nM30\n"),
    ("a computed tool may be none", MILL, "T2 M6\nT[#110] M6\nG0 X1.\nM30\n"),
    ("a tool by an unknown number", CNC, "T1 M6\nM61 Q#110\nG10 L1 P1 Z5\nG43\nG0 Z1\nM2\n"),
    ("H0 is the tool in the spindle", CNC, "T1 M6\nG43 H0\nG0 Z0\nT0 M6\nG43 H0\nM2\n"),
    (
        "a length that is brought back",
        CNC,
        "T1 M6\nG43.1 Z3\nM70\nG49\nM72\nG43 H2\nM70\nT2 M6\nG43\nM72\nG0 X4\nM2\n",
    ),
    ("offsets that are brought back", CNC, "G0 X1 F100\nM70\nT1 M6 G43 G55 G1 X2 G98\nM72\nX3\nM2\n"),
    (
        "a path that was left on an unknown size",
        MILL,
        "F100.\nG41 D1 G1 X10.\nY10.\nG40\nG0 Z10.\nG0 X1.\nM30\n",
    ),
    ("G40 moves the programmed point", CNC, "F100\nG0 X5 Y5\nG41 D1\nG1 X10\nG1 Y20\nG40\nG0 Z1\nM2\n"),
    (
        "a move that is held back where paths meet",
        MILL,
        "F100.\nG41 D1\nIF [#100 GT 0.] GOTO 10\nG1 X10.\nG1 Y10.\nN10\nG1 X20.\nG40 G0 X0.\nM30\n",
    ),
    ("a pass under compensation", LATHE, "M3 S500\nG0 X50. Z2.\nG42\nG94 X20. Z-2. F.1\nM30\n"),
    (
        "a series of passes from an unknown place",
        LATHE,
        "M3 S500 F.2\nG0 X[#110] Z5.\nG90 X40. Z-10.\nG0 X[#111]\nG90 X30.\nM30\n",
    ),
    (
        "words of passes behind an unknown mode",
        LATHE,
        "M3 S500 F.2\nG0 X50. Z5.\nIF [#110 GT 0.] GOTO 10\nG90 X40. Z-10.\nN10\nX30.\nG0 X60.\nM30\n",
    ),
    (
        "a profile with a refused block",
        LATHE,
        "M3 S500 F.2\nG0 X50. Z5.\nG71 U1. R.5\nG71 P100 Q200 F.3\nN100 G0 X20.\nG2 X30. Z-5. R.5\nX31. Z-7.\nN200 X50.\nG70 P100 Q200 S300 F.1\nM30\n",
    ),
    (
        "a modal call after a move that is reported",
        LATHE,
        "G66 P1002 A1.\nG2 X1. F100.\nG67\nM30\nO1002\nG4 P1.\nM99\n",
    ),
    (
        "a touch that must come on a machine just switched on",
        HAAS,
        "G0 Z5.\nG31 Z-1. F10. M79\nIF [#105 GT 0.] THEN #111=1.\nM30\n",
    ),
    (
        "a touch beside the point",
        HAAS,
        "G0 X1. Z5.\nG1 G141 D1 X1. I0. J.6 K.8 F100.\nG31 Z[#102] F20.\nM30\n",
    ),
    ("the override of a tap that is not followed", HAAS, "S500 M3\nG74 Z-3. R1. F100.\nG80\nM30\n"),
    ("pecks from an unknown height", CNC, "G83 X2 Z-3 R1 Q1 F100\nX10 Y1\nG80\nM2\n"),
    (
        "a pattern behind an unknown cycle",
        HAAS,
        "S500 M3 F100.\nIF [#105 GT 0.] GOTO 10\nG84 Z-2. R1.\nN10\nG70 I5. J0. L4\nG80\nM30\n",
    ),
    ("a number that is kept or read", HAAS, "IF [#102 GT 0.] GOTO 10\nG44 H1\nN10\nH2\nG0 X1.\nM30\n"),
    ("a shift that replaces an unknown one", MILL, "G52 X#110\nG1 X2.5 F100.\nG52 X#111 Y2.\nG0 Z1.\nM30\n"),
    ("P0 of an offset is the shift", HAAS, "G10 L2 P#100 X1.\nG0 X1.\nM30\n"),
    (
        "an offset that may be an increment",
        MILL,
        "IF [#100 GT 0.] GOTO 10\nG91\nN10\nG10 L2 P1 X5.\nG10 L10 P1 R5.\nG10 L11 P1 R1.\nG10 L12 P1 R1.\nM30\n",
    ),
    ("an arc under a mirror", MILL, "G51.1 X0.\nG2 X2. Y0. R5. F100.\nM30\n"),
    (
        "an arc in an unknown plane",
        MILL,
        "IF [#100 GT 0.] GOTO 10\nG19\nN10\nG3 X0. Y2. Z1. I1. J1. F100.\nM30\n",
    ),
    ("a coordinate or an angle", MILL, "G0 X5. Y5.\nIF [#100 GT 0.] GOTO 10\nG16\nN10\nG0 X3. Y30.\nM30\n"),
    (
        "a mode of motion or a cycle",
        MILL,
        "F100.\nIF [#100 GT 0.] GOTO 10\nG81 Z-2. R1.\nN10\nX2.5\nG80\nM30\n",
    ),
    ("an optional stop that stops", HAAS, "S500 M3 M8\nM1\nG0 X1.\nM30\n"),
];

/// As [`OTHERS`], on a machine that was just switched on: what nobody wrote holds nothing, or zero.
const AFTER_SWITCHING_ON: &[(&str, &str, &str)] = &[
    (
        "variables that nobody wrote",
        HAAS,
        "O1\nG21 G90\nIF [#3001 GT 0.] GOTO 10\n#[510+ROUND[#3002]]=1.\nN10 (MEETS)\nG0 X1.\nM30\n",
    ),
    (
        "tables that nobody wrote",
        HAAS,
        "O1\nG21 G90\nIF [#3001 GT 0.] GOTO 10\nG65 P9999\nN10 (MEETS)\nG0 X1.\nM30\n",
    ),
];

/// What may differ in saved modes: what is done before `M70` on each of the two ways.
const SAVED: &[(&str, &str, &str)] = &[
    ("saved modes", "G91", "G90"),
    ("saved feed", "F100", "F200"),
    ("saved speed", "S100", "S200"),
    ("saved spindle", "S100 M3", "S100 M4"),
    ("saved mist", "M7", "M9"),
    ("saved flood", "M8", "M9"),
    ("saved length", "G43.1 Z1", "G43.1 Z2"),
    ("saved feed override", "M50 P0", "M50 P1"),
    ("saved speed override", "M51 P0", "M51 P1"),
    ("saved blending", "G64 P0.1", "G64 P0.2"),
    ("saved limit", "G96 D1000 S100", "G96 D2000 S100"),
    ("saved adaptive feed", "M52 P1", "M52 P0"),
    ("saved feed stop", "M53 P0", "M53 P1"),
];

/// The programs, each with a machine of which everything is told.
pub(crate) fn sources() -> Vec<Source> {
    let written = ALL.iter().map(|ways| (ways.name, ways.control, text(ways)));
    let saved = SAVED.iter().map(|(name, one, other)| {
        (*name, CNC, two_ways(CNC, "", &format!("{one}\nM70"), &format!("{other}\nM70"), "G0 X1"))
    });
    let others = OTHERS.iter().map(|(name, control, text)| (*name, *control, (*text).to_owned()));
    let source = |fresh: bool| {
        move |(name, control, text): (&str, &str, String)| Source {
            name: name.to_owned(),
            control: control.to_owned(),
            text,
            machine: Machine { fresh, ..told() },
            folder: Folder(None),
        }
    };
    let fresh = AFTER_SWITCHING_ON.iter().map(|(name, control, text)| (*name, *control, (*text).to_owned()));
    let found = FOUND.iter().map(|(name, control, text)| Source {
        machine: Machine::default(),
        ..source(false)((*name, *control, (*text).to_owned()))
    });
    written
        .chain(saved)
        .chain(others)
        .map(source(false))
        .chain(fresh.map(source(true)))
        .chain(found)
        .collect()
}

fn text(ways: &Ways) -> String {
    two_ways(ways.control, ways.before, ways.one, ways.other, ways.after)
}

fn two_ways(control: &str, before: &str, one: &str, other: &str, after: &str) -> String {
    let end = if after.contains("M30") { "" } else { "M30\n" };
    if control == CNC {
        return format!(
            "G21 G90\n{before}\no1 if [#100 GT 0]\n{one}\no1 else\n{other}\no1 endif\n{after}\nM2\n"
        );
    }
    format!(
        "O1\nG21 G90\n{before}\nIF [#100 GT 0.] GOTO 10\n{one}\nGOTO 20\nN10\n{other}\nN20 (MEETS)\n{after}\n{end}"
    )
}

/// A machine of which everything is told.
fn told() -> Machine {
    let along = |axis: Axis, by: f64| {
        let mut point = Position::ZERO;
        point.set(axis, by);
        point
    };
    let tool = |number: u32| Tool {
        pocket: number,
        offset: along(Axis::Z, f64::from(number) * 10.0),
        diameter: Mm(f64::from(number)),
        corner_radius: Mm(f64::from(number) / 10.0),
        angles: [f64::from(number), 0.0],
        orientation: number as u8,
    };
    let offset =
        |number: u16| WorkOffset { origin: along(Axis::X, f64::from(number) * 100.0), rotation: 0.0 };
    Machine {
        start: Some(Position::ZERO),
        offsets: (1..=9).map(|number| (number, offset(number))).collect(),
        tools: (1..=6).map(|number| (number, tool(number))).collect(),
        tool_table_is_complete: true,
        bar: BarFeeder { new_bar: Some(Mm(300.0)), bars: Some(3), starts_new: true },
        ..Machine::default()
    }
}
