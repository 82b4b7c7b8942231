//! The feed, and what may override it.
//!
//! Knows: the feed as it counts and as it was written, which overrides are allowed. Must not know: moves, times.

use super::mode_set::ModeSet;
use crate::eval::value::{Domain, Truth};
use crate::lattice::lattice;

lattice! {
    /// The feed.
    #[derive(Debug, Clone)]
    pub(crate) struct Feed<D: Domain> {
        /// In millimetres a minute or turn, or moves a minute; 0 none given.
        pub(crate) rate: D::Value,
        /// As the program wrote it.
        pub(crate) word: D::Value,
        /// The feed mode under which it was given.
        pub(crate) given_under: ModeSet,
        /// The operator may override it.
        pub(crate) overridable: Truth,
        /// It follows an input.
        pub(crate) adaptive: Truth,
        /// An input stops it.
        pub(crate) hold: Truth,
    }
}

impl<D: Domain> Feed<D> {
    /// None given, under the mode that is in effect; switches as at power-on.
    pub(crate) fn none(mode: ModeSet) -> Self {
        Self {
            rate: D::number(0.0),
            word: D::number(0.0),
            given_under: mode,
            overridable: Truth::True,
            adaptive: Truth::False,
            hold: Truth::True,
        }
    }

    /// No feed is given any more.
    pub(crate) fn clear(&mut self) {
        self.rate = D::number(0.0);
        self.word = D::number(0.0);
    }

    /// Anything may have been given and switched.
    pub(crate) fn forget(&mut self) {
        let Self { rate, word, given_under, overridable, adaptive, hold } = self;
        *rate = D::unknown();
        *word = D::unknown();
        *given_under = ModeSet::ANY;
        for switch in [overridable, adaptive, hold] {
            *switch = Truth::Unknown;
        }
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Feed<E> {
        let Self { rate, word, given_under, overridable, adaptive, hold } = self;
        Feed {
            rate: change(rate),
            word: change(word),
            given_under: *given_under,
            overridable: *overridable,
            adaptive: *adaptive,
            hold: *hold,
        }
    }
}
