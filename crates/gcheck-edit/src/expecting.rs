//! The acts that a program must make after a change: those of a run before it, changed as it claims.
//!
//! Knows: runs. Must not know: text, how acts are compared.

use gcheck_engine::{At, Machine, Model, Options, Program, RunResult};
use gcheck_toolpath::Act;

use crate::change::Change;
use crate::refusal::Refusal;
use crate::run::{Executed, Visitor, run};
use crate::scope::Scope;
use crate::witness::Following;

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
    let following = Some(Following::new(change, scope, model));
    let mut emitting = Emitting { following, emit, is_over: false };
    let result = run(program, model, machine, options, fuel, scope, &mut emitting);
    Expected { result, refusal: emitting.following.and_then(|following| following.refusal) }
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
    let mut emitting = Emitting { following: None, emit, is_over: false };
    run(program, model, machine, options, fuel, &Scope::All, &mut emitting)
}

struct Emitting<'c, 'e> {
    following: Option<Following<'c>>,
    emit: &'e mut dyn FnMut(Act) -> bool,
    is_over: bool,
}

impl Visitor for Emitting<'_, '_> {
    fn executed(&mut self, block: &Executed<'_>) {
        if let Some(following) = &mut self.following {
            following.executed(block);
        }
    }

    fn act(&mut self, at: At, is_expanded: bool, act: Act) {
        if self.is_over {
            return;
        }
        let act = match &mut self.following {
            Some(following) => following.act(at, is_expanded, act),
            None => Some(act),
        };
        self.is_over = act.is_none_or(|act| !(self.emit)(act));
    }

    fn unfollowed(&mut self, _: u32, _: u32, _: Option<&str>) {}

    fn stops(&self) -> bool {
        self.is_over
    }
}
