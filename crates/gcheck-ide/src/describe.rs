//! Entries of the knowledge base as Markdown.
//!
//! Knows: how an entry reads. Must not know: any code, word or variable.

use std::fmt::Write as _;

use gcheck_controls::{Access, Code, Control, Letter, VariableEntry, VariableKind, WordEntry};

use gcheck_diagnostics::alarm_name;

use crate::foreign::Foreign;

/// A code: title, rules, words, prose, example, source.
pub(crate) fn code(control: &Control, code: Code<'_>) -> String {
    format!("{}\n\n{}", title(code), details(control, code))
}

/// A code and what it is called, in one line.
pub(crate) fn title(code: Code<'_>) -> String {
    let entry = code.entry();
    if code.is_user() {
        // The configuration came with the programs.
        return format!("**{}** {}", entry.code, Foreign::Prose(&entry.title));
    }
    format!("**{}** {}", entry.code, entry.title)
}

/// All about a code but its title.
pub(crate) fn details(control: &Control, code: Code<'_>) -> String {
    let entry = code.entry();
    let mut text = format!("{}\n", entry.summary);
    let mut facts: Vec<String> = Vec::new();
    let group = code.group();
    let number = group.number.as_ref().map(|n| format!(" (group {n})")).unwrap_or_default();
    let lasts = if group.modal { "stays in effect" } else { "for its own block" };
    facts.push(format!("{}{number}: {lasts}", group.title));
    let mut fact = |title: &str, items: &[String]| {
        if !items.is_empty() {
            facts.push(format!("{title} {}", control.references_in_words(items, |code| format!("`{code}`"))));
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
        let name = alarm_name(number);
        let (first, rest) = name.split_at_checked(1).unwrap_or_default();
        let first = first.to_ascii_uppercase();
        let _ = write!(text, "\n{first}{rest}: {}{}\n", alarm.text, alarm.confidence.remark());
    }
    let blocks: Vec<&str> = entry.setup.iter().chain([&entry.example]).map(String::as_str).collect();
    let _ = write!(text, "\n```gcode\n{}\n```\n", blocks.join("\n"));
    let _ = write!(text, "\n*{}: {}{}*\n", control.title(), entry.source, entry.confidence.remark());
    text
}

/// Is a word required, and what may it be?
pub(crate) fn needs(word: &WordEntry) -> String {
    format!("{}, {}", word.need_in_words(), word.values_in_words())
}

/// The meaning of a word, followed by more of it, without what the meaning says already: `spindle speed, optional`, not
/// `spindle speed, optional, spindle speed`.
pub(crate) fn meaning(is: &str, more: &str) -> String {
    let mut text = is.to_owned();
    for part in more.split(", ").filter(|part| !says(is, part)) {
        text.push_str(", ");
        text.push_str(part);
    }
    text
}

/// Does a text begin with some words?
fn says(text: &str, words: &str) -> bool {
    let Some((head, rest)) = text.split_at_checked(words.len()) else { return false };
    head.eq_ignore_ascii_case(words) && !rest.starts_with(|c: char| c.is_alphanumeric() || c == '-')
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
    format!("{} ({kind}{access}){}", entry.title, entry.confidence.remark())
}

/// The entry of a word as a code reads it.
pub(crate) fn word_of(code: Code<'_>, letter: Letter) -> Option<&WordEntry> {
    code.entry().words.iter().find(|word| Letter::parse(&word.letter) == Some(letter))
}
