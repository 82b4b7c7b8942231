//! Control points of a curve under way.
//!
//! Knows: the points of the blocks so far. Must not know: which curve they make.

use std::rc::Rc;

use crate::lattice::{Joinable, Lattice};

/// Control points with a number each (a weight, an order), in the order of their blocks.
#[derive(Debug, Clone)]
pub(crate) struct ControlPoints(pub(crate) Rc<Vec<[f64; 3]>>);

/// Another number of points makes it another curve.
impl Joinable for ControlPoints {
    fn joined(&self, other: &Self, _: bool) -> Option<Self> {
        if self.is_same(other) {
            return Some(self.clone());
        }
        let join = || self.0.iter().zip(&*other.0).map(|(a, b)| a.join(b)).collect();
        (self.0.len() == other.0.len()).then(|| Self(Rc::new(join())))
    }

    fn stands_for(&self, inner: &Self) -> bool {
        self.0.len() == inner.0.len() && self.0.iter().zip(&*inner.0).all(|(a, b)| a.covers(b))
    }

    fn is_same(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
            || self.0.len() == other.0.len() && self.0.iter().zip(&*other.0).all(|(a, b)| a.same(b))
    }
}
