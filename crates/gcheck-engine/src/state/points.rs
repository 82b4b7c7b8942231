//! Where the tool is.
//!
//! Knows: the programmed point, where the axes stand for it, the last point passed on a way to a reference position. Must not
//! know: offsets, moves.

use crate::lattice::lattice;
use crate::position::Position;

lattice! {
    /// Points of the program and of the axes.
    #[derive(Debug, Clone)]
    pub(crate) struct Points {
        /// The programmed point, programmed coordinates.
        pub(crate) position: Position,
        /// Where the axes stand, work coordinates: differs from `position` under compensation and transformations.
        pub(crate) actual: Position,
        /// The point that the last return to a reference position passed, programmed coordinates.
        pub(crate) passed: Position,
    }
}

impl Points {
    /// At a point, of which work and programmed coordinates are the same; nothing was passed yet.
    pub(crate) fn at(position: Position) -> Self {
        Self { position, actual: position, passed: Position::UNKNOWN }
    }

    /// Nobody knows where the tool is.
    pub(crate) fn lose(&mut self) {
        self.position = Position::UNKNOWN;
        self.actual = Position::UNKNOWN;
    }
}
