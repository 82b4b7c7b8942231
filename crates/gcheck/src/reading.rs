//! Reading a program from disk or standard input, and refusing what is no text.
//!
//! Knows: files and bytes. Must not know: configuration, controls.

use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use gcheck_syntax::SourceText;

use crate::Problem;
use crate::problem::io_reason;

/// Bytes that are looked at to tell a program from a binary.
const SAMPLE: usize = 64 << 10;

/// Reads a program.
pub(crate) fn file(path: &Path) -> Result<SourceText, Problem> {
    let bytes = fs::read(path)
        .map_err(|error| Problem::with_file(path, format!("cannot read: {}", io_reason(&error))))?;
    text(path, bytes)
}

/// Reads standard input, called `name`.
pub(crate) fn standard_input(name: &Path) -> Result<SourceText, Problem> {
    let mut bytes = Vec::new();
    io::stdin().lock().read_to_end(&mut bytes).map_err(|error| {
        Problem::with_file(name, format!("cannot read standard input: {}", io_reason(&error)))
    })?;
    text(name, bytes)
}

fn text(path: &Path, bytes: Vec<u8>) -> Result<SourceText, Problem> {
    if let [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] = bytes.as_slice() {
        return Err(Problem::with_file(path, "is UTF-16 text").help("save it as UTF-8 or plain ASCII"));
    }
    if is_binary(&bytes) {
        return Err(Problem::with_file(path, "is no text, so no part program"));
    }
    SourceText::from_bytes(bytes).map_err(|_| Problem::with_file(path, "is larger than 4 GiB"))
}

/// More than one byte in ten is a control character that no program uses, or no UTF-8.
///
/// Programs hold some: punched tapes begin and end with NUL, serial lines leave DC1 to DC4, old editors end a file with SUB,
/// comments hold bytes of code pages.
fn is_binary(bytes: &[u8]) -> bool {
    let sample = bytes.get(..SAMPLE).unwrap_or(bytes);
    let is_padding = |b: &u8| matches!(b, 0 | 0x1A);
    let start = sample.iter().position(|b| !is_padding(b)).unwrap_or(sample.len());
    let end = sample.iter().rposition(|b| !is_padding(b)).map_or(start, |at| at + 1);
    let sample = sample.get(start..end).unwrap_or_default();
    let control = |b: &u8| matches!(b, 0..=8 | 14..=16 | 21..=25 | 27..=31);
    let strange = sample.iter().filter(|b| control(b)).count();
    let no_utf8: usize = sample.utf8_chunks().map(|chunk| chunk.invalid().len()).sum();
    (strange * 10 > sample.len()) || (no_utf8 * 4 > sample.len())
}

#[cfg(test)]
mod tests {
    use super::is_binary;

    #[test]
    fn tapes_and_code_pages_are_text() {
        assert!(!is_binary(b""));
        assert!(!is_binary(b"\0\0\0%\nO1 (TEST)\nM30\n%\0\0\0\x1A"));
        assert!(!is_binary(b"(Fr\xE4sen) G1 X1.\x11\r\n"));
    }

    #[test]
    fn pictures_and_programs_of_computers_are_not() {
        assert!(is_binary(b"\x7fELF\x02\x01\x01\0\0\0\0\0\0\0\0\0\x02\0>\0\x01"));
        let noise: Vec<u8> = (0..4_000_u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        assert!(is_binary(&noise));
    }
}
