//! Reading a program from disk or standard input, and refusing what is not text.
//!
//! Knows: files and bytes. Must not know: configuration, controls.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

use gcheck_syntax::SourceText;

use crate::Problem;
use crate::problem::io_reason;

/// Bytes that are looked at to tell a program from a binary.
const SAMPLE: usize = 64 << 10;

/// Bytes of a program that are read: a surface in tens of millions of blocks. Its analysis may take several times as much memory.
const MOST: usize = 1 << 30;

/// Reads a program.
pub(crate) fn file(path: &Path) -> Result<SourceText, Problem> {
    let unreadable =
        |error: &io::Error| Problem::with_file(path, format!("cannot read: {}", io_reason(error)));
    let file = File::open(path).map_err(|error| unreadable(&error))?;
    let size = file.metadata().map_err(|error| unreadable(&error))?.len();
    let size = usize::try_from(size).ok().filter(|size| *size <= MOST);
    bounded(path, file, size.ok_or_else(|| too_large(path))?).map_err(|error| unreadable(&error))?
}

/// Reads a file that others name, in a configuration or by its place: only what is a file (no pipe, device or socket), and
/// at most `most` bytes. The error is the reason, in words that follow "cannot read".
pub(crate) fn regular(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    // Before it is opened: opening a pipe waits for a program that writes to it.
    size(fs::metadata(path), most)?;
    let file = File::open(path).map_err(|error| io_reason(&error))?;
    let size = size(file.metadata(), most)?;
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default());
    // Some files are longer than they say: those of the system itself say 0.
    file.take(most + 1).read_to_end(&mut bytes).map_err(|error| io_reason(&error))?;
    if bytes.len() as u64 > most { Err(larger(most)) } else { Ok(bytes) }
}

/// Why a file that others read is not read: no file, or too large a one. `None` for one that is not there.
pub(crate) fn irregular(path: &Path, most: u64) -> Option<String> {
    let data = fs::metadata(path).ok()?;
    size(Ok(data), most).err()
}

/// The size of a regular file of at most `most` bytes.
fn size(data: io::Result<Metadata>, most: u64) -> Result<u64, String> {
    match data {
        Ok(data) if !data.is_file() => Err("it is a pipe, a device or a folder, not a file".to_owned()),
        Ok(data) if data.len() > most => Err(larger(most)),
        Ok(data) => Ok(data.len()),
        Err(error) => Err(io_reason(&error)),
    }
}

/// The first bytes of a file as text; `None` where they cannot be read, or are not text.
pub(crate) fn head(path: &Path, most: u64) -> Option<String> {
    let mut bytes = Vec::new();
    File::open(path).ok()?.take(most).read_to_end(&mut bytes).ok()?;
    let is_text = !is_other_format(&bytes) && !is_binary(&bytes);
    is_text.then(|| String::from_utf8_lossy(&bytes).into_owned())
}

/// Bytes as text, if they are text.
pub(crate) fn text(path: &Path, bytes: &[u8]) -> Result<SourceText, Problem> {
    let size = bytes.len();
    bounded(path, bytes, size).unwrap_or_else(|_| Err(too_large(path)))
}

fn larger(most: u64) -> String {
    format!("it is larger than {} MB", most >> 20)
}

/// Reads standard input, called `name`.
pub(crate) fn standard_input(name: &Path) -> Result<SourceText, Problem> {
    bounded(name, io::stdin().lock(), 0).map_err(|error| {
        Problem::with_file(name, format!("cannot read standard input: {}", io_reason(&error)))
    })?
}

/// Reads a sample, and the rest only after a sample that is text: a device or pipe may never end.
///
/// `size` is what is expected, so that the buffer does not grow; the bytes become text without being copied.
fn bounded(path: &Path, mut from: impl Read, size: usize) -> io::Result<Result<SourceText, Problem>> {
    // Room for one byte more: only a read that finds nothing tells the end.
    let mut bytes = Vec::with_capacity(size + 1);
    from.by_ref().take(SAMPLE as u64).read_to_end(&mut bytes)?;
    if let [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] = bytes.as_slice() {
        return Ok(Err(Problem::with_file(path, "is UTF-16 text").help("save it as UTF-8 or plain ASCII")));
    }
    if is_other_format(&bytes) || is_binary(&bytes) {
        return Ok(Err(Problem::with_file(path, "is not text, so it is not a part program")));
    }
    let left = MOST + 1 - bytes.len();
    from.take(left as u64).read_to_end(&mut bytes)?;
    if bytes.len() > MOST {
        return Ok(Err(too_large(path)));
    }
    Ok(SourceText::from_bytes(bytes).map_err(|_| too_large(path)))
}

fn too_large(path: &Path) -> Problem {
    Problem::with_file(
        path,
        format!("is larger than {} GB, the largest program that gcheck reads", MOST >> 30),
    )
    .help("split it, for example at its tool changes, and check the parts")
}

/// How files of other formats begin: pictures (PNG, JPEG, GIF), PDF, archives (ZIP, gzip, 7z), documents of offices, programs.
const BEGINNINGS: [&[u8]; 9] = [
    b"\x89PNG\r\n",
    b"\xFF\xD8\xFF",
    b"GIF8",
    b"%PDF-",
    b"PK\x03\x04",
    b"\x1F\x8B\x08",
    b"7z\xBC\xAF\x27\x1C",
    b"\xD0\xCF\x11\xE0\xA1\xB1",
    b"\x7FELF",
];

/// A file of another format that is short, or has much text in it, is known by its first bytes.
fn is_other_format(sample: &[u8]) -> bool {
    BEGINNINGS.iter().any(|beginning| sample.starts_with(beginning))
}

/// More than one byte in ten is a control character that no program uses, or no UTF-8.
///
/// Programs hold some: punched tapes begin and end with NUL, serial lines leave DC1 to DC4, old editors end a file with SUB,
/// comments hold bytes of code pages.
fn is_binary(sample: &[u8]) -> bool {
    let is_padding = |b: &u8| matches!(b, 0 | 0x1A);
    let start = sample.iter().position(|b| !is_padding(b)).unwrap_or(sample.len());
    let end = sample.iter().rposition(|b| !is_padding(b)).map_or(start, |at| at + 1);
    // No tape has a leader as long as the sample.
    let is_padding_alone = start == SAMPLE;
    let sample = sample.get(start..end).unwrap_or_default();
    let control = |b: &u8| matches!(b, 0..=8 | 14..=16 | 21..=25 | 27..=31);
    let strange = sample.iter().filter(|b| control(b)).count();
    let no_utf8: usize = sample.utf8_chunks().map(|chunk| chunk.invalid().len()).sum();
    is_padding_alone || (strange * 10 > sample.len()) || (no_utf8 * 4 > sample.len())
}

#[cfg(test)]
mod tests {
    use std::io::{self, Read as _};
    use std::path::Path;

    use super::{SAMPLE, bounded, is_binary, is_other_format};

    #[test]
    fn an_endless_device_is_refused_by_its_beginning() {
        for byte in [0, 0xFF] {
            let problem = bounded(Path::new("device"), io::repeat(byte), 0).unwrap().unwrap_err().to_string();
            assert!(problem.starts_with("device: is "), "{problem}");
        }
    }

    #[test]
    fn what_is_longer_than_the_sample_is_read_whole() {
        let program = "G1 X1.\n".repeat(SAMPLE);
        let source = bounded(Path::new("a.nc"), program.as_bytes(), 0).unwrap().unwrap();
        assert_eq!(source.text(), program);
        let leader = io::repeat(0).take(4_000).chain(&b"%\nM30\n%\n"[..]);
        assert_eq!(bounded(Path::new("tape"), leader, 0).unwrap().unwrap().text().len(), 4_008);
    }

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

    #[test]
    fn a_short_picture_and_a_document_with_much_text_are_not() {
        assert!(is_other_format(b"\x89PNG\r\n\x1A\n\0\0"));
        assert!(is_other_format(b"%PDF-1.7\n1 0 obj << /Type /Catalog >> endobj\n"));
        assert!(!is_other_format(b"%\nO1234 (PNG)\nM30\n%\n"));
    }
}
