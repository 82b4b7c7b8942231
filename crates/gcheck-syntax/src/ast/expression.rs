//! Expressions: numbers, variables, operators, functions, brackets.
//!
//! Knows: how they nest. Must not know: what they come to.

use std::ops::Range;

use rowan::NodeOrToken;

use super::view::views;
use crate::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken, byte_range};

views! {
    /// `a + b`.
    Binary = BINARY,
    /// `-a`.
    Unary = UNARY,
    /// `[a]`, `[a,b]`.
    Group = GROUP,
    /// `SIN[a]`, `ATAN[a]/[b]`.
    FunctionCall = FUNCTION_CALL,
    /// `##1`, `#[#1+2]`.
    Indirect = INDIRECT,
}

/// An expression or a part of one.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Expr {
    /// `1.5`.
    Number(Number),
    /// `#1`, `#<name>`, `#[…]`.
    Variable(Variable),
    /// `a + b`.
    Binary(Binary),
    /// `-a`.
    Unary(Unary),
    /// `[a]`.
    Group(Group),
    /// `SIN[a]`.
    FunctionCall(FunctionCall),
}

/// A number without an address.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Number(SyntaxElement);

/// A variable or parameter.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Variable {
    /// `#100`.
    Numbered(SyntaxToken),
    /// `#<name>`.
    Named(SyntaxToken),
    /// `##1`, `#[#1+2]`.
    Indirect(Indirect),
}

impl Expr {
    /// Views a node or token, if it is an expression.
    pub fn cast(element: SyntaxElement) -> Option<Self> {
        match element.kind() {
            SyntaxKind::NUMBER | SyntaxKind::DIVIDED_NUMBER => Some(Self::Number(Number(element))),
            SyntaxKind::VARIABLE | SyntaxKind::NAMED_VARIABLE | SyntaxKind::INDIRECT => {
                Variable::cast(element).map(Self::Variable)
            }
            SyntaxKind::BINARY => element.into_node().map(|node| Self::Binary(Binary(node))),
            SyntaxKind::UNARY => element.into_node().map(|node| Self::Unary(Unary(node))),
            SyntaxKind::GROUP => element.into_node().map(|node| Self::Group(Group(node))),
            SyntaxKind::FUNCTION_CALL => {
                element.into_node().map(|node| Self::FunctionCall(FunctionCall(node)))
            }
            _ => None,
        }
    }

    /// Bytes of the parsed text.
    pub fn range(&self) -> Range<u32> {
        match self {
            Self::Number(number) => number.range(),
            Self::Variable(variable) => variable.range(),
            Self::Binary(binary) => binary.range(),
            Self::Unary(unary) => unary.range(),
            Self::Group(group) => group.range(),
            Self::FunctionCall(call) => call.range(),
        }
    }

    /// The variable that the expression is, brackets around it left out.
    pub fn as_variable(&self) -> Option<Variable> {
        match self {
            Self::Variable(variable) => Some(variable.clone()),
            Self::Group(group) => group.expressions().next()?.as_variable(),
            _ => None,
        }
    }
}

/// The expressions among the children of a node.
pub(super) fn expressions(node: &SyntaxNode) -> impl Iterator<Item = Expr> + use<> {
    node.children_with_tokens().filter_map(Expr::cast)
}

impl Number {
    /// The digits and the point, without blanks.
    pub fn text(&self) -> String {
        self.0.to_string().chars().filter(|c| !c.is_whitespace()).collect()
    }

    /// Bytes of the parsed text.
    pub fn range(&self) -> Range<u32> {
        byte_range(self.0.text_range())
    }

    /// The number, if it is whole.
    pub fn integer(&self) -> Option<u32> {
        whole_number(&self.text())
    }
}

/// The number of these digits, which a point may end.
pub(super) fn whole_number(text: &str) -> Option<u32> {
    let digits = text.strip_suffix('.').unwrap_or(text);
    // `parse` takes a sign too.
    if digits.starts_with('+') { None } else { digits.parse().ok() }
}

impl Variable {
    /// Views a node or token, if it is a variable.
    pub fn cast(element: SyntaxElement) -> Option<Self> {
        match element {
            NodeOrToken::Token(token) if token.kind() == SyntaxKind::VARIABLE => Some(Self::Numbered(token)),
            NodeOrToken::Token(token) if token.kind() == SyntaxKind::NAMED_VARIABLE => {
                Some(Self::Named(token))
            }
            NodeOrToken::Token(_) => None,
            NodeOrToken::Node(node) => Indirect::cast(node).map(Self::Indirect),
        }
    }

    /// Bytes of the parsed text, from the `#` on.
    pub fn range(&self) -> Range<u32> {
        match self {
            Self::Numbered(token) | Self::Named(token) => byte_range(token.text_range()),
            Self::Indirect(indirect) => indirect.range(),
        }
    }

    /// The number of `#100`.
    pub fn number(&self) -> Option<u32> {
        match self {
            Self::Numbered(_) => self.name().and_then(|(_, digits)| digits.parse().ok()),
            Self::Named(_) | Self::Indirect(_) => None,
        }
    }

    /// The digits of `#100`, or what is between the brackets of `#<name>`, with its bytes of the parsed text.
    pub fn name(&self) -> Option<(Range<u32>, &str)> {
        let (Self::Numbered(token) | Self::Named(token)) = self else { return None };
        let start: u32 = token.text_range().start().into();
        let (place, name) = variable_name(token.text())?;
        Some((start + place.start..start + place.end, name))
    }

    /// Is it assigned to, and not read?
    pub fn is_target(&self) -> bool {
        let (parent, own) = match self {
            Self::Numbered(token) | Self::Named(token) => (token.parent(), token.text_range()),
            Self::Indirect(indirect) => (indirect.0.parent(), indirect.0.text_range()),
        };
        parent.is_some_and(|parent| {
            parent.kind() == SyntaxKind::ASSIGNMENT
                && parent.text_range().start() == own.start()
                && parent.children_with_tokens().any(|child| child.kind() == SyntaxKind::EQUALS)
        })
    }
}

/// The digits of `#100`, or what is between the brackets of `#<name>`, with its bytes of the token.
pub fn variable_name(token: &str) -> Option<(Range<u32>, &str)> {
    let (start, name) = match token.find('<') {
        Some(open) => (open + 1, token.get(open + 1..)?.strip_suffix('>')?),
        None => (1, token.get(1..)?.trim_end_matches('.')),
    };
    Some((start as u32..(start + name.len()) as u32, name))
}

impl Binary {
    /// What is in front of the operator.
    pub fn left(&self) -> Option<Expr> {
        self.0.children_with_tokens().take_while(|child| !child.kind().is_operator()).find_map(Expr::cast)
    }

    /// The operator; of `* *` the first part.
    pub fn operator(&self) -> Option<SyntaxToken> {
        self.0
            .children_with_tokens()
            .filter_map(NodeOrToken::into_token)
            .find(|token| token.kind().is_operator())
    }

    /// What is after the operator.
    pub fn right(&self) -> Option<Expr> {
        self.0.children_with_tokens().skip_while(|child| !child.kind().is_operator()).find_map(Expr::cast)
    }
}

impl Unary {
    /// What has the sign.
    pub fn operand(&self) -> Option<Expr> {
        expressions(&self.0).next()
    }
}

impl Group {
    /// What is between the brackets; several where commas part them.
    pub fn expressions(&self) -> impl Iterator<Item = Expr> + use<> {
        expressions(&self.0)
    }

    /// Does it have its `]`?
    pub fn is_closed(&self) -> bool {
        self.0.last_child_or_token().is_some_and(|last| last.kind() == SyntaxKind::R_BRACKET)
    }

    /// Is a place of the line between the brackets? All that is after one which is not closed is.
    pub fn surrounds(&self, offset: u32) -> bool {
        let range = self.range();
        range.start < offset && (offset < range.end || !self.is_closed())
    }
}

impl FunctionCall {
    /// The token with the function's name.
    pub fn name(&self) -> Option<SyntaxToken> {
        self.0.first_token().filter(|token| token.kind() == SyntaxKind::FUNCTION)
    }

    /// The groups of its arguments: two of `ATAN[a]/[b]`.
    pub fn arguments(&self) -> impl Iterator<Item = Group> + use<> {
        self.0.children().filter_map(Group::cast)
    }
}

impl Indirect {
    /// What gives the number of the variable.
    pub fn number(&self) -> Option<Expr> {
        expressions(&self.0).next()
    }
}
