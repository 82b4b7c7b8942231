//! Findings rendered for people and for machines.
//!
//! Knows: how a [`Report`] looks in every output format, where lines and columns are, how a finding is recognised again.
//! Must not know: how findings are made, files on disk, the environment, clocks, whether the output is a terminal. It is
//! the only crate that may use codespan-reporting.
//!
//! A caller builds a [`Report`] and calls [`write()`]. For the formats that people read it also prints [`control_lines`]
//! (to standard error), [`summary_line`] and, when asked, [`statistics`] and [`file_counts`] in place of the findings.

mod baseline;
mod closing;
mod control;
mod control_lines;
mod excerpt;
mod fingerprint;
mod fold;
mod formats;
mod line_index;
mod path_base;
mod report;
mod shown;
mod source;
mod style;
#[cfg(test)]
mod testing;

pub use baseline::{Baseline, Malformed, StaleEntry};
pub use closing::{assumptions, file_counts, statistics, summary_line};
pub use control::{ControlChoice, ControlSource};
pub use control_lines::control_lines;
pub use fingerprint::{Fingerprint, Fingerprinter};
pub use fold::folded;
pub use formats::{Format, findings_schema, write};
pub use line_index::{LineIndex, Position};
pub use path_base::PathBase;
pub use report::{Assumed, FailedRule, FileReport, RelatedFile, Report, Skipped, Summary};
pub use shown::{harmless, one_line};
pub use style::Colour;
