//! `junit`: test results, which nearly every CI server shows.
//!
//! Knows: suites, cases and failures of that format. Must not know: exit codes.
//!
//! A file is a suite and a finding a case of it. What makes the run fail is a failure; other findings are cases that pass and
//! say what was found, and a file without findings is a case that passes, since servers take a suite without cases for a
//! mistake. A file that could not be checked is a case with an error.
//! The file is an attribute of the suite, not of the case: servers that hold reports against a schema know it only there.

use std::io::{self, Write};

use gcheck_diagnostics::Finding;
use quick_xml::Writer;
use quick_xml::events::BytesText;

use super::remarks::remarks;
use super::xml;
use crate::Report;
use crate::report::{File, Skipped};

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    xml::document(out, |writer| {
        let errors = report.skipped().len();
        let (mut tests, mut failures) = (errors, 0);
        for file in report.files() {
            tests += cases(file);
            failures += failed(report, file);
        }
        let root = writer
            .create_element("testsuites")
            .with_attribute(("name", "gcheck"))
            .with_attribute(("tests", tests.to_string().as_str()))
            .with_attribute(("failures", failures.to_string().as_str()))
            .with_attribute(("errors", errors.to_string().as_str()));
        if tests == 0 {
            root.write_empty()?;
            return Ok(());
        }
        root.write_inner_content(|writer| {
            report.files().iter().try_for_each(|file| write_suite(report, file, writer))?;
            report.skipped().iter().try_for_each(|skipped| write_skipped(report, skipped, writer))
        })?;
        Ok(())
    })
}

/// At least the one that says that nothing was found.
fn cases(file: &File) -> usize {
    file.findings.len().max(1)
}

fn failed(report: &Report, file: &File) -> usize {
    file.findings.iter().filter(|finding| report.is_failed_by(finding)).count()
}

fn write_suite<W: Write>(report: &Report, file: &File, writer: &mut Writer<W>) -> io::Result<()> {
    let path = xml::text(file.rooted());
    let suite = writer
        .create_element("testsuite")
        .with_attribute(("name", path.as_ref()))
        .with_attribute(("tests", cases(file).to_string().as_str()))
        .with_attribute(("failures", failed(report, file).to_string().as_str()))
        .with_attribute(("errors", "0"))
        .with_attribute(("file", path.as_ref()));
    suite.write_inner_content(|writer| {
        if file.findings.is_empty() {
            let case = writer.create_element("testcase").with_attribute(("name", report.passed()));
            case.with_attribute(("classname", path.as_ref())).write_empty()?;
        }
        file.findings.iter().try_for_each(|finding| write_case(report, file, finding, writer))
    })?;
    Ok(())
}

fn write_skipped<W: Write>(report: &Report, skipped: &Skipped, writer: &mut Writer<W>) -> io::Result<()> {
    let path = report.rooted(&skipped.file);
    // A problem of the run as a whole has no file.
    let path = xml::text(if path.is_empty() { "gcheck" } else { &path });
    let suite = writer
        .create_element("testsuite")
        .with_attribute(("name", path.as_ref()))
        .with_attribute(("tests", "1"))
        .with_attribute(("failures", "0"))
        .with_attribute(("errors", "1"))
        .with_attribute(("file", path.as_ref()));
    suite.write_inner_content(|writer| {
        let case = writer.create_element("testcase").with_attribute(("name", "could not be checked"));
        case.with_attribute(("classname", path.as_ref())).write_inner_content(|writer| {
            let error = writer.create_element("error").with_attribute(("type", "not-checked"));
            let error = error.with_attribute(("message", xml::text(&skipped.reason).as_ref()));
            let said = format!("{path}: {}", skipped.reason);
            error.write_text_content(BytesText::new(&xml::block(&said)))?;
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

fn write_case<W: Write>(
    report: &Report,
    file: &File,
    finding: &Finding,
    writer: &mut Writer<W>,
) -> io::Result<()> {
    let at = file.source.position(finding.range.start);
    let place = format!("{}:{}:{}", file.rooted(), at.line, at.column);
    let case = writer
        .create_element("testcase")
        .with_attribute(("name", format!("{}:{} {}", at.line, at.column, finding.rule.id).as_str()))
        .with_attribute(("classname", xml::text(file.rooted()).as_ref()));
    let mut said = format!("{place}: {}[{}] {}", finding.severity, finding.rule.id, finding.message);
    for remark in remarks(finding) {
        said.push('\n');
        said.push_str(&remark);
    }
    let said = xml::block(&said);
    case.write_inner_content(|writer| {
        if report.is_failed_by(finding) {
            let failure = writer.create_element("failure").with_attribute(("type", finding.severity.name()));
            let failure = failure.with_attribute(("message", xml::text(&finding.message).as_ref()));
            failure.write_text_content(BytesText::new(&said))?;
        } else {
            writer.create_element("system-out").write_text_content(BytesText::new(&said))?;
        }
        Ok(())
    })?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use gcheck_diagnostics::Severity;

    use crate::testing::{everything, render};
    use crate::{Format, Report, Skipped};

    #[test]
    fn a_suite_a_file() {
        expect![[r#"
            <?xml version="1.0" encoding="UTF-8"?>
            <testsuites name="gcheck" tests="3" failures="1" errors="0">
              <testsuite name="empty.nc" tests="1" failures="0" errors="0" file="empty.nc">
                <testcase name="no findings" classname="empty.nc"/>
              </testsuite>
              <testsuite name="part.nc" tests="2" failures="1" errors="0" file="part.nc">
                <testcase name="4:5 feed-missing" classname="part.nc">
                  <failure type="error" message="no feed rate is in effect">part.nc:4:5: error[feed-missing] no feed rate is in effect
            note: the control stops without a feed rate
            note: from the manual:
              &quot;feed is modal&quot;
            note: the control raises alarm 312 FEED
            note: assuming setting 162 is off
            help: write a feed rate, e.g. `F200.`</failure>
                </testcase>
                <testcase name="5:5 arc-end-off-circle" classname="part.nc">
                  <system-out>part.nc:5:5: info[arc-end-off-circle] arc may end off the circle</system-out>
                </testcase>
              </testsuite>
            </testsuites>
        "#]].assert_eq(&render(&everything(), Format::Junit));
    }

    #[test]
    fn what_makes_the_run_fail_is_a_failure_and_the_rest_passes() {
        let failures = |report: &Report| {
            let text = render(report, Format::Junit);
            (text.matches("<failure").count(), text.matches("<system-out").count())
        };
        assert_eq!(failures(&everything().failing(Some(Severity::Info), false)), (2, 0));
        assert_eq!(failures(&everything().failing(Some(Severity::Warning), false)), (1, 1));
        assert_eq!(failures(&everything().failing(None, false)), (0, 2));
    }

    #[test]
    fn a_file_that_cannot_be_read_is_an_error() {
        let skipped = Skipped { file: "a.nc".to_owned(), reason: "is too large".to_owned() };
        expect![[r#"
            <?xml version="1.0" encoding="UTF-8"?>
            <testsuites name="gcheck" tests="1" failures="0" errors="1">
              <testsuite name="a.nc" tests="1" failures="0" errors="1" file="a.nc">
                <testcase name="could not be checked" classname="a.nc">
                  <error type="not-checked" message="is too large">a.nc: is too large</error>
                </testcase>
              </testsuite>
            </testsuites>
        "#]]
        .assert_eq(&render(&Report::new(vec![]).with_skipped(vec![skipped]), Format::Junit));
    }

    #[test]
    fn no_files() {
        expect![[r#"
            <?xml version="1.0" encoding="UTF-8"?>
            <testsuites name="gcheck" tests="0" failures="0" errors="0"/>
        "#]]
        .assert_eq(&render(&Report::new(vec![]), Format::Junit));
    }
}
