//! The programs of one file: from an `O` number to the next.
//!
//! Knows: where each program of a file begins and ends, which sequence numbers and ends it has. Must not know: any rule.

use std::ops::Range;

use crate::FileCx;
use gcheck_controls::{Code, CodeIx, WordEntry, WordKind};
use gcheck_program::{FileIndex, Label, ProgramNumber};

/// One program of a file.
#[derive(Debug, Clone)]
pub(crate) struct Section<'a> {
    /// Its number; `None` for a file that has no number at all.
    pub(crate) number: Option<&'a ProgramNumber>,
    /// Its bytes. Text before the first number belongs to the first program.
    pub(crate) range: Range<u32>,
}

/// Sequence numbers by value, for many look-ups.
#[derive(Debug)]
pub(crate) struct LabelIndex<'a> {
    by_number: Vec<&'a Label>,
}

impl<'a> LabelIndex<'a> {
    /// All labels of a number, in text order.
    pub(crate) fn all(&self, number: u32) -> &[&'a Label] {
        let start = self.by_number.partition_point(|l| l.number < number);
        let rest = self.by_number.get(start..).unwrap_or_default();
        rest.get(..rest.partition_point(|l| l.number == number)).unwrap_or_default()
    }

    /// The labels of a number in a program, in text order.
    pub(crate) fn within(&self, number: u32, program: &Range<u32>) -> &[&'a Label] {
        let all = self.all(number);
        let start = all.partition_point(|l| l.range.start < program.start);
        let rest = all.get(start..).unwrap_or_default();
        rest.get(..rest.partition_point(|l| l.range.start < program.end)).unwrap_or_default()
    }
}

/// The programs of the file in text order; never empty.
pub(crate) fn sections<'a>(cx: &FileCx<'a>) -> Vec<Section<'a>> {
    let file_index: &'a FileIndex = cx.file_index;
    let mut sections: Vec<Section<'a>> = Vec::with_capacity(file_index.programs.len().max(1));
    for number in &file_index.programs {
        let start = sections.last_mut().map_or(0, |previous| {
            previous.range.end = number.range.start;
            number.range.start
        });
        sections.push(Section { number: Some(number), range: start..cx.region.end });
    }
    if sections.is_empty() {
        sections.push(Section { number: None, range: 0..cx.region.end });
    }
    sections
}

/// Bytes of the program in which an offset lies.
pub(crate) fn program_around(cx: &FileCx<'_>, offset: u32) -> Range<u32> {
    let programs = &cx.file_index.programs;
    let next = programs.partition_point(|p| p.range.start <= offset);
    let start = |ix: usize| programs.get(ix).map(|p| p.range.start);
    match next {
        0 | 1 => 0..start(1).unwrap_or(cx.region.end),
        _ => start(next - 1).unwrap_or(0)..start(next).unwrap_or(cx.region.end),
    }
}

/// An index of the file's sequence numbers.
pub(crate) fn label_index<'a>(cx: &FileCx<'a>) -> LabelIndex<'a> {
    let mut by_number: Vec<&Label> = cx.file_index.labels.iter().collect();
    // Stable: labels of one number stay in text order.
    by_number.sort_by_key(|l| l.number);
    LabelIndex { by_number }
}

/// The word of a code that names a label or a program, as data describes it.
pub(crate) fn target_word<'a>(
    cx: &FileCx<'a>,
    code: CodeIx,
    kind: WordKind,
    word: &str,
) -> Option<(Code<'a>, &'a WordEntry)> {
    let code = cx.control().code_at(code)?;
    let letter = word.get(..1)?;
    let entry =
        code.entry().words.iter().find(|w| w.kind == kind && w.letter.eq_ignore_ascii_case(letter))?;
    Some((code, entry))
}

/// Programs are kept and called by number: not so where `O` only labels flow control.
pub(crate) fn keeps_programs_by_number(cx: &FileCx<'_>) -> bool {
    cx.control().syntax().program_number && !cx.control().syntax().o_words
}

/// Can anything on this control go to a sequence number?
pub(crate) fn has_jumps(cx: &FileCx<'_>) -> bool {
    let named = |c: Code<'_>| c.entry().words.iter().any(|w| w.kind == WordKind::Label);
    cx.control().syntax().macro_statements || cx.control().codes().any(named)
}

/// Is a block with a tape mark a line that begins with it, comments aside?
pub(crate) fn is_tape_mark_line(cx: &FileCx<'_>, block: &Range<u32>) -> bool {
    let block = cx.slice(block.clone());
    let block = block.trim_matches([' ', '\t', '\u{FEFF}', '\0']);
    let Some(rest) = block.strip_prefix('%') else { return false };
    // `%`, `% (PART)`, `%1234` and `%_N_PART_MPF` are heads of tapes; `% G0 X1.` is not.
    !rest.starts_with([' ', '\t'])
        || rest.trim_start().is_empty()
        || rest.trim_start().starts_with(['(', ';'])
}
