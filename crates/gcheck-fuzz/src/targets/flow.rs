//! Law 4, and what a check says of faults: the analysis of all paths covers every run, and a run that faults has a finding.
//!
//! Knows: runs and analyses of a program. Must not know: how programs are made.

use gcheck_engine::{Fault, Machine, Model, NoLibrary, Nobody, Options, Program, Stopped, run as execute};
use gcheck_program::{Dialect, Loaded};
use gcheck_syntax::SourceText;

use crate::draw::Random;
use crate::law::{self, Case};
use crate::programs;

pub(crate) fn run(bytes: &[u8]) {
    let case = programs::case(bytes);
    let covered = law::check(
        &Case {
            name: "fuzzed",
            control: case.control.name(),
            text: &case.text,
            machine: &Machine::default(),
            library: &NoLibrary,
            work: super::WORK,
            fuel: 3_000,
        },
        2,
        &mut Random::new(bytes.len() as u64),
    );
    if let Err(gap) = covered {
        panic!("the analysis does not cover a run: {gap}");
    }
    let dialect = Dialect::new(case.control);
    let source = SourceText::from(case.text.as_str());
    let outcome = super::checked(&source, &dialect);
    super::assert_places(&outcome, source.text());
    let again = super::checked(&source, &dialect);
    assert_eq!(outcome.findings, again.findings, "the same input gives the same findings");

    let model = Model::new(case.control);
    let loaded = Loaded::new(source.text(), &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let ran = execute(&program, &model, &Machine::default(), Options::NONE, 3_000, Nobody);
    if let Stopped::Faulted(fault) = ran.stopped
        && fault != Fault::Undecidable
        && !outcome.out_of_fuel
        && outcome.suppressed == 0
        // `M99 P…` names a block of the program that calls this one.
        && !(matches!(fault, Fault::NoSuchLabel(_)) && case.text.contains("M99"))
    {
        assert!(
            !outcome.findings.is_empty(),
            "a run stops ({fault:?}), and a check says nothing of\n{}",
            case.text
        );
    }
}
