//! Collecting an outline.
//!
//! Knows: block tables in order, and what of a block matters to control flow. Must not know: how pairs are made.

use std::ops::Range;

use gcheck_controls::{Control, Effect, Ends, Letter, LetterSet, SystemValue, WordKind};

use super::loops::LoopBuilder;
use super::o_words::OWordBuilder;
use super::{Chunk, NONE, Outline, Part};
use crate::block::{Block, BlockFlags, BlockIx, BlockTable, Value, Word};
use crate::expression::ExprIx;
use crate::lower::{Dialect, name_key};
use crate::statement::{Statement, StatementKind, Target};

/// A call names a program by its number, or by the last digits of a number whose first digits count repeats.
const PROGRAM_DIGITS: u32 = 10_000;

/// An [`Outline`] in the making: chunks are added in text order.
#[derive(Debug, Clone)]
pub struct OutlineBuilder {
    outline: Outline,
    loops: LoopBuilder,
    o_words: OWordBuilder,
    /// The program in front of the first program number has an end of its own.
    has_end: bool,
    /// Sequence numbers that are jumped to.
    jumps: Vec<u32>,
    /// Program numbers that are called.
    calls: Vec<u32>,
    has_computed_call: bool,
    /// Programs, by index, with a jump to a computed sequence number.
    computed: Vec<u32>,
    /// A subprogram may return to a computed sequence number of whatever program called it.
    has_computed_return: bool,
    /// Variables whose assignment is an alarm, known from the first chunk on.
    alarms: Option<Vec<Range<u32>>>,
}

impl Default for OutlineBuilder {
    fn default() -> Self {
        let part = Part { start: 0, head: NONE, number: NONE };
        Self {
            outline: Outline { parts: vec![part], ..Outline::default() },
            loops: LoopBuilder::default(),
            o_words: OWordBuilder::default(),
            has_end: false,
            jumps: Vec::new(),
            calls: Vec::new(),
            has_computed_call: false,
            computed: Vec::new(),
            has_computed_return: false,
            alarms: None,
        }
    }
}

impl OutlineBuilder {
    /// Adds the next chunk. `text` is the chunk's, `base` its offset in the file, `region_end` the end of the part of the file
    /// that the control reads; blocks that begin behind it are left out.
    pub fn add(&mut self, table: &BlockTable, base: u32, region_end: u32, text: &str, dialect: &Dialect<'_>) {
        let first = self.outline.blocks;
        self.outline.chunks.push(Chunk { first, base });
        let inside = table.blocks.partition_point(|b| base.saturating_add(b.range.start) < region_end);
        self.outline.blocks = first.saturating_add(inside as u32);
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
            if block.flags.intersects(interesting) {
                let number = first.saturating_add(ix.0);
                if block.flags.intersects(BlockFlags::LABEL | BlockFlags::PROGRAM_NUMBER | BlockFlags::ERROR)
                {
                    self.add_head(table, ix, block, number, text, dialect);
                }
                if block.flags.contains(BlockFlags::CODE) {
                    self.add_codes(table, block, number, dialect);
                }
                if block.flags.contains(BlockFlags::STATEMENT) {
                    let earlier = statements.iter().take_while(|(of, _)| *of < ix).count();
                    statements = statements.get(earlier..).unwrap_or_default();
                    for (_, statement) in statements.iter().take_while(|(of, _)| *of == ix) {
                        self.add_statement(table, statement, number, dialect);
                    }
                }
            }
        }
    }

    /// All chunks are added.
    pub fn finish(mut self) -> Outline {
        self.end_program();
        self.note_entries();
        let mut outline = self.outline;
        outline.loops = self.loops.finish();
        outline.o_words = self.o_words.finish();
        outline.labels.sort_unstable();
        outline.labels.shrink_to_fit();
        let parts = outline.parts.iter().zip(0u32..);
        outline.numbers = parts.filter(|(p, _)| p.number != NONE).map(|(p, ix)| (p.number, ix)).collect();
        outline.numbers.sort_unstable();
        outline.numbers.shrink_to_fit();
        outline.names.sort_unstable();
        outline.chunks.shrink_to_fit();
        outline.parts.shrink_to_fit();
        outline.flow.shrink();
        outline.marks.shrink();
        outline
    }

    /// Finds the labels that a jump may name and the heads that a call may name. Labels are in text order still.
    fn note_entries(&mut self) {
        for list in [&mut self.jumps, &mut self.calls, &mut self.computed] {
            list.sort_unstable();
            list.dedup();
        }
        let parts = &self.outline.parts;
        let is_called = |part: &Part| {
            let (number, packed) = (part.number, part.number % PROGRAM_DIGITS);
            self.has_computed_call
                || self.calls.iter().any(|call| *call == number || call % PROGRAM_DIGITS == packed)
        };
        // The first program begins where the file does, so its head is passed like any block, unless something calls it.
        // The others are only called or fallen into.
        let heads = parts.iter().enumerate().filter(|(ix, p)| *ix > 0 || is_called(p));
        let mut entries: Vec<u32> =
            heads.flat_map(|(_, p)| [p.start, p.head]).filter(|block| *block != NONE).collect();
        if self.has_computed_return || !self.jumps.is_empty() || !self.computed.is_empty() {
            let mut part = 0;
            for (number, block) in &self.outline.labels {
                while parts.get(part + 1).is_some_and(|next| next.start <= *block) {
                    part += 1;
                }
                if self.has_computed_return
                    || self.jumps.binary_search(number).is_ok()
                    || self.computed.binary_search(&(part as u32)).is_ok()
                {
                    entries.push(*block);
                }
            }
        }
        self.outline.entries.merge(entries);
    }

    fn end_program(&mut self) {
        self.loops.end_program();
        self.o_words.end_program();
    }

    fn part(&self) -> u32 {
        self.outline.parts.len().saturating_sub(1) as u32
    }

    /// A sequence or program number at the head of a block.
    fn add_head(
        &mut self,
        table: &BlockTable,
        ix: BlockIx,
        block: &Block,
        number: u32,
        text: &str,
        dialect: &Dialect<'_>,
    ) {
        // `N10 O1234` is as good a head as `O1234`.
        let words = table.words(block);
        let heads = words.iter().take_while(|w| w.letter == LABEL || w.letter == PROGRAM).take(2);
        for word in heads {
            if word.letter == PROGRAM {
                self.begin_program(number, word.integer().unwrap_or(NONE));
            } else if let Some(label) = word.integer() {
                self.outline.labels.push((label, number));
                self.outline.marks.push(number);
            }
        }
        // `O<NAME>` without keyword: a mistake in form to the grammar, a program's name where O-words are not known.
        if block.flags.contains(BlockFlags::ERROR) && !dialect.profile().o_words {
            let is_name = gcheck_syntax::SyntaxErrorKind::OWordWithoutKeyword;
            let error = table.errors(ix).find(|e| e.kind == is_name);
            let written = error.and_then(|e| text.get(e.range.start as usize..e.range.end as usize));
            let name = written.and_then(|w| Some(w.split_once('<')?.1.trim_end().trim_end_matches('>')));
            let is_head = error
                .is_some_and(|e| words.first().is_none_or(|w| w.start > e.range.start || w.letter == LABEL));
            if let Some(name) = name.filter(|_| is_head) {
                self.begin_program(number, NONE);
                let part = self.part();
                self.outline.names.push((name_key(name.as_bytes()), part));
            }
        }
    }

    fn begin_program(&mut self, head: u32, number: u32) {
        self.outline.marks.push(head);
        let is_second_head = self.outline.parts.last().is_some_and(|p| p.head == head);
        if is_second_head {
            return;
        }
        match self.outline.parts.as_mut_slice() {
            [first] if first.head == NONE && !self.has_end => {
                first.head = head;
                first.number = number;
            }
            _ => {
                self.end_program();
                self.outline.parts.push(Part { start: head, head, number });
            }
        }
    }

    fn add_codes(&mut self, table: &BlockTable, block: &Block, number: u32, dialect: &Dialect<'_>) {
        let words = table.words(block);
        let mut found = References::default();
        for word in words.iter().filter(|w| matches!(w.letter.ascii(), b'G' | b'M') && !w.letter.is_corner())
        {
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
        self.outline.flow.push(number);
        // `/M30` and `IF … M30` may be passed by, but they show that the program is meant to end here.
        self.has_end |= found.ends && self.outline.parts.len() == 1;
        for word in words {
            if found.labels.contains(word.letter) {
                self.jump(integer(table, word), found.returns);
            }
            if found.programs.contains(word.letter) {
                match integer(table, word) {
                    Some(program) => push_new(&mut self.calls, program),
                    None => self.has_computed_call = true,
                }
            }
        }
    }

    /// A jump to a sequence number, which is `None` when computed; `returns` when it may leave its program.
    fn jump(&mut self, target: Option<u32>, returns: bool) {
        match target {
            Some(number) => push_new(&mut self.jumps, number),
            None if returns => self.has_computed_return = true,
            None => {
                let part = self.part();
                push_new(&mut self.computed, part);
            }
        }
    }

    fn add_statement(
        &mut self,
        table: &BlockTable,
        statement: &Statement,
        number: u32,
        dialect: &Dialect<'_>,
    ) {
        let constant = |expr: Option<ExprIx>| expr.and_then(|e| table.constant(e)).and_then(whole);
        match &statement.kind {
            StatementKind::If { .. } | StatementKind::Guard { .. } => {}
            StatementKind::Goto { target } => self.jump(constant(*target), false),
            StatementKind::Do { number: loop_number, .. } => {
                self.outline.marks.push(number);
                self.loops.add(number, true, constant(*loop_number));
            }
            StatementKind::End { number: loop_number } => {
                self.outline.marks.push(number);
                self.loops.add(number, false, constant(*loop_number));
            }
            StatementKind::OWord { label, keyword, .. } => {
                self.outline.marks.push(number);
                self.o_words.add(number, *keyword, label);
            }
            StatementKind::Assign { target, .. } => {
                let alarms = self.alarms.get_or_insert_with(|| alarm_variables(dialect.control()));
                let is_alarm = match target {
                    Target::Variable(variable) => alarms.iter().any(|row| row.contains(variable)),
                    Target::Computed(_) => !alarms.is_empty(),
                    Target::Named(_) | Target::Invalid => false,
                };
                if !is_alarm {
                    return;
                }
            }
            StatementKind::Print => return,
        }
        self.outline.flow.push(number);
    }
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

/// A list without the same entry twice in a row, for loops of text that repeat one jump.
fn push_new(list: &mut Vec<u32>, entry: u32) {
    if list.last() != Some(&entry) {
        list.push(entry);
    }
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
