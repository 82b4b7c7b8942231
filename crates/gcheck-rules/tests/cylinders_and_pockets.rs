//! Cylinders and pockets with every word wrong in every way: nothing is called an error that only may be one, and a mistake is
//! found wherever it is.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

use std::collections::BTreeSet;
use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_diagnostics::Severity;
use gcheck_lint::{ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Selection, check};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

/// Errors and warnings of a program, each rule once.
fn findings(program: &str) -> BTreeSet<String> {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let machine = MachineFacts::default();
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &NoPrograms,
        control_basis: ControlBasis::Chosen,
        unsupported: None,
    };
    let source = SourceText::from(program);
    let outcome = check(&Job {
        source: &source,
        environment,
        selection: &Selection::recommended(RULES),
        suppressions: false,
        execution: Execution::default(),
    });
    let grave = outcome.findings.iter().filter(|f| f.severity >= Severity::Warning);
    grave.map(|f| format!("{}[{}]", f.severity, f.rule.id)).collect()
}

/// Where a block is.
const PLACES: [(&str, &str, &str); 4] = [
    ("plain", "", ""),
    ("behind a block skip", "/", ""),
    ("in a loop", "WHILE [#101 LT 3] DO1\n#101=#101+1\n", "\nEND1"),
    ("in a subprogram", "M97 P900\nM30\nN900 ", "\nM99"),
];

const OUTLINE: &str = "O9\nG1 Y1.\nX-1.\nY-1.\nX1.\nY1.\nX0.\nM99\n";

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
    check_words(
        &["G107", "Y0.", "A0.", "Q2.5"],
        &expect![[r#"
        Y0. missing: warning[cylinder-end-without-begin]
        Y0. twice: warning[word-given-twice]
        Y0. -1.: warning[cylinder-word-value-ignored]
        Y0. 0.: 
        Y0. 99999.: warning[cylinder-word-value-ignored]
        Y0. ABC: error[unexpected-text]
        Y0. #100: 
        A0. missing: error[cylinder-without-rotary-axis]
        A0. twice: warning[word-given-twice]
        A0. -1.: warning[cylinder-word-value-ignored]
        A0. 0.: 
        A0. 99999.: warning[cylinder-word-value-ignored]
        A0. ABC: error[unexpected-text]
        A0. #100: 
        Q2.5 missing: 
        Q2.5 twice: warning[word-given-twice]
        Q2.5 -1.: error[number-out-of-range]
        Q2.5 0.: 
        Q2.5 99999.: 
        Q2.5 ABC: error[unexpected-text]
        Q2.5 #100: 
    "#]],
    );
}

#[test]
fn words_of_a_pocket() {
    let words = ["G150", "P9", "G41", "D1", "X0.", "Y0.", "Z-.5", "Q.25", "R.1", "I.2", "K.01"];
    check_words(
        &words,
        &expect![[r#"
            P9 missing: error[required-word-missing]
            P9 twice: warning[word-given-twice]
            P9 -1.: error[decimal-point-on-integer] error[number-out-of-range]
            P9 0.: error[decimal-point-on-integer] warning[subprogram-missing]
            P9 99999.: error[decimal-point-on-integer]
            P9 ABC: error[unexpected-text]
            P9 #100: 
            G41 missing: 
            G41 twice: 
            G41 -1.: error[unknown-code]
            G41 0.: 
            G41 99999.: error[unknown-code]
            G41 ABC: error[unexpected-text]
            G41 #100: 
            D1 missing: warning[lasting-word-never-given]
            D1 twice: warning[word-given-twice]
            D1 -1.: error[decimal-point-on-integer] error[sign-not-accepted]
            D1 0.: error[decimal-point-on-integer]
            D1 99999.: error[decimal-point-on-integer] error[number-out-of-range]
            D1 ABC: error[unexpected-text]
            D1 #100: 
            X0. missing: 
            X0. twice: warning[word-given-twice]
            X0. -1.: error[pocket-outline-open]
            X0. 0.: 
            X0. 99999.: error[pocket-outline-open]
            X0. ABC: error[unexpected-text]
            X0. #100: 
            Y0. missing: 
            Y0. twice: warning[word-given-twice]
            Y0. -1.: 
            Y0. 0.: 
            Y0. 99999.: error[pocket-start-outside]
            Y0. ABC: error[unexpected-text]
            Y0. #100: 
            Z-.5 missing: error[required-word-missing]
            Z-.5 twice: warning[word-given-twice]
            Z-.5 -1.: 
            Z-.5 0.: 
            Z-.5 99999.: warning[cycle-r-below-bottom]
            Z-.5 ABC: error[unexpected-text]
            Z-.5 #100: 
            Q.25 missing: error[required-word-missing]
            Q.25 twice: warning[word-given-twice]
            Q.25 -1.: error[number-out-of-range]
            Q.25 0.: error[number-out-of-range]
            Q.25 99999.: 
            Q.25 ABC: error[unexpected-text]
            Q.25 #100: 
            R.1 missing: warning[lasting-word-never-given]
            R.1 twice: warning[word-given-twice]
            R.1 -1.: warning[cycle-r-below-bottom]
            R.1 0.: 
            R.1 99999.: warning[cycle-numbers-contradict]
            R.1 ABC: error[unexpected-text]
            R.1 #100: 
            I.2 missing: error[word-choice-missing]
            I.2 twice: warning[word-given-twice]
            I.2 -1.: error[number-out-of-range]
            I.2 0.: error[number-out-of-range]
            I.2 99999.: 
            I.2 ABC: error[unexpected-text]
            I.2 #100: 
            K.01 missing: 
            K.01 twice: warning[word-given-twice]
            K.01 -1.: error[number-out-of-range]
            K.01 0.: 
            K.01 99999.: 
            K.01 ABC: error[unexpected-text]
            K.01 #100: 
        "#]],
    );
}
