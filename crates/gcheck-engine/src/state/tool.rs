//! The tool: which one is in the spindle, which is called for, the offsets that count for it.
//!
//! Knows: numbers and the data of the loaded tool. Must not know: the tool table's other entries, codes.

use super::tables::{Tables, ToolData};
use crate::eval::value::Domain;
use crate::lattice::{Lattice, Perhaps, lattice};
use crate::position::Position;

lattice! {
    /// The tool and its offsets.
    #[derive(Debug, Clone)]
    pub(crate) struct ToolState<D: Domain> {
        /// In the spindle: vacant none known to be, 0 none.
        pub(crate) number: D::Value,
        /// Called for.
        pub(crate) selected: D::Value,
        /// What was loaded last.
        pub(crate) loaded: Loaded,
        /// Offsets in effect by axis.
        pub(crate) length: Position,
        /// Number of the length offset.
        pub(crate) h: D::Value,
        /// Number of the cutter compensation offset.
        pub(crate) d: D::Value,
    }
}

lattice! {
    /// The tool as it was loaded: what compensation by "the tool in the spindle" reads.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Loaded {
        /// Its data.
        pub(crate) data: ToolData,
        /// The entry of the table that they come from.
        pub(crate) entry: Perhaps<u32>,
    }
}

impl<D: Domain> ToolState<D> {
    /// Before a program. A control that was just started has no tool in the spindle; else nobody knows which.
    pub(crate) fn at_start(fresh: bool, tables: &Tables) -> Self {
        let number = if fresh { D::number(0.0) } else { D::unknown() };
        let data = if fresh { ToolData::NOTHING } else { ToolData::UNKNOWN };
        // Observed: the first line of the table is that of the spindle. Of a table told in part, another line may be the first.
        let entry = match tables.first_tool() {
            _ if !tables.is_complete() => Perhaps::Unknown,
            first => first.map_or(Perhaps::No, Perhaps::Yes),
        };
        Self {
            number: number.clone(),
            selected: number,
            loaded: Loaded { data, entry },
            length: Position::ZERO,
            h: D::number(0.0),
            d: D::number(0.0),
        }
    }

    /// Any tool may be loaded, with any offsets.
    pub(crate) fn forget(&mut self) {
        let Self { number, selected, loaded, length, h, d } = self;
        for value in [number, selected, h, d] {
            *value = D::unknown();
        }
        *loaded = Loaded { data: ToolData::UNKNOWN, entry: Perhaps::Unknown };
        *length = Position::UNKNOWN;
    }

    /// Takes back what [`Self::forget`] took away, as far as it is not as at the start. Where a tool is called and not in the
    /// spindle, the program may be there to put it in.
    pub(super) fn keep_what_was_set(&mut self, before: &Self, start: &Self) {
        if !before.selected.same(&start.selected) && !before.selected.same(&before.number) {
            return;
        }
        if !before.selected.same(&start.selected) {
            self.selected = before.selected.clone();
        }
        if !before.number.same(&start.number) {
            self.number = before.number.clone();
            self.loaded = before.loaded;
        }
        if !before.h.same(&start.h) {
            self.h = before.h.clone();
            self.length = before.length;
        }
        if !before.d.same(&start.d) {
            self.d = before.d.clone();
        }
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> ToolState<E> {
        let Self { number, selected, loaded, length, h, d } = self;
        ToolState {
            number: change(number),
            selected: change(selected),
            loaded: *loaded,
            length: *length,
            h: change(h),
            d: change(d),
        }
    }
}
