//! What the rules of the path tier remember at a checkpoint, stored so that it stays right while text before its places is
//! inserted and deleted.
//!
//! Knows: memories of rules, the layout. Must not know: any rule, when an analysis continues from there.

use std::ops::Range;

use gcheck_engine::At;

use super::layout::Layout;
use crate::Places;
use crate::memories::Memories;
use crate::watchers::Watchers;

/// What the rules remember at a checkpoint. Blocks are stored in it by their names, bytes beside it.
#[derive(Debug, PartialEq)]
pub(crate) struct RuleState {
    memories: Memories,
    /// Names of the bytes of each range in the memories, in their order.
    bytes: Vec<[u64; 2]>,
}

impl RuleState {
    /// Of the rules that watch.
    pub(crate) fn of(watchers: &mut Watchers<'_, '_>, layout: &Layout) -> Self {
        let mut names = NamePlaces { layout, bytes: Vec::new() };
        let mut memories = Memories::of(watchers);
        memories.visit(&mut names);
        Self { memories, bytes: names.bytes }
    }

    /// Makes the rules remember what they did there. `false` when it names text that is not there any more.
    pub(crate) fn restore(&self, watchers: &mut Watchers<'_, '_>, layout: &Layout) -> bool {
        let mut places = FindPlaces { layout, bytes: self.bytes.iter(), all: true };
        self.memories.restore(watchers, |memory| memory.visit(&mut places));
        places.all
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
