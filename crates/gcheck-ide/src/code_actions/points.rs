//! Decimal points for all numbers of a file that lack them.
//!
//! Knows: which words a missing point changes. Must not know: which of two readings was meant, so both are offered.

use gcheck_controls::{Code, Effect, Unpointed, WordKind};
use gcheck_db::Snapshot;
use gcheck_diagnostics::Edit;
use gcheck_program::{BlockFlags, Word};

use super::action::{CodeAction, Offer};
use crate::describe;
use crate::number_text::plain;

/// Words that are changed together.
const MOST: usize = 100_000;

/// Offers both readings: the value as the control counts it, and the number as it is written.
pub(super) fn offer(snapshot: &Snapshot, actions: &mut Vec<CodeAction>) {
    let control = snapshot.control();
    let numbers = control.numbers();
    if numbers.unpointed == Unpointed::AsWritten || snapshot.file_index().unpointed.is_empty() {
        return;
    }
    let words = words(snapshot);
    if words.is_empty() || words.len() > MOST {
        return;
    }
    let least = least_length(snapshot);
    let counted: Option<Vec<Edit>> = words
        .iter()
        .map(|word| {
            let least = if word.kind == WordKind::Angle { Some(numbers.least_angle) } else { least };
            // Divided by a power of ten rather than multiplied: no noise of binary fractions.
            let text = pointed(word.number / (1.0 / least?).round());
            Some(Edit { range: word.digits.clone(), text })
        })
        .collect();
    if let Some(edits) = counted.filter(|_| numbers.unpointed == Unpointed::LeastIncrement) {
        let title = format!(
            "Write {} with decimal points, as the control counts them",
            numbers_in_words(words.len())
        );
        actions.push(CodeAction::change(title, Offer::WriteCounted, edits));
    }
    let behind =
        words.iter().map(|word| Edit { range: word.digits.end..word.digits.end, text: ".".to_owned() });
    let title = format!(
        "Write decimal points after {} without one (changes what they count)",
        numbers_in_words(words.len())
    );
    actions.push(CodeAction::change(title, Offer::AddPoints, behind.collect()));
}

/// `1 number`, `5 numbers`.
fn numbers_in_words(count: usize) -> String {
    if count == 1 { "1 number".to_owned() } else { format!("{count} numbers") }
}

/// A number with a decimal point, whole or not.
pub(super) fn pointed(value: f64) -> String {
    let text = plain(value, 6);
    if text.contains('.') { text } else { text + "." }
}

/// A number without a decimal point that one would change.
struct Pointless {
    number: f64,
    kind: WordKind,
    /// Bytes of sign and digits.
    digits: std::ops::Range<u32>,
}

fn words(snapshot: &Snapshot) -> Vec<Pointless> {
    let control = snapshot.control();
    let mut found = Vec::new();
    let mut seen = None;
    for range in &snapshot.file_index().unpointed {
        let Some(chunk) = snapshot.chunk_at(range.start) else { continue };
        if seen == Some(chunk.index) {
            continue;
        }
        seen = Some(chunk.index);
        let Some(table) = snapshot.table(chunk.index) else { continue };
        let end = crate::symbols::code_end(snapshot);
        for (_, block) in table.blocks() {
            if !block.flags.contains(BlockFlags::UNPOINTED)
                || block.flags.contains(BlockFlags::ERROR)
                || chunk.base + block.range.start >= end
                || snapshot.file_index().is_data(chunk.base + block.range.start)
            {
                continue;
            }
            let words = table.words(block);
            let codes: Vec<Code<'_>> = words.iter().filter_map(|word| control.code_at(word.code)).collect();
            // After a call of a macro numbers mean what the macro makes of them.
            if codes.iter().any(|code| code.entry().any_words) {
                continue;
            }
            for word in words {
                let Some(kind) = changed_by_point(snapshot, word, &codes) else { continue };
                let text = snapshot.slice(chunk.base + word.range().start..chunk.base + word.range().end);
                let Some(at) = text.find(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+')) else {
                    continue;
                };
                let start = chunk.base + word.range().start + at as u32;
                let digits = start..chunk.base + word.range().end;
                // A number with blanks inside is left to its author.
                if text.get(at..).is_some_and(|digits| digits.contains(char::is_whitespace)) {
                    continue;
                }
                found.extend(word.number().map(|number| Pointless { number, kind, digits }));
            }
        }
    }
    found
}

/// The kind of a value that a missing point changes; `None` where it changes nothing, or its kind is not certain.
fn changed_by_point(snapshot: &Snapshot, word: &Word, codes: &[Code<'_>]) -> Option<WordKind> {
    let control = snapshot.control();
    word.number().filter(|number| *number != 0.0 && !word.shape.point)?;
    let general = control.letter(word.letter).filter(|entry| entry.scaled)?;
    let entry = codes.iter().find_map(|code| describe::word_of(*code, word.letter));
    let kind = match entry {
        Some(entry) => entry.kind,
        // Without a code in the block the word belongs to what is in effect: an axis is a length to all of them.
        None if general.axis || general.kind == WordKind::Feed => general.kind,
        None => return None,
    };
    matches!(kind, WordKind::Length | WordKind::Angle | WordKind::Feed).then_some(kind)
}

/// The least increment of lengths, where the file is in one unit throughout and says so.
fn least_length(snapshot: &Snapshot) -> Option<f64> {
    let control = snapshot.control();
    let uses = |effect: Effect| {
        let mut codes = snapshot.file_index().codes.iter();
        codes.any(|(number, _)| control.code(*number).is_some_and(|code| code.effect() == effect))
    };
    match (uses(Effect::Inch), uses(Effect::Millimetre)) {
        (true, false) => Some(control.numbers().least_inch),
        (false, true) => Some(control.numbers().least_mm),
        _ => None,
    }
}
