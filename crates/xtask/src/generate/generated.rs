//! Generated files.
//!
//! Knows: nothing but their shape. Must not know: who makes them.

use std::path::PathBuf;

/// Files with their paths from the root, and what belongs in them.
pub(crate) type Generated = Vec<(PathBuf, String)>;
