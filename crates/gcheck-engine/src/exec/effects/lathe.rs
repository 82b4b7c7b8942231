//! Turning cycles: one-pass cycles, grooving, threading.
//!
//! Knows: their words on each control's form, and which words stay in effect. Must not know: the strokes ([`crate::cycles`]),
//! where a profile comes from (`profile`).
//!
//! The form of a block is read from its words. Grooving and threading exist in two blocks, where a block without an end
//! point only stores words for the next one, and in one block. Threading in one block that names its passes by `J` exists
//! where the code has that word.

pub(in crate::exec) mod profile;

use gcheck_controls::{Effect, Letter, LetterSet, Unpointed, WordKind};
use gcheck_geometry::{Degrees, Mm, Plane};

use crate::assumption::Assumption;
use crate::cycles::{
    CycleError, Grooving, InFeed, Stroke, TaperEnds, TaperedThread, ThreadHeights, box_pass, grooving,
    multi_pass_thread, tapered_thread,
};
use crate::eval::numbers::in_steps;
use crate::eval::value::{Domain, Truth};
use crate::event::{FeedMode, Units};
use crate::exec::context::{Executor, Step};
use crate::fault::{CycleFault, Fault};
use crate::lattice::{Lattice, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{Course, KeptTurningWords, ModeSet, State, TurningWords};

/// Addresses that name the end point of a turning cycle.
const END_POINT: LetterSet = LetterSet::of("XZUW");

/// No threading insert is wider than this, degrees.
const WIDEST_NOSE: f64 = 120.0;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    // ---- one pass ----

    /// `G90`, `G92`, `G94` of lathes: a block with an end point while the mode is on.
    pub(in crate::exec) fn turning_pass(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        let mut words = state.turning();
        let start = [Axis::X, Axis::Z].map(|axis| Some(state.position().raw(axis)));
        // Every pass ends where it began; from elsewhere another series begins.
        let another = TurningWords { start, corner: [None; 2], taper: None, lead: None, ..words };
        let is_known = |place: [Option<f64>; 2]| place.iter().all(|at| at.is_none_or(|at| !at.is_nan()));
        if !is_known(start) || !is_known(words.start) {
            words = words.join(&another);
            words.start = start;
        } else if !start.same(&words.start) {
            words = another;
        }
        for (slot, axis) in words.corner.iter_mut().zip([Axis::X, Axis::Z]) {
            if self.names_axis(axis) || slot.is_none() {
                *slot = Some(target.raw(axis));
            }
        }
        let old_form = if effect == Effect::FacingPass { 'K' } else { 'I' };
        if let Some(taper) =
            self.length(Letter::of('R'), state).or_else(|| self.length(Letter::of(old_form), state))
        {
            words.taper = Some(taper);
        }
        let threads = effect == Effect::ThreadingPass;
        if let Some(lead) = self.lead(state).filter(|_| threads) {
            words.lead = Some(lead);
        }
        keep(&words, state);
        let [x, z] = words.corner.map(|coordinate| Mm(coordinate.unwrap_or(f64::NAN)));
        let taper = Mm(words.taper.unwrap_or(0.0));
        let lead = Mm(words.lead.or_else(|| self.modal_lead(state)).unwrap_or(f64::NAN));
        let pull_out = if threads { self.pull_out(lead) } else { Mm::ZERO };
        let checked = if threads { Self::check_lead(words.lead, state) } else { self.check_feed(state) };
        let from = state.position().xyz();
        let mut strokes = Vec::new();
        let result =
            box_pass(effect, from, (x, z), taper, lead, pull_out, &mut |stroke| strokes.push(stroke));
        self.carry_out(&strokes, result, Plane::Zx, *state.position(), state)?;
        checked
    }

    // ---- grooving ----

    /// `G74`, `G75` of lathes.
    pub(in crate::exec) fn groove_cycle(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let present = self.words.present();
        let one_block = present.intersects(LetterSet::of("IKD"));
        let stores = !one_block && !present.intersects(END_POINT) && !present.intersects(LetterSet::of("PQ"));
        if stores && present.contains(Letter::of('R')) {
            let words = TurningWords { peck_retract: self.length(Letter::of('R'), state), ..state.turning() };
            keep(&words, state);
            return Ok(());
        }
        let target = self.target(state)?;
        let (deep, side) = if one_block {
            let (i, k) = (self.length(Letter::of('I'), state), self.length(Letter::of('K'), state));
            if effect == Effect::GrooveFace { (k, i) } else { (i, k) }
        } else {
            let (p, q) = (self.least_length('P', state), self.least_length('Q', state));
            if effect == Effect::GrooveFace { (q, p) } else { (p, q) }
        };
        let retract = state.turning().peck_retract.filter(|_| !one_block);
        let relief = self.length(Letter::of(if one_block { 'D' } else { 'R' }), state);
        let words = Grooving {
            to: (Mm(target.raw(Axis::X)), Mm(target.raw(Axis::Z))),
            peck: deep.map(Mm),
            step: side.filter(|step| *step != 0.0).map(Mm),
            retract: Mm(retract.unwrap_or(self.model.semantics().cycles.chip_break_retract)),
            relief: Mm(relief.unwrap_or(0.0)),
        };
        let checked = self.check_feed(state);
        let held = self.hold_compensation(state)?;
        let mut strokes = Vec::new();
        let result = grooving(effect, state.position().xyz(), &words, &mut |stroke| strokes.push(stroke));
        let result = if one_block { result } else { with_letters(result, &[('I', 'P'), ('K', 'Q')]) };
        let outcome = self.carry_out(&strokes, result, Plane::Zx, *state.position(), state);
        Self::release_compensation(held, state);
        outcome?;
        checked
    }

    // ---- threading ----

    /// `G76` of lathes.
    pub(in crate::exec) fn thread_cycle(&mut self, state: &mut State<D>) -> Step {
        let codes = self.words.codes().iter();
        let ix = codes.copied().find(|ix| self.model.effect(*ix) == Effect::ThreadCycle);
        let code = ix.and_then(|ix| self.model.control().code_at(ix));
        if code.is_some_and(|code| code.entry().words.iter().any(|word| word.letter == "J")) {
            return self.tapered_thread(state);
        }
        let present = self.words.present();
        if present.intersects(END_POINT) {
            let target = self.target(state)?;
            let to = (Mm(target.raw(Axis::X)), Mm(target.raw(Axis::Z)));
            let lead = self.lead(state);
            let checked = Self::check_lead(lead, state);
            let lead = Mm(lead.or_else(|| self.modal_lead(state)).unwrap_or(f64::NAN));
            let one_block = present.intersects(LetterSet::of("KD"));
            let words = if one_block {
                self.thread_of_one_block(to, lead, state)?
            } else {
                self.thread_of_two_blocks(to, lead, ix, state)?
            };
            let held = self.hold_compensation(state)?;
            let mut strokes = Vec::new();
            let result =
                multi_pass_thread(state.position().xyz(), &words, &mut |stroke| strokes.push(stroke));
            let result = if one_block { result } else { with_letters(result, &[('K', 'P'), ('D', 'Q')]) };
            let outcome = self.carry_out(&strokes, result, Plane::Zx, *state.position(), state);
            Self::release_compensation(held, state);
            outcome?;
            return checked;
        }
        self.store_thread(state);
        Ok(())
    }

    /// The first block of two: `P` packs passes, pull-out and angle into six digits.
    fn store_thread(&mut self, state: &mut State<D>) {
        let mut words = state.turning();
        let [passes, pull_out, angle, least, finish] = &mut words.thread;
        if let Some(packed) = self.raw(Letter::of('P'), state) {
            let digits = |from: f64| (packed / from).trunc() % 100.0;
            *passes = Some(digits(10_000.0));
            *pull_out = Some(digits(100.0) / 10.0);
            *angle = Some(digits(1.0));
        }
        if let Some(q) = self.least_length('Q', state) {
            *least = Some(q);
        }
        if let Some(r) = self.length(Letter::of('R'), state) {
            *finish = Some(r);
        }
        keep(&words, state);
    }

    fn thread_of_one_block(&mut self, to: (Mm, Mm), lead: Mm, state: &State<D>) -> Step<ThreadHeights> {
        let height = self.length(Letter::of('K'), state).ok_or(missing('K'))?;
        let first = self.length(Letter::of('D'), state).ok_or(missing('D'))?;
        let unit = self.unit(state);
        let in_feed = match self.raw(Letter::of('P'), state) {
            Some(2.0) => InFeed::BothEdgesConstantLoad,
            Some(3.0) => InFeed::OneEdgeConstantDepth,
            Some(4.0) => InFeed::BothEdgesConstantDepth,
            _ => InFeed::OneEdgeConstantLoad,
        };
        Ok(ThreadHeights {
            to,
            taper: Mm(self.length(Letter::of('I'), state).unwrap_or(0.0)),
            height: Mm(height),
            first: Mm(first),
            least: Mm(self.number_setting("99") * unit),
            finish: Mm(self.number_setting("86") * unit),
            finish_passes: 1,
            angle: Degrees(self.nose_angle(state).unwrap_or(0.0)),
            pull_out: self.pull_out(lead),
            lead,
            in_feed,
        })
    }

    /// `A60` is sixty degrees also where angles count least increments.
    fn nose_angle(&mut self, state: &State<D>) -> Option<f64> {
        let written = self.raw(Letter::of('A'), state).filter(|angle| *angle <= WIDEST_NOSE);
        written.or_else(|| self.words.number(Letter::of('A')))
    }

    fn thread_of_two_blocks(
        &mut self,
        to: (Mm, Mm),
        lead: Mm,
        ix: Option<gcheck_controls::CodeIx>,
        state: &State<D>,
    ) -> Step<ThreadHeights> {
        let height = self.least_length('P', state).ok_or(missing('P'))?;
        let first = self.least_length('Q', state).ok_or(missing('Q'))?;
        let stored = state.turning().thread;
        if let Some(ix) = ix.filter(|_| stored.iter().any(Option::is_none)) {
            // Parameters of the control stand for what no first block gave.
            self.assumptions.insert(Assumption::Code(ix));
        }
        let [passes, pull_out, angle, least, finish] = stored;
        #[expect(
            clippy::cast_sign_loss,
            reason = "two digits, or not known: then the rest is not known either"
        )]
        let finish_passes = passes.unwrap_or(1.0).max(1.0) as u32;
        Ok(ThreadHeights {
            to,
            taper: Mm(self.length(Letter::of('R'), state).unwrap_or(0.0)),
            height: Mm(height),
            first: Mm(first),
            least: Mm(least.unwrap_or(0.0)),
            finish: Mm(finish.unwrap_or(0.0)),
            finish_passes,
            angle: Degrees(angle.unwrap_or(60.0)),
            pull_out: lead * pull_out.unwrap_or(0.0),
            lead,
            in_feed: InFeed::OneEdgeConstantLoad,
        })
    }

    /// The form `P Z I J K R Q H E L`.
    fn tapered_thread(&mut self, state: &mut State<D>) -> Step {
        let present = self.words.present();
        if !present.intersects(self.model.axis_letters) {
            return Err(Fault::NoAxisWords);
        }
        if present.intersects(LetterSet::of("ABC")) {
            return Err(Fault::Cycle(CycleFault::Rotary));
        }
        if self.compensates(state) {
            return Err(Fault::Cycle(CycleFault::Compensated));
        }
        let half = if state.is_diameter(self.model) == Some(true) { 2.0 } else { 1.0 };
        let mut needed = [0.0; 4];
        for (slot, letter) in needed.iter_mut().zip(['P', 'I', 'J', 'K']) {
            *slot = self.length(Letter::of(letter), state).ok_or(missing(letter))?;
        }
        let [pitch, peak, first, depth] = needed;
        if pitch < 0.0 {
            return Err(missing('P'));
        }
        if Self::spindle_turns(state) == Some(false) {
            return Err(Fault::SpindleStopped);
        }
        let target = self.target(state)?;
        let word = |letter: char, unset: f64| self.words.number(Letter::of(letter)).unwrap_or(unset);
        let mut counts = [0_i64; 2];
        for (slot, (letter, least)) in counts.iter_mut().zip([('H', -1.0), ('L', 0.0)]) {
            let count = word(letter, 0.0);
            if (count - count.round()).abs() > 1e-4 || count < least {
                return Err(Fault::WordRange(Letter::of(letter)));
            }
            *slot = count.round() as i64;
        }
        let [springs, ends] = counts;
        let words = TaperedThread {
            to: target.xyz(),
            pitch: Mm(pitch),
            peak: Mm(peak / half),
            first: Mm(first / half),
            depth: Mm(depth / half),
            degression: word('R', 1.0),
            slide: Degrees(word('Q', 0.0)),
            springs,
            taper: Mm(self.length(Letter::of('E'), state).unwrap_or(0.0)),
            ends: TaperEnds::of(ends),
            units: state.units(self.model).unwrap_or(Units::Mm),
        };
        let mut strokes = Vec::new();
        let result = tapered_thread(state.position().xyz(), &words, &mut |stroke| strokes.push(stroke));
        let plane = state.plane(self.model).unwrap_or(Plane::Zx);
        self.carry_out(&strokes, result, plane, target, state)?;
        self.end_motion_cycle(state);
        Ok(())
    }

    // ---- what they share ----

    /// Gives out a cycle's strokes; `end` is where a cycle of unknown numbers leaves the tool.
    pub(in crate::exec) fn carry_out(
        &mut self,
        strokes: &[Stroke],
        result: Result<[Mm; 3], CycleError>,
        plane: Plane,
        end: Position,
        state: &mut State<D>,
    ) -> Step {
        self.strokes(strokes, plane, state)?;
        match result {
            Ok(_) => Ok(()),
            Err(CycleError::Fault(fault)) => Err(Fault::Cycle(fault)),
            Err(CycleError::Profile(_)) => Err(Fault::Profile),
            Err(CycleError::TooManyStrokes) => Err(Fault::Cycle(CycleFault::Geometry)),
            Err(CycleError::Unknown | CycleError::NotThisKind) => {
                let either = state.cycle.feed_override_on.join(&Truth::True);
                state.cycle.feed_override_on = either;
                self.end_unfollowed(end, state);
                Ok(())
            }
        }
    }

    /// Cycles of many passes follow their own path: the moves that cutter compensation holds back come first, and it
    /// goes on where the cycle ends.
    pub(in crate::exec) fn hold_compensation(&mut self, state: &mut State<D>) -> Step<HeldCompensation> {
        self.flush_compensation(state)?;
        let modes = *state.mode(Role::Compensation);
        if self.compensates(state) || modes.only().is_none() {
            state.set_mode(Role::Compensation, self.model.code_with(Effect::CompensationOff));
        }
        let on = std::mem::take(&mut state.compensation.on);
        Ok(HeldCompensation { on, modes })
    }

    /// Goes on with what was held.
    pub(in crate::exec) fn release_compensation(held: HeldCompensation, state: &mut State<D>) {
        state.compensation.on = held.on;
        state.modes.put(Role::Compensation, held.modes);
    }

    /// A cycle that is a motion mode of its own, by which no block moves without naming it, has read the block's axis words.
    fn end_motion_cycle(&mut self, state: &mut State<D>) {
        state.set_mode(Role::Cycle, self.model.code_with(Effect::CycleCancel));
        let taken = |ix: &gcheck_controls::CodeIx| self.model.code(*ix).is_some_and(|code| code.takes_axes);
        if self.words.codes().iter().any(taken) {
            state.set_mode(Role::Motion, gcheck_controls::CodeIx::NONE);
        } else {
            self.words.clear();
        }
    }

    /// Does the block name the axis, by its own address or as an increment?
    pub(in crate::exec) fn names_axis(&self, axis: Axis) -> bool {
        self.words
            .present()
            .iter()
            .any(|letter| self.model.axis_of(letter).is_some_and(|(named, _)| named == axis))
    }

    /// Millimetres a turn from the block's words.
    pub(in crate::exec) fn lead(&self, state: &State<D>) -> Option<f64> {
        self.length(Letter::of('E'), state).or_else(|| self.length(Letter::of('F'), state))
    }

    /// Millimetres a turn from the feed in effect.
    fn modal_lead(&self, state: &State<D>) -> Option<f64> {
        let per_turn = state.feed_mode(self.model) == Some(FeedMode::PerRevolution);
        D::known(state.feed()).filter(|feed| per_turn && *feed > 0.0)
    }

    /// A thread needs a lead from somewhere.
    fn check_lead(lead: Option<f64>, state: &State<D>) -> Step {
        match lead {
            Some(lead) if lead <= 0.0 => Err(Fault::NoFeed),
            None if D::known(state.feed()) == Some(0.0) => Err(Fault::NoFeed),
            _ => Ok(()),
        }
    }

    /// How long a thread's end leaves the work at an angle, where a setting says so.
    fn pull_out(&mut self, lead: Mm) -> Mm {
        lead * self.number_setting("95")
    }

    /// A setting that is a number; 0 without it.
    pub(in crate::exec) fn number_setting(&mut self, number: &str) -> f64 {
        self.setting(number).and_then(|value| value.parse::<f64>().ok()).unwrap_or(0.0)
    }

    /// A count as written: without what a missing decimal point does to lengths.
    pub(in crate::exec) fn raw(&mut self, letter: Letter, state: &State<D>) -> Option<f64> {
        let number = self.words.number(letter)?;
        if self.words.is_pointed(letter) || number == 0.0 {
            return Some(number);
        }
        let one = self.scale(letter, 1.0, state.units(self.model));
        Some((number / one * 1e6).round() / 1e6)
    }

    /// A length that counts least increments when it is written without a decimal point, whatever numbers else do.
    fn least_length(&mut self, letter: char, state: &State<D>) -> Option<f64> {
        let unit = self.unit(state);
        if self.words.is_pointed(Letter::of(letter)) {
            return self.length(Letter::of(letter), state);
        }
        let count = self.raw(Letter::of(letter), state)?;
        if self.model.control().numbers().unpointed == Unpointed::AsWritten {
            return Some(count * unit);
        }
        Some(in_steps(count, self.least_increment(state.units(self.model))) * unit)
    }

    /// Does a word of a code name a block of the program?
    fn takes_label(&self, ix: gcheck_controls::CodeIx, letter: &str) -> bool {
        let code = self.model.control().code_at(ix);
        code.is_some_and(|code| {
            code.entry().words.iter().any(|word| word.letter == letter && word.kind == WordKind::Label)
        })
    }
}

/// Cutter compensation set aside while a cycle goes its own way.
pub(in crate::exec) struct HeldCompensation {
    on: Perhaps<Course>,
    modes: ModeSet,
}

impl HeldCompensation {
    /// Leaves the path: compensation stays the mode, but where its path goes on is not known.
    pub(in crate::exec) fn without_path(self) -> Self {
        let on = if self.on.is_no() { Perhaps::No } else { Perhaps::Yes(Course::Unknown) };
        Self { on, ..self }
    }
}

/// Keeps words of turning cycles.
fn keep<D: Domain>(words: &TurningWords, state: &mut State<D>) {
    if state.turning() != *words {
        state.turning = KeptTurningWords::of(words);
    }
}

/// A fault of a number with the address that another form of the cycle writes it by.
fn with_letters(
    result: Result<[Mm; 3], CycleError>,
    letters: &[(char, char)],
) -> Result<[Mm; 3], CycleError> {
    let Err(CycleError::Fault(CycleFault::NotPositive(letter))) = result else { return result };
    let other = letters.iter().find(|(from, _)| Letter::of(*from) == letter);
    Err(CycleFault::NotPositive(other.map_or(letter, |(_, to)| Letter::of(*to))).into())
}

fn missing(letter: char) -> Fault {
    Fault::Cycle(CycleFault::Missing(Letter::of(letter)))
}
