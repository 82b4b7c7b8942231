//! What comments on lines of their own call the blocks after them.

use gcheck_program::{Dialect, Headings, Loaded};

/// The headings of a program, each with the line from which on it holds.
fn headings(program: &str) -> Vec<(String, String)> {
    let mut headings = Headings::default();
    if let Ok(control) = gcheck_controls::load("haas-mill") {
        let _ = Loaded::new(program, &Dialect::new(&control), |base, table, part| {
            headings.look(base, table, part);
        });
    }
    let found = headings.into_found().into_iter().map(|heading| {
        let line = program.get(heading.from as usize..).and_then(|rest| rest.lines().next());
        (line.unwrap_or_default().to_owned(), heading.name)
    });
    found.collect()
}

#[track_caller]
fn check(program: &str, expected: &[(&str, &str)]) {
    let found = headings(program);
    let found: Vec<(&str, &str)> = found.iter().map(|(line, name)| (line.as_str(), name.as_str())).collect();
    assert_eq!(found, expected, "{program}");
}

#[test]
fn a_comment_names_the_blocks_after_it() {
    check(
        "G0 X1.\n(ROUGH)\nG1 X2.\nX3.\nN5 (FINISH)\nG1 X4.\n",
        &[("G1 X2.", "ROUGH"), ("G1 X4.", "FINISH")],
    );
}

#[test]
fn the_first_of_several_comments_is_the_name() {
    check("(POCKET 2)\n(STOCK 0.3)\n\nT1 M6 (END MILL)\n", &[("T1 M6 (END MILL)", "POCKET 2")]);
}

#[test]
fn rules_for_gcheck_and_rows_of_signs_name_nothing() {
    check("(gcheck: control=haas-mill)\nG0 X1.\n(-----)\nG1 X2.\n", &[]);
}

#[test]
fn a_comment_with_nothing_after_it_names_nothing() {
    check("G0 X1.\n(END)\n%\n", &[]);
}
