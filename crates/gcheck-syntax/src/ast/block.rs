//! Blocks of a chunk, and what they are made of.
//!
//! Knows: which elements a block has. Must not know: what they mean.

use rowan::NodeOrToken;

use super::comment::Comment;
use super::expression::{Expr, Group, Variable};
use super::statement::{Assignment, OLabel, Statement};
use super::view::views;
use super::word::Word;
use crate::{SyntaxKind, SyntaxToken};

views! {
    /// Whole lines of a program.
    Chunk = CHUNK,
    /// One block.
    Block = BLOCK,
    /// `/` or `/3`.
    BlockDelete = BLOCK_DELETE,
}

impl Chunk {
    /// The blocks in order.
    pub fn blocks(&self) -> impl Iterator<Item = Block> + use<> {
        self.0.children().filter_map(Block::cast)
    }
}

impl Block {
    /// The words in order, those of statements not included.
    pub fn words(&self) -> impl Iterator<Item = Word> + use<> {
        self.0.children_with_tokens().filter_map(Word::cast)
    }

    /// The words in order, those of statements and of text that the grammar could not use included.
    pub fn all_words(&self) -> impl Iterator<Item = Word> + use<> {
        self.0.descendants_with_tokens().filter_map(Word::cast)
    }

    /// The statements in order, those inside of others not included.
    pub fn statements(&self) -> impl Iterator<Item = Statement> + use<> {
        self.0.children().filter_map(Statement::cast)
    }

    /// The statements in order, each followed by those inside of it.
    pub fn all_statements(&self) -> impl Iterator<Item = Statement> + use<> {
        self.0.descendants().filter_map(Statement::cast)
    }

    /// The block delete, wherever it is.
    pub fn block_delete(&self) -> Option<BlockDelete> {
        self.0.children().find_map(BlockDelete::cast)
    }

    /// Assignments in order, those of other statements not included.
    pub fn assignments(&self) -> impl Iterator<Item = Assignment> + use<> {
        self.0.children().filter_map(Assignment::cast)
    }

    /// The label of an O-word, whether its keyword is there or not.
    pub fn o_label(&self) -> Option<OLabel> {
        self.0.children_with_tokens().find_map(|child| match child {
            NodeOrToken::Node(node) => match Statement::cast(node.clone()) {
                Some(Statement::O(statement)) => statement.label(),
                _ => OLabel::cast(node.into()),
            },
            token @ NodeOrToken::Token(_) => OLabel::cast(token),
        })
    }

    /// Comments in order.
    pub fn comments(&self) -> impl Iterator<Item = Comment> + use<> {
        self.0.descendants_with_tokens().filter_map(Comment::of_element)
    }

    /// Variables in order; of `##1` the indirect one and the one that gives its number.
    pub fn variables(&self) -> impl Iterator<Item = Variable> + use<> {
        self.0.descendants_with_tokens().filter_map(Variable::cast)
    }

    /// Expressions in order, each followed by those inside of it.
    pub fn expressions(&self) -> impl Iterator<Item = Expr> + use<> {
        self.0.descendants_with_tokens().filter_map(Expr::cast)
    }

    /// The brackets of expressions in order, each followed by those inside of it.
    pub fn groups(&self) -> impl Iterator<Item = Group> + use<> {
        self.0.descendants().filter_map(Group::cast)
    }

    /// Is a place of the line between the brackets of an expression, or of what is printed?
    pub fn is_in_brackets(&self, offset: u32) -> bool {
        let prints = |statement| matches!(statement, Statement::Print(print) if print.surrounds(offset));
        self.groups().any(|group| group.surrounds(offset)) || self.all_statements().any(prints)
    }

    /// The tokens in order.
    pub fn tokens(&self) -> impl Iterator<Item = SyntaxToken> + use<> {
        self.0.descendants_with_tokens().filter_map(NodeOrToken::into_token)
    }

    /// The first token that is not a blank; a comment is one.
    pub fn first(&self) -> Option<SyntaxToken> {
        self.tokens().find(|token| !token.kind().is_trivia() || token.kind().is_comment())
    }

    /// Does a mark of the tape, `%`, begin the block?
    pub fn is_tape_mark(&self) -> bool {
        self.first().is_some_and(|first| first.kind() == SyntaxKind::PERCENT)
    }
}

impl BlockDelete {
    /// The digit after the slash.
    pub fn level(&self) -> Option<u8> {
        let number = self
            .0
            .children_with_tokens()
            .filter_map(NodeOrToken::into_token)
            .find(|t| t.kind() == SyntaxKind::NUMBER)?;
        number.text().parse().ok()
    }
}
