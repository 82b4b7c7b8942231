//! Which blocks of a program are changed.
//!
//! Knows: lines, tools. Must not know: what is changed.

use std::ops::Range;

/// The blocks that are changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Scope {
    /// All blocks of the file.
    All,
    /// The blocks that begin in these bytes of the file.
    Bytes(Range<u32>),
    /// The blocks that run while this tool is in the spindle.
    Tool(u32),
}

impl Scope {
    /// The blocks of lines, counted from 1, both included.
    pub fn lines(text: &str, first: u32, last: u32) -> Self {
        let start = |line: u32| {
            let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
            std::iter::once(0).chain(breaks).nth(line as usize).unwrap_or(text.len()) as u32
        };
        let (first, last) = (first.saturating_sub(1), last);
        Self::Bytes(start(first)..start(last))
    }

    /// Is a block of the program changed? `tool` is the tool in the spindle after it.
    pub(crate) fn selects(&self, start: u32, tool: Option<u32>) -> bool {
        match self {
            Self::All => true,
            Self::Bytes(range) => range.contains(&start),
            Self::Tool(wanted) => tool == Some(*wanted),
        }
    }
}
