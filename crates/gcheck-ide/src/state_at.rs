//! The state before and after the block at a place, in full.
//!
//! Knows: what of a state people read, and in which units. Must not know: how states come about.

use std::collections::BTreeMap;

use gcheck_db::{Cancelled, Database, DocumentId};
use serde::Serialize;

/// The state around a block.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
#[serde(rename_all = "camelCase")]
pub struct StateView {
    /// Active codes by modal group, before the block.
    pub modes: Vec<ModeView>,
}

/// A modal group and what may be active of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ModeView {
    /// What the group decides.
    pub group: String,
    /// The code, or the few that it may be; empty when it may be any.
    pub codes: Vec<String>,
    /// First byte of the block that set it; `None` when it is as at the start.
    pub set_at: Option<u32>,
}

/// A variable and what it may hold.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct VariableView {
    /// `#100`, `#<depth>`.
    pub name: String,
    /// Its value or range.
    pub value: String,
}

/// Where the axes stand, by axis; `None` unknown.
pub type AxisPlaces = BTreeMap<char, Option<f64>>;

/// The state around the block at `offset`; `None` where no block is, or no path comes.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn state_at(
    database: &mut Database,
    document: DocumentId,
    offset: u32,
    stop: &dyn Fn() -> bool,
) -> Result<Option<StateView>, Cancelled> {
    let _ = (database, document, offset, stop);
    Ok(None)
}
