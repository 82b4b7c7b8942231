//! A program on disk in the place of another: written, or shown as a difference.
//!
//! Knows: files on disk, unified differences. Must not know: why a program is changed.

use std::fs;
use std::path::Path;

use similar::TextDiff;

use crate::problem::io_reason;
use crate::{Problem, output};

/// Replaces a program on disk: whole or not at all, and only if it still is what was read. `verb` is what is done to it, as
/// in "cannot fix".
pub(crate) fn write(path: &Path, verb: &str, before: &[u8], after: &[u8]) -> Result<(), Problem> {
    let problem =
        |error: &std::io::Error| Problem::with_file(path, format!("cannot {verb}: {}", io_reason(error)));
    let permissions = fs::metadata(path).map_err(|error| problem(&error))?.permissions();
    if permissions.readonly() {
        return Err(Problem::with_file(path, format!("cannot {verb}: the file is read-only")));
    }
    output::replace(path, before, after)
}

/// The change as a unified difference. Bytes that are not UTF-8 are shown as such.
pub(crate) fn difference(shown: &str, before: &[u8], after: &[u8]) -> String {
    let (before, after) = (String::from_utf8_lossy(before), String::from_utf8_lossy(after));
    TextDiff::from_lines(&*before, &*after)
        .unified_diff()
        .context_radius(3)
        .header(&format!("a/{shown}"), &format!("b/{shown}"))
        .to_string()
}
