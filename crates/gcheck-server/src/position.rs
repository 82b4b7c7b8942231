//! Places in a document: bytes here, lines and columns of some unit at the client.
//!
//! Knows: position encodings, what the protocol says of positions that a text does not have. Must not know: documents.

use std::ops::Range;

use gcheck_db::Snapshot;

use crate::proto::{self, Position, PositionEncodingKind};

/// In what columns are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Encoding {
    /// In bytes.
    Utf8,
    /// In units of UTF-16, which every client knows.
    #[default]
    Utf16,
}

impl Encoding {
    /// The best that a client offers.
    pub(crate) fn choose(offered: Option<&[PositionEncodingKind]>) -> Self {
        let has_utf8 = offered.is_some_and(|kinds| kinds.contains(&PositionEncodingKind::UTF8));
        if has_utf8 { Self::Utf8 } else { Self::Utf16 }
    }

    /// Its name in the protocol.
    pub(crate) fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
        }
    }

    fn columns(self, text: &str) -> u32 {
        let columns = match self {
            Self::Utf8 => text.len(),
            Self::Utf16 if text.is_ascii() => text.len(),
            Self::Utf16 => text.chars().map(char::len_utf16).sum(),
        };
        columns as u32
    }

    /// Bytes before a column; the whole text when it has fewer. A column inside a character is taken for its start.
    fn bytes(self, text: &str, column: u32) -> u32 {
        let column = column as usize;
        let bytes = match self {
            Self::Utf8 => text.floor_char_boundary(column),
            Self::Utf16 if text.is_ascii() => column.min(text.len()),
            Self::Utf16 => {
                let mut units = 0;
                let behind = text.char_indices().find(|(_, c)| {
                    units += c.len_utf16();
                    units > column
                });
                behind.map_or(text.len(), |(at, _)| at)
            }
        };
        bytes as u32
    }
}

/// Translates places of one document. Places in text order are found fastest, however long the lines are.
#[derive(Debug)]
pub(crate) struct Places<'s> {
    snapshot: &'s Snapshot,
    encoding: Encoding,
    last: Option<Last>,
}

/// The place that was found last.
#[derive(Debug)]
struct Last {
    line: u32,
    /// Bytes of the line without its end.
    bytes: Range<u32>,
    offset: u32,
    column: u32,
}

impl<'s> Places<'s> {
    pub(crate) fn new(snapshot: &'s Snapshot, encoding: Encoding) -> Self {
        Self { snapshot, encoding, last: None }
    }

    /// The position of a byte. One after the text is its end, one inside a line's end is before it.
    pub(crate) fn position(&mut self, offset: u32) -> Position {
        let known = self.last.take().filter(|last| last.bytes.start <= offset && offset <= last.bytes.end);
        let mut last = known.unwrap_or_else(|| {
            let line = self.snapshot.line_at(offset.min(self.snapshot.len()));
            let bytes = self.snapshot.line_range(line);
            Last { line, offset: bytes.start, bytes, column: 0 }
        });
        let offset = offset.clamp(last.bytes.start, last.bytes.end);
        if offset < last.offset {
            last = Last { offset: last.bytes.start, column: 0, ..last };
        }
        let between = self.before(last.offset, offset);
        last.column += self.encoding.columns(&between);
        last.offset += between.len() as u32;
        let position = Position::new(last.line, last.column);
        self.last = Some(last);
        position
    }

    /// The text between two bytes, where the second may be inside a character, which is then left out.
    fn before(&self, start: u32, end: u32) -> std::borrow::Cow<'s, str> {
        let mut end = end;
        loop {
            let text = self.snapshot.slice(start..end);
            if !text.is_empty() || end <= start {
                return text;
            }
            end -= 1;
        }
    }

    /// The range of some bytes.
    pub(crate) fn range(&mut self, bytes: &Range<u32>) -> proto::Range {
        let start = self.position(bytes.start);
        proto::Range { start, end: self.position(bytes.end.max(bytes.start)) }
    }

    /// The byte at a position. A column after a line is its end, a line after the text is the end of that.
    pub(crate) fn offset(&self, position: Position) -> u32 {
        if position.line >= self.snapshot.line_count() {
            return self.snapshot.len();
        }
        let line = self.snapshot.line_range(position.line);
        line.start + self.encoding.bytes(&self.snapshot.slice(line), position.character)
    }

    /// The bytes of a range; one that ends before it begins is turned round.
    pub(crate) fn bytes(&self, range: proto::Range) -> Range<u32> {
        let (start, end) = (self.offset(range.start), self.offset(range.end));
        start.min(end)..start.max(end)
    }
}

/// The range of some bytes of a text that is not a document.
pub(crate) fn range_in(text: &str, bytes: &Range<usize>, encoding: Encoding) -> proto::Range {
    let position = |offset: usize| {
        let before = text.get(..offset).unwrap_or(text);
        let line = before.rfind('\n').map_or(before, |end| before.get(end + 1..).unwrap_or_default());
        let lines = before.bytes().filter(|byte| *byte == b'\n').count();
        Position::new(lines as u32, encoding.columns(line))
    };
    proto::Range { start: position(bytes.start), end: position(bytes.end) }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use gcheck_db::{Database, Settings, Snapshot};

    use super::{Encoding, Places};
    use crate::proto::{Position, PositionEncodingKind, Range};

    fn snapshot(text: &str) -> Snapshot {
        let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
        let mut database = Database::new();
        let id = database.open(text, Settings::new(control, gcheck_rules::RULES));
        database.snapshot(id).unwrap()
    }

    const TEXT: &str = "G0 X1.\r\n(µ 日本 😀) G1\rM30\n";

    /// Line and column of every character of [`TEXT`], and of its end.
    fn columns(encoding: Encoding) -> String {
        let snapshot = snapshot(TEXT);
        let mut places = Places::new(&snapshot, encoding);
        let mut out = String::new();
        for (at, c) in TEXT.char_indices().chain([(TEXT.len(), '.')]) {
            let Position { line, character } = places.position(at as u32);
            writeln!(out, "{line}:{character} {}", c.escape_debug()).unwrap();
            if !matches!(c, '\n' | '\r') || TEXT[at..].starts_with('\r') {
                assert_eq!(places.offset(Position { line, character }) as usize, at, "{c:?}");
            }
        }
        out
    }

    #[test]
    fn columns_are_counted_in_bytes_or_in_units_of_utf_16() {
        expect_test::expect![[r#"
            0:0 G
            0:1 0
            0:2  
            0:3 X
            0:4 1
            0:5 .
            0:6 \r
            0:6 \n
            1:0 (
            1:1 µ
            1:3  
            1:4 日
            1:7 本
            1:10  
            1:11 😀
            1:15 )
            1:16  
            1:17 G
            1:18 1
            1:19 \r
            2:0 M
            2:1 3
            2:2 0
            2:3 \n
            3:0 .
        "#]]
        .assert_eq(&columns(Encoding::Utf8));
        expect_test::expect![[r#"
            0:0 G
            0:1 0
            0:2  
            0:3 X
            0:4 1
            0:5 .
            0:6 \r
            0:6 \n
            1:0 (
            1:1 µ
            1:2  
            1:3 日
            1:4 本
            1:5  
            1:6 😀
            1:8 )
            1:9  
            1:10 G
            1:11 1
            1:12 \r
            2:0 M
            2:1 3
            2:2 0
            2:3 \n
            3:0 .
        "#]]
        .assert_eq(&columns(Encoding::Utf16));
    }

    #[test]
    fn places_in_any_order_are_the_same() {
        let snapshot = snapshot(TEXT);
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            let mut places = Places::new(&snapshot, encoding);
            for first in 0..=TEXT.len() as u32 + 3 {
                for second in 0..=TEXT.len() as u32 + 3 {
                    places.position(first);
                    let fresh = Places::new(&snapshot, encoding).position(second);
                    assert_eq!(places.position(second), fresh, "{first} then {second}");
                }
            }
        }
    }

    #[test]
    fn what_the_text_does_not_have_is_the_nearest_that_it_has() {
        let snapshot = snapshot(TEXT);
        let places = Places::new(&snapshot, Encoding::Utf16);
        let text = |range| &TEXT[places.bytes(range).start as usize..places.bytes(range).end as usize];
        let range = |a, b, c, d| Range::new(Position::new(a, b), Position::new(c, d));
        assert_eq!(text(range(0, 3, 0, 99)), "X1.", "after a line is its end");
        assert_eq!(text(range(2, 0, 99, 0)), "M30\n", "after the text is its end");
        assert_eq!(text(range(1, 1, 0, 3)), "X1.\r\n(", "the wrong way round");
        assert_eq!(text(range(1, 6, 1, 7)), "", "half a character is taken for its start");
        assert_eq!(text(range(1, 6, 1, 8)), "😀");
    }

    #[test]
    fn many_places_of_a_very_long_line_are_found_in_time() {
        let snapshot = snapshot(&"X1.µ".repeat(1_000_000));
        let mut places = Places::new(&snapshot, Encoding::Utf16);
        for place in 0..1_000 {
            assert_eq!(places.position(place * 5_000).character, place * 4_000);
        }
    }

    #[test]
    fn bytes_are_counted_where_the_client_can() {
        let both = [PositionEncodingKind::UTF16, PositionEncodingKind::UTF8];
        assert_eq!(Encoding::choose(Some(&both)), Encoding::Utf8);
        assert_eq!(Encoding::choose(Some(&[PositionEncodingKind::UTF32])), Encoding::Utf16);
        assert_eq!(Encoding::choose(None), Encoding::Utf16);
    }
}
