//! Lines of nothing but words with numbers: nearly all of a large program, read without tokens.
//!
//! Knows: how such a line looks. Must not know: anything else that a line may hold; then it reads nothing, and the grammar
//! does. What it reads is what tokens and grammar would give (law 2).

use gcheck_controls::Letter;
use gcheck_syntax::MAX_LINE_BYTES;

use crate::number::{self, NumberShape};

/// One word of a plain line.
pub(crate) struct PlainWord {
    pub(crate) letter: Letter,
    pub(crate) value: f64,
    pub(crate) shape: NumberShape,
    /// Offset of its letter in the text.
    pub(crate) start: u32,
    /// Offset after its last digit.
    pub(crate) end: u32,
    /// The letter is a small one.
    pub(crate) is_lower: bool,
}

/// Reads the line that begins at `start`, blanks between words allowed. `word` receives its words; the line's end, its end of
/// line included, is returned. `None` for a line that is not plain; `word` may have received some of it by then.
pub(crate) fn line(text: &[u8], start: usize, mut word: impl FnMut(PlainWord)) -> Option<usize> {
    // Of a longer line the grammar reads a part.
    let text = text.get(..text.len().min(start + MAX_LINE_BYTES as usize)).unwrap_or_default();
    let mut at = start;
    loop {
        match *text.get(at)? {
            b' ' | b'\t' => at += 1,
            b'\n' => return Some(at + 1),
            b'\r' if text.get(at + 1) == Some(&b'\n') => return Some(at + 2),
            byte if byte.is_ascii_alphabetic() => {
                let letter = Letter::new(byte)?;
                let (value, shape, end) = number_at(text, at + 1)?;
                let (start, is_lower) = (at as u32, byte.is_ascii_lowercase());
                word(PlainWord { letter, value, shape, start, end: end as u32, is_lower });
                at = end;
            }
            _ => return None,
        }
    }
}

/// The number that begins here and where it ends; `None` where there is none, or none as plain as `-1.5`.
#[expect(
    clippy::inline_always,
    reason = "half of the time of a large program is spent here, and a call doubles it"
)]
#[inline(always)]
fn number_at(text: &[u8], start: usize) -> Option<(f64, NumberShape, usize)> {
    let (at, minus) = match text.get(start)? {
        b'-' => (start + 1, true),
        b'+' => (start + 1, false),
        _ => (start, false),
    };
    let Some(Digits { value, whole, decimals, len }) = few_digits(text, at) else {
        return any_number_at(text, start, at);
    };
    let shape =
        NumberShape { whole_digits: whole as u8, decimals: decimals as u8, point: len > whole, minus };
    let value = number::of_digits(value, decimals);
    (whole + decimals > 0).then_some((if minus { -value } else { value }, shape, at + len))
}

/// Digits with a point among them, or none.
#[derive(Debug, PartialEq, Eq)]
struct Digits {
    /// All of them as one whole number.
    value: u64,
    whole: usize,
    decimals: usize,
    /// Bytes, the point included.
    len: usize,
}

/// The digits that begin here. Eight bytes are looked at together: `None` when that is not enough to see where they end.
///
/// A part of [`number_at`], and inlined with it.
#[inline(always)]
fn few_digits(text: &[u8], at: usize) -> Option<Digits> {
    const EACH: u64 = 0x0101_0101_0101_0101;
    let bytes = u64::from_le_bytes(*text.get(at..)?.first_chunk::<8>()?);
    // A digit becomes its value, any other byte more than nine; of those the highest bit is then set.
    let values = bytes ^ (EACH * 0x30);
    let others = (((values & (EACH * 0x7F)) + EACH * 0x76) | values) & (EACH * 0x80);
    let whole = (others.trailing_zeros() / 8) as usize;
    if whole == 8 {
        return None;
    }
    let has_point = (bytes >> (8 * whole)) as u8 == b'.';
    let (digits, len) = if has_point {
        let behind = others & (others - 1);
        let len = (behind.trailing_zeros() / 8) as usize;
        if len == 8 && text.get(at + 8).is_none_or(u8::is_ascii_digit) {
            return None;
        }
        // Without the point between them.
        let front = (1 << (8 * whole)) - 1;
        ((values & front) | ((values >> 8) & !front), len)
    } else {
        (values, whole)
    };
    let decimals = len - whole - usize::from(has_point);
    let count = whole + decimals;
    // The last digit in the highest byte, zeros in front of the first; neighbours are put together to pairs, fours, the whole.
    let digits = if count == 0 { 0 } else { digits << (64 - 8 * count) };
    let pairs = (digits * 10 + (digits >> 8)) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_FFFF_0000_FFFF;
    let value = (fours * 10_000 + (fours >> 32)) & 0xFFFF_FFFF;
    Some(Digits { value, whole, decimals, len })
}

/// A number whose first digit or point is at `at`, whatever its length.
fn any_number_at(text: &[u8], start: usize, at: usize) -> Option<(f64, NumberShape, usize)> {
    let count = |at: usize| {
        text.get(at..).unwrap_or_default().iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    let whole = count(at);
    let mut end = at + whole;
    let mut digits = whole;
    if text.get(end) == Some(&b'.') {
        let decimals = count(end + 1);
        digits += decimals;
        end += 1 + decimals;
    }
    let (value, shape) = number::parse(text.get(start..end)?);
    (digits > 0).then_some((value, shape, end))
}

#[cfg(test)]
mod tests {
    use super::{Digits, few_digits, line};

    #[test]
    fn digits_are_read_eight_bytes_at_a_time() {
        let digits = |value, whole, decimals, len| Some(Digits { value, whole, decimals, len });
        for (text, expected) in [
            ("1234567 ", digits(1_234_567, 7, 0, 7)),
            ("1. 567890", digits(1, 1, 0, 2)),
            (".5Y56789", digits(5, 0, 1, 2)),
            ("0098.765 ", digits(98_765, 4, 3, 8)),
            ("12.3.456", digits(123, 2, 1, 4)),
            ("X1234567", digits(0, 0, 0, 0)),
            (". 123456", digits(0, 0, 0, 1)),
            ("9\u{e9}999999", digits(9, 1, 0, 1)),
            ("0098.7654", None),
            ("0098.765", None),
            ("12345678", None),
            ("1234567", None),
        ] {
            assert_eq!(few_digits(text.as_bytes(), 0), expected, "{text}");
        }
    }

    #[test]
    fn a_line_is_plain_when_it_holds_words_alone() {
        for (text, is_plain) in [
            ("X1. Y-.5\n", true),
            ("  N10G1X+1\tY000000000001.000000000001\r\n", true),
            ("\n", true),
            ("X1", false),
            ("X1\r", false),
            ("X 1\n", false),
            ("X1.5.5\n", false),
            ("X1 5\n", false),
            ("X.\n", false),
            ("X-\n", false),
            ("X1(A)\n", false),
            ("X[1]\n", false),
        ] {
            let end = line(text.as_bytes(), 0, |_| ());
            assert_eq!(end.is_some(), is_plain, "{text:?}");
            assert!(end.is_none_or(|end| end == text.len()));
        }
    }
}
