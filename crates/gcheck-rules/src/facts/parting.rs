//! The cut that parts a turned part off.
//!
//! Knows: which move is one, and when it takes off something that was turned. Must not know: any rule.

use crate::{PathCx, remembers};
use gcheck_engine::{At, Axis, Event, TravelKind};
use gcheck_geometry::Mm;

/// A cut across the centre, below the face of the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Parting {
    /// Where along the part, in work coordinates; below zero.
    pub(crate) z: Mm,
    /// The block that cuts.
    pub(crate) at: At,
}

remembers!(Parting: at);

impl Parting {
    /// A straight cut in X alone that comes to the centre or past it. A cut at `Z0` or above it faces the part; one that stops
    /// before the centre is a groove or parts off a ring, which the program does not tell.
    pub(crate) fn of(cx: &PathCx<'_>, event: &Event) -> Option<Self> {
        let Event::Travel(travel) = event else { return None };
        if travel.kind != TravelKind::Feed {
            return None;
        }
        let (from, to) = (&travel.from, &travel.to);
        let z = to.raw(Axis::Z);
        let is_across = from.raw(Axis::X) > 1e-3 && to.raw(Axis::X) <= 1e-3;
        let is_square = (from.raw(Axis::Z) - z).abs() < 1e-6;
        (is_across && is_square && z < -1e-3).then(|| Self { z: Mm(z), at: cx.origin().at })
    }
}

/// How far along the part was turned, in work coordinates: millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Along {
    least: f64,
    most: f64,
}

remembers!(Along);

/// The shortest part: millimetres. A cut to the centre that is nearer to `Z0` may face the part.
const SHORT: f64 = 3.0;

impl Along {
    /// Nothing yet.
    pub(crate) const NOTHING: Self = Self { least: f64::INFINITY, most: f64::NEG_INFINITY };

    /// A cut along Z.
    pub(crate) const fn add(&mut self, from: f64, to: f64) {
        self.least = self.least.min(from.min(to));
        self.most = self.most.max(from.max(to));
    }

    /// Was there turned what the cut takes off? What it faces at its end was not turned before.
    pub(crate) fn is_turned(&self, parting: &Parting) -> bool {
        let middle = parting.z.0 / 2.0;
        self.least < middle && middle < self.most
    }

    /// Does the cut part off what was turned, for certain?
    pub(crate) fn is_parted(&self, parting: &Parting) -> bool {
        parting.z.0 < -SHORT && self.is_turned(parting)
    }
}
