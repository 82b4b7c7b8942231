//! Fixes that rules propose: a word removed, a block inserted before another.
//!
//! Knows: where words, blocks and lines begin and end. Must not know: any rule, whether a fix is wanted.

use std::ops::Range;

use gcheck_controls::Letter;
use gcheck_diagnostics::Fix;
use gcheck_engine::At;
use gcheck_program::{BlockFlags, Word};

use crate::{BlockCx, PathCx};

impl BlockCx<'_> {
    /// The word with the blanks before it: what is removed with the word.
    pub fn with_blanks(&self, word: &Word) -> Range<u32> {
        self.in_file(self.with_blanks_before(word.range()))
    }

    /// Bytes of the chunk with the blanks before them.
    pub fn with_blanks_before(&self, range: Range<u32>) -> Range<u32> {
        let before = self.slice(0..range.start);
        let blanks = before.len() - before.trim_end_matches([' ', '\t']).len();
        range.start - blanks as u32..range.end
    }

    /// Begins a block of its own with a word. `None` where the head of the block is for all of it: a statement, a block delete.
    pub fn block_from(&self, word: &Word) -> Option<Fix> {
        if self.block().flags.intersects(BlockFlags::STATEMENT | BlockFlags::BLOCK_DELETE) {
            return None;
        }
        let before = self.with_blanks(word).start..self.range(word).start;
        let end = line_end(self.slice(self.block().range.end..self.text.len() as u32));
        Some(Fix::risky(format!("put `{}` in a block of its own", self.text(word)), before, end))
    }

    /// Removes a word; only the programmer knows whether it was meant.
    pub fn removal_of(&self, word: &Word) -> Fix {
        Fix::risky(format!("take `{}` away", self.text(word)), self.with_blanks(word), "")
    }
}

impl PathCx<'_> {
    /// Removes the word with an address, and the blanks before it.
    pub fn removal_of(&self, letter: char, title: &str) -> Option<Fix> {
        let place = self.place()?;
        let is_it = |word: &&Word| word.letter == Letter::of(letter);
        let word = place.table.words(place.block()).iter().find(is_it)?.range();
        let file = self.program.file(self.origin().at.file)?;
        let before = file.loaded.chunk_text(place.chunk).get(..word.start as usize)?;
        let blanks = before.len() - before.trim_end_matches([' ', '\t']).len();
        let range = place.base + word.start - blanks as u32..place.base + word.end;
        Some(Fix::risky(title, range, ""))
    }

    /// Inserts a code in a block of its own before this one.
    pub fn block_before(&self, code: Option<&str>) -> Option<Fix> {
        self.block_before_at(self.origin().at, code)
    }

    /// Inserts a code in a block of its own before a block of the main file. `None` without a code, and where the line holds
    /// something else before the block.
    pub fn block_before_at(&self, at: At, code: Option<&str>) -> Option<Fix> {
        let code = code.filter(|code| !code.is_empty())?;
        let place = self.place_of(at).filter(|_| at.file == 0)?;
        let text = self.program.file(0)?;
        let text = text.loaded.chunk_text(place.chunk);
        let block = place.block().range.clone();
        let before = text.get(..block.start as usize)?.trim_end_matches([' ', '\t']);
        if !before.is_empty() && !before.ends_with(['\n', '\r', '\u{FEFF}']) {
            return None;
        }
        let start = place.base + before.len() as u32;
        let title = format!("put `{code}` in a block before this one");
        Some(Fix::risky(title, start..start, format!("{code}{}", line_end(text.get(block.end as usize..)?))))
    }
}

/// The line end that the file uses, read from the rest of a line.
pub fn line_end(rest: &str) -> &'static str {
    match rest.find(['\n', '\r']).and_then(|at| rest.get(at..)) {
        Some(end) if end.starts_with("\r\n") => "\r\n",
        Some(end) if end.starts_with('\r') => "\r",
        _ => "\n",
    }
}
