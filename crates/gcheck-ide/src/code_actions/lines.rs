//! Changes of whole lines: block skip on and off, sequence numbers in steps.
//!
//! Knows: which lines such changes leave alone. Must not know: what the lines do.

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_diagnostics::Edit;
use gcheck_format::{Numbering, renumber};
use gcheck_syntax::ast::Element;
use gcheck_syntax::{SyntaxKind, SyntaxToken};

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
    // Where each block begins, and its block delete.
    let mut blocks: Vec<(u32, Option<Range<u32>>)> = Vec::new();
    for line in first..=last {
        let start = snapshot.line_range(line).start;
        let tree = snapshot.tree_at(start).filter(|_| start < end);
        blocks.extend(tree.and_then(|tree| {
            let block = tree.block_at(start)?;
            let first = block.first().filter(may_be_skipped)?;
            let place = tree.place_of(&first);
            let mark = block.block_delete().map(|mark| tree.in_file(mark.range()));
            Some((place.start, mark.filter(|mark| mark.start == place.start)))
        }));
    }
    if blocks.is_empty() {
        return;
    }
    let all = blocks.iter().all(|(_, mark)| mark.is_some());
    let count = blocks.len();
    let plural = if count == 1 { "this block" } else { "these blocks" };
    let (title, offer, edits): (_, _, Vec<Edit>) = if all {
        // A level belongs to its slash.
        let marks = blocks.into_iter().filter_map(|(_, mark)| mark);
        let edits = marks.map(|range| Edit { range, text: String::new() });
        (format!("Remove block delete from {plural}"), Offer::RemoveBlockDelete, edits.collect())
    } else {
        let bare = blocks.iter().filter(|(_, mark)| mark.is_none());
        let edits = bare.map(|(at, _)| Edit { range: *at..*at, text: "/".to_owned() });
        (format!("Add block delete to {plural}"), Offer::AddBlockDelete, edits.collect())
    };
    actions.push(CodeAction::change(title, offer, edits));
}

/// Programs, tape marks and comments are not blocks to be skipped.
fn may_be_skipped(first: &SyntaxToken) -> bool {
    match Element::of(first.clone()) {
        Element::Comment(_) | Element::Label(_) => false,
        Element::Word(word) => word.letter() != Some('O'),
        _ => !matches!(first.kind(), SyntaxKind::PERCENT | SyntaxKind::SEMICOLON),
    }
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
