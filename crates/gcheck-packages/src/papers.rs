//! What goes with the binary: licences, README, changelog, completions.
//!
//! Knows: which files of the repository these are. Must not know: any package.

use std::collections::BTreeMap;

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
    /// The texts of this repository.
    pub fn new(completions: BTreeMap<String, String>) -> Self {
        Self {
            readme: include_str!("../../../README.md").to_owned(),
            changelog: include_str!("../../../CHANGELOG.md").to_owned(),
            mit: include_str!("../../../LICENSE-MIT").to_owned(),
            apache: include_str!("../../../LICENSE-APACHE").to_owned(),
            completions,
        }
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
