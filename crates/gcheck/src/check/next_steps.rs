//! What a check suggests to do next, after its last line.
//!
//! Knows: which option helps when. Must not know: how findings look.

use std::fmt::Write as _;

use gcheck_report::Report;

use crate::args::CheckOptions;

/// From so many files and findings on a folder is one of old programs, for which there is the baseline.
const MANY_FILES: usize = 20;
const MANY_FINDINGS: usize = 100;
/// So many files of dialects that are not read are a folder of them.
const MANY_UNSUPPORTED: usize = 5;

/// A line for each suggestion; empty when there is none.
pub(super) fn after(report: &Report, options: &CheckOptions) -> String {
    let mut text = String::new();
    let shows_findings = !(options.statistics || options.summary);
    let summary = report.summary();
    let findings = summary.errors + summary.warnings + summary.infos + summary.hints;
    // Writing into a string does not fail.
    if shows_findings && findings >= MANY_FINDINGS && summary.files > 1 {
        let _ = writeln!(text, "begin with the counts: `--statistics` has them by rule, `--summary` by file");
    }
    if shows_findings && gcheck_report::folded(report) > 0 {
        let _ = writeln!(
            text,
            "repeats are folded: `--show-all` shows every finding, `--statistics` counts them"
        );
    }
    let unsupported = report.unsupported_files();
    if unsupported >= MANY_UNSUPPORTED {
        let _ = writeln!(
            text,
            "{unsupported} of {} files are for controls that gcheck does not read: leave them out with `exclude` under \
             `[files]` of a `gcheck.toml`, or name the control with `--control` if that is wrong",
            summary.files
        );
    }
    let by_default = report.files_by_default();
    if by_default > 0 {
        let these = if by_default == 1 { "a program".to_owned() } else { format!("{by_default} programs") };
        let _ = writeln!(
            text,
            "nothing shows which control runs {these}: name it with `--control` (`gcheck controls` lists them) or \
             in a `gcheck.toml` (`gcheck init`)"
        );
    }
    let fixable = report.fixable();
    if fixable > 0 && !options.fix {
        let these = if fixable == 1 {
            "1 finding has a fix that changes".to_owned()
        } else {
            format!("{fixable} findings have fixes that change")
        };
        let _ = writeln!(text, "{these} no move: `--diff` shows, `--fix` applies");
    }
    // A baseline is for findings, not for files that are not read at all.
    let is_old_work = summary.files.saturating_sub(unsupported) >= MANY_FILES
        && findings.saturating_sub(unsupported) >= MANY_FINDINGS;
    if options.baseline.is_none() && is_old_work {
        let _ = writeln!(
            text,
            "old programs: `--baseline gcheck-baseline.json --update-baseline` accepts what is found today, and later \
             checks with that baseline show only what is new"
        );
    }
    text
}
