//! Affine frames: shifts, rotations, scalings and mirrors, and what they do to points.
//!
//! Knows how transforms compose and what becomes of a path's shape. Must not know which code asks for one, nor
//! in what order a control applies them: the engine composes, this multiplies.
//!
//! An unknown coordinate makes unknown only what depends on it: a shift in X does not lose Y.

use nalgebra::{Matrix3, Vector3};

use crate::plane::Plane;
use crate::units::{Degrees, Mm};

/// Relative size below which a difference of two lengths is rounding.
const ROUNDING: f64 = 1e-9;

/// An affine transform of X, Y and Z: a linear part and a shift after it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    linear: Matrix3<f64>,
    shift: Vector3<f64>,
}

impl Default for Frame {
    fn default() -> Self {
        Self::identity()
    }
}

impl Frame {
    /// The frame that changes nothing.
    pub fn identity() -> Self {
        Self { linear: Matrix3::identity(), shift: Vector3::zeros() }
    }

    /// A linear part and a shift (millimetres) applied after it.
    pub fn from_parts(linear: Matrix3<f64>, shift: [Mm; 3]) -> Self {
        Self { linear, shift: Vector3::from(shift.map(Mm::get)) }
    }

    /// A shift by X, Y, Z.
    pub fn translation(shift: [Mm; 3]) -> Self {
        Self::from_parts(Matrix3::identity(), shift)
    }

    /// A rotation in a plane about `centre` (first and second coordinate of the plane), counter-clockwise positive.
    pub fn rotation(plane: Plane, centre: (Mm, Mm), angle: Degrees) -> Self {
        let (sin, cos) = angle.sin_cos();
        let (first, second, normal) = plane.axes();
        let mut columns = [[0.0; 3]; 3];
        // A column is where the unit vector of its axis goes.
        for (axis, image) in [(first, [cos, sin, 0.0]), (second, [-sin, cos, 0.0]), (normal, [0.0, 0.0, 1.0])]
        {
            if let Some(column) = columns.get_mut(axis) {
                *column = plane.to_xyz(image);
            }
        }
        let linear = Matrix3::from_columns(&columns.map(Vector3::from));
        Self::about(linear, plane.to_xyz([centre.0, centre.1, Mm::ZERO]))
    }

    /// A scaling by one factor per axis about `centre`, which stays where it is. A factor of 1 leaves its axis
    /// alone, whatever the centre; a negative one mirrors, too; with 0 there is no way back.
    pub fn scaling(centre: [Mm; 3], factors: [f64; 3]) -> Self {
        Self::about(Matrix3::from_diagonal(&Vector3::from(factors)), centre)
    }

    /// A mirror that turns round the axes chosen (X, Y, Z) about `centre`.
    pub fn mirror(centre: [Mm; 3], axes: [bool; 3]) -> Self {
        Self::scaling(centre, axes.map(|mirrored| if mirrored { -1.0 } else { 1.0 }))
    }

    /// A linear part that leaves `centre` where it is.
    pub fn about(linear: Matrix3<f64>, centre: [Mm; 3]) -> Self {
        let centre = Vector3::from(centre.map(Mm::get));
        // centre - linear * centre, so that an unknown centre does not spoil an axis that does not move.
        let shift = multiply(&(Matrix3::identity() - linear), &centre);
        Self { linear, shift }
    }

    /// First this frame, then `next`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            linear: multiply_matrices(&next.linear, &self.linear),
            shift: multiply(&next.linear, &self.shift) + next.shift,
        }
    }

    /// Where a point goes.
    #[must_use]
    pub fn apply(&self, point: [Mm; 3]) -> [Mm; 3] {
        let moved = multiply(&self.linear, &Vector3::from(point.map(Mm::get))) + self.shift;
        let [x, y, z] = moved.into();
        [Mm(x), Mm(y), Mm(z)]
    }

    /// What becomes of a direction or a way: the shift does not count.
    #[must_use]
    pub fn apply_vector(&self, vector: [Mm; 3]) -> [Mm; 3] {
        let [x, y, z] = multiply(&self.linear, &Vector3::from(vector.map(Mm::get))).into();
        [Mm(x), Mm(y), Mm(z)]
    }

    /// The frame that undoes this one; none for one that flattens space or that is unknown in its linear part.
    pub fn inverse(&self) -> Option<Self> {
        if !self.linear.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        // Rotations and shifts are nearly all frames, and their inverse is exact.
        let linear = if self.linear == Matrix3::identity() {
            self.linear
        } else if self.linear_is_rigid() {
            self.linear.transpose()
        } else {
            self.linear.try_inverse().filter(|inverse| inverse.iter().all(|entry| entry.is_finite()))?
        };
        Some(Self { linear, shift: -multiply(&linear, &self.shift) })
    }

    /// The linear part.
    pub fn linear(&self) -> &Matrix3<f64> {
        &self.linear
    }

    /// Where the origin goes.
    pub fn origin(&self) -> [Mm; 3] {
        let [x, y, z] = self.shift.into();
        [Mm(x), Mm(y), Mm(z)]
    }

    /// The factor by which volumes grow, with the sign of the orientation.
    pub fn determinant(&self) -> f64 {
        self.linear.determinant()
    }

    /// Whether right becomes left: a counter-clockwise arc in a plane that is mapped onto itself becomes clockwise
    /// only if the *plane* is turned round; see [`reverses_plane`](Self::reverses_plane).
    pub fn is_mirrored(&self) -> bool {
        self.determinant() < 0.0
    }

    /// Whether arcs in the plane change their direction, seen along the same normal. A mirror in X reverses XY
    /// and ZX; a mirror in Z reverses ZX and YZ and leaves XY as it is.
    pub fn reverses_plane(&self, plane: Plane) -> bool {
        self.plane_part(plane).is_some_and(|[[a, c], [b, d]]| a * d - b * c < 0.0)
    }

    /// The factor by which circles in the plane grow; none where they become ellipses or leave the plane.
    pub fn circle_scale(&self, plane: Plane) -> Option<f64> {
        let (first, second, normal) = plane.axes();
        let entry = |row: usize, column: usize| self.linear.get((row, column)).copied().unwrap_or(f64::NAN);
        let stays = [(normal, first), (normal, second), (first, normal), (second, normal)];
        if !stays.into_iter().all(|(row, column)| entry(row, column).abs() <= ROUNDING) {
            return None;
        }
        let [[a, c], [b, d]] = self.plane_part(plane)?;
        let (one, other) = (a.hypot(c), b.hypot(d));
        let tolerance = ROUNDING * one.max(other);
        ((one - other).abs() <= tolerance && (a * b + c * d).abs() <= tolerance * one.max(other))
            .then_some(one)
    }

    /// Whether lengths and angles stay as they are; mirrors count as rigid.
    pub fn is_rigid(&self) -> bool {
        self.linear_is_rigid()
    }

    /// Whether the frame does nothing but shift.
    pub fn is_translation(&self) -> bool {
        self.linear == Matrix3::identity()
    }

    /// Whether shift and linear part are known numbers.
    pub fn is_known(&self) -> bool {
        self.linear.iter().chain(self.shift.iter()).all(|entry| entry.is_finite())
    }

    fn linear_is_rigid(&self) -> bool {
        (self.linear.transpose() * self.linear - Matrix3::identity()).abs().max() <= 1e-12
    }

    /// The images of the plane's first and second unit vectors, in the plane.
    fn plane_part(&self, plane: Plane) -> Option<[[f64; 2]; 2]> {
        let (first, second, _) = plane.axes();
        let entry = |row: usize, column: usize| self.linear.get((row, column)).copied();
        Some([[entry(first, first)?, entry(second, first)?], [entry(first, second)?, entry(second, second)?]])
    }
}

/// Matrix times vector, in which nothing times unknown is nothing.
fn multiply(matrix: &Matrix3<f64>, vector: &Vector3<f64>) -> Vector3<f64> {
    let [x, y, z] = (*vector).into();
    Vector3::from_fn(|row, _| {
        let mut sum = 0.0;
        for (factor, value) in matrix.row(row).iter().zip([x, y, z]) {
            // NaN and not zero: unknown. Comparing so also skips both zeros.
            if factor.is_nan() || factor.abs() > 0.0 {
                sum += factor * value;
            }
        }
        sum
    })
}

/// Matrix times matrix, in which nothing times unknown is nothing.
fn multiply_matrices(left: &Matrix3<f64>, right: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[0, 1, 2].map(|column| multiply(left, &right.column(column).into_owned())))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn at(x: f64, y: f64, z: f64) -> [Mm; 3] {
        [Mm(x), Mm(y), Mm(z)]
    }

    fn near(one: [Mm; 3], other: [Mm; 3]) -> bool {
        one.iter().zip(other).all(|(one, other)| one.is_near(other, Mm(1e-6)))
    }

    #[test]
    fn a_quarter_turn_about_a_centre_is_exact() {
        let turn = Frame::rotation(Plane::Xy, (Mm(10.0), Mm(0.0)), Degrees(90.0));
        assert_eq!(turn.apply(at(20.0, 0.0, 7.0)), at(10.0, 10.0, 7.0));
        assert_eq!(turn.apply_vector(at(1.0, 0.0, 0.0)), at(0.0, 1.0, 0.0));
    }

    #[test]
    fn every_plane_turns_its_first_axis_towards_its_second() {
        for plane in Plane::ALL {
            let turn = Frame::rotation(plane, (Mm(0.0), Mm(0.0)), Degrees(90.0));
            let first = plane.to_xyz([Mm(1.0), Mm(0.0), Mm(0.0)]);
            let second = plane.to_xyz([Mm(0.0), Mm(1.0), Mm(0.0)]);
            assert_eq!(turn.apply(first), second, "{plane:?}");
        }
    }

    #[test]
    fn frames_are_applied_in_the_order_they_are_written() {
        let shift = Frame::translation(at(10.0, 0.0, 0.0));
        let turn = Frame::rotation(Plane::Xy, (Mm(0.0), Mm(0.0)), Degrees(90.0));
        assert_eq!(shift.then(&turn).apply(at(0.0, 0.0, 0.0)), at(0.0, 10.0, 0.0));
        assert_eq!(turn.then(&shift).apply(at(0.0, 0.0, 0.0)), at(10.0, 0.0, 0.0));
    }

    #[test]
    fn scaling_leaves_its_centre_alone() {
        let twice = Frame::scaling(at(5.0, 5.0, 0.0), [2.0, 2.0, 1.0]);
        assert_eq!(twice.apply(at(5.0, 5.0, 3.0)), at(5.0, 5.0, 3.0));
        assert_eq!(twice.apply(at(6.0, 4.0, 3.0)), at(7.0, 3.0, 3.0));
        assert_eq!(twice.circle_scale(Plane::Xy), Some(2.0));
        assert_eq!(twice.circle_scale(Plane::Zx), None);
    }

    #[test]
    fn a_mirror_reverses_arcs_in_the_planes_that_hold_its_axis() {
        let mirror = Frame::mirror(at(0.0, 0.0, 0.0), [true, false, false]);
        assert_eq!(mirror.apply(at(1.0, 2.0, 3.0)), at(-1.0, 2.0, 3.0));
        assert!(mirror.is_mirrored() && mirror.is_rigid());
        assert!(mirror.reverses_plane(Plane::Xy) && mirror.reverses_plane(Plane::Zx));
        assert!(!mirror.reverses_plane(Plane::Yz));
        let both = Frame::mirror(at(0.0, 0.0, 0.0), [true, true, false]);
        assert!(!both.is_mirrored() && !both.reverses_plane(Plane::Xy));
    }

    #[test]
    fn an_unknown_coordinate_spoils_only_what_depends_on_it() {
        let known = |point: [Mm; 3]| point.map(Mm::is_known);
        let shift = Frame::translation(at(1.0, f64::NAN, 0.0));
        assert_eq!(known(shift.apply(at(1.0, 1.0, f64::NAN))), [true, false, false]);
        assert_eq!(known(shift.inverse().unwrap().apply(at(1.0, 1.0, 1.0))), [true, false, true]);
        let turn = Frame::rotation(Plane::Xy, (Mm(0.0), Mm(0.0)), Degrees(90.0));
        // After a quarter turn Y comes from X alone.
        assert_eq!(known(turn.apply(at(1.0, f64::NAN, 1.0))), [false, true, true]);
        let unknown_angle = Frame::rotation(Plane::Xy, (Mm(0.0), Mm(0.0)), Degrees(f64::NAN));
        assert_eq!(known(unknown_angle.apply(at(1.0, 1.0, 1.0))), [false, false, true]);
        assert!(unknown_angle.inverse().is_none());
        let somewhere = Frame::scaling(at(f64::NAN, 0.0, f64::NAN), [2.0, 2.0, 1.0]);
        assert_eq!(known(somewhere.apply(at(1.0, 1.0, 1.0))), [false, true, true]);
    }

    #[test]
    fn flat_space_has_no_way_back() {
        assert!(Frame::scaling(at(0.0, 0.0, 0.0), [1.0, 0.0, 1.0]).inverse().is_none());
    }

    fn some_frame() -> impl Strategy<Value = Frame> {
        let centre = (-100.0..100.0_f64, -100.0..100.0_f64, -100.0..100.0_f64);
        let plane = prop::sample::select(Plane::ALL.to_vec());
        let factor = prop_oneof![0.1..5.0_f64, -5.0..-0.1_f64, Just(1.0)];
        let part = prop_oneof![
            centre.clone().prop_map(|(x, y, z)| Frame::translation(at(x, y, z))),
            (plane, centre.clone(), -400.0..400.0_f64).prop_map(|(plane, (x, y, _), angle)| {
                Frame::rotation(plane, (Mm(x), Mm(y)), Degrees(angle))
            }),
            (centre.clone(), prop::array::uniform3(factor))
                .prop_map(|((x, y, z), factors)| Frame::scaling(at(x, y, z), factors)),
            (centre, prop::array::uniform3(any::<bool>()))
                .prop_map(|((x, y, z), axes)| Frame::mirror(at(x, y, z), axes)),
        ];
        prop::collection::vec(part, 1..4)
            .prop_map(|parts| parts.iter().fold(Frame::identity(), |frame, part| frame.then(part)))
    }

    proptest! {
        #[test]
        fn the_inverse_leads_back(frame in some_frame(), point in prop::array::uniform3(-100.0..100.0_f64)) {
            let point = point.map(Mm);
            let back = frame.inverse().unwrap();
            prop_assert!(near(back.apply(frame.apply(point)), point));
            prop_assert!(near(frame.then(&back).apply(point), point));
        }

        #[test]
        fn composing_is_applying_one_after_the_other(
            one in some_frame(), other in some_frame(), point in prop::array::uniform3(-100.0..100.0_f64),
        ) {
            let point = point.map(Mm);
            let (at_once, in_turn) = (one.then(&other).apply(point), other.apply(one.apply(point)));
            for (a, b) in at_once.iter().zip(in_turn) {
                prop_assert!(a.is_near(b, Mm(1e-9 * (1.0 + a.abs().0) * 1e3)));
            }
        }

        #[test]
        fn a_rotation_keeps_lengths(
            angle in -1e4..1e4_f64, vector in prop::array::uniform3(-100.0..100.0_f64),
            plane in prop::sample::select(Plane::ALL.to_vec()),
        ) {
            let turn = Frame::rotation(plane, (Mm(3.0), Mm(4.0)), Degrees(angle));
            let length = |vector: [Mm; 3]| vector.iter().map(|c| c.0 * c.0).sum::<f64>().sqrt();
            prop_assert!((length(turn.apply_vector(vector.map(Mm))) - length(vector.map(Mm))).abs() < 1e-9);
            prop_assert!(turn.is_rigid() && !turn.is_mirrored());
            prop_assert!(turn.circle_scale(plane).is_some_and(|scale| (scale - 1.0).abs() < 1e-9));
        }
    }
}
