//! The syntax tree as text, for people who work on gcheck.
//!
//! Knows: how a tree is printed. Must not know: what nodes mean.

use std::fmt::Write as _;

use gcheck_db::Snapshot;
use gcheck_syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

/// More text than this is not printed: nobody reads it.
const MOST_BYTES: usize = 4 << 20;

/// The tree of the block at `offset`, or of the whole document, one node or token a line: kind, bytes of the file, and the
/// text of a token. Mistakes in form are at the end of their chunk.
pub fn syntax_tree(snapshot: &Snapshot, offset: Option<u32>) -> String {
    let mut out = String::new();
    for chunk in snapshot.chunks() {
        let end = chunk.base + chunk.text.len() as u32;
        let is_last = end == snapshot.len();
        if offset.is_some_and(|at| at < chunk.base || at > end || at == end && !is_last) {
            continue;
        }
        let Some(parse) = snapshot.tree(chunk.index) else { continue };
        let root = parse.syntax();
        match offset {
            None => node(&root, chunk.base, 0, &mut out),
            Some(at) => {
                let holds = |block: &SyntaxNode| {
                    let (start, end): (u32, u32) =
                        (block.text_range().start().into(), block.text_range().end().into());
                    start + chunk.base <= at && (at < end + chunk.base || is_last)
                };
                let block =
                    root.children().filter(|node| node.kind() == SyntaxKind::BLOCK).filter(holds).last();
                if let Some(block) = block {
                    node(&block, chunk.base, 0, &mut out);
                }
            }
        }
        for error in parse.errors().iter().filter(|_| offset.is_none()) {
            let (start, end) = (error.range.start + chunk.base, error.range.end + chunk.base);
            // Writing to a string cannot fail.
            let _ = writeln!(out, "error {start}..{end} {:?}", error.kind);
        }
        if out.len() > MOST_BYTES {
            out.push_str("…\n");
            break;
        }
    }
    out
}

fn node(node: &SyntaxNode, base: u32, depth: usize, out: &mut String) {
    let range = |start: u32, end: u32| format!("{}..{}", start + base, end + base);
    let own = node.text_range();
    let indent = depth * 2;
    let _ = writeln!(out, "{:indent$}{:?} {}", "", node.kind(), range(own.start().into(), own.end().into()));
    for child in node.children_with_tokens() {
        match child {
            SyntaxElement::Node(inner) => self::node(&inner, base, depth + 1, out),
            SyntaxElement::Token(token) => {
                let own = token.text_range();
                let range = range(own.start().into(), own.end().into());
                let _ = writeln!(out, "{:indent$}  {:?} {range} {:?}", "", token.kind(), token.text());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::syntax_tree;
    use crate::fixture::Fixture;

    #[test]
    fn nodes_and_tokens_with_their_bytes() {
        let fixture = Fixture::new("haas-mill", "G0 X1.\n#1=[2\nM30$0\n");
        expect![[r##"
            CHUNK 0..17
              BLOCK 0..7
                WORD 0..2 "G0"
                WHITESPACE 2..3 " "
                WORD 3..6 "X1."
                NEWLINE 6..7 "\n"
              BLOCK 7..13
                ASSIGNMENT 7..12
                  VARIABLE 7..9 "#1"
                  EQUALS 9..10 "="
                  GROUP 10..12
                    L_BRACKET 10..11 "["
                    NUMBER 11..12 "2"
                NEWLINE 12..13 "\n"
              BLOCK 13..17
                WORD 13..16 "M30"
                NEWLINE 16..17 "\n"
            error 10..11 UnclosedBracket
        "##]]
        .assert_eq(&syntax_tree(&fixture.snapshot(), None));
        expect![[r#"
            BLOCK 13..17
              WORD 13..16 "M30"
              NEWLINE 16..17 "\n"
        "#]]
        .assert_eq(&syntax_tree(&fixture.snapshot(), Some(fixture.offset)));
    }
}
