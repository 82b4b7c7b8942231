//! `gcheck controls`: the controls that can be chosen.
//!
//! Knows: what a list of controls shows. Must not know: any control.

use gcheck_controls::Machine;
use serde::Serialize;

use super::{columns, json};
use crate::args::{ListFormat, ListOptions};
use crate::{Problem, output};

/// A control in JSON.
#[derive(Debug, Serialize)]
struct Row {
    name: String,
    title: String,
    machine: &'static str,
    codes: usize,
    fallback: bool,
}

/// Prints the list.
pub(crate) fn run(options: &ListOptions) -> Result<u8, Problem> {
    let mut rows = Vec::new();
    for name in gcheck_controls::names() {
        let control = gcheck_controls::load(name).map_err(|error| Problem::new(error.to_string()))?;
        rows.push(Row {
            name: control.name().to_owned(),
            title: control.title().to_owned(),
            machine: match control.machine() {
                Machine::Mill => "mill",
                Machine::Lathe => "lathe",
            },
            codes: control.codes().count(),
            fallback: *name == gcheck_controls::fallback(),
        });
    }
    match options.output_format {
        ListFormat::Json => output::print(&json(&rows)?),
        ListFormat::Text => {
            let row = |r: &Row| vec![r.name.clone(), format!("{} codes", r.codes), r.title.clone()];
            output::print(&columns(&rows.iter().map(row).collect::<Vec<_>>()))
        }
    }
}
