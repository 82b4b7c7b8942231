//! Which mode of a role is active at a block: before it, while it moves, at the end of the program.
//!
//! Knows: what the state and the codes of the block say together. Must not know: any rule, which modes matter.

use crate::PathCx;
use crate::{Finding, RuleMeta};
use gcheck_controls::{Code, CodeIx, CodeNumber, Effect};
use gcheck_engine::{Fact, Role};

use crate::facts::boundary::{Boundary, boundary_range};

/// A mode that a block before this one switched on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ActiveMode {
    /// On every path that comes here.
    Certain(CodeIx),
    /// On some path that comes here.
    Possible(CodeIx),
}

/// The mode of a role while a block moves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum ModeInBlock {
    /// The block itself says it.
    Written(CodeIx),
    /// It was in effect before.
    Before(CodeIx),
    /// It may be any of these; empty when nothing is known.
    Several(Vec<CodeIx>),
}

/// A mode that is on before this block, if the block itself does not set it.
pub(crate) fn left_on(cx: &PathCx<'_>, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<ActiveMode> {
    if cx.code_of_role(role).is_some() { None } else { on_before(cx, role, is_on) }
}

/// A mode that is on before this block, whatever the block says.
fn on_before(cx: &PathCx<'_>, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<ActiveMode> {
    let mode = cx.state().mode(role);
    let on = |code: &CodeIx| code.is_some() && is_on(cx.model.effect(*code));
    match mode.only() {
        Some(code) => on(&code).then_some(ActiveMode::Certain(code)),
        None => mode.alternatives().iter().copied().find(on).map(ActiveMode::Possible),
    }
}

/// The mode that is on while this block moves: by its own code, or by one before it.
pub(crate) fn in_effect(cx: &PathCx<'_>, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<ActiveMode> {
    if let Some(code) = cx.code_of_role(role) {
        return is_on(cx.model.effect(code)).then_some(ActiveMode::Certain(code));
    }
    let cancels_length = || cx.known_number('H') == Some(0.0);
    if role == Role::Length && cancels_length() {
        return None;
    }
    on_before(cx, role, is_on)
}

/// The mode of a role while the block moves: modes act before the move, wherever they are in the block.
pub(crate) fn mode_in_block(cx: &PathCx<'_>, role: Role) -> ModeInBlock {
    if let Some(code) = cx.code_of_role(role) {
        return ModeInBlock::Written(code);
    }
    let mode = cx.state().mode(role);
    match mode.only() {
        Some(code) => ModeInBlock::Before(code),
        None => ModeInBlock::Several(mode.alternatives().to_vec()),
    }
}

/// Adds where a mode was switched on, unless the block itself did.
pub(crate) fn resting_on_mode(cx: &PathCx<'_>, finding: Finding, role: Role) -> Finding {
    if cx.code_of_role(role).is_some() {
        return finding;
    }
    match cx.code_name(role) {
        Some(name) => cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")),
        None => finding,
    }
}

/// A finding about a mode that the program leaves on for the next one, if its end does not reset it.
pub(crate) fn left_at_end(
    cx: &PathCx<'_>,
    meta: &'static RuleMeta,
    role: Role,
    is_on: impl Fn(Effect) -> bool,
    what: &str,
) -> Option<Finding> {
    if cx.end_resets(role) {
        return None;
    }
    let Some(ActiveMode::Certain(code)) = left_on(cx, role, is_on) else { return None };
    let fact = Fact::Mode(role);
    // A mode as it was at the start was not switched on by the program.
    cx.definitions().set_by(fact)?;
    let name = cx.name_of(code);
    let end = Boundary::ProgramEnd;
    let message = format!("{what} is still on {} (`{name}`)", end.words());
    let finding = cx.finding(meta, boundary_range(cx, end), message);
    let finding = finding.label("what runs next begins with it");
    Some(cx.resting_on(finding, fact, &format!("`{name}`")))
}

/// Does the block move the same way in absolute and incremental mode, or by words of its own?
pub(crate) fn ignores_distance_mode(cx: &PathCx<'_>) -> bool {
    cx.has_effect(|effect| effect.moves_by_machine_places() || effect == Effect::ToolChange)
}

/// Do the control's data say that a code does not allow another one while it is active?
pub(crate) fn forbids(code: Code<'_>, other: Code<'_>) -> bool {
    code.entry().forbids.iter().any(|item| match item.strip_prefix('@') {
        Some(group) => other.group().id == group,
        None => CodeNumber::parse(item) == Some(other.number()),
    })
}
