//! How entries of the knowledge base read to people.
//!
//! Knows: words for kinds, needs, ranges and confidence. Must not know: any code or address, and how a page is laid out.

use crate::{Confidence, Control, Need, WordEntry, WordKind};

impl WordKind {
    /// The kind in words: `whole number`.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Angle => "degrees",
            Self::Direction => "direction number",
            Self::Integer => "whole number",
            Self::LeastIncrements => "length in least increments, a whole number",
            Self::Real => "number",
            Self::Feed => "feed rate",
            Self::Speed => "spindle speed",
            Self::SecondsOrMilliseconds => "seconds with a decimal point, milliseconds without",
            Self::Seconds => "seconds",
            Self::Milliseconds => "milliseconds",
            Self::Label => "sequence number",
            Self::Program => "program number",
            Self::Ratio => "factor",
            Self::Flag => "presence counts",
        }
    }
}

impl WordEntry {
    /// Must the word be given? `required`, `optional, else 1`.
    pub fn need_in_words(&self) -> String {
        match self.need {
            Need::Required => "required".to_owned(),
            Need::Modal => "here or earlier".to_owned(),
            Need::Optional => {
                self.default.as_ref().map_or_else(|| "optional".to_owned(), |d| format!("optional, else {d}"))
            }
            Need::Conditional => self.when.clone().unwrap_or_else(|| "sometimes".to_owned()),
        }
    }

    /// What it may be: its kind and its bounds, `length, above 0`; what is not a value between them, `but not 201 to 999`.
    pub fn values_in_words(&self) -> String {
        let range = match (self.min, self.max, self.above) {
            _ if !self.values.is_empty() => format!(", {}", one_of(&self.values)),
            (Some(min), Some(max), _) => format!(", {min} to {max}"),
            (Some(min), None, _) => format!(", from {min}"),
            (None, Some(max), _) => format!(", up to {max}"),
            (None, None, Some(above)) => format!(", above {above}"),
            (None, None, None) => String::new(),
        };
        let gaps = spans(&self.gaps);
        let gaps = if gaps.is_empty() { gaps } else { format!(", but not {gaps}") };
        format!("{}{range}{gaps}", self.kind.in_words())
    }
}

/// Single values for people: `0, 1 or 2`.
pub fn one_of(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(f64::to_string).collect();
    match texts.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}

/// Ranges of numbers for people: `0, 201 to 999`.
pub fn spans(ranges: &[[f64; 2]]) -> String {
    let shown = |[first, last]: &[f64; 2]| {
        if last - first < 1e-9 { format!("{first}") } else { format!("{first} to {last}") }
    };
    ranges.iter().map(shown).collect::<Vec<String>>().join(", ")
}

impl Confidence {
    /// What is added to a fact that no manual grounds; nothing to one that a manual does.
    pub fn remark(self) -> &'static str {
        match self {
            Self::Manual => "",
            Self::Observed => " (seen on real programs)",
            Self::Assumed => " (unverified)",
        }
    }
}

impl Control {
    /// What an entry refers to, in a list: groups (`@id`) by what they decide, codes as `code` writes them.
    pub fn references_in_words(&self, items: &[String], code: impl Fn(&str) -> String) -> String {
        let name = |item: &String| match item.strip_prefix('@') {
            Some(id) => self
                .group_by_id(id)
                .map_or_else(|| id.to_owned(), |ix| format!("all of {}", self.group(ix).title)),
            None => code(item),
        };
        items.iter().map(name).collect::<Vec<_>>().join(", ")
    }
}
