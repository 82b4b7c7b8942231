//! From what a configuration says about a program to the control and the machine that it is checked for.
//!
//! Knows: how settings, codes of the shop and the command line come together. Must not know: programs, rules.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use gcheck_controls::{Control, UserCode};
use gcheck_engine::Model;
use gcheck_lint::MachineFacts;

use crate::Problem;
use crate::args::Assignment;
use crate::config::FileSettings;
use crate::execution::{Equipment, Start};

/// A control's name and the codes that a configuration adds to it.
type ControlKey = (String, Vec<UserCode>);

/// Controls with the codes that configurations add to them, each made once.
#[derive(Debug, Default)]
pub(crate) struct Controls {
    made: Mutex<HashMap<ControlKey, Arc<Control>>>,
}

impl Controls {
    /// A control with a shop's own codes.
    pub(crate) fn get(&self, name: &str, codes: &[UserCode]) -> Result<Arc<Control>, Problem> {
        let plain = gcheck_controls::load(name).map_err(|error| Problem::new(error.to_string()))?;
        if codes.is_empty() {
            return Ok(plain);
        }
        let key = (name.to_owned(), codes.to_vec());
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(Arc::clone(made.entry(key).or_insert_with(|| Arc::new(plain.with_user_codes(codes)))))
    }
}

/// The machine that a program is checked for, with variables that the command line sets.
pub(crate) fn machine(
    settings: &FileSettings,
    control: &Control,
    set: &[Assignment],
) -> Result<MachineFacts, Problem> {
    let mut equipment = Equipment::new(settings, &Model::new(control), Start::Any)?;
    equipment.set(set);
    let mut machine = settings.machine.clone();
    machine.units_are_told = !equipment.units_assumed;
    machine.engine = equipment.machine;
    Ok(machine)
}
