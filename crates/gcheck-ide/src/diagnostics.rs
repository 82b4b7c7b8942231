//! Findings as editors publish them.
//!
//! Knows: how much of a finding an editor shows, how many findings it takes. Must not know: rules.

use std::ops::Range;
use std::sync::Arc;

use gcheck_db::Analysis;
use gcheck_rules::{Finding, Severity};

/// Most diagnostics of a document; the rest are counted.
pub const MAX_DIAGNOSTICS: usize = 1_000;

/// The diagnostics of a document.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Diagnostics {
    /// In text order, at most [`MAX_DIAGNOSTICS`].
    pub list: Vec<Diagnostic>,
    /// What is not listed, by rule, the most frequent first.
    pub omitted: Vec<Omitted>,
}

/// One finding for an editor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The rule's id.
    pub rule: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// Bytes of the file.
    pub range: Range<u32>,
    /// The title, and behind it what this spot contributes, notes and help, one a line.
    pub message: String,
    /// Other places involved.
    pub related: Vec<Related>,
    /// Address of the rule's page.
    pub docs: String,
    /// The text can never run, so editors fade it.
    pub unnecessary: bool,
    /// The finding has a fix.
    pub fixable: bool,
}

/// Another place involved in a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Related {
    /// Name of the file, if it is another one.
    pub file: Option<Arc<str>>,
    /// Bytes of that file.
    pub range: Range<u32>,
    /// What this place contributes.
    pub message: String,
}

/// Findings of one rule that are not listed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Omitted {
    /// The rule's id.
    pub rule: &'static str,
    /// How bad they are.
    pub severity: Severity,
    /// How many.
    pub count: usize,
}

/// What is published of an analysis.
pub fn diagnostics(analysis: &Analysis) -> Diagnostics {
    let _: &[Finding] = &analysis.findings;
    Diagnostics::default()
}

/// Bytes that no path comes to, as findings say it, in text order.
pub fn unreachable_ranges(analysis: &Analysis) -> Vec<Range<u32>> {
    let _ = analysis;
    Vec::new()
}
