//! `--show-settings`: what is in force for each file.
//!
//! Knows: how settings read as text. Must not know: how they came about.

use std::fmt::Write as _;

use super::job::{Bench, Prepared, Target, prepare};
use crate::{Problem, paths};

/// The settings of each target; what cannot be read is added to `problems`.
pub(super) fn page(bench: &Bench<'_>, targets: &[Target], problems: &mut Vec<Problem>) -> String {
    let mut out = String::new();
    for target in targets {
        match prepare(bench, target) {
            // Writing to a string cannot fail.
            Ok(prepared) => {
                let _ = writeln!(out, "{}", of_file(target, &prepared));
            }
            Err(problem) => problems.push(problem),
        }
    }
    out
}

fn of_file(target: &Target, prepared: &Prepared) -> String {
    let Prepared { settings, choice, selection, .. } = prepared;
    let mut out = format!("{}\n", target.shown);
    let because = choice.because.as_ref().map(|b| format!(" ({b})")).unwrap_or_default();
    let source = format!("{:?}", choice.source).to_lowercase();
    let config = target.config.path().map_or_else(|| "none".to_owned(), paths::shown_from_here);
    let _ = writeln!(out, "  control: {}, by {source}{because}", choice.name);
    let _ = writeln!(out, "  configuration: {config}");
    if let Some(axes) = settings.machine.axes {
        let axes: Vec<String> = axes.iter().map(|a| a.to_string()).collect();
        let _ = writeln!(out, "  axes: {}", axes.join(" "));
    }
    for (number, value) in &settings.machine.settings {
        let _ = writeln!(out, "  setting {number}: {value}");
    }
    for code in &settings.codes {
        let _ = writeln!(out, "  code {}: {}", code.number, code.title);
    }
    for folder in &settings.search {
        let _ = writeln!(out, "  search: {}", paths::shown_from_here(folder));
    }
    let rules: Vec<String> = selection
        .rules()
        .map(|(rule, severity)| {
            severity.map_or_else(|| rule.meta.id.to_owned(), |s| format!("{}={s}", rule.meta.id))
        })
        .collect();
    let _ = writeln!(out, "  rules ({}): {}", rules.len(), rules.join(", "));
    out
}
