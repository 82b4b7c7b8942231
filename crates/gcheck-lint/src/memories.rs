//! What all rules of the path tier remember at one moment of an analysis.
//!
//! Knows: memories of rules, and how far the rules have come. Must not know: any rule, when an analysis continues from there.

use crate::watchers::{Progress, Watchers};
use crate::{Memory, Places, Remembers};

/// A copy of a rule's memory.
type Copied = Box<dyn Memory>;

/// What the rules that watch remember.
pub(crate) struct Memories {
    /// By rule; none of rules that remember nothing.
    copies: Vec<Option<Copied>>,
    progress: Progress,
}

impl Memories {
    /// Those of the rules that watch.
    pub(crate) fn of(watchers: &mut Watchers<'_, '_>) -> Self {
        let progress = watchers.progress();
        let copies = watchers.memories().map(|memory| match memory {
            Remembers::All(memory) => Some(memory.copy()),
            Remembers::Nothing | Remembers::Unknown => None,
        });
        Self { copies: copies.collect(), progress }
    }

    /// Makes the rules remember what they did then. `change` may change the copies that they get.
    pub(crate) fn restore(&self, watchers: &mut Watchers<'_, '_>, mut change: impl FnMut(&mut dyn Memory)) {
        for (memory, own) in self.copies.iter().zip(watchers.memories()) {
            if let (Some(memory), Remembers::All(own)) = (memory, own) {
                let mut memory = memory.copy();
                change(&mut *memory);
                own.recall(&*memory);
            }
        }
        watchers.set_progress(&self.progress);
    }

    /// Shows every place in them, always in the same order.
    pub(crate) fn visit(&mut self, places: &mut dyn Places) {
        for memory in self.copies.iter_mut().flatten() {
            memory.visit(places);
        }
    }
}

impl std::fmt::Debug for Memories {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Memories").field("rules", &self.copies.len()).finish_non_exhaustive()
    }
}

impl PartialEq for Memories {
    fn eq(&self, other: &Self) -> bool {
        let same = |pair: (&Option<Copied>, &Option<Copied>)| match pair {
            (Some(own), Some(other)) => own.is_as(&**other),
            (None, None) => true,
            _ => false,
        };
        self.progress == other.progress
            && self.copies.len() == other.copies.len()
            && self.copies.iter().zip(&other.copies).all(same)
    }
}
