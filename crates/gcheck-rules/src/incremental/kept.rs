//! What the rules of the path tier remember at a checkpoint, and findings as they are kept: with places that stay right while
//! text in front of them comes and goes.
//!
//! Knows: memories, findings, the layout. Must not know: when they are taken up again.

use std::ops::Range;

use gcheck_engine::At;

use super::layout::Layout;
use crate::memory::{Memory, Placed, Places};
use crate::paths::Lists;
use crate::{Finding, Severity};

/// A copy of a rule's memory.
type Copied = Box<dyn Memory>;

/// What the rules remember at a checkpoint. Blocks stand in it by their names, bytes beside it.
pub(crate) struct Kept {
    /// By rule; none of rules that remember nothing.
    pub(crate) memories: Vec<Option<Copied>>,
    /// Names of the bytes of each range in the memories, in their order.
    pub(crate) bytes: Vec<[u64; 2]>,
    pub(crate) lists: Lists,
    pub(crate) changed: bool,
}

impl std::fmt::Debug for Kept {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Kept").field("bytes", &self.bytes.len()).finish_non_exhaustive()
    }
}

impl PartialEq for Kept {
    fn eq(&self, other: &Self) -> bool {
        let same = |pair: (&Option<Copied>, &Option<Copied>)| match pair {
            (Some(own), Some(other)) => own.is_as(&**other),
            (None, None) => true,
            _ => false,
        };
        self.changed == other.changed
            && self.bytes == other.bytes
            && self.lists == other.lists
            && self.memories.len() == other.memories.len()
            && self.memories.iter().zip(&other.memories).all(same)
    }
}

/// Gives places their names.
pub(crate) struct Naming<'l> {
    pub(crate) layout: &'l Layout,
    pub(crate) bytes: Vec<[u64; 2]>,
}

impl Places for Naming<'_> {
    fn at(&mut self, at: &mut At) {
        self.layout.name(at);
    }

    fn range(&mut self, range: &mut Range<u32>) {
        self.bytes.push(self.layout.name_bytes(range));
        *range = 0..0;
    }
}

/// Finds named places again.
pub(crate) struct Refinding<'l> {
    pub(crate) layout: &'l Layout,
    pub(crate) bytes: std::slice::Iter<'l, [u64; 2]>,
    /// All of them are there.
    pub(crate) all: bool,
}

impl Places for Refinding<'_> {
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

/// A finding whose ranges count from the chunks they stand in.
#[derive(Debug)]
pub(crate) struct KeptFinding {
    pub(crate) severity: Option<Severity>,
    finding: Finding,
    /// Of each range in it: the slots in which it begins and ends.
    slots: Vec<[u32; 2]>,
}

impl KeptFinding {
    /// `None` when it stands nowhere in the file.
    pub(crate) fn new(severity: Option<Severity>, mut finding: Finding, layout: &Layout) -> Option<Self> {
        let mut anchoring = Anchoring { layout, slots: Vec::new(), all: true };
        finding.visit(&mut anchoring);
        anchoring.all.then_some(Self { severity, finding, slots: anchoring.slots })
    }

    /// Slots of the chunks that it names places of.
    pub(crate) fn slots(&self) -> impl Iterator<Item = u32> {
        self.slots.iter().flatten().copied()
    }

    /// The finding where it stands by now.
    pub(crate) fn found(&self, layout: &Layout) -> Finding {
        let mut finding = self.finding.clone();
        finding.visit(&mut Resolving { layout, slots: self.slots.iter() });
        finding
    }

    /// Where it begins by now, and its message, by which findings are told apart.
    pub(crate) fn key(&self, layout: &Layout) -> (&'static str, u32, &str) {
        let start = self.slots.first().and_then(|slots| layout.outside(slots[0], self.finding.range.start));
        (self.finding.rule.id, start.unwrap_or(0), &self.finding.message)
    }
}

struct Anchoring<'l> {
    layout: &'l Layout,
    slots: Vec<[u32; 2]>,
    all: bool,
}

impl Places for Anchoring<'_> {
    fn at(&mut self, _: &mut At) {}

    fn range(&mut self, range: &mut Range<u32>) {
        let start = self.layout.inside(range.start, false);
        let end = if range.end > range.start { self.layout.inside(range.end, true) } else { start };
        let (Some(start), Some(end)) = (start, end) else {
            self.all = false;
            return;
        };
        self.slots.push([start.0, end.0]);
        *range = start.1..end.1;
    }
}

struct Resolving<'l> {
    layout: &'l Layout,
    slots: std::slice::Iter<'l, [u32; 2]>,
}

impl Places for Resolving<'_> {
    fn at(&mut self, _: &mut At) {}

    fn range(&mut self, range: &mut Range<u32>) {
        let Some([first, last]) = self.slots.next() else { return };
        let start = self.layout.outside(*first, range.start).unwrap_or(0);
        *range = start..self.layout.outside(*last, range.end).unwrap_or(start);
    }
}

/// Moves every range of a finding on by some bytes.
pub(crate) fn moved_on(finding: &Finding, base: u32) -> Finding {
    struct Moving(u32);
    impl Places for Moving {
        fn at(&mut self, _: &mut At) {}

        fn range(&mut self, range: &mut Range<u32>) {
            *range = range.start + self.0..range.end + self.0;
        }
    }
    let mut finding = finding.clone();
    finding.visit(&mut Moving(base));
    finding
}
