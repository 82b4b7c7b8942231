//! What the codes of a block ask of its words, and what hides it.
//!
//! Knows: when a block's words mean what the control's data says. Must not know: any rule.

use std::ops::Range;

use gcheck_controls::{Code, Letter, LetterSet};
use gcheck_program::{BlockFlags, Value, Word, lower};

use crate::{BlockCx, FileCx};

impl<'a> BlockCx<'a> {
    /// Do the block's words mean what its codes say? Not after a mistake in form, beside a code that is computed, unknown
    /// or the user's own, nor as arguments of a macro.
    pub(crate) fn words_are_plain(&self) -> bool {
        !self.block().flags.contains(BlockFlags::ERROR)
            && self.code_words().all(|word| {
                self.control()
                    .code_at(word.code)
                    .is_some_and(|code| !code.is_user() && !code.entry().any_words)
            })
    }

    /// Does a code of the block take its words as arguments of a macro? A computed code may.
    pub(crate) fn words_may_be_arguments(&self) -> bool {
        self.code_words().any(|word| {
            let is_g = word.letter == Letter::of('G');
            match self.control().code_at(word.code) {
                Some(code) => code.is_user() || is_g && code.entry().any_words,
                None => is_g && !matches!(word.value, Value::Number(_)),
            }
        })
    }

    /// The block's `G` and `M` words, known codes or not.
    pub(crate) fn code_words(&self) -> impl Iterator<Item = &'a Word> + use<'a> {
        self.words().iter().filter(|w| matches!(w.letter.ascii(), b'G' | b'M'))
    }

    /// The first word whose address is in the set.
    pub(crate) fn first_of(&self, letters: LetterSet) -> Option<&'a Word> {
        self.words().iter().find(|w| letters.contains(w.letter))
    }

    /// A code as the block writes it, `G01` where it says so.
    pub(crate) fn written(&self, code: Code<'_>) -> &'a str {
        let word = self
            .code_words()
            .find(|w| self.control().code_at(w.code).is_some_and(|c| c.number() == code.number()));
        word.map_or("", |word| self.text(word))
    }
}

impl FileCx<'_> {
    /// Reads a block again that the survey remembers by its place, and gives it to `look`.
    pub(crate) fn reread(&self, place: Range<u32>, mut look: impl FnMut(&BlockCx<'_>)) {
        let base = place.start;
        let text = self.slice(place);
        let table = lower(text, self.scene.dialect);
        for (ix, block) in table.blocks() {
            look(&BlockCx { scene: self.scene, table: &table, ix, block, text, base });
        }
    }

    /// Reads the file again, block by block. A rule that is on by default has no business here: it asks the survey.
    pub(crate) fn each_block(&self, mut look: impl FnMut(&BlockCx<'_>)) {
        let text = self.slice(0..self.region.end);
        for chunk in gcheck_syntax::cuts(text) {
            let base = chunk.start as u32;
            let text = text.get(chunk).unwrap_or_default();
            let table = lower(text, self.scene.dialect);
            for (ix, block) in table.blocks() {
                look(&BlockCx { scene: self.scene, table: &table, ix, block, text, base });
            }
        }
    }

    /// The line around a place, at most [`LINE`] bytes of it on either side.
    pub(crate) fn line_around(&self, place: Range<u32>) -> Range<u32> {
        let (base, text) = self.text.around(place.start);
        let is_end = |byte: &&u8| matches!(byte, b'\n' | b'\r');
        let inside = place.start.saturating_sub(base) as usize;
        let (head, tail) = text.as_bytes().split_at_checked(inside).unwrap_or_default();
        let before = head.iter().rev().take(LINE).take_while(|byte| !is_end(byte)).count() as u32;
        let behind = tail.iter().take(LINE).take_while(|byte| !is_end(byte)).count() as u32;
        place.start - before..place.start + behind
    }
}

/// No line of a control is longer; a file of one long line is not read again and again.
const LINE: usize = 1024;

/// The addresses of an item of `one-of` or `not-together`: `R`, `,C`, `@` or several letters as `IJK`.
pub(crate) fn letters_of(item: &str) -> LetterSet {
    match Letter::parse(item) {
        Some(letter) => LetterSet::from_iter([letter]),
        None => LetterSet::of(item),
    }
}

/// Addresses for people: "`I`, `J` or `R`".
pub(crate) fn choice(letters: LetterSet) -> String {
    let names: Vec<String> = letters.iter().map(|letter| format!("`{letter}`")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}
