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

/// One normative sentence, in our words, with its proofs.
pub(crate) struct Sentence {
    pub(crate) says: &'static str,
    pub(crate) proofs: &'static [Proof],
}

/// Proves every sentence of a system, and shows all that fail.
pub(crate) fn prove(system: &System) {
    let failures: Vec<String> = system
        .sentences
        .par_iter()
        .enumerate()
        .flat_map_iter(|(index, sentence)| {
            let number = format!("{}-{}: {}", system.key, index + 1, sentence.says);
            assert!(!sentence.proofs.is_empty(), "{number}: nothing proves it");
            sentence
                .proofs
                .iter()
                .filter_map(move |proof| holds(proof).err().map(|why| format!("{number}\n{why}\n")))
        })
        .collect();
    assert!(failures.is_empty(), "{} proofs fail\n\n{}", failures.len(), failures.join("\n"));
}
