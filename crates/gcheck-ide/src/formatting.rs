//! Formatting a document, some of its lines, or the line just typed.
//!
//! Knows: which lines are meant. Must not know: what well-formatted means (`gcheck-format` does).

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_rules::Edit;

/// Characters that finish a line.
pub const FORMAT_TRIGGERS: &[&str] = &["\n"];

/// Edits that format the document, or the lines that a range touches.
pub fn format(snapshot: &Snapshot, range: Option<Range<u32>>) -> Vec<Edit> {
    let _ = (snapshot, range);
    Vec::new()
}

/// Edits that format what was finished by typing a character of [`FORMAT_TRIGGERS`]; `offset` stands behind it.
pub fn format_on_type(snapshot: &Snapshot, offset: u32) -> Vec<Edit> {
    let _ = (snapshot, offset);
    Vec::new()
}
