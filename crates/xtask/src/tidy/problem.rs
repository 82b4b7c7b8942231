//! A place where a law is broken.
//!
//! Knows: how it is printed. Must not know: any law.

use std::fmt;

/// A place where a law is broken.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Problem {
    pub(super) path: String,
    /// From 1; 0 when the whole file is meant.
    pub(super) line: usize,
    pub(super) message: String,
}

impl Problem {
    pub(super) fn new(path: impl Into<String>, line: usize, message: impl Into<String>) -> Self {
        Self { path: path.into(), line, message: message.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.path, self.message),
            line => write!(f, "{}:{line}: {}", self.path, self.message),
        }
    }
}
