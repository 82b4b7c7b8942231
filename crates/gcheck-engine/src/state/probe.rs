//! What a control remembers of a probing move.
//!
//! Knows: which axes moved and which way, how two memories join. Must not know: where the probe touched (nobody does
//! beforehand), codes, tables.

use crate::eval::value::Truth;
use crate::lattice::{Lattice, flat_lattice, lattice};
use crate::position::{Axis, Position};

lattice! {
    /// What probing moves left.
    #[derive(Debug, Clone)]
    pub(crate) struct Probe {
        /// Where the last one touched.
        pub(crate) point: Position,
        /// Whether it touched.
        pub(crate) result: Truth,
        /// The last one.
        pub(crate) touched: Touch,
        /// The one kept for a measurement between two touches.
        pub(crate) kept: Touch,
    }
}

impl Probe {
    /// Before a program. A control that was just started has probed nothing; else nobody knows what it has.
    pub(crate) fn at_start(fresh: bool) -> Self {
        Self {
            point: if fresh { Position::ZERO } else { Position::UNKNOWN },
            result: if fresh { Truth::False } else { Truth::Unknown },
            touched: Touch::None,
            kept: Touch::None,
        }
    }

    /// Anything may have been probed.
    pub(crate) fn forget(&mut self) {
        let Self { point, result, touched, kept } = self;
        *point = Position::UNKNOWN;
        *result = Truth::Unknown;
        *touched = Touch::Unknown;
        *kept = Touch::Unknown;
    }
}

/// A probing move that was made, or kept for a measurement between two touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touch {
    /// There was none.
    None,
    /// There was one, and went this way.
    Made(Ways),
    /// There may have been one.
    Unknown,
}

/// The way of a probing move by axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ways([Way; Axis::ALL.len()]);

/// The way of a probing move along one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// The block does not move the axis.
    Still,
    /// Toward greater coordinates.
    Up,
    /// Toward smaller coordinates.
    Down,
    /// It moves, or stands: nobody knows.
    Unknown,
}

impl Way {
    /// The way of a distance; NaN when it is not known.
    pub(crate) fn of(distance: f64) -> Self {
        if distance > 0.0 {
            Self::Up
        } else if distance < 0.0 {
            Self::Down
        } else if distance.is_nan() {
            Self::Unknown
        } else {
            Self::Still
        }
    }
}

impl Ways {
    pub(crate) const STILL: Self = Self([Way::Still; Axis::ALL.len()]);

    /// The way along an axis.
    pub fn of(&self, axis: Axis) -> Way {
        self.0.get(axis.index()).copied().unwrap_or(Way::Unknown)
    }

    pub(crate) fn set(&mut self, axis: Axis, way: Way) {
        if let Some(slot) = self.0.get_mut(axis.index()) {
            *slot = way;
        }
    }
}

flat_lattice!(Way);

impl Lattice for Touch {
    fn join(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::None, Self::None) => Self::None,
            (Self::Made(ways), Self::Made(with)) => Self::Made(Ways(ways.0.join(&with.0))),
            _ => Self::Unknown,
        }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Unknown, _) | (Self::None, Self::None) => true,
            (Self::Made(ways), Self::Made(inner)) => ways.0.covers(&inner.0),
            _ => false,
        }
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

#[cfg(test)]
mod tests {
    use super::{Touch, Way, Ways};
    use crate::lattice::Lattice;
    use crate::position::Axis;

    fn along(axis: Axis, way: Way) -> Touch {
        let mut ways = Ways::STILL;
        ways.set(axis, way);
        Touch::Made(ways)
    }

    #[test]
    fn a_joined_memory_covers_both() {
        let all = [
            Touch::None,
            Touch::Unknown,
            along(Axis::X, Way::Up),
            along(Axis::X, Way::Down),
            along(Axis::Y, Way::Unknown),
        ];
        for one in all {
            for other in all {
                let joined = one.join(&other);
                assert!(joined.covers(&one) && joined.covers(&other), "{one:?} {other:?}");
                assert_eq!(joined, other.join(&one));
            }
        }
    }

    #[test]
    fn touches_along_other_axes_are_told_apart() {
        assert!(!along(Axis::X, Way::Up).covers(&along(Axis::Y, Way::Up)));
        assert_eq!(along(Axis::X, Way::Up).join(&along(Axis::X, Way::Down)), along(Axis::X, Way::Unknown));
        assert_eq!(Way::of(f64::NAN), Way::Unknown);
        assert_eq!(Way::of(0.0), Way::Still);
    }
}
