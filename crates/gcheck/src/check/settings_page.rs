//! `--show-settings`: what is in force for each file.
//!
//! Knows: how settings read as text. Must not know: how they came about.

use std::fmt::Write as _;

use gcheck_diagnostics::Severity;
use gcheck_engine::{Axis, Machine, Model};
use gcheck_geometry::{MmPerMin, Rpm};
use gcheck_lint::{RuleEntry, Selection};

use super::job::{Bench, Prepared, Target, prepare};
use crate::execution::{Equipment, Start};
use crate::{Problem, paths};

/// The settings of each target; what cannot be read is added to `problems`.
pub(super) fn page(bench: &Bench<'_>, targets: &[Target], problems: &mut Vec<Problem>) -> String {
    let mut out = String::new();
    for target in targets {
        match prepare(bench, target) {
            // Writing to a string cannot fail.
            Ok(prepared) => match machine(bench, &prepared) {
                Ok(machine) => {
                    let _ = writeln!(out, "{}", of_file(target, &prepared, &machine));
                }
                Err(problem) => problems.push(problem),
            },
            Err(problem) => problems.push(problem),
        }
    }
    out
}

/// The machine as the program would find it.
fn machine(bench: &Bench<'_>, prepared: &Prepared) -> Result<Machine, Problem> {
    let control = bench.controls.get(&prepared.chosen.choice.name, &prepared.settings.codes)?;
    Ok(Equipment::new(&prepared.settings, &Model::new(&control), Start::Any)?.machine)
}

fn of_file(target: &Target, prepared: &Prepared, machine: &Machine) -> String {
    let Prepared { settings, chosen, selection, .. } = prepared;
    let choice = &chosen.choice;
    let mut out = format!("{}\n", target.shown);
    let because = choice.because.as_ref().map(|b| format!(" ({b})")).unwrap_or_default();
    let source = format!("{:?}", choice.source).to_lowercase();
    let config = target.config.path().map_or_else(|| "none".to_owned(), paths::shown_from_here);
    let _ = writeln!(out, "  control: {}, by {source}{because}", choice.name);
    let _ = writeln!(out, "  configuration: {config}");
    let preset = settings.execution.iter().rev().find_map(|facts| facts.machine.preset.as_ref());
    if let Some(preset) = preset {
        let _ = writeln!(out, "  preset: {}", preset.value.0);
    }
    if let Some(axes) = settings.machine.axes {
        let axes: Vec<String> = axes.iter().map(|a| a.to_string()).collect();
        let _ = writeln!(out, "  axes: {}", axes.join(" "));
    }
    for (axis, (low, high)) in &machine.travel {
        let unit = if axis.is_rotary() { "degrees" } else { "mm" };
        let _ = writeln!(out, "  travel {}: {low} to {high} {unit}", axis.letter());
    }
    if let Some(Rpm(most)) = machine.max_rpm {
        let _ = writeln!(out, "  speed: at most {most} rpm");
    }
    if let Some(MmPerMin(most)) = machine.max_feed {
        let _ = writeln!(out, "  feed: at most {most} mm/min");
    }
    rates(&mut out, machine);
    for (what, count) in [("work offsets", machine.offsets.len()), ("tools", machine.tools.len())] {
        if count > 0 {
            let _ = writeln!(out, "  {what} known: {count}");
        }
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
    let _ = writeln!(out, "  {}", rules(selection));
    out
}

/// Rules are listed by name up to so many; of more only what differs from the recommended ones is.
const MOST_LISTED: usize = 12;

/// Which rules run.
fn rules(selection: &Selection) -> String {
    let shown = |(rule, severity): (&RuleEntry, Option<Severity>)| {
        severity.map_or_else(|| rule.meta.id.to_owned(), |s| format!("{}={s}", rule.meta.id))
    };
    let count = selection.rules().count();
    if count <= MOST_LISTED {
        return format!("rules ({count}): {}", selection.rules().map(shown).collect::<Vec<_>>().join(", "));
    }
    let is_on = |rule: &RuleEntry| selection.rules().any(|(on, _)| on.meta == rule.meta);
    let mut text = format!("rules ({count}): the recommended ones");
    let mut add = |what: &str, names: Vec<String>| {
        if names.is_empty() {
            return;
        }
        let more = names.len().saturating_sub(MOST_LISTED);
        let list = names.into_iter().take(MOST_LISTED).collect::<Vec<_>>().join(", ");
        let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
        let _ = write!(text, "; {what} {list}{rest}");
    };
    let changed =
        |(rule, severity): &(&RuleEntry, Option<Severity>)| rule.meta.recommended && severity.is_some();
    add("and", selection.rules().filter(|(rule, _)| !rule.meta.recommended).map(shown).collect());
    add("with another severity", selection.rules().filter(changed).map(shown).collect());
    let left_out = selection.table().iter().filter(|rule| rule.meta.recommended && !is_on(rule));
    add("without", left_out.map(|rule| rule.meta.id.to_owned()).collect());
    text
}

/// Rapid rates and accelerations, as far as they are known.
fn rates(out: &mut String, machine: &Machine) {
    let by_axis = |figures: &std::collections::BTreeMap<Axis, f64>, unit: &str| {
        let words = |(axis, figure): (&Axis, &f64)| {
            let length = if axis.is_rotary() { "deg" } else { "mm" };
            format!("{} {figure} {length}/{unit}", axis.letter())
        };
        figures.iter().map(words).collect::<Vec<_>>().join(", ")
    };
    let dynamics = &machine.dynamics;
    // Writing to a string cannot fail.
    if !dynamics.rapid.is_empty() {
        let _ = writeln!(out, "  rapid: {}", by_axis(&dynamics.rapid, "min"));
    } else if let Some(MmPerMin(rate)) = machine.rapid {
        let _ = writeln!(out, "  rapid: {rate} mm/min");
    }
    if !dynamics.acceleration.is_empty() {
        let _ = writeln!(out, "  acceleration: {}", by_axis(&dynamics.acceleration, "s²"));
    }
}
