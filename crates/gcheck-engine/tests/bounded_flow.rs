//! The analysis of all paths costs what the text is worth, however long the program runs: steps are counted, not seconds.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::collections::BTreeMap;
use std::fmt::Write as _;

use gcheck_engine::{
    At, Budget, FlowCx, FlowObserver, FlowResult, Limit, Machine, Model, NoLibrary, Program, Reach, Task,
    flow,
};
use gcheck_program::{Dialect, Loaded};

struct Nobody;

impl FlowObserver for Nobody {}

/// Analyses a program as `check` does: the result, and the work that the text is worth.
fn analyse(control: &str, program: &str) -> (FlowResult, u64) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(program, &dialect, |_, _, _| ());
    let model = Model::new(&control);
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let budget = Budget::DEFAULT.of(&program);
    (flow(&program, &model, &Machine::default(), Task::all_paths(budget), &mut Nobody), budget)
}

fn limits(result: &FlowResult) -> Vec<Limit> {
    let mut limits: Vec<Limit> = result.given_up.iter().map(|given_up| given_up.limit).collect();
    limits.sort_unstable();
    limits.dedup();
    limits
}

/// Analysed to the end, or to a limit: never beyond the budget and what it takes to show what was executed silently.
fn check_ends(control: &str, program: &str) -> FlowResult {
    let (result, budget) = analyse(control, program);
    // The last step may fork to every label of the program.
    let reserve = budget / 4 + 100_000;
    assert!(result.work <= budget + reserve, "{} of {budget}", result.work);
    result
}

/// Programs that call the next one several times each, `before` in front of each call.
fn calls_of_calls(programs: u32, calls: u32, before: impl Fn(u32) -> String) -> String {
    let body = |program: u32| -> String {
        (0..calls).map(|call| format!("{}M98 P{}\n", before(call), 1001 + program)).collect()
    };
    let mut text = format!("O1\n{}M30\n", body(0));
    for program in 1..programs {
        let _ = write!(text, "O{}\n{}M99\n", 1000 + program, body(program));
    }
    let _ = write!(text, "O{}\nG0 X1.\nM99\n", 1000 + programs);
    text
}

// ---- programs that run for years ----

#[test]
fn calls_of_calls_end_at_the_limit_of_work() {
    let text = calls_of_calls(9, 10, |_| String::new());
    let result = check_ends("fanuc-mill", &text);
    assert_eq!(limits(&result), [Limit::Work]);
    // The second call of the main program, which nothing has come to.
    assert_eq!(result.reach(At { file: 0, block: 2 }), Reach::Unknown);
}

#[test]
fn calls_of_calls_on_parted_paths_end_at_the_limit_of_states() {
    // The paths part in front of the calls and do not meet before the end.
    let text = calls_of_calls(9, 10, |_| String::new()).replacen("O1\n", "O1\nIF [#500 EQ 1] GOTO 7\n", 1);
    let text = text.replacen("M30", "N7 M30", 1);
    let result = check_ends("fanuc-mill", &text);
    assert_eq!(limits(&result), [Limit::States]);
    assert!(result.work < 200_000, "{}", result.work);
}

#[test]
fn calls_of_calls_with_conditions_end() {
    let conditions = |call: u32| format!("IF [#{} EQ 1] GOTO {}\n", 500 + call, call + 1);
    let text = calls_of_calls(9, 4, conditions);
    check_ends("fanuc-mill", &text);
}

#[test]
fn computed_jumps_end() {
    let mut text = "O1\nG21 G90\n".to_owned();
    for label in 0..25 {
        let _ = write!(text, "N{} #{}=#{}+1\nGOTO #{}\n", label + 1, 100 + label, 100 + label, 500 + label);
    }
    check_ends("fanuc-mill", &(text + "M30\n"));
}

#[test]
fn a_nest_of_repeat_loops_ends() {
    let mut text = String::new();
    for level in 1..=500 {
        let _ = writeln!(text, "o{level} repeat [9]");
    }
    text.push_str("G1 X1 F100\n");
    for level in (1..=500).rev() {
        let _ = writeln!(text, "o{level} endrepeat");
    }
    check_ends("linuxcnc", &(text + "M2\n"));
}

#[test]
fn what_was_not_seen_is_not_called_unreachable() {
    let text = calls_of_calls(9, 10, |_| String::new());
    let (result, _) = analyse("fanuc-mill", &text);
    let blocks = text.lines().count() as u32;
    assert!((0..blocks).all(|block| result.reach(At { file: 0, block }) != Reach::Never));
}

#[test]
fn where_it_stopped_is_named_with_the_calls_that_lead_there() {
    let text = calls_of_calls(9, 10, |_| String::new());
    let (result, _) = analyse("fanuc-mill", &text);
    let given_up = result.given_up.first().unwrap();
    assert_eq!(given_up.calls.first(), Some(&At { file: 0, block: 1 }), "the first call of the main program");
    assert!(!given_up.calls.is_empty());
}

#[test]
fn a_program_that_machines_run_is_analysed_to_its_end() {
    // A pocket in levels, called for each of a grid of parts, with conditions that nobody knows.
    let text = "O1\nG21 G90 G17\n#1=0\nWHILE [#1 LT 40] DO1\n#2=0\nWHILE [#2 LT 40] DO2\nG0 X[#1*10] Y[#2*10]\n\
                G65 P1000 A-5.\nIF [#500 EQ 1] GOTO 5\nM8\nN5 #2=#2+1\nEND2\n#1=#1+1\nEND1\nM30\n\
                O1000\n#3=0\nWHILE [#3 GT #1] DO1\n#3=#3-1\nG1 Z#3 F100.\nG2 I5.\nEND1\nM99\n";
    let (result, _) = analyse("fanuc-mill", text);
    assert_eq!(limits(&result), []);
    assert_eq!(result.reach(At { file: 0, block: 14 }), Reach::Always, "M30");
}

// ---- twice the text costs twice the work ----

/// Work for a text and for one twice as long.
fn check_growth(control: &str, text: impl Fn(u32) -> String) {
    let [once, twice] = [200, 400].map(|size| analyse(control, &text(size)).0);
    assert!(once.work > 200, "{}", once.work);
    assert!(twice.work * 10 <= once.work * 22, "{} for one, {} for two", once.work, twice.work);
    assert!(!once.is_incomplete() && !twice.is_incomplete());
}

fn lines(size: u32, line: impl Fn(u32) -> String) -> String {
    (0..size).map(line).collect()
}

#[test]
fn conditions_in_a_row_cost_their_number() {
    check_growth("fanuc-mill", |size| {
        let conditions = lines(size, |line| {
            format!("IF [#500 EQ {line}] GOTO {}\nX{line}.\nN{} Y1.\n", line + 1, line + 1)
        });
        format!("O1\nG21 G90 G0\n{conditions}M30\n")
    });
}

#[test]
fn calls_in_a_row_cost_their_number() {
    check_growth("fanuc-mill", |size| {
        format!("O1\nG21 G90\n{}M30\nO2\nG0 X1.\nX2.\nM99\n", lines(size, |_| "M98 P2\n".to_owned()))
    });
}

#[test]
fn loops_in_a_row_cost_their_number() {
    check_growth("linuxcnc", |size| {
        format!(
            "G21 G90\n{}M2\n",
            lines(size, |line| format!("o{line} repeat [5]\nG0 X{line}\no{line} endrepeat\n"))
        )
    });
}

#[test]
fn one_computed_jump_costs_its_targets() {
    check_growth("fanuc-mill", |size| {
        format!("O1\nG21 G90\nGOTO #500\n{}M30\n", lines(size, |line| format!("N{} G0 X{line}.\n", line + 1)))
    });
}

// ---- what is kept goes when no path comes back to it ----

/// Counts how often each block is shown.
#[derive(Default)]
struct Counter(BTreeMap<u32, u32>);

impl FlowObserver for Counter {
    fn before(&mut self, cx: &FlowCx<'_>) {
        *self.0.entry(cx.origin.at.block).or_default() += 1;
    }
}

#[test]
fn each_block_of_a_long_program_with_parted_paths_is_shown_once() {
    // The paths part in the first block and meet in the last; in between are more states than are kept for long.
    let conditions =
        lines(1_000, |line| format!("IF [#501 EQ {line}] GOTO {}\nX{line}.\nN{} Y1.\n", line + 1, line + 1));
    let text = format!("O1\nIF [#500 EQ 1] GOTO 9999\n{conditions}N9999 M30\n");
    let control = gcheck_controls::load("fanuc-mill").unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text.as_str(), &dialect, |_, _, _| ());
    let model = Model::new(&control);
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let mut counter = Counter::default();
    let work = Budget::DEFAULT.of(&program);
    let result = flow(&program, &model, &Machine::default(), Task::all_paths(work), &mut counter);
    assert_eq!(limits(&result), []);
    assert_eq!(counter.0.len(), text.lines().count());
    assert!(counter.0.values().all(|times| *times == 1), "{:?}", counter.0);
}
