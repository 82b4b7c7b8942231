//! Cutters of unknown size, and what they are taken to be for a proof.
//!
//! Knows: that a path beside the programmed one is compared only if the cutter has a size. Must not know: tool tables.

use std::collections::BTreeSet;

use gcheck_engine::{Assumption, Machine, Position, Tool};
use gcheck_geometry::Mm;

/// The radius that an unknown cutter is taken to have: so small that it fits into every corner, and so large that the side of
/// the path that it is on makes a difference.
pub const ASSUMED_RADIUS: Mm = Mm(0.01);

/// Gives cutters, whose size a run did not know, a small one. The answer are their numbers.
pub fn assume_cutters(machine: &mut Machine, assumptions: &BTreeSet<Assumption>) -> Vec<u32> {
    let mut numbers = Vec::new();
    for assumption in assumptions {
        let Assumption::ToolRadius(number) = assumption else { continue };
        let tool = machine.tools.entry(*number).or_insert(Tool {
            pocket: *number,
            offset: Position::UNKNOWN,
            diameter: Mm::UNKNOWN,
            corner_radius: Mm::UNKNOWN,
            angles: [0.0; 2],
            orientation: 0,
        });
        tool.diameter = Mm(2.0 * ASSUMED_RADIUS.0);
        tool.corner_radius = ASSUMED_RADIUS;
        numbers.push(*number);
    }
    numbers
}
