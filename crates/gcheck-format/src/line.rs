//! One line written again: gaps between its items, letters, zeros, its sequence number.
//!
//! Knows: the tokens of a line and where items of a block begin. Must not know: other lines. A line whose form is not certain
//! to be read as before stays as it is.

use std::ops::Range;

use gcheck_controls::Letter;
use gcheck_program::Dialect;
use gcheck_syntax::SyntaxKind as K;

use crate::labels::Labels;
use crate::same::Reader;
use crate::style::{Indentation, LeadingZeros, LetterCase, Style, TrailingZeros, WordSpacing};

/// One token of a line, its place in the tree with it.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub(crate) kind: K,
    /// Bytes of the text.
    pub(crate) range: Range<u32>,
    /// Number of the item: a token or node directly in a block.
    pub(crate) item: u32,
    /// Kind of the item.
    pub(crate) outer: K,
    /// Kind of the innermost node; that of the token where there is none.
    pub(crate) inner: K,
    /// Text that the program prints.
    pub(crate) is_verbatim: bool,
}

/// The case that letters get: small ones only where the control reads them.
pub(crate) fn written_case(style: &Style, dialect: &Dialect<'_>) -> LetterCase {
    match style.letter_case {
        LetterCase::Lower if !dialect.control().syntax().lower_case => LetterCase::Keep,
        case => case,
    }
}

/// Blanks at the head of a line at most.
const DEEPEST: usize = 100;

/// Writes lines again, one after the other.
pub(crate) struct Writer<'s> {
    style: &'s Style,
    case: LetterCase,
    /// By byte: an address whose numbers may lose zeros at their end.
    trims: [bool; 128],
    /// Characters of a line that the control takes.
    longest: usize,
    labels: Option<Labels>,
    reader: Reader,
    items: Vec<Item>,
    /// The line as it becomes.
    line: String,
    /// Bytes of the text that change, and those of the new line that are there then.
    edits: Vec<(Range<u32>, Range<usize>)>,
}

/// A token or node directly in a block.
#[derive(Debug)]
struct Item {
    kind: ItemKind,
    /// Its tokens.
    parts: Range<usize>,
    /// Bytes of the text.
    range: Range<u32>,
    /// The blanks in front of it.
    gap: Range<u32>,
}

/// What an item is, as far as the gaps around it ask.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ItemKind {
    SequenceNumber,
    /// `O1234`, `:1234`.
    ProgramNumber,
    Word,
    /// An assignment, a condition, a statement.
    Statement,
    BlockDelete,
    Comment,
    /// The end of a block inside the line.
    Semicolon,
}

impl ItemKind {
    fn of(part: &Part, text: &str) -> Self {
        match part.outer {
            K::WORD | K::ADDRESS => match text.as_bytes().get(part.range.start as usize) {
                Some(b'N' | b'n') => Self::SequenceNumber,
                Some(b'O' | b'o') => Self::ProgramNumber,
                _ => Self::Word,
            },
            K::COLON_NUMBER => Self::ProgramNumber,
            K::BLOCK_DELETE => Self::BlockDelete,
            K::SEMICOLON => Self::Semicolon,
            kind if kind.is_comment() => Self::Comment,
            _ => Self::Statement,
        }
    }

    /// Letters and digits alone, which need no blank around them.
    fn is_word(self) -> bool {
        matches!(self, Self::SequenceNumber | Self::ProgramNumber | Self::Word)
    }
}

impl<'s> Writer<'s> {
    pub(crate) fn new(style: &'s Style, dialect: &Dialect<'_>, labels: Option<Labels>) -> Self {
        let mut trims = [false; 128];
        if style.trailing_zeros == TrailingZeros::Drop {
            for (byte, trims) in trims.iter_mut().enumerate() {
                let letter = Letter::new(byte as u8).or_else(|| Letter::sign(byte as u8));
                *trims = letter.is_some_and(|letter| takes_fractions(letter, dialect));
            }
        }
        Self {
            style,
            case: written_case(style, dialect),
            trims,
            longest: dialect.control().limits().line_length.map_or(usize::MAX, |most| most as usize),
            labels,
            reader: Reader::new(dialect),
            items: Vec::with_capacity(16),
            line: String::new(),
            edits: Vec::new(),
        }
    }

    /// Emits the edits of a line without mistakes in form; `parts` are its tokens without the line's end, `depth` is how deep
    /// it is nested, `base` the offset of `text` in the file.
    pub(crate) fn write(
        &mut self,
        text: &str,
        parts: &[Part],
        depth: usize,
        base: u32,
        emit: &mut impl FnMut(Range<u32>, &str),
    ) {
        let parts = match parts {
            [mark, rest @ ..] if mark.kind == K::BOM => rest,
            parts => parts,
        };
        // What is beside a tape mark is a name, or nobody knows what.
        if parts.iter().any(|part| matches!(part.kind, K::PERCENT | K::BOM)) {
            return;
        }
        let (Some(first), Some(last)) = (parts.first(), parts.last()) else { return };
        let range = first.range.start..last.range.end;
        self.find_items(text, parts);
        let dropped = self.droppable(base);
        self.line.clear();
        self.edits.clear();
        self.compose(text, parts, depth, dropped);
        if self.edits.is_empty() || self.is_too_long(slice(text, &range)) {
            return;
        }
        let is_plain = |part: &Part| {
            matches!(part.kind, K::WORD | K::WHITESPACE | K::COMMENT | K::LINE_COMMENT)
                && part.outer == part.kind
        };
        if !parts.iter().all(is_plain) {
            let kept = match dropped {
                // A line never becomes a number after its start: what is left out here is one item and its gap.
                Some(ix) => self.without(text, &range, ix),
                None => slice(text, &range).to_owned(),
            };
            if !self.reader.reads_the_same(&kept, &self.line) {
                return;
            }
        }
        for (range, new) in &self.edits {
            let new = self.line.get(new.clone()).unwrap_or_default();
            emit(base + range.start..base + range.end, new);
        }
    }

    fn find_items(&mut self, text: &str, parts: &[Part]) {
        self.items.clear();
        let mut end = parts.first().map_or(0, |part| part.range.start);
        let mut at = 0;
        while let Some(first) = parts.get(at) {
            let rest = parts.get(at..).unwrap_or_default();
            let count = rest.iter().take_while(|part| part.item == first.item).count();
            if first.outer != K::WHITESPACE {
                let last = rest.get(count - 1).unwrap_or(first);
                self.items.push(Item {
                    kind: ItemKind::of(first, text),
                    parts: at..at + count,
                    range: first.range.start..last.range.end,
                    gap: end..first.range.start,
                });
                end = last.range.end;
            }
            at += count;
        }
    }

    /// The item that is a sequence number which goes.
    fn droppable(&self, base: u32) -> Option<usize> {
        let labels = self.labels.as_ref()?;
        let ix = self.items.iter().position(|item| item.kind != ItemKind::BlockDelete)?;
        let number = self.items.get(ix).filter(|item| item.kind == ItemKind::SequenceNumber)?;
        // A number alone is a block, and a comment after one speaks for its own line. Of two numbers one may be the label.
        let next = self.items.get(ix + 1)?;
        let is_number = |item: &&Item| item.kind == ItemKind::SequenceNumber;
        let has_code = self.items.iter().filter(is_number).count() == 1
            && (next.kind.is_word() || next.kind == ItemKind::Statement);
        (has_code && labels.is_unnamed(base + number.range.start)).then_some(ix)
    }

    /// The line without an item and the gap after it.
    fn without(&self, text: &str, range: &Range<u32>, ix: usize) -> String {
        let start = self.items.get(ix).map_or(range.start, |item| item.range.start);
        let end = self.items.get(ix + 1).map_or(range.start, |item| item.range.start);
        [slice(text, &(range.start..start)), slice(text, &(end..range.end))].concat()
    }

    fn is_too_long(&self, old: &str) -> bool {
        let length = |text: &str| text.chars().count();
        self.line.len() > self.longest && length(&self.line) > self.longest.max(length(old))
    }

    fn compose(&mut self, text: &str, parts: &[Part], depth: usize, dropped: Option<usize>) {
        let items = std::mem::take(&mut self.items);
        let is_comment = |item: &Item| item.kind == ItemKind::Comment;
        let is_program = items.iter().any(|item| item.kind == ItemKind::ProgramNumber);
        let words_end = items.iter().rposition(|item| !is_comment(item)).map_or(0, |at| at + 1);
        let label = items
            .iter()
            .position(|item| item.kind != ItemKind::BlockDelete)
            .filter(|ix| items.get(*ix).is_some_and(|item| item.kind == ItemKind::SequenceNumber));
        let mut before = None;
        let mut has_code = false;
        for (ix, item) in items.iter().enumerate() {
            // After a number that goes, the blanks in front of it are the gap.
            if dropped.is_none_or(|dropped| dropped + 1 != ix) {
                let is_remark = ix >= words_end && has_code;
                let blanks = match before {
                    None => self.indentation(item.kind, depth),
                    Some(_) if is_remark && (is_program || self.style.comment_column == 0) => None,
                    Some(_) if is_remark && ix == words_end => Some(self.up_to(self.style.comment_column)),
                    Some(_) if is_remark => Some(1),
                    Some(_) if label.is_some_and(|label| label + 1 == ix) && self.style.word_column > 0 => {
                        Some(self.up_to(self.style.word_column))
                    }
                    Some(before) => self.between(before, item.kind),
                };
                match blanks {
                    None => self.copy(text, &item.gap),
                    Some(count) => self.blanks(text, &item.gap, count),
                }
            }
            if dropped == Some(ix) {
                let end = items.get(ix + 1).map_or(item.range.end, |next| next.range.start);
                self.replace(text, item.range.start..end, |_| ());
                continue;
            }
            self.item(text, item, parts.get(item.parts.clone()).unwrap_or_default());
            has_code |= matches!(item.kind, ItemKind::Word | ItemKind::Statement | ItemKind::ProgramNumber);
            before = Some(item.kind);
        }
        let head = parts.first().map_or(0, |part| part.range.start);
        let end = items.last().map_or(head, |item| item.range.end);
        let tail = end..parts.last().map_or(end, |part| part.range.end);
        if self.style.drop_trailing_blanks {
            self.blanks(text, &tail, 0);
        }
        self.items = items;
    }

    /// Blanks in front of the first item; `None` keeps them.
    fn indentation(&self, first: ItemKind, depth: usize) -> Option<usize> {
        match self.style.indentation {
            Indentation::Keep => None,
            Indentation::None => Some(0),
            Indentation::Nested(_) if first == ItemKind::BlockDelete => Some(0),
            Indentation::Nested(width) => Some((depth * usize::from(width)).min(DEEPEST)),
        }
    }

    /// Blanks between two items; `None` keeps them.
    fn between(&self, before: ItemKind, after: ItemKind) -> Option<usize> {
        let ends = |kind| matches!(kind, ItemKind::BlockDelete | ItemKind::Semicolon);
        if ends(before) || ends(after) {
            return None;
        }
        match self.style.word_spacing {
            WordSpacing::Keep => None,
            WordSpacing::One => Some(1),
            WordSpacing::None => (before.is_word() && after.is_word()).then_some(0),
        }
    }

    /// Blanks up to a column, one at least.
    fn up_to(&self, column: u8) -> usize {
        usize::from(column).saturating_sub(1).saturating_sub(self.line.chars().count()).max(1)
    }

    fn item(&mut self, text: &str, item: &Item, parts: &[Part]) {
        if item.kind != ItemKind::Comment && self.style.word_spacing != WordSpacing::Keep {
            // `X 1.5`, `X - 1.5` is one word, `X #1` begins with its address.
            let is_blank = |part: &&Part| part.kind != K::WHITESPACE;
            let mut tokens = parts.iter().filter(is_blank).map(|part| part.kind);
            let kinds = [tokens.next(), tokens.next(), tokens.next(), tokens.next()];
            let is_number = matches!(
                kinds,
                [Some(K::LETTER), Some(K::NUMBER), None, None]
                    | [Some(K::LETTER), Some(K::PLUS | K::MINUS), Some(K::NUMBER), None]
            );
            if item.kind.is_word() && is_number {
                let word: String =
                    parts.iter().filter(is_blank).map(|part| slice(text, &part.range)).collect();
                self.replace(text, item.range.clone(), |writer| writer.word(&word));
                return;
            }
        }
        let has_address = matches!(parts, [letter, ..] if letter.kind == K::LETTER);
        for (ix, part) in parts.iter().enumerate() {
            let is_behind_address = ix == 1 && has_address && part.kind == K::WHITESPACE;
            if is_behind_address && self.style.word_spacing != WordSpacing::Keep {
                self.blanks(text, &part.range, 0);
            } else {
                self.token(text, part);
            }
        }
    }

    fn token(&mut self, text: &str, part: &Part) {
        if part.is_verbatim {
            return self.copy(text, &part.range);
        }
        let old = slice(text, &part.range);
        match part.kind {
            // The first piece of a number with blanks inside is not a number yet.
            K::WORD if part.inner != K::ADDRESS => {
                self.replace(text, part.range.clone(), |writer| writer.word(old));
            }
            K::WORD | K::LETTER | K::O_NAME => {
                let letters = old.len() - old.trim_start_matches([',', 'o', 'O']).len();
                let letters = if part.kind == K::O_NAME { letters } else { old.len() };
                self.replace(text, part.range.clone(), |writer| {
                    writer.cased(old.get(..letters).unwrap_or_default());
                    writer.line.push_str(old.get(letters..).unwrap_or_default());
                });
            }
            K::FUNCTION | K::COMPARISON | K::AND_KW | K::OR_KW | K::MOD_KW => {
                self.replace(text, part.range.clone(), |writer| writer.cased(old));
            }
            kind if kind.is_keyword() => self.replace(text, part.range.clone(), |writer| writer.cased(old)),
            _ => self.copy(text, &part.range),
        }
    }

    /// Writes a word: its letter, its number without the zeros that count nothing.
    fn word(&mut self, old: &str) {
        let digits = old.find(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
        let (address, number) = old.split_at(digits.unwrap_or(old.len()));
        self.cased(address);
        let letter = address.bytes().last().unwrap_or_default().to_ascii_uppercase();
        match (letter, self.style.leading_zeros) {
            (b'G' | b'M', LeadingZeros::Add | LeadingZeros::Drop)
                if number.starts_with(|c: char| c.is_ascii_digit()) =>
            {
                let whole = number.find('.').unwrap_or(number.len());
                let (whole, fraction) = number.split_at(whole);
                let bare = whole.trim_start_matches('0');
                let least = if self.style.leading_zeros == LeadingZeros::Add { 2 } else { 1 };
                for _ in bare.len()..least {
                    self.line.push('0');
                }
                self.line.push_str(bare);
                self.line.push_str(fraction);
            }
            _ => {
                let is_trimmed = self.trims.get(usize::from(letter)).is_some_and(|trims| *trims);
                self.line.push_str(if is_trimmed { without_zeros(number) } else { number });
            }
        }
    }

    fn cased(&mut self, old: &str) {
        self.line.extend(old.chars().map(|c| match self.case {
            LetterCase::Keep => c,
            LetterCase::Upper => c.to_ascii_uppercase(),
            LetterCase::Lower => c.to_ascii_lowercase(),
        }));
    }

    fn copy(&mut self, text: &str, range: &Range<u32>) {
        self.line.push_str(slice(text, range));
    }

    fn blanks(&mut self, text: &str, range: &Range<u32>, count: usize) {
        self.replace(text, range.clone(), |writer| writer.line.extend(std::iter::repeat_n(' ', count)));
    }

    /// Writes something in the place of some bytes; the edit is of those alone that differ.
    fn replace(&mut self, text: &str, range: Range<u32>, write: impl FnOnce(&mut Self)) {
        let from = self.line.len();
        write(self);
        let (old, new) = (slice(text, &range), self.line.get(from..).unwrap_or_default());
        if old == new {
            return;
        }
        // What changes is plain ASCII, so that bytes may be counted.
        let same = |(a, b): &(u8, u8)| a == b;
        let front = old.bytes().zip(new.bytes()).take_while(same).count();
        let back = old.bytes().skip(front).rev().zip(new.bytes().skip(front).rev()).take_while(same).count();
        let range = range.start + front as u32..range.end - back as u32;
        let new = from + front..self.line.len() - back;
        match self.edits.last_mut() {
            Some((last, written)) if last.end == range.start => {
                (last.end, written.end) = (range.end, new.end);
            }
            _ => self.edits.push((range, new)),
        }
    }
}

/// May zeros after the point of such a word go? Not where the number is a name.
fn takes_fractions(letter: Letter, dialect: &Dialect<'_>) -> bool {
    let kind = dialect.control().letter(letter).map(|entry| entry.kind);
    !matches!(letter.ascii(), b'G' | b'M' | b'N' | b'O') && kind.is_some_and(|kind| !kind.is_whole())
}

/// `1.50` without the zeros at its end; a digit and the point stay.
fn without_zeros(number: &str) -> &str {
    let Some(point) = number.find('.') else { return number };
    let bare = number.trim_end_matches('0');
    let has_digit = number.get(..point).is_some_and(|whole| whole.contains(|c: char| c.is_ascii_digit()));
    if bare.len() > point + 1 || has_digit { bare } else { number.get(..point + 2).unwrap_or(number) }
}

fn slice<'t>(text: &'t str, range: &Range<u32>) -> &'t str {
    text.get(range.start as usize..range.end as usize).unwrap_or_default()
}
