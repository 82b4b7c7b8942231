//! The proof of a change: the moves of two runs, compared while both run.
//!
//! Knows: threads, the words for a proof that failed. Must not know: what a change claims, when moves are the same.

use std::mem;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use gcheck_edit::{Change, Holder, Refusal, Scope, expected, hold, is_as_claimed, plainly};
use gcheck_engine::{Options, RunResult, Units};
use gcheck_syntax::SourceText;
use gcheck_toolpath::{Act, Differences};

use super::refusing::problem;
use crate::Problem;
use crate::commands::diff::words::Sides;
use crate::execution::{self, Prepared, Session};

/// Acts that are handed over together, and how many such batches may wait.
const BATCH: usize = 1_024;
const WAITING: usize = 4;

/// What was proved.
pub(super) struct Proof {
    /// Pieces of path that were compared.
    pub(super) moves: u64,
    /// How often the program ran.
    pub(super) runs: usize,
}

/// What is to be proved.
pub(super) struct Asked<'a> {
    pub(super) change: &'a Change,
    pub(super) scope: &'a Scope,
    /// Millimetres.
    pub(super) tolerance: f64,
    /// In which messages show lengths.
    pub(super) units: Units,
    /// Unknown places of the machine were put somewhere.
    pub(super) assumes_places: bool,
}

/// Compares the runs of a program before and after a change.
///
/// # Errors
/// The moves are not as the change says, or a run does not come to its end.
pub(super) fn prove(
    before: &Prepared,
    after: &[u8],
    asked: &Asked<'_>,
    runs: &[Options],
) -> Result<Proof, Problem> {
    let change = asked.change;
    let shown = format!("{} (changed)", before.shown);
    let after = before.with_text(text(before, after.to_vec())?, shown);
    let mut moves = 0;
    for options in runs {
        let (differences, Ran { refusal, faults }) = held(before, &after, asked, *options)?;
        if let Some(refusal) = refusal {
            return Err(problem(before, change, &refusal));
        }
        // A run that was cut off because the paths had parted before ended nowhere of its own.
        let left_alone = differences.left_alone();
        let fault = faults.into_iter().zip(left_alone).find_map(|(fault, left)| fault.filter(|_| !left));
        if fault.is_none() && !is_as_claimed(change, &differences) {
            return Err(different(before, &after, asked, &differences));
        }
        if let Some(fault) = fault {
            return Err(fault.note(format!(
                "nothing is proved of a run that ends early, so gcheck cannot {}",
                change.verb()
            )));
        }
        if differences.unknown {
            let message = format!(
                "cannot {}: a cut starts or ends at a coordinate that is not known, so nothing is proved of it",
                change.verb()
            );
            return Err(Problem::with_file(&before.path, message)
                .help("let the program give X, Y and Z before it cuts"));
        }
        if let Some([of_promise, of_run]) = &differences.half_known {
            let message = format!(
                "cannot {}: where the move of line {} ends is known in one run only, before the change or after it (there line {})",
                change.verb(),
                of_promise.line,
                of_run.line
            );
            return Err(Problem::with_file(&before.path, message)
                .help("give X, Y and Z in the program before this move, or the tool lengths and work offsets in `gcheck.toml`"));
        }
        moves = differences.moves.max(moves);
    }
    Ok(Proof { moves, runs: runs.len() })
}

/// The proof failed: the first differences, each with its lines.
fn different(before: &Prepared, after: &Prepared, asked: &Asked<'_>, differences: &Differences) -> Problem {
    let (units, tolerance) = (asked.units, asked.tolerance);
    let sides = Sides { prepared: [before, after], units, tolerance, faults: &[None, None], left_out: &[] };
    let text = sides.text(differences);
    let mut lines: Vec<&str> = text.lines().collect();
    // The verdict is ours to say.
    lines.retain(|line| line.starts_with(' ') || !line.contains(" (changed) "));
    let message = format!("cannot {}: the proof failed\n{}", asked.change.verb(), lines.join("\n"));
    let problem = Problem::with_file(&before.path, message);
    let problem = match asked.change {
        Change::Convert(Units::Inch) => {
            problem.help("the last digit of an inch is 0.00254 mm, and roundings of increments and arcs add up: `--tolerance` allows more")
        }
        Change::MoveSection(_) => {
            problem.help("let the section give all that it needs after its tool change: work offset, length, modes, feed, speed and a first point")
        }
        _ => problem,
    };
    let problem = if asked.assumes_places {
        problem.note("work offsets, tool lengths and the start are not known, so the coordinates of places of the machine (`G53`, `G28`) are made up for the proof")
    } else {
        problem
    };
    problem.note("`-` is what the change promises, `+` is what the changed program does")
}

/// What two runs came to, beside their acts.
#[derive(Default)]
struct Ran {
    /// Why the acts cannot be told in advance.
    refusal: Option<Refusal>,
    /// Why a run did not come to its end.
    faults: [Option<Problem>; 2],
}

/// Runs both and compares what they do while they do it.
fn held(
    before: &Prepared,
    after: &Prepared,
    asked: &Asked<'_>,
    options: Options,
) -> Result<(Differences, Ran), Problem> {
    let mut ran = Ran::default();
    let mut both = |with: Holder<'_>| {
        ran = run_both(before, after, asked, options, with)?;
        Ok(())
    };
    let differences = hold(asked.change, asked.tolerance, &mut both)?;
    Ok((differences, ran))
}

/// Runs both; `with` gets their acts.
fn run_both(
    before: &Prepared,
    after: &Prepared,
    asked: &Asked<'_>,
    options: Options,
    with: Holder<'_>,
) -> Result<Ran, Problem> {
    let Asked { change, scope, .. } = *asked;
    thread::scope(|scope_of_threads| {
        let (sender, promised) = sync_channel(WAITING);
        let start = || thread::Builder::new().stack_size(crate::threads::STACK);
        let failed = |error: std::io::Error| Problem::new(format!("cannot start a thread: {error}"));
        let first = start()
            .spawn_scoped(scope_of_threads, move || {
                before.session(|session| {
                    let mut sending = Sending::new(&before.shown, sender);
                    let ran = expected(
                        change,
                        scope,
                        session.program,
                        session.model,
                        &before.equipment.machine,
                        options,
                        before.fuel(),
                        &mut |act| sending.send(act),
                    );
                    sending.hand_over();
                    (ran.refusal, fault(session, &ran.result))
                })
            })
            .map_err(failed)?;
        let (sender, made) = sync_channel(WAITING);
        let second = start()
            .spawn_scoped(scope_of_threads, move || {
                after.session(|session| {
                    let mut sending = Sending::new(&after.shown, sender);
                    let ran = plainly(
                        session.program,
                        session.model,
                        &after.equipment.machine,
                        options,
                        after.fuel(),
                        &mut |act| sending.send(act),
                    );
                    sending.hand_over();
                    fault(session, &ran)
                })
            })
            .map_err(failed)?;
        {
            // With the receivers goes the reason to run on.
            let (mut promised, mut made) = (acts(promised), acts(made));
            with(&mut promised, &mut made);
        }
        let panicked = |payload: Box<dyn std::any::Any + Send>| {
            Problem::own_mistake(payload.as_ref()).in_file(&before.path)
        };
        let (refusal, first) = first.join().map_err(panicked)?;
        let second = second.join().map_err(panicked)?;
        Ok(Ran { refusal, faults: [first, second] })
    })
}

fn fault(session: &Session<'_>, ran: &RunResult) -> Option<Problem> {
    execution::fault_of(session, ran).map(|fault| execution::problem_of(&fault))
}

fn acts(batches: Receiver<Vec<Act>>) -> impl Iterator<Item = Act> {
    batches.into_iter().flatten()
}

/// Hands the acts of a run to who compares them.
struct Sending {
    /// What messages call the program.
    shown: Arc<str>,
    batch: Vec<Act>,
    to: SyncSender<Vec<Act>>,
}

impl Sending {
    fn new(shown: &str, to: SyncSender<Vec<Act>>) -> Self {
        Self { shown: Arc::from(shown), batch: Vec::with_capacity(BATCH), to }
    }

    /// Takes an act; `false` when nobody listens any more.
    fn send(&mut self, mut act: Act) -> bool {
        if act.file.is_empty() {
            act.file = Arc::clone(&self.shown);
        }
        self.batch.push(act);
        self.batch.len() < BATCH || self.hand_over()
    }

    fn hand_over(&mut self) -> bool {
        let batch = mem::replace(&mut self.batch, Vec::with_capacity(BATCH));
        self.to.send(batch).is_ok()
    }
}

/// The changed program as text.
fn text(prepared: &Prepared, bytes: Vec<u8>) -> Result<SourceText, Problem> {
    SourceText::from_bytes(bytes)
        .map_err(|_| Problem::with_file(&prepared.path, "would become larger than 4 GiB"))
}
