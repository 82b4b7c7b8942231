//! What a configuration says for the execution of programs.
//!
//! Knows: the shape of these facts. Must not know: how they are checked, how layers are put together.

use std::path::PathBuf;

use super::file::{MachineTable, ToolTable, Units};

/// What a layer, or an override in it, says for the execution of programs. Lengths are in its own units.
#[derive(Debug, Clone, Default)]
pub struct ExecutionFacts {
    /// Units of its lengths; those in force when it says none.
    pub units: Option<Units>,
    /// It is a preset: its units are those of its own lengths, and say nothing of the machine at power-on.
    pub is_preset: bool,
    /// The machine.
    pub machine: MachineTable,
    /// Macro variables and named parameters, as written: `#3100`, `#<name>`.
    pub variables: Vec<(String, f64)>,
    /// Work offsets as written (`G54`, `G154 P1`), by axis.
    pub offsets: Vec<(String, Vec<(String, f64)>)>,
    /// Tools by number.
    pub tools: Vec<(u32, ToolTable)>,
    /// A tool table on disk.
    pub table: Option<PathBuf>,
}
