//! The cut that parts a turned part off.
//!
//! Knows: which move is one. Must not know: any rule.

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
