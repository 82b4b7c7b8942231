//! One block looked at in a state: what its expressions come to, what it would make the machine do.
//!
//! Knows: how a single step is taken apart for who looks at it. Must not know: how the state came about, what is shown of it.

use std::ops::Range;

use gcheck_controls::Letter;
use gcheck_program::{ExprIx, Place, Value, Word};

use crate::eval::value::{Abstract, AbstractValue};
use crate::event::{Event, Units};
use crate::exec::context::{Executor, Options, Outcome};
use crate::fault::Fault;
use crate::machine::Machine;
use crate::model::Model;
use crate::observer::Observer;
use crate::origin::{At, Origin};
use crate::program::Program;
use crate::state::State;

/// Events of one block that are kept.
const MOST_EVENTS: usize = 20_000;
/// Expressions of one block that are looked at.
const MOST_EXPRESSIONS: usize = 256;

/// Looks at blocks of a program, each in the state that it is given.
///
/// The state must come from an execution of the same [`Program`]: names of parameters are small numbers of the program.
pub struct Look<'a, 'p> {
    executor: Executor<'a, 'p, Abstract, Seen>,
}

/// What a block does in a state.
#[derive(Debug)]
pub struct Trial {
    /// What happens, in order; the first of very many.
    pub events: Vec<Event>,
    /// There were more events than are kept.
    pub is_cut_short: bool,
    /// The state behind the block; `None` when execution does not simply go on with another block.
    pub after: Option<State<Abstract>>,
    /// Why the block cannot be executed.
    pub fault: Option<Fault>,
}

#[derive(Default)]
struct Seen {
    events: Vec<Event>,
    more: bool,
}

impl Observer<Abstract> for Seen {
    fn event(&mut self, _: Origin, _: &State<Abstract>, event: &Event) {
        if self.events.len() < MOST_EVENTS {
            self.events.push(event.clone());
        } else {
            self.more = true;
        }
    }
}

impl std::fmt::Debug for Look<'_, '_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Look").finish_non_exhaustive()
    }
}

impl<'a, 'p> Look<'a, 'p> {
    /// Looks at a program on a machine.
    pub fn new(program: &'a Program<'p>, model: &'a Model<'a>, machine: &'a Machine) -> Self {
        Self::with(program, model, machine, Options::NONE)
    }

    /// Looks at a program in states that an analysis with these options gave.
    pub fn with(
        program: &'a Program<'p>,
        model: &'a Model<'a>,
        machine: &'a Machine,
        options: Options,
    ) -> Self {
        Self { executor: Executor::new(program, model, machine, options, Seen::default()) }
    }

    /// The control.
    pub fn model(&self) -> &'a Model<'a> {
        self.executor.model
    }

    /// The programs.
    pub fn program(&self) -> &'a Program<'p> {
        self.executor.program
    }

    /// What the expressions of a block come to in the state before it: bytes of the file, and the value. Those that have no
    /// value are left out.
    pub fn expressions(&mut self, at: At, state: &State<Abstract>) -> Vec<(Range<u32>, AbstractValue)> {
        let Some(place) = self.executor.place(at) else { return Vec::new() };
        self.executor.origin.at = at;
        let table = &*place.table;
        let of_words = table.words(place.block()).iter().filter_map(|word| match word.value {
            Value::Expr(expr) => Some(expr),
            Value::Number(_) | Value::Missing => None,
        });
        let of_statements = table.statements(place.ix).flat_map(|statement| statement.kind.expressions());
        let all: Vec<ExprIx> = of_words.chain(of_statements).take(MOST_EXPRESSIONS).collect();
        let mut values = Vec::with_capacity(all.len());
        for ix in all {
            let expr = table.expr(ix);
            if let Ok(value) = self.executor.evaluate(&place, table, expr, state) {
                values.push((place.base + expr.range.start..place.base + expr.range.end, value));
            }
        }
        values
    }

    /// The computed words of a block with their values in the state before it; those that have no value are left out.
    pub fn words(&mut self, place: &Place, at: At, state: &State<Abstract>) -> Vec<(Word, AbstractValue)> {
        self.executor.origin.at = at;
        let table = &*place.table;
        let mut values = Vec::new();
        for word in table.words(place.block()).iter().take(MOST_EXPRESSIONS) {
            if let Value::Expr(expr) = word.value
                && let Ok(value) = self.executor.evaluate(place, table, table.expr(expr), state)
            {
                values.push((*word, value));
            }
        }
        values
    }

    /// The value of a numbered variable, whether the program's or the control's own; `None` when reading it is a fault.
    pub fn variable(&mut self, number: u32, state: &State<Abstract>) -> Option<AbstractValue> {
        self.executor.read_variable(number, state).ok()
    }

    /// The value of a named parameter, by its name without brackets; `None` when reading it is a fault.
    pub fn parameter(&mut self, name: &str, state: &State<Abstract>) -> Option<AbstractValue> {
        let name: String = name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect();
        let name = self.executor.program.name(&name);
        self.executor.read_name(name, state).ok()
    }

    /// A number without decimal point on an address, as the control counts it.
    pub fn counted(&mut self, letter: Letter, number: f64, units: Option<Units>) -> f64 {
        self.executor.scale(letter, number, units)
    }

    /// What a block does in a state.
    pub fn execute(&mut self, at: At, state: &State<Abstract>) -> Trial {
        let mut after = state.clone();
        self.executor.observer = Seen::default();
        let outcome = self.executor.step(at, &mut after);
        let Seen { events, more } = std::mem::take(&mut self.executor.observer);
        let (after, fault) = match outcome {
            Outcome::Next | Outcome::Jump(_) => (Some(after), None),
            Outcome::Fork(_) | Outcome::End(_) => (None, None),
            Outcome::Fault(fault) => (None, Some(fault)),
        };
        Trial { events, is_cut_short: more, after, fault }
    }
}
