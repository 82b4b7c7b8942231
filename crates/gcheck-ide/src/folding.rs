//! What can be folded away.
//!
//! Knows: sections, loops, subroutines, comments. Must not know: how editors fold.

use std::ops::Range;

use gcheck_db::Snapshot;

/// What can be folded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fold {
    /// From the end of the line that stays to the end of the last line that goes.
    pub range: Range<u32>,
    /// What it is.
    pub kind: FoldKind,
}

/// What is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FoldKind {
    /// Comments.
    Comment,
    /// A program, a tool section, a loop, a subroutine, a condition.
    Region,
}

/// What can be folded, in order of its begin.
pub fn folding_ranges(snapshot: &Snapshot) -> Vec<Fold> {
    let _ = snapshot;
    Vec::new()
}
