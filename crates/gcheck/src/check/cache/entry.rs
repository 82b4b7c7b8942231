//! The form of a stored result.
//!
//! Knows: every part of a verdict, and that rules are called by id. Must not know: where entries lie.

use std::ops::Range;
use std::sync::Arc;

use gcheck_report::{ControlChoice, ControlSource};
use gcheck_rules::{Certainty, Described, Edit, Finding, Fix, Label, RuleMeta, Severity};
use serde::{Deserialize, Serialize};

use super::questions::Asked;

/// What a check said about a program, without the program.
#[derive(Debug, Clone)]
pub(in crate::check) struct Verdict {
    pub(in crate::check) control: ControlChoice,
    pub(in crate::check) findings: Vec<Finding>,
    /// Findings beyond those kept, by rule and severity.
    pub(in crate::check) omitted: Vec<(&'static RuleMeta, Severity, usize)>,
    pub(in crate::check) lines: usize,
    pub(in crate::check) suppressed: usize,
    pub(in crate::check) out_of_fuel: bool,
    pub(in crate::check) assumptions: Vec<Described>,
}

/// A verdict, and what it rests on besides what its key says.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::check) struct Entry {
    pub(in crate::check) asked: Asked,
    verdict: Stored,
}

#[derive(Debug, Serialize, Deserialize)]
struct Stored {
    control: (String, u8, Option<String>),
    /// Ids that the others name by their place.
    rules: Vec<String>,
    findings: Vec<StoredFinding>,
    omitted: Vec<(u32, u8, u64)>,
    lines: u64,
    suppressed: u64,
    out_of_fuel: bool,
    assumptions: Vec<(String, Option<String>)>,
}

#[derive(Debug, Serialize, Deserialize)]
struct StoredFinding {
    rule: u32,
    severity: u8,
    maybe: bool,
    message: String,
    range: Range<u32>,
    label: String,
    labels: Vec<(Option<String>, Range<u32>, String)>,
    notes: Vec<String>,
    help: Option<String>,
    alarm: Option<String>,
    assumptions: Vec<String>,
    fixes: Vec<StoredFix>,
}

#[derive(Debug, Serialize, Deserialize)]
struct StoredFix {
    title: String,
    safe: bool,
    edits: Vec<(Range<u32>, String)>,
}

/// In the order in which stored results count them.
const SOURCES: [ControlSource; 5] = [
    ControlSource::Configuration,
    ControlSource::Option,
    ControlSource::Comment,
    ControlSource::Detected,
    ControlSource::Default,
];

impl Entry {
    pub(in crate::check) fn new(asked: Asked, verdict: &Verdict) -> Self {
        Self { asked, verdict: Stored::new(verdict) }
    }

    /// The verdict; none if a rule is not there, which another build may have had.
    pub(in crate::check) fn verdict(self) -> Option<Verdict> {
        self.verdict.restore()
    }

    pub(super) fn encode(&self) -> Option<Vec<u8>> {
        postcard::to_allocvec(self).ok()
    }

    pub(super) fn decode(payload: &[u8]) -> Option<Self> {
        postcard::from_bytes(payload).ok()
    }
}

impl Stored {
    fn new(verdict: &Verdict) -> Self {
        let Verdict { control, findings, omitted, lines, suppressed, out_of_fuel, assumptions } = verdict;
        let mut rules: Vec<&str> = Vec::new();
        let mut place = |rule: &'static RuleMeta| {
            let known = rules.iter().position(|id| *id == rule.id);
            known.unwrap_or_else(|| {
                rules.push(rule.id);
                rules.len() - 1
            }) as u32
        };
        let findings =
            findings.iter().map(|finding| StoredFinding::new(finding, place(finding.rule))).collect();
        let omitted = omitted
            .iter()
            .map(|(rule, severity, count)| (place(rule), number_of(*severity), *count as u64))
            .collect();
        let source = SOURCES.iter().position(|source| *source == control.source).unwrap_or_default() as u8;
        Self {
            control: (control.name.clone(), source, control.because.clone()),
            rules: rules.into_iter().map(str::to_owned).collect(),
            findings,
            omitted,
            lines: *lines as u64,
            suppressed: *suppressed as u64,
            out_of_fuel: *out_of_fuel,
            assumptions: assumptions.iter().map(|a| (a.text.clone(), a.pin.clone())).collect(),
        }
    }

    fn restore(self) -> Option<Verdict> {
        let rules: Vec<&'static RuleMeta> = self
            .rules
            .iter()
            .map(|id| gcheck_rules::by_id(id).map(|rule| rule.meta))
            .collect::<Option<_>>()?;
        let rule = |place: u32| rules.get(place as usize).copied();
        let (name, source, because) = self.control;
        Some(Verdict {
            control: ControlChoice { name, source: *SOURCES.get(usize::from(source))?, because },
            findings: self
                .findings
                .into_iter()
                .map(|finding| {
                    let rule = rule(finding.rule)?;
                    finding.restore(rule)
                })
                .collect::<Option<_>>()?,
            omitted: self
                .omitted
                .into_iter()
                .map(|(place, severity, count)| {
                    Some((rule(place)?, severity_of(severity)?, usize::try_from(count).ok()?))
                })
                .collect::<Option<_>>()?,
            lines: usize::try_from(self.lines).ok()?,
            suppressed: usize::try_from(self.suppressed).ok()?,
            out_of_fuel: self.out_of_fuel,
            assumptions: self.assumptions.into_iter().map(|(text, pin)| Described { text, pin }).collect(),
        })
    }
}

impl StoredFinding {
    fn new(finding: &Finding, rule: u32) -> Self {
        let Finding {
            rule: _,
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
        } = finding;
        Self {
            rule,
            severity: number_of(*severity),
            maybe: *certainty == Certainty::Maybe,
            message: message.clone(),
            range: range.clone(),
            label: label.clone(),
            labels: labels
                .iter()
                .map(|l| (l.file.as_deref().map(str::to_owned), l.range.clone(), l.message.clone()))
                .collect(),
            notes: notes.clone(),
            help: help.clone(),
            alarm: alarm.clone(),
            assumptions: assumptions.clone(),
            fixes: fixes
                .iter()
                .map(|fix| {
                    let edits = fix.edits.iter().map(|edit| (edit.range.clone(), edit.text.clone()));
                    StoredFix { title: fix.title.clone(), safe: fix.safe, edits: edits.collect() }
                })
                .collect(),
        }
    }

    fn restore(self, rule: &'static RuleMeta) -> Option<Finding> {
        Some(Finding {
            rule,
            severity: severity_of(self.severity)?,
            certainty: if self.maybe { Certainty::Maybe } else { Certainty::Always },
            message: self.message,
            range: self.range,
            label: self.label,
            labels: self
                .labels
                .into_iter()
                .map(|(file, range, message)| Label { file: file.map(Arc::from), range, message })
                .collect(),
            notes: self.notes,
            help: self.help,
            alarm: self.alarm,
            assumptions: self.assumptions,
            fixes: self
                .fixes
                .into_iter()
                .map(|StoredFix { title, safe, edits }| Fix {
                    title,
                    safe,
                    edits: edits.into_iter().map(|(range, text)| Edit { range, text }).collect(),
                })
                .collect(),
        })
    }
}

fn number_of(severity: Severity) -> u8 {
    Severity::ALL.iter().position(|s| *s == severity).unwrap_or_default() as u8
}

fn severity_of(number: u8) -> Option<Severity> {
    Severity::ALL.get(usize::from(number)).copied()
}
