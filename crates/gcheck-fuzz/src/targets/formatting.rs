//! Law 6: formatting and renumbering leave what a run does as it is, and twice is once.
//!
//! Knows: styles. Must not know: how a style is applied.

use gcheck_diagnostics::{apply, apply_to_bytes};
use gcheck_format::{
    Indentation, LeadingZeros, LetterCase, Numbering, SequenceNumbers, Style, TrailingZeros, WordSpacing,
    format, formatted, renumber,
};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;

use super::moves::Moves;
use crate::choices::Choices;
use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let (one, two) = (choices.byte(), choices.byte());
    let case = programs::case(choices.rest());
    let dialect = Dialect::new(case.control);
    let style = style(&dialect, one, two);
    let source = SourceText::from(case.text.as_str());
    let edits = format(source.text(), &dialect, &style, None);
    let by_edits = apply(source.text(), &edits);
    let Some(after) = formatted(&source, &dialect, &style) else {
        assert_eq!(by_edits, source.text(), "what is formatted has no edits");
        return numbered(&source, &dialect, usize::from(two));
    };
    assert_eq!(by_edits.as_bytes(), after, "edits and bytes say the same");
    let Ok(after) = SourceText::from_bytes(after) else { return };
    assert_eq!(formatted(&after, &dialect, &style), None, "twice is once");
    assert_same(source.text(), after.text(), &dialect);
    numbered(&source, &dialect, usize::from(two));
}

fn numbered(source: &SourceText, dialect: &Dialect<'_>, step: usize) {
    let numbering = Numbering { start: 7, step: 1 + step as u32 % 10 };
    let Ok(edits) = renumber(source.text(), dialect, &numbering) else { return };
    let Ok(after) = SourceText::from_bytes(apply_to_bytes(&source.to_bytes(), &edits)) else { return };
    assert_eq!(renumber(after.text(), dialect, &numbering), Ok(Vec::new()), "twice is once");
    assert_same(source.text(), after.text(), dialect);
}

fn assert_same(before: &str, after: &str, dialect: &Dialect<'_>) {
    let (old, new) = (Moves::of(before, dialect), Moves::of(after, dialect));
    if old.ended() || new.ended() {
        assert_eq!(old.events, new.events, "the moves stay\n{before}\n---\n{after}");
        assert_eq!(old.stopped, new.stopped, "the end stays");
    } else {
        // Lines without a block may be more or fewer, and count as blocks where a run is stopped.
        for (one, other) in old.events.iter().zip(&new.events) {
            assert_eq!(one, other, "the moves stay\n{before}\n---\n{after}");
        }
    }
}

fn style(dialect: &Dialect<'_>, one: u8, two: u8) -> Style {
    let own = Style::of(dialect.control());
    match one % 4 {
        0 => own,
        1 => Style {
            word_spacing: WordSpacing::None,
            letter_case: LetterCase::Upper,
            leading_zeros: LeadingZeros::Drop,
            trailing_zeros: TrailingZeros::Drop,
            sequence_numbers: if two.is_multiple_of(2) {
                SequenceNumbers::Drop
            } else {
                own.sequence_numbers
            },
            comment_column: 1,
            blank_lines: 0,
            indentation: Indentation::None,
            ..own
        },
        2 => Style {
            letter_case: LetterCase::Lower,
            leading_zeros: LeadingZeros::Add,
            word_column: two % 16,
            comment_column: 40,
            blank_lines: 2,
            indentation: Indentation::Nested(2),
            ..own
        },
        _ => Style { word_spacing: WordSpacing::Keep, letter_case: LetterCase::Lower, ..own },
    }
}
