//! The example programs of the LinuxCNC documentation, compared with the installed interpreter.
//!
//! Knows: where each program is, what is around a snippet to make it a program, verdicts on findings, where the two sides
//! differ. Must not know: how anything is checked or executed. Left out: prototypes with words that stand for numbers, and
//! examples without anything to execute.

use std::collections::HashMap;
use std::path::PathBuf;

use gcheck_testkit::skips::skip;
use gcheck_tests::canonical::{End, compare};

use super::example::{Expected, Finding, Tally, Verdict};
use super::haas_manual::hash;
use crate::interpreter;
use crate::proof::on;

/// The documents below the folder that `GCHECK_MANUALS` names, each with the hash of its text: every line below was found in it.
const DOCUMENTS: &[(&str, u64)] = &[
    ("coordinates", 0xdb8d_2105_f668_bd21),
    ("g-code", 0x681f_aabb_538c_2237),
    ("m-code", 0x2f68_a624_07d6_48f4),
    ("o-code", 0xa0c8_ff6a_a49a_cf4d),
    ("overview", 0xc471_b73c_28a6_9ddb),
    ("user-concepts", 0xac7f_3956_b6d6_783e),
];

/// A program of the documentation.
struct Example {
    /// Document and line at which it begins, from 1.
    at: (&'static str, usize),
    lines: usize,
    /// Hash of these lines.
    hash: u64,
    /// In our words.
    what: &'static str,
    /// Ours, in front of the snippet and after it.
    around: [&'static str; 2],
    findings: &'static [Finding],
    both: Both,
}

/// What the interpreter and `gcheck run` make of a program.
enum Both {
    /// The same functions, and both come to its end.
    End,
    /// Both refuse it at the same block, the interpreter with these words.
    Refuse(&'static str),
    /// They differ, for a reason that is known: turns the test red when they do not any more.
    Differ(&'static str),
}

#[test]
fn every_example_runs_as_in_the_interpreter() {
    let documents = match read() {
        Ok(documents) => documents,
        Err(why) => return skip("every_example_runs_as_in_the_interpreter", "manuals", &why),
    };
    let mut tally = Tally::default();
    let mut failures = Vec::new();
    for example in EXAMPLES {
        let (document, line) = example.at;
        let name = format!("{document}.adoc, line {line}, {}", example.what);
        let lines = documents[document].lines().skip(line - 1).take(example.lines);
        let theirs: String = lines.map(|line| format!("{line}\n")).collect();
        assert_eq!(hash(&theirs), example.hash, "{name}: other lines than those that were read");
        let [before, after] = example.around;
        let program = on("linuxcnc", Box::leak(format!("{before}{theirs}{after}").into_boxed_str()));
        let expected = Expected { findings: example.findings, shows: &[], not_yet: &[] };
        tally.add(&name, &program, &expected);
        let (ours, Some(reference)) = interpreter::both(&program) else { continue };
        let difference = compare(&reference, &ours).map(|difference| difference.text);
        let ended = reference.end == End::Ended;
        match (&example.both, difference) {
            (Both::End, None) if ended => {}
            (Both::Refuse(words), None) if matches!(&reference.end, End::Refused(why) if why.contains(words)) =>
                {}
            (Both::Differ(_), Some(_)) => {}
            (Both::Differ(why), None) => failures.push(format!("{name}: they agree, so this goes: {why}")),
            (_, difference) => {
                failures.push(format!("{name}: {difference:?}; the interpreter: {:?}", reference.end));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    tally.close("LinuxCNC documentation");
}

/// The documents by name, or why they are not there: the test is skipped then.
fn read() -> Result<HashMap<&'static str, String>, String> {
    let folder = std::env::var_os("GCHECK_MANUALS").ok_or("GCHECK_MANUALS names no folder")?;
    let folder = PathBuf::from(folder).join("linuxcnc");
    DOCUMENTS
        .iter()
        .map(|&(name, known)| {
            let path = folder.join(format!("{name}.adoc"));
            let text =
                std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
            if hash(&text) != known {
                return Err(format!("{} is not the text whose programs are known", path.display()));
            }
            Ok((name, text))
        })
        .collect()
}

const EXAMPLES: &[Example] = &[
    Example {
        at: ("coordinates", 44),
        lines: 1,
        hash: 0xf476_130d_cb22_4004,
        what: "a move in machine coordinates",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("coordinates", 125),
        lines: 11,
        hash: 0x2730_f4bb_aceb_b888,
        what: "a square in another system",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("coordinates", 406),
        lines: 6,
        hash: 0xe5e6_9c54_c6a7_17af,
        what: "a circle",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("coordinates", 419),
        lines: 4,
        hash: 0x3bf6_1325_534c_710b,
        what: "four systems set",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("coordinates", 429),
        lines: 34,
        hash: 0xc0e8_b5b6_c13d_0604,
        what: "five circles in a diamond",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 143),
        lines: 3,
        hash: 0x2908_43a3_1c28_198f,
        what: "a rapid move",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 191),
        lines: 5,
        hash: 0x88b0_0b2c_2e6c_8723,
        what: "straight moves at two feeds",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 390),
        lines: 2,
        hash: 0x10e8_f8c4_a8e6_3b92,
        what: "an arc by its centre",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 406),
        lines: 3,
        hash: 0xd4d7_c494_0431_07f8,
        what: "arcs there and back",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 420),
        lines: 2,
        hash: 0x31dc_c8e8_d28d_58dd,
        what: "a helix",
        around: ["F10\n", "M2\n"],
        findings: &[Finding(
            "warning[arc-end-off-circle] 3",
            Verdict::True,
            "the end is 8.9 mm off the circle that I and J name: the interpreter refuses it",
        )],
        both: Both::Refuse("Radius to end of arc differs"),
    },
    Example {
        at: ("g-code", 430),
        lines: 2,
        hash: 0x54ae_02b8_b812_f110,
        what: "a helix of two turns",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 499),
        lines: 1,
        hash: 0x3723_5226_46d2_4da8,
        what: "an arc by its radius",
        around: ["F10 G0 X0 Y0 Z0\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 526),
        lines: 1,
        hash: 0x65e4_79ad_3140_023d,
        what: "a dwell",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 561),
        lines: 3,
        hash: 0xf4de_5b0a_9f5a_8afe,
        what: "a cubic spline",
        around: ["F10\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 604),
        lines: 3,
        hash: 0x322a_03d1_000e_3808,
        what: "a quadratic spline",
        around: ["F10\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 643),
        lines: 14,
        hash: 0x131d_7090_5c5f_3e0a,
        what: "a NURBS block",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 734),
        lines: 2,
        hash: 0xfd53_e006_c277_c49d,
        what: "tool offsets set",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 816),
        lines: 1,
        hash: 0x5500_59d9_e38d_27cd,
        what: "a coordinate system set",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 827),
        lines: 1,
        hash: 0x07c6_07cc_9f69_8bab,
        what: "a coordinate system cleared",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 860),
        lines: 4,
        hash: 0x8b83_f5df_3af5_77e2,
        what: "a length set from the present place",
        around: ["", ""],
        findings: &[],
        both: Both::Differ(
            "without a machine the interpreter reads the position back after the tool change and loses the length's shift",
        ),
    },
    Example {
        at: ("g-code", 929),
        lines: 1,
        hash: 0x6217_54bb_45fc_f723,
        what: "a coordinate system set from the present place",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 993),
        lines: 1,
        hash: 0x9c7e_2977_8a3f_e072,
        what: "home by a point",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1032),
        lines: 1,
        hash: 0x726e_8d36_9405_cf6a,
        what: "the second home by a point",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1097),
        lines: 7,
        hash: 0x6c2a_e15d_b8fb_fe41,
        what: "a thread",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1172),
        lines: 5,
        hash: 0x222f_f9db_422b_90b1,
        what: "rigid tapping",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1273),
        lines: 5,
        hash: 0x2806_65b1_b291_36a4,
        what: "a length probed",
        around: ["T1 M6 G43\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1292),
        lines: 2,
        hash: 0x5a3c_d2c2_d31b_5dd1,
        what: "a place probed, in machine coordinates",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1332),
        lines: 4,
        hash: 0x9ad6_929b_c543_36b6,
        what: "compensation ended by a long move",
        around: ["G20 F10 T1 M6\nG0 X-5 Y-3\nG41 G1 X-2 Y0\nX1\n", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1462),
        lines: 1,
        hash: 0x6efa_f19c_f471_21c3,
        what: "a length",
        around: ["T1 M6\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1488),
        lines: 4,
        hash: 0xebd7_0b78_8065_a2f8,
        what: "a length given",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1520),
        lines: 5,
        hash: 0x08d9_08e3_afd7_6599,
        what: "a length added by number",
        around: ["", ""],
        findings: &[],
        both: Both::Refuse("Requested tool 10 not found"),
    },
    Example {
        at: ("g-code", 1530),
        lines: 5,
        hash: 0xe4cd_bf04_2cf9_5960,
        what: "a length added",
        around: ["", ""],
        findings: &[],
        both: Both::Refuse("Requested tool -1 not found"),
    },
    Example {
        at: ("g-code", 1592),
        lines: 2,
        hash: 0x659b_4f40_6ef6_4954,
        what: "machine coordinates twice",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1743),
        lines: 1,
        hash: 0xb8e2_61b0_db85_d7fe,
        what: "a tolerance",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1751),
        lines: 1,
        hash: 0x832c_7e18_29fd_5279,
        what: "the default tolerance",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1760),
        lines: 1,
        hash: 0xddb6_e2eb_e605_08b3,
        what: "a tolerance and a coarse one",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 1771),
        lines: 1,
        hash: 0xddc4_8aeb_e610_b087,
        what: "a tolerance and a finer one",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2067),
        lines: 2,
        hash: 0x97ca_406e_8d74_6d24,
        what: "a thread in passes",
        around: ["S500 M3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2208),
        lines: 8,
        hash: 0x26fb_1ea6_f258_7866,
        what: "eight holes by increments",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2233),
        lines: 11,
        hash: 0x9277_5d97_4cb8_bfb2,
        what: "twelve holes by increments",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2266),
        lines: 3,
        hash: 0x4e83_0360_b3f3_fb91,
        what: "a cycle ended by G80",
        around: ["F10 S500 M3 G0 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2277),
        lines: 2,
        hash: 0xdde5_aa39_b50f_074a,
        what: "a cycle ended by a move",
        around: ["F10 S500 M3 G0 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2294),
        lines: 15,
        hash: 0xfd4d_fbc5_36ec_f645,
        what: "eight holes by positions",
        around: ["F10 S500 M3\n", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2347),
        lines: 1,
        hash: 0x4a63_e088_120f_4171,
        what: "a hole by a position",
        around: ["F10 S500 M3 G0 X1 Y2 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2374),
        lines: 1,
        hash: 0xab42_a497_d6c5_19fb,
        what: "three holes by increments",
        around: ["F10 S500 M3 G0 X1 Y2 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2416),
        lines: 1,
        hash: 0x4a63_e088_120f_4171,
        what: "a hole, back to the start",
        around: ["F10 S500 M3 G0 X1 Y2 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2435),
        lines: 1,
        hash: 0xab42_a497_d6c5_19fb,
        what: "three holes, back to the start",
        around: ["F10 S500 M3 G0 X1 Y2 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2449),
        lines: 1,
        hash: 0xd4ba_d34d_335f_472b,
        what: "a deep hole, back to the start",
        around: ["F10 S500 M3 G0 X1 Y2 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2482),
        lines: 1,
        hash: 0x3e6a_5694_e7e7_3dd8,
        what: "a hole with a dwell",
        around: ["F10 S500 M3 G0 X1 Y2 Z3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2643),
        lines: 2,
        hash: 0x9c30_40cb_4d84_edda,
        what: "a position",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2650),
        lines: 2,
        hash: 0xff50_0d5a_3407_c06f,
        what: "a distance",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2805),
        lines: 1,
        hash: 0x8503_d92a_077c_046a,
        what: "a surface speed with its limit",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("g-code", 2832),
        lines: 2,
        hash: 0x9bc6_cc29_28f5_f7e4,
        what: "a cycle's return",
        around: ["S500 M3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("m-code", 117),
        lines: 4,
        hash: 0x9bde_3300_3c1b_1159,
        what: "three spindles",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::Refuse("Invalid spindle ($) number"),
    },
    Example {
        at: ("m-code", 424),
        lines: 1,
        hash: 0x1b39_cd2c_69f7_fd63,
        what: "a wait for an input",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("m-code", 590),
        lines: 29,
        hash: 0x816a_f15c_4488_3463,
        what: "modes saved by the caller",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("m-code", 643),
        lines: 28,
        hash: 0xd8da_15e4_f2df_91a7,
        what: "modes saved by the subroutine",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("m-code", 694),
        lines: 15,
        hash: 0x4e09_ecf2_8c68_7d14,
        what: "modes restored by hand",
        around: ["", "o<measure> call\nM2\n"],
        findings: &[],
        both: Both::Refuse("Start point too close"),
    },
    Example {
        at: ("o-code", 42),
        lines: 11,
        hash: 0x13a1_ed60_9c57_fb2b,
        what: "a condition in a subroutine",
        around: ["", "o100 call [1] [6]\nM2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 99),
        lines: 7,
        hash: 0xacbf_0dbe_54f9_b40a,
        what: "a subroutine called",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 117),
        lines: 9,
        hash: 0x7a00_2026_44dc_d6d6,
        what: "a subroutine left early",
        around: ["", "o100 call [1] [1]\nM2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 143),
        lines: 12,
        hash: 0xc052_837c_bc16_4315,
        what: "a subroutine with arguments",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 164),
        lines: 5,
        hash: 0x88fb_88e3_a62b_1443,
        what: "a subroutine in another: invalid",
        around: ["", "M2\n"],
        findings: &[
            Finding("info[checked-past-alarm] 1", Verdict::True, "the check goes on past it"),
            Finding("error[subroutine-inside-subroutine] 2", Verdict::True, "the text calls it invalid"),
        ],
        both: Both::Refuse("Nested subroutine definition"),
    },
    Example {
        at: ("o-code", 213),
        lines: 7,
        hash: 0x5637_94a2_9797_2be2,
        what: "a numbered program",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 274),
        lines: 17,
        hash: 0xf380_b484_4b37_1fc0,
        what: "a numbered program that calls another",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 313),
        lines: 10,
        hash: 0x9481_2d54_064c_c015,
        what: "a loop",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 328),
        lines: 13,
        hash: 0x0f10_39b3_d9ca_4f82,
        what: "a loop with its test at the end",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 368),
        lines: 4,
        hash: 0x4a8f_dac8_5ae1_d40e,
        what: "one condition",
        around: ["#31=3\n", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("o-code", 377),
        lines: 10,
        hash: 0xc10c_0f42_1540_788f,
        what: "three cases",
        around: ["#2=6\n", "M2\n"],
        findings: &[Finding("hint[unreachable-block] 7", Verdict::True, "our own value decides")],
        both: Both::End,
    },
    Example {
        at: ("o-code", 395),
        lines: 10,
        hash: 0x8428_20d3_5450_d6d3,
        what: "three cases again",
        around: ["#2=1\n", "M2\n"],
        findings: &[
            Finding("hint[unreachable-block] 4", Verdict::True, "our own value decides"),
            Finding("hint[unreachable-block] 10", Verdict::True, "our own value decides"),
        ],
        both: Both::End,
    },
    Example {
        at: ("o-code", 477),
        lines: 5,
        hash: 0xe41f_d0c1_7518_01dd,
        what: "a file of one subroutine",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("overview", 646),
        lines: 5,
        hash: 0x8dc4_8cca_a5ac_b900,
        what: "is a value of the machine file there?",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::Differ(
            "whether the value is there depends on the machine file, which gcheck is not given",
        ),
    },
    Example {
        at: ("overview", 672),
        lines: 1,
        hash: 0x1211_723d_7825_c74c,
        what: "the value of a pin",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("overview", 682),
        lines: 5,
        hash: 0x3193_3f36_f6ec_bbfc,
        what: "is a pin there?",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::Differ(
            "whether the value is there depends on the machine file, which gcheck is not given",
        ),
    },
    Example {
        at: ("overview", 799),
        lines: 12,
        hash: 0x5ee0_2abc_2afd_0934,
        what: "is a parameter there?",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("overview", 905),
        lines: 6,
        hash: 0x93a6_9093_b1f1_3aac,
        what: "polar moves",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("overview", 925),
        lines: 6,
        hash: 0x2ae1_7c63_8ecc_9cc4,
        what: "polar moves by angles",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("overview", 1036),
        lines: 3,
        hash: 0x5857_f67c_822a_3efd,
        what: "comments",
        around: ["", ""],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("overview", 1268),
        lines: 1,
        hash: 0xeea6_7c83_eb0b_f1e7,
        what: "a preamble",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
    Example {
        at: ("user-concepts", 26),
        lines: 1,
        hash: 0x7d9e_4325_485d_1e59,
        what: "a line",
        around: ["", "M2\n"],
        findings: &[],
        both: Both::End,
    },
];
