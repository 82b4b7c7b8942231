//! Starts of loops that were met while one state stands for all paths, to find a loop that never ends.
//!
//! Knows: the loops of the programs under way. Must not know: what is done with a loop.
//!
//! States are kept of programs under way alone, so memory follows the text and the depth of calls. Of those that returned it is
//! kept how often their loops turned: a loop in a program that is called again goes on counting.

use std::collections::hash_map::Entry;
use std::hash::{Hash, Hasher};
use std::rc::Rc;

use rustc_hash::{FxHashMap, FxHasher};

use crate::eval::value::Abstract;
use crate::origin::At;
use crate::state::State;

/// The start of a loop.
#[derive(Debug, Clone)]
pub(super) struct Head {
    /// Shared by copies.
    pub(super) state: Rc<State<Abstract>>,
    /// How many forks there were when it was met.
    pub(super) forks: u64,
    /// How often a refused block that may lead elsewhere was come by before it was met.
    pub(super) lost: u64,
    /// How often it was met, the turns of calls that returned included.
    pub(super) visits: u32,
    /// How often it was met in such calls.
    pub(super) before: u32,
    /// How often a turn was joined with those before.
    pub(super) joins: u32,
    /// The visit of this call at which `state` was taken: compared with later ones to find a loop that repeats its state.
    pub(super) taken: u32,
}

/// A block, and whether it is the branch that a condition in front of it chose.
type Place = (At, bool);

/// Starts of loops, for each of the programs under way.
#[derive(Debug, Clone, Default)]
pub(super) struct Heads {
    main: FxHashMap<Place, Head>,
    /// Of calls, the outermost first, with the blocks that called.
    calls: Vec<(At, FxHashMap<Place, Head>)>,
    /// How often loops of calls that returned were visited, by the calls that led there.
    turned: FxHashMap<(u64, Place), u32>,
}

impl Heads {
    /// These calls are under way: what belongs to others goes.
    pub(super) fn are_in(&mut self, path: &Rc<[At]>) {
        let kept = self.calls.iter().zip(path.iter()).take_while(|((caller, _), at)| caller == *at).count();
        while self.calls.len() > kept {
            let way = self.way();
            let Some((_, heads)) = self.calls.pop() else { break };
            self.turned.extend(heads.into_iter().map(|(place, head)| ((way, place), head.visits)));
        }
        self.calls.extend(path.iter().skip(kept).map(|caller| (*caller, FxHashMap::default())));
    }

    /// The start of a loop at a block of the program under way, if one was met.
    pub(super) fn at(&mut self, at: At, wanted: bool) -> Option<&mut Head> {
        self.last().get_mut(&(at, wanted))
    }

    /// The start of a loop is met for the first time in the program under way.
    pub(super) fn meet(&mut self, at: At, wanted: bool, state: &State<Abstract>, forks: u64, lost: u64) {
        let before = if self.calls.is_empty() || self.turned.is_empty() {
            0
        } else {
            self.turned.get(&(self.way(), (at, wanted))).copied().unwrap_or(0)
        };
        let visits = before.saturating_add(1);
        if let Entry::Vacant(slot) = self.last().entry((at, wanted)) {
            let state = Rc::new(state.clone());
            slot.insert(Head { state, forks, lost, visits, before, joins: 0, taken: 1 });
        }
    }

    /// Nothing leads back to any loop.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    fn last(&mut self) -> &mut FxHashMap<Place, Head> {
        self.calls.last_mut().map_or(&mut self.main, |(_, heads)| heads)
    }

    /// The calls under way as a number.
    fn way(&self) -> u64 {
        let mut hasher = FxHasher::default();
        for (caller, _) in &self.calls {
            caller.hash(&mut hasher);
        }
        hasher.finish()
    }
}
