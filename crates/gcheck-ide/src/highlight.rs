//! The other places of a file that name what the cursor stands at.
//!
//! Knows: files one at a time. Must not know: other files.

use std::ops::Range;

use gcheck_db::Snapshot;

use crate::ReferenceKind;

/// A place to be marked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Highlight {
    /// Bytes of the file.
    pub range: Range<u32>,
    /// Whether it is set or used there.
    pub kind: ReferenceKind,
}

/// Places of the file that name what stands at `offset`, in text order.
pub fn highlights(snapshot: &Snapshot, offset: u32) -> Vec<Highlight> {
    let _ = (snapshot, offset);
    Vec::new()
}
