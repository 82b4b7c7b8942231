//! Program numbers, as they are written and as they are mistyped.
//!
//! Knows: what a program number looks like. Must not know: any rule.

use gcheck_syntax::SyntaxError;

use crate::BlockCx;

/// Does a number without address look like a program number with a zero for its letter?
pub(crate) fn is_number_with_zero(cx: &BlockCx<'_>, error: &SyntaxError) -> bool {
    let number = cx.slice(error.range.clone());
    let before = cx.slice(cx.block().range.start..error.range.start);
    cx.control().syntax().program_number
        && (4..=9).contains(&number.len())
        && number.starts_with('0')
        && number.bytes().all(|b| b.is_ascii_digit())
        && before.trim_matches([' ', '\t', '%', '\u{FEFF}']).is_empty()
        && cx.words().is_empty()
}
