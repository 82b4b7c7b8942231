//! Repeats: findings of one rule and severity after the first few, which people are told as one.
//!
//! Knows: which findings repeat others, and how many are shown one by one. Must not know: formats, editors.

use std::collections::BTreeMap;

use crate::{Finding, Severity};

/// So many findings of one rule and severity are shown one by one where repeats are folded.
pub const SHOWN_OF_A_RULE: usize = 5;

/// What is told next.
#[derive(Debug, Clone, PartialEq)]
pub enum Told<'f> {
    /// A finding.
    One(&'f Finding),
    /// Findings that repeat the last ones of their rule and severity, in order; never none.
    Repeats(Vec<&'f Finding>),
}

impl<'f> Told<'f> {
    /// The finding, or the first of the repeats.
    pub fn first(&self) -> Option<&'f Finding> {
        match self {
            Self::One(finding) => Some(finding),
            Self::Repeats(repeats) => repeats.first().copied(),
        }
    }

    /// How many findings it tells.
    pub fn count(&self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Repeats(repeats) => repeats.len(),
        }
    }
}

/// The findings as they are told, in order; repeats are where the first of them would be. Those that `stays` accepts never count
/// as repeats.
pub fn fold_repeats(findings: &[Finding], stays: impl Fn(&Finding) -> bool) -> Vec<Told<'_>> {
    /// How many of a rule and severity there were, and where those after the first few are told.
    #[derive(Default)]
    struct Seen {
        count: usize,
        place: Option<usize>,
    }
    let mut seen: BTreeMap<(&str, Severity), Seen> = BTreeMap::new();
    let mut told: Vec<Told<'_>> = Vec::new();
    for finding in findings {
        let seen = seen.entry((finding.rule.id, finding.severity)).or_default();
        seen.count += 1;
        if seen.count <= SHOWN_OF_A_RULE || stays(finding) {
            told.push(Told::One(finding));
            continue;
        }
        let place = *seen.place.get_or_insert(told.len());
        match told.get_mut(place) {
            Some(Told::Repeats(repeats)) => repeats.push(finding),
            _ => told.push(Told::Repeats(vec![finding])),
        }
    }
    told
}
