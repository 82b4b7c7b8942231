//! Which program calls which.
//!
//! Knows: programs, subroutines and called blocks as callers and callees. Must not know: what a call does.

use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_db::DocumentId;

use crate::document_symbols::{o_name, return_behind};
use crate::symbols::{Symbol, callee, definition_of, program_around, subs, symbol_at};
use crate::{Place, SymbolKind, Workspace, WorkspaceFile};

/// A program or subroutine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CallItem {
    /// `O1234`, `o<probe>`, `N100`, or the file's name where the program has no number.
    pub name: String,
    /// The file's name.
    pub detail: String,
    /// Program or subroutine.
    pub kind: SymbolKind,
    /// Its name's place.
    pub place: Place,
    /// All its bytes.
    pub range: Range<u32>,
}

/// Who calls a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Incoming {
    /// The caller.
    pub from: CallItem,
    /// The calls: bytes of the caller's file.
    pub calls: Vec<Range<u32>>,
}

/// What a program calls.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outgoing {
    /// What is called.
    pub to: CallItem,
    /// The calls: bytes of the calling program's file.
    pub calls: Vec<Range<u32>>,
}

/// The program that is named at `offset`; elsewhere the one around it.
pub fn call_items(workspace: &Workspace, document: DocumentId, offset: u32) -> Vec<CallItem> {
    let Some(file) = workspace.file(document) else { return Vec::new() };
    let named = symbol_at(&file.snapshot, offset).and_then(|occurrence| match occurrence.symbol {
        Symbol::Program(_) | Symbol::Subroutine(_) => {
            let place = definition_of(workspace, document, &occurrence.symbol)?;
            Some(around(workspace.file(place.file)?, place.range.start))
        }
        Symbol::Label { number, program } => called_block(file, number, &program),
        _ => None,
    });
    vec![named.unwrap_or_else(|| around(file, offset))]
}

/// Who calls the program.
pub fn incoming_calls(workspace: &Workspace, item: &CallItem) -> Vec<Incoming> {
    let mut callers: Vec<Incoming> = Vec::new();
    for file in &workspace.files {
        for (range, to) in calls(workspace, file) {
            if to.place == item.place {
                let from = around(file, range.start);
                match callers.iter_mut().find(|caller| caller.from == from) {
                    Some(caller) => caller.calls.push(range),
                    None => callers.push(Incoming { from, calls: vec![range] }),
                }
            }
        }
    }
    callers
}

/// What the program calls.
pub fn outgoing_calls(workspace: &Workspace, item: &CallItem) -> Vec<Outgoing> {
    let Some(file) = workspace.file(item.place.file) else { return Vec::new() };
    let mut called: Vec<Outgoing> = Vec::new();
    for (range, to) in calls(workspace, file) {
        if around(file, range.start).place != item.place {
            continue;
        }
        match called.iter_mut().find(|out| out.to == to) {
            Some(out) => out.calls.push(range),
            None => called.push(Outgoing { to, calls: vec![range] }),
        }
    }
    called
}

/// The calls of a file whose callee is found, in text order.
fn calls(workspace: &Workspace, file: &WorkspaceFile) -> Vec<(Range<u32>, CallItem)> {
    let snapshot = &file.snapshot;
    let file_index = snapshot.file_index();
    // A program calls few others, many times.
    let mut known: Vec<(Symbol, Option<CallItem>)> = Vec::new();
    let mut calls: Vec<(Range<u32>, CallItem)> = Vec::new();
    for call in &file_index.calls {
        let Some(symbol) = callee(snapshot, call) else { continue };
        let item = match known.iter().find(|(known, _)| *known == symbol) {
            Some((_, item)) => item.clone(),
            None => {
                let place = definition_of(workspace, file.id, &symbol);
                let item =
                    place.and_then(|place| Some(around(workspace.file(place.file)?, place.range.start)));
                known.push((symbol, item.clone()));
                item
            }
        };
        calls.extend(item.map(|item| (call.range.clone(), item)));
    }
    let control = snapshot.control();
    for jump in &file_index.jumps {
        let is_call = control.code_at(jump.code).is_some_and(|code| code.effect() == Effect::CallLocal);
        let Some(number) = jump.target.filter(|_| is_call) else { continue };
        let item = called_block(file, number, &program_around(snapshot, jump.range.start));
        calls.extend(item.map(|item| (jump.range.clone(), item)));
    }
    calls.sort_by_key(|(range, _)| range.start);
    calls
}

/// A block that is called by its sequence number.
fn called_block(file: &WorkspaceFile, number: u32, program: &Range<u32>) -> Option<CallItem> {
    let snapshot = &file.snapshot;
    let file_index = snapshot.file_index();
    let control = snapshot.control();
    file_index.jumps.iter().find(|jump| {
        jump.target == Some(number)
            && program.contains(&jump.range.start)
            && control.code_at(jump.code).is_some_and(|code| code.effect() == Effect::CallLocal)
    })?;
    let label = file_index
        .labels
        .iter()
        .find(|label| label.number == number && program.contains(&label.range.start))?;
    Some(CallItem {
        name: format!("N{number}"),
        detail: file.name.to_string(),
        kind: SymbolKind::Subroutine,
        place: Place { file: file.id, range: label.range.clone() },
        range: label.range.start..return_behind(snapshot, label.range.start, program.end),
    })
}

/// The subroutine or program around an offset.
fn around(file: &WorkspaceFile, offset: u32) -> CallItem {
    let snapshot = &file.snapshot;
    let detail = file.name.to_string();
    let place = |range: Range<u32>| Place { file: file.id, range };
    let sub = subs(snapshot).into_iter().rev().find(|sub| sub.range.contains(&offset));
    if let Some(sub) = sub {
        let kind = SymbolKind::Subroutine;
        return CallItem { name: o_name(&sub.label), detail, kind, place: place(sub.name), range: sub.range };
    }
    let range = program_around(snapshot, offset);
    if let Some(block) = local_around(file, offset, &range) {
        return block;
    }
    let head = snapshot.file_index().programs.iter().find(|program| range.contains(&program.range.start));
    let (name, at) = match head {
        Some(head) => (snapshot.slice(head.range.clone()).trim().to_owned(), head.range.clone()),
        None => (file.name.to_string(), 0..0),
    };
    CallItem { name, detail, kind: SymbolKind::Program, place: place(at), range }
}

/// The block called by its number whose way to its return holds an offset.
fn local_around(file: &WorkspaceFile, offset: u32, program: &Range<u32>) -> Option<CallItem> {
    let file_index = file.snapshot.file_index();
    let control = file.snapshot.control();
    let is_call = |code| control.code_at(code).is_some_and(|code| code.effect() == Effect::CallLocal);
    if !file_index.jumps.iter().any(|jump| is_call(jump.code)) {
        return None;
    }
    let labels = file_index.labels.iter().rev();
    labels
        .filter(|label| label.range.start <= offset && program.contains(&label.range.start))
        .find_map(|label| called_block(file, label.number, program))
        .filter(|item| item.range.contains(&offset))
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::{CallItem, call_items, incoming_calls, outgoing_calls};
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let fixture = Fixture::new(control, text);
        let items = call_items(&fixture.workspace, fixture.document, fixture.offset);
        let name = |item: &CallItem| format!("{} of {}", item.name, item.detail);
        let mut lines = Vec::new();
        for item in &items {
            lines.push(name(item));
            for incoming in incoming_calls(&fixture.workspace, item) {
                let calls: Vec<String> =
                    incoming.calls.iter().map(|call| fixture.shown(incoming.from.place.file, call)).collect();
                lines.push(format!("from {}: {}", name(&incoming.from), calls.join(", ")));
            }
            for outgoing in outgoing_calls(&fixture.workspace, item) {
                let calls: Vec<String> =
                    outgoing.calls.iter().map(|call| fixture.shown(item.place.file, call)).collect();
                lines.push(format!("to {}: {}", name(&outgoing.to), calls.join(", ")));
            }
        }
        expected.assert_eq(&(lines.join("\n") + "\n"));
    }

    #[test]
    fn programs_of_other_files() {
        let files = "//- a.nc\nO1\nM98 P2\nG65 P9010 A1.\nM98 P2\nM98 P77\nM30\n//- b.nc\nO2\nG0 X$01.\nG65 P9010\nM99\n//- 9010.nc\nO9010\nM99\n";
        check(
            "haas-mill",
            files,
            &expect![[r#"
            O2 of b.nc
            from O1 of a.nc: a.nc:2: P2, a.nc:4: P2
            to O9010 of 9010.nc: b.nc:3: P9010
        "#]],
        );
        check(
            "haas-mill",
            &files.replace("P9010 A", "P90$010 A").replace("X$0", "X"),
            &expect![[r#"
            O9010 of 9010.nc
            from O1 of a.nc: a.nc:3: P9010
            from O2 of b.nc: b.nc:3: P9010
        "#]],
        );
    }

    #[test]
    fn blocks_called_by_their_number() {
        check(
            "haas-mill",
            "O1\nM97 P1000$0\nM30\nN1000 G0 X1.\nM98 P2\nM99\nO2\nM99\n",
            &expect![[r#"
                N1000 of main.nc
                from O1 of main.nc: 2: P1000
                to O2 of main.nc: 5: P2
            "#]],
        );
        check(
            "haas-mill",
            "O1\nG0 X$01.\nM97 P1000\nM30\nN1000 G0 X1.\nM99\n",
            &expect![[r#"
            O1 of main.nc
            to N1000 of main.nc: 3: P1000
        "#]],
        );
    }

    #[test]
    fn subroutines_of_o_words() {
        let files = "//- main.ngc\no<probe> call$0 [1]\nM2\n//- probe.ngc\no<probe> sub\no<touch> call\no<probe> endsub\no<touch> sub\no<touch> endsub\n";
        check(
            "linuxcnc",
            files,
            &expect![[r#"
            o<probe> of probe.ngc
            from main.ngc of main.ngc: main.ngc:1: o<probe> call [1]
            to o<touch> of probe.ngc: probe.ngc:2: o<touch> call
        "#]],
        );
    }
}
