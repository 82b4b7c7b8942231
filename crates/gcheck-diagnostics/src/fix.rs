//! A way to fix a finding, and which of them are wanted.
//!
//! Knows: what a fix may change. Must not know: how fixes are applied to a program, rules.

use std::ops::Range;

use crate::Edit;

/// A way to fix a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fix {
    /// Imperative: "write `G1` as `G01`".
    pub title: String,
    /// Does not change any move. Only such fixes are applied without being asked twice.
    pub safe: bool,
    /// Edits of this file that do not overlap.
    pub edits: Vec<Edit>,
}

/// Which fixes are applied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FixKinds {
    /// Those that change no move.
    Safe,
    /// Also those whose intent only the programmer knows.
    All,
}

impl FixKinds {
    /// Is a fix one of these?
    pub fn include(self, fix: &Fix) -> bool {
        fix.safe || self == Self::All
    }
}

impl Fix {
    /// One replacement that changes no move.
    pub fn safe(title: impl Into<String>, range: Range<u32>, text: impl Into<String>) -> Self {
        Self { title: title.into(), safe: true, edits: vec![Edit { range, text: text.into() }] }
    }

    /// One replacement that may change moves, or whose intent only the programmer knows.
    pub fn risky(title: impl Into<String>, range: Range<u32>, text: impl Into<String>) -> Self {
        Self { safe: false, ..Self::safe(title, range, text) }
    }
}
