//! One finding of a rule about a program.
//!
//! Knows: places in bytes, the parts of a message. Must not know: lines and columns, terminals, editors.

use std::ops::Range;
use std::sync::Arc;

use crate::{Certainty, Fix, RuleMeta, Severity};

/// One finding.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The rule that made it.
    pub rule: &'static RuleMeta,
    /// Severity after the rule's own judgement (confidence of facts) and before configuration.
    pub severity: Severity,
    /// On which paths it holds.
    pub certainty: Certainty,
    /// One line: lower case, no full stop.
    pub message: String,
    /// Where: bytes of the file.
    pub range: Range<u32>,
    /// What this spot contributes, shown under it; may be empty.
    pub label: String,
    /// The other places involved.
    pub labels: Vec<Label>,
    /// The control's behaviour, with its source.
    pub notes: Vec<String>,
    /// An action, imperative.
    pub help: Option<String>,
    /// The alarm that the control is known to raise.
    pub alarm: Option<String>,
    /// Facts that are not configured and that the verdict assumes: settings, offsets, tables.
    pub assumptions: Vec<String>,
    /// Ways to fix it.
    pub fixes: Vec<Fix>,
}

/// Another place involved in a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The file, if it is another one.
    pub file: Option<Arc<str>>,
    /// Bytes of that file.
    pub range: Range<u32>,
    /// What this place contributes.
    pub message: String,
}

impl Finding {
    /// A finding of a rule at a place, with the rule's own severity.
    pub fn new(rule: &'static RuleMeta, range: Range<u32>, message: impl Into<String>) -> Self {
        Self {
            rule,
            severity: rule.severity,
            certainty: Certainty::Always,
            message: message.into(),
            range,
            label: String::new(),
            labels: Vec::new(),
            notes: Vec::new(),
            help: None,
            alarm: None,
            assumptions: Vec::new(),
            fixes: Vec::new(),
        }
    }

    /// What the spot contributes.
    #[must_use]
    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.label = text.into();
        self
    }

    /// Another place in the same file.
    #[must_use]
    pub fn also(mut self, range: Range<u32>, message: impl Into<String>) -> Self {
        self.labels.push(Label { file: None, range, message: message.into() });
        self
    }

    /// A fact about the control.
    #[must_use]
    pub fn note(mut self, text: impl Into<String>) -> Self {
        self.notes.push(text.into());
        self
    }

    /// What to do.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// The alarm that the control will raise.
    #[must_use]
    pub fn alarm(mut self, text: Option<String>) -> Self {
        self.alarm = text;
        self
    }

    /// What the control answers, as a note says it: `the control raises alarm PS0011`.
    pub fn alarm_note(&self) -> Option<String> {
        self.alarm.as_deref().map(|alarm| format!("the control raises {}", alarm_name(alarm)))
    }

    /// What the verdict rests on.
    #[must_use]
    pub fn assuming(mut self, text: impl Into<String>) -> Self {
        self.assumptions.push(text.into());
        self
    }

    /// A severity no higher than `limit`.
    #[must_use]
    pub fn at_most(mut self, limit: Severity) -> Self {
        self.severity = self.severity.at_most(limit);
        self
    }

    /// A way to fix it.
    #[must_use]
    pub fn fix(mut self, fix: Fix) -> Self {
        self.fixes.push(fix);
        self
    }

    /// A way to fix it, if there is one.
    #[must_use]
    pub fn fix_if(mut self, fix: Option<Fix>) -> Self {
        self.fixes.extend(fix);
        self
    }
}
/// What people call an alarm of a number: `alarm PS0011`, but `error 20` where the control itself says so.
pub fn alarm_name(number: &str) -> String {
    let says_itself = ["alarm ", "error "].iter().any(|word| number.starts_with(word));
    if says_itself { number.to_owned() } else { format!("alarm {number}") }
}
