//! Macro expressions in the order of evaluation.
//!
//! Knows: operators and functions by name. Must not know: their values on any control.

use std::ops::Range;

/// Index of an expression in its chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprIx(pub(crate) u32);

impl ExprIx {
    /// A number usable as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expr {
    /// Bytes of the chunk.
    pub range: Range<u32>,
    /// Every operator has its operands. An ill-formed expression has a syntax error and no value.
    pub well_formed: bool,
    pub(crate) ops: Range<u32>,
}

/// One operation on a stack of values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Op {
    /// Pushes a number.
    Number(f64),
    /// Pushes a numbered variable.
    Variable(u32),
    /// Pushes a named parameter; its name, brackets not included, is at this place of the chunk.
    Named {
        /// First byte of the name.
        start: u32,
        /// Byte after the name.
        end: u32,
    },
    /// Pops a number, pushes the variable of that number.
    Indirect,
    /// Changes the sign.
    Negate,
    /// Pops two, pushes one.
    Binary(BinaryOp),
    /// Pops as many as the function has arguments, pushes one.
    Call(Function, u8),
}

/// Operators with two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names are the operators")]
pub enum BinaryOp {
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Power,
    Equal,
    NotEqual,
    Greater,
    GreaterEqual,
    Less,
    LessEqual,
    And,
    Or,
    Xor,
}

impl BinaryOp {
    /// The operator of a token's text.
    pub(crate) fn parse(text: &[u8]) -> Option<Self> {
        const NAMES: [(&[u8], BinaryOp); 15] = [
            (b"+", BinaryOp::Add),
            (b"-", BinaryOp::Subtract),
            (b"*", BinaryOp::Multiply),
            (b"/", BinaryOp::Divide),
            (b"MOD", BinaryOp::Modulo),
            (b"**", BinaryOp::Power),
            (b"EQ", BinaryOp::Equal),
            (b"NE", BinaryOp::NotEqual),
            (b"GT", BinaryOp::Greater),
            (b"GE", BinaryOp::GreaterEqual),
            (b"LT", BinaryOp::Less),
            (b"LE", BinaryOp::LessEqual),
            (b"AND", BinaryOp::And),
            (b"OR", BinaryOp::Or),
            (b"XOR", BinaryOp::Xor),
        ];
        NAMES.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)).map(|(_, op)| *op)
    }
}

macro_rules! functions {
    ($($name:literal = $variant:ident,)*) => {
        /// Functions of expressions.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[expect(missing_docs, reason = "the names are the functions")]
        pub enum Function {
            $($variant,)*
        }

        impl Function {
            /// The name as programs write it, upper case.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// The function of a name, any case.
            pub fn parse(text: &[u8]) -> Option<Self> {
                [$(Self::$variant,)*].into_iter().find(|f| f.name().as_bytes().eq_ignore_ascii_case(text))
            }
        }
    };
}

functions! {
    "ABS" = Abs,
    "ACOS" = Acos,
    "ASIN" = Asin,
    "ATAN" = Atan,
    "BCD" = Bcd,
    "BIN" = Bin,
    "COS" = Cos,
    "EXISTS" = Exists,
    "EXP" = Exp,
    "FIX" = Fix,
    "FUP" = Fup,
    "LN" = Ln,
    "NOT" = Not,
    "POW" = Pow,
    "ROUND" = Round,
    "SIN" = Sin,
    "SQRT" = Sqrt,
    "TAN" = Tan,
}

/// Does every operation find its operands, with one value left at the end?
pub(crate) fn is_well_formed(ops: &[Op]) -> bool {
    let mut depth: usize = 0;
    for op in ops {
        let (takes, gives) = match op {
            Op::Number(_) | Op::Variable(_) | Op::Named { .. } => (0, 1),
            Op::Indirect | Op::Negate => (1, 1),
            Op::Binary(_) => (2, 1),
            Op::Call(_, arguments) => (usize::from(*arguments), 1),
        };
        match depth.checked_sub(takes) {
            Some(rest) => depth = rest + gives,
            None => return false,
        }
    }
    depth == 1
}
