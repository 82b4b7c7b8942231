//! Which rules run, and with what severity.
//!
//! Knows: rule ids, groups, sets, aliases. Must not know: where the wishes come from (command line, configuration).

use gcheck_diagnostics::Severity;

use crate::{RuleEntry, RuleTable};

/// Why a selector cannot be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownRule {
    /// As written.
    pub name: String,
    /// The nearest rule, group or set.
    pub suggestion: Option<&'static str>,
}

/// Whether a rule runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Off,
    /// With the severity that it gives each finding itself.
    On,
    /// With one severity for all its findings.
    Fixed(Severity),
}

/// Rules that run, with their severities.
#[derive(Debug, Clone)]
pub struct Selection {
    table: RuleTable,
    /// Parallel to the table.
    states: Vec<State>,
}

impl Selection {
    /// The recommended set of a table.
    pub fn recommended(table: RuleTable) -> Self {
        Self::of(table, |rule| rule.meta.recommended)
    }

    /// No rule of a table.
    pub fn none(table: RuleTable) -> Self {
        Self::of(table, |_| false)
    }

    /// One rule of a table.
    pub fn only(table: RuleTable, rule: &RuleEntry) -> Self {
        Self::of(table, |r| r.meta == rule.meta)
    }

    fn of(table: RuleTable, is_on: impl Fn(&RuleEntry) -> bool) -> Self {
        let states = table.iter().map(|rule| if is_on(rule) { State::On } else { State::Off }).collect();
        Self { table, states }
    }

    /// All rules that there are, selected or not.
    pub fn table(&self) -> RuleTable {
        self.table
    }

    /// Turns on what a selector names: a rule, a group, a set or `all`.
    ///
    /// # Errors
    /// [`UnknownRule`] when it names nothing.
    pub fn enable(&mut self, selector: &str) -> Result<(), UnknownRule> {
        self.each(selector, |state| {
            if *state == State::Off {
                *state = State::On;
            }
        })
    }

    /// Turns off what a selector names.
    ///
    /// # Errors
    /// [`UnknownRule`] when it names nothing.
    pub fn disable(&mut self, selector: &str) -> Result<(), UnknownRule> {
        self.each(selector, |state| *state = State::Off)
    }

    /// Turns on what a selector names and fixes its severity.
    ///
    /// # Errors
    /// [`UnknownRule`] when it names nothing.
    pub fn set_severity(&mut self, selector: &str, severity: Severity) -> Result<(), UnknownRule> {
        self.each(selector, |state| *state = State::Fixed(severity))
    }

    /// Turns off all rules but one, which stays as it is.
    pub fn keep_only(&mut self, id: &str) {
        for (rule, state) in self.table.iter().zip(&mut self.states) {
            if rule.meta.id != id {
                *state = State::Off;
            }
        }
    }

    /// Turns off one rule.
    pub(crate) fn leave_out(&mut self, id: &str) {
        for (rule, state) in self.table.iter().zip(&mut self.states) {
            if rule.meta.id == id {
                *state = State::Off;
            }
        }
    }

    /// The rules that are on, with the severity that replaces their own.
    pub fn rules(&self) -> impl Iterator<Item = (&'static RuleEntry, Option<Severity>)> {
        self.table.iter().zip(&self.states).filter_map(|(rule, state)| match state {
            State::Off => None,
            State::On => Some((rule, None)),
            State::Fixed(severity) => Some((rule, Some(*severity))),
        })
    }

    /// Is the rule on?
    pub fn contains(&self, id: &str) -> bool {
        self.rules().any(|(rule, _)| rule.meta.id == id)
    }

    fn each(&mut self, selector: &str, mut change: impl FnMut(&mut State)) -> Result<(), UnknownRule> {
        let mut found = false;
        for (rule, state) in self.table.iter().zip(&mut self.states) {
            if rule.meta.is_selected_by(selector) {
                found = true;
                change(state);
            }
        }
        if found {
            Ok(())
        } else {
            Err(UnknownRule { name: selector.to_owned(), suggestion: self.table.suggest(selector) })
        }
    }
}
