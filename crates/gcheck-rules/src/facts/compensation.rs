//! Cutter compensation: whether it is on, and where it begins.
//!
//! Knows: its effects, the plane in which it acts. Must not know: any rule, how the path is offset.

use gcheck_controls::{Code, CodeIx, Effect, Letter};
use gcheck_engine::{Abstract, Axis, Domain, Event, Role};

use crate::facts::boundary::{Boundary, boundary_range};
use crate::{Finding, PathCx, RuleMeta};

/// Is the path offset by the size of the cutter?
pub(crate) fn is_on(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::CompensationLeft
            | Effect::CompensationRight
            | Effect::CompensationLeftByDiameter
            | Effect::CompensationRightByDiameter
            | Effect::CompensationVector
    )
}

/// Is compensation known to be on?
pub(crate) fn is_compensated(cx: &PathCx<'_>) -> bool {
    let on = cx.state().effect(Role::Compensation, cx.model);
    on.is_some_and(|effect| effect != Effect::CompensationOff)
}

/// The number of no offset, which ends compensation as its own code does on some controls.
const NO_OFFSET: &str = "D0";

/// Does the number of no offset end this compensation?
pub(crate) fn ends_by_number(code: Code<'_>) -> bool {
    code.entry().cancelled_by.iter().any(|item| item == NO_OFFSET)
}

/// Has the number of no offset ended the compensation whose code is in effect?
pub(crate) fn is_ended_by_number(cx: &PathCx<'_>, mode: CodeIx) -> bool {
    cx.code_of(mode).is_some_and(ends_by_number) && Abstract::known(cx.state().d()) == Some(0.0)
}

/// Is the cutter left of the path? `None` while compensation is off, or not known, or along vectors.
pub(crate) fn is_left(cx: &PathCx<'_>) -> Option<bool> {
    match cx.state().effect(Role::Compensation, cx.model)? {
        Effect::CompensationLeft | Effect::CompensationLeftByDiameter => Some(true),
        Effect::CompensationRight | Effect::CompensationRightByDiameter => Some(false),
        _ => None,
    }
}

/// A finding about compensation that is, or may be, still on at a place.
pub(crate) fn left_on_finding(
    cx: &PathCx<'_>,
    rule: &'static RuleMeta,
    place: Boundary,
    message: String,
) -> Finding {
    let cancel = cx.name_of_effect(Effect::CompensationOff).unwrap_or_default();
    cx.finding(rule, boundary_range(cx, place), message)
        .label(match place {
            Boundary::ToolChange => "the next tool begins with it",
            Boundary::ProgramEnd => "the program ends with it",
        })
        .help(format!("leave the contour on a straight move with `{cancel}` before the tool goes away"))
}

/// Does the block switch compensation on that was off before it?
pub(crate) fn begins(cx: &PathCx<'_>) -> bool {
    let was_on = cx.state().effect(Role::Compensation, cx.model).is_none_or(is_on);
    !was_on && cx.has_effect(is_on)
}

/// Does the move leave the coordinates in the compensated plane as they are?
pub(crate) fn stays_in_plane(cx: &PathCx<'_>, event: &Event) -> bool {
    if !matches!(event, Event::Travel(_)) {
        return false;
    }
    let Some(plane) = cx.state().plane(cx.model) else { return false };
    let (first, second, _) = plane.axes();
    // By its words: under compensation by a tool of unknown size the path itself is not known.
    let in_plane = [first, second].into_iter().filter_map(|index| Axis::ALL.get(index)).any(|axis| {
        let names = |letter: Letter| cx.origin().letters.contains(letter);
        let increment =
            cx.model.semantics().increments.iter().find(|(_, of)| Letter::parse(of) == Some(axis.letter()));
        names(axis.letter()) || increment.and_then(|(letter, _)| Letter::parse(letter)).is_some_and(names)
    });
    !in_plane
}

/// May cutter compensation be on, so that events come a block late?
pub(crate) fn may_be_on(cx: &PathCx<'_>) -> bool {
    !matches!(cx.state().effect(Role::Compensation, cx.model), Some(Effect::CompensationOff | Effect::None))
}

/// Does the code limit how far the control reads ahead, which it refuses under compensation?
pub(crate) fn limits_reading_ahead(cx: &PathCx<'_>, code: CodeIx) -> bool {
    let refuses = cx.model.semantics().compensation.refuses.as_ref();
    refuses.is_some_and(|refuses| refuses.read_ahead_limits.contains(&cx.name_of(code)))
}
