//! The text of a program on disk, in two forms: as it is analysed, and as people read it.
//!
//! Knows: bytes that are not UTF-8, and the characters that old code pages mean by them. Must not know: files.

use std::ops::Range;

/// A program's text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ProgramText {
    /// With a stand-in of one byte for each byte that is not UTF-8: offsets are those of the file.
    pub text: String,
    /// Offsets of the stand-ins and the bytes that they stand for, ascending.
    pub replaced: Vec<(u32, u8)>,
}

impl ProgramText {
    /// As people read it: bytes that are not UTF-8 are taken for Latin-1, which most old programs are written in. Its lines and
    /// characters are those of the text, its offsets are not: see [`Widened`].
    pub(crate) fn readable(&self) -> String {
        let mut text = String::with_capacity(self.text.len() + self.replaced.len());
        let mut from = 0;
        for (at, byte) in &self.replaced {
            let at = *at as usize;
            text.push_str(self.text.get(from..at).unwrap_or_default());
            text.push(character(*byte));
            from = at + 1;
        }
        text + self.text.get(from..).unwrap_or_default()
    }

    /// What it takes to find places of the text in its readable form.
    pub(crate) fn widened(&self) -> Widened {
        let mut total = 0;
        let widened = self.replaced.iter().map(|(at, byte)| {
            total += character(*byte).len_utf8() as u32 - 1;
            (*at, total)
        });
        Widened(widened.collect())
    }
}

/// Where the readable form of a text is longer: offsets of stand-ins, and the bytes more up to there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Widened(Vec<(u32, u32)>);

impl Widened {
    /// Bytes of the readable form.
    pub(crate) fn range(&self, bytes: &Range<u32>) -> Range<u32> {
        self.offset(bytes.start)..self.offset(bytes.end)
    }

    fn offset(&self, offset: u32) -> u32 {
        let before = self.0.partition_point(|(at, _)| *at < offset);
        offset + before.checked_sub(1).and_then(|last| self.0.get(last)).map_or(0, |(_, more)| *more)
    }
}

/// What a byte means in Latin-1; the control characters there are letters of other code pages, and nobody knows which.
fn character(byte: u8) -> char {
    match byte {
        0x80..=0x9F => char::REPLACEMENT_CHARACTER,
        other => char::from(other),
    }
}

#[cfg(test)]
mod tests {
    use super::ProgramText;

    #[test]
    fn places_are_found_in_the_readable_form() {
        let text =
            ProgramText { text: "(f\u{1a}r\u{1a}) T1".to_owned(), replaced: vec![(2, 0xFC), (4, 0x81)] };
        let readable = text.readable();
        assert_eq!(readable, "(für\u{fffd}) T1");
        let widened = text.widened();
        for (bytes, part) in [(0..2, "(f"), (2..3, "ü"), (3..4, "r"), (4..5, "\u{fffd}"), (7..9, "T1")] {
            let range = widened.range(&bytes);
            assert_eq!(&readable[range.start as usize..range.end as usize], part);
        }
    }

    #[test]
    fn plain_text_stays_as_it_is() {
        let text = ProgramText { text: "G0 X1.\n".to_owned(), replaced: Vec::new() };
        assert_eq!((text.readable(), text.widened().range(&(3..5))), (text.text.clone(), 3..5));
    }
}
