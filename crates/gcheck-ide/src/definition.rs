//! Where a symbol is defined: labels, programs, subroutines, variables.
//!
//! Knows: what counts as the definition of which symbol. Must not know: how symbols are found in the text.

use std::ops::Range;

use gcheck_db::{DocumentId, Snapshot};

use crate::symbols::{
    Symbol, definition_of, occurrences, occurrences_in, program_around, returned_to, subs, symbol_at,
};
use crate::{Place, ReferenceKind, Workspace, WorkspaceFile};

/// Most assignments of a variable that are offered as its definition.
const MOST_ASSIGNMENTS: usize = 100;

/// Where something is defined.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Target {
    /// The name in its file.
    pub name: Place,
    /// The whole of it: a block, a program.
    pub full: Range<u32>,
    /// Bytes of the word that was asked about.
    pub from: Range<u32>,
}

/// Where the symbol at `offset` is defined; several places where several may be meant.
pub fn definition(workspace: &Workspace, document: DocumentId, offset: u32) -> Vec<Target> {
    let Some(file) = workspace.file(document) else { return Vec::new() };
    let Some(occurrence) = symbol_at(&file.snapshot, offset) else {
        return blocks_of_callers(workspace, file, offset);
    };
    let from = occurrence.range;
    match &occurrence.symbol {
        Symbol::Program(_) | Symbol::Subroutine(_) => {
            let place = definition_of(workspace, document, &occurrence.symbol);
            place.map(|place| target(workspace, place, &occurrence.symbol, from)).into_iter().collect()
        }
        symbol => {
            let mut written: Vec<Place> = occurrences(workspace, document, symbol)
                .into_iter()
                .filter(|(_, occurrence)| occurrence.kind == ReferenceKind::Write)
                .map(|(file, occurrence)| Place { file, range: occurrence.range })
                .collect();
            written.truncate(MOST_ASSIGNMENTS);
            written.into_iter().map(|place| target(workspace, place, symbol, from.clone())).collect()
        }
    }
}

/// The blocks of callers that a return names (`M99 P100`).
fn blocks_of_callers(workspace: &Workspace, file: &WorkspaceFile, offset: u32) -> Vec<Target> {
    let mut targets = Vec::new();
    for (caller, occurrence) in returned_to(workspace, file, offset) {
        let Some(caller) = workspace.file(caller) else { continue };
        let labels = occurrences_in(&caller.snapshot, &occurrence.symbol).into_iter();
        for label in labels.filter(|label| label.kind == ReferenceKind::Write) {
            let place = Place { file: caller.id, range: label.range };
            targets.push(target(workspace, place, &occurrence.symbol, occurrence.range.clone()));
        }
    }
    targets
}

fn target(workspace: &Workspace, name: Place, symbol: &Symbol, from: Range<u32>) -> Target {
    let full = workspace
        .file(name.file)
        .map_or_else(|| name.range.clone(), |file| whole(&file.snapshot, &name.range, symbol));
    Target { name, full, from }
}

/// All of what is defined at a place.
fn whole(snapshot: &Snapshot, name: &Range<u32>, symbol: &Symbol) -> Range<u32> {
    match symbol {
        Symbol::Program(_) => program_around(snapshot, name.start),
        Symbol::Subroutine(_) => {
            let sub = subs(snapshot).into_iter().find(|sub| sub.range.contains(&name.start));
            sub.map_or_else(|| name.clone(), |sub| sub.range)
        }
        _ => {
            let block = snapshot.block_at(name.start).map(|place| place.range());
            block
                .filter(|block| block.start <= name.start && name.end <= block.end)
                .unwrap_or_else(|| name.clone())
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::definition;
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let fixture = Fixture::new(control, text);
        let targets = definition(&fixture.workspace, fixture.document, fixture.offset);
        let lines = targets.iter().map(|target| {
            let full = fixture.shown(target.name.file, &target.full);
            format!("{} in {full}\n", fixture.shown(target.name.file, &target.name.range))
        });
        expected.assert_eq(&lines.collect::<String>());
    }

    #[test]
    fn labels_of_the_own_program() {
        let text = "O1\nN10 G0 X0.\nGOTO 1$00\nM30\nO2\nN10 M99\n";
        check(
            "fanuc-mill",
            text,
            &expect![[r#"
            2: 10 in 2: N10 G0 X0.
        "#]],
        );
        check(
            "haas-mill",
            "O1\nM97 P100$0\nM30\nN100 G0 X1.\nM99\n",
            &expect![[r#"
            4: 100 in 4: N100 G0 X1.
        "#]],
        );
        check(
            "haas-lathe",
            "O1\nG71 P$010 Q20 U.1\nN10 G0 X1.\nN20 X2.\nM30\n",
            &expect![[r#"
            3: 10 in 3: N10 G0 X1.
        "#]],
        );
    }

    #[test]
    fn programs_in_this_file_and_in_others() {
        check(
            "haas-mill",
            "O1\nM98 P$02\nM30\nO2\nG0 X1.\nM99\n",
            &expect![[r#"
            4: O2 in 4: O2⏎G0 X1.⏎M99⏎
        "#]],
        );
        let files = "//- main.nc\nO1\nG65 P9010$0 A1.\nM30\n//- probe.nc\n%\nO9010 (PROBE)\nM99\n%\n";
        check(
            "haas-mill",
            files,
            &expect![[r#"
            probe.nc:2: O9010 in probe.nc:1: %⏎O9010 (PROBE)⏎M99⏎%⏎
        "#]],
        );
        check(
            "fanuc-mill",
            "O1\nM98 P3$00002\nM30\nO2\nM99\n",
            &expect![[r#"
            4: O2 in 4: O2⏎M99⏎
        "#]],
        );
    }

    #[test]
    fn subroutines_by_name() {
        let files = "//- main.ngc\no<probe> call$0 [1]\nM2\n//- probe.ngc\no<probe> sub\nG0 X#1\no<probe> endsub\nM2\n";
        check(
            "linuxcnc",
            files,
            &expect![[r#"
            probe.ngc:1: probe in probe.ngc:1: o<probe> sub⏎G0 X#1⏎o<probe> endsub
        "#]],
        );
    }

    #[test]
    fn variables_where_they_are_set() {
        check(
            "haas-mill",
            "O1\n#100=1.\nG0 X#10$00\n#100=#100+1.\nM30\n",
            &expect![[r#"
            2: 100 in 2: #100=1.
            4: 100 in 4: #100=#100+1.
        "#]],
        );
        let text = "o<a> sub\n#<d> = 1\no<a> endsub\n#<d> = 2\nG0 X#<d$0>\nM2\n";
        check(
            "linuxcnc",
            text,
            &expect![[r#"
            4: d in 4: #<d> = 2
        "#]],
        );
    }

    #[test]
    fn what_a_return_names_stands_in_the_caller() {
        let files = "//- main.nc\nO1\nM98 P9001\nN50 G0 X0.\nM30\n//- 9001.nc\nO9001\nM99 P50$0\n";
        check(
            "fanuc-mill",
            files,
            &expect![[r#"
                main.nc:3: 50 in main.nc:3: N50 G0 X0.
            "#]],
        );
    }

    #[test]
    fn on_some_controls_what_a_return_names_is_in_its_own_program() {
        check(
            "haas-mill",
            "O1\nM98 P2\nN20 G0 X0.\nM30\nO2\nM99 P2$00\nN20 M99\n",
            &expect![[r#"
            7: 20 in 7: N20 M99
        "#]],
        );
    }
}
