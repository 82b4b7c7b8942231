//! The output formats: their names and the one way to write them.
//!
//! Knows: which formats exist. Must not know: what any of them looks like; each is one file here.

mod concise;
mod full;
mod github;
mod json;
mod sarif;

use std::io::{self, Write};

use gcheck_rules::Finding;

use crate::{Colour, Report};

/// An output format. Names are a promise (see `contract`): they change only with a major version.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Format {
    /// Source lines, labels, notes: for reading at a terminal.
    #[default]
    Full,
    /// One line a finding.
    Concise,
    /// One object with everything that is known.
    Json,
    /// SARIF 2.1.0, for code hosts and viewers.
    Sarif,
    /// Workflow commands that GitHub shows beside the lines of a change.
    Github,
}

impl Format {
    /// All formats, in the order in which help lists them.
    pub const ALL: [Self; 5] = [Self::Full, Self::Concise, Self::Json, Self::Sarif, Self::Github];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Concise => "concise",
            Self::Json => "json",
            Self::Sarif => "sarif",
            Self::Github => "github",
        }
    }

    /// The format of a name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }

    /// Whether people read it, so that a summary line may follow; otherwise the output is one document and ends itself.
    pub fn is_text(self) -> bool {
        match self {
            Self::Full | Self::Concise | Self::Github => true,
            Self::Json | Self::Sarif => false,
        }
    }
}

/// Writes a report. Colour matters to `full` and `concise` only.
///
/// # Errors
/// What `out` answers.
pub fn write(report: &Report, format: Format, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    // Formats write in small pieces.
    let mut out = io::BufWriter::with_capacity(1 << 16, out);
    match format {
        Format::Full => full::write(report, colour, &mut out)?,
        Format::Concise => concise::write(report, colour, &mut out)?,
        Format::Json => json::write(report, &mut out)?,
        Format::Sarif => sarif::write(report, &mut out)?,
        Format::Github => github::write(report, &mut out)?,
    }
    out.flush()
}

/// What is said below the source lines, or after the message in formats without them: `note: …`, `help: …`.
fn remarks(finding: &Finding) -> Vec<String> {
    let notes = finding.notes.iter().map(|note| format!("note: {note}"));
    let alarm = finding.alarm.iter().map(|alarm| format!("note: the control raises alarm {alarm}"));
    let assumptions = finding.assumptions.iter().map(|fact| format!("note: assuming {fact}"));
    let help = finding.help.iter().map(|help| format!("help: {help}"));
    notes.chain(alarm).chain(assumptions).chain(help).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for format in Format::ALL {
            assert_eq!(Format::parse(format.name()), Some(format));
        }
        assert_eq!(Format::parse("xml"), None);
    }
}
