//! Whether a flat drawing is wrapped around a cylinder, and the diameters that cylinders have.
//!
//! Knows: what is wrapped, where the axes are for a point of the drawing, the diameters that the program gave. Must not know:
//! words, codes, the control's settings.

use gcheck_geometry::Mm;

use crate::cylinder::Cylinder;
use crate::lattice::{Joinable, Lattice, lattice};
use crate::position::{Axis, Position};

lattice! {
    /// Cylindrical mapping.
    #[derive(Debug, Clone, Default)]
    pub(crate) struct Mapping {
        /// A linear axis wrapped around a cylinder.
        pub(crate) wrapped: Wrapped,
        /// Diameters of cylinders as the program gave them.
        pub(crate) diameters: Diameters,
    }
}

impl Mapping {
    /// Any diameter may have been given, and what was wrapped may be wrapped otherwise; what was not still is not.
    pub(crate) fn forget(&mut self) {
        if self.wrapped != Wrapped::No {
            self.wrapped = Wrapped::Unknown;
        }
        self.diameters.forget();
    }
}

/// Whether an axis is wrapped.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Wrapped {
    /// None is.
    #[default]
    No,
    /// One is.
    On(Cylinder),
    /// One may be, and nobody knows which.
    Unknown,
}

impl Wrapped {
    /// The cylinder, if an axis is wrapped for certain.
    pub const fn cylinder(&self) -> Option<&Cylinder> {
        match self {
            Self::On(cylinder) => Some(cylinder),
            Self::No | Self::Unknown => None,
        }
    }

    pub(crate) const fn cylinder_mut(&mut self) -> Option<&mut Cylinder> {
        match self {
            Self::On(cylinder) => Some(cylinder),
            Self::No | Self::Unknown => None,
        }
    }

    /// The point with the angle that its place on the drawing has.
    #[must_use]
    pub(crate) fn turned(&self, mut point: Position) -> Position {
        match self {
            Self::No => {}
            Self::On(cylinder) => point.set(cylinder.rotary, cylinder.angle(point.raw(cylinder.linear))),
            Self::Unknown => {
                for axis in Axis::ALL.into_iter().filter(|axis| axis.is_rotary()) {
                    point.set(axis, f64::NAN);
                }
            }
        }
        point
    }

    /// The point with the linear axis where it stands.
    #[must_use]
    pub(crate) fn standing(&self, mut point: Position) -> Position {
        match self {
            Self::No => {}
            Self::On(cylinder) => point.set(cylinder.linear, cylinder.stands),
            Self::Unknown => point = point.with_xyz([Mm::UNKNOWN; 3]),
        }
        point
    }
}

impl Lattice for Wrapped {
    fn join(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::No, Self::No) => Self::No,
            (Self::On(a), Self::On(b)) => a.joined(b, false).map_or(Self::Unknown, Self::On),
            _ => Self::Unknown,
        }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Unknown, _) | (Self::No, Self::No) => true,
            (Self::On(a), Self::On(b)) => a.stands_for(b),
            _ => false,
        }
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

/// By rotary axis A, B, C: the diameter that the program gave last, millimetres. `None` none yet; 0 gave the default back to
/// the control's settings.
#[derive(Debug, Clone, Copy, Default)]
pub struct Diameters([Option<f64>; 3]);

impl Diameters {
    /// The last diameter of a rotary axis.
    pub fn of(&self, rotary: Axis) -> Option<f64> {
        *self.0.get(Self::index(rotary)?)?
    }

    pub(crate) fn set(&mut self, rotary: Axis, diameter: f64) {
        if let Some(slot) = Self::index(rotary).and_then(|index| self.0.get_mut(index)) {
            *slot = Some(diameter);
        }
    }

    /// Whatever was given may have been replaced.
    pub(crate) fn forget(&mut self) {
        self.0 = [Some(f64::NAN); 3];
    }

    fn index(rotary: Axis) -> Option<usize> {
        match rotary {
            Axis::A => Some(0),
            Axis::B => Some(1),
            Axis::C => Some(2),
            _ => None,
        }
    }
}

impl Lattice for Diameters {
    fn join(&self, other: &Self) -> Self {
        Self(self.0.join(&other.0))
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        self.0.covers(&inner.0)
    }

    fn same(&self, other: &Self) -> bool {
        self.0.same(&other.0)
    }
}

impl PartialEq for Diameters {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cylinder() -> Cylinder {
        Cylinder { linear: Axis::Y, rotary: Axis::A, diameter: 100.0, stands: 5.0, zero: 0.0 }
    }

    #[test]
    fn what_may_be_one_thing_or_another_is_unknown() {
        let (on, off) = (Wrapped::On(cylinder()), Wrapped::No);
        assert_eq!(on.join(&off), Wrapped::Unknown);
        let other = Wrapped::On(Cylinder { diameter: 50.0, ..cylinder() });
        let joined = on.join(&other);
        assert!(joined.cylinder().is_some_and(|cylinder| cylinder.diameter.is_nan()));
        assert!(joined.covers(&on) && joined.covers(&other) && !on.covers(&other));
        assert!(Wrapped::Unknown.covers(&off) && !off.covers(&on));
        let point = Wrapped::Unknown.standing(Wrapped::Unknown.turned(Position::ZERO));
        assert!(point.raw(Axis::A).is_nan() && point.raw(Axis::X).is_nan());
    }

    #[test]
    fn diameters_belong_to_their_axes() {
        let mut diameters = Diameters::default();
        diameters.set(Axis::A, 50.0);
        assert_eq!((diameters.of(Axis::A), diameters.of(Axis::B)), (Some(50.0), None));
        let joined = diameters.join(&Diameters::default());
        assert!(joined.of(Axis::A).is_some_and(f64::is_nan) && joined.covers(&diameters));
        assert_eq!(joined.of(Axis::B), None);
    }
}
