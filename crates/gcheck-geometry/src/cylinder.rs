//! Paths drawn flat and wrapped around a cylinder.
//!
//! Knows the length of an arc on a diameter. Must not know which axis turns the cylinder.

use crate::units::{Degrees, Mm};

/// The angle that a length unrolled on the surface of a cylinder takes: a turn for every circumference.
///
/// The sign of `length` is kept, the sign of `diameter` is not looked at. Diameter zero gives an infinite angle,
/// and an unknown one for length zero.
#[must_use]
pub fn angle_of_unrolled(length: Mm, diameter: Mm) -> Degrees {
    Degrees(360.0 * length.0 / (std::f64::consts::PI * diameter.0.abs()))
}

/// The length on the surface that an angle takes; undoes [`angle_of_unrolled`].
#[must_use]
pub fn unrolled_length(angle: Degrees, diameter: Mm) -> Mm {
    Mm(angle.0 / 360.0 * std::f64::consts::PI * diameter.0.abs())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_circumference_is_a_turn() {
        let diameter = Mm(100.0);
        let circumference = Mm(100.0 * std::f64::consts::PI);
        assert!(angle_of_unrolled(circumference, diameter).is_near(Degrees::TURN, Degrees(1e-12)));
        assert!(angle_of_unrolled(circumference * -0.25, diameter).is_near(Degrees(-90.0), Degrees(1e-12)));
    }

    #[test]
    fn a_4_inch_cylinder_turns_28_648_degrees_an_inch() {
        let angle = angle_of_unrolled(Mm::from_inch(1.0), Mm::from_inch(4.0));
        assert!(angle.is_near(Degrees(28.647_889_757), Degrees(1e-8)));
    }

    #[test]
    fn a_cylinder_without_diameter_has_no_angle() {
        assert!(!angle_of_unrolled(Mm(1.0), Mm(0.0)).is_finite());
        assert!(!angle_of_unrolled(Mm(0.0), Mm(0.0)).is_known());
    }

    proptest! {
        #[test]
        fn both_ways_are_inverse(length in -1e4..1e4_f64, diameter in 0.01..1e4_f64) {
            let there = angle_of_unrolled(Mm(length), Mm(diameter));
            let back = unrolled_length(there, Mm(diameter));
            prop_assert!(back.is_near(Mm(length), Mm(1e-9)));
        }
    }
}
