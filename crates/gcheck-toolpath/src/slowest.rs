//! The places of a program where most time is lost.
//!
//! Knows: stretches of lines that lose time for one cause. Must not know: how the loss comes about, how it is shown.

use gcheck_geometry::Seconds;
use gcheck_planner::Cause;

/// How many places are kept.
pub const MAX_PLACES: usize = 10;
/// A move that loses less than this part of its time ends a place.
const LEAST_PART: f64 = 0.1;

/// Lines that lose time for one cause.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// File, as [`crate::Statistics::file`] counts.
    pub file: u16,
    /// First and last line in the order of execution, counted from 1.
    pub lines: (u32, u32),
    /// Why.
    pub cause: Cause,
    /// Time beyond what the same moves take at the speed that was asked for.
    pub lost: Seconds,
    /// Time that they take.
    pub taken: Seconds,
    /// Moves.
    pub moves: u64,
    /// Way at the speed asked for, for the average length: millimetres, or degrees where only rotary axes move.
    pub way: f64,
}

/// Keeps the places that lose most.
#[derive(Debug, Clone, Default)]
pub(crate) struct Slowest {
    /// At most [`MAX_PLACES`], the worst first.
    places: Vec<Place>,
    /// The one that still grows.
    current: Option<Place>,
}

impl Slowest {
    /// A stretch of a move: its time, and what it would have been.
    pub(crate) fn add(&mut self, next: Place) {
        if next.cause == Cause::None || next.lost.0 < LEAST_PART * next.taken.0 {
            // Arcs at corners stand for no move: they neither begin nor end anything.
            if next.moves > 0 {
                self.end();
            }
            return;
        }
        if let Some(current) = &mut self.current {
            let goes_on = current.file == next.file
                && (current.cause == next.cause || next.moves == 0)
                && next.lines.0.abs_diff(current.lines.1) <= 3;
            if goes_on {
                current.lines.0 = current.lines.0.min(next.lines.0);
                current.lines.1 = current.lines.1.max(next.lines.1);
                current.lost += next.lost;
                current.taken += next.taken;
                current.moves += next.moves;
                current.way += next.way;
                return;
            }
        }
        self.end();
        self.current = Some(next);
    }

    fn end(&mut self) {
        let Some(place) = self.current.take() else { return };
        // The same lines come again in loops and with every call of a subprogram.
        let same = |known: &Place| {
            known.file == place.file && known.lines == place.lines && known.cause == place.cause
        };
        if let Some(at) = self.places.iter().position(same) {
            let mut known = self.places.remove(at);
            known.lost += place.lost;
            known.taken += place.taken;
            known.moves += place.moves;
            known.way += place.way;
            self.put(known);
        } else {
            self.put(place);
        }
        self.places.truncate(MAX_PLACES);
    }

    fn put(&mut self, place: Place) {
        let at = self.places.partition_point(|known| known.lost >= place.lost);
        self.places.insert(at, place);
    }

    /// To be called when nothing comes any more.
    pub(crate) fn finish(&mut self) {
        self.end();
    }

    /// The worst first.
    pub(crate) fn places(&self) -> &[Place] {
        &self.places
    }
}
