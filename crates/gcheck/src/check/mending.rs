//! What becomes of mended programs: they are written, or shown as a difference.
//!
//! Knows: files on disk, unified differences. Must not know: rules, how a fix is made.

use std::fs;
use std::path::Path;

use similar::TextDiff;

use super::job::Change;
use crate::problem::io_reason;
use crate::{Problem, output};

/// Replaces a program on disk by its mended form: whole or not at all, and only if it is still what was checked.
pub(super) fn write(path: &Path, change: &Change) -> Result<(), Problem> {
    let problem =
        |error: &std::io::Error| Problem::with_file(path, format!("cannot mend: {}", io_reason(error)));
    let permissions = fs::metadata(path).map_err(|error| problem(&error))?.permissions();
    if permissions.readonly() {
        return Err(Problem::with_file(path, "cannot mend: the file is read-only"));
    }
    output::replace(path, &permissions, &change.after, |now| now == change.before)
}

/// The change as a unified difference. Bytes that are no UTF-8 are shown as such.
pub(super) fn difference(shown: &str, change: &Change) -> String {
    let (before, after) = (String::from_utf8_lossy(&change.before), String::from_utf8_lossy(&change.after));
    TextDiff::from_lines(&*before, &*after)
        .unified_diff()
        .context_radius(3)
        .header(&format!("a/{shown}"), &format!("b/{shown}"))
        .to_string()
}
