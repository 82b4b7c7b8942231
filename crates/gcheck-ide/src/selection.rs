//! What a growing selection takes in: word, block, section, program.
//!
//! Knows: what stands around what. Must not know: cursors.

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_syntax::SyntaxKind;

use crate::parts::parts;
use crate::things::{program_around, subs};

/// Ranges around `offset`, each inside the next: token, word or expression, block, line, operation, tool section or
/// subroutine, program, file.
pub fn selection_ranges(snapshot: &Snapshot, offset: u32) -> Vec<Range<u32>> {
    let offset = offset.min(snapshot.len());
    let mut ranges = inside_the_block(snapshot, offset);
    ranges.push(snapshot.line_range(snapshot.line_at(offset)));
    let parts = parts(snapshot);
    let operations = parts.operations.into_iter().map(|part| part.range);
    let tools = parts.tools.into_iter().map(|part| part.range);
    let subs = subs(snapshot).into_iter().map(|sub| sub.range);
    let mut around: Vec<Range<u32>> =
        operations.chain(tools).chain(subs).filter(|range| range.contains(&offset)).collect();
    around.push(program_around(snapshot, offset));
    around.push(0..snapshot.len());
    around.sort_by_key(|range| range.end - range.start);
    ranges.extend(around);
    let mut nested: Vec<Range<u32>> = Vec::new();
    for range in ranges {
        let grows = nested.last().is_none_or(|last| {
            range.start <= last.start
                && last.end <= range.end
                && (range.start, range.end) != (last.start, last.end)
        });
        if grows && range.start <= offset && offset <= range.end {
            nested.push(range);
        }
    }
    nested
}

fn inside_the_block(snapshot: &Snapshot, offset: u32) -> Vec<Range<u32>> {
    let found = snapshot.chunk_at(offset).and_then(|chunk| Some((chunk.base, snapshot.tree(chunk.index)?)));
    let Some((base, tree)) = found else { return Vec::new() };
    let root = tree.syntax();
    let inside = (offset - base).min(root.text_range().end().into());
    let tokens = root.token_at_offset(inside.into());
    // Between a word and a blank the word is meant.
    let left =
        tokens.clone().left_biased().filter(|token| !token.kind().is_trivia() || token.kind().is_comment());
    let Some(token) = left.or_else(|| tokens.right_biased()) else { return Vec::new() };
    if matches!(token.kind(), SyntaxKind::WHITESPACE | SyntaxKind::NEWLINE) {
        return Vec::new();
    }
    let in_file = |range: Range<u32>| base + range.start..base + range.end;
    let own = in_file(token.text_range().start().into()..token.text_range().end().into());
    let mut ranges = vec![own];
    let nodes =
        token.parent_ancestors().filter(|node| !matches!(node.kind(), SyntaxKind::CHUNK | SyntaxKind::BLOCK));
    ranges
        .extend(nodes.map(|node| in_file(node.text_range().start().into()..node.text_range().end().into())));
    ranges
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::selection_ranges;
    use crate::fixture::{Fixture, shown};

    fn check(control: &str, text: &str, expected: &Expect) {
        let fixture = Fixture::new(control, text);
        let snapshot = fixture.snapshot();
        let ranges = selection_ranges(&snapshot, fixture.offset);
        expected.assert_eq(&ranges.iter().map(|range| shown(&snapshot, range) + "\n").collect::<String>());
    }

    #[test]
    fn from_a_word_to_the_file() {
        let text = "%\nO1\nT1 M6\n(SLOT)\nG1 X1.$05 Y2.\nX3.\nT2 M6\nM30\nO2\nM99\n%\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            5: X1.5
            5: G1 X1.5 Y2.
            4: (SLOT)⏎G1 X1.5 Y2.⏎X3.⏎
            3: T1 M6⏎(SLOT)⏎G1 X1.5 Y2.⏎X3.⏎
            1: %⏎O1⏎T1 M6⏎(SLOT)⏎G1 X1.5 Y2.⏎X3.⏎T2 M6⏎M30⏎
            1: %⏎O1⏎T1 M6⏎(SLOT)⏎G1 X1.5 Y2.⏎X3.⏎T2 M6⏎M30⏎O2⏎M99⏎%⏎
        "#]],
        );
    }

    #[test]
    fn inside_an_expression() {
        check(
            "haas-mill",
            "G0 X[#1+[#2*3.$0]]\n",
            &expect![[r#"
            1: 3.
            1: #2*3.
            1: [#2*3.]
            1: #1+[#2*3.]
            1: [#1+[#2*3.]]
            1: X[#1+[#2*3.]]
            1: G0 X[#1+[#2*3.]]
            1: G0 X[#1+[#2*3.]]⏎
        "#]],
        );
    }

    #[test]
    fn a_comment_and_nothing() {
        check(
            "haas-mill",
            "G0 (CLE$0AR) X1.\n",
            &expect![[r#"
            1: (CLEAR)
            1: G0 (CLEAR) X1.
            1: G0 (CLEAR) X1.⏎
        "#]],
        );
        check(
            "haas-mill",
            "",
            &expect![[r#"
            1: 
        "#]],
        );
    }
}
