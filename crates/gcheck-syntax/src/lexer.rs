//! Tokens: how characters group, whatever the control.
//!
//! Knows: characters. Must not know: what a word means, or how tokens group into blocks. Every byte belongs to exactly one
//! token and lexing never fails.

use logos::Logos;

use crate::SyntaxKind;

/// What the lexer is told about the control: the only dialect choice that changes where a token ends.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LexerMode {
    pub(crate) semicolon_comment: bool,
}

/// A token as logos sees it. Words that need no expression are one token: letter, sign and digits together.
#[derive(Logos, Debug, Clone, Copy, PartialEq, Eq)]
#[logos(extras = LexerMode)]
pub(crate) enum Token {
    #[regex(r"[ \t\x0B\x0C]+")]
    Whitespace,
    #[regex(r"\r\n|\n|\r")]
    Newline,
    #[token("\u{FEFF}")]
    Bom,
    #[token("%")]
    Percent,
    /// `X-1.5`, `,R.5`, `@2.`: an address and its number, fused. Only `,A`, `,C` and `,R` are addresses with a comma.
    #[regex(r"(,[ACRacr]|[A-Za-z@^$])[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)")]
    Word,
    #[regex(r",[ACRacr]|[A-Za-z@^$]")]
    Letter,
    #[regex(r"[0-9]+\.?[0-9]*|\.[0-9]+")]
    Number,
    /// `#100`; a decimal point may end the number, as it may end any number.
    #[regex(r"#[0-9]+\.?")]
    Variable,
    #[regex(r"#[ \t]*<[^<>\r\n]*>")]
    NamedVariable,
    /// `O<name>`.
    #[regex(r"[oO][ \t]*<[^<>\r\n]*>")]
    OName,
    /// `:1234`.
    #[regex(r":[0-9]+")]
    ColonNumber,
    #[token("#")]
    Hash,
    #[token("[")]
    LBracket,
    #[token("]")]
    RBracket,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Star,
    #[token("**")]
    Power,
    #[token("/")]
    Slash,
    #[token("=")]
    Equals,
    #[token(",")]
    Comma,
    #[token(")")]
    RParen,
    #[token("(", comment)]
    Comment(CommentEnd),
    #[token(";", semicolon)]
    Semicolon(SemicolonUse),

    #[token("EQ", ignore(case))]
    #[token("NE", ignore(case))]
    #[token("GT", ignore(case))]
    #[token("GE", ignore(case))]
    #[token("LT", ignore(case))]
    #[token("LE", ignore(case))]
    Comparison,
    #[token("AND", ignore(case))]
    And,
    #[token("OR", ignore(case))]
    #[token("XOR", ignore(case))]
    Or,
    #[token("MOD", ignore(case))]
    Mod,
    #[token("ABS", ignore(case))]
    #[token("ACOS", ignore(case))]
    #[token("ASIN", ignore(case))]
    #[token("ATAN", ignore(case))]
    #[token("BCD", ignore(case))]
    #[token("BIN", ignore(case))]
    #[token("COS", ignore(case))]
    #[token("EXISTS", ignore(case))]
    #[token("EXP", ignore(case))]
    #[token("FIX", ignore(case))]
    #[token("FUP", ignore(case))]
    #[token("LN", ignore(case))]
    #[token("NOT", ignore(case))]
    #[token("POW", ignore(case))]
    #[token("ROUND", ignore(case))]
    #[token("SIN", ignore(case))]
    #[token("SQRT", ignore(case))]
    #[token("TAN", ignore(case))]
    Function,

    // Where blanks do not count, `ELSE IF` and `END IF` are as good as `ELSEIF` and `ENDIF`.
    #[token("IF", ignore(case))]
    If,
    #[token("THEN", ignore(case))]
    Then,
    #[token("ELSE", ignore(case))]
    Else,
    #[regex(r"ELSE[ \t]*IF", ignore(case))]
    ElseIf,
    #[regex(r"END[ \t]*IF", ignore(case))]
    EndIf,
    #[token("WHILE", ignore(case))]
    #[token("WH", ignore(case))]
    While,
    #[regex(r"END[ \t]*WHILE", ignore(case))]
    EndWhile,
    #[token("DO", ignore(case))]
    Do,
    #[token("END", ignore(case))]
    End,
    #[token("GOTO", ignore(case))]
    Goto,
    #[token("SUB", ignore(case))]
    Sub,
    #[regex(r"END[ \t]*SUB", ignore(case))]
    EndSub,
    #[token("CALL", ignore(case))]
    Call,
    #[token("RETURN", ignore(case))]
    Return,
    #[token("REPEAT", ignore(case))]
    Repeat,
    #[regex(r"END[ \t]*REPEAT", ignore(case))]
    EndRepeat,
    #[token("BREAK", ignore(case))]
    Break,
    #[token("CONTINUE", ignore(case))]
    Continue,
    #[token("DPRNT", ignore(case))]
    #[token("BPRNT", ignore(case))]
    Print,
    #[token("POPEN", ignore(case))]
    #[token("PCLOS", ignore(case))]
    // `SETVN101[DEPTH,RADIUS]` gives variables names that the operator sees.
    #[regex(r"SETVN[ \t]*[0-9]+[ \t]*\[[^\[\]\r\n]*\]", ignore(case))]
    Port,

    /// `$H`, `$J=G91 X1`, `$110=500`: a command to the firmware, up to a comment or the end of the line.
    #[regex(r"\$([A-Za-z$/][^\r\n;(]*|[0-9]+=[^\r\n;(]*)")]
    Command,

    /// Any other character; a name in angle brackets that neither `#` nor `O` introduces.
    #[regex(r"<[^<>\r\n]*>")]
    Unknown,

    /// The rest of a line that is longer than is read; the grammar makes it.
    Overlong,
}

/// How a parenthesis comment ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CommentEnd {
    /// At its `)`.
    Closed,
    /// At its `)`, after another `(` inside.
    Nested,
    /// At the end of the line.
    Unclosed,
}

/// What a `;` turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SemicolonUse {
    Comment,
    EndOfBlock,
}

/// A comment runs to the first `)`; with parentheses inside, to the matching one, so that `(A (B) C)` is one mistake and not two.
fn comment(lexer: &mut logos::Lexer<'_, Token>) -> CommentEnd {
    let rest = lexer.remainder().as_bytes();
    let line = rest.get(..memchr::memchr2(b'\r', b'\n', rest).unwrap_or(rest.len())).unwrap_or_default();
    let mut depth = 0_usize;
    let mut nested = false;
    let mut first_close = None;
    for at in memchr::memchr2_iter(b'(', b')', line) {
        if line.get(at) == Some(&b'(') {
            nested = true;
            depth += 1;
        } else if depth == 0 {
            lexer.bump(at + 1);
            return if nested { CommentEnd::Nested } else { CommentEnd::Closed };
        } else {
            first_close.get_or_insert(at);
            depth -= 1;
        }
    }
    match first_close {
        // `(A (B)` closes where a control closes it: at the first parenthesis.
        Some(at) => {
            lexer.bump(at + 1);
            CommentEnd::Nested
        }
        None => {
            lexer.bump(line.len());
            CommentEnd::Unclosed
        }
    }
}

fn semicolon(lexer: &mut logos::Lexer<'_, Token>) -> SemicolonUse {
    if !lexer.extras.semicolon_comment {
        return SemicolonUse::EndOfBlock;
    }
    let rest = lexer.remainder().as_bytes();
    lexer.bump(memchr::memchr2(b'\r', b'\n', rest).unwrap_or(rest.len()));
    SemicolonUse::Comment
}

impl Token {
    /// The kind under which the token is in the tree.
    pub(crate) fn kind(self) -> SyntaxKind {
        match self {
            Self::Whitespace => SyntaxKind::WHITESPACE,
            Self::Newline => SyntaxKind::NEWLINE,
            Self::Bom => SyntaxKind::BOM,
            Self::Percent => SyntaxKind::PERCENT,
            Self::Word => SyntaxKind::WORD,
            Self::Letter => SyntaxKind::LETTER,
            Self::Number => SyntaxKind::NUMBER,
            Self::Variable => SyntaxKind::VARIABLE,
            Self::NamedVariable => SyntaxKind::NAMED_VARIABLE,
            Self::OName => SyntaxKind::O_NAME,
            Self::ColonNumber => SyntaxKind::COLON_NUMBER,
            Self::Hash => SyntaxKind::HASH,
            Self::LBracket => SyntaxKind::L_BRACKET,
            Self::RBracket => SyntaxKind::R_BRACKET,
            Self::Plus => SyntaxKind::PLUS,
            Self::Minus => SyntaxKind::MINUS,
            Self::Star => SyntaxKind::STAR,
            Self::Power => SyntaxKind::POWER,
            Self::Slash => SyntaxKind::SLASH,
            Self::Equals => SyntaxKind::EQUALS,
            Self::Comma => SyntaxKind::COMMA,
            Self::RParen => SyntaxKind::R_PAREN,
            Self::Comment(CommentEnd::Closed) => SyntaxKind::COMMENT,
            Self::Comment(CommentEnd::Nested | CommentEnd::Unclosed) => SyntaxKind::BROKEN_COMMENT,
            Self::Semicolon(SemicolonUse::Comment) => SyntaxKind::LINE_COMMENT,
            Self::Semicolon(SemicolonUse::EndOfBlock) => SyntaxKind::SEMICOLON,
            Self::Comparison => SyntaxKind::COMPARISON,
            Self::And => SyntaxKind::AND_KW,
            Self::Or => SyntaxKind::OR_KW,
            Self::Mod => SyntaxKind::MOD_KW,
            Self::Function => SyntaxKind::FUNCTION,
            Self::If => SyntaxKind::IF_KW,
            Self::Then => SyntaxKind::THEN_KW,
            Self::Else => SyntaxKind::ELSE_KW,
            Self::ElseIf => SyntaxKind::ELSEIF_KW,
            Self::EndIf => SyntaxKind::ENDIF_KW,
            Self::While => SyntaxKind::WHILE_KW,
            Self::EndWhile => SyntaxKind::ENDWHILE_KW,
            Self::Do => SyntaxKind::DO_KW,
            Self::End => SyntaxKind::END_KW,
            Self::Goto => SyntaxKind::GOTO_KW,
            Self::Sub => SyntaxKind::SUB_KW,
            Self::EndSub => SyntaxKind::ENDSUB_KW,
            Self::Call => SyntaxKind::CALL_KW,
            Self::Return => SyntaxKind::RETURN_KW,
            Self::Repeat => SyntaxKind::REPEAT_KW,
            Self::EndRepeat => SyntaxKind::ENDREPEAT_KW,
            Self::Break => SyntaxKind::BREAK_KW,
            Self::Continue => SyntaxKind::CONTINUE_KW,
            Self::Print => SyntaxKind::PRINT_KW,
            Self::Port => SyntaxKind::PORT_KW,
            Self::Command => SyntaxKind::COMMAND,
            Self::Unknown | Self::Overlong => SyntaxKind::UNKNOWN,
        }
    }

    /// Tokens that mean the same wherever they are in a block: a line of these needs no grammar.
    pub(crate) fn is_plain(self) -> bool {
        matches!(self, Self::Word | Self::Whitespace | Self::Newline | Self::Comment(CommentEnd::Closed))
    }
}

/// The tokens of a text, each with its end offset; the token starts where the one before ends.
pub(crate) struct Lexer<'t> {
    inner: logos::Lexer<'t, Token>,
}

impl<'t> Lexer<'t> {
    pub(crate) fn new(text: &'t str, mode: LexerMode) -> Self {
        Self { inner: Token::lexer_with_extras(text, mode) }
    }

    /// Goes on `bytes` further after the last token; no character is cut in two.
    pub(crate) fn pass_over(&mut self, bytes: u32) {
        self.inner.bump(bytes as usize);
    }
}

impl Iterator for Lexer<'_> {
    type Item = (Token, u32);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let token = self.inner.next()?.unwrap_or(Token::Unknown);
        Some((token, self.inner.span().end as u32))
    }
}

/// Counts the tokens of a text: what a bench of the lexer alone can observe.
pub fn count_tokens(text: &str, semicolon_comment: bool) -> usize {
    Lexer::new(text, LexerMode { semicolon_comment }).count()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::{Expect, expect};

    use super::{Lexer, LexerMode};

    fn check(text: &str, semicolon_comment: bool, expected: &Expect) {
        let mut start = 0;
        let mut out = String::new();
        for (token, end) in Lexer::new(text, LexerMode { semicolon_comment }) {
            let end = end as usize;
            let _ = writeln!(out, "{token:?} {:?}", &text[start..end]);
            start = end;
        }
        assert_eq!(start, text.len(), "no byte is lost");
        expected.assert_eq(&out);
    }

    #[test]
    fn a_word_is_one_token_in_every_number_form() {
        check(
            "X1X1.X.5X-.5X+1,R.5@2",
            false,
            &expect![[r#"
                Word "X1"
                Word "X1."
                Word "X.5"
                Word "X-.5"
                Word "X+1"
                Word ",R.5"
                Word "@2"
            "#]],
        );
    }

    #[test]
    fn keywords_win_over_letters_and_numbers_end_them() {
        check(
            "IF[#1eq2]GOTO10 END1",
            false,
            &expect![[r##"
                If "IF"
                LBracket "["
                Variable "#1"
                Comparison "eq"
                Number "2"
                RBracket "]"
                Goto "GOTO"
                Number "10"
                Whitespace " "
                End "END"
                Number "1"
            "##]],
        );
    }

    #[test]
    fn a_keyword_of_two_words_may_have_a_blank() {
        check(
            "o1 else if end\tsub END 1",
            true,
            &expect![[r#"
                Word "o1"
                Whitespace " "
                ElseIf "else if"
                Whitespace " "
                EndSub "end\tsub"
                Whitespace " "
                End "END"
                Whitespace " "
                Number "1"
            "#]],
        );
    }

    #[test]
    fn comments_end_with_the_line_whatever_is_wrong_with_them() {
        check(
            "(a(b)c)X1\r(open\r\n)(a (b",
            false,
            &expect![[r#"
                Comment(Nested) "(a(b)c)"
                Word "X1"
                Newline "\r"
                Comment(Unclosed) "(open"
                Newline "\r\n"
                RParen ")"
                Comment(Unclosed) "(a (b"
            "#]],
        );
    }

    #[test]
    fn a_semicolon_is_a_comment_or_ends_the_block() {
        check(
            "X1;X2\n",
            true,
            &expect![[r#"
                Word "X1"
                Semicolon(Comment) ";X2"
                Newline "\n"
            "#]],
        );
        check(
            "X1;X2\n",
            false,
            &expect![[r#"
                Word "X1"
                Semicolon(EndOfBlock) ";"
                Word "X2"
                Newline "\n"
            "#]],
        );
    }
}
