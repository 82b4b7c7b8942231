//! `github`: workflow commands, which GitHub Actions turns into annotations.
//!
//! Knows: the command's syntax and escapes, and what the runner refuses. Must not know: source text.
//!
//! GitHub shows only a few annotations a step, so the caller should print the summary line as well.

use std::io::{self, Write};

use gcheck_diagnostics::{Finding, Severity};

use super::remarks::remarks;
use crate::Report;
use crate::report::File;
use crate::shown::{lines, one_line};

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    report.findings().try_for_each(|(file, finding)| write_command(file, finding, out))
}

fn write_command(file: &File, finding: &Finding, out: &mut dyn Write) -> io::Result<()> {
    let span = file.source.span(&finding.range);
    let level = match finding.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info | Severity::Hint => "notice",
    };
    let path = one_line(file.rooted());
    let (start, id) = (span.start, finding.rule.id);
    // The title has the rule and the annotation its place; the text repeats neither.
    write!(out, "::{level} title=gcheck ({}),file={},line={}", property(id), property(&path), start.line)?;
    if span.end.line == start.line {
        write!(out, ",endLine={},col={},endColumn={}", start.line, start.column, span.end.column)?;
    } else {
        // The runner refuses columns of a range over several lines. A range that ends before a line's first character
        // does not touch that line.
        let untouched = u32::from(span.end.column == 1);
        write!(out, ",endLine={}", span.end.line - untouched)?;
    }
    let mut text = lines(&finding.message).into_owned();
    for remark in remarks(finding) {
        text.push_str("\n  ");
        text.push_str(&lines(&remark));
    }
    writeln!(out, "::{}", data(&text))
}

/// Escapes the text of a command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Escapes the value of a property.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_diagnostics::{Finding, Severity};

    use crate::testing::{FEED_MISSING, everything, file, on, render, report};
    use crate::{Format, Report};

    #[test]
    fn one_command_a_finding() {
        expect![[r#"
            ::error title=gcheck (feed-missing),file=part.nc,line=4,endLine=4,col=5,endColumn=7::no feed rate is in effect%0A  note: the control stops without a feed rate%0A  note: from the manual:%0A  "feed is modal"%0A  note: the control raises alarm 312 FEED%0A  note: assuming setting 162 is off%0A  help: write a feed rate, e.g. `F200.`
            ::notice title=gcheck (arc-end-off-circle),file=part.nc,line=5,endLine=5,col=5,endColumn=16::arc may end off the circle
        "#]].assert_eq(&render(&everything(), Format::Github));
    }

    #[test]
    fn properties_and_text_are_escaped() {
        let path = "my parts/100%, a:b.nc";
        let report =
            Report::new(vec![file(path, "G1", vec![on("G1", "G1").help("50% :: less,\r\nor none")])]);
        expect![[r#"
            ::error title=gcheck (feed-missing),file=my parts/100%25%2C a%3Ab.nc,line=1,endLine=1,col=1,endColumn=3::no feed rate is in effect%0A  help: 50%25 :: less,%0Aor none
        "#]].assert_eq(&render(&report, Format::Github));
    }

    #[test]
    fn a_range_over_lines_has_no_columns() {
        let at = |range| {
            render(&report("G1\nG2\nG3\n", vec![Finding::new(&FEED_MISSING, range, "m")]), Format::Github)
        };
        expect![[r#"
            ::error title=gcheck (feed-missing),file=part.nc,line=1,endLine=2::m
        "#]]
        .assert_eq(&at(0..4));
        expect![[r#"
            ::error title=gcheck (feed-missing),file=part.nc,line=1,endLine=2::m
        "#]]
        .assert_eq(&at(0..6));
    }

    #[test]
    fn levels() {
        let findings = Severity::ALL.map(|severity| Finding { severity, ..on("G1", "G1") });
        expect![[r#"
            ::notice title=gcheck (feed-missing),file=part.nc,line=1,endLine=1,col=1,endColumn=3::no feed rate is in effect
            ::notice title=gcheck (feed-missing),file=part.nc,line=1,endLine=1,col=1,endColumn=3::no feed rate is in effect
            ::warning title=gcheck (feed-missing),file=part.nc,line=1,endLine=1,col=1,endColumn=3::no feed rate is in effect
            ::error title=gcheck (feed-missing),file=part.nc,line=1,endLine=1,col=1,endColumn=3::no feed rate is in effect
        "#]].assert_eq(&render(&report("G1", findings.to_vec()), Format::Github));
    }
}
