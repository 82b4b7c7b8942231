//! What a growing selection takes in: word, block, section, program.
//!
//! Knows: what is around what. Must not know: cursors.

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_syntax::ast::Block;
use gcheck_syntax::{SyntaxKind, byte_range};

use crate::sections::sections_around;
use crate::symbols::{program_around, subs};

/// Ranges around `offset`, each inside the next: token, word or expression, block, line, operation, tool section or
/// subroutine, program, file.
pub fn selection_ranges(snapshot: &Snapshot, offset: u32) -> Vec<Range<u32>> {
    let offset = offset.min(snapshot.len());
    let mut ranges = inside_the_block(snapshot, offset);
    ranges.push(snapshot.line_range(snapshot.line_at(offset)));
    let mut around = sections_around(snapshot, offset);
    around.extend(subs(snapshot).into_iter().map(|sub| sub.range).filter(|range| range.contains(&offset)));
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
    let Some(tree) = snapshot.tree_at(offset) else { return Vec::new() };
    let is_blank = |kind| matches!(kind, SyntaxKind::WHITESPACE | SyntaxKind::NEWLINE | SyntaxKind::BOM);
    // Between a word and a blank the word is meant.
    let token =
        tree.token_before(offset).filter(|token| !is_blank(token.kind())).or_else(|| tree.token_at(offset));
    let Some(token) = token.filter(|token| !is_blank(token.kind())) else { return Vec::new() };
    let nodes = token.parent_ancestors();
    let nodes = nodes.take_while(|node| Block::cast(node.clone()).is_none());
    let around = std::iter::once(token.text_range()).chain(nodes.map(|node| node.text_range()));
    around.map(|range| tree.in_file(byte_range(range))).collect()
}

#[cfg(test)]
mod tests {
    use std::ops::Range;

    use expect_test::{Expect, expect};

    use super::selection_ranges;
    use crate::fixture::{Fixture, shown};
    use crate::sections::{sections, sections_around};

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

    /// Tools, comments and moves in every order, cut into chunks of their own lines.
    fn program(seed: usize) -> String {
        let mut text = "%\nO1\n".to_owned();
        let mut number = seed.wrapping_mul(0x9E37_79B9) | 1;
        for line in 0..1_500 {
            number = number.wrapping_mul(1_103_515_245).wrapping_add(12_345) & 0x7FFF_FFFF;
            text += match number / 65_536 % 400 {
                0 => "T1 M6\n",
                1 => "(OPERATION)\n",
                2 => "(ABOVE)\n(THE CHANGE)\nT2 M6\n",
                3 => "O2\n",
                4 => "M8 (COOLANT)\n",
                5 => "T3\n",
                _ => "X1.5 Y2.25\n",
            };
            if line == 900 && seed.is_multiple_of(2) {
                text += "M30\n%\n";
            }
        }
        text
    }

    #[test]
    fn what_is_around_a_place_is_what_a_look_at_the_whole_file_finds() {
        for seed in 0..6 {
            let snapshot = Fixture::new("haas-mill", &program(seed)).snapshot();
            let sections = sections(&snapshot);
            let all: Vec<Range<u32>> = sections
                .operations
                .into_iter()
                .map(|part| part.range)
                .chain(sections.tools.into_iter().map(|part| part.range))
                .collect();
            for offset in (0..snapshot.len()).step_by(97) {
                let around: Vec<&Range<u32>> = all.iter().filter(|range| range.contains(&offset)).collect();
                let found = sections_around(&snapshot, offset);
                assert_eq!(found.iter().collect::<Vec<_>>(), around, "seed {seed}, byte {offset}");
            }
        }
    }

    #[test]
    fn a_place_costs_its_tool_section_not_the_file() {
        let section = |tool: usize| format!("T{tool} M6\n(OPERATION)\n{}", "X1.5 Y2.25\n".repeat(300));
        let text: String = (1..200).map(section).collect();
        let mut fixture = Fixture::new("haas-mill", &text);
        let snapshot = fixture.database.indexed(fixture.document).unwrap();
        let ranges = selection_ranges(&snapshot, snapshot.len() / 2);
        assert!(ranges.iter().any(|range| range.end - range.start < 6_000), "{ranges:?}");
        assert!(snapshot.tables_read() < 10, "{} of {}", snapshot.tables_read(), snapshot.chunks().len());
    }
}
