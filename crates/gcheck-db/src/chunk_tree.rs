//! The tree of a chunk at its place in the file: how a feature asks what is at a byte.
//!
//! Knows: bytes of the file as bytes of the chunk, lines as runs of blocks. Must not know: what blocks mean.

use std::ops::Range;

use gcheck_syntax::ast::{Block, Chunk, Element};
use gcheck_syntax::{Parse, SyntaxNode, SyntaxToken, byte_range, token_at};

/// The tree of a chunk. Its nodes are made where they are used: it does not go to other threads.
#[derive(Debug, Clone)]
pub struct ChunkTree {
    root: SyntaxNode,
    base: u32,
}

impl ChunkTree {
    pub(crate) fn new(parse: &Parse, base: u32) -> Self {
        Self { root: parse.syntax(), base }
    }

    /// The root.
    pub fn chunk(&self) -> Option<Chunk> {
        Chunk::cast(self.root.clone())
    }

    /// Bytes of the chunk, as trees and their views have them, as bytes of the file.
    pub fn in_file(&self, range: Range<u32>) -> Range<u32> {
        self.base + range.start..self.base + range.end
    }

    /// A byte of the file as a byte of the chunk; the first for one that is before it.
    pub fn in_chunk(&self, offset: u32) -> u32 {
        offset.saturating_sub(self.base)
    }

    /// The token that holds a byte of the file.
    pub fn token_at(&self, offset: u32) -> Option<SyntaxToken> {
        token_at(&self.root, offset.checked_sub(self.base)?)
    }

    /// The token that ends at a byte of the file or holds the byte before it.
    pub fn token_before(&self, offset: u32) -> Option<SyntaxToken> {
        self.token_at(offset.checked_sub(1)?)
    }

    /// What the token that holds a byte of the file is a part of.
    pub fn element_at(&self, offset: u32) -> Option<Element> {
        self.token_at(offset).map(Element::of)
    }

    /// The block that holds a byte of the file.
    pub fn block_at(&self, offset: u32) -> Option<Block> {
        self.token_at(offset)?.parent_ancestors().find_map(Block::cast)
    }

    /// The blocks that begin in a range of the file: of a line, those that it has.
    pub fn blocks(&self, within: Range<u32>) -> impl Iterator<Item = Block> + use<> {
        let first = self.block_at(within.start);
        let base = self.base;
        let all = std::iter::successors(first, |block| block.syntax().next_sibling().and_then(Block::cast));
        all.take_while(move |block| base + block.range().start < within.end)
    }

    /// Bytes of a token as bytes of the file.
    pub fn place_of(&self, token: &SyntaxToken) -> Range<u32> {
        self.in_file(byte_range(token.text_range()))
    }
}
