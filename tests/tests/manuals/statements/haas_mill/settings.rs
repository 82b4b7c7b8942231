//! Chapter 9 (p. 367 to 414), as far as a setting changes what a program means: its sentences and what proves them.
//!
//! With their codes stand Settings 22, 27, 28 and 52 (cycles), 33 (G52, G92), 34 and 79 (rotary feeds, G107), 35
//! (G60), 40 (compensation), 43, 44 and 58 (chapter 5), 45 to 48, 80 and 250 (mirror image), 59 to 63 (probing), 71,
//! 72, 73 and 188 to 190 (scaling, rotation), 85 and 191 (G187), 108 (G28), 117 (G143), 130 and 133 (tapping), 165 and
//! 166 (M138), 247 and 293 to 298 (tool changes), 251 (M98), 254 to 257 and 300 to 305 (rotary centres), 306 (chip
//! cleaning).
//!
//! Left out: settings of screens, keys, locks of keys, jogging, graphics, warm-up, thermal compensation, conveyors,
//! lights, pumps, timers, tool life, networks and simulators.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::blocks::cut;
use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Legal, Makes, Rule, Run, Same, Silent};
use crate::statements::statement::{Chapter, prove};

/// A short program.
macro_rules! short {
    ($blocks:literal) => {
        mill(concat!("O1 (A)\nG20 G90 G54 G0 X0.\n", $blocks, ""))
    };
}

pub(crate) const CHAPTER: Chapter = Chapter { title: "Settings that change what a program means", key: "SET", file: "haas_mill/settings.rs", statements: &[
held("p. 375", "With Setting 9 at INCH lengths are inches to 0.0001, at MM millimetres to 0.001.", "`numbers` of the control", &[Makes { program: cut!("X1\n"), block: "X1", events: &["rapid X0.0001"] }, Makes { program: mill("O1 (A)\nG21 G90 G54 G0 X0.\nX1\nM30\n"), block: "X1", events: &["rapid X0.001"] }]),
held("p. 375", "Setting 9 is the default of G20 and G21: a program without either runs in its units.", "setting 9", &[Run { program: mill("O1 (A)\nG90 G54 G0 X1.\nM30\n").with(&["settings.9=\"mm\""]), prints: &["stdin, mm"] }]),
held("p. 375", "Without G20 or G21 the units are those of the machine.", "`machine.units`", &[Run { program: mill("O1 (A)\nG90 G54 G0 X1.\nM30\n").with(&["machine.units=\"mm\""]), prints: &["stdin, mm"] }, Run { program: mill("O1 (A)\nG90 G54 G0 X1.\nM30\n").with(&["machine.units=\"inch\""]), prints: &["stdin, inch"] }]),
gap("p. 376", "Setting 10 halves the rapids.", "with `10 = true` rapid moves take twice the time", &[Makes { program: cut!("X1.\n").with(&["settings.10=true", "machine.rapid=1000.0"]), block: "X1.", events: &["rapid X1 T0.12"] }]),
held("p. 376", "With Setting 15 on H must be the number of the tool in the spindle (alarm otherwise).", "rule `length-offset-of-another-tool`, `length-agreement`", &[Rule { finding: "error[length-offset-of-another-tool]", violates: cut!("G43 H2 Z1.\n").with(&["settings.15=true"]), conforms: cut!("G43 H1 Z1.\n").with(&["settings.15=true"]) }]),
held("p. 376", "H00 is no alarm under Setting 15.", "rule `length-offset-of-another-tool`", &[Silent { rule: "length-offset-of-another-tool", program: cut!("G43 H0 Z1.\n").with(&["settings.15=true"]) }]),
held("p. 376", "With Setting 15 off nothing on the machine guards against the H of another tool.", "rule `length-offset-of-another-tool`, `offsets-of-tools`", &[Rule { finding: "warning[length-offset-of-another-tool]", violates: cut!("G43 H2 Z.1\nG1 Z-1. F10.\n"), conforms: cut!("G43 H1 Z.1\nG1 Z-1. F10.\n") }]),
held("p. 376", "With Setting 17 on M01 never stops.", "`optional-stop-lock`", &[Rule { finding: "warning[maybe-spindle-stopped-while-cutting]", violates: cut!("M1\nG1 Z-1. F10.\n").with(&["settings.17=false"]), conforms: cut!("M1\nG1 Z-1. F10.\n").with(&["settings.17=true"]) }]),
gap("p. 377", "With Setting 18 on blocks with / are always run.", "what holds only with block delete on is not said with `18 = true`", &[Silent { rule: "first-touch-missing", program: mill("O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nM59 P1134\nZ-.5\n/G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\nM69 P1134\nG0 G90 G53 Z0.\nM30\n").with(&["settings.18=true"]) }]),
gap("p. 377", "With Setting 18 off the operator's switch decides.", "what holds only with block delete on is `maybe` and names the switch; at present an error that is `always`", &[Rule { finding: "warning[maybe-first-touch-missing]", violates: mill("O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nM59 P1134\nZ-.5\n/G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\nM69 P1134\nG0 G90 G53 Z0.\nM30\n"), conforms: mill("O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nM59 P1134\nZ-.5\nG31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\nM69 P1134\nG0 G90 G53 Z0.\nM30\n") }]),
held("p. 378", "With Setting 29 on G91 holds for its own block only.", "`increments-of-block-setting`", &[Makes { program: cut!("X1.\nG91 X1.\nX3.\n").with(&["settings.29=true"]), block: "X3.", events: &["rapid X3"] }]),
held("p. 378", "With Setting 29 off G91 stays on.", "effect `incremental`", &[Makes { program: cut!("X1.\nG91 X1.\nX3.\nG90\n").with(&["settings.29=false"]), block: "X3.", events: &["rapid X5"] }]),
held("p. 378", "With Setting 32 at OFF a coolant code alarms.", "rule `coolant-locked`", &[Rule { finding: "error[coolant-locked]", violates: cut!("M8\n").with(&["settings.32=\"off\""]), conforms: cut!("M8\n").with(&["settings.32=\"normal\""]) }]),
held("p. 378", "With Setting 32 at IGNORE coolant codes are ignored.", "`coolant-setting`", &[Makes { program: cut!("M9\nM8\n").with(&["settings.32=\"ignore\""]), block: "M8", events: &[] }]),
not_modelled("p. 379", "With Setting 36 on a start in the middle works through the program first; it alarms inside cutter compensation.", "where the operator starts is not in the program; `tool-section-not-restart-safe` judges each tool section on its own"),
held("p. 380", "With Setting 42 on the program stops after each tool change; nothing else changes.", "no effect", &[Same { one: short!("T2 M6\nG43 H2 Z1.\nM30\n").with(&["settings.42=true"]), other: short!("T2 M6\nG43 H2 Z1.\nM30\n") }]),
held("p. 382", "With Setting 56 on M30 brings all modal codes back to their defaults.", "`at-end`", &[Silent { rule: "incremental-left-on", program: short!("G91 X1.\nM30\n").with(&["settings.56=true"]) }, Legal { program: short!("G91 X1.\nG18\nM30\n").with(&["settings.56=true"]) }]),
gap("p. 382", "With Setting 56 off modal codes outlive M30.", "G91, G18, G19, G93, G95 (and a canned cycle) in effect at M30 with `56 = false`: warning; silent so far", &[Rule { finding: "warning[incremental-left-on]", violates: short!("G91 X1.\nM30\n").with(&["settings.56=false"]), conforms: short!("G91 X1.\nG90\nM30\n").with(&["settings.56=false"]) }, Rule { finding: "warning[arc-mode-left-on]", violates: short!("G1 X1. F10.\nG2 X2. Y1. R1.\nM30\n").with(&["settings.56=false"]), conforms: short!("G1 X1. F10.\nG2 X2. Y1. R1.\nG0 X3.\nM30\n").with(&["settings.56=false"]) }]),
held("p. 385", "An F without point counts 0.0001 inch or 0.001 mm a minute with Setting 77 at DEFAULT: F10 is 0.001 or 0.01.", "setting 77", &[Makes { program: cut!("G1 X1. F10\n"), block: "G1 X1. F10", events: &["feed X1 F0.001"] }, Makes { program: mill("O1 (A)\nG21 G90 G54 G0 X0.\nG1 X10. F10\nM30\n"), block: "G1 X10. F10", events: &["feed X10 F0.01"] }, Rule { finding: "warning[missing-decimal-point]", violates: cut!("G1 X1. F10\n"), conforms: cut!("G1 X1. F10.\n") }]),
held("p. 385", "With Setting 77 at INTEGER F10 is F10.: no point is missed.", "setting 77", &[Silent { rule: "missing-decimal-point", program: cut!("G1 X1. F10\n").with(&["settings.77=\"integer\""]) }]),
held("p. 385", "F10 is F10. at INTEGER, F1. at .1, F.1 at .01, F.01 at .001 and F.001 at .0001.", "`scale-setting` of `F`", &[Makes { program: cut!("G1 X1. F10\n").with(&["settings.77=\"integer\""]), block: "G1 X1. F10", events: &["feed X1 F10 T6"] }, Makes { program: cut!("G1 X1. F10\n").with(&["settings.77=\".1\""]), block: "G1 X1. F10", events: &["feed X1 F1"] }, Makes { program: cut!("G1 X1. F10\n").with(&["settings.77=\".01\""]), block: "G1 X1. F10", events: &["feed X1 F0.1"] }, Makes { program: cut!("G1 X1. F10\n").with(&["settings.77=\".001\""]), block: "G1 X1. F10", events: &["feed X1 F0.01"] }, Makes { program: cut!("G1 X1. F10\n").with(&["settings.77=\".0001\""]), block: "G1 X1. F10", events: &["feed X1 F0.001"] }]),
not_modelled("p. 380, p. 385, p. 386, p. 388", "Settings 39, 81, 83, 87 and 88 beep, load a tool at power-up, and reset overrides.", "overrides, sounds and the tool at power-up are the operator's"),
held("p. 388", "With Setting 86 on M39 is ignored.", "effect `turn-carousel`", &[Silent { rule: "tool-called-not-changed", program: cut!("T3\nM39\n").with(&["settings.86=true"]) }]),
not_modelled("p. 391", "Setting 118 counts an M99 of the main program as a part.", "counters of the control"),
not_modelled("p. 391", "With Settings 119 and 120 on offsets and variables cannot be changed by hand; G10 and macros still change them.", "keys of the operator; programs are not affected, which G10 and assignments show elsewhere"),
not_modelled("p. 391", "With Setting 131 on M80 and M81 and the end of a program move the door.", "doors are not part of a path"),
not_modelled("p. 392", "Setting 144 couples the feed override to the spindle.", "overrides are the operator's"),
held("p. 393", "With Setting 162 off a number without point counts least increments: X-2 is -0.0002 inch or -0.002 mm.", "setting 162", &[Makes { program: cut!("X-2\n"), block: "X-2", events: &["rapid X-0.0002"] }, Makes { program: mill("O1 (A)\nG21 G90 G54 G0 X0.\nX-2\nM30\n"), block: "X-2", events: &["rapid X-0.002"] }, Rule { finding: "warning[missing-decimal-point]", violates: cut!("X-2\n"), conforms: cut!("X-2.\n") }]),
held("p. 393", "With Setting 162 on it counts whole units for X, Y, Z, A, B, C, E, I, J, K, U and W.", "setting 162", &[Makes { program: cut!("X-2\n").with(&["settings.162=true"]), block: "X-2", events: &["rapid X-2"] }, Makes { program: cut!("A1\n").with(&["settings.162=true"]), block: "A1", events: &["rapid A1"] }, Makes { program: cut!("G2 X2. I1 J0 F10.\n").with(&["settings.162=true"]), block: "G2 X2. I1 J0 F10.", events: &["arc X2 S-180"] }, Silent { rule: "missing-decimal-point", program: cut!("X-2\n").with(&["settings.162=true"]) }]),
held("p. 393", "Setting 162 does not touch F.", "`scale-setting` of `F`", &[Makes { program: cut!("G1 X1. F10\n").with(&["settings.162=true"]), block: "G1 X1. F10", events: &["feed X1 F0.001"] }]),
held("p. 393", "R and Q are not among them: their points are still needed.", "setting 162", &[Rule { finding: "warning[missing-decimal-point]", violates: cut!("G83 Z-.5 R.1 Q1 F5.\n").with(&["settings.162=true"]), conforms: cut!("G83 Z-.5 R.1 Q.1 F5.\n").with(&["settings.162=true"]) }, Rule { finding: "warning[missing-decimal-point]", violates: cut!("G2 X1. Y1. R1 F10.\n").with(&["settings.162=true"]), conforms: cut!("G2 X1. Y1. R1. F10.\n").with(&["settings.162=true"]) }]),
held("p. 393", "So with Setting 162 on R1 and Q1 still count least increments.", "`scale-setting` of `R` and `Q`", &[Makes { program: cut!("G0 Z2.\nG83 G99 Z-.5 R1 Q.6 F5.\n").with(&["settings.162=true"]), block: "G83 G99 Z-.5 R1 Q.6 F5.", events: &["rapid Z0.0001", "feed Z-0.5", "rapid Z0.0001"] }]),
not_modelled("p. 401, p. 402", "Settings 261 to 263 say where DPRNT writes, or that it does not.", "no output of a program changes its path"),
held("p. 398 to 400", "#20000 and the number of a setting reads that setting: #20255 is Setting 255.", "`setting-variables`", &[Run { program: short!("#1=#20022\nX#1\nM30\n").with(&["settings.22=0.05"]), prints: &["rapid 0.0500"] }]),
not_modelled("p. 403 to 405", "Settings 268 to 273 are the second home positions.", "a key goes there, and no code of the mill does"),
not_modelled("p. 405, p. 406", "Settings 276 and 292 keep the spindle from starting with an open clamp, and slow it with an open door.", "inputs of the machine are not part of a program"),
held("p. 411, p. 412", "Settings 310 to 318 narrow the travel of axes.", "`machine.travel`", &[Rule { finding: "error[move-outside-travel]", violates: cut!("G0 X2.\n").with(&["machine.travel.X=[-5.0,0.0]", "offsets.G54={X=-1.0,Y=0.0,Z=0.0}"]), conforms: cut!("G0 X1.\n").with(&["machine.travel.X=[-5.0,0.0]", "offsets.G54={X=-1.0,Y=0.0,Z=0.0}"]) }]),
held("p. 414", "Setting 335 makes rapids straight or not; the time of a program stays the same.", "times of rapid moves", &[Same { one: cut!("G0 X1. Y2.\n").with(&["settings.335=\"linear (xyz)\""]), other: cut!("G0 X1. Y2.\n") }]),
] };

#[test]
fn holds() {
    prove(&CHAPTER);
}
