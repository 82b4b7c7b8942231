//! Scripts that run a control without a screen.
//!
//! Knows: what such scripts share. Must not know: what any of them asks the control.

use std::fs;
use std::path::{Path, PathBuf};

const SHARED: &str = include_str!("headless.py");

/// Writes a script into a folder, beside what it imports.
pub(crate) fn write(folder: &Path, name: &str, script: &str) -> anyhow::Result<PathBuf> {
    fs::write(folder.join("headless.py"), SHARED)?;
    let path = folder.join(name);
    fs::write(&path, script)?;
    Ok(path)
}
