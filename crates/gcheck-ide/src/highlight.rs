//! The other places of a file that name what the cursor is at.
//!
//! Knows: one file at a time. Must not know: other files.

use std::ops::Range;

use gcheck_db::Snapshot;

use crate::ReferenceKind;
use crate::symbols::{occurrences_in, symbol_at};
use crate::tool_words::{tool_word_at, tool_words};

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
    let Some(occurrence) = symbol_at(snapshot, offset) else { return of_tool(snapshot, offset) };
    let places = occurrences_in(snapshot, &occurrence.symbol).into_iter();
    places.map(|occurrence| Highlight { range: occurrence.range, kind: occurrence.kind }).collect()
}

/// The words with the address and number of one that names a tool.
fn of_tool(snapshot: &Snapshot, offset: u32) -> Vec<Highlight> {
    let Some(word) = tool_word_at(snapshot, offset) else { return Vec::new() };
    let words = tool_words(snapshot, word.letter, word.number).into_iter();
    words.map(|word| Highlight { range: word.range, kind: ReferenceKind::Read }).collect()
}
