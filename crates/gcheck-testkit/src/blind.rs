//! Measurements that nobody could tune to: programs drawn and mistakes written before gcheck saw them.
//!
//! Knows: the tables of `tests/blind`, what their first-look figures are. Must not know: rules, how gcheck is run
//! (`cargo xtask blind`), what a verdict should be: a reader gives it.
//!
//! The protocol is told in `docs/dev/blind.md`.

mod bound;
mod draws;
mod mistakes;
mod section;
mod table;

use std::path::{Path, PathBuf};

pub use bound::{at_least, at_most};
pub use draws::{Draw, DrawnProgram, Judged, Verdict};
pub use mistakes::{ComesOfIt, Mistake, MistakeSet, NewFinding};
pub use section::{precision, recall, with_section};

/// The folder of the tables.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/blind")
}

/// A table that cannot be read: the file, the line and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unreadable(pub String);

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unreadable {}
