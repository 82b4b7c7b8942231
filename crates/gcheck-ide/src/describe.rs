//! Entries of the knowledge base as Markdown.
//!
//! Knows: how an entry reads. Must not know: any code, word or variable.

use std::fmt::Write as _;

use gcheck_controls::{
    Access, Code, Confidence, Control, Letter, Need, VariableEntry, VariableKind, WordEntry, WordKind,
};

/// A code: title, rules, words, prose, example, source.
pub(crate) fn code(control: &Control, code: Code<'_>) -> String {
    let entry = code.entry();
    let mut text = format!("**{}** {}\n\n{}\n", entry.code, entry.title, entry.summary);
    let mut facts: Vec<String> = Vec::new();
    let group = code.group();
    let number = group.number.as_ref().map(|n| format!(" (group {n})")).unwrap_or_default();
    let lasts = if group.modal { "stays in effect" } else { "for its own block" };
    facts.push(format!("{}{number}: {lasts}", group.title));
    let mut fact = |title: &str, items: &[String]| {
        if !items.is_empty() {
            facts.push(format!("{title} {}", references(control, items)));
        }
    };
    fact("requires", &entry.requires);
    fact("better with", &entry.recommends);
    fact("not while active:", &entry.forbids);
    fact("not in the same block:", &entry.conflicts);
    fact("ends", &entry.cancels);
    fact("ended by", &entry.cancelled_by);
    if let Some(option) = &entry.option {
        facts.push(format!("needs the option {option}"));
    }
    text.push('\n');
    for fact in facts {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "- {fact}");
    }
    if !entry.words.is_empty() {
        text.push_str("\n| word | meaning | |\n|---|---|---|\n");
        for word in &entry.words {
            let _ = writeln!(text, "| `{}` | {} | {} |", word.letter, word.is, needs(word));
        }
    }
    if let Some(hover) = &entry.hover {
        let _ = write!(text, "\n{}\n", hover.trim());
    }
    let alarms = entry.alarms.iter().filter(|alarm| alarm.number.is_some());
    for alarm in alarms {
        let number = alarm.number.as_deref().unwrap_or_default();
        let _ = write!(text, "\nAlarm {number}: {}{}\n", alarm.text, unverified(alarm.confidence));
    }
    let blocks: Vec<&str> = entry.setup.iter().chain([&entry.example]).map(String::as_str).collect();
    let _ = write!(text, "\n```gcode\n{}\n```\n", blocks.join("\n"));
    let _ = write!(text, "\n*{}: {}{}*\n", control.title(), entry.source, unverified(entry.confidence));
    text
}

/// Must a word stand, and what may it be?
pub(crate) fn needs(word: &WordEntry) -> String {
    let need = match word.need {
        Need::Required => "required".to_owned(),
        Need::Modal => "here or earlier".to_owned(),
        Need::Optional => {
            word.default.as_ref().map_or_else(|| "optional".to_owned(), |d| format!("optional, else {d}"))
        }
        Need::Conditional => word.when.clone().unwrap_or_else(|| "sometimes".to_owned()),
    };
    let range = match (word.min, word.max, word.above) {
        (Some(min), Some(max), _) => format!(", {min} to {max}"),
        (Some(min), None, _) => format!(", from {min}"),
        (None, Some(max), _) => format!(", up to {max}"),
        (None, None, Some(above)) => format!(", above {above}"),
        (None, None, None) => String::new(),
    };
    format!("{need}, {}{range}", kind(word.kind))
}

/// Codes as they are, groups by what they decide.
fn references(control: &Control, items: &[String]) -> String {
    let name = |item: &String| match item.strip_prefix('@') {
        Some(id) => control
            .group_by_id(id)
            .map_or_else(|| id.to_owned(), |ix| format!("all of {}", control.group(ix).title)),
        None => format!("`{item}`"),
    };
    items.iter().map(name).collect::<Vec<_>>().join(", ")
}

/// A kind of value in words.
pub(crate) fn kind(kind: WordKind) -> &'static str {
    match kind {
        WordKind::Length => "length",
        WordKind::Angle => "degrees",
        WordKind::Direction => "direction number",
        WordKind::Integer => "whole number",
        WordKind::Real => "number",
        WordKind::Feed => "feed rate",
        WordKind::Speed => "spindle speed",
        WordKind::SecondsOrMilliseconds => "seconds with a decimal point, milliseconds without",
        WordKind::Seconds => "seconds",
        WordKind::Milliseconds => "milliseconds",
        WordKind::Label => "sequence number",
        WordKind::Program => "program number",
        WordKind::Ratio => "factor",
        WordKind::Flag => "only its presence counts",
    }
}

/// What a variable is to the control, in one line.
pub(crate) fn variable(entry: &VariableEntry) -> String {
    let kind = match entry.kind {
        VariableKind::Local => "local to one program",
        VariableKind::Common => "kept until power off",
        VariableKind::Retained => "kept over power off",
        VariableKind::System => "the control's own",
    };
    let access = match entry.access {
        Access::ReadWrite => "",
        Access::Read => ", may only be read",
        Access::Write => ", may only be written",
    };
    format!("{} ({kind}{access}){}", entry.title, unverified(entry.confidence))
}

/// How sure a fact is.
pub(crate) fn unverified(confidence: Confidence) -> &'static str {
    match confidence {
        Confidence::Manual => "",
        Confidence::Observed => " (seen on real programs)",
        Confidence::Assumed => " (unverified)",
    }
}

/// The entry of a word as a code reads it.
pub(crate) fn word_of(code: Code<'_>, letter: Letter) -> Option<&WordEntry> {
    code.entry().words.iter().find(|word| Letter::parse(&word.letter) == Some(letter))
}
