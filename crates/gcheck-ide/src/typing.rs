//! The block that is being typed: what is before the cursor, and which codes and words it has.
//!
//! Knows: one line up to the cursor. Must not know: states, what is offered.

use std::ops::Range;

use gcheck_controls::{Code, CodeNumber, Control, Letter, WordEntry};
use gcheck_db::{ChunkTree, Snapshot};
use gcheck_syntax::ast::{Block, Comment, Element, OLabel, Statement, Word};
use gcheck_syntax::{SyntaxKind, SyntaxToken, byte_range};

use crate::describe;

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
    /// The tree of the chunk around; none in an empty document.
    tree: Option<ChunkTree>,
    /// The blocks of the line.
    blocks: Vec<Block>,
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
        let start = range.start;
        let tree = snapshot.tree_at(start);
        let blocks = tree.iter().flat_map(|tree| tree.blocks(range.clone())).collect();
        Self { snapshot, tree, blocks, before, start, offset }
    }

    /// Bytes of a view as bytes of the file.
    pub(crate) fn in_file(&self, range: Range<u32>) -> Range<u32> {
        self.tree.as_ref().map_or_else(|| range.clone(), |tree| tree.in_file(range.clone()))
    }

    /// A byte of the file as views count it.
    pub(crate) fn in_chunk(&self, offset: u32) -> u32 {
        self.tree.as_ref().map_or(0, |tree| tree.in_chunk(offset))
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
        let comment = Comment::cast(self.token_before(self.offset)?)?;
        let range = self.in_file(comment.range());
        if comment.is_closed() && range.end == self.offset {
            return None;
        }
        self.before.get((range.start - self.start) as usize + 1..)
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
        let offset = self.in_chunk(self.offset);
        self.blocks.iter().any(|block| block.is_in_brackets(offset))
    }

    /// What the tokens before `from` ask for.
    pub(crate) fn expected(&self, from: u32) -> Expected {
        let Some(last) = self.last_before(from) else { return Expected::Anything };
        let end = self.in_file(byte_range(last.text_range())).end;
        let syntax = self.control().syntax();
        let label = self.o_label().map(|label| self.in_file(label.range()).end);
        if let Some(label) = label.filter(|label| syntax.o_words && *label <= end) {
            let is_alone = label == end && end < self.offset;
            return if is_alone { Expected::OKeyword } else { self.expected_in_brackets(&last) };
        }
        let after_condition = self.statements().find_map(|statement| {
            let (keyword, condition) = match statement {
                Statement::If(statement) => (statement.keyword()?, statement.condition()?),
                Statement::While(statement) => (statement.keyword()?, statement.condition()?),
                _ => return None,
            };
            (self.in_file(condition.range()).end == end).then_some(keyword.kind())
        });
        match after_condition {
            Some(keyword)
                if last.kind() == SyntaxKind::R_BRACKET && syntax.macro_statements && !self.in_brackets() =>
            {
                Expected::AfterCondition(keyword)
            }
            _ => self.expected_in_brackets(&last),
        }
    }

    fn expected_in_brackets(&self, last: &SyntaxToken) -> Expected {
        let ends_operand = matches!(
            last.kind(),
            SyntaxKind::VARIABLE | SyntaxKind::NAMED_VARIABLE | SyntaxKind::NUMBER | SyntaxKind::R_BRACKET
        );
        if !ends_operand || !self.in_brackets() {
            return Expected::Anything;
        }
        let in_condition = self.statements().any(|statement| match statement {
            Statement::If(_) => true,
            Statement::While(statement) => statement.keyword().is_some(),
            Statement::O(statement) => statement.keyword().is_some_and(|keyword| {
                matches!(keyword.kind(), SyntaxKind::IF_KW | SyntaxKind::ELSEIF_KW | SyntaxKind::WHILE_KW)
            }),
            _ => false,
        });
        Expected::Operator { in_condition }
    }

    /// The statements of the line, those inside of others included.
    pub(crate) fn statements(&self) -> impl Iterator<Item = Statement> {
        self.blocks.iter().flat_map(Block::all_statements)
    }

    /// The label of the line's O-word.
    pub(crate) fn o_label(&self) -> Option<OLabel> {
        self.blocks.iter().find_map(Block::o_label)
    }

    fn token_before(&self, offset: u32) -> Option<SyntaxToken> {
        self.tree.as_ref()?.token_before(offset).filter(|_| offset > self.start)
    }

    /// The last token before the cursor and what is typed there, blanks left out.
    pub(crate) fn last_before(&self, from: u32) -> Option<SyntaxToken> {
        let tokens = self.blocks.iter().flat_map(Block::tokens);
        let before = tokens.take_while(|token| self.in_file(byte_range(token.text_range())).end <= from);
        before.filter(|token| !token.kind().is_trivia()).last()
    }

    /// The words of the line.
    pub(crate) fn words(&self) -> impl Iterator<Item = Word> {
        self.blocks.iter().flat_map(Block::all_words)
    }

    /// The word that the cursor is in or at the end of.
    pub(crate) fn word_here(&self) -> Option<Word> {
        match Element::of(self.token_before(self.offset)?) {
            Element::Word(word) => Some(word),
            _ => None,
        }
    }

    /// The codes of the line in text order, but for one that is being typed at the cursor.
    pub(crate) fn codes(&self) -> Vec<(Range<u32>, Code<'s>)> {
        let words = self.words().map(|word| (self.in_file(word.range()), word));
        let finished = words.filter(|(range, _)| range.end != self.offset);
        finished
            .filter_map(|(range, word)| {
                let number = CodeNumber::parse(&word.text())?;
                Some((range, self.control().code(number)?))
            })
            .collect()
    }

    /// Addresses of the line's words, but for one that is being typed at the cursor.
    pub(crate) fn letters(&self) -> Vec<Letter> {
        let finished = self.words().filter(|word| self.in_file(word.head_range()).end != self.offset);
        finished.filter_map(|word| address(&word)).collect()
    }

    /// How the codes of the line read an address: the first that reads it.
    pub(crate) fn entry(&self, letter: Letter) -> Option<(Code<'s>, &'s WordEntry)> {
        self.codes().into_iter().find_map(|(_, code)| Some((code, describe::word_of(code, letter)?)))
    }
}

/// The address of a word.
pub(crate) fn address(word: &Word) -> Option<Letter> {
    let letter = u8::try_from(word.letter()?).ok()?;
    if word.is_corner() {
        Letter::corner(letter)
    } else {
        Letter::new(letter).or_else(|| Letter::sign(letter))
    }
}
