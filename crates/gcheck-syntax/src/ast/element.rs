//! What a token is a part of: what people point at.
//!
//! Knows: the smallest view around a token. Must not know: cursors.

use std::ops::Range;

use super::block::BlockDelete;
use super::comment::Comment;
use super::expression::Variable;
use super::statement::OLabel;
use super::word::Word;
use crate::{SyntaxKind, SyntaxToken, byte_range};

/// The smallest part of a block around a token that has a meaning of its own.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Element {
    /// A comment.
    Comment(Comment),
    /// An address and its number. What an expression of a word has is an element of its own.
    Word(Word),
    /// A variable; at its `#` an indirect one.
    Variable(Variable),
    /// The name of a function.
    Function(SyntaxToken),
    /// A word of a statement: `IF`, `GOTO`, `SUB`.
    Keyword(SyntaxToken),
    /// `+`, `EQ`, `AND`.
    Operator(SyntaxToken),
    /// The name of an O-word, `O<name>`.
    Label(OLabel),
    /// `/`, `/3`.
    BlockDelete(BlockDelete),
    /// A blank, a bracket, a number of an expression, a character that the grammar could not use.
    Token(SyntaxToken),
}

impl Element {
    /// What a token is a part of.
    pub fn of(token: SyntaxToken) -> Self {
        let kind = token.kind();
        let parent = token.parent();
        let of_token = match kind {
            kind if kind.is_comment() => Comment::cast(token.clone()).map(Self::Comment),
            kind if kind.is_keyword() => Some(Self::Keyword(token.clone())),
            SyntaxKind::VARIABLE | SyntaxKind::NAMED_VARIABLE => {
                Variable::cast(token.clone().into()).map(Self::Variable)
            }
            SyntaxKind::HASH => parent.and_then(|node| Variable::cast(node.into())).map(Self::Variable),
            SyntaxKind::FUNCTION => Some(Self::Function(token.clone())),
            SyntaxKind::O_NAME => OLabel::cast(token.clone().into()).map(Self::Label),
            SyntaxKind::WORD | SyntaxKind::COLON_NUMBER => {
                Word::cast(token.clone().into()).or_else(|| Word::cast(parent?.into())).map(Self::Word)
            }
            SyntaxKind::LETTER => parent.and_then(|node| Word::cast(node.into())).map(Self::Word),
            SyntaxKind::SLASH if parent.as_ref().is_some_and(is_block_delete) => {
                parent.and_then(BlockDelete::cast).map(Self::BlockDelete)
            }
            // The number of `X 1.5` and `X -1.5` is a part of its word, the `5` of `/5` a part of the block delete.
            SyntaxKind::NUMBER | SyntaxKind::PLUS | SyntaxKind::MINUS => match parent {
                Some(node) if is_block_delete(&node) => BlockDelete::cast(node).map(Self::BlockDelete),
                Some(node) if node.kind() == SyntaxKind::UNARY => {
                    node.parent().and_then(|node| Word::cast(node.into())).map(Self::Word)
                }
                node => node.and_then(|node| Word::cast(node.into())).map(Self::Word),
            },
            _ => None,
        };
        of_token.unwrap_or_else(
            || {
                if kind.is_operator() { Self::Operator(token) } else { Self::Token(token) }
            },
        )
    }

    /// Bytes of the parsed text.
    pub fn range(&self) -> Range<u32> {
        match self {
            Self::Comment(comment) => comment.range(),
            Self::Word(word) => word.range(),
            Self::Variable(variable) => variable.range(),
            Self::Label(label) => label.range(),
            Self::BlockDelete(mark) => mark.range(),
            Self::Function(token) | Self::Keyword(token) | Self::Operator(token) | Self::Token(token) => {
                byte_range(token.text_range())
            }
        }
    }
}

fn is_block_delete(node: &crate::SyntaxNode) -> bool {
    node.kind() == SyntaxKind::BLOCK_DELETE
}
