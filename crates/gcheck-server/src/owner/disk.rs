//! Programs on disk that are loaded beside the open documents.
//!
//! Knows: which files and lists of files are in memory. Must not know: which of them are needed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use gcheck_controls::Control;
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
    /// The control that it is read for.
    pub(super) control: Arc<Control>,
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

    /// Only some files stay.
    pub(super) fn keep(&mut self, is_kept: impl Fn(&Path) -> bool, database: &mut Database) {
        self.files.retain(|path, loaded| {
            let is_kept = is_kept(path);
            if !is_kept {
                database.close(loaded.id);
            }
            is_kept
        });
    }

    /// Bytes of all of them.
    pub(super) fn bytes(&self) -> u64 {
        self.files.values().map(|loaded| loaded.size).sum()
    }
}
