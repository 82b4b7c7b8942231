//! Statements: assignments, conditions, loops, jumps, O-words.
//!
//! Knows: which part of a statement is where. Must not know: what statements do.

use std::ops::Range;

use rowan::NodeOrToken;

use super::expression::{Expr, Group, Variable, expressions};
use super::view::views;
use super::word::Word;
use crate::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken, byte_range};

views! {
    /// `#1 = …`.
    Assignment = ASSIGNMENT,
    /// `[…]` in front of words.
    Condition = CONDITION,
    /// `IF […] …`.
    IfStatement = IF_STATEMENT,
    /// `WHILE […] DO1`, `DO1`.
    WhileStatement = WHILE_STATEMENT,
    /// `END1`.
    EndStatement = END_STATEMENT,
    /// `GOTO 10`.
    GotoStatement = GOTO_STATEMENT,
    /// `O100 SUB`.
    OStatement = O_STATEMENT,
    /// `DPRNT[…]`.
    PrintStatement = PRINT_STATEMENT,
    /// `POPEN`, `PCLOS`, `SETVN101[DEPTH]`.
    PortStatement = PORT_STATEMENT,
    /// `$H`.
    CommandStatement = COMMAND_STATEMENT,
}

/// A statement of a block.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Statement {
    /// `#1 = …`.
    Assignment(Assignment),
    /// `[…]` in front of words.
    Condition(Condition),
    /// `IF […] …`.
    If(IfStatement),
    /// `WHILE […] DO1`, `DO1`.
    While(WhileStatement),
    /// `END1`.
    End(EndStatement),
    /// `GOTO 10`.
    Goto(GotoStatement),
    /// `O100 SUB`.
    O(OStatement),
    /// `DPRNT[…]`.
    Print(PrintStatement),
    /// `POPEN`, `PCLOS`, `SETVN101[DEPTH]`.
    Port(PortStatement),
    /// `$H`.
    Command(CommandStatement),
}

impl Statement {
    /// Views a node, if it is a statement.
    pub fn cast(node: SyntaxNode) -> Option<Self> {
        Some(match node.kind() {
            SyntaxKind::ASSIGNMENT => Self::Assignment(Assignment(node)),
            SyntaxKind::CONDITION => Self::Condition(Condition(node)),
            SyntaxKind::IF_STATEMENT => Self::If(IfStatement(node)),
            SyntaxKind::WHILE_STATEMENT => Self::While(WhileStatement(node)),
            SyntaxKind::END_STATEMENT => Self::End(EndStatement(node)),
            SyntaxKind::GOTO_STATEMENT => Self::Goto(GotoStatement(node)),
            SyntaxKind::O_STATEMENT => Self::O(OStatement(node)),
            SyntaxKind::PRINT_STATEMENT => Self::Print(PrintStatement(node)),
            SyntaxKind::PORT_STATEMENT => Self::Port(PortStatement(node)),
            SyntaxKind::COMMAND_STATEMENT => Self::Command(CommandStatement(node)),
            _ => return None,
        })
    }
}

/// The first token of a kind among the children of a node.
fn token(node: &SyntaxNode, is_it: impl Fn(SyntaxKind) -> bool) -> Option<SyntaxToken> {
    node.children_with_tokens().filter_map(NodeOrToken::into_token).find(|token| is_it(token.kind()))
}

impl Assignment {
    /// What is assigned to.
    pub fn target(&self) -> Option<Variable> {
        let mut before = self.0.children_with_tokens().take_while(|child| child.kind() != SyntaxKind::EQUALS);
        before.find_map(Variable::cast)
    }

    /// What is assigned.
    pub fn value(&self) -> Option<Expr> {
        let mut after = self.0.children_with_tokens().skip_while(|child| child.kind() != SyntaxKind::EQUALS);
        after.find_map(Expr::cast)
    }
}

impl Condition {
    /// The brackets.
    pub fn group(&self) -> Option<Group> {
        self.0.children().find_map(Group::cast)
    }
}

impl IfStatement {
    /// The token `IF`.
    pub fn keyword(&self) -> Option<SyntaxToken> {
        self.0.first_token()
    }

    /// What decides.
    pub fn condition(&self) -> Option<Expr> {
        expressions(&self.0).next()
    }

    /// The jump that is made when the condition holds.
    pub fn goto(&self) -> Option<GotoStatement> {
        self.0.children().find_map(GotoStatement::cast)
    }

    /// The assignments that are made when the condition holds.
    pub fn assignments(&self) -> impl Iterator<Item = Assignment> + use<> {
        self.0.children().filter_map(Assignment::cast)
    }
}

impl WhileStatement {
    /// The token `WHILE`; none of `DO1` alone.
    pub fn keyword(&self) -> Option<SyntaxToken> {
        self.0.first_token().filter(|token| token.kind() == SyntaxKind::WHILE_KW)
    }

    /// What decides; nothing of `DO1` alone.
    pub fn condition(&self) -> Option<Expr> {
        let mut before = self.0.children_with_tokens().take_while(|child| child.kind() != SyntaxKind::DO_KW);
        before.find_map(Expr::cast)
    }

    /// The number after `DO`.
    pub fn number(&self) -> Option<Expr> {
        let mut after = self.0.children_with_tokens().skip_while(|child| child.kind() != SyntaxKind::DO_KW);
        after.find_map(Expr::cast)
    }
}

impl EndStatement {
    /// The number of the loop.
    pub fn number(&self) -> Option<Expr> {
        expressions(&self.0).next()
    }
}

impl GotoStatement {
    /// The sequence number of the block to go on at.
    pub fn target(&self) -> Option<Expr> {
        expressions(&self.0).next()
    }
}

impl OStatement {
    /// The label.
    pub fn label(&self) -> Option<OLabel> {
        self.0.children_with_tokens().next().and_then(OLabel::cast)
    }

    /// The token with the keyword: `SUB`, `CALL`, `IF`, …
    pub fn keyword(&self) -> Option<SyntaxToken> {
        token(&self.0, SyntaxKind::is_keyword)
    }

    /// The condition of `IF`, `ELSEIF` and `WHILE`, how often `REPEAT` repeats, what `RETURN` and `ENDSUB` return.
    pub fn operand(&self) -> Option<Expr> {
        let keyword = self.keyword().filter(|keyword| keyword.kind() != SyntaxKind::CALL_KW)?;
        self.after(&keyword).find_map(Expr::cast)
    }

    /// The arguments of `CALL`.
    pub fn arguments(&self) -> Vec<Group> {
        let call = self.keyword().filter(|keyword| keyword.kind() == SyntaxKind::CALL_KW);
        let groups =
            call.map(|call| self.after(&call).filter_map(NodeOrToken::into_node).filter_map(Group::cast));
        groups.into_iter().flatten().collect()
    }

    /// The index of the argument that a place of the line is in, else of the one that would come there.
    pub fn argument_at(&self, offset: u32) -> usize {
        let arguments = self.arguments().into_iter();
        let begun: Vec<Group> = arguments.take_while(|group| group.range().start < offset).collect();
        let is_inside = begun.last().is_some_and(|last| last.surrounds(offset));
        begun.len() - usize::from(is_inside)
    }

    fn after(&self, keyword: &SyntaxToken) -> impl Iterator<Item = SyntaxElement> + use<> {
        let start = keyword.text_range().end();
        self.0.children_with_tokens().filter(move |child| child.text_range().start() >= start)
    }
}

impl PrintStatement {
    /// Is a place of the line between the brackets of what is printed? All that is after a bracket which is not closed is.
    pub fn surrounds(&self, offset: u32) -> bool {
        let tokens = || self.0.children_with_tokens().filter_map(NodeOrToken::into_token);
        let count = |kind| tokens().filter(|token| token.kind() == kind).count();
        let (open, closed) = (count(SyntaxKind::L_BRACKET), count(SyntaxKind::R_BRACKET));
        let first = token(&self.0, |kind| kind == SyntaxKind::L_BRACKET);
        first.is_some_and(|first| byte_range(first.text_range()).end <= offset)
            && (offset < self.range().end || closed < open)
    }
}

/// The label of an O-word: `O100`, `O<name>`, `O[#1]`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct OLabel(SyntaxElement);

impl OLabel {
    /// Views a name or a word with the address `O`.
    pub fn cast(element: SyntaxElement) -> Option<Self> {
        let is_label = match &element {
            NodeOrToken::Token(token) if token.kind() == SyntaxKind::O_NAME => true,
            _ => Word::cast(element.clone()).is_some_and(|word| word.letter() == Some('O')),
        };
        is_label.then_some(Self(element))
    }

    /// Bytes of the parsed text, from the `O` on.
    pub fn range(&self) -> Range<u32> {
        byte_range(self.0.text_range())
    }

    /// What is between the brackets of `O<name>`.
    pub fn name(&self) -> Option<&str> {
        self.0
            .as_token()
            .filter(|token| token.kind() == SyntaxKind::O_NAME)?
            .text()
            .split_once('<')?
            .1
            .strip_suffix('>')
    }

    /// The number of `O100`, and of a name that is one: `O<100>`.
    pub fn number(&self) -> Option<u32> {
        match self.name() {
            Some(name) => name.trim().parse().ok(),
            None => Word::cast(self.0.clone())?.integer(),
        }
    }
}
