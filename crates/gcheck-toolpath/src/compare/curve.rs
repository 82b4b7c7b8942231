//! The path of one move, to go along and to find places on.
//!
//! Knows: lines and arcs over nine axes, of which some may be unknown. Must not know: what is compared.

use std::f64::consts::{FRAC_PI_4, TAU};

use gcheck_engine::{Axis, Position};
use gcheck_geometry::{Arc, Mm};

use crate::trail::Move;

/// A path from 0 to 1. Axes of which nothing is known stay unknown all along.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    from: Position,
    to: Position,
    arc: Option<Arc>,
    length: f64,
    /// It starts at a place that is unknown on an axis that has a known end.
    open: bool,
}

impl Curve {
    pub(super) fn new(made: &Move) -> Self {
        let mut from = made.from;
        let mut open = false;
        for axis in Axis::ALL {
            if from.raw(axis).is_nan() && !made.to.raw(axis).is_nan() {
                open = true;
                from.set(axis, made.to.raw(axis));
            }
        }
        let way = |axes: [Axis; 3]| {
            let ways = axes.map(|axis| made.to.raw(axis) - from.raw(axis));
            ways.into_iter().filter(|way| !way.is_nan()).fold(0.0, f64::hypot)
        };
        let xyz = made.arc.map_or_else(|| way([Axis::X, Axis::Y, Axis::Z]), |arc| arc.length().0);
        // The parts of the way that the other axes make are their own: a length is only there to tell which move is shorter.
        let length = [xyz, way([Axis::U, Axis::V, Axis::W]), way([Axis::A, Axis::B, Axis::C])];
        let length = length.into_iter().find(|length| *length > 0.0).unwrap_or(0.0);
        Self { from, to: made.to, arc: made.arc.filter(|_| !open), length, open }
    }

    pub(super) const fn is_open(&self) -> bool {
        self.open
    }

    /// Is a part of it unknown that every machine has?
    pub(super) fn is_unknown(&self) -> bool {
        self.open || [Axis::X, Axis::Z].into_iter().any(|axis| self.to.raw(axis).is_nan())
    }

    /// Two ways from unknown places: do they lead to known ones on the same axes? First down and then across is another way
    /// than first across and then down.
    pub(super) fn go_for_the_same(a: &Self, b: &Self) -> bool {
        let is_known = |curve: &Self, axis| !curve.to.raw(axis).is_nan();
        let xyz = [Axis::X, Axis::Y, Axis::Z];
        !a.open || !b.open || xyz.into_iter().all(|axis| is_known(a, axis) == is_known(b, axis))
    }

    /// May a move of which only unknown axes are left be what the other one does? Then that one moves along these axes alone.
    pub(super) fn may_go_as(&self, other: &Self, tolerance: f64) -> bool {
        let mut goes_unseen = false;
        for axis in Axis::ALL {
            let (from, to) = (other.from.raw(axis), other.to.raw(axis));
            let own = self.to.raw(axis);
            let moves = (from - to).abs() > 1e-9;
            if own.is_nan() {
                goes_unseen |= moves;
            } else if moves || (own - to).abs() > tolerance {
                return false;
            }
        }
        goes_unseen && other.arc.is_none() && !other.open
    }

    /// Does nothing move?
    pub(super) fn is_nothing(&self) -> bool {
        !self.open && self.length <= 1e-9
    }

    pub(super) const fn length(&self) -> f64 {
        self.length
    }

    pub(super) const fn end(&self) -> Position {
        self.to
    }

    pub(super) fn at(&self, part: f64) -> Position {
        if part >= 1.0 {
            return self.to;
        }
        let mut at = self.from;
        for axis in Axis::ALL {
            let (from, to) = (self.from.raw(axis), self.to.raw(axis));
            at.set(axis, from + (to - from) * part);
        }
        match &self.arc {
            Some(arc) => at.with_xyz(arc.point_at(part)),
            None => at,
        }
    }

    /// At how many places it has to be near to another curve to be near to it everywhere.
    pub(super) fn checks(&self, other: &Self) -> u32 {
        let sweeps = [self, other].map(|curve| curve.arc.map_or(0.0, |arc| arc.sweep().abs()));
        let sweep = sweeps.into_iter().fold(0.0, f64::max);
        if self.arc.is_none() && other.arc.is_none() {
            return 1;
        }
        #[expect(clippy::cast_sign_loss, reason = "8 at least")]
        let count = (sweep / FRAC_PI_4).ceil().clamp(8.0, 4_096.0) as u32;
        count
    }

    /// The part of the curve nearest to a point, not before `least`.
    pub(super) fn nearest(&self, point: &Position, least: f64) -> f64 {
        match &self.arc {
            Some(arc) => Self::nearest_on_arc(arc, point, least),
            None => {
                let (mut along, mut square) = (0.0, 0.0);
                for axis in Axis::ALL {
                    let chord = self.to.raw(axis) - self.from.raw(axis);
                    let offset = point.raw(axis) - self.from.raw(axis);
                    if chord.is_finite() && offset.is_finite() {
                        along += chord * offset;
                        square += chord * chord;
                    }
                }
                if square > 0.0 { (along / square).clamp(least, 1.0) } else { 1.0 }
            }
        }
    }

    fn nearest_on_arc(arc: &Arc, point: &Position, least: f64) -> f64 {
        let angle = |at: [Mm; 3]| {
            let [first, second, _] = arc.plane().to_local(at);
            (second.0 - arc.centre().1.0).atan2(first.0 - arc.centre().0.0)
        };
        let sweep = arc.sweep();
        let turned = (angle(point.xyz()) - angle(arc.start())) * sweep.signum();
        // Of the turns that come by this direction, the one nearest to where one is.
        let wanted = least * sweep.abs();
        let turns = ((wanted - turned) / TAU).round();
        let mut turned = turned + turns * TAU;
        if turned < wanted - FRAC_PI_4 {
            turned += TAU;
        }
        if sweep.abs() > 0.0 { (turned / sweep.abs()).clamp(least, 1.0) } else { 1.0 }
    }
}

/// How far two points are apart on the axis where they are furthest; axes that one of them does not know do not count.
pub(super) fn apart(a: &Position, b: &Position) -> f64 {
    let ways = a.values().iter().zip(b.values()).map(|(a, b)| (a - b).abs());
    ways.filter(|way| !way.is_nan()).fold(0.0, f64::max)
}
