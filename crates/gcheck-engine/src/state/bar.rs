//! The bar of a bar feeder.
//!
//! Knows: what of the bar is left, how many wait, whether the chuck is closed. Must not know: codes, variables, the order of a
//! feed.
//!
//! The bar is measured behind the face of the chuck, where what is too short cannot be clamped: a new bar's length less its
//! first push, less a part for every push after it.

use gcheck_geometry::Mm;

use crate::eval::value::Truth;
use crate::lattice::{Lattice, lattice};
use crate::machine::Machine;

lattice! {
    /// The bar in the chuck, and those that wait.
    #[derive(Debug, Clone, Copy)]
    pub struct Bar {
        rest: Rest,
        /// Bars in the magazine; infinite when nobody counts them, NaN unknown.
        pub(crate) waiting: f64,
        /// The chuck is closed.
        pub(crate) clamped: Truth,
    }
}

/// What of the bar is behind the face of the chuck, millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Rest {
    /// The bar is whole: its first push is still to be taken off.
    Whole(f64),
    /// This much is left.
    Left(f64),
    /// Nobody knows.
    Unknown,
}

impl Lattice for Rest {
    fn join(&self, other: &Self) -> Self {
        if self.same(other) { *self } else { Self::Unknown }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        *self == Self::Unknown || self.same(inner)
    }

    fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Whole(a), Self::Whole(b)) | (Self::Left(a), Self::Left(b)) => a.same(b),
            (Self::Unknown, Self::Unknown) => true,
            _ => false,
        }
    }
}

lattice! {
    /// A bar feed as its block commands it, millimetres; NaN unknown.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct BarCommand {
        pub(crate) part: f64,
        pub(crate) initial: f64,
        pub(crate) clamping: f64,
        /// Angle at which the spindle takes a new bar.
        pub(crate) orient: Option<f64>,
    }
}

impl Bar {
    /// Nothing is known.
    pub(crate) const UNKNOWN: Self = Self { rest: Rest::Unknown, waiting: f64::NAN, clamped: Truth::Unknown };

    /// As a run finds it.
    pub(crate) fn at_start(machine: &Machine) -> Self {
        let feeder = machine.bar;
        if !feeder.starts_new {
            return Self::UNKNOWN;
        }
        Self {
            rest: feeder.new_bar.map_or(Rest::Unknown, |bar| Rest::Whole(bar.0)),
            waiting: feeder.bars.map_or(f64::INFINITY, |bars| f64::from(bars.saturating_sub(1))),
            clamped: Truth::Unknown,
        }
    }

    /// What of the bar is behind the face of the chuck; NaN unknown.
    pub fn length(&self) -> Mm {
        match self.rest {
            Rest::Left(length) => Mm(length),
            Rest::Whole(_) | Rest::Unknown => Mm::UNKNOWN,
        }
    }

    /// Is the chuck closed?
    pub fn clamped(&self) -> Truth {
        self.clamped
    }

    /// Is it known how long the bar is, pushed out or not?
    pub(crate) fn is_measured(&self) -> bool {
        self.rest != Rest::Unknown
    }

    /// This much is left, millimetres; NaN unknown.
    pub(crate) fn set_length(&mut self, length: f64) {
        self.rest = if length.is_nan() { Rest::Unknown } else { Rest::Left(length) };
    }

    /// The first push of a whole bar counts from now on.
    pub(crate) fn count_first_push(&mut self, push: f64) {
        if let Rest::Whole(length) = self.rest {
            self.set_length(length - push);
        }
    }
}
