//! A sentence of a founding page, with its proofs.
//!
//! Knows: sentences in our words. Must not know: how a proof is made.

use rayon::prelude::*;

use crate::proof::{Proof, holds};

/// A system of a control: one page of a manual.
pub(crate) struct System {
    /// The code that the page is about, and its title: `G143, 5-axis tool length compensation`.
    pub(crate) title: &'static str,
    /// Before the number of a sentence: `G143`.
    pub(crate) key: &'static str,
    /// Manuals and pages.
    pub(crate) source: &'static str,
    /// The module with the programs of the system, which the page names.
    pub(crate) module: &'static str,
    pub(crate) sentences: &'static [Sentence],
}

/// One normative sentence, in our words, with its proofs by the kind of word that they are about.
pub(crate) struct Sentence {
    pub(crate) says: &'static str,
    /// Words written as numbers, and what needs no word.
    pub(crate) literal: Tests,
    /// Words with a variable or an expression.
    pub(crate) computed: Tests,
    /// Words and modes of an earlier block.
    pub(crate) lasting: Tests,
    /// Words that a block leaves out, and targets that are not there.
    pub(crate) missing: Tests,
    /// Words that the code does not have, and words that exclude each other.
    pub(crate) extra: Tests,
    /// Values outside the range, with the wrong sign, or finer than the step.
    pub(crate) range: Tests,
}

/// The tests of a kind.
pub(crate) enum Tests {
    By(&'static [Proof]),
    /// The sentence has no such word: why, in two or three words.
    No(&'static str),
}

impl Sentence {
    /// The tests by kind, in the order of [`KINDS`].
    pub(crate) const fn kinds(&self) -> [&Tests; 6] {
        [&self.literal, &self.computed, &self.lasting, &self.missing, &self.extra, &self.range]
    }
}

/// What the kinds are called on the page.
pub(crate) const KINDS: [&str; 6] = ["as numbers", "computed", "lasting", "missing", "extra", "out of range"];

/// Proves every sentence of a system, and shows all that fail.
pub(crate) fn prove(system: &System) {
    let failures: Vec<String> = system
        .sentences
        .par_iter()
        .enumerate()
        .flat_map_iter(|(index, sentence)| {
            let number = format!("{}-{}: {}", system.key, index + 1, sentence.says);
            let proofs = sentence.kinds().into_iter().zip(KINDS).flat_map(|(tests, kind)| match tests {
                Tests::By(proofs) => {
                    assert!(!proofs.is_empty(), "{number}: no test {kind}, and no reason why");
                    proofs.iter().map(|proof| (kind, proof)).collect()
                }
                Tests::No(why) => {
                    assert!(kind != KINDS[0], "{number}: nothing proves it: {why}");
                    Vec::new()
                }
            });
            let proofs: Vec<(&str, &Proof)> = proofs.collect();
            proofs
                .into_par_iter()
                .filter_map(|(kind, proof)| {
                    holds(proof).err().map(|why| format!("{number} ({kind})\n{why}\n"))
                })
                .collect::<Vec<String>>()
        })
        .collect();
    assert!(failures.is_empty(), "{} proofs fail\n\n{}", failures.len(), failures.join("\n"));
}
