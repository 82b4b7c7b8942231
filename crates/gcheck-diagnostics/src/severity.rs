//! How bad a finding is, and on which paths of a program it holds.
//!
//! Knows: the scales and their names. Must not know: how a severity is chosen or shown.

use std::fmt;

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// A matter of style.
    Hint,
    /// Worth knowing.
    Info,
    /// A likely crash, scrap or trap.
    Warning,
    /// The control alarms, or the move is certainly wrong.
    Error,
}

impl Severity {
    /// All severities, the mildest first.
    pub const ALL: [Self; 4] = [Self::Hint, Self::Info, Self::Warning, Self::Error];

    /// The name used in every format and in configuration.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hint => "hint",
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }

    /// The severity of a name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name)
    }

    /// The severity, or the milder one if `limit` is milder.
    #[must_use]
    pub fn at_most(self, limit: Self) -> Self {
        self.min(limit)
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// On which paths a finding holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Certainty {
    /// On every path, or without regard to paths.
    Always,
    /// On some path; the labels show it.
    Maybe,
}

impl Certainty {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Always, Self::Maybe];

    /// The name used in every format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Always => "always",
            Self::Maybe => "maybe",
        }
    }
}
