//! Two programs run at once, each in a thread of its own, so that no run is ever kept whole.
//!
//! Knows: threads, how acts are handed over. Must not know: when paths are the same, how differences are worded.

use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::{mem, thread};

use gcheck_engine::{Concrete, Origin, State, Units};
use gcheck_toolpath::{Act, Differences, Rest, Step, Trail, WorkCoordinates, compare};

use super::left_out::{self, Executions, LeftOut, NotCompared};
use super::words::{Sides, Stopped};
use crate::Problem;
use crate::args::{DiffOptions, Global};
use crate::execution::{self, Prepared, Steps};
use crate::programs::ProgramFolders;

/// Acts that are handed over together, and how many such batches may wait.
const BATCH: usize = 1_024;
const WAITING: usize = 4;
/// Macros call each other; the main thread has as much.
const STACK: usize = 8 << 20;

/// Two programs that were compared.
pub(super) struct Compared {
    pub(super) prepared: [Prepared; 2],
    pub(super) differences: Differences,
    /// Commands that are not compared and that the programs do not have alike; nothing where a run was cut off.
    pub(super) left_out: Vec<NotCompared>,
    /// Why a run did not come to its end, as far as that counts.
    pub(super) faults: [Option<Stopped>; 2],
    /// Which control reads each, in words.
    pub(super) controls: [String; 2],
    units: Units,
    /// Millimetres.
    tolerance: f64,
}

impl Compared {
    /// For words about the differences.
    pub(super) fn sides(&self) -> Sides<'_> {
        let [a, b] = &self.prepared;
        Sides {
            prepared: [a, b],
            units: self.units,
            tolerance: self.tolerance,
            faults: &self.faults,
            left_out: &self.left_out,
        }
    }

    /// Was everything compared that the programs do not have alike?
    pub(super) fn is_all_known(&self) -> bool {
        !self.differences.unknown && self.left_out.is_empty()
    }

    /// Do both come to their end, and make the machine do the same?
    pub(super) fn is_same(&self) -> bool {
        !self.has_fault() && self.differences.is_same()
    }

    /// Does a program stop before its end? Then nothing can be concluded.
    pub(super) fn has_fault(&self) -> bool {
        self.faults.iter().any(Option::is_some)
    }
}

/// Executes both and compares what they do while they do it.
///
/// # Errors
/// A program, or what is in force for it, cannot be read.
pub(super) fn both(
    global: &Global,
    options: &DiffOptions,
    files: [&Path; 2],
    folders: &Arc<ProgramFolders>,
    rest: Rest,
) -> Result<Compared, Problem> {
    let [a, b] = prepared(global, options, files, folders)?;
    let (differences, ran_a, ran_b) = run_both(&a, &b, options.tolerance, rest)?;
    // A run that was cut off because the paths had parted before ended nowhere of its own.
    let [a_is_left, b_is_left] = differences.left_alone();
    let faults = [ran_a.fault.filter(|_| !a_is_left), ran_b.fault.filter(|_| !b_is_left)];
    let is_whole = !differences.is_cut_short() && faults.iter().all(Option::is_none);
    let left_out = [ran_a.left_out, ran_b.left_out];
    Ok(Compared {
        left_out: if is_whole { left_out::not_compared(&left_out) } else { Vec::new() },
        faults,
        controls: [ran_a.control, ran_b.control],
        units: ran_a.units,
        tolerance: options.tolerance,
        prepared: [a, b],
        differences,
    })
}

/// Both programs, ready to run.
///
/// # Errors
/// A program, or what is in force for it, cannot be read.
pub(super) fn prepared(
    global: &Global,
    options: &DiffOptions,
    [a, b]: [&Path; 2],
    folders: &Arc<ProgramFolders>,
) -> Result<[Prepared; 2], Problem> {
    let prepare = |global: &Global, path: &Path| {
        let prepared = execution::prepare(global, &options.conditions.of(path), execution::Start::Fresh)?;
        Ok::<_, Problem>(prepared.among(Arc::clone(folders)))
    };
    let second = Global {
        control: options.control_b.clone().or_else(|| global.control.clone()),
        config: global.config.clone(),
        isolated: global.isolated,
        color: global.color,
        quiet: global.quiet,
    };
    Ok([prepare(global, a)?, prepare(&second, b)?])
}

/// What is known of a run when it is over.
struct Ran {
    control: String,
    fault: Option<Stopped>,
    /// Units of most moves.
    units: Units,
    left_out: LeftOut,
}

fn run_both(
    a: &Prepared,
    b: &Prepared,
    tolerance: f64,
    rest: Rest,
) -> Result<(Differences, Ran, Ran), Problem> {
    thread::scope(|scope| {
        let start = |prepared| {
            let (sender, receiver) = sync_channel(WAITING);
            let run = thread::Builder::new()
                .stack_size(STACK)
                .spawn_scoped(scope, move || run_one(prepared, sender))
                .map_err(|error| Problem::new(format!("cannot start a thread: {error}")))?;
            Ok::<_, Problem>((run, receiver))
        };
        let (run_a, acts_a) = start(a)?;
        let (run_b, acts_b) = start(b)?;
        // With the receivers goes the reason to run on.
        let differences = compare(acts(acts_a), acts(acts_b), tolerance, rest);
        let end = |run: thread::ScopedJoinHandle<'_, Ran>, prepared: &Prepared| {
            run.join().map_err(|payload| Problem::own_mistake(payload.as_ref()).in_file(&prepared.path))
        };
        Ok((differences, end(run_a, a)?, end(run_b, b)?))
    })
}

fn acts(batches: Receiver<Vec<Act>>) -> impl Iterator<Item = Act> {
    batches.into_iter().flatten()
}

fn run_one(prepared: &Prepared, to: SyncSender<Vec<Act>>) -> Ran {
    prepared.session(|session| {
        let trail = Trail::new(WorkCoordinates::at_power_on(session.model, &prepared.equipment.machine));
        let sender = Sender {
            trail,
            batch: Vec::with_capacity(BATCH),
            to,
            inch: 0,
            mm: 0,
            executions: Executions::new(session),
        };
        let control = execution::control_line(session);
        let units = prepared.equipment.units;
        match session.run(sender) {
            Ok((ran, mut sender)) => {
                // Nobody listens where the paths have parted.
                let _ = sender.hand_over();
                let units = match sender.inch.cmp(&sender.mm) {
                    std::cmp::Ordering::Less => Units::Mm,
                    std::cmp::Ordering::Equal => units,
                    std::cmp::Ordering::Greater => Units::Inch,
                };
                let fault = execution::fault_of(session, &ran).map(|fault| {
                    let problem = execution::problem_of(&fault);
                    Stopped { message: fault.words.message, problem }
                });
                Ran { control, fault, units, left_out: sender.executions.left_out() }
            }
            Err(_) => Ran { control, fault: None, units, left_out: LeftOut::default() },
        }
    })
}

/// Hands the acts of a run to who compares them.
struct Sender<'s> {
    trail: Trail,
    batch: Vec<Act>,
    to: SyncSender<Vec<Act>>,
    inch: u64,
    mm: u64,
    executions: Executions<'s>,
}

impl Sender<'_> {
    fn hand_over(&mut self) -> io::Result<()> {
        let batch = mem::replace(&mut self.batch, Vec::with_capacity(BATCH));
        self.to.send(batch).map_err(|_| io::ErrorKind::BrokenPipe.into())
    }
}

impl Steps for Sender<'_> {
    fn block(&mut self, origin: Origin, state: &State<Concrete>) {
        self.executions.count(origin, state);
    }

    fn step(&mut self, step: &Step<'_>) -> io::Result<()> {
        match step.units {
            Units::Inch => self.inch += 1,
            Units::Mm => self.mm += 1,
        }
        let batch = &mut self.batch;
        self.trail.add(step, |act| batch.push(act));
        if self.batch.len() >= BATCH { self.hand_over() } else { Ok(()) }
    }
}
