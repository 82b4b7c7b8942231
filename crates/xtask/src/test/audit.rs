//! Asks the registry of npm for advisories about the packages of the editors.
//!
//! Knows: lock files, what `npm audit` prints. Must not know: what the packages are for.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use super::tools::say;
use crate::workspace;

/// What the registry says about the packages of a lock file.
#[derive(Debug, PartialEq, Eq)]
enum Answer {
    /// No advisory, about so many packages.
    None(u64),
    /// A line for each package with advisories.
    Some(Vec<String>),
    /// It could not be asked, for this reason.
    NotAsked(String),
}

/// False for an advisory. A registry that cannot be asked is reported, and fails only where advisories `must` be within reach.
pub(super) fn passes(must: bool) -> bool {
    let mut passes = true;
    for folder in folders_with_lock(&workspace::root().join("editors")) {
        let shown = workspace::relative(workspace::root(), &folder);
        say(&format!("npm audit in {shown}"));
        match ask(&folder) {
            Answer::None(packages) => say(&format!("no advisories about the {packages} packages of {shown}")),
            Answer::Some(lines) => {
                passes = false;
                for line in lines {
                    say(&format!("advisory about {line}, a package of {shown}"));
                }
            }
            Answer::NotAsked(reason) => {
                passes &= !must;
                say(&format!(
                    "npm audit could not be asked about {shown}: {reason}: its advisories are not checked"
                ));
            }
        }
    }
    passes
}

/// The folders directly in `folder` that have a lock file of npm, sorted.
fn folders_with_lock(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut folders: Vec<PathBuf> = entries.filter(|path| path.join("package-lock.json").is_file()).collect();
    folders.sort();
    folders
}

fn ask(folder: &Path) -> Answer {
    // npm is a script on Windows.
    let mut npm = Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" });
    // The lock file is all that it reads; a registry that does not answer is asked once, and not for minutes.
    npm.args(["audit", "--json", "--package-lock-only", "--fetch-retries=1", "--fetch-timeout=30000"]);
    match npm.current_dir(folder).stdin(Stdio::null()).output() {
        Ok(output) => answer(&String::from_utf8_lossy(&output.stdout)),
        Err(error) => Answer::NotAsked(format!("npm does not start: {error}")),
    }
}

/// Reads what `npm audit --json` prints. Its exit code is 1 for an advisory and for a registry without an answer.
fn answer(printed: &str) -> Answer {
    let Ok(report) = serde_json::from_str::<Value>(printed) else {
        return Answer::NotAsked("npm prints no report".to_owned());
    };
    let Some(advisories) = report.get("vulnerabilities").and_then(Value::as_object) else {
        let reason = report.get("message").or_else(|| report.pointer("/error/summary"));
        return Answer::NotAsked(reason.and_then(Value::as_str).unwrap_or("npm gives no reason").to_owned());
    };
    if advisories.is_empty() {
        let packages = report.pointer("/metadata/dependencies/total").and_then(Value::as_u64);
        return match packages {
            // A report about nothing is not an answer.
            None | Some(0) => Answer::NotAsked("the report names no packages".to_owned()),
            Some(packages) => Answer::None(packages),
        };
    }
    let line = |(name, advisory): (&String, &Value)| {
        let severity = advisory.get("severity").and_then(Value::as_str).unwrap_or("unknown severity");
        let via = advisory.get("via").and_then(Value::as_array).into_iter().flatten();
        // A package that only needs one with an advisory names that one.
        let words = via.filter_map(|via| via.get("title").unwrap_or(via).as_str());
        format!("{name} ({severity}): {}", words.collect::<Vec<_>>().join("; "))
    };
    Answer::Some(advisories.iter().map(line).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advisories_are_named_with_the_packages_that_need_them() {
        let report = r#"{
            "auditReportVersion": 2,
            "vulnerabilities": {
                "tar": { "name": "tar", "severity": "high", "via": [
                    { "title": "tar writes outside of its folder", "url": "https://github.com/advisories/GHSA-x" }
                ] },
                "packer": { "name": "packer", "severity": "high", "via": ["tar"] }
            },
            "metadata": { "dependencies": { "total": 300 } }
        }"#;
        let lines = ["packer (high): tar", "tar (high): tar writes outside of its folder"];
        assert_eq!(answer(report), Answer::Some(lines.map(str::to_owned).to_vec()));
    }

    #[test]
    fn packages_without_advisories_are_counted() {
        let report =
            r#"{ "vulnerabilities": {}, "metadata": { "dependencies": { "prod": 5, "total": 300 } } }"#;
        assert_eq!(answer(report), Answer::None(300));
        let report = r#"{ "vulnerabilities": {}, "metadata": { "dependencies": { "total": 0 } } }"#;
        assert_eq!(answer(report), Answer::NotAsked("the report names no packages".to_owned()));
    }

    #[test]
    fn a_registry_that_has_no_advisories_to_give_is_told_from_one_without_any() {
        let refused = r#"{ "message": "405 Method Not Allowed - POST", "statusCode": 405, "error": { "summary": "" } }"#;
        assert_eq!(answer(refused), Answer::NotAsked("405 Method Not Allowed - POST".to_owned()));
        let offline = r#"{ "error": { "code": "ENOTFOUND", "summary": "request failed", "detail": "" } }"#;
        assert_eq!(answer(offline), Answer::NotAsked("request failed".to_owned()));
        assert_eq!(answer(""), Answer::NotAsked("npm prints no report".to_owned()));
    }

    #[test]
    fn every_lock_file_of_the_repository_is_asked_about() {
        let editors = workspace::root().join("editors");
        let asked: Vec<String> = folders_with_lock(&editors)
            .iter()
            .map(|folder| workspace::relative(workspace::root(), &folder.join("package-lock.json")))
            .collect();
        let mut files = workspace::text_files(workspace::root()).unwrap();
        files.retain(|file| file.path.ends_with("package-lock.json"));
        assert!(!asked.is_empty());
        assert_eq!(asked, files.into_iter().map(|file| file.path).collect::<Vec<_>>());
    }
}
