//! What becomes of fixed programs: they are written, or shown as a difference.
//!
//! Knows: what a fixed program is called. Must not know: rules, how a fix is made, how a file is replaced.

use std::path::Path;

use super::job::Change;
use crate::{Problem, rewriting};

/// Replaces a program on disk by its fixed form: whole or not at all, and only if it is still what was checked.
pub(super) fn write(path: &Path, change: &Change) -> Result<(), Problem> {
    rewriting::write(path, "fix", &change.before, &change.after)
}

/// The change as a unified difference.
pub(super) fn difference(shown: &str, change: &Change) -> String {
    rewriting::difference(shown, &change.before, &change.after)
}
