//! The block that is being typed: what is before the cursor, and which codes and words it has.
//!
//! Knows: one line up to the cursor. Must not know: states, what is offered.

use std::ops::Range;

use gcheck_controls::{Code, CodeNumber, Control, Letter, WordEntry};
use gcheck_db::Snapshot;
use gcheck_syntax::SyntaxKind;

use crate::describe;
use crate::lexemes::{Lexeme, lexemes};

/// What the tokens before a place ask for next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Expected {
    /// A condition is complete; the keyword in front of it is `IF` or `WHILE`.
    AfterCondition(SyntaxKind),
    /// An expression has an operand and may go on with an operator.
    Operator {
        /// The expression is a condition.
        in_condition: bool,
    },
    /// The keyword of an O-word, whose label the line begins with.
    OKeyword,
    /// Nothing in particular.
    Anything,
}

/// A block that is being typed.
pub(crate) struct Typing<'s> {
    pub(crate) snapshot: &'s Snapshot,
    /// Tokens of the whole line.
    pub(crate) line: Vec<Lexeme>,
    /// Text of the line up to the cursor.
    pub(crate) before: String,
    /// First byte of the line.
    pub(crate) start: u32,
    pub(crate) offset: u32,
}

impl<'s> Typing<'s> {
    pub(crate) fn new(snapshot: &'s Snapshot, offset: u32) -> Self {
        let offset = offset.min(snapshot.len());
        let range = snapshot.line_range(snapshot.line_at(offset));
        let text = snapshot.slice(range.clone());
        let upto = (offset.saturating_sub(range.start) as usize).min(text.len());
        // A cursor inside a character is before it.
        let upto = (0..=upto).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
        let before = text.get(..upto).unwrap_or_default().to_owned();
        let offset = range.start + upto as u32;
        Self { snapshot, line: lexemes(snapshot, &text, range.start), before, start: range.start, offset }
    }

    pub(crate) fn control(&self) -> &'s Control {
        self.snapshot.control()
    }

    /// Text of the line after the cursor.
    pub(crate) fn rest(&self) -> String {
        let line = self.snapshot.line_range(self.snapshot.line_at(self.offset));
        self.snapshot.slice(self.offset..line.end.max(self.offset)).into_owned()
    }

    /// The text of the comment that the cursor is in, up to the cursor.
    pub(crate) fn comment(&self) -> Option<&str> {
        let lexeme = self
            .line
            .iter()
            .find(|lexeme| lexeme.range.start < self.offset && self.offset <= lexeme.range.end)?;
        let is_closed = lexeme.kind == SyntaxKind::COMMENT && lexeme.range.end == self.offset;
        if !lexeme.kind.is_comment() || is_closed {
            return None;
        }
        self.before.get((lexeme.range.start - self.start) as usize + 1..)
    }

    /// What is being typed: letters, digits and signs right before the cursor, with the offset of the first.
    pub(crate) fn prefix(&self) -> (&str, u32) {
        let is_part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '#' | '<' | '_' | ',' | '>');
        let mut at = self.before.len();
        for (index, c) in self.before.char_indices().rev() {
            if !is_part(c) {
                break;
            }
            at = index;
            // A sigil begins what is typed.
            if c == '#' {
                break;
            }
        }
        let text = self.before.get(at..).unwrap_or_default();
        // `G0X1`: the last address begins the word, but `GOTO` and names are one.
        let word = text.rfind(|c: char| c.is_ascii_alphabetic()).filter(|last| {
            !text.starts_with('#')
                && text
                    .get(*last + 1..)
                    .is_some_and(|rest| rest.bytes().all(|b| b.is_ascii_digit() || b == b'.'))
                && text
                    .get(..*last)
                    .is_some_and(|head| head.ends_with(|c: char| c.is_ascii_digit() || c == '.'))
        });
        let at = at + word.unwrap_or(0);
        (self.before.get(at..).unwrap_or_default(), self.start + at as u32)
    }

    /// Is the cursor inside brackets?
    pub(crate) fn in_brackets(&self) -> bool {
        let before = self.line.iter().filter(|lexeme| lexeme.range.start < self.offset);
        let depth = before.fold(0_i32, |depth, lexeme| match lexeme.kind {
            SyntaxKind::L_BRACKET => depth + 1,
            SyntaxKind::R_BRACKET => depth - 1,
            _ => depth,
        });
        depth > 0
    }

    /// What the tokens before `from` ask for.
    pub(crate) fn expected(&self, from: u32) -> Expected {
        let before: Vec<&Lexeme> =
            self.line.iter().filter(|lexeme| lexeme.range.end <= from && !lexeme.kind.is_trivia()).collect();
        let Some(last) = before.last() else { return Expected::Anything };
        let syntax = self.control().syntax();
        if syntax.o_words && before.iter().any(|lexeme| self.is_label(lexeme)) {
            let is_alone = self.is_label(last) && last.range.end < self.offset;
            return if is_alone { Expected::OKeyword } else { self.expected_in_brackets(&before) };
        }
        // The bracket that the last token closes, if it closes one.
        let mut depth = 0;
        let open = before.iter().rposition(|lexeme| {
            match lexeme.kind {
                SyntaxKind::R_BRACKET => depth += 1,
                SyntaxKind::L_BRACKET => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        let keyword = open.and_then(|open| before.get(open.checked_sub(1)?)).map(|lexeme| lexeme.kind);
        match keyword {
            Some(keyword @ (SyntaxKind::IF_KW | SyntaxKind::WHILE_KW))
                if last.kind == SyntaxKind::R_BRACKET && syntax.macro_statements =>
            {
                Expected::AfterCondition(keyword)
            }
            _ => self.expected_in_brackets(&before),
        }
    }

    fn expected_in_brackets(&self, before: &[&Lexeme]) -> Expected {
        let ends_operand = before.last().is_some_and(|last| {
            matches!(
                last.kind,
                SyntaxKind::VARIABLE
                    | SyntaxKind::NAMED_VARIABLE
                    | SyntaxKind::NUMBER
                    | SyntaxKind::R_BRACKET
            )
        });
        if !ends_operand || !self.in_brackets() {
            return Expected::Anything;
        }
        let is_condition = |lexeme: &&Lexeme| {
            matches!(lexeme.kind, SyntaxKind::IF_KW | SyntaxKind::ELSEIF_KW | SyntaxKind::WHILE_KW)
        };
        Expected::Operator { in_condition: before.iter().any(is_condition) }
    }

    /// Is a token the label of an O-word?
    fn is_label(&self, lexeme: &Lexeme) -> bool {
        lexeme.kind == SyntaxKind::O_NAME
            || lexeme.kind == SyntaxKind::WORD && self.letter(lexeme) == Some(Letter::of('O'))
    }

    /// The last token before the cursor and what is typed there, blanks left out.
    pub(crate) fn last_before(&self, from: u32) -> Option<&Lexeme> {
        self.line.iter().rfind(|lexeme| lexeme.range.end <= from && !lexeme.kind.is_trivia())
    }

    /// The codes of the line in text order, but for one that is being typed at the cursor.
    pub(crate) fn codes(&self) -> Vec<(Range<u32>, Code<'s>)> {
        let words = self.line.iter().filter(|lexeme| lexeme.kind == SyntaxKind::WORD);
        let finished = words.filter(|lexeme| lexeme.range.end != self.offset);
        finished
            .filter_map(|lexeme| {
                let number = CodeNumber::parse(&self.snapshot.slice(lexeme.range.clone()))?;
                Some((lexeme.range.clone(), self.control().code(number)?))
            })
            .collect()
    }

    /// Addresses of the line's words, but for one that is being typed at the cursor.
    pub(crate) fn letters(&self) -> Vec<Letter> {
        let words =
            self.line.iter().filter(|lexeme| matches!(lexeme.kind, SyntaxKind::WORD | SyntaxKind::LETTER));
        let finished = words.filter(|lexeme| lexeme.range.end != self.offset);
        finished.filter_map(|lexeme| self.letter(lexeme)).collect()
    }

    /// The address of a word.
    pub(crate) fn letter(&self, lexeme: &Lexeme) -> Option<Letter> {
        let text = self.snapshot.slice(lexeme.range.clone());
        let len = if text.starts_with(',') { 2 } else { 1 };
        Letter::parse(&text.get(..len)?.to_ascii_uppercase())
    }

    /// How the codes of the line read an address: the first that reads it.
    pub(crate) fn entry(&self, letter: Letter) -> Option<(Code<'s>, &'s WordEntry)> {
        self.codes().into_iter().find_map(|(_, code)| Some((code, describe::word_of(code, letter)?)))
    }
}
