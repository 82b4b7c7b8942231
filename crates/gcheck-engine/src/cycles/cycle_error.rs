//! Why a cycle gives no strokes.
//!
//! Knows: faults of the control and of what is asked. Must not know: words for people, cycles.

use crate::fault::CycleFault;

/// Why a cycle gives no strokes, or no more of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CycleError {
    /// The control refuses the block.
    Fault(CycleFault),
    /// The control refuses the profile.
    Profile(ProfileFault),
    /// A number that the cycle is built on is not known.
    Unknown,
    /// More than [`MAX_STROKES`](super::MAX_STROKES).
    TooManyStrokes,
    /// The effect is not a cycle of this kind.
    NotThisKind,
}

impl From<CycleFault> for CycleError {
    fn from(fault: CycleFault) -> Self {
        Self::Fault(fault)
    }
}

impl From<ProfileFault> for CycleError {
    fn from(fault: ProfileFault) -> Self {
        Self::Profile(fault)
    }
}

/// Why a profile cannot be cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProfileFault {
    /// No piece.
    Empty,
    /// The first piece is not what the cycle wants: a move of X alone to rough along Z, of Z alone to rough along X.
    FirstPiece,
    /// A piece goes back in the direction in which the profile may only go forth; its index.
    NotMonotonic(usize),
    /// An arc whose ends do not stand on its circle; its index.
    Arc(usize),
    /// The start point does not lie outside the profile.
    Start,
}
