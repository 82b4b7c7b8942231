//! Words of turning cycles that stay in effect from block to block.
//!
//! Knows: what each was given. Must not know: what a cycle makes of it.

use std::rc::Rc;

use crate::lattice::{Lattice, lattice};

lattice! {
    /// Words of turning cycles that stay in effect, millimetres (X as a radius). `None` not given, NaN not known.
    #[derive(Debug, Clone, Copy, Default)]
    pub(crate) struct TurningWords {
        /// Cycles of one pass: X and Z of the point that the series begins and ends at.
        pub(crate) start: [Option<f64>; 2],
        /// X and Z of the far corner.
        pub(crate) corner: [Option<f64>; 2],
        /// Start of the cut less its end.
        pub(crate) taper: Option<f64>,
        /// Millimetres a turn.
        pub(crate) lead: Option<f64>,
        /// First block of roughing: depth of a pass, way back from the work.
        pub(crate) roughing: [Option<f64>; 2],
        /// First block of pattern repeating: shift in X and Z, passes.
        pub(crate) pattern: [Option<f64>; 3],
        /// First block of grooving: way back after a peck.
        pub(crate) peck_retract: Option<f64>,
        /// First block of threading: passes at full depth, pull-out in leads, angle in degrees, least depth, left for the end.
        pub(crate) thread: [Option<f64>; 5],
    }
}

impl TurningWords {
    /// Whatever was given may have been replaced.
    pub(crate) const UNKNOWN: Self = Self {
        start: [Some(f64::NAN); 2],
        corner: [Some(f64::NAN); 2],
        taper: Some(f64::NAN),
        lead: Some(f64::NAN),
        roughing: [Some(f64::NAN); 2],
        pattern: [Some(f64::NAN); 3],
        peck_retract: Some(f64::NAN),
        thread: [Some(f64::NAN); 5],
    };
}

/// The words of turning cycles, which most programs have none of.
#[derive(Debug, Clone, Default)]
pub(crate) struct KeptTurningWords(Option<Rc<TurningWords>>);

impl KeptTurningWords {
    /// The words.
    pub(crate) fn get(&self) -> TurningWords {
        self.0.as_deref().copied().unwrap_or_default()
    }

    /// Keeps words.
    pub(crate) fn of(words: &TurningWords) -> Self {
        Self(Some(Rc::new(*words)))
    }

    fn shares(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(a), Some(b)) => Rc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl Lattice for KeptTurningWords {
    fn join(&self, other: &Self) -> Self {
        if self.same(other) { self.clone() } else { Self::of(&self.get().join(&other.get())) }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        self.shares(inner) || self.get().covers(&inner.get())
    }

    fn same(&self, other: &Self) -> bool {
        self.shares(other) || self.get().same(&other.get())
    }
}
