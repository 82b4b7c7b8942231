//! Colours of a terminal.
//!
//! Knows: the escape sequences. Must not know: whether the output is a terminal; the caller decides that.

/// Whether the text formats use colour.
///
/// There is no `Auto` on purpose: this crate sees no terminal and no environment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colour {
    /// Text alone.
    #[default]
    Plain,
    /// ANSI escape sequences.
    Ansi,
}

/// Ends every style.
pub(crate) const RESET: &str = "\x1b[0m";
/// Bold, in the colour the terminal has.
pub(crate) const STRONG: &str = "\x1b[0m\x1b[1m";
/// Frames, line numbers, secondary labels.
pub(crate) const FRAME: &str = "\x1b[0m\x1b[34m";

/// Start of a text in the colour of a severity.
pub(crate) fn severity(severity: gcheck_diagnostics::Severity) -> &'static str {
    match severity {
        gcheck_diagnostics::Severity::Error => "\x1b[0m\x1b[1;31m",
        gcheck_diagnostics::Severity::Warning => "\x1b[0m\x1b[1;33m",
        gcheck_diagnostics::Severity::Info => "\x1b[0m\x1b[1;36m",
        gcheck_diagnostics::Severity::Hint => "\x1b[0m\x1b[1;32m",
    }
}

impl Colour {
    /// The sequence, or nothing.
    pub(crate) fn paint(self, sequence: &'static str) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Ansi => sequence,
        }
    }
}
