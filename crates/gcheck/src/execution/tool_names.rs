//! What a program calls its tools: remarks beside the tool change, above it, or in a list at the head.
//!
//! Knows: where such remarks stand. Must not know: what tools do.

use std::collections::BTreeMap;

/// Names of tools by number.
#[derive(Debug, Default)]
pub(crate) struct ToolNames {
    names: BTreeMap<u32, String>,
}

impl ToolNames {
    /// What a tool is called.
    pub(crate) fn get(&self, tool: u32) -> Option<&str> {
        self.names.get(&tool).map(String::as_str)
    }
}
