//! G150, general purpose pocket milling: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G150, general purpose pocket milling",
    key: "G150",
    source: "Haas 96-8000 rev AC, May 2010, p. 184; June 1999, p. 208",
    module: "pockets",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
