//! What rules of the path tier remember, so that an analysis can continue from a checkpoint.
//!
//! Knows: how to copy and compare a rule's memory, and every place of the main file in it. Must not know: any rule, how
//! places are stored.

use std::any::Any;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::hash::{BuildHasher, Hash};
use std::ops::Range;

use gcheck_controls::{CodeIx, Letter};
use gcheck_diagnostics::Finding;
use gcheck_engine::{At, Position, Role};

/// Looks at the places in a memory, and may change them.
pub trait Places {
    /// A block.
    fn at(&mut self, at: &mut At);
    /// Bytes of the main file.
    fn range(&mut self, range: &mut Range<u32>);
}

/// Something that may hold places of the main file.
pub trait Placed {
    /// Shows every place in it, always in the same order.
    fn visit(&mut self, places: &mut dyn Places) {
        let _ = places;
    }
}

/// What a rule remembers: implemented for every rule that can be copied and compared, and names its places.
pub trait Memory: Placed {
    /// The same memory.
    fn copy(&self) -> Box<dyn Memory>;
    /// Is it the same memory, places included?
    fn is_as(&self, other: &dyn Memory) -> bool;
    /// Becomes the other memory, which is one of the same rule.
    fn recall(&mut self, other: &dyn Memory);
    /// For comparing with a memory of the same rule.
    fn as_any(&self) -> &dyn Any;
}

impl<T: Placed + Clone + PartialEq + 'static> Memory for T {
    fn copy(&self) -> Box<dyn Memory> {
        Box::new(self.clone())
    }

    fn is_as(&self, other: &dyn Memory) -> bool {
        other.as_any().downcast_ref::<T>() == Some(self)
    }

    fn recall(&mut self, other: &dyn Memory) {
        if let Some(other) = other.as_any().downcast_ref::<T>() {
            self.clone_from(other);
        }
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

/// What a rule says about its memory.
pub enum Remembers<'r> {
    /// There is none.
    Nothing,
    /// All of it is this.
    All(&'r mut dyn Memory),
    /// The rule does not say.
    Unknown,
}

/// Names the fields of a rule's memory that may hold places: `remembers!(Rule: told, begun)`.
#[macro_export]
macro_rules! remembers {
    ($name:ty $(: $($field:ident),+)?) => {
        impl $crate::Placed for $name {
            fn visit(&mut self, places: &mut dyn $crate::Places) {
                let _ = &places;
                $($($crate::Placed::visit(&mut self.$field, places);)+)?
            }
        }
    };
}

impl Placed for At {
    fn visit(&mut self, places: &mut dyn Places) {
        places.at(self);
    }
}

impl Placed for Range<u32> {
    fn visit(&mut self, places: &mut dyn Places) {
        places.range(self);
    }
}

impl Placed for Finding {
    fn visit(&mut self, places: &mut dyn Places) {
        places.range(&mut self.range);
        for label in &mut self.labels {
            if label.file.is_none() {
                places.range(&mut label.range);
            }
        }
        for edit in self.fixes.iter_mut().flat_map(|fix| &mut fix.edits) {
            places.range(&mut edit.range);
        }
    }
}

impl<T: Placed> Placed for Option<T> {
    fn visit(&mut self, places: &mut dyn Places) {
        if let Some(inner) = self {
            inner.visit(places);
        }
    }
}

impl<T: Placed> Placed for Vec<T> {
    fn visit(&mut self, places: &mut dyn Places) {
        for inner in self {
            inner.visit(places);
        }
    }
}

impl<T: Placed, const N: usize> Placed for [T; N] {
    fn visit(&mut self, places: &mut dyn Places) {
        for inner in self {
            inner.visit(places);
        }
    }
}

impl<T: Placed + Ord> Placed for BTreeSet<T> {
    fn visit(&mut self, places: &mut dyn Places) {
        let visited = std::mem::take(self).into_iter().map(|mut inner| {
            inner.visit(places);
            inner
        });
        *self = visited.collect();
    }
}

impl<T: Placed + Ord + Hash, S: BuildHasher + Default> Placed for HashSet<T, S> {
    fn visit(&mut self, places: &mut dyn Places) {
        // In order, so that the same memory shows its places in the same order.
        let ordered: BTreeSet<T> = std::mem::take(self).into_iter().collect();
        let visited = ordered.into_iter().map(|mut inner| {
            inner.visit(places);
            inner
        });
        *self = visited.collect();
    }
}

impl<K, T: Placed> Placed for BTreeMap<K, T> {
    fn visit(&mut self, places: &mut dyn Places) {
        for inner in self.values_mut() {
            inner.visit(places);
        }
    }
}

impl<A: Placed, B: Placed> Placed for (A, B) {
    fn visit(&mut self, places: &mut dyn Places) {
        self.0.visit(places);
        self.1.visit(places);
    }
}

impl<A: Placed, B: Placed, C: Placed> Placed for (A, B, C) {
    fn visit(&mut self, places: &mut dyn Places) {
        self.0.visit(places);
        self.1.visit(places);
        self.2.visit(places);
    }
}

impl Placed for u16 {}
impl Placed for u32 {}
impl Placed for usize {}
impl Placed for f64 {}
impl Placed for bool {}
impl Placed for CodeIx {}
impl Placed for Letter {}
impl Placed for Role {}
impl Placed for Position {}
