//! What surrounds a program that is checked: its control, the user's machine, other programs.
//!
//! Knows: what every rule may ask of the surroundings. Must not know: where they come from, the program itself.

use std::collections::BTreeMap;

use gcheck_controls::{Control, LetterSet, UnsupportedDialect};
use gcheck_diagnostics::Severity;
use gcheck_engine::{Library, SourceFile};
use gcheck_program::Dialect;

/// What the user declared about the machine; everything may be unknown.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MachineFacts {
    /// Axes the machine has.
    pub axes: Option<LetterSet>,
    /// The control's settings by number, values as its page words them.
    pub settings: BTreeMap<String, String>,
    /// The user configured the units of the machine's programs: `engine.units` is more than the control's default.
    pub units_are_told: bool,
    /// Offsets, tools, travel and the rest that executing a program asks for.
    pub engine: gcheck_engine::Machine,
}

/// Programs that are not in the file at hand: other files of its folder and of the search path.
pub trait Programs {
    /// Is there a program of this number?
    fn has_number(&self, number: u32) -> bool;
    /// Is there a subroutine file of this name (lower case)?
    fn has_name(&self, name: &str) -> bool;
    /// The file that holds the program of this number, for execution.
    fn source_of_number(&self, number: u32) -> Option<SourceFile> {
        let _ = number;
        None
    }
    /// The file that holds the subroutine of this name (lower case), for execution.
    fn source_of_name(&self, name: &str) -> Option<SourceFile> {
        let _ = name;
        None
    }
}

/// No other programs.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoPrograms;

impl Programs for NoPrograms {
    fn has_number(&self, _: u32) -> bool {
        false
    }

    fn has_name(&self, _: &str) -> bool {
        false
    }
}

/// Why a program is taken to be for its control.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ControlBasis {
    /// The user chose it.
    Chosen,
    /// The program shows it clearly.
    Shown,
    /// The program shows it weakly, or the programs beside it do, or nothing does.
    Guessed,
}

/// What every rule may ask.
#[derive(Clone, Copy)]
pub struct Environment<'a> {
    /// The control, prepared.
    pub dialect: &'a Dialect<'a>,
    /// The user's machine.
    pub machine: &'a MachineFacts,
    /// Other programs.
    pub programs: &'a dyn Programs,
    /// Why the program is taken to be for this control.
    pub control_basis: ControlBasis,
    /// The dialect, where no control here reads it and the user did not choose one: the end of the file's name may show it,
    /// which rules do not see.
    pub unsupported: Option<&'static UnsupportedDialect>,
}

impl<'a> Environment<'a> {
    /// The control.
    pub fn control(&self) -> &'a Control {
        self.dialect.control()
    }

    /// Did the user choose the control?
    pub fn control_is_chosen(&self) -> bool {
        self.control_basis == ControlBasis::Chosen
    }

    /// Nobody chose the control, and nothing in the program speaks for it: it may be any.
    pub fn control_is_unknown(&self) -> bool {
        !self.control_is_chosen() && self.control().name() == gcheck_controls::fallback()
    }

    /// The most that a finding may be which holds for this control and not for all.
    pub fn most_for_this_control(&self) -> Severity {
        if self.control_is_chosen() { Severity::Error } else { Severity::Warning }
    }

    /// A setting's value: configured, or the default that the knowledge base assumes.
    ///
    /// The second part is the assumption to state, if the user did not configure it.
    pub fn setting(&self, number: &str) -> Option<(&'a str, Option<String>)> {
        if let Some(value) = self.machine.settings.get(number) {
            return Some((value, None));
        }
        let entry = self.control().setting(number)?;
        let default = entry.default.as_deref()?;
        Some((default, Some(format!("setting {number} ({}) is {default}", entry.title))))
    }
}

/// The engine's view of [`Environment::programs`].
pub(crate) struct ProgramLibrary<'a>(pub(crate) &'a dyn Programs);

impl Library for ProgramLibrary<'_> {
    fn by_number(&self, number: u32) -> Option<SourceFile> {
        self.0.source_of_number(number)
    }

    fn by_name(&self, name: &str) -> Option<SourceFile> {
        self.0.source_of_name(name)
    }
}
