//! The installed interpreter.
//!
//! Knows: how `rs274` is found, called and understood. Must not know: what its output is compared with.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use gcheck_testkit::skips::skip;

use crate::canonical::{Call, End, Outcome, read};
use crate::process::run;
use crate::setup::Setup;

/// No program of the suite takes longer than a tenth of this.
const LIMIT: Duration = Duration::from_secs(5);

/// The installed interpreter.
#[derive(Debug, Clone)]
pub struct Reference {
    program: PathBuf,
}

/// The installed interpreter.
///
/// `None`, with a line on standard error that says so, where it is not installed and nothing demands it.
pub fn find() -> Option<Reference> {
    let folders = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&folders).map(|folder| folder.join("rs274")).find(|file| file.is_file());
    if let Some(program) = found {
        return Some(Reference { program });
    }
    skip(
        "a comparison with the interpreter",
        "rs274",
        "`cargo xtask test` installs it (Debian: linuxcnc-uspace)",
    );
    None
}

impl Reference {
    /// Runs a program in its folder. What of its output never counts is left out.
    pub fn run(&self, program: &Path, setup: &Setup) -> Outcome {
        let Outcome { calls, end } = self.run_whole(program, setup);
        Outcome { calls: without_idle_tolerance(calls), end }
    }

    /// Runs a program in its folder, all of its output.
    pub fn run_whole(&self, program: &Path, setup: &Setup) -> Outcome {
        // The home folder holds the tool table of the running interpreter: two of them with one home disturb each other.
        let home = tempfile::tempdir().unwrap();
        let (table, parameters) = (home.path().join("tool.tbl"), home.path().join("parameters.var"));
        fs::copy(&setup.table, &table).unwrap();
        fs::write(&parameters, "").unwrap();
        let mut command = Command::new(&self.program);
        command.env("HOME", home.path()).current_dir(program.parent().unwrap());
        if let Some(ini) = &setup.ini {
            command.arg("-i").arg(ini);
        }
        command.arg("-t").arg(&table).arg("-v").arg(&parameters).arg("-g").arg(program);
        let finished = run(&mut command, LIMIT);
        let end = match finished.code {
            _ if finished.endless => End::Endless,
            Some(0) => End::Ended,
            Some(1) => End::Refused(refusal(&finished.stderr)),
            code => End::Broken(format!("exit {code:?}: {}", finished.stderr)),
        };
        let mut calls = read(&finished.stdout);
        if setup.ini.is_some() {
            // With a machine file it resets once less after the program, whatever the file says.
            calls.extend(calls.last().cloned());
        }
        Outcome { calls, end }
    }
}

/// The words of a refusal: the last line but one, the last being the source line.
fn refusal(stderr: &str) -> String {
    let lines: Vec<&str> = stderr.lines().filter(|line| *line != "executing").collect();
    lines.get(lines.len().saturating_sub(2)).map(|line| (*line).to_owned()).unwrap_or_default()
}

/// Drops the tolerance that the reference repeats after a cycle under exact stop: it says nothing there
/// (`exact-stop-tolerance`).
fn without_idle_tolerance(calls: Vec<Call>) -> Vec<Call> {
    let mut stops = false;
    let keep = |call: &Call| {
        let idle = stops && call.name() == "SET_NAIVECAM_TOLERANCE";
        stops = call.name() == "SET_MOTION_CONTROL_MODE" && call.is_exact_stop();
        !idle
    };
    calls.into_iter().filter(keep).collect()
}
