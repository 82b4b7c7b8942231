//! Formatting a document, some of its lines, or the line just typed.
//!
//! Knows: which lines are meant. Must not know: what well-formatted means (`gcheck-format` does).

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_diagnostics::Edit;
use gcheck_format::Style;

/// Characters that finish a line.
pub const FORMAT_TRIGGERS: &[&str] = &["\n"];

/// Edits that format the document, or the lines that a range touches, in text order, as is customary on its control.
pub fn format(snapshot: &Snapshot, range: Option<Range<u32>>) -> Vec<Edit> {
    format_in(snapshot, &Style::of(snapshot.control()), range)
}

/// As [`format`], in a style.
pub fn format_in(snapshot: &Snapshot, style: &Style, range: Option<Range<u32>>) -> Vec<Edit> {
    let lines = range.map(|range| {
        let first = snapshot.line_at(range.start);
        let last = snapshot.line_at(range.end.max(range.start));
        // A selection that ends where a line begins does not hold the line.
        let whole = last > first && snapshot.line_range(last).start == range.end;
        first..if whole { last } else { last + 1 }
    });
    format_lines(snapshot, style, lines)
}

/// Edits that format what was finished by typing a character of [`FORMAT_TRIGGERS`]; `offset` is after it.
pub fn format_on_type(snapshot: &Snapshot, offset: u32) -> Vec<Edit> {
    format_on_type_in(snapshot, &Style::of(snapshot.control()), offset)
}

/// As [`format_on_type`], in a style.
pub fn format_on_type_in(snapshot: &Snapshot, style: &Style, offset: u32) -> Vec<Edit> {
    match snapshot.line_at(offset).checked_sub(1) {
        Some(line) => format_lines(snapshot, style, Some(line..line + 1)),
        None => Vec::new(),
    }
}

fn format_lines(snapshot: &Snapshot, style: &Style, lines: Option<Range<u32>>) -> Vec<Edit> {
    // What is written for another control must not be rewritten.
    if snapshot.settings().unsupported.is_some() {
        return Vec::new();
    }
    gcheck_format::format(&snapshot.text(), &snapshot.dialect(), style, lines)
}

#[cfg(test)]
mod tests {
    use gcheck_db::Settings;

    use super::{format, format_on_type};
    use crate::fixture::{Fixture, applied};

    #[test]
    fn a_program_of_another_dialect_stays_as_it_is() {
        let mut settings = Settings::new(gcheck_controls::load("generic-mill").unwrap(), gcheck_rules::RULES);
        let text = "%00214\nN0 T1.1\nN10   M6\n";
        let edits = |settings: &Settings| format(&Fixture::with(text, settings).snapshot(), None);
        assert!(!edits(&settings).is_empty());
        settings.unsupported = gcheck_controls::unsupported_dialect(text, None);
        assert_eq!(edits(&settings), []);
    }

    #[test]
    fn a_document_some_lines_and_the_line_just_typed() {
        let text = "G1X1.  Y2.\nG1X3.\nG1X4.\n";
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        assert_eq!(applied(text, &format(&snapshot, None)), "G1 X1. Y2.\nG1 X3.\nG1 X4.\n");
        assert_eq!(applied(text, &format(&snapshot, Some(11..17))), "G1X1.  Y2.\nG1 X3.\nG1X4.\n");
        assert_eq!(applied(text, &format_on_type(&snapshot, 11)), "G1 X1. Y2.\nG1X3.\nG1X4.\n");
        assert!(format_on_type(&snapshot, 0).is_empty());
    }
}
