//! Reference positions: G28, G29, G30 and where they are kept.
//!
//! Knows: the way through the intermediate point. Must not know: offsets' values.

use gcheck_controls::LetterSet;

use super::{Executor, Step};
use crate::assumption::Assumption;
use crate::event::TravelKind;
use crate::fault::{CompensationFault, Fault};
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::State;
use crate::value::Domain;

#[expect(clippy::unused_self, reason = "the parts of a step read as its methods")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G28`, `G30`: by the block's point to the reference position, on the axes that the block names.
    pub(super) fn return_reference(&mut self, number: u8, state: &mut State<D>) -> Step {
        if self.compensates(state) && self.refuses_incomplete() {
            return Err(Fault::Compensation(CompensationFault::NotWhileOn));
        }
        let named = self.words.present().and(self.model.axis_letters);
        let axes: Vec<Axis> = if named.is_empty() {
            if !self.model.semantics().reference_without_axes {
                return Ok(());
            }
            self.model.axes.clone()
        } else {
            let mut axes: Vec<Axis> =
                named.iter().filter_map(|letter| self.model.axis_of(letter)).map(|(axis, _)| axis).collect();
            axes.dedup();
            axes
        };
        let through = self.target(state)?;
        self.travel(TravelKind::Rapid, through, true, state)?;
        let index = usize::from(number.saturating_sub(1)).min(1);
        let reference = state.tables.references.get(index).copied().unwrap_or(Position::UNKNOWN);
        if !reference.is_known() {
            self.assumptions.insert(Assumption::ReferencePosition(number));
        }
        // The axes that return are given in machine coordinates; the others stay where they are.
        let target = state.from_machine(&reference);
        let mut to = state.actual;
        for axis in &axes {
            to.set(*axis, target.raw(*axis));
        }
        let returned: LetterSet = axes.iter().map(|axis| axis.letter()).collect();
        self.moved_off_drawing(returned, &mut to, state);
        let programmed = self.programmed_of(&to, state);
        self.travel(TravelKind::Rapid, programmed, true, state)?;
        // Beyond the turning of unknown coordinates, this is where the axes stand.
        state.actual = to;
        if self.model.semantics().reference_cancels_length {
            self.cancel_length(state);
        }
        Ok(())
    }

    /// `G29`: to the block's point, by the point that the last `G28` passed; that point is not kept here.
    pub(super) fn return_from_reference(&mut self, state: &mut State<D>) -> Step {
        let target = self.target(state)?;
        self.travel(TravelKind::Rapid, target, true, state)
    }

    /// `G28.1`, `G30.1`.
    pub(super) fn store_reference(&mut self, number: u8, state: &mut State<D>) {
        let machine = state.machine();
        let tables = std::rc::Rc::make_mut(&mut state.tables);
        if let Some(slot) = tables.references.get_mut(usize::from(number.saturating_sub(1)).min(1)) {
            *slot = machine;
        }
    }

    /// Do the block's words name an axis?
    pub(super) fn names_axes(&self, letters: &str) -> bool {
        self.words.present().intersects(LetterSet::of(letters))
    }
}
