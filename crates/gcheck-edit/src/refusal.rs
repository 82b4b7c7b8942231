//! Why a change is not made.
//!
//! Knows: a place, a reason, what helps. Must not know: how it is shown.

use std::fmt;
use std::ops::Range;

/// Why a change is not made; nothing of the program is changed then.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Bytes of the program that are in the way; empty for the program as a whole.
    pub range: Range<u32>,
    /// The other file that the reason is in, if it is not in the program.
    pub file: Option<String>,
    /// The reason, a sentence without a capital and a full stop.
    pub reason: String,
    /// What to do, imperative.
    pub help: Option<String>,
}

impl Refusal {
    /// A reason at a place of the program.
    pub fn at(range: Range<u32>, reason: impl Into<String>) -> Self {
        Self { range, file: None, reason: reason.into(), help: None }
    }

    /// A reason that holds for the program as a whole.
    pub fn whole(reason: impl Into<String>) -> Self {
        Self::at(0..0, reason)
    }

    /// What to do about it.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The same in another file; `None` for the program itself.
    #[must_use]
    pub(crate) fn in_file(self, file: Option<&str>) -> Self {
        Self { file: file.map(str::to_owned), ..self }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for Refusal {}
