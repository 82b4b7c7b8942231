//! Work offsets: whether a cut is made in one that the program chose.
//!
//! Knows: what chooses a work offset, what a program with length offsets shows, what writes a zero. Must not know: any rule, values of offsets.

use std::ops::RangeInclusive;

use gcheck_controls::{Confidence, Effect, SystemValue};
use gcheck_engine::{Abstract, At, Domain, Fact, Role};
use gcheck_program::{BlockFlags, StatementKind, Target};

use crate::PathCx;

/// The first work offset, where this cut is in one that nothing chose.
pub(crate) fn unchosen_work_offset(cx: &PathCx<'_>) -> Option<String> {
    let first = cx.control().codes().find(|code| code.effect() == Effect::WorkOffset(1))?;
    let is_chosen = cx.definitions().set_by(Fact::Mode(Role::WorkOffset)).is_some()
        || cx.definitions().set_by(Fact::Shift).is_some()
        || cx.is_after_unknown_program();
    let is_in_machine_coordinates = cx.has_effect(|effect| effect == Effect::MachineCoordinates);
    let is_free = is_chosen || is_in_machine_coordinates || cx.model.semantics().tools.change_by_t;
    (!is_free).then(|| first.number().to_string())
}

/// The tool was changed in and has a length offset: the program is one for tables of offsets, and it `chooses_work_offset` no work offset
/// at all. Not so where each end of a program is known to bring the first one back.
pub(crate) fn never_chooses_work_offset(cx: &PathCx<'_>) -> bool {
    let semantics = cx.model.semantics();
    let comes_back = semantics.confidence == Confidence::Manual && cx.end_resets(Role::WorkOffset);
    let has_length = cx.state().effect(Role::Length, cx.model) == Some(Effect::LengthPlus)
        && Abstract::known(cx.state().h()).is_some_and(|offset| offset > 0.0);
    has_length
        && cx.definitions().set_by(Fact::Tool).is_some()
        && !comes_back
        && !cx.file_uses(chooses_work_offset)
}

/// Does a block write a zero by a variable (`#5223=…`)?
pub(crate) fn writes_zero_at(cx: &PathCx<'_>, at: At) -> bool {
    let Some(place) = cx.place_of(at).filter(|place| place.block().flags.contains(BlockFlags::STATEMENT))
    else {
        return false;
    };
    let writes = |kind: &StatementKind| match kind {
        StatementKind::Assign { target: Target::Variable(number), .. } => is_zero(cx, *number),
        _ => false,
    };
    place.table.statements(place.ix).any(|statement| writes(&statement.kind))
}

/// Does the file write a zero by a variable?
pub(crate) fn file_writes_zero(cx: &PathCx<'_>) -> bool {
    cx.file_index.assigned.iter().any(|(number, _)| is_zero(cx, *number))
}

/// Is the variable of the control's one of a zero: a work offset or a shift?
fn is_zero(cx: &PathCx<'_>, number: u32) -> bool {
    let holds = |value: SystemValue| {
        matches!(value, SystemValue::WorkOffset | SystemValue::Shift | SystemValue::LocalShift)
    };
    let variables = &cx.model.semantics().system_variables;
    OFFSETS.contains(&number)
        || variables.iter().any(|variable| holds(variable.holds) && variable.cell(number).is_some())
}

/// The variables of shifts and work offsets where a control's data tell nothing of them: which axis each is for, machines differ in.
const OFFSETS: RangeInclusive<u32> = 5201..=5340;

/// Does the code choose a work offset?
pub(crate) fn chooses_work_offset(effect: Effect) -> bool {
    matches!(effect, Effect::WorkOffset(_) | Effect::WorkOffsetByP(_))
}
