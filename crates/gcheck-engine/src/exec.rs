//! One block, one step: the only place where a block changes a state.
//!
//! Knows: the order inside a block, statements, and which effect handler a code calls. Must not know: which domain it runs in,
//! how paths are explored.

mod arc;
pub(crate) mod context;
mod contract;
mod corner;
mod effects;
mod flow_control;
pub(crate) mod look;
mod message;
mod motion;
mod o_words;
mod order;
pub(crate) mod past_alarm;
pub(crate) mod plain;

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_program::{Block, BlockFlags, BlockTable, ExprIx, Place, StatementKind, Word};
use rustc_hash::FxHashMap;

use self::context::{Cursor, Ending, Executor, Options, Outcome, Step};
use self::order::{Action, Parts};
use crate::assumption::{Assumption, Assumptions};

use crate::eval::numbers::{is_unpointed_open, settle_unpointed};
use crate::eval::value::{Domain, Truth};
use crate::eval::words::BlockWords;
use crate::event::Event;
use crate::fault::Fault;
use crate::lattice::Lattice;
use crate::machine::Machine;
use crate::model::contract::POLAR;
use crate::model::{Model, Role};
use crate::observer::Observer;
use crate::origin::{At, Origin, origin_of};
use crate::program::{Program, ProgramFile};
use crate::state::State;

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
            unpointed_is_open: is_unpointed_open(model, machine),
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
    pub(crate) fn place(&mut self, at: At) -> Option<Place> {
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
    pub(crate) fn emit(&mut self, state: &mut State<D>, event: Event) {
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

    // ---- expressions ----

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
}

/// What remains of a block after its statements.
enum Statements<D: Domain> {
    /// Its words.
    Words,
    /// Nothing.
    Done(Outcome<D>),
}

/// Blocks whose form may be refused.
const FORM: BlockFlags = BlockFlags::LABEL
    .union(BlockFlags::LONG_LINE)
    .union(BlockFlags::BLOCK_DELETE)
    .union(BlockFlags::PROGRAM_NUMBER);

const FEED_SPEED_TOOL: LetterSet = LetterSet::of("FST");
