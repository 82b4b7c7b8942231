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
    /// Of a block that calls a program of the file: what may be the state when the program is back at the block after it, and where
    /// its facts were set. `None` where nothing is called, or nothing comes back.
    pub returned: Option<(State<Abstract>, ReachingDefinitions)>,
    /// Every path comes here.
    pub on_every_path: bool,
    /// How often it was executed: turns of loops and calls of its program.
    pub visits: u32,
    /// The program calls others that are not here, or probes: these are assumed to change nothing, and to touch at their targets.
    pub is_assumed: bool,
}

impl StateAt {
    /// Does the block go on in a program that it calls?
    pub fn calls(&self) -> bool {
        self.after.as_ref().is_some_and(|after| after.frames().len() > self.before.frames().len())
    }

    /// The state after the block as people count: of a call, when the program is back.
    pub fn settled(&self) -> Option<(&State<Abstract>, &ReachingDefinitions)> {
        if self.calls() {
            return self.returned.as_ref().map(|(state, definitions)| (state, definitions));
        }
        self.after.as_ref().map(|after| (after, &self.definitions_after))
    }
}

/// Keeps the states of a range of blocks.
pub(crate) struct Keeper {
    pub(crate) blocks: Range<u32>,
    pub(crate) seen: BTreeMap<u32, StateAt>,
    /// What [`StateAt::is_assumed`] says of them.
    assumed: bool,
}

impl Keeper {
    pub(crate) fn new(blocks: Range<u32>, assumed: bool) -> Self {
        Self { blocks, seen: BTreeMap::new(), assumed }
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

    /// The blocks that must be executed: those that are kept, and the one that the last of them goes back to after a call.
    pub(crate) fn executed(&self) -> Range<u32> {
        self.blocks.start..self.blocks.end.saturating_add(1)
    }

    /// Is a program back that the block in front of this one has called?
    fn come_back(&mut self, cx: &FlowCx<'_>) {
        let at = cx.origin.at;
        let caller = at.block.checked_sub(1).filter(|caller| at.file == 0 && self.blocks.contains(caller));
        let Some(seen) = caller.and_then(|caller| self.seen.get_mut(&caller)) else { return };
        if !seen.calls() || seen.before.frames().len() != cx.state.frames().len() {
            return;
        }
        let state = match &seen.returned {
            Some((returned, _)) => returned.union(cx.state),
            None => cx.state.clone(),
        };
        seen.returned = Some((state, cx.definitions.clone()));
    }

    fn is_wanted(&self, cx: &FlowCx<'_>) -> bool {
        cx.origin.at.file == 0 && self.blocks.contains(&cx.origin.at.block)
    }
}

impl FlowObserver for Keeper {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.come_back(cx);
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
                    returned: None,
                    on_every_path: cx.solo,
                    visits: 1,
                    is_assumed: self.assumed,
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
