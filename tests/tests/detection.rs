//! How often the control of a real program is detected rightly, as a newcomer meets it: no configuration, no comment for gcheck.
//!
//! Knows: the corpus (`GCHECK_CORPUS`), and the truth about its programs by origin (`tests/detection.tsv`). Must not know: any
//! hint, how a control is chosen. The page `docs/dev/detection.md` is written from what is found
//! (`UPDATE_EXPECT=1 cargo test -p gcheck-tests --test detection`).

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use gcheck_testkit::corpus::{self, CorpusProgram};
use gcheck_tests::process::run;
use serde_json::Value;

/// Of a hundred programs, so many must be told rightly or be left open.
const RIGHT_PERCENT: usize = 97;
/// Of a hundred programs, so many may be taken for something that they are not.
const WRONG_PERCENT: usize = 1;

/// What the truth calls programs of which it says no control.
const UNKNOWN: &str = "unknown";

/// What a program is, by its origin.
struct Truth {
    /// The beginning of the paths that it holds for; of several, the longest counts.
    path: String,
    /// A control, a dialect that no control here reads, or [`UNKNOWN`].
    answer: String,
    reason: String,
}

fn truths() -> Vec<Truth> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("detection.tsv")).unwrap();
    let truth = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let [path, answer, reason] = fields.as_slice() else { panic!("three columns: {line}") };
        Truth { path: (*path).to_owned(), answer: (*answer).to_owned(), reason: (*reason).to_owned() }
    };
    text.lines().skip(1).map(truth).collect()
}

/// The row for a program.
fn of<'t>(truths: &'t [Truth], name: &str) -> Option<&'t Truth> {
    truths.iter().filter(|truth| name.starts_with(&truth.path)).max_by_key(|truth| truth.path.len())
}

/// How a program was told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Told {
    Right,
    Open,
    Wrong,
}

fn told(truth: &str, said: &str) -> Told {
    match said {
        said if said == truth => Told::Right,
        UNKNOWN => Told::Open,
        _ => Told::Wrong,
    }
}

/// What gcheck says of each program of a folder, by name: a control, a dialect that no control here reads, or [`UNKNOWN`].
fn said_in(folder: &Path, names: &[&str]) -> BTreeMap<String, String> {
    let mut said = BTreeMap::new();
    for some in names.chunks(400) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gcheck-under-test"));
        command.current_dir(folder);
        command.args(["check", "--isolated", "--no-cache", "--select", "unsupported-dialect"]);
        command.args(["--output-format", "json"]).args(some);
        let finished = run(&mut command, Duration::from_mins(5));
        let report: Value = serde_json::from_str(&finished.stdout)
            .unwrap_or_else(|error| panic!("{error}: {:?} {}", finished.code, finished.stderr));
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        for file in report["files"].as_array().unwrap() {
            let is_open = file["control"]["source"] == "default";
            let control = if is_open { UNKNOWN.to_owned() } else { text(&file["control"]["name"]) };
            said.insert(text(&file["file"]), control);
        }
        for finding in report["findings"].as_array().unwrap() {
            let dialect = dialect(finding["message"].as_str().unwrap()).unwrap();
            said.insert(text(&finding["file"]), dialect.to_owned());
        }
    }
    said
}

/// What gcheck says of each program where all are in one folder, as a shop keeps the programs of all its machines.
fn said_in_one_folder(programs: &[CorpusProgram]) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let names: Vec<String> = programs
        .iter()
        .enumerate()
        .map(|(ix, program)| {
            let extension = program.path.extension().unwrap_or_default().to_string_lossy();
            let name = format!("{ix:04}.{extension}");
            fs::copy(&program.path, folder.path().join(&name)).unwrap();
            name
        })
        .collect();
    let said = said_in(folder.path(), &names.iter().map(String::as_str).collect::<Vec<_>>());
    names.iter().map(|name| said[name].clone()).collect()
}

/// `the file is for …, which gcheck does not read`.
fn dialect(message: &str) -> Option<&str> {
    message.strip_prefix("the file is for ")?.split_once(", which").map(|(dialect, _)| dialect)
}

/// What a program shows alone, without those beside it.
fn said_alone(program: &CorpusProgram) -> String {
    let text = fs::read(&program.path).unwrap();
    let extension = program.path.extension().map(|extension| extension.to_string_lossy());
    let evidence = gcheck_program::evidence_of_file(&String::from_utf8_lossy(&text), extension.as_deref());
    match evidence.unsupported {
        Some(dialect) => dialect.name.clone(),
        None => gcheck_controls::guess(&evidence).map_or_else(|| UNKNOWN.to_owned(), |guess| guess.control),
    }
}

#[test]
fn programs_are_told_rightly_or_left_open() {
    let Some(programs) = corpus::programs() else { return };
    let truths = truths();
    let names: Vec<&str> = programs.iter().map(|program| program.name.as_str()).collect();
    let with_neighbours = said_in(&corpus::folder().unwrap(), &names);
    let in_one_folder = said_in_one_folder(&programs);
    let mut rows = Vec::new();
    let mut used = BTreeSet::new();
    for (program, mixed) in programs.iter().zip(in_one_folder) {
        let truth = of(&truths, &program.name).unwrap_or_else(|| panic!("no truth for {}", program.name));
        used.insert(&truth.path);
        let said =
            with_neighbours.get(&program.name).unwrap_or_else(|| panic!("not checked: {}", program.name));
        rows.push(Row { name: &program.name, truth, alone: said_alone(program), mixed, said: said.clone() });
    }
    let idle: Vec<&str> =
        truths.iter().filter(|truth| !used.contains(&truth.path)).map(|truth| truth.path.as_str()).collect();
    assert!(idle.is_empty(), "rows of tests/detection.tsv without a program: {idle:?}");
    expect_test::expect_file!["../../docs/dev/detection.md"].assert_eq(&page(&rows));
    for said in [|row: &Row<'_>| row.told(), |row: &Row<'_>| told(&row.truth.answer, &row.mixed)] {
        let wrong = rows.iter().filter(|row| said(row) == Told::Wrong).count();
        assert!(wrong * 100 <= rows.len() * WRONG_PERCENT, "{wrong} of {} are wrong", rows.len());
        assert!((rows.len() - wrong) * 100 >= rows.len() * RIGHT_PERCENT);
    }
}

struct Row<'t> {
    name: &'t str,
    truth: &'t Truth,
    /// What it shows alone.
    alone: String,
    /// What gcheck says of it in one folder with all others.
    mixed: String,
    /// What gcheck says of it in its folder.
    said: String,
}

impl Row<'_> {
    fn told(&self) -> Told {
        told(&self.truth.answer, &self.said)
    }
}

const HEAD: &str = "\
<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-tests --test detection`; edit `tests/detection.tsv`. -->

# Detection of the control

Each program of the corpus (`GCHECK_CORPUS`) as a newcomer checks it: no configuration, no comment for gcheck.
The truth is by origin: the repository, the folder, what a comment names (`tests/detection.tsv`, with a reason for each).
*Open* means that gcheck names no control: the fallback checks the program, and no finding is above a warning. So it is with a control that the program shows only weakly, or that only the programs beside it show.
Where the truth is *unknown*, no control is certain, and to leave it open is right.

";

fn page(rows: &[Row<'_>]) -> String {
    let mut page = HEAD.to_owned();
    let count = |rows: &[&Row<'_>], told| rows.iter().filter(|row| row.told() == told).count();
    let mut by_truth: BTreeMap<&str, Vec<&Row<'_>>> = BTreeMap::new();
    for row in rows {
        by_truth.entry(&row.truth.answer).or_default().push(row);
    }
    page.push_str("| truth | programs | right | open | wrong | right alone | wrong in one folder |\n|---|---|---|---|---|---|---|\n");
    let mut line = |name: &str, rows: &[&Row<'_>]| {
        let alone = rows.iter().filter(|row| row.alone == row.truth.answer).count();
        let [right, open, wrong] = [Told::Right, Told::Open, Told::Wrong].map(|told| count(rows, told));
        let mixed = rows.iter().filter(|row| told(&row.truth.answer, &row.mixed) == Told::Wrong).count();
        writeln!(page, "| {name} | {} | {right} | {open} | {wrong} | {alone} | {mixed} |", rows.len())
            .unwrap();
    };
    for (truth, rows) in &by_truth {
        line(truth, rows);
    }
    line("**all**", &rows.iter().collect::<Vec<_>>());
    page.push_str("\n*Right alone*: without the programs beside it. *Wrong in one folder*: with all programs of the corpus in one folder, as a shop keeps those of all its machines.\n\n## Wrong\n\n");
    page.push_str("| program | truth | told | why the truth is that |\n|---|---|---|---|\n");
    for row in rows.iter().filter(|row| row.told() == Told::Wrong) {
        let Truth { answer: truth, reason, .. } = row.truth;
        writeln!(page, "| {} | {truth} | {} | {reason} |", row.name, row.said).unwrap();
    }
    page.push_str("\n## Dialects that gcheck does not read, left open\n\n");
    page.push_str("The fallback checks them, so what it says of them may be false.\n\n");
    page.push_str("| program | truth |\n|---|---|\n");
    let is_foreign = |row: &&Row<'_>| {
        row.told() == Told::Open && !gcheck_controls::names().contains(&row.truth.answer.as_str())
    };
    for row in rows.iter().filter(is_foreign) {
        writeln!(page, "| {} | {} |", row.name, row.truth.answer).unwrap();
    }
    page.push_str("\n## Controls of gcheck, left open\n\n| folder | truth | programs |\n|---|---|---|\n");
    let mut open: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.told() == Told::Open && !is_foreign(row)) {
        let folder = row.name.rsplit_once('/').map_or("", |(folder, _)| folder);
        *open.entry((folder, &row.truth.answer)).or_default() += 1;
    }
    for ((folder, truth), count) in open {
        writeln!(page, "| {folder} | {truth} | {count} |").unwrap();
    }
    page
}

#[test]
fn the_longest_beginning_of_a_path_counts() {
    let truths = truths();
    let truth = |name| of(&truths, name).map(|truth| truth.answer.as_str());
    assert_eq!(truth("LinuxCNC__linuxcnc/tests/halui/shared-test.sh"), Some("a script interpreter"));
    assert_eq!(truth("LinuxCNC__linuxcnc/nc_files/x.ngc"), Some("linuxcnc"));
    assert_eq!(truth("nobody/x.ngc"), None);
    assert!(truths.iter().all(|truth| !truth.reason.is_empty()));
}
