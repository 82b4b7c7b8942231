//! Programs, subroutines, tools and operations of all files, by name.
//!
//! Knows: how a query matches a name. Must not know: what parts a program has (document symbols do).

use crate::{Place, Symbol, SymbolKind, Workspace, WorkspaceFile, document_symbols};

/// Most symbols of an answer.
pub const MAX_SYMBOLS: usize = 1_000;

/// A symbol of some file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WorkspaceSymbol {
    /// Its name, and what the program calls it.
    pub name: String,
    /// What it is.
    pub kind: SymbolKind,
    /// Its name's place.
    pub place: Place,
    /// What it is a part of: a program, else the file's name.
    pub container: String,
}

/// Symbols whose name or detail holds the letters of `query` in order, without regard to case; at most [`MAX_SYMBOLS`].
pub fn workspace_symbols(workspace: &Workspace, query: &str) -> Vec<WorkspaceSymbol> {
    let mut found = Vec::new();
    for file in &workspace.files {
        for symbol in document_symbols(&file.snapshot) {
            add(file, &symbol, &file.name, query, &mut found);
        }
        if found.len() >= MAX_SYMBOLS {
            found.truncate(MAX_SYMBOLS);
            break;
        }
    }
    found
}

fn add(
    file: &WorkspaceFile,
    symbol: &Symbol,
    container: &str,
    query: &str,
    found: &mut Vec<WorkspaceSymbol>,
) {
    let name = if symbol.detail.is_empty() {
        symbol.name.clone()
    } else {
        format!("{} {}", symbol.name, symbol.detail)
    };
    // Sequence numbers are many and say nothing beyond their file.
    if symbol.kind != SymbolKind::Label && matches(&name, query) {
        found.push(WorkspaceSymbol {
            name,
            kind: symbol.kind,
            place: Place { file: file.id, range: symbol.selection.clone() },
            container: container.to_owned(),
        });
    }
    for child in &symbol.children {
        add(file, child, &symbol.name, query, found);
    }
}

/// Does the name hold the letters of the query in their order?
fn matches(name: &str, query: &str) -> bool {
    let mut letters = name.chars().flat_map(char::to_lowercase);
    query.chars().flat_map(char::to_lowercase).filter(|c| !c.is_whitespace()).all(|c| letters.any(|l| l == c))
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::workspace_symbols;
    use crate::fixture::Fixture;

    fn check(text: &str, query: &str, expected: &Expect) {
        let fixture = Fixture::new("haas-mill", text);
        let found = workspace_symbols(&fixture.workspace, query).into_iter().map(|symbol| {
            let place = fixture.shown(symbol.place.file, &symbol.place.range);
            format!("{:?} {} in {} @{place}\n", symbol.kind, symbol.name, symbol.container)
        });
        expected.assert_eq(&found.collect::<String>());
    }

    #[test]
    fn letters_in_order() {
        let files =
            "//- a.nc\nO1 (BRACKET)\nT1 M6 (DRILL 5)\nN5 M30\n//- b.nc\nT2 M6 (END MILL)\n(DRILLS)\nM30\n";
        check(
            files,
            "dril",
            &expect![[r#"
            Tool T1 DRILL 5 in O1 @a.nc:2: T1
            Operation DRILLS in T2 @b.nc:2: (DRILLS)
        "#]],
        );
        check(
            files,
            "BRKT",
            &expect![[r#"
            Program O1 BRACKET in a.nc @a.nc:1: O1
        "#]],
        );
        check(
            files,
            "",
            &expect![[r#"
            Program O1 BRACKET in a.nc @a.nc:1: O1
            Tool T1 DRILL 5 in O1 @a.nc:2: T1
            Tool T2 END MILL in b.nc @b.nc:1: T2
            Operation DRILLS in T2 @b.nc:2: (DRILLS)
        "#]],
        );
    }
}
