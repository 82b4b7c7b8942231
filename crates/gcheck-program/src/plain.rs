//! Lines of nothing but words with numbers: nearly all of a large program, read without tokens.
//!
//! Knows: how such a line looks. Must not know: anything else that a line may hold; then it reads nothing, and the grammar
//! does. What it reads is what tokens and grammar would give (law 2).

use gcheck_controls::Letter;

use crate::number::{self, NumberShape};

/// One word of a plain line.
pub(crate) struct PlainWord {
    pub(crate) letter: Letter,
    pub(crate) value: f64,
    pub(crate) shape: NumberShape,
    /// Offset of its letter in the text.
    pub(crate) start: u32,
    /// Offset behind its last digit.
    pub(crate) end: u32,
    /// The letter is a small one.
    pub(crate) is_lower: bool,
}

/// Reads the line that begins at `start`, blanks between words allowed. `word` receives its words; the line's end, its end of
/// line included, is returned. `None` for a line that is not plain; `word` may have received some of it by then.
pub(crate) fn line(text: &[u8], start: usize, mut word: impl FnMut(PlainWord)) -> Option<usize> {
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
fn number_at(text: &[u8], start: usize) -> Option<(f64, NumberShape, usize)> {
    let (mut at, minus) = match text.get(start)? {
        b'-' => (start + 1, true),
        b'+' => (start + 1, false),
        _ => (start, false),
    };
    let mut mantissa: u64 = 0;
    let mut digits = |at: &mut usize| {
        let first = *at;
        while let Some(byte) = text.get(*at) {
            let digit = byte.wrapping_sub(b'0');
            if digit > 9 {
                break;
            }
            // What does not fit is read again below.
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            *at += 1;
        }
        *at - first
    };
    let whole = digits(&mut at);
    let point = text.get(at) == Some(&b'.');
    let decimals = if point {
        at += 1;
        digits(&mut at)
    } else {
        0
    };
    if whole + decimals == 0 {
        return None;
    }
    if whole + decimals > number::EXACT_DIGITS {
        let (value, shape) = number::parse(text.get(start..at)?);
        return Some((value, shape, at));
    }
    let shape = NumberShape { whole_digits: whole as u8, decimals: decimals as u8, point, minus };
    let value = number::of_digits(mantissa, decimals);
    Some((if minus { -value } else { value }, shape, at))
}
