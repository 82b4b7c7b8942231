//! The parts of a program: programs, tools, operations, labels, subroutines.
//!
//! Knows: what machinists call the parts of a program. Must not know: states.

use std::ops::Range;

use gcheck_db::Snapshot;

/// A part of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// More, in a few words; may be empty.
    pub detail: String,
    /// What it is.
    pub kind: SymbolKind,
    /// All its bytes.
    pub range: Range<u32>,
    /// Bytes of its name, inside `range`.
    pub selection: Range<u32>,
    /// Its parts in text order.
    pub children: Vec<Symbol>,
}

/// What a part of a program is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SymbolKind {
    /// A program (`O1234`).
    Program,
    /// A subroutine (`O100 SUB`).
    Subroutine,
    /// What one tool does.
    Tool,
    /// An operation, by the comment that stands alone before it.
    Operation,
    /// A sequence number that something jumps to.
    Label,
}

/// The parts of a document, in text order.
pub fn document_symbols(snapshot: &Snapshot) -> Vec<Symbol> {
    let _ = snapshot;
    Vec::new()
}
