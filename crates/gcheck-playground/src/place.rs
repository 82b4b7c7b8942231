//! Places in a program as browsers count them: lines from 1, columns from 1 in units of UTF-16.
//!
//! Knows: lines of a document, units of UTF-16. Must not know: what is at a place.

use std::ops::Range;

use gcheck_db::Snapshot;
use serde::Serialize;

/// A place in the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1, in units of UTF-16.
    pub column: u32,
}

/// A part of the program; `end` is after its last character.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Span {
    /// Its start.
    pub start: Place,
    /// Its end.
    pub end: Place,
}

/// Bytes of the file as lines and columns.
pub(crate) fn span(snapshot: &Snapshot, bytes: &Range<u32>) -> Span {
    Span { start: place(snapshot, bytes.start), end: place(snapshot, bytes.end) }
}

fn place(snapshot: &Snapshot, offset: u32) -> Place {
    let line = snapshot.line_at(offset);
    let start = snapshot.line_range(line).start;
    let before = snapshot.slice(start..offset.max(start));
    Place { line: line + 1, column: before.encode_utf16().count() as u32 + 1 }
}

/// The byte at a line and a column. A place after the end of its line, or after the last line, is taken for that end.
pub(crate) fn offset(snapshot: &Snapshot, place: Place) -> u32 {
    let range = snapshot.line_range(place.line.saturating_sub(1));
    let text = snapshot.slice(range.clone());
    let mut units = 1;
    let before = text.chars().take_while(|c| {
        units += c.len_utf16() as u32;
        units <= place.column
    });
    range.start + before.map(|c| c.len_utf8() as u32).sum::<u32>()
}

#[cfg(test)]
mod tests {
    use gcheck_db::{Database, Settings, Snapshot};

    use super::{Place, offset, span};

    fn snapshot(text: &str) -> Snapshot {
        let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
        let mut database = Database::new();
        let id = database.open(text, Settings::new(control, gcheck_rules::RULES));
        database.snapshot(id).unwrap()
    }

    #[test]
    fn columns_count_units_of_utf_16() {
        let text = "G0 X1.\n(\u{1f527} \u{fc}) G1\r\nM30";
        let snapshot = snapshot(text);
        for (word, line, column) in [("X1.", 1, 4), ("G1", 2, 8), ("M30", 3, 1)] {
            let at = text.find(word).unwrap() as u32;
            let found = span(&snapshot, &(at..at + word.len() as u32));
            assert_eq!((found.start.line, found.start.column), (line, column), "{word}");
            assert_eq!((found.end.line, found.end.column), (line, column + word.len() as u32), "{word}");
            assert_eq!(offset(&snapshot, found.start), at);
        }
    }

    #[test]
    fn places_outside_the_text_are_at_an_end() {
        let snapshot = snapshot("G0 X1.\nM30");
        assert_eq!(offset(&snapshot, Place { line: 0, column: 0 }), 0);
        assert_eq!(offset(&snapshot, Place { line: 1, column: 99 }), 6);
        assert_eq!(offset(&snapshot, Place { line: 99, column: 1 }), 10);
        let nothing = self::snapshot("");
        assert_eq!(offset(&nothing, Place { line: 1, column: 1 }), 0);
    }
}
