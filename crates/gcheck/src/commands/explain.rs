//! `gcheck explain`: a rule, or a code as a control reads it.
//!
//! Knows: how an entry of the knowledge base and a rule's documentation read on a terminal. Must not know: any code or rule.

use std::fmt::Write as _;
use std::sync::Arc;

use gcheck_controls::{Code, CodeNumber, Confidence, Control, WordEntry};
use gcheck_diagnostics::RuleMeta;

use super::{chosen_control, columns};
use crate::args::{ExplainOptions, Global};
use crate::nearest::nearest;
use crate::{Problem, output};

/// Prints the page of a rule or code.
pub(crate) fn run(global: &Global, options: &ExplainOptions) -> Result<u8, Problem> {
    let subject = options.subject.trim();
    if let Some(rule) = gcheck_rules::RULES.by_id(subject) {
        return output::print(&of_rule(rule.meta));
    }
    // As programs write it: `G54.1 P1`.
    let code = subject.split_ascii_whitespace().next().unwrap_or(subject);
    if let Some(number) = CodeNumber::parse(code) {
        return explain_code(global, number);
    }
    let rules = gcheck_rules::RULES.iter().map(|rule| rule.meta.id);
    let near = nearest(subject, rules).map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
    let problem = Problem::new(format!("`{subject}` is neither a rule nor a code{near}"));
    Err(problem.help("`gcheck rules` and `gcheck codes` list them"))
}

fn explain_code(global: &Global, number: CodeNumber) -> Result<u8, Problem> {
    let having: Vec<Arc<Control>> = gcheck_controls::names()
        .iter()
        .filter_map(|name| gcheck_controls::load(name).ok())
        .filter(|control| control.code(number).is_some())
        .collect();
    let others =
        |own: &str| -> Vec<&str> { having.iter().map(|c| c.name()).filter(|name| *name != own).collect() };
    let chosen = chosen_control(global)?;
    let control = match &chosen {
        Some(control) => control,
        // Nobody named a control: the best founded entry explains most.
        None => having
            .iter()
            .max_by_key(|control| {
                let entry = control.code(number).map(Code::entry);
                (entry.map(|e| e.confidence), entry.is_some_and(|e| e.hover.is_some()))
            })
            .ok_or_else(|| Problem::new(format!("no control that gcheck knows has `{number}`")))?,
    };
    let Some(code) = control.code(number) else {
        let problem = Problem::new(format!("{} has no `{number}`", control.title()));
        let others = others(control.name());
        return Err(if others.is_empty() {
            problem
        } else {
            problem.help(format!("it is a code of {}", others.join(", ")))
        });
    };
    let mut page = of_code(control, code);
    let others = others(control.name());
    if !others.is_empty() {
        let how = if chosen.is_some() { "" } else { "; choose with --control" };
        let _ = writeln!(page, "Also a code of {}{how}.", others.join(", "));
    }
    output::print(&page)
}

fn of_rule(meta: &RuleMeta) -> String {
    let on = if meta.recommended {
        "on by default".to_owned()
    } else {
        format!("off by default (in {})", meta.sets().join(", "))
    };
    let mends = match meta.fixability.option() {
        "" => String::new(),
        option => format!(", fixed by {option}"),
    };
    format!(
        "{}: {}\n\nseverity {}, {on}{mends}, group {}, since {}\n\n{}",
        meta.id,
        meta.summary,
        meta.severity,
        meta.group,
        meta.since,
        meta.docs()
    )
}

fn of_code(control: &Control, code: Code<'_>) -> String {
    let entry = code.entry();
    let mut page = format!("{}: {}\non {}\n\n{}\n", entry.code, entry.title, control.title(), entry.summary);
    let mut line = |title: &str, text: String| {
        if !text.is_empty() {
            // Writing to a string cannot fail.
            let _ = write!(page, "\n{title}: {text}");
        }
    };
    let references = |items: &[String]| control.references_in_words(items, str::to_owned);
    let group = code.group();
    let number = group.number.as_ref().map(|n| format!(" (group {n})")).unwrap_or_default();
    let default = if group.default.as_deref() == Some(&entry.code) { ", active at power-on" } else { "" };
    let stays = if group.modal { "stays in effect" } else { "for its own block" };
    line("group", format!("{}{number}, {stays}{default}", group.title));
    line("requires", entry.requires.join(", "));
    line("recommends", entry.recommends.join(", "));
    line("not while it is active", references(&entry.forbids));
    line("not in the same block", references(&entry.conflicts));
    line("ends", references(&entry.cancels));
    line("ended by", references(&entry.cancelled_by));
    line("needs the option", entry.option.clone().unwrap_or_default());
    page.push('\n');
    if !entry.words.is_empty() {
        let _ = write!(page, "\nWords\n{}", words(&entry.words));
    }
    if let Some(hover) = &entry.hover {
        let _ = write!(page, "\n{}\n", hover.trim());
    }
    if !entry.alarms.is_empty() {
        page.push_str("\nAlarms\n");
        for alarm in &entry.alarms {
            let number = alarm.number.as_ref().map(|n| format!("{n} ")).unwrap_or_default();
            let _ = writeln!(page, "  {number}{}{}", alarm.text, alarm.confidence.remark());
        }
    }
    page.push_str("\nExample\n");
    for block in entry.setup.iter().chain([&entry.example]) {
        let _ = writeln!(page, "  {block}");
    }
    let _ = writeln!(page, "\nSource: {}{}", entry.source, entry.confidence.remark());
    page
}

fn words(words: &[WordEntry]) -> String {
    let row = |word: &WordEntry| {
        let is = format!("{}{}", word.is, word.confidence.map_or("", Confidence::remark));
        vec![format!("  {}", word.letter), word.values_in_words(), word.need_in_words(), is]
    };
    columns(&words.iter().map(row).collect::<Vec<_>>())
}
