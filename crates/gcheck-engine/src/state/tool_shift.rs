//! Where the axes stand beside the programmed point for the sake of the tool: by a length along a tilting tool, by the size of
//! a cutter along a vector.
//!
//! Knows: the amounts in effect. Must not know: which codes set them, how a vector comes about.

use crate::lattice::lattice;

lattice! {
    /// Shifts between the programmed point and the axes. All off by default.
    #[derive(Debug, Clone, Copy)]
    pub struct ToolShift {
        /// Length added along the tool, millimetres; NaN unknown, `None` off.
        pub(crate) along: Option<f64>,
        /// Radius by which each block's point is shifted along the block's vector, millimetres; NaN unknown, `None` off.
        pub(crate) cutter: Option<f64>,
        /// How far X, Y and Z stand beside the programmed point, millimetres; NaN unknown. An axis that a block does not name
        /// keeps its distance though the tool has turned.
        pub(crate) beside: [f64; 3],
    }
}

impl ToolShift {
    /// Nothing.
    pub const NONE: Self = Self { along: None, cutter: None, beside: [0.0; 3] };

    /// Length added along the tool, millimetres; NaN unknown, `None` off.
    pub fn along_tool(&self) -> Option<f64> {
        self.along
    }

    /// Radius by which the path is shifted along vectors, millimetres; NaN unknown, `None` off.
    pub fn along_vectors(&self) -> Option<f64> {
        self.cutter
    }

    pub(crate) fn is_on(&self) -> bool {
        self.along.is_some() || self.cutter.is_some()
    }

    /// As it may be after something that nobody knows: what is on now may be off, or changed.
    pub(crate) fn or_none(&self) -> Self {
        let unknown = |amount: Option<f64>| amount.map(|_| f64::NAN);
        let beside = if self.is_on() { [f64::NAN; 3] } else { [0.0; 3] };
        Self { along: unknown(self.along), cutter: unknown(self.cutter), beside }
    }
}
