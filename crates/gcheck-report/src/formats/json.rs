//! `json`: one object with everything that is known.
//!
//! Knows: version 1 of the object, whose members may grow but not change. Must not know: colours, source text.
//!
//! Files and findings are one a line, so that the output can be compared, searched and written without holding it.

use std::io::{self, Write};

use gcheck_diagnostics::{Certainty, Finding, Severity};
use schemars::JsonSchema;
use serde::Serialize;

use super::list::List;
use crate::report::File;
use crate::source::Source;
use crate::{ControlChoice, Fingerprint, Position, Report, Summary};

/// Version of the object.
const VERSION: u32 = 1;

// The object is written in parts; this says only which parts there are.
/// What `gcheck check --output-format json` prints.
#[derive(JsonSchema)]
#[schemars(title = "findings of gcheck", rename = "Report")]
#[expect(dead_code, reason = "it describes what `write` writes part by part")]
pub(super) struct JsonReport<'r> {
    /// 1. It changes only when a member goes away or means something else; new members keep it.
    #[schemars(extend("const" = VERSION))]
    version: u32,
    /// The files that were checked, in the order of their names.
    files: Vec<JsonFile<'r>>,
    /// The findings, by file and in the order of its text.
    findings: Vec<JsonFinding<'r>>,
    /// Counts over all files, and what keeps the verdict from being complete.
    summary: Summary,
}

/// A file that was checked.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "File")]
struct JsonFile<'r> {
    /// As it was named, or as it is called from the current folder.
    file: &'r str,
    /// The control that it was read for.
    control: &'r ControlChoice,
}

/// A finding.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Finding")]
pub(super) struct JsonFinding<'r> {
    /// The rule's id, which never changes.
    rule: &'r str,
    /// How bad it is.
    #[schemars(extend("enum" = Severity::ALL.map(Severity::name)))]
    severity: &'r str,
    /// On every path of the program, or on some.
    #[schemars(extend("enum" = Certainty::ALL.map(Certainty::name)))]
    certainty: &'r str,
    /// One line that makes sense by itself.
    message: &'r str,
    /// The file, as in `files`.
    file: &'r str,
    /// The place.
    range: JsonRange,
    /// What the place itself contributes.
    label: Option<&'r str>,
    /// Other places involved.
    labels: Vec<JsonLabel<'r>>,
    /// Facts, and what the control does, with sources.
    notes: &'r [String],
    /// What to do.
    help: Option<&'r str>,
    /// The alarm or error that the control answers with.
    alarm: Option<&'r str>,
    /// What the finding assumes.
    assumptions: &'r [String],
    /// Changes that settle it.
    fixes: Vec<JsonFix<'r>>,
    /// 32 hexadecimal digits by which the finding is known again when lines around it change.
    #[schemars(with = "String", extend("pattern" = "^[0-9a-f]{32}$"))]
    fingerprint: Fingerprint,
}

/// A part of a file; the end is not part of it.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Range")]
struct JsonRange {
    /// Its first character.
    start: Position,
    /// The place after its last character.
    end: Position,
}

/// Another place involved in a finding.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Label")]
struct JsonLabel<'r> {
    /// What the place contributes.
    message: &'r str,
    /// Its file.
    file: &'r str,
    /// The place; `null` if the other file's text is not at hand.
    range: Option<JsonRange>,
}

/// A change that settles a finding.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Fix")]
struct JsonFix<'r> {
    /// What it does.
    title: &'r str,
    /// It changes no move of the machine.
    safe: bool,
    /// Its edits, which do not overlap.
    edits: Vec<JsonEdit<'r>>,
}

/// A text in the place of another.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Edit")]
struct JsonEdit<'r> {
    /// The file.
    file: &'r str,
    /// What is replaced; nothing where it is empty.
    range: JsonRange,
    /// The new text.
    text: &'r str,
}

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\n\"version\": {VERSION},\n\"files\": ")?;
    let mut list = List::begin(out)?;
    for file in report.files() {
        list.item(out, &JsonFile { file: &file.path, control: &file.control })?;
    }
    list.end(out)?;
    write!(out, ",\n\"findings\": ")?;
    let mut list = List::begin(out)?;
    for file in report.files() {
        for (finding, fingerprint) in file.findings.iter().zip(file.fingerprints()) {
            list.item(out, &json_finding(report, file, finding, fingerprint))?;
        }
    }
    list.end(out)?;
    write!(out, ",\n\"summary\": ")?;
    serde_json::to_writer(&mut *out, &report.summary())?;
    writeln!(out, "\n}}")
}

/// A finding with everything that is known about it.
pub(super) fn json_finding<'r>(
    report: &'r Report,
    file: &'r File,
    finding: &'r Finding,
    fingerprint: Fingerprint,
) -> JsonFinding<'r> {
    let labels = finding.labels.iter().map(|label| {
        let path = label.file.as_deref().unwrap_or(&file.path);
        let source = if path == file.path { Some(&file.source) } else { report.source(path) };
        JsonLabel {
            message: &label.message,
            file: path,
            range: source.map(|source| range(source, &label.range)),
        }
    });
    let fixes = finding.fixes.iter().map(|fix| {
        let edits = fix.edits.iter();
        JsonFix {
            title: &fix.title,
            safe: fix.safe,
            edits: edits
                .map(|edit| JsonEdit {
                    file: &file.path,
                    range: range(&file.source, &edit.range),
                    text: &edit.text,
                })
                .collect(),
        }
    });
    JsonFinding {
        rule: finding.rule.id,
        severity: finding.severity.name(),
        certainty: finding.certainty.name(),
        message: &finding.message,
        file: &file.path,
        range: range(&file.source, &finding.range),
        label: (!finding.label.is_empty()).then_some(finding.label.as_str()),
        labels: labels.collect(),
        notes: &finding.notes,
        help: finding.help.as_deref(),
        alarm: finding.alarm.as_deref(),
        assumptions: &finding.assumptions,
        fixes: fixes.collect(),
        fingerprint,
    }
}

fn range(source: &Source, range: &std::ops::Range<u32>) -> JsonRange {
    let span = source.span(range);
    JsonRange { start: span.start, end: span.end }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_diagnostics::{Edit, Finding, Fix};
    use serde_json::{Value, json};

    use crate::testing::{FEED_MISSING, everything, on, render, report};
    use crate::{Format, Report};

    fn parsed(report: &Report) -> Value {
        serde_json::from_str(&render(report, Format::Json)).unwrap()
    }

    #[test]
    fn everything_a_finding_can_say() {
        expect![[r#"
            {
            "version": 1,
            "files": [
              {"file":"empty.nc","control":{"name":"acme-mill","source":"detected","because":"(ACME)"}},
              {"file":"part.nc","control":{"name":"acme-mill","source":"detected","because":"(ACME)"}}
            ],
            "findings": [
              {"rule":"feed-missing","severity":"error","certainty":"always","message":"no feed rate is in effect","file":"part.nc","range":{"start":{"line":4,"column":5,"offset":25},"end":{"line":4,"column":7,"offset":27}},"label":"here","labels":[{"message":"`G90` set here","file":"part.nc","range":{"start":{"line":3,"column":1,"offset":17},"end":{"line":3,"column":4,"offset":20}}},{"message":"called from here","file":"sub/O9 1.nc","range":{"start":{"line":1,"column":1,"offset":0},"end":{"line":1,"column":3,"offset":2}}}],"notes":["the control stops without a feed rate","from the manual:\n  \"feed is modal\""],"help":"write a feed rate, e.g. `F200.`","alarm":"312 FEED","assumptions":["setting 162 is off"],"fixes":[{"title":"add `F200.`","safe":false,"edits":[{"file":"part.nc","range":{"start":{"line":4,"column":10,"offset":30},"end":{"line":4,"column":10,"offset":30}},"text":" F200."}]}],"fingerprint":"149a7a4dd9ecc09d284ba0866a301a1b"},
              {"rule":"arc-end-off-circle","severity":"info","certainty":"maybe","message":"arc may end off the circle","file":"part.nc","range":{"start":{"line":5,"column":5,"offset":37},"end":{"line":5,"column":16,"offset":48}},"label":null,"labels":[],"notes":[],"help":null,"alarm":null,"assumptions":[],"fixes":[],"fingerprint":"a447bc762e13c1017d57e064941370ba"}
            ],
            "summary": {"files":2,"lines":7,"errors":1,"warnings":0,"infos":1,"hints":0,"omitted":0,"suppressed":1,"baseline":0,"fixed":0,"out_of_fuel":["empty.nc"],"failed_rules":[],"skipped":[],"assumptions":[]}
            }
        "#]].assert_eq(&render(&everything(), Format::Json));
    }

    #[test]
    fn an_empty_report() {
        expect![[r#"
            {
            "version": 1,
            "files": [],
            "findings": [],
            "summary": {"files":0,"lines":0,"errors":0,"warnings":0,"infos":0,"hints":0,"omitted":0,"suppressed":0,"baseline":0,"fixed":0,"out_of_fuel":[],"failed_rules":[],"skipped":[],"assumptions":[]}
            }
        "#]].assert_eq(&render(&Report::new(vec![]), Format::Json));
    }

    #[test]
    fn a_fix_with_two_edits() {
        let edits = vec![
            Edit { range: 0..1, text: "G01".to_owned() },
            Edit { range: 2..2, text: "\"µ\x1A".to_owned() },
        ];
        let fix = Fix { title: "write it".to_owned(), safe: true, edits };
        let value = parsed(&report("G\n1", vec![on("G\n1", "1").fix(fix)]));
        assert_eq!(
            value["findings"][0]["fixes"],
            json!([{ "title": "write it", "safe": true, "edits": [
                { "file": "part.nc", "text": "G01",
                  "range": { "start": { "line": 1, "column": 1, "offset": 0 },
                             "end": { "line": 1, "column": 2, "offset": 1 } } },
                { "file": "part.nc", "text": "\"µ\u{1A}",
                  "range": { "start": { "line": 2, "column": 1, "offset": 2 },
                             "end": { "line": 2, "column": 1, "offset": 2 } } } ] }])
        );
    }

    #[test]
    fn ranges_of_odd_texts() {
        let range = |text: &str, range| {
            let value = parsed(&report(text, vec![Finding::new(&FEED_MISSING, range, "m")]));
            let place = |end: &str| {
                let place = &value["findings"][0]["range"][end];
                ["line", "column", "offset"].map(|name| place[name].as_u64().unwrap())
            };
            (place("start"), place("end"))
        };
        assert_eq!(range("", 0..0), ([1, 1, 0], [1, 1, 0]));
        assert_eq!(range("G1\n", 3..3), ([2, 1, 3], [2, 1, 3]));
        assert_eq!(range("G1\r\nG2", 1..6), ([1, 2, 1], [2, 3, 6]));
        assert_eq!(range("G1\rG2", 3..5), ([2, 1, 3], [2, 3, 5]));
        assert_eq!(range("(µ日本😀)\tG1", 14..16), ([1, 7, 14], [1, 9, 16]));
        let long = "µ".repeat(1_000_000);
        assert_eq!(
            range(&long, 1_999_998..2_000_000),
            ([1, 1_000_000, 1_999_998], [1, 1_000_001, 2_000_000])
        );
    }
}
