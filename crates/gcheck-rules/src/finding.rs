//! What a rule says about a program: the vocabulary of a finding.
//!
//! Knows: severities, places in bytes, words for people, fixes as edits. Must not know: lines and columns, terminals, LSP.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::RuleMeta;

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// A matter of style.
    Hint,
    /// Worth knowing.
    Info,
    /// A likely crash, scrap or trap.
    Warning,
    /// The control alarms, or the move is certainly wrong.
    Error,
}

impl Severity {
    /// All severities, the mildest first.
    pub const ALL: [Self; 4] = [Self::Hint, Self::Info, Self::Warning, Self::Error];

    /// The name used in every format and in configuration.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hint => "hint",
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }

    /// The severity of a name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name)
    }

    /// The severity, or the milder one if `limit` is milder.
    #[must_use]
    pub fn at_most(self, limit: Self) -> Self {
        self.min(limit)
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// On which paths a finding holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Certainty {
    /// On every path, or without regard to paths.
    Always,
    /// On some path; the labels show it.
    Maybe,
}

impl Certainty {
    /// The name used in every format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Always => "always",
            Self::Maybe => "maybe",
        }
    }
}

/// One finding.
#[derive(Debug, Clone)]
pub struct Finding {
    /// The rule that made it.
    pub rule: &'static RuleMeta,
    /// Severity after the rule's own judgement (confidence of facts) and before configuration.
    pub severity: Severity,
    /// On which paths it holds.
    pub certainty: Certainty,
    /// Stands alone in one line: lower case, no full stop.
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
    /// What the verdict rests on that nobody told us: settings, offsets, tables.
    pub assumptions: Vec<String>,
    /// Ways to mend it.
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

/// A way to mend a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fix {
    /// Imperative: "write `G1` as `G01`".
    pub title: String,
    /// Does not change any move. Only such fixes are applied without being asked twice.
    pub safe: bool,
    /// Edits of this file that do not overlap.
    pub edits: Vec<Edit>,
}

/// A replacement of bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Bytes of the file.
    pub range: Range<u32>,
    /// What stands there afterwards.
    pub text: String,
}

impl PartialEq for Finding {
    fn eq(&self, other: &Self) -> bool {
        let Self {
            rule,
            severity,
            certainty,
            message,
            range,
            label,
            labels,
            notes,
            help,
            alarm,
            assumptions,
            fixes,
        } = self;
        rule.id == other.rule.id
            && (severity, certainty, message, range)
                == (&other.severity, &other.certainty, &other.message, &other.range)
            && (label, labels, notes, help) == (&other.label, &other.labels, &other.notes, &other.help)
            && (alarm, assumptions, fixes) == (&other.alarm, &other.assumptions, &other.fixes)
    }
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

    /// The alarm it foretells.
    #[must_use]
    pub fn alarm(mut self, text: Option<String>) -> Self {
        self.alarm = text;
        self
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

    /// A way to mend it.
    #[must_use]
    pub fn fix(mut self, fix: Fix) -> Self {
        self.fixes.push(fix);
        self
    }
}

impl Fix {
    /// One replacement that changes no move.
    pub fn safe(title: impl Into<String>, range: Range<u32>, text: impl Into<String>) -> Self {
        Self { title: title.into(), safe: true, edits: vec![Edit { range, text: text.into() }] }
    }

    /// One replacement that may change moves, or whose intent only the programmer knows.
    pub fn risky(title: impl Into<String>, range: Range<u32>, text: impl Into<String>) -> Self {
        Self { safe: false, ..Self::safe(title, range, text) }
    }
}
