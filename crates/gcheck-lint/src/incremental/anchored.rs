//! Findings as they are kept: with places that stay right while text before them is inserted and deleted.
//!
//! Knows: findings, the layout. Must not know: which findings are kept, and for how long.

use std::ops::Range;

use gcheck_diagnostics::{Finding, Severity};
use gcheck_engine::At;

use super::layout::Layout;
use crate::{Placed, Places};

/// A finding whose ranges count from the chunks that hold them.
#[derive(Debug)]
pub(crate) struct AnchoredFinding {
    pub(crate) severity: Option<Severity>,
    finding: Finding,
    /// Of each range in it: the slots in which it begins and ends.
    slots: Vec<[u32; 2]>,
}

impl AnchoredFinding {
    /// `None` when the file does not hold all its places.
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

/// The finding with every range moved on by some bytes.
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
