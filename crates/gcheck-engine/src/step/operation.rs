//! Operations of one block on mills: pockets and hole patterns.
//!
//! Knows: their words. Must not know: the strokes ([`crate::cycles`]).

use gcheck_controls::Effect;

use super::{Executor, Step};
use crate::observer::Observer;
use crate::state::State;
use crate::value::Domain;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    pub(super) fn circular_pocket(&mut self, _effect: Effect, _state: &mut State<D>) -> Step {
        Ok(())
    }

    pub(super) fn general_pocket(&mut self, _state: &mut State<D>) -> Step {
        Ok(())
    }

    pub(super) fn bolt_pattern(&mut self, _effect: Effect, _state: &mut State<D>) -> Step {
        Ok(())
    }
}
