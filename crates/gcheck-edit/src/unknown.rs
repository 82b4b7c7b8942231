//! What a proof takes for what is unknown of the machine.
//!
//! Knows: that a path is compared only where it is known, and that a change may not rest on how things happen to be. Must not
//! know: tool tables, how paths are compared.

use std::collections::BTreeSet;

use gcheck_engine::{Assumption, Axis, Machine, Position, Tool, WorkOffset};
use gcheck_geometry::Mm;

use crate::rigid::LINEAR;

/// The radius that an unknown cutter is taken to have: so small that it fits into every corner, and so large that the side of
/// the path that it is on makes a difference.
pub const ASSUMED_RADIUS: Mm = Mm(0.01);

/// Gives cutters, whose size a run did not know, a small one. The answer are their numbers.
pub fn assume_cutters(machine: &mut Machine, assumptions: &BTreeSet<Assumption>) -> Vec<u32> {
    let mut numbers = Vec::new();
    for assumption in assumptions {
        let Assumption::ToolRadius(number) = assumption else { continue };
        let tool = tool(machine, *number);
        tool.diameter = Mm(2.0 * ASSUMED_RADIUS.0);
        tool.corner_radius = ASSUMED_RADIUS;
        numbers.push(*number);
    }
    numbers
}

/// Puts the axes, the work offsets and the lengths of tools, which a run did not know, somewhere, so that both paths are known
/// all the way. A change is planned without these numbers: one that rests on how things are at the start, such as the first
/// absolute word written as an increment, has another path from elsewhere. The answer is whether anything was unknown.
pub fn assume_places(machine: &mut Machine, assumptions: &BTreeSet<Assumption>) -> bool {
    let mut assumes = false;
    for assumption in assumptions {
        assumes |= matches!(
            assumption,
            Assumption::StartPosition | Assumption::WorkOffset(_) | Assumption::ToolLength(_)
        );
        match assumption {
            Assumption::StartPosition => machine.start = Some(somewhere(0)),
            Assumption::WorkOffset(number) => {
                let offset = machine.offsets.entry(*number).or_insert(WorkOffset::UNTOLD);
                offset.origin = filled(offset.origin, somewhere(u32::from(*number)));
            }
            Assumption::ToolLength(number) => {
                let tool = tool(machine, *number);
                let mut length = Position::ZERO;
                length.set(Axis::Z, somewhere(*number).raw(Axis::Z));
                tool.offset = filled(tool.offset, length);
            }
            _ => {}
        }
    }
    assumes
}

fn tool(machine: &mut Machine, number: u32) -> &mut Tool {
    machine.tools.entry(number).or_insert(Tool {
        pocket: number,
        offset: Position::UNKNOWN,
        diameter: Mm::UNKNOWN,
        corner_radius: Mm::UNKNOWN,
        angles: [0.0; 2],
        orientation: 0,
    })
}

/// A point that no program names. Where other axes are stays unknown: a path in X, Y and Z does not depend on it.
fn somewhere(number: u32) -> Position {
    let mut point = Position::UNKNOWN;
    let mut coordinate = 1.734_1 + 0.083_7 * f64::from(number % 1_000);
    for axis in LINEAR {
        point.set(axis, coordinate);
        coordinate += 0.619_3;
    }
    point
}

/// The point with the coordinates of another one where it has none.
fn filled(mut point: Position, other: Position) -> Position {
    for axis in Axis::ALL {
        if point.raw(axis).is_nan() {
            point.set(axis, other.raw(axis));
        }
    }
    point
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use gcheck_engine::{Assumption, Axis, Machine, Position, WorkOffset};

    use super::assume_places;

    #[test]
    fn what_was_told_stays() {
        let mut machine = Machine::default();
        let mut told = Position::UNKNOWN;
        told.set(Axis::X, 100.0);
        machine.offsets.insert(1, WorkOffset { origin: told, rotation: 0.0 });
        let unknown = [Assumption::StartPosition, Assumption::WorkOffset(1), Assumption::ToolLength(7)];
        assert!(assume_places(&mut machine, &BTreeSet::from(unknown)));
        let offset = machine.offsets.get(&1).unwrap();
        assert!((offset.origin.raw(Axis::X) - 100.0).abs() < 1e-12);
        assert!(offset.origin.raw(Axis::Y).is_finite());
        assert!(machine.start.is_some_and(|start| start.raw(Axis::Z).is_finite()));
        let length = machine.tools.get(&7).unwrap().offset;
        assert!(length.raw(Axis::Z) > 0.0 && length.raw(Axis::X).abs() < 1e-12);
    }
}
