//! A page with the drawing, the program and its findings: one file that loads nothing.
//!
//! Knows: what the page is put together from, how text is kept from becoming markup. Must not know: how the path is drawn
//! (viewer.js does), what is found.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter};

use super::data::{Heading, ViewerData};
use super::drawing::Drawing;
use super::note::Note;
use super::svg::escaped;
use crate::summary::Names;

/// Text of all files together, bytes, that is put into a page; a longer file is named without its text.
const MAX_TEXT: usize = 32 << 20;
/// Lines of a file that a page shows; browsers can scroll no further.
const MAX_LINES: usize = 1_500_000;

/// The modules of the page, each after those that it imports: as one script their names are one another's.
const MODULES: [&str; 17] = [
    include_str!("viewer/geometry.js"),
    include_str!("viewer/data.js"),
    include_str!("viewer/former.js"),
    include_str!("viewer/colors.js"),
    include_str!("viewer/words.js"),
    include_str!("viewer/camera.js"),
    include_str!("viewer/painter.js"),
    include_str!("viewer/paper.js"),
    include_str!("viewer/surroundings.js"),
    include_str!("viewer/annotate.js"),
    include_str!("viewer/measure.js"),
    include_str!("viewer/picture.js"),
    include_str!("viewer/pick.js"),
    include_str!("viewer/rotary.js"),
    include_str!("viewer.js"),
    include_str!("panel.js"),
    include_str!("page.js"),
];
const STYLE: &str = include_str!("page.css");
const BODY: &str = include_str!("page.html");

/// Nothing is loaded, whatever the program's text holds.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'";

/// What is in a page beside the drawing.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// What the page is called: the program's name.
    pub title: &'a str,
    /// The control that read the program.
    pub control: &'a str,
    /// The texts of the files, by the names that the drawing gives them.
    pub sources: &'a [Source<'a>],
    /// What is marked.
    pub findings: &'a [Finding<'a>],
    /// What comments call the moves after them.
    pub headings: &'a [Heading<'a>],
    /// Further sentences about the drawing, after its own.
    pub notes: &'a [Note],
}

/// A file of the program.
#[derive(Debug, Clone, Copy)]
pub struct Source<'a> {
    /// Its name, as steps of the run have it.
    pub name: &'a str,
    /// Its text.
    pub text: &'a str,
}

/// Something found in a file.
#[derive(Debug, Clone, Copy)]
pub struct Finding<'a> {
    /// Name of the file.
    pub file: &'a str,
    /// Line, from 1.
    pub line: u32,
    /// `error`, `warning`, `info` or `hint`.
    pub severity: &'a str,
    /// The rule's id.
    pub rule: &'a str,
    /// One line.
    pub message: &'a str,
}

#[derive(Debug, Serialize)]
struct PageData<'a> {
    title: &'a str,
    control: &'a str,
    moves: u64,
    seconds: f64,
    notes: Vec<NoteData>,
    /// Those of the drawing first, in its order.
    sources: Vec<SourceData<'a>>,
    findings: Vec<FindingData<'a>>,
    toolpath: ViewerData<'a>,
}

#[derive(Debug, Serialize)]
struct SourceData<'a> {
    name: &'a str,
    text: Option<&'a str>,
}

#[derive(Debug, Serialize)]
struct NoteData {
    words: String,
    /// Index of the source of the block that it speaks of, and the block's line.
    file: Option<usize>,
    line: Option<u32>,
}

#[derive(Debug, Serialize)]
struct FindingData<'a> {
    /// Index of the source.
    file: usize,
    line: u32,
    severity: &'a str,
    rule: &'a str,
    message: &'a str,
}

impl Drawing {
    /// Writes the page.
    ///
    /// # Errors
    ///
    /// Those of the writer.
    pub fn write_page(&self, page: &Page<'_>, names: &Names<'_>, out: &mut dyn Write) -> io::Result<()> {
        let title = escaped(page.title);
        write!(
            out,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{BODY}\
             <script type=\"application/json\" id=\"data\">"
        )?;
        let data = self.page_data(page, names);
        data.serialize(&mut serde_json::Serializer::with_formatter(&mut *out, Harmless(CompactFormatter)))?;
        write!(out, "</script>\n<script type=\"module\">\n")?;
        for line in MODULES.iter().flat_map(|module| module.lines()).filter(|line| !is_import(line)) {
            writeln!(out, "{line}")?;
        }
        write!(out, "</script>\n</body>\n</html>\n")
    }

    fn page_data<'a>(&'a self, page: &Page<'a>, names: &Names<'_>) -> PageData<'a> {
        let text_of =
            |name: &str| page.sources.iter().find(|source| source.name == name).map(|source| source.text);
        let drawn = self.files.iter().map(String::as_str);
        let others = page.sources.iter().map(|source| source.name);
        let others = others.filter(|name| !self.files.iter().any(|file| file == name));
        let mut left = MAX_TEXT;
        let sources: Vec<SourceData<'a>> = drawn
            .chain(others)
            .map(|name| {
                let text = text_of(name).filter(|text| {
                    text.len() <= left
                        && text.bytes().filter(|byte| matches!(byte, b'\n' | b'\r')).count() < MAX_LINES
                });
                left -= text.map_or(0, str::len);
                SourceData { name, text }
            })
            .collect();
        let findings = page.findings.iter().filter_map(|finding| {
            let file = sources.iter().position(|source| source.name == finding.file)?;
            let Finding { line, severity, rule, message, .. } = *finding;
            Some(FindingData { file, line, severity, rule, message })
        });
        let source = |name: &String| sources.iter().position(|source| source.name == name);
        let notes = self.notes().into_iter().chain(page.notes.iter().cloned()).map(|note| {
            let Note { words, file, line } = note;
            NoteData { words, file: file.as_ref().and_then(source), line }
        });
        let notes = notes.collect();
        PageData {
            title: page.title,
            control: page.control,
            moves: self.moves,
            seconds: self.seconds,
            notes,
            findings: findings.collect(),
            sources,
            toolpath: self.viewer_data(names, page.headings),
        }
    }
}

/// Does a line of a module take names from another, or pass them on? Each such statement has its own line.
fn is_import(line: &str) -> bool {
    line.starts_with("import ") || line.starts_with("export {")
}

/// JSON without `<`, so that no text of a program can end the script that holds it.
struct Harmless(CompactFormatter);

impl Formatter for Harmless {
    fn write_string_fragment<W: ?Sized + Write>(&mut self, writer: &mut W, fragment: &str) -> io::Result<()> {
        let mut parts = fragment.split('<');
        if let Some(first) = parts.next() {
            self.0.write_string_fragment(writer, first)?;
        }
        for part in parts {
            writer.write_all(b"\\u003c")?;
            self.0.write_string_fragment(writer, part)?;
        }
        Ok(())
    }
}
