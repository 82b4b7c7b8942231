//! Comments on lines of their own: what they call the blocks after them.
//!
//! Knows: which comments name something, and the block from which on a name holds. Must not know: what the blocks do.

use gcheck_controls::LetterSet;

use crate::block::{Block, BlockFlags, BlockTable};
use crate::tool_names::remark;

/// Headings of a file that are kept: a program with a comment at every line has none that matters.
const MOST: usize = 5_000;

/// A name for the blocks of a file from one on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Heading {
    /// Where the first block after the comment begins: bytes of the file.
    pub from: u32,
    /// The first of the comments that follow each other.
    pub name: String,
}

/// Headings of a file, gathered chunk by chunk.
#[derive(Debug, Clone, Default)]
pub struct Headings {
    found: Vec<Heading>,
    /// The name above the next block.
    above: Option<String>,
}

impl Headings {
    /// Looks at the blocks of the next chunk, which begins at `base` in the file and has the text `text`.
    pub fn look(&mut self, base: u32, table: &BlockTable, text: &str) {
        if self.above.is_none() && !table.flags().contains(BlockFlags::COMMENT) {
            return;
        }
        for (_, block) in table.blocks() {
            let range = block.range.start as usize..block.range.end as usize;
            if is_comment_alone(block) {
                let name = text.get(range).and_then(remark).filter(|name| is_name(name));
                if self.above.is_none() {
                    self.above = name.map(str::to_owned);
                }
            } else if !block.letters.without(LetterSet::of("N")).is_empty() {
                let name = self.above.take().filter(|_| self.found.len() < MOST);
                let from = base + block.range.start;
                self.found.extend(name.map(|name| Heading { from, name }));
            }
        }
    }

    /// Does a name wait for its block?
    pub const fn is_waiting(&self) -> bool {
        self.above.is_some()
    }

    /// What was found, in the order of the file.
    pub fn into_found(self) -> Vec<Heading> {
        self.found
    }
}

/// A comment, perhaps with a sequence number, and nothing else.
pub fn is_comment_alone(block: &Block) -> bool {
    block.flags.contains(BlockFlags::COMMENT)
        && !block.flags.intersects(BlockFlags::STATEMENT | BlockFlags::TAPE_MARK | BlockFlags::ERROR)
        && block.letters.without(LetterSet::of("N")).is_empty()
}

/// Does a comment name something, other than rules of gcheck?
pub fn is_name(comment: &str) -> bool {
    comment.chars().any(char::is_alphanumeric) && !comment.trim_start().starts_with("gcheck:")
}
