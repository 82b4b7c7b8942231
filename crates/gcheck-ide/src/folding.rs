//! What can be folded away.
//!
//! Knows: programs, sections, loops, subroutines, conditions, comments. Must not know: how editors fold.

use std::ops::Range;

use gcheck_db::Snapshot;
use gcheck_program::{OKeyword, OLabel};

use crate::sections::sections;
use crate::symbols::{code_end, program_around};

/// What can be folded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fold {
    /// From the end of the line that stays to the end of the last line that goes.
    pub range: Range<u32>,
    /// What it is.
    pub kind: FoldKind,
}

/// What is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FoldKind {
    /// Comments.
    Comment,
    /// A program, a tool section, an operation, a loop, a subroutine, a condition.
    Region,
}

/// What can be folded, in order of its start.
pub fn folding_ranges(snapshot: &Snapshot) -> Vec<Fold> {
    let end = code_end(snapshot);
    let mut regions: Vec<Range<u32>> = Vec::new();
    for program in &snapshot.file_index().programs {
        regions.push(program.range.start..program_around(snapshot, program.range.start).end.min(end));
    }
    let sections = sections(snapshot);
    regions.extend(sections.tools.iter().map(|tool| tool.range.clone()));
    regions.extend(sections.operations.iter().map(|operation| operation.range.clone()));
    loops(snapshot, &mut regions);
    o_words(snapshot, &mut regions);
    let comments = sections.comments.into_iter().map(|range| (range, FoldKind::Comment));
    let regions = regions.into_iter().map(|range| (range, FoldKind::Region));
    let mut folds: Vec<Fold> =
        regions.chain(comments).filter_map(|(range, kind)| fold(snapshot, &range, kind)).collect();
    folds.sort_by_key(|fold| (fold.range.start, std::cmp::Reverse(fold.range.end), fold.kind));
    // Two folds at one line are one to an editor: the larger stays.
    folds.dedup_by_key(|fold| fold.range.start);
    folds
}

/// The lines of a range but for its first; blank lines at its end stay.
fn fold(snapshot: &Snapshot, range: &Range<u32>, kind: FoldKind) -> Option<Fold> {
    let first = snapshot.line_at(range.start);
    let mut last = snapshot.line_at(range.end);
    // A range that ends where a line begins does not hold the line.
    if last > first && snapshot.line_range(last).start == range.end {
        last -= 1;
    }
    while last > first && snapshot.line_text(last).trim().is_empty() {
        last -= 1;
    }
    (last > first)
        .then(|| Fold { range: snapshot.line_range(first).end..snapshot.line_range(last).end, kind })
}

/// `DO` and `END`.
fn loops(snapshot: &Snapshot, regions: &mut Vec<Range<u32>>) {
    let mut open: Vec<(Option<u64>, u32)> = Vec::new();
    for mark in &snapshot.file_index().loops {
        let number = mark.number.map(f64::to_bits);
        if mark.begins {
            open.push((number, mark.range.start));
        } else if let Some(at) = open.iter().rposition(|(opened, _)| *opened == number) {
            regions.extend(open.drain(at..).next().map(|(_, start)| start..mark.range.end));
        }
    }
}

/// Subroutines, conditions and loops of O-words; each branch of a condition by itself.
fn o_words(snapshot: &Snapshot, regions: &mut Vec<Range<u32>>) {
    let mut open: Vec<(&OLabel, OKeyword, u32)> = Vec::new();
    for word in &snapshot.file_index().o_words {
        let partner = |opens: &[OKeyword]| {
            open.iter().rposition(|(label, keyword, _)| **label == word.label && opens.contains(keyword))
        };
        let closes = match word.keyword {
            OKeyword::EndSub => partner(&[OKeyword::Sub]),
            OKeyword::EndIf | OKeyword::Else | OKeyword::ElseIf => {
                partner(&[OKeyword::If, OKeyword::ElseIf, OKeyword::Else])
            }
            OKeyword::EndWhile => partner(&[OKeyword::While]),
            OKeyword::While => partner(&[OKeyword::Do]),
            OKeyword::EndRepeat => partner(&[OKeyword::Repeat]),
            _ => None,
        };
        let is_branch = matches!(word.keyword, OKeyword::Else | OKeyword::ElseIf);
        if let Some(at) = closes {
            let start = open.drain(at..).next().map(|(_, _, start)| start);
            // A branch leaves the line of the next one standing.
            let end = if is_branch { word.range.start } else { word.range.end };
            let end = if is_branch { snapshot.line_range(snapshot.line_at(end)).start } else { end };
            regions.extend(start.map(|start| start..end));
        }
        let opens = is_branch
            || matches!(word.keyword, OKeyword::Sub | OKeyword::If | OKeyword::Do | OKeyword::Repeat)
            || word.keyword == OKeyword::While && closes.is_none();
        if opens {
            open.push((&word.label, word.keyword, word.range.start));
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::folding_ranges;
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let snapshot = Fixture::new(control, text).snapshot();
        let line = |offset: u32| snapshot.line_at(offset) + 1;
        let folds = folding_ranges(&snapshot);
        let lines = folds
            .iter()
            .map(|fold| format!("{}-{} {:?}\n", line(fold.range.start), line(fold.range.end), fold.kind));
        expected.assert_eq(&lines.collect::<String>());
    }

    #[test]
    fn head_tools_and_operations() {
        let text = "%\nO1 (PART)\n(HEAD)\n(TOOLS)\nG21\n(FACE)\nT1 M6\nG0 X0.\n(POCKET)\nG1 X5.\n\n\nT2 M6\nG0 X1.\nM30\n%\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            2-16 Region
            3-4 Comment
            6-10 Region
            9-10 Region
            13-16 Region
        "#]],
        );
    }

    #[test]
    fn loops_of_macros() {
        check(
            "fanuc-mill",
            "WHILE [#1 LT 5] DO1\nDO2\n#1=#1+1\nEND2\nEND1\nEND3\nM30\n",
            &expect![[r#"
            1-5 Region
            2-4 Region
        "#]],
        );
    }

    #[test]
    fn o_words_with_branches() {
        let text = "o1 sub\no2 if [1]\nG0 X1\no2 elseif [2]\nG0 X2\no2 else\nG0 X3\no2 endif\no1 endsub\no3 do\nG0 X4\no3 while [0]\nM2\n";
        check(
            "linuxcnc",
            text,
            &expect![[r#"
            1-9 Region
            2-3 Region
            4-5 Region
            6-8 Region
            10-12 Region
        "#]],
        );
    }
}
