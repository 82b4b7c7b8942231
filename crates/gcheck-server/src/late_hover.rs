//! A hover that was answered without the state, because the analysis takes longer than a person waits.
//!
//! Knows: which place of which text it speaks of, and the whole answer once it is worked out. Must not know: how a hover is
//! made.

use std::ops::Range;

use gcheck_db::DocumentId;

use crate::proto::{Hover, Uri};

/// A hover that was answered without the state.
#[derive(Debug)]
pub(crate) struct LateHover {
    pub(crate) document: DocumentId,
    pub(crate) uri: Uri,
    /// The document's clock.
    pub(crate) clock: u64,
    /// Bytes that it speaks of.
    pub(crate) bytes: Range<u32>,
    /// How often the state was begun and put off for something more urgent.
    tries: u32,
    /// The whole answer, when it is known.
    answer: Option<Hover>,
}

/// A state that was put off this often is not tried again.
const MOST_TRIES: u32 = 20;

impl LateHover {
    /// Of a place whose state is still to be worked out.
    pub(crate) fn new(document: DocumentId, uri: Uri, clock: u64, bytes: Range<u32>) -> Self {
        Self { document, uri, clock, bytes, tries: 0, answer: None }
    }

    /// The whole answer for a place of a text, if it is of that place and known.
    pub(crate) fn answer(&self, document: DocumentId, clock: u64, offset: u32) -> Option<&Hover> {
        // Between a word and a blank the word is meant.
        let is_at = self.bytes.start <= offset && offset <= self.bytes.end;
        let is_of = self.document == document && self.clock == clock && is_at;
        self.answer.as_ref().filter(|_| is_of)
    }

    /// Is the state still to be worked out?
    pub(crate) fn is_open(&self) -> bool {
        self.answer.is_none() && self.tries < MOST_TRIES
    }

    /// After a try, which gave the whole answer or was put off.
    #[must_use]
    pub(crate) fn tried(self, answer: Option<Hover>) -> Self {
        Self { tries: self.tries + 1, answer, ..self }
    }
}
