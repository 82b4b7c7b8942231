//! G141, 3D+ cutter compensation: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G141, 3D+ cutter compensation",
    key: "G141",
    source: "Haas 96-8000 rev R, June 2007, p. 153",
    module: "cutter_3d",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
