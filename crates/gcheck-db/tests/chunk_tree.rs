//! What a snapshot tells of the structure at a byte.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_db::{Database, Settings, Snapshot};
use gcheck_syntax::ast::{Element, Statement};

fn snapshot(text: &str) -> Snapshot {
    let mut database = Database::new();
    let settings = Settings::new(gcheck_controls::load("haas-mill").unwrap(), gcheck_rules::RULES);
    let id = database.open(text, settings);
    database.indexed(id).unwrap()
}

#[test]
fn elements_have_their_bytes_of_the_file_in_every_chunk() {
    let text: String = (0..6_000).map(|line| format!("N{line} X#1 (CUT {line})\n")).collect();
    let snapshot = snapshot(&text);
    assert!(snapshot.chunks().len() > 3);
    for line in (0..6_000).step_by(7) {
        let range = snapshot.line_range(line);
        let tree = snapshot.tree_at(range.start).unwrap();
        let place = |offset: u32| {
            let element = tree.element_at(offset).unwrap();
            let place = tree.in_file(element.range());
            (element, snapshot.slice(place).into_owned())
        };
        let (word, written) = place(range.start);
        assert!(matches!(word, Element::Word(_)));
        assert_eq!(written, format!("N{line}"));
        let (comment, written) = place(range.end - 1);
        assert!(matches!(comment, Element::Comment(_)));
        assert_eq!(written, format!("(CUT {line})"));
        let block = tree.block_at(range.end - 1).unwrap();
        assert_eq!(tree.in_file(block.range()), range.start..range.end + 1);
    }
}

#[test]
fn the_blocks_of_a_line() {
    let snapshot = snapshot("G0 X1.\nG1 Y1. ; Z2. ; IF [#1 EQ 2] GOTO 9\n\nM30");
    let tree = snapshot.tree_at(0).unwrap();
    let counts: Vec<usize> = (0..4).map(|line| tree.blocks(snapshot.line_range(line)).count()).collect();
    assert_eq!(counts, [1, 3, 0, 1]);
    let line: Vec<_> = tree.blocks(snapshot.line_range(1)).collect();
    assert!(matches!(line[2].statements().next(), Some(Statement::If(_))));
    assert_eq!(tree.token_before(snapshot.len()).unwrap().text(), "M30");
    assert_eq!(tree.token_at(snapshot.len()), None);
}

#[test]
fn an_empty_document_has_no_tree() {
    assert!(snapshot("").tree_at(0).is_none());
}
