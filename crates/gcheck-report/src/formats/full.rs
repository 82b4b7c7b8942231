//! `full`: source lines with labels, notes and help, drawn by codespan.
//!
//! Knows: codespan, and how a finding is told in it. Must not know: whole programs — codespan sees [`Excerpt`]s only.
//!
//! Codespan would draw a line of a megabyte in full and has no severities `info` and `hint`; excerpts and the writer below
//! make up for it.

use std::io::{self, Write};
use std::ops::Range;

use codespan_reporting::diagnostic::{Diagnostic, Label, LabelStyle, Severity as Level};
use codespan_reporting::files::{Error, Files};
use codespan_reporting::term::{Config, GeneralWriteResult, WriteStyle, emit_to_write_style};
use gcheck_diagnostics::{Finding, Severity};

use super::concise;
use super::remarks::remarks;
use crate::excerpt::Excerpt;
use crate::fold::{Told, told};
use crate::report::File;
use crate::shown::{lines, one_line};
use crate::source::Source;
use crate::{Colour, Report, style};

pub(super) fn write(report: &Report, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    let config = Config::default();
    let mut drawn = Vec::new();
    let told =
        report.files().iter().flat_map(|file| told(report, file).into_iter().map(move |told| (file, told)));
    for (file, told) in told {
        let finding = match told {
            Told::One(finding) => finding,
            Told::Fold(fold) => {
                let words = format!("{} in {}, {}", fold.count, one_line(&file.path), fold.lines);
                write_fold(fold.first, &words, colour, out)?;
                continue;
            }
            Told::Files(finding, words) => {
                write_fold(finding, &one_line(&words), colour, out)?;
                continue;
            }
        };
        drawn.clear();
        let shown = ShownFiles::new(report, file, finding);
        let diagnostic = shown.diagnostic(finding);
        let mut writer = Writer { out: &mut drawn, colour, severity: finding.severity, name_due: false };
        match emit_to_write_style(&mut writer, &config, &shown, &diagnostic) {
            Ok(()) => write_trimmed(&drawn, out)?,
            // What cannot be drawn must still be reported.
            Err(_) => concise::write_line(file, finding, colour, out)?,
        }
    }
    Ok(())
}

/// The line that stands for repeats, in the form of a finding's first line.
fn write_fold(first: &Finding, words: &str, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    let (severity, strong, reset) = (
        colour.paint(style::severity(first.severity)),
        colour.paint(style::STRONG),
        colour.paint(style::RESET),
    );
    writeln!(out, "{severity}{}[{}]{reset}{strong}: {words}{reset}\n", first.severity.name(), first.rule.id)
}

/// Codespan pads lines with blanks, which show up in logs that are compared.
fn write_trimmed(drawn: &[u8], out: &mut dyn Write) -> io::Result<()> {
    for line in drawn.split_inclusive(|byte| *byte == b'\n') {
        out.write_all(line.trim_ascii_end())?;
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// The files that one finding shows.
struct ShownFiles<'r> {
    files: Vec<Shown<'r>>,
    /// Labels into files whose text is not at hand.
    elsewhere: Vec<String>,
}

struct Shown<'r> {
    path: &'r str,
    labels: Vec<(LabelStyle, &'r str)>,
    excerpt: Excerpt,
}

impl<'r> ShownFiles<'r> {
    fn new(report: &'r Report, file: &'r File, finding: &'r Finding) -> Self {
        struct Wanted<'r> {
            path: &'r str,
            source: &'r Source,
            spots: Vec<Range<u32>>,
            labels: Vec<(LabelStyle, &'r str)>,
        }
        let mut wanted = vec![Wanted {
            path: &file.path,
            source: &file.source,
            spots: vec![finding.range.clone()],
            labels: vec![(LabelStyle::Primary, finding.label.as_str())],
        }];
        let mut elsewhere = Vec::new();
        for label in &finding.labels {
            let path = label.file.as_deref().unwrap_or(&file.path);
            let entry = (LabelStyle::Secondary, label.message.as_str());
            if let Some(known) = wanted.iter_mut().find(|known| known.path == path) {
                known.spots.push(label.range.clone());
                known.labels.push(entry);
            } else if let Some(source) = report.source(path) {
                let spots = vec![label.range.clone()];
                wanted.push(Wanted { path, source, spots, labels: vec![entry] });
            } else {
                elsewhere.push(format!("note: in {path}: {}", label.message));
            }
        }
        let files = wanted.into_iter().map(|Wanted { path, source, spots, labels }| Shown {
            path,
            labels,
            excerpt: Excerpt::new(source, &spots),
        });
        Self { files: files.collect(), elsewhere }
    }

    fn diagnostic(&self, finding: &Finding) -> Diagnostic<usize> {
        let mut labels = Vec::new();
        for (id, file) in self.files.iter().enumerate() {
            for ((style, message), spot) in file.labels.iter().zip(file.excerpt.spots()) {
                labels.push(Label::new(*style, id, spot.clone()).with_message(one_line(message)));
            }
        }
        let remarks = self.elsewhere.iter().cloned().chain(remarks(finding));
        Diagnostic::new(level(finding.severity))
            .with_code(finding.rule.id)
            .with_message(one_line(&finding.message))
            .with_labels(labels)
            .with_notes_iter(remarks.map(|remark| lines(&remark).into_owned()))
    }

    fn file(&self, id: usize) -> Result<&Shown<'r>, Error> {
        self.files.get(id).ok_or(Error::FileMissing)
    }
}

fn level(severity: Severity) -> Level {
    match severity {
        Severity::Error => Level::Error,
        Severity::Warning => Level::Warning,
        Severity::Info => Level::Note,
        Severity::Hint => Level::Help,
    }
}

impl<'a> Files<'a> for ShownFiles<'_> {
    type FileId = usize;
    type Name = String;
    type Source = &'a str;

    fn name(&'a self, id: usize) -> Result<String, Error> {
        Ok(one_line(self.file(id)?.path).into_owned())
    }

    fn source(&'a self, id: usize) -> Result<&'a str, Error> {
        Ok(self.file(id)?.excerpt.text())
    }

    fn line_index(&'a self, id: usize, byte: usize) -> Result<usize, Error> {
        Ok(self.file(id)?.excerpt.line_at(byte))
    }

    fn line_number(&'a self, id: usize, line: usize) -> Result<usize, Error> {
        self.file(id)?.excerpt.line_number(line).ok_or(Error::LineTooLarge { given: line, max: 0 })
    }

    fn column_number(&'a self, id: usize, _line: usize, byte: usize) -> Result<usize, Error> {
        self.file(id)?.excerpt.column_at(byte).ok_or(Error::ColumnTooLarge { given: byte, max: 0 })
    }

    fn line_range(&'a self, id: usize, line: usize) -> Result<Range<usize>, Error> {
        self.file(id)?.excerpt.line_range(line).ok_or(Error::LineTooLarge { given: line, max: 0 })
    }
}

/// Takes what codespan draws: puts colours in, and our names of severities in the place of codespan's.
struct Writer<'o> {
    out: &'o mut Vec<u8>,
    colour: Colour,
    severity: Severity,
    /// The next thing written is the name of the severity.
    name_due: bool,
}

impl Writer<'_> {
    fn paint(&mut self, sequence: &'static str) -> GeneralWriteResult {
        self.out.write_all(self.colour.paint(sequence).as_bytes())
    }
}

impl Write for Writer<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if std::mem::take(&mut self.name_due) && (bytes == b"note" || bytes == b"help") {
            self.out.extend_from_slice(self.severity.name().as_bytes());
        } else {
            self.out.extend_from_slice(bytes);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl WriteStyle for Writer<'_> {
    fn set_header(&mut self, _: Level) -> GeneralWriteResult {
        self.name_due = true;
        self.paint(style::severity(self.severity))
    }

    fn set_header_message(&mut self) -> GeneralWriteResult {
        self.paint(style::STRONG)
    }

    fn set_line_number(&mut self) -> GeneralWriteResult {
        self.paint(style::FRAME)
    }

    fn set_note_bullet(&mut self) -> GeneralWriteResult {
        self.paint(style::FRAME)
    }

    fn set_source_border(&mut self) -> GeneralWriteResult {
        self.paint(style::FRAME)
    }

    fn set_label(&mut self, _: Level, label: LabelStyle) -> GeneralWriteResult {
        self.paint(match label {
            LabelStyle::Primary => style::severity(self.severity),
            LabelStyle::Secondary => style::FRAME,
        })
    }

    fn reset(&mut self) -> GeneralWriteResult {
        self.paint(style::RESET)
    }
}

#[cfg(test)]
mod tests;
