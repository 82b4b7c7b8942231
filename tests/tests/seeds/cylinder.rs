//! G107, cylindrical mapping: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G107, cylindrical mapping",
    key: "G107",
    source: "Haas 96-8000, June 1999, p. 203",
    module: "cylinder",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
