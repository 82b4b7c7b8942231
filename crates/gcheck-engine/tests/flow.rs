//! What the analysis of all paths promises, one promise a test: exact while every condition is known, both ways where none
//! is, joined where the ways meet, widened where they turn, and always at an end.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

use gcheck_engine::{
    Abstract, AbstractValue, At, Axis, ConcreteValue, Domain, Ending, Event, Fault, FlowCx, FlowObserver,
    FlowResult, Machine, Model, NoLibrary, Options, Position, Program, Reach, Role, State, Task, Tool, flow,
};
use gcheck_geometry::Mm;
use gcheck_program::{Dialect, Loaded};

/// A block as it was shown.
struct Shown {
    /// Line, counted from one.
    line: u32,
    solo: bool,
    state: State<Abstract>,
}

#[derive(Default)]
struct Watcher {
    before: Vec<Shown>,
    endless: Vec<u32>,
    faults: Vec<(u32, Fault)>,
    endings: Vec<(u32, Ending)>,
    vacant: Vec<(u32, u32)>,
    moves: usize,
}

fn line(at: At) -> u32 {
    at.block + 1
}

impl FlowObserver for Watcher {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.before.push(Shown { line: line(cx.origin.at), solo: cx.solo, state: cx.state.clone() });
    }

    fn event(&mut self, _: &FlowCx<'_>, event: &Event) {
        self.moves += usize::from(matches!(event, Event::Travel(_) | Event::Arc(_)));
    }

    fn vacant_read(&mut self, cx: &FlowCx<'_>, variable: u32) {
        self.vacant.push((line(cx.origin.at), variable));
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.faults.push((line(cx.origin.at), fault.clone()));
    }

    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        self.endings.push((line(cx.origin.at), ending));
    }

    fn endless(&mut self, _: &FlowCx<'_>, head: At) {
        self.endless.push(line(head));
    }
}

/// What came out of a program whose every line is a block.
struct Seen {
    watcher: Watcher,
    result: FlowResult,
}

impl Seen {
    fn reach(&self, line: u32) -> Reach {
        self.result.reach(At { file: 0, block: line - 1 })
    }

    /// The states in which a line was shown.
    fn states(&self, line: u32) -> Vec<&State<Abstract>> {
        self.watcher.before.iter().filter(|shown| shown.line == line).map(|shown| &shown.state).collect()
    }

    /// The one state in which a line was shown.
    fn state(&self, line: u32) -> &State<Abstract> {
        let states = self.states(line);
        assert_eq!(states.len(), 1, "line {line} was shown {} times", states.len());
        states[0]
    }

    /// The values of a local variable, each time a line was shown.
    fn locals(&self, line: u32, number: u32) -> Vec<Option<f64>> {
        self.states(line).into_iter().map(|state| state.local(number).and_then(Abstract::known)).collect()
    }
}

fn analyse_with(control: &str, program: &str, options: Options, fuel: u64) -> Seen {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(program, &dialect, |_, _, _| ());
    let model = Model::new(&control);
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let mut watcher = Watcher::default();
    let result =
        flow(&program, &model, &Machine::default(), Task { options, ..Task::all_paths(fuel) }, &mut watcher);
    Seen { watcher, result }
}

fn analyse(control: &str, program: &str) -> Seen {
    analyse_with(control, program, Options::NONE, 100_000)
}

// ---- exact while everything is known ----

#[test]
fn a_loop_with_known_turns_is_shown_turn_by_turn() {
    let seen = analyse("fanuc-mill", "#1=0\nWHILE [#1 LT 3] DO1\nG0 X#1\n#1=#1+1\nEND1\nG0 X9.\nM30\n");
    assert_eq!(seen.locals(3, 1), [Some(0.0), Some(1.0), Some(2.0)]);
    assert_eq!(seen.locals(6, 1), [Some(3.0)]);
    assert_eq!(seen.watcher.moves, 4);
    assert!(seen.watcher.before.iter().all(|shown| shown.solo));
    assert_eq!(seen.watcher.endings, [(7, Ending::Program)]);
}

#[test]
fn nested_loops_are_exact_too() {
    let seen = analyse(
        "fanuc-mill",
        "#1=0\nWHILE [#1 LT 3] DO1\n#2=0\nWHILE [#2 LT #1] DO2\nG0 X#1 Y#2\n#2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n",
    );
    assert_eq!(seen.locals(5, 1), [Some(1.0), Some(2.0), Some(2.0)]);
    assert_eq!(seen.locals(5, 2), [Some(0.0), Some(0.0), Some(1.0)]);
}

#[test]
fn a_known_condition_takes_one_way() {
    let seen = analyse("fanuc-mill", "#1=5\nIF [#1 GT 3] GOTO 10\nG0 X1.\nN10 M30\n");
    assert_eq!(seen.reach(3), Reach::Never);
    assert_eq!(seen.reach(4), Reach::Always);
}

#[test]
fn a_jump_back_with_a_counter_ends() {
    let seen = analyse("haas-mill", "#1= 3\nN10 G0 X#1\n#1= #1 - 1\nIF [#1 GT 0] GOTO 10\nM30\n");
    assert_eq!(seen.locals(2, 1), [Some(3.0), Some(2.0), Some(1.0)]);
    assert!(seen.watcher.endless.is_empty());
}

#[test]
fn o_words_loop_repeat_and_choose() {
    let seen = analyse(
        "linuxcnc",
        "#1=0\no1 repeat [3]\n#1=[#1+1]\no1 endrepeat\no2 if [#1 EQ 3]\nG0 X1\no2 else\nG0 X2\no2 endif\nM2\n",
    );
    assert_eq!(seen.locals(3, 1), [Some(0.0), Some(1.0), Some(2.0)]);
    assert_eq!(seen.reach(6), Reach::Always);
    assert_eq!(seen.reach(8), Reach::Never);
}

// ---- forks and joins ----

#[test]
fn an_unknown_condition_goes_both_ways_and_they_meet() {
    let seen = analyse("fanuc-mill", "G0 X1.\nIF [#500 EQ 1] GOTO 10\nG0 X5.\nN10 G0 Y2.\nM30\n");
    assert_eq!(
        [1, 2, 3, 4, 5].map(|line| seen.reach(line)),
        [Reach::Always, Reach::Always, Reach::Some, Reach::Always, Reach::Always]
    );
    let solo: Vec<bool> = seen.watcher.before.iter().map(|shown| shown.solo).collect();
    assert_eq!(solo, [true, true, false, true, true]);
}

#[test]
fn where_ways_meet_what_differs_is_unknown_and_what_agrees_stays() {
    let seen =
        analyse("fanuc-mill", "G21 G90\nG0 X1. Y3.\nIF [#500 EQ 1] GOTO 10\nG0 X5.\nN10 G0 Z2.\nM30\n");
    let state = seen.state(5);
    assert_eq!(state.position().get(Axis::X), None);
    assert_eq!(state.position().get(Axis::Y), Some(3.0));
    assert!(state.mode(Role::Distance).only().is_some());
}

#[test]
fn modes_that_differ_are_alternatives() {
    let seen = analyse("fanuc-mill", "G90\nIF [#500 EQ 1] GOTO 10\nG91\nN10 G0 X1.\nM30\n");
    let mode = seen.state(4).mode(Role::Distance);
    assert_eq!(mode.only(), None);
    assert_eq!(mode.alternatives().len(), 2);
}

#[test]
fn values_that_differ_are_a_few() {
    let seen = analyse("fanuc-mill", "#1=1\nIF [#500 EQ 1] GOTO 10\n#1=2\nN10 G0 X1.\nM30\n");
    let value = seen.state(4).local(1).unwrap();
    assert_eq!(Abstract::known(value), None);
    assert_eq!(Abstract::bounds(value), Some((1.0, 2.0)));
}

#[test]
fn a_condition_narrows_what_it_asks_for() {
    let seen = analyse("fanuc-mill", "IF [#500 GT 5] GOTO 10\nG0 X1.\nM30\nN10 G0 X2.\nM30\n");
    let value = |line: u32| seen.state(line).variables().get(500);
    let (low, high) = Abstract::bounds(&value(4)).unwrap();
    assert!(low > 5.0 && low < 5.1 && high.is_infinite(), "{low} to {high}");
    // Nothing counts as zero in a comparison, so it may be nothing here, but no number above five.
    let low = value(2);
    assert!(low.allows(ConcreteValue::Number(5.0)) && low.allows(ConcreteValue::Vacant));
    assert!(!low.allows(ConcreteValue::Number(6.0)));
}

#[test]
fn the_second_of_two_equal_questions_has_one_answer() {
    let seen =
        analyse("fanuc-mill", "IF [#500 GT 1] GOTO 10\nM30\nN10 IF [#500 GT 0] GOTO 20\nG0 X1.\nN20 M30\n");
    assert_eq!(seen.reach(4), Reach::Never);
}

#[test]
fn a_way_that_ends_is_still_a_way() {
    let seen = analyse("haas-mill", "IF [#500 EQ 1] GOTO 9\nM30\nN9 G0 X1.\nM30\n");
    assert_eq!(
        [1, 2, 3, 4].map(|line| seen.reach(line)),
        [Reach::Always, Reach::Some, Reach::Some, Reach::Some]
    );
    assert_eq!(seen.watcher.endings, [(2, Ending::Program), (4, Ending::Program)]);
    assert!(seen.watcher.before.iter().all(|shown| shown.solo == (shown.line == 1)));
}

#[test]
fn each_block_on_a_fork_is_shown_once_in_its_final_state() {
    let seen = analyse(
        "fanuc-mill",
        "IF [#500 EQ 1] GOTO 10\n#1=1\nGOTO 20\nN10 #1=2\nN20 G0 X1.\nIF [#501 EQ 1] GOTO 30\nG0 Y#1\nN30 M30\n",
    );
    for line in 1..=8 {
        assert_eq!(seen.states(line).len(), 1, "line {line}");
    }
}

#[test]
fn a_computed_jump_leads_to_every_label_it_may_be() {
    let seen = analyse(
        "fanuc-mill",
        "IF [#500 LT 5] GOTO 90\nIF [#500 GT 15] GOTO 90\nGOTO #500\nN10 G0 X1.\nM30\nN20 G0 X2.\nM30\nN90 M30\n",
    );
    assert_eq!(seen.reach(4), Reach::Some);
    assert_eq!(seen.reach(6), Reach::Never);
    assert_eq!(seen.reach(8), Reach::Some);
}

// ---- loops without a known number of turns ----

#[test]
fn a_loop_with_unknown_turns_is_widened() {
    let seen = analyse("fanuc-mill", "#1=0\nWHILE [#1 LT #500] DO1\n#1=#1+1\nEND1\nG0 X#1\nM30\n");
    assert_eq!(Abstract::bounds(seen.state(5).local(1).unwrap()), Some((0.0, f64::INFINITY)));
    assert!(seen.result.work < 1_000, "{} blocks", seen.result.work);
    assert!(!seen.result.is_incomplete());
}

#[test]
fn the_bound_of_a_loop_holds_inside_it() {
    let seen = analyse(
        "fanuc-mill",
        "#1=0\nWHILE [#1 LT #500] DO1\nIF [#1 GT 99] GOTO 10\n#1=#1+1\nEND1\nN10 M30\n",
    );
    let (low, _) = Abstract::bounds(seen.state(4).local(1).unwrap()).unwrap();
    assert!(low >= 0.0);
}

#[test]
fn a_loop_that_parts_inside_comes_to_an_end() {
    let seen = analyse(
        "fanuc-mill",
        "#1=0\nN10 IF [#500 EQ #1] GOTO 20\nG91 X1.\nN20 #1=#1+1\nIF [#1 LT 1000] GOTO 10\nM30\n",
    );
    assert!(seen.result.work < 20_000, "{} blocks", seen.result.work);
    assert_ne!(seen.reach(6), Reach::Never);
}

#[test]
fn the_turns_of_a_repeated_call_may_be_unknown() {
    let seen = analyse("linuxcnc", "o1 repeat [#100]\nG91 G0 X1\no1 endrepeat\nG90 G0 X0\nM2\n");
    assert_eq!(seen.reach(2), Reach::Some);
    assert_eq!(seen.reach(4), Reach::Always);
}

// ---- loops without end ----

#[test]
fn a_state_that_comes_back_never_ends() {
    let seen = analyse("fanuc-mill", "#1=0\nWHILE [#1 LT 5] DO1\nG0 X1.\nG0 X0.\nEND1\nM30\n");
    assert_eq!(seen.watcher.endless, [2]);
    assert_eq!(seen.reach(6), Reach::Never);
    assert!(seen.result.work < 1_000, "{} blocks", seen.result.work);
}

#[test]
fn states_that_take_turns_never_end_either() {
    let seen = analyse("fanuc-mill", "#1=1\nN10 #1=0-#1\nG0 X#1\nGOTO 10\nM30\n");
    assert_eq!(seen.watcher.endless, [2]);
}

#[test]
fn a_jump_to_itself_by_a_number_that_nobody_knows_settles() {
    let seen = analyse("fanuc-mill", "N10 GOTO #500\nM30\n");
    assert!(!seen.result.is_incomplete());
    assert!(seen.result.work < 1_000, "{} blocks", seen.result.work);
}

#[test]
fn a_return_in_the_main_program_ends_after_one_pass() {
    let seen = analyse("haas-mill", "G0 X1.\nM99\n");
    assert_eq!(seen.watcher.endings, [(2, Ending::Restart)]);
    assert!(seen.watcher.endless.is_empty());
}

#[test]
fn out_of_fuel_is_unknown_and_not_unreachable() {
    let program = "#1=1\nWHILE [#1 NE 10] DO1\n#1=#1+2\nEND1\nG0 X1.\nM30\n";
    let seen = analyse_with("fanuc-mill", program, Options::NONE, 1_000);
    assert!(seen.result.is_incomplete());
    assert!((1_000..1_100).contains(&seen.result.work), "{}", seen.result.work);
    assert_eq!(seen.reach(3), Reach::Always);
    assert_eq!(seen.reach(5), Reach::Unknown);
}

// ---- calls ----

#[test]
fn a_call_comes_back_behind_itself() {
    let seen = analyse("fanuc-mill", "O1\nM98 P2 L2\nG0 X9.\nM30\nO2\nG91 G0 X1.\nM99\n");
    assert_eq!(seen.states(6).len(), 2);
    assert_eq!(seen.states(3).len(), 1);
    assert_eq!(seen.states(6)[0].frames().len(), 2);
    assert_eq!(seen.state(3).frames().len(), 1);
    assert!((1..=7).filter(|line| *line != 4).all(|line| seen.reach(line) == Reach::Always));
}

#[test]
fn a_local_call_runs_the_blocks_behind_the_end() {
    let seen = analyse("haas-mill", "M97 P10 L2\nM30\nN10 G0 X1.\nM99\n");
    assert_eq!(seen.states(3).len(), 2);
    assert_eq!(seen.watcher.endings, [(2, Ending::Program)]);
}

#[test]
fn a_macro_has_variables_of_its_own() {
    let seen = analyse("fanuc-mill", "O1\n#1=7\nG65 P2 A3. B4.\nG0 X#1\nM30\nO2\nG0 X#1 Y#2\n#1=8\nM99\n");
    assert_eq!(seen.locals(7, 1), [Some(3.0)]);
    assert_eq!(seen.locals(7, 2), [Some(4.0)]);
    assert_eq!(seen.locals(4, 1), [Some(7.0)]);
}

#[test]
fn a_subroutine_runs_only_when_it_is_called() {
    let seen = analyse("linuxcnc", "o1 sub\nG0 X#1\no1 endsub\no1 call [5]\no2 sub\nG0 X2\no2 endsub\nM2\n");
    assert_eq!(seen.locals(2, 1), [Some(5.0)]);
    assert_eq!(seen.reach(6), Reach::Never);
}

#[test]
fn calls_from_two_places_do_not_mix() {
    let seen = analyse("fanuc-mill", "O1\n#100=1\nM98 P2\n#100=2\nM98 P2\nM30\nO2\nG0 X#100\nM99\n");
    let values: Vec<_> =
        seen.states(8).into_iter().map(|state| Abstract::known(&state.variables().get(100))).collect();
    assert_eq!(values, [Some(1.0), Some(2.0)]);
}

#[test]
fn a_recursion_without_end_is_a_fault() {
    let seen = analyse("fanuc-mill", "O1\nM98 P2\nM30\nO2\nM98 P2\nM99\n");
    assert_eq!(seen.watcher.faults, [(5, Fault::TooDeep)]);
    assert!(!seen.result.is_incomplete());
}

#[test]
fn a_recursion_on_an_unknown_condition_comes_to_an_end() {
    let seen = analyse("fanuc-mill", "O1\nM98 P2\nM30\nO2\nIF [#500 GT 5] GOTO 9\nM98 P2\nN9 M99\n");
    assert!(!seen.result.is_incomplete());
    assert_ne!(seen.reach(3), Reach::Never);
}

#[test]
fn a_call_of_a_program_that_is_not_here_leaves_little_known() {
    let seen = analyse("fanuc-mill", "G90 G0 X1.\n#100=1\nM98 P500\nG0 X2.\nM30\n");
    let state = seen.state(4);
    assert_eq!(state.mode(Role::Distance).only(), None);
    assert_eq!(state.variables().get(100), AbstractValue::Unknown);
    assert_eq!(seen.reach(5), Reach::Always);
}

// ---- faults, skips, variables ----

#[test]
fn the_analysis_goes_on_behind_a_block_that_cannot_be_executed() {
    let seen = analyse("linuxcnc", "G21 G90\nG1 X1\nG0 X2\nM2\n");
    assert_eq!(seen.watcher.faults, [(2, Fault::NoFeed)]);
    assert_eq!(seen.reach(3), Reach::Always);
}

#[test]
fn a_jump_to_nowhere_falls_through() {
    let seen = analyse("fanuc-mill", "GOTO 50\nG0 X1.\nM30\nG0 X2.\n");
    assert_eq!(seen.watcher.faults, [(1, Fault::NoSuchLabel(50))]);
    assert_eq!(seen.reach(2), Reach::Always);
    assert_eq!(seen.reach(4), Reach::Never);
}

#[test]
fn an_arc_off_its_circle_is_a_line_to_its_end() {
    let seen = analyse("haas-mill", "G21 G90 G0 X0. Y0.\nG1 X10. F100.\nG2 X20. Y0. I3. J0.\nG1 Y5.\nM30\n");
    assert_eq!(seen.watcher.faults.len(), 1);
    assert_eq!(seen.watcher.moves, 4);
    assert_eq!(seen.state(4).position().get(Axis::X), Some(20.0));
}

#[test]
fn a_refused_move_does_not_take_the_rest_of_its_block_with_it() {
    let seen = analyse("haas-mill", "G21 G90 G0 X0. Y0.\nG2 X20. Y0. F100. M8\nM30\n");
    assert_eq!(seen.watcher.faults.len(), 1);
    assert_eq!(seen.watcher.endings, [(3, Ending::Program)]);
    let seen = analyse("haas-mill", "G21 G90 G0 X0. Y0.\nG2 X20. I3. J5. F100. M30\nG0 X1.\n");
    assert_eq!(seen.watcher.faults.len(), 1);
    assert_eq!(seen.watcher.endings, [(2, Ending::Program)]);
    assert_eq!(seen.reach(3), Reach::Never);
}

#[test]
fn a_value_that_does_not_exist_is_unknown_afterwards() {
    let seen =
        analyse("fanuc-mill", "#100=5\n#100=[1/0]\nG0 X#100 Y1.\nIF [#100 EQ 5] GOTO 6\nG0 X1.\nN6 M30\n");
    assert_eq!(seen.watcher.faults, [(2, Fault::Value(gcheck_engine::ValueFault::DivisionByZero))]);
    assert_eq!(seen.state(4).position().get(Axis::X), None);
    assert_eq!(seen.state(4).position().get(Axis::Y), Some(1.0));
    assert_eq!(seen.reach(5), Reach::Some);
}

#[test]
fn a_condition_that_has_no_value_goes_both_ways() {
    let seen = analyse("fanuc-mill", "IF [[1/0] EQ 1] GOTO 30\nG0 X1.\nGOTO 40\nN30 G0 X2.\nN40 M30\n");
    assert_eq!(seen.watcher.faults.len(), 1);
    assert_eq!([seen.reach(2), seen.reach(4), seen.reach(5)], [Reach::Some, Reach::Some, Reach::Always]);
}

#[test]
fn after_a_refused_length_no_length_is_known() {
    let control = gcheck_controls::load("linuxcnc").unwrap();
    let dialect = Dialect::new(&control);
    let text = "G21 G90\nG43 H1\nG43 H7 Z5\nG0 Z10\nM2\n";
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let model = Model::new(&control);
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let mut offset = Position::ZERO;
    offset.set(Axis::Z, 30.0);
    let (diameter, corner_radius) = (Mm(10.0), Mm(0.0));
    let tool = Tool { pocket: 1, offset, diameter, corner_radius, angles: [0.0; 2], orientation: 0 };
    let machine = Machine { tools: [(1, tool)].into(), tool_table_is_complete: true, ..Machine::default() };
    let mut watcher = Watcher::default();
    let result = flow(&program, &model, &machine, Task::all_paths(1_000), &mut watcher);
    let seen = Seen { watcher, result };
    assert_eq!(seen.watcher.faults, [(3, Fault::NoSuchTool(7))]);
    assert_eq!(seen.state(3).length().get(Axis::Z), Some(30.0));
    assert_eq!(seen.state(4).length().get(Axis::Z), None);
    assert_eq!(seen.state(4).position().get(Axis::Z), Some(5.0));
}

#[test]
fn a_missing_subroutine_is_passed_over_and_leaves_little_known() {
    let seen = analyse("linuxcnc", "G21 G90 G0 X1\no7 call\nG0 X2\nM2\n");
    assert_eq!(seen.watcher.faults, [(2, Fault::NoSuchProgram)]);
    assert_eq!(seen.state(3).mode(Role::Distance).only(), None);
    assert_eq!(seen.watcher.endings, [(4, Ending::Program)]);
}

#[test]
fn an_alarm_in_a_subprogram_comes_with_every_call() {
    let seen = analyse("fanuc-mill", "O1\nM98 P2\nM98 P2\nM30\nO2\nGOTO 50\nG0 X1.\nM99\n");
    assert_eq!(seen.watcher.faults, [(6, Fault::NoSuchLabel(50)), (6, Fault::NoSuchLabel(50))]);
    assert_eq!(seen.watcher.endings, [(4, Ending::Program)]);
}

#[test]
fn a_return_to_a_missing_block_goes_back_to_its_caller() {
    let seen = analyse("fanuc-mill", "O1\nM98 P2\nG0 X3.\nM30\nO2\nM99 P50\nO3\nG0 X1.\nM99\n");
    assert_eq!(seen.watcher.faults, [(6, Fault::NoSuchLabel(50))]);
    assert_eq!([seen.reach(3), seen.reach(8)], [Reach::Always, Reach::Never]);
}

#[test]
fn a_loop_with_an_alarm_in_it_ends_as_it_does_without() {
    let seen = analyse("fanuc-mill", "#1=0\nWHILE [#1 LT 3] DO1\nGOTO 50\n#1=#1+1\nEND1\nG0 X9.\nM30\n");
    assert_eq!(seen.watcher.faults.len(), 3);
    assert_eq!(seen.watcher.endless, [0_u32; 0]);
    assert_eq!(seen.locals(6, 1), [Some(3.0)]);
}

#[test]
fn a_loop_whose_way_out_leads_nowhere_is_not_endless() {
    // The only way out: known at every turn, known at some turn, not known.
    for program in [
        "N10 G0 X1.\nGOTO 50\nGOTO 10\nG0 X9.\nM30\n",
        "#1=0\nN10 #1=#1+1\nIF [#1 GT 5] GOTO 50\nGOTO 10\nG0 X9.\nM30\n",
        "N10 G0 X1.\nIF [#500 GT 5] GOTO 50\nGOTO 10\nG0 X9.\nM30\n",
    ] {
        let seen = analyse("fanuc-mill", program);
        assert_eq!(seen.watcher.endless, [0_u32; 0], "{program}");
        assert_eq!(seen.watcher.endings.len(), 1, "{program}");
    }
}

#[test]
fn a_loop_without_its_end_is_straight_code() {
    let seen = analyse("fanuc-mill", "#1=0\nWHILE [#1 LT 3] DO1\nG0 X1.\nM30\n");
    assert_eq!(seen.watcher.faults, [(2, Fault::LoopMismatch)]);
    assert_eq!(seen.watcher.endings, [(4, Ending::Program)]);
}

#[test]
fn an_alarm_on_one_way_of_a_condition_leaves_both_ways_to_meet() {
    let seen = analyse("fanuc-mill", "IF [#500 EQ 1] GOTO 20\nGOTO 50\nN20 G0 X1.\nM30\n");
    assert_eq!(seen.watcher.faults, [(2, Fault::NoSuchLabel(50))]);
    assert_eq!(seen.reach(3), Reach::Always);
    assert!(seen.watcher.before.last().is_some_and(|shown| shown.solo));
}

#[test]
fn a_recursion_without_end_is_passed_over() {
    let seen = analyse("fanuc-mill", "O1\nM98 P2\nG0 X1.\nM30\nO2\nM98 P2\nM98 P2\nM99\n");
    assert_eq!(seen.watcher.faults, [(6, Fault::TooDeep)]);
    assert_eq!(seen.watcher.endings, [(4, Ending::Program)]);
}

#[test]
fn block_delete_is_one_switch_for_all_blocks() {
    let program = "/GOTO 10\nG0 X1.\nN10 /G0 X2.\nM30\n";
    let off = analyse_with("fanuc-mill", program, Options::NONE, 1_000);
    assert_eq!(off.reach(2), Reach::Never);
    let on = analyse_with("fanuc-mill", program, Options::SKIP_ALL, 1_000);
    assert_eq!(on.reach(2), Reach::Always);
    // A block that is skipped is come to, and does nothing.
    assert_eq!(on.states(1).len(), 0);
    assert_eq!(on.reach(1), Reach::Always);
}

#[test]
fn a_variable_that_nothing_set_is_told_when_it_is_read() {
    let seen = analyse("fanuc-mill", "G0 X#1\n#2=#500\nM30\n");
    assert_eq!(seen.watcher.vacant, [(1, 1)]);
}

#[test]
fn an_alarm_of_the_programs_own_ends_it() {
    let seen = analyse("fanuc-mill", "#3000=5 (STOP)\nG0 X1.\nM30\n");
    assert_eq!(seen.watcher.endings, [(1, Ending::Alarm(5))]);
    assert_eq!(seen.reach(2), Reach::Never);
}

#[test]
fn an_alarm_on_one_way_leaves_the_other() {
    let seen = analyse("fanuc-mill", "IF [#500 EQ 1] THEN #3000=5\nG0 X1.\nM30\n");
    assert_ne!(seen.reach(2), Reach::Never);
    assert_ne!(seen.reach(3), Reach::Never);
}

#[test]
fn a_test_for_nothing_narrows() {
    let seen =
        analyse("fanuc-mill", "IF [#500 EQ 1] GOTO 10\n#1=5\nN10 IF [#1 EQ #0] THEN #1=1\nG0 X#1\nM30\n");
    let value = seen.state(4).local(1).unwrap();
    assert_eq!(Abstract::bounds(value), Some((1.0, 5.0)));
}
