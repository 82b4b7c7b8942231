//! Where facts were set, and which way led here. Not part of the state: two paths that set the same value are one.
//!
//! Knows: the last block that set each fact. Must not know: values.

use crate::event::Event;
use crate::model::{Model, Role};
use crate::state::At;

/// A fact whose setting block is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Fact {
    /// The mode of a role.
    Mode(Role),
    /// The feed.
    Feed,
    /// The speed.
    Speed,
    /// The spindle turning or not.
    Spindle,
    /// The tool in the spindle.
    Tool,
    /// The tool called for.
    Selected,
    /// Tool length offsets.
    Length,
    /// The shift of `G92` or `G52`.
    Shift,
    /// Coolant.
    Coolant,
    /// The chuck open or closed.
    Chuck,
}

impl Fact {
    const COUNT: usize = Role::COUNT + 9;

    const fn index(self) -> usize {
        match self {
            Self::Mode(role) => role.index(),
            Self::Feed => Role::COUNT,
            Self::Speed => Role::COUNT + 1,
            Self::Spindle => Role::COUNT + 2,
            Self::Tool => Role::COUNT + 3,
            Self::Selected => Role::COUNT + 4,
            Self::Length => Role::COUNT + 5,
            Self::Shift => Role::COUNT + 6,
            Self::Coolant => Role::COUNT + 7,
            Self::Chuck => Role::COUNT + 8,
        }
    }
}

/// A way taken where the paths parted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decision {
    /// The block that decides.
    pub at: At,
    /// The block it led to.
    pub to: At,
}

/// The last setting of each fact, and the last decisions.
#[derive(Debug, Clone)]
pub struct Trace {
    set: [Option<At>; Fact::COUNT],
    decisions: Vec<Decision>,
}

impl Default for Trace {
    fn default() -> Self {
        Self { set: [None; Fact::COUNT], decisions: Vec::new() }
    }
}

/// Decisions that are kept: the last ones say most.
const MOST_DECISIONS: usize = 8;

impl Trace {
    /// The block that set a fact last; `None` when it still is as at the start.
    pub fn set_by(&self, fact: Fact) -> Option<At> {
        self.set.get(fact.index()).copied().flatten()
    }

    /// The last decisions on the way here, the oldest first.
    pub fn decisions(&self) -> &[Decision] {
        &self.decisions
    }

    pub(super) fn decide(&mut self, decision: Decision) {
        if self.decisions.len() >= MOST_DECISIONS {
            self.decisions.remove(0);
        }
        self.decisions.push(decision);
    }

    pub(super) fn see(&mut self, at: At, event: &Event, model: &Model<'_>) {
        let fact = match event {
            Event::Modal(code) => match model.role(*code) {
                Some(role) => Fact::Mode(role),
                None => return,
            },
            Event::FeedRate(_) => Fact::Feed,
            Event::SpindleSpeed(_) => Fact::Speed,
            Event::Spindle(_) => Fact::Spindle,
            Event::ToolChange(_) | Event::SetToolNumber(_) => Fact::Tool,
            Event::SelectTool(_) => Fact::Selected,
            Event::LengthOffset(_) => Fact::Length,
            Event::Shift(_) => Fact::Shift,
            Event::Coolant { .. } => Fact::Coolant,
            Event::Chuck(_) => Fact::Chuck,
            _ => return,
        };
        if let Some(slot) = self.set.get_mut(fact.index()) {
            *slot = Some(at);
        }
    }

    /// Where paths meet the later block is kept: it is the more likely to be looked for.
    pub(super) fn join(&mut self, other: &Self) {
        for (slot, with) in self.set.iter_mut().zip(&other.set) {
            *slot = (*slot).max(*with);
        }
        if other.decisions.len() > self.decisions.len() {
            self.decisions.clone_from(&other.decisions);
        }
    }
}
