//! How often the control of a real program is guessed right.
//!
//! Knows: the corpus (`GCHECK_CORPUS`) and the control that its index names for each program, by origin. Must not know: any
//! hint. What is counted is the machine and the family, as a newcomer meets it: no configuration, no comment for gcheck.

use std::collections::BTreeMap;
use std::fs;

use gcheck_testkit::corpus;

/// Origins and programs whose control the index names wrongly.
const MISLABELLED: &[(&str, &str)] = &[
    ("Michael-F-Bryan__gcode-rs/tests/data/", "samples of every dialect, for a parser"),
    ("winder__Universal-G-Code-Sender/test_files/comments.gcode", "comments for a test, no program"),
    (
        "winder__Universal-G-Code-Sender/ugs-core/test/resources/gcode/fixtures/comments/",
        "comments for a test, no program",
    ),
    ("GCodeProjects__GCodeWorkShop/examples/TOKARKA.NC", "a lathe with `G90`, `G95` and `G92 S`"),
];

/// Of a hundred programs of controls that gcheck has, so many may be taken for another control.
const WRONG_PERCENT: usize = 1;

#[test]
fn real_programs_are_taken_for_their_control_or_for_none() {
    let Some(programs) = corpus::programs() else { return };
    let known: Vec<String> = gcheck_controls::names().iter().map(ToString::to_string).collect();
    let mut counts: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    let is_told = |name: &str| !MISLABELLED.iter().any(|(start, _)| name.starts_with(start));
    for program in programs {
        if !known.contains(&program.control) || !is_told(&program.name) {
            continue;
        }
        let bytes = fs::read(&program.path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let evidence = gcheck_program::collect_evidence(&text);
        // A file of a dialect that nobody reads is told, whatever else speaks for a control.
        if evidence.unsupported.is_some() {
            continue;
        }
        let guess = gcheck_controls::guess(&evidence);
        let guess = guess.map_or_else(|| "unknown".to_owned(), |guess| guess.control);
        counts.entry((program.control, guess)).or_default().push(program.name);
    }
    let all: usize = counts.values().map(Vec::len).sum();
    let mut wrong = 0;
    for ((truth, guess), programs) in &counts {
        println!("{truth} taken for {guess}: {}", programs.len());
        if guess != truth && guess != "unknown" {
            wrong += programs.len();
            for name in programs {
                println!("    {name}");
            }
        }
    }
    println!("{wrong} of {all} wrong");
    assert!(wrong * 100 <= all * WRONG_PERCENT, "{wrong} of {all} programs are taken for another control");
}

fn guess(program: &str) -> Option<String> {
    gcheck_controls::guess(&gcheck_program::collect_evidence(program)).map(|guess| guess.control)
}

#[test]
fn headers_of_senders_and_lines_for_the_firmware_speak_for_their_control() {
    for program in [
        "; LightBurn 1.4.00\n; GRBL device profile, absolute coords\nG00 G17 G40 G21 G54\nG90\nM4\n",
        "(Carbide Create 7)\nG90\nG21\nM3 S12000\nG0 X1 Y1\n",
        "(posted for grbl 1.1)\nG21 G90\nG0 X1\n",
        "$H\nG21 G90\nG0 X1\nG38.2 Z-10 F50\n",
        "$110=500\nG0 X1\n",
    ] {
        assert_eq!(guess(program).as_deref(), Some("grbl"), "{program}");
    }
    for program in [
        "G21 G90\nG0 X1\n",
        "; LightBurn 1.4.00\n; Marlin device profile\nG0 X1\n",
        "(for grblHAL)\nG81 X1 Z-1 R1 F100\n",
        "(FluidNC, grbl)\nT1 M6\n",
        "(carbide end mill)\nO1\nT1 M6\nG43 H1\n",
        "$1 S100 M3\n",
    ] {
        assert_ne!(guess(program).as_deref(), Some("grbl"), "{program}");
    }
}

#[test]
fn a_lathe_is_of_another_system_of_codes_only_where_that_is_decisive() {
    let body = "T0101\nG96 S180 M3\nG0 X60. Z5.\nG1 X58. Z0.\nX56. Z-1.\nX54. Z-2.\n";
    for (head, control) in [
        ("O1\nG21 G99\nG50 S2500\n", "fanuc-lathe"),
        ("O1\nG21\n", "fanuc-lathe"),
        ("O1\nG21 G90 G95\nG92 S2500\n", "fanuc-lathe-b"),
        ("O1\nG71\nG90 G95\nG92 S2500\n", "fanuc-lathe-c"),
        ("O1\nG90 G95\nG50 S2500\n", "fanuc-lathe"),
    ] {
        assert_eq!(guess(&format!("{head}{body}")).as_deref(), Some(control), "{head}");
    }
}
