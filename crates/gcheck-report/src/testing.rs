//! Reports for tests.
//!
//! Knows: a few made-up rules, and how to name places by the text that is there. Must not know: any format.

use std::ops::Range;
use std::sync::Arc;

use gcheck_diagnostics::{Finding, Fixability, RuleMeta, Severity, Tier};
use gcheck_syntax::SourceText;

use crate::{Colour, ControlChoice, ControlSource, FileReport, Format, Report};

pub(crate) static FEED_MISSING: RuleMeta = RuleMeta {
    id: "feed-missing",
    group: "motion",
    summary: "cutting move with no feed rate in effect",
    severity: Severity::Error,
    tier: Tier::Block,
    recommended: true,
    other_sets: &[],
    control_specific: false,
    fixability: Fixability::Never,
    since: "0.1.0",
    aliases: &["no-feed"],
    raw_docs: " A cutting move runs while no feed rate\n is in effect.\n\n ## Why it matters\n The control stops.\n\n\
               ```nc,reported,acme-mill\n G1 X10.\n ```\n",
};

pub(crate) static ARC_OFF_CIRCLE: RuleMeta = RuleMeta {
    id: "arc-end-off-circle",
    group: "motion",
    summary: "arc end point is not on the circle",
    severity: Severity::Warning,
    tier: Tier::Block,
    recommended: true,
    other_sets: &[],
    control_specific: false,
    fixability: Fixability::Never,
    since: "0.1.0",
    aliases: &[],
    raw_docs: "",
};

pub(crate) static UNSUPPORTED: RuleMeta = RuleMeta {
    id: "unsupported-dialect",
    group: "program",
    summary: "dialect that is not read",
    severity: Severity::Warning,
    tier: Tier::Program,
    recommended: true,
    other_sets: &[],
    control_specific: false,
    fixability: Fixability::Never,
    since: "0.1.0",
    aliases: &[],
    raw_docs: "",
};

/// A file checked for a control that everybody knows.
pub(crate) fn file(path: &str, text: &str, findings: Vec<Finding>) -> FileReport {
    let control = ControlChoice {
        name: "acme-mill".to_owned(),
        source: ControlSource::Detected,
        because: Some("(ACME)".to_owned()),
    };
    FileReport::new(path.to_owned(), SourceText::from(text), control, findings)
}

/// The bytes of the first `part` of a text.
pub(crate) fn at(text: &str, part: &str) -> Range<u32> {
    let start = text.find(part).expect("the part is in the text");
    start as u32..(start + part.len()) as u32
}

/// A finding on the first `part` of a text.
pub(crate) fn on(text: &str, part: &str) -> Finding {
    Finding::new(&FEED_MISSING, at(text, part), "no feed rate is in effect").label("here")
}

pub(crate) fn render(report: &Report, format: Format) -> String {
    rendered(report, format, Colour::Plain)
}

pub(crate) fn rendered(report: &Report, format: Format, colour: Colour) -> String {
    let mut out = Vec::new();
    crate::write(report, format, colour, &mut out).expect("a vector takes everything");
    String::from_utf8(out).expect("formats write UTF-8")
}

/// One file with findings.
pub(crate) fn report(text: &str, findings: Vec<Finding>) -> Report {
    Report::new(vec![file("part.nc", text, findings)])
}

/// A program and a finding that uses everything a finding can say.
pub(crate) fn everything() -> Report {
    let text = "%\nO1 (µ 日本)\nG90\nN10 G1 X10.\nN20 G2 X20. I5.\nM30\n%\n";
    let mut full = on(text, "G1")
        .also(at(text, "G90"), "`G90` set here")
        .note("the control stops without a feed rate")
        .note("from the manual:\n  \"feed is modal\"")
        .alarm(Some("312 FEED".to_owned()))
        .assuming("setting 162 is off")
        .help("write a feed rate, e.g. `F200.`");
    full.labels.push(gcheck_diagnostics::Label {
        file: Some("sub/O9 1.nc".into()),
        range: 0..2,
        message: "called from here".to_owned(),
    });
    let full = full.fix(gcheck_diagnostics::Fix::risky("add `F200.`", 30..30, " F200."));
    let mild = Finding {
        severity: Severity::Info,
        certainty: gcheck_diagnostics::Certainty::Maybe,
        ..Finding::new(&ARC_OFF_CIRCLE, at(text, "G2 X20. I5."), "arc may end off the circle")
    };
    let mut first = file("part.nc", text, vec![mild, full]);
    first.suppressed = 1;
    let mut second = file("empty.nc", "", vec![]);
    second.out_of_fuel = true;
    Report::new(vec![first, second])
        .with_related(vec![crate::RelatedFile {
            path: "sub/O9 1.nc".to_owned(),
            text: Arc::new(SourceText::from("O9(é)\r\nM99\r\n")),
        }])
        .with_rules([&FEED_MISSING, &ARC_OFF_CIRCLE])
}
