//! Edits of a text, and how they are applied.
//!
//! Knows: bytes. Must not know: why a text is edited.

use std::ops::Range;

/// A replacement of bytes: part of a fix, of formatting, of an action in an editor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// The bytes that are replaced; empty for an insertion.
    pub range: Range<u32>,
    /// What replaces them; empty for a deletion.
    pub text: String,
}

/// The text with the edits applied. They must be sorted, must not overlap, and must lie on character boundaries; an edit that
/// does not is left out.
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

/// As [`apply`], on the bytes of a file that may not be UTF-8. The edits are those of a text in which every byte that is not
/// UTF-8 is one character of one byte, so that offsets are equal.
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
    fn edits_replace_insert_and_delete() {
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
