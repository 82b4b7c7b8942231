//! Where in the loaded programs something is.
//!
//! Knows: a block by file and number, what a block is to those who watch. Must not know: what blocks do.

use gcheck_controls::LetterSet;
use gcheck_program::{BlockFlags, Place};

/// A block of a loaded program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct At {
    /// Index of the file among those loaded.
    pub file: u32,
    /// Number of the block in the file, counted from 0 in text order.
    pub block: u32,
}

impl At {
    /// The next block in text order.
    #[must_use]
    pub const fn next(self) -> Self {
        Self { file: self.file, block: self.block + 1 }
    }
}

/// Where an event comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Origin {
    /// The block.
    pub at: At,
    /// First byte of the block in its file.
    pub start: u32,
    /// Byte after the block.
    pub end: u32,
    /// What the block has.
    pub flags: BlockFlags,
    /// Addresses of its words.
    pub letters: LetterSet,
    /// Its sequence number.
    pub n: Option<u32>,
}

impl Origin {
    /// Of nothing: no block was executed.
    pub(crate) const NONE: Self = Self {
        at: At { file: 0, block: 0 },
        start: 0,
        end: 0,
        flags: BlockFlags::empty(),
        letters: LetterSet::EMPTY,
        n: None,
    };
}

/// The block at `place` as the source of events; its sequence number is not looked for.
#[inline]
pub(crate) fn origin_of(at: At, place: &Place) -> Origin {
    let block = place.block();
    let range = place.range();
    Origin { at, start: range.start, end: range.end, flags: block.flags, letters: block.letters, n: None }
}
