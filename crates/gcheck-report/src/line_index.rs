//! Lines and columns of a text.
//!
//! Knows: byte offsets, line ends (LF, CRLF, a lone CR), Unicode scalar values. Must not know: findings, tokens.

use std::ops::Range;

use serde::Serialize;

/// Bytes between two counted places. A column costs at most one count of so many bytes, however long its line is.
const BLOCK: usize = 1_024;

/// A place in a text, as people and formats name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, schemars::JsonSchema)]
pub struct Position {
    /// From 1.
    pub line: u32,
    /// From 1, in Unicode scalar values.
    pub column: u32,
    /// In bytes, from 0.
    pub offset: u32,
}

/// Where the lines of a text begin, and how many scalar values are before every so many bytes.
///
/// Built in one pass. It does not hold the text: every question passes the text it was built from. A wrong text, or an
/// offset outside, gives wrong places but never a panic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LineIndex {
    starts: Vec<u32>,
    /// Scalar values before each block and, last, in all; empty if the text is ASCII and columns are bytes.
    scalars: Vec<u32>,
}

impl LineIndex {
    /// Reads a text of less than four gigabytes.
    pub fn new(text: &str) -> Self {
        let bytes = text.as_bytes();
        let mut starts = vec![0];
        let mut scalars = Vec::with_capacity(bytes.len() / BLOCK + 2);
        let mut total = 0_u32;
        for (block, base) in bytes.chunks(BLOCK).zip((0..).step_by(BLOCK)) {
            scalars.push(total);
            total += count_scalars(block);
            push_starts(bytes, block, base, &mut starts);
        }
        scalars.push(total);
        if total as usize == bytes.len() {
            scalars = Vec::new();
        }
        Self { starts, scalars }
    }

    /// Number of lines; the one after the last line end counts, though it may be empty.
    pub fn line_count(&self) -> u32 {
        self.starts.len() as u32
    }

    /// Line of an offset, from 1.
    pub fn line(&self, offset: u32) -> u32 {
        self.starts.partition_point(|start| *start <= offset) as u32
    }

    /// Line and column of an offset; one past the end gives the end, one inside a character gives the character.
    pub fn position(&self, text: &str, offset: u32) -> Position {
        let offset = text.floor_char_boundary(offset as usize) as u32;
        let line = self.line(offset);
        let start = self.starts.get(line as usize - 1).copied().unwrap_or(0);
        let column = self.scalars_before(text, offset).saturating_sub(self.scalars_before(text, start)) + 1;
        Position { line, column, offset }
    }

    /// Bytes of a line (from 1) without its end; empty at the end of the text for a line that does not exist.
    pub fn line_range(&self, text: &str, line: u32) -> Range<u32> {
        let length = text.len() as u32;
        let at = |index: usize| self.starts.get(index).copied().unwrap_or(length);
        let (start, end) = (at((line as usize).saturating_sub(1)), at(line as usize));
        let bytes = text.as_bytes().get(start as usize..end as usize).unwrap_or_default();
        let ending = match bytes {
            [.., b'\r', b'\n'] => 2,
            [.., b'\r' | b'\n'] => 1,
            _ => 0,
        };
        start..end - ending
    }

    fn scalars_before(&self, text: &str, offset: u32) -> u32 {
        let block = offset as usize / BLOCK;
        let Some(before) = self.scalars.get(block) else { return offset };
        before + count_scalars(text.as_bytes().get(block * BLOCK..offset as usize).unwrap_or_default())
    }
}

/// Adds the starts of lines after the line ends of a block, which begins at `base`.
///
/// Most files have no lone CR: looking for LF alone and then seeing that every CR was before one takes half the time of
/// looking for both.
fn push_starts(bytes: &[u8], block: &[u8], base: usize, starts: &mut Vec<u32>) {
    let known = starts.len();
    let mut returns = block.iter().map(|byte| u32::from(*byte == b'\r')).sum::<u32>();
    let next = bytes.get(base + block.len());
    for at in memchr::memchr_iter(b'\n', block) {
        starts.push((base + at + 1) as u32);
        returns -= u32::from(at > 0 && block.get(at - 1) == Some(&b'\r'));
    }
    returns -= u32::from(block.last() == Some(&b'\r') && next == Some(&b'\n'));
    if returns > 0 {
        starts.truncate(known);
        for at in memchr::memchr2_iter(b'\n', b'\r', block) {
            let after = base + at + 1;
            let half_of_crlf = block.get(at) == Some(&b'\r') && bytes.get(after) == Some(&b'\n');
            if !half_of_crlf {
                starts.push(after as u32);
            }
        }
    }
}

/// Every byte but the continuation bytes of UTF-8; a shape that the compiler turns into vector instructions.
fn count_scalars(bytes: &[u8]) -> u32 {
    bytes.iter().map(|byte| u32::from(byte & 0xC0 != 0x80)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(text: &str) -> Vec<(u32, u32)> {
        let index = LineIndex::new(text);
        let boundaries = text.char_indices().map(|(at, _)| at).chain([text.len()]);
        boundaries.map(|at| index.position(text, at as u32)).map(|p| (p.line, p.column)).collect()
    }

    #[test]
    fn every_line_end_counts_once() {
        assert_eq!(places("a\nb"), [(1, 1), (1, 2), (2, 1), (2, 2)]);
        assert_eq!(places("a\rb"), [(1, 1), (1, 2), (2, 1), (2, 2)]);
        assert_eq!(places("a\r\nb"), [(1, 1), (1, 2), (1, 3), (2, 1), (2, 2)]);
        assert_eq!(places("\n\r\r\n"), [(1, 1), (2, 1), (3, 1), (3, 2), (4, 1)]);
        assert_eq!(places(""), [(1, 1)]);
    }

    #[test]
    fn columns_count_scalar_values() {
        assert_eq!(places("µ日😀X").iter().map(|(_, c)| *c).collect::<Vec<_>>(), [1, 2, 3, 4, 5]);
        let index = LineIndex::new("µX");
        assert_eq!(index.position("µX", 1), Position { line: 1, column: 1, offset: 0 }, "inside µ");
        assert_eq!(index.position("µX", 99), Position { line: 1, column: 3, offset: 3 }, "past the end");
    }

    #[test]
    fn blocks_agree_with_counting() {
        for unit in ["G1 X1.\r\n", "µm 日本 😀", "a\r", "é\n", "\r\n", "a\r\nb\rc\n\n\r"] {
            let text = unit.repeat(4 * BLOCK / unit.len() + 1);
            let index = LineIndex::new(&text);
            let (mut line, mut column, mut previous) = (1, 1, ' ');
            for (at, c) in text.char_indices() {
                if previous == '\n' || (previous == '\r' && c != '\n') {
                    (line, column) = (line + 1, 1);
                }
                assert_eq!(index.position(&text, at as u32), Position { line, column, offset: at as u32 });
                (column, previous) = (column + 1, c);
            }
        }
        let whole_blocks = "é".repeat(BLOCK);
        let end = LineIndex::new(&whole_blocks).position(&whole_blocks, whole_blocks.len() as u32);
        assert_eq!(end.column as usize, BLOCK + 1, "the end falls on the edge of a block");
    }

    #[test]
    fn a_line_is_without_its_end() {
        let text = "a\r\nbc\rd\n";
        let index = LineIndex::new(text);
        let lines: Vec<_> = (1..=index.line_count() + 1)
            .map(|line| index.line_range(text, line))
            .map(|r| &text[r.start as usize..r.end as usize])
            .collect();
        assert_eq!(lines, ["a", "bc", "d", "", ""]);
    }
}
