//! `gcheck rules`: the list of rules.
//!
//! Knows: what a list of rules shows. Must not know: any rule.

use gcheck_diagnostics::RuleSet;
use serde::Serialize;

use super::{columns, json};
use crate::args::{ListFormat, ListOptions};
use crate::{Problem, output};

/// A rule in JSON.
#[derive(Debug, Serialize)]
struct Row {
    id: &'static str,
    group: &'static str,
    summary: &'static str,
    severity: &'static str,
    recommended: bool,
    sets: Vec<&'static str>,
    mends: Option<&'static str>,
    tier: &'static str,
    since: &'static str,
    aliases: &'static [&'static str],
}

/// Prints the list.
pub(crate) fn run(options: &ListOptions) -> Result<u8, Problem> {
    let row = |rule: &gcheck_lint::RuleEntry| {
        let meta = rule.meta;
        Row {
            id: meta.id,
            group: meta.group,
            summary: meta.summary,
            severity: meta.severity.name(),
            recommended: meta.recommended,
            sets: meta.sets(),
            mends: Some(meta.fixability.option()).filter(|option| !option.is_empty()),
            tier: meta.tier.name(),
            since: meta.since,
            aliases: meta.aliases,
        }
    };
    let rows: Vec<Row> = gcheck_rules::RULES.iter().map(row).collect();
    match options.output_format {
        ListFormat::Json => output::print(&json(&rows)?),
        ListFormat::Text => {
            let row = |r: &Row| {
                let severity =
                    if r.recommended { r.severity.to_owned() } else { format!("({})", r.severity) };
                // The strict set holds the recommended one: of a rule in both, one says all.
                let sets = r.sets.iter().filter(|set| !(r.recommended && **set == RuleSet::Strict.name()));
                let sets = sets.copied().collect::<Vec<_>>().join(" ");
                vec![r.id.to_owned(), r.group.to_owned(), severity, sets, r.summary.to_owned()]
            };
            output::print(&columns(&rows.iter().map(row).collect::<Vec<_>>()))
        }
    }
}
