//! What `gcheck check` finds in the program, for the page.
//!
//! Knows: how one file is checked with what is in force for it. Must not know: pages.

use std::sync::Arc;

use gcheck_lint::{Environment, Execution, Job, check};
use gcheck_program::Dialect;
use gcheck_report::LineIndex;
use gcheck_toolpath::plot::Finding;

use crate::args::{Global, PlotOptions};
use crate::config::{Configs, RuleWishes, unknown_rule};
use crate::execution::Prepared;
use crate::programs::Reachable;
use crate::{Problem, in_force};

/// More findings are counted, not shown.
const MOST: usize = 1_000;

/// What was found.
#[derive(Debug, Default)]
pub(super) struct Found {
    shown: Vec<OneFound>,
    more: usize,
}

#[derive(Debug)]
struct OneFound {
    line: u32,
    severity: &'static str,
    rule: &'static str,
    message: String,
}

impl Found {
    /// The findings, all in the file of this name.
    pub(super) fn findings<'f>(&'f self, file: &'f str) -> impl Iterator<Item = Finding<'f>> {
        self.shown.iter().map(move |found| Finding {
            file,
            line: found.line,
            severity: found.severity,
            rule: found.rule,
            message: &found.message,
        })
    }

    /// That there are more.
    pub(super) fn note(&self) -> Option<String> {
        (self.more > 0)
            .then(|| format!("{} more findings are not shown; `gcheck check` lists them", self.more))
    }
}

/// Checks the program that is plotted, as `gcheck check` does.
pub(super) fn of(global: &Global, options: &PlotOptions, prepared: &Prepared) -> Result<Found, Problem> {
    let path = &prepared.path;
    let settings = Configs::new(&global.config, global.isolated)?.of_file(path)?.settings(path);
    let mut selection =
        settings.selection(&RuleWishes::default()).map_err(|unknown| Problem::new(unknown_rule(&unknown)))?;
    prepared.chosen.narrow(&mut selection);
    let dialect = Dialect::new(&prepared.control);
    let programs = Reachable::new(Arc::default(), path, &prepared.search);
    let machine = in_force::machine(&settings, &prepared.control, &options.execution.conditions.set)?;
    let outcome = check(&Job {
        source: &prepared.source,
        environment: Environment {
            dialect: &dialect,
            machine: &machine,
            programs: &programs,
            control_basis: prepared.chosen.basis(),
            unsupported: prepared.chosen.unsupported,
        },
        selection: &selection,
        suppressions: true,
        execution: Execution { fuel: options.execution.conditions.fuel, block_skip: None },
    });
    let text = prepared.source.text();
    let lines = LineIndex::new(text);
    let mut shown: Vec<OneFound> = outcome
        .findings
        .iter()
        .map(|finding| OneFound {
            line: lines.line(finding.range.start),
            severity: finding.severity.name(),
            rule: finding.rule.id,
            message: finding.message.clone(),
        })
        .collect();
    // The page goes through them from the top.
    shown.sort_by_key(|found| found.line);
    let more = shown.len().saturating_sub(MOST);
    shown.truncate(MOST);
    Ok(Found { shown, more })
}
