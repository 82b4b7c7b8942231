//! Recall: mistakes that machinists fear are put into programs without one, and gcheck is asked whether it sees them.
//!
//! Knows: the kinds of mistakes, under `kinds`, and what came of each. Must not know: how anything is checked; the product is
//! run as its users run it.
//!
//! The programs are ours (`fixtures/clean`) and, where `GCHECK_CORPUS` names it, those of the real-program corpus about which
//! gcheck has nothing to say. Which place of which program gets a mistake is drawn by hashing names: the same every time.
//!
//! The page `docs/recall.md` is written from what is found (`UPDATE_EXPECT=1 cargo test -p gcheck-tests --test seeded`).

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

mod cases;
mod kind;
mod kinds;
mod page;
mod product;
mod program;
mod table;

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};

use cases::Case;
use gcheck_testkit::blind::{self, MistakeSet};
use table::{Row, Table};

/// Percent of the mistakes that the strict rules find at least: what was reached once is not lost again.
const STRICT_SHARE: usize = 96;
/// Percent that is found at least when nobody chooses rules.
const SHARE: usize = 95;

/// The folder of this file.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn count(cases: &[Case]) -> Table {
    Table::count(cases, &product::found(cases, product::BY_DEFAULT), &product::found(cases, product::STRICT))
}

fn enough(Row { made, found, strictly }: Row) {
    assert!(found * 100 >= made * SHARE, "{found} of {made} mistakes were found by default");
    assert!(strictly * 100 >= made * STRICT_SHARE, "{strictly} of {made} mistakes were found strictly");
}

#[test]
fn programs_without_mistakes_are_clean() {
    let programs = cases::ours();
    assert!(programs.len() >= 8);
    let found = product::check_clean(&programs);
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn kinds_are_told_apart_and_name_rules_that_exist() {
    let ids: BTreeSet<&str> = kinds::all().map(|kind| kind.id).collect();
    assert_eq!(ids.len(), kinds::all().count(), "an id is used twice");
    assert!(ids.len() >= 60, "{} kinds", ids.len());
    for kind in kinds::all() {
        for rule in kind.found_by {
            assert!(gcheck_rules::RULES.by_id(rule).is_some(), "{}: there is no rule `{rule}`", kind.id);
        }
    }
}

#[test]
fn mistakes_in_our_programs_are_found() {
    let programs = cases::ours();
    let cases = cases::of_ours(&programs);
    for kind in kinds::all() {
        assert!(
            cases.iter().any(|case| case.kind.id == kind.id),
            "{}: no program has a place for it",
            kind.id
        );
    }
    let table = count(&cases);
    let corpus = Table::read(include_str!("../../recall-corpus.tsv"));
    let others = page::Others::read(include_str!("../../competitors.tsv"));
    let first_looks = blind::recall(&MistakeSet::all(&blind::folder()).unwrap());
    let page = blind::with_section(&page::write(&table, &corpus, &others), &first_looks);
    expect_test::expect_file!["../../../docs/recall.md"].assert_eq(&page);
    enough(table.total());
}

#[test]
fn mistakes_in_programs_of_the_corpus_are_found() {
    let Some(programs) = cases::of_the_corpus() else { return };
    let programs = product::only_clean(programs);
    let cases = cases::in_the_corpus(&programs);
    let table = count(&cases);
    expect_test::expect_file!["../../recall-corpus.tsv"].assert_eq(&table.write());
    enough(table.total());
}

/// For `cargo xtask competitors`, which runs other checkers on the same cases.
#[test]
fn the_cases_are_written_where_they_are_asked_for() {
    let Some(folder) = env::var_os("GCHECK_SEEDED_CASES") else { return };
    let programs = cases::ours();
    Case::write_all(&cases::of_ours(&programs), &programs, Path::new(&folder));
}
