//! A JSON list with one item a line, written as the items come.
//!
//! Knows: brackets and commas. Must not know: what the items are.

use std::io::{self, Write};

use serde::Serialize;

/// A list under way.
pub(super) struct List {
    begun: bool,
}

impl List {
    /// Opens the list.
    pub(super) fn begin(out: &mut dyn Write) -> io::Result<Self> {
        out.write_all(b"[")?;
        Ok(Self { begun: false })
    }

    /// Writes the next item.
    pub(super) fn item(&mut self, out: &mut dyn Write, item: &impl Serialize) -> io::Result<()> {
        out.write_all(if self.begun { b",\n  " } else { b"\n  " })?;
        self.begun = true;
        Ok(serde_json::to_writer(out, item)?)
    }

    /// Closes the list.
    pub(super) fn end(self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(if self.begun { b"\n]" } else { b"]" })
    }
}
