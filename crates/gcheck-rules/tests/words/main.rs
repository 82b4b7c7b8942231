//! Every code of the controls with each of its words computed, left to an earlier block, missing or out of range, and with
//! every letter that it has no use for: is the control's answer among the findings?
//!
//! Knows: what the knowledge base says of codes and letters, what `gcheck check` reports. Must not know: any rule.
//!
//! The page `docs/dev/words.md` is written from what is found (`UPDATE_EXPECT=1 cargo test -p gcheck-rules --test words`).

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

mod block;
mod case;
mod judge;
mod lasting;
mod law;
mod page;

use case::{Case, Kind};
use judge::{Answer, Judge};

/// The controls whose codes are tried.
const CONTROLS: [&str; 12] = [
    "haas-mill",
    "haas-lathe",
    "fanuc-mill",
    "fanuc-lathe",
    "fanuc-lathe-b",
    "fanuc-lathe-c",
    "linuxcnc",
    "grbl",
    "grblhal",
    "fluidnc",
    "generic-mill",
    "tsnc-yh-a1m",
];

/// Cases that may be open without a reason.
const UNJUSTIFIED: usize = 0;

/// The cases of a control with their answers, in the order of its codes.
fn answers(name: &str) -> Vec<(Case, Answer)> {
    let control = gcheck_controls::load(name).unwrap();
    let judge = Judge::new(&control);
    let codes: Vec<_> = control.codes().filter(|code| !code.is_user()).collect();
    let of_code = |code: &gcheck_controls::Code<'_>| {
        let subject = block::Subject::of(&control, *code);
        let first_line = subject.first_line();
        let base = judge.findings(&subject.program(), first_line);
        let answered = |case| {
            let answer = judge.answer(&base, &case, first_line);
            (case, answer)
        };
        case::of(&control, *code, &subject).into_iter().map(answered).collect::<Vec<_>>()
    };
    codes.iter().flat_map(of_code).collect()
}

fn table(name: &str) -> page::Table {
    let control = gcheck_controls::load(name).unwrap();
    page::Table::of(&control, &answers(name))
}

/// What became of the cases of every control, each on a thread of its own.
fn tables() -> Vec<page::Table> {
    std::thread::scope(|scope| {
        let threads = CONTROLS.map(|name| scope.spawn(move || table(name)));
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    })
}

#[test]
fn no_word_is_passed_over_in_silence() {
    let tables = tables();
    let page = page::write(&tables);
    expect_test::expect_file!["../../../../docs/dev/words.md"].assert_eq(&page);
    let unjustified: usize = tables.iter().map(|table| table.unjustified).sum();
    assert!(unjustified == UNJUSTIFIED, "{unjustified} cases are open without a reason");
}

#[test]
fn every_kind_has_cases_on_every_control() {
    for name in CONTROLS {
        let control = gcheck_controls::load(name).unwrap();
        let mut counts = [0; Kind::ALL.len()];
        for code in control.codes() {
            for case in case::of(&control, code, &block::Subject::of(&control, code)) {
                counts[case.kind as usize] += 1;
            }
        }
        let has_variables = control.syntax().variables;
        for kind in Kind::ALL.into_iter().filter(|kind| has_variables || !kind.is_computed()) {
            assert!(
                counts[kind as usize] >= 20,
                "{name}: {} cases of `{}`",
                counts[kind as usize],
                kind.name()
            );
        }
    }
}

/// What the data say of words that stay in effect, and what the engine does.
#[test]
fn words_last_in_the_engine_as_the_data_say() {
    let mut wrong = Vec::new();
    let mut telling = 0;
    for name in CONTROLS {
        let control = gcheck_controls::load(name).unwrap();
        for code in control.codes().filter(|code| !code.is_user()) {
            let subject = block::Subject::of(&control, code);
            for case in lasting::of(&control, &subject) {
                if let Some(answer) = case.judge(&control, &subject) {
                    telling += 1;
                    wrong.extend(answer.err());
                }
            }
        }
    }
    assert!(telling > 200, "{telling} cases tell something");
    assert!(wrong.is_empty(), "{} of {telling} differ:\n{}", wrong.len(), wrong.join("\n"));
}

/// The programs of the cases, the fixtures, and where there is a corpus, some of its programs.
#[test]
fn every_fault_of_a_run_is_among_the_findings_of_a_check() {
    let mut found = std::thread::scope(|scope| {
        let threads = CONTROLS.map(|name| scope.spawn(move || misses(name)));
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
    });
    found.sort();
    let lines: Vec<String> = found
        .into_iter()
        .map(|(fault, (count, at))| format!("{fault} {count} times, first at {at}"))
        .collect();
    assert!(lines.is_empty(), "{} faults are without a finding:\n{}", lines.len(), lines.join("\n"));
}

fn misses(name: &str) -> law::Misses {
    let control = gcheck_controls::load(name).unwrap();
    let judge = Judge::new(&control);
    let mut misses = law::Misses::new();
    for code in control.codes() {
        let subject = block::Subject::of(&control, code);
        for case in case::of(&control, code, &subject) {
            law::add(&mut misses, &control, &judge, &case.shown, &case.program);
        }
    }
    for (path, text) in fixtures(name) {
        law::add(&mut misses, &control, &judge, &path, &text);
    }
    misses
}

/// Fixtures of a control, and where there is a corpus, some of its programs.
fn fixtures(name: &str) -> Vec<(String, String)> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut folders = vec![root.join("clean").join(name)];
    if name == "linuxcnc" {
        let groups = std::fs::read_dir(root.join("oracle")).unwrap();
        folders.extend(groups.map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()));
    }
    let mut programs = Vec::new();
    for folder in folders.into_iter().filter(|folder| folder.is_dir()) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|kind| kind == "nc" || kind == "ngc") {
                programs.push((path.file_name().unwrap().to_string_lossy().into_owned(), read(&path)));
            }
        }
    }
    let corpus = gcheck_testkit::corpus::programs().unwrap_or_default();
    let own: Vec<_> = corpus.into_iter().filter(|program| program.control == name).collect();
    let step = own.len().div_ceil(60).max(1);
    programs.extend(own.iter().step_by(step).map(|program| (program.name.clone(), read(&program.path))));
    programs.retain(|(_, text)| text.len() < 100_000);
    programs.sort();
    programs
}

fn read(path: &std::path::Path) -> String {
    String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned()
}
