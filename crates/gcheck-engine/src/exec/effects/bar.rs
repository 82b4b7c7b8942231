//! The bar feeder: `G105` pushes the bar for the next part, or loads a new one.
//!
//! Knows: the order of cutoff, spindle, chuck and push, when a bar is too short. Must not know: which variables hold its lengths
//! (data), how long anything takes.

use gcheck_controls::{BarFeederRules, CodeIx, Letter};
use gcheck_geometry::Mm;
use gcheck_program::Word;

use crate::assumption::Assumption;
use crate::eval::value::{Domain, Truth};
use crate::event::{BarLengths, Event, Spindle, Units};
use crate::exec::context::{Count, Ending, Executor, Step};
use crate::fault::Fault;
use crate::lattice::Flat;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::position::Axis;
use crate::state::{Bar, BarCommand, State};

/// Lengths that differ by less are taken for equal: the rest of a bar is a sum of many.
const EQUAL_WITHIN: f64 = 1e-6;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G105`.
    pub(in crate::exec) fn bar_feed(&mut self, ix: CodeIx, words: &[Word], state: &mut State<D>) -> Step {
        let Some(rules) = &self.model.semantics().bar_feeder else {
            self.opaque_operation(ix, state);
            return Ok(());
        };
        if let Some(mode) = self.bar_mode(words)? {
            // The feeder is set up: bars come and go, and where they are is its own affair.
            self.assumptions.insert(Assumption::Code(ix));
            state.bar = Bar::UNKNOWN;
            if state.spindle.way != Flat::Known(Spindle::Stopped) {
                state.spindle.way = Flat::Unknown;
            }
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
            Some(Count::Unknown) => self.lose_everything(state)?,
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
    pub(in crate::exec) fn feed_after_cutoff(
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
        state.bar.count_first_push(initial);
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
        if state.spindle() != Some(Spindle::Stopped) {
            self.spindle(Spindle::Stopped, state)?;
        }
        self.chuck(false, state);
        match self.is_long_enough(command, state) {
            Truth::True => {
                let left = state.bar.length().0 - part;
                state.bar.set_length(left);
                self.push(part, state);
            }
            Truth::False => {
                let left = state.bar.length();
                self.emit(state, Event::BarUnload(left));
                if state.bar.waiting < 1.0 || self.is_at_limit(rules.bars, rules.most_bars, state)? {
                    return Ok(Some(Ending::BarsUsed));
                }
                state.bar.waiting -= 1.0;
                self.add_to_variable(rules.bars, 1.0, state)?;
                if let Some(angle) = orient {
                    self.emit(state, Event::OrientSpindle { angle, way: 0 });
                }
                self.emit(state, Event::BarLoad);
                state.bar.set_length(feeder.new_bar.map_or(f64::NAN, |bar| bar.0 - initial));
                self.push(initial, state);
            }
            Truth::Unknown => {
                // Most feeds of a bar are pushes, so that a run goes on with one; what is left of the bar nobody knows.
                if !self.leaves_to_rules() && state.bar.length().0.is_nan() {
                    self.assumptions.insert(Assumption::BarLength);
                }
                state.bar.set_length(f64::NAN);
                state.bar.waiting = f64::NAN;
                self.write_plain(rules.bars, D::unknown(), state);
                self.push(part, state);
            }
        }
        let left = state.bar.length().0 / self.table_unit(state);
        let left = if left.is_finite() { D::assumed(D::number(left)) } else { D::unknown() };
        self.write_plain(rules.bar_length, left, state);
        self.chuck(true, state);
        Ok(None)
    }

    /// Is the bar longer than a part and its clamping? Where it is just as long, a new one is the safe choice.
    fn is_long_enough(&mut self, command: &BarCommand, state: &State<D>) -> Truth {
        let BarCommand { part, clamping, .. } = *command;
        let length = state.bar.length().0;
        let spare = length - part - clamping;
        if spare.abs() <= EQUAL_WITHIN {
            self.assumptions.insert(Assumption::BarAtLimit);
            return Truth::False;
        }
        if !spare.is_nan() {
            // Without a length the same bar would be pushed for ever.
            return if part > 0.0 { Truth::from(spare > 0.0) } else { Truth::Unknown };
        }
        // A part that does not even fit in is too long, whatever has to stay clamped.
        if length < part { Truth::False } else { Truth::Unknown }
    }

    /// Does a main program that came to its return make another part? As long as bars are told and known to be left.
    pub(crate) fn starts_again(&self, state: &State<D>) -> bool {
        self.machine.bar.bars.is_some() && state.bar.is_measured()
    }

    fn push(&mut self, by: f64, state: &mut State<D>) {
        self.emit(state, Event::BarPush(Mm(by)));
    }

    /// `M10`, `M11`, and the feeder's own.
    pub(in crate::exec) fn chuck(&mut self, clamped: bool, state: &mut State<D>) {
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
