//! Expressions: what they come to in a state.
//!
//! Knows: the order of operations, functions that a control has in a way of its own. Must not know: what an operator gives on
//! values (the domain does), where a variable's value comes from.

use gcheck_program::{BinaryOp, BlockTable, Expr, Function, Op, Place};

use super::variables::variable_number;
use crate::eval::value::Domain;
use crate::exec::context::{Executor, Step};
use crate::fault::{Fault, ValueFault};
use crate::observer::Observer;
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// The value of an expression. An execution that goes on past alarms takes one that has none for unknown.
    pub(crate) fn evaluate(
        &mut self,
        place: &Place,
        table: &BlockTable,
        expr: &Expr,
        state: &State<D>,
    ) -> Step<D::Value> {
        self.value_of(place, table, expr, state).or_else(|fault| {
            self.refuse(fault)?;
            Ok(D::unknown())
        })
    }

    /// The value of an expression, or why it has none.
    pub(crate) fn value_of(
        &mut self,
        place: &Place,
        table: &BlockTable,
        expr: &Expr,
        state: &State<D>,
    ) -> Step<D::Value> {
        let ops = table.ops(expr);
        // By far the most common: one number, or one variable.
        match ops {
            [Op::Number(number)] => return Ok(D::number(*number)),
            [Op::Variable(number)] => return self.read_variable(*number, state),
            _ => {}
        }
        if !expr.well_formed {
            return Err(Fault::Value(ValueFault::Malformed));
        }
        let semantics = self.model.semantics();
        let bottom = self.stack.len();
        for (index, op) in ops.iter().enumerate() {
            let asks_whether_it_exists = matches!(ops.get(index + 1), Some(Op::Call(Function::Exists, _)));
            let result = match op {
                // `EXISTS[#<name>]` asks whether reading it would be a fault.
                Op::Named { .. } | Op::Variable(_) | Op::Indirect if asks_whether_it_exists => {
                    let exists = self.exists(place, op, state);
                    Ok(exists.map_or_else(D::unknown, |exists| D::number(f64::from(u8::from(exists)))))
                }
                Op::Number(number) => Ok(D::number(*number)),
                Op::Variable(number) => self.read_variable(*number, state),
                Op::Named { start, end } => {
                    let name = self.name(place, (*start, *end));
                    // In front of the assignment that brings it into being the name does not exist yet.
                    if self.created.iter().any(|(created, from)| *created == name && start < from) {
                        Err(Fault::UnsetParameter)
                    } else {
                        self.read_name(name, state)
                    }
                }
                Op::Indirect => {
                    let number = self.operand();
                    self.read_indirect(&number, state)
                }
                Op::Negate => {
                    let value = self.operand();
                    Ok(D::negate(&value))
                }
                Op::Binary(op) => {
                    let right = self.operand();
                    let left = self.operand();
                    D::binary(*op, &left, &right, semantics).map_err(Fault::Value)
                }
                Op::Call(function, count) => self.call_function(*function, *count, bottom),
            };
            match result {
                Ok(value) => self.stack.push(value),
                Err(fault) => {
                    self.stack.truncate(bottom);
                    return Err(fault);
                }
            }
        }
        let value = self.operand();
        self.stack.truncate(bottom);
        Ok(value)
    }

    /// Takes the uppermost value of the expression under way.
    pub(crate) fn operand(&mut self) -> D::Value {
        self.stack.pop().unwrap_or_else(D::unknown)
    }

    /// Would reading what this operation names be no fault?
    pub(crate) fn exists(&mut self, place: &Place, op: &Op, state: &State<D>) -> Option<bool> {
        match op {
            Op::Named { start, end } => self.has_name(self.name(place, (*start, *end)), state),
            Op::Variable(number) => Some(self.check_number(*number).is_ok()),
            _ => {
                let number = D::known(&self.operand());
                number.map(|n| variable_number(n).is_ok_and(|n| self.check_number(n).is_ok()))
            }
        }
    }

    /// A function of the uppermost `count` values, as far as they are above the `bottom` of the expression.
    pub(crate) fn call_function(&mut self, function: Function, count: u8, bottom: usize) -> Step<D::Value> {
        let semantics = self.model.semantics();
        match (function, count) {
            (Function::Exists, _) => Ok(self.operand()),
            (Function::Atan, 2) if semantics.atan_takes_one => {
                let divisor = self.operand();
                let number = self.operand();
                D::call(Function::Atan, std::slice::from_ref(&number), semantics)
                    .and_then(|angle| D::binary(BinaryOp::Divide, &angle, &divisor, semantics))
                    .map_err(Fault::Value)
            }
            _ => {
                let from = self.stack.len().saturating_sub(usize::from(count)).max(bottom);
                let result = D::call(function, self.stack.get(from..).unwrap_or_default(), semantics);
                self.stack.truncate(from);
                result.map_err(Fault::Value)
            }
        }
    }
}
