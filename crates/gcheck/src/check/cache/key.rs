//! What a result is stored under.
//!
//! Knows: everything that is known before a check and decides its result. Must not know: how any of it decides.

use std::fmt;

use gcheck_lint::Execution;
use gcheck_syntax::SourceText;
use twox_hash::XxHash3_128;

use crate::args::Assignment;
use crate::config::{FileSettings, RuleWishes};
use crate::{paths, reading};

/// Identity of a check: a program as it is called, and all that is in force for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::check) struct Key(u128);

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl Key {
    pub(super) fn bytes(self) -> [u8; 16] {
        self.0.to_le_bytes()
    }
}

/// What the checks of a run share.
#[derive(Clone)]
pub(in crate::check) struct Run(XxHash3_128);

impl fmt::Debug for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Run")
    }
}

impl Run {
    /// From the command line, and the build of this program.
    pub(in crate::check) fn new(
        control: Option<&str>,
        wishes: &RuleWishes,
        suppressions: bool,
        execution: Execution,
        set: &[Assignment],
    ) -> Self {
        let mut hasher = XxHash3_128::new();
        put(&mut hasher, env!("CARGO_PKG_VERSION").as_bytes());
        put(&mut hasher, env!("GCHECK_BUILD").as_bytes());
        put(&mut hasher, format!("{:?}", (control, wishes, suppressions, execution, set)).as_bytes());
        Self(hasher)
    }

    /// The key of one program; none when something that is in force cannot be read, which the check then reports.
    pub(in crate::check) fn key(
        &self,
        shown: &str,
        source: &SourceText,
        settings: &FileSettings,
    ) -> Option<Key> {
        let mut hasher = self.0.clone();
        // Two copies of a program may reach other subprograms, so each has its own entry.
        put(&mut hasher, shown.as_bytes());
        put(&mut hasher, settings.in_words().as_bytes());
        for table in settings.tables() {
            put(&mut hasher, paths::shown_from_here(table).as_bytes());
            put(&mut hasher, reading::file(table).ok()?.text().as_bytes());
        }
        put(&mut hasher, source.text().as_bytes());
        for (offset, byte) in source.replaced() {
            hasher.write(&offset.to_le_bytes());
            hasher.write(&[*byte]);
        }
        Some(Key(hasher.finish_128()))
    }
}

/// Hashes a field with its length, so that two fields are never taken for two others.
fn put(hasher: &mut XxHash3_128, field: &[u8]) {
    hasher.write(&(field.len() as u64).to_le_bytes());
    hasher.write(field);
}
