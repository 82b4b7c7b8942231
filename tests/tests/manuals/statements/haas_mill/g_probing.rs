//! G31, G35, G36, G37 and G136 (p. 264 to 270, 308, 309), with M75, M78 and M79 (p. 355, 356): the sentences of these
//! pages and what proves them.
//!
//! Left out: wiring and calibration of probes.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked.

use super::mill::{gap, held, mill, not_modelled};
use crate::proof::Proof::{Assumes, Legal, Makes, Rule, Run, Stands};
use crate::statements::statement::{Chapter, prove};

/// Tool 1 as the operator has measured it.
const TOOL: &str = "tools.1={length=4.0,diameter=0.5}";

/// Where the part lies.
const G54: &str = "offsets.G54={X=-10.0,Y=-5.0,Z=-8.0}";

/// Blocks of a spindle probe, with its length on.
macro_rules! touching {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nM59 P1134\nG43 H1 Z1.\n",
            $blocks,
            "M69 P1134\nG0 G90 G53 Z0.\nM30\n"
        ))
    };
}

/// Blocks of a cutter that turns beside the tool probe.
macro_rules! beside_tool_probe {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G59 X0. Y-1.\nM59 P1133\nG4 P1.\nM59 P1134\nG43 H1 Z1.\nS200 M4\nG1 Z-.25 F50.\n",
            $blocks,
            "M69 P1134\nG0 G90 G53 Z0.\nM30\n"
        ))
    };
}

/// Blocks of a spindle probe beside the part, without its length.
macro_rules! measuring {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y0.\nM59 P1134\nZ-.5\n",
            $blocks,
            "M69 P1134\nG0 G90 G53 Z0.\nM30\n"
        ))
    };
}

/// Blocks of a tool over the tool probe, with its length on.
macro_rules! tool_probe {
    ($blocks:literal) => {
        mill(concat!(
            "O1 (A)\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G59 X0. Y0.\nG43 H1 Z5.\nM59 P1133\nG4 P1.\nM59 P1134\n",
            $blocks,
            "M69 P1134\nG0 G90 G53 Z0.\nM30\n"
        ))
    };
}

pub(crate) const CHAPTER: Chapter = Chapter { title: "G codes: probing", key: "PRB", file: "haas_mill/g_probing.rs", statements: &[
held("p. 264", "G31 moves at feed to its point or until the probe touches; the program goes on either way.", "effect `skip`", &[Makes { program: touching!("G31 Z-.25 F50.\nG0 Z1.\n"), block: "G31 Z-.25 F50.", events: &["probe Z-0.25 F50"] }, Legal { program: touching!("G31 Z-.25 F50.\nG0 Z1.\n") }]),
held("p. 264", "After G31 the axes stand at the touch, wherever that was.", "effect `skip`", &[Run { program: touching!("G31 Z-.25 F50.\nG0 X1.\n").with(&["machine.rapid=1000.0"]), prints: &["probe 0.0000 0.0000 -0.2500", "rapid 1.0000 0.0000 ?"] }]),
held("p. 264", "G31 needs an axis.", "`one-of` of `G31`", &[Rule { finding: "error[word-choice-missing]", violates: touching!("G31 F50.\n"), conforms: touching!("G31 Z-.25 F50.\n") }]),
held("p. 264", "G31 without any feed alarms.", "need of `F`", &[Rule { finding: "error[required-word-missing]", violates: touching!("G31 Z-.25\n"), conforms: touching!("G31 Z-.25 F50.\n") }]),
gap("p. 264", "The block of G31 names its feed; an alarm comes where neither axis nor feed is given.", "with a feed in effect from earlier blocks a missing F on the G31 block is a warning (the probe moves at whatever feed that was), not an error; error stays where there is no feed at all", &[Rule { finding: "warning[required-word-missing]", violates: touching!("G1 Z.5 F20.\nG31 Z-.25\nG0 Z1.\n"), conforms: touching!("G1 Z.5 F20.\nG31 Z-.25 F20.\nG0 Z1.\n") }]),
held("p. 264", "The touch is in #5061 to #5066, by axis.", "`probe-position` of `system-variables`", &[Run { program: touching!("G31 Z-.25 F50.\n#100=#5063\nG0 Z#100\n"), prints: &["probe 0.0000 0.0000 -0.2500", "rapid 0.0000 0.0000 ?"] }, Assumes { program: touching!("G31 Z-.25 F50.\nIF [#5063 GT 0.] GOTO10\nG0 Z1.\nN10\n"), says: "probing moves touch, at unknown points" }]),
held("p. 264", "G31 acts in its own block.", "group `one-shot`", &[Run { program: touching!("G31 Z-.25 F50.\nZ1.\n"), prints: &["probe 0.0000 0.0000 -0.2500", "rapid 0.0000 0.0000 1.0000"] }]),
held("p. 264", "No cutter compensation while G31 probes.", "rule `probing-in-wrong-mode`", &[Rule { finding: "error[probing-in-wrong-mode]", violates: touching!("G41 D1 G1 X1. F10.\nG31 Z-.25 F10.\nG40 G1 X2.\n"), conforms: touching!("G1 X1. F10.\nG31 Z-.25 F10.\nG1 X2.\n") }]),
held("p. 264", "Probing feeds stay below F100 (inch) or F2500 (metric).", "`probe-feed` of `execution.toml`", &[Rule { finding: "warning[probe-feed-too-high]", violates: touching!("G31 Z-.25 F101.\n"), conforms: touching!("G31 Z-.25 F99.\n") }, Rule { finding: "warning[probe-feed-too-high]", violates: mill("O1 (A)\nG21 G90 G54 G0 X0. Y0.\nG43 H1 Z9.\nG31 Z-2. F2600.\nG0 Z9.\nM30\n"), conforms: mill("O1 (A)\nG21 G90 G54 G0 X0. Y0.\nG43 H1 Z9.\nG31 Z-2. F2400.\nG0 Z9.\nM30\n") }]),
not_modelled("p. 264 to 270", "The probe is switched on before it probes, by M59 P1134 or M59 P1133, and off by M69 P1134.", "the outputs belong to the standard probe; other probes have other codes (user relays, macros), so that a missing switch cannot be told from another probe"),
held("p. 266", "G35 sets the size offset D from two touches: a G31 with M75 first, then G35.", "rule `first-touch-missing`", &[Legal { program: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }, Rule { finding: "error[first-touch-missing]", violates: beside_tool_probe!("G35 Y.205 D1 F10.\nG1 Y1.\n"), conforms: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }]),
held("p. 266", "The D of G35 is not 0.", "range of `D`", &[Rule { finding: "error[number-out-of-range]", violates: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D0 F10.\nG1 Y1.\n"), conforms: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }]),
held("p. 265", "G35 needs F.", "need of `F`", &[Rule { finding: "error[required-word-missing]", violates: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1\nG1 Y1.\n"), conforms: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }]),
held("p. 266", "G35 moves to its point or until the touch.", "effect `probe-diameter`", &[Makes { program: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n"), block: "G35 Y.205 D1 F10.", events: &["probe Y0.205 F10"] }]),
held("p. 266", "After G35 the size of offset D is what was measured: a size configured for tool 1 does not hold.", "effect `probe-diameter`", &[Run { program: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1. F10.\nG0 Z1.\nG41 D1 G1 X1.\nG40 X2.\n").with(&[TOOL]), prints: &["feed ? ? 1.0000"] }]),
not_modelled("p. 266, p. 383", "Setting 63, the width of the tool probe, is taken off the distance of the touches.", "the size that a probe measures is unknown beforehand, with or without the correction"),
held("p. 266", "No cutter compensation with G35; feed below F100 or F2500.", "rules `probing-in-wrong-mode`, `probe-feed-too-high`", &[Rule { finding: "error[probing-in-wrong-mode]", violates: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG41 D1 G1 X1. F10.\nG35 Y.205 D1 F10.\nG40 G1 X2.\n"), conforms: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }, Rule { finding: "warning[probe-feed-too-high]", violates: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F101.\nG1 Y1.\n"), conforms: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }]),
held("p. 266", "The spindle turns backward (M04) while a right-handed cutter is measured.", "rule `spindle-turns-while-probing`", &[Legal { program: beside_tool_probe!("G31 Y-.25 F10. M75\nG1 Y-1. F25.\nZ.5\nY1.\nZ-.25\nG35 Y.205 D1 F10.\nG1 Y1.\n") }, Rule { finding: "warning[spindle-turns-while-probing]", violates: touching!("S200 M3\nG31 Z-.25 F10.\nM5\n"), conforms: touching!("G31 Z-.25 F10.\n") }]),
held("p. 267", "G36 moves until the touch and makes that point the zero of the active work offset on the axes it names.", "effect `probe-offset`", &[Makes { program: measuring!("G36 Y-.7 F10.\nG0 Z1.\n"), block: "G36 Y-.7 F10.", events: &["probe Y-0.7 F10"] }, Run { program: measuring!("G36 Y-.7 F10.\nG0 X1.\n").with(&[G54]), prints: &["probe 0.0000 -0.7000", "rapid 1.0000 ?"] }]),
held("p. 267", "After G36 the offset that it set is unknown, and that of other axes unchanged.", "effect `probe-offset`", &[Stands { program: measuring!("G36 Y-.7 F10.\nG0 X1.\n").with(&[G54]), after: "G0 X1.", at: "MX-9 MY?" }]),
held("p. 267", "G36 needs an axis.", "`one-of` of `G36`", &[Rule { finding: "error[word-choice-missing]", violates: measuring!("G36 F10.\nG0 Z1.\n"), conforms: measuring!("G36 Y-.7 F10.\nG0 Z1.\n") }]),
held("p. 267", "G36 needs F.", "need of `F`", &[Rule { finding: "error[required-word-missing]", violates: measuring!("G36 Y-.7\nG0 Z1.\n"), conforms: measuring!("G36 Y-.7 F10.\nG0 Z1.\n") }]),
held("p. 268", "I, J, K of G36 shift the offset of X, Y, Z off the touch.", "rule `shift-of-axis-not-probed`", &[Legal { program: measuring!("G91 G36 Y-.7 F10. J.1\nG0 Z1.\n") }, Rule { finding: "warning[shift-of-axis-not-probed]", violates: measuring!("G36 Y-.7 F10. I.1\nG0 Z1.\n"), conforms: measuring!("G36 Y-.7 F10. J.1\nG0 Z1.\n") }]),
held("p. 267, p. 268", "Neither cutter compensation nor tool length compensation (G43, G44) is in effect for G36.", "rule `probing-in-wrong-mode`", &[Rule { finding: "error[probing-in-wrong-mode]", violates: measuring!("G43 H1 Z1.\nG36 Y-.7 F10.\nG0 Z1.\n"), conforms: measuring!("G36 Y-.7 F10.\nG0 Z1.\n") }, Rule { finding: "error[probing-in-wrong-mode]", violates: measuring!("G44 H1 Z1.\nG36 Y-.7 F10.\nG0 Z1.\n"), conforms: measuring!("G36 Y-.7 F10.\nG0 Z1.\n") }, Rule { finding: "error[probing-in-wrong-mode]", violates: measuring!("G42 D1 G1 X1. F10.\nG36 Y-.7 F10.\nG40 G1 X3.\n"), conforms: measuring!("G36 Y-.7 F10.\nG0 Z1.\n") }]),
held("p. 268", "The feed of G36 stays below F100 or F2500.", "rule `probe-feed-too-high`", &[Rule { finding: "warning[probe-feed-too-high]", violates: measuring!("G36 Y-.7 F110.\nG0 Z1.\n"), conforms: measuring!("G36 Y-.7 F10.\nG0 Z1.\n") }]),
not_modelled("p. 268, p. 308, p. 383", "Points of G31, G36, G136 and M75 are corrected by Settings 59 to 62.", "what a probe measures is unknown beforehand, with or without the correction"),
held("p. 269", "G37 moves Z until the tool touches the probe.", "effect `probe-length`", &[Run { program: tool_probe!("G37 H1 Z0. F30.\n"), prints: &["probe 0.0000 0.0000 ?"] }]),
held("p. 269", "G37 sets the length offset H, so that a length known before is not known after it.", "effect `probe-length`", &[Stands { program: tool_probe!("G37 H1 Z0. F30.\nG0 Z1.\n").with(&["tools.1={length=4.0}", "offsets.G59={X=0.0,Y=0.0,Z=-10.0}"]), after: "G0 Z1.", at: "MZ?" }]),
held("p. 269", "Z of G37 is required; its value shifts the offset, 0 for none.", "need of `Z`", &[Rule { finding: "error[required-word-missing]", violates: tool_probe!("G37 H1 F30.\n"), conforms: tool_probe!("G37 H1 Z0. F30.\n") }, Legal { program: tool_probe!("G37 H1 Z.1 F30.\n") }]),
held("p. 269", "G37 needs F.", "need of `F`", &[Rule { finding: "error[required-word-missing]", violates: tool_probe!("G37 H1 Z0.\n"), conforms: tool_probe!("G37 H1 Z0. F30.\n") }]),
held("p. 269", "H of G37 is not 0.", "range of `H`", &[Rule { finding: "error[number-out-of-range]", violates: tool_probe!("G37 H0 Z0. F30.\n"), conforms: tool_probe!("G37 H1 Z0. F30.\n") }]),
held("p. 269", "G37 needs G43 or G44 in effect.", "rule `probing-in-wrong-mode`", &[Rule { finding: "error[probing-in-wrong-mode]", violates: tool_probe!("G49\nG37 H1 Z0. F30.\n"), conforms: tool_probe!("G37 H1 Z0. F30.\n") }]),
held("p. 269", "Work offset and H may be chosen in the block of G37 or before it.", "effects of the block", &[Legal { program: tool_probe!("G37 Z0. F30.\n") }, Legal { program: tool_probe!("G54\nG37 G59 H1 Z0. F30.\n") }]),
held("p. 269", "The feed of G37 stays below F100 or F2500.", "rule `probe-feed-too-high`", &[Rule { finding: "warning[probe-feed-too-high]", violates: tool_probe!("G37 H1 Z0. F130.\n"), conforms: tool_probe!("G37 H1 Z0. F30.\n") }]),
held("p. 308", "G136 sets the active work offset to the middle between the point kept by M75 and its own touch.", "rules `first-touch-missing`, `touches-do-not-meet`", &[Legal { program: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\n") }, Rule { finding: "error[first-touch-missing]", violates: measuring!("G91 G136 Y-.7 F10.\nG0 Z1.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\n") }, Rule { finding: "warning[touches-do-not-meet]", violates: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 X1. F10.\nG0 Z1.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\n") }]),
held("p. 308", "G136 sets the axes that it names, and no others.", "effect `probe-centre`", &[Stands { program: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG136 Y-1.2 F10.\nG0 X1.\n").with(&[G54]), after: "G0 X1.", at: "MX-9 MY?" }]),
held("p. 308", "No compensation of any kind (G41, G42, G43, G44) with G136.", "rule `probing-in-wrong-mode`", &[Rule { finding: "error[probing-in-wrong-mode]", violates: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG43 H1 Z.5\nG136 Y-1.2 F10.\nG0 X1.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG136 Y-1.2 F10.\nG0 X1.\n") }, Rule { finding: "error[probing-in-wrong-mode]", violates: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG41 D1 G1 X1. F10.\nG136 Y-1.2 F10.\nG40 G1 X3.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG136 Y-1.2 F10.\nG0 X1.\n") }]),
held("p. 308", "I, J, K of G136 shift the offset of X, Y, Z off the middle.", "rule `shift-of-axis-not-probed`", &[Legal { program: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10. J.1\nG0 Z1.\n") }, Rule { finding: "warning[shift-of-axis-not-probed]", violates: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10. I.1\nG0 Z1.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10. J.1\nG0 Z1.\n") }]),
held("p. 309", "The feed of G136 stays below F100 or F2500.", "rule `probe-feed-too-high`", &[Rule { finding: "warning[probe-feed-too-high]", violates: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG136 Y-1.2 F110.\nG0 X1.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG136 Y-1.2 F10.\nG0 X1.\n") }]),
held("p. 355", "M75 keeps the touch of a probing move: in its block or after it.", "rule `touch-code-without-probing`", &[Legal { program: measuring!("G31 Y-.7 F10.\nM75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\n") }, Rule { finding: "error[touch-code-without-probing]", violates: measuring!("M75\nG31 Y-.7 F10.\nG1 Y1. F20.\n"), conforms: measuring!("G31 Y-.7 F10. M75\nG1 Y-.5 F20.\nG0 Z1.\nY-2.\nZ-.5\nG91 G136 Y.9 F10.\nG0 Z1.\n") }]),
held("p. 355", "M78 alarms when the probe touched; it is in the block of the probing move or after it.", "effect `alarm-if-touched`, which a run takes as not touched", &[Legal { program: touching!("G31 Y-.7 F10. M78\n") }, Legal { program: touching!("G31 Y-.7 F10.\nM78\n") }, Rule { finding: "warning[touch-code-without-probing]", violates: touching!("M78\nG31 Y-.7 F10.\n"), conforms: touching!("G31 Y-.7 F10.\nM78\n") }]),
held("p. 356", "M79 alarms when the probe did not touch; it is in the block of the probing move or after it.", "effect `alarm-if-not-touched`, which a run takes as touched", &[Legal { program: touching!("G31 Y-.7 F10. M79\n") }, Legal { program: touching!("G31 Y-.7 F10.\nM79\n") }, Rule { finding: "warning[touch-code-without-probing]", violates: touching!("M79\nG31 Y-.7 F10.\n"), conforms: touching!("G31 Y-.7 F10.\nM79\n") }]),
] };

#[test]
fn holds() {
    prove(&CHAPTER);
}
