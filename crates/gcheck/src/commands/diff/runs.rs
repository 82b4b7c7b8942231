//! Two programs run at once, each in a thread of its own, so that no run is ever kept whole.
//!
//! Knows: threads, how acts are handed over. Must not know: when paths are the same, how differences are worded.

use std::io;
use std::iter::Flatten;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{IntoIter, Receiver, SyncSender, sync_channel};
use std::{mem, thread};

use gcheck_engine::{Assumption, Concrete, Origin, State, Units};
use gcheck_report::LineIndex;
use gcheck_toolpath::{
    Act, Differences, Marks, Outline, Place, Rest, Sections, Step, Title, Trail, WorkCoordinates, compare,
};

use super::left_out::{self, Executions, LeftOut, NotCompared};
use super::words::{Sides, Stopped};
use crate::Problem;
use crate::args::{DiffOptions, Global};
use crate::execution::{self, Prepared, Session, Steps};
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
    /// How numbers count that say it themselves in no program: what the verdict rests on.
    pub(super) assumed: Vec<String>,
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

/// Executes both and compares what they do while they do it. Where their paths part, both run again, and their sections are
/// compared one by one.
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
    let tolerance = options.tolerance;
    let mut outlines = [Outline::of_tools(), Outline::of_tools()];
    let (mut differences, ran_a, ran_b) = run_both(&a, &b, |acts_a, acts_b| {
        let [of_a, of_b] = &mut outlines;
        let mut acts_a = acts_a.inspect(|act| of_a.add(act));
        let mut acts_b = acts_b.inspect(|act| of_b.add(act));
        let differences = compare(&mut acts_a, &mut acts_b, tolerance, rest);
        // What is not compared is for the outlines.
        acts_a.for_each(drop);
        acts_b.for_each(drop);
        differences
    })?;
    if differences.parting.is_some()
        && [&ran_a, &ran_b].iter().all(|ran| ran.fault.is_none())
        && let Some(sections) = sections([&a, &b], outlines, tolerance, rest)?
    {
        differences = sections.begun();
        for pass in 0..sections.passes() {
            run_both(&a, &b, |acts_a, acts_b| sections.compare(pass, acts_a, acts_b, &mut differences))?;
        }
    }
    // A run that was cut off because the paths had parted before ended nowhere of its own.
    let [a_is_left, b_is_left] = differences.left_alone();
    let faults = [ran_a.fault.filter(|_| !a_is_left), ran_b.fault.filter(|_| !b_is_left)];
    let is_whole = !differences.is_cut_short() && faults.iter().all(Option::is_none);
    let left_out = [ran_a.left_out, ran_b.left_out];
    Ok(Compared {
        left_out: if is_whole { left_out::not_compared(&left_out) } else { Vec::new() },
        faults,
        assumed: {
            let mut all: Vec<String> = [ran_a.rests, ran_b.rests].into_iter().flatten().collect();
            all.dedup();
            all
        },
        controls: [ran_a.control, ran_b.control],
        units: ran_a.units,
        tolerance,
        prepared: [a, b],
        differences,
    })
}

/// How the sections of two programs are compared, if they have any: tool sections, or what their comments call operations where
/// no program changes the tool more than once.
fn sections(
    prepared: [&Prepared; 2],
    mut outlines: [Outline; 2],
    tolerance: f64,
    rest: Rest,
) -> Result<Option<Sections>, Problem> {
    if outlines.iter().all(|outline| outline.len() <= 1) {
        let marks = prepared.map(|prepared| prepared.session(marks));
        if marks.iter().any(Marks::is_empty) {
            return Ok(None);
        }
        outlines = marks.map(Outline::of_operations);
        let [a, b] = prepared;
        let [of_a, of_b] = &mut outlines;
        run_both(a, b, |acts_a, acts_b| {
            acts_a.for_each(|act| of_a.add(&act));
            acts_b.for_each(|act| of_b.add(&act));
        })?;
    } else {
        for (prepared, outline) in prepared.into_iter().zip(&mut outlines) {
            prepared.session(|session| {
                let marks = lines(session);
                outline.name(|title, after, first| name(session, &marks, title, after, first));
            });
        }
    }
    Ok(Sections::new(outlines, tolerance, rest))
}

/// Where the comments of a program name what follows: lines, and names.
fn lines(session: &Session<'_>) -> Vec<(u32, String)> {
    let text = session.prepared.source.text();
    let index = LineIndex::new(text);
    session.headings.iter().map(|heading| (index.line(heading.from), heading.name.clone())).collect()
}

fn marks(session: &Session<'_>) -> Marks {
    Marks::new(&session.prepared.shown, lines(session))
}

/// What a program calls a section: by the last comment above its first block, else what it calls the tool.
fn name(
    session: &Session<'_>,
    marks: &[(u32, String)],
    title: &Title,
    after: u32,
    first: &Place,
) -> Option<String> {
    let Title::Tool(tool) = title else { return None };
    let above = || {
        let (_, name) = marks.iter().rfind(|(line, _)| *line > after && *line <= first.line)?;
        (*first.file == *session.prepared.shown).then(|| name.clone())
    };
    above().or_else(|| session.tool_name((*tool)?))
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
    /// How numbers without decimal point count, where nobody told and the run has some.
    rests: Option<String>,
}

/// Runs both; `with` gets their acts.
fn run_both<T>(
    a: &Prepared,
    b: &Prepared,
    with: impl FnOnce(Acts, Acts) -> T,
) -> Result<(T, Ran, Ran), Problem> {
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
        let made = with(acts(acts_a), acts(acts_b));
        let end = |run: thread::ScopedJoinHandle<'_, Ran>, prepared: &Prepared| {
            run.join().map_err(|payload| Problem::own_mistake(payload.as_ref()).in_file(&prepared.path))
        };
        Ok((made, end(run_a, a)?, end(run_b, b)?))
    })
}

/// The acts of a run.
type Acts = Flatten<IntoIter<Vec<Act>>>;

fn acts(batches: Receiver<Vec<Act>>) -> Acts {
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
                let unpointed = Assumption::UnpointedNumbers;
                let rests = ran
                    .assumptions
                    .contains(&unpointed)
                    .then(|| gcheck_lint::describe(&unpointed, session.model).text);
                Ran { control, fault, units, left_out: sender.executions.left_out(), rests }
            }
            Err(_) => Ran { control, fault: None, units, left_out: LeftOut::default(), rests: None },
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
