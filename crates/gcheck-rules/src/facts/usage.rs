//! How a file is used, as its text shows: started by the operator, or called by programs of other files.
//!
//! Knows: ends, conditions and variables of the main file's text. Must not know: any rule, values.

use std::rc::Rc;

use crate::Environment;
use gcheck_controls::{Ends, SystemValue};
use gcheck_engine::{At, Model, Program, ProgramFile};
use gcheck_program::{BlockFlags, EndMark, FileIndex, OKeyword, Op, Place, StatementKind};

/// The blocks of the main file that have any of these flags.
pub(crate) fn blocks_with(
    program: &Program<'_>,
    environment: Environment<'_>,
    flags: BlockFlags,
) -> impl Iterator<Item = (At, Place)> {
    let file: Option<Rc<ProgramFile<'_>>> = program.file(0);
    let found: Vec<_> =
        file.map_or_else(Vec::new, |file| file.loaded.blocks_with(flags, environment.dialect).collect());
    found.into_iter().map(|(block, place)| (At { file: 0, block }, place))
}

/// Does the path through the main file depend on a condition?
pub(crate) fn has_conditions(program: &Program<'_>, environment: Environment<'_>) -> bool {
    blocks_with(program, environment, BlockFlags::STATEMENT).any(|(_, place)| {
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

/// Does the main file read what the control may hold otherwise than assumed at the start: modes, the tool, offsets?
pub(crate) fn reads_start_state(
    program: &Program<'_>,
    model: &Model<'_>,
    environment: Environment<'_>,
) -> bool {
    let variables = &model.semantics().system_variables;
    let Some(file) = program.file(0) else { return false };
    let flags = BlockFlags::STATEMENT | BlockFlags::EXPRESSION;
    blocks_with(program, environment, flags).any(|(_, place)| {
        let text = file.loaded.chunk_text(place.chunk);
        place.expressions().any(|expr| {
            place.table.ops(place.table.expr(expr)).iter().any(|op| match op {
                Op::Variable(number) => variables
                    .iter()
                    .any(|variable| is_assumed(variable.holds) && variable.cell(*number).is_some()),
                Op::Named { start, end } => {
                    let name = text.get(*start as usize..*end as usize).unwrap_or_default();
                    variables.iter().any(|variable| {
                        variable.name.as_ref().is_some_and(|n| n.eq_ignore_ascii_case(name))
                            && is_assumed(variable.holds)
                    })
                }
                _ => false,
            })
        })
    })
}

/// Has the start state an assumed value for it?
pub(crate) fn is_assumed(value: SystemValue) -> bool {
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
            | V::ToolLengthWear
            | V::ToolDiameterWear
            | V::CallLevel
            | V::Alarm
            | V::StopWithMessage
            | V::Unknown
    )
}

/// Does a block never lead to the next block: an end, a return, a jump that no condition guards?
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
    place.table.words(block).iter().any(|word| model.effect(word.code).leaves_program())
}

/// May the program be called by one that is not in the file? Then it has its caller's words too, which the text does not show.
/// A program after the main program of the file is called by that.
pub(crate) fn may_be_called(file_index: &FileIndex) -> bool {
    let second = file_index.programs.get(1).map_or(0, |second| second.range.start);
    let is_of_main =
        |end: &EndMark| end.range.start < second && end.ends == Ends::Program && !end.conditional;
    file_index.is_called_from_elsewhere()
        || second > 0 && !file_index.ends.iter().any(is_of_main)
        || file_index.o_words.iter().any(|word| word.keyword == OKeyword::Sub)
}
