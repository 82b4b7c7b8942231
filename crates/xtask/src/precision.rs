//! `cargo xtask precision`: how many findings on real programs are right, in `docs/precision.md`.
//!
//! Knows: the JSON of `gcheck check`, how a sample is drawn, the table of verdicts (`tests/precision.tsv`). Must not know: any
//! rule or control, or what a verdict should be: a person reads each finding beside its program.
//!
//! The sample is stratified: of each rule, severity and control, a fixed number of findings or all there are, in the order
//! of a hash of their fingerprints. A finding that stays where it is stays in the sample, and keeps its verdict.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::process::ExitCode;

use anyhow::{Context as _, bail, ensure};
use gcheck_testkit::blind::{self, Draw};
use gcheck_testkit::corpus;
use serde_json::Value;

use crate::{binary, workspace};

const PAGE: &str = "docs/precision.md";
const TABLE: &str = "tests/precision.tsv";
const HEAD: &str = "program\tline\trule\tseverity\tcontrol\tfingerprint\tverdict\treason\n";

/// Findings of a stratum that are read at least, where there are so many.
const AT_LEAST: usize = 6;
/// One in so many of a large stratum is read.
const ONE_IN: usize = 20;
/// Turns the same findings into another sample.
const SEED: &str = "2026";

/// One finding, as the sample needs it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Found {
    stratum: Stratum,
    program: String,
    line: u64,
    fingerprint: String,
}

/// What findings are drawn from.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Stratum {
    severity: String,
    rule: String,
    control: String,
}

/// What a reader said of a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Verdict {
    is: Is,
    reason: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Is {
    True,
    False,
    Unsure,
}

impl Is {
    fn parse(word: &str) -> Option<Self> {
        match word {
            "true" => Some(Self::True),
            "false" => Some(Self::False),
            "unsure" => Some(Self::Unsure),
            _ => None,
        }
    }
}

impl Verdict {
    /// The file is not a program of the control: a script, a listing, a program of another control.
    fn is_of_no_program(&self) -> bool {
        self.reason.starts_with("no program of this control")
    }
}

/// Findings of one control.
#[derive(Debug, Clone, Default)]
struct Counts {
    programs: usize,
    lines: u64,
    by_severity: BTreeMap<String, u64>,
}

/// Checks the corpus, draws the sample, matches the verdicts, writes the page and the table.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    if !arguments.is_empty() {
        bail!("precision takes no arguments; the folder comes from GCHECK_CORPUS");
    }
    let folder = corpus::folder().context("GCHECK_CORPUS does not name the folder of the corpus")?;
    let data = workspace::root().join("crates/gcheck-controls/data");
    let mut programs = corpus::programs().context("the corpus has no index")?;
    programs.retain(|p| data.join(&p.control).join("control.toml").exists());
    programs.sort_by(|a, b| a.name.cmp(&b.name));

    let gcheck = binary::build(false)?;

    let mut counts: BTreeMap<String, Counts> = BTreeMap::new();
    let mut found = Vec::new();
    let controls: BTreeSet<&str> = programs.iter().map(|p| p.control.as_str()).collect();
    for control in controls {
        let paths: Vec<&str> =
            programs.iter().filter(|p| p.control == control).map(|p| p.name.as_str()).collect();
        let output = binary::check(&gcheck, &folder, &["--isolated", "--control", control], &paths)?;
        let report: Value = serde_json::from_slice(&output.stdout).context("the output is not JSON")?;
        let of_control = read(&report, control);
        let mut count = Counts {
            programs: paths.len(),
            lines: report.pointer("/summary/lines").and_then(Value::as_u64).unwrap_or(0),
            ..Counts::default()
        };
        for one in &of_control {
            *count.by_severity.entry(one.stratum.severity.clone()).or_default() += 1;
        }
        counts.insert(control.to_owned(), count);
        found.extend(of_control);
    }
    found.retain(|one| matches!(one.stratum.severity.as_str(), "error" | "warning"));

    let table = workspace::root().join(TABLE);
    let verdicts = verdicts(&fs::read_to_string(&table).unwrap_or_else(|_| HEAD.to_owned()))?;
    let sizes = found.iter().fold(BTreeMap::new(), |mut sizes: BTreeMap<&Stratum, u64>, one| {
        *sizes.entry(&one.stratum).or_default() += 1;
        sizes
    });
    let sample = sample(&found);
    fs::write(&table, write_table(&sample, &verdicts))?;
    let first_looks = blind::precision(&Draw::all(&blind::folder())?);
    let page = blind::with_section(&page(&counts, &sizes, &sample, &verdicts), &first_looks);
    fs::write(workspace::root().join(PAGE), page)?;
    let unread: Vec<&Found> = sample.iter().filter(|one| !verdicts.contains_key(&key(one))).collect();
    println!("wrote  {PAGE}\nwrote  {TABLE}");
    for one in &unread {
        let Stratum { severity, rule, .. } = &one.stratum;
        println!("unread {}:{}: {severity}[{rule}]", one.program, one.line);
    }
    Ok(if unread.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn read(report: &Value, control: &str) -> Vec<Found> {
    let findings = report.get("findings").and_then(Value::as_array).into_iter().flatten();
    let field =
        |finding: &Value, name: &str| finding.get(name).and_then(Value::as_str).unwrap_or("?").to_owned();
    findings
        .map(|finding| Found {
            stratum: Stratum {
                severity: field(finding, "severity"),
                rule: field(finding, "rule"),
                control: control.to_owned(),
            },
            program: field(finding, "file"),
            line: finding.pointer("/range/start/line").and_then(Value::as_u64).unwrap_or(0),
            fingerprint: field(finding, "fingerprint"),
        })
        .collect()
}

/// Of each stratum so many, in the order of a hash.
fn sample(found: &[Found]) -> Vec<Found> {
    let mut strata: BTreeMap<&Stratum, Vec<&Found>> = BTreeMap::new();
    for one in found {
        strata.entry(&one.stratum).or_default().push(one);
    }
    let mut sample = Vec::new();
    for (_, mut of_stratum) in strata {
        of_stratum.sort_by_key(|one| drawn(&one.fingerprint));
        let size = of_stratum.len();
        sample.extend(of_stratum.into_iter().take(AT_LEAST.max(size / ONE_IN)).cloned());
    }
    sample.sort_by(|a, b| (&a.program, a.line, &a.stratum).cmp(&(&b.program, b.line, &b.stratum)));
    sample
}

/// A number that depends on the fingerprint alone (FNV-1a).
fn drawn(fingerprint: &str) -> u64 {
    let bytes = SEED.bytes().chain([b':']).chain(fingerprint.bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// What a verdict is remembered by: the finding as it is recognised again, and how much was made of it.
fn key(one: &Found) -> (String, String) {
    (one.fingerprint.clone(), one.stratum.severity.clone())
}

fn verdicts(table: &str) -> anyhow::Result<BTreeMap<(String, String), Verdict>> {
    let mut verdicts = BTreeMap::new();
    for (number, line) in table.lines().enumerate().skip(1) {
        let [_, _, _, severity, _, fingerprint, verdict, reason] = line.split('\t').collect::<Vec<_>>()[..]
        else {
            bail!("{TABLE}:{}: eight columns are needed", number + 1);
        };
        if verdict.is_empty() {
            continue;
        }
        let is = Is::parse(verdict)
            .with_context(|| format!("{TABLE}:{}: `{verdict}` is not a verdict", number + 1))?;
        ensure!(!reason.is_empty(), "{TABLE}:{}: a verdict needs a reason", number + 1);
        let key = (fingerprint.to_owned(), severity.to_owned());
        verdicts.insert(key, Verdict { is, reason: reason.to_owned() });
    }
    Ok(verdicts)
}

fn write_table(sample: &[Found], verdicts: &BTreeMap<(String, String), Verdict>) -> String {
    let mut text = HEAD.to_owned();
    for one in sample {
        let (verdict, reason) = match verdicts.get(&key(one)) {
            Some(Verdict { is: Is::True, reason }) => ("true", reason.as_str()),
            Some(Verdict { is: Is::False, reason }) => ("false", reason.as_str()),
            Some(Verdict { is: Is::Unsure, reason }) => ("unsure", reason.as_str()),
            None => ("", ""),
        };
        let Stratum { severity, rule, control } = &one.stratum;
        let _ = writeln!(
            text,
            "{}\t{}\t{rule}\t{severity}\t{control}\t{}\t{verdict}\t{reason}",
            one.program, one.line, one.fingerprint
        );
    }
    text
}

/// Verdicts of a group of strata, and what they say of all findings of it.
#[derive(Debug, Clone, Default)]
struct Tally {
    findings: u64,
    read: u64,
    right: u64,
    wrong: u64,
    unsure: u64,
    /// Findings of the group that are wrong if the sample of each stratum speaks for it.
    expected_wrong: f64,
}

impl Tally {
    #[expect(clippy::cast_precision_loss, reason = "counts, far below 2^53")]
    fn add(&mut self, size: u64, verdicts: &[&Verdict]) {
        let count = |is: Is| verdicts.iter().filter(|verdict| verdict.is == is).count() as u64;
        let read = verdicts.len() as u64;
        self.findings += size;
        self.read += read;
        self.right += count(Is::True);
        self.wrong += count(Is::False);
        self.unsure += count(Is::Unsure);
        self.expected_wrong += size as f64 * count(Is::False) as f64 / read.max(1) as f64;
    }

    #[expect(clippy::cast_precision_loss, reason = "counts, far below 2^53")]
    fn share(&self) -> String {
        format!("{:.1} %", self.expected_wrong * 100.0 / self.findings.max(1) as f64)
    }

    fn cells(&self) -> String {
        let Self { findings, read, right, wrong, unsure, .. } = self;
        format!("{findings} | {read} | {right} | {wrong} | {unsure} | {}", self.share())
    }
}

fn page(
    counts: &BTreeMap<String, Counts>,
    sizes: &BTreeMap<&Stratum, u64>,
    sample: &[Found],
    verdicts: &BTreeMap<(String, String), Verdict>,
) -> String {
    let mut text = format!(
        "<!-- Written by `cargo xtask precision`; the verdicts are in `{TABLE}`. -->\n\n# How many findings are right\n\n"
    );
    text.push_str(
        "gcheck checks the real-program corpus (`GCHECK_CORPUS`; [dev/corpus.md](dev/corpus.md) says whose programs they are) with the rules that are on by default, each program for the control that the corpus guesses for it, and without a machine file.\n\
        Of the errors and warnings a sample was drawn and read by eye, beside the program, by a person who programs and runs such machines.\n\n\
        * *True*: the control refuses it, or does something else than what is meant, or the operator would want to know.\n\
        * *False*: the program is right there, or what is said of it is not so.\n\
        * *Unsure*: it hangs on a setting, a macro or an intention that the program does not show.\n\n\
        The sample is stratified: of each rule, severity and control six findings or one in twenty, in the order of a hash, or all there are.\n\
        The false share is the one of all findings, each stratum counted by its size.\n",
    );
    per_control(&mut text, counts);
    let mut by_stratum: BTreeMap<&Stratum, Vec<&Verdict>> = BTreeMap::new();
    let mut unread = 0;
    for one in sample {
        match verdicts.get(&key(one)) {
            Some(verdict) => by_stratum.entry(&one.stratum).or_default().push(verdict),
            None => unread += 1,
        }
    }
    let columns = "findings | read | true | false | unsure | false share |\n";
    let _ = write!(text, "\n## Verdicts\n\n| severity | {columns}|---|---|---|---|---|---|---|\n");
    for severity in ["error", "warning"] {
        let mut all = Tally::default();
        let mut programs = Tally::default();
        for (stratum, size) in sizes.iter().filter(|(stratum, _)| stratum.severity == severity) {
            let read = by_stratum.get(stratum).cloned().unwrap_or_default();
            all.add(*size, &read);
            let of_programs: Vec<&Verdict> =
                read.iter().copied().filter(|verdict| !verdict.is_of_no_program()).collect();
            // The share of a stratum that is in programs is the one of its sample.
            let size = (*size * of_programs.len() as u64).checked_div(read.len() as u64).unwrap_or(0);
            programs.add(size, &of_programs);
        }
        let _ = writeln!(text, "| {severity} | {} |", all.cells());
        let _ = writeln!(text, "| {severity}, in programs of the control | {} |", programs.cells());
    }
    text.push_str("\n*In programs of the control* leaves out findings in shell scripts, listings and programs of other controls that the corpus lists; how many findings those are is estimated from the sample.\n");
    if unread > 0 {
        let _ = writeln!(text, "\n{unread} findings of the sample are not read yet.");
    }

    let _ = write!(text, "\n## By rule\n\n| rule | severity | {columns}|---|---|---|---|---|---|---|---|\n");
    let mut by_rule: BTreeMap<(&str, &str), Tally> = BTreeMap::new();
    for (stratum, size) in sizes {
        let read = by_stratum.get(stratum).cloned().unwrap_or_default();
        by_rule.entry((&stratum.rule, &stratum.severity)).or_default().add(*size, &read);
    }
    for ((rule, severity), tally) in &by_rule {
        let _ = writeln!(text, "| [{rule}](rules/{rule}.md) | {severity} | {} |", tally.cells());
    }
    not_right(&mut text, sample, verdicts);
    text
}

fn per_control(text: &mut String, counts: &BTreeMap<String, Counts>) {
    text.push_str("\n## Findings for 1,000 lines\n\n| control | programs | lines | errors | warnings | infos | hints |\n|---|---|---|---|---|---|---|\n");
    for (control, count) in counts {
        let per =
            |severity: &str| per_thousand(count.by_severity.get(severity).copied().unwrap_or(0), count.lines);
        let _ = writeln!(
            text,
            "| `{control}` | {} | {} | {} | {} | {} | {} |",
            count.programs,
            count.lines,
            per("error"),
            per("warning"),
            per("info"),
            per("hint")
        );
    }
}

fn not_right(text: &mut String, sample: &[Found], verdicts: &BTreeMap<(String, String), Verdict>) {
    text.push_str("\n## What was not right, or not clear\n\n| finding | verdict | why |\n|---|---|---|\n");
    for one in sample {
        let Some(verdict) = verdicts.get(&key(one)) else { continue };
        let word = match verdict.is {
            Is::True => continue,
            Is::False => "false",
            Is::Unsure => "unsure",
        };
        let Stratum { severity, rule, .. } = &one.stratum;
        let _ = writeln!(
            text,
            "| {severity} `{rule}`, `{}` line {} | {word} | {} |",
            one.program, one.line, verdict.reason
        );
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts, far below 2^53")]
fn per_thousand(found: u64, lines: u64) -> String {
    format!("{:.2}", found as f64 * 1_000.0 / lines.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::{AT_LEAST, Found, HEAD, Stratum, page, sample, verdicts, write_table};

    fn found(rule: &str, number: usize) -> Found {
        Found {
            stratum: Stratum {
                severity: "error".to_owned(),
                rule: rule.to_owned(),
                control: "acme-mill".to_owned(),
            },
            program: "b/1.nc".to_owned(),
            line: number as u64,
            fingerprint: format!("{rule}{number}"),
        }
    }

    #[test]
    fn small_strata_are_read_whole_and_large_ones_in_part() {
        let mut all: Vec<Found> = (0..200).map(|number| found("feed-missing", number)).collect();
        all.push(found("feed-zero", 1));
        let drawn = sample(&all);
        assert_eq!(drawn.iter().filter(|one| one.stratum.rule == "feed-missing").count(), 10);
        assert_eq!(drawn.iter().filter(|one| one.stratum.rule == "feed-zero").count(), 1);
        const { assert!(AT_LEAST < 10) };
        // What is there already is drawn first again when findings are added elsewhere.
        all.push(found("arc-end-off-circle", 3));
        assert!(drawn.iter().all(|one| sample(&all).contains(one)));
    }

    #[test]
    fn verdicts_stay_with_their_findings() {
        let drawn = sample(&[found("feed-missing", 1), found("feed-missing", 2)]);
        let blank = write_table(&drawn, &BTreeMap::new());
        assert!(blank.starts_with(HEAD) && verdicts(&blank).unwrap().is_empty());
        let read = blank.replacen("feed-missing1\t\t", "feed-missing1\tfalse\tthe feed is given above", 1);
        let known = verdicts(&read).unwrap();
        assert_eq!(write_table(&drawn, &known), read);
        let sizes = BTreeMap::from([(&drawn[0].stratum, 2)]);
        let page = page(&BTreeMap::new(), &sizes, &drawn, &known);
        assert!(page.contains("| error | 2 | 1 | 0 | 1 | 0 | 100.0 % |"), "{page}");
        assert!(page.contains("1 findings of the sample are not read yet"), "{page}");
        assert!(verdicts(&read.replace("\tfalse\t", "\tmaybe\t")).is_err());
    }
}
