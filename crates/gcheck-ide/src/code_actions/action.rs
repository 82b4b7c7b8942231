//! A change that an editor can offer.
//!
//! Knows: its parts. Must not know: which changes there are, how editors ask.

use std::ops::Range;

use gcheck_diagnostics::Edit;

/// Something that can be done at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodeAction {
    /// What it does, imperative.
    pub title: String,
    /// What kind of change it is.
    pub kind: ActionKind,
    /// Edits of the document, which do not overlap; empty for [`ActionKind::Explain`].
    pub edits: Vec<Edit>,
    /// The rule whose finding it answers.
    pub rule: Option<&'static str>,
    /// Bytes of the finding that it answers.
    pub finding: Option<Range<u32>>,
    /// The first choice for its finding.
    pub is_preferred: bool,
    /// An address to open, of [`ActionKind::Explain`].
    pub link: Option<String>,
}

/// Kinds of actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ActionKind {
    /// Fixes a finding, or all findings of its rule.
    Fix,
    /// Applies every fix in the file that changes no move.
    FixAll,
    /// Silences a finding by a comment.
    Suppress,
    /// Opens a page.
    Explain,
    /// Changes how something is written at the place.
    Rewrite,
    /// Changes the whole file.
    Source,
}

impl CodeAction {
    /// A change that answers no finding.
    pub(super) fn change(title: impl Into<String>, kind: ActionKind, edits: Vec<Edit>) -> Self {
        Self { title: title.into(), kind, edits, rule: None, finding: None, is_preferred: false, link: None }
    }
}
