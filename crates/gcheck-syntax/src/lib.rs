//! The syntax of CNC part programs: tokens, a lossless tree, mistakes in form, chunks and their edits.
//!
//! Knows: text, and the [`SyntaxProfile`] that says which forms a control has. Must not know: any control's name, what codes
//! mean, salsa.
//!
//! Laws (property tests in `tests/`): the tree's text is the input for every byte sequence; both sinks of the grammar see
//! the same blocks; parsing never fails, never panics and is linear; editing a [`Document`] gives the chunks of a fresh one.

pub mod ast;
mod chunk;
mod error;
mod grammar;
mod kind;
mod lexer;
mod profile;
mod source;
mod tree;

pub use chunk::{Changed, Document, MAX_LINES, MIN_LINES, OutOfRange, cut, cuts, line_len};
pub use error::{ForeignForm, SyntaxError, SyntaxErrorKind};
pub use grammar::{MAX_EXPRESSION_DEPTH, MAX_LINE_BYTES, MAX_OPERATORS, Sink, parse_into};
pub use kind::SyntaxKind;
pub use lexer::count_tokens;
pub use profile::SyntaxProfile;
pub use source::{SourceText, TooLarge};
pub use tree::{
    Parse, PartProgram, SyntaxElement, SyntaxNode, SyntaxToken, byte_range, parse, replay, token_at,
};
