//! Passes of a thread that a program cuts one by one.
//!
//! Knows: where the last pass ran, and with which lead. Must not know: any rule.

use gcheck_controls::Effect;
use gcheck_engine::{At, Axis, Event, Travel, TravelKind};

use crate::{PathCx, remembers};

/// Does the code cut one pass of a thread?
pub(crate) fn cuts_pass(effect: Effect) -> bool {
    matches!(effect, Effect::ThreadingPass | Effect::Thread)
}

/// A pass of a thread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pass {
    /// Where it begins and ends along the thread: millimetres.
    pub(crate) z: [f64; 2],
    /// The radii at which it begins and ends: millimetres.
    pub(crate) x: [f64; 2],
    /// Millimetres a turn.
    pub(crate) lead: f64,
    pub(crate) at: At,
}

remembers!(Pass: at);

/// Places that are nearer than this are one: millimetres.
const SAME: f64 = 0.01;

impl Pass {
    /// Does the pass run over the same length as another one, whatever its depth? On a face the length is along X.
    pub(crate) fn is_along(&self, other: &Self) -> bool {
        let is_one =
            |one: [f64; 2], other: [f64; 2]| one.into_iter().zip(other).all(|(a, b)| (a - b).abs() < SAME);
        let is_level = |[from, to]: [f64; 2]| (from - to).abs() < SAME;
        match (is_level(self.z), is_level(other.z)) {
            (false, false) => is_one(self.z, other.z),
            // A step that is shorter is a piece of a longer way.
            (true, true) => !is_level(self.x) && is_one(self.x, other.x),
            _ => false,
        }
    }
}

/// The last pass of the tool in these coordinates.
#[derive(Debug, Default, Clone, PartialEq)]
pub(crate) struct ThreadPasses {
    /// Millimetres a turn, by which the axes are tied to the spindle.
    lead: Option<f64>,
    last: Option<Pass>,
}

remembers!(ThreadPasses: last);

impl ThreadPasses {
    /// Takes note of an event that is not a move.
    pub(crate) fn see(&mut self, event: &Event) {
        match event {
            Event::SpindleSync { lead, .. } => self.lead = lead.map(|lead| lead.0.abs()),
            // Another tool may cut another thread, and other coordinates are other places.
            Event::ToolChange(_) | Event::WorkOffset { .. } | Event::Shift(_) => self.last = None,
            _ => {}
        }
    }

    /// The pass that this move cuts, with the one before it over the same length.
    pub(crate) fn pass(&mut self, cx: &PathCx<'_>, event: &Event) -> Option<(Pass, Pass)> {
        let Event::Travel(travel) = event else { return None };
        if travel.kind != TravelKind::Thread || !cx.is_on_every_path() {
            return None;
        }
        let lead = self.lead.filter(|lead| *lead > 0.0)?;
        let pass = Pass { z: ends(travel, Axis::Z), x: ends(travel, Axis::X), lead, at: cx.origin().at };
        let before = self.last.replace(pass)?;
        (before.is_along(&pass) && before.at != pass.at).then_some((before, pass))
    }
}

fn ends(travel: &Travel, axis: Axis) -> [f64; 2] {
    [travel.from.raw(axis), travel.programmed.raw(axis)]
}
