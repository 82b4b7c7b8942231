//! Typed views of the tree: how editor features and fixes read the structure of a program's text.
//!
//! A view is a node or token of a known kind with methods for its parts; a part that is missing in the text is `None`. Offsets
//! count from the start of the parsed text.
//!
//! Knows: which kinds are where. Must not know: values; a view gives text and ranges.

mod block;
mod comment;
mod element;
mod expression;
mod statement;
mod view;
mod word;

pub use block::{Block, BlockDelete, Chunk};
pub use comment::{Comment, comment_text};
pub use element::Element;
pub use expression::{Binary, Expr, FunctionCall, Group, Indirect, Number, Unary, Variable, variable_name};
pub use statement::{
    Assignment, CommandStatement, Condition, EndStatement, GotoStatement, IfStatement, OLabel, OStatement,
    PortStatement, PrintStatement, Statement, WhileStatement,
};
pub use word::Word;
