//! Words that shape the corner at the end of a straight cut.
//!
//! Knows: which words a control has for that. Must not know: where a corner is, how it is cut.

use gcheck_controls::{Letter, LetterSet};

/// The words of a straight cut that shape it, by what they do.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct CornerWords {
    /// Radius of a rounding.
    pub(crate) round: LetterSet,
    /// Size of a chamfer. One that says by its sign which way the next cut goes counts by its size.
    pub(crate) chamfer: LetterSet,
    /// Angle of the line from the plane's first axis, degrees.
    pub(crate) angle: LetterSet,
}

impl CornerWords {
    /// Those among the words of the straight cut that move no axis.
    pub(crate) fn of(words: &[gcheck_controls::WordEntry], axes: LetterSet) -> Self {
        let taken = |letters: &[Letter]| -> LetterSet {
            let is_taken = |letter: &&Letter| {
                !axes.contains(**letter)
                    && words.iter().any(|word| Letter::parse(&word.letter) == Some(**letter))
            };
            letters.iter().filter(is_taken).copied().collect()
        };
        Self {
            round: taken(&[Letter::CORNER_R, Letter::of('R')]),
            chamfer: taken(&[Letter::CORNER_C, Letter::of('I'), Letter::of('K')]),
            angle: taken(&[Letter::CORNER_A, Letter::of('A')]),
        }
    }

    pub(crate) fn corners(&self) -> LetterSet {
        self.round.or(self.chamfer)
    }
}
