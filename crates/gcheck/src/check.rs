//! `gcheck check`: once, or again whenever something changes.
//!
//! Knows: that a check is rounds. Must not know: what a round does.

mod cache;
mod fixed;
mod job;
mod known;
mod next_steps;
mod round;
mod settings_page;
mod watch;

use crate::args::{CheckOptions, Global};
use crate::console::say;
use crate::{Problem, discovery, paths};
use round::{Check, Looked};

/// Are these bytes what the cache stores, without its heading and check sum?
pub(crate) fn is_stored_result(bytes: &[u8]) -> bool {
    cache::Entry::decode(bytes).and_then(|entry| entry.verdict()).is_some()
}

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &CheckOptions) -> Result<u8, Problem> {
    let listed;
    let options = match &options.files_from {
        Some(list) => {
            listed = CheckOptions { paths: discovery::listed(list)?, ..options.clone() };
            // A change that touches no program is right, and still worth a word.
            if listed.paths.is_empty() && !global.quiet {
                say(&format!("{}: lists no files, so that nothing is checked", paths::shown(list)));
            }
            &listed
        }
        None => options,
    };
    let command = Check::new(global, options)?;
    if options.watch { watch::run(&command) } else { command.round(&mut Looked::default()) }
}
