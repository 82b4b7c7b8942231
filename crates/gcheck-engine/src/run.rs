//! A run: one execution from a configured start, with every value known or said to be unknown.
//!
//! Knows: fuel, how a run ends, that it may go on after an alarm. Must not know: other paths than the one taken.

use std::collections::BTreeSet;

use crate::assumption::Assumption;
use crate::eval::value::Concrete;
use crate::exec::context::{Ending, Executor, Options, Outcome};
use crate::exec::past_alarm::choose_way;
use crate::fault::Fault;
use crate::machine::Machine;
use crate::model::Model;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::program::Program;
use crate::start::start_state;
use crate::state::State;

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
pub fn run(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    mut observer: impl Observer<Concrete>,
) -> RunResult {
    run_watched(program, model, machine, options, fuel, &mut observer)
}

/// The engine in machine code is large: all observers share it, at the price of a call through a table for what each is shown.
fn run_watched(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    observer: &mut dyn Observer<Concrete>,
) -> RunResult {
    let mut executor = Executor::new(program, model, machine, options, observer);
    executor.lenient = options.past_alarms;
    let state = start_state::<Concrete>(model, machine, &mut executor.assumptions);
    // What the start rests on belongs to no block.
    executor.assumptions.take_untold();
    let at = At { file: 0, block: 0 };
    let mut course =
        Course { executor, state, at, alarms: Alarms::default(), undecided: BTreeSet::new(), feeds: 0 };
    let (stopped, blocks) = course.follow(fuel);
    course.end(stopped, blocks)
}

/// A run under way.
struct Course<'e, 'p, 'o> {
    executor: Executor<'e, 'p, Concrete, &'o mut dyn Observer<Concrete>>,
    state: State<Concrete>,
    /// The block that comes next.
    at: At,
    alarms: Alarms,
    /// Blocks whose way was chosen once.
    undecided: BTreeSet<At>,
    /// Bar feeds as the program began again.
    feeds: u64,
}

impl Course<'_, '_, '_> {
    /// Executes until the run stops: how, and after how many blocks.
    fn follow(&mut self, fuel: u64) -> (Stopped, u64) {
        let mut blocks = 0;
        let mut surplus = 0;
        let mut ask_at = ASKED_EVERY;
        loop {
            self.tell_assumptions();
            if blocks >= ask_at {
                if self.executor.observer.stops() {
                    return (Stopped::OutOfFuel, blocks);
                }
                ask_at = blocks + ASKED_EVERY;
            }
            if let Some(moves) = self.executor.plain_moves(self.at, &self.state) {
                let most = fuel.saturating_sub(surplus);
                while blocks < most.min(ask_at) && self.executor.plain_move(&moves, self.at, &mut self.state)
                {
                    blocks += 1;
                    self.at = self.at.next();
                }
            }
            if blocks + surplus >= fuel {
                return (Stopped::OutOfFuel, blocks);
            }
            blocks += 1;
            let given = self.executor.events;
            let outcome = self.executor.step(self.at, &mut self.state);
            surplus += (self.executor.events - given).saturating_sub(FREE_EVENTS);
            if self.goes_past_alarms()
                && let Some(fault) = self.executor.refused_in_passing.take()
            {
                self.alarm(fault);
                self.executor.give_out_bridge(&mut self.state);
            }
            match self.next(outcome) {
                Ok(next) => self.at = next,
                Err(stopped) => return (stopped, blocks),
            }
        }
    }

    fn tell_assumptions(&mut self) {
        for assumption in self.executor.assumptions.take_untold() {
            let origin = self.executor.origin();
            self.executor.observer.assumed(origin, &assumption);
        }
    }

    /// The block after the one that had this outcome, or how the run stops there.
    fn next(&mut self, outcome: Outcome<Concrete>) -> Result<At, Stopped> {
        let at = self.at;
        match outcome {
            Outcome::Next => Ok(at.next()),
            Outcome::Jump(to) => Ok(to),
            Outcome::End(Ending::Restart)
                if self.executor.starts_again(&self.state) && self.executor.bar_feeds > self.feeds =>
            {
                self.feeds = self.executor.bar_feeds;
                Ok(At { file: 0, block: 0 })
            }
            Outcome::End(Ending::Alarm(number)) if self.goes_past_alarms() => {
                self.alarm(Fault::Alarm(number));
                Ok(at.next())
            }
            Outcome::End(ending) => Err(Stopped::Ended(ending)),
            Outcome::Fork(ways) => {
                let chosen =
                    self.goes_past_alarms().then(|| choose_way(at, ways, &mut self.undecided)).flatten();
                let Some((to, way)) = chosen else { return Err(Stopped::Faulted(Fault::Undecidable)) };
                self.alarm(Fault::Undecidable);
                self.state = way;
                Ok(to)
            }
            Outcome::Fault(fault) => {
                if !self.goes_past_alarms() {
                    return Err(Stopped::Faulted(fault));
                }
                self.alarm(fault.clone());
                let next = self.executor.go_on(at, &fault, &mut self.state);
                next.ok_or(Stopped::Faulted(fault))
            }
        }
    }

    fn goes_past_alarms(&self) -> bool {
        self.executor.options.past_alarms
    }

    fn alarm(&mut self, fault: Fault) {
        let origin = self.executor.origin();
        self.alarms.add(self.executor.observer, origin, &self.state, fault);
    }

    fn end(self, stopped: Stopped, blocks: u64) -> RunResult {
        let origin = self.executor.origin();
        if let Stopped::Faulted(fault) = &stopped
            && !self.goes_past_alarms()
        {
            self.executor.observer.fault(origin, &self.state, fault);
        }
        RunResult {
            stopped,
            origin,
            state: self.state,
            blocks,
            assumptions: self.executor.assumptions.into_all(),
            alarms: self.alarms.list,
        }
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
    fn add(
        &mut self,
        observer: &mut dyn Observer<Concrete>,
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
