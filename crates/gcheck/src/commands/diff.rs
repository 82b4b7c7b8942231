//! `gcheck diff`: do two programs make the machine do the same?
//!
//! Knows: that both run at once, each in a thread of its own, so that no run is ever kept whole. Must not know: when paths are
//! the same, how differences are worded.

pub(super) mod words;

use std::io::{self, Write};
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::{mem, thread};

use gcheck_engine::Units;
use gcheck_toolpath::{Act, Differences, Step, Trail, WorkCoordinates, compare};

use super::json as to_text;
use crate::args::{DiffOptions, ExecutionOptions, Global, ListFormat};
use crate::console::{FAILED, report, say};
use crate::execution::{self, Prepared, Steps};
use crate::{Problem, output};
use words::{Sides, Stopped};

/// The programs do different things.
const DIFFERENT: u8 = 1;
/// Acts that are handed over together, and how many such batches may wait.
const BATCH: usize = 1_024;
const WAITING: usize = 4;
/// Macros call each other; the main thread has as much.
const STACK: usize = 8 << 20;

/// Runs the command; the exit code is its result.
pub(crate) fn run(global: &Global, options: &DiffOptions) -> Result<u8, Problem> {
    let is_standard_input = |path: &Path| path.as_os_str() == "-";
    if is_standard_input(&options.a) && is_standard_input(&options.b) {
        return Err(Problem::new("both programs cannot come from standard input"));
    }
    let a = execution::prepare(global, &of_one(options, &options.a), execution::Start::Fresh)?;
    let second = Global {
        control: options.control_b.clone().or_else(|| global.control.clone()),
        config: global.config.clone(),
        isolated: global.isolated,
        color: global.color,
        quiet: global.quiet,
    };
    let b = execution::prepare(&second, &of_one(options, &options.b), execution::Start::Fresh)?;
    let (differences, ran_a, ran_b) = run_both(&a, &b, options.tolerance)?;
    // A run that was cut off because the paths had parted before ended nowhere of its own.
    let goes_on =
        differences.parting.as_ref().map_or([false; 2], |parting| parting.to.map(|to| to.is_some()));
    let [a_goes_on, b_goes_on] = goes_on;
    let units = ran_a.units;
    let faults = [ran_a.fault.filter(|_| !a_goes_on), ran_b.fault.filter(|_| !b_goes_on)];
    let sides = Sides { prepared: [&a, &b], units, tolerance: options.tolerance, faults: &faults };
    if !global.quiet && options.output_format == ListFormat::Text {
        say(&ran_a.control);
        say(&ran_b.control);
    }
    let text = match options.output_format {
        ListFormat::Text => sides.text(&differences),
        ListFormat::Json => to_text(&sides.json(&differences))?,
    };
    match &options.output_file {
        Some(file) => output::to_file(file, |out| out.write_all(text.as_bytes()))?,
        None => output::to_stdout(|out: &mut dyn Write| out.write_all(text.as_bytes()))?,
    }
    for fault in faults.iter().flatten() {
        report(&fault.problem);
    }
    Ok(match (faults.iter().any(Option::is_some), differences.is_same()) {
        (true, _) => FAILED,
        (false, true) => 0,
        (false, false) => DIFFERENT,
    })
}

fn of_one(options: &DiffOptions, file: &Path) -> ExecutionOptions {
    ExecutionOptions {
        file: file.to_owned(),
        stdin_filename: options.stdin_filename.clone(),
        set: options.set.clone(),
        block_skip: options.block_skip,
        optional_stop: options.optional_stop,
        fuel: options.fuel,
    }
}

/// What is known of a run when it is over.
struct Ran {
    control: String,
    fault: Option<Stopped>,
    /// Units of most moves.
    units: Units,
}

/// Executes both and compares what they do while they do it.
fn run_both(a: &Prepared, b: &Prepared, tolerance: f64) -> Result<(Differences, Ran, Ran), Problem> {
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
        let differences = compare(acts(acts_a), acts(acts_b), tolerance);
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
        let sender = Sender { trail, batch: Vec::with_capacity(BATCH), to, inch: 0, mm: 0 };
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
                Ran { control, fault, units }
            }
            Err(_) => Ran { control, fault: None, units },
        }
    })
}

/// Hands the acts of a run to who compares them.
struct Sender {
    trail: Trail,
    batch: Vec<Act>,
    to: SyncSender<Vec<Act>>,
    inch: u64,
    mm: u64,
}

impl Sender {
    fn hand_over(&mut self) -> io::Result<()> {
        let batch = mem::replace(&mut self.batch, Vec::with_capacity(BATCH));
        self.to.send(batch).map_err(|_| io::ErrorKind::BrokenPipe.into())
    }
}

impl Steps for Sender {
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
