//! How much an analysis of all paths may cost, and where it stopped at that.
//!
//! Knows: the work that a text is worth, the limits and the places where they were reached. Must not know: how work is spent.

use std::rc::Rc;

use crate::origin::At;
use crate::program::Program;

/// The work that an analysis may do, in executed blocks; copies, joins and comparisons of states count as blocks, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Whatever the text.
    pub base: u64,
    /// For each block of the program's file.
    pub each_block: u64,
}

impl Budget {
    /// What an analysis gets unless somebody says otherwise. It is enough for the loops and calls of programs that machines run:
    /// two hundred times 10,000 turns, and each block of a long program dozens of times.
    pub const DEFAULT: Self = Self { base: 2_000_000, each_block: 64 };

    /// The work for a program.
    pub fn of(self, program: &Program<'_>) -> u64 {
        let blocks = program.file(0).map_or(0, |file| u64::from(file.loaded.flow_graph().blocks()));
        self.base.saturating_add(self.each_block.saturating_mul(blocks))
    }
}

/// What an analysis has no more of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Limit {
    /// Work: loops and calls execute too many blocks.
    Work,
    /// States: too many ways part, or too many calls of calls are apart.
    States,
    /// Turns: a loop changes its state each time, whatever is left open.
    Turns,
}

/// Where an analysis stopped, wholly or on one way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GivenUp {
    /// The block.
    pub at: At,
    /// Blocks of the calls under way there, the outermost first.
    pub calls: Rc<[At]>,
    /// Why.
    pub limit: Limit,
}
