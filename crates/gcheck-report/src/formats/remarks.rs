//! What several formats print with a finding: its notes and help, and where the project is.
//!
//! Knows: the order of these lines. Must not know: any format.

use gcheck_diagnostics::Finding;

/// Address of the project.
pub(super) const HOME: &str = env!("CARGO_PKG_REPOSITORY");

/// The lines below the source lines, or after the message in formats without them: `note: …`, `help: …`.
pub(super) fn remarks(finding: &Finding) -> Vec<String> {
    let notes = finding.notes.iter().map(|note| format!("note: {note}"));
    let alarm = finding.alarm_note().map(|alarm| format!("note: {alarm}"));
    let assumptions = finding.assumptions.iter().map(|fact| format!("note: assuming {fact}"));
    let help = finding.help.iter().map(|help| format!("help: {help}"));
    notes.chain(alarm).chain(assumptions).chain(help).collect()
}
