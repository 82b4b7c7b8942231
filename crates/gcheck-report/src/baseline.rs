//! Findings that were there before: a project takes up gcheck without fixing all its old programs first.
//!
//! Knows: the form of a baseline, how findings are recognised in it. Must not know: files on disk, the current folder.
//!
//! A baseline has a line for each finding, sorted, so that version control merges it and a review shows what came and went.
//! It holds fingerprints and neither wording nor severity nor line numbers, and survives changes of these.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use gcheck_diagnostics::{Finding, RuleMeta};
use serde::{Deserialize, Serialize};

use crate::{FileReport, Fingerprint, Fingerprinter};

/// Version of the form.
const VERSION: u32 = 1;

/// Known findings.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Baseline {
    files: BTreeMap<String, Known>,
}

/// The known findings of a file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
struct Known {
    /// With the rule under which it was known then.
    findings: BTreeMap<Fingerprint, String>,
    /// Findings that were counted and not kept, by rule.
    omitted: BTreeMap<String, usize>,
}

/// An entry that no finding answers to any more.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct StaleEntry {
    /// The file, as the baseline calls it.
    pub file: String,
    /// The rule, as it was called then.
    pub rule: String,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    version: u32,
    findings: Vec<Entry>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    file: String,
    rule: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    fingerprint: Option<String>,
    /// In place of a fingerprint: so many of the rule's findings were not kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    omitted: Option<usize>,
}

/// Why a text is not a baseline.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Malformed {
    /// One sentence without an end.
    pub reason: String,
    /// Line of the text, from 1.
    pub line: usize,
    /// What to do about it.
    pub help: &'static str,
}

/// Does the text begin as every baseline does? Nobody is told to delete anything else.
fn is_ours(text: &str) -> bool {
    let inside = text.trim_start().strip_prefix('{').map(str::trim_start);
    inside.is_some_and(|inside| inside.starts_with("\"version\""))
}

const WRITE_ANEW: &str = "delete it, and `--update-baseline` writes it again";

impl Baseline {
    /// Reads a baseline.
    ///
    /// # Errors
    /// When the text is none, or comes from a later version.
    pub fn parse(text: &str) -> Result<Self, Malformed> {
        // Version control leaves its marks in the first column, where no line of ours has any.
        let is_mark =
            |line: &str| ["<<<<<<<", "=======", ">>>>>>>"].iter().any(|mark| line.starts_with(mark));
        if let Some(at) = text.lines().position(is_mark) {
            return Err(Malformed {
                reason: "a merge left conflict marks".to_owned(),
                line: at + 1,
                help: "keep the entries of both sides and delete the marks",
            });
        }
        if !is_ours(text) {
            return Err(Malformed {
                reason: "this is not a baseline that gcheck wrote".to_owned(),
                line: 1,
                help: "name another file; `--update-baseline` writes a new one",
            });
        }
        let form: Form = serde_json::from_str(text).map_err(|error| Malformed {
            reason: format!("is not a baseline: {}", reason(&error)),
            line: error.line().max(1),
            help: WRITE_ANEW,
        })?;
        if form.version != VERSION {
            return Err(Malformed {
                reason: format!("is of version {}; this gcheck reads version {VERSION}", form.version),
                line: 1,
                help: "use the gcheck that wrote it, or delete it and write it again with `--update-baseline`",
            });
        }
        let mut baseline = Self::default();
        for (index, entry) in form.findings.into_iter().enumerate() {
            let known = baseline.files.entry(entry.file).or_default();
            match (entry.fingerprint, entry.omitted) {
                (Some(digits), None) => {
                    let fingerprint = Fingerprint::parse(&digits).ok_or_else(|| Malformed {
                        reason: format!("entry {} has no fingerprint but `{digits}`", index + 1),
                        line: 1 + text.lines().position(|line| line.contains(&digits)).unwrap_or(0),
                        help: WRITE_ANEW,
                    })?;
                    known.findings.insert(fingerprint, entry.rule);
                }
                (None, Some(count)) => {
                    // A baseline of strangers may hold any numbers.
                    let sum = known.omitted.entry(entry.rule).or_default();
                    *sum = sum.saturating_add(count);
                }
                _ => {
                    return Err(Malformed {
                        reason: format!("entry {} has neither a fingerprint nor a count alone", index + 1),
                        line: 1,
                        help: WRITE_ANEW,
                    });
                }
            }
        }
        Ok(baseline)
    }

    /// The text of the baseline: the same for the same findings, wherever they came from.
    pub fn to_text(&self) -> String {
        let mut lines = BTreeSet::new();
        for (file, known) in &self.files {
            let entry = |rule: &str| Entry {
                file: file.clone(),
                rule: rule.to_owned(),
                fingerprint: None,
                omitted: None,
            };
            for (fingerprint, rule) in &known.findings {
                let fingerprint = fingerprint.to_string();
                let line = json(&Entry { fingerprint: Some(fingerprint.clone()), ..entry(rule) });
                lines.insert((file, rule, Some(fingerprint), line));
            }
            for (rule, count) in &known.omitted {
                lines.insert((file, rule, None, json(&Entry { omitted: Some(*count), ..entry(rule) })));
            }
        }
        let mut text = format!("{{\n\"version\": {VERSION},\n\"findings\": [");
        for (index, (.., line)) in lines.iter().enumerate() {
            let _ = write!(text, "{}\n  {line}", if index > 0 { "," } else { "" });
        }
        text.push_str(if lines.is_empty() { "]\n}\n" } else { "\n]\n}\n" });
        text
    }

    /// Takes the known findings out of a report and counts them there; gives the entries that found nothing. `file` is what
    /// the baseline calls the file.
    pub fn apply(&self, file: &str, report: &mut FileReport) -> Vec<StaleEntry> {
        let Some(known) = self.files.get(file) else { return Vec::new() };
        let mut left = known.clone();
        let text = std::sync::Arc::clone(&report.text);
        let prints = fingerprints(file, text.text(), &mut report.findings);
        let mut prints = prints.into_iter();
        report.findings.retain(|_| {
            let is_known = prints
                .next()
                .is_some_and(|names| names.into_iter().any(|print| left.findings.remove(&print).is_some()));
            report.baseline += usize::from(is_known);
            !is_known
        });
        for (rule, _, count) in &mut report.omitted {
            for name in names(rule) {
                if let Some(known) = left.omitted.get_mut(name) {
                    let taken = (*known).min(*count);
                    (*known, *count) = (*known - taken, *count - taken);
                    report.baseline += taken;
                }
            }
        }
        report.omitted.retain(|(_, _, count)| *count > 0);
        let stale = |rule: &String| StaleEntry { file: file.to_owned(), rule: rule.clone() };
        let of_findings = left.findings.values().map(stale);
        let of_omitted = left.omitted.iter().filter(|(_, count)| **count > 0).map(|(rule, _)| stale(rule));
        of_findings.chain(of_omitted).collect()
    }

    /// Makes the findings of a report known, and those that the file had before forgotten.
    pub fn record(&mut self, file: &str, report: &mut FileReport) {
        let text = std::sync::Arc::clone(&report.text);
        let mut fingerprinter = Fingerprinter::new(file, text.text());
        sort(&mut report.findings);
        let mut known = Known::default();
        for finding in &report.findings {
            let fingerprint = fingerprinter.next(finding.rule.id, finding.range.start);
            known.findings.insert(fingerprint, finding.rule.id.to_owned());
        }
        for (rule, _, count) in &report.omitted {
            let sum = known.omitted.entry(rule.id.to_owned()).or_default();
            *sum = sum.saturating_add(*count);
        }
        if known == Known::default() {
            self.files.remove(file);
        } else {
            self.files.insert(file.to_owned(), known);
        }
    }

    /// Forgets every file for which `gone` holds: those that are not there any more.
    pub fn forget(&mut self, gone: impl Fn(&str) -> bool) {
        self.files.retain(|file, _| !gone(file));
    }

    /// The files that it knows findings of.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// How many findings it knows.
    pub fn len(&self) -> usize {
        let counts = self
            .files
            .values()
            .flat_map(|known| std::iter::once(known.findings.len()).chain(known.omitted.values().copied()));
        counts.fold(0, usize::saturating_add)
    }

    /// Whether it knows none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The entries of a file, all of them stale.
    pub fn entries_of(&self, file: &str) -> Vec<StaleEntry> {
        let Some(known) = self.files.get(file) else { return Vec::new() };
        let rules = known.findings.values().chain(known.omitted.keys());
        rules.map(|rule| StaleEntry { file: file.to_owned(), rule: rule.clone() }).collect()
    }
}

/// What a rule is called, and what it was called.
fn names(rule: &'static RuleMeta) -> impl Iterator<Item = &'static str> {
    std::iter::once(rule.id).chain(rule.aliases.iter().copied())
}

/// The fingerprints of each finding, one for each name that its rule ever had; sorts the findings.
fn fingerprints(file: &str, text: &str, findings: &mut [Finding]) -> Vec<Vec<Fingerprint>> {
    sort(findings);
    // Findings are counted by the name of their rule, so each name is asked for by itself.
    let mut now = Fingerprinter::new(file, text);
    let mut former: BTreeMap<&str, Fingerprinter<'_>> = BTreeMap::new();
    findings
        .iter()
        .map(|finding| {
            let start = finding.range.start;
            let mut prints = vec![now.next(finding.rule.id, start)];
            for alias in finding.rule.aliases {
                let fingerprinter = former.entry(alias).or_insert_with(|| Fingerprinter::new(file, text));
                prints.push(fingerprinter.next(alias, start));
            }
            prints
        })
        .collect()
}

/// The order in which findings are counted on equal lines.
fn sort(findings: &mut [Finding]) {
    findings.sort_by(crate::report::order);
}

/// What serde says, without its place.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.split(" at line ").next().unwrap_or(&text).to_owned()
}

fn json(entry: &Entry) -> String {
    // A struct of strings and numbers: there is nothing that JSON could refuse.
    serde_json::to_string(entry).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{Baseline, Malformed, StaleEntry};
    use crate::FileReport;
    use crate::testing::{ARC_OFF_CIRCLE, FEED_MISSING, file, on};
    use gcheck_diagnostics::{Finding, Severity};

    fn on_lines(text: &str) -> FileReport {
        let starts = text.match_indices("G1").map(|(at, _)| at as u32);
        file("part.nc", text, starts.map(|at| Finding::new(&FEED_MISSING, at..at + 2, "m")).collect())
    }

    fn known(mut report: FileReport) -> Baseline {
        let mut baseline = Baseline::default();
        baseline.record("part.nc", &mut report);
        baseline
    }

    fn left(baseline: &Baseline, mut report: FileReport) -> (usize, usize, usize) {
        let stale = baseline.apply("part.nc", &mut report);
        (report.findings.len(), report.baseline, stale.len())
    }

    #[test]
    fn counts_of_any_size_are_read() {
        let entry = format!("{{\"file\":\"a\",\"rule\":\"r\",\"omitted\":{}}}", usize::MAX);
        let text = format!("{{\"version\":1,\"findings\":[{entry},{entry}]}}");
        assert_eq!(Baseline::parse(&text).unwrap().len(), usize::MAX);
    }

    #[test]
    fn what_is_known_is_counted_and_not_shown() {
        let baseline = known(on_lines("G1 X1.\nG1 X2.\n"));
        assert_eq!(left(&baseline, on_lines("G1 X1.\nG1 X2.\n")), (0, 2, 0));
        assert_eq!(
            left(&baseline, on_lines("(new)\nn10 g0\nN20 G1 X1.\nG1 X2.\n")),
            (0, 2, 0),
            "lines may move"
        );
        assert_eq!(left(&baseline, on_lines("G1 X1.\nG1 X2.\nG1 X3.\n")), (1, 2, 0), "what is new is shown");
        assert_eq!(left(&baseline, on_lines("G1 X1.\n")), (0, 1, 1), "what is fixed is stale");
        assert_eq!(left(&baseline, on_lines("G1 X9.\n")), (1, 0, 2));
    }

    #[test]
    fn equal_lines_are_counted() {
        let baseline = known(on_lines("G1 X1.\nG1 X1.\n"));
        assert_eq!(left(&baseline, on_lines("G1 X1.\nG1 X1.\nG1 X1.\n")), (1, 2, 0));
    }

    #[test]
    fn another_file_is_another_matter() {
        let baseline = known(on_lines("G1\n"));
        let mut other = on_lines("G1\n");
        assert_eq!(baseline.apply("other.nc", &mut other), []);
        assert_eq!(other.findings.len(), 1);
    }

    #[test]
    fn a_renamed_rule_keeps_its_entries() {
        // `feed-missing` was `no-feed`.
        let mut text = known(on_lines("G1\n")).to_text();
        let former = crate::Fingerprinter::new("part.nc", "G1\n").next("no-feed", 0);
        let now = crate::Fingerprinter::new("part.nc", "G1\n").next("feed-missing", 0);
        text = text.replace(&now.to_string(), &former.to_string()).replace("feed-missing", "no-feed");
        assert_eq!(left(&Baseline::parse(&text).unwrap(), on_lines("G1\n")), (0, 1, 0));
    }

    #[test]
    fn findings_that_were_not_kept_are_known_by_their_number() {
        let omitted = |count| {
            let mut report = on_lines("G1\n");
            report.omitted = vec![(&ARC_OFF_CIRCLE, Severity::Warning, count)];
            report
        };
        let baseline = Baseline::parse(&known(omitted(5)).to_text()).unwrap();
        let mut report = omitted(7);
        assert_eq!(baseline.apply("part.nc", &mut report), []);
        assert_eq!((report.omitted[0].2, report.baseline), (2, 6));
        let mut fewer = omitted(3);
        let stale = baseline.apply("part.nc", &mut fewer);
        assert_eq!(stale, [StaleEntry { file: "part.nc".to_owned(), rule: "arc-end-off-circle".to_owned() }]);
        assert!(fewer.omitted.is_empty());
    }

    #[test]
    fn the_form_is_a_promise() {
        let mut report = on_lines("G1 X1.\n");
        report.omitted = vec![(&ARC_OFF_CIRCLE, Severity::Warning, 2)];
        let baseline = known(report);
        let text = baseline.to_text();
        expect![[r#"
            {
            "version": 1,
            "findings": [
              {"file":"part.nc","rule":"arc-end-off-circle","omitted":2},
              {"file":"part.nc","rule":"feed-missing","fingerprint":"f7cfa82180c00dc3b9ecdc8b57c8debe"}
            ]
            }
        "#]]
        .assert_eq(&text);
        assert_eq!(Baseline::parse(&text).unwrap(), baseline);
        expect![[r#"
            {
            "version": 1,
            "findings": []
            }
        "#]]
        .assert_eq(&Baseline::default().to_text());
        assert!(Baseline::parse(&Baseline::default().to_text()).unwrap().is_empty());
    }

    #[test]
    fn entries_merged_twice_are_one() {
        let text = known(on_lines("G1\n")).to_text();
        let line = text.lines().nth(3).unwrap().to_owned();
        let twice = text.replace(&line, &format!("{line},\n{line}"));
        assert_eq!(Baseline::parse(&twice).unwrap(), known(on_lines("G1\n")));
    }

    #[test]
    fn a_damaged_baseline_says_where() {
        let why = |text: &str| {
            let Malformed { reason, line, help } = Baseline::parse(text).unwrap_err();
            format!("{line}: {reason} ({help})\n")
        };
        let good = known(on_lines("G1\n")).to_text();
        let mut all = why("");
        all += &why("%\nO2000\nG0 X1.\nM30\n%\n");
        all += &why(good.get(..good.len() / 2).unwrap());
        all += &why("{\"version\": 2, \"findings\": []}");
        all += &why(&good.replace("  {", "<<<<<<< ours\n  {"));
        all += &why(&good.replace("\"fingerprint\":\"", "\"fingerprint\":\"x"));
        all += &why(&good.replace("\"rule\"", "\"rul\""));
        all += &why("{\"version\": 1, \"findings\": [{\"file\": \"a\", \"rule\": \"r\"}]}");
        expect![[r#"
            1: this is not a baseline that gcheck wrote (name another file; `--update-baseline` writes a new one)
            1: this is not a baseline that gcheck wrote (name another file; `--update-baseline` writes a new one)
            4: is not a baseline: EOF while parsing a string (delete it, and `--update-baseline` writes it again)
            1: is of version 2; this gcheck reads version 1 (use the gcheck that wrote it, or delete it and write it again with `--update-baseline`)
            4: a merge left conflict marks (keep the entries of both sides and delete the marks)
            4: entry 1 has no fingerprint but `xd83bb959ae86b76009503b31cb70d96f` (delete it, and `--update-baseline` writes it again)
            4: is not a baseline: unknown field `rul`, expected one of `file`, `rule`, `fingerprint`, `omitted` (delete it, and `--update-baseline` writes it again)
            1: entry 1 has neither a fingerprint nor a count alone (delete it, and `--update-baseline` writes it again)
        "#]].assert_eq(&all);
    }

    #[test]
    fn findings_of_any_order_are_recorded_alike() {
        let text = "G1 X1.\nG1 X1.\n";
        let mut turned = on_lines(text);
        turned.findings.reverse();
        turned.findings.push(on(text, "X1."));
        let mut straight = on_lines(text);
        straight.findings.insert(0, on(text, "X1."));
        assert_eq!(known(turned).to_text(), known(straight).to_text());
    }
}
