//! What a block does not say but means, beside it.
//!
//! Knows: which facts of the state are worth reading there. Must not know: how states come about.

use std::ops::Range;

use gcheck_db::{Cancelled, Database, DocumentId};

/// Which hints are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent switches, named one by one in the settings of editors"
)]
pub struct InlayOptions {
    /// The feed of a cutting move whose block has no `F`, where it differs from the line before.
    pub feed: bool,
    /// The speed likewise.
    pub speed: bool,
    /// What a computed word or assignment comes to.
    pub values: bool,
    /// Where an incremental move ends.
    pub positions: bool,
    /// What a tool is called, beside its number.
    pub tools: bool,
}

impl Default for InlayOptions {
    /// All of them.
    fn default() -> Self {
        Self { feed: true, speed: true, values: true, positions: true, tools: true }
    }
}

/// A hint beside the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InlayHint {
    /// Byte of the file in front of which it stands.
    pub offset: u32,
    /// Its text.
    pub label: String,
    /// Markdown; may be empty.
    pub tooltip: String,
    /// Which switch it belongs to.
    pub kind: InlayKind,
}

/// What a hint tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "as the switches")]
pub enum InlayKind {
    Feed,
    Speed,
    Value,
    Position,
    Tool,
}

/// Hints in a range, in text order.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn inlay_hints(
    database: &mut Database,
    document: DocumentId,
    range: Range<u32>,
    options: InlayOptions,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<InlayHint>, Cancelled> {
    let _ = (database, document, range, options, stop);
    Ok(Vec::new())
}
