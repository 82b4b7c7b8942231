//! Programs on disk that are loaded beside the open documents.
//!
//! Knows: which files and lists of files are in memory. Must not know: which of them are needed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use gcheck_db::{Database, DocumentId};

use crate::ProgramFile;
use crate::program_text::Widened;

/// What is loaded from disk.
#[derive(Debug, Default)]
pub(super) struct Disk {
    pub(super) lists: BTreeMap<(PathBuf, bool), (Instant, Vec<ProgramFile>)>,
    pub(super) files: BTreeMap<PathBuf, Loaded>,
}

/// A program that was read from disk.
#[derive(Debug)]
pub(super) struct Loaded {
    pub(super) id: DocumentId,
    pub(super) size: u64,
    pub(super) stamp: u64,
    /// Places in the file as places in the document.
    pub(super) widened: Widened,
}

impl Disk {
    /// Everything is read again when it is needed.
    pub(super) fn forget(&mut self, database: &mut Database) {
        self.lists.clear();
        // Their settings may have changed.
        for (_, loaded) in std::mem::take(&mut self.files) {
            database.close(loaded.id);
        }
    }

    /// A file is read again when it is needed.
    pub(super) fn forget_file(&mut self, path: &Path, database: &mut Database) {
        if let Some(loaded) = self.files.remove(path) {
            database.close(loaded.id);
        }
    }

    /// Bytes of all of them.
    pub(super) fn bytes(&self) -> u64 {
        self.files.values().map(|loaded| loaded.size).sum()
    }
}
