//! The laws of the lattice, for every part of the state, and that every field of it counts in all four questions.
//!
//! Knows: how to make values of every part from a few choices. Must not know: what blocks do.

mod alterations;
mod choices;

use std::fmt::Debug;

use gcheck_controls::LetterSet;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestRng, TestRunner};

use self::alterations::alterations;
use self::choices::{Choices, Made};
use super::*;
use crate::assumption::Assumptions;
use crate::lattice::{Flat, May};
use crate::machine::{BarFeeder, Machine};
use crate::position::Axis;
use crate::start::start_state;

/// Changes of choices: what makes one value from another that it is like in most.
type Changes = Vec<(usize, u8)>;

fn changed(choices: &[u8], changes: &Changes) -> Vec<u8> {
    let mut choices = choices.to_vec();
    for (at, choice) in changes {
        let at = at % choices.len().max(1);
        if let Some(slot) = choices.get_mut(at) {
            *slot = *choice;
        }
    }
    choices
}

/// Checks the laws on three values, of which the second and third are like the first.
fn check<T: Made + Lattice + Clone + Debug>(
    choices: &[u8],
    first: &Changes,
    second: &Changes,
) -> Result<(), TestCaseError> {
    let a = T::made(&mut Choices::of(choices));
    let b = T::made(&mut Choices::of(&changed(choices, first)));
    let c = T::made(&mut Choices::of(&changed(choices, second)));
    for (joined, name) in [(a.join(&b), "join"), (a.widen(&b), "widen")] {
        prop_assert!(joined.covers(&a), "{name} does not cover the first\n{a:?}\n{b:?}\n{joined:?}");
        prop_assert!(joined.covers(&b), "{name} does not cover the second\n{a:?}\n{b:?}\n{joined:?}");
    }
    let (one, other) = (a.join(&b), b.join(&a));
    prop_assert!(one.same(&other), "the order counts\n{a:?}\n{b:?}\n{one:?}\n{other:?}");
    prop_assert!(a.join(&a).same(&a), "joined with itself it is another\n{a:?}\n{:?}", a.join(&a));
    prop_assert!(a.widen(&a).same(&a), "widened by itself it is another\n{a:?}");
    prop_assert!(a.covers(&a), "it does not cover itself\n{a:?}");
    prop_assert!(a.same(&a.clone()), "a copy is not the same\n{a:?}");
    if a.same(&b) {
        prop_assert!(b.same(&a) && a.covers(&b) && b.covers(&a), "{a:?}\n{b:?}");
    }
    let wide = a.join(&b).join(&c);
    prop_assert!(wide.covers(&a) && wide.covers(&b) && wide.covers(&c), "{a:?}\n{b:?}\n{c:?}\n{wide:?}");
    prop_assert!(wide.covers(&one), "covering does not pass on\n{one:?}\n{wide:?}");
    if a.covers(&b) && b.covers(&c) {
        prop_assert!(a.covers(&c), "covering does not pass on\n{a:?}\n{b:?}\n{c:?}");
    }
    Ok(())
}

/// A chain of widenings by the same values comes to an end.
fn check_chain<T: Made + Lattice + Clone + Debug>(
    choices: &[u8],
    steps: &[Changes],
) -> Result<(), TestCaseError> {
    let values: Vec<T> =
        steps.iter().map(|changes| T::made(&mut Choices::of(&changed(choices, changes)))).collect();
    let mut wide = T::made(&mut Choices::of(choices));
    for _ in 0..64 {
        let before = wide.clone();
        for value in &values {
            wide = wide.widen(value);
        }
        if wide.same(&before) {
            return Ok(());
        }
    }
    Err(TestCaseError::fail(format!("it is still growing: {wide:?}")))
}

fn laws<T: Made + Lattice + Clone + Debug>(cases: u32) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let changes = || prop::collection::vec((any::<usize>(), any::<u8>()), 0..6);
    let strategy = (prop::collection::vec(any::<u8>(), T::CHOICES), prop::collection::vec(changes(), 2..6));
    let result = runner.run(&strategy, |(choices, changes)| {
        let [first, second, ..] = changes.as_slice() else { return Ok(()) };
        check::<T>(&choices, first, second)?;
        check_chain::<T>(&choices, &changes)
    });
    if let Err(error) = result {
        panic!("{}: {error}", std::any::type_name::<T>());
    }
}

#[test]
fn leaves_keep_the_laws() {
    laws::<f64>(500);
    laws::<Option<f64>>(500);
    laws::<Truth>(200);
    laws::<May>(50);
    laws::<Flat<u16>>(200);
    laws::<Perhaps<u32>>(200);
    laws::<LetterSet>(500);
    laws::<Position>(500);
    laws::<ModeSet>(2_000);
    laws::<AbstractValue>(2_000);
    laws::<WorkOffset>(300);
}

#[test]
fn points_offsets_and_tables_keep_the_laws() {
    laws::<Points>(300);
    laws::<Tables>(1_000);
    laws::<Offsets>(500);
}

#[test]
fn modes_tool_feed_and_spindle_keep_the_laws() {
    laws::<Modes>(300);
    laws::<ToolData>(300);
    laws::<ToolState<Abstract>>(500);
    laws::<Feed<Abstract>>(500);
    laws::<SpindleState<Abstract>>(500);
    laws::<CoolantState>(100);
    laws::<Blending>(200);
}

#[test]
fn words_and_transformations_keep_the_laws() {
    laws::<CycleWords>(1_000);
    laws::<KeptTurningWords>(500);
    laws::<Transform>(1_000);
    laws::<Mapping>(500);
    laws::<ToolShift>(500);
    laws::<Probe>(500);
    laws::<Bar>(500);
}

#[test]
fn compensation_and_curves_keep_the_laws() {
    laws::<CompensationState>(500);
    laws::<Perhaps<ControlPoints>>(500);
    laws::<SavedModes>(300);
}

#[test]
fn variables_and_calls_keep_the_laws() {
    laws::<Locals<Abstract>>(300);
    laws::<Variables<Abstract>>(1_000);
    laws::<Kept>(1_000);
    laws::<ModalCalls<Abstract>>(1_000);
    laws::<Calls<Abstract>>(1_000);
}

#[test]
fn whole_states_keep_the_laws() {
    laws::<State<Abstract>>(400);
}

/// The state before a program, of which everything is known.
fn known_state() -> State<Abstract> {
    let control = gcheck_controls::load("fanuc-mill").unwrap();
    let model = Model::new(&control);
    let machine = Machine {
        fresh: true,
        start: Some(Position::ZERO),
        tool_table_is_complete: true,
        bar: BarFeeder { new_bar: Some(Mm(1000.0)), bars: Some(3), starts_new: true },
        ..Machine::default()
    };
    let mut state = start_state(&model, &machine, &mut Assumptions::default());
    state.points.passed = Position::ZERO;
    state.bar.clamped = Truth::True;
    state
}

/// Two paths that differ in one thing: neither stands for the other, and what stands for both has not invented anything.
#[test]
fn every_field_counts_in_all_four_questions() {
    let base = known_state();
    for (name, alter) in alterations() {
        let mut other = base.clone();
        alter(&mut other);
        assert!(!base.same(&other) && !other.same(&base), "{name}: the two are called the same");
        assert!(!base.covers(&other), "{name}: the one covers the other");
        assert!(!other.covers(&base), "{name}: the other covers the one");
        for joined in [base.join(&other), base.widen(&other)] {
            assert!(joined.covers(&base) && joined.covers(&other), "{name}: a path is lost");
            assert!(
                !joined.same(&base) && !joined.same(&other),
                "{name}: one path's value is taken for both"
            );
        }
        assert!(base.join(&other).same(&other.join(&base)), "{name}: the order counts");
        assert!(base.join(&base.clone()).same(&base), "{name}");
    }
}

/// A run's state is a state of the analysis.
#[test]
fn the_state_of_a_run_is_one_of_the_analysis() {
    let control = gcheck_controls::load("linuxcnc").unwrap();
    let model = Model::new(&control);
    let machine = Machine { fresh: true, ..Machine::default() };
    let run = start_state::<Concrete>(&model, &machine, &mut Assumptions::default());
    let all = start_state::<Abstract>(&model, &machine, &mut Assumptions::default());
    assert!(all.same(&run.as_abstract()));
}
