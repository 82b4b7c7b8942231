//! What is in force for a document.
//!
//! Knows: control, machine, rules, other programs. Must not know: where they come from.

use std::fmt;
use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_rules::{Execution, MachineFacts, NoPrograms, Programs, Selection};

/// Programs that calls may bring in, as several threads ask for them.
pub type SharedPrograms = Arc<dyn Programs + Send + Sync>;

/// What is in force for a document.
#[derive(Clone)]
pub struct Settings {
    /// The control.
    pub control: Arc<Control>,
    /// Nobody chose the control: it was guessed from the program, or is the default.
    pub control_is_guessed: bool,
    /// The user's machine.
    pub machine: Arc<MachineFacts>,
    /// The rules that run.
    pub selection: Arc<Selection>,
    /// Whether comments may silence rules.
    pub suppressions: bool,
    /// How paths are analysed.
    pub execution: Execution,
    /// Other programs. Who changes what they hold sets the settings again.
    pub programs: SharedPrograms,
}

impl Settings {
    /// A control, and nothing else told.
    pub fn new(control: Arc<Control>) -> Self {
        Self {
            control,
            control_is_guessed: false,
            machine: Arc::default(),
            selection: Arc::default(),
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
