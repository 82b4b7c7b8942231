//! When two values of two runs count as the same.
//!
//! Knows: tolerances; an unknown value differs from nothing. Must not know: what the values mean.

use gcheck_engine::PathMode;

use crate::corner_mode::CornerMode;

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

/// Are corners taken differently? An unknown tolerance differs from none.
pub(super) fn corners_differ([a, b]: [CornerMode; 2]) -> bool {
    let path = match (a.path, b.path) {
        (
            PathMode::Blending { tolerance: a, naive: a_naive },
            PathMode::Blending { tolerance: b, naive: b_naive },
        ) => {
            rate_differs(a.0, b.0)
                || a_naive.is_some() != b_naive.is_some()
                || matches!((a_naive, b_naive), (Some(a), Some(b)) if rate_differs(a.0, b.0))
        }
        (a, b) => a != b,
    };
    let [of_a, of_b] = [a.smoothing, b.smoothing];
    let smoothing = of_a.level != of_b.level
        || of_a.tolerance.is_some() != of_b.tolerance.is_some()
        || matches!((of_a.tolerance, of_b.tolerance), (Some(a), Some(b)) if rate_differs(a.0, b.0));
    path || smoothing || a.contour != b.contour
}
