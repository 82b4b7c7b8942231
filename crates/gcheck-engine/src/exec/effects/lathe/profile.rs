//! Cycles that cut a profile written elsewhere in the program, and how that profile is read.
//!
//! Knows: which blocks hold a profile, what their words draw, which words a roughing cycle takes. Must not know: the strokes
//! ([`crate::cycles`]).
//!
//! A profile stands between two sequence numbers, behind the cycle (then control goes on behind the profile) or before it;
//! or it is a subprogram. Reading it moves nothing: the blocks change a state that is thrown away. A finishing pass between
//! sequence numbers, though, is those blocks executed, with their feeds and compensation.

use std::rc::Rc;

use gcheck_controls::{CodeIx, Effect, Letter, LetterSet};
use gcheck_geometry::{Arc, ArcDirection, Mm, Plane};
use gcheck_program::{BlockFlags, OLabel, Word};

use super::keep;
use crate::assumption::Assumption;
use crate::cycles::{
    CycleError, LayeredFinish, LayeredRoughing, PatternRepeat, Pockets, ProfileFault, ProfileSegment,
    Roughing, RoughingDirection, layered_finish, layered_roughing, pattern_repeat, roughing,
};
use crate::eval::value::Domain;
use crate::event::{Event, TravelKind, Units};
use crate::exec::Statements;
use crate::exec::arc::{arc_fault, plane_axes};
use crate::exec::context::{Count, Executor, Flow, Outcome, Step};
use crate::exec::corner::{Corner, Fit, cut_corner};
use crate::fault::{ArcFault, CycleFault, Fault};
use crate::lattice::Perhaps;
use crate::model::Role;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::position::Axis;
use crate::state::{Frame, FrameKind, Locals, State};

/// Blocks that reading one profile may execute. A profile of more is taken for one whose loop never ends.
const MOST_BLOCKS: u32 = 5_000;

/// Blocks that hold a profile.
#[derive(Debug, Clone, Copy)]
pub(in crate::exec) struct ProfileBlocks {
    /// The file.
    pub(in crate::exec) file: u32,
    /// The first block.
    pub(in crate::exec) first: u32,
    /// The last block.
    pub(in crate::exec) last: u32,
}

/// A profile as it was read.
#[derive(Debug)]
pub(in crate::exec) struct ReadProfile {
    /// Its pieces in the plane's first and second axis, X as a radius.
    pub(in crate::exec) segments: Vec<ProfileSegment>,
    /// Every block was read, and every condition on the way known.
    pub(in crate::exec) complete: bool,
}

/// The words of `G70` to `G72.2` where `Q` is a subprogram.
struct LayeredWords {
    depth: Mm,
    increment: Mm,
    retract: Mm,
    nearest: Mm,
    passes: f64,
    units: Units,
}

impl LayeredWords {
    #[expect(clippy::cast_sign_loss, reason = "a negative count becomes none")]
    const fn finish(&self) -> LayeredFinish {
        LayeredFinish { first: self.depth, last: self.nearest, passes: self.passes as u32, units: self.units }
    }

    fn roughing(&self, effect: Effect, pockets: Pockets) -> LayeredRoughing {
        let along_x = effect == Effect::RoughAlongX;
        LayeredRoughing {
            direction: if along_x { RoughingDirection::AlongX } else { RoughingDirection::AlongZ },
            increment: self.increment,
            retract: self.retract,
            stock: self.depth,
            units: self.units,
            pockets,
        }
    }
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G70` to `G73` of lathes.
    pub(in crate::exec) fn profile_cycle(
        &mut self,
        effect: Effect,
        ix: CodeIx,
        state: &mut State<D>,
    ) -> Step {
        if !self.takes_label(ix, "P") {
            return self.layered_cycle(effect, ix, state);
        }
        let (p, q) = (self.raw(Letter::of('P'), state), self.raw(Letter::of('Q'), state));
        let (first, last) = match (p, q) {
            (None, None) if effect != Effect::FinishProfile => {
                return self.store_first_block(effect, state);
            }
            (Some(p), Some(q)) => (p, q),
            (None, _) => return Err(Fault::MissingWord(Letter::of('P'))),
            (_, None) => return Err(Fault::MissingWord(Letter::of('Q'))),
        };
        let here = self.origin.at;
        let Some(blocks) = self.labelled_blocks(first, last)? else {
            // Nobody knows which blocks they are; the tool ends where it began.
            self.assumptions.insert(Assumption::Passes(ix));
            return Ok(());
        };
        if (blocks.first..=blocks.last).contains(&here.block) {
            return Err(Fault::Profile);
        }
        if effect == Effect::FinishProfile {
            self.execute_profile(blocks, state)?;
        } else {
            self.rough_profile(effect, blocks, state)?;
        }
        if blocks.first > here.block {
            self.flow = Some(Flow::Jump(At { file: here.file, block: blocks.last + 1 }));
        }
        Ok(())
    }

    /// The blocks between two sequence numbers; `None` when a number is not known.
    fn labelled_blocks(&self, first: f64, last: f64) -> Step<Option<ProfileBlocks>> {
        if first.is_nan() || last.is_nan() {
            return Ok(None);
        }
        let at = self.origin.at;
        let Some(file) = self.file(at.file) else { return Ok(None) };
        let find = |number: f64, from: u32, letter: char| {
            let range = 0.0..=f64::from(u32::MAX);
            if !range.contains(&number) || (number - number.round()).abs() > 1e-4 {
                return Err(Fault::WordRange(Letter::of(letter)));
            }
            #[expect(clippy::cast_sign_loss, reason = "range checked above")]
            let number = number.round() as u32;
            file.loaded.flow_graph().label(number, from, true).ok_or(Fault::NoSuchLabel(number))
        };
        let first = find(first, at.block, 'P')?;
        let last = find(last, first, 'Q')?;
        if last < first {
            Err(Fault::Profile)
        } else {
            Ok(Some(ProfileBlocks { file: at.file, first, last }))
        }
    }

    /// The first of two blocks: depth and way back, or shift and passes.
    fn store_first_block(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let not_positive = |letter: char, value: Option<f64>| match value {
            Some(value) if value <= 0.0 => Err(Fault::Cycle(CycleFault::NotPositive(Letter::of(letter)))),
            _ => Ok(()),
        };
        let mut words = state.turning();
        let length = |letter: char| self.length(Letter::of(letter), state);
        let (in_x, in_z, back) = (length('U'), length('W'), length('R'));
        if effect == Effect::RepeatPattern {
            let passes = self.raw(Letter::of('R'), state);
            not_positive('R', passes)?;
            // `R4`, and `R0.004` on controls that want a point, are both four passes.
            let [x, z, count] = &mut words.pattern;
            *x = in_x.or(*x);
            *z = in_z.or(*z);
            *count = passes.or(*count);
        } else {
            let along_x = effect == Effect::RoughAlongX;
            let depth = if along_x { in_z } else { in_x };
            not_positive(if along_x { 'W' } else { 'U' }, depth)?;
            let [kept, retract] = &mut words.roughing;
            *kept = depth.or(*kept);
            *retract = back.or(*retract);
        }
        keep(&words, state);
        Ok(())
    }

    /// `G71` to `G73` between sequence numbers.
    fn rough_profile(&mut self, effect: Effect, blocks: ProfileBlocks, state: &mut State<D>) -> Step {
        let checked = self.check_feed(state);
        let mut scratch = state.clone();
        let profile = self.read_profile(blocks, Plane::Zx, &mut scratch)?;
        let half = if state.is_diameter(self.model) == Some(true) { 2.0 } else { 1.0 };
        let length = |letter: char| self.length(Letter::of(letter), state).unwrap_or(0.0);
        let stock = (Mm(length('W')), Mm(length('U') / half));
        let more = (Mm(length('K')), Mm(length('I')));
        let from = state.position().xyz();
        let mut strokes = Vec::new();
        let mut out = |stroke| strokes.push(stroke);
        let result = if !profile.complete {
            Err(CycleError::Unknown)
        } else if effect == Effect::RepeatPattern {
            match self.pattern(stock, more, state) {
                Some(words) => pattern_repeat(from, &profile.segments, &words, &mut out),
                None => Err(CycleError::Unknown),
            }
        } else {
            let words = self.roughing_words(effect, stock, state);
            if more == (Mm::ZERO, Mm::ZERO) {
                roughing(from, &profile.segments, &words, &mut out)
            } else {
                // More is left at first; one pass along the profile takes it down to the finishing stock.
                let first = Roughing { stock: (stock.0 + more.0, stock.1 + more.1), ..words };
                let once = PatternRepeat { passes: 1, total: (Mm::ZERO, Mm::ZERO), stock };
                roughing(from, &profile.segments, &first, &mut out)
                    .and_then(|_| pattern_repeat(from, &profile.segments, &once, &mut out))
            }
        };
        // What a control makes of a profile of another shape (alarm, another type of cycle, an option) is not known.
        let result = match result {
            Err(CycleError::Profile(fault)) if fault != ProfileFault::Empty => Err(CycleError::Unknown),
            result => result,
        };
        if matches!(result, Err(CycleError::Unknown)) {
            strokes.clear();
            let codes = self.words.codes().iter().copied();
            let unknown: Vec<CodeIx> = codes.filter(|ix| self.model.effect(*ix) == effect).collect();
            self.assumptions.extend(unknown.into_iter().map(Assumption::Passes));
        }
        let start = *state.position();
        let held = self.hold_compensation(state)?;
        let outcome = self.carry_out(&strokes, result, Plane::Zx, start, state);
        Self::release_compensation(held, state);
        outcome?;
        checked
    }

    /// How deep and how far back, from the block, the first block, or settings.
    fn roughing_words(&mut self, effect: Effect, stock: (Mm, Mm), state: &State<D>) -> Roughing {
        let along_x = effect == Effect::RoughAlongX;
        let unit = self.unit(state);
        let [depth, retract] = state.turning().roughing;
        let set = |value: f64| Some(value * unit).filter(|value| *value > 0.0);
        let depth = self.length(Letter::of('D'), state).or(depth).or_else(|| set(self.number_setting("72")));
        let retract = retract.or_else(|| set(self.number_setting("73")));
        Roughing {
            direction: if along_x { RoughingDirection::AlongX } else { RoughingDirection::AlongZ },
            depth: Mm(depth.unwrap_or(f64::NAN)),
            retract: Mm(retract.unwrap_or(0.0)),
            stock,
            pockets: true,
        }
    }

    /// How often and from how far: `D` with `K` and `I` in one block, else what the first block said.
    fn pattern(&mut self, stock: (Mm, Mm), more: (Mm, Mm), state: &State<D>) -> Option<PatternRepeat> {
        let [x, z, stored] = state.turning().pattern;
        let (count, total) = match self.raw(Letter::of('D'), state) {
            Some(count) => (count, more),
            None => (stored?, (Mm(z.unwrap_or(0.0)), Mm(x.unwrap_or(0.0)))),
        };
        #[expect(clippy::cast_sign_loss, reason = "a negative count becomes none, which is refused")]
        let passes = count.round() as u32;
        count.is_finite().then_some(PatternRepeat { passes, total, stock })
    }

    /// The finishing pass: the profile's blocks as they stand, then back at rapid.
    fn execute_profile(&mut self, blocks: ProfileBlocks, state: &mut State<D>) -> Step {
        if self.holds_profile_cycle(blocks) {
            return Err(Fault::Profile);
        }
        let (origin, words) = (self.origin, self.words.clone());
        let pending = std::mem::take(&mut self.pending);
        let start = *state.position();
        let mut block = blocks.first;
        let mut left = MOST_BLOCKS;
        let mut refused = None;
        while (blocks.first..=blocks.last).contains(&block) {
            left = left.checked_sub(1).ok_or(Fault::Profile)?;
            match self.step(At { file: blocks.file, block }, state) {
                Outcome::Next => block += 1,
                Outcome::Jump(to) if to.file == blocks.file => block = to.block,
                Outcome::Jump(_) | Outcome::End(_) => return Err(Fault::Profile),
                // A way that depends on what nobody knows; it leads back to the start in any case.
                Outcome::Fork(_) => {
                    self.emit(state, Event::Unfollowed);
                    break;
                }
                Outcome::Fault(fault) if self.lenient => {
                    refused.get_or_insert_with(|| (fault, self.origin, Box::new(state.clone())));
                    block += 1;
                }
                // The fault is that block's.
                Outcome::Fault(fault) => return Err(fault),
            }
        }
        self.origin = origin;
        self.words = words;
        self.pending = pending;
        self.flow = None;
        self.machine_coordinates = false;
        self.travel(TravelKind::Rapid, start, true, state)?;
        match refused {
            None => Ok(()),
            Some((fault, block, then)) => {
                self.origin = block;
                self.at_fault = Some(then);
                Err(fault)
            }
        }
    }

    /// A profile that runs profiles may come back to itself.
    fn holds_profile_cycle(&mut self, blocks: ProfileBlocks) -> bool {
        let mut blocks_read = (blocks.first..=blocks.last).take(MOST_BLOCKS as usize);
        blocks_read.any(|block| {
            let Some(place) = self.place(At { file: blocks.file, block }) else { return false };
            let mut words = place.table.words(place.block()).iter();
            words.any(|word| self.model.effect(word.code) == Effect::FinishProfile)
        })
    }

    // ---- profiles in subprograms ----

    /// `G70` to `G72.2` where `Q` is a subprogram.
    fn layered_cycle(&mut self, effect: Effect, ix: CodeIx, state: &mut State<D>) -> Step {
        let label = match self.count(Letter::of('Q'))? {
            Some(Count::Known(number)) => number,
            Some(Count::Unknown) => {
                self.opaque_operation(ix, state);
                return Ok(());
            }
            None => return Err(Fault::MissingWord(Letter::of('Q'))),
        };
        if state.plane(self.model).is_some_and(|plane| plane != Plane::Zx) {
            return Err(Fault::Cycle(CycleFault::Plane));
        }
        if self.compensates(state) {
            if effect != Effect::FinishProfile {
                return Err(Fault::Cycle(CycleFault::Compensated));
            }
            // Carried out beside the profile (observed); where that leads is not computed.
            self.opaque_operation(ix, state);
            return Ok(());
        }
        let target = self.target(state)?;
        let words = self.layered_words(state);
        self.travel(TravelKind::Rapid, target, true, state)?;
        let blocks = self.profile_of_subprogram(label)?;
        let mut scratch = self.in_subprogram(blocks, state);
        let profile = self.read_profile(blocks, Plane::Zx, &mut scratch)?;
        // What the subprogram leaves as motion mode and in variables stays.
        if let Some(mode) = scratch.mode(Role::Motion).only() {
            state.set_mode(Role::Motion, mode);
            state.set_mode(Role::Cycle, self.model.code_with(Effect::CycleCancel));
        }
        state.variables = scratch.variables.clone();
        let from = state.position().xyz();
        let mut strokes = Vec::new();
        let mut out = |stroke| strokes.push(stroke);
        let result = if !profile.complete {
            Err(CycleError::Unknown)
        } else if effect == Effect::FinishProfile {
            let words = words.finish();
            if words.passes == 0 {
                // Nothing moves, and yet the interpreter goes on from the end of the subprogram.
                state.points.position = *scratch.position();
                state.points.actual = self.axes_of(scratch.position(), state);
                Ok(from)
            } else {
                layered_finish(from, &profile.segments, &words, &mut out)
            }
        } else {
            layered_roughing(from, &profile.segments, &words.roughing(effect, self.pockets(ix)), &mut out)
        };
        // Moves count as those of the subprogram's last block, which is where the interpreter has got to.
        let behind = self.origin_of(At { file: blocks.file, block: blocks.last + 1 });
        if let Some(behind) = behind {
            self.observer.before(behind, state);
        }
        // The cycles end on the contour: where, nobody knows when the contour is not known.
        let mut unknown = *state.position();
        for axis in [Axis::X, Axis::Z] {
            unknown.set(axis, f64::NAN);
        }
        let outcome = self.carry_out(&strokes, result, Plane::Zx, unknown, state);
        if let Some(behind) = behind {
            self.observer.after(behind, state);
        }
        // The cycle has read the block's axis words; none are left for a motion.
        self.words.clear();
        outcome
    }

    fn layered_words(&self, state: &State<D>) -> LayeredWords {
        let unit = self.unit(state);
        let length = |letter: char, unset: f64| self.length(Letter::of(letter), state).unwrap_or(unset);
        LayeredWords {
            depth: Mm(length('D', 0.0)),
            increment: Mm(length('I', unit)),
            retract: Mm(length('R', 0.5 * unit)),
            nearest: Mm(length('E', 0.0)),
            passes: self.words.number(Letter::of('P')).map_or(1.0, f64::trunc),
            units: state.units(self.model).unwrap_or(Units::Mm),
        }
    }

    /// The blocks of a subprogram between its first and its last one.
    fn profile_of_subprogram(&self, label: u32) -> Step<ProfileBlocks> {
        let Some(sub) = self.program.find_subroutine(&OLabel::Number(label), self.origin.at.file) else {
            return Err(Fault::NoSuchProgram);
        };
        let end =
            self.program.file(sub.file).and_then(|file| file.loaded.flow_graph().o_word(sub.block)?.end);
        let Some(end) = end else { return Err(Fault::LoopMismatch) };
        Ok(ProfileBlocks { file: sub.file, first: sub.block + 1, last: end.saturating_sub(1) })
    }

    /// The state in which the subprogram of a profile begins.
    fn in_subprogram(&self, blocks: ProfileBlocks, state: &State<D>) -> State<D> {
        let mut scratch = state.clone();
        let sub = At { file: blocks.file, block: blocks.first - 1 };
        let locals = Locals::new(self.model.semantics().locals[1], &D::number(0.0));
        let frame = Frame::new(FrameKind::OWord, sub, self.origin.at, Some(0));
        scratch.calls.push(Frame { locals: Perhaps::Yes(locals), ..frame });
        // The way to the first point was a rapid, and so is what the subprogram gives no code.
        scratch.set_mode(Role::Motion, self.model.code_with(Effect::Rapid));
        scratch
    }

    /// What the digit after the point of a roughing code says of pockets.
    fn pockets(&self, ix: CodeIx) -> Pockets {
        match self.model.control().code_at(ix).map_or(0, |code| code.number().tenths() % 10) {
            1 => Pockets::PassedOver,
            2 => Pockets::Only,
            _ => Pockets::Cleared,
        }
    }

    fn origin_of(&mut self, at: At) -> Option<Origin> {
        let place = self.place(at)?;
        let block = place.block();
        Some(Origin {
            at,
            start: place.base + block.range.start,
            end: place.base + block.range.end,
            flags: block.flags,
            letters: block.letters,
            n: sequence_number(place.table.words(block)),
        })
    }

    // ---- reading ----

    /// What the blocks draw, beginning where `state` stands. Nothing moves; `state` is changed as a run through the
    /// blocks would change it, but for codes that are no part of a drawing. Observers see the blocks pass.
    ///
    /// # Errors
    ///
    /// Faults of the blocks, which are then the blocks under way.
    pub(in crate::exec) fn read_profile(
        &mut self,
        blocks: ProfileBlocks,
        plane: Plane,
        state: &mut State<D>,
    ) -> Step<ReadProfile> {
        let (origin, words) = (self.origin, self.words.clone());
        let pending = std::mem::take(&mut self.pending);
        state.compensation.on = Perhaps::No;
        state.compensation.left = Perhaps::No;
        let [first, second, _] = plane.to_local(state.position().xyz());
        let mut drawing = Drawing { plane, segments: Vec::new(), corners: Vec::new(), complete: true };
        drawing.complete &= self.read_blocks(blocks, state, &mut drawing)?;
        self.origin = origin;
        self.words = words;
        self.pending = pending;
        self.flow = None;
        let segments = with_corners((first.0, second.0), &drawing.segments, &drawing.corners);
        Ok(ReadProfile { segments, complete: drawing.complete })
    }

    /// Is everything read?
    fn read_blocks(
        &mut self,
        blocks: ProfileBlocks,
        state: &mut State<D>,
        drawing: &mut Drawing,
    ) -> Step<bool> {
        let mut block = blocks.first;
        let mut left = MOST_BLOCKS;
        while (blocks.first..=blocks.last).contains(&block) {
            let at = At { file: blocks.file, block };
            let Some(place) = self.place(at).filter(|_| left > 0) else { return Ok(false) };
            left -= 1;
            block += 1;
            let table = Rc::clone(&place.table);
            let read = table.block(place.ix);
            if read.flags.contains(BlockFlags::BLOCK_DELETE) && self.options.skips(read.delete) {
                continue;
            }
            if read.flags.contains(BlockFlags::TAPE_MARK) {
                return Ok(true);
            }
            self.origin = Origin {
                at,
                start: place.base + read.range.start,
                end: place.base + read.range.end,
                flags: read.flags,
                letters: read.letters,
                n: sequence_number(table.words(read)),
            };
            self.observer.before(self.origin, state);
            if read.flags.contains(BlockFlags::ERROR) && table.errors(place.ix).next().is_some() {
                return Err(Fault::Malformed);
            }
            if read.flags.contains(BlockFlags::STATEMENT) {
                match self.statements(&place, &table, read, state)? {
                    Statements::Words => {}
                    Statements::Done(Outcome::Next) => {
                        self.observer.after(self.origin, state);
                        continue;
                    }
                    Statements::Done(Outcome::Jump(to)) if to.file == blocks.file => {
                        self.observer.after(self.origin, state);
                        block = to.block;
                        continue;
                    }
                    Statements::Done(_) => return Ok(false),
                }
            }
            let words = table.words(read);
            if !words.is_empty() {
                self.read_words(&place, &table, words, state)?;
                if self.draw(state, drawing)? == Drawn::End {
                    return Ok(true);
                }
            }
            for (target, value) in std::mem::take(&mut self.pending) {
                if self.assign(target, value, state)?.is_some() {
                    return Ok(false);
                }
            }
            self.observer.after(self.origin, state);
        }
        Ok(true)
    }

    /// One block of a drawing.
    fn draw(&mut self, state: &mut State<D>, drawing: &mut Drawing) -> Step<Drawn> {
        use Effect as E;
        let codes = self.words.codes().to_vec();
        for ix in codes {
            let Some(code) = self.model.code(ix).copied() else { continue };
            match code.effect {
                E::Return | E::ProgramEnd | E::ProgramEndWithPallet => return Ok(Drawn::End),
                E::CallProgram | E::CallLocal | E::MacroCall | E::MacroModal | E::JumpUnlessInput => {
                    drawing.complete = false;
                    return Ok(Drawn::End);
                }
                _ => {}
            }
            if code.takes_axes {
                return Ok(Drawn::On);
            }
            if let Some(role @ (Role::Motion | Role::Distance | Role::ArcCentre | Role::Diameter)) = code.role
            {
                state.set_mode(role, ix);
            }
        }
        let present = self.words.present();
        let arc_words = present.intersects(LetterSet::of("IJKR"));
        let has_axes = present.intersects(self.model.axis_letters);
        let Some(mode) = state.mode(Role::Motion).only() else {
            drawing.complete = false;
            return Ok(Drawn::On);
        };
        let effect = self.model.effect(mode);
        match effect {
            E::Rapid | E::Linear if has_axes => self.draw_line(effect == E::Rapid, state, drawing)?,
            E::ArcClockwise | E::ArcCounterClockwise
                if has_axes && !arc_words && self.is_straight_without_centre() =>
            {
                self.draw_line(false, state, drawing)?;
            }
            E::ArcClockwise | E::ArcCounterClockwise if has_axes || arc_words => {
                self.draw_arc(effect == E::ArcCounterClockwise, state, drawing)?;
            }
            _ if has_axes => drawing.complete = false,
            _ => {}
        }
        Ok(Drawn::On)
    }

    fn draw_line(&mut self, rapid: bool, state: &mut State<D>, drawing: &mut Drawing) -> Step {
        let mut target = self.target(state)?;
        let ([first, second, _], _) = plane_axes(drawing.plane);
        self.aim(&mut target, state);
        if let Some(corner) = self.corner_of_block(state) {
            drawing.corners.push((drawing.segments.len(), corner));
        }
        let to = (Mm(target.raw(first)), Mm(target.raw(second)));
        drawing.segments.push(ProfileSegment::Line { to, rapid });
        state.points.position = target;
        state.points.actual = target;
        Ok(())
    }

    fn draw_arc(&mut self, ccw: bool, state: &mut State<D>, drawing: &mut Drawing) -> Step {
        let target = self.target(state)?;
        let plane = drawing.plane;
        let ([first, second, _], [i, j, _]) = plane_axes(plane);
        let direction = if ccw { ArcDirection::Ccw } else { ArcDirection::Cw };
        let (start, end) = (state.position().xyz(), target.xyz());
        let tolerance = self.arc_tolerance(state);
        let has_centre = self.words.has(i) || self.words.has(j);
        let arc = match self.length(Letter::of('R'), state) {
            Some(_) if has_centre && !self.model.semantics().arcs.radius_wins => {
                return Err(Fault::Arc(ArcFault::CentreAndRadius));
            }
            Some(radius) => Arc::by_radius(plane, start, end, Mm(radius), direction, 1, &tolerance),
            None if !has_centre => return Err(Fault::Arc(ArcFault::NoCentre)),
            None => {
                let absolute = state.effect(Role::ArcCentre, self.model) == Some(Effect::ArcCentreAbsolute);
                let diameter = state.is_diameter(self.model) == Some(true);
                let coordinate = |axis: Axis, letter: Letter| {
                    let here = state.position().raw(axis);
                    Mm(match self.length(letter, state) {
                        Some(value) if absolute && axis == Axis::X && diameter => value / 2.0,
                        Some(value) if absolute => value,
                        Some(value) => here + value,
                        None => here,
                    })
                };
                let centre = (coordinate(first, i), coordinate(second, j));
                Arc::by_centre(plane, start, end, centre, direction, 1, &tolerance)
            }
        };
        let arc = arc.map_err(|error| Fault::Arc(arc_fault(&error)))?;
        let to = (Mm(target.raw(first)), Mm(target.raw(second)));
        drawing.segments.push(ProfileSegment::Arc { to, centre: arc.centre(), ccw });
        state.points.position = target;
        state.points.actual = target;
        Ok(())
    }
}

/// A profile being read.
struct Drawing {
    plane: Plane,
    segments: Vec<ProfileSegment>,
    /// Corners by the piece that they end.
    corners: Vec<(usize, Corner)>,
    complete: bool,
}

/// Does the drawing go on behind a block?
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Drawn {
    On,
    End,
}

/// What the block's `N` says.
fn sequence_number(words: &[Word]) -> Option<u32> {
    words.iter().find(|word| word.letter == Letter::of('N')).and_then(Word::integer)
}

/// The pieces with fillets and chamfers between straight ones. A corner that does not fit stays sharp.
fn with_corners(
    start: (f64, f64),
    pieces: &[ProfileSegment],
    corners: &[(usize, Corner)],
) -> Vec<ProfileSegment> {
    let mut shaped = Vec::with_capacity(pieces.len() + corners.len());
    let mut at = start;
    for (index, piece) in pieces.iter().enumerate() {
        let (to, rapid) = match *piece {
            ProfileSegment::Line { to, rapid } => ((to.0.0, to.1.0), rapid),
            ProfileSegment::Arc { to, .. } => {
                shaped.push(*piece);
                at = (to.0.0, to.1.0);
                continue;
            }
        };
        let corner = corners.iter().find(|(behind, _)| *behind == index).map(|(_, corner)| *corner);
        let next = match pieces.get(index + 1) {
            Some(ProfileSegment::Line { to, .. }) => Some((to.0.0, to.1.0)),
            _ => None,
        };
        match corner.zip(next).map(|(corner, next)| cut_corner(at, to, next, corner)) {
            None | Some(Fit::Straight | Fit::TooLong { .. } | Fit::Unknown) => {
                shaped.push(*piece);
                at = to;
            }
            Some(Fit::Cut((before, piece_of_corner, behind))) => {
                shaped.push(ProfileSegment::Line { to: (Mm(before.0), Mm(before.1)), rapid });
                shaped.push(piece_of_corner);
                at = behind;
            }
        }
    }
    shaped
}
