//! Any bytes are a text whose tree is the text.
//!
//! Knows: decoding, cutting, tokens, trees. Must not know: controls.

use gcheck_program::{code_region, collect_evidence, control_comment};
use gcheck_syntax::{SourceText, SyntaxProfile, count_tokens, cut, parse};

pub(crate) fn run(bytes: &[u8]) {
    let Ok(source) = SourceText::from_bytes(bytes.to_vec()) else { return };
    assert_eq!(source.to_bytes(), bytes, "decoding loses bytes");
    let text = source.text();
    let mut at = 0;
    for chunk in cut(text) {
        assert_eq!(chunk.start, at, "chunks follow each other");
        at = chunk.end;
    }
    assert_eq!(at, text.len(), "chunks are the whole text");
    for profile in [SyntaxProfile::MACRO_B, SyntaxProfile::NGC] {
        let parsed = parse(text, profile);
        assert_eq!(parsed.syntax().text().to_string(), text, "the tree is the text");
        for error in parsed.errors() {
            let range = error.range.start as usize..error.range.end as usize;
            assert!(text.get(range).is_some(), "{error:?} is not in the text");
        }
    }
    let _ = count_tokens(text, false);
    let region = code_region(text);
    assert!(text.get(region.clone()).is_some(), "{region:?} is not in the text");
    let _ = collect_evidence(text);
    let _ = control_comment(text);
}
