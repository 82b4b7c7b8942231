//! A run: one execution from a configured start, with every value known or said to be unknown.
//!
//! Knows: fuel, how a run ends, that it may go on after an alarm. Must not know: other paths than the one taken.

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
use crate::step::past_alarm::choose_way;
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

impl Stopped {
    /// Did the run come to where the program ends by its own words?
    pub const fn is_program_end(&self) -> bool {
        match self {
            Self::Ended(ending) => match ending {
                Ending::Program | Ending::Restart | Ending::Tape | Ending::BarsUsed => true,
                Ending::Text | Ending::Alarm(_) => false,
            },
            Self::Faulted(_) | Self::OutOfFuel => false,
        }
    }
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
    /// Where the control would have stopped, each block once in the order of the run; only [`Options::past_alarms`] leaves any,
    /// and at most [`MOST_ALARMS`].
    pub alarms: Vec<Alarm>,
}

/// A block that cannot be executed, after which the run went on.
#[derive(Debug, Clone, PartialEq)]
pub struct Alarm {
    /// The block.
    pub origin: Origin,
    /// Why.
    pub fault: Fault,
}

/// Alarms that are kept of one run.
pub const MOST_ALARMS: usize = 1_000;

/// The observer is asked so often, in blocks, whether it wants to see more.
const ASKED_EVERY: u64 = 4096;

/// Events that a block may give for nothing: moves, strokes, switches. Each one beyond them costs a run as much fuel as a block:
/// repeats and cycles give very many.
const FREE_EVENTS: u64 = 16;

/// Executes a program until it ends, faults, has executed `fuel` blocks (or given events that cost as much), or the observer
/// wants no more. With [`Options::past_alarms`] a fault does not end it: the observer is told ([`Observer::fault`]), and the run goes on.
pub fn run<O: Observer<Concrete>>(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    observer: O,
) -> RunResult {
    let mut executor = Executor::new(program, model, machine, options, observer);
    executor.lenient = options.past_alarms;
    let mut alarms = Alarms::default();
    let mut undecided = BTreeSet::new();
    let mut state = start_state::<Concrete>(model, machine, &mut executor.assumptions);
    let mut at = At { file: 0, block: 0 };
    let mut blocks = 0;
    let mut surplus = 0;
    let mut feeds = 0;
    let mut ask_at = ASKED_EVERY;
    // What the start rests on belongs to no block.
    executor.assumptions.take_untold();
    let stopped = loop {
        for assumption in executor.assumptions.take_untold() {
            let origin = executor.origin();
            executor.observer.assumed(origin, &assumption);
        }
        if blocks >= ask_at {
            if executor.observer.stops() {
                break Stopped::OutOfFuel;
            }
            ask_at = blocks + ASKED_EVERY;
        }
        if let Some(moves) = executor.plain_moves(at, &state) {
            let most = fuel.saturating_sub(surplus);
            while blocks < most.min(ask_at) && executor.plain_move(&moves, at, &mut state) {
                blocks += 1;
                at = at.next();
            }
        }
        if blocks + surplus >= fuel {
            break Stopped::OutOfFuel;
        }
        blocks += 1;
        let given = executor.events;
        let outcome = executor.step(at, &mut state);
        surplus += (executor.events - given).saturating_sub(FREE_EVENTS);
        if options.past_alarms
            && let Some(fault) = executor.refused_in_passing.take()
        {
            let origin = executor.origin();
            alarms.add(&mut executor.observer, origin, &state, fault);
            executor.give_out_bridge(&mut state);
        }
        match outcome {
            Outcome::Next => at = at.next(),
            Outcome::Jump(to) => at = to,
            Outcome::End(Ending::Restart) if executor.starts_again(&state) && executor.bar_feeds > feeds => {
                feeds = executor.bar_feeds;
                at = At { file: 0, block: 0 };
            }
            Outcome::End(Ending::Alarm(number)) if options.past_alarms => {
                let origin = executor.origin();
                alarms.add(&mut executor.observer, origin, &state, Fault::Alarm(number));
                at = at.next();
            }
            Outcome::End(ending) => break Stopped::Ended(ending),
            Outcome::Fork(ways) => {
                let chosen = options.past_alarms.then(|| choose_way(at, ways, &mut undecided)).flatten();
                let Some((to, way)) = chosen else { break Stopped::Faulted(Fault::Undecidable) };
                let origin = executor.origin();
                alarms.add(&mut executor.observer, origin, &state, Fault::Undecidable);
                (at, state) = (to, way);
            }
            Outcome::Fault(fault) => {
                if !options.past_alarms {
                    break Stopped::Faulted(fault);
                }
                let origin = executor.origin();
                alarms.add(&mut executor.observer, origin, &state, fault.clone());
                match executor.go_on(at, &fault, &mut state) {
                    Some(next) => at = next,
                    None => break Stopped::Faulted(fault),
                }
            }
        }
    };
    let origin = executor.origin();
    if let Stopped::Faulted(fault) = &stopped
        && !options.past_alarms
    {
        executor.observer.fault(origin, &state, fault);
    }
    RunResult {
        stopped,
        origin,
        state,
        blocks,
        assumptions: executor.assumptions.into_all(),
        alarms: alarms.list,
    }
}

/// Alarms that a run went past.
#[derive(Debug, Default)]
struct Alarms {
    list: Vec<Alarm>,
    at: BTreeSet<At>,
}

impl Alarms {
    /// Tells the observer of an alarm, and keeps it; a block in a loop counts once.
    fn add<O: Observer<Concrete>>(
        &mut self,
        observer: &mut O,
        origin: Origin,
        state: &State<Concrete>,
        fault: Fault,
    ) {
        if self.list.len() < MOST_ALARMS && self.at.insert(origin.at) {
            observer.fault(origin, state, &fault);
            self.list.push(Alarm { origin, fault });
        }
    }
}
