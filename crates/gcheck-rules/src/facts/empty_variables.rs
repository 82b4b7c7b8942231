//! How a block uses a variable that holds nothing.
//!
//! Knows: the expressions of a block. Must not know: any rule, values.

use std::ops::Range;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::FrameKind;
use gcheck_program::{BinaryOp, ExprIx, Op, Place, StatementKind, Value};

use crate::PathCx;

/// How a block uses a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// In arithmetic, a comparison or a target.
    Computed,
    /// `#5=#5+1`: counts from null, as from zero.
    Counted,
    /// The value of the word of this address.
    Word(Letter),
    /// An argument of a call, or a copy: passed on.
    HandedOn,
    /// Compared with null.
    Tested,
}

/// Is a program under way that a call with arguments began?
pub(crate) fn is_in_macro(cx: &PathCx<'_>) -> bool {
    cx.state().frames().iter().any(|frame| frame.kind == FrameKind::Macro)
}

/// The address of a call whose value is in this local variable.
pub(crate) fn argument_of<'a>(cx: &PathCx<'a>, variable: u32) -> Option<&'a str> {
    let letters = &cx.model.semantics().argument_letters;
    let of = letters.iter().find(|(_, number)| u32::from(**number) == variable);
    of.map(|(letter, _)| letter.as_str())
}

/// Does a block that is before this one in the file write the variable? What is empty then was emptied, or copied from an
/// empty one.
pub(crate) fn is_assigned_before(cx: &PathCx<'_>, variable: u32) -> bool {
    let here = cx.range().start;
    cx.file_index.assigned.iter().any(|(number, range)| *number == variable && range.end <= here)
}

/// The most serious use of a variable in a block, with its bytes. `None` when the block reads it in a way that its text
/// does not show (`#[#1]`).
pub(crate) fn usage(cx: &PathCx<'_>, place: &Place, variable: u32) -> Option<(Use, Range<u32>)> {
    let mut found: Option<(Use, Range<u32>)> = None;
    let mut see = |usage: Use, range: Range<u32>| {
        let rank = |usage: Use| match usage {
            Use::Tested | Use::HandedOn => 0,
            Use::Counted => 1,
            Use::Word(_) => 2,
            Use::Computed => 3,
        };
        if found.as_ref().is_none_or(|(known, _)| rank(*known) < rank(usage)) {
            found = Some((usage, place.base + range.start..place.base + range.end));
        }
    };
    let reads = |expr: ExprIx| place.table.ops(place.table.expr(expr)).contains(&Op::Variable(variable));
    let calls = cx.has_effect(Effect::calls_macro);
    for word in place.table.words(place.block()) {
        let Value::Expr(expr) = word.value else { continue };
        if !reads(expr) {
            continue;
        }
        let usage = match place.table.ops(place.table.expr(expr)) {
            [Op::Variable(_)] if calls => Use::HandedOn,
            [Op::Variable(_)] | [Op::Variable(_), Op::Negate] => Use::Word(word.letter),
            _ => Use::Computed,
        };
        see(usage, word.range());
    }
    for statement in place.table.statements(place.ix) {
        for expr in statement.kind.expressions().filter(|expr| reads(*expr)) {
            let ops = place.table.ops(place.table.expr(expr));
            let is_condition = matches!(
                statement.kind,
                StatementKind::If { .. } | StatementKind::Guard { .. } | StatementKind::Do { .. }
            );
            let is_tested = is_condition && ops.contains(&Op::Variable(0));
            let counts = matches!(&statement.kind, StatementKind::Assign { target: gcheck_program::Target::Variable(to), .. } if *to == variable)
                && ops.contains(&Op::Binary(BinaryOp::Add));
            let usage = match ops {
                _ if is_tested => Use::Tested,
                [Op::Variable(_)] if !is_condition => Use::HandedOn,
                _ if counts => Use::Counted,
                _ => Use::Computed,
            };
            see(usage, statement.range.clone());
        }
    }
    found
}
