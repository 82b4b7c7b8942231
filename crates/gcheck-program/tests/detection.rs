//! How often the control of a real program is guessed right.
//!
//! Knows: the corpus (`GCHECK_CORPUS`) and the control that its index names for each program, by origin. Must not know: any
//! hint. What is counted is the machine and the family, as a newcomer meets it: no configuration, no comment for gcheck.

use std::collections::BTreeMap;
use std::fs;

use gcheck_testkit::corpus;

/// Of a hundred programs of controls that gcheck has, so many may be taken for another control.
const WRONG_PERCENT: usize = 1;

#[test]
fn real_programs_are_taken_for_their_control_or_for_none() {
    let Some(programs) = corpus::programs() else { return };
    let known: Vec<String> = gcheck_controls::names().iter().map(ToString::to_string).collect();
    let mut counts: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    for program in programs.into_iter().filter(|program| known.contains(&program.control)) {
        let bytes = fs::read(&program.path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let guess = gcheck_controls::guess(&gcheck_program::collect_evidence(&text));
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
