//! When two values of two runs count as the same.
//!
//! Knows: tolerances; an unknown value differs from nothing. Must not know: what the values mean.

/// Feeds and speeds that differ by less, as a part of the larger one, are the same: inches are not always whole millimetres.
const SAME_RATE: f64 = 1e-3;

/// Are two values known and different?
pub(super) fn known_differ<T: PartialEq>(a: Option<T>, b: Option<T>) -> bool {
    matches!((a, b), (Some(a), Some(b)) if a != b)
}

/// Do two lengths of the machine's tables differ? One that a program writes itself and the other leaves to the control is another.
pub(super) fn table_differs(a: f64, b: f64, tolerance: f64) -> bool {
    a.is_nan() != b.is_nan() || (a - b).abs() > tolerance
}

/// Do two rates differ? An unknown rate differs from nothing.
pub(super) fn rate_differs(a: f64, b: f64) -> bool {
    (a - b).abs() > SAME_RATE * a.abs().max(b.abs())
}
