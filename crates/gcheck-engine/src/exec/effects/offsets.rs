//! Work offsets, shifts, tool lengths: codes that move the coordinates, not the axes.
//!
//! Knows: G10, G43 to G49, G52, G54 and its kin, G92. Must not know: moves.
//!
//! The axes stay where they are, so the position in work coordinates changes by what the offsets change.

use std::rc::Rc;

use gcheck_controls::{CodeIx, DataOpening, Effect, Letter, LetterSet};
use gcheck_geometry::Mm;
use gcheck_program::{BlockTable, Place, Value, Word};

use crate::assumption::Assumption;
use crate::eval::value::{Domain, Truth};
use crate::event::{Event, ToolEntry};
use crate::exec::context::{Count, Executor, Step};
use crate::fault::{CompensationFault, Fault};
use crate::lattice::{Flat, Lattice, Perhaps};
use crate::machine::WorkOffset;
use crate::observer::Observer;
use crate::origin::At;
use crate::position::{Axis, Position};
use crate::state::{Offsets, State, ToolData};

#[expect(clippy::unnecessary_wraps, reason = "handlers of effects share one signature")]
impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Changes offsets while the axes stand still.
    fn reframe(&mut self, state: &mut State<D>, change: impl FnOnce(&mut State<D>)) {
        let before = Placement::of(state);
        let old = *state.actual();
        let machine = state.machine(self.model, self.machine);
        change(state);
        let after = Placement::of(state);
        if before.same(&after) {
            return;
        }
        let here = before.moved(&old, &after);
        state.points.actual = here;
        if state.follows_rotary(&machine, self.model, self.machine) {
            self.reread(&machine, state);
            return;
        }
        if let Some(cylinder) = state.mapping.wrapped.yes_mut() {
            // The axis that is wrapped stands still as all the others do.
            let linear = cylinder.linear;
            let mut standing = old;
            standing.set(linear, cylinder.stands);
            cylinder.stands = before.moved(&standing, &after).raw(linear);
            cylinder.anchor(&here);
        }
        let programmed = self.programmed_of(&here, state);
        state.points.position = programmed;
    }

    /// `G54` and its kin.
    pub(in crate::exec) fn select_work_offset(&mut self, number: Option<u16>, state: &mut State<D>) {
        if number.is_some() && number == state.work() && self.refuses_incomplete() {
            // The system in use stays as it is.
            return;
        }
        self.reframe(state, |state| {
            let offset = number.map_or(WorkOffset::UNKNOWN, |n| state.tables().offset(n));
            state.offsets.work = number.into();
            state.offsets.in_effect = offset;
        });
        if number.is_none() {
            // One unknown system may have taken the place of another.
            state.points.lose();
        }
        if let Some(number) = number
            && !state.tables().offset(number).origin.is_known()
        {
            self.assumptions.insert(Assumption::WorkOffset(number));
        }
        self.announce_offset(state);
        let shift = state.shift();
        self.emit(state, Event::Shift(shift));
        self.announce_rotation(state);
    }

    pub(crate) fn announce_offset(&mut self, state: &mut State<D>) {
        let WorkOffset { origin, rotation } = state.work_offset();
        let number = state.work().unwrap_or(0);
        self.emit(state, Event::WorkOffset { number, offset: origin, rotation });
    }

    pub(in crate::exec) fn announce_rotation(&mut self, state: &mut State<D>) {
        let rotation = state.work_offset().rotation;
        self.emit(state, Event::Rotation(rotation));
    }

    /// The words' values by axis, lengths in millimetres; NaN on axes that the block does not name.
    fn named_axes(&self, state: &State<D>) -> Position {
        let mut values = Position::UNKNOWN;
        for axis in &self.model.axes {
            if let Some(value) = self.measured(*axis, axis.letter(), state) {
                values.set(*axis, value);
            }
        }
        values
    }

    /// What a word says of an axis, lengths in millimetres.
    fn measured(&self, axis: Axis, letter: Letter, state: &State<D>) -> Option<f64> {
        let value = self.words.number(letter)?;
        let value = if axis.is_rotary() || value == 0.0 { value } else { value * self.unit(state) };
        let is_diameter = axis == Axis::X && state.is_diameter(self.model) == Some(true);
        Some(if is_diameter { value / 2.0 } else { value })
    }

    /// Axes that the block names, with their values.
    fn named(&self, state: &State<D>) -> Vec<(Axis, f64)> {
        let values = self.named_axes(state);
        let named = self.model.axes.iter().filter(|axis| self.words.has(axis.letter()));
        named.map(|axis| (*axis, values.raw(*axis))).collect()
    }

    /// Axes that the block changes by an address of increments, with their steps in millimetres.
    fn increments(&self, state: &State<D>) -> Vec<(Axis, f64)> {
        let present = self.words.present().and(self.model.axis_letters);
        let steps = present.iter().filter_map(|letter| {
            let (axis, _) = self.model.axis_of(letter).filter(|(_, is_increment)| *is_increment)?;
            Some((axis, self.measured(axis, letter, state)?))
        });
        steps.collect()
    }

    /// `G92`: the present position reads as programmed.
    pub(in crate::exec) fn set_position(&mut self, state: &mut State<D>) -> Step {
        self.check_named_axes()?;
        let mut named = self.named(state);
        let position = if state.compensation.is_followed() { *state.position() } else { *state.actual() };
        let adds = self.model.semantics().increments_set_position;
        let changed = self.increments(state).into_iter();
        named.extend(
            changed.map(|(axis, step)| (axis, if adds { position.raw(axis) + step } else { f64::NAN })),
        );
        if named.is_empty() {
            return if self.refuses_incomplete() { Err(Fault::NoAxisWords) } else { Ok(()) };
        }
        for (axis, value) in &named {
            // Machine = work + shift stays, so the shift grows by what the position loses.
            let counts = if self.shifts_are_one() { state.offsets.shift_on } else { Truth::True };
            let base = match (counts, state.offsets.shift.raw(*axis)) {
                (Truth::True, shift) => shift,
                (Truth::False, _) => 0.0,
                (Truth::Unknown, shift) => {
                    if shift == 0.0 {
                        0.0
                    } else {
                        f64::NAN
                    }
                }
            };
            // `G52` of the axis is over: what it moved is in the new shift.
            let local = if self.shifts_are_one() { 0.0 } else { state.offsets.local.raw(*axis) };
            if local != 0.0 {
                state.offsets.local.set(*axis, 0.0);
            }
            state.offsets.shift.set(*axis, base + local + position.raw(*axis) - value);
            state.points.actual.set(*axis, *value);
            state.points.position.set(*axis, *value);
        }
        // What is suspended does not come back on other axes.
        let unnamed = |axis: &Axis| !named.iter().any(|(a, _)| a == axis);
        let in_effect = state.offsets.shift_in_effect();
        for axis in Axis::ALL.into_iter().filter(unnamed) {
            state.offsets.shift.set(axis, in_effect.raw(axis));
        }
        state.offsets.shift_on = Truth::True;
        let here = *state.actual();
        if let Some(cylinder) = state.mapping.wrapped.yes_mut() {
            // The drawing has a new zero; what that says of the axis that stands still is in no page.
            cylinder.stands = f64::NAN;
            cylinder.anchor(&here);
        }
        let shift = state.shift();
        self.emit(state, Event::Shift(shift));
        Ok(())
    }

    /// `G52`.
    pub(in crate::exec) fn local_shift(&mut self, state: &mut State<D>) -> Step {
        self.check_named_axes()?;
        let named = self.named(state);
        if named.is_empty() && self.refuses_incomplete() {
            return Err(Fault::NoAxisWords);
        }
        let shared = self.shifts_are_one();
        self.reframe(state, |state| {
            if shared {
                // What is suspended does not come back with another axis.
                let in_effect = state.offsets.shift_in_effect();
                state.offsets.shift = in_effect;
                state.offsets.shift_on = Truth::True;
            }
            for (axis, value) in &named {
                if shared {
                    state.offsets.shift.set(*axis, *value);
                } else {
                    state.offsets.local.set(*axis, *value);
                }
            }
        });
        for (axis, _) in named.iter().filter(|(_, value)| value.is_nan()) {
            // One unknown shift may have taken the place of another.
            state.points.actual.set(*axis, f64::NAN);
            state.points.position.set(*axis, f64::NAN);
        }
        let shift = state.shift();
        self.emit(state, Event::Shift(shift));
        Ok(())
    }

    /// `G92.1`, `G92.2`.
    pub(in crate::exec) fn clear_shift(&mut self, state: &mut State<D>, keep: bool) {
        self.reframe(state, |state| {
            state.offsets.shift_on = Truth::False;
            if !keep {
                state.offsets.shift = Position::ZERO;
            }
        });
        let shift = state.shift();
        self.emit(state, Event::Shift(shift));
    }

    /// `G92.3`.
    pub(in crate::exec) fn restore_shift(&mut self, state: &mut State<D>) {
        self.reframe(state, |state| state.offsets.shift_on = Truth::True);
        let shift = state.shift();
        self.emit(state, Event::Shift(shift));
    }

    // ---- tool length ----

    pub(in crate::exec) fn length_code(&mut self, effect: Effect, state: &mut State<D>) -> Step {
        match effect {
            Effect::LengthOff => {
                self.cancel_length(state);
                Ok(())
            }
            Effect::LengthFromBlock => {
                // With X Y Z as offsets; where the code takes H it is a length along the tool.
                if self.words.has(Letter::of('H')) {
                    return self.length_number(1.0, state);
                }
                let named = self.named(state);
                // Axes that are not named keep their offsets.
                let mut length = *state.length();
                for (axis, value) in named {
                    length.set(axis, value);
                }
                self.set_length(length, state);
                Ok(())
            }
            Effect::LengthAdd => self.add_length(state),
            Effect::LengthFiveAxis => self.length_along_tool(state),
            Effect::LengthMinus => self.length_number(-1.0, state),
            _ => self.length_number(1.0, state),
        }
    }

    /// `G43 H…`.
    fn length_number(&mut self, sign: f64, state: &mut State<D>) -> Step {
        let rules = self.model.semantics().tools;
        match self.count(Letter::of('H'))? {
            None | Some(Count::Known(0)) if rules.length_from_tool => {
                self.loaded_length(sign, state);
                Ok(())
            }
            Some(Count::Known(number)) => {
                if number == 0 && !rules.length_from_tool {
                    // H0 is length zero, and ends the compensation on some controls.
                    state.tool.h = D::number(0.0);
                    self.set_length(Position::ZERO, state);
                    return Ok(());
                }
                self.apply_length(number, sign, state)
            }
            Some(Count::Unknown) => {
                state.tool.h = self.words.get(Letter::of('H')).unwrap_or_else(D::unknown);
                self.set_length(self.unknown_length(state), state);
                Ok(())
            }
            // H stays in effect from before.
            None => match D::known(state.h()) {
                #[expect(clippy::cast_sign_loss, reason = "offset numbers are counts")]
                Some(h) if h > 0.0 => self.apply_length(h as u32, sign, state),
                _ => {
                    self.set_length(self.unknown_length(state), state);
                    Ok(())
                }
            },
        }
    }

    /// The length of the tool in the spindle, as it was loaded.
    pub(in crate::exec) fn loaded_length(&mut self, sign: f64, state: &mut State<D>) {
        let number = state.tool().clone();
        state.tool.h = number;
        let mut length = self.with_known_axes(state.tool.loaded.data.length(), state);
        if !length.is_known()
            && let Some(tool) = D::known(state.tool())
        {
            #[expect(clippy::cast_sign_loss, reason = "tool numbers are counts")]
            self.assumptions.insert(Assumption::ToolLength(tool as u32));
        }
        for axis in Axis::ALL {
            length.set(axis, sign * length.raw(axis));
        }
        self.set_length(length, state);
    }

    /// Any length may be in effect, of any number.
    pub(in crate::exec) fn lose_length(&mut self, state: &mut State<D>) {
        state.tool.h = D::unknown();
        let length = self.unknown_length(state);
        self.set_length(length, state);
    }

    /// Offsets of a tool of which nothing is known: only along Z on mills.
    pub(in crate::exec) fn unknown_length(&self, state: &State<D>) -> Position {
        let mut length = Position::ZERO;
        length.set(Axis::Z, f64::NAN);
        if state.is_diameter(self.model) == Some(true) {
            length.set(Axis::X, f64::NAN);
        }
        length
    }

    /// Of an entry of which nothing is known but its size, too: only along Z on mills.
    pub(in crate::exec) fn with_known_axes(&self, mut length: Position, state: &State<D>) -> Position {
        let unknown = self.unknown_length(state);
        for axis in Axis::ALL {
            if length.raw(axis).is_nan() && !unknown.raw(axis).is_nan() {
                length.set(axis, 0.0);
            }
        }
        length
    }

    pub(in crate::exec) fn apply_length(&mut self, number: u32, sign: f64, state: &mut State<D>) -> Step {
        state.tool.h = D::number(f64::from(number));
        if number == 0 && !self.model.semantics().tools.length_from_tool {
            self.set_length(Position::ZERO, state);
            return Ok(());
        }
        let length = match state.tables().tool(number) {
            Some(tool) => tool.length(),
            None if number == 0 => Position::ZERO,
            None if state.tables().is_complete() => return Err(Fault::NoSuchTool(number)),
            None => self.unknown_length(state),
        };
        let length = self.with_known_axes(length, state);
        if !length.is_known() {
            self.assumptions.insert(Assumption::ToolLength(number));
        }
        let mut signed = length;
        for axis in Axis::ALL {
            signed.set(axis, sign * length.raw(axis));
        }
        self.set_length(signed, state);
        Ok(())
    }

    fn add_length(&mut self, state: &mut State<D>) -> Step {
        let axes = self.words.present().intersects(self.model.axis_letters);
        match (self.words.has(Letter::of('H')), axes) {
            (true, true) if self.refuses_incomplete() => return Err(Fault::Conflict),
            (false, false) if self.refuses_incomplete() => return Err(Fault::NoAxisWords),
            _ => {}
        }
        let added = match self.count(Letter::of('H'))? {
            Some(Count::Known(number)) => match state.tables().tool(number) {
                Some(tool) => tool.length(),
                None if state.tables().is_complete() => return Err(Fault::NoSuchTool(number)),
                None => self.unknown_length(state),
            },
            Some(Count::Unknown) => self.unknown_length(state),
            None => {
                // The interpreter looks for a tool all the same.
                if self.refuses_incomplete() && state.tables().is_complete() && !self.leaves_to_rules() {
                    return Err(Fault::MissingWord(Letter::of('H')));
                }
                let mut added = Position::ZERO;
                for (axis, value) in self.named(state) {
                    added.set(axis, value);
                }
                added
            }
        };
        let length = *state.length() + added;
        self.set_length(length, state);
        Ok(())
    }

    pub(in crate::exec) fn cancel_length(&mut self, state: &mut State<D>) {
        state.tool.h = D::number(0.0);
        self.set_length(Position::ZERO, state);
    }

    pub(in crate::exec) fn set_length(&mut self, length: Position, state: &mut State<D>) {
        self.end_length_along_tool(state);
        let old = *state.length();
        self.reframe(state, |state| state.tool.length = length);
        for axis in Axis::ALL {
            // One unknown length took the place of another.
            if old.raw(axis).is_nan() && length.raw(axis).is_nan() {
                state.points.actual.set(axis, f64::NAN);
                state.points.position.set(axis, f64::NAN);
            }
        }
        self.emit(state, Event::LengthOffset(length));
    }

    // ---- G10 ----

    /// `G10`: writes offsets and tool data.
    pub(in crate::exec) fn write_offsets(&mut self, ix: CodeIx, state: &mut State<D>) -> Step {
        if self.opens_data(ix) {
            state.data_entry = Truth::True;
            return Ok(());
        }
        let Some(kind) = self.count(Letter::of('L'))? else {
            // Without L the forms differ from control to control.
            self.forget_offsets(state);
            return if self.refuses_incomplete() { Err(Fault::MissingWord(Letter::of('L'))) } else { Ok(()) };
        };
        let Count::Known(kind) = kind else {
            self.forget_offsets(state);
            return Ok(());
        };
        let number = match kind {
            2 | 20 if self.refuses_incomplete() => self.truncated(Letter::of('P'))?,
            _ => self.rounded(Letter::of('P'))?,
        };
        self.check_named_axes()?;
        match kind {
            2 => self.write_work_offset(number, false, state),
            20 if self.refuses_incomplete() => self.write_work_offset(number, true, state),
            20 => {
                // Extra work offsets: P counts from the first of them.
                let first = self.model.control().codes().find_map(|code| match code.effect() {
                    Effect::WorkOffsetByP(first) => Some(first),
                    _ => None,
                });
                let system = match (number, first) {
                    (Some(Count::Known(p)), Some(first)) if p > 0 => {
                        u16::try_from(p).ok().map(|p| first + p - 1)
                    }
                    _ => None,
                };
                self.write_work_system(system, false, state);
                Ok(())
            }
            0 if self.refuses_incomplete() => self.reload_tools(state),
            1 | 10 | 11 => self.write_tool(kind, number, state),
            12 | 13 if !self.refuses_incomplete() => self.write_tool(kind, number, state),
            _ if self.refuses_incomplete() => Err(Fault::WordRange(Letter::of('L'))),
            _ => Ok(()),
        }
    }

    /// Does the block open lines of data by this code?
    fn opens_data(&mut self, ix: CodeIx) -> bool {
        let number = |letter| self.words.has(letter).then(|| self.words.number(letter));
        match self.model.control().code_at(ix).map(|code| code.data_opening(number)) {
            None | Some(DataOpening::Never) => false,
            Some(DataOpening::IfEnded) => self.ends_rows_below(),
            Some(DataOpening::Certain) => true,
        }
    }

    /// Is the first code below the block under way one that ends lines of data?
    fn ends_rows_below(&mut self) -> bool {
        let At { file, block } = self.origin.at;
        if let Some(ends) = self.rows_end.get(&self.origin.at) {
            return *ends;
        }
        let dialect = self.program.dialect();
        let ends = self.file(file).is_some_and(|file| file.loaded.ends_data_below(block, dialect));
        self.rows_end.insert(self.origin.at, ends);
        ends
    }

    /// Ends lines of data at a block with a code: it ends them by right, as `G11` does, or it is a command that the control stops
    /// for, and what it means to do is done all the same. True: the block may be a row.
    pub(in crate::exec) fn reads_row_or_ends_data(words: &[Word], state: &mut State<D>) -> bool {
        if state.data_entry == Truth::False {
            return false;
        }
        let has_code = words.iter().any(|word| word.code != CodeIx::NONE);
        if has_code {
            state.data_entry = Truth::False;
        }
        !has_code
    }

    /// The words of a row of data with their numbers. A word whose value is a fault is one of an unknown value: the control
    /// looks at rows in its own way.
    pub(in crate::exec) fn row(
        &mut self,
        place: &Place,
        table: &BlockTable,
        words: &[Word],
        state: &State<D>,
    ) -> Rc<[(Letter, f64)]> {
        let mut number = |word: &Word| match word.value {
            Value::Number(number) => Some(number),
            Value::Missing => Some(f64::NAN),
            Value::Expr(expr) => {
                let value =
                    self.value_of(place, table, table.expr(expr), state).unwrap_or_else(|_| D::unknown());
                // An empty variable takes the word out.
                let is_there = D::is_vacant(&value) != Truth::True;
                is_there.then(|| D::known(&value).unwrap_or(f64::NAN))
            }
        };
        words.iter().filter_map(|word| Some((word.letter, number(word)?))).collect()
    }

    /// What a strict control asks of `G10` before its block acts: a form that exists, and the number that the form needs.
    pub(in crate::exec) fn check_write_offsets(&self) -> Step {
        let (l, p) = (Letter::of('L'), Letter::of('P'));
        let Some(Count::Known(kind)) = self.count(l)? else { return Ok(()) };
        let of_work = matches!(kind, 2 | 20);
        // The interpreter refuses decimals below a half only (observed).
        let decimals = self.words.number(p).map_or(0.0, f64::fract);
        if kind != 0 && decimals > 1e-4 && decimals < 0.5 {
            return Err(Fault::WordRange(p));
        }
        let number = match kind {
            0 => return Ok(()),
            2 | 20 => self.truncated(p)?,
            1 | 10 | 11 => self.rounded(p)?,
            _ => return Err(Fault::WordRange(l)),
        };
        match number {
            None => Err(Fault::MissingWord(p)),
            Some(Count::Known(number)) if of_work && number > 9 || !of_work && number == 0 => {
                Err(Fault::WordRange(p))
            }
            _ => Ok(()),
        }
    }

    /// Axes that the machine does not have.
    pub(in crate::exec) fn check_named_axes(&self) -> Step {
        let Some(own) = &self.machine.axes else { return Ok(()) };
        let mut absent = self.model.axes.iter().filter(|axis| !own.contains(axis)).map(|axis| axis.letter());
        match absent.find(|letter| self.words.has(*letter)) {
            Some(letter) => Err(Fault::NoSuchAxis(letter)),
            None => Ok(()),
        }
    }

    /// `G10 L0`: the table of tools is read again, which a tool in the spindle forbids.
    fn reload_tools(&mut self, state: &mut State<D>) -> Step {
        let loaded = D::known(state.tool()).is_some_and(|tool| tool != 0.0);
        if loaded { Err(Fault::NotNow(self.model.code_with(Effect::WriteOffsets), None)) } else { Ok(()) }
    }

    pub(in crate::exec) fn forget_offsets(&mut self, state: &mut State<D>) {
        let turns = self.model.semantics().work_offsets_rotate && self.words.has(Letter::of('R'));
        let shifts = !self.refuses_incomplete();
        let named = self.named(state);
        let shared = self.shifts_are_one();
        self.reframe(state, |state| {
            state.offsets.tables_mut().forget_offsets(turns);
            for (axis, _) in named.iter().filter(|_| shifts) {
                // Number 0 is the shift of all systems.
                let Offsets { shift, local, .. } = &mut state.offsets;
                let slot = if shared { shift } else { local };
                slot.set(*axis, f64::NAN);
            }
            state.offsets.in_effect.origin = Position::UNKNOWN;
            if turns {
                state.offsets.in_effect.rotation = f64::NAN;
            }
        });
        // One unknown offset may have taken the place of another.
        state.points.lose();
    }

    fn write_work_offset(&mut self, number: Option<Count>, here: bool, state: &mut State<D>) -> Step {
        let system = match number {
            Some(Count::Known(0)) if self.refuses_incomplete() => state.work(),
            // P0 is the shift of all systems on other controls.
            Some(Count::Known(0)) => {
                self.write_shift_of_all(state);
                return Ok(());
            }
            Some(Count::Known(p)) => match u16::try_from(p) {
                Ok(p) if p <= 9 || !self.refuses_incomplete() => Some(p),
                _ => return Err(Fault::WordRange(Letter::of('P'))),
            },
            Some(Count::Unknown) => None,
            None if self.refuses_incomplete() => return Err(Fault::MissingWord(Letter::of('P'))),
            None => state.work(),
        };
        let of_tools = LetterSet::of(if here { "IJR" } else { "IJ" });
        if self.words.present().intersects(of_tools) && self.refuses_incomplete() {
            return Err(Fault::Conflict);
        }
        if system.is_some() && system == state.work() && self.refuses_incomplete() && self.compensates(state)
        {
            return Err(Fault::Compensation(CompensationFault::NotWhileOn));
        }
        self.write_work_system(system, here, state);
        Ok(())
    }

    /// `G10 L2 P0`: the shift of `G52`, where the control keeps it apart.
    fn write_shift_of_all(&mut self, state: &mut State<D>) {
        if self.shifts_are_one() {
            return;
        }
        let incremental = state.is_incremental(self.model);
        for (axis, value) in self.named(state) {
            let value = match incremental {
                Some(true) => state.offsets.local.raw(axis) + value,
                Some(false) => value,
                None => f64::NAN,
            };
            self.set_local_shift(axis, value, state);
        }
    }

    /// The shift of `G52` along an axis, millimetres or degrees.
    pub(crate) fn set_local_shift(&mut self, axis: Axis, value: f64, state: &mut State<D>) {
        self.reframe(state, |state| state.offsets.local.set(axis, value));
        let shift = state.shift();
        self.emit(state, Event::Shift(shift));
    }

    /// Writes a work coordinate system: its origin, or so that the present position reads as programmed.
    fn write_work_system(&mut self, system: Option<u16>, here: bool, state: &mut State<D>) {
        let Some(system) = system else {
            self.forget_offsets(state);
            return;
        };
        let mut named = self.named(state);
        let incremental = state.is_incremental(self.model) == Some(true) && !self.refuses_incomplete();
        if !here && state.is_incremental(self.model).is_none() && !self.refuses_incomplete() {
            // Whether the words are added is not known.
            for (_, value) in &mut named {
                *value = f64::NAN;
            }
        }
        let turns = self.model.semantics().work_offsets_rotate && !here;
        let rotation = self.words.number(Letter::of('R')).filter(|_| turns);
        let old = state.tables().offset(system);
        let mut offset = old;
        if let Some(rotation) = rotation {
            offset.rotation = rotation;
        }
        if here {
            // Machine position without the shift and tool, turned into the system's own directions.
            let machine = state.machine(self.model, self.machine) - *state.length();
            let turned = machine.turned(-offset.rotation);
            let origin = offset.origin.turned(-offset.rotation);
            let mut wanted = origin;
            for (axis, value) in &named {
                wanted.set(*axis, turned.raw(*axis) - value - state.shift().raw(*axis));
            }
            let back = wanted.turned(offset.rotation);
            for axis in Axis::ALL {
                let turned = offset.rotation != 0.0 && matches!(axis, Axis::X | Axis::Y);
                if turned || named.iter().any(|(a, _)| *a == axis) {
                    offset.origin.set(axis, back.raw(axis));
                }
            }
        } else {
            for (axis, value) in &named {
                let base = if incremental { old.origin.raw(*axis) } else { 0.0 };
                offset.origin.set(*axis, base + value);
            }
        }
        let active = state.work() == Some(system);
        let here = *state.actual();
        self.reframe(state, |state| {
            state.offsets.tables_mut().set_offset(system, offset);
            if active {
                state.offsets.in_effect = offset;
            }
        });
        if active && self.refuses_incomplete() && old.rotation.to_bits() != offset.rotation.to_bits() {
            // A mistake of the interpreter, but what the machine then does: it turns its position without the shift.
            let turned = (here.turned(old.rotation) + old.origin - offset.origin).turned(-offset.rotation);
            for axis in [Axis::X, Axis::Y] {
                state.points.actual.set(axis, turned.raw(axis));
            }
            state.points.position = self.programmed_of(state.actual(), state);
        }
        if active {
            for (axis, _) in &named {
                // One unknown offset took the place of another.
                if offset.origin.raw(*axis).is_nan() {
                    state.points.actual.set(*axis, f64::NAN);
                    state.points.position.set(*axis, f64::NAN);
                }
            }
            self.announce_offset(state);
            self.announce_rotation(state);
        }
    }

    /// Writes a tool's length or radius.
    fn write_tool(&mut self, kind: u32, number: Option<Count>, state: &mut State<D>) -> Step {
        let Some(number) = number else { return Err(Fault::MissingWord(Letter::of('P'))) };
        let Count::Known(number) = number else {
            state.offsets.tables_mut().forget_tools();
            return Ok(());
        };
        if !self.refuses_incomplete() {
            return self.write_register(kind, number, state);
        }
        if number == 0 || state.tables().lacks_tool(number) {
            return Err(Fault::NoSuchTool(number));
        }
        if !self.words.present().intersects(self.model.axis_letters.or(const { LetterSet::of("RIJQ") })) {
            // Without a value to write it is refused (observed).
            return Err(Fault::MissingWord(Letter::of('R')));
        }
        let named = self.named(state);
        let radius = self.length(Letter::of('R'), state);
        let angles = [self.words.number(Letter::of('I')), self.words.number(Letter::of('J'))];
        let orientation = self.count(Letter::of('Q'))?;
        let machine = state.machine(self.model, self.machine);
        let work = state.work_offset();
        let shift = state.shift();
        let fixture = state.tables().offset(9);
        let tool = state.offsets.tables_mut().tool_mut(number);
        if kind == 1 {
            for (axis, value) in &named {
                tool.offset.set(*axis, *value);
            }
        } else {
            // So that the present position reads as programmed, with the offsets in effect or with the last system's. In
            // a turned system that is worked out in its own directions.
            let (frame, shift) = if kind == 10 { (work, shift) } else { (fixture, Position::ZERO) };
            let here = (machine - frame.origin).turned(-frame.rotation) - shift;
            let mut turned = tool.offset.turned(-frame.rotation);
            for (axis, value) in &named {
                turned.set(*axis, here.raw(*axis) - value);
            }
            tool.offset = turned.turned(frame.rotation);
        }
        if let Some(radius) = radius {
            tool.diameter = Mm(2.0 * radius);
        }
        for (slot, angle) in tool.angles.iter_mut().zip(angles) {
            if let Some(angle) = angle {
                *slot = angle;
            }
        }
        match orientation {
            Some(Count::Known(q @ 0..=9)) => tool.orientation = Flat::Known(q as u8),
            Some(Count::Known(_)) => return Err(Fault::WordRange(Letter::of('Q'))),
            Some(Count::Unknown) => tool.orientation = Flat::Unknown,
            None => {}
        }
        let written = *tool;
        self.announce_tool(number, &written, state);
        Ok(())
    }

    /// A tool's entry was written: it is that of the tool in the spindle, too, where that was loaded from it.
    fn announce_tool(&mut self, number: u32, written: &ToolData, state: &mut State<D>) {
        let ToolData { angles, orientation, .. } = *written;
        let (offset, diameter) = (written.length(), written.size());
        let entry = ToolEntry {
            pocket: state.tables().row_of(number),
            tool: number,
            offset,
            diameter,
            angles,
            orientation: orientation.known().unwrap_or(0),
        };
        self.emit(state, Event::ToolTableEntry(entry));
        match state.tool.loaded.entry {
            Perhaps::Yes(loaded) if loaded == number => {
                state.tool.loaded.data = *written;
                state.tool.number = D::number(f64::from(number));
                self.emit(state, Event::ToolTableEntry(ToolEntry { pocket: 0, ..entry }));
            }
            Perhaps::Unknown => {
                let either = state.tool.loaded.data.join(written);
                state.tool.loaded.data = either;
                let either = state.tool().join(&D::number(f64::from(number)));
                state.tool.number = either;
            }
            Perhaps::Yes(_) | Perhaps::No => {}
        }
    }

    /// Registers of other controls: length (L10), its wear (L11, L1), size (L12) and its wear (L13), by `R`.
    fn write_register(&mut self, kind: u32, number: u32, state: &mut State<D>) -> Step {
        let Some(value) = self.length(Letter::of('R'), state) else { return Ok(()) };
        let incremental = state.is_incremental(self.model) == Some(true);
        let is_settled = state.is_incremental(self.model).is_some();
        let value = if is_settled { value } else { f64::NAN };
        let is_diameter = self.offsets_are_diameters();
        let tool = state.offsets.tables_mut().tool_mut(number);
        match kind {
            10 => {
                let base = if incremental { tool.offset.raw(Axis::Z) } else { 0.0 };
                tool.offset.set(Axis::Z, base + value);
                for axis in [Axis::X, Axis::Y] {
                    if tool.offset.raw(axis).is_nan() {
                        tool.offset.set(axis, 0.0);
                    }
                }
            }
            12 => {
                let base = if incremental { tool.diameter.0 } else { 0.0 };
                tool.diameter = Mm(base + if is_diameter { value } else { 2.0 * value });
            }
            1 | 11 => {
                let [wear, _] = &mut tool.wear;
                *wear = value + if incremental { *wear } else { 0.0 };
            }
            _ => {
                let [_, wear] = &mut tool.wear;
                let value = if is_diameter { value } else { 2.0 * value };
                *wear = value + if incremental { *wear } else { 0.0 };
            }
        }
        Ok(())
    }

    /// Is a cutter's register a diameter? A setting may say so.
    pub(in crate::exec) fn offsets_are_diameters(&mut self) -> bool {
        let rules = &self.model.semantics().compensation;
        match &rules.setting {
            Some(number) => self.setting(number).is_some_and(|value| value.contains("diameter")),
            None => rules.value == gcheck_controls::OffsetValue::Diameter,
        }
    }
}

/// Everything between work and machine coordinates.
#[derive(Debug, Clone, Copy)]
struct Placement {
    work: Option<u16>,
    offset: WorkOffset,
    shift: Position,
    local: Position,
    length: Position,
}

impl Placement {
    fn of<D: Domain>(state: &State<D>) -> Self {
        Self {
            work: state.work(),
            offset: state.work_offset(),
            shift: state.offsets.shift_in_effect(),
            local: state.offsets.local,
            length: *state.length(),
        }
    }

    fn same(&self, other: &Self) -> bool {
        let Self { work, offset, shift, local, length } = self;
        *work == other.work
            && offset.same(&other.offset)
            && shift.same(&other.shift)
            && local.same(&other.local)
            && length.same(&other.length)
    }

    /// Where a point in work coordinates is after this placement has become another, the axes standing still.
    fn moved(&self, point: &Position, after: &Self) -> Position {
        let (before, turned) = (self.offset.rotation, after.offset.rotation);
        let still_turned = before.same(&turned) && before.is_nan() && self.is_level_with(after);
        if before == 0.0 && turned == 0.0 || still_turned {
            *point + self.less(after)
        } else {
            after.work_of_machine(&self.to_machine(point))
        }
    }

    /// Is the same all that a rotation turns: what is between it and the machine, in X and Y?
    fn is_level_with(&self, after: &Self) -> bool {
        let known = self.work.is_some() && self.work == after.work;
        let same = |a: &Position, b: &Position| {
            [Axis::X, Axis::Y].into_iter().all(|axis| a.raw(axis).same(&b.raw(axis)))
        };
        known && same(&self.offset.origin, &after.offset.origin) && same(&self.length, &after.length)
    }

    fn to_machine(self, work: &Position) -> Position {
        let WorkOffset { origin, rotation } = self.offset;
        (*work + self.shift + self.local).turned(rotation) + origin + self.length
    }

    fn work_of_machine(self, machine: &Position) -> Position {
        let WorkOffset { origin, rotation } = self.offset;
        (*machine - self.length - origin).turned(-rotation) - self.shift - self.local
    }

    /// What a position in work coordinates gains when this placement becomes another. Parts that did not change cancel out,
    /// known or not; an unknown part that was replaced leaves its axes unknown.
    fn less(&self, after: &Self) -> Position {
        let same_system = self.work.is_some() && self.work == after.work;
        per_axis(&self.offset.origin, &after.offset.origin, same_system)
            + per_axis(&self.shift, &after.shift, true)
            + per_axis(&self.local, &after.local, true)
            + per_axis(&self.length, &after.length, true)
    }
}

/// The difference by axis; unknown stays unknown unless `same` says that an unknown value is still the same one.
fn per_axis(old: &Position, new: &Position, same: bool) -> Position {
    let mut difference = *old - *new;
    for axis in Axis::ALL {
        if same && old.raw(axis).same(&new.raw(axis)) {
            difference.set(axis, 0.0);
        }
    }
    difference
}
