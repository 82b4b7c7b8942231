//! A refused change as a message at its place.
//!
//! Knows: how a message is laid out. Must not know: why a change is refused.

use std::path::Path;

use gcheck_edit::{Change, Refusal};

use crate::execution::Prepared;
use crate::{Problem, reading};

/// A refusal at its place.
pub(super) fn problem(prepared: &Prepared, change: &Change, refusal: &Refusal) -> Problem {
    let message = format!("cannot {}: {refusal}", change.verb());
    let range = refusal.range.start as usize..refusal.range.end as usize;
    let problem = match &refusal.file {
        Some(name) => match reading::file(Path::new(name)) {
            Ok(source) => Problem::at(name, source.text(), &range, message),
            Err(_) => Problem::with_file(Path::new(name), message),
        },
        None if range.is_empty() => Problem::with_file(&prepared.path, message),
        None => Problem::at(&prepared.shown, prepared.source.text(), &range, message),
    };
    match &refusal.help {
        Some(help) => problem.help(help.clone()),
        None => problem,
    }
}
