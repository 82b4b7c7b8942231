//! What a text output ends with: the summary line; and the tables that count findings by rule and by file.
//!
//! Knows: sums in words and columns. Must not know: single findings' places or texts.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::iter;

use gcheck_diagnostics::Severity;

use crate::fold::of_files;
use crate::report::{InFold, is_fixable};
use crate::shown::{number, one_line};
use crate::{Report, Summary};

/// Files named when their analysis ended early.
const NAMED: usize = 3;

/// The sums in one line: `3 errors, 1 warning in 2 files (1,204 lines)`.
pub fn summary_line(summary: &Summary) -> String {
    let counts = [
        (summary.errors, "error", "errors"),
        (summary.warnings, "warning", "warnings"),
        (summary.infos, "info", "infos"),
        (summary.hints, "hint", "hints"),
    ];
    let counts: Vec<String> =
        counts.iter().filter(|(n, ..)| *n > 0).map(|(n, a, b)| count(*n, a, b)).collect();
    let found = if counts.is_empty() { "no findings".to_owned() } else { counts.join(", ") };
    let files = count(summary.files, "file", "files");
    let mut line = format!("{found} in {files} ({})", count(summary.lines, "line", "lines"));
    // A problem that is not one of a single file is told beside the findings.
    let unread: BTreeSet<&str> =
        summary.skipped.iter().map(|skipped| skipped.file.as_str()).filter(|file| !file.is_empty()).collect();
    if !unread.is_empty() {
        line = format!("{line}; {} could not be checked", count(unread.len(), "more file", "more files"));
    }

    if summary.omitted > 0 {
        line = format!("{line}; {} of them counted but not shown", number(summary.omitted));
    }
    let mut silent = Vec::new();
    if summary.fixed > 0 {
        silent.push(format!("{} fixed", number(summary.fixed)));
    }
    if summary.suppressed > 0 {
        silent.push(format!("{} suppressed", number(summary.suppressed)));
    }
    if summary.baseline > 0 {
        silent.push(format!("{} in the baseline", number(summary.baseline)));
    }
    if !silent.is_empty() {
        line = format!("{line}; {}", silent.join(", "));
    }
    if !summary.out_of_fuel.is_empty() {
        let mut names: Vec<String> =
            summary.out_of_fuel.iter().take(NAMED).map(|path| one_line(path).into_owned()).collect();
        let more = summary.out_of_fuel.len() - names.len();
        if more > 0 {
            names.push(format!("{} more", number(more)));
        }
        line = format!("{line}; analysis ended early, out of fuel: {}", names.join(", "));
    }
    if !summary.failed_rules.is_empty() {
        let mut names: Vec<String> = summary
            .failed_rules
            .iter()
            .take(NAMED)
            .map(|failed| format!("{} in {}", failed.rule, one_line(&failed.file)))
            .collect();
        let more = summary.failed_rules.len() - names.len();
        if more > 0 {
            names.push(format!("{} more", number(more)));
        }
        line = format!(
            "{line}; failed by a mistake in gcheck, their findings are missing: {}",
            names.join(", ")
        );
    }
    line
}

/// Assumptions shown when one file was checked.
const SHOWN: usize = 12;

/// What the verdicts rest on and a configuration could settle, a line each; of many files only how many there are.
/// Empty when there is nothing of the kind. What no configuration can settle (the modes at power-on) is in the JSON
/// output only.
pub fn assumptions(summary: &Summary) -> String {
    let all: Vec<_> = summary.assumptions.iter().filter(|assumed| assumed.pin.is_some()).collect();
    if all.is_empty() {
        return String::new();
    }
    let mut text = String::new();
    if summary.files > 1 {
        let these = count(all.len(), "assumption", "assumptions");
        let _ = writeln!(
            text,
            "the verdicts rest on {these} about the machines; `--output-format json` lists them"
        );
        return text;
    }
    let _ = writeln!(text, "the verdict assumes:");
    for assumed in all.iter().take(SHOWN) {
        let _ = match &assumed.pin {
            Some(pin) => writeln!(text, "  {}; to settle it: {pin}", assumed.text),
            None => writeln!(text, "  {}", assumed.text),
        };
    }
    if all.len() > SHOWN {
        let _ = writeln!(text, "  and {} more", number(all.len() - SHOWN));
    }
    text
}

/// What is counted of a rule at a severity.
#[derive(Default)]
struct RuleCount {
    about: &'static str,
    findings: usize,
    files: usize,
    fixable: usize,
}

/// Findings by rule and severity, the most frequent first: how many, in how many files, how many have a fix that changes
/// no move (of those that are kept), and what the rule is about. Empty without findings.
pub fn statistics(report: &Report) -> String {
    let mut counts: BTreeMap<(&str, Severity), RuleCount> = BTreeMap::new();
    for file in report.files() {
        let kept = file.findings.iter().map(|f| (f.rule, f.severity, 1, usize::from(is_fixable(f))));
        let omitted = file.omitted.iter().map(|(rule, severity, count)| (*rule, *severity, *count, 0));
        let mut seen = BTreeSet::new();
        for (rule, severity, findings, fixable) in kept.chain(omitted) {
            let key = (rule.id, severity);
            let count = counts.entry(key).or_default();
            count.about = rule.summary;
            count.findings += findings;
            count.fixable += fixable;
            count.files += usize::from(seen.insert(key));
        }
    }
    let mut rows: Vec<((&str, Severity), RuleCount)> = counts.into_iter().collect();
    rows.sort_by(|(a, x), (b, y)| y.findings.cmp(&x.findings).then_with(|| a.cmp(b)));
    let cells = rows.into_iter().map(|((rule, severity), count)| {
        let fixable = if count.fixable > 0 { number(count.fixable) } else { String::new() };
        [
            number(count.findings),
            number(count.files),
            fixable,
            severity.name().to_owned(),
            rule.to_owned(),
            count.about.to_owned(),
        ]
    });
    table(["findings", "files", "fixable", "severity", "rule", ""], 3, cells)
}

/// Findings by file, those with the worst first: how many of each severity. Files without findings are left out.
pub fn file_counts(report: &Report) -> String {
    let mut rows: Vec<([usize; 4], &str)> = Vec::new();
    let mut folds: Vec<[String; 5]> = Vec::new();
    for file in report.files() {
        match (&file.in_fold, file.findings.as_slice()) {
            (InFold::Hidden, _) => continue,
            (InFold::First(count), [finding]) => {
                let of = |severity| if finding.severity == severity { number(*count) } else { number(0) };
                let [errors, warnings, infos, hints] =
                    [Severity::Error, Severity::Warning, Severity::Info, Severity::Hint].map(of);
                folds.push([
                    errors,
                    warnings,
                    infos,
                    hints,
                    one_line(&of_files(*count, finding)).into_owned(),
                ]);
                continue;
            }
            _ => {}
        }
        let mut row = [0; 4];
        let kept = file.findings.iter().map(|finding| (finding.severity, 1));
        let omitted = file.omitted.iter().map(|(_, severity, count)| (*severity, *count));
        for (severity, count) in kept.chain(omitted) {
            let [errors, warnings, infos, hints] = &mut row;
            *match severity {
                Severity::Error => errors,
                Severity::Warning => warnings,
                Severity::Info => infos,
                Severity::Hint => hints,
            } += count;
        }
        if row != [0; 4] {
            rows.push((row, &file.path));
        }
    }
    rows.sort_by(|(a, x), (b, y)| b.cmp(a).then_with(|| x.cmp(y)));
    let cells = rows.into_iter().map(|([errors, warnings, infos, hints], path)| {
        [number(errors), number(warnings), number(infos), number(hints), one_line(path).into_owned()]
    });
    table(["errors", "warnings", "infos", "hints", "file"], 4, cells.chain(folds))
}

/// Columns as wide as their cells, the first `numbers` of them to the right; empty without rows.
fn table<const N: usize>(head: [&str; N], numbers: usize, rows: impl Iterator<Item = [String; N]>) -> String {
    let rows: Vec<[String; N]> = rows.collect();
    if rows.is_empty() {
        return String::new();
    }
    let lines: Vec<[String; N]> = iter::once(head.map(str::to_owned)).chain(rows).collect();
    let mut text = String::new();
    for line in &lines {
        let mut drawn = String::new();
        for (column, cell) in line.iter().enumerate() {
            let width = lines
                .iter()
                .filter_map(|line| line.get(column))
                .map(|c| c.chars().count())
                .max()
                .unwrap_or(0);
            let gap = if column == 0 { "" } else { "  " };
            // Writing into a string does not fail.
            let _ = if column < numbers {
                write!(drawn, "{gap}{cell:>width$}")
            } else {
                write!(drawn, "{gap}{cell:<width$}")
            };
        }
        text.push_str(drawn.trim_end());
        text.push('\n');
    }
    text
}

/// `1 file`, `2 files`.
fn count(n: usize, one: &str, many: &str) -> String {
    format!("{} {}", number(n), if n == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{ARC_OFF_CIRCLE, FEED_MISSING, file};
    use crate::{FailedRule, Skipped};
    use expect_test::expect;
    use gcheck_diagnostics::{Finding, Fix};

    #[test]
    fn summaries() {
        let line = |summary: Summary| summary_line(&summary);
        let nothing = Summary { files: 2, lines: 1_204, ..Summary::default() };
        assert_eq!(line(nothing.clone()), "no findings in 2 files (1,204 lines)");
        let some = Summary { errors: 3, warnings: 1, ..nothing };
        assert_eq!(line(some.clone()), "3 errors, 1 warning in 2 files (1,204 lines)");
        let all = Summary { infos: 2, hints: 1, suppressed: 4, baseline: 1_000, ..some.clone() };
        assert_eq!(
            line(all),
            "3 errors, 1 warning, 2 infos, 1 hint in 2 files (1,204 lines); 4 suppressed, 1,000 in the baseline"
        );
        let fuel = Summary { out_of_fuel: ["a", "b", "c", "d"].map(str::to_owned).to_vec(), ..some };
        assert_eq!(
            line(fuel),
            "3 errors, 1 warning in 2 files (1,204 lines); analysis ended early, out of fuel: a, b, c, 1 more"
        );
        let skipped = |file: &str| Skipped { file: file.to_owned(), reason: "is a pipe".to_owned() };
        let unread = Summary { files: 2, lines: 5, ..Summary::default() };
        assert_eq!(
            line(Summary { skipped: vec![skipped("a.nc"), skipped("b.nc"), skipped("")], ..unread }),
            "no findings in 2 files (5 lines); 2 more files could not be checked"
        );
        let failed = FailedRule { file: "a.nc".to_owned(), rule: "feed-missing" };
        assert_eq!(
            line(Summary { files: 1, lines: 1, failed_rules: vec![failed], ..Summary::default() }),
            "no findings in 1 file (1 line); failed by a mistake in gcheck, their findings are missing: feed-missing in a.nc"
        );
        assert_eq!(
            line(Summary { files: 1, lines: 1, ..Summary::default() }),
            "no findings in 1 file (1 line)"
        );
    }

    #[test]
    fn a_rule_that_failed_is_named_and_leaves_more_to_find() {
        let mut one = file("a.nc", "G1\n", vec![]);
        one.failed_rules = vec!["feed-missing"];
        let report = Report::new(vec![one]);
        assert!(report.is_incomplete());
        let json = serde_json::to_value(report.summary()).unwrap();
        assert_eq!(json["failed_rules"], serde_json::json!([{ "file": "a.nc", "rule": "feed-missing" }]));
    }

    fn two_files() -> Report {
        let findings = |n: usize, rule| (0..n).map(move |_| Finding::new(rule, 0..0, "m"));
        let mut fixable = Finding::new(&FEED_MISSING, 0..0, "m");
        fixable.fixes.push(Fix::safe("write the feed", 0..0, "F1."));
        fixable.severity = Severity::Info;
        let mut many = file("b.nc", "", findings(1_200, &ARC_OFF_CIRCLE).chain([fixable]).collect());
        many.omitted = vec![(&ARC_OFF_CIRCLE, Severity::Warning, 34)];
        Report::new(vec![
            file("a.nc", "", findings(3, &FEED_MISSING).collect()),
            file("c.nc", "", vec![]),
            many,
        ])
    }

    #[test]
    fn statistics_count_by_rule_and_severity() {
        expect![[r#"
            findings  files  fixable  severity  rule
               1,234      1           warning   arc-end-off-circle  arc end point is not on the circle
                   3      1           error     feed-missing        cutting move with no feed rate in effect
                   1      1        1  info      feed-missing        cutting move with no feed rate in effect
        "#]]
        .assert_eq(&statistics(&two_files()));
        assert_eq!(statistics(&Report::new(vec![])), "");
    }

    #[test]
    fn files_are_counted_with_the_worst_first() {
        expect![[r#"
            errors  warnings  infos  hints  file
                 3         0      0      0  a.nc
                 0     1,234      1      0  b.nc
        "#]]
        .assert_eq(&file_counts(&two_files()));
        assert_eq!(file_counts(&Report::new(vec![file("c.nc", "", vec![])])), "");
    }
}
