//! Where the tool is.
//!
//! Knows: the programmed point, where the axes stand for it, the last point passed on a way to a reference position. Must not
//! know: offsets, moves.

use crate::position::Position;
use crate::tracked::{Tracked, part};

part! {
    /// Points of the program and of the axes.
    #[derive(Debug, Clone)]
    pub(crate) struct Points {
        /// The programmed point, programmed coordinates.
        pub(crate) position: Tracked<Position>,
        /// Where the axes stand, work coordinates: differs from `position` under compensation and transformations.
        pub(crate) actual: Tracked<Position>,
        /// The point that the last return to a reference position passed, programmed coordinates.
        pub(crate) passed: Tracked<Position>,
    }
}

impl Points {
    /// At a point, of which work and programmed coordinates are the same; nothing was passed yet.
    pub(crate) fn at(position: Position) -> Self {
        Self {
            position: Tracked::new(position),
            actual: Tracked::new(position),
            passed: Tracked::new(Position::UNKNOWN),
        }
    }

    /// Nobody knows where the tool is.
    pub(crate) fn lose(&mut self) {
        self.position.put(Position::UNKNOWN);
        self.actual.put(Position::UNKNOWN);
    }
}
