//! G143, 5-axis tool length compensation: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G143, 5-axis tool length compensation",
    key: "G143",
    source: "Haas 96-8000 rev AC, May 2010, p. 184",
    module: "length_5_axis",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
