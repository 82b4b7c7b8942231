//! What the words, expressions and variables of a block come to.
//!
//! Knows: values and how a control counts them. Must not know: what a block does with them.

pub(crate) mod expression;
pub(crate) mod narrowing;
pub(crate) mod numbers;
pub(crate) mod system;
pub(crate) mod value;
pub(crate) mod variables;
pub(crate) mod words;
