//! Machines and moves for tests.

#![expect(clippy::indexing_slicing, reason = "points have three axes")]
#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_geometry::{Arc, Mm, Plane, Seconds};
use gcheck_planner::{
    Changer, Control, Corners, Drive, Item, Limits, Machine, Meeting, Move, Planner, Point, Rapids, Rounding,
    Shares, Slowing, Span, SpindleLimits, SpindleWait, Taps,
};

/// Corners on arcs, as a control does it that was measured; moves that cannot be rounded overlap.
pub(crate) fn rounded() -> Corners {
    Corners::Rounded(Rounding {
        default_tolerance: None,
        part_of_length: 0.25,
        stretched: true,
        curve_shares: [1.0 / 3.0, 1.0 / 6.0],
        sharpest_between_arcs: 150_f64.to_radians(),
        across: 0.866,
        along: 0.5,
        divides: true,
        unrounded: 0.1,
        cycle: Seconds(0.001),
        least_cycles: 4.0,
        overlaps: true,
    })
}

/// Corners on arcs, in the plainest way.
pub(crate) fn plainly_rounded() -> Corners {
    Corners::Rounded(Rounding {
        default_tolerance: Some(Mm(0.05)),
        part_of_length: 0.25,
        stretched: false,
        curve_shares: [0.0; 2],
        sharpest_between_arcs: std::f64::consts::PI,
        across: 1.0,
        along: 1.0,
        divides: false,
        unrounded: 0.1,
        cycle: Seconds(0.001),
        least_cycles: 0.0,
        overlaps: false,
    })
}

/// Corners at a change of speed of 500 units a minute.
pub(crate) fn slowed() -> Corners {
    Corners::Slowed(Slowing { change: Point::from_element(500.0 / 60.0) })
}

/// 200 units a second on every axis.
pub(crate) fn machine(corners: Corners, acceleration: f64) -> Machine {
    Machine {
        limits: Limits::new([200.0; 9], [acceleration; 9], None).unwrap(),
        control: Control {
            corners,
            rapids: Rapids::Joined,
            look_ahead: 50,
            block_time: Seconds::ZERO,
            even_below: Seconds::ZERO,
            shortest: Seconds::ZERO,
            halt_time: Seconds::ZERO,
            taps: Taps::RestAtBottom,
            spindle_wait: SpindleWait::AtFeed,
        },
        spindle: SpindleLimits::default(),
        changer: Changer { change: Seconds(4.0), pocket: Seconds::ZERO, pockets: None, turns_ahead: false },
        rapid_part: 1.0,
    }
}

/// The way to a point at a speed, units a second.
pub(crate) fn line(from: Point, to: Point, speed: f64) -> Move<usize> {
    let way = to - from;
    let length = [0, 6, 3].into_iter().map(|at| way.fixed_rows::<3>(at).norm()).find(|l| *l > 0.0);
    Move { drive: Drive::Feed, from, to, arc: None, asked: Seconds(length.unwrap_or(0.0) / speed), tag: 0 }
}

/// The same as fast as the axes go.
pub(crate) fn rapid(from: Point, to: Point) -> Move<usize> {
    Move { drive: Drive::Rapid, asked: Seconds::ZERO, ..line(from, to, 1.0) }
}

/// An arc in XY by centre and angle, at a speed.
pub(crate) fn arc(from: Point, centre: (f64, f64), sweep: f64, rise: f64, speed: f64) -> Move<usize> {
    let (dx, dy) = (from[0] - centre.0, from[1] - centre.1);
    let (sin, cos) = sweep.sin_cos();
    let mut to = from;
    to[0] = centre.0 + dx * cos - dy * sin;
    to[1] = centre.1 + dx * sin + dy * cos;
    to[2] += rise;
    let corner = |point: &Point| [Mm(point[0]), Mm(point[1]), Mm(point[2])];
    let arc = Arc::from_parts(Plane::Xy, corner(&from), corner(&to), (Mm(centre.0), Mm(centre.1)), sweep);
    Move { drive: Drive::Feed, from, to, arc: Some(arc), asked: Seconds(arc.length().0 / speed), tag: 0 }
}

/// A point of X, Y and Z.
pub(crate) fn at(x: f64, y: f64, z: f64) -> Point {
    let mut point = Point::zeros();
    (point[0], point[1], point[2]) = (x, y, z);
    point
}

/// With a tolerance.
pub(crate) fn within(tolerance: f64) -> Meeting {
    Meeting::Rounded { tolerance: (tolerance > 0.0).then_some(Mm(tolerance)), merge: Mm::ZERO }
}

/// All spans of a run.
pub(crate) fn spans(machine: &Machine, items: &[Item<usize>]) -> Vec<Span<usize>> {
    let mut spans = Vec::new();
    let mut planner = Planner::new(*machine);
    for item in items {
        planner.push(*item, &mut |span| spans.push(*span));
    }
    planner.finish(&mut |span| spans.push(*span));
    spans
}

/// Time of a run.
pub(crate) fn seconds(machine: &Machine, items: &[Item<usize>]) -> f64 {
    shares(machine, items).total().0
}

/// Shares of a run.
pub(crate) fn shares(machine: &Machine, items: &[Item<usize>]) -> Shares {
    spans(machine, items).iter().fold(Shares::default(), |sum, span| sum + span.shares)
}

/// Moves after a mode.
pub(crate) fn items(meeting: Meeting, moves: &[Move<usize>]) -> Vec<Item<usize>> {
    std::iter::once(Item::Meeting(meeting)).chain(moves.iter().map(|item| Item::Move(*item))).collect()
}
