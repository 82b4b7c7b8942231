//! The rotary axes of a machine, from its configuration.
//!
//! Knows: keys that describe tilting heads and tables, and what they mean when one is left out. Must not know: programs, which
//! code compensates for a tilted tool.

use std::collections::BTreeMap;

use gcheck_engine::{Axis, Units};
use gcheck_geometry::{Arrangement, Direction, Kinematics, Mm, RotaryAxis};

use crate::config::{MachineTable, Placed, Rotary, rotary_axis};

/// What the layers of a configuration say, each over the one before.
#[derive(Debug, Default)]
pub(super) struct RotaryAxes {
    arrangement: Option<Arrangement>,
    order: Option<Vec<RotaryAxis>>,
    /// In the order in which `axes` names them.
    named: Vec<RotaryAxis>,
    sign: BTreeMap<usize, f64>,
    direction: BTreeMap<usize, Direction>,
    pivot_length: Option<Mm>,
    centre: [Option<Mm>; 3],
    offset: [Mm; 3],
    shorter_way: Vec<Axis>,
}

impl RotaryAxes {
    /// Puts a layer over the others; `units` are those of its lengths.
    pub(super) fn put(&mut self, table: &MachineTable, units: Units) {
        let axes = |names: &[Placed<String>]| -> Vec<RotaryAxis> {
            names.iter().filter_map(|name| rotary_axis(&name.value)).collect()
        };
        if let Some(names) = &table.axes {
            self.named = axes(&names.value);
        }
        if let Some(names) = &table.rotary_order {
            self.order = Some(axes(names));
        }
        if let Some(rotary) = &table.rotary {
            self.arrangement = Some(match rotary.value {
                Rotary::HeadHead => Arrangement::HeadHead,
                Rotary::HeadTable => Arrangement::HeadTable,
                Rotary::TableTable => Arrangement::TableTable,
            });
        }
        for (name, sign) in &table.rotary_sign {
            if let Some(axis) = rotary_axis(&name.value) {
                self.sign.insert(axis.index(), f64::from(sign.value));
            }
        }
        for (name, parts) in &table.rotary_direction {
            if let (Some(axis), Some(direction)) = (rotary_axis(&name.value), Direction::of(parts.value)) {
                self.direction.insert(axis.index(), direction);
            }
        }
        if let Some(length) = &table.pivot_length {
            self.pivot_length = Some(Mm(length.value * units.in_mm()));
        }
        let linear = |name: &str| ["X", "Y", "Z"].iter().position(|axis| name.eq_ignore_ascii_case(axis));
        for (name, value) in &table.rotary_centre {
            if let Some(slot) = linear(&name.value).and_then(|index| self.centre.get_mut(index)) {
                *slot = Some(Mm(value.value * units.in_mm()));
            }
        }
        for (name, value) in &table.rotary_offset {
            if let Some(slot) = linear(&name.value).and_then(|index| self.offset.get_mut(index)) {
                *slot = Mm(value.value * units.in_mm());
            }
        }
        if let Some(names) = &table.rotary_shorter_way {
            let of_machine = |rotary: RotaryAxis| match rotary {
                RotaryAxis::A => Axis::A,
                RotaryAxis::B => Axis::B,
                RotaryAxis::C => Axis::C,
            };
            self.shorter_way = axes(names).into_iter().map(of_machine).collect();
        }
    }

    /// A point of the table's rotary axis; of two, where they meet, or of the first.
    pub(super) fn centre(&self) -> Option<[Mm; 3]> {
        let [x, y, z] = self.centre;
        Some([x?, y?, z?])
    }

    /// Rotary axes that reach an angle the shorter way round.
    pub(super) fn shorter_way(&self) -> &[Axis] {
        &self.shorter_way
    }

    /// The machine's kinematics, if anything was said of them: a tilting head where only the rest is told.
    pub(super) fn kinematics(&self) -> Option<Kinematics> {
        let is_told = self.arrangement.is_some()
            || self.order.is_some()
            || !self.sign.is_empty()
            || !self.direction.is_empty()
            || self.pivot_length.is_some()
            || self.offset.iter().any(|part| part.0.abs() > 0.0);
        let order = self.order.as_deref().unwrap_or(&self.named);
        let order = match order {
            [first, second, ..] => [*first, *second],
            _ => [RotaryAxis::A, RotaryAxis::B],
        };
        is_told.then(|| Kinematics {
            arrangement: self.arrangement.unwrap_or(Arrangement::HeadHead),
            order,
            sign: order.map(|axis| self.sign.get(&axis.index()).copied().unwrap_or(1.0)),
            inclined: order.map(|axis| self.direction.get(&axis.index()).copied()),
            pivot_length: self.pivot_length,
            offset: self.offset,
        })
    }
}
