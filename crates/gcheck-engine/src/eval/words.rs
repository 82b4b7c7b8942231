//! The words of one block with their values.
//!
//! Knows: which addresses stand in the block, their values as the control counts them, the codes in text order. Must not know:
//! units (a word is a length only to the code that reads it), effects.

use gcheck_controls::{CodeIx, Letter, LetterSet};

use crate::eval::value::Domain;

/// Codes that fit in one block; a block with more repeats itself and is refused anyway.
const MOST_CODES: usize = 24;

/// The words of one block.
#[derive(Debug, Clone)]
pub(crate) struct BlockWords<D: Domain> {
    /// Addresses with a value; words whose value is vacant are left out, as the controls do.
    present: LetterSet,
    /// Addresses written with a decimal point, or computed on controls where that counts as one.
    pointed: LetterSet,
    /// Addresses whose value stands in `numbers`; that of others stands in `values`.
    literal: LetterSet,
    numbers: [f64; Letter::COUNT],
    values: Vec<D::Value>,
    codes: [CodeIx; MOST_CODES],
    code_count: usize,
}

impl<D: Domain> BlockWords<D> {
    pub(crate) fn new() -> Self {
        Self {
            present: LetterSet::EMPTY,
            pointed: LetterSet::EMPTY,
            literal: LetterSet::EMPTY,
            numbers: [0.0; Letter::COUNT],
            values: vec![D::vacant(); Letter::COUNT],
            codes: [CodeIx::NONE; MOST_CODES],
            code_count: 0,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.present = LetterSet::EMPTY;
        self.pointed = LetterSet::EMPTY;
        self.literal = LetterSet::EMPTY;
        self.code_count = 0;
    }

    /// Puts a number as it is written, finite.
    pub(crate) fn put_number(&mut self, letter: Letter, number: f64, pointed: bool) {
        if !number.is_finite() {
            self.put(letter, D::number(number), pointed);
        } else if let Some(slot) = self.numbers.get_mut(letter.index()) {
            // Zero has no sign.
            *slot = number + 0.0;
            self.present.insert(letter);
            self.literal.insert(letter);
            if pointed {
                self.pointed.insert(letter);
            }
        }
    }

    pub(crate) fn put(&mut self, letter: Letter, value: D::Value, pointed: bool) {
        if let Some(slot) = self.values.get_mut(letter.index()) {
            *slot = value;
            self.present.insert(letter);
            self.literal = self.literal.without([letter].into_iter().collect());
            if pointed {
                self.pointed.insert(letter);
            }
        }
    }

    pub(crate) fn put_code(&mut self, code: CodeIx) {
        if let Some(slot) = self.codes.get_mut(self.code_count) {
            *slot = code;
            self.code_count += 1;
        }
    }

    /// Addresses with a value.
    pub(crate) fn present(&self) -> LetterSet {
        self.present
    }

    pub(crate) fn has(&self, letter: Letter) -> bool {
        self.present.contains(letter)
    }

    pub(crate) fn is_pointed(&self, letter: Letter) -> bool {
        self.pointed.contains(letter)
    }

    pub(crate) fn codes(&self) -> &[CodeIx] {
        self.codes.get(..self.code_count).unwrap_or_default()
    }

    /// The value of an address, if it stands in the block.
    pub(crate) fn get(&self, letter: Letter) -> Option<D::Value> {
        if self.literal.contains(letter) {
            self.numbers.get(letter.index()).copied().map(D::number)
        } else if self.has(letter) {
            self.values.get(letter.index()).cloned()
        } else {
            None
        }
    }

    /// The number of an address: `None` when it does not stand, NaN when its value is not known.
    pub(crate) fn number(&self, letter: Letter) -> Option<f64> {
        if self.literal.contains(letter) {
            self.numbers.get(letter.index()).copied()
        } else if self.has(letter) {
            self.values.get(letter.index()).map(|value| D::known(value).unwrap_or(f64::NAN))
        } else {
            None
        }
    }
}
