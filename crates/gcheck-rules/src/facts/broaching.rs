//! Strokes of a tool that shapes or broaches: along Z again and again, a little deeper across each time.
//!
//! Knows: moves since the first stroke. Must not know: any rule, whether the spindle has to turn.

use gcheck_engine::{Axis, Event, Position, Travel, TravelKind};

use crate::remembers;

/// What the moves since the first stroke show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shows {
    /// Nothing yet.
    Nothing,
    /// The tool broaches.
    Broaching,
    /// It does something else.
    Other,
}

/// Strokes to one depth, each beside the one before.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Strokes {
    /// The end of the last one.
    last: Position,
    /// How often a stroke went a little further across, all in one direction.
    steps: u8,
    /// That direction: the sums of the steps in X and Y.
    way: [f64; 2],
}

remembers!(Strokes);

/// A step across is not longer than this: millimetres.
const STEP: f64 = 1.0;
/// The tool goes off the wall by less: millimetres.
const AWAY: f64 = 5.0;
/// Moves and depths that differ by less are one: millimetres.
const SLACK: f64 = 0.005;
/// As many steps show that the tool broaches.
const STEPS: u8 = 2;

impl Strokes {
    /// With a move, if it may be the first: straight down along Z at feed.
    pub(crate) fn begin(event: &Event) -> Option<Self> {
        let Event::Travel(travel) = event else { return None };
        is_stroke(travel).then_some(Self { last: travel.to, steps: 0, way: [0.0; 2] })
    }

    /// After another move.
    pub(crate) fn moved(&mut self, event: &Event) -> Shows {
        let Event::Travel(travel) = event else { return Shows::Other };
        if travel.kind == TravelKind::Rapid {
            return Shows::Nothing;
        }
        if !is_stroke(travel) {
            // The way out along Z, and the small ways off the wall and to it, may be at feed.
            return if is_out(travel) || is_step(travel) { Shows::Nothing } else { Shows::Other };
        }
        let last = std::mem::replace(&mut self.last, travel.to);
        let step = [Axis::X, Axis::Y].map(|axis| between(&last, &travel.to, axis));
        let is_same_angle =
            [Axis::A, Axis::B, Axis::C].into_iter().all(|axis| travel.to.get(axis) == last.get(axis));
        let is_as_deep = (travel.to.raw(Axis::Z) - last.raw(Axis::Z)).abs() < SLACK;
        let length = step[0].hypot(step[1]);
        let goes_on = step[0] * self.way[0] + step[1] * self.way[1] >= 0.0;
        // An unknown place is NaN, and shows nothing of the kind.
        let is_beside = is_same_angle && is_as_deep && length <= STEP && goes_on;
        if !is_beside {
            return Shows::Other;
        }
        if length > SLACK {
            self.steps += 1;
            self.way = [self.way[0] + step[0], self.way[1] + step[1]];
        }
        if self.steps >= STEPS { Shows::Broaching } else { Shows::Nothing }
    }
}

fn along(travel: &Travel, axis: Axis) -> f64 {
    between(&travel.from, &travel.to, axis)
}

/// From one place to another along an axis; zero for one that the program does not use.
fn between(from: &Position, to: &Position, axis: Axis) -> f64 {
    match (from.get(axis), to.get(axis)) {
        (None, None) => 0.0,
        _ => to.raw(axis) - from.raw(axis),
    }
}

fn across(travel: &Travel) -> f64 {
    along(travel, Axis::X).hypot(along(travel, Axis::Y))
}

fn is_fed(travel: &Travel) -> bool {
    travel.kind == TravelKind::Feed && !travel.expanded
}

/// Straight down along Z.
fn is_stroke(travel: &Travel) -> bool {
    is_fed(travel) && across(travel) < SLACK && along(travel, Axis::Z) < -SLACK
}

fn is_out(travel: &Travel) -> bool {
    is_fed(travel) && across(travel) < SLACK && along(travel, Axis::Z) > 0.0
}

/// Off the wall, or to it.
fn is_step(travel: &Travel) -> bool {
    is_fed(travel) && along(travel, Axis::Z).abs() < SLACK && across(travel) < AWAY
}
