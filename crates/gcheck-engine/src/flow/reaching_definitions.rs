//! Where facts were set, and which way led here. Not part of the state: two paths that set the same value are one.
//!
//! Knows: the last block that set each fact. Must not know: values.

use std::cell::Cell;
use std::rc::Rc;

use crate::event::Event;
use crate::model::{Model, Role};
use crate::origin::At;

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

/// A block at which paths that were one part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parting {
    /// The block that decides.
    pub at: At,
    /// How many ways lead on.
    pub ways: usize,
    /// The work done before, since the leg of the analysis began.
    pub work: u64,
}

/// One way of a [`Parting`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// The block that decides.
    pub at: At,
    /// Which of its ways, from 0 on. Of a condition before a jump or words, 0 is that it does not hold; of a loop's or an
    /// O-word's, 0 is that it holds.
    pub way: usize,
}

/// A set of facts; the last decisions count as one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Facts(u64);

impl Facts {
    const DECISIONS: Self = Self(1 << Fact::COUNT);

    const fn one(index: usize) -> Self {
        Self(1 << index)
    }

    /// Is no fact in it?
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Is a fact in both?
    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// The facts that are not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

/// The last setting of each fact, and the last decisions.
#[derive(Debug, Clone)]
pub struct ReachingDefinitions {
    set: [Option<At>; Fact::COUNT],
    decisions: Vec<Decision>,
    /// Facts set in this leg of the analysis.
    own: Cell<Facts>,
    /// Facts asked for in this leg that were not set in it. All traces of an analysis share it.
    asked: Rc<Cell<Facts>>,
}

impl Default for ReachingDefinitions {
    fn default() -> Self {
        Self { set: [None; Fact::COUNT], decisions: Vec::new(), own: Cell::default(), asked: Rc::default() }
    }
}

/// Decisions that are kept: the last ones say most.
const MOST_DECISIONS: usize = 8;

impl ReachingDefinitions {
    /// The block that set a fact last; `None` when it still is as at the start.
    pub fn set_by(&self, fact: Fact) -> Option<At> {
        self.ask(Facts::one(fact.index()));
        self.set.get(fact.index()).copied().flatten()
    }

    /// The last decisions on the way here, the oldest first.
    pub fn decisions(&self) -> &[Decision] {
        self.ask(Facts::DECISIONS);
        &self.decisions
    }

    fn ask(&self, facts: Facts) {
        self.asked.set(self.asked.get().or(facts.without(self.own.get())));
    }

    /// A leg of the analysis begins.
    pub(super) fn begin_leg(&self) {
        self.own.set(Facts::default());
        self.asked.set(Facts::default());
    }

    /// What was asked for and what was set in this leg.
    pub(super) fn notes(&self) -> (Facts, Facts) {
        (self.asked.get(), self.own.get())
    }

    /// Facts that were set by other blocks than in the other one.
    pub fn differing(&self, other: &Self) -> Facts {
        let pairs = self.set.iter().zip(&other.set).enumerate();
        let set = pairs.filter(|(_, (own, other))| own != other).map(|(index, _)| Facts::one(index));
        let decisions = (self.decisions != other.decisions).then_some(Facts::DECISIONS);
        set.chain(decisions).fold(Facts::default(), Facts::or)
    }

    /// Takes these facts over from another one.
    pub fn take(&mut self, facts: Facts, other: &Self) {
        for (index, (slot, with)) in self.set.iter_mut().zip(&other.set).enumerate() {
            if facts.intersects(Facts::one(index)) {
                *slot = *with;
            }
        }
        if facts.intersects(Facts::DECISIONS) {
            self.decisions.clone_from(&other.decisions);
        }
    }

    /// Changes every block that it names. `change` says no to one that is not there; then the trace is of no use.
    pub fn places(&mut self, change: &mut dyn FnMut(&mut At) -> bool) -> bool {
        let decisions = self.decisions.iter_mut().flat_map(|decision| [&mut decision.at, &mut decision.to]);
        self.set.iter_mut().flatten().chain(decisions).all(change)
    }

    /// The same, whose notes nobody else shares.
    #[must_use]
    pub fn apart(&self) -> Self {
        Self { asked: Rc::default(), ..self.clone() }
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
            Event::Spindle(_) | Event::OrientSpindle { .. } => Fact::Spindle,
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
            self.own.set(self.own.get().or(Facts::one(fact.index())));
        }
    }

    /// Where paths meet the later block is kept: it is the more likely to be looked for.
    pub(super) fn join(&mut self, other: &Self) {
        // Which block is the later one depends on what was set before the leg, where one of the paths did not set the fact.
        let (both, either) = (self.own.get().and(other.own.get()), self.own.get().or(other.own.get()));
        self.own.set(both);
        self.ask(either.or(Facts::DECISIONS).without(both));
        for (slot, with) in self.set.iter_mut().zip(&other.set) {
            *slot = (*slot).max(*with);
        }
        if other.decisions.len() > self.decisions.len() {
            self.decisions.clone_from(&other.decisions);
        }
    }
}
