//! The commands other than `check`, one module each.
//!
//! Knows: nothing itself. Must not know: how a command works.

pub(crate) mod codes;
pub(crate) mod completions;
pub(crate) mod controls;
pub(crate) mod diff;
pub(crate) mod edit;
pub(crate) mod explain;
pub(crate) mod fmt;
pub(crate) mod init;
pub(crate) mod machine;
pub(crate) mod models;
pub(crate) mod plot;
pub(crate) mod rules;
pub(crate) mod run;
pub(crate) mod stats;

use std::path::Path;
use std::sync::Arc;

use gcheck_controls::Control;

use crate::Problem;
use crate::args::Global;
use crate::config::{Configs, validate_control};

/// The control that the option or the configuration of the current folder names.
fn chosen_control(global: &Global) -> Result<Option<Arc<Control>>, Problem> {
    let name = match &global.control {
        Some(name) => Some(name.clone()),
        None => {
            let here = Path::new(".");
            Configs::new(&global.config, global.isolated)?.of_folder(here)?.settings(here).control
        }
    };
    let Some(name) = name else { return Ok(None) };
    validate_control(&name).map_err(Problem::new)?;
    gcheck_controls::load(&name).map(Some).map_err(|error| Problem::new(error.to_string()))
}

/// Rows as columns, the last one as long as it is.
fn columns(rows: &[Vec<String>]) -> String {
    let mut widths: Vec<usize> = Vec::new();
    for row in rows {
        for (ix, cell) in row.iter().enumerate() {
            let width = cell.chars().count();
            match widths.get_mut(ix) {
                Some(widest) => *widest = width.max(*widest),
                None => widths.push(width),
            }
        }
    }
    let mut out = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            line.push_str(cell);
            line.push_str(&" ".repeat(width - cell.chars().count() + 2));
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

/// A list as JSON, for other programs.
fn json<T: serde::Serialize>(list: &T) -> Result<String, Problem> {
    serde_json::to_string_pretty(list)
        .map(|text| text + "\n")
        .map_err(|error| Problem::new(format!("cannot write JSON: {error}")))
}
