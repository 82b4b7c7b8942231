//! Whether the codes of a block decide what its words mean, as the control's data states it.
//!
//! Knows: what makes words mean something else: mistakes in form, computed and user codes, macro calls. Must not know: any rule.

use gcheck_controls::{Code, Letter, LetterSet};
use gcheck_program::{BlockFlags, Value, Word};

use crate::{BlockCx, WordFacts};

impl<'a> BlockCx<'a> {
    /// Do the block's words mean what its codes say? Not after a mistake in form, beside a code that is computed, unknown
    /// or the user's own, nor as arguments of a macro.
    pub fn words_are_plain(&self) -> bool {
        !self.block().flags.contains(BlockFlags::ERROR)
            && self.code_words().all(|word| {
                self.control()
                    .code_at(word.code)
                    .is_some_and(|code| !code.is_user() && !code.entry().any_words)
            })
    }

    /// As [`Self::words_are_plain`], of one word: a code that takes arguments reads some words itself, as the number of the
    /// program.
    pub fn is_plain(&self, facts: &WordFacts<'_>) -> bool {
        let is_own = |code: Code<'_>| code.entry().any_words && !code.is_user();
        let is_known = |word: &Word| self.control().code_at(word.code).is_some_and(|code| !code.is_user());
        self.words_are_plain()
            || !self.block().flags.contains(BlockFlags::ERROR)
                && facts.code.is_some_and(is_own)
                && self.code_words().all(is_known)
    }

    /// Does a code of the block take its words as arguments of a macro? A computed code may.
    pub fn words_may_be_arguments(&self) -> bool {
        self.code_words().any(|word| {
            let is_g = word.letter == Letter::of('G');
            match self.control().code_at(word.code) {
                Some(code) => code.is_user() || is_g && code.entry().any_words,
                None => is_g && !matches!(word.value, Value::Number(_)),
            }
        })
    }

    /// The block's `G` and `M` words, known codes or not.
    pub fn code_words(&self) -> impl Iterator<Item = &'a Word> + use<'a> {
        self.words().iter().filter(|w| matches!(w.letter.ascii(), b'G' | b'M'))
    }

    /// The first word whose address is in the set.
    pub fn first_of(&self, letters: LetterSet) -> Option<&'a Word> {
        self.words().iter().find(|w| letters.contains(w.letter))
    }

    /// A code as the block writes it, `G01` where it says so.
    pub fn written(&self, code: Code<'_>) -> &'a str {
        let word = self
            .code_words()
            .find(|w| self.control().code_at(w.code).is_some_and(|c| c.number() == code.number()));
        word.map_or("", |word| self.text(word))
    }
}
