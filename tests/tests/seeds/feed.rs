//! Feed modes, dwell and helices: the sentences of its page and what proves them.
//!
//! Knows: sentences in our words, programs, expectations. Must not know: how they are checked.

use crate::sentence::{System, prove};

pub(crate) const SYSTEM: System = System {
    title: "Feed modes, dwell and helices",
    key: "Feed",
    source: "General milling control, feed functions and circular interpolation",
    module: "feed",
    sentences: &[],
};

#[test]
fn holds() {
    prove(&SYSTEM);
}
