//! The grammar: how tokens group into blocks, words, statements and expressions.
//!
//! Knows: forms of text of all controls. Must not know: what is done with them; it drives a [`Sink`], which builds a tree
//! or lowers blocks. Nothing is stored but the tokens of one line.
//!
//! Convention: `foo(p)` always makes a node or reports an error; `opt_foo(p)` may make nothing. The caller looks at the
//! first token.

use std::ops::Range;

use crate::lexer::{CommentEnd, Lexer, LexerMode, SemicolonUse, Token};
use crate::{ForeignForm, SyntaxError, SyntaxErrorKind, SyntaxKind, SyntaxProfile};

/// Nesting of brackets, functions, signs, indirections and `IF … THEN` that a block may have.
///
/// Controls allow five to a dozen; the limit only protects the stack.
pub const MAX_EXPRESSION_DEPTH: u32 = 64;

/// Operators that the expressions of one line may have.
///
/// The tree of `1+1+1` is as deep as it has operators, and trees are walked and freed by recursion. A control reads lines of
/// some hundred characters; the limit only protects the stack.
pub const MAX_OPERATORS: u32 = 1_000;

/// Bytes of a line that are read; what follows is one token.
///
/// The tokens of a line are kept while it is read, and take several times its size. A control reads lines of some hundred
/// characters; the limit only protects memory.
pub const MAX_LINE_BYTES: u32 = 1 << 20;

/// Receives what the grammar recognises, in text order.
pub trait Sink {
    /// A place to which [`Sink::start_node_at`] can come back.
    type Checkpoint: Copy;

    /// A node begins.
    fn start_node(&mut self, kind: SyntaxKind);
    /// The innermost open node ends.
    fn finish_node(&mut self);
    /// The present place.
    fn checkpoint(&self) -> Self::Checkpoint;
    /// A node begins that holds everything since `checkpoint`.
    fn start_node_at(&mut self, checkpoint: Self::Checkpoint, kind: SyntaxKind);
    /// A token; `range` in bytes from the start of the parsed text.
    fn token(&mut self, kind: SyntaxKind, range: Range<u32>);
    /// A mistake.
    fn error(&mut self, error: SyntaxError);

    /// Reads whole lines by itself, from the start of the line at `from` on, and returns where the next line begins that the
    /// grammar is to read. For a sink that reads the plainest lines faster than tokens are made; what it makes of them must be
    /// what it would have made of their tokens.
    fn lines_without_tokens(&mut self, from: u32) -> u32 {
        from
    }
}

/// Parses whole lines into a sink; never fails.
///
/// Emits one `BLOCK` node for each block, without a node around them.
pub fn parse_into<S: Sink>(text: &str, profile: SyntaxProfile, sink: &mut S) {
    let mut lexer = Lexer::new(text, LexerMode { semicolon_comment: profile.semicolon_comment });
    let mut tokens: Vec<Lexeme> = Vec::with_capacity(64);
    let mut start = 0;
    loop {
        let next = sink.lines_without_tokens(start);
        lexer.pass_over(next - start);
        start = next;
        tokens.clear();
        let mut plain = true;
        let most = start.saturating_add(MAX_LINE_BYTES);
        while let Some((token, end)) = lexer.next() {
            tokens.push(Lexeme { token, start, end });
            start = end;
            plain &= token.is_plain();
            if token == Token::Newline {
                break;
            }
            let rest = if end >= most { rest_of_line(text.as_bytes(), end) } else { 0 };
            if rest > 0 {
                lexer.pass_over(rest);
                tokens.push(Lexeme { token: Token::Overlong, start, end: end + rest });
                start += rest;
                plain = false;
            }
        }
        if tokens.is_empty() {
            return;
        }
        // `X 1.` and `X1. 5` need the grammar where blanks may be in numbers, but then a NUMBER or LETTER token is there,
        // and that is not plain.
        if plain {
            sink.start_node(SyntaxKind::BLOCK);
            for lexeme in &tokens {
                sink.token(lexeme.token.kind(), lexeme.start..lexeme.end);
            }
            sink.finish_node();
        } else {
            line(&mut Parser {
                text: text.as_bytes(),
                tokens: &tokens,
                at: 0,
                depth: 0,
                operators: 0,
                tail: None,
                too_deep: false,
                profile,
                sink,
            });
        }
    }
}

/// Bytes from there to the end of the line.
fn rest_of_line(text: &[u8], from: u32) -> u32 {
    let rest = text.get(from as usize..).unwrap_or_default();
    memchr::memchr2(b'\r', b'\n', rest).unwrap_or(rest.len()) as u32
}

#[derive(Debug, Clone, Copy)]
struct Lexeme {
    token: Token,
    start: u32,
    end: u32,
}

struct Parser<'p, S: Sink> {
    text: &'p [u8],
    /// Tokens of one line, its end included; never empty.
    tokens: &'p [Lexeme],
    at: usize,
    depth: u32,
    /// Operators of the line so far.
    operators: u32,
    /// What the end of the line is made of, once a semicolon asked.
    tail: Option<Tail>,
    /// The depth limit was reported for this line; what follows from it is not.
    too_deep: bool,
    profile: SyntaxProfile,
    sink: &'p mut S,
}

impl<S: Sink> Parser<'_, S> {
    fn current(&self) -> Option<Token> {
        self.tokens.get(self.at).map(|l| l.token)
    }

    /// The token that follows `skip` tokens further on, blanks and comments not counted.
    fn peek_past_blanks(&self, skip: usize) -> Option<Token> {
        let rest = self.tokens.get(self.at + skip..)?;
        rest.iter().map(|l| l.token).find(|t| !matches!(t, Token::Whitespace))
    }

    /// Start of the current token, or the end of the line.
    fn offset(&self) -> u32 {
        self.tokens.get(self.at).map_or_else(|| self.tokens.last().map_or(0, |l| l.end), |l| l.start)
    }

    fn end_of_previous(&self) -> u32 {
        self.at.checked_sub(1).and_then(|at| self.tokens.get(at)).map_or_else(|| self.offset(), |l| l.end)
    }

    fn bump(&mut self) {
        if let Some(lexeme) = self.tokens.get(self.at) {
            self.sink.token(lexeme.token.kind(), lexeme.start..lexeme.end);
            self.at += 1;
        }
    }

    /// Blanks inside a statement or expression.
    fn skip_blanks(&mut self) {
        while self.current() == Some(Token::Whitespace) {
            self.bump();
        }
    }

    /// The text of the current token.
    fn current_text(&self) -> &[u8] {
        let range = self.tokens.get(self.at).map(|l| l.start as usize..l.end as usize);
        range.and_then(|r| self.text.get(r)).unwrap_or_default()
    }

    /// Where the token is that follows `skip` tokens further on, blanks not counted.
    fn index_past_blanks(&self, skip: usize) -> usize {
        let rest = self.tokens.get(self.at + skip..).unwrap_or_default();
        let blanks = rest.iter().take_while(|l| l.token == Token::Whitespace).count();
        self.at + skip + blanks
    }

    /// A decimal point that touches no digit.
    fn is_point(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(|l| {
            l.token == Token::Unknown && self.text.get(l.start as usize..l.end as usize) == Some(b".")
        })
    }

    fn is_number(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(|l| l.token == Token::Number)
    }

    /// Does the number whose first piece is `skip - 1` tokens ahead go on after blanks: `1 0`, `1 . 5`?
    fn number_goes_on(&self, skip: usize) -> bool {
        if !self.profile.blanks_in_numbers || !self.has_blank_or_point(self.at + skip) {
            return false;
        }
        let next = self.index_past_blanks(skip);
        self.is_number(next) || self.is_point(next)
    }

    fn has_blank_or_point(&self, at: usize) -> bool {
        self.tokens.get(at).is_some_and(|l| matches!(l.token, Token::Whitespace | Token::Unknown))
    }

    /// `. 5`: a number that begins with a point, a blank after it.
    fn starts_with_point(&self, at: usize) -> bool {
        self.profile.blanks_in_numbers
            && self.is_point(at)
            && self.tokens.get(at + 1).is_some_and(|l| l.token == Token::Whitespace)
            && self.is_number(at + 2)
    }

    /// Does the current token start a value?
    fn at_operand(&self) -> bool {
        self.current().is_some_and(starts_operand) || self.starts_with_point(self.at)
    }

    fn is_address_o(&self) -> bool {
        matches!(self.current_text(), [b'O' | b'o', ..])
    }

    fn at_end(&self) -> bool {
        matches!(
            self.current(),
            None | Some(Token::Newline | Token::Overlong | Token::Semicolon(SemicolonUse::EndOfBlock))
        )
    }

    /// Is the previous token directly in front, without a blank?
    fn touches_previous(&self) -> bool {
        let previous = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        previous.is_some_and(|l| l.token != Token::Whitespace)
    }

    fn error(&mut self, kind: SyntaxErrorKind, range: Range<u32>) {
        if self.too_deep {
            return;
        }
        self.sink.error(SyntaxError { kind, range });
    }

    fn error_here(&mut self, kind: SyntaxErrorKind) {
        let range = self.tokens.get(self.at).map_or_else(|| self.offset()..self.offset(), |l| l.start..l.end);
        self.error(kind, range);
    }

    /// The current token in an ERROR node.
    fn bump_as_error(&mut self, kind: SyntaxErrorKind) {
        self.error_here(kind);
        self.sink.start_node(SyntaxKind::ERROR);
        self.bump();
        self.sink.finish_node();
    }

    /// Everything to the end of the block in an ERROR node.
    fn rest_as_error(&mut self) {
        if self.at_end() {
            return;
        }
        self.sink.start_node(SyntaxKind::ERROR);
        while !self.at_end() {
            self.bump();
        }
        self.sink.finish_node();
    }

    fn foreign(&mut self, form: ForeignForm, range: Range<u32>) {
        self.error(SyntaxErrorKind::Foreign(form), range);
    }
}

/// A line: one block, or several where `;` ends a block.
fn line<S: Sink>(p: &mut Parser<'_, S>) {
    loop {
        p.sink.start_node(SyntaxKind::BLOCK);
        block(p);
        match p.current() {
            Some(Token::Semicolon(SemicolonUse::EndOfBlock)) => {
                p.bump();
                if rest_is_not_a_block(p) {
                    // `; end` or `G0 X1. ; move`: the line end closes this block, so that no empty block follows.
                    finish_line(p);
                    return;
                }
                p.sink.finish_node();
            }
            _ => {
                overlong(p);
                p.bump();
                p.sink.finish_node();
                return;
            }
        }
        if p.at >= p.tokens.len() {
            return;
        }
    }
}

/// What follows the part of a line that is read.
fn overlong<S: Sink>(p: &mut Parser<'_, S>) {
    if p.current() == Some(Token::Overlong) {
        // Whatever else is wrong with the line, this is why the rest of it is not read.
        p.too_deep = false;
        p.bump_as_error(SyntaxErrorKind::LineTooLong);
    }
}

/// After an end-of-block character: nothing more, only comments, or text that cannot be read as words.
///
/// The line is looked through once, whatever number of blocks it has.
fn rest_is_not_a_block<S: Sink>(p: &mut Parser<'_, S>) -> bool {
    let Parser { at, tokens, .. } = *p;
    let tail = p.tail.get_or_insert_with(|| Tail::of(tokens));
    tail.word.is_none_or(|word| word < at) || tail.prose.is_some_and(|prose| prose >= at)
}

/// What the end of a line is made of, as indexes of tokens.
#[derive(Debug, Clone, Copy, Default)]
struct Tail {
    /// The last token that can be part of a block.
    word: Option<usize>,
    /// The last token that shows that the text is prose.
    prose: Option<usize>,
}

impl Tail {
    fn of(tokens: &[Lexeme]) -> Self {
        let mut tail = Self::default();
        let mut previous: Option<(usize, Token)> = None;
        for (at, Lexeme { token, .. }) in tokens.iter().enumerate() {
            match (token, previous) {
                (Token::Whitespace | Token::Overlong, _) => continue,
                (Token::Unknown, _) => tail.prose = Some(at),
                // `T` `O` `O` `L`: two letters in a row are prose.
                (Token::Letter, Some((first, Token::Letter))) => tail.prose = Some(first),
                _ => {}
            }
            if !matches!(token, Token::Comment(_) | Token::Newline | Token::Semicolon(_)) {
                tail.word = Some(at);
            }
            previous = Some((at, *token));
        }
        if let Some((last, Token::Letter)) = previous {
            tail.prose = Some(last);
        }
        tail
    }
}

/// The rest of a line after its last end-of-block character.
fn finish_line<S: Sink>(p: &mut Parser<'_, S>) {
    while matches!(p.current(), Some(Token::Whitespace | Token::Comment(_) | Token::Semicolon(_))) {
        comment_or_blank(p);
    }
    let is_over = |token: Option<Token>| matches!(token, None | Some(Token::Newline | Token::Overlong));
    if !is_over(p.current()) {
        let end = p.tokens.iter().rev().find(|l| !is_over(Some(l.token))).map_or(0, |l| l.end);
        p.error(SyntaxErrorKind::TextAfterEndOfBlock, p.offset()..end);
        p.sink.start_node(SyntaxKind::ERROR);
        while !is_over(p.current()) {
            p.bump();
        }
        p.sink.finish_node();
    }
    overlong(p);
    p.bump();
    p.sink.finish_node();
}

fn comment_or_blank<S: Sink>(p: &mut Parser<'_, S>) {
    match p.current() {
        Some(Token::Comment(CommentEnd::Nested)) => p.bump_as_error(SyntaxErrorKind::NestedComment),
        Some(Token::Comment(CommentEnd::Unclosed)) => p.bump_as_error(SyntaxErrorKind::UnclosedComment),
        _ => p.bump(),
    }
}

/// Everything of a block but its end.
fn block<S: Sink>(p: &mut Parser<'_, S>) {
    while !p.at_end() {
        item(p);
    }
}

/// One part of a block: blank, comment, word, assignment or statement.
fn item<S: Sink>(p: &mut Parser<'_, S>) {
    let Some(token) = p.current() else { return };
    match token {
        Token::Percent if !is_tape_mark(p) => p.bump_as_error(SyntaxErrorKind::Unexpected),
        // A control whose `O` opens programs alone takes it for one, or says nothing of it.
        Token::ColonNumber if p.profile.o_words && !p.profile.colon_program => {
            p.bump_as_error(SyntaxErrorKind::Unexpected);
        }
        Token::Whitespace | Token::Bom | Token::Percent | Token::ColonNumber | Token::Semicolon(_) => {
            p.bump();
        }
        Token::Comment(_) => comment_or_blank(p),
        Token::Word => word(p),
        Token::Letter if starts_prose(p, p.at) => prose(p),
        Token::Letter => address(p),
        Token::Comma if starts_parted_corner_word(p) => parted_corner_word(p),
        Token::OName => o_statement(p),
        Token::Variable | Token::NamedVariable | Token::Hash => assignment(p),
        Token::LBracket if !p.profile.o_words && (opens_block(p) || !p.touches_previous()) => condition(p),
        Token::LBracket => stray_group(p),
        Token::Slash => block_delete(p),
        Token::Number => p.bump_as_error(if p.touches_previous() && p.at > 0 {
            SyntaxErrorKind::MalformedNumber
        } else {
            SyntaxErrorKind::ValueWithoutAddress
        }),
        Token::RParen => p.bump_as_error(SyntaxErrorKind::StrayParenthesis),
        Token::RBracket => p.bump_as_error(SyntaxErrorKind::StrayBracket),
        Token::If => if_statement(p),
        Token::While | Token::Do => while_statement(p),
        Token::End => end_statement(p),
        Token::Goto => goto_statement(p),
        Token::Print => print_statement(p),
        Token::Port => port_statement(p),
        Token::Command => command_statement(p),
        Token::Then
        | Token::Else
        | Token::ElseIf
        | Token::EndIf
        | Token::EndWhile
        | Token::Sub
        | Token::EndSub
        | Token::Call
        | Token::Return
        | Token::Repeat
        | Token::EndRepeat
        | Token::Break
        | Token::Continue
        | Token::Comparison
        | Token::And
        | Token::Or
        | Token::Mod
        | Token::Function => p.bump_as_error(SyntaxErrorKind::StrayKeyword),
        Token::Newline
        | Token::Plus
        | Token::Minus
        | Token::Star
        | Token::Power
        | Token::Equals
        | Token::Comma
        | Token::Overlong
        | Token::Unknown => unexpected(p),
    }
}

/// A run of characters that make no sense here is one mistake.
fn unexpected<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    p.sink.start_node(SyntaxKind::ERROR);
    p.bump();
    while matches!(
        p.current(),
        Some(Token::Unknown | Token::Plus | Token::Minus | Token::Star | Token::Equals | Token::Comma)
    ) {
        p.bump();
    }
    p.sink.finish_node();
    let end = p.end_of_previous();
    p.error(SyntaxErrorKind::Unexpected, start..end);
}

/// Do the tokens at `at` begin a word of prose? `X`, `Y`, `Z` in a row, or a letter with a keyword after it.
fn starts_prose<S: Sink>(p: &Parser<'_, S>, at: usize) -> bool {
    let token = |at: usize| p.tokens.get(at).map(|l| l.token);
    match (token(at), token(at + 1)) {
        (Some(Token::Letter), Some(Token::Letter)) => token(at + 2)
            .is_some_and(|t| matches!(t, Token::Letter | Token::Function | Token::Unknown) || is_keyword(t)),
        (Some(Token::Letter), Some(next)) => is_keyword(next),
        _ => false,
    }
}

/// A keyword that cannot begin a value.
fn is_keyword(token: Token) -> bool {
    is_o_keyword(token)
        || matches!(
            token,
            Token::Comparison
                | Token::And
                | Token::Or
                | Token::Mod
                | Token::Then
                | Token::End
                | Token::Goto
                | Token::Print
                | Token::Port
        )
}

/// Text that is not a code, as far as it goes, is one mistake: `OFFSET`, `move to start`.
fn prose<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    p.sink.start_node(SyntaxKind::ERROR);
    loop {
        // A word goes to its next blank, whatever it is made of.
        while !p.at_end()
            && !matches!(
                p.current(),
                Some(Token::Whitespace | Token::Comment(_) | Token::Semicolon(_) | Token::RParen)
            )
        {
            p.bump();
        }
        let next = if p.current() == Some(Token::Whitespace) { p.at + 1 } else { p.at };
        let Some(token) = p.tokens.get(next).map(|l| l.token) else { break };
        let behind = p.tokens.get(next + 1).map(|l| l.token);
        let goes_on = match token {
            Token::Letter => {
                starts_prose(p, next)
                    || matches!(behind, None | Some(Token::Whitespace | Token::Newline | Token::Letter))
            }
            Token::Unknown
            | Token::Number
            | Token::Comma
            | Token::Equals
            | Token::Plus
            | Token::Minus
            | Token::Star => true,
            _ => false,
        };
        if !goes_on {
            break;
        }
        p.skip_blanks();
    }
    p.sink.finish_node();
    let end = p.end_of_previous();
    p.error(SyntaxErrorKind::Unexpected, start..end);
}

/// `/`, `/3`. At the head of a block or, on some controls, further in.
fn block_delete<S: Sink>(p: &mut Parser<'_, S>) {
    p.sink.start_node(SyntaxKind::BLOCK_DELETE);
    p.bump();
    // `/1` is a level, `/ 1` and `/12` are not.
    if let Some(level) = p.tokens.get(p.at)
        && level.token == Token::Number
        && level.end - level.start == 1
    {
        p.bump();
    }
    p.sink.finish_node();
}

/// A fused word, or `O100` in front of a keyword.
fn word<S: Sink>(p: &mut Parser<'_, S>) {
    // Between `O100` and its keyword are blanks at most; `N10 IF` is a label and a statement.
    if p.peek_past_blanks(1).is_some_and(is_o_keyword) && p.is_address_o() {
        o_statement(p);
        return;
    }
    // `X1. 5` is one number where blanks are allowed in numbers; `X1.2.3` is none anywhere.
    let next_is_number = p.tokens.get(p.at + 1).is_some_and(|l| l.token == Token::Number);
    if !next_is_number && p.number_goes_on(1) {
        p.sink.start_node(SyntaxKind::ADDRESS);
        number_with_blanks(p);
        p.sink.finish_node();
        return;
    }
    p.bump();
    needs_brackets(p);
}

/// The pieces of a number that blanks divide, the first of which may be a fused word.
fn number_with_blanks<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    p.bump();
    loop {
        let next = p.index_past_blanks(0);
        if !p.is_number(next) && !p.is_point(next) {
            break;
        }
        p.skip_blanks();
        p.bump();
    }
    let range = start..p.end_of_previous();
    let text = p.text.get(range.start as usize..range.end as usize).unwrap_or_default();
    if memchr::memchr_iter(b'.', text).count() > 1 {
        p.error(SyntaxErrorKind::MalformedNumber, range);
    }
}

fn is_o_keyword(token: Token) -> bool {
    matches!(
        token,
        Token::Sub
            | Token::EndSub
            | Token::Call
            | Token::Return
            | Token::If
            | Token::ElseIf
            | Token::Else
            | Token::EndIf
            | Token::While
            | Token::EndWhile
            | Token::Do
            | Token::Repeat
            | Token::EndRepeat
            | Token::Break
            | Token::Continue
    )
}

/// An address whose number is not fused to it: `X#1`, `X[#1+2.]`, `X - .5`, `X 1.`; or nothing at all.
fn address<S: Sink>(p: &mut Parser<'_, S>) {
    let is_o = p.is_address_o();
    let statement = p.sink.checkpoint();
    let start = p.offset();
    p.sink.start_node(SyntaxKind::ADDRESS);
    p.bump();
    let letter = start..p.end_of_previous();
    let has_value = value_of_address(p);
    p.sink.finish_node();
    if !has_value {
        p.error(SyntaxErrorKind::AddressWithoutValue, letter);
        return;
    }
    if is_o && p.peek_past_blanks(0).is_some_and(is_o_keyword) {
        let label = start..p.end_of_previous();
        if !is_whole_label(p.text.get(label.start as usize..label.end as usize).unwrap_or_default()) {
            p.error(SyntaxErrorKind::MalformedNumber, label);
        }
        p.sink.start_node_at(statement, SyntaxKind::O_STATEMENT);
        o_tail(p, start);
        p.sink.finish_node();
        return;
    }
    needs_brackets(p);
}

/// What comes after the letter of an address, if it is a value.
fn value_of_address<S: Sink>(p: &mut Parser<'_, S>) -> bool {
    match p.peek_past_blanks(0) {
        Some(Token::Number) => {
            p.skip_blanks();
            if p.profile.blanks_in_numbers {
                number_with_blanks(p);
            } else {
                p.bump();
            }
            true
        }
        Some(token) if starts_operand(token) => {
            p.skip_blanks();
            unary(p);
            true
        }
        Some(Token::Unknown) if p.starts_with_point(p.index_past_blanks(0)) => {
            p.skip_blanks();
            number_with_blanks(p);
            true
        }
        _ => false,
    }
}

/// Do blanks and the address of a corner word, `R` or `C`, come after the comma here?
fn starts_parted_corner_word<S: Sink>(p: &Parser<'_, S>) -> bool {
    let at = p.index_past_blanks(1);
    let Some(next) = p.tokens.get(at) else { return false };
    matches!(p.text.get(next.start as usize), Some(b'R' | b'C' | b'r' | b'c'))
        && (next.token == Token::Word || next.token == Token::Letter && !starts_prose(p, at))
}

/// `, R 5.`: a corner word, with blanks after its comma.
fn parted_corner_word<S: Sink>(p: &mut Parser<'_, S>) {
    p.sink.start_node(SyntaxKind::ADDRESS);
    p.bump();
    p.skip_blanks();
    let letter = p.offset();
    let is_word = p.current() == Some(Token::Word);
    let goes_on = p.number_goes_on(1);
    if is_word && goes_on {
        number_with_blanks(p);
    } else {
        p.bump();
    }
    let has_value = is_word || value_of_address(p);
    let letter = letter..letter + 1;
    p.sink.finish_node();
    if has_value {
        needs_brackets(p);
    } else {
        p.error(SyntaxErrorKind::AddressWithoutValue, letter);
    }
}

fn starts_operand(token: Token) -> bool {
    matches!(
        token,
        Token::Number
            | Token::Variable
            | Token::NamedVariable
            | Token::Hash
            | Token::LBracket
            | Token::Plus
            | Token::Minus
            | Token::Function
    )
}

/// `X#1+2`, `X1.-2`: arithmetic after a value that is not in brackets.
fn needs_brackets<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    let mut any = false;
    // `X#1 /G0` is a block delete, `X#1/2` a division.
    while let Some(token) = p.current()
        && binding_power(token, p.profile).is_some()
        && p.tokens
            .get(p.at + 1)
            .is_some_and(|next| starts_operand(next.token) || next.token == Token::Whitespace)
        && (token != Token::Slash
            || p.tokens.get(p.at + 1).is_some_and(|next| next.token != Token::Whitespace))
    {
        if !any {
            p.sink.start_node(SyntaxKind::ERROR);
            any = true;
        }
        p.bump();
        p.skip_blanks();
        unary(p);
    }
    if any {
        p.sink.finish_node();
        let end = p.end_of_previous();
        p.error(SyntaxErrorKind::NeedsBrackets, start..end);
    }
}

/// `#100 = …`.
fn assignment<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    p.sink.start_node(SyntaxKind::ASSIGNMENT);
    variable(p);
    let target = start..p.end_of_previous();
    if p.peek_past_blanks(0) == Some(Token::Equals) {
        p.skip_blanks();
        p.bump();
        p.skip_blanks();
        if p.at_operand() {
            let value = p.offset();
            let is_bare = expression(p);
            if is_bare && !p.profile.bare_expressions {
                let end = p.end_of_previous();
                p.error(SyntaxErrorKind::NeedsBrackets, value..end);
            }
        } else {
            let end = p.end_of_previous();
            p.error(SyntaxErrorKind::MissingOperand, start..end);
        }
    } else {
        p.error(SyntaxErrorKind::MissingEquals, target);
    }
    p.sink.finish_node();
}

/// Is the `%` here a mark of the tape? Where O-words are read, the mark has its line to itself, and is a stray character
/// elsewhere; other controls end the tape wherever they find it.
fn is_tape_mark<S: Sink>(p: &Parser<'_, S>) -> bool {
    let is_blank = |l: &Lexeme| matches!(l.token, Token::Whitespace | Token::Bom);
    let is_idle = |l: &Lexeme| {
        is_blank(l) || matches!(l.token, Token::Comment(_) | Token::Semicolon(_) | Token::Newline)
    };
    let (before, behind) = (p.tokens.get(..p.at), p.tokens.get(p.at + 1..));
    !p.profile.o_words
        || before.unwrap_or_default().iter().all(is_blank) && behind.unwrap_or_default().iter().all(is_idle)
}

/// Is there nothing in front of the current token in its block but its number and its `/`?
fn opens_block<S: Sink>(p: &Parser<'_, S>) -> bool {
    let before = p.tokens.get(..p.at).unwrap_or_default();
    let is_number = |l: &Lexeme| matches!(p.text.get(l.start as usize), Some(b'N' | b'n'));
    let mut before =
        before.iter().rev().skip_while(|l| matches!(l.token, Token::Whitespace | Token::Comment(_)));
    match before.next() {
        None => true,
        Some(l) => match l.token {
            Token::Semicolon(_) | Token::Bom | Token::Slash => true,
            Token::Word => is_number(l),
            // `/3`, `N 10`
            Token::Number => before
                .find(|l| l.token != Token::Whitespace)
                .is_some_and(|l| l.token == Token::Slash || l.token == Token::Letter && is_number(l)),
            _ => false,
        },
    }
}

/// `X5[2]`: a bracket after a complete word or value. No control reads it.
fn stray_group<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    p.sink.start_node(SyntaxKind::ERROR);
    group(p);
    p.sink.finish_node();
    // A control without expressions has been told of the bracket, and so has one that misses its end.
    let is_closed =
        p.at.checked_sub(1).and_then(|at| p.tokens.get(at)).is_some_and(|l| l.token == Token::RBracket);
    if p.profile.variables && is_closed {
        let end = p.end_of_previous();
        p.error(SyntaxErrorKind::Unexpected, start..end);
    }
}

/// `[#1 LT 10]` in front of words.
fn condition<S: Sink>(p: &mut Parser<'_, S>) {
    p.sink.start_node(SyntaxKind::CONDITION);
    group(p);
    p.sink.finish_node();
}

/// A statement of macro-B controls, reported where the control has none.
fn macro_statement<S: Sink>(p: &mut Parser<'_, S>, kind: SyntaxKind, body: impl FnOnce(&mut Parser<'_, S>)) {
    if !p.profile.macro_statements {
        let range = p.offset()..p.tokens.get(p.at).map_or(0, |l| l.end);
        p.foreign(ForeignForm::MacroStatement, range);
    }
    p.sink.start_node(kind);
    body(p);
    p.sink.finish_node();
}

/// `[…]`, or several joined by `AND` and `OR`.
fn required_condition<S: Sink>(p: &mut Parser<'_, S>) {
    let keyword = p.at.checked_sub(1).and_then(|at| p.tokens.get(at)).map_or(0..0, |l| l.start..l.end);
    if p.peek_past_blanks(0) == Some(Token::LBracket) {
        p.skip_blanks();
        expression(p);
    } else {
        p.error(SyntaxErrorKind::MissingCondition, keyword);
    }
}

/// The number after `GOTO`, `DO`, `END`.
fn required_number<S: Sink>(p: &mut Parser<'_, S>) {
    let keyword = p.at.checked_sub(1).and_then(|at| p.tokens.get(at)).map_or(0..0, |l| l.start..l.end);
    if p.peek_past_blanks(0).is_some_and(starts_operand) {
        p.skip_blanks();
        unary(p);
    } else {
        p.error(SyntaxErrorKind::MissingNumber, keyword);
        if p.peek_past_blanks(0) == Some(Token::Word) {
            // `GOTO N10`: the label word is not a word of this block.
            p.skip_blanks();
            p.sink.start_node(SyntaxKind::ERROR);
            p.bump();
            p.sink.finish_node();
        }
    }
}

fn if_statement<S: Sink>(p: &mut Parser<'_, S>) {
    macro_statement(p, SyntaxKind::IF_STATEMENT, |p| {
        let start = p.offset();
        p.bump();
        required_condition(p);
        match p.peek_past_blanks(0) {
            Some(Token::Goto) => {
                p.skip_blanks();
                goto_tail(p);
            }
            Some(Token::Then) => {
                p.skip_blanks();
                p.bump();
                deeper(p, block);
            }
            // `IF [#9 EQ #0] #9=#4109`: some controls let THEN be left out in front of an assignment.
            Some(Token::Variable | Token::NamedVariable | Token::Hash) => deeper(p, block),
            Some(Token::Word) if p.profile.words_after_if => deeper(p, block),
            _ => {
                let end = p.end_of_previous();
                p.error(SyntaxErrorKind::IfWithoutConsequence, start..end);
            }
        }
    });
}

fn goto_tail<S: Sink>(p: &mut Parser<'_, S>) {
    p.sink.start_node(SyntaxKind::GOTO_STATEMENT);
    p.bump();
    required_number(p);
    p.sink.finish_node();
}

fn goto_statement<S: Sink>(p: &mut Parser<'_, S>) {
    macro_statement(p, SyntaxKind::GOTO_STATEMENT, |p| {
        p.bump();
        required_number(p);
    });
}

/// `WHILE […] DO1` or `DO1`.
fn while_statement<S: Sink>(p: &mut Parser<'_, S>) {
    macro_statement(p, SyntaxKind::WHILE_STATEMENT, |p| {
        let start = p.offset();
        if p.current() == Some(Token::While) {
            p.bump();
            required_condition(p);
        }
        if p.peek_past_blanks(0) == Some(Token::Do) {
            p.skip_blanks();
            p.bump();
            required_number(p);
        } else {
            let end = p.end_of_previous();
            p.error(SyntaxErrorKind::WhileWithoutDo, start..end);
        }
    });
}

fn end_statement<S: Sink>(p: &mut Parser<'_, S>) {
    macro_statement(p, SyntaxKind::END_STATEMENT, |p| {
        p.bump();
        required_number(p);
    });
}

/// `DPRNT[TEXT#100[53]]`: the text runs to the matching bracket and is not read as words.
fn print_statement<S: Sink>(p: &mut Parser<'_, S>) {
    macro_statement(p, SyntaxKind::PRINT_STATEMENT, |p| {
        let start = p.offset();
        p.bump();
        p.skip_blanks();
        if p.current() != Some(Token::LBracket) {
            let end = p.end_of_previous();
            p.error(SyntaxErrorKind::MissingOperand, start..end);
            return;
        }
        let open = p.offset();
        let mut depth = 0_usize;
        while !matches!(p.current(), None | Some(Token::Newline)) {
            match p.current() {
                Some(Token::LBracket) => depth += 1,
                Some(Token::RBracket) => depth -= 1,
                _ => {}
            }
            p.bump();
            if depth == 0 {
                return;
            }
        }
        p.error(SyntaxErrorKind::UnclosedBracket, open..open + 1);
    });
}

fn port_statement<S: Sink>(p: &mut Parser<'_, S>) {
    macro_statement(p, SyntaxKind::PORT_STATEMENT, |p| {
        p.bump();
    });
}

/// `$H`: a line of its own.
fn command_statement<S: Sink>(p: &mut Parser<'_, S>) {
    let before = p.tokens.get(..p.at).unwrap_or_default();
    let opens = before.iter().all(|lexeme| {
        matches!(lexeme.token, Token::Whitespace | Token::Bom | Token::Comment(CommentEnd::Closed))
    });
    if !opens {
        p.bump_as_error(SyntaxErrorKind::Unexpected);
        return;
    }
    if !p.profile.system_commands {
        let range = p.offset()..p.tokens.get(p.at).map_or(0, |lexeme| lexeme.end);
        p.foreign(ForeignForm::SystemCommand, range);
    }
    p.sink.start_node(SyntaxKind::COMMAND_STATEMENT);
    p.bump();
    p.sink.finish_node();
}

/// `O100 SUB`, `O<name> CALL [1] [2]` with a fused label.
fn o_statement<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    let is_whole = p.current() != Some(Token::Word) || is_whole_label(p.current_text());
    p.sink.start_node(SyntaxKind::O_STATEMENT);
    p.bump();
    if !is_whole {
        // `O1.5 IF`
        let end = p.end_of_previous();
        p.error(SyntaxErrorKind::MalformedNumber, start..end);
    }
    if p.peek_past_blanks(0).is_some_and(is_o_keyword) {
        o_tail(p, start);
    } else {
        let end = p.end_of_previous();
        p.error(SyntaxErrorKind::OWordWithoutKeyword, start..end);
    }
    p.sink.finish_node();
}

/// Is a label that is written as one number (`O1.0`, `O[2]`) a whole number? True for labels of other forms.
fn is_whole_label(label: &[u8]) -> bool {
    let is_of_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'[' | b']' | b' ' | b'\t');
    let mut rest = label.iter().skip(1);
    if !rest.clone().all(is_of_number) {
        return true;
    }
    rest.find(|byte| **byte == b'.');
    rest.all(|byte| !matches!(byte, b'1'..=b'9'))
}

/// The keyword of an O-word statement and what follows it.
fn o_tail<S: Sink>(p: &mut Parser<'_, S>, start: u32) {
    p.skip_blanks();
    let keyword = p.current();
    p.bump();
    if !p.profile.o_words {
        let end = p.end_of_previous();
        p.foreign(ForeignForm::OWord, start..end);
    }
    match keyword {
        Some(Token::If | Token::ElseIf | Token::While | Token::Repeat) => required_condition(p),
        Some(Token::Call) => {
            // There may be a comment between two arguments.
            while let Some(blanks) = blanks_before_argument(p) {
                for _ in 0..blanks {
                    comment_or_blank(p);
                }
                group(p);
            }
        }
        Some(Token::Return | Token::EndSub) if p.peek_past_blanks(0) == Some(Token::LBracket) => {
            p.skip_blanks();
            group(p);
        }
        _ => {}
    }
}

/// How many blanks and comments are in front of the next argument of a call, if there is one.
fn blanks_before_argument<S: Sink>(p: &Parser<'_, S>) -> Option<usize> {
    let rest = p.tokens.get(p.at..)?;
    let is_blank = |token: Token| matches!(token, Token::Whitespace | Token::Comment(CommentEnd::Closed));
    let blanks = rest.iter().take_while(|l| is_blank(l.token)).count();
    rest.get(blanks).filter(|l| l.token == Token::LBracket).map(|_| blanks)
}

/// How tightly an operator binds, or `None` for other tokens.
fn binding_power(token: Token, profile: SyntaxProfile) -> Option<u8> {
    let logic = profile.logic_binds_last;
    Some(match token {
        Token::Power => 6,
        Token::And if !logic => 5,
        Token::Star | Token::Slash | Token::Mod => 5,
        Token::Or if !logic => 4,
        Token::Plus | Token::Minus => 4,
        Token::Comparison => 3,
        Token::And | Token::Or => 2,
        _ => return None,
    })
}

/// An expression; true if it has an operator that is in no bracket.
fn expression<S: Sink>(p: &mut Parser<'_, S>) -> bool {
    binary(p, 0)
}

fn binary<S: Sink>(p: &mut Parser<'_, S>, weakest: u8) -> bool {
    let left = p.sink.checkpoint();
    unary(p);
    let mut any = false;
    while let Some(power) = operator_ahead(p).filter(|power| *power >= weakest) {
        any = true;
        p.operators += 1;
        if p.operators > MAX_OPERATORS {
            too_deep(p);
            break;
        }
        p.sink.start_node_at(left, SyntaxKind::BINARY);
        p.skip_blanks();
        if p.current() == Some(Token::Power) && !p.profile.power_operator {
            let range = p.offset()..p.offset() + 2;
            p.foreign(ForeignForm::PowerOperator, range);
        }
        let operator = p.offset();
        if is_divided_power(p, p.at) {
            p.bump();
            p.skip_blanks();
        }
        p.bump();
        let operator = operator..p.end_of_previous();
        p.skip_blanks();
        if p.at_operand() {
            binary(p, power + 1);
        } else {
            p.error(SyntaxErrorKind::MissingOperand, operator);
        }
        p.sink.finish_node();
    }
    any
}

/// How tightly the operator binds that comes next, blanks not counted.
fn operator_ahead<S: Sink>(p: &Parser<'_, S>) -> Option<u8> {
    let at = p.index_past_blanks(0);
    let token = p.tokens.get(at)?.token;
    binding_power(if is_divided_power(p, at) { Token::Power } else { token }, p.profile)
}

/// `* *`, which is `**` where blanks do not count.
fn is_divided_power<S: Sink>(p: &Parser<'_, S>, at: usize) -> bool {
    let token = |at: usize| p.tokens.get(at).map(|l| l.token);
    token(at) == Some(Token::Star)
        && p.profile.blanks_in_numbers
        && p.profile.power_operator
        && token(at + 1) == Some(Token::Whitespace)
        && token(at + 2) == Some(Token::Star)
}

/// Runs `body` one level deeper, or reports the limit and gives up on the block.
fn deeper<S: Sink>(p: &mut Parser<'_, S>, body: impl FnOnce(&mut Parser<'_, S>)) {
    if p.depth >= MAX_EXPRESSION_DEPTH {
        too_deep(p);
        return;
    }
    p.depth += 1;
    body(p);
    p.depth -= 1;
}

/// Reports that the block goes too deep, and keeps the rest of it as text.
fn too_deep<S: Sink>(p: &mut Parser<'_, S>) {
    p.error_here(SyntaxErrorKind::TooDeep);
    p.too_deep = true;
    p.rest_as_error();
}

/// A value with its signs.
fn unary<S: Sink>(p: &mut Parser<'_, S>) {
    if matches!(p.current(), Some(Token::Plus | Token::Minus)) {
        deeper(p, |p| {
            let sign = p.offset();
            p.sink.start_node(SyntaxKind::UNARY);
            p.bump();
            p.skip_blanks();
            if p.at_operand() {
                unary(p);
            } else {
                p.error(SyntaxErrorKind::MissingOperand, sign..sign + 1);
            }
            p.sink.finish_node();
        });
    } else {
        primary(p);
    }
}

fn primary<S: Sink>(p: &mut Parser<'_, S>) {
    match p.current() {
        Some(Token::Number) if !p.number_goes_on(1) => p.bump(),
        Some(Token::Variable | Token::NamedVariable | Token::Hash) => variable(p),
        Some(Token::LBracket) => group(p),
        Some(Token::Function) => function_call(p),
        _ if p.at_operand() => {
            p.sink.start_node(SyntaxKind::DIVIDED_NUMBER);
            number_with_blanks(p);
            p.sink.finish_node();
        }
        _ => p.error_here(SyntaxErrorKind::MissingOperand),
    }
}

/// `#1`, `#<name>`, `##1`, `#[#1+2]`, and on RS274/NGC controls `#FIX[#1]`.
fn variable<S: Sink>(p: &mut Parser<'_, S>) {
    match p.current() {
        Some(Token::Variable) => {
            if !p.profile.variables {
                let range = p.offset()..p.tokens.get(p.at).map_or(0, |l| l.end);
                p.foreign(ForeignForm::Variable, range);
            }
            p.bump();
        }
        Some(Token::NamedVariable) => {
            if !p.profile.named_parameters {
                let range = p.offset()..p.tokens.get(p.at).map_or(0, |l| l.end);
                p.foreign(ForeignForm::NamedParameter, range);
            }
            p.bump();
        }
        _ => deeper(p, |p| {
            let hash = p.offset();
            p.sink.start_node(SyntaxKind::INDIRECT);
            p.bump();
            p.skip_blanks();
            match p.current() {
                Some(Token::Variable | Token::NamedVariable | Token::Hash) => variable(p),
                Some(Token::LBracket) => group(p),
                Some(Token::Number) => p.bump(),
                // Whoever has O-words takes any value as the number of a parameter.
                Some(Token::Function) if p.profile.o_words => function_call(p),
                _ => p.error(SyntaxErrorKind::MissingOperand, hash..hash + 1),
            }
            p.sink.finish_node();
        }),
    }
}

/// `[…]`.
fn group<S: Sink>(p: &mut Parser<'_, S>) {
    deeper(p, |p| {
        let open = p.offset();
        if !p.profile.variables {
            p.foreign(ForeignForm::Expression, open..open + 1);
        }
        p.sink.start_node(SyntaxKind::GROUP);
        p.bump();
        p.skip_blanks();
        if p.at_operand() {
            expression(p);
            p.skip_blanks();
            // `ATAN[a,b]`, `POW[a,b]`.
            while p.current() == Some(Token::Comma) {
                p.bump();
                p.skip_blanks();
                expression(p);
                p.skip_blanks();
            }
        } else {
            p.error(SyntaxErrorKind::MissingOperand, open..open + 1);
        }
        close_group(p, open);
        p.sink.finish_node();
    });
}

fn close_group<S: Sink>(p: &mut Parser<'_, S>, open: u32) {
    if p.current() != Some(Token::RBracket) && !p.at_end() {
        // Text between the expression and its bracket is one mistake, if the bracket comes at all.
        let rest = p.tokens.get(p.at..).unwrap_or_default();
        let closes = rest.iter().any(|l| l.token == Token::RBracket);
        if closes {
            let start = p.offset();
            p.sink.start_node(SyntaxKind::ERROR);
            while !matches!(p.current(), None | Some(Token::RBracket)) {
                p.bump();
            }
            p.sink.finish_node();
            let end = p.end_of_previous();
            p.error(SyntaxErrorKind::Unexpected, start..end);
        }
    }
    if p.current() == Some(Token::RBracket) {
        p.bump();
    } else {
        p.error(SyntaxErrorKind::UnclosedBracket, open..open + 1);
    }
}

/// Is there one parameter and nothing else in the bracket here: `EXISTS[#<name>]`?
fn holds_a_parameter<S: Sink>(p: &Parser<'_, S>) -> bool {
    let first = p.index_past_blanks(1);
    let token = |at: usize| p.tokens.get(at).map(|l| l.token);
    match token(first) {
        Some(Token::Variable | Token::NamedVariable) => {
            let blanks = p.tokens.get(first + 1..).unwrap_or_default();
            let blanks = blanks.iter().take_while(|l| l.token == Token::Whitespace).count();
            token(first + 1 + blanks) == Some(Token::RBracket)
        }
        Some(Token::Hash) => true,
        _ => false,
    }
}

/// `SIN[a]`, `ATAN[a]/[b]`.
fn function_call<S: Sink>(p: &mut Parser<'_, S>) {
    let start = p.offset();
    let is_atan = p.current_text().eq_ignore_ascii_case(b"ATAN");
    let asks = p.current_text().eq_ignore_ascii_case(b"EXISTS");
    p.sink.start_node(SyntaxKind::FUNCTION_CALL);
    p.bump();
    let name = start..p.end_of_previous();
    p.skip_blanks();
    if p.current() == Some(Token::LBracket) {
        let is_of_parameter = !asks || holds_a_parameter(p);
        group(p);
        if !is_of_parameter {
            p.error(SyntaxErrorKind::MissingOperand, name);
        }
        if is_atan && p.peek_past_blanks(0) == Some(Token::Slash) {
            let slash = p
                .tokens
                .get(p.at..)
                .and_then(|rest| rest.iter().position(|l| l.token == Token::Slash))
                .unwrap_or(0);
            if p.peek_past_blanks(slash + 1) == Some(Token::LBracket) {
                p.skip_blanks();
                p.bump();
                p.skip_blanks();
                group(p);
            }
        }
    } else {
        p.error(SyntaxErrorKind::MissingOperand, name);
    }
    p.sink.finish_node();
}
