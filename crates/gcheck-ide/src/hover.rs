//! What is shown for the word under the pointer.
//!
//! Knows: which parts of an answer a place has, and their order. Must not know: how editors draw Markdown.

use std::ops::Range;

use gcheck_db::{Analysis, Cancelled, Database, DocumentId};

/// What is shown for a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hover {
    /// Bytes that it speaks of.
    pub range: Range<u32>,
    /// Markdown.
    pub markdown: String,
}

/// What is to be said of the place at `offset`: the code, word, number, variable or label there, the state before and after
/// its block, and findings that hold there as far as `analysis` has them.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn hover(
    database: &mut Database,
    document: DocumentId,
    offset: u32,
    analysis: Option<&Analysis>,
    stop: &dyn Fn() -> bool,
) -> Result<Option<Hover>, Cancelled> {
    let _ = (database, document, offset, analysis, stop);
    Ok(None)
}
