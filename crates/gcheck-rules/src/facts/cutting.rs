//! Cutting: which moves cut, what starts the spindle or a live tool, what cuts a thread.
//!
//! Knows: effects of codes and kinds of moves. Must not know: any rule, where material is.

use gcheck_controls::{Effect, LetterSet};
use gcheck_engine::{Axis, Event, TravelKind};

use crate::PathCx;

/// Does the code tie the feed to the spindle's angle?
pub(crate) fn is_thread(effect: Effect) -> bool {
    effect.cuts_thread() || effect == Effect::RigidTap
}

/// A move with the tool in the work, as far as a program shows it.
pub(crate) fn is_cut(cx: &PathCx<'_>, event: &Event) -> bool {
    if cx.has_effect(|effect| matches!(effect, Effect::MachineCoordinates | Effect::Skip)) {
        return false;
    }
    match event {
        Event::Travel(travel) => {
            let is_along_z = !cx.origin().letters.intersects(LetterSet::of("XYABCUV"));
            // Up, or from an unknown height.
            let goes_down = travel.to.raw(Axis::Z) < travel.from.raw(Axis::Z);
            // A back bore cuts on its way up.
            let bores_up = travel.expanded
                && cx
                    .state()
                    .active_cycle(cx.model)
                    .is_some_and(|ix| cx.model.effect(ix) == Effect::CycleBackBore);
            let is_up = is_along_z && !goes_down && !bores_up;
            travel.kind == TravelKind::Feed && !is_up
        }
        Event::Arc(_) | Event::Curve(_) => true,
        _ => false,
    }
}

/// Does the code turn the spindle counter-clockwise?
pub(crate) fn turns_backwards(effect: Effect) -> bool {
    matches!(effect, Effect::SpindleCounterClockwise | Effect::SpindleCounterClockwiseWithCoolant)
}

/// Does the code start something that cuts?
pub(crate) fn starts_spindle(effect: Effect) -> bool {
    effect.starts_spindle() || effect == Effect::LiveToolOn
}
