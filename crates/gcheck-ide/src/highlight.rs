//! The other places of a file that name what the cursor is at.
//!
//! Knows: one file at a time. Must not know: other files.

use std::ops::Range;

use gcheck_db::Snapshot;

use crate::ReferenceKind;
use crate::symbols::{occurrences_in, symbol_at};

/// A place to be marked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Highlight {
    /// Bytes of the file.
    pub range: Range<u32>,
    /// Whether it is set or used there.
    pub kind: ReferenceKind,
}

/// Places of the file that name what is at `offset`, in text order.
pub fn highlights(snapshot: &Snapshot, offset: u32) -> Vec<Highlight> {
    let Some(occurrence) = symbol_at(snapshot, offset) else { return Vec::new() };
    let places = occurrences_in(snapshot, &occurrence.symbol).into_iter();
    places.map(|occurrence| Highlight { range: occurrence.range, kind: occurrence.kind }).collect()
}
