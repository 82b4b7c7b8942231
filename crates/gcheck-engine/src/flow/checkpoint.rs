//! Where an analysis of all paths can be taken up again, and what it does between two such places.
//!
//! Knows: what the rest of an analysis depends on at such a place. Must not know: who keeps them, what rules remember.

use std::collections::BTreeSet;

use super::budget::GivenUp;
use super::marks::Marks;
use super::reaching_definitions::{Facts, Parting, ReachingDefinitions};
use crate::assumption::Assumption;
use crate::eval::value::Abstract;
use crate::origin::At;
use crate::state::State;

/// A place where one state stands for all paths, the main program is under way, and nothing in front is come back to: what
/// follows depends on this alone.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    /// The block that comes next, the first of a chunk of the main file.
    pub at: At,
    /// What may be the state.
    pub state: State<Abstract>,
    /// Where its facts were set.
    pub definitions: ReachingDefinitions,
    /// A path has ended: what comes is no longer on every path.
    pub parted: bool,
    /// How many of the task's choices were made.
    pub taken: usize,
}

impl Checkpoint {
    /// Does the same follow from both? Places and where facts were set left aside.
    pub fn leads_on_as(&self, other: &Self) -> bool {
        self.parted == other.parted && self.taken == other.taken && self.state == other.state
    }
}

/// What an analysis did from one checkpoint to the next, or to its end.
#[derive(Debug, Default)]
pub struct Leg {
    pub(super) reached: Marks,
    pub(super) always: Marks,
    /// Where it was given up: what was not seen may still be reached.
    pub given_up: Vec<GivenUp>,
    /// The observer ended it.
    pub stopped: bool,
    /// It came back over a checkpoint, which therefore was none.
    pub went_back: bool,
    /// What it cost, in blocks.
    pub work: u64,
    /// What it rests on.
    pub assumptions: BTreeSet<Assumption>,
    /// Where paths that were one part, in the order of the first time.
    pub partings: Vec<Parting>,
    /// Facts that somebody asked for while they still were as the leg began.
    pub asked: Facts,
    /// Facts that were set on every path.
    pub set: Facts,
}

impl Leg {
    /// Runs of blocks that were reached: the first of each, and the number behind its last.
    pub fn reached(&self) -> Vec<(At, u32)> {
        self.reached.runs()
    }

    /// Runs of blocks that every path reaches, likewise.
    pub fn always_reached(&self) -> Vec<(At, u32)> {
        self.always.runs()
    }
}
