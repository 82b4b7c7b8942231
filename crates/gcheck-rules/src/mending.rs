//! Fixes that several rules make: a word taken away, a block put in front of another.
//!
//! Knows: where words, blocks and lines begin and end. Must not know: any rule, whether a fix is wanted.

use std::ops::Range;

use gcheck_controls::Letter;
use gcheck_engine::At;
use gcheck_program::Word;

use crate::{BlockCx, Finding, Fix, PathCx};

impl Finding {
    /// A way to mend it, where there is one.
    #[must_use]
    pub(crate) fn fix_if(mut self, fix: Option<Fix>) -> Self {
        self.fixes.extend(fix);
        self
    }
}

impl BlockCx<'_> {
    /// The word with the blanks in front of it: what goes when the word goes.
    pub(crate) fn with_blanks(&self, word: &Word) -> Range<u32> {
        self.in_file(self.with_blanks_before(word.range()))
    }

    /// Bytes of the chunk with the blanks in front of them.
    pub(crate) fn with_blanks_before(&self, range: Range<u32>) -> Range<u32> {
        let before = self.slice(0..range.start);
        let blanks = before.len() - before.trim_end_matches([' ', '\t']).len();
        range.start - blanks as u32..range.end
    }

    /// Takes a word away; whether it was meant, only the programmer knows.
    pub(crate) fn taking_away(&self, word: &Word) -> Fix {
        Fix::risky(format!("take `{}` away", self.text(word)), self.with_blanks(word), "")
    }
}

impl PathCx<'_> {
    /// The word with an address, and the blanks in front of it, taken away.
    pub(crate) fn taking_away(&self, letter: char, title: &str) -> Option<Fix> {
        let place = self.place()?;
        let is_it = |word: &&Word| word.letter == Letter::of(letter) && !word.letter.is_corner();
        let word = place.table.words(place.block()).iter().find(is_it)?.range();
        let file = self.program.file(self.origin().at.file)?;
        let before = file.loaded.chunk_text(place.chunk).get(..word.start as usize)?;
        let blanks = before.len() - before.trim_end_matches([' ', '\t']).len();
        let range = place.base + word.start - blanks as u32..place.base + word.end;
        Some(Fix::risky(title, range, ""))
    }

    /// Puts a code in a block of its own in front of this one.
    pub(crate) fn block_before(&self, code: Option<&str>) -> Option<Fix> {
        self.block_before_at(self.origin().at, code)
    }

    /// Puts a code in a block of its own in front of a block of the main file. `None` without a code, and where something
    /// else stands on the line before the block.
    pub(crate) fn block_before_at(&self, at: At, code: Option<&str>) -> Option<Fix> {
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

/// The end of the line that a text is in the middle of, as the file writes it.
pub(crate) fn line_end(rest: &str) -> &'static str {
    match rest.find(['\n', '\r']).and_then(|at| rest.get(at..)) {
        Some(end) if end.starts_with("\r\n") => "\r\n",
        Some(end) if end.starts_with('\r') => "\r",
        _ => "\n",
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{World, findings, fixed};
    use crate::{Selection, by_id};

    /// A program with the first fix of one rule in it.
    fn mended(rule: &str, control: &str, program: &str) -> String {
        let found = findings(&Selection::only(by_id(rule).unwrap()), control, program, &World::default());
        found.iter().map(|finding| fixed(program, finding)).collect()
    }

    #[test]
    fn a_block_before_has_the_line_end_of_the_file() {
        assert_eq!(
            mended(
                "cycle-left-on",
                "haas-mill",
                "G90 G54 G0 X0. Y0.\r\nG81 Z-1. R.1 F1.\r\n  N9 T2 M6\r\nM30\r\n"
            ),
            "G90 G54 G0 X0. Y0.\r\nG81 Z-1. R.1 F1.\r\nG80\r\n  N9 T2 M6\r\nM30\r\n",
        );
    }

    #[test]
    fn no_block_is_put_between_two_of_one_line() {
        let program = "G90 G54 G0 X0. Y0.;G81 Z-1. R.1 F1.;T2 M6\nM30\n";
        assert_eq!(mended("cycle-left-on", "haas-mill", program), program, "told, and not mended");
    }

    #[test]
    fn a_word_goes_with_the_blanks_before_it() {
        assert_eq!(mended("word-not-read", "linuxcnc", "G0 X1\t H3 Y2\n"), "G0 X1 Y2\n",);
    }
}
