//! `checkstyle`: the XML that Jenkins and many other servers read.
//!
//! Knows: the elements and severities of Checkstyle. Must not know: source text.

use std::io::{self, Write};

use gcheck_diagnostics::Severity;
use quick_xml::Writer;

use super::xml;
use crate::Report;
use crate::report::File;

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    xml::document(out, |writer| {
        let root = writer.create_element("checkstyle").with_attribute(("version", "4.3"));
        if report.findings().next().is_none() {
            root.write_empty()?;
            return Ok(());
        }
        root.write_inner_content(|writer| {
            let with_findings = report.files().iter().filter(|file| !file.findings.is_empty());
            with_findings.into_iter().try_for_each(|file| write_file(file, writer))
        })?;
        Ok(())
    })
}

fn write_file<W: Write>(file: &File, writer: &mut Writer<W>) -> io::Result<()> {
    let element = writer.create_element("file").with_attribute(("name", xml::text(file.rooted()).as_ref()));
    element.write_inner_content(|writer| {
        for finding in &file.findings {
            let at = file.source.position(finding.range.start);
            writer
                .create_element("error")
                .with_attribute(("line", at.line.to_string().as_str()))
                .with_attribute(("column", at.column.to_string().as_str()))
                .with_attribute(("severity", severity(finding.severity)))
                .with_attribute(("message", xml::text(&finding.message).as_ref()))
                .with_attribute(("source", format!("gcheck.{}", finding.rule.id).as_str()))
                .write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info | Severity::Hint => "info",
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::testing::{everything, file, on, render, report};
    use crate::{Format, Report};

    #[test]
    fn an_element_a_finding() {
        expect![[r#"
            <?xml version="1.0" encoding="UTF-8"?>
            <checkstyle version="4.3">
              <file name="part.nc">
                <error line="4" column="5" severity="error" message="no feed rate is in effect" source="gcheck.feed-missing"/>
                <error line="5" column="5" severity="info" message="arc may end off the circle" source="gcheck.arc-end-off-circle"/>
              </file>
            </checkstyle>
        "#]].assert_eq(&render(&everything(), Format::Checkstyle));
    }

    #[test]
    fn nothing_found() {
        expect![[r#"
            <?xml version="1.0" encoding="UTF-8"?>
            <checkstyle version="4.3"/>
        "#]]
        .assert_eq(&render(&report("G1", vec![]), Format::Checkstyle));
    }

    #[test]
    fn what_xml_cannot_hold_is_shown_otherwise() {
        let mut finding = on("G1", "G1");
        finding.message = "<a> & \"b\"\u{1}\u{FFFE}\n'c'".to_owned();
        let report = Report::new(vec![file("a & \"b\".nc", "G1", vec![finding])]);
        expect![[r#"
            <?xml version="1.0" encoding="UTF-8"?>
            <checkstyle version="4.3">
              <file name="a &amp; &quot;b&quot;.nc">
                <error line="1" column="1" severity="error" message="&lt;a&gt; &amp; &quot;b&quot;␁� &apos;c&apos;" source="gcheck.feed-missing"/>
              </file>
            </checkstyle>
        "#]].assert_eq(&render(&report, Format::Checkstyle));
    }
}
