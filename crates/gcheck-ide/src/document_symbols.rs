//! The parts of a program: programs, tools, operations, labels, subroutines.
//!
//! Knows: what machinists call the parts of a program, and which part holds which. Must not know: states.

use std::collections::HashSet;
use std::ops::Range;

use gcheck_controls::{Effect, Ends};
use gcheck_db::Snapshot;
use gcheck_program::OLabel;

use crate::remarks::title;
use crate::sections::sections;
use crate::symbols::{code_end, program_around, subs};

/// A part of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// More, in a few words; may be empty.
    pub detail: String,
    /// What it is.
    pub kind: SymbolKind,
    /// All its bytes.
    pub range: Range<u32>,
    /// Bytes of its name, inside `range`.
    pub selection: Range<u32>,
    /// Its parts in text order.
    pub children: Vec<Symbol>,
}

/// What a part of a program is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SymbolKind {
    /// A program (`O1234`).
    Program,
    /// A subroutine: `O100 SUB`, or a block that `M97` calls.
    Subroutine,
    /// What one tool does.
    Tool,
    /// An operation, by the comment that is alone before it.
    Operation,
    /// A sequence number that something jumps to.
    Label,
}

/// The parts of a document, in text order.
pub fn document_symbols(snapshot: &Snapshot) -> Vec<Symbol> {
    let mut all: Vec<Symbol> = Vec::new();
    programs(snapshot, &mut all);
    for sub in subs(snapshot) {
        let name = o_name(&sub.label);
        all.push(symbol(name, String::new(), SymbolKind::Subroutine, sub.range, sub.name));
    }
    let sections = sections(snapshot);
    for tool in sections.tools {
        let name = match tool.tool {
            Some(_) if tool.is_named => snapshot.slice(tool.word.clone()).trim().to_owned(),
            Some(number) => format!("T{number}"),
            None => "tool change".to_owned(),
        };
        all.push(symbol(name, tool.name, SymbolKind::Tool, tool.range, tool.word));
    }
    for operation in sections.operations {
        let (range, comment) = (operation.range, operation.comment);
        all.push(symbol(operation.name, String::new(), SymbolKind::Operation, range, comment));
    }
    labels(snapshot, &mut all);
    nest(all)
}

/// `O100`, `o<probe>`.
pub(crate) fn o_name(label: &OLabel) -> String {
    match label {
        OLabel::Number(number) => format!("O{number}"),
        OLabel::Name(name) => format!("o<{name}>"),
        OLabel::Computed => "o[…]".to_owned(),
    }
}

fn symbol(
    name: String,
    detail: String,
    kind: SymbolKind,
    range: Range<u32>,
    selection: Range<u32>,
) -> Symbol {
    let name = if name.is_empty() { "…".to_owned() } else { name };
    let range = range.start.min(selection.start)..range.end.max(selection.end);
    Symbol { name, detail, kind, range, selection, children: Vec::new() }
}

fn programs(snapshot: &Snapshot, all: &mut Vec<Symbol>) {
    let end = code_end(snapshot);
    for program in &snapshot.file_index().programs {
        if program.range.start >= end {
            continue;
        }
        let around = program_around(snapshot, program.range.start);
        // What is in front of the first number is not part of its name.
        let range = program.range.start..around.end.min(end);
        let line = snapshot.line_text(snapshot.line_at(program.range.start)).into_owned();
        let detail = title(&line).unwrap_or_default().to_owned();
        let name = snapshot.slice(program.range.clone()).trim().to_owned();
        all.push(symbol(name, detail, SymbolKind::Program, range, program.range.clone()));
    }
}

/// Sequence numbers that something names, and blocks that are called.
fn labels(snapshot: &Snapshot, all: &mut Vec<Symbol>) {
    let file_index = snapshot.file_index();
    let control = snapshot.control();
    let is_call = |code| control.code_at(code).is_some_and(|code| code.effect() == Effect::CallLocal);
    let (mut named, mut called) = (HashSet::new(), HashSet::new());
    for jump in &file_index.jumps {
        if let Some(target) = jump.target {
            let program = program_around(snapshot, jump.range.start).start;
            if is_call(jump.code) {
                called.insert((program, target))
            } else {
                named.insert((program, target))
            };
        }
    }
    for label in &file_index.labels {
        let program = program_around(snapshot, label.range.start);
        let key = (program.start, label.number);
        let name = format!("N{}", label.number);
        if called.contains(&key) {
            let range = label.range.start..return_behind(snapshot, label.range.start, program.end);
            all.push(symbol(name, String::new(), SymbolKind::Subroutine, range, label.range.clone()));
        } else if named.contains(&key) {
            all.push(symbol(
                name,
                String::new(),
                SymbolKind::Label,
                label.range.clone(),
                label.range.clone(),
            ));
        }
    }
}

/// After the return of a block that is called.
pub(crate) fn return_behind(snapshot: &Snapshot, from: u32, end: u32) -> u32 {
    let ends = &snapshot.file_index().ends;
    let next = ends.get(ends.partition_point(|mark| mark.range.start < from)..).unwrap_or_default();
    let is_return = |mark: &&gcheck_program::EndMark| mark.ends == Ends::Subprogram && !mark.conditional;
    next.iter().find(is_return).map_or(end, |mark| mark.range.end.min(end))
}

/// Puts each symbol into the one that holds it.
fn nest(mut all: Vec<Symbol>) -> Vec<Symbol> {
    let level = |kind: SymbolKind| match kind {
        SymbolKind::Program => 0,
        SymbolKind::Subroutine => 1,
        SymbolKind::Tool => 2,
        SymbolKind::Operation => 3,
        SymbolKind::Label => 4,
    };
    all.sort_by_key(|symbol| (symbol.range.start, level(symbol.kind)));
    let mut roots = Vec::new();
    let mut open: Vec<Symbol> = Vec::new();
    for mut symbol in all {
        while let Some(last) = open.last()
            && (symbol.range.start >= last.range.end || level(last.kind) >= level(symbol.kind))
        {
            close(&mut open, &mut roots);
        }
        if let Some(around) = open.last() {
            symbol.range.end = symbol.range.end.min(around.range.end).max(symbol.selection.end);
        }
        open.push(symbol);
    }
    while !open.is_empty() {
        close(&mut open, &mut roots);
    }
    roots
}

/// Ends the innermost symbol that is open.
fn close(open: &mut Vec<Symbol>, roots: &mut Vec<Symbol>) {
    let Some(done) = open.pop() else { return };
    match open.last_mut() {
        Some(around) => {
            around.range.end = around.range.end.max(done.range.end);
            around.children.push(done);
        }
        None => roots.push(done),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::{Symbol, document_symbols};
    use crate::fixture::{Fixture, shown};

    fn check(control: &str, text: &str, expected: &Expect) {
        let snapshot = Fixture::new(control, text).snapshot();
        let mut out = String::new();
        for symbol in document_symbols(&snapshot) {
            show(&snapshot, &symbol, 0, &mut out);
        }
        expected.assert_eq(&out);
    }

    fn show(snapshot: &gcheck_db::Snapshot, symbol: &Symbol, depth: usize, out: &mut String) {
        use std::fmt::Write as _;
        let (first, last) =
            (snapshot.line_at(symbol.range.start) + 1, snapshot.line_at(symbol.range.end) + 1);
        assert!(symbol.range.start <= symbol.selection.start && symbol.selection.end <= symbol.range.end);
        let at = shown(snapshot, &symbol.selection);
        let (name, detail, kind) = (&symbol.name, &symbol.detail, symbol.kind);
        let _ =
            writeln!(out, "{:depth$}{kind:?} {name} [{detail}] {first}-{last} @{at}", "", depth = depth * 2);
        for child in &symbol.children {
            show(snapshot, child, depth + 1, out);
        }
    }

    #[test]
    fn tools_of_a_mill_with_the_next_one_called_ahead() {
        let text = "%\nO00010 (BRACKET)\n(T1 D=10. FLAT END MILL)\n(T2 DRILL)\nG21 G90\n(FACE)\nT1 M6\nT2 (NEXT)\nG0 X0.\n(POCKET 1)\nG1 X5. F100.\n(POCKET 2)\nG1 X6.\n\nM6\nG0 X1.\nM30\n%\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            Program O00010 [BRACKET] 2-18 @2: O00010
              Tool T1 [D=10. FLAT END MILL] 6-15 @7: T1
                Operation POCKET 1 [] 10-12 @10: (POCKET 1)
                Operation POCKET 2 [] 12-15 @12: (POCKET 2)
              Tool T2 [DRILL] 15-18 @15: M6
        "#]],
        );
    }

    #[test]
    fn tools_of_a_lathe_without_a_change_code() {
        let text =
            "O1 (SHAFT)\nG28 U0\nT0101 (OD ROUGH)\nG0 X50. Z2.\nT0100\nN2 (GROOVE)\nT0303\nG0 X52.\nM30\n";
        check(
            "haas-lathe",
            text,
            &expect![[r#"
                Program O1 [SHAFT] 1-10 @1: O1
                  Tool T0101 [OD ROUGH] 3-6 @3: T0101
                  Tool T0303 [GROOVE] 6-10 @7: T0303
            "#]],
        );
    }

    #[test]
    fn labels_and_called_blocks() {
        let text = "O1\nN1 G0 X0.\nM97 P100\nIF [#1 EQ 1] GOTO 1\nM30\nN100 G0 Z1.\nN101 X1.\nM99\nO2\nM99\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            Program O1 [] 1-9 @1: O1
              Label N1 [] 2-2 @2: N1
              Subroutine N100 [] 6-8 @6: N100
            Program O2 [] 9-11 @9: O2
        "#]],
        );
    }

    #[test]
    fn subroutines_of_o_words() {
        check(
            "linuxcnc",
            "o<probe> sub\nG0 X1\no<probe> endsub\nt1 m6 ; drill\nG0 X0\nM2\n",
            &expect![[r#"
            Subroutine o<probe> [] 1-3 @1: probe
            Tool t1 [drill] 4-7 @4: t1
        "#]],
        );
    }

    #[test]
    fn nothing() {
        check("haas-mill", "", &expect![[""]]);
        check("haas-mill", "%\n", &expect![[""]]);
    }

    #[test]
    fn a_directive_is_no_title() {
        check(
            "haas-mill",
            "O1 (gcheck: control=haas-mill)\n(gcheck: off)\nT1 M6 (gcheck: ignore-file feed-missing)\nG0 X1.\nO2 (gcheck: off) (SLOT)\nM99\n",
            &expect![[r#"
                Program O1 [] 1-5 @1: O1
                  Tool T1 [] 2-5 @3: T1
                Program O2 [SLOT] 5-7 @5: O2
            "#]],
        );
    }
}
