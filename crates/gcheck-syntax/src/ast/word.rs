//! Words: an address and its value.
//!
//! Knows: where address and value are. Must not know: what addresses mean.

use std::ops::Range;

use rowan::NodeOrToken;

use super::expression::{Expr, whole_number};
use crate::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken, byte_range};

/// An address and its value: a fused token, or a node where the value is an expression, spaced or missing.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Word {
    /// `X1.5`.
    Fused(SyntaxToken),
    /// `X#1`, `X[#1+2.]`, `X 1.5`, `X`.
    Spread(SyntaxNode),
}

impl Word {
    /// Views a token or node, if it is a word.
    pub fn cast(element: SyntaxElement) -> Option<Self> {
        match element {
            NodeOrToken::Token(t) if matches!(t.kind(), SyntaxKind::WORD | SyntaxKind::COLON_NUMBER) => {
                // The first part of `X1. 5` is a token of its node.
                let is_own = t.parent().is_none_or(|parent| parent.kind() != SyntaxKind::ADDRESS);
                is_own.then_some(Self::Fused(t))
            }
            NodeOrToken::Node(n) if n.kind() == SyntaxKind::ADDRESS => Some(Self::Spread(n)),
            _ => None,
        }
    }

    /// The token that begins with the address; of `, R5.` the one after the comma.
    fn head(&self) -> Option<SyntaxToken> {
        match self {
            Self::Fused(token) => Some(token.clone()),
            Self::Spread(node) => {
                let mut tokens = node.children_with_tokens().filter_map(NodeOrToken::into_token);
                tokens.find(|token| matches!(token.kind(), SyntaxKind::WORD | SyntaxKind::LETTER))
            }
        }
    }

    /// The address, upper case; `O` for `:1234`.
    pub fn letter(&self) -> Option<char> {
        let first = self.head()?.text().chars().find(|c| *c != ',')?;
        Some(if first == ':' { 'O' } else { first.to_ascii_uppercase() })
    }

    /// Is it a corner word, `,R5.`?
    pub fn is_corner(&self) -> bool {
        match self {
            Self::Fused(token) => token.text().starts_with(','),
            Self::Spread(node) => node.first_token().is_some_and(|first| first.text().starts_with(',')),
        }
    }

    /// Bytes of the parsed text.
    pub fn range(&self) -> Range<u32> {
        match self {
            Self::Fused(token) => byte_range(token.text_range()),
            Self::Spread(node) => byte_range(node.text_range()),
        }
    }

    /// Bytes of the address, with the number that is fused to it.
    pub fn head_range(&self) -> Range<u32> {
        self.head().map_or_else(|| self.range(), |head| byte_range(head.text_range()))
    }

    /// The value, where it is one expression that is not fused to the address: none of `X1.`, `X` and `X1. 5`.
    pub fn value(&self) -> Option<Expr> {
        let Self::Spread(node) = self else { return None };
        let is_address = |kind| matches!(kind, SyntaxKind::LETTER | SyntaxKind::COMMA);
        let mut parts =
            node.children_with_tokens().filter(|part| !part.kind().is_trivia() && !is_address(part.kind()));
        let value = parts.next()?;
        if parts.next().is_none() { Expr::cast(value) } else { None }
    }

    /// The word as it is written, without blanks: `G01`, `X-1.5`, `X[#1+2.]`.
    pub fn text(&self) -> String {
        let text = match self {
            Self::Fused(token) => token.text().to_owned(),
            Self::Spread(node) => node.text().to_string(),
        };
        text.chars().filter(|c| !c.is_whitespace()).collect()
    }

    /// The number of a word without expression, where it is whole and has no sign; blanks do not count.
    pub fn integer(&self) -> Option<u32> {
        let text = self.text();
        whole_number(text.trim_start_matches(',').get(1..)?)
    }
}
