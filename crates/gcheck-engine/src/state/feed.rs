//! The feed, and what may override it.
//!
//! Knows: the feed as it counts and as it was written, which overrides are allowed. Must not know: moves, times.

use super::mode_set::ModeSet;
use crate::tracked::{Tracked, part};
use crate::value::{Domain, Truth};

part! {
    /// The feed.
    #[derive(Debug, Clone)]
    pub(crate) struct Feed<D: Domain> {
        /// In millimetres a minute or turn, or moves a minute; 0 none given.
        pub(crate) rate: Tracked<D::Value>,
        /// As the program wrote it.
        pub(crate) word: Tracked<D::Value>,
        /// The feed mode under which it was given.
        pub(crate) given_under: Tracked<ModeSet>,
        /// The operator may override it.
        pub(crate) overridable: Tracked<Truth>,
        /// It follows an input.
        pub(crate) adaptive: Tracked<Truth>,
        /// An input stops it.
        pub(crate) hold: Tracked<Truth>,
    }
}

impl<D: Domain> Feed<D> {
    /// None given, under the mode that is in effect; switches as at power-on.
    pub(crate) fn none(mode: ModeSet) -> Self {
        Self {
            rate: Tracked::new(D::number(0.0)),
            word: Tracked::new(D::number(0.0)),
            given_under: Tracked::new(mode),
            overridable: Tracked::new(Truth::True),
            adaptive: Tracked::new(Truth::False),
            hold: Tracked::new(Truth::True),
        }
    }

    /// No feed is given any more.
    pub(crate) fn clear(&mut self) {
        self.rate.put(D::number(0.0));
        self.word.put(D::number(0.0));
    }

    /// Anything may have been given and switched.
    pub(crate) fn forget(&mut self) {
        let Self { rate, word, given_under, overridable, adaptive, hold } = self;
        rate.put(D::unknown());
        word.put(D::unknown());
        given_under.put(ModeSet::ANY);
        for switch in [overridable, adaptive, hold] {
            switch.put(Truth::Unknown);
        }
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> Feed<E> {
        let Self { rate, word, given_under, overridable, adaptive, hold } = self;
        Feed {
            rate: rate.map(change),
            word: word.map(change),
            given_under: given_under.clone(),
            overridable: overridable.clone(),
            adaptive: adaptive.clone(),
            hold: hold.clone(),
        }
    }
}
