//! Repeats of one rule in one file, told in one line.
//!
//! Knows: which findings of a file are shown one by one, and how the others are counted. Must not know: any format.

use gcheck_diagnostics::{self as diagnostics, Finding, fold_repeats};

use crate::Report;
use crate::report::{File, InFold};
use crate::shown::number;

/// What a format for people tells next.
#[derive(Debug)]
pub(crate) enum Told<'r> {
    /// A finding.
    One(&'r Finding),
    /// The findings that repeat the last ones of this rule.
    Fold(Fold<'r>),
    /// The finding of this file and of others, in the words that stand for all of them.
    Files(&'r Finding, String),
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
    match (&file.in_fold, file.findings.as_slice()) {
        (InFold::Hidden, _) => return Vec::new(),
        (InFold::First(count), [finding]) => return vec![Told::Files(finding, of_files(*count, finding))],
        _ => {}
    }
    if !report.folds() {
        return file.findings.iter().map(Told::One).collect();
    }
    let told = fold_repeats(&file.findings, |_| false).into_iter();
    told.filter_map(|told| {
        Some(match told {
            diagnostics::Told::One(finding) => Told::One(finding),
            diagnostics::Told::Repeats(repeats) => Told::Fold(fold(file, &repeats)?),
        })
    })
    .collect()
}

/// `… and 19,995 more files: the file is for a 3-D printer, which gcheck does not read`
pub(crate) fn of_files(count: usize, finding: &Finding) -> String {
    format!("… and {} more files: {}", number(count), finding.message)
}

/// Findings that folds hide from people.
pub fn folded(report: &Report) -> usize {
    let of_file = |file: &File| hidden(file) + usize::from(file.in_fold != InFold::Not);
    if report.folds() { report.files().iter().map(of_file).sum() } else { 0 }
}

fn hidden(file: &File) -> usize {
    let told = fold_repeats(&file.findings, |_| false).into_iter();
    told.map(|told| if let diagnostics::Told::Repeats(repeats) = told { repeats.len() } else { 0 }).sum()
}

fn fold<'r>(file: &File, repeats: &[&'r Finding]) -> Option<Fold<'r>> {
    let (first, last) = (*repeats.first()?, *repeats.last()?);
    // What was counted and not kept comes after what was kept.
    let omitted =
        file.omitted.iter().filter(|(of, level, _)| of.id == first.rule.id && *level == first.severity);
    let omitted: usize = omitted.map(|(.., count)| count).sum();
    let line = |finding: &Finding| file.source.position(finding.range.start).line as usize;
    let (from, to) = (line(first), line(last));
    let lines = match () {
        () if omitted > 0 => format!("from line {} on", number(from)),
        () if to == from => format!("line {}", number(from)),
        () => format!("lines {} to {}", number(from), number(to)),
    };
    Some(Fold { first, count: format!("… and {} more", number(repeats.len() + omitted)), lines })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_diagnostics::{Finding, Severity};

    use super::folded;
    use crate::testing::{ARC_OFF_CIRCLE, FEED_MISSING, UNSUPPORTED, file, render};
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

    /// Files for a printer, and one for another control.
    fn printed(count: usize) -> Report {
        let finding = |of: &str| {
            let message = format!("the file is for {of}, which gcheck does not read");
            Finding::new(&UNSUPPORTED, 0..2, message)
        };
        let one = |n: usize| file(&format!("p{n:02}.gcode"), "G1\n", vec![finding("a 3-D printer")]);
        let files: Vec<_> = (0..count).map(one).collect();
        let other = file("z.mpf", "G1\n", vec![finding("a SINUMERIK control")]);
        Report::new(files.into_iter().chain([other]).collect())
    }

    #[test]
    fn files_for_a_control_that_is_not_read_are_counted_after_the_fifth() {
        let report = printed(12).folded();
        expect![[r#"
            p00.gcode:1:1: warning[unsupported-dialect] the file is for a 3-D printer, which gcheck does not read
            p01.gcode:1:1: warning[unsupported-dialect] the file is for a 3-D printer, which gcheck does not read
            p02.gcode:1:1: warning[unsupported-dialect] the file is for a 3-D printer, which gcheck does not read
            p03.gcode:1:1: warning[unsupported-dialect] the file is for a 3-D printer, which gcheck does not read
            p04.gcode:1:1: warning[unsupported-dialect] the file is for a 3-D printer, which gcheck does not read
            p05.gcode:1:1: warning[unsupported-dialect] … and 7 more files: the file is for a 3-D printer, which gcheck does not read
            z.mpf:1:1: warning[unsupported-dialect] the file is for a SINUMERIK control, which gcheck does not read
        "#]].assert_eq(&render(&report, Format::Concise));
        let grouped = render(&report, Format::Grouped);
        assert_eq!(grouped.matches(".gcode\n").count(), 6, "{grouped}");
        let full = render(&report, Format::Full);
        assert!(
            full.contains("warning[unsupported-dialect]: … and 7 more files: the file is for a 3-D printer"),
            "{full}"
        );
        expect![[r#"
            errors  warnings  infos  hints  file
                 0         1      0      0  p00.gcode
                 0         1      0      0  p01.gcode
                 0         1      0      0  p02.gcode
                 0         1      0      0  p03.gcode
                 0         1      0      0  p04.gcode
                 0         1      0      0  z.mpf
                 0         7      0      0  … and 7 more files: the file is for a 3-D printer, which gcheck does not read
        "#]].assert_eq(&crate::file_counts(&report));
        assert_eq!(folded(&report), 7);
        assert_eq!(render(&printed(12).folded(), Format::Json), render(&printed(12), Format::Json));
        assert!(!render(&printed(6).folded(), Format::Concise).contains('…'));
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
