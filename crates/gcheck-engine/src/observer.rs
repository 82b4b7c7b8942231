//! Who watches an execution: the interface between the engine and everything made of what it computes.
//!
//! Knows: what is shown, and when. Must not know: what observers do with it.

use crate::assumption::Assumption;
use crate::eval::value::Domain;
use crate::event::Event;
use crate::fault::Fault;
use crate::origin::Origin;
use crate::state::State;

/// Watches an execution.
pub trait Observer<D: Domain> {
    /// A block is about to be executed in this state.
    fn before(&mut self, origin: Origin, state: &State<D>) {
        let _ = (origin, state);
    }

    /// Something happened; the state is that after it. Under cutter compensation events come when the next move is known,
    /// so the state may be that of a later block.
    fn event(&mut self, origin: Origin, state: &State<D>, event: &Event) {
        let _ = (origin, state, event);
    }

    /// A variable was read that nobody set before, on a control where that is nothing.
    fn vacant_read(&mut self, origin: Origin, state: &State<D>, variable: u32) {
        let _ = (origin, state, variable);
    }

    /// A block was executed.
    fn after(&mut self, origin: Origin, state: &State<D>) {
        let _ = (origin, state);
    }

    /// A block cannot be executed, in this state.
    fn fault(&mut self, origin: Origin, state: &State<D>, fault: &Fault) {
        let _ = (origin, state, fault);
    }

    /// A run takes something for granted, or leaves it unknown, in a block that is the first to need it.
    fn assumed(&mut self, origin: Origin, assumption: &Assumption) {
        let _ = (origin, assumption);
    }

    /// Has it seen enough? A run asks now and then, and ends when it has.
    fn stops(&mut self) -> bool {
        false
    }
}

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Nobody;

impl<D: Domain> Observer<D> for Nobody {}

impl<D: Domain, O: Observer<D> + ?Sized> Observer<D> for &mut O {
    fn before(&mut self, origin: Origin, state: &State<D>) {
        (**self).before(origin, state);
    }

    fn event(&mut self, origin: Origin, state: &State<D>, event: &Event) {
        (**self).event(origin, state, event);
    }

    fn vacant_read(&mut self, origin: Origin, state: &State<D>, variable: u32) {
        (**self).vacant_read(origin, state, variable);
    }

    fn after(&mut self, origin: Origin, state: &State<D>) {
        (**self).after(origin, state);
    }

    fn fault(&mut self, origin: Origin, state: &State<D>, fault: &Fault) {
        (**self).fault(origin, state, fault);
    }

    fn assumed(&mut self, origin: Origin, assumption: &Assumption) {
        (**self).assumed(origin, assumption);
    }

    fn stops(&mut self) -> bool {
        (**self).stops()
    }
}
