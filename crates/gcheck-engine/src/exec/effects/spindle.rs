//! Feed, spindle, tools, dwell, inputs and outputs.
//!
//! Knows: what their words and codes change. Must not know: motion.

use gcheck_controls::{DwellWord, Effect, Letter};
use gcheck_geometry::Seconds;

use crate::eval::value::{Domain, Truth};
use crate::event::{Coolant, Event, FeedMode, Spindle};
use crate::exec::context::{Count, Executor, Step};
use crate::fault::Fault;
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::model::Role;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{Loaded, State, ToolData};

#[expect(clippy::unnecessary_wraps, reason = "handlers of effects share one signature")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `F`.
    pub(in crate::exec) fn feed_word(&mut self, state: &mut State<D>) -> Step {
        let Some(value) = self.words.get(Letter::of('F')) else { return Ok(()) };
        if D::known(&value).is_some_and(|f| f < 0.0) {
            return Err(Fault::WordRange(Letter::of('F')));
        }
        state.feed.word = value.clone();
        state.feed.given_under = *state.mode(Role::FeedMode);
        let mode = state.feed_mode(self.model);
        state.feed.rate = match (mode, D::known(&value)) {
            (Some(FeedMode::InverseTime), _) => value,
            (_, Some(0.0)) => D::number(0.0),
            // Moves a minute have no unit, and it may be those.
            (None, Some(_)) if state.mode(Role::FeedMode).only().is_none() => D::unknown(),
            (_, Some(number)) => D::number(number * self.unit(state)),
            (_, None) => D::unknown(),
        };
        if mode != Some(FeedMode::InverseTime) {
            let rate = D::known(state.feed()).unwrap_or(f64::NAN);
            self.emit(state, Event::FeedRate(rate));
        }
        Ok(())
    }

    /// `S`.
    pub(in crate::exec) fn speed_word(&mut self, state: &mut State<D>) -> Step {
        let Some(value) = self.words.get(Letter::of('S')) else { return Ok(()) };
        if D::known(&value).is_some_and(|s| s < 0.0) {
            return Err(Fault::WordRange(Letter::of('S')));
        }
        self.check_spindle()?;
        let limits =
            self.words.codes().iter().any(|ix| self.model.effect(*ix) == Effect::SpeedLimitOrSetPosition);
        if limits {
            return Ok(());
        }
        let rate = D::known(&value).unwrap_or(f64::NAN);
        state.spindle.speed = value;
        self.emit(state, Event::SpindleSpeed(rate));
        Ok(())
    }

    /// `G96`, `G97`: `D` limits the speed where it is read.
    pub(in crate::exec) fn spindle_mode(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        if effect == Effect::ConstantSpeed {
            self.emit(state, Event::SpindleMode(None));
            return Ok(());
        }
        if let Some(limit) = self.words.number(Letter::of('D')) {
            state.spindle.limit = limit.abs();
        } else if self.model.semantics().feed_mode_clears_feed {
            state.spindle.limit = f64::INFINITY;
        }
        let limit = state.speed_limit();
        self.emit(state, Event::SpindleMode(Some(limit)));
        Ok(())
    }

    /// `G50 S` of lathes: the limit holds at once where constant surface speed is on.
    pub(in crate::exec) fn limit_speed(&mut self, state: &mut State<D>) {
        state.spindle.limit = self.words.number(Letter::of('S')).unwrap_or(f64::NAN);
        if state.effect(Role::SpindleMode, self.model) == Some(Effect::SurfaceSpeed) {
            let limit = state.speed_limit();
            self.emit(state, Event::SpindleMode(Some(limit)));
        }
    }

    /// `M3`, `M4`, `M5`.
    pub(in crate::exec) fn spindle(&mut self, spindle: Spindle, state: &mut State<D>) -> Step {
        state.spindle.way = Flat::Known(spindle);
        self.emit(state, Event::Spindle(spindle));
        Ok(())
    }

    /// The spindle turns as it did at another time, where that is known.
    pub(in crate::exec) fn turn_spindle(&mut self, spindle: Option<Spindle>, state: &mut State<D>) -> Step {
        match spindle {
            Some(spindle) => self.spindle(spindle, state),
            None => {
                state.spindle.way = Flat::Unknown;
                Ok(())
            }
        }
    }

    /// `M19`.
    pub(in crate::exec) fn orient(&mut self, state: &mut State<D>) -> Step {
        let to_p = self.model.semantics().orients_to_p;
        if self.refuses_incomplete() && !self.words.has(Letter::of('R')) {
            // Without an angle the interpreter does nothing (observed).
            return Ok(());
        }
        let angle = self.words.number(Letter::of('R'));
        let angle =
            angle.or_else(|| if to_p { self.raw(Letter::of('P'), state) } else { None }).unwrap_or(0.0);
        let way = if to_p { None } else { self.count(Letter::of('P'))? };
        let way = match way {
            Some(Count::Known(way @ 0..=2)) => way as u8,
            Some(Count::Known(_)) if self.refuses_incomplete() => {
                return Err(Fault::WordRange(Letter::of('P')));
            }
            _ => 0,
        };
        if !(0.0..=360.0).contains(&angle) && self.refuses_incomplete() {
            return Err(Fault::WordRange(Letter::of('R')));
        }
        let timeout = self.words.number(Letter::of('Q'));
        if timeout.is_some_and(|timeout| timeout <= 0.0) {
            return Err(Fault::WordRange(Letter::of('Q')));
        }
        state.spindle.way = Flat::Known(Spindle::Stopped);
        self.emit(state, Event::OrientSpindle { angle, way });
        if let Some(timeout) = timeout {
            self.emit(state, Event::WaitOrient(Seconds(timeout)));
        }
        Ok(())
    }

    /// `G4`.
    pub(in crate::exec) fn dwell(&mut self, state: &mut State<D>) -> Step {
        let mut found = None;
        for (letter, kind) in &self.model.semantics().dwell {
            let Some(letter) = Letter::parse(letter) else { continue };
            let Some(number) = self.words.number(letter) else { continue };
            let seconds = match kind {
                DwellWord::Seconds => number,
                DwellWord::SecondsOrMilliseconds | DwellWord::Milliseconds => {
                    let is_seconds =
                        *kind == DwellWord::SecondsOrMilliseconds && self.words.is_pointed(letter);
                    if is_seconds { number } else { number / 1000.0 }
                }
            };
            found = Some((letter, seconds));
        }
        match found {
            Some((letter, seconds)) if seconds < 0.0 => Err(Fault::WordRange(letter)),
            Some((_, seconds)) => {
                self.emit(state, Event::Dwell(Seconds(seconds)));
                Ok(())
            }
            // Elsewhere a dwell without time is an exact stop.
            None if self.refuses_incomplete() => Err(Fault::NoDwellTime),
            None => Ok(()),
        }
    }

    /// `T`.
    pub(in crate::exec) fn tool_word(&mut self, state: &mut State<D>) -> Step {
        let rules = self.model.semantics().tools;
        let Some(word) = self.count(Letter::of('T'))? else { return Ok(()) };
        let Count::Known(mut number) = word else {
            state.tool.selected = self.words.get(Letter::of('T')).unwrap_or_else(D::unknown);
            self.emit(state, Event::SelectTool(None));
            if rules.change_by_t {
                state.tool.number = D::unknown();
                state.tool.length = Position::UNKNOWN;
                state.tool.h = D::unknown();
                self.emit(state, Event::ToolChange(None));
            }
            return Ok(());
        };
        let mut offset = None;
        if rules.offset_in_t && number >= 100 {
            offset = Some(number % 100);
            number /= 100;
        } else if rules.offset_in_t && number < 100 && rules.change_by_t {
            // `T1` is tool 0, offset 1 on some controls, tool 1 on others: the tool stays unknown.
            offset = None;
        }
        if state.tables().is_complete() && number != 0 && state.tables().tool(number).is_none() {
            return Err(Fault::NoSuchTool(number));
        }
        state.tool.selected = D::number(f64::from(number));
        self.emit(state, Event::SelectTool(Some(number)));
        if rules.change_by_t {
            self.put_tool(Some(number), state);
        }
        if let Some(offset) = offset {
            self.apply_length(offset, 1.0, state)?;
            state.tool.d = D::number(f64::from(offset));
        }
        Ok(())
    }

    /// `M6`.
    pub(in crate::exec) fn tool_change(&mut self, state: &mut State<D>) -> Step {
        let rules = self.model.semantics().tools;
        if self.model.semantics().compensation.freezes_modes && self.compensates(state) {
            return Err(Fault::Compensation(crate::fault::CompensationFault::NotWhileOn));
        }
        if rules.change_needs_t && D::known(state.selected()).is_some_and(|t| t < 0.0) {
            return Err(Fault::NoToolSelected);
        }
        self.emit(state, Event::StartChange);
        self.go_to_change(state);
        if rules.change_stops_spindle {
            self.spindle(Spindle::Stopped, state)?;
        }
        let mist = state.coolant.mist;
        if rules.change_stops_coolant {
            self.all_coolant_off(state);
        }
        #[expect(
            clippy::cast_sign_loss,
            reason = "a tool number is a count: negative ones were refused at `T`"
        )]
        let number = D::known(state.selected()).map(|t| t.max(0.0) as u32);
        self.put_tool(number, state);
        if rules.change_stops_coolant && mist != Truth::False {
            self.coolant(Coolant::Mist, true, state);
            state.coolant.mist = mist;
        }
        if rules.change_cancels_length {
            self.cancel_length(state);
        }
        Ok(())
    }

    /// The axis that a change takes to the machine's zero is there from now on.
    fn go_to_change(&self, state: &mut State<D>) {
        let Some(axis) =
            self.model.semantics().tools.change_at_zero.and_then(|letter| Axis::of(Letter::of(letter)))
        else {
            return;
        };
        let mut machine = state.machine(self.model, self.machine);
        machine.set(axis, 0.0);
        let from = *state.actual();
        let to = state.at_machine(&machine, &from, |named| named == axis, self.model, self.machine);
        state.points.actual = to;
        let programmed = self.programmed_of(&to, state);
        let goes = |other: &Axis| *other == axis || to.raw(*other).to_bits() != from.raw(*other).to_bits();
        for axis in Axis::ALL.into_iter().filter(goes) {
            state.points.position.set(axis, programmed.raw(axis));
        }
    }

    fn put_tool(&mut self, number: Option<u32>, state: &mut State<D>) {
        state.tool.number = number.map_or_else(D::unknown, |n| D::number(f64::from(n)));
        self.load(number, state);
        self.emit(state, Event::ToolChange(number));
    }

    /// The tool's data come with it. No tool leaves those of the last one where they are.
    fn load(&mut self, number: Option<u32>, state: &mut State<D>) {
        let unknown = ToolData { offset: self.unknown_length(state), ..ToolData::UNKNOWN };
        match number {
            Some(0) => {}
            Some(number) => {
                let mut data = state.tables().tool(number).copied().unwrap_or(unknown);
                data.offset = self.with_known_axes(data.offset, state);
                state.tool.loaded = Loaded { data, entry: Self::entry_of(number, state) };
            }
            // It may be no tool.
            None => {
                let data = state.tool.loaded.data.join(&unknown);
                state.tool.loaded = Loaded { data, entry: Perhaps::Unknown };
            }
        }
    }

    /// The entry of the table that a tool's data come from. A tool that nobody listed has one all the same.
    fn entry_of(number: u32, state: &State<D>) -> Perhaps<u32> {
        if number == 0 && state.tables().row_of(number) == 0 { Perhaps::No } else { Perhaps::Yes(number) }
    }

    /// `M61`.
    pub(in crate::exec) fn set_tool_number(&mut self, state: &mut State<D>) -> Step {
        match self.rounded(Letter::of('Q'))? {
            Some(Count::Known(number)) => {
                if state.tables().is_complete() && number != 0 && state.tables().tool(number).is_none() {
                    return Err(Fault::NoSuchTool(number));
                }
                state.tool.number = D::number(f64::from(number));
                // Only its number: the data of the tool that was loaded stay in effect.
                state.tool.loaded.entry = Self::entry_of(number, state);
                self.emit(state, Event::SetToolNumber(Some(number)));
            }
            Some(Count::Unknown) => {
                state.tool.number = D::unknown();
                state.tool.loaded.entry = Perhaps::Unknown;
                self.emit(state, Event::SetToolNumber(None));
            }
            None => return Err(Fault::MissingWord(Letter::of('Q'))),
        }
        Ok(())
    }

    pub(in crate::exec) fn digital_output(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let index = self.index(Letter::of('P'))?;
        let on = effect.switches_output_on();
        let with_move = matches!(effect, Effect::OutputOnWithMove | Effect::OutputOffWithMove);
        if let Some(first) = self.model.semantics().output_variables {
            state.variables.set(first.saturating_add(index), D::number(f64::from(u8::from(on))));
        }
        self.emit(state, Event::Output { index, value: f64::from(u8::from(on)), analog: false, with_move });
        Ok(())
    }

    pub(in crate::exec) fn analog_output(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let index = self.index(Letter::of('E'))?;
        let value = self.words.number(Letter::of('Q')).unwrap_or(-1.0);
        let with_move = effect == Effect::AnalogOutputWithMove;
        self.emit(state, Event::Output { index, value, analog: true, with_move });
        Ok(())
    }

    pub(in crate::exec) fn wait_for_input(&mut self, state: &mut State<D>) -> Step {
        let analog = match (self.words.has(Letter::of('P')), self.words.has(Letter::of('E'))) {
            (true, true) => return Err(Fault::Conflict),
            (false, false) => return Err(Fault::MissingWord(Letter::of('P'))),
            (_, analog) => analog,
        };
        let index = self.index(Letter::of(if analog { 'E' } else { 'P' }))?;
        let what = match self.count(Letter::of('L'))? {
            Some(Count::Known(what @ 0..=4)) => what as u8,
            // The interpreter passes over a way to wait that it does not have (observed).
            Some(Count::Known(_)) if self.refuses_incomplete() => return Ok(()),
            Some(Count::Known(_)) => return Err(Fault::WordRange(Letter::of('L'))),
            _ => 0,
        };
        let timeout = self.words.number(Letter::of('Q')).unwrap_or(0.0);
        if analog && what != 0 {
            return Err(Fault::WordRange(Letter::of('L')));
        }
        if what != 0 && timeout <= 0.0 {
            return Err(Fault::WordRange(Letter::of('Q')));
        }
        self.emit(state, Event::WaitInput { index, analog, what, timeout: Seconds(timeout) });
        Ok(())
    }

    fn index(&self, letter: Letter) -> Step<u32> {
        match self.rounded(letter)? {
            Some(Count::Known(index)) => Ok(index),
            Some(Count::Unknown) => Err(Fault::Undecidable),
            None => Err(Fault::MissingWord(letter)),
        }
    }

    /// Does anything turn that could cut?
    pub(in crate::exec) fn spindle_turns(state: &State<D>) -> Option<bool> {
        state.spindle().map(|s| s != Spindle::Stopped)
    }
}
