//! How corners are blended.
//!
//! Knows: the numbers that a program gave for it. Must not know: whether blending is on (a mode).

use crate::lattice::lattice;

lattice! {
    /// Tolerances of blending. A change of units converts neither what the machine keeps to nor the numbers; where they are
    /// announced again, the numbers count in the units of that time.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Blending {
        /// Largest distance from the path; 0 not given, NaN unknown.
        pub(crate) tolerance: f64,
        /// Tolerance of joining nearly straight moves.
        pub(crate) naive: Option<f64>,
        /// Millimetres of the unit in which they were announced last; NaN unknown.
        pub(crate) unit: f64,
    }
}

impl Blending {
    /// Nothing was given.
    pub(crate) const NONE: Self = Self { tolerance: 0.0, naive: None, unit: 1.0 };
    /// Anything may have been given.
    pub(crate) const UNKNOWN: Self = Self { tolerance: f64::NAN, naive: Some(f64::NAN), unit: f64::NAN };

    /// Are the numbers the same, whatever they count in?
    pub(crate) fn has_numbers_of(&self, other: &Self) -> bool {
        let bits = |blending: &Self| (blending.tolerance.to_bits(), blending.naive.map(f64::to_bits));
        bits(self) == bits(other)
    }
}
