//! Which blocks were reached.
//!
//! Knows: blocks by file and number. Must not know: how they are reached. Costs little where few blocks are marked, wherever
//! they stand.

use crate::origin::At;

/// A set of blocks: a bit a block, in words of 64; only words with a block are kept, in order.
#[derive(Debug, Clone, Default)]
pub(super) struct Marks {
    words: Vec<Word>,
    /// Where a block was marked last: the next one is likely to stand beside it.
    last: usize,
}

#[derive(Debug, Clone, Copy)]
struct Word {
    file: u32,
    /// Number of its first block, divided by 64.
    index: u32,
    bits: u64,
}

impl Word {
    fn key(&self) -> (u32, u32) {
        (self.file, self.index)
    }
}

impl Marks {
    pub(super) fn contains(&self, at: At) -> bool {
        let key = (at.file, at.block / 64);
        let found = self.words.binary_search_by_key(&key, Word::key).ok();
        found.and_then(|ix| self.words.get(ix)).is_some_and(|word| word.bits & (1 << (at.block % 64)) != 0)
    }

    pub(super) fn insert(&mut self, at: At) {
        self.insert_bits(at.file, at.block / 64, 1 << (at.block % 64));
    }

    /// The blocks from `from` to before `to`, which stands in the same file.
    pub(super) fn insert_all(&mut self, from: At, to: At) {
        let mut block = from.block;
        while block < to.block {
            let index = block / 64;
            let end = index.saturating_add(1).saturating_mul(64).min(to.block);
            // From the block up, and not past the end.
            let above = u64::MAX << (block % 64);
            let below = if end.is_multiple_of(64) { u64::MAX } else { (1 << (end % 64)) - 1 };
            self.insert_bits(from.file, index, above & below);
            block = end;
        }
    }

    fn insert_bits(&mut self, file: u32, index: u32, bits: u64) {
        let key = (file, index);
        if let Some(word) = self.words.get_mut(self.last).filter(|word| word.key() == key) {
            word.bits |= bits;
            return;
        }
        self.last = if self.words.last().is_none_or(|word| word.key() < key) {
            self.words.push(Word { file, index, bits });
            self.words.len() - 1
        } else {
            match self.words.binary_search_by_key(&key, Word::key) {
                Ok(ix) => {
                    if let Some(word) = self.words.get_mut(ix) {
                        word.bits |= bits;
                    }
                    ix
                }
                Err(ix) => {
                    self.words.insert(ix, Word { file, index, bits });
                    ix
                }
            }
        };
    }

    /// The first block from `from` on, in its file, that is not in the set.
    pub(super) fn first_missing(&self, from: At) -> At {
        let mut block = from.block;
        let start = self.words.partition_point(|word| word.key() < (from.file, block / 64));
        for word in self.words.get(start..).unwrap_or_default() {
            if word.key() != (from.file, block / 64) {
                break;
            }
            // The bits in front of the block count as set.
            let missing = !(word.bits | ((1 << (block % 64)) - 1));
            if missing != 0 {
                return At { block: block / 64 * 64 + missing.trailing_zeros(), ..from };
            }
            block = (block / 64 + 1) * 64;
        }
        At { block, ..from }
    }

    /// Runs of blocks: the first of each, and the number behind its last.
    pub(super) fn runs(&self) -> Vec<(At, u32)> {
        let mut runs: Vec<(At, u32)> = Vec::new();
        for word in &self.words {
            let mut bits = word.bits;
            let mut block = word.index * 64;
            while bits != 0 {
                let skip = bits.trailing_zeros();
                block += skip;
                bits >>= skip;
                let len = (!bits).trailing_zeros();
                match runs.last_mut() {
                    Some((from, end)) if from.file == word.file && *end == block => *end += len,
                    _ => runs.push((At { file: word.file, block }, block + len)),
                }
                block += len;
                bits = if len == 64 { 0 } else { bits >> len };
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::Marks;
    use crate::origin::At;

    #[test]
    fn the_first_block_that_is_missing_is_found() {
        let at = |block: u32| At { file: 1, block };
        let mut marks = Marks::default();
        assert_eq!(marks.first_missing(at(5)), at(5));
        marks.insert_all(at(3), at(200));
        for (from, missing) in
            [(0, 0), (2, 2), (3, 200), (63, 200), (64, 200), (191, 200), (200, 200), (500, 500)]
        {
            assert_eq!(marks.first_missing(at(from)), at(missing), "from {from}");
        }
        marks.insert_all(at(200), at(256));
        assert_eq!(marks.first_missing(at(10)), at(256));
        assert_eq!(marks.first_missing(At { file: 0, block: 7 }), At { file: 0, block: 7 });
    }

    #[test]
    fn runs_are_what_was_marked() {
        let at = |file: u32, block: u32| At { file, block };
        let mut marks = Marks::default();
        marks.insert_all(at(0, 60), at(0, 200));
        marks.insert(at(2, 5));
        marks.insert(at(0, 3));
        marks.insert(at(0, 201));
        marks.insert_all(at(0, 128), at(0, 128));
        assert_eq!(marks.runs(), [(at(0, 3), 4), (at(0, 60), 200), (at(0, 201), 202), (at(2, 5), 6)]);
        assert!(marks.contains(at(0, 199)) && !marks.contains(at(0, 200)) && !marks.contains(at(1, 5)));
    }
}
