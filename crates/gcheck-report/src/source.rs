//! A program's text together with its lines, found only when somebody asks.
//!
//! Knows: when to build a [`LineIndex`]. Must not know: formats.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use gcheck_syntax::SourceText;

use crate::{LineIndex, Position};

/// A text and its lines. Nothing is read until the first question, so that files without findings cost nothing.
#[derive(Debug)]
pub(crate) struct Source {
    text: Arc<SourceText>,
    index: OnceLock<LineIndex>,
}

impl Source {
    pub(crate) fn new(text: Arc<SourceText>) -> Self {
        Self { text, index: OnceLock::new() }
    }

    pub(crate) fn text(&self) -> &str {
        self.text.text()
    }

    pub(crate) fn index(&self) -> &LineIndex {
        self.index.get_or_init(|| LineIndex::new(self.text.text()))
    }

    pub(crate) fn position(&self, offset: u32) -> Position {
        self.index().position(self.text(), offset)
    }

    /// Both ends of a range, never the wrong way round.
    pub(crate) fn span(&self, range: &Range<u32>) -> Range<Position> {
        let start = self.position(range.start);
        start..self.position(range.end.max(range.start))
    }

    /// Whether the character at `offset` stands for a byte that is not UTF-8.
    pub(crate) fn is_stand_in(&self, offset: u32) -> bool {
        self.text.replaced().binary_search_by_key(&offset, |(at, _)| *at).is_ok()
    }
}
