//! Why a file was not written.
//!
//! Knows: the reasons, in words. Must not know: which step failed.

use std::{fmt, io};

use crate::problem::io_reason;

/// Why a file was not written; it is then as it was.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The system said no.
    System(io::Error),
    /// The file would lose what it has; in words that follow its name.
    Refused(&'static str),
    /// The file is not what the caller wanted to replace.
    Changed,
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::System(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::System(error) => f.write_str(&io_reason(error)),
            Self::Refused(reason) => f.write_str(reason),
            Self::Changed => f.write_str("it was changed by another program in the meantime"),
        }
    }
}
