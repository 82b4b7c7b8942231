//! What goes with the binary: licences, README, changelog, completions.
//!
//! Knows: which files of the repository these are. Must not know: any package.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::Context as _;

use crate::container::Entry;

/// The shells that get completions.
pub const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

/// The texts of a package.
#[derive(Debug, Clone, Default)]
pub struct Papers {
    /// `README.md`
    pub readme: String,
    /// `CHANGELOG.md`
    pub changelog: String,
    /// `LICENSE-MIT`
    pub mit: String,
    /// `LICENSE-APACHE`
    pub apache: String,
    /// Completions by shell.
    pub completions: BTreeMap<String, String>,
}

impl Papers {
    /// Reads the texts of the repository.
    ///
    /// # Errors
    /// When one of them cannot be read.
    pub fn read(root: &Path, completions: BTreeMap<String, String>) -> anyhow::Result<Self> {
        let read = |name: &str| {
            fs::read_to_string(root.join(name)).with_context(|| root.join(name).display().to_string())
        };
        Ok(Self {
            readme: read("README.md")?,
            changelog: read("CHANGELOG.md")?,
            mit: read("LICENSE-MIT")?,
            apache: read("LICENSE-APACHE")?,
            completions,
        })
    }

    /// The licences in a folder.
    pub(crate) fn licences(&self, folder: &str) -> [Entry; 2] {
        let at = |name: &str| format!("{folder}/{name}");
        [
            Entry::text(at("LICENSE-APACHE"), self.apache.as_str()),
            Entry::text(at("LICENSE-MIT"), self.mit.as_str()),
        ]
    }
}
