//! No error is in a program that LinuxCNC ships and its interpreter (`rs274`) accepts.
//!
//! Knows: the real-program corpus, the interpreter's exit code. Must not know: why a program is accepted or refused; the
//! oracle compares the moves.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::env;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use gcheck_testkit::corpus::{self, CorpusProgram};
use gcheck_testkit::skips::skip;
use rayon::prelude::*;
use serde_json::Value;

/// Seconds; the longest program that ends takes a fraction of this.
const LIMIT: &str = "10";

fn interpreter() -> Option<PathBuf> {
    let folders = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&folders).map(|folder| folder.join("rs274")).find(|file| file.is_file());
    if found.is_none() {
        skip("shipped programs", "rs274", "`cargo xtask test` installs it (Debian: linuxcnc-uspace)");
    }
    found
}

/// The interpreter comes to the program's end, in the folder where it is.
fn is_accepted(interpreter: &PathBuf, program: &CorpusProgram) -> bool {
    // The home folder holds the tool table of the running interpreter: two of them with one home disturb each other.
    let home = tempfile::tempdir().unwrap();
    let (table, parameters) = (home.path().join("tool.tbl"), home.path().join("parameters.var"));
    fs::write(&table, "T1 P1 D6 Z50\nT2 P2 D6 Z60\n").unwrap();
    fs::write(&parameters, "").unwrap();
    let mut command = Command::new("timeout");
    command.arg(LIMIT).arg(interpreter).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.env("HOME", home.path()).current_dir(program.path.parent().unwrap());
    command.arg("-t").arg(&table).arg("-v").arg(&parameters).arg("-g").arg(&program.path);
    command.status().unwrap().code() == Some(0)
}

#[test]
fn a_program_that_the_interpreter_accepts_has_no_error() {
    let Some(mut programs) = corpus::programs() else { return };
    let Some(interpreter) = interpreter() else { return };
    programs.retain(|program| program.repository == "LinuxCNC/linuxcnc" && program.control == "linuxcnc");
    let accepted: Vec<&str> = programs
        .par_iter()
        .filter(|program| is_accepted(&interpreter, program))
        .map(|program| program.name.as_str())
        .collect();
    assert!(accepted.len() > 200, "{} of {} programs are accepted", accepted.len(), programs.len());
    let output = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"))
        .current_dir(corpus::folder().unwrap())
        .args(["check", "--isolated", "--control", "linuxcnc", "--output-format", "json", "--"])
        .args(&accepted)
        .output()
        .unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let errors: Vec<String> = report["findings"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|finding| finding["severity"] == "error")
        .map(|finding| {
            format!("{}:{}: {}", finding["file"], finding["range"]["start"]["line"], finding["message"])
        })
        .collect();
    assert_eq!(errors, Vec::<String>::new(), "among {} accepted programs", accepted.len());
}
