//! The lossless tree: a rowan tree for one chunk, and its replay into a [`Sink`].
//!
//! Knows: rowan. Must not know: what blocks mean.

use std::ops::Range;

use rowan::{GreenNode, GreenNodeBuilder, Language, NodeOrToken, TextRange};

use crate::{Sink, SyntaxError, SyntaxKind, SyntaxProfile, parse_into};

/// The language of part programs, for rowan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PartProgram {}

impl Language for PartProgram {
    type Kind = SyntaxKind;

    fn kind_from_raw(raw: rowan::SyntaxKind) -> SyntaxKind {
        // Only kinds that `kind_to_raw` made are ever in a tree.
        SyntaxKind::ALL.get(usize::from(raw.0)).copied().unwrap_or(SyntaxKind::ERROR)
    }

    fn kind_to_raw(kind: SyntaxKind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}

/// A node of the tree.
pub type SyntaxNode = rowan::SyntaxNode<PartProgram>;
/// A token of the tree.
pub type SyntaxToken = rowan::SyntaxToken<PartProgram>;
/// A node or a token.
pub type SyntaxElement = rowan::SyntaxElement<PartProgram>;

/// A place in a tree as bytes of the text that was parsed.
pub fn byte_range(range: TextRange) -> Range<u32> {
    range.start().into()..range.end().into()
}

/// The token of a tree that holds a byte of the parsed text.
pub fn token_at(root: &SyntaxNode, offset: u32) -> Option<SyntaxToken> {
    let byte = TextRange::at(offset.into(), 1.into());
    // By halving in each node; a look at all children would make each of them.
    let covering = |node: &SyntaxNode| node.child_or_token_at_range(byte);
    let mut found = covering(root)?;
    loop {
        match found {
            NodeOrToken::Token(token) => return Some(token),
            NodeOrToken::Node(node) => found = covering(&node)?,
        }
    }
}

/// The tree of one chunk and what is wrong with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parse {
    green: GreenNode,
    errors: Vec<SyntaxError>,
}

impl Parse {
    /// The root, a `CHUNK` node. Red nodes are cheap and not `Send`: make them where they are used.
    pub fn syntax(&self) -> SyntaxNode {
        SyntaxNode::new_root(self.green.clone())
    }

    /// The green tree: shareable between threads, comparable.
    pub fn green(&self) -> &GreenNode {
        &self.green
    }

    /// Mistakes in the order in which the grammar met them: the first of a block is what the others may come from.
    pub fn errors(&self) -> &[SyntaxError] {
        &self.errors
    }
}

/// Parses whole lines to a tree; never fails, and the tree's text is the input.
pub fn parse(text: &str, profile: SyntaxProfile) -> Parse {
    let mut sink = TreeSink { text, builder: GreenNodeBuilder::new(), errors: Vec::new() };
    sink.builder.start_node(PartProgram::kind_to_raw(SyntaxKind::CHUNK));
    parse_into(text, profile, &mut sink);
    sink.builder.finish_node();
    Parse { green: sink.builder.finish(), errors: sink.errors }
}

struct TreeSink<'t> {
    text: &'t str,
    builder: GreenNodeBuilder<'static>,
    errors: Vec<SyntaxError>,
}

impl Sink for TreeSink<'_> {
    type Checkpoint = rowan::Checkpoint;

    fn start_node(&mut self, kind: SyntaxKind) {
        self.builder.start_node(PartProgram::kind_to_raw(kind));
    }

    fn finish_node(&mut self) {
        self.builder.finish_node();
    }

    fn checkpoint(&self) -> rowan::Checkpoint {
        self.builder.checkpoint()
    }

    fn start_node_at(&mut self, checkpoint: rowan::Checkpoint, kind: SyntaxKind) {
        self.builder.start_node_at(checkpoint, PartProgram::kind_to_raw(kind));
    }

    fn token(&mut self, kind: SyntaxKind, range: Range<u32>) {
        let text = self.text.get(range.start as usize..range.end as usize).unwrap_or_default();
        self.builder.token(PartProgram::kind_to_raw(kind), text);
    }

    fn error(&mut self, error: SyntaxError) {
        self.errors.push(error);
    }
}

/// Plays a parsed chunk into another sink, as [`parse_into`] would have done from its text.
///
/// Nodes that the grammar opens late (binary operations) come at their place in the tree; a sink must not depend on when a
/// node was opened, only on when it ends.
pub fn replay<S: Sink>(parse: &Parse, sink: &mut S) {
    // The green tree, as the red one allocates each node and token that it shows.
    let mut open = vec![parse.green.children()];
    let mut offset = 0;
    while let Some(children) = open.last_mut() {
        match children.next() {
            Some(NodeOrToken::Node(node)) => {
                sink.start_node(PartProgram::kind_from_raw(node.kind()));
                open.push(node.children());
            }
            Some(NodeOrToken::Token(token)) => {
                let start = offset;
                offset += u32::from(token.text_len());
                sink.token(PartProgram::kind_from_raw(token.kind()), start..offset);
            }
            None => {
                open.pop();
                // The root, a CHUNK, is not an event.
                if !open.is_empty() {
                    sink.finish_node();
                }
            }
        }
    }
    for error in parse.errors() {
        sink.error(error.clone());
    }
}
