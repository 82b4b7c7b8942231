//! Loops that begin with a condition, and the variables that the condition asks.
//!
//! Knows: where such a loop ends, which of the variables a program can set. Must not know: any rule, what the variables hold.

use std::collections::HashSet;
use std::ops::Range;

use gcheck_controls::Control;
use gcheck_engine::{At, Model};
use gcheck_program::{ControlFlowGraph, ExprIx, OKeyword, Op, Place, StatementKind, Target};

/// The condition of a loop that begins in this block, and the block that ends it. A `while` at the end of a `do` begins none.
pub(crate) fn loop_at(graph: &ControlFlowGraph, at: At, place: &Place) -> Option<(ExprIx, u32)> {
    // A jump before the loop's statement would be its exit.
    place.table.statements(place.ix).find_map(|statement| match &statement.kind {
        StatementKind::Do { condition: Some(condition), .. } => Some((*condition, graph.end_of(at.block)?)),
        StatementKind::OWord { keyword: OKeyword::While, arguments, .. } => {
            let links = graph.o_word(at.block).filter(|links| links.head.is_none())?;
            Some((StatementKind::arguments(arguments).next()?, links.end?))
        }
        _ => None,
    })
}

/// Variables of a condition.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Asked {
    numbers: HashSet<u32>,
    names: HashSet<String>,
}

impl Asked {
    /// Of a condition that asks variables which only the program sets; `text` is that of the chunk.
    pub(crate) fn of(
        control: &Control,
        model: &Model<'_>,
        place: &Place,
        condition: ExprIx,
        text: &str,
    ) -> Option<Self> {
        let mut asked = Self::default();
        for op in place.table.ops(place.table.expr(condition)) {
            match op {
                // What the machine changes by itself: positions, timers, inputs.
                Op::Variable(number) if is_the_machines(model, *number) => return None,
                Op::Variable(0) | Op::Number(_) | Op::Negate | Op::Binary(_) | Op::Call(..) => {}
                Op::Variable(number) => {
                    asked.numbers.insert(*number);
                }
                Op::Named { start, end } => {
                    let name = key(text, &(*start..*end));
                    if is_system_name(control, model, &name) {
                        return None;
                    }
                    asked.names.insert(name);
                }
                Op::Indirect => return None,
            }
        }
        let is_fixed = asked.numbers.is_empty() && asked.names.is_empty();
        (!is_fixed).then_some(asked)
    }

    /// May an assignment to this target set one of them?
    pub(crate) fn is_set_by(&self, target: &Target, text: &str) -> bool {
        match target {
            Target::Variable(number) => self.numbers.contains(number),
            Target::Named(range) => self.names.contains(&key(text, range)),
            Target::Computed(_) | Target::Invalid => true,
        }
    }
}

/// Does the machine change the variable by itself?
pub(crate) fn is_the_machines(model: &Model<'_>, number: u32) -> bool {
    let [_, last_local] = model.semantics().locals;
    let is_common = (100..1000).contains(&number);
    number > last_local && !is_common
}

fn is_system_name(control: &Control, model: &Model<'_>, name: &str) -> bool {
    let mut variables = model.semantics().system_variables.iter();
    name.starts_with("_ini[")
        || name.starts_with("_hal[")
        || control.named_parameter(name).is_some()
        || variables.any(|variable| variable.name.as_ref().is_some_and(|n| n.eq_ignore_ascii_case(name)))
}

/// A parameter's name as the control compares names.
fn key(text: &str, range: &Range<u32>) -> String {
    let name = text.get(range.start as usize..range.end as usize).unwrap_or_default();
    let name = name.trim_start_matches("#<").trim_end_matches('>');
    name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect()
}
