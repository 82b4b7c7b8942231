//! The bar feeder: `G105` pushes the bar for the next part, or loads a new one.
//!
//! Knows: the order of cutoff, spindle, chuck and push, when a bar is too short, what of the bar is left. Must not know: which
//! variables hold its lengths (data), how long anything takes.
//!
//! The bar is measured behind the face of the chuck, where what is too short cannot be clamped: a new bar's length less its
//! first push, less a part for every push after it.

use gcheck_controls::{BarFeederRules, CodeIx, Letter};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use super::{Count, Ending, Executor, Step};
use crate::assumption::Assumption;
use crate::event::{BarLengths, Event, Spindle, Units};
use crate::fault::Fault;
use crate::machine::Machine;
use crate::model::Model;
use crate::number::{either, stands_for};
use crate::observer::{Observer, Origin};
use crate::position::Axis;
use crate::state::{At, State};
use crate::value::{Domain, Truth};

/// The bar in the chuck, and those that wait.
#[derive(Debug, Clone, Copy)]
pub struct Bar {
    /// Behind the face of the chuck, millimetres; NaN unknown.
    length: f64,
    /// The bar is whole: its first push is still to be taken off `length`.
    is_whole: bool,
    /// Bars in the magazine; infinite when nobody counts them, NaN unknown.
    waiting: f64,
    /// The chuck is closed.
    clamped: Truth,
}

/// A bar feed as its block commands it, millimetres; NaN unknown.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BarCommand {
    part: f64,
    initial: f64,
    clamping: f64,
    /// Angle at which the spindle takes a new bar.
    orient: Option<f64>,
}

/// Lengths that differ by less are taken for equal: the rest of a bar is a sum of many.
const EQUAL_WITHIN: f64 = 1e-6;

impl Bar {
    /// Nothing is known.
    pub(crate) const UNKNOWN: Self =
        Self { length: f64::NAN, is_whole: false, waiting: f64::NAN, clamped: Truth::Unknown };

    pub(crate) fn at_start(machine: &Machine) -> Self {
        let feeder = machine.bar;
        if !feeder.starts_new {
            return Self::UNKNOWN;
        }
        Self {
            length: feeder.new_bar.map_or(f64::NAN, |bar| bar.0),
            is_whole: feeder.new_bar.is_some(),
            waiting: feeder.bars.map_or(f64::INFINITY, |bars| f64::from(bars.saturating_sub(1))),
            clamped: Truth::Unknown,
        }
    }

    /// What of the bar is behind the face of the chuck; NaN unknown.
    pub fn length(&self) -> Mm {
        Mm(if self.is_whole { f64::NAN } else { self.length })
    }

    /// Is the chuck closed?
    pub fn clamped(&self) -> Truth {
        self.clamped
    }

    fn bits(&self) -> (u64, bool, u64, Truth) {
        (self.length.to_bits(), self.is_whole, self.waiting.to_bits(), self.clamped)
    }

    pub(crate) fn join(&self, other: &Self) -> Self {
        Self {
            length: if self.is_whole == other.is_whole {
                either(self.length, other.length)
            } else {
                f64::NAN
            },
            is_whole: self.is_whole && other.is_whole,
            waiting: either(self.waiting, other.waiting),
            clamped: if self.clamped == other.clamped { self.clamped } else { Truth::Unknown },
        }
    }

    /// Is what `inner` stands for something that this stands for?
    pub(crate) fn contains(&self, inner: &Self) -> bool {
        (self.length.is_nan() || stands_for(self.length, inner.length) && self.is_whole == inner.is_whole)
            && stands_for(self.waiting, inner.waiting)
            && (self.clamped == Truth::Unknown || self.clamped == inner.clamped)
    }
}

impl PartialEq for Bar {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

impl BarCommand {
    fn bits(&self) -> ([u64; 3], Option<u64>) {
        ([self.part, self.initial, self.clamping].map(f64::to_bits), self.orient.map(f64::to_bits))
    }

    pub(crate) fn join(&self, other: &Self) -> Self {
        Self {
            part: either(self.part, other.part),
            initial: either(self.initial, other.initial),
            clamping: either(self.clamping, other.clamping),
            orient: match (self.orient, other.orient) {
                (Some(a), Some(b)) => Some(either(a, b)),
                (None, None) => None,
                _ => Some(f64::NAN),
            },
        }
    }
}

impl PartialEq for BarCommand {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

/// A run begins with its first bar: the counters of the feeder start with it, unless they were told.
pub(crate) fn start_bar_counters<D: Domain>(model: &Model<'_>, machine: &Machine, state: &mut State<D>) {
    let Some(rules) = model.semantics().bar_feeder.as_ref().filter(|_| machine.bar.starts_new) else {
        return;
    };
    for (number, value) in [(rules.parts, 0.0), (rules.bars, 1.0), (rules.run_length, 0.0)] {
        if !state.variables.is_written(number) {
            state.variables.set(number, D::assumed(D::number(value)));
        }
    }
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G105`.
    pub(super) fn bar_feed(&mut self, ix: CodeIx, words: &[Word], state: &mut State<D>) -> Step {
        let Some(rules) = &self.model.semantics().bar_feeder else {
            self.opaque_operation(ix, state);
            return Ok(());
        };
        if let Some(mode) = self.bar_mode(words)? {
            // The feeder is set up: bars come and go, and where they are is its own affair.
            self.assumptions.insert(Assumption::Code(ix));
            state.bar = Bar::UNKNOWN;
            state.spindle = state.spindle.filter(|spindle| *spindle == Spindle::Stopped);
            let mode = if let Count::Known(mode) = mode { Some(mode) } else { None };
            self.emit(state, Event::BarSetup(mode));
            return Ok(());
        }
        let command = BarCommand {
            part: self.bar_length('J', rules.part, state)?,
            initial: self.initial_push(rules, state)?,
            clamping: self.bar_length('K', rules.clamping, state)?,
            orient: self.words.number(Letter::of('R')).map(|angle| {
                // What a number without a decimal point counts in, goes by the lengths of the address.
                if self.words.is_pointed(Letter::of('R')) || angle == 0.0 { angle } else { f64::NAN }
            }),
        };
        match self.count(Letter::of('P'))? {
            None => {}
            Some(Count::Unknown) => self.lose_everything(state),
            Some(Count::Known(number)) => match self.program.find_number(number, self.origin.at.file) {
                Some(target) => {
                    self.cut_off_then_feed(target, command);
                    return Ok(());
                }
                None => self.missing_program(number, false, state)?,
            },
        }
        if let Some(ending) = self.feed_bar(&command, state)? {
            self.flow = Some(super::Flow::End(ending));
        }
        Ok(())
    }

    /// The mode that sets the feeder up; `None` for the feed.
    fn bar_mode(&self, words: &[Word]) -> Step<Option<Count>> {
        let letter = Letter::of('Q');
        // A whole number, which elsewhere is a length and counts otherwise without a decimal point.
        let written = words.iter().rfind(|word| word.letter == letter).and_then(Word::number);
        let mode = match written {
            Some(mode) if (0.0..=f64::from(u16::MAX)).contains(&mode) && mode.fract() == 0.0 =>
            {
                #[expect(clippy::cast_sign_loss, reason = "range checked in the pattern's guard")]
                Some(Count::Known(mode as u32))
            }
            Some(_) => return Err(Fault::WordRange(letter)),
            None => self.count(letter)?,
        };
        Ok(mode.filter(|mode| *mode != Count::Known(0)))
    }

    /// The cutoff program came back to the bar feed that called it.
    pub(super) fn feed_behind_cutoff(
        &mut self,
        at: At,
        command: &BarCommand,
        state: &mut State<D>,
    ) -> Step<Option<Ending>> {
        let back = self.origin;
        if let Some(place) = self.place(at) {
            let block = place.block();
            self.origin = Origin {
                at,
                start: place.base + block.range.start,
                end: place.base + block.range.end,
                flags: block.flags,
                letters: block.letters,
                n: None,
            };
        }
        let ending = self.feed_bar(command, state);
        self.origin = back;
        ending
    }

    /// What comes behind the cutoff. An ending where the feeder stops the job.
    fn feed_bar(&mut self, command: &BarCommand, state: &mut State<D>) -> Step<Option<Ending>> {
        let Some(rules) = &self.model.semantics().bar_feeder else { return Ok(None) };
        let BarCommand { part, initial, clamping, orient } = *command;
        self.flush_compensation(state)?;
        self.bar_feeds += 1;
        let feeder = self.machine.bar;
        if feeder.starts_new && feeder.new_bar.is_some() {
            self.assumptions.insert(Assumption::NewBar);
        }
        if state.bar.is_whole {
            state.bar.is_whole = false;
            state.bar.length -= initial;
        }
        self.emit(
            state,
            Event::BarFeed(BarLengths { part: Mm(part), initial: Mm(initial), clamping: Mm(clamping) }),
        );
        self.add_to_variable(rules.parts, 1.0, state)?;
        let run = part / self.table_unit(state);
        self.add_to_variable(rules.run_length, run, state)?;
        if self.is_at_limit(rules.parts, rules.most_parts, state)?
            || self.is_at_limit(rules.run_length, rules.most_length, state)?
        {
            return Ok(Some(Ending::BarsUsed));
        }
        if state.spindle != Some(Spindle::Stopped) {
            self.spindle(Spindle::Stopped, state)?;
        }
        self.chuck(false, state);
        match self.is_long_enough(command, state) {
            Truth::True => {
                state.bar.length -= part;
                self.push(part, state);
            }
            Truth::False => {
                self.emit(state, Event::BarUnload(Mm(state.bar.length)));
                if state.bar.waiting < 1.0 || self.is_at_limit(rules.bars, rules.most_bars, state)? {
                    return Ok(Some(Ending::BarsUsed));
                }
                state.bar.waiting -= 1.0;
                self.add_to_variable(rules.bars, 1.0, state)?;
                if let Some(angle) = orient {
                    self.emit(state, Event::OrientSpindle { angle, way: 0 });
                }
                self.emit(state, Event::BarLoad);
                state.bar.length = feeder.new_bar.map_or(f64::NAN, |bar| bar.0 - initial);
                self.push(initial, state);
            }
            Truth::Unknown => {
                // Most feeds of a bar are pushes, so that a run goes on with one; what is left of the bar nobody knows.
                if !self.lenient {
                    self.assumptions.insert(Assumption::BarLength);
                }
                state.bar.length = f64::NAN;
                state.bar.waiting = f64::NAN;
                self.write_plain(rules.bars, D::unknown(), state);
                self.push(part, state);
            }
        }
        let left = state.bar.length / self.table_unit(state);
        let left = if left.is_finite() { D::assumed(D::number(left)) } else { D::unknown() };
        self.write_plain(rules.bar_length, left, state);
        self.chuck(true, state);
        Ok(None)
    }

    /// Is the bar longer than a part and its clamping? Where it is just as long, a new one is the safe choice.
    fn is_long_enough(&mut self, command: &BarCommand, state: &State<D>) -> Truth {
        let BarCommand { part, clamping, .. } = *command;
        let spare = state.bar.length - part - clamping;
        if spare.abs() <= EQUAL_WITHIN {
            self.assumptions.insert(Assumption::BarAtLimit);
            return Truth::False;
        }
        if !spare.is_nan() {
            // Without a length the same bar would be pushed for ever.
            return if part > 0.0 { Truth::from(spare > 0.0) } else { Truth::Unknown };
        }
        // A part that does not even fit in is too long, whatever has to stay clamped.
        if state.bar.length < part { Truth::False } else { Truth::Unknown }
    }

    /// Does a main program that came to its return make another part? As long as bars are told and known to be left.
    pub(crate) fn starts_again(&self, state: &State<D>) -> bool {
        self.machine.bar.bars.is_some() && !state.bar.length.is_nan()
    }

    fn push(&mut self, by: f64, state: &mut State<D>) {
        self.emit(state, Event::BarPush(Mm(by)));
    }

    /// `M10`, `M11`, and the feeder's own.
    pub(super) fn chuck(&mut self, clamped: bool, state: &mut State<D>) {
        state.bar.clamped = Truth::from(clamped);
        self.emit(state, Event::Chuck(clamped));
    }

    /// The push of a new bar: `I`, else its variable. Zero in both is the reference position; a zero for this block alone is
    /// something the manual does not decide.
    fn initial_push(&mut self, rules: &BarFeederRules, state: &State<D>) -> Step<f64> {
        let push = self.bar_length('I', rules.initial_push, state)?;
        if push != 0.0 {
            return Ok(push);
        }
        let stored = self.bar_variable(rules.initial_push, state)?;
        if stored == 0.0 { self.bar_variable(rules.reference, state) } else { Ok(f64::NAN) }
    }

    /// A length of the block, else of its variable: millimetres, NaN unknown.
    fn bar_length(&mut self, letter: char, variable: u32, state: &State<D>) -> Step<f64> {
        match self.length(Letter::of(letter), state) {
            Some(length) => Ok(length),
            None => self.bar_variable(variable, state),
        }
    }

    fn bar_variable(&mut self, number: u32, state: &State<D>) -> Step<f64> {
        let value = self.read_variable(number, state)?;
        if !state.variables.is_written(number) {
            self.assumptions.insert(Assumption::Variable(number));
        }
        let length = D::known(&value).map(|value| self.millimetres_of_table(Axis::Z, value, state));
        Ok(length.unwrap_or(f64::NAN))
    }

    fn add_to_variable(&mut self, number: u32, by: f64, state: &mut State<D>) -> Step {
        let sum = D::known(&self.read_variable(number, state)?).map_or(f64::NAN, |value| value + by);
        let sum = if sum.is_finite() { D::assumed(D::number(sum)) } else { D::unknown() };
        self.write_plain(number, sum, state);
        Ok(())
    }

    /// Has a counter come to its limit? Zero is no limit, and what nobody told is none that is known.
    fn is_at_limit(&mut self, counter: u32, limit: u32, state: &State<D>) -> Step<bool> {
        let limit = D::known(&self.read_variable(limit, state)?);
        let count = D::known(&self.read_variable(counter, state)?);
        let reached = matches!((count, limit), (Some(count), Some(limit)) if limit > 0.0 && count >= limit);
        if reached {
            self.assumptions.insert(Assumption::BarLimits);
        }
        Ok(reached)
    }

    /// Millimetres in a unit of the control's tables; NaN unknown.
    fn table_unit(&self, state: &State<D>) -> f64 {
        self.machine.table_units.map_or_else(|| self.unit(state), Units::in_mm)
    }
}
