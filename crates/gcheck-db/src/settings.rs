//! What is in force for a document.
//!
//! Knows: control, machine, rules, other programs. Must not know: where they come from.

use std::fmt;
use std::sync::Arc;

use gcheck_controls::{Control, UnsupportedDialect};
use gcheck_lint::{ControlBasis, Execution, MachineFacts, NoPrograms, Programs, RuleTable, Selection};

/// Programs that calls may bring in, as several threads ask for them.
pub type SharedPrograms = Arc<dyn Programs + Send + Sync>;

/// What is in force for a document.
#[derive(Clone)]
pub struct Settings {
    /// The control.
    pub control: Arc<Control>,
    /// Why the document is taken to be for this control.
    pub control_basis: ControlBasis,
    /// The dialect, where no control here reads it and the user did not choose one.
    pub unsupported: Option<&'static UnsupportedDialect>,
    /// The user's machine.
    pub machine: Arc<MachineFacts>,
    /// The rules that run.
    pub selection: Arc<Selection>,
    /// Whether comments may silence rules.
    pub suppressions: bool,
    /// How paths are analysed.
    pub execution: Execution,
    /// Other programs. When what they hold changes, the settings are set again.
    pub programs: SharedPrograms,
}

impl Settings {
    /// A control, the recommended rules of a table, and nothing else configured.
    pub fn new(control: Arc<Control>, rules: RuleTable) -> Self {
        Self {
            control,
            control_basis: ControlBasis::Chosen,
            unsupported: None,
            machine: Arc::default(),
            selection: Arc::new(Selection::recommended(rules)),
            suppressions: true,
            execution: Execution::default(),
            programs: Arc::new(NoPrograms),
        }
    }
}

impl fmt::Debug for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Settings").field("control", &self.control.name()).finish_non_exhaustive()
    }
}
