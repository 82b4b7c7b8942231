//! Where the lines of a text begin.
//!
//! Knows: line ends (LF, CRLF, a lone CR). Must not know: blocks, columns.

/// Where each line begins, in bytes; the text after the last line end is a line too, even if it is empty.
pub fn line_starts(text: &str) -> Vec<u32> {
    let mut starts = vec![0];
    let mut rest = text.as_bytes();
    let mut at = 0;
    while !rest.is_empty() {
        let (line, after) = rest.split_at(gcheck_syntax::line_len(rest));
        at += line.len() as u32;
        if line.ends_with(b"\n") || line.ends_with(b"\r") {
            starts.push(at);
        }
        rest = after;
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::line_starts;

    #[test]
    fn every_line_end_begins_a_line() {
        for (text, starts) in
            [("", vec![0]), ("a", vec![0]), ("a\n", vec![0, 2]), ("a\r\nb\rc\n\nd", vec![0, 3, 5, 7, 8])]
        {
            assert_eq!(line_starts(text), starts, "{text:?}");
        }
    }
}
