//! How many characters of a line count where a control reads only so many.
//!
//! Knows: blanks, comments and signs. Must not know: any limit.

use gcheck_controls::LineCounts;

/// The characters of a line that count.
pub fn counted_characters(line: &str, counts: LineCounts) -> usize {
    places_that_count(line, counts).count()
}

/// Where the characters of a line that count begin, in bytes of the line.
pub fn places_that_count(line: &str, counts: LineCounts) -> impl Iterator<Item = usize> {
    let mut in_comment = false;
    let mut at_end = false;
    line.char_indices().filter_map(move |(at, c)| {
        if counts == LineCounts::Everything {
            return Some(at);
        }
        let in_brackets = in_comment || c == '(';
        in_comment = in_brackets && c != ')';
        at_end |= c == ';' && !in_brackets;
        (!in_brackets && !at_end && c > ' ' && c != '/').then_some(at)
    })
}

#[cfg(test)]
mod tests {
    use gcheck_controls::LineCounts;

    use super::counted_characters;

    #[test]
    fn comments_and_blanks_count_only_where_everything_does() {
        for (line, everything, code) in
            [("G1 X1.5 Y2", 10, 8), ("/G1 (a; b) X1 ; to the end (", 28, 4), ("(é)", 3, 0), ("", 0, 0)]
        {
            assert_eq!(counted_characters(line, LineCounts::Everything), everything, "{line}");
            assert_eq!(counted_characters(line, LineCounts::Code), code, "{line}");
        }
    }
}
