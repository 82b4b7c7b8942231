//! Where a thing is defined: labels, programs, subroutines, variables.
//!
//! Knows: what counts as the definition of which thing. Must not know: how things are found in the text.

use std::ops::Range;

use gcheck_db::DocumentId;

use crate::{Place, Workspace};

/// Where something is defined.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Target {
    /// The name in its file.
    pub name: Place,
    /// The whole of it: a block, a program.
    pub full: Range<u32>,
    /// Bytes of the word that was asked about.
    pub from: Range<u32>,
}

/// Where the thing at `offset` is defined; several places where several may be meant.
pub fn definition(workspace: &Workspace, document: DocumentId, offset: u32) -> Vec<Target> {
    let _ = (workspace, document, offset);
    Vec::new()
}
