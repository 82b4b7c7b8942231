//! What each piece of a program is, for colours.
//!
//! Knows: kinds of pieces. Must not know: colours, delta encodings.

use std::ops::Range;

use gcheck_db::Snapshot;

/// Names of token types; [`SemanticToken::kind`] is an index.
pub const TOKEN_TYPES: &[&str] = &[
    "rapid",
    "feed",
    "arc",
    "cycle",
    "modal",
    "code",
    "coordinate",
    "word",
    "label",
    "program",
    "comment",
    "variable",
    "keyword",
    "function",
    "number",
    "operator",
];

/// Names of modifiers; [`SemanticToken::modifiers`] has a bit for each.
pub const TOKEN_MODIFIERS: &[&str] = &["unreachable", "skippable", "definition", "readonly"];

/// A piece of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SemanticToken {
    /// Bytes of the file; never more than one line.
    pub range: Range<u32>,
    /// Index into [`TOKEN_TYPES`].
    pub kind: u32,
    /// Bits of [`TOKEN_MODIFIERS`].
    pub modifiers: u32,
}

/// The pieces of a range, or of the whole document, in text order and without overlap. Pieces in `unreachable`
/// ([`crate::unreachable_ranges`]) are marked so.
pub fn semantic_tokens(
    snapshot: &Snapshot,
    range: Option<Range<u32>>,
    unreachable: &[Range<u32>],
) -> Vec<SemanticToken> {
    let _ = (snapshot, range, unreachable);
    Vec::new()
}
