//! The profile of a lathe cycle: a chain of lines and arcs.
//!
//! Knows: geometry of one chain in the plane of a lathe. Must not know: which blocks it came from, what is cut of it.
//!
//! Points are `(z, x)`: `z` along the spindle, `x` as a radius. Counter-clockwise is the turn from `z` to `x`, that is the
//! turn of the plane ZX seen from +Y.

use gcheck_geometry::Mm;

use super::cycle_error::{CycleError, ProfileFault};

/// A point `(z, x)`.
pub(super) type Point = (f64, f64);

/// A piece of a profile, beginning where the piece before ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProfileSegment {
    /// Straight.
    Line {
        /// End `(z, x)`.
        to: (Mm, Mm),
        /// Programmed as a rapid.
        rapid: bool,
    },
    /// On a circle.
    Arc {
        /// End `(z, x)`.
        to: (Mm, Mm),
        /// Centre `(z, x)`.
        centre: (Mm, Mm),
        /// Counter-clockwise: from +Z toward +X.
        ccw: bool,
    },
}

/// A piece with its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cut {
    /// Straight.
    Line {
        /// Start `(z, x)`.
        from: (f64, f64),
        /// End `(z, x)`.
        to: (f64, f64),
        /// Programmed as a rapid.
        rapid: bool,
    },
    /// On a circle.
    Arc {
        /// Start `(z, x)`.
        from: (f64, f64),
        /// End `(z, x)`.
        to: (f64, f64),
        /// Centre `(z, x)`.
        centre: (f64, f64),
        /// Counter-clockwise.
        ccw: bool,
    },
}

/// How far the ends of an arc may stand from its circle, millimetres.
const OFF_CIRCLE: f64 = 0.03;

impl Cut {
    pub(super) fn from(&self) -> Point {
        match *self {
            Self::Line { from, .. } | Self::Arc { from, .. } => from,
        }
    }

    pub(super) fn to(&self) -> Point {
        match *self {
            Self::Line { to, .. } | Self::Arc { to, .. } => to,
        }
    }

    pub(super) fn shifted(&self, (dz, dx): Point) -> Self {
        let shift = |(z, x): Point| (z + dz, x + dx);
        match *self {
            Self::Line { from, to, rapid } => Self::Line { from: shift(from), to: shift(to), rapid },
            Self::Arc { from, to, centre, ccw } => {
                Self::Arc { from: shift(from), to: shift(to), centre: shift(centre), ccw }
            }
        }
    }

    /// With Z and X changed for each other, which turns the sense of arcs round.
    pub(super) fn transposed(&self) -> Self {
        let swap = |(z, x): Point| (x, z);
        match *self {
            Self::Line { from, to, rapid } => Self::Line { from: swap(from), to: swap(to), rapid },
            Self::Arc { from, to, centre, ccw } => {
                Self::Arc { from: swap(from), to: swap(to), centre: swap(centre), ccw: !ccw }
            }
        }
    }

    /// Mirrored by `sz` and `sx`, each 1 or −1.
    pub(super) fn mirrored(&self, (sz, sx): Point) -> Self {
        let mirror = |(z, x): Point| (z * sz, x * sx);
        match *self {
            Self::Line { from, to, rapid } => Self::Line { from: mirror(from), to: mirror(to), rapid },
            Self::Arc { from, to, centre, ccw } => Self::Arc {
                from: mirror(from),
                to: mirror(to),
                centre: mirror(centre),
                ccw: ccw == (sz * sx > 0.0),
            },
        }
    }

    /// The piece as pieces that never turn back in either coordinate: a line itself, an arc quarter by quarter.
    pub(super) fn monotonic_pieces(&self) -> Vec<Self> {
        let Self::Arc { from, to, centre, ccw } = *self else { return vec![*self] };
        let (start, sweep) = self.angles();
        let quarter = std::f64::consts::FRAC_PI_2;
        let radius = distance(from, centre);
        let sign = if ccw { 1.0 } else { -1.0 };
        let mut pieces = Vec::with_capacity(5);
        let mut at = from;
        // The next multiple of a quarter after the start, on the way of the arc; an arc crosses at most four.
        let mut next = ((start * sign / quarter).floor() + 1.0) * quarter;
        while next < start * sign + sweep.abs() - 1e-9 && pieces.len() < 4 {
            let angle = next * sign;
            let corner = (centre.0 + radius * angle.cos(), centre.1 + radius * angle.sin());
            if next > start * sign + 1e-9 {
                pieces.push(Self::Arc { from: at, to: corner, centre, ccw });
                at = corner;
            }
            next += quarter;
        }
        pieces.push(Self::Arc { from: at, to, centre, ccw });
        pieces
    }

    /// Of an arc: angle of its start and signed sweep, radians; a closed one is a whole turn.
    pub(super) fn angles(&self) -> (f64, f64) {
        let Self::Arc { from, to, centre, ccw } = *self else { return (0.0, 0.0) };
        let turn = std::f64::consts::TAU;
        let of = |(a, b): Point| (b - centre.1).atan2(a - centre.0);
        let start = of(from);
        let sign = if ccw { 1.0 } else { -1.0 };
        let sweep = ((of(to) - start) * sign).rem_euclid(turn);
        (start, sign * if sweep < 1e-9 { turn } else { sweep })
    }

    /// Where a piece that never turns back crosses the level `x` of the second coordinate: its first coordinate there.
    pub(super) fn crossing(&self, x: f64) -> f64 {
        let (from, to) = (self.from(), self.to());
        match *self {
            Self::Line { .. } => {
                let part = (x - from.1) / (to.1 - from.1);
                if part.is_finite() { from.0 + part.clamp(0.0, 1.0) * (to.0 - from.0) } else { to.0 }
            }
            Self::Arc { centre, .. } => {
                let radius = distance(from, centre);
                let half = (radius * radius - (x - centre.1) * (x - centre.1)).max(0.0).sqrt();
                let middle = f64::midpoint(from.0, to.0);
                if middle < centre.0 { centre.0 - half } else { centre.0 + half }
            }
        }
    }
}

/// The pieces with their starts, checked: known numbers, arcs on their circles, at least one piece.
pub(super) fn cuts(start: (Mm, Mm), segments: &[ProfileSegment]) -> Result<Vec<Cut>, CycleError> {
    if segments.is_empty() {
        return Err(ProfileFault::Empty.into());
    }
    let mut from = (start.0.0, start.1.0);
    let mut cuts = Vec::with_capacity(segments.len());
    for (index, segment) in segments.iter().enumerate() {
        let cut = match *segment {
            ProfileSegment::Line { to, rapid } => Cut::Line { from, to: (to.0.0, to.1.0), rapid },
            ProfileSegment::Arc { to, centre, ccw } => {
                Cut::Arc { from, to: (to.0.0, to.1.0), centre: (centre.0.0, centre.1.0), ccw }
            }
        };
        let numbers = match cut {
            Cut::Line { from, to, .. } => [from, to, to],
            Cut::Arc { from, to, centre, .. } => [from, to, centre],
        };
        if !numbers.iter().all(|(z, x)| z.is_finite() && x.is_finite()) {
            return Err(CycleError::Unknown);
        }
        if let Cut::Arc { from, to, centre, .. } = cut
            && (distance(from, centre) - distance(to, centre)).abs() > OFF_CIRCLE
        {
            return Err(ProfileFault::Arc(index).into());
        }
        from = cut.to();
        cuts.push(cut);
    }
    Ok(cuts)
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    (a.0 - b.0).hypot(a.1 - b.1)
}
