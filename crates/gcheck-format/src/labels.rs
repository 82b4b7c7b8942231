//! Sequence numbers, the words that name them, and which block each word means.
//!
//! Knows: which words of a control name blocks (data), the programs of a file and who calls whom in it. Must not know:
//! how numbers change. An uncertain name is marked as such, and then nothing that depends on it changes.

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_controls::{CodeIx, Ends, Letter, LetterSet, Variable, WordKind};
use gcheck_program::{
    Block, BlockFlags, BlockIx, BlockTable, ControlFlowGraph, Dialect, FileIndex, Loaded, Op, StatementKind,
    Value, Word,
};

/// Programs that call one, as far as they are followed.
const MOST_CALLERS: usize = 64;

/// A sequence number at the head of a block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Label {
    /// Its value; `None` for one that is not a whole number.
    pub(crate) number: Option<u32>,
    /// Bytes of the file: the word.
    pub(crate) range: Range<u32>,
    /// Bytes of the file: its digits.
    pub(crate) digits: Range<u32>,
    /// The program that it is in: its first block.
    pub(crate) program: u32,
}

/// A word that names a block by its number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Reference {
    /// What it names.
    pub(crate) target: Target,
    /// Bytes of the file: the word or statement.
    pub(crate) range: Range<u32>,
    /// The program that it is in: its first block.
    pub(crate) program: u32,
}

/// What a word names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Target {
    /// A block of its own program.
    Own(Number),
    /// A block of the program that calls this one; of its own when nothing calls it.
    Caller(Number),
    /// A block of its own program where that has one of the number, else a program.
    OwnOrProgram(Number),
    /// A block of its own program or of another one.
    Other,
    /// Computed, or written in a form that is not certain.
    Computed,
    /// No block: it reads the number of one.
    Reads,
    /// No block: it is a number that is not in front of its block, or a second one.
    Stray,
    /// The block has a mistake in form, so that what it names is not certain.
    Unclear,
}

/// A number that names a block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Number {
    pub(crate) value: u32,
    /// Bytes of the file: its digits.
    pub(crate) digits: Range<u32>,
}

/// The sequence numbers of a file.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    /// In text order.
    pub(crate) list: Vec<Label>,
    /// In text order.
    pub(crate) references: Vec<Reference>,
    /// By program, the first blocks of the programs of the file that call it.
    callers: BTreeMap<u32, Vec<u32>>,
    /// Programs, by their first blocks, with a code that ends a main program.
    mains: Vec<u32>,
    /// A program is called that is not in the file, or nobody knows which.
    calls_others: bool,
    /// Which program is called is computed, or several codes of a block may call it.
    has_computed_call: bool,
    /// Offsets of the numbers that nothing names, in order.
    unnamed: Vec<u32>,
}

/// What was found in text order, with numbers of blocks.
#[derive(Default)]
struct Found {
    labels: Vec<(u32, Label)>,
    references: Vec<(u32, Reference)>,
    /// Calls with the number of the program.
    calls: Vec<(u32, Option<u32>)>,
    ends: Vec<u32>,
    blocks: u32,
}

impl Labels {
    /// Collects the numbers of a file.
    pub(crate) fn of(text: &str, dialect: &Dialect<'_>) -> Self {
        let region_end = gcheck_program::code_region(text).end as u32;
        let mut found = Found::default();
        let mut file_index = FileIndex::default();
        let loaded = Loaded::new(text, dialect, |base, table, part| {
            found.add(table, base, region_end, part, dialect);
            file_index.add(table, base, region_end, dialect);
        });
        // `N` of a row of data is the number of something else, wherever it is in the row.
        found.labels.retain(|(_, label)| !file_index.is_data(label.range.start));
        let is_stray = |reference: &Reference| matches!(reference.target, Target::Stray);
        found.references.retain(|(_, of)| !is_stray(of) || !file_index.is_data(of.range.start));
        Self::resolve(found, loaded.flow_graph(), dialect)
    }

    fn resolve(found: Found, graph: &ControlFlowGraph, dialect: &Dialect<'_>) -> Self {
        let program = |block: u32| graph.part_of(block).start;
        let mut labels = Self {
            list: found
                .labels
                .into_iter()
                .map(|(block, label)| Label { program: program(block), ..label })
                .collect(),
            references: found
                .references
                .into_iter()
                .map(|(block, reference)| Reference { program: program(block), ..reference })
                .collect(),
            mains: found.ends.into_iter().map(program).collect(),
            ..Self::default()
        };
        labels.mains.sort_unstable();
        labels.mains.dedup();
        for (block, number) in found.calls {
            // The digits in front of the last four may count repeats.
            let called = number.and_then(|number| graph.program(number).or(graph.program(number % 10_000)));
            match called {
                Some(called) => {
                    let callers = labels.callers.entry(called.blocks.start).or_default();
                    // Calls come in text order, and so do those of one program.
                    let from = program(block);
                    if callers.last() != Some(&from) && callers.len() <= MOST_CALLERS {
                        callers.push(from);
                    }
                }
                None => labels.calls_others = true,
            }
            labels.has_computed_call |= number.is_none();
        }
        labels.note_unnamed(dialect);
        labels
    }

    /// Does nothing name the sequence number at this offset of the file, as far as the file tells for certain?
    pub(crate) fn is_unnamed(&self, offset: u32) -> bool {
        self.unnamed.binary_search(&offset).is_ok()
    }

    fn note_unnamed(&mut self, dialect: &Dialect<'_>) {
        let control = dialect.control();
        let names_blocks = control.syntax().macro_statements
            || control.codes().any(|code| {
                code.is_user() || code.entry().words.iter().any(|word| word.kind == WordKind::Label)
            });
        let is_known = |reference: &Reference| {
            !matches!(reference.target, Target::Other | Target::Computed | Target::Reads | Target::Unclear)
        };
        if names_blocks && (self.calls_others || !self.references.iter().all(is_known)) {
            return;
        }
        let mut named: Vec<u32> = self
            .references
            .iter()
            .filter_map(|reference| match &reference.target {
                Target::Own(number) | Target::Caller(number) | Target::OwnOrProgram(number) => {
                    Some(number.value)
                }
                _ => None,
            })
            .collect();
        named.sort_unstable();
        let is_named = |label: &Label| label.number.is_none_or(|number| named.binary_search(&number).is_ok());
        self.unnamed =
            self.list.iter().filter(|label| !is_named(label)).map(|label| label.range.start).collect();
    }

    /// The programs, by their first blocks, one of whose blocks a reference names; empty when that cannot be told.
    pub(crate) fn programs_named_by(&self, reference: &Reference) -> Vec<u32> {
        match (&reference.target, self.callers.get(&reference.program)) {
            (Target::Own(_) | Target::OwnOrProgram(_), _) => vec![reference.program],
            (Target::Caller(_), Some(callers))
                if !self.has_computed_call && callers.len() <= MOST_CALLERS =>
            {
                callers.clone()
            }
            // A main program goes on at a block of its own.
            (Target::Caller(_), None) if self.mains.binary_search(&reference.program).is_ok() => {
                vec![reference.program]
            }
            _ => Vec::new(),
        }
    }
}

impl Found {
    fn add(&mut self, table: &BlockTable, base: u32, region_end: u32, text: &str, dialect: &Dialect<'_>) {
        let inside = |block: &Block| base + block.range.start < region_end;
        let first = self.blocks;
        self.blocks += table.blocks().filter(|(_, block)| inside(block)).count() as u32;
        let interesting = BlockFlags::CODE
            | BlockFlags::LABEL
            | BlockFlags::STATEMENT
            | BlockFlags::EXPRESSION
            | BlockFlags::ERROR;
        if !table.flags().intersects(interesting) {
            return;
        }
        let blocks = table.blocks().zip(first..).take_while(|((_, block), _)| inside(block));
        for ((ix, block), number) in blocks {
            if block.flags.intersects(interesting) {
                self.add_block(&Place { table, ix, block, number, base, text, dialect });
            }
        }
    }

    fn add_block(&mut self, place: &Place<'_>) {
        let Place { table, ix, block, number, .. } = *place;
        let words = table.words(block);
        if let Some(label) = head(words) {
            let range = place.shift(&label.range());
            let digits = place.digits(&label.range()).unwrap_or(range.end..range.end);
            let value = label.integer().filter(|_| !digits.is_empty());
            self.labels.push((number, Label { number: value, range, digits, program: 0 }));
        }
        let is_number = |word: &&Word| word.letter == Letter::of('N');
        let stray = words.iter().filter(is_number).find(|word| head(words) != Some(*word));
        if let Some(word) = stray {
            self.refer(number, Target::Stray, place.shift(&word.range()));
        }
        let references = self.references.len();
        // A block may be as long as a file: what its codes ask for is gathered once.
        let mut addresses = None;
        for word in words.iter().filter(|word| word.code.is_some()) {
            self.add_code(place, word, || {
                *addresses.get_or_insert_with(|| Addresses::of(words, place.dialect))
            });
        }
        for statement in table.statements(ix) {
            if let StatementKind::Goto { target } = &statement.kind {
                let target = target.map(|expr| table.expr(expr).range.clone());
                let digits = target.and_then(|range| place.digits(&range));
                let target = place.number(digits).map_or(Target::Computed, Target::Own);
                self.refer(number, target, place.shift(&statement.range));
            }
        }
        let computed = words.iter().filter_map(|word| match word.value {
            Value::Expr(expr) => Some(expr),
            Value::Number(_) | Value::Missing => None,
        });
        let statements = table.statements(ix).flat_map(|statement| statement.kind.expressions());
        for expr in computed.chain(statements).map(|expr| table.expr(expr)) {
            if table.ops(expr).iter().any(|op| place.holds_number(op)) {
                self.refer(number, Target::Reads, place.shift(&expr.range));
            }
        }
        // In a block with a mistake in form nobody knows what was meant.
        if block.flags.contains(BlockFlags::ERROR) {
            let is_jump = |word: &Word| dialect_refers(place.dialect, word.code);
            if self.references.len() > references || words.iter().any(is_jump) || place.names_jump() {
                self.references.truncate(references);
                self.refer(number, Target::Unclear, place.shift(&block.range));
            }
        }
    }

    fn refer(&mut self, block: u32, target: Target, range: Range<u32>) {
        self.references.push((block, Reference { target, range, program: 0 }));
    }

    fn add_code<'t>(&mut self, place: &Place<'_>, word: &Word, addresses: impl FnOnce() -> Addresses<'t>) {
        let control = place.dialect.control();
        let Some(code) = control.code_at(word.code) else { return };
        let entry = code.entry();
        if entry.ends == Some(Ends::Program) {
            self.ends.push(place.number);
        }
        if code.alias().is_some() {
            self.calls.push((place.number, None));
        }
        if !dialect_refers(place.dialect, word.code) {
            return;
        }
        let addresses = addresses();
        let is_call = entry.words.iter().any(|word| word.kind == WordKind::Program);
        for target in &entry.words {
            let Some(letter) = Letter::parse(&target.letter) else { continue };
            let Some(found) = addresses.first(letter) else { continue };
            let range = place.shift(&found.range());
            let is_shared = addresses.shared.contains(letter);
            if target.kind == WordKind::Program {
                self.calls.push((place.number, found.integer().filter(|_| !is_shared)));
            }
            if target.kind != WordKind::Label && !target.or_label {
                continue;
            }
            let digits = match found.value {
                Value::Number(_) => place.digits(&found.range()),
                Value::Expr(_) | Value::Missing => None,
            };
            let target = match place.number(digits) {
                None => Target::Computed,
                // Which of two codes reads the word is not for us to say.
                Some(_) if is_shared => Target::Other,
                Some(number) if target.or_label => Target::OwnOrProgram(number),
                Some(number) if !target.elsewhere => Target::Own(number),
                Some(number) if entry.ends == Some(Ends::Subprogram) => Target::Caller(number),
                // A block of this program or of the one that is called, where the code calls one.
                Some(number) if !is_call => Target::Own(number),
                Some(_) => Target::Other,
            };
            self.refer(place.number, target, range);
        }
    }
}

/// A block and everything needed to read it.
struct Place<'p> {
    table: &'p BlockTable,
    ix: BlockIx,
    block: &'p Block,
    /// The block's number in the file.
    number: u32,
    base: u32,
    /// Of the chunk.
    text: &'p str,
    dialect: &'p Dialect<'p>,
}

impl Place<'_> {
    fn shift(&self, range: &Range<u32>) -> Range<u32> {
        range.start + self.base..range.end + self.base
    }

    fn slice(&self, range: &Range<u32>) -> &str {
        self.text.get(range.start as usize..range.end as usize).unwrap_or_default()
    }

    /// The digits of a number that is written as plainly as can be, perhaps in brackets and with a point after it: bytes of
    /// the chunk in, bytes of the file out.
    fn digits(&self, range: &Range<u32>) -> Option<Range<u32>> {
        let text = self.slice(range);
        let start = text.find(|c: char| c.is_ascii_digit())?;
        let (front, rest) = text.split_at(start);
        let count = rest.bytes().take_while(u8::is_ascii_digit).count();
        let is_plain = |text: &str, allowed: &[char]| text.trim_matches(allowed).is_empty();
        let address = front.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let is_number = is_plain(address, &[' ', '\t', '['])
            && rest.get(count..).is_some_and(|tail| is_plain(tail, &[' ', '\t', ']', '.']));
        let start = self.base + range.start + start as u32;
        is_number.then_some(start..start + count as u32)
    }

    /// The number that these digits of the file write.
    fn number(&self, digits: Option<Range<u32>>) -> Option<Number> {
        let digits = digits?;
        let value = self.slice(&(digits.start - self.base..digits.end - self.base)).parse().ok()?;
        Some(Number { value, digits })
    }

    /// Does the operation read a variable that holds the number of a block?
    fn holds_number(&self, op: &Op) -> bool {
        let Op::Variable(number) = op else { return false };
        matches!(self.dialect.control().variable(*number), Variable::Known(entry) if entry.sequence_number)
    }

    /// Does the text of the block hold the word of a jump, comments taken for text as well?
    fn names_jump(&self) -> bool {
        let text = self.slice(&self.block.range).as_bytes();
        text.windows(4).any(|word| word.eq_ignore_ascii_case(b"GOTO"))
    }
}

/// The sequence number at the head of a block: `N10`, `O1234 N10`.
fn head(words: &[Word]) -> Option<&Word> {
    let is = |word: &&Word, letter: char| word.letter == Letter::of(letter);
    match words {
        [first, ..] if is(&first, 'N') => Some(first),
        [first, second, ..] if is(&first, 'O') && is(&second, 'N') => Some(second),
        _ => None,
    }
}

/// Does the code name a block or a program in one of its words?
fn dialect_refers(dialect: &Dialect<'_>, code: CodeIx) -> bool {
    dialect.control().code_at(code).is_some_and(|code| {
        code.entry().words.iter().any(|word| matches!(word.kind, WordKind::Label | WordKind::Program))
    })
}

/// Which words of a block its codes may refer with.
#[derive(Clone, Copy)]
struct Addresses<'t> {
    /// By address: its first word.
    first: [Option<&'t Word>; Letter::COUNT],
    /// Addresses that are twice, or that several codes of the block may read.
    shared: LetterSet,
}

impl<'t> Addresses<'t> {
    fn of(words: &'t [Word], dialect: &Dialect<'_>) -> Self {
        let mut first = [None; Letter::COUNT];
        let (mut shared, mut by_one, mut all) = (LetterSet::EMPTY, LetterSet::EMPTY, LetterSet::EMPTY);
        let mut by_users = 0_u32;
        for word in words {
            if !all.insert(word.letter) {
                shared.insert(word.letter);
            }
            if let Some(slot) = first.get_mut(word.letter.index()) {
                slot.get_or_insert(word);
            }
            let Some(code) = dialect.control().code_at(word.code) else { continue };
            // What a code of the shop reads nobody knows.
            by_users += u32::from(code.is_user());
            shared = shared.or(by_one.and(code.reads()));
            by_one = by_one.or(code.reads());
        }
        if by_users > 0 {
            shared = shared.or(by_one);
        }
        Self { first, shared }
    }

    fn first(&self, letter: Letter) -> Option<&'t Word> {
        self.first.get(letter.index()).copied().flatten()
    }
}
