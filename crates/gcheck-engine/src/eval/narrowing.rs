//! Conditions: whether they hold, and what a variable may still be on the way that one leaves open.
//!
//! Knows: comparisons of a variable with a number. Must not know: where the ways lead.

use gcheck_controls::Unset;
use gcheck_program::{BinaryOp, BlockTable, ExprIx, Op, Place};

use crate::eval::value::{Domain, Truth};
use crate::exec::context::{Executor, Step};
use crate::observer::Observer;
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    pub(crate) fn condition(
        &mut self,
        place: &Place,
        table: &BlockTable,
        condition: ExprIx,
        state: &State<D>,
    ) -> Step<Truth> {
        let value = self.evaluate(place, table, table.expr(condition), state)?;
        Ok(D::truth(&value))
    }

    /// Narrows a variable by what a condition says of it: `#1 LT 10` holding leaves less than ten.
    pub(crate) fn assume(
        &mut self,
        table: &BlockTable,
        condition: ExprIx,
        holds: bool,
        state: &mut State<D>,
    ) {
        let (variable, op, bound) = match table.ops(table.expr(condition)) {
            [Op::Variable(variable), Op::Number(bound), Op::Binary(op)] => (*variable, *op, *bound),
            [Op::Variable(variable), Op::Number(bound), Op::Negate, Op::Binary(op)] => {
                (*variable, *op, -*bound)
            }
            [Op::Number(bound), Op::Variable(variable), Op::Binary(op)] => match mirrored(*op) {
                Some(op) => (*variable, op, *bound),
                None => return,
            },
            // `#1 EQ #0`: nothing, or something.
            [
                Op::Variable(variable),
                Op::Variable(0),
                Op::Binary(op @ (BinaryOp::Equal | BinaryOp::NotEqual)),
            ]
            | [
                Op::Variable(0),
                Op::Variable(variable),
                Op::Binary(op @ (BinaryOp::Equal | BinaryOp::NotEqual)),
            ] if self.model.semantics().unset == Unset::Vacant => {
                let vacant = (*op == BinaryOp::Equal) == holds;
                if let Ok(value) = self.read_variable(*variable, state)
                    && let Some(narrowed) = D::assume_vacant(&value, vacant)
                    && self.model.system_variable(*variable).is_none()
                {
                    self.narrow(*variable, narrowed, state);
                }
                return;
            }
            [Op::Variable(variable), Op::Variable(other), Op::Binary(op)] => {
                match self.read_variable(*other, state).ok().as_ref().and_then(D::known) {
                    Some(bound) => (*variable, *op, bound),
                    None => return,
                }
            }
            _ => return,
        };
        let Some(op) = (if holds { Some(op) } else { opposite(op) }) else { return };
        let Ok(value) = self.read_variable(variable, state) else { return };
        if D::known(&value).is_some() {
            return;
        }
        if let Some(narrowed) = D::assume(&value, op, bound, self.model.semantics()) {
            let is_system = self.model.system_variable(variable).is_some();
            if !is_system {
                self.narrow(variable, narrowed, state);
            }
        }
    }

    /// A variable holds this on the way taken. Nobody has written it for that.
    pub(crate) fn narrow(&self, variable: u32, value: D::Value, state: &mut State<D>) {
        let semantics = self.model.semantics();
        let number = semantics.kept_as(variable);
        let [first, last] = semantics.locals;
        if !(first..=last).contains(&number) {
            state.variables.narrow(number, value);
        } else if let Some(locals) = state.calls.locals_mut() {
            locals.set(number, value);
        }
    }
}

/// The comparison with its sides exchanged.
fn mirrored(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Equal => BinaryOp::Equal,
        BinaryOp::NotEqual => BinaryOp::NotEqual,
        BinaryOp::Greater => BinaryOp::Less,
        BinaryOp::GreaterEqual => BinaryOp::LessEqual,
        BinaryOp::Less => BinaryOp::Greater,
        BinaryOp::LessEqual => BinaryOp::GreaterEqual,
        _ => return None,
    })
}

/// The comparison that holds when this one does not.
fn opposite(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Equal => BinaryOp::NotEqual,
        BinaryOp::NotEqual => BinaryOp::Equal,
        BinaryOp::Greater => BinaryOp::LessEqual,
        BinaryOp::GreaterEqual => BinaryOp::Less,
        BinaryOp::Less => BinaryOp::GreaterEqual,
        BinaryOp::LessEqual => BinaryOp::Greater,
        _ => return None,
    })
}
