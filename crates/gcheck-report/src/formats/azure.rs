//! `azure`: logging commands, which Azure Pipelines turns into issues of a build.
//!
//! Knows: the command's syntax, escapes and its two levels. Must not know: source text.

use std::io::{self, Write};

use gcheck_diagnostics::{Finding, Severity};

use crate::Report;
use crate::report::File;
use crate::shown::one_line;

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    report.findings().try_for_each(|(file, finding)| write_command(file, finding, out))
}

fn write_command(file: &File, finding: &Finding, out: &mut dyn Write) -> io::Result<()> {
    let at = file.source.position(finding.range.start);
    // There is nothing milder than a warning.
    let level = if finding.severity == Severity::Error { "error" } else { "warning" };
    writeln!(
        out,
        "##vso[task.logissue type={level};sourcepath={};linenumber={};columnnumber={};code={};]{}",
        property(&one_line(file.rooted())),
        at.line,
        at.column,
        property(finding.rule.id),
        data(&one_line(&finding.message))
    )
}

/// Escapes the text of a command.
fn data(text: &str) -> String {
    text.replace('%', "%AZP25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Escapes the value of a property.
fn property(text: &str) -> String {
    data(text).replace(';', "%3B").replace(']', "%5D")
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::testing::{everything, file, on, render};
    use crate::{Format, Report};

    #[test]
    fn one_command_a_finding() {
        expect![[r#"
            ##vso[task.logissue type=error;sourcepath=part.nc;linenumber=4;columnnumber=5;code=feed-missing;]no feed rate is in effect
            ##vso[task.logissue type=warning;sourcepath=part.nc;linenumber=5;columnnumber=5;code=arc-end-off-circle;]arc may end off the circle
        "#]].assert_eq(&render(&everything(), Format::Azure));
    }

    #[test]
    fn properties_and_text_are_escaped() {
        let mut finding = on("G1", "G1");
        finding.message = "50%; [of] it".to_owned();
        let report = Report::new(vec![file("a;b]100%.nc", "G1", vec![finding])]);
        expect![[r#"
            ##vso[task.logissue type=error;sourcepath=a%3Bb%5D100%AZP25.nc;linenumber=1;columnnumber=1;code=feed-missing;]50%AZP25; [of] it
        "#]].assert_eq(&render(&report, Format::Azure));
    }
}
