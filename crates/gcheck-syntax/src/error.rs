//! What can be wrong with the form of a block, as kinds without words for people.

use std::ops::Range;

/// One mistake in the form of a block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SyntaxError {
    /// What is wrong.
    pub kind: SyntaxErrorKind,
    /// Where, in bytes from the start of the parsed text.
    pub range: Range<u32>,
}

/// Kinds of mistakes; `gcheck-rules` has a rule with the wording for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SyntaxErrorKind {
    /// `(` without `)` on its line.
    UnclosedComment,
    /// `(` inside a comment.
    NestedComment,
    /// `)` without `(`.
    StrayParenthesis,
    /// `[` without `]`.
    UnclosedBracket,
    /// `]` without `[`.
    StrayBracket,
    /// Brackets, signs or `IF … THEN` nested deeper than [`MAX_EXPRESSION_DEPTH`](crate::MAX_EXPRESSION_DEPTH), or more
    /// operators in a line than [`MAX_OPERATORS`](crate::MAX_OPERATORS).
    TooDeep,
    /// A line longer than [`MAX_LINE_BYTES`](crate::MAX_LINE_BYTES).
    LineTooLong,
    /// An address without a number or expression.
    AddressWithoutValue,
    /// A number without an address.
    ValueWithoutAddress,
    /// A number with a second point or sign: `X1.2.3`.
    MalformedNumber,
    /// An operator or function without its operand.
    MissingOperand,
    /// `#1=#2+3` or `X#1+2` where brackets are needed.
    NeedsBrackets,
    /// `#1` without `=` where a block must assign.
    MissingEquals,
    /// `IF […]` without `GOTO` or `THEN`.
    IfWithoutConsequence,
    /// `IF`, `WHILE`, `ELSEIF` or `REPEAT` without `[…]`.
    MissingCondition,
    /// `GOTO`, `DO` or `END` without its number.
    MissingNumber,
    /// `WHILE […]` without `DO`.
    WhileWithoutDo,
    /// `O<name>` without `SUB`, `CALL`, ….
    OWordWithoutKeyword,
    /// A keyword in the wrong place.
    StrayKeyword,
    /// Characters that no control reads, or that make no sense here.
    Unexpected,
    /// Text after the end-of-block character that is not a block.
    TextAfterEndOfBlock,
    /// A form that other controls have and this one has not.
    Foreign(ForeignForm),
}

/// Forms of text that only some controls have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ForeignForm {
    /// `O100 SUB`.
    OWord,
    /// `IF […] GOTO`, `WHILE […] DO1`, `DPRNT[…]`.
    MacroStatement,
    /// `#1`.
    Variable,
    /// `[…]` for a value.
    Expression,
    /// `#<name>`.
    NamedParameter,
    /// `**`.
    PowerOperator,
    /// `$H`, `$J=G91 X1`.
    SystemCommand,
}
