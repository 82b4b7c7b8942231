//! The laws of the architecture on programs that nobody of the project wrote.
//!
//! Skipped, saying so, where there is no real-program corpus (`GCHECK_CORPUS`).

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fs;
use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_diagnostics::Finding;
use gcheck_lint::{ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Selection, check};
use gcheck_program::{Dialect, lower, lower_tree};
use gcheck_rules::RULES;
use gcheck_syntax::{Document, SourceText, cut, parse};
use gcheck_testkit::corpus::{CorpusProgram, programs};
use rayon::prelude::*;

fn controls() -> Vec<Arc<Control>> {
    gcheck_controls::names().iter().map(|name| gcheck_controls::load(name).unwrap()).collect()
}

fn read(program: &CorpusProgram) -> SourceText {
    SourceText::from_bytes(fs::read(&program.path).unwrap()).unwrap()
}

/// Runs `law` on every program of the corpus, several at a time, and names the program when it fails.
fn on_every_program(law: impl Fn(&CorpusProgram, &SourceText) + Sync) {
    let Some(programs) = programs() else { return };
    assert!(programs.len() > 500, "the index lists {} programs", programs.len());
    programs.par_iter().for_each(|program| {
        let source = read(program);
        let run = std::panic::AssertUnwindSafe(|| law(program, &source));
        let holds = std::panic::catch_unwind(run).is_ok();
        assert!(holds, "the law does not hold for {}", program.name);
    });
}

#[test]
fn law_1_every_program_is_lossless_on_every_control() {
    on_every_program(|program, source| {
        assert_eq!(source.to_bytes(), fs::read(&program.path).unwrap());
        for control in controls() {
            let profile = Dialect::new(&control).profile();
            for range in cut(source.text()) {
                let text = &source.text()[range];
                assert_eq!(parse(text, profile).syntax().text().to_string(), text);
            }
        }
    });
}

#[test]
fn law_2_tree_and_tokens_give_the_same_blocks() {
    on_every_program(|_, source| {
        for control in controls() {
            let dialect = Dialect::new(&control);
            for range in cut(source.text()) {
                let text = &source.text()[range];
                let flat = lower(text, &dialect);
                let tree = lower_tree(&parse(text, dialect.profile()), text, &dialect);
                assert_eq!(flat, tree, "{}", control.name());
            }
        }
    });
}

#[test]
fn law_3_an_edited_program_is_a_fresh_one() {
    on_every_program(|program, source| {
        let mut document = Document::new(source.text());
        let mut text = source.text().to_owned();
        // A different edit for each program, the same in each run.
        let mut state = program
            .name
            .bytes()
            .fold(7_usize, |hash, byte| hash.wrapping_mul(31).wrapping_add(usize::from(byte)));
        for insert in ["", "G1 X1.\n", "(", "\r", "%\n", "N10 G0\r\nX5."] {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let mut start = (state >> 16) % (text.len() + 1);
            let mut end = (start + (state >> 8) % 80).min(text.len());
            while !text.is_char_boundary(start) {
                start -= 1;
            }
            while !text.is_char_boundary(end) {
                end += 1;
            }
            document.edit(start..end, insert).unwrap();
            text.replace_range(start..end, insert);
            assert_eq!(document, Document::new(&text));
        }
    });
}

fn findings(control: &Control, source: &SourceText) -> Vec<Finding> {
    let dialect = Dialect::new(control);
    let machine = MachineFacts::default();
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &NoPrograms,
        control_basis: ControlBasis::Chosen,
        unsupported: None,
    };
    let mut selection = Selection::recommended(RULES);
    selection.enable("all").unwrap();
    check(&Job {
        source,
        environment,
        selection: &selection,
        suppressions: true,
        execution: Execution::default(),
    })
    .findings
}

#[test]
fn law_7_every_program_is_checked_on_every_control() {
    on_every_program(|_, source| {
        for control in controls() {
            for finding in findings(&control, source) {
                let text = source.text();
                let places = finding.labels.iter().filter(|l| l.file.is_none()).map(|l| &l.range);
                for range in places.chain([&finding.range]) {
                    assert!(
                        text.get(range.start as usize..range.end as usize).is_some(),
                        "{}: {range:?}",
                        finding.rule.id
                    );
                }
            }
        }
    });
}

#[test]
fn law_8_the_same_program_gives_the_same_findings() {
    on_every_program(|program, source| {
        let Ok(control) = gcheck_controls::load(&program.control) else { return };
        assert_eq!(format!("{:?}", findings(&control, source)), format!("{:?}", findings(&control, source)));
    });
}
