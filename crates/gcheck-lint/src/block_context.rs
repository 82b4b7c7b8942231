//! What a rule of the token or block tier sees: one block with its control.
//!
//! Knows: how to ask the block table and the knowledge base together. Must not know: how rules are chosen, other blocks.

use std::ops::Range;

use gcheck_controls::{Code, Confidence, Control, Letter, LetterEntry, Unset, WordEntry, WordKind};
use gcheck_program::{Block, BlockIx, BlockTable, Expr, Op, Value, Word};

use crate::Environment;

/// Words of one block that rules look at.
///
/// Rules may compare every word with every other. There are 32 addresses, so a block with more words than this repeats them
/// all and is reported for that; a line of a million characters must not cost a million squared.
pub(crate) const MAX_WORDS: usize = 256;

/// One block, as a rule of the token or block tier sees it.
pub struct BlockCx<'a> {
    /// Control, machine, other programs.
    pub environment: Environment<'a>,
    pub(crate) table: &'a BlockTable,
    pub(crate) ix: BlockIx,
    pub(crate) block: &'a Block,
    /// Words of the block.
    pub(crate) words: &'a [Word],
    /// Text of the chunk.
    pub(crate) text: &'a str,
    /// Offset of the chunk in the file.
    pub(crate) base: u32,
}

/// What a word means in its block: the entry of the code that reads it, or the general one of its address.
#[derive(Debug, Clone, Copy)]
pub struct WordFacts<'a> {
    /// Meaning in a few words.
    pub is: &'a str,
    /// Kind of value.
    pub kind: WordKind,
    /// Smallest value.
    pub min: Option<f64>,
    /// Largest value.
    pub max: Option<f64>,
    /// The value must be greater than this.
    pub above: Option<f64>,
    /// The values that it may have; empty where the bounds say all.
    pub values: &'a [f64],
    /// Numbers between the bounds that it may not have either.
    pub gaps: &'a [[f64; 2]],
    /// A number that is not whole is refused, not rounded.
    pub whole: bool,
    /// A minus sign is accepted.
    pub negative: bool,
    /// The code that reads the word; `None` when the general entry of the address applies.
    pub code: Option<Code<'a>>,
    /// How sure these facts are.
    pub confidence: Confidence,
    /// How sure `values`, `min`, `max` and `above` are.
    pub range_confidence: Confidence,
    /// Where they are written: manual and page.
    pub source: &'a str,
}

impl<'a> BlockCx<'a> {
    /// A block as it is written; `text` is that of its chunk, `base` the chunk's offset in the file.
    pub(crate) fn new(
        environment: Environment<'a>,
        table: &'a BlockTable,
        ix: BlockIx,
        text: &'a str,
        base: u32,
    ) -> Self {
        let block = table.block(ix);
        Self { environment, table, ix, block, words: table.words(block), text, base }
    }

    /// The alarm that the control raises for what a rule finds about a code or an address: `G43.1`, `T`.
    pub fn alarm_of(&self, rule: &str, thing: &str) -> Option<String> {
        let alarm = self.control().alarm_of(rule, thing)?;
        Some(alarm.number.clone().unwrap_or_else(|| alarm.text.clone()))
    }

    /// The control.
    pub fn control(&self) -> &'a Control {
        self.environment.control()
    }

    /// The block.
    pub fn block(&self) -> &'a Block {
        self.block
    }

    /// The chunk's table.
    pub fn table(&self) -> &'a BlockTable {
        self.table
    }

    /// The block's words in text order, statements not included; the first 256 of them, which is more
    /// than a block can use. A computed word is a number where the rule [asks for it](crate::Run::BlockAndValues).
    pub fn words(&self) -> &'a [Word] {
        self.words.get(..MAX_WORDS).unwrap_or(self.words)
    }

    /// The first word with an address.
    pub fn word(&self, letter: char) -> Option<&'a Word> {
        let letter = Letter::of(letter);
        self.words().iter().find(|w| w.letter == letter)
    }

    /// The block's `G` and `M` words that name codes of the control, with the codes.
    pub fn codes(&self) -> impl Iterator<Item = (&'a Word, Code<'a>)> + use<'a> {
        let control = self.control();
        self.words().iter().filter_map(move |word| Some((word, control.code_at(word.code)?)))
    }

    /// The block's statements in text order.
    pub fn statements(&self) -> impl Iterator<Item = &'a gcheck_program::Statement> + use<'a> {
        self.table.statements(self.ix)
    }

    /// The block's expressions: of its words, then of its statements.
    pub fn expressions(&self) -> impl Iterator<Item = &'a Expr> + use<'a> {
        let table = self.table;
        let of_words = self.words().iter().filter_map(|word| match word.value {
            Value::Expr(expr) => Some(expr),
            Value::Number(_) | Value::Missing => None,
        });
        of_words.chain(self.statements().flat_map(|s| s.kind.expressions())).map(|ix| table.expr(ix))
    }

    /// May the word be left out of the block? A variable that holds nothing takes its address with it, on controls that
    /// have such variables.
    pub fn may_be_left_out(&self, word: &Word) -> bool {
        let Value::Expr(expr) = word.value else { return false };
        let ops = self.table.ops(self.table.expr(expr));
        self.control().semantics().unset == Unset::Vacant
            && matches!(ops, [Op::Variable(_)] | [Op::Variable(_), Op::Negate])
    }

    /// Bytes of the chunk as bytes of the file.
    pub fn in_file(&self, range: Range<u32>) -> Range<u32> {
        range.start + self.base..range.end + self.base
    }

    /// A word's bytes of the file.
    pub fn range(&self, word: &Word) -> Range<u32> {
        self.in_file(word.range())
    }

    /// The block's bytes of the file.
    pub fn block_range(&self) -> Range<u32> {
        self.in_file(self.block.range.clone())
    }

    /// Text of the chunk's bytes.
    pub fn slice(&self, range: Range<u32>) -> &'a str {
        self.text.get(range.start as usize..range.end as usize).unwrap_or_default()
    }

    /// A word as written.
    pub fn text(&self, word: &Word) -> &'a str {
        self.slice(word.range())
    }

    /// The block as written, without its end of line.
    pub fn block_text(&self) -> &'a str {
        self.slice(self.block.range.clone())
    }

    /// The structure of the block's text, with offsets from the start of the block: for the places of findings and fixes. The tree
    /// is made for the rule that asks, so a rule asks where it has something to report.
    pub fn tree(&self) -> Option<gcheck_syntax::ast::Block> {
        let parse = gcheck_syntax::parse(self.block_text(), gcheck_program::profile(self.control()));
        gcheck_syntax::ast::Chunk::cast(parse.syntax())?.blocks().next()
    }

    /// Bytes of the block's [tree](Self::tree) as bytes of the file.
    pub fn of_tree(&self, range: Range<u32>) -> Range<u32> {
        let start = self.block_range().start;
        start + range.start..start + range.end
    }

    /// What a word means: asked first of the codes in its block, then of its address.
    ///
    /// `None` for `G` and `M` words, for addresses the control does not have, and where a code of the block may read
    /// anything (a macro call), so that its words mean what the macro says.
    pub fn facts(&self, word: &Word) -> Option<WordFacts<'a>> {
        facts_of(self.control(), self.codes().map(|(_, code)| code), word.letter)
    }
}

/// What a word of an address means beside the codes of its block; see [`BlockCx::facts`].
pub(crate) fn facts_of<'a>(
    control: &'a Control,
    codes: impl Iterator<Item = Code<'a>>,
    letter: Letter,
) -> Option<WordFacts<'a>> {
    if matches!(letter.ascii(), b'G' | b'M') && !letter.is_corner() {
        return None;
    }
    let general = control.letter(letter);
    let mut anything = false;
    for code in codes {
        if code.reads().contains(letter) {
            let entry = code.entry().words.iter().find(|w| Letter::parse(&w.letter) == Some(letter))?;
            return Some(of_code(code, entry, general));
        }
        anything |= code.entry().any_words;
    }
    if anything && !general.is_some_and(|g| matches!(g.kind, WordKind::Label) && g.free) {
        return None;
    }
    general.map(of_letter)
}

fn of_code<'a>(code: Code<'a>, entry: &'a WordEntry, general: Option<&'a LetterEntry>) -> WordFacts<'a> {
    let confidence = entry.confidence.unwrap_or(code.entry().confidence);
    // What has a number for its name has none below zero.
    let is_name = matches!(entry.kind, WordKind::Label | WordKind::Program);
    let own = WordFacts {
        is: &entry.is,
        kind: entry.kind,
        min: entry.min.or(is_name.then_some(0.0)),
        max: entry.max,
        above: entry.above,
        values: &entry.values,
        gaps: &entry.gaps,
        whole: entry.whole,
        // An argument of a macro may be any number.
        negative: code.entry().any_words || general.is_none_or(|g| g.negative),
        code: Some(code),
        confidence,
        range_confidence: entry.range_confidence.unwrap_or(confidence),
        source: &code.entry().source,
    };
    match general.filter(|general| takes_range_of(code, entry, general)) {
        Some(general) => WordFacts {
            min: general.min,
            max: general.max,
            range_confidence: general.confidence,
            source: &general.source,
            ..own
        },
        None => own,
    }
}

/// Does the word have the range of its address? It does where the code gives none, and means the same kind of value.
fn takes_range_of(code: Code<'_>, entry: &WordEntry, general: &LetterEntry) -> bool {
    let is_bound = entry.min.is_some() || entry.max.is_some() || entry.above.is_some();
    let is_listed = !entry.values.is_empty() || !entry.gaps.is_empty();
    !code.entry().any_words
        && !is_bound
        && !is_listed
        && entry.kind == general.kind
        && (general.min.is_some() || general.max.is_some())
}

fn of_letter(entry: &LetterEntry) -> WordFacts<'_> {
    WordFacts {
        is: &entry.is,
        kind: entry.kind,
        min: entry.min,
        max: entry.max,
        above: None,
        values: &[],
        gaps: &entry.gaps,
        whole: entry.whole,
        negative: entry.negative,
        code: None,
        confidence: entry.confidence,
        range_confidence: entry.confidence,
        source: &entry.source,
    }
}
