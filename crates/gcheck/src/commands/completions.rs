//! `gcheck completions SHELL`.
//!
//! Knows: the command line's definition. Must not know: what the commands do.

use clap::CommandFactory as _;
use clap_complete::Shell;

use crate::args::Arguments;
use crate::{Problem, output};

/// Prints the completions of a shell.
pub(crate) fn run(shell: Shell) -> Result<u8, Problem> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "gcheck", &mut text);
    output::print(&String::from_utf8_lossy(&text))
}
