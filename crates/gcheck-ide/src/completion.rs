//! What may be typed at a place.
//!
//! Knows: which kinds of things can stand where. Must not know: how editors match and sort beyond what an item says.

use gcheck_db::{Cancelled, Database, DocumentId};
use gcheck_rules::Edit;

use crate::Workspace;

/// Characters that open the list without being asked.
pub const TRIGGERS: &[&str] = &["G", "M", "#", "<", "[", "(", ":", "=", " "];

/// One thing that may be typed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// Shown in the list.
    pub label: String,
    /// Shown behind the label, in a few words.
    pub detail: String,
    /// Markdown.
    pub documentation: Option<String>,
    /// What it is.
    pub kind: CompletionKind,
    /// What is written, in the place of what stands there.
    pub edit: Edit,
    /// The text of the edit is a snippet: `$1`, `${2:0.1}` and `$0` are places for the cursor; `$`, `}` and `\` are escaped.
    pub is_snippet: bool,
    /// What editors compare with what was typed.
    pub filter: String,
    /// Items are shown in the order of this text.
    pub sort: String,
}

/// What a completion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CompletionKind {
    /// A G or M code.
    Code,
    /// A word of the block's code.
    Word,
    /// A numbered or named variable.
    Variable,
    /// A function of expressions.
    Function,
    /// A keyword of macro statements.
    Keyword,
    /// A sequence number.
    Label,
    /// A program or subroutine.
    Program,
    /// A cycle with places for its words.
    Snippet,
    /// A rule.
    Rule,
    /// A control.
    Control,
}

/// What may be typed at `offset`, the most fitting first.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn completion(
    database: &mut Database,
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<Completion>, Cancelled> {
    let _ = (database, workspace, document, offset, stop);
    Ok(Vec::new())
}
