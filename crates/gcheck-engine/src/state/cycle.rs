//! Words of a canned cycle that stay in effect from block to block.
//!
//! Knows: which words a series was given, or may have been. Must not know: what a cycle makes of them.

use gcheck_controls::{Letter, LetterSet};

use crate::eval::value::Truth;
use crate::lattice::lattice;

lattice! {
    /// Words of a canned cycle that stay in effect, millimetres; NaN not given, or not known.
    #[derive(Debug, Clone, Copy)]
    pub struct CycleWords {
        /// Words of the series that were given, or may have been: their own letters, and `START` for its level.
        may_have: LetterSet,
        /// Retract plane.
        pub r: f64,
        /// Bottom.
        pub z: f64,
        /// Peck or shift.
        pub q: f64,
        /// Dwell in seconds.
        pub p: f64,
        /// R and the depth word as they were given, lengths in millimetres: what increments count from may change.
        pub(crate) given: [f64; 2],
        /// The last dwell of any series: some controls give it to taps without one of their own.
        pub(crate) last_dwell: Option<f64>,
        /// `R` of the last pocket, which a pocket without one of its own uses.
        pub(crate) pocket_r: Option<f64>,
        /// A threading cycle turned the feed override on, though the program has it off.
        pub(crate) feed_override_on: Truth,
        /// I, J, K.
        pub ijk: [f64; 3],
        /// Depth along the tool.
        pub e: f64,
        /// Level of the depth axis before the series began.
        pub initial: f64,
    }
}

impl CycleWords {
    /// Nothing was given.
    pub const NONE: Self = Self {
        may_have: LetterSet::EMPTY,
        r: f64::NAN,
        z: f64::NAN,
        q: f64::NAN,
        p: f64::NAN,
        given: [f64::NAN; 2],
        last_dwell: None,
        pocket_r: None,
        feed_override_on: Truth::False,
        ijk: [f64::NAN; 3],
        e: f64::NAN,
        initial: f64::NAN,
    };

    /// Stands for the level that a series began at among the words that it may have.
    const START: Letter = Letter::of('N');

    /// Nothing of a new series yet, but the level that it began at where another cycle goes on from it.
    pub(crate) fn series(&self, goes_on: bool) -> Self {
        let Self { last_dwell, pocket_r, feed_override_on, initial, .. } = *self;
        let new = Self { last_dwell, pocket_r, feed_override_on, ..Self::NONE };
        if goes_on && self.has_begun() {
            let may_have = [Self::START].into_iter().collect();
            Self { may_have, initial, ..new }
        } else {
            new
        }
    }

    /// Whether a series is under way, and with which words, is not known.
    pub(crate) fn unknown(&self) -> Self {
        let Self { last_dwell, pocket_r, feed_override_on, .. } = *self;
        let may_have = LetterSet::of("RZQPIJKEXYN");
        Self { may_have, last_dwell, pocket_r, feed_override_on, ..Self::NONE }
    }

    /// As [`Self::unknown`], after something that nobody knows.
    pub(crate) fn forgotten(&self) -> Self {
        Self {
            last_dwell: Some(f64::NAN),
            pocket_r: Some(f64::NAN),
            feed_override_on: Truth::Unknown,
            ..self.unknown()
        }
    }

    /// May the word have been given in this series? Then its NaN is a value that nobody knows.
    pub(crate) fn may_have(&self, letter: Letter) -> bool {
        self.may_have.contains(letter)
    }

    /// Was none of these words given in this series, on any path?
    pub fn lacks(&self, letters: LetterSet) -> bool {
        !self.may_have.intersects(letters)
    }

    /// The block gives the word.
    pub(crate) fn give(&mut self, letter: Letter) {
        self.may_have.insert(letter);
    }

    /// A word's value: `None` not given, NaN unknown.
    pub(crate) fn word(&self, letter: char, value: f64) -> Option<f64> {
        (!value.is_nan() || self.may_have(Letter::of(letter))).then_some(value)
    }

    /// I, J and K are another's, and stay what they were.
    pub(crate) fn take_back_ijk(&mut self, before: &Self) {
        let letters = LetterSet::of("IJK");
        self.ijk = before.ijk;
        self.may_have = self.may_have.without(letters).or(before.may_have.and(letters));
    }

    /// Did a series begin, or may it have begun?
    pub(crate) fn has_begun(&self) -> bool {
        self.may_have(Self::START)
    }

    /// The series begins at a level.
    pub(crate) fn begin(&mut self, level: f64) {
        self.initial = level;
        self.give(Self::START);
    }

    /// The series is over: the next cycle begins at a level of its own.
    pub(crate) fn end(&mut self) {
        self.initial = f64::NAN;
        self.may_have = self.may_have.without([Self::START].into_iter().collect());
    }
}
