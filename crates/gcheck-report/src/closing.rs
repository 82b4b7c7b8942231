//! What a text output ends with: the summary line, the statistics table.
//!
//! Knows: sums in words. Must not know: single findings' places or texts.

use std::collections::BTreeMap;
use std::fmt::Write as _;

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

/// Findings per rule, the most frequent first: count, id, what the rule is about. Empty without findings.
pub fn statistics(report: &Report) -> String {
    let mut rules: BTreeMap<&str, (usize, &str)> = BTreeMap::new();
    let kept = report.findings().map(|(_, finding)| (finding.rule, 1));
    let omitted =
        report.files().iter().flat_map(|file| file.omitted.iter().map(|(rule, _, count)| (*rule, *count)));
    for (rule, count) in kept.chain(omitted) {
        rules.entry(rule.id).or_insert((0, rule.summary)).0 += count;
    }
    let mut rows: Vec<(usize, &str, &str)> =
        rules.into_iter().map(|(id, (n, about))| (n, id, about)).collect();
    rows.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(b.1)));
    let digits = rows.first().map_or(0, |(n, ..)| number(*n).len());
    let id_width = rows.iter().map(|(_, id, _)| id.len()).max().unwrap_or(0);
    let mut table = String::new();
    for (n, id, about) in rows {
        // Writing into a string does not fail.
        let _ = writeln!(table, "{:>digits$}  {id:<id_width$}  {about}", number(n));
    }
    table
}

/// `1 file`, `2 files`.
fn count(n: usize, one: &str, many: &str) -> String {
    format!("{} {}", number(n), if n == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{ARC_OFF_CIRCLE, FEED_MISSING, file};
    use expect_test::expect;
    use gcheck_diagnostics::Finding;

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
        assert_eq!(
            line(Summary { files: 1, lines: 1, ..Summary::default() }),
            "no findings in 1 file (1 line)"
        );
    }

    #[test]
    fn statistics_count_by_rule() {
        let findings = |n: usize, rule| (0..n).map(move |_| Finding::new(rule, 0..0, "m"));
        let report = Report::new(vec![
            file("a.nc", "", findings(3, &FEED_MISSING).collect()),
            file("b.nc", "", findings(1_200, &ARC_OFF_CIRCLE).chain(findings(4, &FEED_MISSING)).collect()),
        ]);
        expect![[r#"
            1,200  arc-end-off-circle  arc end point is not on the circle
                7  feed-missing        cutting move with no feed rate in effect
        "#]]
        .assert_eq(&statistics(&report));
        assert_eq!(statistics(&Report::new(vec![])), "");
    }
}
