//! A program on disk in the place of another: written, or shown as a difference.
//!
//! Knows: files on disk, unified differences. Must not know: why a program is changed.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use similar::algorithms::{Capture, Compact, Replace, myers};
use similar::udiff::UnifiedHunkHeader;
use similar::{ChangeTag, DiffOp, DiffableStr, group_diff_ops};

use crate::problem::io_reason;
use crate::{Problem, output};

/// Replaces a program on disk: whole or not at all, and only if it still is what was read. `verb` is what is done to it, as
/// in "cannot fix".
pub(crate) fn write(path: &Path, verb: &str, before: &[u8], after: &[u8]) -> Result<(), Problem> {
    let problem =
        |error: &std::io::Error| Problem::with_file(path, format!("cannot {verb}: {}", io_reason(error)));
    let permissions = fs::metadata(path).map_err(|error| problem(&error))?.permissions();
    if permissions.readonly() {
        return Err(Problem::with_file(path, format!("cannot {verb}: the file is read-only")));
    }
    output::replace(path, before, after)
}

/// Lines around a change that are shown.
const CONTEXT: usize = 3;

/// The change as a unified difference. Bytes that are not UTF-8 are shown as such.
pub(crate) fn difference(shown: &str, before: &[u8], after: &[u8]) -> String {
    let (before, after) = (String::from_utf8_lossy(before), String::from_utf8_lossy(after));
    let lines = [before.tokenize_lines(), after.tokenize_lines()];
    let mut out = String::new();
    for hunk in group_diff_ops(operations(&lines), CONTEXT) {
        if out.is_empty() {
            out = format!("--- a/{shown}\n+++ b/{shown}\n");
        }
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{}", UnifiedHunkHeader::new(&hunk));
        for operation in &hunk {
            show(operation, &lines, &mut out);
        }
    }
    out
}

/// What becomes of the lines. By one algorithm and of numbers, as each further algorithm and type is a large part of the
/// program.
fn operations(lines: &[Vec<&str>; 2]) -> Vec<DiffOp> {
    let mut numbers = HashMap::new();
    let [old, new] = [0, 1].map(|side: usize| {
        let lines = lines.get(side).into_iter().flatten();
        let number = |line| {
            let next = numbers.len() as u32;
            *numbers.entry(line).or_insert(next)
        };
        lines.map(number).collect::<Vec<u32>>()
    });
    let mut hook = Compact::new(Replace::new(Capture::new()), &*old, &*new);
    // What is captured cannot fail.
    let _ = myers::diff(&mut hook, &*old, 0..old.len(), &*new, 0..new.len());
    hook.into_inner().into_inner().into_ops()
}

/// Writes lines with a sign in front.
fn show(operation: &DiffOp, [old, new]: &[Vec<&str>; 2], out: &mut String) {
    let mut write = |sign: ChangeTag, lines: Option<&[&str]>| {
        for line in lines.unwrap_or_default() {
            let _ = write!(out, "{sign}{line}");
            if !line.ends_with(['\n', '\r']) {
                *out += "\n\\ No newline at end of file\n";
            }
        }
    };
    let (of_old, of_new) = (old.get(operation.old_range()), new.get(operation.new_range()));
    match operation {
        DiffOp::Equal { .. } => write(ChangeTag::Equal, of_old),
        DiffOp::Delete { .. } | DiffOp::Insert { .. } | DiffOp::Replace { .. } => {
            write(ChangeTag::Delete, of_old);
            write(ChangeTag::Insert, of_new);
        }
    }
}
