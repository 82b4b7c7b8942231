//! Modes that shift the axes by the tool: a length along a tilting tool, a cutter's size along a vector.
//!
//! Knows: which of them a block is executed under, what people call them. Must not know: any rule.

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_engine::{Fact, Role};
use gcheck_program::Word;

use crate::boundary::LeftOn;
use crate::{Finding, PathCx};

/// Is the length of the tool added along the tool?
pub(crate) fn is_along_tool(effect: Effect) -> bool {
    effect == Effect::LengthFiveAxis
}

/// Is the path shifted along the vector of each block?
pub(crate) fn is_along_vectors(effect: Effect) -> bool {
    effect == Effect::CompensationVector
}

impl PathCx<'_> {
    /// The code that holds while the block under way moves: its own, or the one in effect.
    pub(crate) fn in_effect(&self, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<LeftOn> {
        let own = self.codes().iter().copied().rfind(|code| self.model.role(*code) == Some(role));
        let on = |code: CodeIx| code.is_some() && is_on(self.model.effect(code));
        if let Some(code) = own {
            return on(code).then_some(LeftOn::Surely(code));
        }
        if role == Role::Length && self.has_word(|word| is_word(word, 'H') && word.number() == Some(0.0)) {
            return None;
        }
        let mode = self.state().mode(role);
        match mode.only() {
            Some(code) => on(code).then_some(LeftOn::Surely(code)),
            None => mode.alternatives().iter().copied().find(|code| on(*code)).map(LeftOn::Maybe),
        }
    }

    /// Adds where a mode was switched on, unless the block itself did.
    pub(crate) fn resting_on_mode(&self, finding: Finding, role: Role) -> Finding {
        if self.codes().iter().any(|code| self.model.role(*code) == Some(role)) {
            return finding;
        }
        match self.code_name(role) {
            Some(name) => self.resting_on(finding, Fact::Mode(role), &format!("`{name}`")),
            None => finding,
        }
    }

    /// Has the block a word that `is` says yes to?
    pub(crate) fn has_word(&self, is: impl Fn(&Word) -> bool) -> bool {
        self.find_word(self.origin().at, is).is_some()
    }

    /// The first word of the block with an address.
    pub(crate) fn word(&self, letter: char) -> Option<Word> {
        let place = self.place()?;
        place.table.words(place.block()).iter().find(|word| is_word(word, letter)).copied()
    }
}

fn is_word(word: &Word, letter: char) -> bool {
    word.letter == Letter::of(letter) && !word.letter.is_corner()
}
