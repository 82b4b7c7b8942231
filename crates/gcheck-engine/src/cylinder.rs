//! A flat drawing wrapped around a cylinder: the moves of one linear axis turn a rotary axis.
//!
//! Knows: which axes belong together, where the linear one stands meanwhile, which angle a point of the drawing has. Must not
//! know: words, codes, where a diameter comes from.
//!
//! While an axis is wrapped, its coordinate is the one on the unrolled surface; the axis itself does not move.

use gcheck_geometry::Mm;
use gcheck_geometry::cylinder::angle_of_unrolled;

use crate::number::{either, stands_for};
use crate::position::{Axis, Position};

/// A linear axis wrapped around a cylinder on a rotary axis. NaN is unknown.
#[derive(Debug, Clone, Copy)]
pub struct Cylinder {
    /// The linear axis whose moves are wrapped.
    pub linear: Axis,
    /// The rotary axis that turns instead.
    pub rotary: Axis,
    /// Diameter of the surface, millimetres.
    pub diameter: f64,
    /// Where the linear axis itself stands, work coordinates.
    pub stands: f64,
    /// Angle of the rotary axis at the drawing's zero, work coordinates.
    pub zero: f64,
}

impl Cylinder {
    /// Angle of the rotary axis at a coordinate of the drawing, millimetres.
    pub fn angle(&self, coordinate: f64) -> f64 {
        let turned = angle_of_unrolled(Mm(coordinate), Mm(self.diameter)).0;
        let angle = self.zero + turned;
        // A cylinder without a diameter has no angles.
        if angle.is_finite() { angle } else { f64::NAN }
    }

    /// Makes the drawing continue from where both axes are: `at` has the drawing's coordinate on the linear axis.
    pub(crate) fn anchor(&mut self, at: &Position) {
        self.zero = 0.0;
        self.zero = at.raw(self.rotary) - self.angle(at.raw(self.linear));
    }

    fn numbers(&self) -> [f64; 3] {
        [self.diameter, self.stands, self.zero]
    }

    fn same_axes(&self, other: &Self) -> bool {
        (self.linear, self.rotary) == (other.linear, other.rotary)
    }
}

impl PartialEq for Cylinder {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.same_axes(other) && self.numbers().map(f64::to_bits) == other.numbers().map(f64::to_bits)
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

    /// Either.
    pub(crate) fn join(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::No, Self::No) => Self::No,
            (Self::On(a), Self::On(b)) if a.same_axes(b) => Self::On(Cylinder {
                diameter: either(a.diameter, b.diameter),
                stands: either(a.stands, b.stands),
                zero: either(a.zero, b.zero),
                ..*a
            }),
            _ => Self::Unknown,
        }
    }

    /// Is everything that `inner` stands for something that this stands for?
    pub(crate) fn contains(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Unknown, _) | (Self::No, Self::No) => true,
            (Self::On(a), Self::On(b)) => {
                a.same_axes(b) && a.numbers().into_iter().zip(b.numbers()).all(|(a, b)| stands_for(a, b))
            }
            _ => false,
        }
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

    pub(crate) fn join(&self, other: &Self) -> Self {
        let mut joined = *self;
        for (slot, with) in joined.0.iter_mut().zip(other.0) {
            if slot.map(f64::to_bits) != with.map(f64::to_bits) {
                *slot = Some(f64::NAN);
            }
        }
        joined
    }

    pub(crate) fn contains(&self, inner: &Self) -> bool {
        self.0
            .iter()
            .zip(inner.0)
            .all(|(a, b)| a.is_some_and(f64::is_nan) || a.map(f64::to_bits) == b.map(f64::to_bits))
    }
}

impl PartialEq for Diameters {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.0.map(|diameter| diameter.map(f64::to_bits))
            == other.0.map(|diameter| diameter.map(f64::to_bits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cylinder() -> Cylinder {
        Cylinder { linear: Axis::Y, rotary: Axis::A, diameter: 100.0, stands: 5.0, zero: 0.0 }
    }

    #[test]
    fn a_circumference_is_a_turn_both_ways() {
        let around = 100.0 * std::f64::consts::PI;
        assert!((cylinder().angle(around) - 360.0).abs() < 1e-9);
        assert!((cylinder().angle(-around / 4.0) + 90.0).abs() < 1e-9);
    }

    #[test]
    fn a_drawing_continues_from_where_the_axes_are() {
        let mut on_a = cylinder();
        let mut at = Position::ZERO;
        at.set(Axis::Y, 50.0 * std::f64::consts::PI);
        at.set(Axis::A, 30.0);
        on_a.anchor(&at);
        assert!((on_a.angle(0.0) + 150.0).abs() < 1e-9);
        assert!((Wrapped::On(on_a).turned(at).raw(Axis::A) - 30.0).abs() < 1e-9);
    }

    #[test]
    fn without_a_diameter_no_angle_is_known() {
        for diameter in [0.0, f64::NAN] {
            let none = Cylinder { diameter, ..cylinder() };
            assert!(none.angle(1.0).is_nan() && none.angle(0.0).is_nan());
        }
    }

    #[test]
    fn what_may_be_one_thing_or_another_is_unknown() {
        let (on, off) = (Wrapped::On(cylinder()), Wrapped::No);
        assert_eq!(on.join(&off), Wrapped::Unknown);
        let other = Wrapped::On(Cylinder { diameter: 50.0, ..cylinder() });
        let joined = on.join(&other);
        assert!(joined.cylinder().is_some_and(|cylinder| cylinder.diameter.is_nan()));
        assert!(joined.contains(&on) && joined.contains(&other) && !on.contains(&other));
        assert!(Wrapped::Unknown.contains(&off) && !off.contains(&on));
        let point = Wrapped::Unknown.standing(Wrapped::Unknown.turned(Position::ZERO));
        assert!(point.raw(Axis::A).is_nan() && point.raw(Axis::X).is_nan());
    }

    #[test]
    fn diameters_belong_to_their_axes() {
        let mut diameters = Diameters::default();
        diameters.set(Axis::A, 50.0);
        assert_eq!((diameters.of(Axis::A), diameters.of(Axis::B)), (Some(50.0), None));
        let joined = diameters.join(&Diameters::default());
        assert!(joined.of(Axis::A).is_some_and(f64::is_nan) && joined.contains(&diameters));
        assert_eq!(joined.of(Axis::B), None);
    }
}
