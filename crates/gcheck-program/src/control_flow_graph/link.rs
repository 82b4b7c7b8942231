//! Numbers of blocks and programs that may be missing.
//!
//! Knows: the number that means "none". Must not know: what links to what.

/// Means "no block" or "no number" where an `Option` would double the memory.
pub(super) const NONE: u32 = u32::MAX;

/// The number, unless it is [`NONE`].
pub(super) fn known(number: u32) -> Option<u32> {
    (number != NONE).then_some(number)
}
