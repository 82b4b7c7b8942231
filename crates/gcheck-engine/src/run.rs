//! A run: one execution from a configured start, with every value known or said to be unknown.
//!
//! Knows: fuel, how a run ends. Must not know: other paths than the one taken.

use std::collections::BTreeSet;

use crate::assumption::Assumption;
use crate::fault::Fault;
use crate::machine::Machine;
use crate::model::Model;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::program::Program;
use crate::start::start_state;
use crate::state::State;
use crate::step::{Ending, Executor, Options, Outcome};
use crate::value::Concrete;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Stopped {
    /// At an end of the program.
    Ended(Ending),
    /// At a block that cannot be executed.
    Faulted(Fault),
    /// After as many blocks as were allowed, or when the observer wanted no more.
    OutOfFuel,
}

/// What a run leaves.
#[derive(Debug)]
pub struct RunResult {
    /// How it ended.
    pub stopped: Stopped,
    /// The last block.
    pub origin: Origin,
    /// The state at the end.
    pub state: State<Concrete>,
    /// Blocks executed.
    pub blocks: u64,
    /// What it rests on.
    pub assumptions: BTreeSet<Assumption>,
}

/// The observer is asked so often, in blocks, whether it wants to see more.
const ASKED_EVERY: u64 = 4096;

/// Executes a program until it ends, faults, has executed `fuel` blocks, or the observer wants no more.
pub fn run<O: Observer<Concrete>>(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    observer: O,
) -> RunResult {
    let mut executor = Executor::new(program, model, machine, options, observer);
    let mut state = start_state::<Concrete>(model, machine, &mut executor.assumptions);
    let mut at = At { file: 0, block: 0 };
    let mut blocks = 0;
    let mut feeds = 0;
    let mut ask_at = ASKED_EVERY;
    let stopped = loop {
        if blocks >= ask_at {
            if executor.observer.stops() {
                break Stopped::OutOfFuel;
            }
            ask_at = blocks + ASKED_EVERY;
        }
        if let Some(moves) = executor.plain_moves(at, &state) {
            while blocks < fuel.min(ask_at) && executor.plain_move(&moves, at, &mut state) {
                blocks += 1;
                at = at.next();
            }
        }
        if blocks >= fuel {
            break Stopped::OutOfFuel;
        }
        blocks += 1;
        match executor.step(at, &mut state) {
            Outcome::Next => at = at.next(),
            Outcome::Jump(to) => at = to,
            Outcome::End(Ending::Restart) if executor.starts_again(&state) && executor.bar_feeds > feeds => {
                feeds = executor.bar_feeds;
                at = At { file: 0, block: 0 };
            }
            Outcome::End(ending) => break Stopped::Ended(ending),
            Outcome::Fork(_) => break Stopped::Faulted(Fault::Undecidable),
            Outcome::Fault(fault) => break Stopped::Faulted(fault),
        }
    };
    let origin = executor.origin();
    if let Stopped::Faulted(fault) = &stopped {
        executor.observer.fault(origin, &state, fault);
    }
    RunResult { stopped, origin, state, blocks, assumptions: executor.assumptions }
}
