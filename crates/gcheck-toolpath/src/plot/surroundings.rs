//! What is around a path: how wide tools are, how far the machine goes.
//!
//! Knows: what a machine's description tells. Must not know: points, where zeros are, what is drawn.

use std::collections::BTreeMap;

use gcheck_engine::{Axis, Machine};
use gcheck_geometry::Mm;

use crate::placing::WorkCoordinates;

/// What is told of a machine.
#[derive(Debug, Clone, Default)]
pub(super) struct Surroundings {
    diameters: BTreeMap<u32, Mm>,
    /// Lowest and highest machine coordinates of X and Y, millimetres.
    travel: [Option<(f64, f64)>; 2],
}

impl Surroundings {
    pub(super) fn of(machine: &Machine) -> Self {
        let diameters = machine.tools.iter().map(|(number, tool)| (*number, tool.diameter));
        Self {
            diameters: diameters.filter(|(_, diameter)| diameter.0 > 0.0).collect(),
            travel: [Axis::X, Axis::Y].map(|axis| machine.travel.get(&axis).copied()),
        }
    }

    /// How wide a tool is, where that is told.
    pub(super) fn diameter(&self, tool: u32) -> Option<Mm> {
        self.diameters.get(&tool).copied()
    }

    /// How far X and Y go in the coordinates of a system. Z is left out: how far a tip goes depends on the length of the tool.
    pub(super) fn travel_in(&self, work: &WorkCoordinates) -> [Option<[f64; 2]>; 2] {
        let mut within = [None, None];
        for ((slot, travel), axis) in within.iter_mut().zip(self.travel).zip([Axis::X, Axis::Y]) {
            let origin = work.origin.raw(axis);
            *slot = travel.filter(|_| !origin.is_nan()).map(|(low, high)| [low - origin, high - origin]);
        }
        within
    }
}
