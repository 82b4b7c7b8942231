//! Macro and O-word statements.
//!
//! Knows: their parts by index. Must not know: which blocks they join (see [`crate::file index`]).

use std::ops::Range;

use crate::expression::ExprIx;

/// One statement, with its bytes in the chunk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Statement {
    /// Bytes of the chunk.
    pub range: Range<u32>,
    /// What it is.
    pub kind: StatementKind,
}

/// What a statement is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StatementKind {
    /// `#1 = …`.
    Assign {
        /// What is assigned to.
        target: Target,
        /// What is assigned; `None` after a mistake in form.
        value: Option<ExprIx>,
    },
    /// `IF […]`: what follows in the block (a `GOTO`, an assignment, words) happens only if the condition holds.
    If {
        /// The condition; `None` after a mistake in form.
        condition: Option<ExprIx>,
    },
    /// `[…]` in front of words: as `IF`.
    Guard {
        /// The condition.
        condition: Option<ExprIx>,
    },
    /// `GOTO`.
    Goto {
        /// The label; `None` after a mistake in form.
        target: Option<ExprIx>,
    },
    /// `WHILE […] DOn`, `DOn`.
    Do {
        /// `None` for a plain `DO`.
        condition: Option<ExprIx>,
        /// `n`.
        number: Option<ExprIx>,
    },
    /// `ENDn`.
    End {
        /// `n`.
        number: Option<ExprIx>,
    },
    /// `O… SUB` and the like.
    OWord {
        /// The label.
        label: OLabel,
        /// The keyword.
        keyword: OKeyword,
        /// Condition, count, arguments or result.
        arguments: Range<u32>,
    },
    /// `DPRNT[…]`, `BPRNT[…]`, `POPEN`, `PCLOS`, `SETVN…[…]`.
    Print,
    /// `$H`, `$J=G91 X1`: a command to the firmware.
    Command,
}

impl StatementKind {
    /// The statement's expressions: its target's, its condition, its value, its arguments.
    pub fn expressions(&self) -> impl Iterator<Item = ExprIx> + use<> {
        let (first, second, arguments) = match self {
            Self::Assign { target: Target::Computed(target), value } => (Some(*target), *value, 0..0),
            Self::Assign { value, .. } => (*value, None, 0..0),
            Self::If { condition } | Self::Guard { condition } => (*condition, None, 0..0),
            Self::Goto { target } => (*target, None, 0..0),
            Self::Do { condition, number } => (*condition, *number, 0..0),
            Self::End { number } => (*number, None, 0..0),
            Self::OWord { arguments, .. } => (None, None, arguments.clone()),
            Self::Print | Self::Command => (None, None, 0..0),
        };
        first.into_iter().chain(second).chain(arguments.map(ExprIx))
    }

    /// Indices of an O-word's arguments.
    pub fn arguments(range: &Range<u32>) -> impl Iterator<Item = ExprIx> + use<> {
        range.clone().map(ExprIx)
    }
}

/// What an assignment assigns to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// `#100`.
    Variable(u32),
    /// `#<name>`: bytes of the name in the chunk.
    Named(Range<u32>),
    /// `#[#1+2]`: the expression gives the number.
    Computed(ExprIx),
    /// Not readable.
    Invalid,
}

/// The label of an O-word.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum OLabel {
    /// `O100`, `O<100>`.
    Number(u32),
    /// `O<name>`: lower case, blanks removed, as the interpreter compares names.
    Name(String),
    /// `O[#1]`.
    Computed,
}

impl OLabel {
    /// The label of a name in lower case without blanks: `O<100>` is `O100`, `O<0100>` is not.
    pub fn of_name(name: String) -> Self {
        match name.parse::<u32>() {
            Ok(number) if number.to_string() == name => Self::Number(number),
            _ => Self::Name(name),
        }
    }

    /// How many of the statement's expressions are the label's own: they come first.
    pub fn expressions(&self) -> usize {
        usize::from(*self == Self::Computed)
    }
}

/// The keyword of an O-word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names are the keywords")]
pub enum OKeyword {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
}

impl OKeyword {
    pub(crate) fn of(kind: gcheck_syntax::SyntaxKind) -> Option<Self> {
        use gcheck_syntax::SyntaxKind as K;
        Some(match kind {
            K::SUB_KW => Self::Sub,
            K::ENDSUB_KW => Self::EndSub,
            K::CALL_KW => Self::Call,
            K::RETURN_KW => Self::Return,
            K::IF_KW => Self::If,
            K::ELSEIF_KW => Self::ElseIf,
            K::ELSE_KW => Self::Else,
            K::ENDIF_KW => Self::EndIf,
            K::WHILE_KW => Self::While,
            K::ENDWHILE_KW => Self::EndWhile,
            K::DO_KW => Self::Do,
            K::REPEAT_KW => Self::Repeat,
            K::ENDREPEAT_KW => Self::EndRepeat,
            K::BREAK_KW => Self::Break,
            K::CONTINUE_KW => Self::Continue,
            _ => return None,
        })
    }

    /// Upper case, as people write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sub => "SUB",
            Self::EndSub => "ENDSUB",
            Self::Call => "CALL",
            Self::Return => "RETURN",
            Self::If => "IF",
            Self::ElseIf => "ELSEIF",
            Self::Else => "ELSE",
            Self::EndIf => "ENDIF",
            Self::While => "WHILE",
            Self::EndWhile => "ENDWHILE",
            Self::Do => "DO",
            Self::Repeat => "REPEAT",
            Self::EndRepeat => "ENDREPEAT",
            Self::Break => "BREAK",
            Self::Continue => "CONTINUE",
        }
    }
}
