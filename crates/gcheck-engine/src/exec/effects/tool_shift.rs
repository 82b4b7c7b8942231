//! Tool length along a tilting tool, and cutter size along a vector: where the axes go beside the programmed point.
//!
//! Knows: which words give length, size and vector, which axes follow. Must not know: moves, offsets between work and machine.
//!
//! Both add to the programmed point what the control adds, in the axes of the work coordinates, and move the axes that the
//! block names and no others: an axis that is left out stays where it is, though the tool has turned or the vector is another.

use gcheck_controls::{CodeIx, Effect, Letter};
use gcheck_geometry::{Arrangement, Kinematics, Mm, RotaryAxis};

use crate::assumption::Assumption;
use crate::eval::value::Domain;
use crate::event::Event;
use crate::exec::context::{Count, Executor, Step};
use crate::fault::Fault;
use crate::lattice::Perhaps;
use crate::model::Role;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{ModeSet, State, Transform};

/// X, Y and Z, in the order of shifts.
const XYZ: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// The words of a vector, in the order of its parts.
const IJK: [char; 3] = ['I', 'J', 'K'];

/// A head that tilts in A and, carried by A, in B: what is taken for granted where nobody described the machine.
const HEAD: Kinematics = Kinematics {
    arrangement: Arrangement::HeadHead,
    order: [RotaryAxis::A, RotaryAxis::B],
    sign: [1.0, 1.0],
    inclined: [None; 2],
    pivot_length: None,
    offset: [Mm::ZERO; 3],
};

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `G143`: the length of `H` along the tool.
    pub(in crate::exec) fn length_along_tool(&mut self, state: &mut State<D>) -> Step {
        let length = match self.count(Letter::of('H'))? {
            Some(Count::Known(0)) => {
                self.end_length_mode(state);
                return Ok(());
            }
            Some(Count::Known(number)) => {
                state.tool.h = D::number(f64::from(number));
                self.length_of_tool(number, state)?
            }
            Some(Count::Unknown) => {
                state.tool.h = self.words.get(Letter::of('H')).unwrap_or_else(D::unknown);
                // It may be the zero that ends the mode.
                let off = ModeSet::one(self.model.code_with(Effect::LengthOff));
                state.modes.add(Role::Length, &off);
                f64::NAN
            }
            // H stays in effect from before.
            None => match D::known(state.h()) {
                #[expect(clippy::cast_sign_loss, reason = "offset numbers are counts")]
                Some(h) if h > 0.0 => self.length_of_tool(h as u32, state)?,
                _ => f64::NAN,
            },
        };
        if self.machine.kinematics.is_none() {
            self.assumptions.insert(Assumption::HeadKinematics);
        }
        self.assumptions.insert(Assumption::UprightTool);
        self.flush_compensation(state)?;
        // Refused beside a length along the tool: the path of the two together is not known.
        state.compensation.lose_path();
        // What is along the tool is no offset along Z besides.
        self.set_length(Position::ZERO, state);
        state.tool_shift.along = Some(length);
        self.stand_beside(state);
        Ok(())
    }

    fn length_of_tool(&mut self, number: u32, state: &State<D>) -> Step<f64> {
        let length = match state.tables().tool(number) {
            Some(tool) => tool.length().raw(Axis::Z),
            None if state.tables().is_complete() => return Err(Fault::NoSuchTool(number)),
            None => f64::NAN,
        };
        if length.is_nan() {
            self.assumptions.insert(Assumption::ToolLength(number));
        }
        Ok(length)
    }

    /// `H0` ends the compensation as its cancelling code does.
    fn end_length_mode(&mut self, state: &mut State<D>) {
        let off = self.model.code_with(Effect::LengthOff);
        state.set_mode(Role::Length, off);
        self.emit(state, Event::Modal(off));
        self.cancel_length(state);
    }

    /// The length along the tool gives way to another way of compensating, or to none. The axes stand still.
    pub(in crate::exec) fn end_length_along_tool(&mut self, state: &mut State<D>) {
        if state.tool_shift.along.take().is_some() {
            self.stand_beside(state);
        }
    }

    /// `G141`: the size of `D` along the vector of each block.
    pub(in crate::exec) fn cutter_along_vectors(&mut self, state: &mut State<D>) -> Step {
        // Where the axes are at the programmed point, or beside it by a shift that is known, the point stays as it is.
        let goes_on = state.tool_shift.along.is_none()
            && state.compensation.on.is_no()
            && state.compensation.left.is_no();
        self.flush_compensation(state)?;
        state.compensation.on = Perhaps::No;
        let (radius, _) = self.cutter_radius(state)?;
        state.tool_shift.cutter = Some(radius);
        if !goes_on {
            self.stand_beside(state);
        }
        Ok(())
    }

    /// Shifts along vectors are over. The axes stand still.
    pub(in crate::exec) fn end_cutter_along_vectors(&mut self, state: &mut State<D>) {
        if state.tool_shift.cutter.take().is_some() {
            self.stand_beside(state);
        }
    }

    /// `H` and `D` of a block that follows the one that switched on.
    pub(in crate::exec) fn words_of_tool_shift(&mut self, state: &mut State<D>) -> Step {
        let names = |role: Role| self.words.codes().iter().any(|code| self.model.role(*code) == Some(role));
        let (length, compensation) = (names(Role::Length), names(Role::Compensation));
        if state.tool_shift.along.is_some() && self.words.has(Letter::of('H')) && !length {
            if state.effect(Role::Length, self.model) == Some(Effect::LengthFiveAxis) {
                self.length_along_tool(state)?;
            } else {
                // On or off: the word may be read, or not.
                state.tool.h = D::unknown();
                state.tool_shift.along = Some(f64::NAN);
                self.stand_beside(state);
            }
        }
        if state.tool_shift.cutter.is_some() && self.words.has(Letter::of('D')) && !compensation {
            if state.effect(Role::Compensation, self.model) == Some(Effect::CompensationVector) {
                self.remember_offset_number(state)?;
                state.tool_shift.cutter = Some(self.cutter_radius(state)?.0);
            } else {
                state.tool.d = D::unknown();
                state.tool_shift.cutter = Some(f64::NAN);
            }
        }
        Ok(())
    }

    /// Tells the vector of a block that moves, so that somebody may judge it.
    pub(in crate::exec) fn announce_vector(&mut self, state: &mut State<D>) {
        if state.tool_shift.cutter.is_some() {
            let parts = IJK.map(|letter| self.words.number(Letter::of(letter)));
            self.emit(state, Event::CutterVector(parts));
        }
    }

    /// How far from a programmed point the axes stand for it.
    pub(in crate::exec) fn tool_shift(&self, target: &Position, state: &State<D>) -> [f64; 3] {
        let mut shift = match state.tool_shift.along {
            None | Some(0.0) => [0.0; 3],
            Some(length) => self.along_tool(length, target),
        };
        if let Some(radius) = state.tool_shift.cutter
            && radius != 0.0
        {
            for (slot, part) in shift.iter_mut().zip(self.vector(state)) {
                *slot += if part == 0.0 { 0.0 } else { radius * part };
            }
        }
        shift
    }

    /// A length along the tool, as far as it goes in each axis. Unknown on a machine that does not tilt the tool in both axes.
    pub(in crate::exec) fn along_tool(&self, length: f64, target: &Position) -> [f64; 3] {
        let kinematics = self.machine.kinematics.unwrap_or(HEAD);
        if kinematics.arrangement != Arrangement::HeadHead {
            // The code is for machines that tilt the tool in both axes.
            return [f64::NAN; 3];
        }
        kinematics.offset_along_tool([Mm::ZERO; 3], Mm(length), target.abc()).map(|mm| mm.0)
    }

    /// The vector of the block; NaN where it is not known. A part that is not written is zero; the block that switches
    /// compensation on goes to its point when it has no vector (Haas NGC mill manual 2017, p. 311 and 313).
    fn vector(&self, state: &State<D>) -> [f64; 3] {
        let cycle = state.active_cycle(self.model);
        let is_straight =
            matches!(state.effect(Role::Motion, self.model), Some(Effect::Rapid | Effect::Linear))
                && cycle.is_some_and(|code| !code.is_some());
        let parts = IJK.map(|letter| self.words.number(Letter::of(letter)));
        let switches_on = |code: &CodeIx| self.model.effect(*code) == Effect::CompensationVector;
        if !is_straight || parts == [None; 3] && !self.words.codes().iter().any(switches_on) {
            return [f64::NAN; 3];
        }
        parts.map(|part| part.unwrap_or(0.0))
    }

    /// Axes that the block does not name stay where they are (Haas NGC mill manual 2017, p. 313 and 326).
    pub(in crate::exec) fn keep_unnamed(&self, to: &mut Position, state: &State<D>) {
        if !state.tool_shift.is_on() || *state.transform() != Transform::NONE {
            return;
        }
        for axis in XYZ {
            if !self.words.has(axis.letter()) {
                to.set(axis, state.actual().raw(axis));
            }
        }
    }

    /// What was switched on or off changes how the place where the axes stand reads.
    fn stand_beside(&mut self, state: &mut State<D>) {
        state.tool_shift.beside = match state.tool_shift.cutter {
            // Of the last point's vector nothing is kept.
            Some(radius) if radius != 0.0 => [f64::NAN; 3],
            _ => {
                let here = *state.actual();
                self.tool_shift(&here, state)
            }
        };
        state.points.position = self.programmed_of(state.actual(), state);
    }

    /// After a block: how far the axes stand beside the programmed point.
    pub(in crate::exec) fn settle_tool_shift(&self, state: &mut State<D>) {
        if !state.tool_shift.is_on() {
            return;
        }
        let plain = self.transformed(state.position(), state);
        let here = *state.actual();
        for (slot, axis) in state.tool_shift.beside.iter_mut().zip(XYZ) {
            *slot = here.raw(axis) - plain.raw(axis);
        }
    }
}

/// A point moved by a shift.
pub(in crate::exec) fn shifted(point: Position, [x, y, z]: [f64; 3]) -> Position {
    let [px, py, pz] = point.xyz();
    point.with_xyz([px + Mm(x), py + Mm(y), pz + Mm(z)])
}
