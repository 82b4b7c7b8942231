//! By how much a path may leave a corner that two runs take differently.
//!
//! Knows: directions and lengths of the two moves of a corner, tolerances. Must not know: how a control rounds corners, words.

use gcheck_engine::{Axis, Position};

use super::curve::Curve;
use super::same::corners_differ;
use crate::corner_mode::CornerMode;

/// The part of a move that shows its direction at an end.
const TIP: f64 = 1e-4;
/// Turns by less, in radians, are no corners.
const STRAIGHT: f64 = 1e-3;

/// By how much two paths may differ at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Off {
    /// By no more than this, millimetres.
    Within(f64),
    /// One of the runs has no tolerance.
    Untold,
}

/// The end of a cutting move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaving {
    way: [f64; 3],
    length: f64,
}

impl Leaving {
    pub(super) fn new(curve: &Curve) -> Self {
        Self { way: way(&curve.at(1.0 - TIP), &curve.at(1.0)), length: curve.length() }
    }

    /// By how much the path may differ at the corner with the move that follows; `None` where it does not.
    ///
    /// A rounding stays within half of each move, so that it is at most as far from the corner as a circle that touches both
    /// there; where a tolerance is less, it counts.
    pub(super) fn off(self, next: &Curve, modes: [CornerMode; 2]) -> Option<Off> {
        if !corners_differ(modes) {
            return None;
        }
        let turn = angle(self.way, way(&next.at(0.0), &next.at(TIP)))?;
        if turn < STRAIGHT {
            return None;
        }
        let (sin, cos) = (turn / 2.0).sin_cos();
        let reach = self.length.min(next.length()) / 2.0;
        let room = if cos > 1e-6 { reach * (1.0 - cos) / sin } else { reach };
        let tolerance = modes.iter().map(CornerMode::tolerance).fold(0.0, f64::max);
        if tolerance <= 0.0 {
            return None;
        }
        Some(if tolerance.is_finite() { Off::Within(tolerance.min(room)) } else { Off::Untold })
    }
}

fn way(from: &Position, to: &Position) -> [f64; 3] {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| {
        let way = to.raw(axis) - from.raw(axis);
        if way.is_nan() { 0.0 } else { way }
    })
}

/// The angle between two directions, radians.
fn angle(one: [f64; 3], other: [f64; 3]) -> Option<f64> {
    let dot: f64 = one.iter().zip(other).map(|(a, b)| a * b).sum();
    let size = |way: [f64; 3]| way.iter().fold(0.0, |sum: f64, part| sum.hypot(*part));
    let sizes = size(one) * size(other);
    (sizes > 0.0).then(|| (dot / sizes).clamp(-1.0, 1.0).acos())
}
