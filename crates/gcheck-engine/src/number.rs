//! Numbers of which NaN says that nobody knows them.
//!
//! Knows: how two such numbers join, and which stands for which. They are compared bit by bit, so that unknown equals unknown
//! and the zeros are told apart. Must not know: what they measure.

/// Either number: unknown when they differ.
pub(crate) fn either(a: f64, b: f64) -> f64 {
    if a.to_bits() == b.to_bits() { a } else { f64::NAN }
}

/// Is what `inner` stands for something that `outer` stands for?
pub(crate) fn stands_for(outer: f64, inner: f64) -> bool {
    outer.is_nan() || outer.to_bits() == inner.to_bits()
}
