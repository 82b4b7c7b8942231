//! Which syntax errors of a block rules of the token tier are shown.
//!
//! Knows: that one typing mistake often breaks the grammar in several places. Must not know: any rule, wording.

use std::ops::Range;

use gcheck_program::Value;
use gcheck_syntax::{SourceText, SyntaxError, SyntaxErrorKind};

use crate::BlockCx;

/// The mistakes of a block that rules get to see: those of its comments, and the first of the others.
///
/// A control stops at the first mistake too. A mistake that causes others comes before them: a character that is not
/// ASCII, then a parenthesis or bracket that closes nothing. A letter O in place of a zero has a rule of its own.
pub(crate) fn shown<'a>(cx: &BlockCx<'a>) -> impl Iterator<Item = &'a SyntaxError> {
    let code = || cx.table.errors(cx.ix).filter(|e| !is_in_comment(e.kind));
    let too_long = code().find(|e| e.kind == SyntaxErrorKind::LineTooLong);
    let first = match (too_long, letter_o(cx)) {
        (Some(too_long), _) => Some(too_long),
        (None, Some(_)) => None,
        (None, None) => code()
            .find(|e| is_foreign_character(cx, e))
            .or_else(|| {
                code().find(|e| {
                    matches!(e.kind, SyntaxErrorKind::StrayParenthesis | SyntaxErrorKind::StrayBracket)
                })
            })
            .or_else(|| code().next()),
    };
    cx.table.errors(cx.ix).filter(|e| is_in_comment(e.kind)).chain(first)
}

fn is_in_comment(kind: SyntaxErrorKind) -> bool {
    matches!(kind, SyntaxErrorKind::UnclosedComment | SyntaxErrorKind::NestedComment)
}

/// Is the mistake a character outside ASCII, or a byte that is not a character?
pub fn is_foreign_character(cx: &BlockCx<'_>, error: &SyntaxError) -> bool {
    error.kind == SyntaxErrorKind::Unexpected && foreign_characters(cx.slice(error.range.clone())).is_some()
}

/// The first run of characters outside ASCII.
pub fn foreign_characters(text: &str) -> Option<Range<usize>> {
    let foreign = |c: char| !c.is_ascii() || c == SourceText::STAND_IN;
    let start = text.find(foreign)?;
    let rest = text.get(start..).unwrap_or_default();
    Some(start..start + rest.find(|c| !foreign(c)).unwrap_or(rest.len()))
}

/// The letter O of a block in place of a zero: directly after an address or a number, not at the head.
pub fn letter_o(cx: &BlockCx<'_>) -> Option<Range<u32>> {
    let bytes = cx.text.as_bytes();
    let at = |offset: u32| bytes.get(offset as usize).copied().unwrap_or(b' ');
    let first_is_label = cx.words().first().is_some_and(|w| w.letter.ascii() == b'N');
    let word = cx.words().iter().enumerate().find(|(position, word)| {
        let start = word.range().start;
        // `O1234` and `N10O1234` name a program; `N1O` is a slip.
        let is_head =
            *position == 0 || (*position == 1 && first_is_label && !matches!(word.value, Value::Missing));
        let previous = at(start.wrapping_sub(1));
        let touches = if previous.is_ascii_alphabetic() {
            // `GO1`, but not the end of a word of prose.
            !at(start.wrapping_sub(2)).is_ascii_alphabetic()
        } else {
            // `M99O1234` is two lines whose end of line got lost.
            let program = word.shape.digits() >= 4 && !word.shape.point;
            matches!(previous, b'.' | b'-' | b'+') || (previous.is_ascii_digit() && !program)
        };
        matches!(at(start), b'O' | b'o') && !is_head && touches && !matches!(word.value, Value::Expr(_))
    });
    if let Some((_, word)) = word {
        let start = word.range().start;
        return Some(start..start + 1);
    }
    // `GOO`, `X1O.`: no word was made of the letter.
    cx.table.errors(cx.ix).filter(|e| e.kind == SyntaxErrorKind::Unexpected).find_map(|error| {
        let [letter, zeros @ ..] = cx.slice(error.range.clone()).as_bytes() else { return None };
        let all_o = letter.is_ascii_alphabetic()
            && zeros.len() > 1
            && zeros.iter().all(|b| matches!(b, b'O' | b'o' | b'0'..=b'9' | b'.'));
        let begins = matches!(
            at(error.range.start.wrapping_sub(1)),
            b' ' | b'\t' | b'\r' | b'\n' | b'0'..=b'9' | b'.'
        );
        (all_o && begins && !matches!(letter, b'O' | b'o'))
            .then_some(error.range.start + 1..error.range.start + 2)
    })
}
