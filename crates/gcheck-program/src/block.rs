//! The blocks of one chunk, as flat tables.
//!
//! Knows: words, codes, expressions and statements by index. Must not know: what they do. Offsets count from the start of
//! the chunk, so that a table can be cached while text above it changes.

use std::ops::Range;

use gcheck_controls::{CodeIx, Letter, LetterSet};
use gcheck_syntax::SyntaxError;

use crate::NumberShape;
use crate::expression::{Expr, ExprIx, Op};
use crate::statement::Statement;

bitflags::bitflags! {
    /// What a block has, so that a rule or the engine can pass over plain motion at the cost of one test.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
    pub struct BlockFlags: u32 {
        /// A `G` or `M` word.
        const CODE = 1;
        /// A code that the control does not have, or that is not a code at all (`G1.25`).
        const UNKNOWN_CODE = 1 << 1;
        /// A mistake in form.
        const ERROR = 1 << 2;
        /// An assignment or a flow statement.
        const STATEMENT = 1 << 3;
        /// A word whose value is an expression.
        const EXPRESSION = 1 << 4;
        /// An address is given twice that may be given once.
        const REPEATED = 1 << 5;
        /// A value without decimal point, not zero, on an address that is not a plain count.
        const UNPOINTED = 1 << 6;
        /// A decimal point on an address that takes whole numbers.
        const POINT_ON_INTEGER = 1 << 7;
        /// A minus sign on an address that takes none.
        const NEGATIVE = 1 << 8;
        /// A value outside the range of its address.
        const OUT_OF_RANGE = 1 << 9;
        /// A number with more digits than the control takes.
        const LONG_NUMBER = 1 << 10;
        /// An address that the control does not have.
        const UNKNOWN_ADDRESS = 1 << 11;
        /// A sequence number.
        const LABEL = 1 << 12;
        /// An `O` word or `:1234`.
        const PROGRAM_NUMBER = 1 << 13;
        /// `%`.
        const TAPE_MARK = 1 << 14;
        /// `/`, anywhere.
        const BLOCK_DELETE = 1 << 15;
        /// A comment.
        const COMMENT = 1 << 16;
        /// More characters than a line of the control may have.
        const LONG_LINE = 1 << 17;
        /// An address that no code of the block reads and that is not free to be anywhere.
        const UNREAD_WORD = 1 << 18;
        /// A lower-case letter outside comments.
        const LOWER_CASE = 1 << 19;
        /// An axis is with its own address and with that of its increments.
        const AXIS_TWICE = 1 << 20;
        /// A word whose number has a blank between its digits: `X1. 5`.
        const DIVIDED_NUMBER = 1 << 21;
        /// Text that is not code and reads like a remark without its parentheses. The letters and numbers in it mean nothing.
        const REMARK = 1 << 22;
    }
}

impl BlockFlags {
    /// Flags that the words of a block decide.
    pub(crate) const OF_WORDS: Self = Self::CODE
        .union(Self::UNKNOWN_CODE)
        .union(Self::EXPRESSION)
        .union(Self::REPEATED)
        .union(Self::UNPOINTED)
        .union(Self::POINT_ON_INTEGER)
        .union(Self::NEGATIVE)
        .union(Self::OUT_OF_RANGE)
        .union(Self::LONG_NUMBER)
        .union(Self::UNKNOWN_ADDRESS)
        .union(Self::LABEL)
        .union(Self::PROGRAM_NUMBER)
        .union(Self::UNREAD_WORD)
        .union(Self::AXIS_TWICE);
}

/// Index of a block in its chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BlockIx(pub(crate) u32);

impl BlockIx {
    /// A number usable as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Bytes of the chunk, from the block's first character to before its end of line.
    pub range: Range<u32>,
    /// What it has.
    pub flags: BlockFlags,
    /// Addresses of its words.
    pub letters: LetterSet,
    /// Level of block delete: 0 without, 1 for `/` and `/1`.
    pub delete: u8,
    pub(crate) words: Range<u32>,
}

/// One word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Word {
    /// The address.
    pub letter: Letter,
    /// The value.
    pub value: Value,
    /// How a literal number is written; all zero for an expression.
    pub shape: NumberShape,
    /// The code that a `G` or `M` word names; [`CodeIx::NONE`] for other words and unknown codes.
    pub code: CodeIx,
    pub(crate) start: u32,
    pub(crate) end: u32,
}

impl Word {
    /// Bytes of the chunk.
    pub fn range(&self) -> Range<u32> {
        self.start..self.end
    }

    /// The same word with a value that was computed, and the code that it names. Nothing of the number is written.
    #[must_use]
    pub fn with_value(self, value: f64, code: CodeIx) -> Self {
        Self { value: Value::Number(value), shape: NumberShape::default(), code, ..self }
    }

    /// Is the value computed, whether it is known or not?
    pub fn is_computed(&self) -> bool {
        match self.value {
            Value::Expr(_) => true,
            Value::Number(_) => self.shape.digits() == 0,
            Value::Missing => false,
        }
    }

    /// The value, if it is written as a number.
    pub fn number(&self) -> Option<f64> {
        match self.value {
            Value::Number(number) => Some(number),
            Value::Expr(_) | Value::Missing => None,
        }
    }

    /// The value as a whole number not below zero, if it is written as one.
    pub fn integer(&self) -> Option<u32> {
        let number = self.number().filter(|n| (0.0..=f64::from(u32::MAX)).contains(n))?;
        #[expect(clippy::cast_sign_loss, reason = "range checked above")]
        let integer = number as u32;
        #[expect(clippy::float_cmp, reason = "asks whether the value is exactly whole")]
        (f64::from(integer) == number).then_some(integer)
    }
}

/// The value of a word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// Written as a number, in the units of the program.
    Number(f64),
    /// Computed.
    Expr(ExprIx),
    /// Not written.
    Missing,
}

/// The blocks of one chunk. Blank lines make no block.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BlockTable {
    pub(crate) blocks: Vec<Block>,
    pub(crate) words: Vec<Word>,
    pub(crate) exprs: Vec<Expr>,
    pub(crate) ops: Vec<Op>,
    pub(crate) statements: Vec<(BlockIx, Statement)>,
    pub(crate) errors: Vec<(BlockIx, SyntaxError)>,
    pub(crate) directives: Vec<Range<u32>>,
    /// What any block has.
    pub(crate) flags: BlockFlags,
}

impl BlockTable {
    /// The blocks in text order.
    pub fn blocks(&self) -> impl ExactSizeIterator<Item = (BlockIx, &Block)> {
        self.blocks.iter().enumerate().map(|(ix, block)| (BlockIx(ix as u32), block))
    }

    /// What any of the blocks has.
    pub fn flags(&self) -> BlockFlags {
        self.flags
    }

    /// How many blocks there are.
    pub fn len(&self) -> usize {
        self.blocks.len()
    }

    /// True when the chunk has no block.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// A block.
    #[expect(clippy::indexing_slicing, reason = "a BlockIx is only made by this table")]
    pub fn block(&self, ix: BlockIx) -> &Block {
        &self.blocks[ix.index()]
    }

    /// The index of a block by its place in the table.
    pub fn ix(&self, index: u32) -> Option<BlockIx> {
        ((index as usize) < self.blocks.len()).then_some(BlockIx(index))
    }

    /// The words of a block in text order, statements not included.
    pub fn words(&self, block: &Block) -> &[Word] {
        self.words.get(block.words.start as usize..block.words.end as usize).unwrap_or_default()
    }

    /// The statements of a block in text order.
    pub fn statements(&self, ix: BlockIx) -> impl Iterator<Item = &Statement> {
        // Most blocks have none.
        let has_some = self.block(ix).flags.contains(BlockFlags::STATEMENT);
        of_block(if has_some { &self.statements } else { &[] }, ix)
    }

    /// All statements with their blocks.
    pub fn all_statements(&self) -> &[(BlockIx, Statement)] {
        &self.statements
    }

    /// The mistakes in form of a block.
    pub fn errors(&self, ix: BlockIx) -> impl Iterator<Item = &SyntaxError> {
        of_block(&self.errors, ix)
    }

    /// Comments that hold a `gcheck:` directive.
    pub fn directives(&self) -> &[Range<u32>] {
        &self.directives
    }

    /// An expression.
    #[expect(clippy::indexing_slicing, reason = "an ExprIx is only made by this table")]
    pub fn expr(&self, ix: ExprIx) -> &Expr {
        &self.exprs[ix.index()]
    }

    /// The operations of an expression in the order of evaluation.
    pub fn ops(&self, expr: &Expr) -> &[Op] {
        self.ops.get(expr.ops.start as usize..expr.ops.end as usize).unwrap_or_default()
    }

    /// Does the word's value depend on a variable?
    pub fn reads_variable(&self, word: &Word) -> bool {
        let Value::Expr(ix) = word.value else { return false };
        let reads = |op: &Op| matches!(op, Op::Variable(_) | Op::Named { .. } | Op::Indirect);
        self.ops(self.expr(ix)).iter().any(reads)
    }

    /// The value of an expression that is a number as it is written: `[5]`, `-1.`.
    pub fn constant(&self, ix: ExprIx) -> Option<f64> {
        match self.ops(self.expr(ix)) {
            [Op::Number(value)] => Some(*value),
            [Op::Number(value), Op::Negate] => Some(-value),
            _ => None,
        }
    }
}

/// Entries of one block in a list sorted by block.
fn of_block<T>(list: &[(BlockIx, T)], ix: BlockIx) -> impl Iterator<Item = &T> {
    let first = list.partition_point(|(block, _)| *block < ix);
    list.get(first..)
        .unwrap_or_default()
        .iter()
        .take_while(move |(block, _)| *block == ix)
        .map(|(_, item)| item)
}
