//! A run ends, within its fuel, whatever the switches; past alarms it goes at least as far.
//!
//! Knows: runs. Must not know: what is written of them.

use gcheck_engine::{Machine, Model, NoLibrary, Nobody, Options, Program, Stopped, run as execute};
use gcheck_program::{Dialect, Loaded};

use crate::programs;

/// Blocks that a run may execute.
const FUEL: u64 = 5_000;

pub(crate) fn run(bytes: &[u8]) {
    let case = programs::case(bytes);
    let dialect = Dialect::new(case.control);
    let model = Model::new(case.control);
    let program = Program::new(Loaded::new(&case.text, &dialect, |_, _, _| ()), &dialect, &NoLibrary);
    let go = |options: Options, fuel: u64| {
        let ran = execute(&program, &model, &Machine::default(), options, fuel, Nobody);
        assert!(ran.blocks <= fuel, "{} blocks of {fuel}", ran.blocks);
        ran
    };
    let plain = go(Options::NONE, FUEL);
    let again = go(Options::NONE, FUEL);
    assert_eq!((&plain.stopped, plain.blocks), (&again.stopped, again.blocks), "twice is once");
    go(Options::SKIP_ALL, FUEL);
    go(Options { optional_stop: true, ..Options::NONE }, 7);
    let past = go(Options { past_alarms: true, ..Options::NONE }, FUEL);
    // Past an alarm, a cycle may give strokes that cost the fuel of later blocks.
    let is_cut = past.stopped == Stopped::OutOfFuel;
    assert!(
        is_cut || past.blocks >= plain.blocks,
        "past alarms a run goes on: {} and {}",
        past.blocks,
        plain.blocks
    );
}
