//! Cutter compensation that is on, with the moves that it holds back.
//!
//! Knows: whether a path is compensated, and where its offset path has got to. Must not know: how the offset path is computed
//! (`gcheck-geometry`), which codes switch it, tools.

use std::rc::Rc;

use gcheck_geometry::{Compensator, Plane};

use crate::event::Event;
use crate::lattice::{Joinable, Lattice, Perhaps, lattice};
use crate::origin::Origin;
use crate::position::Position;

lattice! {
    /// Whether the axes run beside the programmed path.
    #[derive(Debug, Clone, Default)]
    pub(crate) struct CompensationState {
        /// It is on.
        pub(crate) on: Perhaps<Course>,
        /// It is switched off, until the move that leaves its path.
        pub(crate) left: Perhaps<Course>,
    }
}

impl CompensationState {
    /// The path that is followed, taken out; it is to be put back.
    pub(crate) fn take_followed(&mut self) -> Option<Rc<Compensation>> {
        match &self.on {
            Perhaps::Yes(Course::Followed(_)) => match std::mem::take(&mut self.on) {
                Perhaps::Yes(Course::Followed(compensation)) => Some(compensation),
                _ => None,
            },
            _ => None,
        }
    }

    /// Goes on along a path.
    pub(crate) fn follow_path(&mut self, compensation: Rc<Compensation>) {
        self.on = Perhaps::Yes(Course::Followed(compensation));
    }

    /// Its path is not followed from here on. What is off stays off.
    pub(crate) fn lose_path(&mut self) {
        if matches!(self.on, Perhaps::Yes(_)) {
            self.on = Perhaps::Yes(Course::Unknown);
        }
    }

    /// It is switched off on a path that is not followed, or was off.
    pub(crate) fn leave_unknown(&mut self) {
        match std::mem::take(&mut self.on) {
            Perhaps::No => {}
            Perhaps::Yes(_) => self.left = Perhaps::Yes(Course::Unknown),
            Perhaps::Unknown => self.left = Perhaps::Unknown,
        }
    }

    /// Is a path followed?
    #[inline]
    pub(crate) fn is_followed(&self) -> bool {
        matches!(self.on, Perhaps::Yes(Course::Followed(_)))
    }

    /// Is it on along a path that nobody knows?
    pub(crate) fn is_unknown_path(&self) -> bool {
        matches!(self.on, Perhaps::Yes(Course::Unknown))
    }

    /// What was on may be on along a path that nobody knows; what was off is left off.
    pub(crate) fn forget(&mut self) {
        let (on, left) = (self.on.or_other(), self.left.or_other());
        self.on = on;
        self.left = left;
    }

    /// Is it certainly off, and its path left?
    pub(crate) fn is_off(&self) -> bool {
        self.on.is_no() && self.left.is_no()
    }
}

/// The path beside the programmed one.
#[derive(Debug, Clone)]
pub(crate) enum Course {
    /// This one.
    Followed(Rc<Compensation>),
    /// Nobody knows: the tool's size or the start is not known, or two paths became one.
    Unknown,
}

impl Joinable for Course {
    fn joined(&self, other: &Self, _: bool) -> Option<Self> {
        Some(if self.is_same(other) { self.clone() } else { Self::Unknown })
    }

    fn stands_for(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Unknown, _) => true,
            (Self::Followed(a), Self::Followed(b)) => Rc::ptr_eq(a, b) || a.stands_for(b),
            (Self::Followed(_), Self::Unknown) => false,
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Unknown, Self::Unknown) => true,
            (Self::Followed(a), Self::Followed(b)) => Rc::ptr_eq(a, b) || a.is_same(b),
            _ => false,
        }
    }
}

/// A path being compensated.
#[derive(Debug, Clone)]
pub(crate) struct Compensation {
    pub(crate) compensator: Compensator<Programmed, (Origin, Event)>,
    pub(crate) plane: Plane,
    /// The last point given out, all axes.
    pub(crate) at: Position,
}

/// What a programmed move carries through the compensation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Programmed {
    pub(crate) origin: Origin,
    /// Its end as it is programmed.
    pub(crate) target: Position,
    /// Its end as scaling, rotation and mirrors leave it: the path is compensated after them.
    pub(crate) end: Position,
}

/// What one path holds back says nothing of another.
impl Compensation {
    fn stands_for(&self, inner: &Self) -> bool {
        let Self { compensator, plane, at } = self;
        let moves = |a: &Programmed, b: &Programmed| {
            a.origin == b.origin && a.target.covers(&b.target) && a.end.covers(&b.end)
        };
        let events =
            |(a, event): &(Origin, Event), (b, inner): &(Origin, Event)| a == b && event.covers(inner);
        *plane == inner.plane
            && at.covers(&inner.at)
            && compensator.goes_on_as(&inner.compensator, moves, events)
    }

    /// An event held back with a number that nobody knows makes two of them differ: that is safe to say.
    fn is_same(&self, other: &Self) -> bool {
        let Self { compensator, plane, at } = self;
        *plane == other.plane && at.same(&other.at) && *compensator == other.compensator
    }
}
