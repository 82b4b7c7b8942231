//! Figures above each tool section: time, extents.
//!
//! Knows: what of a run's statistics stands above a section. Must not know: how figures are computed.

use std::ops::Range;

use gcheck_db::Snapshot;

/// What one run of a document amounts to. It takes a while: whoever shows it keeps it, and shows it until the next is there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunFigures {
    /// Tool sections in the order in which they began.
    pub sections: Vec<SectionFigures>,
    /// Time of the whole run in seconds.
    pub seconds: f64,
    /// How the run ended, in a few words, where it did not reach the program's end.
    pub stopped: Option<String>,
}

/// What one tool section amounts to.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionFigures {
    /// Line of this document where it begins, from 0.
    pub line: u32,
    /// The tool; `None` unknown.
    pub tool: Option<u32>,
    /// Time in seconds.
    pub seconds: f64,
    /// Where cutting moves went, as text; empty when nothing was cut.
    pub extents: String,
    /// More for a tooltip: feeds, speeds, offsets.
    pub details: String,
}

/// A line above a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodeLens {
    /// Bytes of the line that it stands above.
    pub range: Range<u32>,
    /// Its text.
    pub title: String,
    /// More.
    pub tooltip: String,
}

/// Runs the document for its figures, at most so many blocks.
pub fn figures(snapshot: &Snapshot, fuel: u64) -> RunFigures {
    let _ = (snapshot, fuel);
    RunFigures::default()
}

/// The lenses of a document whose run gave these figures.
pub fn code_lenses(snapshot: &Snapshot, figures: &RunFigures) -> Vec<CodeLens> {
    let _ = (snapshot, figures);
    Vec::new()
}
