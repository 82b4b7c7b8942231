//! `concise`: `path:line:column: severity[rule] message`, one line a finding.
//!
//! Knows: that line, which editors' problem matchers read. Must not know: labels, notes, source text.

use std::io::{self, Write};

use gcheck_diagnostics::Finding;

use crate::fold::{Told, told};
use crate::report::File;
use crate::shown::one_line;
use crate::{Colour, Report, style};

pub(super) fn write(report: &Report, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    for file in report.files() {
        for told in told(report, file) {
            match told {
                Told::One(finding) => write_line(file, finding, colour, out)?,
                Told::Fold(fold) => line(file, fold.first, &fold.words(), colour, out)?,
                Told::Files(finding, words) => line(file, finding, &words, colour, out)?,
            }
        }
    }
    Ok(())
}

/// One finding.
pub(super) fn write_line(
    file: &File,
    finding: &Finding,
    colour: Colour,
    out: &mut dyn Write,
) -> io::Result<()> {
    line(file, finding, &finding.message, colour, out)
}

/// The line of a finding with other words than its message.
fn line(file: &File, finding: &Finding, words: &str, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    let at = file.source.position(finding.range.start);
    let (strong, severity, reset) = (
        colour.paint(style::STRONG),
        colour.paint(style::severity(finding.severity)),
        colour.paint(style::RESET),
    );
    writeln!(
        out,
        "{strong}{}:{}:{}{reset}: {severity}{}[{}]{reset} {}",
        one_line(&file.path),
        at.line,
        at.column,
        finding.severity,
        finding.rule.id,
        one_line(words)
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::testing::{everything, on, render, rendered, report};
    use crate::{Colour, Format};

    #[test]
    fn one_line_a_finding() {
        expect![[r#"
            part.nc:4:5: error[feed-missing] no feed rate is in effect
            part.nc:5:5: info[arc-end-off-circle] arc may end off the circle
        "#]]
        .assert_eq(&render(&everything(), Format::Concise));
    }

    #[test]
    fn places_of_odd_texts() {
        let places = |text: &str, part: &str| {
            let line = render(&report(text, vec![on(text, part)]), Format::Concise);
            line.split(": ").next().map(str::to_owned)
        };
        let is = |place: &str| Some(place.to_owned());
        assert_eq!(places("", ""), is("part.nc:1:1"));
        assert_eq!(places("O1\r\nG1", "G1"), is("part.nc:2:1"));
        assert_eq!(places("O1\rG1", "G1"), is("part.nc:2:1"));
        assert_eq!(places("(µ日本😀) G1", "G1"), is("part.nc:1:8"));
        assert_eq!(places("\tG1", "G1"), is("part.nc:1:2"));
        let long = format!("{}G1", "X1. ".repeat(250_000));
        assert_eq!(places(&long, "G1"), is("part.nc:1:1000001"));
    }

    #[test]
    fn a_message_is_one_line() {
        let mut finding = on("G1", "G1");
        finding.message = "one\ntwo\x1b[31m".to_owned();
        expect![[r#"
            part.nc:1:1: error[feed-missing] one two␛[31m
        "#]]
        .assert_eq(&render(&report("G1", vec![finding]), Format::Concise));
    }

    #[test]
    fn colours() {
        let text = rendered(&report("G1", vec![on("G1", "G1")]), Format::Concise, Colour::Ansi);
        expect![[r#"
            ␛[0m␛[1mpart.nc:1:1␛[0m: ␛[0m␛[1;31merror[feed-missing]␛[0m no feed rate is in effect
        "#]]
        .assert_eq(&text.replace('\x1b', "␛"));
    }
}
