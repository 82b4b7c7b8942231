//! A program line by line: what the grammar says of each, blank lines, which lines may change.
//!
//! Knows: the grammar's events, lines, the part of the file that the control reads. Must not know: how a line is written
//! again (see [`crate::line`]). A line is looked at alone, but for blank lines in front of it and the nesting of loops around
//! it: an edit of one block moves no other.

use std::ops::Range;

use gcheck_controls::{Control, SystemValue};
use gcheck_diagnostics::Edit;
use gcheck_program::{Dialect, code_region};
use gcheck_syntax::{Sink, SourceText, SyntaxError, SyntaxKind, line_len, parse_into};

use crate::labels::Labels;
use crate::line::{Part, Writer};
use crate::nesting::Nesting;
use crate::ready::Ready;
use crate::style::{Indentation, SequenceNumbers, Style};

/// The edits that give a program the style, in text order.
///
/// With `lines`, counted from 0, only lines of that range change, and what they become is what they become when the whole
/// program is formatted: the range that an editor has selected, or the one line that was just finished.
pub fn format(text: &str, dialect: &Dialect<'_>, style: &Style, lines: Option<Range<u32>>) -> Vec<Edit> {
    let mut edits = Vec::new();
    let window = lines.map_or(0..text.len(), |lines| bytes_of(text, &lines));
    lay_out(text, dialect, style, &window, |range, new| edits.push(Edit { range, text: new.to_owned() }));
    edits
}

/// The bytes of a program file in the style; `None` when they are so already.
pub fn formatted(source: &SourceText, dialect: &Dialect<'_>, style: &Style) -> Option<Vec<u8>> {
    let text = source.text();
    let mut out: Option<Vec<u8>> = None;
    let mut at = 0;
    lay_out(text, dialect, style, &(0..text.len()), |range, new| {
        let out = out.get_or_insert_with(|| Vec::with_capacity(text.len() + text.len() / 8));
        let (start, end) = (range.start as usize, range.end as usize);
        out.extend_from_slice(text.as_bytes().get(at..start).unwrap_or_default());
        out.extend_from_slice(new.as_bytes());
        at = end;
    });
    let mut out = out?;
    out.extend_from_slice(text.as_bytes().get(at..).unwrap_or_default());
    restore(&mut out, source);
    Some(out)
}

/// Puts the bytes that are not UTF-8 in the places of their stand-ins, of which formatting moves some and loses none.
fn restore(out: &mut [u8], source: &SourceText) {
    if source.replaced().is_empty() {
        return;
    }
    // A stand-in may also be what the file itself holds, so they are counted along.
    let stand_in = SourceText::STAND_IN as u8;
    let mut replaced = source.replaced().iter().peekable();
    let before = memchr::memchr_iter(stand_in, source.text().as_bytes());
    let after: Vec<usize> = memchr::memchr_iter(stand_in, out).collect();
    for (old, new) in before.zip(after) {
        if let Some((_, byte)) = replaced.next_if(|(at, _)| *at as usize == old)
            && let Some(place) = out.get_mut(new)
        {
            *place = *byte;
        }
    }
}

/// The bytes of a range of lines, their ends included.
fn bytes_of(text: &str, lines: &Range<u32>) -> Range<usize> {
    let mut at = 0;
    let mut start = text.len();
    let mut line = 0;
    while at < text.len() && line < lines.end {
        if line == lines.start {
            start = at;
        }
        at += line_len(text.as_bytes().get(at..).unwrap_or_default());
        line += 1;
    }
    start.min(at)..at
}

/// Emits the edits that change bytes of `window`, which holds whole lines.
fn lay_out(
    text: &str,
    dialect: &Dialect<'_>,
    style: &Style,
    window: &Range<usize>,
    emit: impl FnMut(Range<u32>, &str),
) {
    let region = code_region(text);
    let end = window.end.min(region.end);
    // Nesting counts from the head of the file; without it only the blank lines in front matter.
    let start = match style.indentation {
        Indentation::Nested(_) => 0,
        Indentation::Keep | Indentation::None => head_of_blank_lines(text, window.start),
    };
    let Some(part) = text.get(start..end) else { return };
    let counts_lines = style.blank_lines < u32::MAX && reads_line_number(text, dialect.control());
    let labels = match style.sequence_numbers {
        SequenceNumbers::Drop => Some(Labels::of(text, dialect)),
        SequenceNumbers::Keep => None,
    };
    let mut layout = Layout {
        text: part,
        base: start as u32,
        window: window.start as u32..end as u32,
        ready: Ready::new(style, dialect),
        writer: Writer::new(style, dialect, labels),
        style,
        blank_lines: if counts_lines { u32::MAX } else { style.blank_lines },
        emit,
        parts: Vec::with_capacity(64),
        open: Vec::with_capacity(8),
        items: 0,
        verbatim: 0,
        has_error: false,
        nesting: Nesting::default(),
        blanks: 0,
        keeps_blank: true,
    };
    // Whether the line in front is one whose blank lines matter is seen from the line itself.
    if start > 0 {
        layout.keeps_blank = is_directive(line_before(text, start));
    }
    parse_into(part, dialect.profile(), &mut layout);
    layout.finish_line();
}

/// Does the program ask for the number of a line of its file, which a line that goes would change?
fn reads_line_number(text: &str, control: &Control) -> bool {
    let names: Vec<&str> = control
        .semantics()
        .system_variables
        .iter()
        .filter(|variable| variable.holds == SystemValue::LineNumber)
        .filter_map(|variable| variable.name.as_deref())
        .collect();
    let is_it = |at: usize| {
        let name = text.get(at + 1..).unwrap_or_default().chars().take_while(|c| *c != '>');
        let letters = name.filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_lowercase());
        names.iter().any(|known| letters.clone().eq(known.chars()))
    };
    !names.is_empty() && memchr::memchr_iter(b'<', text.as_bytes()).any(is_it)
}

/// Where the blank lines begin that end at `at`.
fn head_of_blank_lines(text: &str, at: usize) -> usize {
    let before = text.as_bytes().get(..at).unwrap_or_default();
    let blank = |byte: &u8| matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | 0x0B | 0x0C);
    let last = before.iter().rposition(|byte| !blank(byte)).map_or(0, |at| at + 1);
    // After the line that holds it.
    let rest = before.get(last..).unwrap_or_default();
    if last == 0 { 0 } else { last + line_len(rest).min(rest.len()) }
}

/// The line that ends at `at`.
fn line_before(text: &str, at: usize) -> &str {
    let before = text.get(..at).unwrap_or_default().trim_end_matches(['\n', '\r']);
    before.rsplit(['\n', '\r']).next().unwrap_or_default()
}

/// May a comment of the line speak for the line below it?
fn is_directive(line: &str) -> bool {
    line.contains("gcheck:")
}

struct Layout<'t, 's, F> {
    /// From a line's head to the end of what may change.
    text: &'t str,
    /// Its offset in the file.
    base: u32,
    /// Bytes of the file that may change.
    window: Range<u32>,
    style: &'s Style,
    /// The most blank lines that may follow each other.
    blank_lines: u32,
    ready: Ready,
    writer: Writer<'s>,
    emit: F,
    /// Tokens of the line.
    parts: Vec<Part>,
    /// Nodes that have begun and not ended, blocks not counted.
    open: Vec<SyntaxKind>,
    /// Items of the line: tokens and nodes directly in a block.
    items: u32,
    /// Depth of nodes whose text is not ours.
    verbatim: u32,
    has_error: bool,
    nesting: Nesting,
    /// Blank lines directly in front.
    blanks: u32,
    /// One blank line at least is to stay here: in front of all code, and after a directive, whose line below it is.
    keeps_blank: bool,
}

impl<F: FnMut(Range<u32>, &str)> Layout<'_, '_, F> {
    fn finish_line(&mut self) {
        let (Some(first), Some(last)) = (self.parts.first(), self.parts.last()) else { return };
        let has_end = last.kind == SyntaxKind::NEWLINE;
        let line = first.range.start..last.range.end;
        let is_inside = self.window.start <= self.base + line.start;
        let parts = self.parts.len() - usize::from(has_end);
        let parts = self.parts.get(..parts).unwrap_or_default();
        if parts.iter().all(|part| part.kind == SyntaxKind::WHITESPACE) {
            self.blanks = self.blanks.saturating_add(1);
            let most = self.blank_lines.max(u32::from(self.keeps_blank));
            let text_end = parts.last().map_or(line.start, |part| part.range.end);
            let gone = if self.blanks > most {
                line
            } else if self.style.drop_trailing_blanks {
                line.start..text_end
            } else {
                0..0
            };
            if is_inside && !gone.is_empty() {
                (self.emit)(self.base + gone.start..self.base + gone.end, "");
            }
        } else {
            self.blanks = 0;
            let text = self.text.get(line.start as usize..line.end as usize).unwrap_or_default();
            self.keeps_blank = is_directive(text);
            let depth = match self.style.indentation {
                Indentation::Nested(_) => self.nesting.pass(parts, self.text),
                Indentation::Keep | Indentation::None => 0,
            };
            if is_inside && !self.has_error {
                self.writer.write(self.text, parts, depth, self.base, &mut self.emit);
            }
        }
        self.parts.clear();
        self.items = 0;
        self.has_error = false;
    }

    fn item(&mut self) -> u32 {
        self.items += 1;
        self.items
    }
}

/// Printed text and commands to the firmware are not words.
fn is_verbatim(kind: SyntaxKind) -> bool {
    matches!(kind, SyntaxKind::PRINT_STATEMENT | SyntaxKind::COMMAND_STATEMENT)
}

impl<F: FnMut(Range<u32>, &str)> Sink for Layout<'_, '_, F> {
    type Checkpoint = usize;

    fn start_node(&mut self, kind: SyntaxKind) {
        if kind == SyntaxKind::BLOCK {
            return;
        }
        if self.open.is_empty() {
            self.item();
        }
        self.verbatim += u32::from(is_verbatim(kind));
        self.open.push(kind);
    }

    fn finish_node(&mut self) {
        match self.open.pop() {
            Some(kind) if is_verbatim(kind) => self.verbatim -= 1,
            None if self.parts.last().is_some_and(|part| part.kind == SyntaxKind::NEWLINE) => {
                self.finish_line();
            }
            Some(_) | None => {}
        }
    }

    fn checkpoint(&self) -> usize {
        self.parts.len()
    }

    fn start_node_at(&mut self, checkpoint: usize, kind: SyntaxKind) {
        if self.open.is_empty() {
            // What was an item by itself is a part of this one.
            let parts = self.parts.get_mut(checkpoint..).unwrap_or_default();
            let item = parts.first().map_or(self.items, |part| part.item);
            for part in parts {
                (part.item, part.outer) = (item, kind);
            }
            self.items = item;
        }
        self.verbatim += u32::from(is_verbatim(kind));
        self.open.push(kind);
    }

    fn token(&mut self, kind: SyntaxKind, range: Range<u32>) {
        let (outer, inner) = match (self.open.first(), self.open.last()) {
            (Some(outer), Some(inner)) => (*outer, *inner),
            _ => (kind, kind),
        };
        let item = if self.open.is_empty() { self.item() } else { self.items };
        self.parts.push(Part { kind, range, item, outer, inner, is_verbatim: self.verbatim > 0 });
    }

    fn error(&mut self, _: SyntaxError) {
        self.has_error = true;
    }

    fn lines_without_tokens(&mut self, from: u32) -> u32 {
        if !self.parts.is_empty() || self.nesting.depth() > 0 {
            return from;
        }
        let end = self.ready.lines(self.text.as_bytes(), from as usize) as u32;
        if end > from {
            (self.blanks, self.keeps_blank) = (0, false);
        }
        end
    }
}
