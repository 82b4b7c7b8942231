//! The form of a stored result.
//!
//! Knows: every part of a verdict; that rules are called by id; that findings repeat each other's words. Must not know: where
//! entries lie.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use gcheck_diagnostics::{Certainty, Edit, Finding, Fix, Label, RuleMeta, Severity, StatedAssumption};
use gcheck_report::{ControlChoice, ControlSource};
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
    /// Rules that failed; a verdict with any is not stored.
    pub(in crate::check) failed_rules: Vec<&'static str>,
    pub(in crate::check) assumptions: Vec<StatedAssumption>,
}

/// A verdict, and what it rests on besides what its key says.
#[derive(Debug, Serialize, Deserialize)]
pub(in crate::check) struct Entry {
    pub(in crate::check) asked: Asked,
    /// The programs beside it may change which control it is for.
    pub(in crate::check) depends_on_neighbours: bool,
    /// Every text once; the others name it by its place.
    texts: Vec<String>,
    control: (Text, u8, Option<Text>),
    findings: Vec<StoredFinding>,
    omitted: Vec<(Text, u8, u64)>,
    lines: u64,
    suppressed: u64,
    out_of_fuel: bool,
    assumptions: Vec<(Text, Option<Text>)>,
}

/// The place of a text.
type Text = u32;

#[derive(Debug, Serialize, Deserialize)]
struct StoredFinding {
    rule: Text,
    severity: u8,
    maybe: bool,
    message: Text,
    range: Range<u32>,
    label: Text,
    labels: Vec<(Option<Text>, Range<u32>, Text)>,
    notes: Vec<Text>,
    help: Option<Text>,
    alarm: Option<Text>,
    assumptions: Vec<Text>,
    fixes: Vec<StoredFix>,
}

#[derive(Debug, Serialize, Deserialize)]
struct StoredFix {
    title: Text,
    safe: bool,
    edits: Vec<(Range<u32>, Text)>,
}

/// In the order in which stored results count them.
const SOURCES: [ControlSource; 7] = [
    ControlSource::Configuration,
    ControlSource::Option,
    ControlSource::Comment,
    ControlSource::Detected,
    ControlSource::Guessed,
    ControlSource::Neighbours,
    ControlSource::Default,
];

impl Entry {
    pub(in crate::check) fn new(asked: Asked, depends_on_neighbours: bool, verdict: &Verdict) -> Self {
        let Verdict {
            control,
            findings,
            omitted,
            lines,
            suppressed,
            out_of_fuel,
            failed_rules: _,
            assumptions,
        } = verdict;
        let mut texts = Writer::default();
        let source = SOURCES.iter().position(|source| *source == control.source).unwrap_or_default();
        Self {
            asked,
            depends_on_neighbours,
            control: (texts.put(&control.name), source as u8, texts.maybe(control.because.as_deref())),
            findings: findings.iter().map(|finding| texts.finding(finding)).collect(),
            omitted: omitted
                .iter()
                .map(|(rule, severity, count)| (texts.put(rule.id), number_of(*severity), *count as u64))
                .collect(),
            lines: *lines as u64,
            suppressed: *suppressed as u64,
            out_of_fuel: *out_of_fuel,
            assumptions: assumptions
                .iter()
                .map(|assumed| (texts.put(&assumed.text), texts.maybe(assumed.pin.as_deref())))
                .collect(),
            texts: texts.into_texts(),
        }
    }

    /// The verdict; none if a text or rule is not there, which only a mistake of ours can bring about.
    pub(in crate::check) fn verdict(&self) -> Option<Verdict> {
        let texts = Reader { texts: &self.texts, rules: HashMap::new() };
        texts.verdict(self)
    }

    pub(super) fn encode(&self) -> Option<Vec<u8>> {
        postcard::to_allocvec(self).ok()
    }

    pub(in crate::check) fn decode(payload: &[u8]) -> Option<Self> {
        postcard::from_bytes(payload).ok()
    }
}

/// Gives texts their places.
#[derive(Debug, Default)]
struct Writer<'t> {
    places: HashMap<&'t str, Text>,
}

impl<'t> Writer<'t> {
    fn put(&mut self, text: &'t str) -> Text {
        let next = self.places.len() as Text;
        *self.places.entry(text).or_insert(next)
    }

    fn maybe(&mut self, text: Option<&'t str>) -> Option<Text> {
        text.map(|text| self.put(text))
    }

    fn all(&mut self, texts: &'t [String]) -> Vec<Text> {
        texts.iter().map(|text| self.put(text)).collect()
    }

    fn finding(&mut self, finding: &'t Finding) -> StoredFinding {
        let Finding {
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
        } = finding;
        StoredFinding {
            rule: self.put(rule.id),
            severity: number_of(*severity),
            maybe: *certainty == Certainty::Maybe,
            message: self.put(message),
            range: range.clone(),
            label: self.put(label),
            labels: labels
                .iter()
                .map(|label| {
                    (self.maybe(label.file.as_deref()), label.range.clone(), self.put(&label.message))
                })
                .collect(),
            notes: self.all(notes),
            help: self.maybe(help.as_deref()),
            alarm: self.maybe(alarm.as_deref()),
            assumptions: self.all(assumptions),
            fixes: fixes
                .iter()
                .map(|fix| StoredFix {
                    title: self.put(&fix.title),
                    safe: fix.safe,
                    edits: fix.edits.iter().map(|edit| (edit.range.clone(), self.put(&edit.text))).collect(),
                })
                .collect(),
        }
    }

    fn into_texts(self) -> Vec<String> {
        let mut texts: Vec<(&str, Text)> = self.places.into_iter().collect();
        texts.sort_by_key(|(_, place)| *place);
        texts.into_iter().map(|(text, _)| text.to_owned()).collect()
    }
}

/// Finds texts at their places.
struct Reader<'t> {
    texts: &'t [String],
    /// Rules found so far: there are many to look through.
    rules: HashMap<Text, &'static RuleMeta>,
}

impl Reader<'_> {
    fn verdict(mut self, entry: &Entry) -> Option<Verdict> {
        let (name, source, because) = entry.control;
        Some(Verdict {
            control: ControlChoice {
                name: self.get(name)?,
                source: *SOURCES.get(usize::from(source))?,
                because: self.maybe(because)?,
            },
            findings: entry.findings.iter().map(|finding| self.finding(finding)).collect::<Option<_>>()?,
            omitted: entry
                .omitted
                .iter()
                .map(|(rule, severity, count)| {
                    Some((self.rule(*rule)?, severity_of(*severity)?, usize::try_from(*count).ok()?))
                })
                .collect::<Option<_>>()?,
            lines: usize::try_from(entry.lines).ok()?,
            suppressed: usize::try_from(entry.suppressed).ok()?,
            out_of_fuel: entry.out_of_fuel,
            failed_rules: Vec::new(),
            assumptions: entry
                .assumptions
                .iter()
                .map(|(text, pin)| Some(StatedAssumption { text: self.get(*text)?, pin: self.maybe(*pin)? }))
                .collect::<Option<_>>()?,
        })
    }

    fn get(&self, place: Text) -> Option<String> {
        self.texts.get(place as usize).cloned()
    }

    /// The outer option is for a place without a text.
    #[expect(
        clippy::option_option,
        reason = "a text that is missing is a mistake, one that is not there is none"
    )]
    fn maybe(&self, place: Option<Text>) -> Option<Option<String>> {
        match place {
            Some(place) => Some(Some(self.get(place)?)),
            None => Some(None),
        }
    }

    fn all(&self, places: &[Text]) -> Option<Vec<String>> {
        places.iter().map(|place| self.get(*place)).collect()
    }

    fn rule(&mut self, place: Text) -> Option<&'static RuleMeta> {
        if let Some(rule) = self.rules.get(&place) {
            return Some(rule);
        }
        let rule = gcheck_rules::RULES.by_id(self.texts.get(place as usize)?)?.meta;
        self.rules.insert(place, rule);
        Some(rule)
    }

    fn finding(&mut self, stored: &StoredFinding) -> Option<Finding> {
        Some(Finding {
            rule: self.rule(stored.rule)?,
            severity: severity_of(stored.severity)?,
            certainty: if stored.maybe { Certainty::Maybe } else { Certainty::Always },
            message: self.get(stored.message)?,
            range: stored.range.clone(),
            label: self.get(stored.label)?,
            labels: stored
                .labels
                .iter()
                .map(|(file, range, message)| {
                    let file = self.maybe(*file)?.map(Arc::from);
                    Some(Label { file, range: range.clone(), message: self.get(*message)? })
                })
                .collect::<Option<_>>()?,
            notes: self.all(&stored.notes)?,
            help: self.maybe(stored.help)?,
            alarm: self.maybe(stored.alarm)?,
            assumptions: self.all(&stored.assumptions)?,
            fixes: stored.fixes.iter().map(|fix| self.fix(fix)).collect::<Option<_>>()?,
        })
    }

    fn fix(&self, stored: &StoredFix) -> Option<Fix> {
        let edit =
            |(range, text): &(Range<u32>, Text)| Some(Edit { range: range.clone(), text: self.get(*text)? });
        Some(Fix {
            title: self.get(stored.title)?,
            safe: stored.safe,
            edits: stored.edits.iter().map(edit).collect::<Option<_>>()?,
        })
    }
}

fn number_of(severity: Severity) -> u8 {
    Severity::ALL.iter().position(|s| *s == severity).unwrap_or_default() as u8
}

fn severity_of(number: u8) -> Option<Severity> {
    Severity::ALL.get(usize::from(number)).copied()
}
