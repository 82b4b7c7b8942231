//! The words of the code that is being typed, and the arguments of a macro call.
//!
//! Knows: which word the cursor stands at. Must not know: states.

use std::ops::Range;

use gcheck_db::{DocumentId, Snapshot};

use crate::Workspace;

/// Characters that open the help.
pub const TRIGGERS: &[&str] = &[" "];

/// A code with its words, or a call with its arguments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// One line: `G83 X Y Z R Q [P] [F]`.
    pub label: String,
    /// Markdown.
    pub documentation: String,
    /// The words in the order of the label.
    pub parameters: Vec<Parameter>,
    /// Index of the word at the cursor.
    pub active: Option<u32>,
}

/// A word of a signature.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Bytes of the label, which is ASCII.
    pub label: Range<u32>,
    /// Markdown.
    pub documentation: String,
}

/// The signatures of the codes of the block at `offset`, that of the nearest code before the cursor first.
pub fn signature_help(workspace: &Workspace, document: DocumentId, offset: u32) -> Vec<Signature> {
    let _: Option<&Snapshot> = workspace.file(document).map(|file| &file.snapshot);
    let _ = offset;
    Vec::new()
}
