//! Comments that silence a finding.
//!
//! Knows: where such a comment may be. Must not know: how comments silence (the rules do).

use gcheck_db::Snapshot;
use gcheck_diagnostics::{Edit, Finding};
use gcheck_syntax::ast::Block;

use super::action::{CodeAction, Offer};

/// Stands for the reason, which only a person can give.
const REASON: &str = "say why";

/// A comment for the line of a finding, and one for the file.
pub(super) fn of(snapshot: &Snapshot, finding: &Finding) -> Vec<CodeAction> {
    let rule = finding.rule.id;
    let mut actions = Vec::new();
    let line = snapshot.line_at(finding.range.start);
    if let Some(edit) = on_line(snapshot, line, &format!("(gcheck: ignore {rule} - {REASON})")) {
        let title = format!("Ignore `{rule}` on this line");
        actions.push(CodeAction::change(title, Offer::IgnoreLine, vec![edit]));
    }
    let at = head(snapshot);
    let edit = Edit {
        range: at..at,
        text: format!("(gcheck: ignore-file {rule} - {REASON}){}", line_end(snapshot)),
    };
    let title = format!("Ignore `{rule}` in this file");
    actions.push(CodeAction::change(title, Offer::IgnoreFile, vec![edit]));
    actions
}

/// After the line, or on a line of its own above it if the line can have no more text.
fn on_line(snapshot: &Snapshot, line: u32, comment: &str) -> Option<Edit> {
    let range = snapshot.line_range(line);
    let text = snapshot.slice(range.clone());
    let tree = snapshot.tree_at(range.start);
    let blocks: Vec<Block> = tree.iter().flat_map(|tree| tree.blocks(range.clone())).collect();
    // What is at a mark of the tape is not a block, and above it the tape may not have begun.
    if blocks.first().is_some_and(Block::is_tape_mark) {
        return None;
    }
    let is_open = blocks.iter().flat_map(Block::comments).any(|comment| !comment.is_closed());
    let length = text.chars().count() + comment.len() + 1;
    let is_long = snapshot.control().limits().line_length.is_some_and(|most| length > most as usize);
    if is_open || is_long {
        let text = format!("{comment}{}", line_end(snapshot));
        return Some(Edit { range: range.start..range.start, text });
    }
    let end = range.start + text.trim_end().len() as u32;
    Some(Edit { range: end..range.end, text: format!(" {comment}") })
}

/// Where the first line after the tape mark and the program's number begins.
fn head(snapshot: &Snapshot) -> u32 {
    let behind = |offset: u32| {
        let line = snapshot.line_at(offset) + 1;
        if line < snapshot.line_count() { snapshot.line_range(line).start } else { 0 }
    };
    let file_index = snapshot.file_index();
    let first = file_index.first_block.as_ref().map_or(u32::MAX, |first| first.start);
    let number = file_index.programs.first().filter(|program| program.range.start <= first);
    let mark = file_index.tape_marks.first().filter(|mark| mark.start < first);
    match (number, mark) {
        (Some(number), _) => behind(number.range.start),
        (None, Some(mark)) => behind(mark.start),
        (None, None) => 0,
    }
}

/// The end of a line as the file has it.
pub(super) fn line_end(snapshot: &Snapshot) -> &'static str {
    let first = snapshot.line_range(0).end;
    match &*snapshot.slice(first..first + 2) {
        "\r\n" => "\r\n",
        ending if ending.starts_with('\r') => "\r",
        _ => "\n",
    }
}
