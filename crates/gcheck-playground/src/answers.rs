//! What the page is told, as data that becomes JSON.
//!
//! Knows: the shape of the answers. Must not know: how they come about.

use std::fmt;

use gcheck_db::Snapshot;
use gcheck_diagnostics::Finding;
use serde::Serialize;

use crate::place::{Span, span};

/// A control that can be chosen.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ControlRow {
    /// The name that the other functions take.
    pub name: String,
    /// What people call it.
    pub title: String,
}

/// The control that a program is read for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Choice {
    /// Its name.
    pub name: String,
    /// What people call it.
    pub title: String,
    /// Where the choice is from.
    pub source: Source,
    /// What of the program speaks for it; `None` where it was chosen, or where nothing does.
    pub because: Option<String>,
}

/// Where the choice of a control is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Source {
    /// The reader of the page.
    Chosen,
    /// A comment of the program.
    Comment,
    /// The codes and the words of the program, clearly.
    Shown,
    /// The codes and the words of the program, weakly.
    Guessed,
    /// Nobody: it is the usual one.
    Usual,
}

/// What is found in a program.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Findings {
    /// The control that the program is read for.
    pub control: Choice,
    /// Findings in text order.
    pub findings: Vec<Found>,
    /// Findings that are not listed.
    pub more: usize,
    /// Findings that comments silence.
    pub suppressed: usize,
    /// The analysis of paths ended before it had seen all.
    pub out_of_fuel: bool,
}

/// A finding.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Found {
    /// The rule's id.
    pub rule: &'static str,
    /// Address of the rule's page.
    pub page: String,
    /// `error`, `warning`, `info` or `hint`.
    pub severity: &'static str,
    /// Where.
    pub span: Span,
    /// One line.
    pub message: String,
    /// What this spot contributes; may be empty.
    pub label: String,
    /// Other places involved.
    pub related: Vec<Related>,
    /// The control's behaviour, and what is taken as given.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
}

/// Another place of a finding.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Related {
    /// Where.
    pub span: Span,
    /// What this place contributes.
    pub message: String,
}

/// What is shown for a place.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shown {
    /// The code, word or number at the place.
    pub span: Span,
    /// Markdown.
    pub markdown: String,
}

/// Why a question has no answer, in words for the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused(pub String);

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Refused {}

impl Found {
    pub(crate) fn new(snapshot: &Snapshot, finding: &Finding) -> Self {
        let alarm = finding.alarm_note();
        let assumptions = finding.assumptions.iter().map(|fact| format!("assuming {fact}"));
        // The page has one program, so that a place in another file cannot be shown.
        let labels = finding.labels.iter().filter(|label| label.file.is_none());
        Self {
            rule: finding.rule.id,
            page: finding.rule.page(),
            severity: finding.severity.name(),
            span: span(snapshot, &finding.range),
            message: finding.message.clone(),
            label: finding.label.clone(),
            related: labels
                .map(|label| Related { span: span(snapshot, &label.range), message: label.message.clone() })
                .collect(),
            notes: finding.notes.iter().cloned().chain(alarm).chain(assumptions).collect(),
            help: finding.help.clone(),
        }
    }
}
