//! How deep the tool of a mill is in its own cut: where it was fed down from, and whether it has been lifted since.
//!
//! Knows: the moves of the tool since it came into the spindle. Must not know: any rule, where material is beside that.

use gcheck_controls::CodeIx;
use gcheck_engine::{At, Axis, Event, Fact, Position, Travel, TravelKind};

use crate::facts::cuts::{LEVEL, SURFACE};
use crate::{PathCx, SharedMemory, remembers};

/// What the tool did along Z since it came into the spindle. Levels in millimetres, work coordinates.
#[derive(Default, Clone, PartialEq)]
pub(crate) struct Depth {
    /// The block that put the tool in.
    tool: Option<At>,
    /// The level that the tool was last fed down from, after a move that does not cut.
    start: Option<f64>,
    /// The last cut, if the tool has not been lifted since.
    cut: Option<At>,
    /// The level that the last cut ended at.
    level: f64,
    /// The highest level at which the tool cut sideways.
    highest: Option<f64>,
}

remembers!(Depth: tool, cut);

impl SharedMemory for Depth {
    fn moved(&mut self, cx: &PathCx<'_>, event: &Event) {
        // A tool begins with a rapid move; nearly all others are cuts, of which there may be millions.
        if !matches!(event, Event::Travel(travel) if travel.kind == TravelKind::Feed) {
            let tool = cx.definitions().set_by(Fact::Tool);
            if self.tool != tool {
                *self = Self { tool, ..Self::default() };
            }
        }
        match event {
            // A canned cycle ends above its hole; what turns the part while it cuts has no level.
            Event::Travel(travel) if is_of_cycle(cx, travel) || turns(&travel.from, &travel.to) => {
                self.cut = None;
            }
            Event::Arc(arc) if turns(&arc.from, &arc.to) => self.cut = None,
            Event::Travel(travel) => match travel.kind {
                TravelKind::Feed => self.feed(cx, &travel.from, &travel.to),
                TravelKind::Rapid => self.rapid(&travel.from, &travel.to),
                TravelKind::Probe { .. } | TravelKind::Thread => self.cut = None,
            },
            Event::Arc(arc) => self.sideways(cx, arc.to.get(Axis::Z)),
            Event::Curve(curve) => self.sideways(cx, curve.to.get(Axis::Z)),
            _ => self.cut = None,
        }
    }
}

impl Depth {
    /// For [`PathRule::shares`](crate::PathRule::shares).
    pub(crate) fn shared() -> Box<dyn SharedMemory> {
        Box::new(Self::default())
    }

    /// The block of the tool's last cut, if the tool is at its level still.
    pub(crate) fn last_cut(&self, z: f64) -> Option<At> {
        self.cut.filter(|_| (z - self.level).abs() <= LEVEL)
    }

    /// The same, if the part is higher than this level for all that the program shows: the level is below the zero of the
    /// part, or the tool has cut at a higher one.
    pub(crate) fn last_cut_in_part(&self, z: f64) -> Option<At> {
        let is_below = z < SURFACE || self.highest.is_some_and(|highest| z < highest - LIFT);
        self.last_cut(z).filter(|_| is_below)
    }

    fn feed(&mut self, cx: &PathCx<'_>, from: &Position, to: &Position) {
        let (Some(z0), Some(z1)) = (from.get(Axis::Z), to.get(Axis::Z)) else {
            self.cut = None;
            return;
        };
        let stays = |axis: Axis| (from.raw(axis) - to.raw(axis)).abs() <= LEVEL;
        if !stays(Axis::X) || !stays(Axis::Y) {
            // On a slant up the tool leaves the cut.
            if z1 > z0 + LEVEL {
                self.cut = None;
            } else {
                self.sideways(cx, Some(z1));
            }
        } else if z1 < z0 - LEVEL {
            if self.cut.is_none() {
                self.start = Some(z0);
            }
            (self.cut, self.level) = (Some(cx.origin().at), z1);
        } else {
            self.lift(z1);
        }
    }

    fn sideways(&mut self, cx: &PathCx<'_>, z: Option<f64>) {
        self.cut = z.map(|_| cx.origin().at);
        if let Some(z) = z {
            self.level = z;
            // Before the tool was fed down, it goes beside the part or above it.
            if self.start.is_some() {
                self.highest = Some(self.highest.map_or(z, |highest| highest.max(z)));
            }
        }
    }

    /// A rapid move leaves the cut, unless it goes up within it.
    fn rapid(&mut self, from: &Position, to: &Position) {
        let stays = |axis: Axis| (from.raw(axis) - to.raw(axis)).abs() <= LEVEL;
        match to.get(Axis::Z) {
            Some(z) if stays(Axis::X) && stays(Axis::Y) => self.lift(z),
            _ => self.cut = None,
        }
    }

    /// Up to a level.
    fn lift(&mut self, z: f64) {
        let is_clear = z >= 0.0 || self.start.is_none_or(|start| z >= start - LEVEL);
        if is_clear {
            self.cut = None;
        } else {
            self.level = z;
        }
    }
}

/// Is it a move of a canned cycle that stays on?
fn is_of_cycle(cx: &PathCx<'_>, travel: &Travel) -> bool {
    travel.expanded && cx.state().active_cycle(cx.model).is_none_or(CodeIx::is_some)
}

/// Does a rotary axis turn?
fn turns(from: &Position, to: &Position) -> bool {
    let turns = |axis: Axis| from.raw(axis).to_bits() != to.raw(axis).to_bits();
    [Axis::A, Axis::B, Axis::C].into_iter().any(turns)
}

/// Levels that differ by more are of different cuts: millimetres.
const LIFT: f64 = 0.5;
