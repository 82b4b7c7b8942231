//! A modal code of a program that becomes another one: `G90` for `G91`, `G20` for `G21`.
//!
//! Knows: which mode is in effect in the changed program, where it needs a code. Must not know: what the mode does to words.

use std::collections::BTreeMap;

use gcheck_engine::{Model, Role};
use gcheck_program::{Place, Word};

use crate::refusal::Refusal;
use crate::run::Executed;

/// The mode of a role along a run of the changed program.
pub(crate) struct Modal<'c> {
    model: &'c Model<'c>,
    role: Role,
    /// The mode in effect in the changed program.
    current: Option<bool>,
    /// What a block's own code becomes, by its number.
    pub(crate) own: BTreeMap<u32, bool>,
    /// Blocks that get a code, by their number.
    pub(crate) inserted: BTreeMap<u32, bool>,
}

impl<'c> Modal<'c> {
    pub(crate) fn new(role: Role, model: &'c Model<'c>) -> Self {
        Self { model, role, current: None, own: BTreeMap::new(), inserted: BTreeMap::new() }
    }

    pub(crate) fn begin(&mut self) {
        self.current = None;
    }

    /// The word of a block that switches the mode.
    pub(crate) fn code(&self, place: &Place) -> Option<Word> {
        let words = place.table.words(place.block());
        words
            .iter()
            .find(|word| word.code.is_some() && self.model.role(word.code) == Some(self.role))
            .copied()
    }

    /// A block runs: in the mode `was` so far, and its words need the mode `needs`. `otherwise` is what a code of its own becomes
    /// when its words need none.
    pub(crate) fn executed(
        &mut self,
        block: &Executed<'_>,
        was: bool,
        needs: Option<bool>,
        otherwise: bool,
    ) -> Result<(), Refusal> {
        let number = block.at.block;
        let has_code = self.code(block.place).is_some();
        if self.current.is_none() && !has_code {
            self.current = Some(was);
        }
        let twice = "this block runs more than once, in another mode each time";
        if has_code {
            let new = if block.file.is_some() { was } else { needs.unwrap_or(otherwise) };
            self.current = Some(new);
            if block.file.is_none() && self.own.insert(number, new).is_some_and(|old| old != new) {
                return Err(block.refusal(twice));
            }
            return Ok(());
        }
        let Some(needs) = needs else { return Ok(()) };
        if self.current == Some(needs) {
            return Ok(());
        }
        if block.file.is_some() {
            let reason =
                "this block is in another file, which stays as it is, and it would run in another mode";
            return Err(block.refusal(reason));
        }
        self.current = Some(needs);
        if self.inserted.insert(number, needs).is_some_and(|old| old != needs) {
            return Err(block.refusal(twice));
        }
        Ok(())
    }
}
