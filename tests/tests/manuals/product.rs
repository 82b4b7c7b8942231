//! The product as its users run it.
//!
//! Knows: commands and their output. Must not know: what a program is to prove.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use gcheck_controls::Access;
use serde_json::Value;

use crate::proof::Program;

/// Findings, each as `severity[rule]`.
pub(crate) fn check(program: &Program) -> Vec<String> {
    findings(program).iter().map(severity_and_rule).collect()
}

/// Findings as the JSON format has them, in the order of the program.
pub(crate) fn findings(program: &Program) -> Vec<Value> {
    check_json(program)["findings"].as_array().unwrap().clone()
}

/// `severity[rule]`.
pub(crate) fn severity_and_rule(finding: &Value) -> String {
    format!("{}[{}]", finding["severity"].as_str().unwrap(), finding["rule"].as_str().unwrap())
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

/// The moves as the format of one JSON object a move has them.
pub(crate) fn moves(program: &Program) -> Vec<Value> {
    let mut all = events(program);
    all.retain(|one| !one["to"].is_null());
    all
}

/// The moves and what else a run comes to: tools, spindle, coolant, dwells, stops.
pub(crate) fn events(program: &Program) -> Vec<Value> {
    let lines = gcheck(&["run", "--output-format", "jsonl"], program);
    lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// What stops a run, if anything does.
pub(crate) fn stopped(program: &Program) -> Option<String> {
    let output = output(&["run", "--quiet"], program);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    (!output.status.success()).then_some(errors)
}

/// Why a check does not begin: a configuration that is not right.
pub(crate) fn refused(program: &Program) -> Option<String> {
    let output = output(&["check", "--quiet"], program);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    (!matches!(output.status.code(), Some(0 | 1))).then_some(errors)
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

/// Title and access of a variable in the control's table.
pub(crate) fn variable(control: &str, number: u32) -> Option<(String, &'static str)> {
    let control = gcheck_controls::load(control).unwrap();
    let gcheck_controls::Variable::Known(entry) = control.variable(number) else { return None };
    let access = match entry.access {
        Access::ReadWrite => "read-write",
        Access::Read => "read",
        Access::Write => "write",
    };
    Some((entry.title.clone(), access))
}

fn check_json(program: &Program) -> Value {
    serde_json::from_str(&gcheck(&["check", "--output-format", "json"], program)).unwrap()
}

fn gcheck(subcommand: &[&str], program: &Program) -> String {
    text(&output(subcommand, program))
}

/// A program alone comes by standard input; one with others beside it is a file in their folder.
fn output(subcommand: &[&str], program: &Program) -> Output {
    let mut command = command();
    command.args(subcommand).args(["--isolated", "--control", program.control]);
    for key in program.config {
        command.args(["--config", key]);
    }
    if program.skips && subcommand.contains(&"run") {
        command.args(["--block-skip", "on"]);
    }
    if program.files.is_empty() {
        let mut child = command.arg("-").spawn().unwrap();
        child.stdin.take().unwrap().write_all(program.text.as_bytes()).unwrap();
        return child.wait_with_output().unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in program.files.iter().chain([&("main.nc", program.text)]) {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    command.arg("main.nc").current_dir(folder.path()).output().unwrap()
}

fn command() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"));
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Standard output of a command that did what it was asked: it may have found something. One that was asked for a setting that
/// nothing reads says nothing: the statement of that setting is a gap.
fn text(output: &Output) -> String {
    let code = output.status.code();
    let errors = String::from_utf8_lossy(&output.stderr);
    if code == Some(2) && errors.contains("gcheck reads no setting") {
        return String::new();
    }
    assert!(matches!(code, Some(0 | 1)) && !errors.contains("panicked"), "exit {code:?}: {errors}");
    String::from_utf8(output.stdout.clone()).unwrap()
}
