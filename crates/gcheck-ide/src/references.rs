//! Where a symbol is named.
//!
//! Knows: which places count as references. Must not know: how symbols are found in the text.

use std::ops::Range;

use gcheck_db::DocumentId;

use crate::configured::configured_words;
use crate::symbols::{Occurrence, ReferenceKind, occurrences, returned_to, symbol_at};
use crate::tool_words::{tool_word_at, tool_words};
use crate::{Place, Workspace};

/// A place that names a symbol.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reference {
    /// The name.
    pub place: Place,
    /// What the place does with it.
    pub kind: ReferenceKind,
}

/// All places that name the symbol at `offset`, by file and text order; those that define it only with `declarations`.
///
/// Variables that keep their values until power off are looked for in the files that calls join with this one, those that the
/// control keeps longer in all files.
pub fn references(
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    declarations: bool,
) -> Vec<Reference> {
    let Some(file) = workspace.file(document) else { return Vec::new() };
    let named = match symbol_at(&file.snapshot, offset) {
        Some(occurrence) => vec![(document, occurrence)],
        None => returned_to(workspace, file, offset),
    };
    if named.is_empty()
        && let Some(word) = tool_word_at(&file.snapshot, offset)
    {
        let words = tool_words(&file.snapshot, word.letter, word.number).into_iter();
        let place = |range| Place { file: document, range };
        return words.map(|word| Reference { place: place(word.range), kind: ReferenceKind::Read }).collect();
    }
    if named.is_empty() {
        let words = configured_words(&file.snapshot, offset).into_iter();
        let place = |range| Place { file: document, range };
        return words.map(|range| Reference { place: place(range), kind: ReferenceKind::Read }).collect();
    }
    let all = named.iter().flat_map(|(owner, named)| occurrences(workspace, *owner, &named.symbol));
    let mut seen: Vec<(DocumentId, Range<u32>)> = Vec::new();
    let is_new = |(file, occurrence): &(DocumentId, Occurrence)| {
        let place = (*file, occurrence.range.clone());
        let is_new = named.len() < 2 || !seen.contains(&place);
        if named.len() > 1 && is_new {
            seen.push(place);
        }
        is_new
    };
    all.filter(is_new)
        .filter(|(_, occurrence)| declarations || occurrence.kind == ReferenceKind::Read)
        .map(|(file, occurrence)| Reference {
            place: Place { file, range: occurrence.range },
            kind: occurrence.kind,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::{ReferenceKind, references};
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let fixture = Fixture::new(control, text);
        let all = references(&fixture.workspace, fixture.document, fixture.offset, true);
        let line = |place: &super::Reference| {
            let sets = if place.kind == ReferenceKind::Write { " (set)" } else { "" };
            format!("{}{sets}\n", fixture.shown(place.place.file, &place.place.range))
        };
        expected.assert_eq(&all.iter().map(line).collect::<String>());
    }

    #[test]
    fn words_of_a_tool_within_the_program() {
        check(
            "haas-mill",
            "O1\nT3 M6\nG43 H3 Z1.\nG41 D3 X1.\nT4 M6\nT$03 M6\nG43 H03 Z1.\nM30\n",
            &expect![[r#"
                2: T3
                6: T3
            "#]],
        );
        check(
            "haas-mill",
            "O1\nT3 M6\nG43 H$03 Z1.\nG43 H4\nG49\nG43 H3\nM30\n",
            &expect![[r#"
            3: H3
            6: H3
        "#]],
        );
    }

    #[test]
    fn work_offsets_within_the_program() {
        check(
            "haas-mill",
            "O1\nG5$04 X1.\nG55\nG90 G54\nG154 P1\nM30\n",
            &expect![[r#"
                2: G54
                4: G54
            "#]],
        );
        check(
            "haas-mill",
            "O1\nG154 P1\nG154 P2\nG1$054 P1\nM30\n",
            &expect![[r#"
                2: G154
                4: G154
            "#]],
        );
        check("haas-mill", "O1\nG$00 X1.\nG0 X2.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn labels_with_their_jumps() {
        let text =
            "O1\nN10 G0 X0.\nIF [#1 EQ 0] GOTO 10\nGOTO 20\nM99 P10\nN20 M30\nO2\nGOTO 10\nN$010 M99\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            8: 10
            9: 10 (set)
        "#]],
        );
    }

    #[test]
    fn a_common_variable_reaches_the_programs_that_call_each_other() {
        let files = "//- a.nc\nO1\n#10$00=1.\nM98 P2\nM30\n//- b.nc\nO2\nG0 X#100 (#100)\nM99\n//- c.nc\nO3\n#100=5.\nM30\n";
        check(
            "fanuc-mill",
            files,
            &expect![[r#"
            a.nc:2: 100 (set)
            b.nc:2: 100
        "#]],
        );
    }

    #[test]
    fn a_local_variable_lives_in_its_program() {
        check(
            "haas-mill",
            "O1\n#1=1.\nG0 X#1$0\nM30\nO2\n#1=2.\nM99\n",
            &expect![[r#"
            2: 1 (set)
            3: 1
        "#]],
        );
    }

    #[test]
    fn a_variable_that_gives_the_number_of_another_is_read() {
        check(
            "haas-mill",
            "O1\n#100=5\n##10$00=1.\n#[#100+1]=2.\nM30\n",
            &expect![[r#"
            2: 100 (set)
            3: 100
            4: 100
        "#]],
        );
    }

    #[test]
    fn branches_of_o_words() {
        let text = "o100 sub\no110 if [#1 GT 0]\no110 else\no110 end$0if\no100 endsub\no110 if [1]\no110 endif\nM2\n";
        check(
            "linuxcnc",
            text,
            &expect![[r#"
            2: 110 (set)
            3: 110
            4: 110
        "#]],
        );
    }

    #[test]
    fn what_a_return_names_is_where_the_control_looks_for_it() {
        check(
            "haas-mill",
            "O1\nM98 P2\nN20 G0 X0.\nM30\nO2\nM99 P2$00\nN20 M99\n",
            &expect![[r#"
            6: 20
            7: 20 (set)
        "#]],
        );
        check(
            "fanuc-mill",
            "//- a.nc\nO1\nM98 P2\nN10 G0 X0.\nM30\n//- b.nc\nO2\nM99 P1$00\n",
            &expect![[r#"
                a.nc:3: 10 (set)
                b.nc:2: 10
            "#]],
        );
        check(
            "fanuc-mill",
            "//- a.nc\nO1\nM98 P2\nN1$00 G0 X0.\nM30\n//- b.nc\nO2\nM99 P10\n",
            &expect![[r#"
                a.nc:3: 10 (set)
                b.nc:2: 10
            "#]],
        );
    }
}
