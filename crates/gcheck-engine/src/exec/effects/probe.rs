//! Probing moves and measuring codes.
//!
//! Knows: targets, and that where the probe touches is known to nobody beforehand. Must not know: calibration.

use gcheck_controls::{Effect, Letter};
use gcheck_geometry::Mm;

use crate::assumption::Assumption;
use crate::eval::value::{Domain, Truth};
use crate::event::{Event, FeedMode, TravelKind};
use crate::exec::context::{Executor, Step};
use crate::fault::Fault;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{State, Touch, Way, Ways};

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G38.2` to `G38.9`.
    pub(in crate::exec) fn probe_move(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        if self.compensates(state) {
            return Err(Fault::Probe);
        }
        let mode = state.feed_mode(self.model);
        if D::known(state.feed()) == Some(0.0) || mode == Some(FeedMode::InverseTime) {
            return Err(Fault::NoFeed);
        }
        if mode == Some(FeedMode::PerRevolution) && self.refuses_incomplete() {
            return Err(Fault::Probe);
        }
        let distance = [Axis::X, Axis::Y, Axis::Z]
            .into_iter()
            .map(|axis| target.raw(axis) - state.position().raw(axis))
            .fold(0.0_f64, |sum, d| sum + d * d)
            .sqrt();
        // A move of other axes alone has no shortest length.
        let turns_alone = distance == 0.0
            && Axis::ALL
                .into_iter()
                .filter(|axis| ![Axis::X, Axis::Y, Axis::Z].contains(axis))
                .any(|axis| target.raw(axis).to_bits() != state.position().raw(axis).to_bits());
        if !turns_alone && distance < self.least_probe_distance(state) {
            return Err(Fault::Probe);
        }
        let toward = effect.probes_toward();
        let required = matches!(effect, Effect::ProbeToward | Effect::ProbeAway);
        self.probing(TravelKind::Probe { toward, required, skip: false }, target, state)
    }

    /// The interpreter refuses probing moves shorter than a hundredth of an inch, or a quarter of a millimetre.
    fn least_probe_distance(&self, state: &State<D>) -> f64 {
        if self.refuses_incomplete() { 0.01 * self.unit(state).max(1.0) } else { 0.0 }
    }

    /// `G31`.
    pub(in crate::exec) fn skip_move(&mut self, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        self.probing(TravelKind::Probe { toward: true, required: false, skip: true }, target, state)
    }

    /// The probe moves. With a start that is known throughout, a run goes on as if nothing was touched, which is what a
    /// simulation without a workpiece does; who looks at a path sees the probe touch at its target; else the axes that moved end
    /// nobody knows where.
    fn probing(&mut self, kind: TravelKind, target: Position, state: &mut State<D>) -> Step {
        state.probe.touched = Touch::Made(self.ways_to(&target, state));
        self.emit(state, Event::Probe(true));
        let mut moved: Vec<Axis> = Axis::ALL
            .into_iter()
            .filter(|axis| target.raw(*axis).to_bits() != state.position().raw(*axis).to_bits())
            .collect();
        let (from, stood) = (*state.position(), *state.actual());
        self.travel(kind, target, false, state)?;
        self.emit(state, Event::Probe(false));
        state.probe.point = *state.actual();
        if self.has_code(Effect::AlarmIfTouched) {
            // Who goes on behind this block has not touched anything: the move came to its end.
            state.probe.result = Truth::False;
            return Ok(());
        }
        self.assumptions.insert(Assumption::ProbeTouch);
        let is_guessed = self.machine.guesses.touch.is_some();
        if self.options.assumes && !is_guessed {
            state.probe.result = Truth::True;
            return Ok(());
        }
        if self.machine.fresh {
            // Without a workpiece the touch is said to be at the end of the move, and the probe stands a hundredth of an inch
            // before it: what a simulation of the reference interpreter does.
            self.stop_short(from, 0.254, state);
            state.probe.result = self.has_code(Effect::AlarmIfNotTouched).into();
            return Ok(());
        }
        // Under a rotation an axis moves that the block does not name.
        moved.extend(
            Axis::ALL
                .into_iter()
                .filter(|axis| stood.raw(*axis).to_bits() != state.actual().raw(*axis).to_bits()),
        );
        let touched = self.guessed_touch(&from, state);
        let stands = self.axes_of(&touched, state);
        for axis in moved {
            state.points.actual.set(axis, stands.raw(axis));
            state.points.position.set(axis, touched.raw(axis));
            state.probe.point.set(axis, stands.raw(axis));
        }
        let must_touch = self.has_code(Effect::AlarmIfNotTouched);
        let guess = self.machine.guesses.touch.map(|share| share < 1.0);
        let result = guess.map_or_else(D::unknown, |guess| D::assumed(D::number(f64::from(u8::from(guess)))));
        state.probe.result = if must_touch { Truth::True } else { D::truth(&result) };
        Ok(())
    }

    /// The point at which a probing move to the programmed point touched, by the share of its way that is guessed; unknown
    /// without a guess.
    fn guessed_touch(&self, from: &Position, state: &State<D>) -> Position {
        let Some(share) = self.machine.guesses.touch else { return Position::UNKNOWN };
        let guessed = |number: f64| D::known(&D::assumed(D::number(number))).unwrap_or(f64::NAN);
        let mut touched = *state.position();
        for axis in Axis::ALL {
            let (start, end) = (from.raw(axis), touched.raw(axis));
            touched.set(axis, guessed(start + (end - start) * share));
        }
        touched
    }

    pub(in crate::exec) fn has_code(&self, effect: Effect) -> bool {
        self.words.codes().iter().any(|code| self.model.effect(*code) == effect)
    }

    /// Which way the block drives each axis. The sign of an increment tells it even where nobody knows the start.
    fn ways_to(&self, target: &Position, state: &State<D>) -> Ways {
        let mut ways = Ways::STILL;
        for letter in self.words.present().and(self.model.axis_letters).iter() {
            let Some((axis, is_increment)) = self.model.axis_of(letter) else { continue };
            let increment = self.words.number(letter).filter(|_| match self.is_incremental(state) {
                Some(incremental) => incremental || is_increment,
                None => is_increment,
            });
            ways.set(axis, Way::of(increment.unwrap_or(target.raw(axis) - state.position().raw(axis))));
        }
        ways
    }

    fn stop_short(&mut self, from: Position, distance: f64, state: &mut State<D>) {
        let length = Axis::ALL
            .map(|axis| state.position().raw(axis) - from.raw(axis))
            .iter()
            .map(|d| d * d)
            .sum::<f64>()
            .sqrt();
        if length > distance {
            for axis in Axis::ALL {
                let (start, end) = (from.raw(axis), state.position().raw(axis));
                state.points.position.set(axis, end - (end - start) * distance / length);
            }
            let mut stands = self.axes_of(state.position(), state);
            self.keep_unnamed(&mut stands, state);
            state.points.actual = stands;
        }
    }

    /// `G35`, `G36`, `G37`, `G136`: a touch whose result goes into a table.
    pub(in crate::exec) fn measure(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let mut target = self.target(state)?;
        let named = self.words.present().and(self.model.axis_letters);
        let axes: Vec<Axis> =
            named.iter().filter_map(|letter| self.model.axis_of(letter).map(|(axis, _)| axis)).collect();
        if effect == Effect::ProbeLength {
            // The word says what the touched point shall read; the move ends at the touch alone.
            for axis in &axes {
                target.set(*axis, f64::NAN);
            }
        }
        self.probing(TravelKind::Probe { toward: true, required: true, skip: false }, target, state)?;
        match effect {
            Effect::ProbeOffset | Effect::ProbeCentre => self.measure_offset(axes, state),
            _ => self.measure_tool(effect, &axes, state),
        }
        Ok(())
    }

    /// The active work offset is set on the axes of the block, and shifted by I, J and K: it is set, but to what the touch
    /// says.
    fn measure_offset(&mut self, mut axes: Vec<Axis>, state: &mut State<D>) {
        for (shift, axis) in [('I', Axis::X), ('J', Axis::Y), ('K', Axis::Z)] {
            // The page does not say whether an axis that is not probed is shifted too.
            let is_shifted = self.words.number(Letter::of(shift)).is_some_and(|by| by != 0.0);
            if is_shifted && !axes.contains(&axis) {
                axes.push(axis);
            }
        }
        let Some(number) = state.work() else { return self.forget_offsets(state) };
        let mut offset = state.tables().offset(number);
        for axis in axes {
            offset.origin.set(axis, f64::NAN);
            state.offsets.in_effect.origin.set(axis, f64::NAN);
            state.points.actual.set(axis, f64::NAN);
            state.points.position.set(axis, f64::NAN);
        }
        state.offsets.tables_mut().set_offset(number, offset);
        self.announce_offset(state);
    }

    /// The length or the size of a tool is set: of the number in H or D, else of the one in effect.
    fn measure_tool(&mut self, effect: Effect, axes: &[Axis], state: &mut State<D>) {
        let is_length = effect == Effect::ProbeLength;
        let (letter, in_effect) = if is_length { ('H', state.h()) } else { ('D', state.d()) };
        let in_effect = D::known(in_effect);
        let written = self.words.number(Letter::of(letter)).or(in_effect).filter(|n| *n >= 1.0);
        let may_be = |number: Option<f64>| match (number, written) {
            (Some(number), Some(written)) => (number - written).abs() < 0.5,
            _ => true,
        };
        let mut lengths = axes.to_vec();
        if !self.model.semantics().tools.offset_in_t {
            lengths.push(Axis::Z);
        }
        for (number, tool) in state.offsets.tables_mut().tools_mut() {
            if !may_be(Some(f64::from(number))) {
                continue;
            }
            if is_length {
                for axis in &lengths {
                    tool.offset.set(*axis, f64::NAN);
                }
            } else {
                tool.diameter = Mm::UNKNOWN;
            }
        }
        if is_length && may_be(in_effect) {
            for axis in lengths {
                state.tool.length.set(axis, f64::NAN);
                state.points.actual.set(axis, f64::NAN);
                state.points.position.set(axis, f64::NAN);
            }
            let length = *state.length();
            self.emit(state, Event::LengthOffset(length));
        }
    }
}
