//! Times of small runs, against what can be computed by hand.

mod machines;

use gcheck_geometry::{Mm, Rpm, Seconds};
use gcheck_planner::{
    Cause, Corners, Drive, Item, Limits, Machine, Meeting, Rapids, SpindleLimits, SpindleWait, Taps,
};
use machines::{
    arc, at, items, line, machine, plainly_rounded, rapid, rounded, seconds, shares, slowed, spans, within,
};

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-6 + 1e-6 * expected.abs(), "{found}, not {expected}");
}

/// The control's half cycle after a stop.
const CYCLE: f64 = 0.0005;

#[test]
fn a_move_speeds_up_and_slows_down() {
    // 100 mm at 50 mm/s and 1000 mm/s²: 2 s, and half of 50 ms at each end.
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), at(100.0, 0.0, 0.0), 50.0)]);
    near(seconds(&machine(rounded(), 1000.0), &run), 2.05 + CYCLE);
    // On a diagonal two axes share the acceleration.
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), at(30.0, 40.0, 0.0), 50.0)]);
    near(seconds(&machine(rounded(), 1000.0), &run), 1.0 + 50.0 / 1250.0 + CYCLE);
}

#[test]
fn a_move_that_is_too_short_never_reaches_its_speed() {
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), at(0.4, 0.0, 0.0), 50.0)]);
    near(seconds(&machine(rounded(), 1000.0), &run), 0.04 + CYCLE);
}

#[test]
fn a_stop_after_each_move_costs_time_at_each() {
    let moves = [
        line(at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0), 50.0),
        line(at(10.0, 0.0, 0.0), at(20.0, 0.0, 0.0), 50.0),
    ];
    near(seconds(&machine(rounded(), 1000.0), &items(Meeting::Stop, &moves)), 2.0 * (0.25 + CYCLE));
    // Straight on, an exact path needs no stop.
    near(seconds(&machine(rounded(), 1000.0), &items(Meeting::Exact, &moves)), 0.45 + CYCLE);
}

#[test]
fn a_corner_is_rounded_inside_its_tolerance() {
    let moves = [
        line(at(0.0, 0.0, 0.0), at(50.0, 0.0, 0.0), 80.0),
        line(at(50.0, 0.0, 0.0), at(50.0, 50.0, 0.0), 80.0),
    ];
    let machine = machine(plainly_rounded(), 1000.0);
    let spans = spans(&machine, &items(within(0.1), &moves));
    let [first, corner, second] = spans.as_slice() else { panic!("{spans:#?}") };
    // An arc that stays 0.1 mm from the corner of a right angle has this radius.
    let half = std::f64::consts::FRAC_PI_4;
    let radius = 0.1 * half.cos() / (1.0 - half.cos());
    near(corner.profile.length, radius * 2.0 * half);
    near(corner.profile.peak, (1000.0 * radius).sqrt());
    near(first.profile.exit, corner.profile.peak);
    near(second.profile.entry, corner.profile.peak);
    near(first.profile.length, 50.0 - radius);
    assert_eq!((first.blocks, corner.blocks, second.blocks), (1, 0, 1));
    assert_eq!(corner.cause, Cause::Corner);
}

/// An arc that curves as the corner turns gives the corner little of its length: the quarter of the angle between its tangents
/// at most, and the corner counts as a sharper one by half of that.
#[test]
fn a_corner_of_two_arcs_is_as_tight_as_its_arcs_leave_it() {
    let (radius, sweep, turn) = (5.0_f64, 70_f64.to_radians(), 120_f64.to_radians());
    let from = at(radius, 0.0, 0.0);
    let first = arc(from, (0.0, 0.0), sweep, 0.0, 50.0);
    // The corner turns to the left, as the first arc does; the second one curves to the right.
    let heading = sweep + std::f64::consts::FRAC_PI_2 + turn;
    let centre = (first.to[0] + radius * heading.sin(), first.to[1] - radius * heading.cos());
    let second = arc(first.to, centre, -sweep, 0.0, 50.0);
    let spans = spans(&machine(rounded(), 1000.0), &items(within(0.0), &[first, second]));
    let [_, corner, _] = spans.as_slice() else { panic!("{spans:#?}") };
    let angle = (sweep * 2.0 / 3.0).min((std::f64::consts::PI - turn) / 2.0);
    let inner = (angle / 4.0).sin() * radius / f64::midpoint(turn, angle / 2.0).tan();
    near(corner.profile.peak, (866.0 * inner).sqrt());
}

/// Two arcs that all but turn back: they overlap, each at half of what turning leaves of the acceleration.
#[test]
fn a_very_sharp_corner_of_two_arcs_is_not_rounded() {
    let (radius, sweep) = (5.0_f64, 70_f64.to_radians());
    let first = arc(at(radius, 0.0, 0.0), (0.0, 0.0), sweep, 0.0, 50.0);
    let heading = sweep + std::f64::consts::FRAC_PI_2 + 170_f64.to_radians();
    let centre = (first.to[0] + radius * heading.sin(), first.to[1] - radius * heading.cos());
    let second = arc(first.to, centre, -sweep, 0.0, 50.0);
    let spans = spans(&machine(rounded(), 1000.0), &items(within(0.0), &[first, second]));
    let [one, other] = spans.as_slice() else { panic!("{spans:#?}") };
    near(one.profile.acceleration, 250.0);
    assert!(other.begin < one.begin + Seconds(one.profile.seconds), "{spans:#?}");
}

/// Of 0.01 mm in the middle of a straight line.
#[test]
fn no_stretch_is_run_in_less_than_the_control_needs() {
    let moves = [
        line(at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0), 50.0),
        line(at(10.0, 0.0, 0.0), at(10.01, 0.0, 0.0), 50.0),
        line(at(10.01, 0.0, 0.0), at(20.0, 0.0, 0.0), 50.0),
    ];
    let mut machine = machine(rounded(), 1000.0);
    machine.control.shortest = Seconds(0.002);
    let spans = spans(&machine, &items(within(0.01), &moves));
    let [first, short, _] = spans.as_slice() else { panic!("{spans:#?}") };
    near(first.profile.exit, 5.0);
    near(short.profile.seconds, 0.002);
}

/// The control does not know that the last move is the last: another one may overlap with its second half.
#[test]
fn the_last_move_is_entered_so_that_half_of_it_is_enough_to_stop() {
    let moves = [
        line(at(0.0, 0.0, 0.0), at(50.0, 0.0, 0.0), 50.0),
        line(at(50.0, 0.0, 0.0), at(60.0, 0.0, 0.0), 50.0),
    ];
    let spans = spans(&machine(rounded(), 250.0), &items(within(0.05), &moves));
    let [first, last] = spans.as_slice() else { panic!("{spans:#?}") };
    near(first.profile.exit, (125.0_f64 * 10.0).sqrt());
    assert!(last.profile.peak > last.profile.entry, "{spans:#?}");
}

#[test]
fn back_and_forth_is_a_stop() {
    let moves = [
        line(at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0), 50.0),
        line(at(10.0, 0.0, 0.0), at(0.0, 0.0, 0.0), 50.0),
    ];
    let machine = machine(plainly_rounded(), 1000.0);
    near(seconds(&machine, &items(within(1.0), &moves)), 2.0 * (0.25 + CYCLE));
}

#[test]
fn rapid_moves_and_moves_at_feed_do_not_meet() {
    let moves =
        [rapid(at(0.0, 0.0, 0.0), at(90.0, 0.0, 0.0)), line(at(90.0, 0.0, 0.0), at(100.0, 0.0, 0.0), 50.0)];
    let machine = machine(plainly_rounded(), 1000.0);
    near(seconds(&machine, &items(within(1.0), &moves)), 0.65 + 0.25 + 2.0 * CYCLE);
}

#[test]
fn a_tight_arc_is_run_as_its_turn_allows() {
    let full = std::f64::consts::TAU;
    let item = arc(at(0.0, 0.0, 0.0), (0.9, 0.0), full, 0.0, 100.0);
    let machine = machine(plainly_rounded(), 1000.0);
    let spans = spans(&machine, &items(Meeting::Stop, &[item]));
    near(spans[0].profile.peak, 30.0);
    assert_eq!(spans[0].cause, Cause::Turn);
}

#[test]
fn an_axis_holds_back_what_it_is_too_slow_for() {
    let mut machine = machine(plainly_rounded(), 1000.0);
    machine.limits =
        Limits::new([200.0, 10.0, 200.0, 9.0, 9.0, 9.0, 200.0, 200.0, 200.0], [1e9; 9], None).unwrap();
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), at(0.0, 20.0, 0.0), 50.0)]);
    let found = spans(&machine, &run);
    assert_eq!(found[0].cause, Cause::Axis);
    assert!((found[0].shares.run.0 - 2.0).abs() < 1e-6, "{found:#?}");
    // A rotary axis beside a linear one.
    let mut to = at(10.0, 0.0, 0.0);
    to[3] = 90.0;
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), to, 50.0)]);
    assert!((seconds(&machine, &run) - 10.0).abs() < 1e-3);
}

#[test]
fn rapid_moves_of_each_axis_for_itself_end_with_the_last_one() {
    let mut machine = machine(Corners::Filtered, 1000.0);
    machine.control.rapids = Rapids::ByAxis;
    let run = items(within(0.0), &[rapid(at(0.0, 0.0, 0.0), at(100.0, 50.0, 0.0))]);
    near(seconds(&machine, &run), 0.5 + 0.2);
    // On the straight line both would arrive together.
    machine.control.rapids = Rapids::Straight;
    near(seconds(&machine, &run), 0.5 + 0.2);
    machine.rapid_part = 0.5;
    near(seconds(&machine, &run), 1.0 + 0.1);
}

#[test]
fn filtered_axes_follow_without_slowing_down_for_corners() {
    let machine = machine(Corners::Filtered, 1000.0);
    let moves = [
        line(at(0.0, 0.0, 0.0), at(10.0, 0.0, 0.0), 50.0),
        line(at(10.0, 0.0, 0.0), at(10.0, 10.0, 0.0), 50.0),
    ];
    near(seconds(&machine, &items(within(0.0), &moves)), 0.4 + 0.05);
    near(seconds(&machine, &items(Meeting::Stop, &moves)), 0.4 + 0.1);
}

#[test]
fn a_slowed_corner_is_passed_at_the_change_that_the_axes_can_take() {
    let machine = machine(slowed(), 1000.0);
    let moves = [
        line(at(0.0, 0.0, 0.0), at(50.0, 0.0, 0.0), 50.0),
        line(at(50.0, 0.0, 0.0), at(50.0, 50.0, 0.0), 50.0),
    ];
    let found = spans(&machine, &items(within(0.0), &moves));
    near(found[0].profile.exit, 500.0 / 60.0);
}

#[test]
fn jerk_adds_its_time_to_each_change_of_speed() {
    let mut machine = machine(slowed(), 1000.0);
    machine.limits = Limits::new([200.0; 9], [1000.0; 9], Some([50_000.0; 9])).unwrap();
    // With 20 ms to full acceleration: 20 ms more in all.
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), at(100.0, 0.0, 0.0), 50.0)]);
    near(seconds(&machine, &run), 2.05 + 0.02);
    // Too short for the full acceleration: four equal parts, each a third power of time.
    let run = items(Meeting::Stop, &[line(at(0.0, 0.0, 0.0), at(0.2, 0.0, 0.0), 50.0)]);
    near(seconds(&machine, &run), 4.0 * (0.2_f64 / (2.0 * 50_000.0)).cbrt());
}

#[test]
fn nearly_straight_moves_become_one() {
    let points =
        [at(0.0, 0.0, 0.0), at(1.0, 0.004, 0.0), at(2.0, -0.004, 0.0), at(3.0, 0.0, 0.0), at(3.0, 5.0, 0.0)];
    let moves: Vec<_> = points.windows(2).map(|pair| line(pair[0], pair[1], 50.0)).collect();
    let machine = machine(rounded(), 1000.0);
    let merged = Meeting::Rounded { tolerance: Some(Mm(0.01)), merge: Mm(0.01) };
    let found = spans(&machine, &items(merged, &moves));
    let blocks: Vec<u32> = found.iter().map(|span| span.blocks).collect();
    assert_eq!(blocks, [3, 0, 1], "{found:#?}");
    assert!(seconds(&machine, &items(merged, &moves)) < seconds(&machine, &items(within(0.01), &moves)));
}

/// The chord of an even number of half turns is short, and the way is not.
#[test]
fn whole_turns_are_not_straight() {
    let merged = Meeting::Rounded { tolerance: Some(Mm(0.01)), merge: Mm(0.01) };
    for turns in 1..=4_u32 {
        let sweep = std::f64::consts::TAU * f64::from(turns);
        let item = arc(at(0.0, 0.0, 0.0), (-10.0, 0.0), sweep, 1.0, 10.0);
        let found = seconds(&machine(rounded(), 1000.0), &items(merged, &[item]));
        // At 10 mm/s, a turn of 10 mm radius takes as many seconds as its angle.
        assert!(found >= sweep, "{turns} turns in {found} s");
    }
}

#[test]
fn blocks_that_come_too_fast_are_waited_for() {
    let mut machine = machine(rounded(), 1000.0);
    machine.control.block_time = Seconds(0.001);
    let count = 2_000;
    let point = |ix: i32| at(f64::from(ix) * 0.01, 0.0, 0.0);
    // 10 µm at 50 mm/s: 0.2 ms each.
    let moves: Vec<_> = (0..count).map(|ix| line(point(ix), point(ix + 1), 50.0)).collect();
    let found = shares(&machine, &items(within(0.01), &moves));
    assert!((found.total().0 - 2.0).abs() < 0.02, "{found:#?}");
    assert!(found.starved.0 > 1.2, "{found:#?}");
    // A short burst is in the window already.
    let burst = Item::Pause { seconds: Seconds(1.0), auxiliary: false, tag: 0 };
    let mut run = vec![Item::Meeting(within(0.01)), burst];
    run.extend(moves.iter().take(40).map(|item| Item::Move(*item)));
    assert!(shares(&machine, &run).starved.0 < 1e-9);
}

fn turning(acceleration: f64) -> Machine {
    let mut machine = machine(rounded(), 1e6);
    machine.spindle = SpindleLimits { acceleration: Some(Rpm(acceleration)), orientation: Seconds(0.5) };
    machine
}

#[test]
fn a_move_at_feed_waits_for_the_spindle_and_a_rapid_move_does_not() {
    let spindle = Item::Spindle { speed: Rpm(3000.0), tag: 7 };
    let to = at(100.0, 0.0, 0.0);
    let run =
        [spindle, Item::Move(rapid(at(0.0, 0.0, 0.0), to)), Item::Move(line(to, at(110.0, 0.0, 0.0), 50.0))];
    let found = shares(&turning(1000.0), &run);
    // Three seconds, half of one in which the rapid move is made.
    assert!((found.spindle.0 - 2.5).abs() < 0.01, "{found:#?}");
    let mut at_once = turning(1000.0);
    at_once.control.spindle_wait = SpindleWait::AtOnce;
    assert!((shares(&at_once, &run).spindle.0 - 3.0).abs() < 1e-9);
}

#[test]
fn a_spindle_that_turns_round_takes_both_ways() {
    let run = [Item::Spindle { speed: Rpm(1000.0), tag: 0 }, Item::Spindle { speed: Rpm(-1000.0), tag: 0 }];
    let mut machine = turning(1000.0);
    machine.control.spindle_wait = SpindleWait::AtOnce;
    near(shares(&machine, &run).spindle.0, 3.0);
    let run = [Item::Spindle { speed: Rpm(1000.0), tag: 0 }, Item::Orient { tag: 0 }];
    near(shares(&machine, &run).spindle.0, 1.0 + 1.0 + 0.5);
}

#[test]
fn a_tap_comes_to_rest_at_the_bottom_or_runs_on() {
    let stroke = |from: f64, to: f64| {
        let mut item = line(at(0.0, 0.0, from), at(0.0, 0.0, to), 25.0);
        item.drive = Drive::Tap(Rpm(1000.0));
        Item::Move(item)
    };
    let run = [stroke(0.0, -20.0), stroke(-20.0, 0.0)];
    let mut machine = turning(2000.0);
    // Half a second to speed: at 25 mm/s 12.5 mm for both changes, 7.5 mm on.
    near(seconds(&machine, &run), 2.0 * (1.0 + 0.3 + CYCLE));
    machine.control.taps = Taps::RunOut;
    // It waits half a turn for the mark, and comes to rest beyond the top.
    near(seconds(&machine, &run), 2.0 * (0.8 + 1.0 + CYCLE) + 0.03 + 25.0 / 1e6);
}

#[test]
fn a_thread_waits_for_the_spindles_mark() {
    let mut item = line(at(0.0, 0.0, 0.0), at(0.0, 0.0, -30.0), 30.0);
    item.drive = Drive::Thread(Rpm(600.0));
    let found = shares(&turning(1e9), &[Item::Move(item)]);
    near(found.spindle.0, 0.05);
}

#[test]
fn the_magazine_turns_the_shorter_way_and_ahead_where_it_can() {
    let mut machine = machine(rounded(), 1000.0);
    machine.changer.pocket = Seconds(0.5);
    machine.changer.pockets = Some(20);
    let change = |pocket| Item::Change { pocket: Some(pocket), tag: 0 };
    near(seconds(&machine, &[change(1), change(18)]), 4.0 + 4.0 + 1.5);
    machine.changer.turns_ahead = true;
    let pause = Item::Pause { seconds: Seconds(1.0), auxiliary: false, tag: 0 };
    near(
        seconds(&machine, &[change(1), Item::Call { pocket: 18 }, pause, change(18)]),
        4.0 + 1.0 + 4.0 + 0.5,
    );
}

#[test]
fn shares_tell_dwells_from_auxiliary_functions() {
    let machine = machine(rounded(), 1000.0);
    let pause = |auxiliary| Item::Pause { seconds: Seconds(2.0), auxiliary, tag: 0 };
    let found = shares(&machine, &[pause(true), pause(false)]);
    near(found.dwell.0, 2.0);
    near(found.auxiliary.0, 2.0);
}

#[test]
fn limits_that_no_machine_has_are_refused() {
    let error = Limits::new([200.0; 9], [0.0; 9], None).unwrap_err();
    assert_eq!(error.to_string(), "the acceleration of X is 0: it must be greater than zero");
    let mut jerk = [1.0; 9];
    jerk[2] = f64::NAN;
    let error = Limits::new([200.0; 9], [1.0; 9], Some(jerk)).unwrap_err();
    assert_eq!(error.to_string(), "the jerk of Z is NaN: it must be greater than zero");
    assert!(Limits::new([-1.0; 9], [1.0; 9], None).is_err());
}
