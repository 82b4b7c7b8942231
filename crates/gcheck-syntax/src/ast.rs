//! Typed views of the tree: what the editor features and fixes walk.
//!
//! Knows: which kinds are where. Must not know: values; a view gives text and ranges.

use rowan::{NodeOrToken, TextRange};

use crate::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};

macro_rules! views {
    ($($(#[$doc:meta])* $name:ident = $kind:ident,)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug, Clone, PartialEq, Eq, Hash)]
            pub struct $name(SyntaxNode);

            impl $name {
                /// Views a node, if it is of this kind.
                pub fn cast(node: SyntaxNode) -> Option<Self> {
                    (node.kind() == SyntaxKind::$kind).then_some(Self(node))
                }

                /// The node.
                pub fn syntax(&self) -> &SyntaxNode {
                    &self.0
                }
            }
        )*
    };
}

views! {
    /// Whole lines of a program.
    Chunk = CHUNK,
    /// One block.
    Block = BLOCK,
    /// `/` or `/3`.
    BlockDelete = BLOCK_DELETE,
    /// `#1 = …`.
    Assignment = ASSIGNMENT,
    /// `[…]` in front of words.
    Condition = CONDITION,
    /// `IF […] …`.
    IfStatement = IF_STATEMENT,
    /// `WHILE […] DO1`.
    WhileStatement = WHILE_STATEMENT,
    /// `END1`.
    EndStatement = END_STATEMENT,
    /// `GOTO 10`.
    GotoStatement = GOTO_STATEMENT,
    /// `O100 SUB`.
    OStatement = O_STATEMENT,
    /// `DPRNT[…]`.
    PrintStatement = PRINT_STATEMENT,
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

    /// The block delete, wherever it is.
    pub fn block_delete(&self) -> Option<BlockDelete> {
        self.0.children().find_map(BlockDelete::cast)
    }

    /// Assignments in order.
    pub fn assignments(&self) -> impl Iterator<Item = Assignment> + use<> {
        self.0.children().filter_map(Assignment::cast)
    }

    /// Comments in order.
    pub fn comments(&self) -> impl Iterator<Item = SyntaxToken> + use<> {
        self.0.descendants_with_tokens().filter_map(NodeOrToken::into_token).filter(|t| t.kind().is_comment())
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

impl Assignment {
    /// What is assigned to.
    pub fn target(&self) -> Option<SyntaxElement> {
        self.0.children_with_tokens().find(|e| !e.kind().is_trivia())
    }

    /// What is assigned.
    pub fn value(&self) -> Option<SyntaxElement> {
        let mut after = self.0.children_with_tokens().skip_while(|e| e.kind() != SyntaxKind::EQUALS).skip(1);
        after.find(|e| !e.kind().is_trivia())
    }
}

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
                Some(Self::Fused(t))
            }
            NodeOrToken::Node(n) if n.kind() == SyntaxKind::ADDRESS => Some(Self::Spread(n)),
            _ => None,
        }
    }

    /// The address, upper case; `O` for `:1234`.
    pub fn letter(&self) -> Option<char> {
        let first = match self {
            Self::Fused(token) => token.text().chars().find(|c| *c != ','),
            Self::Spread(node) => node.first_token()?.text().chars().find(|c| *c != ','),
        }?;
        Some(if first == ':' { 'O' } else { first.to_ascii_uppercase() })
    }

    /// Where the word is in its chunk.
    pub fn range(&self) -> TextRange {
        match self {
            Self::Fused(token) => token.text_range(),
            Self::Spread(node) => node.text_range(),
        }
    }

    /// The value's node or token; `None` for a fused word and for an address without value.
    pub fn value(&self) -> Option<SyntaxElement> {
        match self {
            Self::Fused(_) => None,
            Self::Spread(node) => node.children_with_tokens().skip(1).find(|e| !e.kind().is_trivia()),
        }
    }
}
