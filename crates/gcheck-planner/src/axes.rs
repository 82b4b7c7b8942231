//! Numbers by axis.
//!
//! Knows: nine axes in the order X Y Z A B C U V W, millimetres on the linear ones and degrees on A, B and C; which of
//! them measure a path. Must not know: machines, limits, time.

use nalgebra::{SVector, Vector3};

/// Axes there may be.
pub const AXES: usize = 9;

/// A point, or a number for each axis: millimetres or degrees, in the order X Y Z A B C U V W.
pub type Point = SVector<f64, AXES>;

/// X, Y and Z of a vector.
pub(crate) fn xyz(point: &Point) -> Vector3<f64> {
    point.fixed_rows::<3>(0).into_owned()
}

/// A vector of the linear axes X, Y and Z alone.
pub(crate) fn from_xyz(vector: Vector3<f64>) -> Point {
    let mut point = Point::zeros();
    point.fixed_rows_mut::<3>(0).copy_from(&vector);
    point
}

/// Do other axes than X, Y and Z take part?
pub(crate) fn beyond_xyz(way: &Point) -> bool {
    way.iter().skip(3).any(|part| part.abs() > 0.0)
}

/// How long a straight way is, as feeds are meant: that of X, Y and Z; of U, V and W when X, Y and Z do not move; of A, B
/// and C in degrees when no linear axis moves.
pub(crate) fn measure(way: &Point) -> f64 {
    let group = |first: usize| way.fixed_rows::<3>(first).norm();
    [0, 6, 3].into_iter().map(group).find(|length| *length > 0.0).unwrap_or(0.0)
}

/// The largest factor by which a way may be stretched while no axis exceeds its bound; infinite for no way.
pub(crate) fn room(way: &Point, bounds: &Point) -> f64 {
    way.iter()
        .zip(bounds.iter())
        .filter(|(part, _)| part.abs() > 0.0)
        .fold(f64::INFINITY, |least, (part, bound)| least.min(bound / part.abs()))
}
