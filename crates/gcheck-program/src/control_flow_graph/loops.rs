//! Which `END` closes which `DO`.
//!
//! Knows: loop statements in text order, program by program. Must not know: conditions, wording of mistakes, how deep a
//! control nests.
//!
//! Pairs are made by number, the innermost open `DO` first. Loops that overlap (`DO1 DO2 END1 END2`) are paired too, and
//! listed: a control finds the partner by its number, and refuses the overlap for itself.

use std::collections::HashMap;

use super::link::NONE;

/// A loop statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Entry {
    block: u32,
    /// The block of its partner, or [`NONE`].
    partner: u32,
    begins: bool,
}

/// The loops of a file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Loops {
    /// In text order, one a block.
    entries: Vec<Entry>,
    unmatched: Vec<u32>,
    crossed: Vec<u32>,
}

impl Loops {
    fn find(&self, block: u32, begins: bool) -> Option<u32> {
        let at = self.entries.binary_search_by_key(&block, |e| e.block).ok()?;
        let entry = self.entries.get(at).filter(|e| e.begins == begins)?;
        super::link::known(entry.partner)
    }

    pub(super) fn end_of(&self, block: u32) -> Option<u32> {
        self.find(block, true)
    }

    pub(super) fn do_of(&self, block: u32) -> Option<u32> {
        self.find(block, false)
    }

    /// First and last block of each loop.
    pub(super) fn turns(&self) -> impl Iterator<Item = (u32, u32)> {
        let begun = self.entries.iter().filter(|entry| entry.begins);
        begun.filter_map(|entry| Some((entry.block, super::link::known(entry.partner)?)))
    }

    pub(super) fn unmatched(&self) -> &[u32] {
        &self.unmatched
    }

    pub(super) fn crossed(&self) -> &[u32] {
        &self.crossed
    }

    #[cfg(test)]
    pub(super) fn heap_bytes(&self) -> usize {
        self.entries.capacity() * size_of::<Entry>()
            + (self.unmatched.capacity() + self.crossed.capacity()) * size_of::<u32>()
    }
}

/// Pairs loop statements as they come.
#[derive(Debug, Clone, Default)]
pub(super) struct LoopBuilder {
    loops: Loops,
    /// Open `DO`s of this program by their number: indices of entries, innermost last.
    open: HashMap<u32, Vec<u32>>,
    /// Indices of this program's `DO`s, innermost last; those that are closed are taken off when they come to the end.
    nesting: Vec<u32>,
    /// `END`s that came while a loop inside was open, each with the index of that inner `DO`.
    early: Vec<(u32, u32)>,
}

impl LoopBuilder {
    /// The next loop statement; `number` is `None` when it is missing, computed or no whole number.
    pub(super) fn add(&mut self, block: u32, begins: bool, number: Option<u32>) {
        if self.loops.entries.last().is_some_and(|last| last.block == block) {
            // No control reads two loop statements in one block.
            self.loops.unmatched.push(block);
            return;
        }
        let ix = self.loops.entries.len() as u32;
        self.loops.entries.push(Entry { block, partner: NONE, begins });
        let Some(number) = number else { return };
        if begins {
            self.open.entry(number).or_default().push(ix);
            self.nesting.push(ix);
        } else if let Some(begin) = self.open.get_mut(&number).and_then(Vec::pop) {
            self.pair(begin, ix);
        }
    }

    fn pair(&mut self, begin: u32, end: u32) {
        let block = |ix: u32| self.loops.entries.get(ix as usize).map_or(NONE, |e| e.block);
        let (begin_block, end_block) = (block(begin), block(end));
        for (ix, partner) in [(begin, end_block), (end, begin_block)] {
            if let Some(entry) = self.loops.entries.get_mut(ix as usize) {
                entry.partner = partner;
            }
        }
        let entries = &self.loops.entries;
        let is_closed = |ix: &u32| entries.get(*ix as usize).is_none_or(|e| e.partner != NONE);
        while self.nesting.last().is_some_and(is_closed) {
            self.nesting.pop();
        }
        // What is open and began later lies inside.
        if let Some(inner) = self.nesting.last().filter(|inner| **inner > begin) {
            self.early.push((end_block, *inner));
        }
    }

    /// Another program begins: what is open stays open.
    pub(super) fn end_program(&mut self) {
        // New tables, for clearing a large one costs its size every time.
        self.open = HashMap::new();
        self.nesting.clear();
    }

    pub(super) fn finish(self) -> Loops {
        let mut loops = self.loops;
        let is_open = |entry: &&Entry| entry.partner == NONE;
        loops.unmatched.extend(loops.entries.iter().filter(is_open).map(|e| e.block));
        loops.unmatched.sort_unstable();
        loops.unmatched.dedup();
        // An inner loop that is never closed is unmatched, and does not cross.
        let closes_later = |inner: u32| loops.entries.get(inner as usize).is_some_and(|e| e.partner != NONE);
        loops.crossed =
            self.early.iter().filter(|(_, inner)| closes_later(*inner)).map(|(end, _)| *end).collect();
        loops.entries.shrink_to_fit();
        loops.unmatched.shrink_to_fit();
        loops
    }
}
