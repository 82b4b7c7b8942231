//! Outcomes of comparisons as findings, for the formats of CI servers.
//!
//! Knows: which outcome is which finding, and where. Must not know: the formats.

use std::path::Path;

use gcheck_diagnostics::{Finding, Fixability, RuleMeta, Severity, Tier};
use gcheck_report::{ControlChoice, ControlSource, FileReport, Format, LineIndex, Report};
use gcheck_syntax::SourceText;

use super::outcome::{Outcome, Outcomes, Spot, Verdict};
use super::runs::Compared;
use crate::{Problem, output, path_base, paths, reading};

/// The first difference of a comparison; with the text, if findings will point into it.
pub(super) fn first(compared: &Compared, with_text: bool) -> Spot {
    let differences = &compared.differences;
    let [_, b] = &compared.prepared;
    let own = |file: &str| file == b.shown;
    let of_parting = differences.parting.as_ref().and_then(|parting| parting.b.as_ref());
    let of_others = differences.kept().iter().find_map(|difference| difference.b.as_ref());
    let of_sections = differences.sections().iter().find_map(|of| of.b.as_ref()).map(|at| &at.first);
    let lines = [of_parting, of_sections, of_others].into_iter().flatten().filter(|place| own(&place.file));
    let line = lines.map(|place| place.line).min().unwrap_or(1);
    let text = if with_text { b.source.clone() } else { SourceText::from("") };
    Spot { line, control: b.chosen.choice.clone(), path: b.shown.clone(), text }
}

const fn rule(id: &'static str, summary: &'static str) -> RuleMeta {
    RuleMeta {
        id,
        group: "diff",
        summary,
        severity: Severity::Error,
        control_specific: false,
        recommended: true,
        other_sets: &[],
        fixability: Fixability::Never,
        since: "0.1.0",
        aliases: &[],
        tier: Tier::Path,
        raw_docs: "",
    }
}

static DIFFERS: RuleMeta = rule("program-differs", "two programs make the machine do different things");
static AS_FAR_AS_KNOWN: RuleMeta = rule(
    "program-partly-compared",
    "two programs are the same as far as known, and something was not compared",
);
static NO_VERDICT: RuleMeta = rule("program-not-compared", "a program cannot be compared");
static REMOVED: RuleMeta = rule("program-removed", "a program of the first folder is not in the second");
static ADDED: RuleMeta = rule("program-added", "a program of the second folder is not in the first");

/// Test results: a suite a program.
pub(super) fn junit(all: &Outcomes) -> Result<String, Problem> {
    written(all, Format::Junit)
}

/// Annotations for GitHub.
pub(super) fn github(all: &Outcomes) -> Result<String, Problem> {
    written(all, Format::Github)
}

fn written(all: &Outcomes, format: Format) -> Result<String, Problem> {
    let pairs = all.pairs.iter().map(|outcome| {
        let [_, file] = &outcome.pair.files;
        let (path, text, control) = match &outcome.first {
            Some(spot) => (spot.path.clone(), spot.text.clone(), Some(spot.control.clone())),
            // Without a finding nothing of the text is shown.
            None if outcome.verdict == Verdict::Same => {
                (paths::shown_from_here(file), SourceText::from(""), None)
            }
            None => (paths::shown_from_here(file), text_of(file), None),
        };
        let findings = finding(outcome, &text, all.is_strict).into_iter().collect();
        report_of(path, text, control, findings)
    });
    let alone = all.alone.iter().filter(|alone| alone.is_open()).map(|alone| {
        let (rule, message) = match alone.side {
            0 => (&REMOVED, "the program is in the first folder only"),
            _ => (&ADDED, "the program is in the second folder only"),
        };
        let text = text_of(&alone.file);
        report_of(paths::shown_from_here(&alone.file), text, None, vec![Finding::new(rule, 0..0, message)])
    });
    let report = Report::new(pairs.chain(alone).collect());
    let base = path_base::of_files(report.paths().map(Path::new));
    let report = report.with_path_base(base).with_passed("makes the machine do the same");
    let mut out = Vec::new();
    gcheck_report::write(&report, format, output::colour(crate::args::When::Never), &mut out)
        .map_err(|error| Problem::new(format!("cannot write the report: {error}")))?;
    Ok(String::from_utf8_lossy(&out).into_owned())
}

fn report_of(
    path: String,
    text: SourceText,
    control: Option<ControlChoice>,
    findings: Vec<Finding>,
) -> FileReport {
    let unknown = || ControlChoice { name: String::new(), source: ControlSource::Default, because: None };
    FileReport::new(path, text, control.unwrap_or_else(unknown), findings)
}

/// The text of a program that findings point into; empty where it cannot be read, as its problem says then.
fn text_of(file: &Path) -> SourceText {
    reading::file(file).unwrap_or_else(|_| SourceText::from(""))
}

fn finding(outcome: &Outcome, text: &SourceText, is_strict: bool) -> Option<Finding> {
    let line = outcome.first.as_ref().map_or(1, |spot| spot.line);
    let range = LineIndex::new(text.text()).line_range(text.text(), line);
    let finding = match &outcome.verdict {
        Verdict::Same => return None,
        Verdict::AsFarAsKnown => Finding::new(&AS_FAR_AS_KNOWN, range, outcome.words())
            .at_most(if is_strict { Severity::Error } else { Severity::Info }),
        Verdict::Different => Finding::new(&DIFFERS, range, outcome.words()),
        Verdict::Accepted => Finding::new(&DIFFERS, range, outcome.words()).at_most(Severity::Info),
        Verdict::None(_) => Finding::new(&NO_VERDICT, range, outcome.words()),
    };
    let text = outcome.text.trim_end();
    Some(if text.is_empty() { finding } else { finding.note(text) })
}
