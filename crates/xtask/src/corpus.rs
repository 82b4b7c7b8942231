//! `cargo xtask corpus`: what the rules say about real programs, as numbers in `docs/dev/corpus.md`.
//!
//! Knows: the index of the corpus and the JSON of `gcheck check`. Must not know: any rule or control; a control that the
//! knowledge base lacks is left out. The folder is given by `GCHECK_CORPUS` and not part of the repository.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

use anyhow::{Context as _, bail, ensure};
use serde_json::Value;

use crate::workspace;

const PAGE: &str = "docs/dev/corpus.md";

/// A program of the corpus.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Program {
    path: String,
    repository: String,
    commit: String,
    control: String,
    licence: String,
}

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
    let folder =
        env::var_os("GCHECK_CORPUS").context("GCHECK_CORPUS does not name the folder of the corpus")?;
    let folder = Path::new(&folder);
    let index = folder.join("index.tsv");
    let index = fs::read_to_string(&index).with_context(|| index.display().to_string())?;
    let data = workspace::root().join("crates/gcheck-controls/data");
    let programs: Vec<Program> = programs(&index)?
        .into_iter()
        .filter(|p| data.join(&p.control).join("control.toml").exists())
        .collect();

    let status = Command::new("cargo")
        .current_dir(workspace::root())
        .args(["build", "--quiet", "--release", "--package", "gcheck"])
        .status()?;
    ensure!(status.success(), "the release build fails");
    let target = workspace::members()?.target_directory.into_std_path_buf();
    let gcheck = target.join("release").join(format!("gcheck{}", env::consts::EXE_SUFFIX));

    let mut by_control: BTreeMap<&str, Counts> = BTreeMap::new();
    let controls: BTreeSet<&str> = programs.iter().map(|p| p.control.as_str()).collect();
    for control in controls {
        let paths: Vec<&str> =
            programs.iter().filter(|p| p.control == control).map(|p| p.path.as_str()).collect();
        let output = Command::new(&gcheck)
            .current_dir(folder)
            .args(["check", "--isolated", "--control", control, "--output-format", "json"])
            .args(&paths)
            .output()?;
        let words = String::from_utf8_lossy(&output.stderr);
        ensure!(
            matches!(output.status.code(), Some(0 | 1)),
            "gcheck check --control {control} fails: {words}"
        );
        by_control.insert(control, count(&output.stdout, paths.len())?);
    }
    fs::write(workspace::root().join(PAGE), page(&programs, &by_control))?;
    println!("wrote  {PAGE}");
    Ok(ExitCode::SUCCESS)
}

/// The programs of an index: tab-separated, first line names the columns.
fn programs(index: &str) -> anyhow::Result<Vec<Program>> {
    let mut lines = index.lines();
    let head: Vec<&str> = lines.next().unwrap_or_default().split('\t').collect();
    let column = |name: &str| {
        head.iter().position(|h| *h == name).with_context(|| format!("no column `{name}` in the index"))
    };
    let (path, repository, commit) = (column("path")?, column("repo")?, column("commit")?);
    let (kind, control, licence) = (column("kind")?, column("dialect")?, column("licence")?);
    let mut programs: Vec<Program> = lines
        .map(|line| line.split('\t').collect::<Vec<_>>())
        .filter(|fields| fields.get(kind) == Some(&"program"))
        .map(|fields| {
            let field = |column: usize| fields.get(column).copied().unwrap_or_default().to_owned();
            Program {
                path: field(path),
                repository: field(repository),
                commit: field(commit),
                control: field(control),
                licence: field(licence),
            }
        })
        .collect();
    programs.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(programs)
}

fn count(json: &[u8], programs: usize) -> anyhow::Result<Counts> {
    let report: Value = serde_json::from_slice(json).context("the output is no JSON")?;
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

fn page(programs: &[Program], by_control: &BTreeMap<&str, Counts>) -> String {
    let mut text =
        String::from("<!-- Written by `cargo xtask corpus`. -->\n\n# Findings on real programs\n\n");
    let repositories: BTreeMap<(&str, &str, &str), usize> =
        programs.iter().fold(BTreeMap::new(), |mut map, p| {
            *map.entry((&p.repository, &p.commit, &p.licence)).or_default() += 1;
            map
        });
    let _ = writeln!(
        text,
        "{} programs from {} public repositories, each checked for the control it is written for, with the recommended rules.\nEvery finding here is either a mistake in a published program or noise of ours: read the programs before trusting a rule.\n",
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
    text.push_str("\n## Where the programs come from\n\n| repository | commit | programs | licence |\n|---|---|---|---|\n");
    for ((repository, commit, licence), count) in repositories {
        let _ = writeln!(
            text,
            "| {repository} | `{}` | {count} | {licence} |",
            commit.get(..10).unwrap_or(commit)
        );
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

    use super::{count, page, programs};

    const INDEX: &str = "path\trepo\tcommit\tbytes\tlines\tkind\tdialect\tfeatures\tlicence\n\
        b/2.nc\ta/b\t0123456789abcdef\t9\t2\tprogram\tacme-mill\t\tMIT\n\
        b/1.nc\ta/b\t0123456789abcdef\t9\t2\tprogram\tacme-mill\t\tMIT\n\
        b/tool.tbl\ta/b\t0123456789abcdef\t9\t2\taux\t-\t\tMIT\n";

    #[test]
    fn findings_are_counted_by_rule_and_control() {
        let programs = programs(INDEX).unwrap();
        assert_eq!(programs.iter().map(|p| p.path.as_str()).collect::<Vec<_>>(), ["b/1.nc", "b/2.nc"]);
        let json = r#"{"findings": [
            {"rule": "feed-missing", "severity": "error", "file": "b/1.nc"},
            {"rule": "feed-missing", "severity": "error", "file": "b/1.nc"}], "summary": {"lines": 4}}"#;
        let counts = count(json.as_bytes(), 2).unwrap();
        assert_eq!((counts.clean, counts.by_rule["feed-missing"]), (1, 2));
        let page = page(&programs, &BTreeMap::from([("acme-mill", counts)]));
        assert!(page.contains("| `acme-mill` | 2 | 1 | 4 | 2 | 0 | 0 | 0 | 500.0 |\n"), "{page}");
        assert!(page.contains("| [feed-missing](../rules/feed-missing.md) | 2 (500.0) |\n"), "{page}");
        assert!(page.contains("| a/b | `0123456789` | 2 | MIT |\n"), "{page}");
    }
}
