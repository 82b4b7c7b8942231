//! How a rule hands over its findings.
//!
//! Knows: that a confidence limits a severity. Must not know: which findings are kept, rules.

use gcheck_controls::Confidence;
use gcheck_diagnostics::{Finding, Severity};

/// Takes the findings of one rule.
pub struct Report<'r> {
    add: &'r mut dyn FnMut(Finding),
}

impl<'r> Report<'r> {
    pub(crate) fn new(add: &'r mut dyn FnMut(Finding)) -> Self {
        Self { add }
    }

    /// Adds a finding.
    pub fn add(&mut self, finding: Finding) {
        (self.add)(finding);
    }
}

/// A fact's confidence as a limit of severity: nothing assumed is ever an error.
pub fn limit(confidence: Confidence) -> Severity {
    match confidence {
        Confidence::Manual => Severity::Error,
        Confidence::Observed | Confidence::Assumed => Severity::Warning,
    }
}
