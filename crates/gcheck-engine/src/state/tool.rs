//! The tool: which one is in the spindle, which is called for, the offsets that count for it.
//!
//! Knows: numbers and the data of the loaded tool. Must not know: the tool table's other entries, codes.

use super::tables::{Tables, ToolData};
use crate::lattice::{Perhaps, lattice};
use crate::position::Position;
use crate::tracked::{Tracked, part};
use crate::value::Domain;

part! {
    /// The tool and its offsets.
    #[derive(Debug, Clone)]
    pub(crate) struct ToolState<D: Domain> {
        /// In the spindle: vacant none known to be, 0 none.
        pub(crate) number: Tracked<D::Value>,
        /// Called for.
        pub(crate) selected: Tracked<D::Value>,
        /// What was loaded last.
        pub(crate) loaded: Tracked<Loaded>,
        /// Offsets in effect by axis.
        pub(crate) length: Tracked<Position>,
        /// Number of the length offset.
        pub(crate) h: Tracked<D::Value>,
        /// Number of the cutter compensation offset.
        pub(crate) d: Tracked<D::Value>,
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
        // Observed: the first line of the table is that of the spindle.
        let entry = tables.first_tool().map_or(Perhaps::No, Perhaps::Yes);
        Self {
            number: Tracked::new(number.clone()),
            selected: Tracked::new(number),
            loaded: Tracked::new(Loaded { data, entry }),
            length: Tracked::new(Position::ZERO),
            h: Tracked::new(D::number(0.0)),
            d: Tracked::new(D::number(0.0)),
        }
    }

    /// Any tool may be loaded, with any offsets.
    pub(crate) fn forget(&mut self) {
        let Self { number, selected, loaded, length, h, d } = self;
        for value in [number, selected, h, d] {
            value.put(D::unknown());
        }
        loaded.put(Loaded { data: ToolData::UNKNOWN, entry: Perhaps::Unknown });
        length.put(Position::UNKNOWN);
    }

    /// The same in another domain.
    pub(crate) fn map<E: Domain>(&self, change: &impl Fn(&D::Value) -> E::Value) -> ToolState<E> {
        let Self { number, selected, loaded, length, h, d } = self;
        ToolState {
            number: number.map(change),
            selected: selected.map(change),
            loaded: loaded.clone(),
            length: length.clone(),
            h: h.map(change),
            d: d.map(change),
        }
    }
}
