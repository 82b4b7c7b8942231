//! Whether two writings of a line are read as the same blocks.
//!
//! Knows: the grammar, and which differences of writing mean nothing. Must not know: why a line is written again. Lines of
//! words alone need no such proof; all others have it before they change.

use std::ops::Range;

use gcheck_program::Dialect;
use gcheck_syntax::{Sink, SyntaxError, SyntaxKind as K, SyntaxProfile, parse_into};

/// Reads lines for comparison.
pub(crate) struct Reader {
    profile: SyntaxProfile,
}

impl Reader {
    pub(crate) fn new(dialect: &Dialect<'_>) -> Self {
        Self { profile: dialect.profile() }
    }

    /// Are the two lines the same blocks, without mistakes in form?
    pub(crate) fn reads_the_same(&self, old: &str, new: &str) -> bool {
        let (old, new) = (self.meaning(old), self.meaning(new));
        new.is_some() && old == new
    }

    fn meaning(&self, line: &str) -> Option<Vec<u8>> {
        let mut meaning =
            Meaning { line, bytes: Vec::with_capacity(line.len() * 2), open: Vec::new(), is_whole: true };
        parse_into(line, self.profile, &mut meaning);
        meaning.is_whole.then_some(meaning.bytes)
    }
}

/// Marks the beginning of an item, the beginning and the end of a node; no text holds them without a mistake in form.
const ITEM: u8 = 1;
const START: u8 = 2;
const END: u8 = 3;

/// What a line says: its tokens without blanks, without case, numbers without zeros that count nothing, the tree around them.
struct Meaning<'t> {
    line: &'t str,
    bytes: Vec<u8>,
    /// Nodes that have begun, blocks among them.
    open: Vec<K>,
    is_whole: bool,
}

impl Meaning<'_> {
    fn upper(&mut self, text: &str) {
        self.bytes.extend(text.bytes().filter(|b| !b.is_ascii_whitespace()).map(|b| b.to_ascii_uppercase()));
    }

    /// `01.50` as `1.5`, `.0` and `0.` as `0.`.
    fn number(&mut self, text: &str) {
        let (whole, fraction) = match text.split_once('.') {
            Some((whole, fraction)) => (whole, Some(fraction)),
            None => (text, None),
        };
        let whole = whole.trim_start_matches('0');
        self.bytes.extend_from_slice(if whole.is_empty() { "0" } else { whole }.as_bytes());
        if let Some(fraction) = fraction {
            self.bytes.push(b'.');
            self.bytes.extend_from_slice(fraction.trim_end_matches('0').as_bytes());
        }
    }
}

/// Nodes that stand for a word; a fused word has none.
fn is_part_of_word(kind: K) -> bool {
    matches!(kind, K::ADDRESS | K::UNARY)
}

impl Sink for Meaning<'_> {
    type Checkpoint = ();

    fn start_node(&mut self, kind: K) {
        if self.open.len() == 1 {
            self.bytes.push(ITEM);
        }
        if !is_part_of_word(kind) {
            self.bytes.extend_from_slice(&[START, kind as u8]);
        }
        self.open.push(kind);
    }

    fn finish_node(&mut self) {
        if self.open.pop().is_some_and(|kind| !is_part_of_word(kind)) {
            self.bytes.push(END);
        }
    }

    fn checkpoint(&self) {}

    fn start_node_at(&mut self, (): (), kind: K) {
        // Where the node began is known from where the mark is after its first part: the grammar is the same for both.
        self.bytes.extend_from_slice(&[START, kind as u8]);
        self.open.push(kind);
    }

    fn token(&mut self, kind: K, range: Range<u32>) {
        let text = self.line.get(range.start as usize..range.end as usize).unwrap_or_default();
        if kind == K::WHITESPACE && !self.open.contains(&K::PRINT_STATEMENT) {
            return;
        }
        if self.open.len() == 1 {
            self.bytes.push(ITEM);
        }
        match kind {
            K::WORD => {
                let digits = text.find(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+'));
                let (address, number) = text.split_at(digits.unwrap_or(text.len()));
                self.upper(address);
                if let Some(sign) = number.chars().next().filter(|c| matches!(c, '-' | '+')) {
                    self.bytes.push(sign as u8);
                }
                self.number(number.trim_start_matches(['-', '+']));
            }
            K::NUMBER => self.number(text),
            K::COMMENT | K::LINE_COMMENT | K::NAMED_VARIABLE | K::UNKNOWN => {
                self.bytes.extend_from_slice(text.as_bytes());
            }
            _ if self.open.contains(&K::PRINT_STATEMENT) => self.bytes.extend_from_slice(text.as_bytes()),
            _ => self.upper(text),
        }
    }

    fn error(&mut self, _: SyntaxError) {
        self.is_whole = false;
    }
}
