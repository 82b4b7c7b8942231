//! All paths of a program: what may be active before every block, and which blocks can be reached.
//!
//! Knows: exact execution while every condition is known, forks, joins, widening, the budget. Must not know: what blocks do
//! (`exec`), findings.
//!
//! There is always a set of pending states, each at a block. As long as it holds one state only, the program is executed
//! exactly as a run would, loops turn by turn, and what is seen holds on every path (*solo*). A condition that nobody knows
//! makes several. Then the state earliest in the program goes first, states that meet are joined, and a loop that changes its
//! state widens it until it stays. When all paths have met again, execution is solo once more.
//!
//! Observers see every block once for each stretch with its final state: what happens between a fork and its end is executed
//! silently until nothing changes, then shown.
//!
//! Time and memory follow the text, not the running time of the program: work is counted and limited ([`Budget`]), states that
//! wait or that later ones are compared with are counted and limited, and what a call needed goes when it returns. A limit that
//! is reached is named in the result ([`GivenUp`]).

mod branch;
mod budget;
mod checkpoint;
mod heads;
mod marks;
mod reaching_definitions;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use branch::Before;
pub use branch::Branch;
pub use budget::{Budget, GivenUp, Limit};
pub use checkpoint::{Checkpoint, Leg};
use heads::Heads;
use marks::Marks;
pub use reaching_definitions::{Choice, Decision, Fact, Facts, Parting, ReachingDefinitions};

use crate::assumption::Assumption;
use crate::eval::value::Abstract;
use crate::event::Event;
use crate::exec::context::{Ending, Executor, Options, Outcome};
use crate::fault::Fault;
use crate::lattice::Lattice;
use crate::machine::Machine;
use crate::model::Model;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::program::Program;
use crate::start::start_state;
use crate::state::State;

/// What an observer of all paths is shown.
#[derive(Clone, Copy)]
pub struct FlowCx<'a> {
    /// The block.
    pub origin: Origin,
    /// What may be the state.
    pub state: &'a State<Abstract>,
    /// Where its facts were set.
    pub definitions: &'a ReachingDefinitions,
    /// Every path comes here in this state.
    pub solo: bool,
}

/// Watches all paths.
pub trait FlowObserver {
    /// A block is about to be executed.
    fn before(&mut self, cx: &FlowCx<'_>) {
        let _ = cx;
    }

    /// Something happened; the state is that after it.
    fn event(&mut self, cx: &FlowCx<'_>, event: &Event) {
        let _ = (cx, event);
    }

    /// A variable was read that nobody set before.
    fn vacant_read(&mut self, cx: &FlowCx<'_>, variable: u32) {
        let _ = (cx, variable);
    }

    /// A block was executed.
    fn after(&mut self, cx: &FlowCx<'_>) {
        let _ = cx;
    }

    /// A block cannot be executed. The analysis goes on as the programmer will who corrects it.
    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        let _ = (cx, fault);
    }

    /// The program ends here.
    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        let _ = (cx, ending);
    }

    /// This block leads back to `head` in the state that was met there before: the loop never ends.
    fn endless(&mut self, cx: &FlowCx<'_>, head: At) {
        let _ = (cx, head);
    }

    /// Is it to be told of [checkpoints](FlowObserver::checkpoint)?
    fn wants_checkpoints(&self) -> bool {
        false
    }

    /// The analysis can be taken up here another time; `leg` is what it did since the last such place. `false` ends it here.
    fn checkpoint(&mut self, leg: Leg, checkpoint: Checkpoint) -> bool {
        let _ = (leg, checkpoint);
        true
    }

    /// Paths that were one part for the first time at this block: so many of its ways are to be given out as
    /// [branches](FlowObserver::branches).
    fn wanted_branches(&self, at: At) -> usize {
        let _ = at;
        0
    }

    /// Paths that were one part here, and each of these ways can be followed by itself another time.
    fn branches(&mut self, branches: Vec<Branch>) {
        let _ = branches;
    }

    /// Asked now and then: is the analysis to be given up?
    fn stops(&mut self) -> bool {
        false
    }
}

/// Whether a block can be reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reach {
    /// By no path.
    Never,
    /// By some path.
    Some,
    /// By every path.
    Always,
    /// The analysis ended before it could say.
    Unknown,
}

/// What the analysis of all paths leaves.
#[derive(Debug, Default)]
pub struct FlowResult {
    reached: Marks,
    always: Marks,
    /// Where it was given up: what was not seen may still be reached.
    pub given_up: Vec<GivenUp>,
    /// What it cost, in blocks executed; copies, joins and comparisons of states count as blocks, too.
    pub work: u64,
    /// What it rests on.
    pub assumptions: BTreeSet<Assumption>,
    /// Where paths that were one part, in the order of the first time.
    pub partings: Vec<Parting>,
}

impl FlowResult {
    /// All of an analysis in one leg.
    fn of(leg: Leg) -> Self {
        let Leg { reached, always, given_up, work, assumptions, partings, .. } = leg;
        Self { reached, always, given_up, work, assumptions, partings }
    }

    /// Did it end before it had seen all paths?
    pub fn is_incomplete(&self) -> bool {
        !self.given_up.is_empty()
    }

    /// Whether a block can be reached.
    pub fn reach(&self, at: At) -> Reach {
        if self.always.contains(at) {
            Reach::Always
        } else if self.reached.contains(at) {
            Reach::Some
        } else if self.is_incomplete() {
            Reach::Unknown
        } else {
            Reach::Never
        }
    }

    /// The first block from `from` on, in its file, that was not reached; it may stand behind the file's last.
    pub fn first_unreached(&self, from: At) -> At {
        self.reached.first_missing(from)
    }

    /// Takes in what a leg did but for what it reached.
    pub fn add_leg(&mut self, work: u64, given_up: &[GivenUp], assumptions: &BTreeSet<Assumption>) {
        self.work += work;
        self.given_up.extend_from_slice(given_up);
        if !self.assumptions.is_superset(assumptions) {
            self.assumptions.extend(assumptions.iter().cloned());
        }
    }

    /// The blocks from `from` to before `to`, which stands in the same file, were reached; by every path when `always`.
    pub fn reach_all(&mut self, from: At, to: u32, always: bool) {
        let to = At { block: to, ..from };
        self.reached.insert_all(from, to);
        if always {
            self.always.insert_all(from, to);
        }
    }
}

/// A block in a chain of calls.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Key {
    /// Blocks of the calls under way, the outermost first, then the block. Compared in this order, "earlier" means: comes
    /// first in the program as it is called.
    path: Rc<[At]>,
    at: At,
    /// The block is the branch that a condition in front of it chose, and not run into from the branch above.
    wanted: bool,
}

impl Key {
    fn of(at: At, state: &State<Abstract>) -> Self {
        Self::on(calls(state), at, state)
    }

    fn on(path: Rc<[At]>, at: At, state: &State<Abstract>) -> Self {
        Self { path, at, wanted: state.frames().last().is_some_and(|frame| frame.wants(at)) }
    }

    /// The blocks of the calls, then the block.
    fn way(&self) -> impl Iterator<Item = &At> {
        self.path.iter().chain([&self.at])
    }

    fn is_before(&self, other: &Self) -> bool {
        self.way().lt(other.way())
    }
}

impl PartialOrd for Key {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Key {
    fn cmp(&self, other: &Self) -> Ordering {
        self.way().cmp(other.way()).then(self.wanted.cmp(&other.wanted))
    }
}

fn calls(state: &State<Abstract>) -> Rc<[At]> {
    state.frames().iter().skip(1).map(|frame| frame.caller).collect()
}

/// A state that waits at a block.
#[derive(Debug, Clone)]
struct Pending {
    /// Shared with what is kept of the block: states are large, and most are joined with others before they are executed.
    state: Rc<State<Abstract>>,
    definitions: ReachingDefinitions,
}

/// A state that stands for all that came to a block since the last solo stretch.
#[derive(Debug)]
struct Met {
    state: Rc<State<Abstract>>,
    definitions: ReachingDefinitions,
    visits: u32,
}

/// States that come to one block more often are widened.
const JOINS_BEFORE_WIDENING: u32 = 3;
/// States that come to one block more often are given up: the widening of some part does not settle.
const MOST_VISITS: u32 = 200;
/// Turns of a loop that are executed exactly; from there on it is widened, so that a loop that counts past its end is seen to.
pub const MOST_EXACT_TURNS: u32 = 10_000;
/// States pending at once; a program that forks more often is given up.
const MOST_PENDING: usize = 4096;
/// What a copy of a state costs at least, in blocks.
const COPY: u64 = 4;
/// What it costs at least to join two states and to see whether that changed anything, in blocks.
const JOIN: u64 = 8;

/// States that are kept of blocks that were met, beside one for each block of the program's file, and of long files at most.
/// A state of a program with the usual variables takes about ten kilobytes.
const MOST_MET: usize = 2048;
const MOST_MET_OF_BLOCKS: usize = 10_000;
/// States that are kept of blocks that were met before those that no path comes back to are looked for.
const MOST_UNSETTLED: usize = 256;
/// Places at which paths part that are named.
const MOST_PARTINGS: usize = 64;
/// Places at which an analysis was given up that are named.
const MOST_NAMED: usize = 8;

/// Blocks between two questions whether the analysis is to be given up.
const ASKED_EVERY: u64 = 8192;

/// Which paths are analysed, and with how much work at most.
#[derive(Debug, Clone, Copy)]
pub struct Task<'d> {
    /// Switches of the operator's panel.
    pub options: Options,
    /// Ways taken where paths that are one part, each the first time, in this order; everywhere else all ways are.
    pub choices: &'d [Choice],
    /// The work that may be done, in blocks.
    pub work: u64,
}

impl Task<'_> {
    /// All paths, no block skipped.
    pub const fn all_paths(work: u64) -> Self {
        Self { options: Options::NONE, choices: &[], work }
    }
}

/// Analyses all paths of a program that a task names.
pub fn flow(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    task: Task<'_>,
    observer: &mut dyn FlowObserver,
) -> FlowResult {
    FlowResult::of(flow_from(program, model, machine, task, None, observer))
}

/// Analyses all paths of a task that take a branch, from where it begins. The work that led there counts as done; what it
/// rests on and reaches before is not repeated.
pub fn flow_branch(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    task: Task<'_>,
    branch: Branch,
    observer: &mut dyn FlowObserver,
) -> FlowResult {
    let Branch { choice: _, to, state, definitions, before } = branch;
    definitions.begin_leg();
    let facts = definitions.clone();
    let mut flow = Flow::new(program, model, machine, task, observer, to);
    flow.taken = before.taken + 1;
    flow.work = before.work;
    flow.asked_at = before.work;
    flow.heads = before.heads.clone();
    flow.forks = before.forks;
    flow.lost_ways.clone_from(&before.lost_ways);
    flow.lost = before.lost;
    flow.arrive(to, state, definitions);
    flow.explore();
    FlowResult::of(flow.end_leg(&facts))
}

/// Analyses all paths of a task from a checkpoint on, or from the beginning: what was done since the last checkpoint that the
/// observer was told of.
pub fn flow_from(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    task: Task<'_>,
    from: Option<Checkpoint>,
    observer: &mut dyn FlowObserver,
) -> Leg {
    let at = from.as_ref().map_or(At { file: 0, block: 0 }, |checkpoint| checkpoint.at);
    let mut flow = Flow::new(program, model, machine, task, observer, at);
    let Checkpoint { at: _, state, definitions, parted, taken } = from.unwrap_or_else(|| flow.beginning());
    definitions.begin_leg();
    let facts = definitions.clone();
    flow.parted = parted;
    flow.taken = taken;
    flow.pending.insert(Key::of(at, &state), Pending { state: Rc::new(state), definitions });
    flow.explore();
    flow.end_leg(&facts)
}

struct Flow<'a, 'p, 'o, 'd> {
    /// Ways that are taken where paths that are one part.
    choices: &'d [Choice],
    /// How many of them were taken, in their order.
    taken: usize,
    executor: Executor<'a, 'p, Abstract, Shown<'a, 'o>>,
    /// The work that may be done.
    limit: u64,
    /// The work done.
    work: u64,
    /// So many states are kept of blocks that were met.
    most_met: usize,
    /// When so many are kept, those that no path comes back to are looked for.
    settle_at: usize,
    /// How much work was done when the observer was asked last whether to go on.
    asked_at: u64,
    forks: u64,
    /// A path ended while others went on: what comes is no longer on every path.
    parted: bool,
    /// The earliest first.
    pending: BTreeMap<Key, Pending>,
    met: FxHashMap<Key, Met>,
    /// Refused blocks that may lead elsewhere once they are corrected: out of a loop.
    lost_ways: BTreeSet<At>,
    /// How often such a block was come by.
    lost: u64,
    /// Keys of `met` in the order in which they were met.
    order: Vec<Key>,
    heads: Heads,
    /// The observer is told of checkpoints.
    offers: bool,
    /// Blocks of the chunk of the main file that is executed alone.
    chunk: Range<u32>,
    /// The block of the last checkpoint.
    last_offer: u32,
    leg: Leg,
    /// How much work was done when the leg began.
    leg_began: u64,
    /// The observer said that this is enough.
    stopped: bool,
    /// The block under way, and the calls that led there.
    at: At,
    path: Rc<[At]>,
}

/// What meeting a loop's head again says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// Another turn.
    On,
    /// The loop has nothing new to show: what there was to come, came by its ways out.
    Over,
    /// The loop has nothing new to show, and a block in it that was refused may be its way out: it ends as loops end.
    LostItsEnd,
}

/// What a stretch of blocks came to.
enum Stretch {
    /// Its end was handled.
    Done,
    /// The work that may be done is done.
    WorkIsDone,
    /// The observer wants no more.
    Stopped,
}

impl<'a, 'p, 'o, 'd> Flow<'a, 'p, 'o, 'd> {
    /// An analysis that has nothing to follow yet.
    fn new(
        program: &'a Program<'p>,
        model: &'a Model<'a>,
        machine: &'a Machine,
        task: Task<'d>,
        observer: &'o mut dyn FlowObserver,
        at: At,
    ) -> Self {
        let offers = observer.wants_checkpoints();
        let shown = Shown {
            observer,
            model,
            definitions: ReachingDefinitions::default(),
            solo: true,
            muted: false,
            also: Vec::new(),
            stepping: None,
            events: 0,
        };
        let mut executor = Executor::new(program, model, machine, task.options, shown);
        executor.lenient = true;
        let blocks = executor.file(0).map_or(0, |file| file.loaded.flow_graph().blocks() as usize);
        Flow {
            chunk: executor.chunk_of(at.block),
            executor,
            limit: task.work,
            work: 0,
            choices: task.choices,
            taken: 0,
            most_met: MOST_MET + blocks.min(MOST_MET_OF_BLOCKS),
            settle_at: MOST_UNSETTLED,
            asked_at: 0,
            forks: 0,
            parted: false,
            pending: BTreeMap::new(),
            met: FxHashMap::default(),
            lost_ways: BTreeSet::new(),
            lost: 0,
            order: Vec::new(),
            heads: Heads::default(),
            offers,
            last_offer: at.block,
            leg: Leg::default(),
            leg_began: 0,
            stopped: false,
            at,
            path: Rc::default(),
        }
    }

    /// The first block, in the state in which the machine is switched on.
    fn beginning(&mut self) -> Checkpoint {
        Checkpoint {
            at: self.at,
            state: start_state::<Abstract>(
                self.executor.model,
                self.executor.machine,
                &mut self.executor.assumptions,
            ),
            definitions: ReachingDefinitions::default(),
            parted: false,
            taken: 0,
        }
    }

    fn explore(&mut self) {
        while let Some((key, next)) = self.pending.pop_first() {
            let solo = self.pending.is_empty();
            let stretch = if solo {
                self.show_met(Some(&key));
                self.alone(key, next)
            } else {
                self.settle_before(&key);
                self.among_others(key, next)
            };
            match stretch {
                Stretch::Done if self.stopped => return,
                Stretch::Done => {}
                Stretch::Stopped => {
                    self.stopped = true;
                    return;
                }
                Stretch::WorkIsDone => {
                    self.give_up(Limit::Work);
                    // What was executed silently is shown once, with work of its own.
                    self.limit = self.limit.saturating_add(self.limit / 4);
                    self.show_met(None);
                    return;
                }
            }
        }
        self.show_met(None);
    }

    /// Is this the end, because the observer wants no more? Asked once in many blocks.
    fn is_stopped(&mut self) -> bool {
        if self.work - self.asked_at >= ASKED_EVERY {
            self.asked_at = self.work;
            self.stopped |= self.executor.observer.observer.stops();
        }
        self.stopped
    }

    /// Execution has left the chunk. `false`: the observer wants no more.
    fn enter_chunk(&mut self, at: At, state: &State<Abstract>) -> bool {
        self.chunk = self.executor.chunk_of(at.block);
        let may_offer = self.offers
            && at.block == self.chunk.start
            && state.is_in_main_program_alone()
            && self
                .executor
                .file(0)
                .is_some_and(|file| file.loaded.flow_graph().is_passed_for_good(at.block));
        if !may_offer {
            return true;
        }
        // Nothing leads back here: what loops in front looked like is of no use any more.
        self.heads.clear();
        self.lost_ways.clear();
        self.last_offer = at.block;
        let leg = self.end_leg(&self.executor.observer.definitions.clone());
        self.executor.observer.definitions.begin_leg();
        let definitions = self.executor.observer.definitions.clone();
        let checkpoint =
            Checkpoint { at, state: state.clone(), definitions, parted: self.parted, taken: self.taken };
        self.executor.observer.observer.checkpoint(leg, checkpoint)
    }

    /// What was done since the last checkpoint. `definitions` are those under way, or share their notes.
    fn end_leg(&mut self, definitions: &ReachingDefinitions) -> Leg {
        let mut leg = std::mem::take(&mut self.leg);
        leg.work = self.work - self.leg_began;
        self.leg_began = self.work;
        leg.assumptions = std::mem::take(&mut self.executor.assumptions).into_all();
        leg.stopped = self.stopped;
        (leg.asked, leg.set) = definitions.notes();
        leg
    }

    /// Execution goes to a block of the main program: not back over a checkpoint, which the text excludes.
    fn note_way(&mut self, to: At, state: &State<Abstract>) {
        self.leg.went_back |= to.file == 0 && to.block < self.last_offer && state.frames().len() == 1;
    }

    fn step(&mut self, at: At, state: &mut State<Abstract>) -> Outcome<Abstract> {
        self.at = at;
        self.executor.observer.stepping = Some(at);
        self.executor.observer.events = 0;
        let outcome = self.executor.step(at, state);
        if let Some(fault) = self.executor.refused_in_passing.take() {
            self.tell(at, &fault, state);
            self.executor.give_out_bridge(state);
        }
        // The first event of a block is the block's own work.
        self.work += 1 + self.executor.observer.events.saturating_sub(1);
        for also in std::mem::take(&mut self.executor.observer.also) {
            self.leg.reached.insert(also);
        }
        match &outcome {
            Outcome::Jump(to) => self.note_in_front(*to),
            Outcome::Fork(ways) => {
                self.work += ways.len() as u64 * (COPY + weight(state));
                for (to, _) in ways {
                    self.note_in_front(*to);
                }
            }
            _ => {}
        }
        outcome
    }

    /// What is put in between a block and the one in front, the end of a subroutine or a loop, is on the way of a jump to the
    /// block: the jump rests on both.
    fn note_in_front(&self, to: At) {
        if let Some(front) = to.block.checked_sub(1).filter(|_| to.file == 0)
            && let Some(file) = self.executor.program.file(0)
        {
            file.loaded.note(front);
        }
    }

    /// Keeps the calls under way. True when they are others than before.
    fn follow_calls(&mut self, state: &State<Abstract>) -> bool {
        let callers = state.frames().iter().skip(1).map(|frame| frame.caller);
        let differ = !callers.eq(self.path.iter().copied());
        if differ {
            self.path = calls(state);
        }
        differ
    }

    /// A limit is reached at the block under way.
    fn give_up(&mut self, limit: Limit) {
        let given_up = GivenUp { at: self.at, calls: Rc::clone(&self.path), limit };
        let is_known = self.leg.given_up.iter().any(|known| known.at == given_up.at && known.limit == limit);
        if !is_known && self.leg.given_up.len() < MOST_NAMED {
            self.leg.given_up.push(given_up);
        }
    }

    /// Executes exactly, showing everything, until the paths part or end.
    fn alone(&mut self, key: Key, from: Pending) -> Stretch {
        let Pending { state, definitions } = from;
        let mut state = Rc::unwrap_or_clone(state);
        let mut at = key.at;
        self.path = key.path;
        self.heads.are_in(&self.path);
        self.executor.observer.definitions = definitions;
        self.executor.observer.solo = !self.parted;
        self.executor.observer.muted = false;
        loop {
            at = self.move_on(at, &mut state);
            if at.file == 0 && !self.chunk.contains(&at.block) && !self.enter_chunk(at, &state) {
                return Stretch::Stopped;
            }
            if self.work >= self.limit {
                return Stretch::WorkIsDone;
            }
            if self.is_stopped() {
                return Stretch::Stopped;
            }
            self.leg.reached.insert(at);
            if !self.parted {
                self.leg.always.insert(at);
            }
            match self.step(at, &mut state) {
                Outcome::Next => at = at.next(),
                Outcome::Jump(to) => {
                    let back = to.file == at.file && to.block <= at.block;
                    let behind = at.next();
                    at = to;
                    self.note_way(to, &state);
                    let is_elsewhere = self.follow_calls(&state);
                    if is_elsewhere {
                        self.heads.are_in(&self.path);
                    }
                    if back {
                        match self.turn(at, &mut state) {
                            Turn::On => {}
                            // The call is part of a loop, which comes to its end at its own jump.
                            Turn::LostItsEnd if is_elsewhere => {}
                            Turn::LostItsEnd => at = behind,
                            Turn::Over => return Stretch::Done,
                        }
                    }
                }
                Outcome::Fork(ways) => {
                    self.fork(at, ways);
                    return Stretch::Done;
                }
                Outcome::End(ending) => {
                    self.executor.end(&state, ending);
                    return Stretch::Done;
                }
                Outcome::Fault(fault) => {
                    let Some(next) = self.go_on(at, &fault, &mut state) else { return Stretch::Done };
                    if next != at.next() {
                        self.note_way(next, &state);
                        self.follow_calls(&state);
                        self.heads.are_in(&self.path);
                    }
                    at = next;
                }
            }
        }
    }

    /// After a block that was refused: the observer is told, and execution goes on where it does once the block is corrected.
    fn go_on(&mut self, at: At, fault: &Fault, state: &mut State<Abstract>) -> Option<At> {
        self.tell(at, fault, state);
        self.executor.go_on(at, fault, state)
    }

    /// Tells the observer of a refused block, and notes it where it may lead elsewhere once it is corrected.
    fn tell(&mut self, at: At, fault: &Fault, state: &State<Abstract>) {
        match self.executor.take_state_at_fault() {
            Some(then) => self.executor.fault(&then, fault),
            None => self.executor.fault(state, fault),
        }
        let may_lead_elsewhere = matches!(
            fault,
            Fault::NoSuchLabel(_)
                | Fault::JumpTarget(_)
                | Fault::NoSuchProgram
                | Fault::LoopMismatch
                | Fault::StrayReturn
                | Fault::TooDeep
                | Fault::Undecidable
                | Fault::Malformed
                | Fault::Value(_)
        );
        if may_lead_elsewhere {
            self.lost += 1;
            self.lost_ways.insert(at);
        }
    }

    /// Does a jump back close a loop with a refused block in it, which may be its way out?
    fn closes_over_lost_way(&self, at: At, to: At) -> bool {
        at.file == to.file && to <= at && self.lost_ways.range(to..=at).next().is_some()
    }

    /// Executes the blocks from here on that only move: the block behind them.
    fn move_on(&mut self, from: At, state: &mut State<Abstract>) -> At {
        let Some(moves) = self.executor.plain_moves(from, state) else { return from };
        let mut at = from;
        while self.work < self.limit {
            self.executor.observer.stepping = Some(at);
            if !self.executor.plain_move(&moves, at, state) {
                break;
            }
            self.work += 1;
            at = at.next();
        }
        self.leg.reached.insert_all(from, at);
        if !self.parted {
            self.leg.always.insert_all(from, at);
        }
        at
    }

    /// A loop's head is met again in a solo stretch.
    fn turn(&mut self, at: At, state: &mut State<Abstract>) -> Turn {
        let wanted = state.frames().last().is_some_and(|frame| frame.wants(at));
        self.work += COPY + weight(state);
        let Some(head) = self.heads.at(at, wanted) else {
            self.heads.meet(at, wanted, state, self.forks, self.lost);
            return Turn::On;
        };
        let over = if head.lost == self.lost { Turn::Over } else { Turn::LostItsEnd };
        head.visits += 1;
        if head.forks != self.forks || head.visits > MOST_EXACT_TURNS {
            // The paths parted and met again inside the loop: its turns are not exact, so they are one.
            let never_parts = head.forks == self.forks;
            head.forks = self.forks;
            head.joins += 1;
            let widen = head.visits - head.before > JOINS_BEFORE_WIDENING || head.visits > MOST_EXACT_TURNS;
            let before: &State<Abstract> = &head.state;
            let joined = if widen { before.widen(state) } else { before.join(state) };
            let gives_up = head.joins > MOST_VISITS;
            if joined == *before || gives_up {
                if gives_up {
                    self.give_up(Limit::Turns);
                }
                if never_parts && !gives_up && over == Turn::Over {
                    // Whatever the turn, no condition leads out.
                    let origin = self.executor.origin();
                    self.executor.observer.endless(origin, at, state);
                }
                return over;
            }
            self.executor.tell_held_back(state);
            head.state = Rc::new(joined.clone());
            *state = joined;
            return Turn::On;
        }
        if *head.state == *state {
            if over == Turn::Over {
                let origin = self.executor.origin();
                self.executor.observer.endless(origin, at, state);
            }
            return over;
        }
        // Compared with a state that is taken ever more seldom: a loop that repeats itself is found, whatever its period.
        if head.visits - head.before >= head.taken.saturating_mul(2) {
            head.state = Rc::new(state.clone());
            head.taken = head.visits - head.before;
        }
        Turn::On
    }

    /// Executes silently, one of several states, until it is no longer the earliest.
    fn among_others(&mut self, key: Key, from: Pending) -> Stretch {
        let Pending { state, definitions } = from;
        let mut state = Rc::unwrap_or_clone(state);
        let mut at = key.at;
        self.path = key.path;
        self.executor.observer.definitions = definitions;
        self.executor.observer.solo = false;
        self.executor.observer.muted = true;
        loop {
            if self.work >= self.limit {
                return Stretch::WorkIsDone;
            }
            if self.is_stopped() {
                return Stretch::Stopped;
            }
            self.leg.reached.insert(at);
            let next = match self.step(at, &mut state) {
                Outcome::Jump(to) => {
                    let definitions = self.executor.observer.definitions.clone();
                    let closes = self.closes_over_lost_way(at, to);
                    if closes && !self.follow_calls(&state) {
                        self.arrive(at.next(), state.clone(), definitions.clone());
                    }
                    self.arrive(to, state, definitions);
                    return Stretch::Done;
                }
                Outcome::Fork(ways) => {
                    self.fork(at, ways);
                    return Stretch::Done;
                }
                Outcome::End(_) => {
                    self.parted = true;
                    return Stretch::Done;
                }
                Outcome::Fault(fault) => match self.go_on(at, &fault, &mut state) {
                    Some(next) if next == at.next() => next,
                    Some(next) => {
                        let definitions = self.executor.observer.definitions.clone();
                        self.arrive(next, state, definitions);
                        return Stretch::Done;
                    }
                    None => {
                        self.parted = true;
                        return Stretch::Done;
                    }
                },
                Outcome::Next => at.next(),
            };
            at = next;
            self.follow_calls(&state);
            let key = Key::on(Rc::clone(&self.path), at, &state);
            let meets = self.met.contains_key(&key)
                || self.is_entry(at)
                || self.pending.contains_key(&key)
                || self.pending.first_key_value().is_some_and(|(first, _)| first.is_before(&key));
            if meets {
                let definitions = self.executor.observer.definitions.clone();
                self.arrive(at, state, definitions);
                return Stretch::Done;
            }
        }
    }

    fn is_entry(&self, at: At) -> bool {
        self.executor.file(at.file).is_some_and(|file| {
            let graph = file.loaded.flow_graph();
            // A loop may come back to the block behind its head.
            graph.may_be_target(at.block) || at.block.checked_sub(1).is_some_and(|above| graph.is_flow(above))
        })
    }

    fn fork(&mut self, at: At, mut ways: Vec<(At, State<Abstract>)>) {
        self.forks += 1;
        if self.executor.observer.solo {
            self.part(at, &mut ways);
        }
        let definitions = self.executor.observer.definitions.clone();
        for (to, state) in ways {
            let mut definitions = definitions.clone();
            definitions.decide(Decision { at, to });
            self.arrive(to, state, definitions);
        }
    }

    /// Paths that were one part: notes it, and keeps the way that is to be taken here.
    fn part(&mut self, at: At, ways: &mut Vec<(At, State<Abstract>)>) {
        let is_known = self.leg.partings.iter().any(|known| known.at == at);
        if !is_known && self.leg.partings.len() < MOST_PARTINGS {
            let work = self.work - self.leg_began;
            self.leg.partings.push(Parting { at, ways: ways.len(), work });
            self.give_out_branches(at, ways);
        }
        if let Some(choice) = self.choices.get(self.taken).filter(|choice| choice.at == at)
            && choice.way < ways.len()
        {
            let chosen = ways.swap_remove(choice.way);
            *ways = vec![chosen];
            self.taken += 1;
        }
    }

    /// Gives out the ways that the observer wants to follow by themselves.
    fn give_out_branches(&mut self, at: At, ways: &[(At, State<Abstract>)]) {
        let wanted = self.executor.observer.observer.wanted_branches(at);
        if wanted == 0 {
            return;
        }
        let before = Rc::new(Before {
            heads: self.heads.clone(),
            forks: self.forks,
            lost_ways: self.lost_ways.clone(),
            lost: self.lost,
            taken: self.taken,
            work: self.work,
        });
        let branch = |(way, (to, state)): (usize, &(At, State<Abstract>))| {
            let mut definitions = self.executor.observer.definitions.apart();
            definitions.decide(Decision { at, to: *to });
            let choice = Choice { at, way };
            Branch { choice, to: *to, state: state.clone(), definitions, before: Rc::clone(&before) }
        };
        let branches = ways.iter().enumerate().take(wanted).map(branch).collect();
        self.executor.observer.observer.branches(branches);
    }

    /// A state comes to a block: it waits there, joined with what came before.
    fn arrive(&mut self, at: At, state: State<Abstract>, definitions: ReachingDefinitions) {
        self.note_way(at, &state);
        let key = Key::of(at, &state);
        let is_kept = self.met.contains_key(&key);
        self.work += weight(&state) + if is_kept { JOIN } else { COPY };
        if !is_kept && (self.pending.len() >= MOST_PENDING || self.met.len() >= self.most_met) {
            self.give_up(Limit::States);
            return;
        }
        let item = match self.met.get_mut(&key) {
            None => {
                self.order.push(key.clone());
                let state = Rc::new(state);
                let met = Met { state: Rc::clone(&state), definitions: definitions.clone(), visits: 1 };
                self.met.insert(key.clone(), met);
                Pending { state, definitions }
            }
            Some(met) => {
                met.visits += 1;
                let widen = met.visits > JOINS_BEFORE_WIDENING;
                let before: &State<Abstract> = &met.state;
                let joined = if widen { before.widen(&state) } else { before.join(&state) };
                if joined == *before {
                    return;
                }
                if met.visits > MOST_VISITS {
                    self.give_up(Limit::Turns);
                    return;
                }
                met.state = Rc::new(joined);
                met.definitions.join(&definitions);
                Pending { state: Rc::clone(&met.state), definitions: met.definitions.clone() }
            }
        };
        self.pending.insert(key, item);
    }

    /// Shows what no path comes back to, and drops it, when many states are kept: the earliest path is at a block that nothing
    /// leads back over.
    fn settle_before(&mut self, earliest: &Key) {
        let here = earliest.at;
        let is_due = self.met.len() >= self.settle_at
            && earliest.path.is_empty()
            && here.file == 0
            && self
                .executor
                .file(0)
                .is_some_and(|file| file.loaded.flow_graph().is_passed_for_good(here.block));
        if !is_due {
            return;
        }
        let is_passed = |key: &Key| key.way().next().is_some_and(|first| *first < here);
        let (passed, later): (Vec<Key>, Vec<Key>) =
            std::mem::take(&mut self.order).into_iter().partition(is_passed);
        self.order = later;
        let met = std::mem::take(&mut self.met);
        for key in &passed {
            if let Some(from) = met.get(key) {
                self.show(key, from, &met);
            }
        }
        self.met = met;
        self.met.retain(|key, _| !is_passed(key));
        self.settle_at = MOST_UNSETTLED.max(self.met.len() * 2);
    }

    /// Shows what was executed silently, each stretch once, in its final state.
    fn show_met(&mut self, next: Option<&Key>) {
        let order = std::mem::take(&mut self.order);
        let met = std::mem::take(&mut self.met);
        self.settle_at = MOST_UNSETTLED;
        for key in &order {
            // What still waits is shown when it is executed.
            if next == Some(key) || self.pending.contains_key(key) {
                continue;
            }
            if let Some(from) = met.get(key) {
                self.show(key, from, &met);
            }
        }
    }

    fn show(&mut self, key: &Key, from: &Met, met: &FxHashMap<Key, Met>) {
        let mut state = State::clone(&from.state);
        let mut at = key.at;
        self.path = Rc::clone(&key.path);
        self.executor.observer.definitions = from.definitions.clone();
        self.executor.observer.solo = false;
        self.executor.observer.muted = false;
        loop {
            if self.work >= self.limit {
                self.give_up(Limit::Work);
                return;
            }
            if self.is_stopped() {
                return;
            }
            match self.step(at, &mut state) {
                Outcome::Next => at = at.next(),
                Outcome::Jump(_) => return self.executor.tell_held_back(&state),
                Outcome::Fork(ways) => {
                    if let Some((_, state)) = ways.first() {
                        self.executor.tell_held_back(state);
                    }
                    return;
                }
                Outcome::End(ending) => {
                    self.executor.end(&state, ending);
                    return;
                }
                Outcome::Fault(fault) => match self.go_on(at, &fault, &mut state) {
                    Some(next) if next == at.next() => at = next,
                    _ => return,
                },
            }
            self.follow_calls(&state);
            if met.contains_key(&Key::on(Rc::clone(&self.path), at, &state)) {
                return self.executor.tell_held_back(&state);
            }
        }
    }
}

/// What a copy of a state costs beside what every copy does, in blocks.
fn weight(state: &State<Abstract>) -> u64 {
    state.values_held() as u64 / 16
}

impl Executor<'_, '_, Abstract, Shown<'_, '_>> {
    /// The blocks of the main file's chunk that holds a block; nothing behind the last.
    fn chunk_of(&self, block: u32) -> Range<u32> {
        let Some(file) = self.program.file(0) else { return block..block };
        let graph = file.loaded.flow_graph();
        graph.chunk_of(block).map_or(block..block, |(chunk, _)| graph.blocks_of(chunk))
    }

    fn end(&mut self, state: &State<Abstract>, ending: Ending) {
        let origin = self.origin();
        let shown = &mut self.observer;
        if !shown.muted {
            let cx = FlowCx { origin, state, definitions: &shown.definitions, solo: shown.solo };
            shown.observer.ended(&cx, ending);
        }
    }

    fn fault(&mut self, state: &State<Abstract>, fault: &Fault) {
        let origin = self.origin();
        let shown = &mut self.observer;
        if !shown.muted {
            let cx = FlowCx { origin, state, definitions: &shown.definitions, solo: shown.solo };
            shown.observer.fault(&cx, fault);
        }
    }
}

/// Passes on what is to be shown, and keeps the reaching definitions.
struct Shown<'a, 'o> {
    observer: &'o mut dyn FlowObserver,
    model: &'a Model<'a>,
    definitions: ReachingDefinitions,
    solo: bool,
    muted: bool,
    /// Blocks that ran inside the step of another: a cycle's profile.
    also: Vec<At>,
    /// The block whose step is under way.
    stepping: Option<At>,
    /// What happened in the block under way.
    events: u64,
}

impl Shown<'_, '_> {
    fn endless(&mut self, origin: Origin, head: At, state: &State<Abstract>) {
        let cx = FlowCx { origin, state, definitions: &self.definitions, solo: self.solo };
        self.observer.endless(&cx, head);
    }
}

impl Observer<Abstract> for Shown<'_, '_> {
    fn before(&mut self, origin: Origin, state: &State<Abstract>) {
        if self.stepping != Some(origin.at) {
            self.also.push(origin.at);
        }
        if !self.muted {
            let cx = FlowCx { origin, state, definitions: &self.definitions, solo: self.solo };
            self.observer.before(&cx);
        }
    }

    fn event(&mut self, origin: Origin, state: &State<Abstract>, event: &Event) {
        self.events += 1;
        self.definitions.see(origin.at, event, self.model);
        if !self.muted {
            let cx = FlowCx { origin, state, definitions: &self.definitions, solo: self.solo };
            self.observer.event(&cx, event);
        }
    }

    fn vacant_read(&mut self, origin: Origin, state: &State<Abstract>, variable: u32) {
        if !self.muted {
            let cx = FlowCx { origin, state, definitions: &self.definitions, solo: self.solo };
            self.observer.vacant_read(&cx, variable);
        }
    }

    fn after(&mut self, origin: Origin, state: &State<Abstract>) {
        if !self.muted {
            let cx = FlowCx { origin, state, definitions: &self.definitions, solo: self.solo };
            self.observer.after(&cx);
        }
    }
}
