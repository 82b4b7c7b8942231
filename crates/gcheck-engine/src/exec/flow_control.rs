//! Jumps, loops, calls and returns.
//!
//! Knows: where control goes, what a call keeps and what it gives. Must not know: conditions' values (the domain decides), motion.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter, ReturnTo, Unset};
use gcheck_program::{BlockFlags, BlockTable, ExprIx, Place, Value, Word};

use crate::assumption::{Assumption, Assumptions, Unsettled};
use crate::eval::value::{Domain, Truth};
use crate::exec::context::{Callee, Count, Ending, Executor, Flow, Outcome, Step};
use crate::fault::Fault;
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::observer::Observer;
use crate::origin::At;
use crate::start::start_state;
use crate::state::{BarCommand, Frame, FrameKind, Kept, Locals, ModalCall, ModalCalls, State};

impl<D: Domain> Callee<D> {
    /// A program that is called without words.
    fn plain(kind: FrameKind, target: At, repeats: Option<u32>) -> Self {
        Self { kind, target, repeats, may_be_skipped: false, arguments: Vec::new(), bar_feed: Perhaps::No }
    }

    /// A subroutine with the values of its arguments.
    pub(super) fn of_subroutine(target: At, arguments: Vec<(u32, D::Value)>) -> Self {
        Self { arguments, ..Self::plain(FrameKind::OWord, target, Some(0)) }
    }

    /// A macro with the words of its call.
    fn of_macro(target: At, repeats: Option<u32>, arguments: Vec<(u32, D::Value)>) -> Self {
        Self { arguments, ..Self::plain(FrameKind::Macro, target, repeats) }
    }

    /// The macro of a modal call.
    fn of_modal(call: &ModalCall<D>) -> Self {
        Self::of_macro(call.target, further_turns(call.repeats.known()), call.arguments.clone())
    }
}

/// The turns that come after the first.
fn further_turns(turns: Option<u32>) -> Option<u32> {
    turns.map(|turns| turns.saturating_sub(1))
}

/// Labels that a computed jump is followed to: one more than an analysis keeps waiting, so that it gives up rather than
/// leave some out.
const MOST_TARGETS: usize = 4097;

/// Calls that nest deeper than this are taken for a recursion without end where the control names no limit.
const DEEPEST: usize = 64;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Goes where the block's codes said.
    pub(super) fn follow(&mut self, flow: Flow<D>, state: &mut State<D>) -> Step<Outcome<D>> {
        match flow {
            Flow::Jump(at) => Ok(Outcome::Jump(at)),
            Flow::End(ending) => Ok(Outcome::End(ending)),
            Flow::Call(callee) => self.enter(callee, state),
            Flow::Return { label } => self.leave(label, None, state),
            Flow::ModalCall => self.follow_modal_call(state),
            Flow::MayJump(at) => {
                Ok(Outcome::Fork(vec![(self.origin.at.next(), state.clone()), (at, state.clone())]))
            }
        }
    }

    // ---- jumps ----

    /// `GOTO`: the label of a value.
    pub(super) fn jump_to_label(&mut self, value: &D::Value, state: &State<D>) -> Step<Outcome<D>> {
        let at = self.origin.at;
        let Some(number) = D::known(value) else { return self.jump_anywhere(value, state) };
        match self.label(number, at)? {
            Some(to) => Ok(Outcome::Jump(to)),
            #[expect(clippy::cast_sign_loss, reason = "labels are counts; `label` refused others")]
            None => Err(Fault::NoSuchLabel(number as u32)),
        }
    }

    fn label(&self, number: f64, at: At) -> Step<Option<At>> {
        let whole = number.round();
        if !(0.0..=f64::from(u32::MAX)).contains(&whole) {
            return Err(Fault::JumpTarget(whole));
        }
        let Some(file) = self.file(at.file) else { return Ok(None) };
        let forward = self.model.semantics().goto_forward_first;
        #[expect(clippy::cast_sign_loss, reason = "range checked above")]
        let block = file.loaded.flow_graph().label(whole as u32, at.block, forward);
        Ok(block.map(|block| At { file: at.file, block }))
    }

    /// A computed jump whose target is not known: every label of the program that it may be.
    fn jump_anywhere(&mut self, value: &D::Value, state: &State<D>) -> Step<Outcome<D>> {
        let at = self.origin.at;
        let Some(file) = self.file(at.file) else { return Err(Fault::Undecidable) };
        let graph = file.loaded.flow_graph();
        let part = graph.part_of(at.block);
        let (low, high) = D::bounds(value).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let fits = |number: u32| (low - 0.5..=high + 0.5).contains(&f64::from(number));
        let targets: Vec<(At, State<D>)> = graph
            .labels_in(part)
            .filter(|(number, _)| fits(*number))
            .take(MOST_TARGETS)
            .map(|(_, block)| (At { file: at.file, block }, state.clone()))
            .collect();
        match targets.as_slice() {
            [] => Err(Fault::Undecidable),
            [(only, _)] => Ok(Outcome::Jump(*only)),
            _ => Ok(Outcome::Fork(targets)),
        }
    }

    /// `M96 P… Q…`: on an input that nobody knows.
    pub(super) fn jump_unless_input(&mut self, state: &mut State<D>) -> Step {
        let Some(Count::Known(number)) = self.count(Letter::of('P'))? else {
            return Err(Fault::MissingWord(Letter::of('P')));
        };
        let at = self.origin.at;
        let Some(to) = self.label(f64::from(number), at)? else { return Err(Fault::NoSuchLabel(number)) };
        let _ = state;
        self.flow = Some(Flow::MayJump(to));
        Ok(())
    }

    // ---- loops ----

    /// `WHILE […] DO n`, `DO n`.
    pub(super) fn loop_head(
        &mut self,
        place: &Place,
        table: &BlockTable,
        condition: Option<ExprIx>,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        let at = self.origin.at;
        let end = self.file(at.file).and_then(|file| file.loaded.flow_graph().end_of(at.block));
        let Some(end) = end else { return Err(Fault::LoopMismatch) };
        let behind = At { file: at.file, block: end + 1 };
        let Some(condition) = condition else { return Ok(Outcome::Next) };
        match self.condition(place, table, condition, state)? {
            Truth::True => {
                self.assume(table, condition, true, state);
                Ok(Outcome::Next)
            }
            Truth::False => {
                self.assume(table, condition, false, state);
                Ok(Outcome::Jump(behind))
            }
            Truth::Unknown => Ok(self.both_ways(table, condition, at.next(), behind, state)),
        }
    }

    /// Forks on a condition, each way with what the condition then says.
    pub(super) fn both_ways(
        &mut self,
        table: &BlockTable,
        condition: ExprIx,
        holds: At,
        fails: At,
        state: &State<D>,
    ) -> Outcome<D> {
        let mut yes = state.clone();
        self.assume(table, condition, true, &mut yes);
        let mut no = state.clone();
        self.assume(table, condition, false, &mut no);
        Outcome::Fork(vec![(holds, yes), (fails, no)])
    }

    /// `END n`.
    pub(super) fn loop_end(&mut self) -> Step<Outcome<D>> {
        let at = self.origin.at;
        let head = self.file(at.file).and_then(|file| file.loaded.flow_graph().do_of(at.block));
        head.map_or(Err(Fault::LoopMismatch), |block| Ok(Outcome::Jump(At { file: at.file, block })))
    }

    // ---- calls ----

    /// `M97`, `M98`.
    pub(super) fn call_code(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let letter = Letter::of('P');
        let Some(count) = self.count(letter)? else { return self.call_by_comment(letter, state) };
        let mut turns = self.turns(self.call_repeats()?)?;
        let zero_skips = self.model.semantics().zero_repeats_skip;
        if turns == Some(0) && zero_skips {
            return Ok(());
        }
        let Count::Known(mut number) = count else { return self.call_unknown(state) };
        let at = self.origin.at;
        let (kind, target) = if effect == Effect::CallLocal {
            (FrameKind::Local, self.label(f64::from(number), at)?)
        } else {
            let mut target = self.program.find_number(number, at.file);
            if target.is_none() && self.packs_repeats() && number > 9999 {
                // Digits in front of the last four count the repeats.
                turns = Some(number / 10_000);
                number %= 10_000;
                target = self.program.find_number(number, at.file);
            }
            (FrameKind::Subprogram, target)
        };
        let Some(target) = target else {
            return self.missing_program(number, effect == Effect::CallLocal, state);
        };
        self.flow = Some(Flow::Call(Callee {
            may_be_skipped: turns.is_none() && zero_skips,
            ..Callee::plain(kind, target, further_turns(turns))
        }));
        Ok(())
    }

    /// How many turns a call makes, `None` where nobody knows: a run cannot go on then, an analysis follows any number of them.
    fn turns(&self, count: Option<Count>) -> Step<Option<u32>> {
        match count {
            None => Ok(Some(1)),
            Some(Count::Known(turns)) => Ok(Some(turns)),
            Some(Count::Unknown) if self.lenient => Ok(None),
            Some(Count::Unknown) => Err(Fault::Undecidable),
        }
    }

    /// A program whose number nobody knows is called: it may be any in the control's memory.
    fn call_unknown(&mut self, state: &mut State<D>) -> Step {
        self.refuse(Fault::Undecidable)?;
        self.lose_everything(state)
    }

    /// A call without a number: some codes take the path of the program from a comment, and which program that is, nobody
    /// looks up.
    fn call_by_comment(&mut self, letter: Letter, state: &mut State<D>) -> Step {
        let by_comment = |ix: &CodeIx| {
            let code = self.model.control().code_at(*ix);
            code.is_some_and(|code| {
                let mut words = code.entry().words.iter();
                words.any(|word| word.unless_comment && Letter::parse(&word.letter) == Some(letter))
            })
        };
        let code = self.words.codes().iter().copied().find(by_comment);
        let Some(code) = code.filter(|_| self.origin.flags.contains(BlockFlags::COMMENT)) else {
            return Err(Fault::MissingWord(letter));
        };
        self.assumptions.insert(Assumption::Code(code));
        self.lose_everything(state)
    }

    fn call_repeats(&self) -> Step<Option<Count>> {
        match self.model.semantics().call_repeats {
            Some(letter) => self.count(Letter::of(letter)),
            None => Ok(None),
        }
    }

    fn packs_repeats(&self) -> bool {
        let packs =
            |code: gcheck_controls::Code<'_>| code.entry().words.iter().any(|word| word.packed_repeats);
        self.model.control().codes().any(packs)
    }

    /// A program that is not here may be in the control's memory: after it, hardly anything is known.
    pub(super) fn missing_program(&mut self, number: u32, local: bool, state: &mut State<D>) -> Step {
        if local {
            return Err(Fault::NoSuchLabel(number));
        }
        self.assumptions.insert(Assumption::MissingProgram(number));
        if self.refuses_incomplete() {
            return Err(Fault::NoSuchProgram);
        }
        self.lose_everything(state)
    }

    /// Something ran that we do not know. The options say what is taken to be left as it was.
    pub(super) fn lose_everything(&mut self, state: &mut State<D>) -> Step {
        // What compensation holds back was commanded before.
        let flushed = self.flush_compensation(state);
        if self.options.keeps_what_was_set {
            let before = state.clone();
            state.forget();
            let start = self.start.get_or_insert_with(|| {
                Box::new(start_state(self.model, self.machine, &mut Assumptions::default()))
            });
            state.keep_what_was_set(&before, start);
        } else if !self.options.assumes {
            state.forget();
        }
        flushed
    }

    /// `G65`, `G66`, a code that is an alias of a macro.
    pub(super) fn macro_call(
        &mut self,
        effect: Effect,
        ix: CodeIx,
        _place: &Place,
        words: &[Word],
        state: &mut State<D>,
    ) -> Step {
        let letter = Letter::of('P');
        let number = match self.alias_of(ix) {
            Some(number) => Some(Count::Known(number)),
            None => self.count(letter)?,
        };
        let Some(number) = number else { return Err(Fault::MissingWord(letter)) };
        let turns = self.turns(self.count(Letter::of('L'))?)?;
        let is_modal = effect == Effect::MacroModal;
        let Count::Known(number) = number else {
            if is_modal {
                self.refuse(Fault::Undecidable)?;
                state.calls.modal = ModalCalls::unknown();
                return Ok(());
            }
            return self.call_unknown(state);
        };
        let arguments = self.arguments(words, state);
        let Some(target) = self.program.find_number(number, self.origin.at.file) else {
            if is_modal {
                self.assumptions.insert(Assumption::MissingProgram(number));
                state.calls.modal = ModalCalls::off();
                return Ok(());
            }
            return self.missing_program(number, false, state);
        };
        if is_modal {
            let repeats = turns.into();
            state.calls.modal = ModalCalls::on(ModalCall { target, arguments, repeats });
            return Ok(());
        }
        self.flow = Some(Flow::Call(Callee::of_macro(target, further_turns(turns), arguments)));
        Ok(())
    }

    fn alias_of(&self, ix: CodeIx) -> Option<u32> {
        let code = self.model.control().code_at(ix)?;
        if !code.is_user() {
            return None;
        }
        code.alias()?.trim_start_matches(['O', 'o']).parse().ok()
    }

    /// The argument words as local variables. Repeated `I`, `J`, `K` go to the next three.
    fn arguments(&mut self, words: &[Word], state: &State<D>) -> Vec<(u32, D::Value)> {
        let mut arguments: Vec<(u32, D::Value)> = Vec::new();
        let mut seen = [0_u32; 3];
        let several = "IJK".chars().any(|l| words.iter().filter(|w| w.letter == Letter::of(l)).count() > 1);
        let whole = self.model.semantics().whole_arguments.as_deref();
        let units = self.units_of_block(words, state);
        for word in words {
            if word.code.is_some() {
                continue;
            }
            let Some((_, first)) =
                self.model.argument_letters.iter().find(|(letter, _)| *letter == word.letter)
            else {
                continue;
            };
            let mut number = *first;
            if several
                && let Some(turn) = "IJK".chars().position(|l| word.letter == Letter::of(l))
                && let Some(count) = seen.get_mut(turn)
            {
                number = 4 + turn as u32 + 3 * *count;
                *count += 1;
            }
            let value = match (word.value, whole) {
                (Value::Number(literal), Some(whole)) if word.shape.digits() > 0 => {
                    D::number(if word.shape.point {
                        literal
                    } else {
                        self.unpointed_argument(word.letter, literal, whole, units)
                    })
                }
                // The value that the block's words hold is scaled; of a repeated address only the last is there.
                (Value::Number(literal), _) if several => D::number(literal),
                _ => self.words.get(word.letter).unwrap_or_else(D::vacant),
            };
            arguments.push((number, value));
        }
        arguments
    }

    /// `G66`: the macro runs after every block that moves, but not after its own or those of what it calls.
    pub(super) fn modal_call(&mut self, state: &State<D>) {
        if !state.calls.modal.is_off() {
            self.flow = Some(Flow::ModalCall);
        }
    }

    /// Calls the macro of `G66`, or goes every way that it may be.
    fn follow_modal_call(&mut self, state: &mut State<D>) -> Step<Outcome<D>> {
        let here = self.origin.at.next();
        let Some(calls) = state.calls.modal.calls().map(<[_]>::to_vec) else {
            // Any macro may run, or none.
            self.assumptions.insert(Assumption::Unsettled(Unsettled::ModalCall));
            let without = state.clone();
            self.lose_everything(state)?;
            *state = state.join(&without);
            return Ok(Outcome::Next);
        };
        let runs = |call: &ModalCall<D>, state: &State<D>| {
            let mut frames = state.calls.frames().iter();
            frames.any(|frame| frame.kind == FrameKind::Macro && frame.entry == call.target)
        };
        let may_be_off = state.calls.modal.may_be_off();
        if let ([call], false) = (calls.as_slice(), may_be_off) {
            return if runs(call, state) {
                Ok(Outcome::Next)
            } else {
                self.enter(Callee::of_modal(call), state)
            };
        }
        let mut ways = Vec::new();
        if may_be_off {
            let mut without = state.clone();
            without.calls.modal = ModalCalls::off();
            ways.push((here, without));
        }
        let mut refused = None;
        for call in calls {
            let mut way = state.clone();
            way.calls.modal = ModalCalls::on((*call).clone());
            let outcome = if runs(&call, &way) {
                Ok(Outcome::Next)
            } else {
                self.enter(Callee::of_modal(&call), &mut way)
            };
            match outcome {
                Ok(Outcome::Jump(to)) => ways.push((to, way)),
                Ok(_) => ways.push((here, way)),
                Err(fault) => refused = Some(fault),
            }
        }
        if let Some(fault) = refused {
            if ways.is_empty() {
                return Err(fault);
            }
            self.assumptions.insert(Assumption::Unsettled(Unsettled::ModalCall));
        }
        Ok(Outcome::Fork(ways))
    }

    pub(super) fn enter(&mut self, callee: Callee<D>, state: &mut State<D>) -> Step<Outcome<D>> {
        let limit = self.model.control().limits().call_depth.map_or(DEEPEST, usize::from);
        if state.calls.depth() > limit.min(DEEPEST) {
            return Err(Fault::TooDeep);
        }
        let Callee { kind, target, repeats, may_be_skipped, arguments, bar_feed } = callee;
        let skipped = may_be_skipped.then(|| state.clone());
        let semantics = self.model.semantics();
        let own_locals = match kind {
            FrameKind::Macro | FrameKind::OWord => true,
            FrameKind::Subprogram => semantics.locals_per_subprogram,
            FrameKind::Main | FrameKind::Local => false,
        };
        let mut frame = Frame::new(kind, target, self.origin.at, repeats);
        frame.kept.bar_feed = bar_feed;
        if own_locals {
            let unset = match semantics.unset {
                Unset::Vacant => D::vacant(),
                Unset::Zero => D::number(0.0),
            };
            let mut locals = Locals::new(semantics.locals[1], &unset);
            for (number, value) in arguments {
                locals.set(number, value);
            }
            frame.locals = Perhaps::Yes(locals);
        }
        state.calls.push(frame);
        Ok(match skipped {
            None => Outcome::Jump(target),
            Some(skipped) => Outcome::Fork(vec![(target, state.clone()), (self.origin.at.next(), skipped)]),
        })
    }

    /// The cutoff program of a bar feed, which goes on when it comes back.
    pub(super) fn cut_off_then_feed(&mut self, target: At, feed: BarCommand) {
        self.flow = Some(Flow::Call(Callee {
            bar_feed: Perhaps::Yes(Rc::new(feed)),
            ..Callee::plain(FrameKind::Subprogram, target, Some(0))
        }));
    }

    /// `M99`, `ENDSUB`, `RETURN`.
    pub(super) fn leave(
        &mut self,
        label: Option<D::Value>,
        result: Option<D::Value>,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        if state.calls.is_main() {
            return self.leave_main(label, state);
        }
        if !state.calls.is_known() {
            self.assumptions.insert(Assumption::Unsettled(Unsettled::Caller));
            return Err(Fault::Undecidable);
        }
        let semantics = self.model.semantics();
        if let Some(label) = &label {
            match semantics.return_to {
                ReturnTo::Same => match self.jump_to_label(label, state) {
                    Err(fault) => self.refuse(fault)?,
                    jump => return jump,
                },
                ReturnTo::Ignored if self.refuses_incomplete() => return Err(Fault::Conflict),
                ReturnTo::Ignored | ReturnTo::Caller => {}
            }
        }
        let Some(entry) = state.calls.last().map(|frame| frame.entry) else { return Err(Fault::StrayReturn) };
        let Some(kept) = state.calls.kept_mut() else { return Err(Fault::StrayReturn) };
        match kept.repeats {
            Flat::Known(0) => {}
            Flat::Known(left) => {
                kept.repeats = Flat::Known(left - 1);
                kept.counters.clear();
                return Ok(Outcome::Jump(entry));
            }
            Flat::Unknown => {
                // Once more, or not.
                let mut again = state.clone();
                if let Some(kept) = again.calls.kept_mut() {
                    kept.counters.clear();
                }
                return Ok(match self.pop(label, result, state)? {
                    Outcome::Jump(at) => Outcome::Fork(vec![(entry, again), (at, state.clone())]),
                    Outcome::Fork(mut ways) => {
                        ways.insert(0, (entry, again));
                        Outcome::Fork(ways)
                    }
                    other => other,
                });
            }
        }
        self.pop(label, result, state)
    }

    fn pop(
        &mut self,
        label: Option<D::Value>,
        result: Option<D::Value>,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        let Some(frame) = state.calls.pop() else { return Err(Fault::StrayReturn) };
        let Frame { kind, caller, kept, .. } = frame;
        let mut without = self.restore_on_return(&kept, state);
        if kind == FrameKind::OWord {
            let returned = f64::from(u8::from(result.is_some()));
            let value = result.unwrap_or_else(|| D::number(0.0));
            let (name, flag) = (self.program.name("_value"), self.program.name("_value_returned"));
            for state in std::iter::once(&mut *state).chain(&mut without) {
                state.variables.set_named(name, value.clone());
                state.variables.set_named(flag, D::number(returned));
            }
        }
        match &kept.bar_feed {
            Perhaps::No => {}
            Perhaps::Yes(feed) => {
                if let Some(ending) = self.feed_after_cutoff(caller, feed, state)? {
                    return Ok(Outcome::End(ending));
                }
            }
            Perhaps::Unknown => {
                self.assumptions.insert(Assumption::Unsettled(Unsettled::BarFeed));
                self.lose_everything(state)?;
            }
        }
        let to = match label {
            Some(label) if self.model.semantics().return_to == ReturnTo::Caller => {
                match self.label_in_caller(&label, caller) {
                    Ok(to) => to,
                    // Corrected, it returns all the same.
                    Err(fault) => {
                        self.refuse(fault)?;
                        caller.next()
                    }
                }
            }
            _ => caller.next(),
        };
        Ok(match without {
            None => Outcome::Jump(to),
            Some(without) => Outcome::Fork(vec![(to, without), (to, state.clone())]),
        })
    }

    /// The block of a return with a label: it is looked for in the program that called.
    fn label_in_caller(&self, label: &D::Value, caller: At) -> Step<At> {
        let Some(number) = D::known(label) else { return Err(Fault::Undecidable) };
        #[expect(clippy::cast_sign_loss, reason = "labels are counts; `label` refused others")]
        self.label(number, caller)?.ok_or(Fault::NoSuchLabel(number as u32))
    }

    /// `M73`: brings modes back on return. The state in which they are not, where nobody knows whether they are to be.
    fn restore_on_return(&mut self, kept: &Kept, state: &mut State<D>) -> Option<State<D>> {
        if kept.restore_on_return == Truth::False {
            return None;
        }
        match &kept.saved {
            Perhaps::No => None,
            Perhaps::Yes(saved) => {
                let without = (kept.restore_on_return == Truth::Unknown).then(|| state.clone());
                self.restore(saved, state);
                without
            }
            Perhaps::Unknown => {
                self.forget_modes(None, state);
                None
            }
        }
    }

    /// `M99` in a main program.
    fn leave_main(&mut self, label: Option<D::Value>, state: &mut State<D>) -> Step<Outcome<D>> {
        if let Some(label) = label {
            match self.model.semantics().return_to {
                ReturnTo::Ignored if self.refuses_incomplete() => return Err(Fault::Conflict),
                _ => match self.jump_to_label(&label, state) {
                    Err(fault) => self.refuse(fault)?,
                    jump => return jump,
                },
            }
        }
        if self.refuses_incomplete() {
            self.end_program(false, state)?;
        }
        Ok(Outcome::End(Ending::Restart))
    }
}
