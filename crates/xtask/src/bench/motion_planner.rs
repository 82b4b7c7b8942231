//! The motion planner alone: a million moves, and how many it keeps.
//!
//! Knows: moves and a machine. Must not know: programs, what the figures are for.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use gcheck_geometry::{Mm, Seconds};
use gcheck_planner::{
    Changer, Control, Corners, Drive, Item, Limits, Machine, Meeting, Move, Planner, Point, Rapids, Rounding,
    SpindleLimits, SpindleWait, Taps,
};

use super::row::{Limit, Row};

const MOVES: u32 = 1_000_000;
const RUNS: usize = 3;
/// Moves that the control looks ahead.
const LOOK_AHEAD: u32 = 200;
/// What is kept beyond them: the arc at each corner, the last move, the one that comes.
const KEPT: u32 = 2 * LOOK_AHEAD + 2;

/// Measures.
pub(super) fn rows() -> anyhow::Result<Vec<Row>> {
    let machine = machine()?;
    let mut seconds = f64::INFINITY;
    let mut waiting = 0;
    for _ in 0..RUNS {
        let start = Instant::now();
        waiting = run(&machine);
        seconds = seconds.min(start.elapsed().as_secs_f64());
    }
    Ok(vec![
        Row {
            name: "planner, 1,000,000 moves".to_owned(),
            measured: Some(seconds),
            limit: Limit::AtMost(1.5),
            unit: "s",
        },
        Row {
            name: format!("planner, most moves kept at a look-ahead of {LOOK_AHEAD}"),
            measured: Some(f64::from(waiting)),
            limit: Limit::AtMost(f64::from(KEPT)),
            unit: "moves",
        },
    ])
}

/// Runs short moves along a wave on a surface, each with a corner; gives the most moves that waited at a time.
fn run(machine: &Machine) -> u32 {
    let mut planner = Planner::new(*machine);
    let mut done = 0;
    let mut waiting = 0;
    let rounded = Meeting::Rounded { tolerance: Some(Mm(0.01)), merge: Mm::ZERO };
    planner.push(Item::Meeting(rounded), &mut |_| {});
    let mut from = place(0);
    for index in 0..MOVES {
        let to = place(index + 1);
        let asked = Seconds((to - from).norm() / 50.0);
        let item = Move { drive: Drive::Feed, from, to, arc: None, asked, tag: index };
        planner.push(Item::Move(item), &mut |span| done += span.blocks);
        waiting = waiting.max(index + 1 - done);
        from = to;
    }
    planner.finish(&mut |span| {
        black_box(span);
    });
    waiting
}

fn place(index: u32) -> Point {
    let x = f64::from(index) * 0.3;
    let (sin, cos) = (x / 20.0 * TAU).sin_cos();
    Point::from([x, 4.0 * sin, cos, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// Of 200 mm/s and 1,000 mm/s², with the corners that take most to compute.
fn machine() -> anyhow::Result<Machine> {
    let rounding = Rounding {
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
    };
    Ok(Machine {
        limits: Limits::new([200.0; 9], [1_000.0; 9], Some([40_000.0; 9]))?,
        control: Control {
            corners: Corners::Rounded(rounding),
            rapids: Rapids::Joined,
            look_ahead: LOOK_AHEAD as usize,
            block_time: Seconds(0.000_5),
            even_below: Seconds::ZERO,
            shortest: Seconds::ZERO,
            halt_time: Seconds::ZERO,
            taps: Taps::RestAtBottom,
            spindle_wait: SpindleWait::AtFeed,
        },
        spindle: SpindleLimits::default(),
        changer: Changer { change: Seconds::ZERO, pocket: Seconds::ZERO, pockets: None, turns_ahead: false },
        rapid_part: 1.0,
    })
}
