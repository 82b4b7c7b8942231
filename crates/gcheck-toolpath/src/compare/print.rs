//! What a section cuts, in a few numbers that say whether two sections may be the same.
//!
//! Knows: lengths, centres and spreads of paths. Must not know: sections, which of them are paired.
//!
//! The numbers are sums along the path. They do not depend on how it is cut into blocks, and they are compared with a tolerance:
//! rounded ones would tell two sections apart that are on two sides of a step. Two sections with the same print may still
//! differ; only their comparison says so.

use gcheck_engine::{Axis, Position};

use super::curve::Curve;
use crate::trail::Move;

const XYZ: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];
/// The part of a size that counts as the same: chords are a little shorter than their arc.
const SAME: f64 = 1e-3;

/// Sums along what is cut.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Print {
    moves: f64,
    length: f64,
    /// Of a coordinate, and of its square, along the path.
    sums: [[f64; 3]; 2],
}

impl Print {
    /// Takes in a cutting move.
    pub(super) fn add(&mut self, made: &Move) {
        let curve = Curve::new(made);
        let length = curve.length();
        if length <= 0.0 || curve.is_open() {
            return;
        }
        self.moves += 1.0;
        self.length += length;
        let pieces = made.arc.as_ref().map_or(1, |_| curve.checks(&curve));
        let part = length / f64::from(pieces);
        let mut from = curve.at(0.0);
        for piece in 1..=pieces {
            let to = curve.at(f64::from(piece) / f64::from(pieces));
            self.add_line(&from, &to, part);
            from = to;
        }
    }

    fn add_line(&mut self, from: &Position, to: &Position, length: f64) {
        let [firsts, seconds] = &mut self.sums;
        for (axis, (first, second)) in XYZ.into_iter().zip(firsts.iter_mut().zip(seconds)) {
            let (from, to) = (from.raw(axis), to.raw(axis));
            if !from.is_nan() && !to.is_nan() {
                *first += length * (from + to) / 2.0;
                *second += length * (from * from + from * to + to * to) / 3.0;
            }
        }
    }

    /// Is anything cut?
    pub(super) fn is_empty(&self) -> bool {
        self.length <= 0.0
    }

    /// May the two be the same, if each point of a path is within `tolerance` millimetres of the other path?
    pub(super) fn is_like(&self, other: &Self, tolerance: f64) -> bool {
        // A move may be longer or shorter by what both its ends are off.
        let slack = 2.0 * tolerance * (self.moves + other.moves) + SAME * self.length.max(other.length);
        if self.is_empty() || other.is_empty() {
            return self.is_empty() == other.is_empty();
        }
        (self.length - other.length).abs() <= slack
            && self.spreads().into_iter().zip(other.spreads()).all(|((centre, spread), (of_other, other))| {
                let slack = 2.0 * tolerance + 2.0 * SAME * spread.max(other);
                (centre - of_other).abs() <= slack && (spread - other).abs() <= slack + root_of_noise(centre)
            })
    }

    /// On each axis: the centre of the path, and how far it is spread around it.
    fn spreads(&self) -> [(f64, f64); 3] {
        let [firsts, seconds] = self.sums;
        let mut spreads = [(0.0, 0.0); 3];
        for (spread, (first, second)) in spreads.iter_mut().zip(firsts.into_iter().zip(seconds)) {
            let centre = first / self.length;
            *spread = (centre, (second / self.length - centre * centre).max(0.0).sqrt());
        }
        spreads
    }
}

/// What computing leaves in a spread that is none, far from the zero.
fn root_of_noise(centre: f64) -> f64 {
    1e-6 * centre.abs()
}
