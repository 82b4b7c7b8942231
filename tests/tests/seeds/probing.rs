//! G136, automatic work offset centre measurement, and G31, G35, G36, G37: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G136, automatic work offset centre measurement, and G31, G35, G36, G37",
    key: "G136",
    source: "Haas 96-8000 rev R, June 2007, p. 152",
    module: "probing",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
