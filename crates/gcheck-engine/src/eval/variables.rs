//! Variables by number and by name: reading and writing them.
//!
//! Knows: local and common variables, names, settings that variables show, what may be written. Must not know: what system
//! variables hold (`system`).

use gcheck_controls::{Access, SystemValue, Unset};
use gcheck_program::{BlockTable, Place, Target};

use crate::assumption::{Assumption, Unsettled};
use crate::eval::value::{Domain, Truth};
use crate::exec::context::{Assignee, Executor, Outcome, Step};
use crate::fault::Fault;
use crate::lattice::Lattice;
use crate::machine::Machine;
use crate::observer::Observer;
use crate::state::{NameId, State, Variable};

impl<'a, D: Domain, O: Observer<D>> Executor<'a, '_, D, O> {
    pub(crate) fn read_variable(&mut self, number: u32, state: &State<D>) -> Step<D::Value> {
        let semantics = self.model.semantics();
        let number = semantics.kept_as(number);
        self.check_number(number)?;
        let [first, last] = semantics.locals;
        if (first..=last).contains(&number) && number > 0 {
            let value = state
                .calls
                .locals()
                .and_then(|locals| locals.get(number))
                .cloned()
                .unwrap_or_else(D::unknown);
            self.tell_vacant(number, &value, state);
            return Ok(value);
        }
        if number == 0 && semantics.unset == Unset::Vacant {
            return Ok(D::vacant());
        }
        let system = self.model.system_variable(number);
        // A probing move writes its result over what the program wrote, and a clock goes on from it.
        let is_probed = system.is_some_and(|(variable, _, _)| {
            matches!(
                variable.holds,
                SystemValue::ProbePosition | SystemValue::ProbeResult | SystemValue::Unknown
            )
        });
        let written = if is_probed { Truth::False } else { state.variables.written(number) };
        if written == Truth::True {
            let value = state.variables.get(number);
            self.tell_vacant(number, &value, state);
            return Ok(value);
        }
        if let Some((variable, row, column)) = system {
            let mut value = self.read_system(variable, row, column, state)?;
            if variable.holds == SystemValue::Unknown
                && let Some(guess) = self.machine.guesses.variables.get(&number)
            {
                value = D::assumed(D::number(*guess));
            }
            // The program may have written over it.
            return Ok(if written == Truth::Unknown {
                value.join(&state.variables.get(number))
            } else {
                value
            });
        }
        if let Some(value) = self.setting_of_variable(number) {
            return Ok(D::number(value));
        }
        let value = state.variables.get(number);
        // A condition that asks whether it is set makes the reading a decision.
        if !state.variables.is_narrowed(number) {
            self.tell_vacant(number, &value, state);
        }
        Ok(value)
    }

    /// Variables that a strict control has.
    pub(crate) fn check_number(&self, number: u32) -> Step {
        match self.model.semantics().refusals.last_variable {
            Some(last) if !(1..=last).contains(&number) => Err(Fault::VariableNumber),
            _ => Ok(()),
        }
    }

    pub(crate) fn tell_vacant(&mut self, number: u32, value: &D::Value, state: &State<D>) {
        let is_vacant = self.model.semantics().unset == Unset::Vacant && D::is_vacant(value) == Truth::True;
        if is_vacant && !self.looks_ahead {
            self.observer.vacant_read(self.origin, state, number);
        }
    }

    pub(crate) fn read_indirect(&mut self, number: &D::Value, state: &State<D>) -> Step<D::Value> {
        match D::known(number) {
            Some(number) => self.read_variable(variable_number(number)?, state),
            None if D::is_vacant(number) == Truth::True => self.read_variable(0, state),
            None => Ok(D::unknown()),
        }
    }

    pub(crate) fn read_name(&mut self, name: NameId, state: &State<D>) -> Step<D::Value> {
        let local = state.calls.own_locals().and_then(|locals| locals.named(name));
        let Some(Variable { value, written }) = local.or_else(|| state.variables.named(name)) else {
            return self.read_unset_name(name, state);
        };
        if written == Truth::True {
            return Ok(value);
        }
        self.assumptions.insert(Assumption::Unsettled(Unsettled::Parameter));
        // On a path that did not set it, the control's own counts, or the path ends here.
        Ok(self.read_unset_name(name, state).map_or(value.clone(), |own| own.join(&value)))
    }

    /// Does reading a parameter give a value? `None` where nobody knows.
    pub(crate) fn has_name(&mut self, name: NameId, state: &State<D>) -> Option<bool> {
        let text = self.program.name_text(name);
        let is_of_machine = ["_ini[", "_hal["].iter().any(|head| text.starts_with(head));
        if is_of_machine && !self.machine.parameters.contains_key(&*text) {
            // The machine may have it.
            return None;
        }
        let local = state.calls.own_locals().and_then(|locals| locals.named(name));
        let set = local.or_else(|| state.variables.named(name));
        match set.map_or(Truth::False, |variable| variable.written) {
            Truth::True => Some(true),
            Truth::False => Some(self.read_unset_name(name, state).is_ok()),
            Truth::Unknown => self.read_unset_name(name, state).is_ok().then_some(true),
        }
    }

    /// A parameter that the program has not set.
    pub(crate) fn read_unset_name(&mut self, name: NameId, state: &State<D>) -> Step<D::Value> {
        let text = self.program.name_text(name);
        if let Some(variable) = self.model.named_variable(&text) {
            return self.read_system(variable, 0, 0, state);
        }
        // `#<_ini[section]name>`, `#<_hal[pin]>`: without its bracket a name like others.
        let of_settings = text.strip_prefix("_ini[").is_some_and(|rest| rest.contains(']'));
        if of_settings || text.strip_prefix("_hal[").is_some_and(|rest| rest.ends_with(']')) {
            return Ok(D::unknown());
        }
        if let Some(value) = self.machine.parameters.get(&*text) {
            return Ok(D::number(*value));
        }
        if self.model.control().named_parameter(&text).is_some() {
            // The control has it; what it holds is not followed. A fresh control has nothing in it.
            return Ok(if self.machine.fresh { D::number(0.0) } else { D::unknown() });
        }
        Err(Fault::UnsetParameter)
    }

    pub(crate) fn name(&self, place: &Place, range: (u32, u32)) -> NameId {
        let file = self.origin.at.file;
        match &self.cursor {
            Some(cursor) => {
                self.program.name_at(file, place.chunk, range, cursor.file.loaded.chunk_text(place.chunk))
            }
            None => self.program.name(""),
        }
    }

    /// `#<a>=1 G0 X#<a>`: an assignment brings its name into being, with zero, as soon as it is read; its value comes after the
    /// block (observed).
    pub(crate) fn create(&mut self, target: Assignee, start: u32, state: &mut State<D>) {
        let Assignee::Name(name) = target else { return };
        if self.has_name(name, state) == Some(false) && self.check_assignable(target).is_ok() {
            self.created.push((name, start));
            self.set_name(name, D::number(0.0), state);
        }
    }

    pub(crate) fn set_name(&self, name: NameId, value: D::Value, state: &mut State<D>) {
        let is_global = self.program.name_text(name).starts_with('_');
        match state.calls.own_locals_mut() {
            Some(locals) if !is_global => locals.set_named(name, value),
            _ => state.variables.set_named(name, value),
        }
    }

    pub(crate) fn assignee(
        &mut self,
        place: &Place,
        table: &BlockTable,
        target: &Target,
        state: &State<D>,
    ) -> Step<Assignee> {
        Ok(match target {
            Target::Variable(number) => Assignee::Number(*number),
            Target::Named(range) => Assignee::Name(self.name(place, (range.start, range.end))),
            Target::Computed(expr) => {
                let value = self.evaluate(place, table, table.expr(*expr), state)?;
                match D::known(&value) {
                    Some(number) => Assignee::Number(variable_number(number)?),
                    None => Assignee::Anywhere,
                }
            }
            Target::Invalid => return Err(Fault::Malformed),
        })
    }

    /// May the program write it? Asked before the block acts.
    pub(crate) fn check_assignable(&mut self, target: Assignee) -> Step {
        match target {
            Assignee::Name(name) => {
                let text = self.program.name_text(name);
                let listed = self.model.control().named_parameter(&text);
                let is_read_only = listed.is_some_and(|entry| entry.access == Access::Read);
                if is_read_only || self.model.named_variable(&text).is_some() {
                    Err(Fault::ReadOnlyVariable(0))
                } else {
                    Ok(())
                }
            }
            Assignee::Number(number) => {
                self.check_number(number)?;
                let writable = number != 0 && self.is_writable(number);
                if writable { Ok(()) } else { Err(Fault::ReadOnlyVariable(number)) }
            }
            Assignee::Anywhere => Ok(()),
        }
    }

    /// The value of a setting that a variable shows, where it is told or has a default. A switch is 1 or 0.
    pub(crate) fn setting_of_variable(&self, number: u32) -> Option<f64> {
        let setting = number.checked_sub(self.model.semantics().setting_variables?)?;
        let value = self.machine.setting(self.model.control(), &setting.to_string())?;
        match value {
            "on" | "true" => Some(1.0),
            "off" | "false" => Some(0.0),
            other => other.parse().ok(),
        }
    }

    /// May a program write the variable, as far as is known? Loops ask for the same few many times.
    pub(crate) fn is_writable(&mut self, number: u32) -> bool {
        let control = self.model.control();
        *self.writable.entry(number).or_insert_with(|| control.is_writable(number))
    }

    /// Writes a variable. Some variables end the program.
    pub(crate) fn assign(
        &mut self,
        target: Assignee,
        value: D::Value,
        state: &mut State<D>,
    ) -> Step<Option<Outcome<D>>> {
        match target {
            Assignee::Name(name) => {
                self.check_assignable(target)?;
                self.set_name(name, value, state);
                Ok(None)
            }
            Assignee::Anywhere => {
                state.variables.forget();
                state.calls.forget_locals();
                Ok(None)
            }
            Assignee::Number(0) => Err(Fault::ReadOnlyVariable(0)),
            Assignee::Number(number) => {
                let number = self.model.semantics().kept_as(number);
                if let Some((variable, row, column)) = self.model.system_variable(number) {
                    return self.write_system(number, variable, row, column, value, state);
                }
                if !self.is_writable(number) {
                    return Err(Fault::ReadOnlyVariable(number));
                }
                self.write_plain(number, value, state);
                Ok(None)
            }
        }
    }

    pub(crate) fn write_plain(&mut self, number: u32, value: D::Value, state: &mut State<D>) {
        let number = self.model.semantics().kept_as(number);
        let [first, last] = self.model.semantics().locals;
        if (first..=last).contains(&number) {
            match state.calls.locals_mut() {
                Some(locals) => locals.set(number, value),
                // Nobody knows whose variable it is.
                None => state.calls.forget_locals(),
            }
        } else {
            state.variables.set(number, value);
        }
    }

    /// The configured or assumed value of a setting.
    pub(crate) fn setting(&mut self, number: &str) -> Option<&'a str> {
        if !self.machine.settings.contains_key(number) && self.model.control().setting(number).is_some() {
            self.assumptions.insert(Assumption::Setting(number.to_owned()));
        }
        let machine: &'a Machine = self.machine;
        machine.setting(self.model.control(), number)
    }
}

pub(crate) fn variable_number(number: f64) -> Step<u32> {
    let whole = number.round();
    if (whole - number).abs() > 1e-4 || !(0.0..=f64::from(u32::MAX)).contains(&whole) {
        return Err(Fault::VariableNumber);
    }
    #[expect(clippy::cast_sign_loss, reason = "range checked above")]
    Ok(whole as u32)
}
