//! Cylinders and pockets with every word wrong in every way: nothing is called an error that only may be one, and a mistake is
//! found wherever it stands.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

use std::collections::BTreeSet;
use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_program::Dialect;
use gcheck_rules::{Execution, Job, MachineFacts, NoPrograms, Scene, Selection, Severity, check};
use gcheck_syntax::SourceText;

/// Errors and warnings of a program, each rule once.
fn findings(program: &str) -> BTreeSet<String> {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let machine = MachineFacts::default();
    let scene =
        Scene { dialect: &dialect, machine: &machine, programs: &NoPrograms, control_is_guessed: false };
    let source = SourceText::from(program);
    let outcome = check(&Job {
        source: &source,
        scene,
        selection: &Selection::default(),
        suppressions: false,
        execution: Execution::default(),
    });
    let grave = outcome.findings.iter().filter(|f| f.severity >= Severity::Warning);
    grave.map(|f| format!("{}[{}]", f.severity, f.rule.id)).collect()
}

/// Where a block stands.
const PLACES: [(&str, &str, &str); 4] = [
    ("plain", "", ""),
    ("behind a block skip", "/", ""),
    ("in a loop", "WHILE [#101 LT 3] DO1\n#101=#101+1\n", "\nEND1"),
    ("in a subprogram", "M97 P900\nM30\nN900 ", "\nM99"),
];

const OUTLINE: &str = "O9\nG1 Y1.\nX1.\nY-1.\nX-1.\nY1.\nX0.\nM99\n";

fn program(block: &str, (_, before, behind): (&str, &str, &str)) -> String {
    let head = "O1\nG20 G90 G94 G17 G54 G0 X0. Y0. A0.\nZ1. F10.\n";
    format!("{head}{before}{block}{behind}\nG40 X0. Y0.\nG107\nM30\n{OUTLINE}")
}

/// The block with each word missing, twice, and with other values.
fn spoilt(words: &[&str], at: usize) -> Vec<(String, String)> {
    let with = |word: &str| {
        let mut block: Vec<&str> = words.to_vec();
        if word.is_empty() {
            block.remove(at);
        } else {
            block.splice(at..=at, [word]);
        }
        block.join(" ")
    };
    let letter = &words[at][..1];
    let mut variants =
        vec![("missing".to_owned(), with("")), ("twice".to_owned(), with(&format!("{0} {0}", words[at])))];
    for value in ["-1.", "0.", "99999.", "ABC", "#100"] {
        variants.push((value.to_owned(), with(&format!("{letter}{value}"))));
    }
    variants
}

fn check_words(words: &[&str], expected: &Expect) {
    let mut table = String::new();
    for at in 1..words.len() {
        for (what, block) in spoilt(words, at) {
            let plain = findings(&program(&block, PLACES[0]));
            if what == "#100" {
                assert!(!plain.iter().any(|f| f.starts_with("error")), "{block}: {plain:?}");
            }
            for place in PLACES {
                let there = findings(&program(&block, place));
                let lost: Vec<_> = plain.difference(&there).filter(|f| f.starts_with("error")).collect();
                assert!(lost.is_empty(), "{block} {}: {lost:?} are not found", place.0);
            }
            let found: Vec<&str> = plain.iter().map(String::as_str).collect();
            writeln!(table, "{} {what}: {}", words[at], found.join(" ")).unwrap();
        }
    }
    expected.assert_eq(&table);
}

#[test]
fn words_of_a_cylinder() {
    check_words(&["G107", "Y0.", "A0.", "Q2.5"], &expect![[""]]);
}

#[test]
fn words_of_a_pocket() {
    let words = ["G150", "P9", "G41", "D1", "X0.", "Y0.", "Z-.5", "Q.25", "R.1", "I.2", "K.01"];
    check_words(&words, &expect![[""]]);
}
