//! Giving a thing another name wherever it is named.
//!
//! Knows: when that is safe. Must not know: who asks.

use std::ops::Range;

use gcheck_db::DocumentId;

use crate::{FileEdits, Workspace};

/// What can be renamed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RenameTarget {
    /// Bytes of the name at the cursor.
    pub range: Range<u32>,
    /// The name as it stands.
    pub name: String,
}

/// Why something cannot be renamed: one sentence for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RenameRefused(pub String);

/// What would be renamed at `offset`.
///
/// # Errors
/// [`RenameRefused`] when there is nothing with a name, or renaming it cannot be safe.
pub fn prepare_rename(
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
) -> Result<RenameTarget, RenameRefused> {
    let _ = (workspace, document, offset);
    Err(RenameRefused("there is nothing here that has a name".to_owned()))
}

/// The edits that give the thing at `offset` a new name.
///
/// # Errors
/// [`RenameRefused`] as for [`prepare_rename`], and when the name is taken, is no such name, or is beyond the control's
/// limit.
pub fn rename(
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    new_name: &str,
) -> Result<Vec<FileEdits>, RenameRefused> {
    let _ = new_name;
    prepare_rename(workspace, document, offset).map(|_| Vec::new())
}
