//! `gcheck codes`: the codes of a control.
//!
//! Knows: what a list of codes shows. Must not know: any control.

use gcheck_controls::Confidence;
use serde::Serialize;

use super::{chosen_control, columns, json};
use crate::args::{Global, ListFormat, ListOptions};
use crate::{Problem, output};

/// A code in JSON.
#[derive(Debug, Serialize)]
struct Row<'c> {
    code: &'c str,
    title: &'c str,
    group: &'c str,
    summary: &'c str,
    confidence: &'static str,
    source: &'c str,
}

/// Prints the list.
pub(crate) fn run(global: &Global, options: &ListOptions) -> Result<u8, Problem> {
    let control = match chosen_control(global)? {
        Some(control) => control,
        None => gcheck_controls::load(gcheck_controls::fallback())
            .map_err(|error| Problem::new(error.to_string()))?,
    };
    let rows: Vec<Row<'_>> = control
        .codes()
        .map(|code| {
            let entry = code.entry();
            Row {
                code: &entry.code,
                title: &entry.title,
                group: &code.group().id,
                summary: &entry.summary,
                confidence: confidence(entry.confidence),
                source: &entry.source,
            }
        })
        .collect();
    match options.output_format {
        ListFormat::Json => output::print(&json(&rows)?),
        ListFormat::Text => {
            let row = |r: &Row<'_>| vec![r.code.to_owned(), r.group.to_owned(), r.title.to_owned()];
            let list = columns(&rows.iter().map(row).collect::<Vec<_>>());
            output::print(&format!("{}: {}\n\n{list}", control.name(), control.title()))
        }
    }
}

/// How well a fact is founded, as data files word it.
fn confidence(confidence: Confidence) -> &'static str {
    match confidence {
        Confidence::Manual => "manual",
        Confidence::Observed => "observed",
        Confidence::Assumed => "assumed",
    }
}
