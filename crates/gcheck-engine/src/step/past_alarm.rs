//! Going on after an alarm: the block has the effect that it has once the programmer has corrected it.
//!
//! Knows: where a refused block leads, and which way a run takes that nobody can decide. Must not know: how often a run goes on,
//! what a run reports of it.

use std::collections::BTreeSet;

use super::arc::plane_axes;
use super::{Executor, Outcome};
use crate::event::{Event, Travel, TravelKind};
use crate::fault::Fault;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::position::{Axis, Position};
use crate::state::State;
use crate::value::Domain;

/// What went before a block that may be refused.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Before {
    /// Where the axes were.
    actual: Position,
    /// Moves given out until then.
    moves: u64,
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, Counting<O>> {
    /// What [`Self::go_on`] has to know of the state before the block.
    pub(crate) fn before_block(&self, state: &State<D>) -> Before {
        Before { actual: *state.actual(), moves: self.observer.moves }
    }

    /// After a block that was refused: the axes go where the block meant them to go, in a straight line. The next block, or `None`
    /// where the program cannot go on.
    pub(crate) fn go_on(
        &mut self,
        at: At,
        before: &Before,
        fault: &Fault,
        state: &mut State<D>,
    ) -> Option<At> {
        if matches!(fault, Fault::NoProgramEnd) || self.place(at).is_none() {
            return self.return_from_unfinished(state);
        }
        self.bridge(before, fault, state);
        Some(at.next())
    }

    /// A subprogram whose text ends without a return goes back to its caller; a main program is over.
    fn return_from_unfinished(&mut self, state: &mut State<D>) -> Option<At> {
        if state.calls.is_main() {
            return None;
        }
        match self.leave(None, None, state) {
            Ok(Outcome::Jump(to)) => Some(to),
            _ => None,
        }
    }

    /// A straight line to where the refused block leads, unless it moved.
    fn bridge(&mut self, before: &Before, fault: &Fault, state: &mut State<D>) {
        if state.compensation.is_followed() || self.observer.moves != before.moves {
            return;
        }
        let in_cycle = state.active_cycle(self.model).is_some_and(gcheck_controls::CodeIx::is_some);
        if same_place(state.actual(), &before.actual) {
            // Of a block whose words could not be read nobody knows where it leads.
            let words_are_read = !matches!(
                fault,
                Fault::Value(_) | Fault::Undecidable | Fault::UnsetParameter | Fault::VariableNumber
            );
            if !words_are_read || !self.words.present().intersects(self.model.axis_letters) {
                return;
            }
            let Ok(mut target) = self.target(state) else { return };
            if in_cycle {
                let Some(plane) = state.plane(self.model) else { return };
                let ([_, _, depth], _) = plane_axes(plane);
                target.set(depth, state.position().raw(depth));
            }
            state.points.position = target;
            let to = self.axes_of(&target, state);
            state.points.actual = to;
            if same_place(&to, &before.actual) {
                return;
            }
        }
        let kind = if in_cycle { TravelKind::Rapid } else { TravelKind::Feed };
        let (from, programmed, to) = (before.actual, *state.position(), *state.actual());
        self.emit(state, Event::Travel(Travel { kind, from, programmed, to, expanded: true }));
    }
}

/// The way of a run where a condition or a target is not known: the next block, the first time; a block that is met again is
/// left by another way, so that a loop of unknown length runs once.
pub(crate) fn choose_way<D: Domain>(
    at: At,
    ways: Vec<(At, State<D>)>,
    met: &mut BTreeSet<At>,
) -> Option<(At, State<D>)> {
    let is_first = met.insert(at);
    let next = at.next();
    let mut ways = ways.into_iter();
    let first = ways.next()?;
    if (first.0 == next) == is_first {
        return Some(first);
    }
    Some(ways.find(|(to, _)| (*to == next) == is_first).unwrap_or(first))
}

/// Are the axes where they were? Unknown is where it was, too.
fn same_place(a: &Position, b: &Position) -> bool {
    Axis::ALL.into_iter().all(|axis| a.raw(axis).to_bits() == b.raw(axis).to_bits())
}

/// Passes everything on, and counts moves.
#[derive(Debug)]
pub(crate) struct Counting<O> {
    pub(crate) observer: O,
    moves: u64,
}

impl<O> Counting<O> {
    pub(crate) fn new(observer: O) -> Self {
        Self { observer, moves: 0 }
    }
}

impl<D: Domain, O: Observer<D>> Observer<D> for Counting<O> {
    #[inline]
    fn before(&mut self, origin: Origin, state: &State<D>) {
        self.observer.before(origin, state);
    }

    #[inline]
    fn event(&mut self, origin: Origin, state: &State<D>, event: &Event) {
        let is_move =
            matches!(event, Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. });
        self.moves += u64::from(is_move);
        self.observer.event(origin, state, event);
    }

    fn vacant_read(&mut self, origin: Origin, state: &State<D>, variable: u32) {
        self.observer.vacant_read(origin, state, variable);
    }

    #[inline]
    fn after(&mut self, origin: Origin, state: &State<D>) {
        self.observer.after(origin, state);
    }

    fn fault(&mut self, origin: Origin, state: &State<D>, fault: &Fault) {
        self.observer.fault(origin, state, fault);
    }

    fn stops(&mut self) -> bool {
        self.observer.stops()
    }
}
