//! Whether a flat drawing is wrapped around a cylinder, or lies on the face of a part that turns, and the diameters that
//! cylinders have.
//!
//! Knows: what is mapped, where the axes are for a point of the drawing, the diameters that the program gave. Must not know:
//! words, codes, the control's settings.

use gcheck_geometry::tilted_plane::by_euler_angles;
use gcheck_geometry::{Degrees, Frame, Mm};

use crate::cylinder::Cylinder;
use crate::lattice::{Lattice, Perhaps, lattice};
use crate::polar_plane::PolarPlane;
use crate::position::{Axis, Position};

lattice! {
    /// Drawings that the machine's axes follow otherwise than as they are written.
    #[derive(Debug, Clone, Default)]
    pub(crate) struct Mapping {
        /// A linear axis wrapped around a cylinder.
        pub(crate) wrapped: Perhaps<Cylinder>,
        /// The face of the part, where X and a rotary axis make its moves.
        pub(crate) face: Perhaps<PolarPlane>,
        /// A plane that lies tilted in the part.
        pub(crate) tilted: Perhaps<TiltedPlane>,
        /// Diameters of cylinders as the program gave them.
        pub(crate) diameters: Diameters,
    }
}

lattice! {
    /// A plane that lies tilted in the part, by its origin in the coordinates before (millimetres) and three turns (degrees).
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct TiltedPlane {
        /// Its origin.
        pub(crate) origin: [f64; 3],
        /// About Z, about the new X, about the new Z.
        pub(crate) turns: [f64; 3],
    }
}

impl TiltedPlane {
    /// From its coordinates to those before.
    pub(crate) fn frame(&self) -> Frame {
        by_euler_angles(self.origin.map(Mm), self.turns.map(Degrees))
    }
}

impl Mapping {
    /// Any diameter may have been given, and what was wrapped may be wrapped otherwise; what was not still is not.
    pub(crate) fn forget(&mut self) {
        self.wrapped = self.wrapped.or_other();
        self.face = self.face.or_other();
        self.tilted = self.tilted.or_other();
        self.diameters.forget();
    }

    /// A point with the angle that its place on the drawing has; the axes come from `from`.
    #[must_use]
    pub(crate) fn turned(&self, mut point: Position, from: &Position) -> Position {
        match &self.wrapped {
            Perhaps::No => {}
            Perhaps::Yes(cylinder) => point.set(cylinder.rotary, cylinder.angle(point.raw(cylinder.linear))),
            Perhaps::Unknown => point = without_rotary(point),
        }
        match &self.face {
            Perhaps::No => point,
            Perhaps::Yes(plane) => plane.turned(point, from),
            Perhaps::Unknown => without_rotary(point),
        }
    }

    /// As [`Self::turned`], at the end of an arc of X and Y.
    #[must_use]
    pub(crate) fn turned_along(
        &self,
        point: Position,
        from: &Position,
        centre: (Mm, Mm),
        sweep: f64,
    ) -> Position {
        match &self.face {
            Perhaps::Yes(plane) => plane.turned_along(point, from, centre, sweep),
            Perhaps::No | Perhaps::Unknown => self.turned(point, from),
        }
    }

    /// A point with linear axes where they stand.
    #[must_use]
    pub(crate) fn standing(&self, point: Position) -> Position {
        self.off_face(self.unwrapped(point))
    }

    /// A point with the wrapped axis where it stands.
    #[must_use]
    pub(crate) fn unwrapped(&self, mut point: Position) -> Position {
        match &self.wrapped {
            Perhaps::No => {}
            Perhaps::Yes(cylinder) => point.set(cylinder.linear, cylinder.stands),
            Perhaps::Unknown => point = point.with_xyz([Mm::UNKNOWN; 3]),
        }
        point
    }

    /// A point of the face with X and Y where their axes stand.
    #[must_use]
    pub(crate) fn off_face(&self, mut point: Position) -> Position {
        match &self.face {
            Perhaps::No => {}
            Perhaps::Yes(plane) => point = plane.standing(point),
            Perhaps::Unknown => {
                point.set(Axis::X, f64::NAN);
                point.set(Axis::Y, f64::NAN);
            }
        }
        point
    }
}

fn without_rotary(mut point: Position) -> Position {
    for axis in Axis::ALL.into_iter().filter(|axis| axis.is_rotary()) {
        point.set(axis, f64::NAN);
    }
    point
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
        let (on, off) = (Perhaps::Yes(cylinder()), Perhaps::No);
        assert_eq!(on.join(&off), Perhaps::Unknown);
        let other = Perhaps::Yes(Cylinder { diameter: 50.0, ..cylinder() });
        let joined = on.join(&other);
        assert!(joined.yes().is_some_and(|cylinder| cylinder.diameter.is_nan()));
        assert!(joined.covers(&on) && joined.covers(&other) && !on.covers(&other));
        assert!(Perhaps::Unknown.covers(&off) && !off.covers(&on));
        let mapping = Mapping { wrapped: Perhaps::Unknown, ..Mapping::default() };
        let point = mapping.standing(mapping.turned(Position::ZERO, &Position::ZERO));
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
