//! Suppressions: what the comments of a program silence.
//!
//! Knows: which findings a suppression covers. Must not know: how comments are read, how findings are made.

use std::ops::Range;

use gcheck_diagnostics::{Finding, Fix};

/// One directive that silences findings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Suppression {
    /// The comment's bytes of the file.
    pub range: Range<u32>,
    /// What it silences, as written: rules, groups or `all`.
    pub selectors: Vec<String>,
    /// It says why.
    pub has_reason: bool,
    /// Bytes of the file: findings that start in them are silenced. The end is the greatest number until a region is closed.
    pub(crate) scope: Range<u32>,
    /// It has silenced something.
    pub used: bool,
}

/// A directive that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MalformedDirective {
    /// The comment's bytes of the file.
    pub range: Range<u32>,
    /// What is wrong with it.
    pub message: String,
    /// Writes the nearest name, where one is near enough.
    pub fix: Option<Fix>,
}

/// The directives of a file.
#[derive(Debug, Clone, Default)]
pub struct Suppressions {
    /// Those that can be read, in text order.
    pub list: Vec<Suppression>,
    /// The others, in text order.
    pub malformed: Vec<MalformedDirective>,
}

impl Suppressions {
    /// Is the finding silenced? Marks every suppression that covers it as used.
    pub(crate) fn silences(&mut self, finding: &Finding) -> bool {
        let mut silenced = false;
        for suppression in &mut self.list {
            if suppression.scope.contains(&finding.range.start)
                && suppression.selectors.iter().any(|selector| finding.rule.is_selected_by(selector))
            {
                suppression.used = true;
                silenced = true;
            }
        }
        silenced
    }
}
