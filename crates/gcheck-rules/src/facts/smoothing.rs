//! The tolerance of smoothing (`G187 E`), with the block that gave it.
//!
//! Knows: the events that give and end it. Must not know: any rule, which tolerance is large.

use gcheck_engine::{At, Event, Smoothing};

use crate::PathCx;
use crate::remembers;

/// Where the tolerance of smoothing in effect comes from. It has to see every change.
#[derive(Debug, Default, Clone, PartialEq)]
pub(crate) struct SmoothingTolerance {
    /// The last block that gave a tolerance, or gave it up.
    set: Option<At>,
}

remembers!(SmoothingTolerance: set);

impl SmoothingTolerance {
    /// To be called with each change.
    pub(crate) fn changed(&mut self, cx: &PathCx<'_>, event: &Event) {
        match event {
            // A level alone keeps the tolerance.
            Event::Smoothing(Smoothing { level: Some(_), tolerance: None }) => {}
            Event::Smoothing(_) => self.set = Some(cx.origin().at),
            Event::End => self.set = None,
            _ => {}
        }
    }

    /// The tolerance in effect, millimetres, NaN unknown, with the block that gave it; `None` where the program gives none.
    pub(crate) fn in_effect(&self, cx: &PathCx<'_>) -> Option<(At, f64)> {
        let (_, tolerance) = cx.state().smoothing();
        self.set.zip(tolerance)
    }
}
