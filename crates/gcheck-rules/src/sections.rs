//! The programs of one file: from an `O` number to the next.
//!
//! Knows: where each program of a file begins and ends, which sequence numbers and ends it has. Must not know: any rule.

use std::ops::Range;

use gcheck_controls::{Code, CodeIx, WordEntry, WordKind};
use gcheck_program::{Label, ProgramNumber, Survey};

use crate::FileCx;

/// One program of a file.
#[derive(Debug, Clone)]
pub struct Section<'a> {
    /// Its number; `None` for a file that has no number at all.
    pub number: Option<&'a ProgramNumber>,
    /// Its bytes. What stands in front of the first number belongs to the first program.
    pub range: Range<u32>,
}

/// Sequence numbers by value, for many look-ups.
#[derive(Debug)]
pub struct LabelIndex<'a> {
    by_number: Vec<&'a Label>,
}

impl<'a> LabelIndex<'a> {
    /// All labels of a number, in text order.
    pub fn all(&self, number: u32) -> &[&'a Label] {
        let start = self.by_number.partition_point(|l| l.number < number);
        let rest = self.by_number.get(start..).unwrap_or_default();
        rest.get(..rest.partition_point(|l| l.number == number)).unwrap_or_default()
    }

    /// The labels of a number in a program, in text order.
    pub fn within(&self, number: u32, program: &Range<u32>) -> &[&'a Label] {
        let all = self.all(number);
        let start = all.partition_point(|l| l.range.start < program.start);
        let rest = all.get(start..).unwrap_or_default();
        rest.get(..rest.partition_point(|l| l.range.start < program.end)).unwrap_or_default()
    }
}

impl<'a> FileCx<'a> {
    /// The programs of the file in text order; never empty.
    pub fn sections(&self) -> Vec<Section<'a>> {
        let survey: &'a Survey = self.survey;
        let mut sections: Vec<Section<'a>> = Vec::with_capacity(survey.programs.len().max(1));
        for number in &survey.programs {
            let start = sections.last_mut().map_or(0, |previous| {
                previous.range.end = number.range.start;
                number.range.start
            });
            sections.push(Section { number: Some(number), range: start..self.region.end });
        }
        if sections.is_empty() {
            sections.push(Section { number: None, range: 0..self.region.end });
        }
        sections
    }

    /// Bytes of the program in which an offset lies.
    pub fn program_around(&self, offset: u32) -> Range<u32> {
        let programs = &self.survey.programs;
        let next = programs.partition_point(|p| p.range.start <= offset);
        let start = |ix: usize| programs.get(ix).map(|p| p.range.start);
        match next {
            0 | 1 => 0..start(1).unwrap_or(self.region.end),
            _ => start(next - 1).unwrap_or(0)..start(next).unwrap_or(self.region.end),
        }
    }

    /// An index of the file's sequence numbers.
    pub fn label_index(&self) -> LabelIndex<'a> {
        let mut by_number: Vec<&Label> = self.survey.labels.iter().collect();
        // Stable: labels of one number stay in text order.
        by_number.sort_by_key(|l| l.number);
        LabelIndex { by_number }
    }

    /// The word of a code that names a label or a program, as data describes it.
    pub fn target_word(&self, code: CodeIx, kind: WordKind, word: &str) -> Option<(Code<'a>, &'a WordEntry)> {
        let code = self.control().code_at(code)?;
        let letter = word.get(..1)?;
        let entry =
            code.entry().words.iter().find(|w| w.kind == kind && w.letter.eq_ignore_ascii_case(letter))?;
        Some((code, entry))
    }

    /// Programs are kept and called by number: not so where `O` only labels flow control.
    pub fn keeps_programs_by_number(&self) -> bool {
        self.control().syntax().program_number && !self.control().syntax().o_words
    }

    /// Can anything on this control go to a sequence number?
    pub fn has_jumps(&self) -> bool {
        let named = |c: Code<'_>| c.entry().words.iter().any(|w| w.kind == WordKind::Label);
        self.control().syntax().macro_statements || self.control().codes().any(named)
    }
}

/// Is a block with a tape mark a line that begins with it, comments aside?
pub(crate) fn is_tape_mark_line(cx: &FileCx<'_>, block: &Range<u32>) -> bool {
    let block = cx.slice(block.clone());
    let block = block.trim_matches([' ', '\t', '\u{FEFF}', '\0']);
    let Some(behind) = block.strip_prefix('%') else { return false };
    // `%`, `% (PART)`, `%1234` and `%_N_PART_MPF` are heads of tapes; `% G0 X1.` is not.
    !behind.starts_with([' ', '\t'])
        || behind.trim_start().is_empty()
        || behind.trim_start().starts_with(['(', ';'])
}
