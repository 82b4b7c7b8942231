//! What output takes of a run: one step after the other.
//!
//! Knows: nothing but the step. Must not know: where steps come from, formats.

use std::io;

use gcheck_engine::{Concrete, Fault, Origin, State};
use gcheck_toolpath::Step;

/// Takes the steps of a run.
pub(crate) trait Steps {
    /// As the reference interpreter has it: sequence numbers are those of the block being executed, which under cutter
    /// compensation may be later than the block that a move belongs to, and an optional stop is one whatever the switch says.
    const AS_INTERPRETED: bool = false;

    /// A block is about to be executed in this state.
    fn block(&mut self, origin: Origin, state: &State<Concrete>) {
        let _ = (origin, state);
    }

    /// One event.
    fn step(&mut self, step: &Step<'_>) -> io::Result<()>;

    /// The control would stop at this line; the run goes on.
    fn alarm(&mut self, file: &str, line: u32, fault: &Fault) -> io::Result<()> {
        let _ = (file, line, fault);
        Ok(())
    }

    /// From this line on moves rest on something that nobody knows.
    fn assumed(&mut self, file: &str, line: u32, words: &str) {
        let _ = (file, line, words);
    }
}
