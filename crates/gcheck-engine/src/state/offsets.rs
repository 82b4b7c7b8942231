//! What is between programmed and machine coordinates: work offset, shifts, the control's tables.
//!
//! Knows: the offsets in effect and those that a program may choose. Must not know: the codes that change them, the tool.

use std::rc::Rc;

use super::tables::Tables;
use crate::eval::value::Truth;
use crate::lattice::{Flat, lattice};
use crate::machine::WorkOffset;
use crate::position::{Axis, Position};

lattice! {
    /// Offsets in effect, and the tables that they come from.
    #[derive(Debug, Clone)]
    pub(crate) struct Offsets {
        /// Work offsets, reference points and tools: shared until written.
        pub(crate) tables: Rc<Tables>,
        /// Number of the active work coordinate system, 1 the first.
        pub(crate) work: Flat<u16>,
        /// The active work coordinate system as it came into effect: a table written later counts when it is chosen again.
        pub(crate) in_effect: WorkOffset,
        /// `G92`; also `G52` where they are one.
        pub(crate) shift: Position,
        /// The shift counts (`G92.2` suspends it).
        pub(crate) shift_on: Truth,
        /// `G52` where it is apart.
        pub(crate) local: Position,
    }
}

impl Offsets {
    /// No shift, with the system that is active and what is known of it.
    pub(crate) fn unshifted(tables: Tables, work: Option<u16>) -> Self {
        let in_effect = work.map_or(WorkOffset::UNTOLD, |number| tables.offset(number));
        Self {
            tables: Rc::new(tables),
            work: work.into(),
            in_effect,
            shift: Position::ZERO,
            shift_on: Truth::True,
            local: Position::ZERO,
        }
    }

    /// The shift of `G92` as it counts.
    pub(crate) fn shift_in_effect(&self) -> Position {
        match self.shift_on {
            Truth::True => self.shift,
            Truth::False => Position::ZERO,
            // On the axes that it would move, nobody knows.
            Truth::Unknown => {
                let mut shift = self.shift;
                for axis in Axis::ALL {
                    if shift.raw(axis) != 0.0 {
                        shift.set(axis, f64::NAN);
                    }
                }
                shift
            }
        }
    }

    /// Any offset may be in effect, and written. What was not turned still is not.
    pub(crate) fn forget(&mut self) {
        self.tables_mut().forget_offsets(false);
        let Self { tables: _, work, in_effect, shift, shift_on, local } = self;
        *work = Flat::Unknown;
        in_effect.origin = Position::UNKNOWN;
        if in_effect.rotation != 0.0 {
            in_effect.rotation = f64::NAN;
        }
        *shift = Position::UNKNOWN;
        *shift_on = Truth::True;
        *local = Position::UNKNOWN;
    }

    /// Writes to the tables.
    pub(crate) fn tables_mut(&mut self) -> &mut Tables {
        Rc::make_mut(&mut self.tables)
    }
}
