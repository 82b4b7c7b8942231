//! One block, one step: the only place where a block changes a state.
//!
//! Knows: the order inside a block, statements, and which effect handler a code calls. Must not know: which domain it runs in,
//! how paths are explored.

mod along_tool;
mod arc;
pub(crate) mod bar;
pub(crate) mod compensation;
pub(crate) mod contract;
pub(crate) mod corner;
mod cycle;
mod cylinder;
mod effects;
mod flow_control;
mod lathe;
pub(crate) mod look;
mod message;
mod modes;
mod motion;
mod o_words;
mod offsets;
mod operation;
mod order;
pub(crate) mod past_alarm;
pub(crate) mod plain;
mod probe;
mod program_end;
mod reference;
mod spindle;
mod system;
mod tool_shift;
mod transform;

use std::rc::Rc;

use gcheck_controls::{Access, CodeIx, Effect, Letter, LetterSet, SystemValue, Unpointed, Unset, WordKind};
use gcheck_program::{
    BinaryOp, Block, BlockFlags, BlockTable, Expr, ExprIx, Function, OLabel, Op, Place, StatementKind,
    Target, Value, Word,
};
use rustc_hash::FxHashMap;

use self::order::{Action, Parts};
use crate::assumption::{Assumption, Assumptions, Unsettled};
use crate::cycles::Stroke;
use crate::event::{Event, Units};
use crate::fault::{Fault, ValueFault};
use crate::lattice::Lattice;
use crate::machine::Machine;
use crate::model::{Model, Role};
use crate::observer::Observer;
use crate::origin::{At, Origin, origin_of};
use crate::program::{Program, ProgramFile};
use crate::state::{NameId, State, Variable};
use crate::value::{Domain, Truth};
use crate::words::BlockWords;

/// Switches of the operator's panel, and how far a run goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(clippy::struct_excessive_bools, reason = "independent switches")]
pub struct Options {
    /// Block delete by level 1 to 9: a bit that is set skips the level's blocks. Bit 0 stands for a plain `/`.
    pub skip: u16,
    /// `M1` stops.
    pub optional_stop: bool,
    /// A run goes on after a fault as the programmer would after correcting it, and where it cannot decide a condition.
    pub past_alarms: bool,
    /// What nobody can know is taken as it most likely is, for people who look at a path: a program that is not here leaves
    /// everything as it was, and a probe touches at its target.
    pub assumes: bool,
    /// A program that is not here leaves what this one has set as it was: modes, the tool with its offsets, the spindle, the
    /// coolant, the feed. Where the axes are, and what variables hold, stays unknown after it.
    pub keeps_what_was_set: bool,
}

impl Options {
    /// Nothing is skipped.
    pub const NONE: Self =
        Self { skip: 0, optional_stop: false, past_alarms: false, assumes: false, keeps_what_was_set: false };
    /// A path to be looked at: past alarms, with assumptions for what nobody can know.
    pub const PICTURE: Self = Self { past_alarms: true, assumes: true, ..Self::NONE };
    /// Every `/` block is skipped.
    pub const SKIP_ALL: Self = Self { skip: u16::MAX, ..Self::NONE };

    fn skips(self, level: u8) -> bool {
        level > 0 && self.skip & (1 << (level - 1).min(15)) != 0
    }
}

/// What comes after a block.
#[derive(Debug)]
pub(crate) enum Outcome<D: Domain> {
    /// The next block in text order.
    Next,
    /// Another block.
    Jump(At),
    /// Any of these: a condition or target is not known.
    Fork(Vec<(At, State<D>)>),
    /// The program is over.
    End(Ending),
    /// The block cannot be executed.
    Fault(Fault),
}

/// How a program came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Ending {
    /// `M2` or `M30`.
    Program,
    /// `M99` in the main program: it would start again.
    Restart,
    /// A closing `%`.
    Tape,
    /// The text ended without an end of the program.
    Text,
    /// `#3000`.
    Alarm(i64),
    /// The bar feeder has no bar left, or has made as many parts as it was told to.
    BarsUsed,
}

pub(crate) type Step<T = ()> = Result<T, Fault>;

/// Executes blocks. Holds what does not belong to the state: the program, the control, the machine, who watches.
#[expect(clippy::struct_excessive_bools, reason = "independent facts of the block under way and of the run")]
pub(crate) struct Executor<'a, 'p, D: Domain, O: Observer<D>> {
    pub(crate) program: &'a Program<'p>,
    pub(crate) model: &'a Model<'a>,
    pub(crate) machine: &'a Machine,
    pub(crate) options: Options,
    pub(crate) observer: O,
    pub(crate) assumptions: Assumptions,
    /// How a number without decimal point counts: settled once.
    unpointed: Unpointed,
    stack: Vec<D::Value>,
    words: BlockWords<D>,
    cursor: Option<Cursor<'p>>,
    /// The block under way.
    origin: Origin,
    /// Where to go when every phase of the block is done.
    flow: Option<Flow<D>>,
    /// `G53`, `G9` and the like: what holds for this block only.
    machine_coordinates: bool,
    /// Goes on after what the control refuses, as an analysis does that looks for more than one mistake.
    pub(crate) lenient: bool,
    /// What was refused in the block under way.
    refused: Option<Fault>,
    /// What went before the block under way, where execution goes on past alarms.
    before: Option<past_alarm::Before>,
    /// Moves given out so far, but those of compensated paths.
    moves: u64,
    /// The line to where a refused move leads, to be given out when the observer has been told of the alarm.
    bridge: Option<Event>,
    /// The state in which a part of the block was refused first, where execution goes on past alarms.
    at_fault: Option<Box<State<D>>>,
    /// What was refused in a block that leads elsewhere all the same, where execution goes on past alarms.
    pub(crate) refused_in_passing: Option<Fault>,
    /// The operation under way passes its points exactly though blending is on.
    passes_exactly: bool,
    /// A code of the block made the control forget the rest of it.
    rest_is_lost: bool,
    /// Subroutines passed over, and whether another is defined inside.
    nested: FxHashMap<At, bool>,
    /// Blocks that may open lines of data, and whether a later one ends them.
    rows_end: FxHashMap<At, bool>,
    /// The state at the start of the main program, once it was asked for.
    start: Option<Box<State<D>>>,
    /// By file, subroutine and label: the O-word block that opened a structure first. Of a subroutine's own label no
    /// subroutine is told.
    #[expect(
        clippy::option_option,
        reason = "no subroutine is one thing, the one without a block of its own another"
    )]
    labels_defined: FxHashMap<(u32, Option<Option<u32>>, OLabel), u32>,
    /// Labels of O-words, by file, where some are computed.
    o_labels: FxHashMap<u32, Rc<o_words::OLabels>>,
    /// Names that assignments of the block brought into being, each with where its assignment begins in the chunk.
    created: Vec<(NameId, u32)>,
    /// Room for the strokes of a hole.
    stroke_buffer: Vec<Stroke>,
    /// Assignments that wait for the end of the block.
    pending: Vec<(Assignee, D::Value)>,
    /// Words of the block that begin before this byte of its chunk have acted; `None` until some may have.
    acted_to: Option<u32>,
    /// The words that are read belong to a block after the one under way.
    looks_ahead: bool,
    /// Variables that were written, and whether the control lets programs do that.
    writable: FxHashMap<u32, bool>,
    /// Bar feeds so far.
    pub(crate) bar_feeds: u64,
    /// Events that were given out so far, those that compensation holds back among them.
    pub(crate) events: u64,
    /// Strokes of cycles that were given out so far.
    strokes_given: u64,
    /// Those that were given out before the block under way.
    strokes_before: u64,
}

/// What an assignment writes to.
#[derive(Debug, Clone, Copy)]
enum Assignee {
    Number(u32),
    Name(NameId),
    /// A variable of unknown number.
    Anywhere,
}

/// A way on that a code asked for.
#[derive(Debug, Clone)]
enum Flow<D: Domain> {
    Jump(At),
    Call(flow_control::Callee<D>),
    Return {
        label: Option<D::Value>,
    },
    /// To the macro that is called after every move.
    ModalCall,
    /// Here or on, as an input decides.
    MayJump(At),
    End(Ending),
}

/// The chunk that execution is in, so that the next block costs no look-up.
#[derive(Clone)]
struct Cursor<'a> {
    file_index: u32,
    file: Rc<ProgramFile<'a>>,
    place: Place,
    /// Number of the chunk's first block in the file.
    first: u32,
}

impl<'a, 'p, D: Domain, O: Observer<D>> Executor<'a, 'p, D, O> {
    pub(crate) fn new(
        program: &'a Program<'p>,
        model: &'a Model<'a>,
        machine: &'a Machine,
        options: Options,
        observer: O,
    ) -> Self {
        let mut assumptions = Assumptions::default();
        let unpointed = settle_unpointed(model, machine, &mut assumptions);
        Self {
            program,
            model,
            machine,
            options,
            observer,
            assumptions,
            unpointed,
            stack: Vec::with_capacity(16),
            words: BlockWords::new(),
            cursor: None,
            origin: Origin::NONE,
            flow: None,
            machine_coordinates: false,
            lenient: false,
            refused: None,
            before: None,
            moves: 0,
            bridge: None,
            at_fault: None,
            refused_in_passing: None,
            passes_exactly: false,
            rest_is_lost: false,
            nested: FxHashMap::default(),
            rows_end: FxHashMap::default(),
            start: None,
            labels_defined: FxHashMap::default(),
            o_labels: FxHashMap::default(),
            created: Vec::new(),
            stroke_buffer: Vec::new(),
            pending: Vec::new(),
            acted_to: None,
            looks_ahead: false,
            writable: FxHashMap::default(),
            bar_feeds: 0,
            events: 0,
            strokes_given: 0,
            strokes_before: 0,
        }
    }

    /// The block under way, or the last one.
    pub(crate) fn origin(&self) -> Origin {
        self.origin
    }

    /// Executes the block at `at`.
    pub(crate) fn step(&mut self, at: At, state: &mut State<D>) -> Outcome<D> {
        let Some(place) = self.place(at) else { return self.end_of_text(at, state) };
        let table = &*place.table;
        let block = table.block(place.ix);
        self.strokes_before = self.strokes_given;
        self.origin = origin_of(at, &place);
        if block.flags.contains(BlockFlags::LABEL) {
            let n = table.words(block).iter().find(|word| word.letter == Letter::of('N'));
            #[expect(
                clippy::cast_sign_loss,
                reason = "negative numbers become 0, as a label cannot be negative"
            )]
            {
                self.origin.n = n.and_then(Word::number).map(|n| n as u32);
            }
        }
        if block.flags.contains(BlockFlags::BLOCK_DELETE) {
            let skipped = self.options.skips(block.delete);
            if block.delete > 0 {
                self.assumptions.insert(Assumption::BlockSkip(skipped));
            }
            if skipped {
                return Outcome::Next;
            }
        }
        if block.flags.contains(BlockFlags::TAPE_MARK) {
            return if self.opens_tape(at, block) { Outcome::Next } else { Outcome::End(Ending::Tape) };
        }
        self.observer.before(self.origin, state);
        self.flow = None;
        self.machine_coordinates = false;
        self.pending.clear();
        self.created.clear();
        self.acted_to = None;
        if self.lenient {
            self.before = Some(self.before_block(state));
            (self.bridge, self.at_fault) = (None, None);
        }
        let outcome = self.run_block(&place, table, block, state);
        if !matches!(outcome, Outcome::Fault(_)) {
            self.observer.after(self.origin, state);
        }
        outcome
    }

    /// Is this `%` the opening one? What the control reads ends with the closing one, and a note may stand in front of the
    /// opening one: `(PART 12)`.
    fn opens_tape(&self, at: At, block: &Block) -> bool {
        let is_last = |file: &ProgramFile<'_>| at.block + 1 >= file.loaded.flow_graph().blocks();
        let closes = self.program.file(at.file).is_none_or(|file| is_last(&file));
        at.block == 0 || block.letters.is_empty() && !closes
    }

    fn run_block(
        &mut self,
        place: &Place,
        table: &BlockTable,
        block: &Block,
        state: &mut State<D>,
    ) -> Outcome<D> {
        let mut refused = None;
        if block.flags.contains(BlockFlags::ERROR) && table.errors(place.ix).next().is_some() {
            refused = Some(Fault::Malformed);
        } else if block.flags.intersects(FORM)
            && let Err(fault) = self.check_form(place, table.words(block), block)
        {
            refused = Some(fault);
        }
        if let Some(fault) = refused {
            // Nobody knows what a remark without its parentheses is to do.
            if !self.lenient || block.flags.contains(BlockFlags::REMARK) {
                return Outcome::Fault(fault);
            }
            self.refused = Some(fault);
        }
        let outcome = self.run_parts(place, table, block, state);
        match (self.refused.take(), outcome) {
            // The first thing wrong with a block is what the control stops for; what the block means to do is done all the same.
            (Some(fault), Outcome::Next | Outcome::Fault(_)) => Outcome::Fault(fault),
            (refused, outcome) => {
                self.refused_in_passing = refused;
                outcome
            }
        }
    }

    fn run_parts(
        &mut self,
        place: &Place,
        table: &BlockTable,
        block: &Block,
        state: &mut State<D>,
    ) -> Outcome<D> {
        if block.flags.contains(BlockFlags::COMMENT) && self.message_comment(state) {
            return Outcome::End(Ending::Alarm(0));
        }
        if block.flags.contains(BlockFlags::STATEMENT) {
            match self.statements(place, table, block, state) {
                Ok(Statements::Words) => {}
                Ok(Statements::Done(outcome)) => return outcome,
                Err(fault) => return Outcome::Fault(fault),
            }
        }
        match self.execute_words(place, table, block, state) {
            Ok(outcome) => outcome,
            Err(fault) => Outcome::Fault(fault),
        }
    }

    /// Words, then the assignments that waited for them, then the way on.
    fn execute_words(
        &mut self,
        place: &Place,
        table: &BlockTable,
        block: &Block,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        let words = self.words_to_come(table, block);
        let mut acts = !words.is_empty();
        if acts && Self::reads_row_or_ends_data(words, state) {
            let row = self.row(place, table, words, state);
            self.emit(state, Event::DataRow(row));
            acts = !state.reads_data();
        }
        if acts {
            // Whether the words are data or commands is not known: what was before stays possible.
            let unread = (state.data_entry == Truth::Unknown).then(|| state.clone());
            self.read_words(place, table, words, state)?;
            let executed = self.execute(place, words, state);
            self.settle_tool_shift(state);
            self.end_increments_of_block(state);
            executed?;
            if let Some(before) = unread {
                *state = state.join(&before);
            }
        }
        if !self.pending.is_empty() {
            let mut pending = std::mem::take(&mut self.pending);
            for (target, value) in pending.drain(..) {
                match self.assign(target, value, state) {
                    Ok(None) => {}
                    Ok(Some(end)) => return Ok(end),
                    Err(fault) => self.refuse(fault)?,
                }
            }
            self.pending = pending;
        }
        match self.flow.take() {
            None => Ok(Outcome::Next),
            Some(flow) => self.follow(flow, state),
        }
    }

    /// The words of a block that have not acted yet.
    fn words_to_come<'t>(&self, table: &'t BlockTable, block: &Block) -> &'t [Word] {
        let words = table.words(block);
        let acted_to = self.acted_to.unwrap_or(0);
        let first = words.partition_point(|word| word.range().start < acted_to);
        words.get(first..).unwrap_or_default()
    }

    /// The words in front of a condition or a jump act before it, where the control reads them at all.
    fn act_before(
        &mut self,
        place: &Place,
        table: &BlockTable,
        block: &Block,
        before: u32,
        state: &mut State<D>,
    ) -> Step {
        if !self.model.semantics().words_before_conditions {
            return Ok(());
        }
        let words = self.words_to_come(table, block);
        let count = words.partition_point(|word| word.range().start < before);
        let words = words.get(..count).unwrap_or_default();
        self.acted_to = Some(before);
        if words.iter().all(|word| matches!(word.letter.ascii(), b'N' | b'O')) {
            return Ok(());
        }
        self.read_words(place, table, words, state)?;
        let executed = self.execute(place, words, state);
        self.settle_tool_shift(state);
        if let Err(fault) = executed {
            // The jump is what the block means all the same.
            self.refuse(fault)?;
        }
        // A call or an end in front of a jump: which of the two the control then follows is in no page.
        if self.flow.take().is_some() { Err(Fault::Undecidable) } else { Ok(()) }
    }

    /// The file, chunk and table of a block.
    fn place(&mut self, at: At) -> Option<Place> {
        if let Some(cursor) = &self.cursor
            && cursor.file_index == at.file
            && at.block >= cursor.first
            && let Some(ix) = cursor.place.table.ix(at.block - cursor.first)
            && at.block < cursor.file.loaded.flow_graph().blocks()
        {
            let Place { table, chunk, base, .. } = &cursor.place;
            return Some(Place { table: Rc::clone(table), ix, chunk: *chunk, base: *base });
        }
        let file = self.program.file(at.file)?;
        let place = file.loaded.place(at.block, self.program.dialect())?;
        let first = at.block - place.ix.index() as u32;
        self.cursor = Some(Cursor { file_index: at.file, file, place: place.clone(), first });
        Some(place)
    }

    pub(crate) fn file(&self, index: u32) -> Option<Rc<ProgramFile<'p>>> {
        match &self.cursor {
            Some(cursor) if cursor.file_index == index => Some(Rc::clone(&cursor.file)),
            _ => self.program.file(index),
        }
    }

    #[inline]
    fn emit(&mut self, state: &mut State<D>, event: Event) {
        self.events += 1;
        let at_once = matches!(
            event,
            Event::SelectTool(_)
                | Event::ToolTableEntry(_)
                | Event::SetToolNumber(_)
                | Event::Message(_)
                | Event::DataRow(_)
                | Event::Plane(_)
                | Event::Units(_)
        );
        if state.compensation.is_followed() && !at_once {
            self.emit_compensated(state, event);
        } else {
            let is_move =
                matches!(event, Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. });
            self.moves += u64::from(is_move);
            self.observer.event(self.origin, state, &event);
        }
    }

    // ---- words ----

    fn read_words(
        &mut self,
        place: &Place,
        table: &BlockTable,
        words: &[Word],
        state: &mut State<D>,
    ) -> Step {
        self.words.clear();
        // Looked for once, however long the block is.
        let mut units = None;
        let m_is_argument = self.model.semantics().m_is_argument;
        let mut takes_m = false;
        for word in words {
            if word.code.is_some() {
                self.words.put_code(word.code);
                takes_m |= m_is_argument && self.is_macro_call(word.code);
                continue;
            }
            let code_letter = match word.letter.ascii() {
                b'G' => !word.letter.is_corner(),
                b'M' => !takes_m,
                _ => false,
            };
            match word.value {
                Value::Number(number) if code_letter => {
                    if !self.model.control().may_be_of_builder(word.letter, number) {
                        self.refuse(Fault::UnknownCode)?;
                    }
                }
                Value::Number(number) => {
                    let pointed = word.shape.point;
                    let number = if pointed || number == 0.0 || self.is_count(word.letter, words) {
                        number
                    } else {
                        let units = match self.unpointed_of(word.letter) {
                            Unpointed::LeastIncrement => {
                                *units.get_or_insert_with(|| self.units_of_block(words, state))
                            }
                            _ => None,
                        };
                        self.scale(word.letter, number, units)
                    };
                    self.words.put_number(word.letter, number, pointed);
                }
                Value::Expr(expr) => {
                    let value = self.evaluate(place, table, table.expr(expr), state)?;
                    if code_letter {
                        // An empty variable takes the word out.
                        if D::is_vacant(&value) != Truth::True {
                            self.computed_code(word.letter, &value)?;
                        }
                        continue;
                    }
                    match D::is_vacant(&value) {
                        Truth::True => {}
                        Truth::False | Truth::Unknown => {
                            let value = self.as_resolved(word.letter, value, words, state);
                            let pointed = self.model.semantics().computed_words_are_pointed;
                            self.words.put(word.letter, value, pointed);
                        }
                    }
                }
                Value::Missing => {
                    self.refuse(Fault::MissingValue(word.letter))?;
                    self.words.put(word.letter, D::unknown(), true);
                }
            }
        }
        Ok(())
    }

    fn is_macro_call(&self, code: CodeIx) -> bool {
        matches!(self.model.effect(code), Effect::MacroCall | Effect::MacroModal)
    }

    /// A computed value as the control reads it: rounded to a whole number, or to the last digit of its lengths and angles, on
    /// controls that do so.
    fn as_resolved(&self, letter: Letter, value: D::Value, words: &[Word], state: &State<D>) -> D::Value {
        let semantics = self.model.semantics();
        if !(semantics.computed_counts_round || semantics.computed_lengths_round)
            || D::is_vacant(&value) != Truth::False
        {
            return value;
        }
        let numbers = self.model.control().numbers();
        match self.kind_read(letter, words) {
            Some(WordKind::Integer) if semantics.computed_counts_round => self.to_multiple(value, 1.0),
            Some(WordKind::Angle) if semantics.computed_lengths_round => {
                self.to_multiple(value, numbers.least_angle)
            }
            Some(WordKind::Length) if semantics.computed_lengths_round => {
                match self.units_of_block(words, state) {
                    Some(Units::Inch) => self.to_multiple(value, numbers.least_inch),
                    Some(Units::Mm) => self.to_multiple(value, numbers.least_mm),
                    // A run goes on with the value; an analysis has every way that the control may read it.
                    None if self.lenient => {
                        let inch = self.to_multiple(value.clone(), numbers.least_inch);
                        let mm = self.to_multiple(value.clone(), numbers.least_mm);
                        value.join(&inch).join(&mm)
                    }
                    None => value,
                }
            }
            _ => value,
        }
    }

    /// What a word means beside the codes of its block; `None` where it is an argument of a macro, which is any number.
    fn kind_read(&self, letter: Letter, words: &[Word]) -> Option<WordKind> {
        let control = self.model.control();
        let mut kind = None;
        for code in words.iter().filter_map(|word| control.code_at(word.code)) {
            if code.entry().any_words {
                return None;
            }
            let mut entries = code.entry().words.iter();
            let entry = entries.find(|entry| Letter::parse(&entry.letter) == Some(letter));
            kind = kind.or(entry.map(|entry| entry.kind));
        }
        kind.or_else(|| control.letter(letter).map(|entry| entry.kind))
    }

    /// The multiple of a step that is nearest to a value.
    fn to_multiple(&self, value: D::Value, step: f64) -> D::Value {
        let semantics = self.model.semantics();
        // Divided by a power of ten rather than multiplied: .1235, not .12350000000000001.
        let steps = D::number((1.0 / step).round());
        let rounded = D::binary(BinaryOp::Multiply, &value, &steps, semantics)
            .and_then(|value| D::call(Function::Round, std::slice::from_ref(&value), semantics))
            .and_then(|value| D::binary(BinaryOp::Divide, &value, &steps, semantics));
        rounded.unwrap_or(value)
    }

    /// Does an analysis of all paths leave this check to rules of lower tiers? A run past alarms makes it.
    pub(crate) fn leaves_to_rules(&self) -> bool {
        self.lenient && !self.options.past_alarms
    }

    /// Something about the block is refused. A run stops there; an analysis goes on with what else the block means.
    pub(crate) fn refuse(&mut self, fault: Fault) -> Step {
        if !self.lenient {
            return Err(fault);
        }
        self.refused.get_or_insert(fault);
        Ok(())
    }

    /// `G#700`: the code that a value names.
    fn computed_code(&mut self, letter: Letter, value: &D::Value) -> Step {
        let Some(number) = D::known(value) else { return Err(Fault::Undecidable) };
        match self.model.code_of_value(letter, number) {
            Some(ix) => self.words.put_code(ix),
            None if self.model.control().may_be_of_builder(letter, number) => {}
            None => return Err(Fault::UnknownCode),
        }
        Ok(())
    }

    /// A number without decimal point, as the control counts it.
    fn scale(&mut self, letter: Letter, number: f64, units: Option<Units>) -> f64 {
        let Some(kind) = self.model.scaled(letter) else { return number };
        if let Some(factor) = self.factor_of_setting(letter) {
            return number * factor;
        }
        match self.unpointed_of(letter) {
            Unpointed::AsWritten => number,
            Unpointed::LeastIncrement => {
                let numbers = self.model.control().numbers();
                let least = match kind {
                    WordKind::Angle => numbers.least_angle,
                    _ => match units {
                        Some(Units::Inch) => numbers.least_inch,
                        Some(Units::Mm) => numbers.least_mm,
                        None => f64::NAN,
                    },
                };
                // Divided by a power of ten rather than multiplied: `X1500` is 1.5, not 1.5000000000000002.
                number / (1.0 / least).round()
            }
            Unpointed::ByParameter => {
                self.assumptions.insert(Assumption::UnpointedNumbers);
                number
            }
        }
    }

    /// How a number of an address without decimal point counts: some addresses follow another setting, or none.
    fn unpointed_of(&self, letter: Letter) -> Unpointed {
        match self.model.scale_setting(letter) {
            None => self.unpointed,
            Some(_) => self.model.unpointed(),
        }
    }

    /// What a setting of the address's own makes of a number without decimal point: `.01` of it, or the number itself.
    fn factor_of_setting(&self, letter: Letter) -> Option<f64> {
        let setting = self.model.scale_setting(letter)?;
        let value = self.machine.settings.get(setting.rsplit(' ').next()?)?;
        if value == "integer" { Some(1.0) } else { value.parse().ok() }
    }

    /// An argument of a macro call that is written without a decimal point, as the macro gets it.
    fn unpointed_argument(&mut self, letter: Letter, number: f64, whole: &str, units: Option<Units>) -> f64 {
        if number == 0.0 || whole.contains(char::from(letter.ascii())) {
            return number;
        }
        match self.unpointed {
            Unpointed::AsWritten => number,
            Unpointed::LeastIncrement => {
                let numbers = self.model.control().numbers();
                let least = match units {
                    Some(Units::Inch) => numbers.least_inch,
                    Some(Units::Mm) => numbers.least_mm,
                    None => f64::NAN,
                };
                number / (1.0 / least).round()
            }
            Unpointed::ByParameter => {
                self.assumptions.insert(Assumption::UnpointedNumbers);
                number
            }
        }
    }

    /// The units in which a block's numbers count: those that it names itself, wherever they stand in it.
    fn units_of_block(&self, words: &[Word], state: &State<D>) -> Option<Units> {
        let named = words.iter().rev().find_map(|word| match self.model.effect(word.code) {
            Effect::Inch => Some(Units::Inch),
            Effect::Millimetre => Some(Units::Mm),
            _ => None,
        });
        named.or_else(|| state.units(self.model))
    }

    /// Puts the parts of the block in the control's order and executes them.
    fn execute(&mut self, place: &Place, words: &[Word], state: &mut State<D>) -> Step {
        let names_unknown = self.prepare(place, words, state)?;
        let present = self.words.present();
        let codes = self.words.codes();
        let turns = self.turns_about_centre(state);
        // A block that only moves: nothing to put in order.
        if codes.is_empty() && !present.intersects(FEED_SPEED_TOOL) {
            let moves = present.intersects(self.model.axis_letters) || present.intersects(POLAR) || turns;
            return if moves && !names_unknown {
                let done = self.motion(state);
                self.past(done, Action::Motion, state)
            } else {
                Ok(())
            };
        }
        let moves = present.intersects(self.model.axis_letters) || present.intersects(POLAR) || turns;
        let mut parts = Parts::new(moves, names_unknown);
        for ix in codes {
            if self.model.contracts.get(ix.index()).is_some_and(|contract| contract.first_only) {
                let first = *ix;
                let done = self.code(first, place, words, state);
                return self.past(done, Action::Code(first), state);
            }
            self.machine_coordinates |= self.model.effect(*ix) == Effect::MachineCoordinates;
            parts.add_code(*ix, present, self.model);
        }
        parts.add_words(present, names_unknown || self.refuses_incomplete(), self.model);
        for action in parts.in_order(self.model) {
            let done = match action {
                Action::Code(code) => self.code(code, place, words, state),
                Action::Feed => self.feed_word(state),
                Action::Speed => self.speed_word(state),
                Action::Tool => self.tool_word(state),
                Action::Motion => self.motion(state),
            };
            self.past(done, action, state)?;
            if std::mem::take(&mut self.rest_is_lost) {
                break;
            }
        }
        Ok(())
    }

    /// What comes before the parts of the block. True when one of its codes is unknown, and may be what reads the other words.
    fn prepare(&mut self, place: &Place, words: &[Word], state: &mut State<D>) -> Step<bool> {
        if let Err(fault) = self.check_block(place, words, state) {
            self.refuse(fault)?;
        }
        if state.tool_shift.is_on()
            && let Err(fault) = self.words_of_tool_shift(state)
        {
            self.refuse(fault)?;
        }
        if self.words.present().intersects(self.model.lasting)
            && let Err(fault) = self.remember_lasting_words(state)
        {
            self.refuse_in(fault, state)?;
            (state.tool.h, state.tool.d) = (D::unknown(), D::unknown());
        }
        let names_unknown = self.refused == Some(Fault::UnknownCode) && self.leaves_to_rules();
        if names_unknown && !self.names_motion() {
            // The axis words may be the unknown code's own.
            self.lose_position(state)?;
        }
        Ok(names_unknown)
    }

    /// Does a code of the block say how its axes move?
    fn names_motion(&self) -> bool {
        let is_motion = |ix: &CodeIx| {
            let code = self.model.code(*ix);
            code.is_some_and(|code| matches!(code.role, Some(Role::Motion | Role::Cycle)))
        };
        self.words.codes().iter().any(is_motion)
    }

    /// The length of a word in millimetres, or the angle of a rotary axis in degrees.
    fn length(&self, letter: Letter, state: &State<D>) -> Option<f64> {
        let number = self.words.number(letter)?;
        // Zero is zero in any unit.
        Some(if number == 0.0 { 0.0 } else { number * self.unit(state) })
    }

    /// Millimetres in a unit of the block; NaN when not known.
    fn unit(&self, state: &State<D>) -> f64 {
        if self.has_millimetre_distances() {
            return 1.0;
        }
        state.units(self.model).map_or(f64::NAN, Units::in_mm)
    }

    /// Are the axis words of the block distances from the present point? `None` when not known.
    fn is_incremental(&self, state: &State<D>) -> Option<bool> {
        // `G53` makes coordinates of them.
        if self.has_millimetre_distances() && !self.machine_coordinates {
            Some(true)
        } else {
            state.is_incremental(self.model)
        }
    }

    /// Does the block name a code whose words are millimetres and distances, whatever the modes?
    fn has_millimetre_distances(&self) -> bool {
        let is_it = |code: &CodeIx| self.model.code(*code).is_some_and(|code| code.millimetre_distances);
        self.model.has_millimetre_distances && self.words.codes().iter().any(is_it)
    }

    /// Is the address, elsewhere an angle that counts smallest steps, a count to a code of the block (`G43 H1` on a lathe)?
    fn is_count(&self, letter: Letter, words: &[Word]) -> bool {
        // Codes that the block computes are among those that it has so far.
        let mut codes = words.iter().map(|word| word.code).chain(self.words.codes().iter().copied());
        self.model.scaled(letter) == Some(WordKind::Angle)
            && codes.any(|ix| {
                self.model.contracts.get(ix.index()).is_some_and(|contract| contract.counts.contains(letter))
            })
    }

    /// A whole number not below zero; `None` when it does not stand, a fault when it is none.
    fn count(&self, letter: Letter) -> Step<Option<Count>> {
        self.words.number(letter).map(|number| Self::whole(letter, number)).transpose()
    }

    /// A number as a count.
    fn whole(letter: Letter, number: f64) -> Step<Count> {
        if number.is_nan() {
            return Ok(Count::Unknown);
        }
        let whole = number.round();
        if (whole - number).abs() > 1e-4 || whole < 0.0 || whole > f64::from(u32::MAX) {
            return Err(Fault::WordRange(letter));
        }
        #[expect(clippy::cast_sign_loss, reason = "range checked above")]
        Ok(Count::Known(whole as u32))
    }

    /// As [`Self::count`]; on strict controls, which do not mind decimals in some counts, rounded.
    fn rounded(&self, letter: Letter) -> Step<Option<Count>> {
        self.near_count(letter, f64::round)
    }

    /// As [`Self::rounded`], without its decimals.
    fn truncated(&self, letter: Letter) -> Step<Option<Count>> {
        self.near_count(letter, f64::trunc)
    }

    fn near_count(&self, letter: Letter, nearest: impl Fn(f64) -> f64) -> Step<Option<Count>> {
        match self.words.number(letter).map(nearest) {
            #[expect(clippy::cast_sign_loss, reason = "range checked in the pattern's guard")]
            Some(number) if self.refuses_incomplete() && (0.0..=f64::from(u32::MAX)).contains(&number) => {
                Ok(Some(Count::Known(number as u32)))
            }
            _ => self.count(letter),
        }
    }

    // ---- expressions ----

    /// The value of an expression. An execution that goes on past alarms takes one that has none for unknown.
    fn evaluate(
        &mut self,
        place: &Place,
        table: &BlockTable,
        expr: &Expr,
        state: &State<D>,
    ) -> Step<D::Value> {
        self.value_of(place, table, expr, state).or_else(|fault| {
            self.refuse(fault)?;
            Ok(D::unknown())
        })
    }

    /// The value of an expression, or why it has none.
    fn value_of(
        &mut self,
        place: &Place,
        table: &BlockTable,
        expr: &Expr,
        state: &State<D>,
    ) -> Step<D::Value> {
        let ops = table.ops(expr);
        // By far the most common: one number, or one variable.
        match ops {
            [Op::Number(number)] => return Ok(D::number(*number)),
            [Op::Variable(number)] => return self.read_variable(*number, state),
            _ => {}
        }
        if !expr.well_formed {
            return Err(Fault::Value(ValueFault::Malformed));
        }
        let semantics = self.model.semantics();
        let bottom = self.stack.len();
        for (index, op) in ops.iter().enumerate() {
            let asks_whether_it_exists = matches!(ops.get(index + 1), Some(Op::Call(Function::Exists, _)));
            let result = match op {
                // `EXISTS[#<name>]` asks whether reading it would be a fault.
                Op::Named { .. } | Op::Variable(_) | Op::Indirect if asks_whether_it_exists => {
                    let exists = self.exists(place, op, state);
                    Ok(exists.map_or_else(D::unknown, |exists| D::number(f64::from(u8::from(exists)))))
                }
                Op::Number(number) => Ok(D::number(*number)),
                Op::Variable(number) => self.read_variable(*number, state),
                Op::Named { start, end } => {
                    let name = self.name(place, (*start, *end));
                    // In front of the assignment that brings it into being the name does not exist yet.
                    if self.created.iter().any(|(created, from)| *created == name && start < from) {
                        Err(Fault::UnsetParameter)
                    } else {
                        self.read_name(name, state)
                    }
                }
                Op::Indirect => {
                    let number = self.operand();
                    self.read_indirect(&number, state)
                }
                Op::Negate => {
                    let value = self.operand();
                    Ok(D::negate(&value))
                }
                Op::Binary(op) => {
                    let right = self.operand();
                    let left = self.operand();
                    D::binary(*op, &left, &right, semantics).map_err(Fault::Value)
                }
                Op::Call(function, count) => self.call_function(*function, *count, bottom),
            };
            match result {
                Ok(value) => self.stack.push(value),
                Err(fault) => {
                    self.stack.truncate(bottom);
                    return Err(fault);
                }
            }
        }
        let value = self.operand();
        self.stack.truncate(bottom);
        Ok(value)
    }

    /// Takes the uppermost value of the expression under way.
    fn operand(&mut self) -> D::Value {
        self.stack.pop().unwrap_or_else(D::unknown)
    }

    /// Would reading what this operation names be no fault?
    fn exists(&mut self, place: &Place, op: &Op, state: &State<D>) -> Option<bool> {
        match op {
            Op::Named { start, end } => self.has_name(self.name(place, (*start, *end)), state),
            Op::Variable(number) => Some(self.check_number(*number).is_ok()),
            _ => {
                let number = D::known(&self.operand());
                number.map(|n| variable_number(n).is_ok_and(|n| self.check_number(n).is_ok()))
            }
        }
    }

    /// A function of the uppermost `count` values, as far as they are above the `bottom` of the expression.
    fn call_function(&mut self, function: Function, count: u8, bottom: usize) -> Step<D::Value> {
        let semantics = self.model.semantics();
        match (function, count) {
            (Function::Exists, _) => Ok(self.operand()),
            (Function::Atan, 2) if semantics.atan_takes_one => {
                let divisor = self.operand();
                let number = self.operand();
                D::call(Function::Atan, std::slice::from_ref(&number), semantics)
                    .and_then(|angle| D::binary(BinaryOp::Divide, &angle, &divisor, semantics))
                    .map_err(Fault::Value)
            }
            _ => {
                let from = self.stack.len().saturating_sub(usize::from(count)).max(bottom);
                let result = D::call(function, self.stack.get(from..).unwrap_or_default(), semantics);
                self.stack.truncate(from);
                result.map_err(Fault::Value)
            }
        }
    }

    fn read_variable(&mut self, number: u32, state: &State<D>) -> Step<D::Value> {
        let semantics = self.model.semantics();
        let number = semantics.kept_as(number);
        self.check_number(number)?;
        let [first, last] = semantics.locals;
        if (first..=last).contains(&number) && number > 0 {
            let value = state
                .calls
                .locals()
                .and_then(|locals| locals.get(number))
                .cloned()
                .unwrap_or_else(D::unknown);
            self.tell_vacant(number, &value, state);
            return Ok(value);
        }
        if number == 0 && semantics.unset == Unset::Vacant {
            return Ok(D::vacant());
        }
        let system = self.model.system_variable(number);
        // A probing move writes its result over what the program wrote, and a clock goes on from it.
        let is_probed = system.is_some_and(|(variable, _, _)| {
            matches!(
                variable.holds,
                SystemValue::ProbePosition | SystemValue::ProbeResult | SystemValue::Unknown
            )
        });
        let written = if is_probed { Truth::False } else { state.variables.written(number) };
        if written == Truth::True {
            let value = state.variables.get(number);
            self.tell_vacant(number, &value, state);
            return Ok(value);
        }
        if let Some((variable, row, column)) = system {
            let mut value = self.read_system(variable, row, column, state)?;
            if variable.holds == SystemValue::Unknown
                && let Some(guess) = self.machine.guesses.variables.get(&number)
            {
                value = D::assumed(D::number(*guess));
            }
            // The program may have written over it.
            return Ok(if written == Truth::Unknown {
                value.join(&state.variables.get(number))
            } else {
                value
            });
        }
        if let Some(value) = self.setting_of_variable(number) {
            return Ok(D::number(value));
        }
        let value = state.variables.get(number);
        // A condition that asks whether it is set makes the reading a decision.
        if !state.variables.is_narrowed(number) {
            self.tell_vacant(number, &value, state);
        }
        Ok(value)
    }

    /// Variables that a strict control has.
    fn check_number(&self, number: u32) -> Step {
        match self.model.semantics().refusals.last_variable {
            Some(last) if !(1..=last).contains(&number) => Err(Fault::VariableNumber),
            _ => Ok(()),
        }
    }

    fn tell_vacant(&mut self, number: u32, value: &D::Value, state: &State<D>) {
        let is_vacant = self.model.semantics().unset == Unset::Vacant && D::is_vacant(value) == Truth::True;
        if is_vacant && !self.looks_ahead {
            self.observer.vacant_read(self.origin, state, number);
        }
    }

    fn read_indirect(&mut self, number: &D::Value, state: &State<D>) -> Step<D::Value> {
        match D::known(number) {
            Some(number) => self.read_variable(variable_number(number)?, state),
            None if D::is_vacant(number) == Truth::True => self.read_variable(0, state),
            None => Ok(D::unknown()),
        }
    }

    fn read_name(&mut self, name: NameId, state: &State<D>) -> Step<D::Value> {
        let local = state.calls.own_locals().and_then(|locals| locals.named(name));
        let Some(Variable { value, written }) = local.or_else(|| state.variables.named(name)) else {
            return self.read_unset_name(name, state);
        };
        if written == Truth::True {
            return Ok(value);
        }
        self.assumptions.insert(Assumption::Unsettled(Unsettled::Parameter));
        // On a path that did not set it, the control's own counts, or the path ends here.
        Ok(self.read_unset_name(name, state).map_or(value.clone(), |own| own.join(&value)))
    }

    /// Does reading a parameter give a value? `None` where nobody knows.
    fn has_name(&mut self, name: NameId, state: &State<D>) -> Option<bool> {
        let text = self.program.name_text(name);
        let is_of_machine = ["_ini[", "_hal["].iter().any(|head| text.starts_with(head));
        if is_of_machine && !self.machine.parameters.contains_key(&*text) {
            // The machine may have it.
            return None;
        }
        let local = state.calls.own_locals().and_then(|locals| locals.named(name));
        let set = local.or_else(|| state.variables.named(name));
        match set.map_or(Truth::False, |variable| variable.written) {
            Truth::True => Some(true),
            Truth::False => Some(self.read_unset_name(name, state).is_ok()),
            Truth::Unknown => self.read_unset_name(name, state).is_ok().then_some(true),
        }
    }

    /// A parameter that the program has not set.
    fn read_unset_name(&mut self, name: NameId, state: &State<D>) -> Step<D::Value> {
        let text = self.program.name_text(name);
        if let Some(variable) = self.model.named_variable(&text) {
            return self.read_system(variable, 0, 0, state);
        }
        // `#<_ini[section]name>`, `#<_hal[pin]>`: without its bracket a name like others.
        let of_settings = text.strip_prefix("_ini[").is_some_and(|rest| rest.contains(']'));
        if of_settings || text.strip_prefix("_hal[").is_some_and(|rest| rest.ends_with(']')) {
            return Ok(D::unknown());
        }
        if let Some(value) = self.machine.parameters.get(&*text) {
            return Ok(D::number(*value));
        }
        if self.model.control().named_parameter(&text).is_some() {
            // The control has it; what it holds is not followed. A fresh control has nothing in it.
            return Ok(if self.machine.fresh { D::number(0.0) } else { D::unknown() });
        }
        Err(Fault::UnsetParameter)
    }

    fn name(&self, place: &Place, range: (u32, u32)) -> NameId {
        let file = self.origin.at.file;
        match &self.cursor {
            Some(cursor) => {
                self.program.name_at(file, place.chunk, range, cursor.file.loaded.chunk_text(place.chunk))
            }
            None => self.program.name(""),
        }
    }

    // ---- statements ----

    fn statements(
        &mut self,
        place: &Place,
        table: &BlockTable,
        block: &Block,
        state: &mut State<D>,
    ) -> Step<Statements<D>> {
        for statement in table.statements(place.ix) {
            match &statement.kind {
                StatementKind::Assign { target, value } => {
                    let Some(value) = value else { return Err(Fault::Malformed) };
                    let target = self.assignee(place, table, target, state)?;
                    if self.model.semantics().assignments_after_block {
                        self.create(target, statement.range.start, state);
                    }
                    let value = self.evaluate(place, table, table.expr(*value), state)?;
                    if self.model.semantics().assignments_after_block {
                        match self.check_assignable(target) {
                            Ok(()) => self.pending.push((target, value)),
                            Err(fault) => self.refuse(fault)?,
                        }
                        continue;
                    }
                    match self.assign(target, value, state) {
                        Ok(None) => {}
                        Ok(Some(end)) => return Ok(Statements::Done(end)),
                        Err(fault) => self.refuse(fault)?,
                    }
                }
                StatementKind::If { condition } | StatementKind::Guard { condition } => {
                    let Some(condition) = condition else { return Err(Fault::Malformed) };
                    self.act_before(place, table, block, statement.range.start, state)?;
                    match self.condition(place, table, *condition, state)? {
                        Truth::True => self.assume(table, *condition, true, state),
                        Truth::False => {
                            self.assume(table, *condition, false, state);
                            return Ok(Statements::Done(Outcome::Next));
                        }
                        Truth::Unknown => {
                            return self.either(place, table, block, *condition, state).map(Statements::Done);
                        }
                    }
                }
                StatementKind::Goto { target } => {
                    let Some(target) = target else { return Err(Fault::Malformed) };
                    // What is between a condition and its jump belongs to the jump; without one all words act before it.
                    let end = if self.acted_to.is_some() { statement.range.start } else { u32::MAX };
                    self.act_before(place, table, block, end, state)?;
                    let value = self.value_of(place, table, table.expr(*target), state)?;
                    return self.jump_to_label(&value, state).map(Statements::Done);
                }
                StatementKind::Do { condition, .. } => {
                    return self.loop_head(place, table, *condition, state).map(Statements::Done);
                }
                StatementKind::End { .. } => return self.loop_end().map(Statements::Done),
                StatementKind::OWord { label, keyword, arguments } => {
                    self.check_o_word(place, table.words(block), block)?;
                    return self
                        .o_word(place, table, label, *keyword, arguments.clone(), state)
                        .map(Statements::Done);
                }
                StatementKind::Print => self.print(place, statement, state),
                StatementKind::Command => self.system_command(place, statement, state),
            }
        }
        Ok(Statements::Words)
    }

    /// `#<a>=1 G0 X#<a>`: an assignment brings its name into being, with zero, as soon as it is read; its value comes after the
    /// block (observed).
    fn create(&mut self, target: Assignee, start: u32, state: &mut State<D>) {
        let Assignee::Name(name) = target else { return };
        if self.has_name(name, state) == Some(false) && self.check_assignable(target).is_ok() {
            self.created.push((name, start));
            self.set_name(name, D::number(0.0), state);
        }
    }

    fn set_name(&self, name: NameId, value: D::Value, state: &mut State<D>) {
        let is_global = self.program.name_text(name).starts_with('_');
        match state.calls.own_locals_mut() {
            Some(locals) if !is_global => locals.set_named(name, value),
            _ => state.variables.set_named(name, value),
        }
    }

    fn condition(
        &mut self,
        place: &Place,
        table: &BlockTable,
        condition: ExprIx,
        state: &State<D>,
    ) -> Step<Truth> {
        let value = self.evaluate(place, table, table.expr(condition), state)?;
        Ok(D::truth(&value))
    }

    /// What stands behind a condition, done or not done: both ways.
    fn either(
        &mut self,
        place: &Place,
        table: &BlockTable,
        block: &Block,
        condition: ExprIx,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        let undecided = state.clone();
        let mut without = state.clone();
        self.assume(table, condition, false, &mut without);
        self.assume(table, condition, true, state);
        let at = self.origin.at;
        let mut goes_on = true;
        let mut fork = vec![(at.next(), without)];
        let mut behind = table.statements(place.ix).skip_while(|s| {
            !matches!(&s.kind, StatementKind::If { condition: Some(c) } | StatementKind::Guard { condition: Some(c) } if *c == condition)
        });
        behind.next();
        for statement in behind {
            match &statement.kind {
                StatementKind::Goto { target: Some(target) } => {
                    let value = self.evaluate(place, table, table.expr(*target), state)?;
                    let jump = match self.jump_to_label(&value, state) {
                        Ok(jump) => jump,
                        Err(fault) => {
                            // A jump without its target falls through: whatever the condition is, the next block comes.
                            self.refuse(fault)?;
                            *state = undecided;
                            return Ok(Outcome::Next);
                        }
                    };
                    match jump {
                        Outcome::Jump(to) => fork.push((to, state.clone())),
                        Outcome::Fork(more) => fork.extend(more),
                        other => return Ok(other),
                    }
                    goes_on = false;
                }
                StatementKind::Assign { target, value: Some(value) } => {
                    let target = self.assignee(place, table, target, state)?;
                    let value = self.evaluate(place, table, table.expr(*value), state)?;
                    // An alarm on one of the ways ends that way.
                    goes_on &= self.assign(target, value, state)?.is_none();
                }
                _ => {}
            }
        }
        if goes_on {
            match self.execute_words(place, table, block, state)? {
                Outcome::Next => fork.push((at.next(), state.clone())),
                Outcome::Jump(to) => fork.push((to, state.clone())),
                Outcome::Fork(more) => fork.extend(more),
                Outcome::End(_) => {}
                Outcome::Fault(fault) => return Err(fault),
            }
        }
        Ok(Outcome::Fork(fork))
    }

    /// Narrows a variable by what a condition says of it: `#1 LT 10` holding leaves less than ten.
    fn assume(&mut self, table: &BlockTable, condition: ExprIx, holds: bool, state: &mut State<D>) {
        let (variable, op, bound) = match table.ops(table.expr(condition)) {
            [Op::Variable(variable), Op::Number(bound), Op::Binary(op)] => (*variable, *op, *bound),
            [Op::Variable(variable), Op::Number(bound), Op::Negate, Op::Binary(op)] => {
                (*variable, *op, -*bound)
            }
            [Op::Number(bound), Op::Variable(variable), Op::Binary(op)] => match mirrored(*op) {
                Some(op) => (*variable, op, *bound),
                None => return,
            },
            // `#1 EQ #0`: nothing, or something.
            [
                Op::Variable(variable),
                Op::Variable(0),
                Op::Binary(op @ (BinaryOp::Equal | BinaryOp::NotEqual)),
            ]
            | [
                Op::Variable(0),
                Op::Variable(variable),
                Op::Binary(op @ (BinaryOp::Equal | BinaryOp::NotEqual)),
            ] if self.model.semantics().unset == Unset::Vacant => {
                let vacant = (*op == BinaryOp::Equal) == holds;
                if let Ok(value) = self.read_variable(*variable, state)
                    && let Some(narrowed) = D::assume_vacant(&value, vacant)
                    && self.model.system_variable(*variable).is_none()
                {
                    self.narrow(*variable, narrowed, state);
                }
                return;
            }
            [Op::Variable(variable), Op::Variable(other), Op::Binary(op)] => {
                match self.read_variable(*other, state).ok().as_ref().and_then(D::known) {
                    Some(bound) => (*variable, *op, bound),
                    None => return,
                }
            }
            _ => return,
        };
        let Some(op) = (if holds { Some(op) } else { opposite(op) }) else { return };
        let Ok(value) = self.read_variable(variable, state) else { return };
        if D::known(&value).is_some() {
            return;
        }
        if let Some(narrowed) = D::assume(&value, op, bound, self.model.semantics()) {
            let is_system = self.model.system_variable(variable).is_some();
            if !is_system {
                self.narrow(variable, narrowed, state);
            }
        }
    }

    /// A variable holds this on the way taken. Nobody has written it for that.
    fn narrow(&self, variable: u32, value: D::Value, state: &mut State<D>) {
        let semantics = self.model.semantics();
        let number = semantics.kept_as(variable);
        let [first, last] = semantics.locals;
        if !(first..=last).contains(&number) {
            state.variables.narrow(number, value);
        } else if let Some(locals) = state.calls.locals_mut() {
            locals.set(number, value);
        }
    }

    fn assignee(
        &mut self,
        place: &Place,
        table: &BlockTable,
        target: &Target,
        state: &State<D>,
    ) -> Step<Assignee> {
        Ok(match target {
            Target::Variable(number) => Assignee::Number(*number),
            Target::Named(range) => Assignee::Name(self.name(place, (range.start, range.end))),
            Target::Computed(expr) => {
                let value = self.evaluate(place, table, table.expr(*expr), state)?;
                match D::known(&value) {
                    Some(number) => Assignee::Number(variable_number(number)?),
                    None => Assignee::Anywhere,
                }
            }
            Target::Invalid => return Err(Fault::Malformed),
        })
    }

    /// May the program write it? Asked before the block acts.
    fn check_assignable(&mut self, target: Assignee) -> Step {
        match target {
            Assignee::Name(name) => {
                let text = self.program.name_text(name);
                let listed = self.model.control().named_parameter(&text);
                let is_read_only = listed.is_some_and(|entry| entry.access == Access::Read);
                if is_read_only || self.model.named_variable(&text).is_some() {
                    Err(Fault::ReadOnlyVariable(0))
                } else {
                    Ok(())
                }
            }
            Assignee::Number(number) => {
                self.check_number(number)?;
                let writable = number != 0 && self.is_writable(number);
                if writable { Ok(()) } else { Err(Fault::ReadOnlyVariable(number)) }
            }
            Assignee::Anywhere => Ok(()),
        }
    }

    /// Under a setting, increments hold for their own block only.
    fn end_increments_of_block(&mut self, state: &mut State<D>) {
        let Some(setting) = self.model.semantics().increments_of_block_setting.as_deref() else { return };
        let is_on =
            self.machine.settings.get(setting).is_some_and(|value| matches!(value.as_str(), "on" | "true"));
        if is_on && self.has_code(Effect::Incremental) {
            let absolute = self.model.code_with(Effect::Absolute);
            state.set_mode(Role::Distance, absolute);
            self.emit(state, Event::Modal(absolute));
        }
    }

    /// The value of a setting that a variable shows, where it is told or has a default. A switch is 1 or 0.
    fn setting_of_variable(&self, number: u32) -> Option<f64> {
        let setting = number.checked_sub(self.model.semantics().setting_variables?)?;
        let value = self.machine.setting(self.model.control(), &setting.to_string())?;
        match value {
            "on" | "true" => Some(1.0),
            "off" | "false" => Some(0.0),
            other => other.parse().ok(),
        }
    }

    /// May a program write the variable, as far as is known? Loops ask for the same few many times.
    fn is_writable(&mut self, number: u32) -> bool {
        let control = self.model.control();
        *self.writable.entry(number).or_insert_with(|| control.is_writable(number))
    }

    /// Writes a variable. Some variables end the program.
    fn assign(
        &mut self,
        target: Assignee,
        value: D::Value,
        state: &mut State<D>,
    ) -> Step<Option<Outcome<D>>> {
        match target {
            Assignee::Name(name) => {
                self.check_assignable(target)?;
                self.set_name(name, value, state);
                Ok(None)
            }
            Assignee::Anywhere => {
                state.variables.forget();
                state.calls.forget_locals();
                Ok(None)
            }
            Assignee::Number(0) => Err(Fault::ReadOnlyVariable(0)),
            Assignee::Number(number) => {
                let number = self.model.semantics().kept_as(number);
                if let Some((variable, row, column)) = self.model.system_variable(number) {
                    return self.write_system(number, variable, row, column, value, state);
                }
                if !self.is_writable(number) {
                    return Err(Fault::ReadOnlyVariable(number));
                }
                self.write_plain(number, value, state);
                Ok(None)
            }
        }
    }

    fn write_plain(&mut self, number: u32, value: D::Value, state: &mut State<D>) {
        let number = self.model.semantics().kept_as(number);
        let [first, last] = self.model.semantics().locals;
        if (first..=last).contains(&number) {
            match state.calls.locals_mut() {
                Some(locals) => locals.set(number, value),
                // Nobody knows whose variable it is.
                None => state.calls.forget_locals(),
            }
        } else {
            state.variables.set(number, value);
        }
    }

    /// The configured or assumed value of a setting.
    fn setting(&mut self, number: &str) -> Option<&'a str> {
        if !self.machine.settings.contains_key(number) && self.model.control().setting(number).is_some() {
            self.assumptions.insert(Assumption::Setting(number.to_owned()));
        }
        let machine: &'a Machine = self.machine;
        machine.setting(self.model.control(), number)
    }
}

/// What remains of a block after its statements.
enum Statements<D: Domain> {
    /// Its words.
    Words,
    /// Nothing.
    Done(Outcome<D>),
}

/// A whole number, or a word whose value nobody knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    Known(u32),
    Unknown,
}

/// Blocks whose form may be refused.
const FORM: BlockFlags = BlockFlags::LABEL
    .union(BlockFlags::LONG_LINE)
    .union(BlockFlags::BLOCK_DELETE)
    .union(BlockFlags::PROGRAM_NUMBER);

const FEED_SPEED_TOOL: LetterSet = LetterSet::of("FST");

/// Polar words: distance and angle from the origin.
pub(crate) const POLAR: LetterSet = {
    let mut letters = LetterSet::EMPTY;
    letters.insert(Letter::AT);
    letters.insert(Letter::CARET);
    letters
};

fn variable_number(number: f64) -> Step<u32> {
    let whole = number.round();
    if (whole - number).abs() > 1e-4 || !(0.0..=f64::from(u32::MAX)).contains(&whole) {
        return Err(Fault::VariableNumber);
    }
    #[expect(clippy::cast_sign_loss, reason = "range checked above")]
    Ok(whole as u32)
}

/// The comparison with its sides exchanged.
fn mirrored(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Equal => BinaryOp::Equal,
        BinaryOp::NotEqual => BinaryOp::NotEqual,
        BinaryOp::Greater => BinaryOp::Less,
        BinaryOp::GreaterEqual => BinaryOp::LessEqual,
        BinaryOp::Less => BinaryOp::Greater,
        BinaryOp::LessEqual => BinaryOp::GreaterEqual,
        _ => return None,
    })
}

/// The comparison that holds when this one does not.
fn opposite(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Equal => BinaryOp::NotEqual,
        BinaryOp::NotEqual => BinaryOp::Equal,
        BinaryOp::Greater => BinaryOp::LessEqual,
        BinaryOp::GreaterEqual => BinaryOp::Less,
        BinaryOp::Less => BinaryOp::GreaterEqual,
        BinaryOp::LessEqual => BinaryOp::Greater,
        _ => return None,
    })
}

/// How numbers without decimal point count on this machine.
fn settle_unpointed(model: &Model<'_>, machine: &Machine, assumptions: &mut Assumptions) -> Unpointed {
    let numbers = model.control().numbers();
    let Some(setting) = &numbers.unpointed_setting else { return model.unpointed() };
    let number = setting.rsplit(' ').next().unwrap_or_default();
    let Some(entry) = model.control().setting(number) else { return model.unpointed() };
    match machine.settings.get(number) {
        None => {
            if model.unpointed() == Unpointed::ByParameter {
                assumptions.insert(Assumption::Setting(number.to_owned()));
            }
            model.unpointed()
        }
        Some(value) if Some(value) == entry.as_written.as_ref() => Unpointed::AsWritten,
        Some(_) => Unpointed::LeastIncrement,
    }
}
