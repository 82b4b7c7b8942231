//! Which program calls which.
//!
//! Knows: programs and subroutines as callers and callees. Must not know: what a call does.

use std::ops::Range;

use gcheck_db::DocumentId;

use crate::{Place, SymbolKind, Workspace};

/// A program or subroutine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CallItem {
    /// `O1234`, `o<probe>`, or the file's name where the program has no number.
    pub name: String,
    /// The file's name.
    pub detail: String,
    /// Program or subroutine.
    pub kind: SymbolKind,
    /// Its name's place.
    pub place: Place,
    /// All its bytes.
    pub range: Range<u32>,
}

/// Who calls a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Incoming {
    /// The caller.
    pub from: CallItem,
    /// The calls: bytes of the caller's file.
    pub calls: Vec<Range<u32>>,
}

/// What a program calls.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outgoing {
    /// What is called.
    pub to: CallItem,
    /// The calls: bytes of the calling program's file.
    pub calls: Vec<Range<u32>>,
}

/// The program that is named at `offset`; elsewhere the one around it.
pub fn call_items(workspace: &Workspace, document: DocumentId, offset: u32) -> Vec<CallItem> {
    let _ = (workspace, document, offset);
    Vec::new()
}

/// Who calls the program.
pub fn incoming_calls(workspace: &Workspace, item: &CallItem) -> Vec<Incoming> {
    let _ = (workspace, item);
    Vec::new()
}

/// What the program calls.
pub fn outgoing_calls(workspace: &Workspace, item: &CallItem) -> Vec<Outgoing> {
    let _ = (workspace, item);
    Vec::new()
}
