//! Which rules run, and with what severity.
//!
//! Knows: rule ids, groups, sets, aliases. Must not know: where the wishes come from (command line, configuration).

use crate::{RuleEntry, RuleSet, Severity, all};

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
    /// Parallel to [`all`].
    states: Vec<State>,
}

impl Default for Selection {
    /// The recommended set.
    fn default() -> Self {
        Self::of(|rule| rule.meta.recommended)
    }
}

impl Selection {
    /// No rule at all.
    pub fn none() -> Self {
        Self::of(|_| false)
    }

    /// Only the rule of an entry.
    pub fn only(rule: &RuleEntry) -> Self {
        Self::of(|r| std::ptr::eq(r.meta, rule.meta))
    }

    fn of(is_on: impl Fn(&RuleEntry) -> bool) -> Self {
        Self { states: all().iter().map(|rule| if is_on(rule) { State::On } else { State::Off }).collect() }
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

    /// The rules that are on, with the severity that replaces their own.
    pub fn rules(&self) -> impl Iterator<Item = (&'static RuleEntry, Option<Severity>)> {
        all().iter().zip(&self.states).filter_map(|(rule, state)| match state {
            State::Off => None,
            State::On => Some((*rule, None)),
            State::Fixed(severity) => Some((*rule, Some(*severity))),
        })
    }

    /// Is the rule on?
    pub fn contains(&self, id: &str) -> bool {
        self.rules().any(|(rule, _)| rule.meta.id == id)
    }

    fn each(&mut self, selector: &str, mut change: impl FnMut(&mut State)) -> Result<(), UnknownRule> {
        let mut found = false;
        for (rule, state) in all().iter().zip(&mut self.states) {
            if matches(rule, selector) {
                found = true;
                change(state);
            }
        }
        if found {
            Ok(())
        } else {
            Err(UnknownRule { name: selector.to_owned(), suggestion: suggest(selector) })
        }
    }
}

/// Does a selector name this rule?
pub(crate) fn matches(rule: &RuleEntry, selector: &str) -> bool {
    let meta = rule.meta;
    match selector {
        "all" => true,
        "recommended" => meta.recommended,
        _ => {
            meta.id == selector
                || meta.group == selector
                || meta.aliases.contains(&selector)
                || RuleSet::ALL.into_iter().any(|set| set.name() == selector && meta.is_in(set))
        }
    }
}

/// The rule, group or set whose name is nearest, if one is near.
pub fn suggest(name: &str) -> Option<&'static str> {
    let sets = RuleSet::ALL.into_iter().map(RuleSet::name);
    let names =
        all().iter().flat_map(|r| [r.meta.id, r.meta.group]).chain(["recommended", "all"]).chain(sets);
    names
        .map(|candidate| (strsim::levenshtein(name, candidate), candidate))
        .filter(|(distance, candidate)| *distance <= 1 + candidate.len() / 4)
        .min()
        .map(|(_, candidate)| candidate)
}
