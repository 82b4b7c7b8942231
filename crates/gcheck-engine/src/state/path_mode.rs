//! How corners are blended.
//!
//! Knows: the numbers that a program gave for it. Must not know: whether blending is on (a mode).

use crate::lattice::lattice;

lattice! {
    /// Tolerances of blending, and how smooth corners are cut. A change of units converts neither what the machine keeps to
    /// nor the numbers of blending; where they are announced again, they count in the units of that time.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Blending {
        /// Largest distance from the path; 0 not given, NaN unknown.
        pub(crate) tolerance: f64,
        /// Tolerance of joining nearly straight moves.
        pub(crate) naive: Option<f64>,
        /// Millimetres of the unit in which they were announced last; NaN unknown.
        pub(crate) unit: f64,
        /// Level of smoothing; `None` where the control's setting counts, NaN unknown.
        pub(crate) smoothing_level: Option<f64>,
        /// Largest distance from the path under smoothing, millimetres; as the level.
        pub(crate) smoothing_tolerance: Option<f64>,
        /// Level of contour control, 0 for one without a number; `None` while it is off, NaN unknown.
        pub(crate) contour: Option<f64>,
    }
}

impl Blending {
    /// Nothing was given.
    pub(crate) const NONE: Self = Self {
        tolerance: 0.0,
        naive: None,
        unit: 1.0,
        smoothing_level: None,
        smoothing_tolerance: None,
        contour: None,
    };
    /// Anything may have been given.
    pub(crate) const UNKNOWN: Self = Self {
        tolerance: f64::NAN,
        naive: Some(f64::NAN),
        unit: f64::NAN,
        smoothing_level: Some(f64::NAN),
        smoothing_tolerance: Some(f64::NAN),
        contour: Some(f64::NAN),
    };

    /// The control's own settings count again for smoothness.
    pub(crate) const fn without_smoothing(self) -> Self {
        Self { smoothing_level: None, smoothing_tolerance: None, contour: None, ..self }
    }

    /// Are the numbers the same, whatever they count in?
    pub(crate) fn has_numbers_of(&self, other: &Self) -> bool {
        let bits = |blending: &Self| (blending.tolerance.to_bits(), blending.naive.map(f64::to_bits));
        bits(self) == bits(other)
    }
}
