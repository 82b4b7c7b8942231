//! What every part of the machine's state can answer, so that two paths can become one without inventing anything.
//!
//! Knows: the four questions, how structures are composed of their fields, the few shapes that an unknown value has. Must not
//! know: what any value means.
//!
//! A value of a lattice stands for a set of values of a run. *Unknown* is a value of its own and stands for all of them; it is
//! never spelled "none", zero, or the value of one of the paths. A number that nobody knows is NaN. Numbers are compared bit by
//! bit, so that unknown is the same as unknown and the zeros are told apart.

use std::rc::Rc;

use gcheck_controls::LetterSet;
use gcheck_geometry::Mm;

/// A set of values that may hold, as far as the analysis tells them apart.
///
/// Laws, which `state/laws.rs` tests: `join` and `widen` cover both sides; `join` gives the same whichever side comes first, and
/// a value joined with itself is the same; a chain of `widen` comes to an end; `covers` is reflexive and transitive; what is the
/// same covers each other.
pub trait Lattice {
    /// What holds in this or in the other.
    #[must_use]
    fn join(&self, other: &Self) -> Self;

    /// As [`Lattice::join`], but such that repeating it comes to an end. `self` is the older of the two.
    #[must_use]
    fn widen(&self, newer: &Self) -> Self;

    /// Is everything that `inner` stands for something that this stands for?
    fn covers(&self, inner: &Self) -> bool;

    /// Equal, numbers bit by bit: the same values have the same future.
    fn same(&self, other: &Self) -> bool;

    /// Where this does not stand for `inner`, for people: the names of the fields that lead there, with both values. Empty for
    /// a value without fields, and where it does stand for it.
    fn uncovered(&self, inner: &Self) -> String {
        let _ = inner;
        String::new()
    }
}

/// Defines a structure whose lattice is that of its fields, each by itself, with `==` as [`Lattice::same`].
///
/// A field whose type does not answer all four questions does not compile. Types without an unknown value, such as `bool` and
/// `u32`, answer none.
macro_rules! lattice {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident $(<$domain:ident: $bound:ident>)? {
            $( $(#[$field_meta:meta])* $field_vis:vis $field:ident: $kind:ty, )*
        }
    ) => {
        $(#[$meta])*
        $vis struct $name $(<$domain: $bound>)? {
            $( $(#[$field_meta])* $field_vis $field: $kind, )*
        }

        impl $(<$domain: $bound>)? $crate::lattice::Lattice for $name $(<$domain>)? {
            fn join(&self, other: &Self) -> Self {
                Self { $( $field: $crate::lattice::merged!(
                    $name.$field,
                    self.$field,
                    $crate::lattice::Lattice::join(&self.$field, &other.$field)
                ), )* }
            }

            fn widen(&self, newer: &Self) -> Self {
                Self { $( $field: $crate::lattice::merged!(
                    $name.$field,
                    self.$field,
                    $crate::lattice::Lattice::widen(&self.$field, &newer.$field)
                ), )* }
            }

            fn covers(&self, inner: &Self) -> bool {
                $( $crate::lattice::Lattice::covers(&self.$field, &inner.$field) )&&*
            }

            fn same(&self, other: &Self) -> bool {
                $( $crate::lattice::Lattice::same(&self.$field, &other.$field) )&&*
            }

            fn uncovered(&self, inner: &Self) -> String {
                let mut parts = Vec::new();
                $( if !$crate::lattice::Lattice::covers(&self.$field, &inner.$field) {
                    let mut part = $crate::lattice::Lattice::uncovered(&self.$field, &inner.$field);
                    if part.is_empty() {
                        part = format!(": {:?} / {:?}", self.$field, inner.$field);
                    }
                    parts.push(format!(".{}{part}", stringify!($field)));
                } )*
                parts.join("\n")
            }
        }

        impl $(<$domain: $bound>)? PartialEq for $name $(<$domain>)? {
            fn eq(&self, other: &Self) -> bool {
                $crate::lattice::Lattice::same(self, other)
            }
        }

        #[cfg(feature = "forgetful")]
        impl $(<$domain: $bound>)? $name $(<$domain>)? {
            /// The type with the names of its fields.
            pub(crate) const FIELDS: (&str, &[&str]) = (stringify!($name), &[$( stringify!($field) ),*]);
        }
    };
}
pub(crate) use lattice;

/// Implements the lattice of a type whose values exclude each other, but for `Unknown`, which stands for all of them.
macro_rules! flat_lattice {
    ($name:ty) => {
        impl $crate::lattice::Lattice for $name {
            fn join(&self, other: &Self) -> Self {
                if self == other { *self } else { Self::Unknown }
            }

            fn widen(&self, newer: &Self) -> Self {
                self.join(newer)
            }

            fn covers(&self, inner: &Self) -> bool {
                *self == Self::Unknown || self == inner
            }

            fn same(&self, other: &Self) -> bool {
                self == other
            }
        }
    };
}
pub(crate) use flat_lattice;

/// A field of two values that become one.
///
/// A build with the feature `forgetful`, which tests alone make, can be told to leave a field as the older value has it: then
/// law 4 must fail (`cargo xtask mutations`).
#[cfg(not(feature = "forgetful"))]
macro_rules! merged {
    ($owner:ident . $field:ident, $own:expr, $merged:expr) => {
        $merged
    };
}
#[cfg(feature = "forgetful")]
macro_rules! merged {
    ($owner:ident . $field:ident, $own:expr, $merged:expr) => {
        if $crate::forgetful::forgets(stringify!($owner), stringify!($field)) {
            ::core::clone::Clone::clone(&$own)
        } else {
            $merged
        }
    };
}
pub(crate) use merged;

/// A number; NaN stands for any.
impl Lattice for f64 {
    #[inline]
    fn join(&self, other: &Self) -> Self {
        if self.same(other) { *self } else { Self::NAN }
    }

    #[inline]
    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    #[inline]
    fn covers(&self, inner: &Self) -> bool {
        self.is_nan() || self.same(inner)
    }

    /// Whatever the bits of a NaN are, it is the same unknown.
    #[inline]
    fn same(&self, other: &Self) -> bool {
        self.to_bits() == other.to_bits() || self.is_nan() && other.is_nan()
    }
}

impl Lattice for Mm {
    fn join(&self, other: &Self) -> Self {
        Self(self.0.join(&other.0))
    }

    fn widen(&self, newer: &Self) -> Self {
        Self(self.0.widen(&newer.0))
    }

    fn covers(&self, inner: &Self) -> bool {
        self.0.covers(&inner.0)
    }

    fn same(&self, other: &Self) -> bool {
        self.0.same(&other.0)
    }
}

/// A number that need not be given: `None` it is not, `Some(NaN)` nobody knows, not even whether it is given.
impl Lattice for Option<f64> {
    fn join(&self, other: &Self) -> Self {
        if self.same(other) { *self } else { Some(f64::NAN) }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        self.is_some_and(f64::is_nan) || self.same(inner)
    }

    fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (None, None) => true,
            (Some(a), Some(b)) => a.same(b),
            _ => false,
        }
    }
}

/// Addresses that may have been given.
impl Lattice for LetterSet {
    fn join(&self, other: &Self) -> Self {
        self.or(*other)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.or(*newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        inner.without(*self).is_empty()
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

impl<T: Lattice, const N: usize> Lattice for [T; N] {
    fn join(&self, other: &Self) -> Self {
        // An array is mapped by index: `zip` of two arrays is not stable.
        std::array::from_fn(|index| at(self, index).join(at(other, index)))
    }

    fn widen(&self, newer: &Self) -> Self {
        std::array::from_fn(|index| at(self, index).widen(at(newer, index)))
    }

    fn covers(&self, inner: &Self) -> bool {
        self.iter().zip(inner).all(|(outer, inner)| outer.covers(inner))
    }

    fn same(&self, other: &Self) -> bool {
        self.iter().zip(other).all(|(a, b)| a.same(b))
    }
}

#[expect(clippy::indexing_slicing, reason = "`from_fn` gives indexes below the length")]
fn at<T, const N: usize>(array: &[T; N], index: usize) -> &T {
    &array[index]
}

/// Values shared until they are written.
impl<T: Lattice> Lattice for Rc<T> {
    fn join(&self, other: &Self) -> Self {
        if self.same(other) { Self::clone(self) } else { Self::new((**self).join(other)) }
    }

    fn widen(&self, newer: &Self) -> Self {
        if self.same(newer) { Self::clone(self) } else { Self::new((**self).widen(newer)) }
    }

    fn covers(&self, inner: &Self) -> bool {
        Self::ptr_eq(self, inner) || (**self).covers(inner)
    }

    fn same(&self, other: &Self) -> bool {
        Self::ptr_eq(self, other) || (**self).same(other)
    }

    fn uncovered(&self, inner: &Self) -> String {
        (**self).uncovered(inner)
    }
}

/// One thing out of many, or nobody knows which.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flat<T> {
    /// This one.
    Known(T),
    /// Any.
    Unknown,
}

impl<T: Copy> Flat<T> {
    /// The thing, if it is known.
    pub(crate) const fn known(self) -> Option<T> {
        match self {
            Self::Known(value) => Some(value),
            Self::Unknown => None,
        }
    }
}

impl<T> From<Option<T>> for Flat<T> {
    /// `None` is unknown.
    fn from(known: Option<T>) -> Self {
        known.map_or(Self::Unknown, Self::Known)
    }
}

impl<T: Clone + PartialEq> Lattice for Flat<T> {
    fn join(&self, other: &Self) -> Self {
        if self == other { self.clone() } else { Self::Unknown }
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        *self == Self::Unknown || self == inner
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}

/// Something that need not be there, or nobody knows whether it is and what it then is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) enum Perhaps<T> {
    /// It is not there.
    #[default]
    No,
    /// It is there.
    Yes(T),
    /// It may be there, and be anything.
    Unknown,
}

impl<T> Perhaps<T> {
    /// Is it certainly not there?
    pub(crate) const fn is_no(&self) -> bool {
        matches!(self, Self::No)
    }

    /// Is neither its presence nor its absence certain?
    pub(crate) const fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown)
    }

    /// What is certainly there.
    pub(crate) const fn yes(&self) -> Option<&T> {
        match self {
            Self::Yes(value) => Some(value),
            Self::No | Self::Unknown => None,
        }
    }

    /// What is certainly there.
    pub(crate) const fn yes_mut(&mut self) -> Option<&mut T> {
        match self {
            Self::Yes(value) => Some(value),
            Self::No | Self::Unknown => None,
        }
    }

    /// As it may be after something that nobody knows: what is not there stays so, by assumption; all else may be anything.
    pub(crate) fn or_other(&self) -> Self {
        match self {
            Self::No => Self::No,
            Self::Yes(_) | Self::Unknown => Self::Unknown,
        }
    }
}

/// What may be in a [`Perhaps`]: two of them need not have anything in common.
pub(crate) trait Joinable: Sized {
    /// As [`Lattice::join`], or with `widen` as [`Lattice::widen`]; `None` when only "unknown" stands for both.
    fn joined(&self, other: &Self, widen: bool) -> Option<Self>;
    /// As [`Lattice::covers`].
    fn stands_for(&self, inner: &Self) -> bool;
    /// As [`Lattice::same`].
    fn is_same(&self, other: &Self) -> bool;
}

impl<T: Lattice> Joinable for T {
    fn joined(&self, other: &Self, widen: bool) -> Option<Self> {
        Some(if widen { self.widen(other) } else { self.join(other) })
    }

    fn stands_for(&self, inner: &Self) -> bool {
        self.covers(inner)
    }

    fn is_same(&self, other: &Self) -> bool {
        self.same(other)
    }
}

impl<T: Joinable> Perhaps<T> {
    fn either(&self, other: &Self, widen: bool) -> Self {
        match (self, other) {
            (Self::No, Self::No) => Self::No,
            (Self::Yes(a), Self::Yes(b)) => a.joined(b, widen).map_or(Self::Unknown, Self::Yes),
            _ => Self::Unknown,
        }
    }
}

impl<T: Joinable> Lattice for Perhaps<T> {
    fn join(&self, other: &Self) -> Self {
        self.either(other, false)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.either(newer, true)
    }

    fn covers(&self, inner: &Self) -> bool {
        match (self, inner) {
            (Self::Unknown, _) | (Self::No, Self::No) => true,
            (Self::Yes(a), Self::Yes(b)) => a.stands_for(b),
            _ => false,
        }
    }

    fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Unknown, Self::Unknown) | (Self::No, Self::No) => true,
            (Self::Yes(a), Self::Yes(b)) => a.is_same(b),
            _ => false,
        }
    }
}

impl<T: Joinable> PartialEq for Perhaps<T> {
    fn eq(&self, other: &Self) -> bool {
        self.same(other)
    }
}

/// A thing that has nothing in common with any other.
macro_rules! discrete {
    ($($kind:ty),*) => { $(
        impl $crate::lattice::Joinable for $kind {
            fn joined(&self, other: &Self, _: bool) -> Option<Self> {
                (self == other).then(|| self.clone())
            }

            fn stands_for(&self, inner: &Self) -> bool {
                self == inner
            }

            fn is_same(&self, other: &Self) -> bool {
                self == other
            }
        }
    )* };
}
pub(crate) use discrete;

discrete!(u32);

/// Something that may have happened; `false` says that it certainly has not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct May(pub(crate) bool);

impl Lattice for May {
    fn join(&self, other: &Self) -> Self {
        Self(self.0 || other.0)
    }

    fn widen(&self, newer: &Self) -> Self {
        self.join(newer)
    }

    fn covers(&self, inner: &Self) -> bool {
        self.0 || !inner.0
    }

    fn same(&self, other: &Self) -> bool {
        self == other
    }
}
