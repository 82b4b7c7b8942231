//! The state before and after blocks, on all paths that come to them.
//!
//! Knows: how visits of one block become one state. Must not know: what states are shown for.

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_engine::{Abstract, FlowCx, FlowObserver, Look, ReachingDefinitions, State};

/// What was seen of a block.
#[derive(Debug, Clone)]
pub struct StateAt {
    /// Number of the block in the file.
    pub block: u32,
    /// What may be the state before it.
    pub before: State<Abstract>,
    /// Where the facts before it were set.
    pub definitions: ReachingDefinitions,
    /// Where the facts after it were set.
    pub definitions_after: ReachingDefinitions,
    /// What may be the state after it; `None` when the program never goes on from here.
    pub after: Option<State<Abstract>>,
    /// Every path comes here.
    pub on_every_path: bool,
    /// How often it was executed: turns of loops and calls of its program.
    pub visits: u32,
}

/// Keeps the states of a range of blocks.
pub(crate) struct Keeper {
    pub(crate) blocks: Range<u32>,
    pub(crate) seen: BTreeMap<u32, StateAt>,
}

impl Keeper {
    pub(crate) fn new(blocks: Range<u32>) -> Self {
        Self { blocks, seen: BTreeMap::new() }
    }

    /// Hands on what was seen, unless it was cut short: then it is not all that comes by.
    pub(crate) fn hand_on(
        &self,
        look: &mut Look<'_, '_>,
        stop: &dyn Fn() -> bool,
        with: &mut dyn FnMut(&StateAt, &mut Look<'_, '_>),
    ) {
        if !stop() {
            self.seen.values().for_each(|state| with(state, look));
        }
    }

    fn is_wanted(&self, cx: &FlowCx<'_>) -> bool {
        cx.origin.at.file == 0 && self.blocks.contains(&cx.origin.at.block)
    }
}

impl FlowObserver for Keeper {
    fn before(&mut self, cx: &FlowCx<'_>) {
        if !self.is_wanted(cx) {
            return;
        }
        let block = cx.origin.at.block;
        match self.seen.get_mut(&block) {
            Some(seen) => {
                seen.before = seen.before.union(cx.state);
                seen.on_every_path |= cx.solo;
                seen.visits = seen.visits.saturating_add(1);
            }
            None => {
                let seen = StateAt {
                    block,
                    before: cx.state.clone(),
                    definitions: cx.definitions.clone(),
                    definitions_after: cx.definitions.clone(),
                    after: None,
                    on_every_path: cx.solo,
                    visits: 1,
                };
                self.seen.insert(block, seen);
            }
        }
    }

    fn after(&mut self, cx: &FlowCx<'_>) {
        if !self.is_wanted(cx) {
            return;
        }
        if let Some(seen) = self.seen.get_mut(&cx.origin.at.block) {
            let after = seen.after.as_ref().map_or_else(|| cx.state.clone(), |after| after.union(cx.state));
            seen.after = Some(after);
            seen.definitions_after = cx.definitions.clone();
        }
    }
}
