//! The output formats: their names and the one way to write them.
//!
//! Knows: which formats exist. Must not know: what any of them looks like; each is one file here.

mod azure;
mod checkstyle;
mod concise;
mod full;
mod github;
mod gitlab;
mod grouped;
mod json;
mod jsonl;
mod junit;
mod list;
mod rdjson;
mod remarks;
mod sarif;
mod schema;
mod xml;

pub use schema::findings_schema;

use std::io::{self, Write};

use crate::{Colour, Report};

/// An output format. Names are a promise (see `contract`): they change only with a major version.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Format {
    /// Source lines, labels, notes: for reading at a terminal.
    #[default]
    Full,
    /// One line a finding.
    Concise,
    /// A table for each file.
    Grouped,
    /// One object with everything that is known.
    Json,
    /// One object a finding, a line each.
    Jsonl,
    /// SARIF 2.1.0, for code hosts and viewers.
    Sarif,
    /// Workflow commands that GitHub shows beside the lines of a change.
    Github,
    /// A code quality report for GitLab's merge requests.
    Gitlab,
    /// The XML of Checkstyle, which many servers read.
    Checkstyle,
    /// Test results, a suite a file.
    Junit,
    /// Diagnostics for reviewdog.
    Rdjson,
    /// Logging commands of Azure Pipelines.
    Azure,
}

impl Format {
    /// All formats, in the order in which help lists them.
    pub const ALL: [Self; 12] = [
        Self::Full,
        Self::Concise,
        Self::Grouped,
        Self::Json,
        Self::Jsonl,
        Self::Sarif,
        Self::Github,
        Self::Gitlab,
        Self::Checkstyle,
        Self::Junit,
        Self::Rdjson,
        Self::Azure,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Concise => "concise",
            Self::Grouped => "grouped",
            Self::Json => "json",
            Self::Jsonl => "jsonl",
            Self::Sarif => "sarif",
            Self::Github => "github",
            Self::Gitlab => "gitlab",
            Self::Checkstyle => "checkstyle",
            Self::Junit => "junit",
            Self::Rdjson => "rdjson",
            Self::Azure => "azure",
        }
    }

    /// The format of a name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }

    /// Whether it is made for people alone: repeats may be folded, and counts may take the place of findings.
    pub fn is_for_people(self) -> bool {
        matches!(self, Self::Full | Self::Concise | Self::Grouped)
    }

    /// Whether people read it, so that a summary line may follow; otherwise the output is one document and ends itself.
    pub fn is_text(self) -> bool {
        match self {
            Self::Full | Self::Concise | Self::Grouped | Self::Github | Self::Azure => true,
            Self::Json
            | Self::Jsonl
            | Self::Sarif
            | Self::Gitlab
            | Self::Checkstyle
            | Self::Junit
            | Self::Rdjson => false,
        }
    }
}

/// Writes a report. Colour matters to `full`, `concise` and `grouped` only.
///
/// # Errors
/// What `out` answers.
pub fn write(report: &Report, format: Format, colour: Colour, out: &mut dyn Write) -> io::Result<()> {
    // Formats write in small pieces.
    let mut out = io::BufWriter::with_capacity(1 << 16, out);
    match format {
        Format::Full => full::write(report, colour, &mut out)?,
        Format::Concise => concise::write(report, colour, &mut out)?,
        Format::Grouped => grouped::write(report, colour, &mut out)?,
        Format::Json => json::write(report, &mut out)?,
        Format::Jsonl => jsonl::write(report, &mut out)?,
        Format::Sarif => sarif::write(report, &mut out)?,
        Format::Github => github::write(report, &mut out)?,
        Format::Gitlab => gitlab::write(report, &mut out)?,
        Format::Checkstyle => checkstyle::write(report, &mut out)?,
        Format::Junit => junit::write(report, &mut out)?,
        Format::Rdjson => rdjson::write(report, &mut out)?,
        Format::Azure => azure::write(report, &mut out)?,
    }
    out.flush()
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
