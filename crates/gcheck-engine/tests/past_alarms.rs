//! Runs that go on after an alarm: the block has the effect that it has once the programmer has corrected it.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Assumption, Axis, Concrete, Event, Fault, Machine, Model, NoLibrary, Observer, Options, Origin, Position,
    Program, State, run,
};
use gcheck_program::{Dialect, Loaded};

/// Writes down where the axes go, and where the control would stop.
#[derive(Default)]
struct Moves(String);

impl Observer<Concrete> for Moves {
    fn event(&mut self, _: Origin, _: &State<Concrete>, event: &Event) {
        let (way, to) = match event {
            Event::Travel(travel) => (format!("{:?}", travel.kind), travel.to),
            Event::Arc(arc) => ("Arc".to_owned(), arc.to),
            _ => return,
        };
        writeln!(self.0, "{} {}", way.to_lowercase(), shown(&to)).unwrap();
    }

    fn fault(&mut self, origin: Origin, _: &State<Concrete>, fault: &Fault) {
        writeln!(self.0, "block {}: {fault:?}", origin.at.block).unwrap();
    }

    fn assumed(&mut self, origin: Origin, assumption: &Assumption) {
        if matches!(assumption, Assumption::MissingProgram(_) | Assumption::ProbeTouch) {
            writeln!(self.0, "block {}: assumed {assumption:?}", origin.at.block).unwrap();
        }
    }
}

fn shown(at: &Position) -> String {
    let known = [Axis::X, Axis::Y, Axis::Z].into_iter().filter(|axis| !at.raw(*axis).is_nan());
    known.map(|axis| format!("{}{}", axis.name(), at.raw(axis))).collect::<Vec<_>>().join(" ")
}

fn check_on(control: &str, program: &str, expected: &Expect) {
    check_with(Options { past_alarms: true, ..Options::NONE }, control, program, expected);
}

fn check_with(options: Options, control: &str, program: &str, expected: &Expect) {
    expected.assert_eq(&ran_with(options, control, program, 1_000));
}

fn ran_with(options: Options, control: &str, program: &str, fuel: u64) -> String {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let loaded = Loaded::new(program, &dialect, |_, _, _| {});
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let mut moves = Moves::default();
    let result = run(&program, &model, &Machine::default(), options, fuel, &mut moves);
    writeln!(moves.0, "{:?}, {} alarms", result.stopped, result.alarms.len()).unwrap();
    moves.0
}

fn check(program: &str, expected: &Expect) {
    check_on("haas-mill", program, expected);
}

#[test]
fn an_arc_off_its_circle_is_a_line_to_its_end() {
    check(
        "O1\nG21 G90 G0 X0. Y0. Z5.\nG1 X10. F100.\nG2 X20. Y0. I3. J0.\nG1 Y10.\nM30\n",
        &expect![[r#"
            rapid X0 Y0 Z5
            feed X10 Y0 Z5
            block 3: Arc(OffCircle { start: 3.0, end: 7.0 })
            feed X20 Y0 Z5
            feed X20 Y10 Z5
            Ended(Program), 1 alarms
        "#]],
    );
}

#[test]
fn a_cycle_without_its_peck_drills_as_the_plainest_cycle() {
    check_on(
        "linuxcnc",
        "G21 G90 G0 X0 Y0 Z50 F100\nG83 X5 Z-10 R2\nG80\nG0 Z60\nM2\n",
        &expect![[r#"
        rapid X0 Y0 Z50
        rapid X5 Y0 Z50
        rapid X5 Y0 Z2
        feed X5 Y0 Z-10
        rapid X5 Y0 Z2
        block 1: Cycle(Missing(Q))
        rapid X5 Y0 Z60
        Ended(Program), 1 alarms
    "#]],
    );
}

#[test]
fn a_half_typed_cycle_goes_to_its_hole_and_the_rest_is_run() {
    check(
        "O1\nG21 G90 G0 X0. Y0. Z50.\nG83 X5. Y6.\nG80\nG0 X9.\nM30\n",
        &expect![[r#"
            rapid X0 Y0 Z50
            block 2: Cycle(Missing(Z))
            rapid X5 Y6 Z50
            rapid X9 Y6 Z50
            Ended(Program), 1 alarms
        "#]],
    );
}

#[test]
fn a_jump_to_a_missing_label_falls_through() {
    check(
        "O1\nG21 G90 G0 X1. Y0. Z50.\nGOTO 77\nG0 X2.\nM30\n",
        &expect![[r#"
        rapid X1 Y0 Z50
        block 2: NoSuchLabel(77)
        rapid X2 Y0 Z50
        Ended(Program), 1 alarms
    "#]],
    );
}

#[test]
fn a_condition_that_nobody_knows_is_taken_once_each_way() {
    check(
        "O1\nG21 G90 G0 X1. Y0. Z50.\nWHILE [#500 EQ 1] DO1\nG91 G0 X1.\nG90\nEND1\nG0 Y2.\nM30\n",
        &expect![[r#"
            rapid X1 Y0 Z50
            block 2: Undecidable
            rapid X2 Y0 Z50
            rapid X2 Y2 Z50
            Ended(Program), 1 alarms
        "#]],
    );
}

#[test]
fn a_subprogram_without_return_goes_back_to_its_caller() {
    check(
        "O1\nG21 G90 G0 X1. Y0. Z50.\nM98 P2\nG0 X3.\nM30\nO2\nG0 X2.\n",
        &expect![[r#"
        rapid X1 Y0 Z50
        rapid X2 Y0 Z50
        block 7: NoProgramEnd
        rapid X3 Y0 Z50
        Ended(Program), 1 alarms
    "#]],
    );
}

#[test]
fn what_a_strict_control_refuses_is_marked_and_done() {
    check_on(
        "linuxcnc",
        "G21 G90 G0 X1 Y0 Z50\nG1 X2\nG1 X3 F100 Q7\nG1 X4\nM2\n",
        &expect![[r#"
        rapid X1 Y0 Z50
        feed X2 Y0 Z50
        block 1: NoFeed
        feed X3 Y0 Z50
        block 2: UnreadWord(Q)
        feed X4 Y0 Z50
        Ended(Program), 2 alarms
    "#]],
    );
}

#[test]
fn the_alarm_of_the_program_itself_is_marked_and_the_rest_is_run() {
    check(
        "O1\nG21 G90 G0 X1. Y0. Z50.\n#3000=7 (NO TOOL)\nG0 X2.\nM30\n",
        &expect![[r#"
        rapid X1 Y0 Z50
        block 2: Alarm(7)
        rapid X2 Y0 Z50
        Ended(Program), 1 alarms
    "#]],
    );
}

#[test]
fn for_a_picture_a_program_that_is_not_here_changes_nothing() {
    let text = "O1\nG21 G90 G0 G54 X1. Y0.\nG43 H1 Z50.\nG65 P9832\nM98 P4711\nG1 Z-5. F200.\nM30\n";
    check_with(
        Options::PICTURE,
        "fanuc-mill",
        text,
        &expect![[r#"
        rapid X1 Y0
        rapid X1 Y0 Z50
        block 3: assumed MissingProgram(9832)
        block 4: assumed MissingProgram(4711)
        feed X1 Y0 Z-5
        Ended(Program), 0 alarms
    "#]],
    );
    check_on(
        "fanuc-mill",
        text,
        &expect![[r#"
        rapid X1 Y0
        rapid X1 Y0 Z50
        block 3: assumed MissingProgram(9832)
        block 4: assumed MissingProgram(4711)
        feed 
        Ended(Program), 0 alarms
    "#]],
    );
}

#[test]
fn for_a_picture_a_probe_touches_at_its_target() {
    let text = "O1\nG21 G90 G0 G54 X1. Y0. Z2.\nG31 Z-1. F5.\n#500=#5063\nG1 Z[#500-.1] F50.\nM30\n";
    check_with(
        Options::PICTURE,
        "haas-mill",
        text,
        &expect![[r#"
        rapid X1 Y0 Z2
        probe { toward: true, required: false, skip: true } X1 Y0 Z-1
        block 2: assumed ProbeTouch
        feed X1 Y0 Z-1.1
        Ended(Program), 0 alarms
    "#]],
    );
}

/// What takes a step for each pair of them takes minutes.
#[test]
fn every_one_of_very_many_missing_programs_is_told_once() {
    const MISSING: usize = 80_000;
    let mut text = "O1\n".to_owned();
    for number in 10_000..10_000 + MISSING {
        writeln!(text, "G65 P{number}\nG65 P{number}").unwrap();
    }
    text.push_str("M30\n");
    let moves = ran_with(Options { past_alarms: true, ..Options::NONE }, "fanuc-mill", &text, u64::MAX);
    let told: Vec<&str> = moves.lines().filter(|line| line.contains("assumed")).collect();
    assert_eq!(told.len(), MISSING);
    assert_eq!(told.last(), Some(&"block 159999: assumed MissingProgram(89999)"));
}
