//! What the command line asks of an import.
//!
//! Knows: format, units, control. Must not know: how a file is read.

use crate::args::ImportFormat;
use crate::config::Units;

/// How files are read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Request<'r> {
    pub(crate) format: Option<ImportFormat>,
    pub(crate) units: Option<Units>,
    /// The control that the command line names.
    pub(crate) control: Option<&'r str>,
    /// Configurations that count when a program is executed, as `--config` takes them.
    pub(crate) config: &'r [String],
    /// One of them is a file, in place of what is found beside the program.
    pub(crate) has_file: bool,
}
