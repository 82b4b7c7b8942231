//! `cargo xtask corpus`: what the rules say about real programs, as numbers in `docs/dev/corpus.md`.
//!
//! Knows: the JSON of `gcheck check`. Must not know: any rule or control; a control that the knowledge base lacks is left
//! out. The folder is given by `GCHECK_CORPUS` and not part of the repository; `gcheck_testkit::corpus` reads its index.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::process::ExitCode;

use anyhow::{Context as _, bail};
use gcheck_testkit::corpus::{self, CorpusProgram};
use serde_json::Value;

use crate::{binary, measure, workspace};

const PAGE: &str = "docs/dev/corpus.md";

/// What was found in the programs of one control.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Counts {
    programs: usize,
    lines: u64,
    /// Programs without any finding.
    clean: usize,
    by_severity: BTreeMap<String, u64>,
    by_rule: BTreeMap<String, u64>,
}

/// Checks the corpus and writes the page.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    if !arguments.is_empty() {
        bail!("corpus takes no arguments; the folder comes from GCHECK_CORPUS");
    }
    let folder = corpus::folder().context("GCHECK_CORPUS does not name the folder of the corpus")?;
    let data = workspace::root().join("crates/gcheck-controls/data");
    let mut programs = corpus::programs().context("the corpus has no index")?;
    programs.retain(|p| data.join(&p.control).join("control.toml").exists());
    programs.sort_by(|a, b| a.name.cmp(&b.name));

    let gcheck = binary::build(true)?;

    let mut by_control: BTreeMap<&str, Counts> = BTreeMap::new();
    let controls: BTreeSet<&str> = programs.iter().map(|p| p.control.as_str()).collect();
    for control in controls {
        let paths: Vec<&str> =
            programs.iter().filter(|p| p.control == control).map(|p| p.name.as_str()).collect();
        let output = binary::check(&gcheck, &folder, &["--isolated", "--control", control], &paths)?;
        by_control.insert(control, count(&output.stdout, paths.len())?);
    }
    let all: Vec<&str> = programs.iter().map(|p| p.name.as_str()).collect();
    let (before, _) = measure::children()?;
    binary::check(&gcheck, &folder, &["--isolated"], &all)?;
    let (after, _) = measure::children()?;
    fs::write(workspace::root().join(PAGE), page(&programs, &by_control, after - before))?;
    println!("wrote  {PAGE}");
    Ok(ExitCode::SUCCESS)
}

fn count(json: &[u8], programs: usize) -> anyhow::Result<Counts> {
    let report: Value = serde_json::from_slice(json).context("the output is not JSON")?;
    let mut counts = Counts {
        programs,
        lines: report.pointer("/summary/lines").and_then(Value::as_u64).unwrap_or(0),
        ..Counts::default()
    };
    let mut files = BTreeSet::new();
    for finding in report.get("findings").and_then(Value::as_array).into_iter().flatten() {
        let field = |name: &str| finding.get(name).and_then(Value::as_str).unwrap_or("?").to_owned();
        *counts.by_rule.entry(field("rule")).or_default() += 1;
        *counts.by_severity.entry(field("severity")).or_default() += 1;
        files.insert(field("file"));
    }
    counts.clean = programs.saturating_sub(files.len());
    Ok(counts)
}

fn page(programs: &[CorpusProgram], by_control: &BTreeMap<&str, Counts>, seconds: f64) -> String {
    let mut text =
        String::from("<!-- Written by `cargo xtask corpus`. -->\n\n# Findings on real programs\n\n");
    let repositories: BTreeMap<(&str, &str), (usize, BTreeSet<&str>)> =
        programs.iter().fold(BTreeMap::new(), |mut map: BTreeMap<_, (usize, BTreeSet<&str>)>, p| {
            let entry = map.entry((p.repository.as_str(), p.licence.as_str())).or_default();
            entry.0 += 1;
            entry.1.insert(p.commit.get(..10).unwrap_or(&p.commit));
            map
        });
    let lines: u64 = by_control.values().map(|counts| counts.lines).sum();
    let _ = writeln!(
        text,
        "{} programs from {} public repositories (the real-program corpus, `GCHECK_CORPUS`), each checked for the control that the corpus\n\
        guesses for it, with the recommended rules. A finding is a mistake in a published program, a file that is not a program\n\
        of that control, or noise of ours: [corpus-notes.md](corpus-notes.md) says what was read by eye and judged.\n\n\
        One `gcheck check` of all {lines} lines took {seconds:.1} CPU seconds (release build) on the machine that wrote this page.\n",
        programs.len(),
        repositories.len(),
    );
    text.push_str("| control | programs | without findings | lines | errors | warnings | infos | hints | findings per 1,000 lines |\n|---|---|---|---|---|---|---|---|---|\n");
    for (control, counts) in by_control {
        let severity = |name: &str| counts.by_severity.get(name).copied().unwrap_or(0);
        let all: u64 = counts.by_severity.values().sum();
        let _ = writeln!(
            text,
            "| `{control}` | {} | {} | {} | {} | {} | {} | {} | {} |",
            counts.programs,
            counts.clean,
            counts.lines,
            severity("error"),
            severity("warning"),
            severity("info"),
            severity("hint"),
            per_thousand(all, counts.lines),
        );
    }
    text.push_str("\n## By rule\n\nFindings, and in brackets findings per 1,000 lines.\n\n");
    let controls: Vec<String> = by_control.keys().map(|control| format!("`{control}`")).collect();
    let _ = writeln!(text, "| rule | {} |\n|---|{}", controls.join(" | "), "---|".repeat(controls.len()));
    let rules: BTreeSet<&str> =
        by_control.values().flat_map(|c| c.by_rule.keys()).map(String::as_str).collect();
    for rule in rules {
        let cells: Vec<String> = by_control
            .values()
            .map(|counts| match counts.by_rule.get(rule) {
                Some(found) => format!("{found} ({})", per_thousand(*found, counts.lines)),
                None => String::new(),
            })
            .collect();
        let _ = writeln!(text, "| [{rule}](../rules/{rule}.md) | {} |", cells.join(" | "));
    }
    text.push_str("\n## Where the programs come from\n\n| repository | commits | programs | licence |\n|---|---|---|---|\n");
    for ((repository, licence), (count, commits)) in repositories {
        let commits = match Vec::from_iter(commits).as_slice() {
            [commit] => format!("`{commit}`"),
            many => many.len().to_string(),
        };
        let _ = writeln!(text, "| {repository} | {commits} | {count} | {licence} |");
    }
    text
}

#[expect(clippy::cast_precision_loss, reason = "counts, far below 2^53")]
fn per_thousand(found: u64, lines: u64) -> String {
    format!("{:.1}", found as f64 * 1_000.0 / lines.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use gcheck_testkit::corpus::CorpusProgram;

    use super::{count, page};

    #[test]
    fn findings_are_counted_by_rule_and_control() {
        let program = |name: &str| CorpusProgram {
            name: name.to_owned(),
            path: name.into(),
            control: "acme-mill".to_owned(),
            repository: "a/b".to_owned(),
            commit: "0123456789abcdef".to_owned(),
            licence: "MIT".to_owned(),
        };
        let json = r#"{"findings": [
            {"rule": "feed-missing", "severity": "error", "file": "b/1.nc"},
            {"rule": "feed-missing", "severity": "error", "file": "b/1.nc"}], "summary": {"lines": 4}}"#;
        let counts = count(json.as_bytes(), 2).unwrap();
        assert_eq!((counts.clean, counts.by_rule["feed-missing"]), (1, 2));
        let programs = [program("b/1.nc"), program("b/2.nc")];
        let page = page(&programs, &BTreeMap::from([("acme-mill", counts)]), 0.25);
        assert!(page.contains("| `acme-mill` | 2 | 1 | 4 | 2 | 0 | 0 | 0 | 500.0 |\n"), "{page}");
        assert!(page.contains("| [feed-missing](../rules/feed-missing.md) | 2 (500.0) |\n"), "{page}");
        assert!(page.contains("| a/b | `0123456789` | 2 | MIT |\n"), "{page}");
    }
}
