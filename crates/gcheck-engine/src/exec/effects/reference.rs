//! Reference positions: G28, G29, G30 and where they are kept.
//!
//! Knows: the way through the intermediate point. Must not know: offsets' values.

use gcheck_controls::{Letter, LetterSet};

use crate::assumption::Assumption;
use crate::eval::value::Domain;
use crate::event::TravelKind;
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CompensationFault, Fault};
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G28`, `G30`: by the block's point to the reference position, on the axes that the block names.
    pub(in crate::exec) fn return_reference(&mut self, number: u8, state: &mut State<D>) -> Step {
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
        let reference = self.reference(number, state)?;
        let through = self.target(state)?;
        self.travel(TravelKind::Rapid, through, true, state)?;
        for axis in &axes {
            state.points.passed.set(*axis, through.raw(*axis));
        }
        // The axes that return are given in machine coordinates; the others stay where they are.
        let mut machine = state.machine(self.model, self.machine);
        if state.follows_rotary(&machine, self.model, self.machine) {
            for axis in &axes {
                machine.set(*axis, reference.raw(*axis));
            }
        } else {
            // Each axis goes to its coordinate of the whole position, in turned coordinates too.
            machine = reference;
        }
        let is_named = |axis| axes.contains(&axis);
        let mut to = state.at_machine(&machine, state.actual(), is_named, self.model, self.machine);
        let returned: LetterSet = axes.iter().map(|axis| axis.letter()).collect();
        self.moved_off_drawing(returned, &mut to, state);
        let programmed = self.programmed_of(&to, state);
        self.travel(TravelKind::Rapid, programmed, true, state)?;
        // Beyond the turning of unknown coordinates, this is where the axes stand.
        state.points.actual = to;
        if self.model.semantics().reference_cancels_length {
            self.cancel_length(state);
        }
        Ok(())
    }

    /// The reference position of a code, or of its `P`: where a code returns to the second one, `P3` and `P4` name two more.
    fn reference(&mut self, number: u8, state: &State<D>) -> Step<Position> {
        let letter = Letter::of('P');
        let number = match self.count(letter)? {
            Some(Count::Known(p)) if number == 2 => match u8::try_from(p) {
                Ok(p @ 2..=4) => p,
                _ => return Err(Fault::WordRange(letter)),
            },
            Some(Count::Unknown) if number == 2 => return Ok(Position::UNKNOWN),
            _ => number,
        };
        let known = state.offsets.tables.references.get(usize::from(number.saturating_sub(1)));
        let reference = known.copied().unwrap_or(Position::UNKNOWN);
        if !reference.is_known() {
            self.assumptions.insert(Assumption::ReferencePosition(number));
        }
        Ok(reference)
    }

    /// `G29`: to the block's point, by the point that the last `G28` passed on the axes that the block names.
    pub(in crate::exec) fn return_from_reference(&mut self, state: &mut State<D>) -> Step {
        let named = self.words.present().and(self.model.axis_letters);
        let mut through = *state.position();
        for (axis, _) in named.iter().filter_map(|letter| self.model.axis_of(letter)) {
            through.set(axis, state.points.passed.raw(axis));
        }
        self.travel(TravelKind::Rapid, through, true, state)?;
        // Increments count from the point passed.
        let target = self.target(state)?;
        self.travel(TravelKind::Rapid, target, true, state)
    }

    /// `G28.1`, `G30.1`.
    pub(in crate::exec) fn store_reference(&mut self, number: u8, state: &mut State<D>) {
        let machine = state.machine(self.model, self.machine);
        let tables = state.offsets.tables_mut();
        if let Some(slot) = tables.references.get_mut(usize::from(number.saturating_sub(1)).min(1)) {
            *slot = machine;
        }
    }

    /// Do the block's words name an axis?
    pub(in crate::exec) fn names_axes(&self, letters: &str) -> bool {
        self.words.present().intersects(LetterSet::of(letters))
    }
}
