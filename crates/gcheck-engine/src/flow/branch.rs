//! One way of a condition, kept as the analysis came to it, so that it can be followed by itself from there.
//!
//! Knows: what an analysis is made of at the moment at which paths that were one part. Must not know: which ways are worth
//! following.
//!
//! Following a branch does what an analysis from the beginning does that takes this way (see [`Task`](super::Task)): all that
//! goes before the condition is as it was, and is not executed again.

use std::collections::BTreeSet;
use std::rc::Rc;

use super::heads::Heads;
use super::reaching_definitions::{Choice, ReachingDefinitions};
use crate::eval::value::Abstract;
use crate::origin::At;
use crate::state::State;

/// A way of a condition, from where it begins.
#[derive(Debug, Clone)]
pub struct Branch {
    pub(super) choice: Choice,
    /// Where the way leads.
    pub(super) to: At,
    pub(super) state: State<Abstract>,
    pub(super) definitions: ReachingDefinitions,
    pub(super) before: Rc<Before>,
}

/// What the ways of a condition have in common.
#[derive(Debug)]
pub(super) struct Before {
    pub(super) heads: Heads,
    /// How often paths had parted.
    pub(super) forks: u64,
    /// Refused blocks that may lead elsewhere once they are corrected.
    pub(super) lost_ways: BTreeSet<At>,
    pub(super) lost: u64,
    /// How many of the task's choices were made before.
    pub(super) taken: usize,
    /// The work that was done to come here.
    pub(super) work: u64,
}

impl Branch {
    /// The way that is taken.
    pub const fn choice(&self) -> Choice {
        self.choice
    }

    /// The work that was done to come here.
    pub fn work(&self) -> u64 {
        self.before.work
    }
}
