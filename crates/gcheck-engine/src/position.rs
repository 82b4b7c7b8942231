//! Axes and points.
//!
//! Knows: nine axes, which of them turn, and that a coordinate may be unknown. Must not know: codes, offsets, planes.

use std::ops::{Add, Sub};

use gcheck_controls::Letter;
use gcheck_geometry::{Degrees, Mm};
use nalgebra::{Rotation2, Vector2};

use crate::lattice::Lattice;

/// An axis of the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "the names are the axes")]
pub enum Axis {
    X,
    Y,
    Z,
    A,
    B,
    C,
    U,
    V,
    W,
}

impl Axis {
    /// All axes, in the order of [`Position`].
    pub const ALL: [Self; 9] =
        [Self::X, Self::Y, Self::Z, Self::A, Self::B, Self::C, Self::U, Self::V, Self::W];
    /// The rotary axes, in the same order.
    pub const ABC: [Self; 3] = [Self::A, Self::B, Self::C];

    /// Place in [`Position`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The address that names the axis.
    pub const fn letter(self) -> Letter {
        Letter::of(self.name())
    }

    /// `X` to `W`.
    pub const fn name(self) -> char {
        match self {
            Self::X => 'X',
            Self::Y => 'Y',
            Self::Z => 'Z',
            Self::A => 'A',
            Self::B => 'B',
            Self::C => 'C',
            Self::U => 'U',
            Self::V => 'V',
            Self::W => 'W',
        }
    }

    /// The axis of an address.
    pub fn of(letter: Letter) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| axis.letter() == letter)
    }

    /// Turns, so that it is measured in degrees.
    pub const fn is_rotary(self) -> bool {
        matches!(self, Self::A | Self::B | Self::C)
    }
}

/// A point: millimetres on linear axes, degrees on rotary ones. A coordinate that nobody knows is NaN, which every sum
/// with it stays.
#[derive(Debug, Clone, Copy)]
pub struct Position([f64; 9]);

impl Position {
    /// All axes at zero.
    pub const ZERO: Self = Self([0.0; 9]);
    /// Nothing is known.
    pub const UNKNOWN: Self = Self([f64::NAN; 9]);

    /// From numbers in the order of [`Axis::ALL`].
    pub const fn new(values: [f64; 9]) -> Self {
        Self(values)
    }

    /// The numbers in the order of [`Axis::ALL`].
    pub const fn values(&self) -> &[f64; 9] {
        &self.0
    }

    /// The coordinate, NaN when unknown.
    #[expect(clippy::indexing_slicing, reason = "an axis is below nine")]
    #[inline]
    pub const fn raw(&self, axis: Axis) -> f64 {
        self.0[axis.index()]
    }

    /// The coordinate, if known.
    #[inline]
    pub fn get(&self, axis: Axis) -> Option<f64> {
        Some(self.raw(axis)).filter(|value| !value.is_nan())
    }

    /// Sets a coordinate.
    #[expect(clippy::indexing_slicing, reason = "an axis is below nine")]
    pub const fn set(&mut self, axis: Axis, value: f64) {
        self.0[axis.index()] = value;
    }

    /// X, Y and Z.
    pub fn xyz(&self) -> [Mm; 3] {
        let [x, y, z, ..] = self.0;
        [Mm(x), Mm(y), Mm(z)]
    }

    /// Replaces X, Y and Z.
    #[must_use]
    pub fn with_xyz(mut self, [x, y, z]: [Mm; 3]) -> Self {
        self.set(Axis::X, x.0);
        self.set(Axis::Y, y.0);
        self.set(Axis::Z, z.0);
        self
    }

    /// A, B and C.
    pub fn abc(&self) -> [Degrees; 3] {
        let [_, _, _, a, b, c, ..] = self.0;
        [Degrees(a), Degrees(b), Degrees(c)]
    }

    /// Is one of the coordinates more than `by` away from that of `other`? Unknown ones are not.
    ///
    /// Looks at all axes at once: this is asked of moves by the million.
    #[inline]
    pub fn is_apart(&self, other: &Self, by: f64) -> bool {
        self.0.iter().zip(&other.0).fold(false, |apart, (own, other)| apart | ((own - other).abs() > by))
    }

    /// Is every coordinate known?
    pub fn is_known(&self) -> bool {
        self.0.iter().all(|value| !value.is_nan())
    }

    /// Turned about Z by degrees; nothing is touched at zero, so that unknown coordinates stay apart.
    #[must_use]
    pub fn turned(self, degrees: f64) -> Self {
        if degrees == 0.0 {
            return self;
        }
        let [x, y, z] = self.xyz();
        let turned = Rotation2::new(degrees.to_radians()) * Vector2::new(x.0, y.0);
        self.with_xyz([Mm(turned.x), Mm(turned.y), z])
    }

    fn zip(&self, other: &Self, with: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = *self;
        for axis in Axis::ALL {
            result.set(axis, with(self.raw(axis), other.raw(axis)));
        }
        result
    }
}

/// Coordinates each by themselves.
impl Lattice for Position {
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

impl PartialEq for Position {
    /// Bit by bit, so that unknown equals unknown.
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}

impl Eq for Position {}

impl Add for Position {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip(&other, |a, b| a + b)
    }
}

impl Sub for Position {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.zip(&other, |a, b| a - b)
    }
}
