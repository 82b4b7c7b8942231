//! Repeats of one rule in one file, told in one line.
//!
//! Knows: which findings of a file are shown one by one, and how the others are counted. Must not know: any format.

use std::collections::BTreeMap;

use gcheck_diagnostics::{Finding, Severity};

use crate::Report;
use crate::report::File;
use crate::shown::number;

/// Findings of one rule and severity that a file shows one by one; with more of them, the others are folded.
const SHOWN: usize = 5;

/// What a format for people tells next.
#[derive(Debug)]
pub(crate) enum Told<'r> {
    /// A finding.
    One(&'r Finding),
    /// The findings that repeat the last ones of this rule.
    Fold(Fold<'r>),
}

/// Findings of one rule and severity after those that are shown.
#[derive(Debug)]
pub(crate) struct Fold<'r> {
    /// The first of them.
    pub(crate) first: &'r Finding,
    /// `… and 1,193 more`
    pub(crate) count: String,
    /// `lines 40 to 1,240`
    pub(crate) lines: String,
}

impl Fold<'_> {
    /// `… and 1,193 more, lines 40 to 1,240`
    pub(crate) fn words(&self) -> String {
        format!("{}, {}", self.count, self.lines)
    }
}

/// The findings of a file as they are told, in order; a fold is where the first of its findings would be.
pub(crate) fn told<'r>(report: &Report, file: &'r File) -> Vec<Told<'r>> {
    if !report.folds() || file.findings.len() <= SHOWN {
        return file.findings.iter().map(Told::One).collect();
    }
    let mut repeats: BTreeMap<(&str, Severity), Vec<&Finding>> = BTreeMap::new();
    for finding in &file.findings {
        repeats.entry((finding.rule.id, finding.severity)).or_default().push(finding);
    }
    let mut told = Vec::new();
    let mut seen: BTreeMap<(&str, Severity), usize> = BTreeMap::new();
    for finding in &file.findings {
        let key = (finding.rule.id, finding.severity);
        let count = seen.entry(key).or_default();
        *count += 1;
        if *count <= SHOWN {
            told.push(Told::One(finding));
        } else if *count == SHOWN + 1 {
            let folded = repeats.get(&key).and_then(|all| all.get(SHOWN..)).unwrap_or_default();
            told.push(Told::Fold(fold(file, finding, folded, key)));
        }
    }
    told
}

/// Findings that folds hide from people.
pub fn folded(report: &Report) -> usize {
    if report.folds() { report.files().iter().map(hidden).sum() } else { 0 }
}

fn hidden(file: &File) -> usize {
    let mut repeats: BTreeMap<(&str, Severity), usize> = BTreeMap::new();
    for finding in &file.findings {
        *repeats.entry((finding.rule.id, finding.severity)).or_default() += 1;
    }
    repeats.values().map(|count| count.saturating_sub(SHOWN)).sum()
}

fn fold<'r>(
    file: &File,
    first: &'r Finding,
    folded: &[&Finding],
    (rule, severity): (&str, Severity),
) -> Fold<'r> {
    // What was counted and not kept comes after what was kept.
    let omitted = file.omitted.iter().filter(|(of, level, _)| of.id == rule && *level == severity);
    let omitted: usize = omitted.map(|(.., count)| count).sum();
    let line = |finding: &&Finding| file.source.position(finding.range.start).line as usize;
    let from = line(&first);
    let to = folded.last().map_or(from, line);
    let lines = match () {
        () if omitted > 0 => format!("from line {} on", number(from)),
        () if to == from => format!("line {}", number(from)),
        () => format!("lines {} to {}", number(from), number(to)),
    };
    Fold { first, count: format!("… and {} more", number(folded.len() + omitted)), lines }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_diagnostics::{Finding, Severity};

    use super::folded;
    use crate::testing::{ARC_OFF_CIRCLE, FEED_MISSING, file, render};
    use crate::{Format, Report};

    /// A line for each finding, and what the first finding of each line says.
    fn every_line(lines: usize) -> (String, Vec<Finding>) {
        let text = "G1\n".repeat(lines);
        let at = |line: usize| (line * 3) as u32..(line * 3 + 2) as u32;
        (text, (0..lines).map(|line| Finding::new(&FEED_MISSING, at(line), "no feed")).collect())
    }

    #[test]
    fn five_are_shown_and_the_others_counted() {
        let (text, findings) = every_line(1_200);
        let report = Report::new(vec![file("part.nc", &text, findings)]).folded();
        expect![[r#"
            part.nc:1:1: error[feed-missing] no feed
            part.nc:2:1: error[feed-missing] no feed
            part.nc:3:1: error[feed-missing] no feed
            part.nc:4:1: error[feed-missing] no feed
            part.nc:5:1: error[feed-missing] no feed
            part.nc:6:1: error[feed-missing] … and 1,195 more, lines 6 to 1,200
        "#]]
        .assert_eq(&render(&report, Format::Concise));
        expect![[r#"
            part.nc
              1:1  error    feed-missing  no feed
              2:1  error    feed-missing  no feed
              3:1  error    feed-missing  no feed
              4:1  error    feed-missing  no feed
              5:1  error    feed-missing  no feed
              6:1  error    feed-missing  … and 1,195 more, lines 6 to 1,200
        "#]]
        .assert_eq(&render(&report, Format::Grouped));
        let full = render(&report, Format::Full);
        assert_eq!(full.matches("error[feed-missing]: no feed\n").count(), 5);
        assert!(
            full.ends_with("error[feed-missing]: … and 1,195 more in part.nc, lines 6 to 1,200\n\n"),
            "{full}"
        );
        assert_eq!(folded(&report), 1_195);
    }

    #[test]
    fn formats_for_programs_stay_whole() {
        for format in Format::ALL.into_iter().filter(|format| !format.is_for_people()) {
            let (text, findings) = every_line(12);
            let whole = Report::new(vec![file("part.nc", &text, findings.clone())]);
            let folded = Report::new(vec![file("part.nc", &text, findings)]).folded();
            assert_eq!(render(&folded, format), render(&whole, format), "{}", format.name());
        }
    }

    #[test]
    fn five_are_not_folded_and_rules_and_severities_are_counted_apart() {
        let (text, mut findings) = every_line(8);
        for finding in &mut findings[5..] {
            finding.severity = Severity::Warning;
        }
        findings.push(Finding::new(&ARC_OFF_CIRCLE, 0..2, "arc"));
        let report = Report::new(vec![file("part.nc", &text, findings)]).folded();
        let told = render(&report, Format::Concise);
        assert!(!told.contains('…') && told.lines().count() == 9, "{told}");
        assert_eq!(folded(&report), 0);
    }

    #[test]
    fn a_fold_is_where_its_first_finding_is() {
        let (text, mut findings) = every_line(7);
        findings.remove(5);
        findings.push(Finding::new(&ARC_OFF_CIRCLE, 15..17, "arc"));
        let report = Report::new(vec![file("part.nc", &text, findings)]).folded();
        let told = render(&report, Format::Concise);
        expect![[r#"
            part.nc:6:1: warning[arc-end-off-circle] arc
            part.nc:7:1: error[feed-missing] … and 1 more, line 7
        "#]]
        .assert_eq(&told.split_inclusive('\n').skip(5).collect::<String>());
    }

    #[test]
    fn findings_that_were_not_kept_are_in_the_count() {
        let (text, findings) = every_line(6);
        let mut part = file("part.nc", &text, findings);
        part.omitted = vec![(&FEED_MISSING, Severity::Error, 100), (&FEED_MISSING, Severity::Info, 7)];
        let told = render(&Report::new(vec![part]).folded(), Format::Concise);
        assert!(told.ends_with("error[feed-missing] … and 101 more, from line 6 on\n"), "{told}");
    }
}
