//! What a file shows of what it does and of how it is used: started, or called by programs that are not here.
//!
//! Knows: ends, conditions and variables of the main file's text. Must not know: any rule, values.

use std::rc::Rc;

use gcheck_controls::{Effect, Ends, SystemValue};
use gcheck_engine::{At, Model, Program, ProgramFile};
use gcheck_program::{BlockFlags, OKeyword, Op, Place, StatementKind, Survey};

use crate::Scene;

/// What the blocks of a program may do, whatever path is taken.
pub struct Uses<'a> {
    /// Control, machine, other programs.
    pub scene: Scene<'a>,
    /// What the main file holds, without regard to paths.
    pub survey: &'a Survey,
    effects: Vec<Effect>,
    /// Blocks that are not here, or whose codes are computed, may do anything.
    is_open: bool,
}

impl<'a> Uses<'a> {
    pub(crate) fn new(scene: Scene<'a>, survey: &'a Survey) -> Self {
        let control = scene.control();
        let codes = survey.codes.iter().map(|(number, _)| control.code_at(control.code_ix(*number)));
        let is_opaque = codes.clone().any(|code| code.is_none_or(gcheck_controls::Code::is_user));
        Self {
            scene,
            survey,
            effects: codes.flatten().map(gcheck_controls::Code::effect).collect(),
            is_open: is_opaque || survey.has_computed_codes || !survey.calls.is_empty(),
        }
    }

    /// May a block have a code with an effect that `is` says yes to?
    pub fn may(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.is_open || self.effects.iter().any(|effect| is(*effect))
    }
}

/// The first program of the file returns (`M99`) before it ends the job, if it does: other programs call it, and give it
/// its variables and modes.
pub(crate) fn is_called_from_elsewhere(survey: &Survey) -> bool {
    let behind = survey.programs.get(1).map_or(u32::MAX, |second| second.range.start);
    let first = survey.ends.iter().find(|end| end.range.start < behind && !end.conditional);
    let any = first.or_else(|| survey.ends.iter().find(|end| end.range.start < behind));
    any.is_some_and(|end| end.ends == Ends::Subprogram)
}

/// The blocks of the main file that have any of these flags.
pub(crate) fn blocks_with(
    program: &Program<'_>,
    scene: Scene<'_>,
    flags: BlockFlags,
) -> impl Iterator<Item = (At, Place)> {
    let file: Option<Rc<ProgramFile<'_>>> = program.file(0);
    let found: Vec<_> =
        file.map_or_else(Vec::new, |file| file.loaded.blocks_with(flags, scene.dialect).collect());
    found.into_iter().map(|(block, place)| (At { file: 0, block }, place))
}

/// Does the way through the main file depend on a condition?
pub(crate) fn has_conditions(program: &Program<'_>, scene: Scene<'_>) -> bool {
    blocks_with(program, scene, BlockFlags::STATEMENT).any(|(_, place)| {
        place.table.statements(place.ix).any(|statement| match &statement.kind {
            StatementKind::If { .. } | StatementKind::Guard { .. } => true,
            StatementKind::Do { condition, .. } => condition.is_some(),
            StatementKind::OWord { keyword, .. } => {
                matches!(keyword, OKeyword::If | OKeyword::ElseIf | OKeyword::While | OKeyword::Repeat)
            }
            _ => false,
        })
    })
}

/// Does the main file read what the control may have otherwise than we take it to be at the start: modes, the tool, offsets?
pub(crate) fn reads_start_state(program: &Program<'_>, model: &Model<'_>, scene: Scene<'_>) -> bool {
    let variables = &model.semantics().system_variables;
    let Some(file) = program.file(0) else { return false };
    let flags = BlockFlags::STATEMENT | BlockFlags::EXPRESSION;
    blocks_with(program, scene, flags).any(|(_, place)| {
        let text = file.loaded.chunk_text(place.chunk);
        expressions(&place).into_iter().any(|expr| {
            place.table.ops(place.table.expr(expr)).iter().any(|op| match op {
                Op::Variable(number) => variables.iter().any(|variable| {
                    let last = |first: u32| {
                        first
                            + variable.stride * variable.rows.saturating_sub(1)
                            + variable.count.saturating_sub(1)
                    };
                    variable.first.is_some_and(|first| (first..=last(first)).contains(number))
                        && is_taken_for_granted(variable.holds)
                }),
                Op::Named { start, end } => {
                    let name = text.get(*start as usize..*end as usize).unwrap_or_default();
                    variables.iter().any(|variable| {
                        variable.name.as_ref().is_some_and(|n| n.eq_ignore_ascii_case(name))
                            && is_taken_for_granted(variable.holds)
                    })
                }
                _ => false,
            })
        })
    })
}

/// Has the start state a value for it that nobody told us?
fn is_taken_for_granted(value: SystemValue) -> bool {
    use SystemValue as V;
    !matches!(
        value,
        V::WorkPosition
            | V::EndPosition
            | V::MachinePosition
            | V::ProbePosition
            | V::ProbeResult
            | V::WorkOffset
            | V::Reference1
            | V::Reference2
            | V::ToolLength
            | V::ToolDiameter
            | V::ToolRadius
            | V::CallLevel
            | V::Alarm
            | V::StopWithMessage
            | V::Unknown
    )
}

/// The expressions of a block: of its words, then of its statements.
pub(crate) fn expressions(place: &Place) -> Vec<gcheck_program::ExprIx> {
    let words = place.table.words(place.block()).iter().filter_map(|word| match word.value {
        gcheck_program::Value::Expr(expr) => Some(expr),
        _ => None,
    });
    words.chain(place.table.statements(place.ix).flat_map(|s| s.kind.expressions())).collect()
}

/// Does a block always lead away from the block behind it: an end, a return, a jump that no condition guards?
pub(crate) fn leads_away(place: &Place, model: &Model<'_>) -> bool {
    let block = place.block();
    if block.delete > 0 {
        return false;
    }
    for statement in place.table.statements(place.ix) {
        match &statement.kind {
            StatementKind::If { .. } | StatementKind::Guard { .. } => return false,
            StatementKind::Goto { .. }
            | StatementKind::OWord { keyword: OKeyword::Return | OKeyword::EndSub, .. } => return true,
            _ => {}
        }
    }
    place.table.words(block).iter().any(|word| {
        matches!(model.effect(word.code), Effect::Return | Effect::ProgramEnd | Effect::ProgramEndWithPallet)
    })
}
