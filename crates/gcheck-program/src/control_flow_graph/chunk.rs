//! What one chunk adds to the flow graph of its file.
//!
//! Knows: what of a block matters to control flow. Must not know: other chunks, where in the file this one is, how pairs
//! are made.

use std::hash::Hasher;
use std::ops::Range;

use gcheck_controls::{Control, Effect, Ends, Letter, LetterSet, SystemValue, WordKind};
use rustc_hash::FxHasher;

use super::link::NONE;
use crate::block::{Block, BlockFlags, BlockIx, BlockTable, Value, Word};
use crate::expression::ExprIx;
use crate::lower::{Dialect, name_key};
use crate::statement::{OKeyword, OLabel, Statement, StatementKind, Target};

/// Something about a block that an flow graph collects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Item {
    /// A sequence number.
    Label(u32),
    /// The head of a program: its number or [`NONE`].
    Program(u32),
    /// The head of a program by its name.
    Name(String),
    /// The block may decide which block is next.
    Flow,
    /// A code that ends a program or subprogram.
    Ends,
    /// A jump to a sequence number, `None` when computed; `returns` when it may leave its program.
    Jump { target: Option<u32>, returns: bool },
    /// A call of a program; `None` when computed.
    Call(Option<u32>),
    /// `DO` or `END`.
    Loop { begins: bool, number: Option<u32> },
    /// An O-word.
    OWord { keyword: OKeyword, label: OLabel },
}

/// What one chunk adds to the flow graph of its file. Blocks are numbered from the chunk's first.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ChunkFlow {
    pub(super) blocks: u32,
    /// Block and sequence number, in text order: a list of their own, because a program may have one in every block.
    pub(super) labels: Vec<(u32, u32)>,
    /// In text order.
    pub(super) items: Vec<(u32, Item)>,
    skeleton: Skeleton,
}

/// What the text alone decides of the control flow, as numbers that are equal when it is the same. Its place is left
/// aside: blocks that decide nothing may come and go between.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Skeleton {
    /// Blocks that decide on the way, as they are written.
    ways: Sequence,
    /// Sequence numbers.
    labels: Sequence,
    /// There is a jump or a call, so that sequence numbers matter.
    refers: bool,
}

impl Skeleton {
    /// Adds what is after.
    pub fn join(&mut self, next: &Self) {
        self.ways.join(next.ways);
        self.labels.join(next.labels);
        self.refers |= next.refers;
    }

    /// Is the control flow the same?
    pub fn is_as(&self, other: &Self) -> bool {
        let same_labels = self.labels == other.labels || !self.refers;
        self.ways == other.ways && self.refers == other.refers && same_labels
    }
}

/// A sequence of things, as a number that does not depend on how the sequence is cut.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Sequence {
    len: u64,
    hash: u64,
}

impl Sequence {
    /// Odd, and without pattern.
    const FACTOR: u64 = 0x9E37_79B9_7F4A_7C15;

    fn push(&mut self, hash: u64) {
        self.join(Self { len: 1, hash });
    }

    fn join(&mut self, next: Self) {
        let (mut power, mut factor, mut left) = (1_u64, Self::FACTOR, next.len);
        while left > 0 {
            if left & 1 == 1 {
                power = power.wrapping_mul(factor);
            }
            factor = factor.wrapping_mul(factor);
            left >>= 1;
        }
        self.hash = self.hash.wrapping_mul(power).wrapping_add(next.hash);
        self.len += next.len;
    }
}

impl ChunkFlow {
    /// Of a chunk's blocks; those that begin at `end` or after it, in bytes of the chunk, are left out.
    pub fn new(table: &BlockTable, end: u32, text: &str, dialect: &Dialect<'_>) -> Self {
        let inside = table.blocks.partition_point(|b| b.range.start < end);
        let mut part = Self { blocks: inside as u32, ..Self::default() };
        let mut told = None;
        scan(table, inside, text, dialect, &mut None, &mut |block, item| {
            if let Item::Label(number) = item {
                part.labels.push((block, number));
                part.skeleton.labels.push(mixed(&number.to_le_bytes()));
                return;
            }
            part.skeleton.refers |= matches!(item, Item::Jump { .. } | Item::Call(_) | Item::OWord { .. });
            if told.replace(block) != Some(block) {
                let range = table.blocks.get(block as usize).map_or(0..0, |b| b.range.clone());
                let written = text.get(range.start as usize..range.end as usize).unwrap_or_default();
                part.skeleton.ways.push(mixed(written.as_bytes()));
            }
            part.items.push((block, item));
        });
        for block in table.blocks.iter().take(inside) {
            if block.flags.contains(BlockFlags::TAPE_MARK) {
                part.skeleton.ways.push(mixed(b"%"));
            }
        }
        part.labels.shrink_to_fit();
        part.items.shrink_to_fit();
        part
    }

    /// How many blocks the chunk has in the part of the file that the control reads.
    pub fn blocks(&self) -> u32 {
        self.blocks
    }

    /// What it decides of the control flow.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }
}

fn mixed(bytes: &[u8]) -> u64 {
    let mut hasher = FxHasher::default();
    hasher.write(bytes);
    hasher.write_usize(bytes.len());
    hasher.finish()
}

/// Shows `take` everything about the first `inside` blocks that an flow graph collects, with the number of the block.
pub(super) fn scan(
    table: &BlockTable,
    inside: usize,
    text: &str,
    dialect: &Dialect<'_>,
    alarms: &mut Option<Vec<Range<u32>>>,
    take: &mut dyn FnMut(u32, Item),
) {
    let interesting = BlockFlags::CODE
        | BlockFlags::LABEL
        | BlockFlags::PROGRAM_NUMBER
        | BlockFlags::STATEMENT
        | BlockFlags::ERROR;
    let mut statements = table.statements.as_slice();
    if !table.flags().intersects(interesting) {
        return;
    }
    for (ix, block) in table.blocks().take(inside) {
        if !block.flags.intersects(interesting) {
            continue;
        }
        if block.flags.intersects(BlockFlags::LABEL | BlockFlags::PROGRAM_NUMBER | BlockFlags::ERROR) {
            head(table, ix, block, text, dialect, take);
        }
        if block.flags.contains(BlockFlags::CODE) {
            codes(table, ix, block, dialect, take);
        }
        if block.flags.contains(BlockFlags::STATEMENT) {
            let earlier = statements.iter().take_while(|(of, _)| *of < ix).count();
            statements = statements.get(earlier..).unwrap_or_default();
            for (_, found) in statements.iter().take_while(|(of, _)| *of == ix) {
                statement(table, ix, found, dialect, alarms, take);
            }
        }
    }
}

/// A sequence or program number at the head of a block.
fn head(
    table: &BlockTable,
    ix: BlockIx,
    block: &Block,
    text: &str,
    dialect: &Dialect<'_>,
    take: &mut dyn FnMut(u32, Item),
) {
    // `N10 O1234` is as good a head as `O1234`.
    let words = table.words(block);
    let heads = words.iter().take_while(|w| w.letter == LABEL || w.letter == PROGRAM).take(2);
    for word in heads {
        if word.letter == PROGRAM {
            take(ix.0, Item::Program(word.integer().unwrap_or(NONE)));
        } else if let Some(label) = word.integer() {
            take(ix.0, Item::Label(label));
        }
    }
    // `O<NAME>` without keyword: a mistake in form to the grammar, a program's name where O-words are not known.
    if block.flags.contains(BlockFlags::ERROR) && !dialect.profile().o_words {
        let is_name = gcheck_syntax::SyntaxErrorKind::OWordWithoutKeyword;
        let error = table.errors(ix).find(|e| e.kind == is_name);
        let written = error.and_then(|e| text.get(e.range.start as usize..e.range.end as usize));
        let name = written.and_then(|w| Some(w.split_once('<')?.1.trim_end().trim_end_matches('>')));
        let is_head =
            error.is_some_and(|e| words.first().is_none_or(|w| w.start > e.range.start || w.letter == LABEL));
        if let Some(name) = name.filter(|_| is_head) {
            take(ix.0, Item::Name(name_key(name.as_bytes())));
        }
    }
}

fn codes(
    table: &BlockTable,
    ix: BlockIx,
    block: &Block,
    dialect: &Dialect<'_>,
    take: &mut dyn FnMut(u32, Item),
) {
    let words = table.words(block);
    let mut found = References::default();
    for word in words.iter().filter(|w| matches!(w.letter.ascii(), b'G' | b'M') && !w.letter.is_corner()) {
        // `M#1` may be any code.
        found.is_flow |= matches!(word.value, Value::Expr(_));
        let Some(code) = dialect.control().code_at(word.code) else { continue };
        let entry = code.entry();
        if entry.ends.is_none() && !dialect.refers(word.code) && !leads_elsewhere(code.effect()) {
            continue;
        }
        found.is_flow = true;
        found.ends |= entry.ends.is_some();
        found.returns |= entry.ends == Some(Ends::Subprogram);
        for target in &entry.words {
            let Some(letter) = Letter::parse(&target.letter) else { continue };
            match target.kind {
                WordKind::Label => found.labels.insert(letter),
                WordKind::Program => found.programs.insert(letter),
                _ => continue,
            };
        }
    }
    if !found.is_flow {
        return;
    }
    take(ix.0, Item::Flow);
    if found.ends {
        take(ix.0, Item::Ends);
    }
    for word in words {
        if found.labels.contains(word.letter) {
            take(ix.0, Item::Jump { target: integer(table, word), returns: found.returns });
        }
        if found.programs.contains(word.letter) {
            take(ix.0, Item::Call(integer(table, word)));
        }
    }
}

fn statement(
    table: &BlockTable,
    ix: BlockIx,
    statement: &Statement,
    dialect: &Dialect<'_>,
    alarms: &mut Option<Vec<Range<u32>>>,
    take: &mut dyn FnMut(u32, Item),
) {
    let constant = |expr: Option<ExprIx>| expr.and_then(|e| table.constant(e)).and_then(whole);
    match &statement.kind {
        StatementKind::If { .. } | StatementKind::Guard { .. } => {}
        StatementKind::Goto { target } => {
            take(ix.0, Item::Jump { target: constant(*target), returns: false });
        }
        StatementKind::Do { number, .. } => {
            take(ix.0, Item::Loop { begins: true, number: constant(*number) });
        }
        StatementKind::End { number } => {
            take(ix.0, Item::Loop { begins: false, number: constant(*number) });
        }
        StatementKind::OWord { label, keyword, .. } => {
            take(ix.0, Item::OWord { keyword: *keyword, label: label.clone() });
        }
        StatementKind::Assign { target, .. } => {
            let alarms = alarms.get_or_insert_with(|| alarm_variables(dialect.control()));
            let is_alarm = match target {
                Target::Variable(variable) => alarms.iter().any(|row| row.contains(variable)),
                Target::Computed(_) => !alarms.is_empty(),
                Target::Named(_) | Target::Invalid => false,
            };
            if !is_alarm {
                return;
            }
        }
        StatementKind::Print | StatementKind::Command => return,
    }
    take(ix.0, Item::Flow);
}

const LABEL: Letter = Letter::of('N');
const PROGRAM: Letter = Letter::of('O');

/// What the codes of a block refer to.
#[derive(Debug, Clone, Default)]
struct References {
    is_flow: bool,
    ends: bool,
    returns: bool,
    /// Addresses that name sequence numbers.
    labels: LetterSet,
    /// Addresses that name programs.
    programs: LetterSet,
}

/// Does a code of this effect decide which block is next, even if its entry names neither label nor program?
fn leads_elsewhere(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::MacroCall
            | Effect::MacroModal
            | Effect::CallProgram
            | Effect::CallLocal
            | Effect::Return
            | Effect::JumpUnlessInput
            | Effect::ProgramEnd
    )
}

/// Rows of variables whose assignment ends the program with an alarm.
fn alarm_variables(control: &Control) -> Vec<Range<u32>> {
    let variables = control.semantics().system_variables.iter();
    let alarms = variables.filter(|v| v.holds == SystemValue::Alarm);
    alarms.filter_map(|v| Some(v.first?..v.first?.saturating_add(v.count))).collect()
}

/// A word's value when it is a whole number that needs no evaluation: `P10`, `P[10]`.
fn integer(table: &BlockTable, word: &Word) -> Option<u32> {
    match word.value {
        Value::Number(_) => word.integer(),
        Value::Expr(expr) => table.constant(expr).and_then(whole),
        Value::Missing => None,
    }
}

#[expect(clippy::cast_sign_loss, reason = "the range is checked")]
fn whole(value: f64) -> Option<u32> {
    ((0.0..=f64::from(u32::MAX)).contains(&value) && value.fract() == 0.0).then_some(value as u32)
}
