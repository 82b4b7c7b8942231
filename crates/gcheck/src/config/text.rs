//! The text of a configuration: where it came from, and how its parts are pointed at and resolved.
//!
//! Knows: places in the text, patterns and paths that count from its folder. Must not know: what its tables mean.

use std::path::{Path, PathBuf};

use super::file::SearchTable;
use super::pattern::PathPattern;
use super::placed::Placed;
use crate::Problem;

/// Folders in which called programs are looked for: each is read, and up to 64 MB of what is in it.
const MAX_SEARCHED: usize = 64;

/// Where a text came from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Text<'t> {
    /// What messages call it.
    pub(super) name: &'t str,
    #[expect(clippy::struct_field_names, reason = "a text has a name and a text")]
    pub(super) text: &'t str,
    /// The folder from which its paths count.
    pub(super) folder: &'t Path,
}

impl Text<'_> {
    pub(super) fn problem<T>(&self, placed: &Placed<T>, message: impl Into<String>) -> Problem {
        Problem::at(self.name, self.text, &placed.range, message)
    }

    /// A problem at some bytes of the text.
    pub(super) fn at(&self, range: &std::ops::Range<usize>, message: impl Into<String>) -> Problem {
        Problem::at(self.name, self.text, range, message)
    }

    pub(super) fn patterns(&self, patterns: &[Placed<String>]) -> Result<Vec<PathPattern>, Problem> {
        patterns.iter().map(|pattern| self.pattern(pattern)).collect()
    }

    pub(super) fn pattern(&self, pattern: &Placed<String>) -> Result<PathPattern, Problem> {
        PathPattern::new(self.folder, &pattern.value).map_err(|reason| {
            self.problem(pattern, format!("`{}` is not a pattern: {reason}", pattern.value))
        })
    }

    pub(super) fn search(&self, table: &SearchTable) -> Result<Vec<PathBuf>, Problem> {
        if let Some(path) = table.paths.get(MAX_SEARCHED) {
            return Err(self.problem(path, format!("more than {MAX_SEARCHED} folders to search")));
        }
        let folder = |written: &Placed<String>| {
            let path = self.path(&written.value);
            if path.is_dir() {
                return Ok(path);
            }
            let message =
                format!("`{}` is not a folder; programs that are called are looked for in it", written.value);
            Err(self.problem(written, message).help("a path counts from the folder of this file"))
        };
        table.paths.iter().map(folder).collect()
    }

    /// A path that the text names.
    pub(super) fn path(&self, path: &str) -> PathBuf {
        crate::paths::absolute(&self.folder.join(path))
    }
}
