//! What a rule sees: a block with its control, or a whole file.
//!
//! Knows: how to ask the block table and the knowledge base together. Must not know: how rules are chosen or findings shown.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_controls::{Code, Confidence, Control, Letter, LetterEntry, LetterSet, WordEntry, WordKind};
use gcheck_program::{Block, BlockIx, BlockTable, Dialect, Expr, Survey, Value, Word};
use gcheck_syntax::SyntaxError;

use crate::suppression::Suppressions;
use crate::writing::Writing;
use crate::{Finding, ProgramText, Severity};

/// How a rule runs, by tier.
pub enum Run {
    /// For each mistake in form of a kind that `on` accepts.
    Token {
        /// Does the rule speak about this kind of mistake?
        on: fn(gcheck_syntax::SyntaxErrorKind) -> bool,
        /// Reports it.
        check: fn(&BlockCx<'_>, &SyntaxError, &mut Report<'_>),
    },
    /// For each block that has any of the flags.
    Block {
        /// Blocks without any of these are passed over.
        trigger: gcheck_program::BlockFlags,
        /// Looks at the block.
        check: fn(&BlockCx<'_>, &mut Report<'_>),
    },
    /// Once for the file.
    Program {
        /// Looks at the file.
        check: fn(&FileCx<'_>, &mut Report<'_>),
    },
    /// While all paths of the program are executed.
    Path {
        /// What the rule wants to see.
        watch: crate::Watch,
        /// Makes the rule for one file.
        make: fn() -> Box<dyn crate::PathRule>,
    },
    /// Once for the file, after its suppressions have silenced what they silence.
    Suppressions {
        /// Looks at the suppressions.
        check: fn(&Suppressions, &mut Report<'_>),
    },
}

impl std::fmt::Debug for Run {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Token { .. } => "Token",
            Self::Block { .. } => "Block",
            Self::Program { .. } => "Program",
            Self::Path { .. } => "Path",
            Self::Suppressions { .. } => "Suppressions",
        })
    }
}

/// Takes the findings of one rule.
pub struct Report<'r> {
    pub(crate) add: &'r mut dyn FnMut(Finding),
}

impl Report<'_> {
    /// Adds a finding.
    pub fn add(&mut self, finding: Finding) {
        (self.add)(finding);
    }
}

/// What the user declared about the machine; everything may be unknown.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MachineFacts {
    /// Axes the machine has.
    pub axes: Option<LetterSet>,
    /// The control's settings by number, values as its page words them.
    pub settings: BTreeMap<String, String>,
    /// Somebody told the units of the machine's programs: `engine.units` is more than what the control starts with.
    pub units_are_told: bool,
    /// Offsets, tools, travel and the rest that executing a program asks for.
    pub engine: gcheck_engine::Machine,
}

/// Programs that are not in the file at hand: other files of its folder and of the search path.
pub trait Programs {
    /// Is there a program of this number?
    fn has_number(&self, number: u32) -> bool;
    /// Is there a subroutine file of this name (lower case)?
    fn has_name(&self, name: &str) -> bool;
    /// The file that holds the program of this number, for execution.
    fn source_of_number(&self, number: u32) -> Option<gcheck_engine::SourceFile> {
        let _ = number;
        None
    }
    /// The file that holds the subroutine of this name (lower case), for execution.
    fn source_of_name(&self, name: &str) -> Option<gcheck_engine::SourceFile> {
        let _ = name;
        None
    }
}

/// No other programs.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoPrograms;

impl Programs for NoPrograms {
    fn has_number(&self, _: u32) -> bool {
        false
    }

    fn has_name(&self, _: &str) -> bool {
        false
    }
}

/// What every rule may ask.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The control, prepared.
    pub dialect: &'a Dialect<'a>,
    /// The user's machine.
    pub machine: &'a MachineFacts,
    /// Other programs.
    pub programs: &'a dyn Programs,
    /// The control was not chosen by anybody: it was guessed from the program, or is the default.
    pub control_is_guessed: bool,
}

impl<'a> Scene<'a> {
    /// The control.
    pub fn control(&self) -> &'a Control {
        self.dialect.control()
    }

    /// A setting's value: configured, or the default that the knowledge base assumes.
    ///
    /// The second part is the assumption to state, if nobody configured it.
    pub fn setting(&self, number: &str) -> Option<(&'a str, Option<String>)> {
        if let Some(value) = self.machine.settings.get(number) {
            return Some((value, None));
        }
        let entry = self.control().setting(number)?;
        let default = entry.default.as_deref()?;
        Some((default, Some(format!("setting {number} ({}) is {default}", entry.title))))
    }
}

/// A fact's confidence as a limit of severity: nothing assumed is ever an error.
pub fn limit(confidence: Confidence) -> Severity {
    match confidence {
        Confidence::Manual => Severity::Error,
        Confidence::Observed | Confidence::Assumed => Severity::Warning,
    }
}

/// Words of one block that rules look at.
///
/// Rules may compare every word with every other. There are 32 addresses, so a block with more words than this repeats them
/// all and is reported for that; a line of a million characters must not cost a million squared.
pub(crate) const MAX_WORDS: usize = 256;

/// One block, as a rule of the token or block tier sees it.
pub struct BlockCx<'a> {
    /// Control, machine, other programs.
    pub scene: Scene<'a>,
    pub(crate) table: &'a BlockTable,
    pub(crate) ix: BlockIx,
    pub(crate) block: &'a Block,
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
    /// A minus sign is accepted.
    pub negative: bool,
    /// The code that reads the word; `None` when the general entry of the address speaks.
    pub code: Option<Code<'a>>,
    /// How sure these facts are.
    pub confidence: Confidence,
    /// How sure `min`, `max` and `above` are.
    pub range_confidence: Confidence,
    /// Where they stand.
    pub source: &'a str,
}

impl<'a> BlockCx<'a> {
    /// The control.
    pub fn control(&self) -> &'a Control {
        self.scene.control()
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
    /// than a block can use.
    pub fn words(&self) -> &'a [Word] {
        let words = self.table.words(self.block);
        words.get(..MAX_WORDS).unwrap_or(words)
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

    /// What a word means: asked first of the codes in its block, then of its address.
    ///
    /// `None` for `G` and `M` words, for addresses the control does not have, and where a code of the block may read
    /// anything (a macro call), so that its words mean what the macro says.
    pub fn facts(&self, word: &Word) -> Option<WordFacts<'a>> {
        if matches!(word.letter.ascii(), b'G' | b'M') && !word.letter.is_corner() {
            return None;
        }
        let general = self.control().letter(word.letter);
        let mut anything = false;
        for (_, code) in self.codes() {
            if code.reads().contains(word.letter) {
                let entry =
                    code.entry().words.iter().find(|w| Letter::parse(&w.letter) == Some(word.letter))?;
                return Some(of_code(code, entry, general));
            }
            anything |= code.entry().any_words;
        }
        if anything && !general.is_some_and(|g| matches!(g.kind, WordKind::Label) && g.free) {
            return None;
        }
        general.map(of_letter)
    }
}

fn of_code<'a>(code: Code<'a>, entry: &'a WordEntry, general: Option<&'a LetterEntry>) -> WordFacts<'a> {
    let confidence = entry.confidence.unwrap_or(code.entry().confidence);
    WordFacts {
        is: &entry.is,
        kind: entry.kind,
        min: entry.min,
        max: entry.max,
        above: entry.above,
        negative: general.is_none_or(|g| g.negative),
        code: Some(code),
        confidence,
        range_confidence: entry.range_confidence.unwrap_or(confidence),
        source: &code.entry().source,
    }
}

fn of_letter(entry: &LetterEntry) -> WordFacts<'_> {
    WordFacts {
        is: &entry.is,
        kind: entry.kind,
        min: entry.min,
        max: entry.max,
        above: None,
        negative: entry.negative,
        code: None,
        confidence: entry.confidence,
        range_confidence: entry.confidence,
        source: &entry.source,
    }
}

/// A whole file, as a rule of the program tier sees it.
pub struct FileCx<'a> {
    /// Control, machine, other programs.
    pub scene: Scene<'a>,
    /// The text.
    pub text: &'a ProgramText<'a>,
    /// The part of the file that the control reads.
    pub region: Range<u32>,
    /// Labels, jumps, calls, loops, ends.
    pub survey: &'a Survey,
    /// How the file is written, once a rule has asked.
    writing: OnceCell<Writing>,
}

impl<'a> FileCx<'a> {
    /// A file with its survey; `region` is the part that the control reads.
    pub fn new(scene: Scene<'a>, text: &'a ProgramText<'a>, region: Range<u32>, survey: &'a Survey) -> Self {
        Self { scene, text, region, survey, writing: OnceCell::new() }
    }

    /// How the file is written.
    pub(crate) fn writing(&self) -> &Writing {
        self.writing.get_or_init(|| Writing::of(self))
    }

    /// The control.
    pub fn control(&self) -> &'a Control {
        self.scene.control()
    }

    /// Text of a range of the file.
    pub fn slice(&self, range: Range<u32>) -> &'a str {
        self.text.slice(range)
    }
}
