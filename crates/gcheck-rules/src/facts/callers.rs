//! What a caller may have given a program that the analysis takes for something else.
//!
//! Knows: which variables and modes a caller hands over, and that a value which the program itself sets is its own under every
//! caller. Must not know: any rule.

use gcheck_engine::{Abstract, Domain, Truth};
use gcheck_program::{BlockFlags, Op};

use crate::PathCx;
use crate::facts::usage::is_assumed;

/// Whether the program has read something on its way that its caller may have given.
///
/// A rule keeps one, and shows it every block with an expression.
#[derive(Debug, Default, Clone, PartialEq)]
pub(crate) struct CallerValues {
    has_read: bool,
}

impl CallerValues {
    /// Takes note of what the block reads; call it before anything is asked about the block.
    pub(crate) fn see(&mut self, cx: &PathCx<'_>) {
        let reads = BlockFlags::EXPRESSION | BlockFlags::STATEMENT;
        if !self.has_read && cx.origin().flags.intersects(reads) && is_called(cx) && reads_given(cx) {
            self.has_read = true;
        }
    }

    /// May a caller give the words of the block other values than the analysis knows?
    pub(crate) fn may_decide(&self, cx: &PathCx<'_>) -> bool {
        self.has_read && is_called(cx)
    }
}

/// Is the block one of a program that others call, and not of one that this program calls?
fn is_called(cx: &PathCx<'_>) -> bool {
    cx.depth() == 1 && cx.file_index.is_called_from_elsewhere()
}

/// Does the block read a variable that nobody has set yet, or a mode, a tool or an offset as the control starts with it?
fn reads_given(cx: &PathCx<'_>) -> bool {
    let Some((table, expressions)) = cx.expressions() else { return false };
    let semantics = cx.model.semantics();
    let variables = &semantics.system_variables;
    let [first, last] = semantics.locals;
    let is_given = |op: &Op| match op {
        Op::Variable(number) if (first..=last).contains(number) => {
            Abstract::is_vacant(&cx.state().variables().get(*number)) != Truth::False
        }
        Op::Variable(number) => {
            variables.iter().any(|variable| is_assumed(variable.holds) && variable.cell(*number).is_some())
        }
        Op::Named { .. } | Op::Indirect => true,
        Op::Number(_) | Op::Negate | Op::Binary(_) | Op::Call(..) => false,
    };
    expressions.iter().any(|expr| table.ops(table.expr(*expr)).iter().any(is_given))
}
