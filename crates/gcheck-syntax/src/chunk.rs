//! Cutting a program into chunks of whole lines, and editing one.
//!
//! Knows: lines. Must not know: blocks. Cuts are found in the content, so that a line inserted at the top does not move
//! every later cut; nothing that people see may depend on where cuts fall.

use std::ops::Range;
use std::sync::Arc;

/// Fewest lines in a chunk, unless the program ends.
pub const MIN_LINES: usize = 128;
/// Most lines in a chunk: repeated lines give no cuts.
pub const MAX_LINES: usize = 2_048;
/// A chunk also ends after the line that brings it to this many bytes, so that long lines do not make huge chunks.
const MAX_BYTES: usize = 1 << 20;
/// A line ends a chunk when its hash has these bits clear: one line in 384, so a mean of about 512 with the minimum.
const CUT_MASK_ODDS: u32 = 384;

/// Ranges of the chunks of a text, in order and without gaps. Each is found when it is asked for, so that who looks at the
/// chunks one by one finds their text in the processor's cache.
pub fn cuts(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    std::iter::from_fn(move || {
        let rest = text.as_bytes().get(start..).filter(|rest| !rest.is_empty())?;
        let chunk = start..start + next_cut(rest);
        start = chunk.end;
        Some(chunk)
    })
}

/// All of [`cuts`].
pub fn cut(text: &str) -> Vec<Range<usize>> {
    cuts(text).collect()
}

/// Length of the first chunk of `bytes`, which is not empty.
fn next_cut(bytes: &[u8]) -> usize {
    let mut lines = 0;
    let mut start = 0;
    while start < bytes.len() {
        let end = start + line_len(bytes.get(start..).unwrap_or_default());
        lines += 1;
        let line = bytes.get(start..end).unwrap_or_default();
        if lines >= MAX_LINES || end >= MAX_BYTES || (lines >= MIN_LINES && is_cut(line)) {
            return end;
        }
        start = end;
    }
    bytes.len()
}

/// Length of the first line of `bytes` with its end.
pub fn line_len(bytes: &[u8]) -> usize {
    let mut at = 0;
    // Lines are short: eight bytes a step are as many as pay.
    while let Some(eight) = bytes.get(at..).and_then(<[u8]>::first_chunk) {
        match first_line_end(*eight) {
            Some(offset) => {
                at += offset;
                break;
            }
            None => at += eight.len(),
        }
    }
    let rest = bytes.get(at..).unwrap_or_default();
    match rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')) {
        None => bytes.len(),
        Some(offset) => {
            let end = at + offset;
            end + if bytes.get(end..end + 2) == Some(b"\r\n") { 2 } else { 1 }
        }
    }
}

/// Where the first byte is that may end a line: one below fourteen, as `\n` and `\r` are, and tabs.
#[inline]
fn first_line_end(bytes: [u8; 8]) -> Option<usize> {
    const EACH: u64 = 0x0101_0101_0101_0101;
    let bytes = u64::from_le_bytes(bytes);
    // Taking fourteen away sets the highest bit of a byte below it. What it borrows falls on bytes after it only.
    let low = bytes.wrapping_sub(EACH * 14) & !bytes & (EACH * 0x80);
    (low != 0).then(|| (low.trailing_zeros() / 8) as usize)
}

/// Looks at the last bytes of the line only: they differ as well as whole lines do, and hashing stays cheap.
fn is_cut(line: &[u8]) -> bool {
    let (low, high) = match line.last_chunk::<16>() {
        Some(tail) => {
            let tail = u128::from_le_bytes(*tail);
            (tail as u64, (tail >> 64) as u64)
        }
        None => line.iter().fold((0, 0), |(low, high): (u64, u64), byte| {
            (low << 8 | u64::from(*byte), high << 8 | low >> 56)
        }),
    };
    // Products with odd numbers of random bits, whose upper half every bit has gone into.
    let hash =
        low.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ high.wrapping_mul(0xC2B2_AE3D_27D4_EB4F).rotate_left(32);
    let hash = (hash ^ (hash >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((hash >> 32) as u32).is_multiple_of(CUT_MASK_ODDS)
}

/// A program as a list of chunks that share their text.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Document {
    chunks: Vec<Arc<str>>,
}

/// What an edit did to the chunks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Changed {
    /// Chunks of the old list that are gone.
    pub old: Range<usize>,
    /// Chunks of the new list that are in their place.
    pub new: Range<usize>,
}

/// An edit names bytes that the document does not have, or cuts a character in two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutOfRange;

impl Document {
    /// Cuts a text.
    pub fn new(text: &str) -> Self {
        Self {
            chunks: cut(text)
                .into_iter()
                .map(|range| Arc::from(text.get(range).unwrap_or_default()))
                .collect(),
        }
    }

    /// The chunks in order.
    pub fn chunks(&self) -> &[Arc<str>] {
        &self.chunks
    }

    /// The whole text.
    pub fn text(&self) -> String {
        self.chunks.iter().map(AsRef::as_ref).collect()
    }

    /// Length in bytes.
    pub fn len(&self) -> usize {
        self.chunks.iter().map(|c| c.len()).sum()
    }

    /// True for an empty program.
    pub fn is_empty(&self) -> bool {
        self.chunks.is_empty()
    }

    /// Replaces a range of bytes; the chunks are then those of [`Document::new`] on the new text.
    ///
    /// # Errors
    /// [`OutOfRange`], and the document is unchanged, when the range does not lie in the text on character boundaries.
    pub fn edit(&mut self, range: Range<usize>, insert: &str) -> Result<Changed, OutOfRange> {
        let starts = self.starts();
        let len = starts.last().copied().unwrap_or(0);
        if range.start > range.end || range.end > len {
            return Err(OutOfRange);
        }
        // One chunk earlier than the edit: `\n` typed at the head of a chunk may join a `\r` at the end of the one before.
        let first = starts.partition_point(|start| *start <= range.start).saturating_sub(2);
        let last = starts.partition_point(|start| *start <= range.end).min(self.chunks.len());
        let base = starts.get(first).copied().unwrap_or(0);
        let mut text: String =
            self.chunks.get(first..last).unwrap_or_default().iter().map(AsRef::as_ref).collect();
        let local = range.start - base..range.end - base;
        if !text.is_char_boundary(local.start) || !text.is_char_boundary(local.end) {
            return Err(OutOfRange);
        }
        text.replace_range(local, insert);

        // Re-cut, taking in further old chunks until a new cut falls on an old one: from there on all cuts are the same.
        let mut end = last;
        let mut new = Vec::new();
        let mut at = 0;
        while at < text.len() {
            let len = next_cut(text.as_bytes().get(at..).unwrap_or_default());
            if at + len == text.len()
                && let Some(next) = self.chunks.get(end)
                && !ends_before(text.get(at..).unwrap_or_default(), next)
            {
                text.push_str(next);
                end += 1;
                continue;
            }
            new.push(Arc::from(text.get(at..at + len).unwrap_or_default()));
            at += len;
        }
        let changed = Changed { old: first..end, new: first..first + new.len() };
        self.chunks.splice(first..end, new);
        Ok(changed)
    }

    /// Start offsets of the chunks, and the length of the text at the end.
    fn starts(&self) -> Vec<usize> {
        let mut at = 0;
        let mut starts = Vec::with_capacity(self.chunks.len() + 1);
        for chunk in &self.chunks {
            starts.push(at);
            at += chunk.len();
        }
        starts.push(at);
        starts
    }
}

/// Would this chunk end here even with `next` after it, or does it only end for want of text?
fn ends_before(chunk: &str, next: &str) -> bool {
    let mut with_more = Vec::with_capacity(chunk.len() + 1);
    with_more.extend_from_slice(chunk.as_bytes());
    with_more.extend(next.bytes().next());
    next_cut(&with_more) == chunk.len()
}

#[cfg(test)]
mod tests {
    use super::line_len;

    #[test]
    fn a_line_is_as_long_as_byte_by_byte() {
        let slowly = |text: &str| match text.find(['\n', '\r']) {
            None => text.len(),
            Some(at) if text[at..].starts_with("\r\n") => at + 2,
            Some(at) => at + 1,
        };
        // Bytes on both sides of what a line may end with, at every place of the eight that are looked at together.
        let pieces = ["\n", "\r", "\r\n", "\t", "\0", "\u{B}", "\u{E}", "\u{8D}", "\u{10A}", "X"];
        for before in 0..20 {
            for first in pieces {
                for second in pieces {
                    let text = format!("{}{first}{second}{}", "X".repeat(before), "Y".repeat(before / 2));
                    assert_eq!(line_len(text.as_bytes()), slowly(&text), "{text:?}");
                }
            }
        }
        assert_eq!(line_len(b""), 0);
    }
}
