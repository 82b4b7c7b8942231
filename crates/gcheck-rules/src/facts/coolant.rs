//! Which coolant is on, and whether the current tool has cut.
//!
//! Knows: what switches coolant, what counts as a cut. Must not know: any rule.

use crate::remembers;
use gcheck_engine::{Coolant, Event, TravelKind};

/// What is on, and whether the current tool has cut.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct CoolantWatch {
    /// Mist, flood, through the tool.
    on: [bool; 3],
    /// The tool has not cut yet.
    is_new: bool,
}

remembers!(CoolantWatch);

impl CoolantWatch {
    /// Is any on?
    pub(crate) fn is_on(&self) -> bool {
        self.on.contains(&true)
    }

    /// After anything that is not a move.
    pub(crate) fn changed(&mut self, event: &Event) {
        match event {
            Event::Coolant { kind, on } => {
                let [mist, flood, through] = &mut self.on;
                *match kind {
                    Coolant::Mist => mist,
                    Coolant::Flood => flood,
                    Coolant::Through => through,
                } = *on;
            }
            Event::ToolChange(_) => self.is_new = true,
            _ => {}
        }
    }

    /// Is this the first cut of a tool that was changed in? `is_cut` of the event; a thread is a cut too.
    pub(crate) fn is_first_cut(&mut self, event: &Event, is_cut: bool) -> bool {
        let is_thread = matches!(event, Event::Travel(travel) if travel.kind == TravelKind::Thread);
        let is_first = self.is_new && (is_cut || is_thread);
        self.is_new &= !is_first;
        is_first
    }
}
