//! The product as its users run it: one `gcheck check` for all cases of one configuration.
//!
//! Knows: commands and their output. Must not know: where cases come from.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::cases::{Case, Subject};
use crate::kind::Place;

/// The rules that are on when nobody chooses.
pub(crate) const BY_DEFAULT: &str = "recommended";
/// And what careful programs state.
pub(crate) const STRICT: &str = "strict";

/// Lines between an edit and a finding that is still near it.
const NEAR: usize = 2;

/// A finding as the cases ask for it.
struct Found {
    severity: String,
    rule: String,
    lines: (usize, usize),
}

/// What is said about programs without mistakes.
pub(crate) fn check_clean(subjects: &[Subject]) -> Vec<String> {
    let files =
        subjects.iter().map(|s| (s.program.control.as_str(), s.config.as_str(), s.program.text.as_str()));
    let findings = check(&files.collect::<Vec<_>>(), BY_DEFAULT);
    let said = subjects.iter().zip(findings);
    said.flat_map(|(subject, found)| {
        found
            .into_iter()
            .map(move |f| format!("{}:{}: {}[{}]", subject.program.name, f.lines.0, f.severity, f.rule))
    })
    .collect()
}

/// The programs about which nothing is said, not even where each is alone in its folder.
pub(crate) fn only_clean(subjects: Vec<Subject>) -> Vec<Subject> {
    let files =
        subjects.iter().map(|s| (s.program.control.as_str(), s.config.as_str(), s.program.text.as_str()));
    let findings = check(&files.collect::<Vec<_>>(), BY_DEFAULT);
    subjects.into_iter().zip(findings).filter(|(_, found)| found.is_empty()).map(|(s, _)| s).collect()
}

/// Which of the cases are found with the rules of a set.
pub(crate) fn found(cases: &[Case], set: &str) -> Vec<bool> {
    let files = cases.iter().map(|c| (c.control.as_str(), c.config.as_str(), c.text.as_str()));
    let findings = check(&files.collect::<Vec<_>>(), set);
    let is_found = |case: &Case, found: &Found| {
        let (first, last) = found.lines;
        let is_near = case.lines.iter().any(|line| first <= line + NEAR && *line <= last + NEAR);
        case.kind.found_by.contains(&found.rule.as_str()) && (case.kind.place == Place::Anywhere || is_near)
    };
    let mut seen = Vec::new();
    for (case, findings) in cases.iter().zip(findings) {
        let hit = findings.iter().any(|found| is_found(case, found));
        if !hit && set == STRICT && std::env::var_os("GCHECK_SEEDED_MISSES").is_some() {
            let said: Vec<_> = findings.iter().map(|f| format!("{}:{}", f.lines.0, f.rule)).collect();
            tell(case, &said);
        }
        seen.push(hit);
    }
    seen
}

/// What a developer of a rule wants to see of a mistake that was missed.
#[expect(clippy::print_stderr, reason = "asked for by a variable of the environment")]
fn tell(case: &Case, said: &[String]) {
    eprintln!("missed: {} in {} ({}): {said:?}", case.kind.id, case.program, case.control);
    for line in &case.lines {
        let text = case.text.lines().nth(line - 1).unwrap_or_default();
        eprintln!("  {line:4} | {text}");
    }
}

/// Checks programs, each in a folder of its own; the findings of each.
fn check(files: &[(&str, &str, &str)], set: &str) -> Vec<Vec<Found>> {
    let folder = tempfile::tempdir().unwrap();
    let configs: BTreeSet<(&str, &str)> =
        files.iter().map(|(control, config, _)| (*control, *config)).collect();
    let mut findings: Vec<Vec<Found>> = files.iter().map(|_| Vec::new()).collect();
    for (number, (control, config)) in configs.into_iter().enumerate() {
        let top = folder.path().join(number.to_string());
        fs::create_dir(&top).unwrap();
        fs::write(top.join("gcheck.toml"), config).unwrap();
        let mut names = BTreeMap::new();
        for (index, file) in files.iter().enumerate() {
            if (file.0, file.1) == (control, config) {
                let name = format!("{index}/program.nc");
                fs::create_dir(top.join(index.to_string())).unwrap();
                fs::write(top.join(&name), file.2).unwrap();
                names.insert(name, index);
            }
        }
        for finding in run(&top, set)["findings"].as_array().unwrap() {
            let line = |end: &str| usize::try_from(finding["range"][end]["line"].as_u64().unwrap()).unwrap();
            let index = names[finding["file"].as_str().unwrap()];
            findings[index].push(Found {
                severity: finding["severity"].as_str().unwrap().to_owned(),
                rule: finding["rule"].as_str().unwrap().to_owned(),
                lines: (line("start"), line("end")),
            });
        }
    }
    findings
}

fn run(folder: &Path, set: &str) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"))
        .current_dir(folder)
        .args(["check", "--output-format", "json", "--select", set, "."])
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 1)) && !errors.contains("panicked"), "{errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}
