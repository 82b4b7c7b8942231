//! Blocks that only move are executed on a path of their own: what they do is what the step does.
//!
//! A sequence number in front of a block changes nothing but the path that it takes. So every program here is executed twice,
//! once with a number in front of each block, and must make the same events in the same states.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use gcheck_engine::{
    Abstract, Concrete, Event, FlowCx, FlowObserver, Machine, Model, NoLibrary, Observer, Options, Origin,
    Position, Program, State, Task, flow, run,
};
use gcheck_program::{Dialect, Loaded};
use proptest::prelude::*;

/// What happens, one line an event.
#[derive(Default)]
struct Events(String);

impl Observer<Concrete> for Events {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        let _ = writeln!(self.0, "block {} {:?}", origin.at.block, state.position());
    }

    fn event(&mut self, origin: Origin, state: &State<Concrete>, event: &Event) {
        let (at, position, actual) = (origin.at, state.position(), state.actual());
        let _ = writeln!(self.0, "{at:?} {event:?} {position:?} {actual:?}");
    }
}

impl FlowObserver for Events {
    fn before(&mut self, cx: &FlowCx<'_>) {
        let _ = writeln!(self.0, "block {} {:?}", cx.origin.at.block, cx.state.position());
    }

    fn event(&mut self, cx: &FlowCx<'_>, event: &Event) {
        let (at, position, actual) = (cx.origin.at, cx.state.position(), cx.state.actual());
        let _ = writeln!(self.0, "{at:?} {event:?} {position:?} {actual:?} {}", cx.solo);
    }

    fn after(&mut self, cx: &FlowCx<'_>) {
        let _ = writeln!(self.0, "after {:?}", State::<Abstract>::position(cx.state));
    }
}

/// Events of the run and of the analysis of all paths, and what is reached.
fn executed(control: &str, text: &str) -> (String, String) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let machine = Machine { start: Some(Position::ZERO), ..Machine::default() };
    let program = Program::new(Loaded::new(text, &dialect, |_, _, _| ()), &dialect, &NoLibrary);
    let mut ran = Events::default();
    let result = run(&program, &model, &machine, Options::NONE, 10_000, &mut ran);
    let _ = writeln!(ran.0, "{:?} after {} blocks", result.stopped, result.blocks);
    let mut all = Events::default();
    let result = flow(&program, &model, &machine, Task::all_paths(10_000), &mut all);
    let blocks = program.file(0).unwrap().loaded.flow_graph().blocks();
    let reached = (0..blocks).map(|block| result.reach(gcheck_engine::At { file: 0, block }));
    let _ = writeln!(all.0, "{:?} after {} blocks", reached.collect::<Vec<_>>(), result.work);
    (ran.0, all.0)
}

/// Lines that a program is made of: most only move, others change what moving means.
const LINES: [&str; 46] = [
    "X1.",
    "Y-2.5",
    "X1. Y1.",
    "Z-0.",
    "X-0.0 Y0.0",
    "X3. Y4. Z5.",
    "A30.",
    "Z.5",
    "X10.125 Z-1.",
    "U2.",
    "W-1.",
    "X1. Y2. Z3. A4.",
    "B15. C20.",
    "G0",
    "G1",
    "G1 X2.",
    "G0 X0. Y0. Z5.",
    "G90",
    "G91",
    "G20",
    "G21",
    "F100.",
    "F0.",
    "G93",
    "G94",
    "G95",
    "S500 M3",
    "G68 R30.",
    "G69",
    "G41 D1",
    "G40",
    "G81 Z-1. R1. F50.",
    "G80",
    "G2 X5. Y5. R10.",
    "G53 X1.",
    "G52 X1.",
    "G92 X0.",
    "G43 H1",
    "G16",
    "G15",
    "G51 P2.",
    "G50",
    "M1",
    "X1. X2.",
    "#1=2.",
    "G7",
];

fn check(control: &str, lines: &[usize]) {
    let line = |index: &usize| LINES.get(index % LINES.len()).copied().unwrap_or_default();
    let lines: Vec<&str> =
        ["G21 G90", "G1 F100."].into_iter().chain(lines.iter().map(line)).chain(["M30"]).collect();
    let plain: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let numbered: String = lines.iter().enumerate().map(|(n, line)| format!("N{} {line}\n", n + 1)).collect();
    let (plain_run, plain_flow) = executed(control, &plain);
    let (run, flow) = executed(control, &numbered);
    assert_eq!(plain_run, run, "a run on {control} of\n{plain}");
    assert_eq!(plain_flow, flow, "all paths on {control} of\n{plain}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_sequence_number_changes_no_move(
        control in prop::sample::select(vec!["haas-mill", "fanuc-mill", "fanuc-lathe", "haas-lathe", "linuxcnc"]),
        lines in prop::collection::vec(0_usize..46, 1..40),
    ) {
        check(control, &lines);
    }
}

#[test]
fn each_line_alone_does_the_same_on_both_paths() {
    for control in ["haas-mill", "fanuc-mill", "fanuc-lathe", "haas-lathe", "linuxcnc", "generic-mill"] {
        for line in 0..LINES.len() {
            check(control, &[line, 0, 5, 2]);
            check(control, &[0, line, 5, 2, 13, 2, 18, 2]);
        }
    }
}
