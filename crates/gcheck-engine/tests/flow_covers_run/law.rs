//! Runs of a program beside the analysis of all its paths.
//!
//! Knows: what of a run the analysis must have shown. Must not know: where programs come from.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Write as _;

use gcheck_controls::Control;
use gcheck_engine::{
    Abstract, At, Concrete, Ending, Event, Fault, FlowCx, FlowObserver, FlowResult, Lattice, Library, Look,
    Machine, Model, Observer, Options, Origin, Program, Reach, RunResult, State, Stopped, Task, flow, run,
};
use gcheck_program::{BlockFlags, Dialect, Loaded};

use crate::draw::{Random, draw};

/// A program with what is told of its machine.
pub(crate) struct Case<'a> {
    pub(crate) name: &'a str,
    pub(crate) control: &'a str,
    pub(crate) text: &'a str,
    /// What the analysis is told; a run is told as much, and draws the rest.
    pub(crate) machine: &'a Machine,
    pub(crate) library: &'a dyn Library,
    /// The work of the analysis, in blocks.
    pub(crate) work: u64,
    /// How many blocks a run executes at most.
    pub(crate) fuel: u64,
}

/// What was compared.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Counts {
    pub(crate) programs: u64,
    /// Programs whose analysis was given up or was too large to be kept. The law does not judge them.
    pub(crate) left_out: u64,
    pub(crate) runs: u64,
    /// Runs that came to an end of the program.
    pub(crate) ended: u64,
    pub(crate) states: u64,
    pub(crate) moves: u64,
    /// Everything else that happened.
    pub(crate) others: u64,
    /// Moves and what belongs to them in blocks of which the analysis says that it does not follow them.
    pub(crate) unfollowed: u64,
    /// Faults and alarms that the analysis showed.
    pub(crate) faults: u64,
    /// Faults of values that the analysis does not know: on other values there is none, so it says nothing.
    pub(crate) faults_by_value: u64,
}

impl Counts {
    pub(crate) fn add(&mut self, other: Self) {
        let Self {
            programs,
            left_out,
            runs,
            ended,
            states,
            moves,
            others,
            unfollowed,
            faults,
            faults_by_value,
        } = other;
        self.programs += programs;
        self.left_out += left_out;
        self.runs += runs;
        self.ended += ended;
        self.states += states;
        self.moves += moves;
        self.others += others;
        self.unfollowed += unfollowed;
        self.faults += faults;
        self.faults_by_value += faults_by_value;
    }
}

/// States and events of the analysis that are kept of one program.
const MOST_KEPT: usize = 40_000;

/// What the analysis shows, by block.
#[derive(Default)]
struct Shown {
    states: HashMap<At, Vec<State<Abstract>>>,
    events: HashMap<At, Vec<Event>>,
    faults: HashMap<At, Vec<Fault>>,
    endings: HashMap<At, Vec<Ending>>,
    kept: usize,
}

impl FlowObserver for Shown {
    fn before(&mut self, cx: &FlowCx<'_>) {
        let states = self.states.entry(cx.origin.at).or_default();
        if states.last() != Some(cx.state) {
            states.push(cx.state.clone());
            self.kept += 1;
        }
    }

    fn event(&mut self, cx: &FlowCx<'_>, event: &Event) {
        let events = self.events.entry(cx.origin.at).or_default();
        if events.last().is_none_or(|last| !last.covers(event)) {
            events.push(event.clone());
            self.kept += 1;
        }
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.faults.entry(cx.origin.at).or_default().push(fault.clone());
    }

    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        self.endings.entry(cx.origin.at).or_default().push(ending);
    }

    fn stops(&mut self) -> bool {
        self.kept > MOST_KEPT
    }
}

/// Moves are compared by kind and place, everything else by kind: what it leaves is part of the state.
fn stands_for(outer: &Event, inner: &Event) -> bool {
    if is_move(inner) {
        outer.covers(inner)
    } else {
        std::mem::discriminant(outer) == std::mem::discriminant(inner)
    }
}

/// Says what is in effect from then on, which the state holds; or that the run itself does not follow its block.
fn is_announcement(event: &Event) -> bool {
    matches!(
        event,
        Event::Modal(_)
            | Event::FeedRate(_)
            | Event::KnownWay(_)
            | Event::WorkOffset { .. }
            | Event::Shift(_)
            | Event::LengthOffset(_)
            | Event::Rotation(_)
            | Event::Spindle(_)
            | Event::Coolant { .. }
            | Event::Unfollowed
    )
}

fn is_move(event: &Event) -> bool {
    matches!(event, Event::Travel(_) | Event::Arc(_) | Event::Curve(_) | Event::RigidTap { .. })
}

/// What the analysis does not cover.
struct Gap {
    at: At,
    why: String,
}

/// Goes along with a run, and compares.
struct Follower<'s> {
    shown: &'s Shown,
    result: &'s FlowResult,
    /// By block, which state covered the last time: the next one is likely to cover the next time.
    cursors: HashMap<At, usize>,
    visited: BTreeSet<At>,
    /// The last state before each block.
    last: HashMap<At, State<Abstract>>,
    counts: Counts,
    gap: Option<Gap>,
}

impl Follower<'_> {
    fn lacks(&mut self, at: At, why: String) {
        self.gap.get_or_insert(Gap { at, why });
    }
}

impl Observer<Concrete> for Follower<'_> {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        if self.gap.is_some() {
            return;
        }
        let at = origin.at;
        self.visited.insert(at);
        self.counts.states += 1;
        if self.result.reach(at) == Reach::Never {
            return self.lacks(at, "visited, and said to be unreachable".to_owned());
        }
        let lifted = state.as_covered();
        let states = self.shown.states.get(&at).map(Vec::as_slice).unwrap_or_default();
        let cursor = self.cursors.entry(at).or_default();
        let (before, from) = states.split_at((*cursor).min(states.len()));
        match from.iter().chain(before).position(|outer| outer.covers(&lifted)) {
            Some(found) => *cursor = (*cursor + found) % states.len(),
            None => {
                let why = states.iter().map(|outer| outer.uncovered(&lifted)).min_by_key(String::len);
                self.lacks(at, why.unwrap_or_else(|| "never shown".to_owned()));
            }
        }
        self.last.insert(at, state.as_abstract());
    }

    fn event(&mut self, origin: Origin, _: &State<Concrete>, event: &Event) {
        if self.gap.is_some() {
            return;
        }
        if is_announcement(event) {
            return;
        }
        *(if is_move(event) { &mut self.counts.moves } else { &mut self.counts.others }) += 1;
        let events = self.shown.events.get(&origin.at).map(Vec::as_slice).unwrap_or_default();
        if events.iter().any(|outer| stands_for(outer, event)) {
            return;
        }
        if events.contains(&Event::Unfollowed) {
            self.counts.unfollowed += 1;
        } else {
            let like: Vec<_> =
                events.iter().filter(|outer| is_move(outer) == is_move(event)).take(4).collect();
            self.lacks(origin.at, format!("not shown: {event:?}\nshown: {like:#?}"));
        }
    }

    fn stops(&mut self) -> bool {
        self.gap.is_some()
    }
}

/// Runs a case so often, and compares each run with the analysis.
pub(crate) fn check(case: &Case<'_>, runs: u32, random: &mut Random) -> Result<Counts, String> {
    let control = control(case.control);
    let dialect = Dialect::new(control);
    let model = Model::new(control);
    let loaded = Loaded::new(case.text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, case.library);
    let mut counts = Counts { programs: 1, ..Counts::default() };
    let skips: &[Options] =
        if case.text.contains('/') { &[Options::NONE, Options::SKIP_ALL] } else { &[Options::NONE] };
    for options in skips {
        let mut shown = Shown::default();
        let task = Task { options: *options, ..Task::all_paths(case.work) };
        let result = flow(&program, &model, case.machine, task, &mut shown);
        if result.is_incomplete() || shown.kept > MOST_KEPT {
            counts.left_out = 1;
            continue;
        }
        for _ in 0..runs {
            let machine = draw(case.machine, case.text, random);
            let mut follower = Follower {
                shown: &shown,
                result: &result,
                cursors: HashMap::new(),
                visited: BTreeSet::new(),
                last: HashMap::new(),
                counts: Counts::default(),
                gap: None,
            };
            let options = Options { optional_stop: random.once_in(2), ..*options };
            let ran = run(&program, &model, &machine, options, case.fuel, &mut follower);
            let mut look = Look::new(&program, &model, &machine);
            if follower.gap.is_none() {
                finish(&mut follower, &ran, &mut look);
            }
            if let Some(gap) = follower.gap {
                let faults: Vec<_> =
                    shown.faults.iter().map(|(at, faults)| (at.file, at.block, faults)).collect();
                return Err(listing(case, &gap, &machine, options) + &format!("faults {faults:?}\n"));
            }
            counts.add(Counts { runs: 1, ..follower.counts });
        }
    }
    Ok(counts)
}

/// How the run stopped must be seen, and no block may be missed that every path comes to.
fn finish(follower: &mut Follower<'_>, ran: &RunResult, look: &mut Look<'_, '_>) {
    let at = ran.origin.at;
    match &ran.stopped {
        Stopped::Ended(ending) => {
            follower.counts.ended += 1;
            if !follower.shown.endings.get(&at).is_some_and(|endings| endings.contains(ending)) {
                follower.lacks(at, format!("ends, and no end was shown: {ending:?}"));
            }
            let Some(file) = look.program().file(0) else { return };
            for block in 0..file.loaded.flow_graph().blocks() {
                let at = At { file: 0, block };
                // A block that is skipped is come to, though not executed; so is the end of the tape.
                let silent = BlockFlags::BLOCK_DELETE | BlockFlags::TAPE_MARK;
                let place = file.loaded.place(block, look.program().dialect());
                let is_executed = place.is_some_and(|place| !place.block().flags.intersects(silent));
                if follower.result.reach(at) == Reach::Always
                    && !follower.visited.contains(&at)
                    && is_executed
                {
                    follower.lacks(at, "said to be on every path, and not visited".to_owned());
                }
            }
        }
        // A condition on what nobody knows: the analysis goes both ways.
        Stopped::OutOfFuel | Stopped::Faulted(Fault::Undecidable) => {}
        Stopped::Faulted(fault) => {
            let is_shown = |shown: &Vec<Fault>| shown.contains(fault);
            if follower.shown.faults.get(&at).is_some_and(is_shown) {
                follower.counts.faults += 1;
                return;
            }
            // On the run's own values the analysis must see it; where it sees more values than that, some of them may be right.
            let by_value = follower.last.remove(&at).is_some_and(|lifted| {
                let states = follower.shown.states.get(&at).map(Vec::as_slice).unwrap_or_default();
                look.execute(at, &lifted).fault.as_ref() == Some(fault) && !states.contains(&lifted)
            });
            if by_value {
                follower.counts.faults_by_value += 1;
            } else {
                let shown = follower.shown.faults.get(&at);
                follower.lacks(at, format!("not shown: {fault:?}\nshown: {shown:?}"));
            }
        }
    }
}

fn listing(case: &Case<'_>, gap: &Gap, machine: &Machine, options: Options) -> String {
    let Machine { guesses, start, fresh, .. } = machine;
    let mut listing = format!(
        "{} ({}), block {} of file {}: {}\n{guesses:?}, start {start:?}, fresh {fresh}, skip {}\n",
        case.name, case.control, gap.at.block, gap.at.file, gap.why, options.skip
    );
    let first = (gap.at.block as usize).saturating_sub(40);
    for (number, line) in case.text.lines().enumerate().skip(first).take(60) {
        let mark = if number as u32 == gap.at.block { '>' } else { ' ' };
        let _ = writeln!(listing, "{mark} {number:3} {line}");
    }
    listing
}

/// A control, loaded once on a thread.
fn control(name: &str) -> &'static Control {
    thread_local! {
        static CONTROLS: std::cell::RefCell<HashMap<String, &'static Control>> = std::cell::RefCell::default();
    }
    CONTROLS.with_borrow_mut(|controls| {
        *controls
            .entry(name.to_owned())
            .or_insert_with(|| Box::leak(Box::new(gcheck_controls::load(name).unwrap())))
    })
}
