//! The files that features look across, and places in them.
//!
//! Knows: which snapshot belongs to which document. Must not know: folders, which files there are on disk.

use std::ops::Range;
use std::sync::Arc;

use gcheck_db::{DocumentId, Snapshot};
use gcheck_diagnostics::Edit;

/// A file that features may look at.
#[derive(Debug, Clone)]
pub struct WorkspaceFile {
    /// Its document.
    pub id: DocumentId,
    /// Its file name without folders, as calls by name look for it.
    pub name: Arc<str>,
    /// Its text.
    pub snapshot: Snapshot,
}

/// The files that features may look at. What is asked about must be among them.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    /// The files; their order is that of results.
    pub files: Vec<WorkspaceFile>,
}

impl Workspace {
    /// One file alone.
    pub fn of(file: WorkspaceFile) -> Self {
        Self { files: vec![file] }
    }

    /// A file.
    pub fn file(&self, id: DocumentId) -> Option<&WorkspaceFile> {
        self.files.iter().find(|file| file.id == id)
    }
}

/// A place in a file of the workspace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: DocumentId,
    /// Bytes of the file.
    pub range: Range<u32>,
}

/// Edits of one file that do not overlap, in text order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileEdits {
    /// The file.
    pub file: DocumentId,
    /// The edits.
    pub edits: Vec<Edit>,
}
