//! The flat plane of polar interpolation: X and a rotary axis together make the moves that a program writes as X and Y.
//!
//! Knows: where both axes stand for a point of the plane, how far the rotary axis turns along a move. Must not know: words,
//! codes, whether the mode is on at all.
//!
//! While the mode is on, positions have the plane's coordinates on X and Y, as radii, and the angle on the rotary axis. The
//! plane's first axis points at the tool at `zero`.

use gcheck_geometry::{Degrees, Mm};

use crate::lattice::{Joinable, Lattice, merged};
use crate::position::{Axis, Position};

/// A flat plane on the face of the part. NaN is unknown.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PolarPlane {
    /// The axis that turns the part.
    pub(crate) rotary: Axis,
    /// Its angle where the plane's first axis points at the tool, degrees.
    pub(crate) zero: f64,
    /// Where the axis stands that the plane's second coordinate is written with, work coordinates.
    pub(crate) stands: f64,
    /// The tool is on the far side of the centre, where X is below zero.
    pub(crate) far: bool,
}

/// Steps in which an arc's turn about the centre is added up, radians of the arc.
const STEP: f64 = std::f64::consts::PI / 16.0;

impl PolarPlane {
    /// The plane for where the axes stand when the mode begins, with that place in it.
    pub(crate) fn begin(rotary: Axis, at: &Position, starts_at_zero: bool) -> (Self, Position) {
        let (x, angle) = (at.raw(Axis::X), at.raw(rotary));
        let zero = if starts_at_zero { angle } else { 0.0 };
        let plane = Self { rotary, zero, stands: at.raw(Axis::Y), far: x < 0.0 };
        let (sin, cos) = (angle - zero).to_radians().sin_cos();
        let mut drawn = *at;
        // Where the axis starts at zero its angle need not be known.
        let [x, y] = if starts_at_zero { [x, 0.0] } else { [x * cos, x * sin] };
        drawn.set(Axis::X, x);
        drawn.set(Axis::Y, y);
        (plane, drawn)
    }

    /// The point of the plane with the angle of the rotary axis, which comes from `from` the shorter way.
    pub(crate) fn turned(&self, mut point: Position, from: &Position) -> Position {
        let before = from.raw(self.rotary);
        let angle = self.angle(point.raw(Axis::X), point.raw(Axis::Y));
        // In the centre the tool is at every angle.
        let angle = if is_centre(&point) { before } else { angle };
        point.set(self.rotary, nearest(angle, before));
        point
    }

    /// As [`Self::turned`], at the end of an arc about `centre`; `sweep` in radians, counter-clockwise positive.
    pub(crate) fn turned_along(
        &self,
        to: Position,
        from: &Position,
        centre: (Mm, Mm),
        sweep: f64,
    ) -> Position {
        let shorter = self.turned(to, from);
        let (dx, dy) = (from.raw(Axis::X) - centre.0.0, from.raw(Axis::Y) - centre.1.0);
        let steps = (sweep.abs() / STEP).ceil();
        if !(steps.is_finite() && dx.is_finite() && dy.is_finite()) {
            return shorter;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "finite, and few turns")]
        let count = steps.clamp(1.0, 10_000.0) as u32;
        let mut turned = 0.0;
        let mut last = self.angle(from.raw(Axis::X), from.raw(Axis::Y));
        for step in 1..=count {
            let (sin, cos) = (sweep * f64::from(step) / f64::from(count)).sin_cos();
            let next = self.angle(centre.0.0 + dx * cos - dy * sin, centre.1.0 + dx * sin + dy * cos);
            turned += nearest(next, last) - last;
            last = next;
        }
        let mut to = to;
        // The end is that of the program, within what its digits leave of the arc.
        to.set(self.rotary, nearest(shorter.raw(self.rotary), from.raw(self.rotary) + turned));
        to
    }

    /// The point with X and Y where their axes stand.
    pub(crate) fn standing(&self, mut point: Position) -> Position {
        let radius = point.raw(Axis::X).hypot(point.raw(Axis::Y));
        point.set(Axis::X, if self.far { -radius } else { radius });
        point.set(Axis::Y, self.stands);
        point
    }

    /// The angle of the rotary axis at a point of the plane, between -180° and 180° from zero.
    fn angle(&self, x: f64, y: f64) -> f64 {
        let (x, y) = if self.far { (-x, -y) } else { (x, y) };
        self.zero + y.atan2(x).to_degrees()
    }
}

/// Is the tool so near to the centre that it has no angle?
fn is_centre(point: &Position) -> bool {
    point.raw(Axis::X).hypot(point.raw(Axis::Y)) < 1e-9
}

/// An angle as it is the shorter way from another one, degrees.
fn nearest(angle: f64, from: f64) -> f64 {
    Degrees(angle).nearest_to(Degrees(from)).0
}

/// About another axis, or from the other side, it is another plane.
impl Joinable for PolarPlane {
    fn joined(&self, other: &Self, _: bool) -> Option<Self> {
        let Self { rotary, zero, stands, far } = *self;
        ((rotary, far) == (other.rotary, other.far)).then(|| Self {
            rotary,
            far,
            zero: merged!(PolarPlane.zero, zero, zero.join(&other.zero)),
            stands: merged!(PolarPlane.stands, stands, stands.join(&other.stands)),
        })
    }

    fn stands_for(&self, inner: &Self) -> bool {
        let Self { rotary, zero, stands, far } = *self;
        (rotary, far) == (inner.rotary, inner.far) && zero.covers(&inner.zero) && stands.covers(&inner.stands)
    }

    fn is_same(&self, other: &Self) -> bool {
        let Self { rotary, zero, stands, far } = *self;
        (rotary, far) == (other.rotary, other.far) && zero.same(&other.zero) && stands.same(&other.stands)
    }
}

impl PartialEq for PolarPlane {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64, c: f64) -> Position {
        let mut point = Position::ZERO;
        for (axis, value) in [(Axis::X, x), (Axis::Y, y), (Axis::C, c)] {
            point.set(axis, value);
        }
        point
    }

    fn stands(point: &Position) -> String {
        [Axis::X, Axis::Y, Axis::C]
            .map(|axis| format!("{}{}", axis.name(), (point.raw(axis) * 1e6).round() / 1e6 + 0.0))
            .join(" ")
    }

    #[test]
    fn a_straight_line_turns_the_part_the_shorter_way() {
        let (plane, begun) = PolarPlane::begin(Axis::C, &at(20.0, 5.0, 90.0), true);
        assert_eq!(stands(&begun), "X20 Y0 C90");
        let corner = plane.turned(at(0.0, 20.0, f64::NAN), &begun);
        assert_eq!(stands(&plane.standing(corner)), "X20 Y5 C180");
        let beyond = plane.turned(at(-20.0, -1.0, f64::NAN), &corner);
        assert!((plane.standing(beyond).raw(Axis::C) - 272.862_405).abs() < 1e-6);
    }

    #[test]
    fn an_arc_about_the_centre_turns_the_part_all_round() {
        let (plane, begun) = PolarPlane::begin(Axis::C, &at(20.0, 0.0, 0.0), false);
        let whole = plane.turned_along(begun, &begun, (Mm(0.0), Mm(0.0)), std::f64::consts::TAU);
        assert_eq!(stands(&whole), "X20 Y0 C360");
        let beside = plane.turned_along(begun, &begun, (Mm(15.0), Mm(0.0)), -std::f64::consts::TAU);
        assert_eq!(stands(&beside), "X20 Y0 C0");
    }

    #[test]
    fn the_centre_keeps_the_angle() {
        let (plane, begun) = PolarPlane::begin(Axis::C, &at(10.0, 0.0, 30.0), true);
        assert_eq!(stands(&plane.turned(at(0.0, 0.0, f64::NAN), &begun)), "X0 Y0 C30");
    }

    #[test]
    fn a_tool_beyond_the_centre_stays_there() {
        let (plane, begun) = PolarPlane::begin(Axis::C, &at(-10.0, 0.0, 0.0), true);
        let turned = plane.turned(at(0.0, -10.0, f64::NAN), &begun);
        assert_eq!(stands(&plane.standing(turned)), "X-10 Y0 C90");
    }
}
