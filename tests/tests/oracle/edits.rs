//! Changes of programs by `gcheck edit`, as the reference executes them before and after.
//!
//! Knows: what each change claims of the canonical functions of a run. Must not know: how a change is made or proved.
//!
//! The reference begins at zero with the tools of a table, of which `gcheck edit` knows nothing, so that a change which rests
//! on either moves elsewhere here. A change that is refused says nothing; how many were made is asserted.

use std::env;
use std::fs;
use std::process::Command;

use gcheck_tests::canonical::{Call, End};

use crate::own::{Program, programs};
use crate::reference::{self, Reference};
use crate::report::{Failure, assert_none, on_each, wanted};
use crate::setup::Setup;

/// Numbers closer than this are the same: a word is written with four decimals at most.
const CLOSE: f64 = 2e-3;
/// One program in so many is tried with each change, unless a long run is asked for.
const SHARE: usize = 4;

/// What a change does to the functions of a run.
#[derive(Debug, Clone, Copy)]
enum Claim {
    /// X, Y and Z of every move are more by so much, from the first move on that gives them.
    Shifted([f64; 3]),
    /// The moves and the rest are as before, but for the way in which corners are taken between cycles.
    Same,
    /// Feeds of cuts are so many times what they were, but for those of taps, whose feed is that of the thread.
    Feeds(f64),
}

const CHANGES: [(&str, Claim); 5] = [
    ("translate --x 10 --y=-5", Claim::Shifted([10.0, -5.0, 0.0])),
    ("scale-feeds 0.5", Claim::Feeds(0.5)),
    ("absolute", Claim::Same),
    ("incremental", Claim::Same),
    ("expand-cycle", Claim::Same),
];

/// A move or a feed of a run.
#[derive(Debug, Clone, PartialEq)]
struct Step {
    name: String,
    numbers: Vec<f64>,
    feed: f64,
}

/// The moves of a run, each with the feed in effect. Moves that go nowhere are left out where they say nothing: a cycle makes
/// them and plain moves do not.
fn steps(calls: &[Call], claim: Claim) -> Vec<Step> {
    let keeps_all = matches!(claim, Claim::Shifted(_));
    let mut steps: Vec<Step> = Vec::new();
    let mut feed = 0.0;
    let mut at: Option<Vec<f64>> = None;
    for call in calls {
        let numbers = call.numbers();
        match call.name() {
            "SET_FEED_RATE" => feed = numbers.first().copied().unwrap_or(f64::NAN),
            "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" | "STRAIGHT_PROBE" => {
                let is_same = |old: &Vec<f64>| old.iter().zip(&numbers).all(|(a, b)| (a - b).abs() < 1e-9);
                if keeps_all || !at.as_ref().is_some_and(is_same) {
                    at = Some(numbers.clone());
                    steps.push(Step { name: call.name().to_owned(), numbers, feed });
                }
            }
            "ARC_FEED" | "NURBS_FEED" | "RIGID_TAP" => {
                at = None;
                steps.push(Step { name: call.name().to_owned(), numbers, feed });
            }
            _ => {}
        }
    }
    steps
}

/// Why two runs are not what the claim says; `None` where they are.
fn difference(before: &[Step], after: &[Step], claim: Claim) -> Option<String> {
    if before.len() != after.len() {
        return Some(format!("{} moves became {}", before.len(), after.len()));
    }
    let mut is_given = [false; 3];
    for (old, new) in before.iter().zip(after) {
        let told = || Some(format!("{old:?} became {new:?}"));
        if old.name != new.name || old.numbers.len() != new.numbers.len() {
            return told();
        }
        let feed = match claim {
            Claim::Feeds(factor) => old.feed * factor,
            _ => old.feed,
        };
        let is_cut = matches!(old.name.as_str(), "STRAIGHT_FEED" | "ARC_FEED");
        if is_cut && (feed - new.feed).abs() > CLOSE.max(1e-3 * feed) {
            return told();
        }
        let Claim::Shifted(by) = claim else {
            if old.numbers.iter().zip(&new.numbers).any(|(a, b)| (a - b).abs() > CLOSE) {
                return told();
            }
            continue;
        };
        if !old.name.starts_with("STRAIGHT") {
            continue;
        }
        for ((axis, given), by) in is_given.iter_mut().enumerate().zip(by) {
            let [old, new] = [&old.numbers, &new.numbers].map(|of| of.get(axis).copied().unwrap_or(f64::NAN));
            let is_shifted = (old + by - new).abs() <= CLOSE;
            // A coordinate that no block has given yet is where the run began.
            if !is_shifted && (*given || (old - new).abs() > CLOSE) {
                return told();
            }
            *given |= is_shifted && by.abs() > CLOSE;
        }
    }
    None
}

/// What became of a change.
enum Made {
    Refused,
    Nothing,
    Changed,
    Wrong(Failure),
}

fn made(reference: &Reference, program: &Program, change: &str, claim: Claim) -> Made {
    let text = fs::read_to_string(&program.path).unwrap();
    // Places of the machine and increments from the zero of the reference stay where they are, and in other units and as a
    // diameter a shift is another number.
    let stays = ["G28", "G30", "G53", "G38", "G92", "G91", "G10", "M70", "M73", "G7", "G20"];
    if matches!(claim, Claim::Shifted(_)) && stays.iter().any(|code| text.contains(code)) {
        return Made::Refused;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(program.path.file_name().unwrap());
    fs::write(&path, &text).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"));
    command.arg("edit").args(change.split(' ')).args(["--isolated", "--control", "linuxcnc"]);
    // The reference keeps its parameters in inches, whatever its programs are written in.
    command.args(["--config", "machine.table_units=\"inch\""]).arg(&path);
    match command.output().unwrap().status.code() {
        Some(0) => {}
        Some(2) => return Made::Refused,
        code => {
            let title = format!("exit {code:?} of {change}");
            return Made::Wrong(Failure { name: program.name.clone(), title: title.clone(), text: title });
        }
    }
    let changed = fs::read_to_string(&path).unwrap();
    let setup = Setup::own();
    let (before, after) = (reference.run(&program.path, &setup), reference.run(&path, &setup));
    if before.end != End::Ended {
        return Made::Refused;
    }
    let told = if after.end == End::Ended {
        difference(&steps(&before.calls, claim), &steps(&after.calls, claim), claim)
    } else {
        Some(format!("{:?}", after.end))
    };
    match told {
        None if changed == text => Made::Nothing,
        None => Made::Changed,
        Some(told) => {
            let text = format!("{change}: {told}\n{text}\nbecame\n{changed}");
            Made::Wrong(Failure { name: program.name.clone(), title: format!("{change}: {told}"), text })
        }
    }
}

#[test]
fn changed_programs_do_in_the_reference_what_the_change_claims() {
    let Some(reference) = reference::find() else { return };
    let share = if env::var_os("GCHECK_ORACLE_LONG").is_some() { 1 } else { SHARE };
    let mut cases = Vec::new();
    let programs: Vec<Program> = programs().into_iter().filter(|p| wanted(&p.name)).collect();
    for (number, (change, claim)) in CHANGES.into_iter().enumerate() {
        let some =
            programs.iter().filter(|program| program.area != "refused" && program.area != "deliberate");
        cases.extend(some.skip(number % share).step_by(share).map(|program| (program, change, claim)));
    }
    let all = on_each(&cases, |(program, change, claim)| made(&reference, program, change, *claim));
    let changed = all.iter().filter(|made| matches!(made, Made::Changed)).count();
    let failures: Vec<Failure> = all
        .into_iter()
        .filter_map(|made| if let Made::Wrong(failure) = made { Some(failure) } else { None })
        .collect();
    assert_none(&failures, cases.len());
    assert!(env::var_os("GCHECK_ORACLE_ONLY").is_some() || changed > 100, "{changed} programs were changed");
}
