//! Loops of macros written out, turn by turn, with the values that their words had.
//!
//! Knows: which blocks of a loop a run executed, in which order. Must not know: how expressions are computed (the engine does).

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_controls::{Control, Effect, VariableKind, WordKind};
use gcheck_engine::{
    AbstractValue, At, Concrete, ConcreteValue, Look, Machine, Model, Program, State, Units,
};
use gcheck_program::{BlockFlags, OKeyword, Op, Place, StatementKind, Target, Value, Word};

use crate::facts::tool;
use crate::number::Hand;
use crate::refusal::Refusal;
use crate::scope::Scope;
use crate::sheet::Sheet;

/// Decimals of the value that a variable has after a loop.
const FINEST: usize = 9;
/// Lines that a loop may become.
const MOST_LINES: usize = 20_000;

/// The loops of a run. Has to see every block before it is executed.
pub(crate) struct Loops<'c> {
    scope: Scope,
    model: &'c Model<'c>,
    hand: Option<Hand>,
    /// Outermost loops: their first and last block.
    outermost: Vec<[u32; 2]>,
    under_way: Option<Turns>,
    done: BTreeMap<u32, Done>,
}

/// A loop that runs.
struct Turns {
    /// Its first and last block.
    blocks: [u32; 2],
    depth: usize,
    /// Assignments stay in each turn: a program that the loop calls may read them, or they act by themselves.
    keeps: bool,
    lines: Vec<String>,
    /// Variables that a turn has set, and whether that is certain: no condition decided it.
    set: BTreeMap<u32, bool>,
}

/// A loop that has run.
#[derive(Debug, Clone, PartialEq)]
struct Done {
    last: u32,
    lines: Vec<String>,
    /// Values that variables have after it.
    values: Vec<(u32, f64)>,
}

impl<'c> Loops<'c> {
    pub(crate) fn new(scope: &Scope, model: &'c Model<'c>) -> Self {
        Self {
            scope: scope.clone(),
            model,
            hand: None,
            outermost: Vec::new(),
            under_way: None,
            done: BTreeMap::new(),
        }
    }

    pub(crate) fn before(
        &mut self,
        program: &Program<'_>,
        machine: &Machine,
        at: At,
        place: &Place,
        state: &State<Concrete>,
    ) -> Result<(), Refusal> {
        self.prepare(program);
        let depth = state.call_depth();
        if let Some(turns) = &self.under_way {
            let [first, last] = turns.blocks;
            let is_inside = at.file == 0 && (first..=last).contains(&at.block) && depth >= turns.depth;
            if depth <= turns.depth && !is_inside {
                self.finish(program, state)?;
            } else if depth > turns.depth {
                return Ok(());
            }
        }
        if at.file != 0 {
            return Ok(());
        }
        let starts = place.range().start;
        if self.under_way.is_none()
            && let Some(blocks) = self.outermost.iter().find(|[first, _]| *first == at.block)
            && self.scope.selects(starts, tool(state))
        {
            let keeps = self.keeps_assignments(program, *blocks);
            self.under_way =
                Some(Turns { blocks: *blocks, depth, keeps, lines: Vec::new(), set: BTreeMap::new() });
        }
        if self.under_way.is_some() { self.turn(program, machine, at, place, state) } else { Ok(()) }
    }

    /// Looks for loops, once.
    fn prepare(&mut self, program: &Program<'_>) {
        if self.hand.is_some() {
            return;
        }
        let Some(file) = program.file(0) else { return };
        self.hand = Some(Hand::of(&file.loaded, program.dialect()));
        let mut open: Vec<u32> = Vec::new();
        let mut dos = 0_u32;
        for (number, place) in file.loaded.blocks_with(BlockFlags::STATEMENT, program.dialect()) {
            for statement in place.table.statements(place.ix) {
                let closes = match &statement.kind {
                    StatementKind::Do { .. } => false,
                    StatementKind::End { .. } => true,
                    StatementKind::OWord { keyword, .. } => match keyword {
                        OKeyword::Repeat => false,
                        OKeyword::EndWhile | OKeyword::EndRepeat => true,
                        OKeyword::Do => {
                            dos += 1;
                            false
                        }
                        OKeyword::While => {
                            let closes_do = dos > 0;
                            dos = dos.saturating_sub(1);
                            closes_do
                        }
                        _ => continue,
                    },
                    _ => continue,
                };
                if !closes {
                    open.push(number);
                } else if let Some(first) = open.pop()
                    && open.is_empty()
                {
                    self.outermost.push([first, number]);
                }
            }
        }
    }

    /// Do the assignments of a loop do more than count its turns and compute its words?
    fn keeps_assignments(&self, program: &Program<'_>, [first, last]: [u32; 2]) -> bool {
        let control = self.model.control();
        let Some(file) = program.file(0) else { return false };
        let mut places = (first..=last).filter_map(|number| file.loaded.place(number, program.dialect()));
        places.any(|place| {
            let mut words = place.table.words(place.block()).iter();
            let calls = words.any(|word| {
                control.code_at(word.code).is_some_and(|code| code.entry().any_words)
                    || matches!(
                        self.model.effect(word.code),
                        Effect::MacroCall | Effect::MacroModal | Effect::CallProgram | Effect::CallLocal
                    )
            });
            calls
                || place.table.statements(place.ix).any(|statement| match &statement.kind {
                    StatementKind::OWord { keyword, .. } => *keyword == OKeyword::Call,
                    StatementKind::Assign { target, .. } => match target {
                        Target::Variable(number) => control.variable_kind(*number) == VariableKind::System,
                        Target::Named(name) => is_global(program, &place, name),
                        Target::Computed(_) => true,
                        Target::Invalid => false,
                    },
                    _ => false,
                })
        })
    }

    /// Writes down a block of a loop with the values that it has in this turn.
    fn turn(
        &mut self,
        program: &Program<'_>,
        machine: &Machine,
        at: At,
        place: &Place,
        state: &State<Concrete>,
    ) -> Result<(), Refusal> {
        let refuse = |reason: &str, help: &str| Err(Refusal::at(place.range(), reason).help(help));
        let words = place.table.words(place.block());
        let flags = place.block().flags;
        let kinds: Vec<&StatementKind> =
            place.table.statements(place.ix).map(|statement| &statement.kind).collect();
        if kinds.iter().any(|kind| matches!(kind, StatementKind::Print | StatementKind::Command)) {
            return refuse("this block prints or commands something in each turn", "select lines without it");
        }
        let is_conditional =
            kinds.iter().any(|kind| matches!(kind, StatementKind::If { .. } | StatementKind::Guard { .. }));
        let says = words.iter().any(|word| word.letter.ascii() != b'N');
        if says && (is_conditional || flags.intersects(BlockFlags::BLOCK_DELETE)) {
            return refuse(
                "whether this block acts is decided in each turn by a condition or by block delete",
                "write the condition as a jump over the block",
            );
        }
        let keeps = self.under_way.as_ref().is_some_and(|turns| turns.keeps);
        let assigns = kinds.iter().any(|kind| matches!(kind, StatementKind::Assign { .. }));
        if keeps && assigns && is_conditional {
            return refuse(
                "a condition decides in each turn whether this block sets its variable",
                "write the condition as a jump over the block",
            );
        }
        if let Some(turns) = &mut self.under_way {
            for kind in &kinds {
                if let StatementKind::Assign { target: Target::Variable(number), .. } = kind {
                    *turns.set.entry(*number).or_default() |= !is_conditional;
                }
            }
        }
        let mut kept = Vec::new();
        for statement in place.table.statements(place.ix).filter(|_| keeps) {
            if let (StatementKind::Assign { .. }, Some(file)) = (&statement.kind, program.file(0)) {
                let in_file = place.base + statement.range.start..place.base + statement.range.end;
                kept.push(file.loaded.slice(in_file).trim().to_owned());
            }
        }
        let is_comment = flags.contains(BlockFlags::COMMENT) && words.is_empty() && kinds.is_empty();
        if !says && !is_comment {
            return self.add(kept, place);
        }
        let Some(line) = self.line(program, machine, at, place, state, !kinds.is_empty()) else {
            return refuse("a word of this block has no value that is known", "give values with --set");
        };
        // The words of a block count with the values from before its assignments.
        kept.insert(0, line);
        self.add(kept, place)
    }

    /// Adds lines to the loop that runs.
    fn add(&mut self, lines: Vec<String>, place: &Place) -> Result<(), Refusal> {
        let Some(turns) = &mut self.under_way else { return Ok(()) };
        turns.lines.extend(lines);
        if turns.lines.len() > MOST_LINES {
            let reason = format!("the loop would become more than {MOST_LINES} lines");
            return Err(Refusal::at(place.range(), reason).help("select another loop"));
        }
        Ok(())
    }

    /// A block as a line without variables.
    fn line(
        &self,
        program: &Program<'_>,
        machine: &Machine,
        at: At,
        place: &Place,
        state: &State<Concrete>,
        words_alone: bool,
    ) -> Option<String> {
        let file = program.file(0)?;
        let mut values = Vec::new();
        if place.block().flags.contains(BlockFlags::EXPRESSION) {
            let mut look = Look::new(program, self.model, machine);
            values = look.expressions(at, &state.as_abstract());
        }
        let block = place.range();
        let words = place.table.words(place.block());
        let is_row = state.reads_as_row(place.block().flags);
        let (mut out, mut from) = (String::new(), block.start);
        for word in words {
            let range = Sheet::range(place, word);
            if !words_alone {
                out.push_str(file.loaded.slice(from..range.start));
            } else if !out.is_empty() {
                out.push_str(self.hand?.gap());
            }
            from = range.end;
            // `N` of a row of data is not the number of a block.
            if word.letter.ascii() == b'N' && !is_row {
                continue;
            }
            match word.value {
                Value::Expr(expr) => {
                    let expr = place.table.expr(expr).range.clone();
                    let expr = place.base + expr.start..place.base + expr.end;
                    let value = values.iter().find(|(other, _)| *other == expr);
                    let Some((_, AbstractValue::Number(number))) = value else { return None };
                    let old = file.loaded.slice(range);
                    out.push_str(&self.word(old, word, *number, state.units(self.model), is_row)?);
                }
                _ => out.push_str(file.loaded.slice(range)),
            }
        }
        if !words_alone {
            out.push_str(file.loaded.slice(from..block.end));
        }
        Some(out.trim().to_owned())
    }

    /// A word with a value.
    fn word(
        &self,
        old: &str,
        word: &Word,
        number: f64,
        units: Option<Units>,
        is_row: bool,
    ) -> Option<String> {
        let control = self.model.control();
        let kind = control.letter(word.letter).map(|entry| entry.kind).filter(|_| !is_row);
        let has_point =
            matches!(kind, Some(WordKind::Length | WordKind::Angle | WordKind::Feed | WordKind::Real));
        let hand = self.hand?;
        let form = if has_point { hand.form(control) } else { "1" };
        let least = if units == Some(Units::Inch) { 4 } else { 3 };
        let head: String = old.chars().take_while(|c| c.is_ascii_alphabetic() || *c == ',').collect();
        Some(format!("{head}{}", hand.write(form, number, least)))
    }

    /// Ends the loop that runs.
    fn finish(&mut self, program: &Program<'_>, state: &State<Concrete>) -> Result<(), Refusal> {
        let Some(turns) = self.under_way.take() else { return Ok(()) };
        let [first, last] = turns.blocks;
        let refusal = |reason: String, help: &str| {
            let place = program.file(0).and_then(|file| file.loaded.place(first, program.dialect()));
            Refusal::at(place.map_or(0..0, |place| place.range()), reason).help(help)
        };
        let values = if turns.keeps {
            Vec::new()
        } else {
            left(program, self.model.control(), &turns, state)
                .map_err(|reason| refusal(reason, "unroll only loops whose variables nothing else reads"))?
        };
        let new = Done { last, lines: turns.lines, values };
        if self.done.get(&first).is_some_and(|old| *old != new) {
            let reason = "this loop runs more than once, each time in another way".to_owned();
            return Err(refusal(reason, "select another loop"));
        }
        self.done.insert(first, new);
        Ok(())
    }

    /// Writes the turns in the place of the loops.
    pub(crate) fn write(&self, sheet: &mut Sheet<'_, '_>, number: u32, place: &Place, program: &Program<'_>) {
        let Some(done) = self.done.get(&number) else { return };
        let Some(last) = sheet.loaded.place(done.last, program.dialect()) else { return };
        let mut lines = done.lines.clone();
        for (variable, value) in &done.values {
            lines.push(format!("#{variable}={}", sheet.hand.write("1.", *value, FINEST)));
        }
        let text = lines.join(sheet.line_end());
        sheet.replace(place.range().start..last.range().end, text);
    }
}

/// Is a named parameter one of all programs, as LinuxCNC writes them: `#<_name>`?
fn is_global(program: &Program<'_>, place: &Place, name: &Range<u32>) -> bool {
    let in_file = place.base + name.start..place.base + name.end;
    program.file(0).is_some_and(|file| file.loaded.slice(in_file).trim_start().starts_with('_'))
}

/// The values that a loop leaves to blocks outside of it, and to programs that run later.
fn left(
    program: &Program<'_>,
    control: &Control,
    turns: &Turns,
    state: &State<Concrete>,
) -> Result<Vec<(u32, f64)>, String> {
    let Some(file) = program.file(0) else { return Ok(Vec::new()) };
    let [first, last] = turns.blocks;
    let mut read: Vec<u32> = Vec::new();
    let (mut reads_any, mut names) = (false, false);
    for (number, place) in file
        .loaded
        .blocks_with(BlockFlags::STATEMENT | BlockFlags::EXPRESSION | BlockFlags::CODE, program.dialect())
    {
        let is_inside = (first..=last).contains(&number);
        if is_inside {
            let is_named = |kind: &StatementKind| matches!(kind, StatementKind::Assign { target, .. } if !matches!(target, Target::Variable(_)));
            names |= place.table.statements(place.ix).any(|statement| is_named(&statement.kind));
            continue;
        }
        for expr in place.expressions() {
            for op in place.table.ops(place.table.expr(expr)) {
                match op {
                    Op::Variable(variable) => read.push(*variable),
                    Op::Indirect | Op::Named { .. } => reads_any = true,
                    _ => {}
                }
            }
        }
    }
    if names && reads_any {
        return Err("this loop sets a parameter by name or by a computed number, and blocks outside of it may read that".to_owned());
    }
    let outlives = |variable: u32| control.variable_kind(variable) != VariableKind::Local;
    let is_left = |variable: u32| reads_any || outlives(variable) || read.contains(&variable);
    let value = |(variable, is_certain): (u32, bool)| {
        let local = state.local(variable).copied();
        let is_set = is_certain || local.is_some() || state.variables().is_written(variable);
        match local.unwrap_or_else(|| state.variables().get(variable)) {
            ConcreteValue::Number(number) => Ok(Some((variable, number))),
            // The condition of the assignment never held.
            _ if !is_set => Ok(None),
            _ => Err(format!("the value that this loop leaves in #{variable} is not known")),
        }
    };
    let set = turns.set.iter().map(|(variable, is_certain)| (*variable, *is_certain));
    set.filter(|(variable, _)| is_left(*variable)).filter_map(|set| value(set).transpose()).collect()
}
