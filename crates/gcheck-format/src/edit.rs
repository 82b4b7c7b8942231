//! Edits, and a text with edits in it.
//!
//! Knows: bytes. Must not know: why a text is edited.

use std::ops::Range;

/// A part of a text and what is to stand in its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// Bytes of the text; empty where something is inserted.
    pub range: Range<u32>,
    /// What is to stand there; empty where something is taken away.
    pub text: String,
}

/// The text with the edits in it. They must be in order, apart from each other and on character boundaries of the text, as
/// those of [`format`](crate::format) and [`renumber`](crate::renumber) are; one that is not is left out.
pub fn apply(text: &str, edits: &[Edit]) -> String {
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for Edit { range, text: new } in edits {
        let (start, end) = (range.start as usize, range.end as usize);
        let Some(before) = text.get(at..start) else { continue };
        if text.get(start..end).is_none() {
            continue;
        }
        out.push_str(before);
        out.push_str(new);
        at = end;
    }
    out.push_str(text.get(at..).unwrap_or_default());
    out
}

/// The same for the bytes of a file, some of which may be no UTF-8: edits of its
/// [text](gcheck_syntax::SourceText::text) stand at the same offsets.
pub fn apply_to_bytes(bytes: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut out = Vec::with_capacity(bytes.len());
    let mut at = 0;
    for Edit { range, text: new } in edits {
        let (start, end) = (range.start as usize, range.end as usize);
        let Some(before) = bytes.get(at..start) else { continue };
        if bytes.get(start..end).is_none() {
            continue;
        }
        out.extend_from_slice(before);
        out.extend_from_slice(new.as_bytes());
        at = end;
    }
    out.extend_from_slice(bytes.get(at..).unwrap_or_default());
    out
}

#[cfg(test)]
mod tests {
    use super::{Edit, apply, apply_to_bytes};

    #[test]
    fn edits_replace_insert_and_take_away() {
        let edit = |range, text: &str| Edit { range, text: text.to_owned() };
        let edits = [edit(0..1, "N1"), edit(2..2, " "), edit(4..6, "")];
        assert_eq!(apply("nAXB  C", &edits), "N1A XBC");
        assert_eq!(apply_to_bytes(b"nA\xFFB  C", &edits), b"N1A \xFFBC");
    }

    #[test]
    fn an_edit_that_does_not_fit_is_left_out() {
        let edit = |range, text: &str| Edit { range, text: text.to_owned() };
        let edits = [edit(1..2, "x"), edit(0..1, "y"), edit(1..9, "z")];
        assert_eq!(apply("abc", &edits), "axc");
        assert_eq!(apply_to_bytes(b"abc", &edits), b"axc");
    }
}
