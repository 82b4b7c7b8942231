//! What the computed words of a block come to in a state.
//!
//! Knows: which values are certain, which code a computed `G` or `M` word names. Must not know: any rule, how the state came
//! about.

use std::cell::{OnceCell, RefCell};

use gcheck_controls::CodeIx;
use gcheck_engine::{Abstract, AbstractValue, At, Domain, Look, Model, State, Truth};
use gcheck_program::{Block, Dialect, Place, Word};

/// Evaluates the computed words of blocks; one for an analysis, as making it costs more than most words.
pub(crate) trait Evaluate {
    /// The computed words of a block with their values in the state before it; those that have no value are left out.
    fn words(&self, place: &Place, at: At, state: &State<Abstract>) -> Vec<(Word, AbstractValue)>;
}

impl Evaluate for RefCell<Look<'_, '_>> {
    fn words(&self, place: &Place, at: At, state: &State<Abstract>) -> Vec<(Word, AbstractValue)> {
        self.try_borrow_mut().map_or_else(|_| Vec::new(), |mut look| look.words(place, at, state))
    }
}

/// What was evaluated of a block, each part when the first rule asked for it.
#[derive(Default)]
pub(crate) struct Evaluated {
    words: OnceCell<Vec<(Word, AbstractValue)>>,
    block: OnceCell<Option<BlockOfValues>>,
}

impl Evaluated {
    /// The computed words with what they may be.
    pub(crate) fn words(
        &self,
        evaluate: impl FnOnce() -> Vec<(Word, AbstractValue)>,
    ) -> &[(Word, AbstractValue)] {
        self.words.get_or_init(evaluate)
    }

    /// The block with the values that are certain.
    pub(crate) fn block(&self, make: impl FnOnce() -> Option<BlockOfValues>) -> Option<&BlockOfValues> {
        self.block.get_or_init(make).as_ref()
    }
}

/// A block with a number in each computed word whose value is certain.
pub(crate) struct BlockOfValues {
    /// Its addresses and flags as if the numbers were written.
    pub(crate) block: Block,
    /// All its words; those that have no certain value are as written, those of empty variables are left out.
    pub(crate) words: Vec<Word>,
    /// Those that were left out.
    pub(crate) left_out: Vec<Word>,
    /// It has other codes or addresses than the block as it is written.
    pub(crate) has_others: bool,
}

impl BlockOfValues {
    /// `None` when no value is certain.
    pub(crate) fn new(
        place: &Place,
        values: &[(Word, AbstractValue)],
        model: &Model<'_>,
        dialect: &Dialect<'_>,
    ) -> Option<Self> {
        let written = place.table.words(place.block());
        let (mut words, mut left_out) = (Vec::with_capacity(written.len()), Vec::new());
        let (mut any, mut has_others) = (false, false);
        for word in written {
            // The control ignores the address beside an empty variable.
            if is_empty(word, values) {
                (any, has_others) = (true, true);
                left_out.push(*word);
            } else if let Some(value) = certain(word, values, model) {
                any = true;
                has_others |= is_code(word);
                words.push(value);
            } else {
                words.push(*word);
            }
        }
        any.then(|| Self { block: dialect.with_words(place.block(), &words), words, left_out, has_others })
    }

    /// The words that hold a computed number.
    pub(crate) fn computed(&self) -> impl Iterator<Item = &Word> {
        self.words.iter().filter(|word| word.is_computed() && word.number().is_some())
    }
}

/// The words of a block, of which the computed codes are known where their values are.
pub(crate) fn with_codes(words: &[Word], values: &[(Word, AbstractValue)], model: &Model<'_>) -> Vec<Word> {
    let mut words = words.to_vec();
    for word in &mut words {
        if let Some(value) = certain(word, values, model).filter(|value| value.code.is_some()) {
            word.code = value.code;
        }
    }
    words
}

/// The word with its value, if that is the same on every path, and a code of the control where it names one.
fn certain(word: &Word, values: &[(Word, AbstractValue)], model: &Model<'_>) -> Option<Word> {
    let value = Abstract::known(value_of(word, values)?)?;
    let code = if is_code(word) { model.code_of_value(word.letter, value) } else { None };
    Some(word.with_value(value, code.unwrap_or(CodeIx::NONE)))
}

/// Is the word computed from variables that are empty on every path?
fn is_empty(word: &Word, values: &[(Word, AbstractValue)]) -> bool {
    value_of(word, values).is_some_and(|value| Abstract::is_vacant(value) == Truth::True)
}

fn value_of<'v>(word: &Word, values: &'v [(Word, AbstractValue)]) -> Option<&'v AbstractValue> {
    values.iter().find(|(computed, _)| computed.range() == word.range()).map(|(_, value)| value)
}

fn is_code(word: &Word) -> bool {
    matches!(word.letter.ascii(), b'G' | b'M') && !word.letter.is_corner()
}
