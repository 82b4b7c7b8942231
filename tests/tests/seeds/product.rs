//! The product as its users run it.
//!
//! Knows: commands and their output. Must not know: what a program is to prove.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

use crate::sentence::Program;

/// Findings, each as `severity[rule]`.
pub(crate) fn check(program: &Program) -> Vec<String> {
    let json = check_json(program);
    let findings = json["findings"].as_array().unwrap();
    findings
        .iter()
        .map(|one| format!("{}[{}]", one["severity"].as_str().unwrap(), one["rule"].as_str().unwrap()))
        .collect()
}

/// What the verdict rests on: of the whole, and of each finding.
pub(crate) fn assumptions(program: &Program) -> Vec<String> {
    let json = check_json(program);
    let of_all = json["summary"]["assumptions"].as_array().unwrap().iter();
    let of_findings = json["findings"].as_array().unwrap().iter();
    of_all
        .map(|one| one["text"].as_str().unwrap().to_owned())
        .chain(of_findings.flat_map(|finding| {
            let texts = finding["assumptions"].as_array().cloned().unwrap_or_default();
            texts.into_iter().filter_map(|one| one.as_str().map(str::to_owned))
        }))
        .collect()
}

/// The moves as text.
pub(crate) fn run(program: &Program) -> String {
    gcheck(&["run", "--output-format", "text"], program)
}

/// Times, tools, extents.
pub(crate) fn stats(program: &Program) -> String {
    gcheck(&["stats"], program)
}

/// What is known about a code.
pub(crate) fn explain(control: &str, code: &str) -> String {
    let output = command().args(["explain", "--control", control, code]).output().unwrap();
    text(&output)
}

fn check_json(program: &Program) -> Value {
    serde_json::from_str(&gcheck(&["check", "--output-format", "json"], program)).unwrap()
}

fn gcheck(subcommand: &[&str], program: &Program) -> String {
    let mut command = command();
    command.args(subcommand).args(["--isolated", "--control", program.control]);
    for key in program.config {
        command.args(["--config", key]);
    }
    let mut child = command.arg("-").spawn().unwrap();
    child.stdin.take().unwrap().write_all(program.text.as_bytes()).unwrap();
    text(&child.wait_with_output().unwrap())
}

fn command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"));
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Standard output of a command that did what it was asked: it may have found something.
fn text(output: &Output) -> String {
    let code = output.status.code();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(code, Some(0 | 1)) && !errors.contains("panicked"), "exit {code:?}: {errors}");
    String::from_utf8(output.stdout.clone()).unwrap()
}
