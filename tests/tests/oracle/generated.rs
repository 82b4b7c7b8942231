//! Random programs, run by both.
//!
//! Knows: seeds, differences, where a minimal program is kept. Must not know: what programs look like.

use std::env;
use std::fs;
use std::path::Path;

use crate::canonical::{Difference, End, Outcome, compare};
use crate::generator::program;
use crate::minimise::minimise;
use crate::product;
use crate::reference::{self, Reference};
use crate::report::{Failure, assert_none, on_each};
use crate::setup::{Setup, fixtures};

/// Programs of a usual run.
const USUAL: u64 = 300;

/// Differences that are minimised: each costs a hundred runs.
const MINIMISED: usize = 5;

/// What the suite must reach, or it would prove nothing about it.
const CALLS: &[&str] = &[
    "ARC_FEED",
    "CHANGE_TOOL",
    "DISABLE_FEED_OVERRIDE",
    "DWELL",
    "FLOOD_ON",
    "NURBS_FEED",
    "ORIENT_SPINDLE",
    "RIGID_TAP",
    "SELECT_PLANE",
    "SET_FEED_MODE",
    "SET_FEED_RATE",
    "SET_G5X_OFFSET",
    "SET_G92_OFFSET",
    "SET_MOTION_CONTROL_MODE",
    "SET_NAIVECAM_TOLERANCE",
    "SET_SPINDLE_MODE",
    "SET_TOOL_TABLE_ENTRY",
    "SET_XY_ROTATION",
    "START_SPEED_FEED_SYNC",
    "START_SPINDLE_COUNTERCLOCKWISE",
    "STRAIGHT_FEED",
    "STRAIGHT_PROBE",
    "STRAIGHT_TRAVERSE",
    "USE_LENGTH_UNITS",
    "USE_TOOL_LENGTH_OFFSET",
];

fn seeds() -> Vec<u64> {
    let count = env::var("GCHECK_ORACLE_LONG").ok().and_then(|n| n.parse().ok()).unwrap_or(USUAL);
    let only: Option<u64> = env::var("GCHECK_ORACLE_ONLY").ok().and_then(|n| n.parse().ok());
    only.map_or_else(|| (0..count).collect(), |seed| vec![seed])
}

/// Runs a text on both sides; `None` when the reference does not come to an end, which proves nothing.
fn both(reference: &Reference, text: &str) -> Option<(Outcome, Outcome)> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("program.ngc");
    fs::write(&file, text).unwrap();
    let setup = Setup::own();
    let expected = reference.run(&file, &setup);
    if matches!(expected.end, End::Endless | End::Broken(_)) {
        return None;
    }
    let ours = product::execute(&file, &setup);
    Some((expected, ours))
}

fn differ(reference: &Reference, text: &str) -> Option<Difference> {
    let (expected, ours) = both(reference, text)?;
    compare(&expected, &ours)
}

#[test]
fn random_programs_run_as_the_reference_runs_them() {
    let Some(reference) = reference::find() else { return };
    let seeds = seeds();
    let found = on_each(&seeds, |seed| Some((*seed, differ(&reference, &program(*seed))?)));
    let found: Vec<(u64, Difference)> = found.into_iter().flatten().collect();
    let (first, others) = found.split_at(found.len().min(MINIMISED));
    let mut failures = on_each(first, |(seed, difference)| {
        let small = smallest(&reference, &program(*seed), difference);
        keep(*seed, &small);
        let difference = differ(&reference, &small).unwrap_or_else(|| difference.clone());
        let text = format!("{}\n{small}", difference.text);
        Failure { name: format!("seed {seed}"), title: difference.title, text }
    });
    failures.extend(others.iter().map(|(seed, difference)| Failure {
        name: format!("seed {seed}"),
        title: difference.title.clone(),
        text: format!("{}\n{}", difference.text, program(*seed)),
    }));
    assert_none(&failures, seeds.len());
}

/// The smallest part that still differs in the same way. `GCHECK_ORACLE_WHOLE` leaves the program as it is.
fn smallest(reference: &Reference, text: &str, difference: &Difference) -> String {
    if env::var_os("GCHECK_ORACLE_WHOLE").is_some() {
        return text.to_owned();
    }
    minimise(text, |part| differ(reference, part).is_some_and(|other| other.kind == difference.kind))
}

/// With `GCHECK_ORACLE_KEEP`, a minimal program becomes a case.
fn keep(seed: u64, small: &str) {
    if env::var_os("GCHECK_ORACLE_KEEP").is_some() {
        let folder = fixtures().join("found");
        fs::create_dir_all(&folder).unwrap();
        fs::write(
            folder.join(format!("seed-{seed}.ngc")),
            format!("(Found by the generator, seed {seed})\n{small}"),
        )
        .unwrap();
    }
}

#[test]
fn random_programs_mostly_run_and_reach_everything() {
    let Some(reference) = reference::find() else { return };
    let seeds: Vec<u64> = (0..USUAL).collect();
    let runs = on_each(&seeds, |seed| {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("program.ngc");
        fs::write(&file, program(*seed)).unwrap();
        (*seed, reference.run(&file, &Setup::own()))
    });
    let refused = runs.iter().filter(|(_, run)| run.end != End::Ended);
    let refused: Vec<String> = refused.map(|(seed, run)| format!("seed {seed}: {:?}", run.end)).collect();
    assert!(refused.len() * 4 < runs.len(), "{} of {}:\n{}", refused.len(), runs.len(), refused.join("\n"));
    for name in CALLS {
        let reached =
            runs.iter().filter(|(_, run)| run.calls.iter().any(|call| call.name() == *name)).count();
        assert!(reached >= 5, "{name} is reached by {reached} programs");
    }
}

#[test]
fn a_seed_gives_the_same_program_each_time() {
    assert_eq!(program(3), program(3));
    assert_ne!(program(3), program(4));
    assert!(Path::new(&Setup::own().table).is_file());
}
