//! A flat drawing wrapped around a cylinder: the moves of one linear axis turn a rotary axis.
//!
//! Knows: which axes belong together, where the linear one stands meanwhile, which angle a point of the drawing has. Must not
//! know: words, codes, where a diameter comes from, whether an axis is wrapped at all.
//!
//! While an axis is wrapped, its coordinate is the one on the unrolled surface; the axis itself does not move.

use gcheck_geometry::Mm;
use gcheck_geometry::cylinder::angle_of_unrolled;

use crate::lattice::{Joinable, Lattice, merged};
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
}

/// On other axes it is another cylinder.
impl Joinable for Cylinder {
    fn joined(&self, other: &Self, _: bool) -> Option<Self> {
        let Self { linear, rotary, diameter, stands, zero } = *self;
        ((linear, rotary) == (other.linear, other.rotary)).then(|| Self {
            linear,
            rotary,
            diameter: merged!(Cylinder.diameter, diameter, diameter.join(&other.diameter)),
            stands: merged!(Cylinder.stands, stands, stands.join(&other.stands)),
            zero: merged!(Cylinder.zero, zero, zero.join(&other.zero)),
        })
    }

    fn stands_for(&self, inner: &Self) -> bool {
        let Self { linear, rotary, diameter, stands, zero } = *self;
        (linear, rotary) == (inner.linear, inner.rotary)
            && diameter.covers(&inner.diameter)
            && stands.covers(&inner.stands)
            && zero.covers(&inner.zero)
    }

    fn is_same(&self, other: &Self) -> bool {
        let Self { linear, rotary, diameter, stands, zero } = *self;
        (linear, rotary) == (other.linear, other.rotary)
            && diameter.same(&other.diameter)
            && stands.same(&other.stands)
            && zero.same(&other.zero)
    }
}

impl PartialEq for Cylinder {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other)
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
        assert!((on_a.angle(at.raw(Axis::Y)) - 30.0).abs() < 1e-9);
    }

    #[test]
    fn without_a_diameter_no_angle_is_known() {
        for diameter in [0.0, f64::NAN] {
            let none = Cylinder { diameter, ..cylinder() };
            assert!(none.angle(1.0).is_nan() && none.angle(0.0).is_nan());
        }
    }
}
