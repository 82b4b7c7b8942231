//! G105, servo bar feed: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "G105, servo bar feed",
    key: "G105",
    source: "Haas bar feeder manual",
    module: "bar_feeder",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
