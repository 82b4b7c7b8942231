//! The bar feeder: what a bar feed does, in which order, and when a job ends.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Abstract, Assumption, At, Bar, BarFeeder, Concrete, Domain, Event, FlowCx, FlowObserver, Lattice,
    Machine, Model, NoLibrary, Observer, Options, Origin, Program, Spindle, State, Task, Truth, flow, run,
};
use gcheck_geometry::Mm;
use gcheck_program::{Dialect, Loaded};

/// Events of spindle, chuck and bar, each with the line of its block.
#[derive(Default)]
struct Feeder {
    lines: Vec<u32>,
    shown: String,
}

impl Observer<Concrete> for Feeder {
    fn event(&mut self, origin: Origin, _: &State<Concrete>, event: &Event) {
        let what = match event {
            Event::Spindle(Spindle::Stopped) => "spindle stops".to_owned(),
            Event::Spindle(_) => "spindle turns".to_owned(),
            Event::OrientSpindle { angle, .. } => format!("spindle to {angle}"),
            Event::Chuck(true) => "chuck closes".to_owned(),
            Event::Chuck(false) => "chuck opens".to_owned(),
            Event::BarFeed(_) => "feed".to_owned(),
            Event::BarSetup(mode) => format!("setup {mode:?}"),
            Event::BarUnload(rest) => format!("unload, left {}", round(*rest)),
            Event::BarLoad => "load".to_owned(),
            Event::BarPush(by) => format!("push {}", round(*by)),
            Event::Travel(_) => "move".to_owned(),
            _ => return,
        };
        let line = self.lines.partition_point(|start| *start <= origin.start);
        let _ = writeln!(self.shown, "{line}: {what}");
    }
}

fn round(length: Mm) -> f64 {
    (length.0 * 1e6).round() / 1e6
}

/// Bars of `length` millimetres.
fn bars(length: f64, bars: u32) -> Machine {
    let bar = BarFeeder { new_bar: Some(Mm(length)), bars: Some(bars), starts_new: true };
    Machine { bar, ..Machine::default() }
}

fn with(mut machine: Machine, variables: &[(u32, f64)]) -> Machine {
    machine.variables = variables.iter().copied().collect();
    machine
}

struct Ran {
    shown: String,
    stopped: String,
    assumptions: Vec<Assumption>,
}

fn execute(text: &str, machine: &Machine) -> Ran {
    let control = gcheck_controls::load("haas-lathe").unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at as u32 + 1));
    let mut feeder = Feeder { lines: starts.collect(), shown: String::new() };
    let result = run(&program, &model, machine, Options::NONE, 2_000, &mut feeder);
    Ran {
        shown: feeder.shown,
        stopped: format!("{:?}", result.stopped),
        assumptions: result.assumptions.into_iter().collect(),
    }
}

fn check(text: &str, machine: &Machine, expected: &Expect) {
    let ran = execute(text, machine);
    expected.assert_eq(&format!("{}{}\n", ran.shown, ran.stopped));
}

#[test]
fn a_bar_that_is_long_enough() {
    check(
        "G21\nS900 M3\nG105 J25. K60. I30. R90. P2\nM30\nO2\nG0 X50.\nM99\n",
        &bars(1000.0, 1),
        &expect![[r#"
            2: spindle turns
            6: move
            3: feed
            3: spindle stops
            3: chuck opens
            3: push 25
            3: chuck closes
            4: spindle stops
            Ended(Program)
        "#]],
    );
}

#[test]
fn a_bar_that_is_too_short() {
    check(
        "G21\nS900 M3\nG105 J25. K60. I30. R90. P2\nM30\nO2\nG0 X50.\nM99\n",
        &bars(100.0, 2),
        &expect![[r#"
            2: spindle turns
            6: move
            3: feed
            3: spindle stops
            3: chuck opens
            3: unload, left 70
            3: spindle to 90
            3: load
            3: push 30
            3: chuck closes
            4: spindle stops
            Ended(Program)
        "#]],
    );
}

/// 70 after the first push; a part and its clamping need exactly 70 when the second one is asked for.
#[test]
fn a_bar_just_long_enough_is_changed_and_said() {
    let ran = execute("G21\nM5\nG105 J10. K60. I30.\nM30\n", &bars(100.0, 2));
    expect![[r#"
        2: spindle stops
        3: feed
        3: chuck opens
        3: unload, left 70
        3: load
        3: push 30
        3: chuck closes
        4: spindle stops
    "#]]
    .assert_eq(&ran.shown);
    assert!(ran.assumptions.contains(&Assumption::BarAtLimit));
    let ran = execute("G21\nM5\nG105 J9.999 K60. I30.\nM30\n", &bars(100.0, 2));
    assert!(ran.shown.contains("push 9.999") && !ran.assumptions.contains(&Assumption::BarAtLimit));
}

#[test]
fn a_main_program_repeats_until_the_bars_are_used() {
    check(
        "G21\nM5\nG105 J25. K10. I30.\nM99\n",
        &bars(100.0, 2),
        &expect![[r#"
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        2: spindle stops
        3: feed
        3: chuck opens
        3: unload, left 20
        3: load
        3: push 30
        3: chuck closes
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        2: spindle stops
        3: feed
        3: chuck opens
        3: unload, left 20
        Ended(BarsUsed)
    "#]],
    );
}

#[test]
fn without_bars_it_runs_once() {
    let one = Machine {
        bar: BarFeeder { new_bar: Some(Mm(100.0)), bars: None, starts_new: true },
        ..Machine::default()
    };
    check(
        "G21\nM5\nG105 J25. K10. I30.\nM99\n",
        &one,
        &expect![[r#"
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        Ended(Restart)
    "#]],
    );
    check(
        "G21\nM5\nG105 J25. K10. I30.\nM99\n",
        &Machine::default(),
        &expect![[r#"
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        Ended(Restart)
    "#]],
    );
    // Bars of which nobody knows when they are used up.
    check(
        "G21\nM5\nG105 J25. I30.\nM99\n",
        &bars(100.0, 3),
        &expect![[r#"
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        Ended(Restart)
    "#]],
    );
    // A program that feeds no bar.
    check(
        "G21\nM5\nM99\n",
        &bars(100.0, 3),
        &expect![[r#"
        2: spindle stops
        Ended(Restart)
    "#]],
    );
}

#[test]
fn limits_of_the_feeder_end_the_job() {
    let text = "G21\nM5\nG105 J25. K10. I30.\nM99\n";
    for (limit, value) in [(3103, 2.0), (3105, 50.0)] {
        let ran = execute(text, &with(bars(1000.0, 2), &[(limit, value)]));
        assert_eq!(ran.shown.matches("feed").count(), 2, "#{limit}");
        assert_eq!(ran.stopped, "Ended(BarsUsed)");
        assert!(ran.assumptions.contains(&Assumption::BarLimits));
    }
    let ran = execute(text, &with(bars(100.0, 5), &[(3104, 1.0)]));
    assert!(!ran.shown.contains("load\n") && ran.stopped == "Ended(BarsUsed)", "{}", ran.shown);
}

/// The counters count, the program may ask.
#[test]
fn a_program_that_counts_its_parts() {
    let ran = execute("G21\nN1 M5\nG105 J25. K10. I30.\nIF [#3106 LT 3] GOTO 1\nM30\n", &bars(1000.0, 2));
    assert_eq!((ran.shown.matches("push").count(), ran.stopped.as_str()), (3, "Ended(Program)"));
    let ran = execute("G21\nN1 M5\nG105 J25. K10. I30.\nIF [#3109 GT 900.] GOTO 1\nM30\n", &bars(1000.0, 2));
    assert_eq!((ran.shown.matches("push").count(), ran.stopped.as_str()), (3, "Ended(Program)"));
}

#[test]
fn variables_stand_in_for_words_and_words_hold_for_their_block() {
    check(
        "G21\n#3100=25.\n#3101=30.\n#3102=10.\nM5\nG105 J12.\nG105\nM30\n",
        &bars(1000.0, 1),
        &expect![[r#"
            5: spindle stops
            6: feed
            6: chuck opens
            6: push 12
            6: chuck closes
            7: feed
            7: chuck opens
            7: push 25
            7: chuck closes
            8: spindle stops
            Ended(Program)
        "#]],
    );
}

#[test]
fn an_initial_push_of_zero_is_the_reference_position() {
    let text = "G21\nM5\nG105 J25. K100.\nM30\n";
    let shown = |text: &str, variables: &[(u32, f64)]| execute(text, &with(bars(110.0, 2), variables)).shown;
    assert!(shown(text, &[(3101, 0.0), (3112, 40.0)]).contains("push 40"));
    assert!(shown("G21\nM5\nG105 J25. K100. I0\nM30\n", &[(3101, 0.0), (3112, 40.0)]).contains("push 40"));
    // What a zero of the block alone means the manual does not say; neither is anything known without a reference.
    let twice = "G21\nM5\nG105 J25. K100. I30.\nG105 J25. K100. I0\nM30\n";
    let ran = execute(twice, &with(bars(110.0, 3), &[(3101, 35.0), (3112, 40.0)]));
    assert!(ran.shown.contains("4: load\n4: push NaN\n4: chuck closes\n"), "{}", ran.shown);
    assert!(shown(text, &[(3101, 0.0)]).contains("push 25"));
}

#[test]
fn what_is_not_known_stays_unknown() {
    let shown = |text: &str| execute(text, &Machine::default());
    let ran = shown("M5\nG105\nM30\n");
    assert!(ran.shown.contains("push NaN"), "{}", ran.shown);
    for needed in [Assumption::Variable(3100), Assumption::Variable(3102), Assumption::BarLength] {
        assert!(ran.assumptions.contains(&needed), "{needed:?}");
    }
    let ran = shown("G21\nM5\nG105 J25.\nM30\n");
    assert!(ran.shown.contains("push 25"), "{}", ran.shown);
}

#[test]
fn a_setup_mode_feeds_nothing() {
    check(
        "G21\nM5\nG105 Q2 J25.\nM30\n",
        &bars(1000.0, 1),
        &expect![[r#"
        2: spindle stops
        3: setup Some(2)
        4: spindle stops
        Ended(Program)
    "#]],
    );
    check(
        "G21\nM5\nG105 Q0 J25. K1. I30.\nM30\n",
        &bars(1000.0, 1),
        &expect![[r#"
        2: spindle stops
        3: feed
        3: chuck opens
        3: push 25
        3: chuck closes
        4: spindle stops
        Ended(Program)
    "#]],
    );
}

#[test]
fn a_feed_inside_the_cutoff_program_of_another_ends_too() {
    let ran = execute("O1\nG21\nG105 J25. P2\nM30\nO2\nG105 J25. P2\nM99\n", &bars(1000.0, 1));
    assert_eq!(ran.stopped, "Faulted(TooDeep)");
}

/// States before each block of all paths.
#[derive(Default)]
struct Allowed(Vec<(At, State<Abstract>)>);

impl FlowObserver for Allowed {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.0.push((cx.origin.at, cx.state.clone()));
    }
}

/// Bars and their counters before each block of a run.
#[derive(Default)]
struct Passed(Vec<(At, Bar, [Option<f64>; 4])>);

impl Observer<Concrete> for Passed {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        let counters = [3106, 3107, 3108, 3109].map(|number| Concrete::known(&state.variables().get(number)));
        self.0.push((origin.at, *state.bar(), counters));
    }
}

/// Law 4 for the bar: what a run counts and has left, the analysis of all paths allows at the same block.
#[test]
fn all_paths_allow_what_a_run_does() {
    let text = "\
O1
G21
#3106=0
N1 IF [#500 EQ 1] GOTO 2
#3100=25.
N2 IF [#501 EQ 1] THEN #3102=10.
M5
G105 I30. K20. P2
M11
M10
IF [#3106 LT 5] GOTO 1
M30
O2
G105 J3. K20. I30.
M99
";
    let control = gcheck_controls::load("haas-lathe").unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let program = Program::new(Loaded::new(text, &dialect, |_, _, _| ()), &dialect, &NoLibrary);
    for told in [Machine::default(), bars(300.0, 3)] {
        let mut allowed = Allowed::default();
        let result = flow(&program, &model, &told, Task::all_paths(50_000), &mut allowed);
        assert!(!result.is_incomplete());
        for (branch, limit) in [(0.0, 0.0), (1.0, 1.0)] {
            let machine = with(bars(300.0, 3), &[(500, branch), (501, limit), (3100, 12.0)]);
            let mut passed = Passed::default();
            run(&program, &model, &machine, Options::NONE, 2_000, &mut passed);
            for (at, bar, counters) in passed.0 {
                let allows = |state: &State<Abstract>| {
                    let (length, clamped) = (state.bar().length(), state.bar().clamped());
                    let same = !length.is_known() || length == bar.length();
                    let held = clamped == Truth::Unknown || clamped == bar.clamped();
                    let counted =
                        [3106, 3107, 3108, 3109].into_iter().zip(counters).all(|(number, value)| {
                            let allowed = state.variables().get(number);
                            value.is_none_or(|value| allowed.covers(&Abstract::number(value)))
                        });
                    same && held && counted
                };
                assert!(
                    allowed.0.iter().any(|(block, state)| *block == at && allows(state)),
                    "block {at:?}: {bar:?} {counters:?}"
                );
            }
        }
    }
}

/// Words of every kind: no number makes a run hang or panic.
#[test]
fn any_numbers_end() {
    for j in ["0", "-1.", "1e9", "99999999.", "0.000001", "#0", "[1/3]", "#500", ""] {
        for k in ["K0", "K-5.", "K99999.", "K#500", ""] {
            for i in ["I0", "I-5.", "I99999.", "I#500", ""] {
                for rest in ["", "R720.", "P0", "P9999", "P#500", "Q-1", "Q99", "Q#500"] {
                    let j = if j.is_empty() { String::new() } else { format!("J{j}") };
                    let text = format!("G21\nG105 {j} {k} {i} {rest}\nM99\n");
                    let ran = execute(&text, &bars(1000.0, 3));
                    assert!(!ran.stopped.is_empty());
                }
            }
        }
    }
}
