//! Cylindrical mapping: a linear axis wrapped around a cylinder on a rotary axis.
//!
//! Knows: the words that begin and end it, which diameter counts, what moves of the axes themselves do to the drawing. Must not
//! know: the angle of a point ([`crate::Cylinder`]).

use gcheck_controls::{CodeIx, CylinderRules, Letter, LetterSet};

use crate::assumption::Assumption;
use crate::cylinder::Cylinder;
use crate::eval::value::{Domain, Truth};
use crate::event::{Event, Units};
use crate::exec::context::{Executor, Step};
use crate::fault::Fault;
use crate::lattice::Perhaps;
use crate::model::Role;
use crate::observer::Observer;
use crate::position::{Axis, Position};
use crate::state::{ModeSet, State};

/// Angles closer than this are one, degrees.
const SAME_ANGLE: f64 = 1e-6;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Mapping on, off, or a new default diameter.
    pub(in crate::exec) fn cylinder(&mut self, ix: CodeIx, state: &mut State<D>) -> Step {
        let Some(rules) = &self.model.semantics().cylinder else {
            self.cylinder_by_radius(ix, state);
            return Ok(());
        };
        let code = self.model.control().code_at(ix);
        let reads = code.map_or(LetterSet::EMPTY, gcheck_controls::Code::reads);
        let given = |axes: &[Axis], reads: LetterSet| -> Vec<Axis> {
            let is_given = |letter: Letter| reads.contains(letter) && self.words.has(letter);
            axes.iter().copied().filter(|axis| is_given(axis.letter())).collect()
        };
        let linear = given(&[Axis::X, Axis::Y, Axis::Z], reads);
        let mut rotary = given(&[Axis::A, Axis::B, Axis::C], reads);
        if rotary.is_empty() {
            // Some manuals of the control list another axis: nothing speaks for a stop there.
            let disputed = code.map_or(LetterSet::EMPTY, gcheck_controls::Code::disputed);
            rotary = given(&[Axis::A, Axis::B, Axis::C], disputed);
            self.assumptions.extend(rotary.iter().map(|axis| Assumption::CylinderCarrier(*axis)));
        }
        let (q, r) = (self.length(Letter::of('Q'), state), self.length(Letter::of('R'), state));
        let [two_linear, two_rotary] = [&linear, &rotary].map(|axes| axes.len() > 1);
        let two_sizes = q.is_some() && r.is_some();
        if self.may_be_vacant(&linear)
            || two_rotary && self.may_be_vacant(&rotary)
            || two_sizes && (q.is_some_and(f64::is_nan) || r.is_some_and(f64::is_nan))
        {
            // Words that may be nothing may begin nothing, and may leave one of two.
            state.mapping.diameters.forget();
            state.mapping.wrapped = Perhaps::Unknown;
            state.modes.add(Role::Cylinder, &ModeSet::one(ix));
            self.emit(state, Event::Modal(ix));
            return Ok(());
        }
        if two_linear || two_rotary || two_sizes {
            return Err(Fault::Conflict);
        }
        // What compensation holds back was drawn before.
        self.flush_compensation(state)?;
        let size = q.or(r.map(|radius| 2.0 * radius));
        let Some(rotary) = rotary.first().copied() else {
            if !linear.is_empty() || size.is_some() {
                return Err(Fault::MissingWord(Letter::of('A')));
            }
            self.unwrap_axis(state);
            return Ok(());
        };
        if let Some(axes) = &self.machine.axes
            && !axes.contains(&rotary)
        {
            return Err(Fault::NoSuchAxis(rotary.letter()));
        }
        if let Some(size) = size {
            // A size below zero means nothing; rules of words speak of it.
            state.mapping.diameters.set(rotary, if size >= 0.0 { size } else { f64::NAN });
        }
        let Some(linear) = linear.first().copied() else { return Ok(()) };
        let diameter = self.diameter_of(rotary, rules, state);
        // The same axis on another cylinder goes on with its drawing.
        if state.cylinder().is_none_or(|cylinder| cylinder.linear != linear) {
            self.unwrap_axis(state);
        }
        let stands = state.mapping.unwrapped(*state.actual()).raw(linear);
        let mut cylinder = Cylinder { linear, rotary, diameter, stands, zero: f64::NAN };
        cylinder.anchor(state.actual());
        if cylinder.zero.abs() > SAME_ANGLE {
            self.assumptions.insert(Assumption::CylinderStart(rotary));
        }
        state.mapping.wrapped = Perhaps::Yes(cylinder);
        state.set_mode(Role::Cylinder, ix);
        self.emit(state, Event::Modal(ix));
        self.emit(state, Event::Cylinder(Some(cylinder)));
        Ok(())
    }

    /// May a word for one of the axes be left out, because its value may be nothing?
    fn may_be_vacant(&self, axes: &[Axis]) -> bool {
        let doubtful = |value: D::Value| D::is_vacant(&value) == Truth::Unknown;
        axes.iter().any(|axis| self.words.get(axis.letter()).is_some_and(doubtful))
    }

    /// The diameter in effect for a rotary axis: the last one that is not zero, else that of the control's setting.
    fn diameter_of(&mut self, rotary: Axis, rules: &CylinderRules, state: &State<D>) -> f64 {
        let last = state.diameters().of(rotary);
        if let Some(diameter) = last.filter(|diameter| *diameter != 0.0) {
            return diameter;
        }
        if last.is_none() {
            self.assumptions.insert(Assumption::CylinderDiameter(rotary));
        }
        let Some(number) = self.machine.cylinder_setting(rotary, rules) else { return f64::NAN };
        let unit = self.machine.units.map_or_else(|| self.unit(state), Units::in_mm);
        let diameter = self.setting(number).and_then(|value| value.parse::<f64>().ok());
        diameter.map_or(f64::NAN, |diameter| diameter * unit)
    }

    /// Ends mapping: the linear axis is where it stood all along.
    fn unwrap_axis(&mut self, state: &mut State<D>) {
        if !state.wrapped().is_no() {
            state.points.actual = state.mapping.unwrapped(*state.actual());
            state.mapping.wrapped = Perhaps::No;
            state.points.position = self.programmed_of(state.actual(), state);
            self.emit(state, Event::Cylinder(None));
        }
        if state.mode(Role::Cylinder).only() != Some(CodeIx::NONE) {
            state.set_mode(Role::Cylinder, CodeIx::NONE);
        }
    }

    /// The end of the program ends mapping where a setting says so.
    pub(in crate::exec) fn unwrap_at_end(&mut self, state: &mut State<D>) {
        if state.wrapped().is_no() {
            return;
        }
        let rules = self.model.semantics().cylinder.as_ref();
        if let Some(number) = rules.and_then(|rules| rules.ended_by_setting.as_deref())
            && self.setting(number) == Some("on")
        {
            self.unwrap_axis(state);
        }
    }

    /// The code with the radius in the rotary axis' word; 0 ends it. Its path is not followed.
    fn cylinder_by_radius(&mut self, ix: CodeIx, state: &mut State<D>) {
        let rotary = [Axis::A, Axis::B, Axis::C];
        let radius = rotary.iter().find_map(|axis| self.words.number(axis.letter()));
        let on = radius.is_some_and(|radius| radius != 0.0);
        state.set_mode(Role::Cylinder, if on { ix } else { CodeIx::NONE });
        // A radius that is not known may be zero, and one that may be nothing leaves that of the next word.
        if radius.is_some_and(f64::is_nan) || self.may_be_vacant(&rotary) {
            state.modes.add(Role::Cylinder, &ModeSet::one(ix));
            state.modes.add(Role::Cylinder, &ModeSet::one(CodeIx::NONE));
            self.emit(state, Event::Modal(ix));
            self.unknown_frame(ix, true, state);
            return;
        }
        self.emit(state, Event::Modal(ix));
        self.unknown_frame(ix, on, state);
    }

    // ---- moves of the axes themselves ----

    /// A word for the rotary axis turns the part, and the drawing with it.
    pub(in crate::exec) fn turn_drawing(&mut self, state: &mut State<D>) {
        let Some(cylinder) = state.cylinder() else { return };
        let letters: LetterSet =
            self.model.letters_of(cylinder.rotary).filter(|letter| self.words.has(*letter)).collect();
        if letters.is_empty() {
            return;
        }
        let (rotary, linear) = (cylinder.rotary, cylinder.linear);
        let moves_both = self.model.letters_of(linear).any(|letter| self.words.has(letter));
        let mut at = *state.actual();
        at.set(rotary, f64::NAN);
        // Which of two words counts first nobody says, and moves that compensation holds back are of the drawing before.
        if !moves_both && !state.compensation.is_followed() {
            for letter in letters.iter() {
                let (Some(value), Some((_, increment))) =
                    (self.words.number(letter), self.model.axis_of(letter))
                else {
                    continue;
                };
                let from = state.actual().raw(rotary);
                let angle = match (increment, state.is_incremental(self.model)) {
                    (true, _) | (false, Some(true)) => from + value,
                    (false, Some(false)) => value,
                    (false, None) => f64::NAN,
                };
                at.set(rotary, angle);
            }
        }
        self.assumptions.insert(Assumption::CylinderStart(rotary));
        if let Some(cylinder) = state.mapping.wrapped.yes_mut() {
            cylinder.anchor(&at);
        }
    }

    /// Axes moved by themselves, not along the drawing: to a reference position, in machine coordinates.
    pub(in crate::exec) fn moved_off_drawing(
        &self,
        named: LetterSet,
        to: &mut Position,
        state: &mut State<D>,
    ) {
        let moves = |axis: Axis| {
            named.iter().filter_map(|letter| self.model.axis_of(letter)).any(|(moved, _)| moved == axis)
        };
        let Some(cylinder) = state.mapping.wrapped.yes_mut() else { return };
        if moves(cylinder.linear) {
            cylinder.stands = to.raw(cylinder.linear);
            to.set(cylinder.linear, f64::NAN);
        }
        if moves(cylinder.linear) || moves(cylinder.rotary) {
            cylinder.anchor(to);
        }
    }
}
