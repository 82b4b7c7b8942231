//! Turning cycles: one-pass cycles, grooving, threading, profiles.
//!
//! Knows: their words on each control's form. Must not know: the strokes ([`crate::cycles`]).

use gcheck_controls::{CodeIx, Effect};

use super::{Executor, Step};
use crate::observer::Observer;
use crate::state::State;
use crate::value::Domain;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    pub(super) fn turning_pass(&mut self, _effect: Effect, _state: &mut State<D>) -> Step {
        Ok(())
    }

    pub(super) fn groove_cycle(&mut self, _effect: Effect, _state: &mut State<D>) -> Step {
        Ok(())
    }

    pub(super) fn thread_cycle(&mut self, _state: &mut State<D>) -> Step {
        Ok(())
    }

    pub(super) fn profile_cycle(&mut self, _effect: Effect, ix: CodeIx, state: &mut State<D>) -> Step {
        self.opaque_operation(ix, state);
        Ok(())
    }
}
