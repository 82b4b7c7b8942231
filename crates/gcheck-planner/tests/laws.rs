//! What holds for every run, whatever its moves.

#![expect(clippy::indexing_slicing, reason = "a test that meets the unexpected is to fail")]

#[expect(dead_code, reason = "the tests of this folder share it, and each uses a part")]
mod machines;

use gcheck_geometry::{Mm, Seconds};
use gcheck_planner::{Corners, Item, Limits, Machine, Meeting, Move, Point, Span};
use machines::{arc, at, items, line, machine, plainly_rounded, rapid, rounded, slowed, spans};
use proptest::prelude::*;

/// One step of a path: how far, by how much it turns, as what.
#[derive(Debug, Clone, Copy)]
enum Step {
    Line { way: [f64; 3], speed: f64 },
    Rotary { way: [f64; 3], turn: f64, speed: f64 },
    Rapid { way: [f64; 3] },
    Arc { radius: f64, direction: f64, sweep: f64, rise: f64, speed: f64 },
    Meeting(Meeting),
    Pause(f64),
}

fn way() -> impl Strategy<Value = [f64; 3]> {
    // Short, long, and along one axis.
    prop_oneof![
        [-30.0..30.0, -30.0..30.0, -5.0..5.0f64],
        [-0.2..0.2, -0.2..0.2, -0.1..0.1f64],
        (-20.0..20.0f64).prop_map(|x| [x, 0.0, 0.0]),
    ]
}

fn meeting() -> impl Strategy<Value = Meeting> {
    prop_oneof![
        Just(Meeting::Stop),
        Just(Meeting::Exact),
        Just(Meeting::Rounded { tolerance: None, merge: Mm::ZERO }),
        (0.001..0.5f64, prop_oneof![Just(0.0), 0.001..0.1f64])
            .prop_map(|(off, merge)| Meeting::Rounded { tolerance: Some(Mm(off)), merge: Mm(merge) }),
    ]
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        6 => (way(), 1.0..300.0f64).prop_map(|(way, speed)| Step::Line { way, speed }),
        1 => (way(), -90.0..90.0f64, 1.0..300.0f64)
            .prop_map(|(way, turn, speed)| Step::Rotary { way, turn, speed }),
        1 => way().prop_map(|way| Step::Rapid { way }),
        3 => (0.05..30.0f64, -3.2..3.2f64, -6.2..6.2f64, prop_oneof![Just(0.0), -3.0..3.0f64], 1.0..300.0f64)
            .prop_map(|(radius, direction, sweep, rise, speed)| Step::Arc { radius, direction, sweep, rise, speed }),
        1 => meeting().prop_map(Step::Meeting),
        1 => (0.0..1.0f64).prop_map(Step::Pause),
    ]
}

fn run_of(steps: &[Step]) -> Vec<Item<usize>> {
    let mut here = Point::zeros();
    let go = |from: Point, way: [f64; 3]| from + at(way[0], way[1], way[2]);
    let mut run = Vec::new();
    for step in steps {
        let item: Move<usize> = match *step {
            Step::Line { way, speed } => line(here, go(here, way), speed),
            Step::Rotary { way, turn, speed } => {
                let mut to = go(here, way);
                to[3] += turn;
                line(here, to, speed)
            }
            Step::Rapid { way } => rapid(here, go(here, way)),
            Step::Arc { radius, direction, sweep, rise, speed } => {
                let centre = (here[0] + radius * direction.cos(), here[1] + radius * direction.sin());
                arc(here, centre, sweep, rise, speed)
            }
            Step::Meeting(meeting) => {
                run.push(Item::Meeting(meeting));
                continue;
            }
            Step::Pause(seconds) => {
                run.push(Item::Pause { seconds: Seconds(seconds), auxiliary: false, tag: 0 });
                continue;
            }
        };
        here = item.to;
        run.push(Item::Move(item));
    }
    run
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    prop::collection::vec(step(), 1..60)
}

fn at_one_speed(steps: &[Step], speed: f64) -> Vec<Step> {
    let at_speed = |step: &Step| match *step {
        Step::Line { way, .. } => Step::Line { way, speed },
        Step::Rotary { way, turn, .. } => Step::Rotary { way, turn, speed },
        Step::Arc { radius, direction, sweep, rise, .. } => {
            Step::Arc { radius, direction, sweep, rise, speed }
        }
        other => other,
    };
    steps.iter().map(at_speed).collect()
}

fn corners() -> impl Strategy<Value = Corners> {
    prop_oneof![Just(rounded()), Just(plainly_rounded()), Just(slowed()), Just(Corners::Filtered)]
}

fn time(machine: &Machine, run: &[Item<usize>]) -> f64 {
    spans(machine, run).iter().map(|span| span.shares.total().0).sum()
}

/// How long the path is that the axes run, corners cut.
fn way_of(machine: &Machine, run: &[Item<usize>]) -> f64 {
    spans(machine, run).iter().map(|span| span.profile.length).sum()
}

fn shares_of(span: &Span<usize>) -> [f64; 7] {
    let shares = span.shares;
    [
        shares.run.0,
        shares.acceleration.0,
        shares.starved.0,
        shares.spindle.0,
        shares.tool_change.0,
        shares.auxiliary.0,
        shares.dwell.0,
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn no_time_is_negative_or_unknown(steps in steps(), corners in corners(), block in 0.0..0.01f64) {
        let mut machine = machine(corners, 800.0);
        machine.control.block_time = Seconds(block);
        for span in spans(&machine, &run_of(&steps)) {
            prop_assert!(shares_of(&span).iter().all(|share| *share >= -1e-9 && share.is_finite()), "{span:#?}");
        }
    }

    /// A stretch never takes less than at the speed asked for, and its speed stays within every limit.
    #[test]
    fn no_speed_is_above_what_was_asked_for_and_what_axes_can(steps in steps(), corners in corners()) {
        let machine = machine(corners, 800.0);
        for span in spans(&machine, &run_of(&steps)) {
            let profile = span.profile;
            // Time that overlaps that of the stretch before it belongs to both.
            prop_assert!(profile.seconds >= span.asked.0 - 1e-9, "{span:#?}");
            if profile.length <= 0.0 {
                continue;
            }
            let asked = profile.length / span.asked.0;
            for part in 0..=20 {
                let speed = profile.speed_at(profile.seconds * f64::from(part) / 20.0);
                prop_assert!(speed <= asked * (1.0 + 1e-9) + 1e-9, "{speed} in {span:#?}");
            }
        }
    }

    /// Speed does not jump: each stretch begins as fast as the last one ended, and in between it changes as the axes can.
    #[test]
    fn speed_does_not_jump(steps in steps(), rounds in any::<bool>()) {
        let machine = machine(if rounds { rounded() } else { slowed() }, 800.0);
        let mut last: f64 = 0.0;
        for span in spans(&machine, &run_of(&steps)) {
            let profile = span.profile;
            if profile.length <= 0.0 {
                prop_assert!(last.abs() < 1e-9, "standing begins at {last} {span:#?}");
                continue;
            }
            prop_assert!((profile.entry - last).abs() < 1e-6, "{last} to {span:#?}");
            let most = 2.0 * profile.acceleration * profile.length;
            let change = (profile.exit * profile.exit - profile.entry * profile.entry).abs();
            prop_assert!(change <= most * (1.0 + 1e-6) + 1e-6, "{span:#?}");
            last = profile.exit;
        }
    }

    /// At one speed: the arc in a corner has the higher speed of the two moves that it rounds, so that a wider one makes a
    /// slow move shorter. With less acceleration the arcs in corners are wider and the path is shorter: at a slow feed that
    /// gains more than starting and stopping lose.
    #[test]
    fn more_acceleration_takes_no_longer_than_the_longer_path(
        steps in steps(), speed in 1.0..300.0f64, corners in corners(), slow in 50.0..5_000.0f64, factor in 1.0..10.0f64,
    ) {
        let run = run_of(&at_one_speed(&steps, speed));
        let [(slow, short), (fast, long)] = [slow, slow * factor].map(|acceleration| {
            let machine = machine(corners, acceleration);
            (time(&machine, &run), way_of(&machine, &run))
        });
        let longer = (long - short).max(0.0) / speed.min(200.0);
        // A corner that is passed on the path itself may then be rounded instead, at a few microseconds.
        prop_assert!(fast <= slow + longer + 1e-6, "{slow} s, then {fast} s, {longer} s of them for a longer path");
    }

    #[test]
    fn more_jerk_never_takes_longer(steps in steps(), jerk in 1e3..1e6f64, factor in 1.0..10.0f64) {
        let run = run_of(&steps);
        let timed = |jerk: Option<f64>| {
            let mut machine = machine(slowed(), 800.0);
            machine.limits = Limits::new([200.0; 9], [800.0; 9], jerk.map(|jerk| [jerk; 9])).unwrap();
            time(&machine, &run)
        };
        let [none, fast, slow] = [None, Some(jerk * factor), Some(jerk)].map(timed);
        prop_assert!(none <= fast + 1e-9 && fast <= slow + 1e-9, "{none} {fast} {slow}");
    }

    /// Where a straight move is cut in two, nothing changes.
    #[test]
    fn a_straight_move_in_two_parts_is_the_same(
        steps in prop::collection::vec((way(), 1.0..200.0f64), 1..12), at in 0.05..0.95f64, which in any::<prop::sample::Index>(),
    ) {
        let path: Vec<Step> = steps.iter().map(|(way, speed)| Step::Line { way: *way, speed: *speed }).collect();
        let mut run = run_of(&path);
        run.insert(0, Item::Meeting(Meeting::Stop));
        let which = 1 + which.index(run.len() - 1);
        let mut parts = run.clone();
        // Only the cut itself is passed without a stop: the corners of the path are stops.
        let Item::Move(whole) = run[which] else { return Ok(()) };
        let middle = whole.from + (whole.to - whole.from) * at;
        let mut first = Move { to: middle, ..whole };
        let mut second = Move { from: middle, ..whole };
        first.asked = whole.asked * at;
        second.asked = whole.asked * (1.0 - at);
        let rounded_here = Item::Meeting(Meeting::Rounded { tolerance: Some(Mm(0.01)), merge: Mm::ZERO });
        parts.splice(
            which..=which,
            [Item::Halt, rounded_here, Item::Move(first), Item::Move(second), Item::Halt, Item::Meeting(Meeting::Stop)],
        );
        run.splice(
            which..=which,
            [Item::Halt, rounded_here, Item::Move(whole), Item::Halt, Item::Meeting(Meeting::Stop)],
        );
        let machine = machine(plainly_rounded(), 800.0);
        let [one, two] = [time(&machine, &run), time(&machine, &parts)];
        prop_assert!((one - two).abs() <= 1e-6 * one + 1e-6, "{one} in one part, {two} in two");
    }

    /// Looking further ahead than it takes to stop changes nothing.
    #[test]
    fn a_window_beyond_the_way_to_stop_changes_nothing(steps in steps(), corners in corners()) {
        let run = run_of(&steps);
        let timed = |ahead: usize| {
            let mut machine = machine(corners, 800.0);
            machine.control.look_ahead = ahead;
            time(&machine, &run)
        };
        let [all, more, few, one] = [200, 2_000, 5, 1].map(timed);
        prop_assert!((all - more).abs() < 1e-9);
        prop_assert!(all <= few + 1e-9 && few <= one + 1e-9, "{all} {few} {one}");
    }

    /// Times come out in order, and the clock is their sum.
    #[test]
    fn spans_follow_each_other(steps in steps(), corners in corners()) {
        let mut now = 0.0;
        for span in spans(&machine(corners, 800.0), &run_of(&steps)) {
            prop_assert!(span.begin.0 <= now + 1e-9, "{now} before {span:#?}");
            now = span.begin.0 + span.profile.seconds + span.shares.starved.0;
        }
        let total: f64 = time(&machine(corners, 800.0), &run_of(&steps));
        prop_assert!((total - now).abs() < 1e-6, "{total} {now}");
    }

    /// Whatever numbers come, something finite goes out.
    #[test]
    fn any_numbers_end(values in prop::collection::vec((any::<f64>(), any::<f64>(), any::<f64>(), any::<f64>()), 0..40)) {
        let mut here = Point::zeros();
        let mut run = Vec::new();
        for (x, y, z, speed) in values {
            let to = at(x, y, z);
            run.push(Item::Move(line(here, to, speed)));
            here = to;
        }
        let machine = machine(rounded(), 800.0);
        for span in spans(&machine, &run) {
            prop_assert!(span.shares.total().0.is_finite(), "{span:#?}");
        }
    }
}

#[test]
fn memory_is_bounded_by_the_window() {
    let machine = machine(rounded(), 800.0);
    let mut planner = gcheck_planner::Planner::new(machine);
    planner.push(Item::Meeting(Meeting::Rounded { tolerance: Some(Mm(0.01)), merge: Mm::ZERO }), &mut |_| {});
    let mut done = 0;
    let mut most = 0;
    for ix in 0..20_000_i32 {
        let x = f64::from(ix) * 0.1;
        let item = line(at(x, x.sin(), 0.0), at(x + 0.1, (x + 0.1).sin(), 0.0), 50.0);
        planner.push(Item::Move(item), &mut |span| done += span.blocks);
        most = most.max(ix + 1 - i32::try_from(done).unwrap());
    }
    assert!(most <= 52, "{most} moves were waiting");
}

#[test]
fn items_without_way_take_no_time() {
    let here = at(1.0, 2.0, 3.0);
    let run = items(Meeting::Exact, &[line(here, here, 10.0), rapid(here, here)]);
    assert_eq!(spans(&machine(rounded(), 800.0), &run).len(), 0);
}
