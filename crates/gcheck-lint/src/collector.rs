//! What is kept of the findings of a file.
//!
//! Knows: how many are kept, how severe one may be where the control is not known or the text is never executed. Must not know: any
//! rule, in which order rules run.

use gcheck_controls::Control;
use gcheck_diagnostics::{Finding, RuleMeta, Severity, Tier};
use gcheck_program::FileIndex;

use crate::block_delete::Positions;
use crate::{ControlBasis, Environment};

/// Findings of one file that are kept; the rest are counted by rule.
pub const MAX_FINDINGS: usize = 10_000;

/// Findings that were counted and not kept, by rule and severity; and rules that panicked.
#[derive(Debug, Clone, Default)]
pub struct Omitted {
    counts: Vec<(&'static RuleMeta, Severity, usize)>,
    failed: Vec<&'static RuleMeta>,
}

impl Omitted {
    /// Notes rules that panicked.
    pub(crate) fn fail(&mut self, rules: &[&'static RuleMeta]) {
        for rule in rules {
            if !self.failed.contains(rule) {
                self.failed.push(rule);
            }
        }
    }

    /// Rules that panicked.
    pub(crate) fn failed(&self) -> &[&'static RuleMeta] {
        &self.failed
    }

    pub(crate) fn add(&mut self, rule: &'static RuleMeta, severity: Severity, more: usize) {
        let same = |(other, of, _): &&mut (&'static RuleMeta, Severity, usize)| {
            std::ptr::eq(*other, rule) && *of == severity
        };
        match self.counts.iter_mut().find(same) {
            Some((_, _, count)) => *count += more,
            None => self.counts.push((rule, severity, more)),
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (&'static RuleMeta, Severity, usize)> {
        self.counts.iter().copied()
    }
}

/// Keeps findings up to the limit.
pub(crate) struct Collector<'c> {
    control: &'c Control,
    /// Nobody chose the control, and nothing in the program speaks for it: it may be the wrong one.
    is_unknown: bool,
    /// The program may be for another control.
    is_guessed: bool,
    findings: Vec<Finding>,
    omitted: Omitted,
}

impl<'c> Collector<'c> {
    pub(crate) fn new(environment: Environment<'c>) -> Self {
        let control = environment.control();
        Self {
            control,
            is_unknown: environment.control_is_unknown(),
            is_guessed: environment.control_basis == ControlBasis::Guessed,
            findings: Vec::new(),
            omitted: Omitted::default(),
        }
    }

    /// What is kept and counted so far.
    pub(crate) fn mark(&self) -> (usize, Omitted) {
        (self.findings.len(), self.omitted.clone())
    }

    /// Forgets what was added since the mark.
    pub(crate) fn rewind(&mut self, (kept, omitted): &(usize, Omitted)) {
        self.findings.truncate(*kept);
        self.omitted.clone_from(omitted);
    }

    pub(crate) fn into_parts(self) -> (Vec<Finding>, Omitted) {
        (self.findings, self.omitted)
    }

    pub(crate) fn add(&mut self, severity: Option<Severity>, finding: Finding) {
        let most = if self.is_unknown && finding.rule.control_specific {
            Severity::Info
        } else if self.is_guessed {
            Severity::Warning
        } else {
            Severity::Error
        };
        let mut finding = finding.at_most(most);
        // Only what is certainly a mistake predicts an alarm.
        if finding.severity != Severity::Error {
            finding.alarm = None;
        } else if finding.alarm.is_none() {
            finding.alarm = self
                .control
                .alarm(finding.rule.id)
                .map(|a| a.number.clone().unwrap_or_else(|| a.text.clone()));
        }
        if let Some(severity) = severity {
            finding.severity = severity;
        }
        self.keep(finding);
    }

    /// Adds a finding that has its severity and alarm.
    pub(crate) fn keep(&mut self, finding: Finding) {
        if self.is_full() {
            self.omit(finding.rule, finding.severity, 1);
        } else {
            self.findings.push(finding);
        }
    }

    /// Are further findings only counted?
    pub(crate) fn is_full(&self) -> bool {
        self.findings.len() >= MAX_FINDINGS
    }

    pub(crate) fn omit(&mut self, rule: &'static RuleMeta, severity: Severity, count: usize) {
        self.omitted.add(rule, severity, count);
    }

    /// Notes rules that panicked in a part of the file.
    pub(crate) fn fail(&mut self, rules: &[&'static RuleMeta]) {
        self.omitted.fail(rules);
    }

    /// Names the condition of findings that hold with one position of block delete only.
    pub(crate) fn name_positions(&mut self, positions: &Positions) {
        for finding in &mut self.findings {
            positions.name(finding);
        }
    }

    /// Changes the first finding of a kind.
    pub(crate) fn change(
        &mut self,
        is_it: impl Fn(&Finding) -> bool,
        change: impl FnOnce(Finding) -> Finding,
    ) {
        if let Some(finding) = self.findings.iter_mut().find(|finding| is_it(finding)) {
            *finding = change(finding.clone());
        }
    }

    /// Leaves findings out; how many.
    pub(crate) fn leave_out(&mut self, mut is_out: impl FnMut(&Finding) -> bool) -> usize {
        let before = self.findings.len();
        self.findings.retain(|finding| !is_out(finding));
        before - self.findings.len()
    }

    /// Leaves out what rules found that panicked elsewhere; these rules.
    pub(crate) fn leave_out_failed(&mut self) -> Vec<&'static RuleMeta> {
        let failed = std::mem::take(&mut self.omitted.failed);
        if !failed.is_empty() {
            self.leave_out(|finding| failed.contains(&finding.rule));
            self.omitted.counts.retain(|(rule, ..)| !failed.contains(rule));
        }
        failed
    }

    /// Lines of data are rows of a table, of which only the form is looked at.
    pub(crate) fn leave_data(&mut self, file_index: &FileIndex) {
        if file_index.has_data() {
            let is_of_rows = |finding: &Finding| {
                finding.rule.tier != Tier::Token && file_index.is_data(finding.range.start)
            };
            self.leave_out(is_of_rows);
        }
    }

    /// In text that no run reads, what is wrong with a block is an info, and nothing is an error, unless the user configured
    /// the rule's severity.
    pub(crate) fn soften(&mut self, is_overridden: impl Fn(&'static RuleMeta) -> bool, unread_from: u32) {
        for finding in &mut self.findings {
            let is_of_block = matches!(finding.rule.tier, Tier::Token | Tier::Block);
            let most = if is_of_block { Severity::Info } else { Severity::Warning };
            if finding.range.start < unread_from || finding.severity <= most || is_overridden(finding.rule) {
                continue;
            }
            finding.severity = most;
            finding.alarm = None;
            finding.notes.push("it is after the end of the program, and is never executed".to_owned());
        }
    }
}
