//! Where a thing is named.
//!
//! Knows: how far a thing reaches: a program, a file, files that call each other. Must not know: what becomes of the places.

use gcheck_db::DocumentId;

use crate::{Place, Workspace};

/// A place that names a thing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reference {
    /// The name.
    pub place: Place,
    /// What the place does with it.
    pub kind: ReferenceKind,
}

/// What a place does with what it names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ReferenceKind {
    /// Defines it: the label itself, the head of a program, an assignment.
    Write,
    /// Uses it.
    Read,
}

/// All places that name the thing at `offset`, by file and text order; those that define it only with `declarations`.
pub fn references(
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    declarations: bool,
) -> Vec<Reference> {
    let _ = (workspace, document, offset, declarations);
    Vec::new()
}
