//! Probing moves and measuring codes.
//!
//! Knows: targets, and that where the probe touches is known to nobody beforehand. Must not know: calibration.

use gcheck_controls::Effect;

use super::{Executor, Step};
use crate::assumption::Assumption;
use crate::event::{Event, FeedMode, TravelKind};
use crate::fault::Fault;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::State;
use crate::value::{Domain, Truth};

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G38.2` to `G38.5`.
    pub(super) fn probe_move(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        if self.compensates(state) {
            return Err(Fault::Probe);
        }
        let mode = state.feed_mode(self.model);
        if D::known(&state.feed) == Some(0.0) || mode == Some(FeedMode::InverseTime) {
            return Err(Fault::NoFeed);
        }
        if mode == Some(FeedMode::PerRevolution) && self.refuses_incomplete() {
            return Err(Fault::Probe);
        }
        let distance = [Axis::X, Axis::Y, Axis::Z]
            .into_iter()
            .map(|axis| target.raw(axis) - state.position.raw(axis))
            .fold(0.0_f64, |sum, d| sum + d * d)
            .sqrt();
        if distance < self.least_probe_distance(state) {
            return Err(Fault::Probe);
        }
        let toward = matches!(effect, Effect::ProbeToward | Effect::ProbeTowardOptional);
        let required = matches!(effect, Effect::ProbeToward | Effect::ProbeAway);
        self.probing(TravelKind::Probe { toward, required, skip: false }, target, state)
    }

    /// The interpreter refuses probing moves shorter than a hundredth of an inch, or a quarter of a millimetre.
    fn least_probe_distance(&self, state: &State<D>) -> f64 {
        if self.refuses_incomplete() { 0.01 * self.unit(state).max(1.0) } else { 0.0 }
    }

    /// `G31`.
    pub(super) fn skip_move(&mut self, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        self.probing(TravelKind::Probe { toward: true, required: false, skip: true }, target, state)
    }

    /// The probe moves. With a start that is known throughout, a run goes on as if nothing was touched, which is what a
    /// simulation without a workpiece does; else the axes that moved end nobody knows where.
    fn probing(&mut self, kind: TravelKind, target: Position, state: &mut State<D>) -> Step {
        self.emit(state, Event::Probe(true));
        let moved: Vec<Axis> = Axis::ALL
            .into_iter()
            .filter(|axis| target.raw(*axis).to_bits() != state.position.raw(*axis).to_bits())
            .collect();
        let from = state.position;
        self.travel(kind, target, false, state)?;
        self.emit(state, Event::Probe(false));
        self.assumptions.insert(Assumption::ProbeTouch);
        if self.machine.fresh {
            // Without a workpiece the touch is said to be at the end of the move, and the probe stands a hundredth of an inch
            // before it: what a simulation of the reference interpreter does.
            state.probed = state.actual;
            self.stop_short(from, 0.254, state);
            state.probe_result = Truth::False;
            return Ok(());
        }
        state.probed = state.actual;
        for axis in moved {
            state.actual.set(axis, f64::NAN);
            state.position.set(axis, f64::NAN);
            state.probed.set(axis, f64::NAN);
        }
        state.probe_result = Truth::Unknown;
        Ok(())
    }

    fn stop_short(&mut self, from: Position, distance: f64, state: &mut State<D>) {
        let length = Axis::ALL
            .map(|axis| state.position.raw(axis) - from.raw(axis))
            .iter()
            .map(|d| d * d)
            .sum::<f64>()
            .sqrt();
        if length > distance {
            for axis in Axis::ALL {
                let (start, end) = (from.raw(axis), state.position.raw(axis));
                state.position.set(axis, end - (end - start) * distance / length);
            }
            state.actual = self.axes_of(&state.position, state);
        }
    }

    /// `G35`, `G36`, `G37`, `G136`: a touch whose result goes into a table.
    pub(super) fn measure(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        self.probing(TravelKind::Probe { toward: true, required: true, skip: false }, target, state)?;
        let tables = std::rc::Rc::make_mut(&mut state.tables);
        match effect {
            Effect::ProbeOffset | Effect::ProbeCentre => {
                if let Some(number) = state.work {
                    let mut offset = tables.offset(number);
                    for letter in self.words.present().and(self.model.axis_letters).iter() {
                        if let Some((axis, _)) = self.model.axis_of(letter) {
                            offset.origin.set(axis, f64::NAN);
                        }
                    }
                    tables.set_offset(number, offset);
                } else {
                    tables.unsure = true;
                }
                for letter in self.words.present().and(self.model.axis_letters).iter() {
                    if let Some((axis, _)) = self.model.axis_of(letter) {
                        state.actual.set(axis, f64::NAN);
                        state.position.set(axis, f64::NAN);
                    }
                }
            }
            _ => {
                // The number in H or D is written; which value it gets is known after the touch.
                for (_, tool) in &mut tables.tools {
                    if effect == Effect::ProbeLength {
                        tool.offset.set(Axis::Z, f64::NAN);
                    } else {
                        tool.diameter = gcheck_geometry::Mm::UNKNOWN;
                    }
                }
            }
        }
        Ok(())
    }
}
