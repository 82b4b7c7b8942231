//! Vectors, lines and circles of the compensation plane.
//!
//! Knows two coordinates and nothing else; must not know tools, sides or corners.

use std::f64::consts::{PI, TAU};
use std::ops::{Add, Mul, Neg, Sub};

/// A point or a direction in the plane, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vector {
    pub(super) first: f64,
    pub(super) second: f64,
}

impl Vector {
    pub(super) const ZERO: Self = Self { first: 0.0, second: 0.0 };

    pub(super) const fn new(first: f64, second: f64) -> Self {
        Self { first, second }
    }

    pub(super) fn dot(self, other: Self) -> f64 {
        self.first * other.first + self.second * other.second
    }

    /// Positive when `other` lies counter-clockwise of `self`.
    pub(super) fn cross(self, other: Self) -> f64 {
        self.first * other.second - self.second * other.first
    }

    pub(super) fn length(self) -> f64 {
        self.first.hypot(self.second)
    }

    /// The direction of this vector; zero for the zero vector.
    pub(super) fn unit(self) -> Self {
        let length = self.length();
        if length > 0.0 { self * (1.0 / length) } else { Self::ZERO }
    }

    /// Turned a quarter counter-clockwise.
    pub(super) fn left(self) -> Self {
        Self::new(-self.second, self.first)
    }

    pub(super) fn angle(self) -> f64 {
        self.second.atan2(self.first)
    }

    /// The turn from `self` to `other`, in (-pi, pi], counter-clockwise positive.
    pub(super) fn turn_to(self, other: Self) -> f64 {
        let turn = self.cross(other).atan2(self.dot(other));
        if turn <= -PI { PI } else { turn }
    }
}

impl Add for Vector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.first + other.first, self.second + other.second)
    }
}

impl Sub for Vector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.first - other.first, self.second - other.second)
    }
}

impl Mul<f64> for Vector {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.first * factor, self.second * factor)
    }
}

impl Neg for Vector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.first, -self.second)
    }
}

/// The angle swept from one direction to another, in [0, 2 pi).
pub(super) fn sweep(from: Vector, to: Vector, ccw: bool) -> f64 {
    let difference = if ccw { to.angle() - from.angle() } else { from.angle() - to.angle() };
    let turned = difference.rem_euclid(TAU);
    // rem_euclid may round up to the modulus itself.
    if turned >= TAU { 0.0 } else { turned }
}

/// A directed curve that an offset segment lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Curve {
    /// `direction` has length one.
    Line {
        point: Vector,
        direction: Vector,
    },
    Circle {
        centre: Vector,
        radius: f64,
        ccw: bool,
    },
}

impl Curve {
    pub(super) fn moved(self, by: Vector) -> Self {
        match self {
            Self::Line { point, direction } => Self::Line { point: point + by, direction },
            Self::Circle { centre, radius, ccw } => Self::Circle { centre: centre + by, radius, ccw },
        }
    }

    /// The direction of travel at a point of the curve.
    fn tangent(self, at: Vector) -> Vector {
        match self {
            Self::Line { direction, .. } => direction,
            Self::Circle { centre, ccw, .. } => {
                let tangent = (at - centre).unit().left();
                if ccw { tangent } else { -tangent }
            }
        }
    }
}

/// How two offset curves meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meeting {
    /// The point where a path along the first curve turns onto the second.
    At(Vector),
    /// They do not meet.
    Apart,
    /// Circles about the same point.
    Concentric,
}

/// The point where a path along `before` turns onto `after`, to the left or to the right.
///
/// Two curves that cross twice turn left at one crossing and right at the other.
pub(super) fn meet(before: Curve, after: Curve, turn_left: bool) -> Meeting {
    let (middle, across, half) = match (before, after) {
        (
            Curve::Line { point, direction },
            Curve::Line { point: other_point, direction: other_direction },
        ) => {
            let along = (other_point - point).cross(other_direction) / direction.cross(other_direction);
            return if along.is_finite() { Meeting::At(point + direction * along) } else { Meeting::Apart };
        }
        (Curve::Line { point, direction }, Curve::Circle { centre, radius, .. })
        | (Curve::Circle { centre, radius, .. }, Curve::Line { point, direction }) => {
            let foot = point + direction * (centre - point).dot(direction);
            let distance = (centre - foot).length();
            (foot, direction, ((radius - distance) * (radius + distance)).sqrt())
        }
        (
            Curve::Circle { centre, radius, .. },
            Curve::Circle { centre: other_centre, radius: other_radius, .. },
        ) => {
            let between = other_centre - centre;
            let distance = between.length();
            if distance < CONCENTRIC {
                return Meeting::Concentric;
            }
            let along = f64::midpoint(distance, (radius - other_radius) * (radius + other_radius) / distance);
            let axis = between * (1.0 / distance);
            (centre + axis * along, axis.left(), ((radius - along) * (radius + along)).sqrt())
        }
    };
    // The root of a negative number is not a number.
    if !half.is_finite() {
        return Meeting::Apart;
    }
    let (one, other) = (middle + across * half, middle - across * half);
    let turn = |at: Vector| before.tangent(at).cross(after.tangent(at));
    if (turn(one) >= turn(other)) == turn_left { Meeting::At(one) } else { Meeting::At(other) }
}

/// Centres closer than this (mm) are one centre.
const CONCENTRIC: f64 = 1e-6;
