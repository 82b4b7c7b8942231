//! How corners are blended.
//!
//! Knows: the numbers that a program gave for it. Must not know: whether blending is on (a mode).

use crate::lattice::lattice;

lattice! {
    /// Tolerances of blending, in the program's units when they were given; a change of units does not convert them.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Blending {
        /// Largest distance from the path; 0 not given, NaN unknown.
        pub(crate) tolerance: f64,
        /// Tolerance of joining nearly straight moves.
        pub(crate) naive: Option<f64>,
    }
}

impl Blending {
    /// Nothing was given.
    pub(crate) const NONE: Self = Self { tolerance: 0.0, naive: None };
    /// Anything may have been given.
    pub(crate) const UNKNOWN: Self = Self { tolerance: f64::NAN, naive: Some(f64::NAN) };
}
