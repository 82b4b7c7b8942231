//! From what the engine shows to what output takes: events become steps with line, units, feed and machine coordinates.
//!
//! Knows: which file and line an event belongs to. Must not know: formats, what the engine computes.

use std::io;
use std::panic::{self, AssertUnwindSafe};

use gcheck_engine::{
    Assumption, At, BlockLines, CallLines, Concrete, Event, Fault, Observer, Origin, RunResult, State, Stop,
    outline_cycle,
};
use gcheck_toolpath::{Beside, Spot, Step};

use super::session::Session;
use super::steps::Steps;

/// Watches a run and makes steps of its events.
pub(super) struct Bridge<'s, S> {
    session: &'s Session<'s>,
    steps: S,
    error: Option<io::Error>,
    /// Sequence number of the block being executed.
    executing: Option<u32>,
    /// The block being executed. An event of it that has no number was written by the control itself.
    executing_at: At,
    lines: BlockLines,
    calls: CallLines,
    /// The block being executed, where it is a cycle that moves along the outline in other blocks.
    cycle: Option<At>,
}

/// Unwinds through the engine when output has failed: there is nobody to execute for.
struct OutputFailed;

/// Runs, unless output fails on the way.
pub(super) fn stopping_at_errors(run: impl FnOnce() -> RunResult) -> Option<RunResult> {
    match panic::catch_unwind(AssertUnwindSafe(run)) {
        Ok(result) => Some(result),
        Err(payload) if payload.is::<OutputFailed>() => None,
        Err(payload) => panic::resume_unwind(payload),
    }
}

impl<'s, S: Steps> Bridge<'s, S> {
    pub(super) fn new(session: &'s Session<'s>, steps: S) -> Self {
        Self {
            session,
            steps,
            error: None,
            executing: None,
            executing_at: At { file: 0, block: 0 },
            lines: BlockLines::new(&session.prepared.shown),
            calls: CallLines::default(),
            cycle: None,
        }
    }

    /// What the run left; the error is that of the output.
    pub(super) fn finish(self, ran: Option<RunResult>) -> io::Result<(RunResult, S)> {
        match (ran, self.error) {
            (Some(result), None) => Ok((result, self.steps)),
            (_, Some(error)) => Err(error),
            (None, None) => Err(io::ErrorKind::Other.into()),
        }
    }
}

impl<S: Steps> Observer<Concrete> for Bridge<'_, S> {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        self.executing = origin.n;
        self.executing_at = origin.at;
        self.steps.block(origin, state);
        self.cycle = outline_cycle(self.session.program, self.session.model, origin);
    }

    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        if !S::AS_INTERPRETED
            && matches!(event, Event::Stop(Stop::Optional))
            && !self.session.prepared.options.optional_stop
        {
            return;
        }
        let model = self.session.model;
        let (file, line) = self.lines.of(self.session.program, origin);
        let n = if S::AS_INTERPRETED && (origin.n.is_some() || origin.at != self.executing_at) {
            self.executing
        } else {
            origin.n
        };
        let spot = Spot { file: &file, line, n };
        let units = self.session.prepared.equipment.units;
        let machine = &self.session.prepared.equipment.machine;
        let seen = Step::seen(event, state, model, machine, spot, units);
        let cycle = self.cycle.filter(|cycle| *cycle != origin.at);
        let calls = self.calls.of(self.session.program, &mut self.lines, state, cycle);
        let step = Step { beside: Beside::of(state, machine, event), calls, ..seen };
        if let Err(error) = self.steps.step(&step) {
            self.error = Some(error);
            panic::resume_unwind(Box::new(OutputFailed));
        }
    }

    fn fault(&mut self, origin: Origin, _: &State<Concrete>, fault: &Fault) {
        let (file, line) = self.lines.of(self.session.program, origin);
        if let Err(error) = self.steps.alarm(&file, line, fault) {
            self.error = Some(error);
            panic::resume_unwind(Box::new(OutputFailed));
        }
    }

    fn assumed(&mut self, origin: Origin, assumption: &Assumption) {
        if let Some(words) = gcheck_lint::in_picture(assumption, self.session.model) {
            let (file, line) = self.lines.of(self.session.program, origin);
            self.steps.assumed(&file, line, &words);
        }
    }
}
