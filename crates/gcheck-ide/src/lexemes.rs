//! The tokens of whole lines, without a tree: for what goes over all of a large file, colours and variables.
//!
//! What is asked at one place reads the tree ([`Snapshot::tree_at`]).
//!
//! Knows: how tokens come from the grammar. Must not know: what they mean.

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_program::profile;
use gcheck_syntax::{Sink, SyntaxError, SyntaxKind, parse_into};

/// A token.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Lexeme {
    pub(crate) kind: SyntaxKind,
    /// Bytes of the file.
    pub(crate) range: Range<u32>,
}

/// The tokens of whole lines that are at `base` in the file.
pub(crate) fn lexemes(snapshot: &Snapshot, lines: &str, base: u32) -> Vec<Lexeme> {
    let mut sink = LexemeSink { base, list: Vec::with_capacity(lines.len() / 6) };
    parse_into(lines, profile(snapshot.control()), &mut sink);
    sink.list
}

/// Does the range contain the offset, its end included? A cursor after a word is still at the word.
pub(crate) fn touches(range: &Range<u32>, offset: u32) -> bool {
    range.start <= offset && offset <= range.end
}

struct LexemeSink {
    base: u32,
    list: Vec<Lexeme>,
}

impl Sink for LexemeSink {
    type Checkpoint = ();

    fn start_node(&mut self, _: SyntaxKind) {}

    fn finish_node(&mut self) {}

    fn checkpoint(&self) {}

    fn start_node_at(&mut self, (): (), _: SyntaxKind) {}

    fn token(&mut self, kind: SyntaxKind, range: Range<u32>) {
        self.list.push(Lexeme { kind, range: range.start + self.base..range.end + self.base });
    }

    fn error(&mut self, _: SyntaxError) {}
}
