//! What is reported about a variation.
//!
//! Knows: how a program is checked. Must not know: what the data ask.

use std::collections::{BTreeMap, BTreeSet};

use gcheck_controls::Control;
use gcheck_diagnostics::Severity;
use gcheck_lint::{
    ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Outcome, Selection, check,
};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

use crate::case::{Asked, Case};

/// How often each rule reports something.
type Counts = BTreeMap<&'static str, usize>;

/// What is reported about a program.
#[derive(Default)]
pub(crate) struct Findings {
    all: Counts,
    /// In the blocks that a case changes.
    here: Counts,
}

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

    /// What is reported about a program whose blocks from a line on, up to its end, are those of a case.
    pub(crate) fn findings(&self, program: &str, first_line: usize) -> Findings {
        let mut findings = Findings::default();
        let start: usize = program.split_inclusive('\n').take(first_line).map(str::len).sum();
        let end = program.rfind("M30").unwrap_or(program.len());
        for finding in self.check(program).findings.iter().filter(|f| f.severity >= Severity::Info) {
            *findings.all.entry(finding.rule.id).or_default() += 1;
            let range = finding.range.start as usize..finding.range.end as usize;
            if range.start < end && range.end >= start {
                *findings.here.entry(finding.rule.id).or_default() += 1;
            }
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
            control_basis: ControlBasis::Chosen,
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

    pub(crate) fn answer(&self, base: &Findings, case: &Case, first_line: usize) -> Answer {
        if let Asked::Allowed(reason) = case.asked {
            return Answer::Allowed(reason);
        }
        let found = self.findings(&case.program, first_line);
        let is_asked = case.asked == Asked::Finding;
        // What is asked for has to be told where the mistake is; what is false is so anywhere.
        let (base, found) = if is_asked { (&base.here, &found.here) } else { (&base.all, &found.all) };
        let is_new = |(rule, count): (&&'static str, &usize)| {
            (base.get(*rule).is_none_or(|before| before < count)).then_some(*rule)
        };
        let new: Vec<&'static str> = found.iter().filter_map(is_new).collect();
        match (is_asked, new.is_empty()) {
            (true, true) => Answer::Silent,
            (true, false) => Answer::Reported(new),
            (false, true) => Answer::Allowed("the same as written"),
            (false, false) => Answer::False(new),
        }
    }
}
