//! A short name for all that two runs do differently.
//!
//! Knows: how values become bytes that are the same on every machine. Must not know: what is different, and when.
//!
//! Files, lines and comments are left out: they may change while the machine does the same. Differences that are counted and
//! not kept are in it.

use std::fmt::{self, Debug, Write};
use std::hash::Hasher as _;

use twox_hash::XxHash3_64;

/// The name while it is made; one that nobody asks for takes nothing in.
#[derive(Clone, Default)]
pub(super) struct Digest(Option<XxHash3_64>);

impl Digest {
    /// One that somebody asks for.
    pub(super) fn begun() -> Self {
        Self(Some(XxHash3_64::default()))
    }

    /// An empty one, if this one is asked for.
    pub(super) fn another(&self) -> Self {
        if self.0.is_some() { Self::begun() } else { Self::default() }
    }

    /// Takes in one thing more; numbers count to the fourth decimal.
    pub(super) fn add(&mut self, what: &dyn Debug) {
        if let Some(hasher) = &mut self.0 {
            // Writing to a hasher cannot fail.
            let _ = writeln!(Text(hasher), "{what:.4?}");
        }
    }

    /// Zero, if nobody asks for it.
    pub(super) fn value(&self) -> u64 {
        self.0.as_ref().map_or(0, XxHash3_64::finish)
    }
}

/// A hasher that is written to.
struct Text<'h>(&'h mut XxHash3_64);

impl Write for Text<'_> {
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
