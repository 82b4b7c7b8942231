//! `grouped`: the findings of a file under its name, in columns.
//!
//! Knows: that table. Must not know: labels, notes, source text.

use std::borrow::Cow;
use std::io::{self, Write};

use gcheck_diagnostics::Finding;

use crate::fold::{Told, told};
use crate::report::File;
use crate::shown::one_line;
use crate::{Colour, Report, style};

pub(super) fn write(report: &Report, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    let mut begun = false;
    for file in report.files() {
        let told = told(report, file);
        if told.is_empty() {
            continue;
        }
        if begun {
            writeln!(out)?;
        }
        begun = true;
        write_file(file, &told, colour, out)?;
    }
    Ok(())
}

fn write_file(file: &File, told: &[Told<'_>], colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    let (strong, reset) = (colour.paint(style::STRONG), colour.paint(style::RESET));
    writeln!(out, "{strong}{}{reset}", one_line(&file.path))?;
    let rows: Vec<(&Finding, Cow<'_, str>)> = told
        .iter()
        .map(|told| match told {
            Told::One(finding) => (*finding, Cow::from(&finding.message)),
            Told::Fold(fold) => (fold.first, Cow::from(fold.words())),
            Told::Files(finding, words) => (*finding, Cow::from(words)),
        })
        .collect();
    let places: Vec<String> = rows
        .iter()
        .map(|(finding, _)| {
            let at = file.source.position(finding.range.start);
            format!("{}:{}", at.line, at.column)
        })
        .collect();
    let place_width = places.iter().map(String::len).max().unwrap_or(0);
    let rule_width = rows.iter().map(|(finding, _)| finding.rule.id.len()).max().unwrap_or(0);
    for ((finding, words), place) in rows.into_iter().zip(places) {
        let severity = colour.paint(style::severity(finding.severity));
        writeln!(
            out,
            "  {place:>place_width$}  {severity}{:<7}{reset}  {:<rule_width$}  {}",
            finding.severity.name(),
            finding.rule.id,
            one_line(&words)
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::testing::{everything, file, on, render};
    use crate::{Format, Report};

    #[test]
    fn a_table_for_each_file_with_findings() {
        expect![[r#"
            part.nc
              4:5  error    feed-missing        no feed rate is in effect
              5:5  info     arc-end-off-circle  arc may end off the circle
        "#]]
        .assert_eq(&render(&everything(), Format::Grouped));
    }

    #[test]
    fn files_are_set_apart() {
        let report = Report::new(vec![
            file("a.nc", "G1", vec![on("G1", "G1")]),
            file("b.nc", "\n\nG0 G1", vec![on("\n\nG0 G1", "G1")]),
        ]);
        expect![[r#"
            a.nc
              1:1  error    feed-missing  no feed rate is in effect

            b.nc
              3:4  error    feed-missing  no feed rate is in effect
        "#]]
        .assert_eq(&render(&report, Format::Grouped));
    }
}
