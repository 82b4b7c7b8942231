//! Where points lie that several work coordinate systems and shifts name: in the coordinates of the first one.
//!
//! Knows: shifts, offsets and rotations in effect. Must not know: which codes set them, what is made of the points.

use std::collections::BTreeMap;

use gcheck_engine::{Axis, Event, Machine, Model, Position};

/// A work coordinate system: its number and where it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkCoordinates {
    /// Its number, 1 the first; `None` unknown.
    pub number: Option<u16>,
    /// Its zero in machine coordinates; NaN unknown.
    pub origin: Position,
    /// Rotation about Z, degrees.
    pub rotation: f64,
}

impl WorkCoordinates {
    /// Nothing is known of them.
    pub const UNKNOWN: Self = Self { number: None, origin: Position::UNKNOWN, rotation: 0.0 };

    /// The one in effect at power-on, as far as the machine's offsets are told.
    pub fn at_power_on(model: &Model<'_>, machine: &Machine) -> Self {
        let number = model.work_at_power_on();
        let offset = number.and_then(|number| machine.offsets.get(&number));
        offset.map_or(Self { number, ..Self::UNKNOWN }, |offset| Self {
            number,
            origin: offset.origin,
            rotation: offset.rotation,
        })
    }
}

/// Follows offsets and shifts. Has to see every event of the run, in order.
#[derive(Debug, Clone)]
pub(crate) struct Placing {
    work: WorkCoordinates,
    shift: Position,
    /// The system in effect at the first move.
    first: Option<WorkCoordinates>,
    /// A point was placed though the distance of its system from the first one is unknown.
    overlaid: bool,
    /// The systems in which something moved, by number, with the place of their zero from the first one's; NaN unknown.
    used: BTreeMap<u16, [f64; 3]>,
    /// The last one of them.
    noted: Option<u16>,
}

impl Placing {
    pub(crate) fn new(work: WorkCoordinates) -> Self {
        Self { work, shift: Position::ZERO, first: None, overlaid: false, used: BTreeMap::new(), noted: None }
    }

    /// To be called after an event was looked at.
    pub(crate) fn after(&mut self, event: &Event) {
        match event {
            Event::WorkOffset { number, offset, rotation } => {
                self.work = WorkCoordinates { number: Some(*number), origin: *offset, rotation: *rotation };
            }
            Event::Rotation(rotation) => self.work.rotation = *rotation,
            Event::Shift(shift) => self.shift = *shift,
            _ => {}
        }
    }

    /// Are points only moved, not turned?
    pub(crate) fn is_upright(&self) -> bool {
        self.work.rotation.abs() <= 0.0
    }

    /// A move begins: the first one decides in which coordinates everything is.
    pub(crate) fn begin_move(&mut self) {
        let first = *self.first.get_or_insert(self.work);
        let apart = self.away(&first);
        self.overlaid |= self.work.number != first.number && apart.iter().any(|way| way.is_nan());
        if self.noted != self.work.number {
            self.noted = self.work.number;
            let is_first = self.work.number == first.number;
            let place = if is_first { [0.0; 3] } else { apart };
            self.used.extend(self.work.number.map(|number| (number, place)));
        }
    }

    /// The system in effect at the first move.
    pub(crate) const fn first(&self) -> Option<&WorkCoordinates> {
        self.first.as_ref()
    }

    /// The systems in which something moved and whose zero has a known place, in the order of their numbers.
    pub(crate) fn zeros(&self) -> Vec<(u16, [f64; 3])> {
        let known = self.used.iter().filter(|(_, place)| place.iter().all(|way| way.is_finite()));
        known.map(|(number, place)| (*number, *place)).collect()
    }

    /// A point in the coordinates of the first system. One whose distance from it is unknown is taken to be the first.
    pub(crate) fn placed(&self, point: &Position) -> Position {
        let first = self.first.unwrap_or(self.work);
        let mut placed = self.in_work(point);
        for (axis, way) in LINEAR.into_iter().zip(self.away(&first)) {
            if !way.is_nan() {
                placed.set(axis, placed.raw(axis) + way);
            }
        }
        placed
    }

    /// A point in its own work coordinate system without shifts and rotation; an unknown shift is taken to be none.
    pub(crate) fn in_work(&self, point: &Position) -> Position {
        let mut plain = *point;
        for axis in LINEAR {
            let shift = self.shift.raw(axis);
            if !shift.is_nan() {
                plain.set(axis, point.raw(axis) + shift);
            }
        }
        if !self.is_upright() {
            let (sin, cos) = self.work.rotation.to_radians().sin_cos();
            let (x, y) = (plain.raw(Axis::X), plain.raw(Axis::Y));
            plain.set(Axis::X, x * cos - y * sin);
            plain.set(Axis::Y, x * sin + y * cos);
        }
        plain
    }

    /// Was something placed whose place is not known?
    pub(crate) const fn has_overlaid(&self) -> bool {
        self.overlaid
    }

    fn away(&self, first: &WorkCoordinates) -> [f64; 3] {
        LINEAR.map(|axis| self.work.origin.raw(axis) - first.origin.raw(axis))
    }
}

const LINEAR: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];
