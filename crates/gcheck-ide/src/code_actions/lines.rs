//! Changes of whole lines: block skip on and off, sequence numbers in steps.
//!
//! Knows: which lines such changes leave alone. Must not know: what the lines do.

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_diagnostics::Edit;
use gcheck_format::{Numbering, renumber};

use super::action::{CodeAction, Offer};
use crate::symbols::code_end;

/// Lines that are changed together.
const MOST_LINES: u32 = 100_000;
/// Numbers in tens leave room for blocks that come later.
const NUMBERING: Numbering = Numbering { start: 10, step: 10 };

/// Offers to put `/` in front of the blocks of a range, or to take it away where all have it.
pub(super) fn offer_block_skip(snapshot: &Snapshot, range: &Range<u32>, actions: &mut Vec<CodeAction>) {
    let first = snapshot.line_at(range.start);
    let mut last = snapshot.line_at(range.end);
    if last > first && snapshot.line_range(last).start == range.end {
        last -= 1;
    }
    if last - first > MOST_LINES {
        return;
    }
    let end = code_end(snapshot);
    let mut lines: Vec<(u32, bool)> = Vec::new();
    for line in first..=last {
        let range = snapshot.line_range(line);
        let text = snapshot.slice(range.clone());
        let trimmed = text.trim_start_matches([' ', '\t', '\u{FEFF}']);
        // Programs, tape marks and comments are not blocks to be skipped.
        if range.start >= end
            || trimmed.trim().is_empty()
            || trimmed.starts_with(['%', '(', ';', 'O', 'o', ':'])
        {
            continue;
        }
        lines.push((range.start + (text.len() - trimmed.len()) as u32, trimmed.starts_with('/')));
    }
    if lines.is_empty() {
        return;
    }
    let all = lines.iter().all(|(_, is_skipped)| *is_skipped);
    let count = lines.len();
    let plural = if count == 1 { "this block" } else { "these blocks" };
    let (title, offer, edits): (_, _, Vec<Edit>) = if all {
        let edits = lines.iter().map(|(at, _)| {
            // A level belongs to its slash.
            let behind = snapshot.slice(at + 1..at + 2);
            let len = if behind.starts_with(|c: char| c.is_ascii_digit()) { 2 } else { 1 };
            Edit { range: *at..at + len, text: String::new() }
        });
        (format!("Remove block delete from {plural}"), Offer::RemoveBlockDelete, edits.collect())
    } else {
        let bare = lines.iter().filter(|(_, is_skipped)| !is_skipped);
        let edits = bare.map(|(at, _)| Edit { range: *at..*at, text: "/".to_owned() });
        (format!("Add block delete to {plural}"), Offer::AddBlockDelete, edits.collect())
    };
    actions.push(CodeAction::change(title, offer, edits));
}

/// Offers to renumber the blocks, with all that names them.
pub(super) fn offer_renumber(snapshot: &Snapshot, actions: &mut Vec<CodeAction>) {
    if snapshot.file_index().labels.is_empty() {
        return;
    }
    // The reason of a refusal is for people who ask for the action, not for those who look at the list.
    if let Ok(edits) = renumber(&snapshot.text(), &snapshot.dialect(), &NUMBERING)
        && !edits.is_empty()
    {
        let title = "Renumber blocks in tens, with the jumps to them";
        actions.push(CodeAction::change(title, Offer::Renumber, edits));
    }
}
