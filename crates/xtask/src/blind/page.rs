//! The first-look figures in `docs/precision.md` and `docs/recall.md`.
//!
//! Knows: where the sections begin and end. Must not know: how they are counted (`gcheck_testkit::blind`).

#![cfg(feature = "product")]

use std::fs;

use anyhow::Context as _;
use gcheck_testkit::blind::{self, Draw, MistakeSet};

use crate::workspace;

/// Writes both sections again from the tables, and leaves the rest of the pages as they are.
pub(super) fn write() -> anyhow::Result<()> {
    let folder = blind::folder();
    let precision = blind::precision(&Draw::all(&folder)?);
    let recall = blind::recall(&MistakeSet::all(&folder)?);
    for (page, section) in [("docs/precision.md", precision), ("docs/recall.md", recall)] {
        let path = workspace::root().join(page);
        let text = fs::read_to_string(&path).with_context(|| page.to_owned())?;
        fs::write(&path, blind::with_section(&text, &section))?;
        println!("wrote  {page}");
    }
    Ok(())
}
