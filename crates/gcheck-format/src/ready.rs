//! Lines of nothing but words that are as the style wants them: nearly all of a formatted program, passed over without
//! tokens.
//!
//! Knows: how such a line looks. Must not know: what becomes of any other.

use gcheck_program::Dialect;

use crate::line::written_case;
use crate::style::{LeadingZeros, LetterCase, SequenceNumbers, Style, TrailingZeros, WordSpacing};

/// How a line looks that needs no change, whatever its words are.
pub(crate) struct Ready {
    /// By byte: an address that the style asks nothing more about.
    address: [bool; 256],
    /// One blank between words, or none.
    blank: bool,
    /// Zeros after a point are not looked for here.
    trims: bool,
}

impl Ready {
    pub(crate) fn new(style: &Style, dialect: &Dialect<'_>) -> Self {
        let case = written_case(style, dialect);
        let mut address = [false; 256];
        for (byte, is_address) in address.iter_mut().enumerate() {
            let byte = byte as u8;
            let has_case = match case {
                LetterCase::Keep => byte.is_ascii_alphabetic(),
                LetterCase::Upper => byte.is_ascii_uppercase(),
                LetterCase::Lower => byte.is_ascii_lowercase(),
            };
            *is_address = has_case
                && match byte.to_ascii_uppercase() {
                    b'G' | b'M' => style.leading_zeros == LeadingZeros::Keep,
                    b'N' => style.sequence_numbers == SequenceNumbers::Keep && style.word_column == 0,
                    // The head of a program, or of what the grammar must read.
                    b'O' => false,
                    _ => true,
                };
        }
        Self {
            address,
            blank: style.word_spacing != WordSpacing::None,
            trims: style.trailing_zeros == TrailingZeros::Drop,
        }
    }

    /// Where the first line after `from`, the head of a line, begins that is to be looked at.
    pub(crate) fn lines(&self, text: &[u8], from: usize) -> usize {
        let mut start = from;
        while let Some(next) = self.line(text, start) {
            start = next;
        }
        start
    }

    /// The end of the line that begins at `start`, if the line is ready.
    fn line(&self, text: &[u8], start: usize) -> Option<usize> {
        let mut at = start;
        loop {
            if !*self.address.get(usize::from(*text.get(at)?))? {
                return None;
            }
            at += 1;
            if matches!(text.get(at)?, b'-' | b'+') {
                at += 1;
            }
            let whole = digits(text, at);
            at += whole;
            let mut decimals = 0;
            if text.get(at)? == &b'.' {
                decimals = digits(text, at + 1);
                at += 1 + decimals;
                if self.trims && decimals > 0 && text.get(at - 1) == Some(&b'0') {
                    return None;
                }
            }
            if whole + decimals == 0 {
                return None;
            }
            match text.get(at)? {
                b'\n' => return Some(at + 1),
                b'\r' if text.get(at + 1) == Some(&b'\n') => return Some(at + 2),
                b' ' if self.blank => at += 1,
                _ if !self.blank => {}
                _ => return None,
            }
        }
    }
}

fn digits(text: &[u8], at: usize) -> usize {
    text.get(at..).unwrap_or_default().iter().take_while(|byte| byte.is_ascii_digit()).count()
}
