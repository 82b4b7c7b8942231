//! System variables: what the state itself answers, and what writing one does.
//!
//! Knows: positions, offsets, modes and tools behind variable numbers. Must not know: which control has which number (data).

use gcheck_controls::{CodeNumber, Effect, Letter, SystemValue, SystemVariable, Unset};

use crate::eval::value::{Domain, Truth};
use crate::event::{Event, FeedMode, Spindle, Stop, Units};
use crate::exec::context::{Ending, Executor, Outcome, Step};
use crate::fault::{CompensationFault, Fault};
use crate::model::Role;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// The value of a system variable.
    pub(crate) fn read_system(
        &mut self,
        variable: &SystemVariable,
        row: u32,
        column: u32,
        state: &State<D>,
    ) -> Step<D::Value> {
        use SystemValue as V;
        // By number the position is that of a move still to come; by name it may be asked all the same.
        let by_number = variable.first.is_some() && variable.holds == V::WorkPosition;
        if by_number && self.refuses_incomplete() && self.compensates(state) {
            return Err(Fault::Compensation(CompensationFault::NotWhileOn));
        }
        let value = self
            .place_held(variable, row, column, state)
            .or_else(|| self.tool_held(variable, column, state))
            .or_else(|| self.mode_held(variable, state));
        Ok(value.unwrap_or_else(|| self.program_held(variable)))
    }

    /// The value of a variable that holds a position or an offset.
    fn place_held(
        &self,
        variable: &SystemVariable,
        row: u32,
        column: u32,
        state: &State<D>,
    ) -> Option<D::Value> {
        use SystemValue as V;
        let axis = axis_of(variable, column);
        let coordinate = |position: &Position| {
            axis.map_or_else(D::unknown, |axis| {
                measured::<D>(self.in_program_units(axis, position.raw(axis), state))
            })
        };
        let machine_units = |position: &Position| {
            axis.map_or_else(D::unknown, |axis| {
                measured::<D>(self.in_table_units(axis, position.raw(axis), state))
            })
        };
        Some(match variable.holds {
            // No page says which point they show while the axes stand beside it.
            V::WorkPosition | V::EndPosition | V::LengthOffset if state.tool_shift.is_on() => D::unknown(),
            V::WorkPosition | V::EndPosition => coordinate(state.actual()),
            V::MachinePosition => coordinate(&state.machine(self.model, self.machine)),
            V::ProbePosition => coordinate(&state.probe.point),
            V::ProbeResult => truth::<D>(state.probe.result),
            V::LengthOffset => coordinate(&state.tool.length),
            V::WorkOffset => {
                let first = variable.of.as_deref().and_then(|of| of.parse::<u32>().ok()).unwrap_or(1);
                machine_units(&state.tables().offset((first + row) as u16).origin)
            }
            V::WorkRotation => measured::<D>(state.tables().offset((row + 1) as u16).rotation),
            V::Shift => machine_units(&state.offsets.shift),
            V::LocalShift => machine_units(&state.offsets.local),
            V::ShiftActive => truth::<D>(state.offsets.shift_on),
            V::WorkOffsetNumber => state.work().map_or_else(D::unknown, |n| {
                if variable.name.is_some() { self.work_code(n) } else { D::number(f64::from(n)) }
            }),
            V::Reference1 => machine_units(&state.tables().references[0]),
            V::Reference2 => machine_units(&state.tables().references[1]),
            _ => return None,
        })
    }

    /// The value of a variable that holds a tool number or what the tool table says of a tool.
    fn tool_held(&self, variable: &SystemVariable, column: u32, state: &State<D>) -> Option<D::Value> {
        use SystemValue as V;
        match variable.holds {
            V::ToolNumber => return Some(state.tool().clone()),
            V::SelectedTool => return Some(state.selected().clone()),
            V::ToolLength | V::ToolDiameter | V::ToolRadius | V::ToolLengthWear | V::ToolDiameterWear => {}
            _ => return None,
        }
        let tool = match &variable.of {
            // A table by tool number.
            Some(first) => Some(first.parse::<u32>().unwrap_or(1) + column),
            #[expect(clippy::cast_sign_loss, reason = "tool numbers are counts")]
            None => D::known(state.tool()).map(|t| t as u32),
        };
        let Some(tool) = tool else { return Some(D::unknown()) };
        let Some(entry) = state.tables().tool(tool) else {
            return Some(if state.tables().is_complete() { D::number(0.0) } else { D::unknown() });
        };
        let in_table = |axis: Axis, value: f64| measured::<D>(self.in_table_units(axis, value, state));
        Some(match variable.holds {
            V::ToolLength => match (&variable.of, axis_of(variable, column)) {
                (None, Some(axis)) => in_table(axis, entry.offset.raw(axis)),
                _ => in_table(Axis::Z, entry.offset.raw(Axis::Z)),
            },
            V::ToolDiameter => in_table(Axis::X, entry.diameter.0),
            V::ToolLengthWear | V::ToolDiameterWear => {
                let [length, diameter] = entry.wear;
                let wear = if variable.holds == V::ToolLengthWear { length } else { diameter };
                // What nobody wrote may be any wear.
                if wear == 0.0 { D::unknown() } else { in_table(Axis::Z, wear) }
            }
            _ => in_table(Axis::X, entry.diameter.0 / 2.0),
        })
    }

    /// The value of a variable that holds a mode, a word that lasts, or a switch of the machine.
    fn mode_held(&self, variable: &SystemVariable, state: &State<D>) -> Option<D::Value> {
        use SystemValue as V;
        let flag = |truth: Option<bool>| truth.map_or_else(D::unknown, |t| D::number(f64::from(u8::from(t))));
        Some(match variable.holds {
            V::ModalCode => self.modal_code(variable, state),
            V::LastWord => match variable.of.as_deref() {
                Some("F") => state.feed_word().clone(),
                Some("S") => state.speed().clone(),
                Some("T") => state.selected().clone(),
                Some("H") => state.h().clone(),
                Some("D") => state.d().clone(),
                _ => D::unknown(),
            },
            V::Feed => state.feed_word().clone(),
            V::Speed => state.speed().clone(),
            V::IsMetric => flag(state.units(self.model).map(|u| u == Units::Mm)),
            V::IsInch => flag(state.units(self.model).map(|u| u == Units::Inch)),
            V::IsAbsolute => flag(state.is_incremental(self.model).map(|i| !i)),
            V::IsIncremental => flag(state.is_incremental(self.model)),
            V::IsInverseTime => flag(state.feed_mode(self.model).map(|m| m == FeedMode::InverseTime)),
            V::IsPerMinute => flag(state.feed_mode(self.model).map(|m| m == FeedMode::PerMinute)),
            V::IsPerRevolution => flag(state.feed_mode(self.model).map(|m| m == FeedMode::PerRevolution)),
            V::SpindleOn => flag(state.spindle().map(|s| s != Spindle::Stopped)),
            V::SpindleClockwise => flag(state.spindle().map(|s| s == Spindle::Clockwise)),
            V::MistOn => truth::<D>(state.coolant.mist),
            V::FloodOn => truth::<D>(state.coolant.flood),
            V::CompensationOn => {
                let mode = state.mode(Role::Compensation).only();
                flag(mode.map(|_| self.compensates(state)))
            }
            V::CodeActive => {
                let number = variable.of.as_deref().and_then(CodeNumber::parse);
                let code = number.map(|n| self.model.control().code_ix(n));
                let mode = code.and_then(|code| Some((code, self.model.role(code)?)));
                match mode.map(|(code, role)| (code, state.mode(role).only())) {
                    Some((code, Some(active))) => flag(Some(code == active)),
                    _ => D::unknown(),
                }
            }
            V::FeedOverrideOn => truth::<D>(state.feed.overridable),
            V::SpeedOverrideOn => truth::<D>(state.spindle.overridable),
            V::AdaptiveFeedOn => truth::<D>(state.feed.adaptive),
            V::FeedStopOn => truth::<D>(state.feed.hold),
            V::LengthOffsetOn => {
                let length = state.tool.length.values();
                flag(length.iter().all(|l| !l.is_nan()).then(|| length.iter().any(|l| *l != 0.0)))
            }
            V::CallLevel => D::number(f64::from(u32::try_from(state.calls.depth()).unwrap_or(1) - 1)),
            _ => return None,
        })
    }

    /// The value of a variable that holds something of the program or the control: a line, a level of calls, a constant.
    fn program_held(&mut self, variable: &SystemVariable) -> D::Value {
        use SystemValue as V;
        match variable.holds {
            V::LineNumber => self.file(self.origin.at.file).map_or_else(D::unknown, |file| {
                D::number(f64::from(file.loaded.line_number(self.origin.start)))
            }),
            V::Constant => {
                variable.of.as_deref().and_then(|of| of.parse().ok()).map_or_else(D::unknown, D::number)
            }
            V::Alarm | V::StopWithMessage => match self.model.semantics().unset {
                Unset::Vacant => D::vacant(),
                Unset::Zero => D::number(0.0),
            },
            // All but the first were answered before.
            V::Unknown
            | V::WorkPosition
            | V::EndPosition
            | V::MachinePosition
            | V::ProbePosition
            | V::ProbeResult
            | V::LengthOffset
            | V::WorkOffset
            | V::WorkRotation
            | V::Shift
            | V::LocalShift
            | V::ShiftActive
            | V::WorkOffsetNumber
            | V::Reference1
            | V::Reference2
            | V::ToolNumber
            | V::SelectedTool
            | V::ToolLength
            | V::ToolDiameter
            | V::ToolRadius
            | V::ToolLengthWear
            | V::ToolDiameterWear
            | V::ModalCode
            | V::LastWord
            | V::Feed
            | V::Speed
            | V::IsMetric
            | V::IsInch
            | V::IsAbsolute
            | V::IsIncremental
            | V::IsInverseTime
            | V::IsPerMinute
            | V::IsPerRevolution
            | V::SpindleOn
            | V::SpindleClockwise
            | V::MistOn
            | V::FloodOn
            | V::CompensationOn
            | V::CodeActive
            | V::FeedOverrideOn
            | V::SpeedOverrideOn
            | V::AdaptiveFeedOn
            | V::FeedStopOn
            | V::LengthOffsetOn
            | V::CallLevel => D::unknown(),
        }
    }

    fn in_program_units(&self, axis: Axis, value: f64, state: &State<D>) -> f64 {
        // The interpreter shows radii in diameter mode too.
        let diameter =
            axis == Axis::X && state.is_diameter(self.model) == Some(true) && !self.refuses_incomplete();
        let value = if diameter { value * 2.0 } else { value };
        if axis.is_rotary() { value } else { value / self.unit(state) }
    }

    /// Tables may count in the machine's own units.
    fn in_table_units(&self, axis: Axis, value: f64, state: &State<D>) -> f64 {
        if axis.is_rotary() {
            return value;
        }
        match self.machine.table_units {
            Some(units) => value / units.in_mm(),
            None => value / self.unit(state),
        }
    }

    fn work_code(&self, number: u16) -> D::Value {
        let code = self.model.control().codes().find(|code| code.effect() == Effect::WorkOffset(number));
        code.map_or_else(D::unknown, |code| D::number(f64::from(code.number().tenths())))
    }

    /// The code in effect of a modal group: ten times its number for named parameters, its number else.
    fn modal_code(&self, variable: &SystemVariable, state: &State<D>) -> D::Value {
        let Some(group) = variable.of.as_deref().and_then(|of| self.model.control().group_by_id(of)) else {
            return D::unknown();
        };
        let role = Role::ALL.into_iter().find(|role| {
            self.model
                .control()
                .codes()
                .any(|code| code.group_ix() == group && Role::of(code.effect()) == Some(*role))
        });
        let cycle = state.active_cycle(self.model);
        let code = match role {
            // A cycle stands in for the motion where they are one group.
            Some(Role::Motion) if cycle.is_some_and(gcheck_controls::CodeIx::is_some) => cycle,
            Some(role) => state.mode(role).only(),
            None => None,
        };
        let tenths = variable.name.is_some();
        match code.map(|ix| self.model.control().code_at(ix)) {
            Some(Some(code)) => {
                let number: CodeNumber = code.number();
                let value = f64::from(number.tenths());
                // The interpreter drops the decimal of `G41.1` and `G42.1` (observed).
                let value =
                    if role == Some(Role::Compensation) { (value / 10.0).floor() * 10.0 } else { value };
                D::number(if tenths { value } else { value / 10.0 })
            }
            // No motion mode is what the code says that ends them.
            Some(None) if tenths => {
                let cancel = self.model.control().code_at(self.model.cycle_cancel);
                cancel.map_or_else(D::unknown, |code| D::number(f64::from(code.number().tenths())))
            }
            _ => D::unknown(),
        }
    }

    /// Writes a system variable. An alarm ends the program.
    pub(crate) fn write_system(
        &mut self,
        number: u32,
        variable: &SystemVariable,
        row: u32,
        column: u32,
        value: D::Value,
        state: &mut State<D>,
    ) -> Step<Option<Outcome<D>>> {
        let axis = axis_of(variable, column);
        let known = D::known(&value);
        match variable.holds {
            SystemValue::Alarm => {
                self.flush_compensation(state)?;
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "alarm numbers are small; the cast saturates"
                )]
                let alarm = known.unwrap_or(0.0) as i64;
                return Ok(Some(Outcome::End(Ending::Alarm(alarm))));
            }
            SystemValue::StopWithMessage => {
                let text = self.stop_text();
                self.emit(state, Event::Stop(Stop::Message(text)));
            }
            _ if !self.model.control().is_writable(number) => return Err(Fault::ReadOnlyVariable(number)),
            SystemValue::WorkOffset | SystemValue::WorkRotation => {
                let first = variable.of.as_deref().and_then(|of| of.parse::<u32>().ok()).unwrap_or(1);
                let system = (first + row) as u16;
                let mut offset = state.tables().offset(system);
                let value = known.unwrap_or(f64::NAN);
                match (variable.holds, axis) {
                    (SystemValue::WorkRotation, _) => offset.rotation = value,
                    (_, Some(axis)) => offset.origin.set(axis, self.millimetres_of_table(axis, value, state)),
                    _ => {}
                }
                // Written, but in effect only when the system is chosen again; elsewhere at once.
                if state.work() == Some(system) && !self.refuses_incomplete() {
                    state.offsets.in_effect = offset;
                    state.points.actual = Position::UNKNOWN;
                    state.points.position = Position::UNKNOWN;
                }
                state.offsets.tables_mut().set_offset(system, offset);
                if state.work() == Some(system) && !self.refuses_incomplete() {
                    self.announce_offset(state);
                }
            }
            SystemValue::Reference1 | SystemValue::Reference2 => {
                if let Some(axis) = axis {
                    let value = self.millimetres_of_table(axis, known.unwrap_or(f64::NAN), state);
                    let index = usize::from(variable.holds == SystemValue::Reference2);
                    if let Some(slot) = state.offsets.tables_mut().references.get_mut(index) {
                        slot.set(axis, value);
                    }
                }
            }
            SystemValue::ToolLength
            | SystemValue::ToolDiameter
            | SystemValue::ToolRadius
            | SystemValue::ToolLengthWear
            | SystemValue::ToolDiameterWear => {
                self.write_tool_value(number, variable, column, known.unwrap_or(f64::NAN), state)?;
            }
            SystemValue::Shift => {
                if let Some(axis) = axis {
                    let value = self.millimetres_of_table(axis, known.unwrap_or(f64::NAN), state);
                    state.offsets.shift.set(axis, value);
                }
            }
            SystemValue::LocalShift => {
                if let Some(axis) = axis {
                    let value = self.millimetres_of_table(axis, known.unwrap_or(f64::NAN), state);
                    self.set_local_shift(axis, value, state);
                }
            }
            _ => self.write_plain(number, value, state),
        }
        Ok(None)
    }

    /// Writes a tool's length or size, or the wear of one.
    fn write_tool_value(
        &mut self,
        number: u32,
        variable: &SystemVariable,
        column: u32,
        value: f64,
        state: &mut State<D>,
    ) -> Step {
        let Some(first) = &variable.of else { return Err(Fault::ReadOnlyVariable(number)) };
        let tool = first.parse::<u32>().unwrap_or(1) + column;
        let value = self.millimetres_of_table(Axis::Z, value, state);
        let entry = state.offsets.tables_mut().tool_mut(tool);
        match variable.holds {
            SystemValue::ToolLength => {
                entry.offset.set(Axis::Z, value);
                for axis in [Axis::X, Axis::Y] {
                    if entry.offset.raw(axis).is_nan() {
                        entry.offset.set(axis, 0.0);
                    }
                }
            }
            SystemValue::ToolDiameter => entry.diameter = gcheck_geometry::Mm(value),
            SystemValue::ToolLengthWear => entry.wear[0] = value,
            SystemValue::ToolDiameterWear => entry.wear[1] = value,
            _ => entry.diameter = gcheck_geometry::Mm(value * 2.0),
        }
        Ok(())
    }

    pub(crate) fn millimetres_of_table(&self, axis: Axis, value: f64, state: &State<D>) -> f64 {
        if axis.is_rotary() {
            return value;
        }
        value * self.machine.table_units.map_or_else(|| self.unit(state), Units::in_mm)
    }
}

/// The axis of a variable in a row by axis.
fn axis_of(variable: &SystemVariable, column: u32) -> Option<Axis> {
    match &variable.of {
        Some(axes) if !axes.is_empty() && axes.chars().all(|c| "XYZABCUVW".contains(c)) => {
            axes.chars().nth(column as usize).and_then(|c| Axis::of(Letter::of(c)))
        }
        _ => Axis::ALL.get(column as usize).copied(),
    }
}

/// A measured number, unless nobody knows it.
fn measured<D: Domain>(value: f64) -> D::Value {
    if value.is_nan() { D::unknown() } else { D::number(value) }
}

/// 1 for yes and 0 for no.
fn truth<D: Domain>(truth: Truth) -> D::Value {
    match truth {
        Truth::True => D::number(1.0),
        Truth::False => D::number(0.0),
        Truth::Unknown => D::unknown(),
    }
}
