//! What an editor offers to do at a place.
//!
//! Knows: which changes are offered where. Must not know: how editors ask.

use std::ops::Range;

use gcheck_db::{Analysis, Cancelled, Database, DocumentId};
use gcheck_rules::Edit;

/// Something that can be done.
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
    /// Mends a finding.
    Fix,
    /// Mends many findings of the file.
    FixAll,
    /// Silences a finding by a comment.
    Suppress,
    /// Opens a page.
    Explain,
    /// Changes how something is written.
    Rewrite,
    /// Changes the whole file.
    Source,
}

/// What can be done in a range, as findings of `analysis` and the text suggest.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn code_actions(
    database: &mut Database,
    document: DocumentId,
    range: Range<u32>,
    analysis: Option<&Analysis>,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<CodeAction>, Cancelled> {
    let _ = (database, document, range, analysis, stop);
    Ok(Vec::new())
}
