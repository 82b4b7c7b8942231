//! The acts that a program must make after a change: those of a run before it, changed as it claims.
//!
//! Knows: runs. Must not know: text, how acts are compared.

use gcheck_engine::{At, Machine, Model, Options, Program, RunResult};
use gcheck_toolpath::Act;

use crate::change::Change;
use crate::refusal::Refusal;
use crate::run::{Executed, Visitor, run};
use crate::scope::Scope;
use crate::witness::Tracker;

/// What a run came to.
#[derive(Debug)]
pub struct Expected {
    /// How it ended.
    pub result: RunResult,
    /// Why the acts cannot be told in advance.
    pub refusal: Option<Refusal>,
}

/// Runs a program and hands on its acts as they must be after a change of some blocks; `emit` says whether it wants more.
#[expect(clippy::too_many_arguments, reason = "what a run needs, and what is changed")]
pub fn expected(
    change: &Change,
    scope: &Scope,
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    emit: &mut dyn FnMut(Act) -> bool,
) -> Expected {
    let tracker = Some(Tracker::new(change, scope, model));
    let mut emitting = Emitting { tracker, emit, is_over: false };
    let result = run(program, model, machine, options, fuel, scope, &mut emitting);
    let refusal = emitting.tracker.as_ref().and_then(|tracker| tracker.refusal().cloned());
    Expected { result, refusal }
}

/// Runs a program and hands on its acts as they are; `emit` says whether it wants more.
pub fn plainly(
    program: &Program<'_>,
    model: &Model<'_>,
    machine: &Machine,
    options: Options,
    fuel: u64,
    emit: &mut dyn FnMut(Act) -> bool,
) -> RunResult {
    let mut emitting = Emitting { tracker: None, emit, is_over: false };
    run(program, model, machine, options, fuel, &Scope::All, &mut emitting)
}

struct Emitting<'c, 'e> {
    tracker: Option<Tracker<'c>>,
    emit: &'e mut dyn FnMut(Act) -> bool,
    is_over: bool,
}

impl Visitor for Emitting<'_, '_> {
    fn executed(&mut self, block: &Executed<'_>) {
        if let Some(tracker) = &mut self.tracker {
            tracker.executed(block);
        }
    }

    fn act(&mut self, at: At, is_expanded: bool, act: Act) {
        if self.is_over {
            return;
        }
        let act = match &mut self.tracker {
            Some(tracker) => tracker.act(at, is_expanded, act),
            None => act,
        };
        self.is_over = !(self.emit)(act);
    }

    fn unfollowed(&mut self, _: u32, _: u32, _: Option<&str>) {}

    fn stops(&self) -> bool {
        self.is_over
    }
}
