//! How differences are shown.
//!
//! Knows: what a person wants to see first. Must not know: how the cases were made.

use std::env;
use std::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::Write as _;
use std::sync::Mutex;

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

/// Differences shown at full length; of the others the title.
const AT_LENGTH: usize = 6;

/// One case that does not hold.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The case's name.
    pub(crate) name: String,
    /// What is wrong, in one line.
    pub(crate) title: String,
    /// What is wrong, at length.
    pub(crate) text: String,
}

/// Runs something on every case, two at a time; the answers are in the order of the cases.
pub(crate) fn on_each<T: Sync, R: Send>(cases: &[T], work: impl Fn(&T) -> R + Send + Sync) -> Vec<R> {
    let pool = ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    pool.install(|| cases.par_iter().map(work).collect())
}

/// Fails with all failures, the first ones at length.
pub(crate) fn assert_none(failures: &[Failure], cases: usize) {
    let mut message = format!("{} of {cases} cases do not hold\n", failures.len());
    // Writing to a string cannot fail.
    for failure in failures.iter().take(AT_LENGTH) {
        let _ = writeln!(message, "\n== {}\n{}", failure.name, failure.text.trim_end());
    }
    if failures.len() > AT_LENGTH {
        message.push_str("\nand:\n");
    }
    for failure in failures.iter().skip(AT_LENGTH) {
        let _ = writeln!(message, "  {}: {}", failure.name, failure.title);
    }
    keep(failures);
    assert!(failures.is_empty(), "{message}");
}

/// Appends all failures at full length to the file that `GCHECK_ORACLE_REPORT` names.
fn keep(failures: &[Failure]) {
    static TURN: Mutex<()> = Mutex::new(());
    let Some(file) = env::var_os("GCHECK_ORACLE_REPORT") else { return };
    let _turn = TURN.lock().unwrap();
    let mut file = OpenOptions::new().create(true).append(true).open(file).unwrap();
    for failure in failures {
        writeln!(file, "== {}\n{}", failure.name, failure.text).unwrap();
    }
}

/// Whether `GCHECK_ORACLE_ONLY` leaves this case in.
pub(crate) fn wanted(name: &str) -> bool {
    env::var("GCHECK_ORACLE_ONLY").map_or(true, |text| name.contains(&text))
}
