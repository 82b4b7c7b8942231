//! The toolpath of a document for a preview.
//!
//! Knows: moves as points with their lines. Must not know: how they are drawn.

use gcheck_db::Snapshot;
use serde::Serialize;

/// Most segments of a toolpath; more are thinned, and it is said so.
pub const MAX_SEGMENTS: usize = 200_000;

/// The toolpath of one run, in millimetres.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
#[serde(rename_all = "camelCase")]
pub struct Toolpath {
    /// How many segments the run had; more than are listed when it was thinned.
    pub total: u64,
}

/// Runs the document for its toolpath, at most so many blocks.
pub fn toolpath(snapshot: &Snapshot, fuel: u64, most_segments: usize) -> Toolpath {
    let _ = (snapshot, fuel, most_segments);
    Toolpath::default()
}
