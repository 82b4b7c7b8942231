//! Fixes of findings, alone and together; silencing and explaining them.
//!
//! Knows: which findings lie at a place, which fixes may be made together. Must not know: how a fix comes about.

use std::ops::Range;

use gcheck_db::{Analysis, Snapshot};
use gcheck_diagnostics::{Edit, Finding, Fix};

use super::action::{CodeAction, Offer};
use super::suppress;

/// Findings that are answered at one place.
const MOST_FINDINGS: usize = 20;

/// Offers what answers the findings in a range.
pub(super) fn offer(
    snapshot: &Snapshot,
    analysis: &Analysis,
    range: &Range<u32>,
    actions: &mut Vec<CodeAction>,
) {
    let touches = |finding: &&Finding| finding.range.start <= range.end && range.start <= finding.range.end;
    let here: Vec<&Finding> = analysis.findings.iter().filter(touches).take(MOST_FINDINGS).collect();
    let answer = |finding: &Finding, action: CodeAction| CodeAction {
        rule: Some(finding.rule.id),
        finding: Some(finding.range.clone()),
        ..action
    };
    let mut told: Vec<&str> = Vec::new();
    for finding in &here {
        for (index, fix) in finding.fixes.iter().enumerate() {
            let mut action = CodeAction::change(
                format!("{}{}", capitalised(&fix.title), note(fix.safe)),
                Offer::Fix,
                fix.edits.clone(),
            );
            action.is_preferred = index == 0 && fix.safe;
            actions.push(answer(finding, action));
        }
        if told.contains(&finding.rule.id) {
            continue;
        }
        told.push(finding.rule.id);
        let of_rule = || {
            let of_rule = analysis.findings.iter().filter(|other| other.rule.id == finding.rule.id);
            of_rule.filter_map(|other| other.fixes.first())
        };
        let (edits, count) = together(of_rule());
        if count > 1 {
            let note = note(of_rule().all(|fix| fix.safe));
            let title = format!("Fix all {count} `{}` findings in this file{note}", finding.rule.id);
            actions.push(answer(finding, CodeAction::change(title, Offer::FixRule, edits)));
        }
    }
    for finding in &here {
        for action in suppress::of(snapshot, finding) {
            actions.push(answer(finding, action));
        }
        let title = format!("Explain `{}`", finding.rule.id);
        let mut action = CodeAction::change(title, Offer::Explain, Vec::new());
        action.link = Some(finding.rule.page());
        actions.push(answer(finding, action));
    }
    let safe = analysis.findings.iter().filter_map(|finding| finding.fixes.iter().find(|fix| fix.safe));
    let (edits, count) = together(safe);
    if count > 0 {
        let title = format!("Fix all {count} findings whose fixes change no move");
        actions.push(CodeAction::change(title, Offer::FixAll, edits));
    }
}

/// What the title of a fix says of moves.
fn note(is_safe: bool) -> &'static str {
    if is_safe { "" } else { " (may change moves)" }
}

/// With a capital at its start, as editors write what can be done.
fn capitalised(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The edits of fixes that neither overlap nor touch each other, the first come first, and how many fixes these are. What is
/// left over is found again after the others.
fn together<'f>(fixes: impl Iterator<Item = &'f Fix>) -> (Vec<Edit>, usize) {
    let mut taken: Vec<Edit> = Vec::new();
    let mut count = 0;
    for fix in fixes {
        let clashes = |edit: &Edit| {
            // Findings come in text order: what clashes is near the end.
            taken
                .iter()
                .rev()
                .take(64)
                .any(|other| edit.range.start <= other.range.end && other.range.start <= edit.range.end)
        };
        if fix.edits.is_empty() || fix.edits.iter().any(clashes) {
            continue;
        }
        taken.extend(fix.edits.iter().cloned());
        count += 1;
    }
    taken.sort_by_key(|edit| edit.range.start);
    // A fix far after its finding may still overlap another.
    let mut end = None;
    taken.retain(|edit| {
        let is_clear = end.is_none_or(|end| edit.range.start > end);
        if is_clear {
            end = Some(edit.range.end);
        }
        is_clear
    });
    (taken, count)
}
