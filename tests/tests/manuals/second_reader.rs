//! Sixty programs of a second reader of the founding pages: somebody who had the manual and had seen neither the rules nor any
//! output wrote them, with what a checker must say of each.
//!
//! Knows: the programs, what was expected, how the first and the present findings were judged. Must not know: any rule.
//!
//! `expected.tsv` was committed before the programs were checked, and `first.tsv` is the verdict on the findings of that day:
//! neither is edited. `findings.tsv` is what is found now, and `verdicts.tsv` how the same judge reads it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use crate::product;

/// A row of a table by the names of its columns.
type Row = BTreeMap<String, String>;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("second-reader")
}

fn table(name: &str) -> Vec<Row> {
    let text = fs::read_to_string(folder().join(name)).unwrap();
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap().split('\t').collect();
    let row = |line: &str| {
        columns.iter().map(|name| (*name).to_owned()).zip(line.split('\t').map(str::to_owned)).collect()
    };
    lines.map(row).collect()
}

/// Errors and warnings of a program, each with its line.
fn found(row: &Row) -> Vec<String> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"));
    command.args(["check", "--isolated", "--output-format", "json", "--control", &row["control"]]);
    for key in row.get("settings").into_iter().flat_map(|keys| keys.split(';')).filter(|key| !key.is_empty())
    {
        command.args(["--config", key]);
    }
    let output = command.arg(folder().join(&row["file"])).output().unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let findings = report["findings"].as_array().unwrap().iter();
    findings
        .filter(|finding| finding["severity"] != "info")
        .map(|finding| {
            format!("{} {}", product::severity_and_rule(finding), finding["range"]["start"]["line"])
        })
        .collect()
}

#[test]
fn what_is_found_is_what_was_judged() {
    let mut text = "file\tfindings\n".to_owned();
    for row in table("expected.tsv") {
        writeln!(text, "{}\t{}", row["file"], found(&row).join("; ")).unwrap();
    }
    expect_test::expect_file!["../../second-reader/findings.tsv"].assert_eq(&text);
}

#[test]
fn the_page_is_fresh() {
    expect_test::expect_file!["../../../docs/dev/second-reader.md"].assert_eq(&page());
}

fn page() -> String {
    let expected = table("expected.tsv");
    let verdicts = |name: &str| -> BTreeMap<String, Row> {
        table(name).into_iter().map(|row| (row["file"].clone(), row)).collect()
    };
    let (first, now) = (verdicts("first.tsv"), verdicts("verdicts.tsv"));
    let mut text = String::from(INTRODUCTION);
    for verdict in VERDICTS {
        let count =
            |rows: &BTreeMap<String, Row>| rows.values().filter(|row| row["verdict"] == verdict).count();
        writeln!(text, "| {verdict} | {} | {} |", count(&first), count(&now)).unwrap();
    }
    text.push_str("\n| program | what the reader expects | line | at first | now |\n|---|---|---|---|---|\n");
    for row in &expected {
        let (file, line) = (&row["file"], if row["line"] == "0" { "" } else { row["line"].as_str() });
        let now = &now[file];
        let note = if now["note"].is_empty() { String::new() } else { format!(": {}", now["note"]) };
        writeln!(
            text,
            "| [{}](../../tests/second-reader/{file}) | {} | {line} | {} | {}{note} |",
            file.trim_end_matches(".nc"),
            row["expect"],
            first[file]["verdict"],
            now["verdict"],
        )
        .unwrap();
    }
    text
}

/// What may become of a program, from good to bad.
const VERDICTS: [&str; 4] = ["right", "message", "missed", "false"];

const INTRODUCTION: &str = "\
<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-tests --test manuals second_reader`. -->
# A second reader's programs

A reader who had the five founding pages, and had seen neither the rules nor their output, wrote sixty programs: correct ones with traps, and others with one mistake each.
What a checker must say of each was committed with them, before they were checked (`tests/second-reader/expected.tsv`).
Another reader judged the findings at first sight; those verdicts are never edited (`first.tsv`).
The rules were changed only then.

* *right*: the mistake is reported where it is, in words that tell what is wrong; or a correct program has no error and no warning.
* *message*: reported, with words, place or severity that mislead.
* *missed*: not reported.
* *false*: an error or warning that is untrue.

| verdict | at first | now |
|---|---|---|
";
