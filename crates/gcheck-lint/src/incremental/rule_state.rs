//! What the rules of the path tier remember at a checkpoint, stored so that it stays right while text before its places is
//! inserted and deleted.
//!
//! Knows: memories of rules, the layout. Must not know: any rule, when an analysis continues from there.

use std::ops::Range;

use gcheck_engine::At;

use super::layout::Layout;
use crate::watchers::{Progress, Watchers};
use crate::{Memory, Places, Remembers};

/// A copy of a rule's memory.
type Copied = Box<dyn Memory>;

/// What the rules remember at a checkpoint. Blocks are stored in it by their names, bytes beside it.
pub(crate) struct RuleState {
    /// By rule; none of rules that remember nothing.
    memories: Vec<Option<Copied>>,
    /// Names of the bytes of each range in the memories, in their order.
    bytes: Vec<[u64; 2]>,
    progress: Progress,
}

impl RuleState {
    /// Of the rules that watch.
    pub(crate) fn of(watchers: &mut Watchers<'_, '_>, layout: &Layout) -> Self {
        let mut names = NamePlaces { layout, bytes: Vec::new() };
        let progress = watchers.progress();
        let memories = watchers.memories().map(|memory| match memory {
            Remembers::All(memory) => {
                let mut memory = memory.copy();
                memory.visit(&mut names);
                Some(memory)
            }
            Remembers::Nothing | Remembers::Unknown => None,
        });
        Self { memories: memories.collect(), bytes: names.bytes, progress }
    }

    /// Makes the rules remember what they did there. `false` when it names text that is not there any more.
    pub(crate) fn restore(&self, watchers: &mut Watchers<'_, '_>, layout: &Layout) -> bool {
        let mut places = FindPlaces { layout, bytes: self.bytes.iter(), all: true };
        for (memory, own) in self.memories.iter().zip(watchers.memories()) {
            if let (Some(memory), Remembers::All(own)) = (memory, own) {
                let mut memory = memory.copy();
                memory.visit(&mut places);
                own.recall(&*memory);
            }
        }
        watchers.set_progress(&self.progress);
        places.all
    }
}

impl std::fmt::Debug for RuleState {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RuleState").field("bytes", &self.bytes.len()).finish_non_exhaustive()
    }
}

impl PartialEq for RuleState {
    fn eq(&self, other: &Self) -> bool {
        let same = |pair: (&Option<Copied>, &Option<Copied>)| match pair {
            (Some(own), Some(other)) => own.is_as(&**other),
            (None, None) => true,
            _ => false,
        };
        self.progress == other.progress
            && self.bytes == other.bytes
            && self.memories.len() == other.memories.len()
            && self.memories.iter().zip(&other.memories).all(same)
    }
}

/// Gives places their names.
struct NamePlaces<'l> {
    layout: &'l Layout,
    bytes: Vec<[u64; 2]>,
}

impl Places for NamePlaces<'_> {
    fn at(&mut self, at: &mut At) {
        self.layout.name(at);
    }

    fn range(&mut self, range: &mut Range<u32>) {
        self.bytes.push(self.layout.name_bytes(range));
        *range = 0..0;
    }
}

/// Finds named places again.
struct FindPlaces<'l> {
    layout: &'l Layout,
    bytes: std::slice::Iter<'l, [u64; 2]>,
    /// All of them are there.
    all: bool,
}

impl Places for FindPlaces<'_> {
    fn at(&mut self, at: &mut At) {
        self.all &= self.layout.number_again(at);
    }

    fn range(&mut self, range: &mut Range<u32>) {
        match self.bytes.next().and_then(|names| self.layout.bytes_again(*names)) {
            Some(found) => *range = found,
            None => self.all = false,
        }
    }
}
