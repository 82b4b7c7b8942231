//! What is reported about a variation.
//!
//! Knows: how a program is checked. Must not know: what the data ask.

use std::collections::{BTreeMap, BTreeSet};

use gcheck_controls::Control;
use gcheck_diagnostics::Severity;
use gcheck_lint::{Environment, Execution, Job, MachineFacts, NoPrograms, Outcome, Selection, check};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

use crate::case::{Asked, Case};

/// How often each rule reports something.
pub(crate) type Findings = BTreeMap<&'static str, usize>;

/// What came of a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Answer {
    /// These rules report it.
    Reported(Vec<&'static str>),
    /// It is correct, and nothing is reported.
    Allowed(&'static str),
    /// Something is to be reported, and nothing is.
    Silent,
    /// It is correct, and these rules report something.
    False(Vec<&'static str>),
}

pub(crate) struct Judge<'c> {
    dialect: Dialect<'c>,
    selection: Selection,
    machine: MachineFacts,
}

impl<'c> Judge<'c> {
    pub(crate) fn new(control: &'c Control) -> Self {
        Self {
            dialect: Dialect::new(control),
            selection: Selection::recommended(RULES),
            machine: MachineFacts::default(),
        }
    }

    pub(crate) fn findings(&self, program: &str) -> Findings {
        let mut findings = Findings::new();
        for finding in self.check(program).findings.iter().filter(|f| f.severity >= Severity::Info) {
            *findings.entry(finding.rule.id).or_default() += 1;
        }
        findings
    }

    /// The lines that findings are on, from 0; `None` where findings are left out.
    pub(crate) fn lines(&self, program: &str) -> Option<BTreeSet<usize>> {
        let line = |at: u32| program.bytes().take(at as usize).filter(|byte| *byte == b'\n').count();
        let outcome = self.check(program);
        let all = outcome.findings.iter().flat_map(|f| line(f.range.start)..=line(f.range.end)).collect();
        outcome.omitted.is_empty().then_some(all)
    }

    fn check(&self, program: &str) -> Outcome {
        let environment = Environment {
            dialect: &self.dialect,
            machine: &self.machine,
            programs: &NoPrograms,
            control_is_guessed: false,
            unsupported: None,
        };
        let source = SourceText::from(program);
        check(&Job {
            source: &source,
            environment,
            selection: &self.selection,
            suppressions: false,
            execution: Execution::default(),
        })
    }

    pub(crate) fn answer(&self, base: &Findings, case: &Case) -> Answer {
        if let Asked::Allowed(reason) = case.asked {
            return Answer::Allowed(reason);
        }
        let found = self.findings(&case.program);
        let is_new = |(rule, count): (&&'static str, &usize)| {
            (base.get(*rule).is_none_or(|before| before < count)).then_some(*rule)
        };
        let new: Vec<&'static str> = found.iter().filter_map(is_new).collect();
        match (case.asked == Asked::Finding, new.is_empty()) {
            (true, true) => Answer::Silent,
            (true, false) => Answer::Reported(new),
            (false, true) => Answer::Allowed("the same as written"),
            (false, false) => Answer::False(new),
        }
    }
}
