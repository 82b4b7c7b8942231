//! Law 4: the analysis of all paths covers every run.
//!
//! Programs run many times, each time with other values for what nobody told: variables, block delete switches, touches of
//! probes, offsets, tools. Before every block the state of the run must be one that the analysis shows there
//! ([`Lattice::covers`](gcheck_engine::Lattice::covers), the function that the engine itself asks), on the same way of calls;
//! every move, every other event, every fault and every end of the run must be one that the analysis shows. No block that a
//! run comes to may be called unreachable, and when it comes to the program's end, it was at every block that the analysis
//! says every path comes to.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::print_stderr,
    reason = "a test that meets the unexpected is to fail, and says what it compared"
)]

mod draw;
mod generator;
mod law;
mod material;
mod programs;

use std::cell::{Cell, RefCell};

use gcheck_engine::{Machine, NoLibrary};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use crate::draw::Random;
use crate::generator::{Style, Writer};
use crate::law::{Case, Counts, check};

/// Random programs of a control.
fn law(control: &'static str, style: Style, cases: u32) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 5_000, ..Config::default() };
    // The same programs in every run.
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let strategy = (prop::collection::vec(any::<u8>(), 10..260), any::<u64>());
    let counts = RefCell::new(Counts::default());
    let result = runner.run(&strategy, |(choices, seed)| {
        let text = Writer::new(&choices, style).program();
        let machine = Machine::default();
        let case = Case {
            name: "generated",
            control,
            text: &text,
            machine: &machine,
            library: &NoLibrary,
            work: 40_000,
            fuel: 3_000,
        };
        let seen = check(&case, 3, &mut Random::new(seed)).map_err(TestCaseError::fail)?;
        counts.borrow_mut().add(seen);
        Ok(())
    });
    let counts = counts.into_inner();
    eprintln!("{control}, {style:?}: {counts:?}");
    if let Err(error) = result {
        panic!("{control}: {error}");
    }
    // A law that hardly says anything of a program would say little.
    assert!(counts.left_out * 10 < counts.programs, "{control}: {counts:?}");
    assert!(counts.ended * 5 > counts.runs, "{control}: {counts:?}");
}

#[test]
fn the_flow_covers_the_run_with_gotos_and_macros() {
    law("fanuc-mill", Style::Macro, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_local_subprograms() {
    law("haas-mill", Style::Local, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_shifts_by_the_tool() {
    law("haas-mill", Style::FiveAxis, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_o_words() {
    law("linuxcnc", Style::OWords, 2_000);
}

#[test]
fn the_flow_covers_the_run_on_a_lathe() {
    law("fanuc-lathe", Style::Lathe, 1_000);
    law("haas-lathe", Style::Lathe, 1_000);
}

/// Checks programs one after the other; all that fail are named.
fn all(programs: &[material::Source], runs: u32, fuel: u64) -> Counts {
    let counts = Cell::new(Counts::default());
    let mut failures = Vec::new();
    for (number, source) in programs.iter().enumerate() {
        let case = Case {
            name: &source.name,
            control: &source.control,
            text: &source.text,
            machine: &source.machine,
            library: &source.folder,
            work: 200_000,
            fuel,
        };
        match check(&case, runs, &mut Random::new(number as u64)) {
            Ok(seen) => {
                let mut sum = counts.get();
                sum.add(seen);
                counts.set(sum);
            }
            Err(why) => failures.push(why),
        }
    }
    let count = failures.len();
    failures.truncate(10);
    assert!(failures.is_empty(), "{count} of {} programs:\n{}", programs.len(), failures.join("\n"));
    counts.into_inner()
}

#[test]
fn the_flow_covers_the_runs_of_programs_written_for_each_field() {
    let counts = all(&programs::sources(), 24, 3_000);
    eprintln!("programs for each field: {counts:?}");
}

#[test]
fn the_flow_covers_the_runs_of_the_fixtures() {
    let counts = all(&material::fixtures(), 6, 20_000);
    eprintln!("fixtures: {counts:?}");
    assert!(counts.left_out * 20 < counts.programs, "{counts:?}");
}

#[test]
fn the_flow_covers_the_runs_of_the_corpus() {
    let Some(programs) = material::corpus() else { return };
    let counts = all(&programs, 4, 10_000);
    eprintln!("corpus: {counts:?}");
    assert!(counts.left_out * 5 < counts.programs, "{counts:?}");
}
