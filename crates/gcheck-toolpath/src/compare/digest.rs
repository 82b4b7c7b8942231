//! A short name for all that two runs do differently.
//!
//! Knows: how values become bytes that are the same on every machine. Must not know: what is different, and when.
//!
//! Files, lines and comments are left out: they may change while the machine does the same. Differences that are counted and
//! not kept are in it.

use std::fmt::{self, Debug, Write};
use std::hash::Hasher as _;

use twox_hash::XxHash3_64;

/// The name while it is made.
#[derive(Clone, Default)]
pub(super) struct Digest(XxHash3_64);

impl Digest {
    /// Takes in one thing more; numbers count to the fourth decimal.
    pub(super) fn add(&mut self, what: &dyn Debug) {
        // Writing to a digest cannot fail.
        let _ = writeln!(self, "{what:.4?}");
    }

    pub(super) fn value(&self) -> u64 {
        self.0.finish()
    }
}

impl Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

impl Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.value())
    }
}

impl PartialEq for Digest {
    fn eq(&self, other: &Self) -> bool {
        self.value() == other.value()
    }
}
