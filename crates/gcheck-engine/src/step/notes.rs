//! What a call notes: executed from another state in which everything that it read is the same, it does the same.
//!
//! Knows: how to execute a call block by block with its notes. Must not know: how notes are made.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use gcheck_program::{Dialect, Loaded};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestRng, TestRunner};

use super::{Executor, Options, Outcome};
use crate::event::Event;
use crate::fault::Fault;
use crate::lattice::Lattice;
use crate::machine::Machine;
use crate::model::{Model, Role};
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::program::{NoLibrary, Program};
use crate::start::start_state;
use crate::state::State;
use crate::tracked::Notes;
use crate::value::Concrete;

/// Programs of one control, from choices.
struct Writing {
    control: &'static str,
    /// What may stand in front of the call.
    before: &'static [&'static str],
    /// What may stand in front of the call of the other program besides.
    beside: &'static [&'static str],
    /// The call of program 1000.
    calls: &'static [&'static str],
    /// What may stand in it.
    body: &'static [&'static str],
    /// What may stand in the program that it calls, 2000.
    inner: &'static [&'static str],
}

const FANUC: Writing = Writing {
    control: "fanuc-mill",
    before: &["#100=1", "#101=2", "#500=3", "G91", "G90", "G0 X1. Y2. Z3.", "F200.", "S500 M3", "G55", "G18"],
    beside: &[
        "#101=7",
        "#102=8",
        "#500=9",
        "M8",
        "S800",
        "T3",
        "G91",
        "F300.",
        "M3",
        "G43 H2",
        "G52 X3.",
        "G0 X9.",
        "#1=4",
        "#2=5",
        "G66 P2000 A1.",
        "G68 X0. Y0. R30.",
        "G20",
    ],
    calls: &["M98 P1000", "M98 P1000 L2", "G65 P1000 A1. B#100", "G65 P1000 A#101"],
    body: &[
        "#100=#101+1",
        "#102=#1",
        "#2=#2+1",
        "#103=#500",
        "G90",
        "G91",
        "G1 X[#1+1.] F100.",
        "G0 X1. Y1. Z1.",
        "X#101",
        "S100 M3",
        "M5",
        "F50.",
        "#104=#5041",
        "#[100+#1]=3.",
        "IF [#101 GT 3] GOTO 5",
        "N5 #105=1",
        "#106=#4001",
        "M8",
        "G4 P100",
        "M98 P2000",
        "G65 P2000 A#100",
        "G66 P2000 A2.",
        "G67",
        "G54",
        "T2 M6",
        "G43 H1",
        "G10 L2 P2 X5.",
        "G52 X#100",
        "G81 X1. Z-2. R1.",
        "G80",
        "IF [#107 EQ #0] THEN #108=1.",
    ],
    inner: &["#110=#1", "#100=#110", "G91", "G1 X1. F20.", "#1=#1+1", "M9", "#111=#101", "G17"],
};

const LINUXCNC: Writing = Writing {
    control: "linuxcnc",
    before: &[
        "#100=1",
        "#<_one>=2",
        "G91",
        "G90",
        "G0 X1 Y2 Z3",
        "F200",
        "S500 M3",
        "G55",
        "G18",
        "#<_two>=1",
    ],
    beside: &[
        "#101=7",
        "#<_one>=8",
        "#<_three>=9",
        "M8",
        "S800",
        "G91",
        "F300",
        "M3",
        "G0 X9",
        "#1=4",
        "G64 P0.1",
        "M49",
        "G92 X3",
        "#<_two>=4",
    ],
    calls: &["o1000 call [1] [#100]", "o1000 call [#101]"],
    body: &[
        "#100=[#101+1]",
        "#102=#1",
        "#<_three>=#<_one>",
        "#<x>=[#1+1]",
        "#103=#<x>",
        "#103=EXISTS[#<_two>]",
        "G90",
        "G91",
        "G1 X[#1+1] F100",
        "G0 X1 Y1 Z1",
        "X#101",
        "S100 M3",
        "M5",
        "F50",
        "#104=#5420",
        "o7 if [#101 GT 3]",
        "o7 endif",
        "o8 repeat [2]",
        "o8 endrepeat",
        "M70",
        "M72",
        "M73",
        "M8",
        "G64 P0.2",
        "o2000 call [#100]",
        "G54",
        "G92 Y1",
        "M48",
    ],
    inner: &["#110=#1", "#<_one>=#110", "G91", "G1 X1 F20", "#1=[#1+1]", "M9", "#111=#101", "M73", "G17"],
};

impl Writing {
    fn lines(of: &[&'static str], choices: &[u8]) -> String {
        choices
            .iter()
            .filter_map(|choice| of.get(usize::from(*choice) % of.len()))
            .map(|line| format!("{line}\n"))
            .collect()
    }

    /// Two main programs that call the same one, and the blocks at which they begin.
    fn program(&self, choices: &Written) -> (String, [u32; 2]) {
        let first = Self::lines(self.before, &choices.before);
        let second = format!("{first}{}", Self::lines(self.beside, &choices.beside));
        let call = Self::lines(self.calls, &[choices.call]);
        let (body, inner) = (Self::lines(self.body, &choices.body), Self::lines(self.inner, &choices.inner));
        let (mut text, mut starts) = (String::new(), [0; 2]);
        let o_words = self.control == "linuxcnc";
        if o_words {
            text = format!("o2000 sub\n{inner}o2000 endsub\no1000 sub\n{body}o1000 endsub\n");
        }
        for (start, before) in starts.iter_mut().zip([first, second]) {
            *start = text.lines().count() as u32;
            let head = if o_words { "G21 G90 G17 G94" } else { "O1\nG21 G90 G17 G94 G40 G49 G80" };
            let _ = write!(text, "{head}\nF100.\n{before}{call}M30\n");
        }
        if !o_words {
            let _ = write!(text, "O1000\n{body}M99\nO2000\n{inner}M99\n");
        }
        (text, starts)
    }
}

/// The choices that a program is written by.
#[derive(Debug, Clone)]
struct Written {
    before: Vec<u8>,
    beside: Vec<u8>,
    call: u8,
    body: Vec<u8>,
    inner: Vec<u8>,
}

fn written() -> impl Strategy<Value = Written> {
    let lines = |most| prop::collection::vec(any::<u8>(), 0..most);
    (lines(5), lines(3), any::<u8>(), lines(9), lines(4))
        .prop_map(|(before, beside, call, body, inner)| Written { before, beside, call, body, inner })
}

/// Everything that happens, and what an observer reads of the state meanwhile, as rules do.
#[derive(Default)]
struct Log(Vec<String>);

impl Observer<Concrete> for Log {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        let seen = match origin.at.block % 6 {
            0 => format!("{:?}", state.feed()),
            1 => format!("{:?}", state.mode(Role::Distance)),
            2 => format!("{:?}", state.spindle()),
            3 => format!("{:?}", state.variables().get(102)),
            4 => format!("{:?}", state.local(1)),
            _ => format!("{:?}", state.coolant()),
        };
        self.0.push(seen);
    }

    fn event(&mut self, origin: Origin, _: &State<Concrete>, event: &Event) {
        self.0.push(format!("{} {event:?}", origin.at.block));
    }
}

type Run<'a, 'p> = Executor<'a, 'p, Concrete, Log>;

/// Executes until program 1000 is entered; nothing when it is not.
fn enter(executor: &mut Run<'_, '_>, from: u32, state: &mut State<Concrete>) -> Option<At> {
    let mut at = At { file: 0, block: from };
    for _ in 0..100 {
        match executor.step(at, state) {
            Outcome::Next => at = at.next(),
            Outcome::Jump(to) if !state.calls.is_main() => return Some(to),
            Outcome::Jump(to) => at = to,
            Outcome::Fork(_) | Outcome::End(_) | Outcome::Fault(_) => return None,
        }
    }
    None
}

/// Executes the call that was just entered. How it ended: nothing for what is not known, an error for a fault.
fn follow(
    executor: &mut Run<'_, '_>,
    mut at: At,
    state: &mut State<Concrete>,
    inner_notes: bool,
) -> Option<Result<(), Fault>> {
    let depth = executed_depth(state);
    let mut callers = Vec::new();
    for _ in 0..300 {
        let before = executed_depth(state);
        let outcome = executor.step(at, state);
        match outcome {
            Outcome::Next => at = at.next(),
            Outcome::Jump(to) => at = to,
            Outcome::Fault(fault) => return Some(Err(fault)),
            Outcome::Fork(_) | Outcome::End(_) => return None,
        }
        let now = executed_depth(state);
        if now < depth {
            return Some(Ok(()));
        }
        // Calls inside are noted by themselves, or as a part of the outer one.
        if now > before && inner_notes {
            callers.push(state.begin_call());
        } else if now < before && inner_notes {
            let caller = callers.pop()?;
            state.end_call(&caller);
        }
    }
    None
}

/// How many programs are under way, asked of a copy: the call itself has not asked.
fn executed_depth(state: &State<Concrete>) -> usize {
    state.clone().call_depth()
}

/// Did the two states agree? Then the law was checked.
fn check(writing: &Writing, choices: &Written, inner_notes: bool) -> Result<bool, TestCaseError> {
    let (text, [first, second]) = writing.program(choices);
    let control = gcheck_controls::load(writing.control).unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let loaded = Loaded::new(text.as_str(), &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let machine = Machine { fresh: true, start: Some(crate::position::Position::ZERO), ..Machine::default() };
    let run = || Executor::new(&program, &model, &machine, Options::NONE, Log::default());
    let start = || start_state::<Concrete>(&model, &machine, &mut BTreeSet::new());

    let (mut one, mut other) = (run(), run());
    let (mut state, mut beside) = (start(), start());
    let entries = enter(&mut one, first, &mut state).zip(enter(&mut other, second, &mut beside));
    let Some((entry, entry_of_other)) = entries else { return Ok(false) };
    if entry != entry_of_other {
        // A modal macro came first.
        return Ok(false);
    }
    one.observer.0.clear();
    other.observer.0.clear();
    let entered = state.clone();
    let untouched = beside.clone();
    let _caller = state.begin_call();
    let Some(ended) = follow(&mut one, entry, &mut state, inner_notes) else { return Ok(false) };
    let notes: Notes = state.notes();
    if !entered.agrees_on(&beside, &notes) {
        return Ok(false);
    }
    let Some(ended_beside) = follow(&mut other, entry, &mut beside, false) else {
        return Err(TestCaseError::fail(format!("the other ends otherwise\n{text}")));
    };
    prop_assert_eq!(&ended, &ended_beside, "{}", text);
    prop_assert_eq!(&one.observer.0, &other.observer.0, "{}", text);
    if ended.is_ok() {
        let mut summarised = untouched;
        summarised.return_as(&state, &notes);
        prop_assert!(summarised.same(&beside), "{text}\n{summarised:?}\n{beside:?}\n{notes:?}");
    }
    Ok(true)
}

fn law(writing: &'static Writing, inner_notes: bool) {
    let config = Config { cases: 1_500, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let checked = std::cell::Cell::new(0);
    let result = runner.run(&written(), |choices| {
        checked.set(checked.get() + u32::from(check(writing, &choices, inner_notes)?));
        Ok(())
    });
    if let Err(error) = result {
        panic!("{}: {error}", writing.control);
    }
    // A law that hardly any two states agree for would say little.
    assert!(checked.get() > 300, "{}: only {} of 1500 were checked", writing.control, checked.get());
}

#[test]
fn a_call_does_the_same_where_all_that_it_read_is_the_same() {
    law(&FANUC, false);
}

#[test]
fn notes_of_inner_calls_become_notes_of_the_outer_one() {
    law(&FANUC, true);
}

#[test]
fn o_word_calls_do_the_same_where_all_that_they_read_is_the_same() {
    law(&LINUXCNC, false);
}

#[test]
fn notes_of_inner_o_word_calls_become_notes_of_the_outer_one() {
    law(&LINUXCNC, true);
}
