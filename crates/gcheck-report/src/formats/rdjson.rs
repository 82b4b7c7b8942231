//! `rdjson`: the diagnostic format of reviewdog, which comments on changes at many code hosts.
//!
//! Knows: the members that reviewdog reads, and that its columns count bytes. Must not know: colours.

use std::io::{self, Write};
use std::ops::Range;

use gcheck_diagnostics::{Finding, Severity};
use serde::Serialize;

use super::list::List;
use super::remarks::{HOME, remarks};
use crate::Report;
use crate::report::File;
use crate::source::Source;

#[derive(Serialize)]
struct Diagnostic<'r> {
    message: String,
    location: Location<'r>,
    severity: &'static str,
    code: Code<'r>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    suggestions: Vec<Suggestion<'r>>,
}

#[derive(Serialize)]
struct Location<'r> {
    path: &'r str,
    range: Span,
}

#[derive(Serialize)]
struct Span {
    start: Place,
    end: Place,
}

/// Both from 1; the column counts bytes of UTF-8.
#[derive(Serialize)]
struct Place {
    line: u32,
    column: u32,
}

#[derive(Serialize)]
struct Code<'r> {
    value: &'r str,
    url: String,
}

#[derive(Serialize)]
struct Suggestion<'r> {
    range: Span,
    text: &'r str,
}

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{{\n\"source\": {{\"name\":\"gcheck\",\"url\":\"{HOME}\"}},\n\"diagnostics\": ")?;
    let mut list = List::begin(out)?;
    for (file, finding) in report.findings() {
        list.item(out, &diagnostic(file, finding))?;
    }
    list.end(out)?;
    writeln!(out, "\n}}")
}

fn diagnostic<'r>(file: &'r File, finding: &'r Finding) -> Diagnostic<'r> {
    let mut message = finding.message.clone();
    for remark in remarks(finding) {
        message.push('\n');
        message.push_str(&remark);
    }
    // A suggestion is one edit, offered with a button: a fix of several would be half applied, and one that may change
    // moves is not for a button.
    let fixes = finding.fixes.iter().filter(|fix| fix.safe);
    let suggestions = fixes.filter_map(|fix| match fix.edits.as_slice() {
        [edit] => Some(Suggestion { range: span(&file.source, &edit.range), text: &edit.text }),
        _ => None,
    });
    Diagnostic {
        message,
        location: Location { path: file.rooted(), range: span(&file.source, &finding.range) },
        severity: match finding.severity {
            Severity::Error => "ERROR",
            Severity::Warning => "WARNING",
            Severity::Info | Severity::Hint => "INFO",
        },
        code: Code { value: finding.rule.id, url: finding.rule.page() },
        suggestions: suggestions.collect(),
    }
}

fn span(source: &Source, range: &Range<u32>) -> Span {
    let place = |offset: u32| {
        let at = source.position(offset);
        let line = source.index().line_range(source.text(), at.line);
        Place { line: at.line, column: at.offset - line.start + 1 }
    };
    Span { start: place(range.start), end: place(range.end.max(range.start)) }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_diagnostics::Fix;

    use crate::Format;
    use crate::testing::{everything, on, render, report};

    #[test]
    fn a_diagnostic_a_finding() {
        expect![[r#"
            {
            "source": {"name":"gcheck","url":"https://github.com/gcheck/gcheck"},
            "diagnostics": [
              {"message":"no feed rate is in effect\nnote: the control stops without a feed rate\nnote: from the manual:\n  \"feed is modal\"\nnote: the control raises alarm 312 FEED\nnote: assuming setting 162 is off\nhelp: write a feed rate, e.g. `F200.`","location":{"path":"part.nc","range":{"start":{"line":4,"column":5},"end":{"line":4,"column":7}}},"severity":"ERROR","code":{"value":"feed-missing","url":"https://github.com/gcheck/gcheck/blob/main/docs/rules/feed-missing.md"}},
              {"message":"arc may end off the circle","location":{"path":"part.nc","range":{"start":{"line":5,"column":5},"end":{"line":5,"column":16}}},"severity":"INFO","code":{"value":"arc-end-off-circle","url":"https://github.com/gcheck/gcheck/blob/main/docs/rules/arc-end-off-circle.md"}}
            ]
            }
        "#]].assert_eq(&render(&everything(), Format::Rdjson));
    }

    #[test]
    fn columns_count_bytes_and_a_safe_fix_is_a_suggestion() {
        let text = "(µ日) G1\n";
        let finding = on(text, "G1").fix(Fix::safe("write `G01`", 8..10, "G01"));
        expect![[r#"
            {
            "source": {"name":"gcheck","url":"https://github.com/gcheck/gcheck"},
            "diagnostics": [
              {"message":"no feed rate is in effect","location":{"path":"part.nc","range":{"start":{"line":1,"column":9},"end":{"line":1,"column":11}}},"severity":"ERROR","code":{"value":"feed-missing","url":"https://github.com/gcheck/gcheck/blob/main/docs/rules/feed-missing.md"},"suggestions":[{"range":{"start":{"line":1,"column":9},"end":{"line":1,"column":11}},"text":"G01"}]}
            ]
            }
        "#]].assert_eq(&render(&report(text, vec![finding]), Format::Rdjson));
    }
}
