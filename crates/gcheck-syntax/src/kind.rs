//! The names of everything that can be in a tree.
//!
//! Knows: names. Must not know: how tokens are recognised (see [`crate::lexer`]) or arranged (see [`crate::grammar`]).

macro_rules! syntax_kinds {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// Kind of a token or node.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[expect(non_camel_case_types, reason = "the customary spelling of syntax kinds, as in the trees people print")]
        #[repr(u16)]
        pub enum SyntaxKind {
            $($(#[$doc])* $name,)*
        }

        impl SyntaxKind {
            /// Every kind, at the index of its number.
            pub const ALL: &'static [Self] = &[$(Self::$name,)*];
        }
    };
}

syntax_kinds! {
    // Tokens.
    /// Blanks and tabs.
    WHITESPACE,
    /// `\n`, `\r\n` or `\r`.
    NEWLINE,
    /// Byte order mark.
    BOM,
    /// `%`.
    PERCENT,
    /// `X-1.5`, `G01`, `,R.5`: address and number, fused.
    WORD,
    /// An address whose value does not follow directly.
    LETTER,
    /// A number without address.
    NUMBER,
    /// `#100`.
    VARIABLE,
    /// `#<name>`.
    NAMED_VARIABLE,
    /// `O<name>`.
    O_NAME,
    /// `:1234`.
    COLON_NUMBER,
    /// `#` before a bracket or another variable.
    HASH,
    /// `[`.
    L_BRACKET,
    /// `]`.
    R_BRACKET,
    /// `+`.
    PLUS,
    /// `-`.
    MINUS,
    /// `*`.
    STAR,
    /// `**`.
    POWER,
    /// `/`: division or block delete.
    SLASH,
    /// `=`.
    EQUALS,
    /// `,`.
    COMMA,
    /// `)` without `(`.
    R_PAREN,
    /// `(…)`.
    COMMENT,
    /// A parenthesis comment that is nested or not closed.
    BROKEN_COMMENT,
    /// `; …` where the control reads it as a comment.
    LINE_COMMENT,
    /// `;` where it ends the block.
    SEMICOLON,
    /// `EQ`, `NE`, `GT`, `GE`, `LT`, `LE`.
    COMPARISON,
    /// `AND`.
    AND_KW,
    /// `OR`, `XOR`.
    OR_KW,
    /// `MOD`.
    MOD_KW,
    /// `SIN`, `ROUND`, …
    FUNCTION,
    /// `IF`.
    IF_KW,
    /// `THEN`.
    THEN_KW,
    /// `ELSE`.
    ELSE_KW,
    /// `ELSEIF`.
    ELSEIF_KW,
    /// `ENDIF`.
    ENDIF_KW,
    /// `WHILE`, `WH`.
    WHILE_KW,
    /// `ENDWHILE`.
    ENDWHILE_KW,
    /// `DO`.
    DO_KW,
    /// `END`.
    END_KW,
    /// `GOTO`.
    GOTO_KW,
    /// `SUB`.
    SUB_KW,
    /// `ENDSUB`.
    ENDSUB_KW,
    /// `CALL`.
    CALL_KW,
    /// `RETURN`.
    RETURN_KW,
    /// `REPEAT`.
    REPEAT_KW,
    /// `ENDREPEAT`.
    ENDREPEAT_KW,
    /// `BREAK`.
    BREAK_KW,
    /// `CONTINUE`.
    CONTINUE_KW,
    /// `DPRNT`, `BPRNT`.
    PRINT_KW,
    /// `POPEN`, `PCLOS`, `SETVN101[DEPTH]`.
    PORT_KW,
    /// `$H`, `$J=G91 X1`: a command to the firmware.
    COMMAND,
    /// A character that no control reads.
    UNKNOWN,

    // Nodes.
    /// Whole lines of a program: the root of a tree.
    CHUNK,
    /// One block, up to and with its end.
    BLOCK,
    /// `/` or `/3` at the head of a block.
    BLOCK_DELETE,
    /// An address whose value is not fused: `X#1`, `X[#1+2.]`, `X 1.`, or missing.
    ADDRESS,
    /// `#1 = …`.
    ASSIGNMENT,
    /// `[…]` in front of words, as in `[#1 LT 10] M99 P10`.
    CONDITION,
    /// `IF […] GOTO n`, `IF […] THEN …`.
    IF_STATEMENT,
    /// `WHILE […] DO1`, `DO1`.
    WHILE_STATEMENT,
    /// `END1`.
    END_STATEMENT,
    /// `GOTO 10`.
    GOTO_STATEMENT,
    /// `O100 SUB`, `O<probe> CALL [1]`.
    O_STATEMENT,
    /// `DPRNT[…]`.
    PRINT_STATEMENT,
    /// `POPEN`, `PCLOS`, `SETVN101[DEPTH]`.
    PORT_STATEMENT,
    /// `$H`, `$J=G91 X1`.
    COMMAND_STATEMENT,
    /// `a + b`.
    BINARY,
    /// `-a`.
    UNARY,
    /// `[a]`.
    GROUP,
    /// `SIN[a]`, `ATAN[a]/[b]`.
    FUNCTION_CALL,
    /// `##1`, `#[#1+2]`.
    INDIRECT,
    /// `1 0 . 5` in an expression, where blanks in numbers do not count.
    DIVIDED_NUMBER,
    /// What the grammar could not use; an error says why.
    ERROR,
}

impl SyntaxKind {
    /// Blanks and comments: what formatting may touch and meaning ignores.
    pub fn is_trivia(self) -> bool {
        matches!(self, Self::WHITESPACE | Self::NEWLINE | Self::BOM) || self.is_comment()
    }

    /// A comment of any form.
    pub fn is_comment(self) -> bool {
        matches!(self, Self::COMMENT | Self::BROKEN_COMMENT | Self::LINE_COMMENT)
    }

    /// An operator between two operands; some of these characters have other uses as well.
    pub fn is_operator(self) -> bool {
        matches!(
            self,
            Self::PLUS
                | Self::MINUS
                | Self::STAR
                | Self::POWER
                | Self::SLASH
                | Self::COMPARISON
                | Self::AND_KW
                | Self::OR_KW
                | Self::MOD_KW
        )
    }

    /// A word of a macro statement.
    pub fn is_keyword(self) -> bool {
        (Self::IF_KW..=Self::PORT_KW).contains(&self)
    }
}
