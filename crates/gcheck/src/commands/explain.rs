//! `gcheck explain`: a rule, or a code as a control reads it.
//!
//! Knows: how an entry of the knowledge base and a rule's documentation read on a terminal. Must not know: any code or rule.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::sync::Arc;

use gcheck_controls::{
    Access, AlarmEntry, Code, CodeNumber, Confidence, Control, Letter, SystemCommands, Variable,
    VariableEntry, WordEntry,
};
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
    if let Some(letter) = Letter::parse(&subject.to_ascii_uppercase()) {
        return explain_address(global, letter);
    }
    if let Some(variable) = subject.strip_prefix('#') {
        return explain_variable(global, variable.trim());
    }
    if subject.starts_with('$') {
        return explain_command(global, subject);
    }
    if let Some(page) = answer(global, subject)? {
        return output::print(&page);
    }
    if KEYWORDS.iter().any(|keyword| keyword.eq_ignore_ascii_case(code)) {
        let message = format!(
            "`{}` is a word of macro statements, which has no page: it is neither a rule nor a code",
            code.to_ascii_uppercase()
        );
        return Err(Problem::new(message)
            .help("`gcheck rules` lists the rules of the group `flow`, which are about jumps and loops"));
    }
    if subject.starts_with(|c: char| c.is_ascii_digit()) {
        return Err(without_letter(subject));
    }
    let rules = gcheck_rules::RULES.iter().map(|rule| rule.meta.id);
    let near = nearest(subject, rules).map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
    let problem = Problem::new(format!("`{subject}` is neither a rule nor a code{near}"));
    Err(problem.help("`gcheck rules` and `gcheck codes` list them"))
}

/// All controls, by name.
fn all_controls() -> impl Iterator<Item = Arc<Control>> {
    gcheck_controls::names().iter().filter_map(|name| gcheck_controls::load(name).ok())
}

/// Words of macro statements.
const KEYWORDS: [&str; 12] =
    ["GOTO", "IF", "THEN", "ELSE", "ENDIF", "WHILE", "DO", "END", "WH", "SUB", "CALL", "RETURN"];

/// What a variable holds on the controls: `4003`, `<_feed>`.
fn explain_variable(global: &Global, written: &str) -> Result<u8, Problem> {
    let shown = format!("#{written}");
    let name = written.strip_prefix('<').and_then(|rest| rest.strip_suffix('>'));
    let number = written.parse::<u32>().ok();
    if name.is_none() && number.is_none() {
        return Err(Problem::new(format!("`{shown}` is not a variable"))
            .help("write `#4003`, or `#<_feed>` for a parameter with a name"));
    }
    let chosen = chosen_control(global)?;
    let all: Vec<Arc<Control>> = all_controls().collect();
    let named = all
        .iter()
        .filter_map(|control| Some((variable(control, number, name)?.title.as_str(), control.name())));
    let meanings = by_meaning(named);
    let Some(control) = chosen else {
        if meanings.is_empty() {
            return Err(Problem::new(format!("no control that gcheck knows lists `{shown}`")));
        }
        return output::print(&format!("{shown}: a variable\n\n{meanings}"));
    };
    let Some(entry) = variable(&control, number, name) else {
        let problem = Problem::new(format!("{} does not list `{shown}`", control.title()));
        return Err(if meanings.is_empty() {
            problem
        } else {
            problem.help(format!(
                "without `--control` its meaning on other controls is shown: `gcheck explain '{shown}'`"
            ))
        });
    };
    let access = match entry.access {
        Access::ReadWrite => "programs read and write it",
        Access::Read => "programs read it",
        Access::Write => "programs write it",
    };
    output::print(&format!(
        "{shown}: {}\non {}\n\n{access}\n\nSource: {}{}\n",
        entry.title,
        control.title(),
        entry.source,
        entry.confidence.remark()
    ))
}

/// The entry of a variable by its number, or else of a parameter by its name.
fn variable<'c>(control: &'c Control, number: Option<u32>, name: Option<&str>) -> Option<&'c VariableEntry> {
    match (number.map(|number| control.variable(number)), name) {
        (Some(Variable::Known(entry)), _) => Some(entry),
        (Some(Variable::Unlisted), _) | (None, None) => None,
        (None, Some(name)) => control.named_parameter(name),
    }
}

/// A line for the control itself: `$32`, `$H`.
fn explain_command(global: &Global, subject: &str) -> Result<u8, Problem> {
    let written: String = subject.split_whitespace().collect::<String>().to_ascii_uppercase();
    let name = written.split_once('=').map_or(written.as_str(), |(name, _)| name);
    let number = name.strip_prefix('$').unwrap_or_default();
    let chosen = chosen_control(global)?;
    let reads = |control: &Arc<Control>| control.syntax().system_commands;
    let controls: Vec<Arc<Control>> =
        chosen.map_or_else(|| all_controls().filter(reads).collect(), |one| vec![one]);
    let with = |control: &&Arc<Control>| reads(control) && control.setting(number).is_some();
    let found: Vec<&Arc<Control>> = controls.iter().filter(with).collect();
    if let Some(setting) = found.first().and_then(|control| control.setting(number)) {
        let titles: Vec<&str> = found.iter().map(|control| control.title()).collect();
        let default =
            setting.default.as_ref().map(|value| format!("; {value} as delivered")).unwrap_or_default();
        return output::print(&format!(
            "{name}: {}\non {}\n\n{}\n\nvalues: {}{default}\n\nSource: {}{}\n",
            setting.title,
            titles.join(", "),
            setting.changes,
            setting.values.join(", "),
            setting.source,
            setting.confidence.remark(),
        ));
    }
    let listed: Vec<&Arc<Control>> = controls
        .iter()
        .filter(|control| control.system_commands().is_some_and(|of| of.knows(name)))
        .collect();
    let Some(control) = listed.first() else {
        return Err(Problem::new(format!("no control that gcheck knows lists `{name}`")));
    };
    output::print(&format!(
        "{name}: a line for the control itself\non {}\n\nIt changes nothing that gcheck follows.\n",
        control.title()
    ))
}

/// What an answer of a control means (`error 22`, `PS0011`): its text, and the rules that report it.
fn answer(global: &Global, subject: &str) -> Result<Option<String>, Problem> {
    let chosen = chosen_control(global)?;
    let controls: Vec<Arc<Control>> = chosen.map_or_else(|| all_controls().collect(), |one| vec![one]);
    let is_it = |alarm: &&AlarmEntry| alarm.number.as_ref().is_some_and(|n| n.eq_ignore_ascii_case(subject));
    let mut meanings: Vec<(String, &str)> = Vec::new();
    let mut rules: BTreeSet<&str> = BTreeSet::new();
    for control in &controls {
        let of_rules = control.alarms_of_rules().filter(|(.., alarm)| is_it(alarm));
        let of_rules: Vec<(&str, &AlarmEntry)> = of_rules.map(|(rule, _, alarm)| (rule, alarm)).collect();
        rules.extend(of_rules.iter().map(|(rule, _)| *rule));
        let of_codes = control.codes().flat_map(|code| &code.entry().alarms).filter(is_it);
        let of_commands = control.system_commands().map(SystemCommands::alarms).into_iter().flatten();
        let all =
            of_rules.into_iter().map(|(_, alarm)| alarm).chain(of_codes).chain(of_commands.filter(is_it));
        for alarm in all {
            let meaning = (alarm.text.clone(), control.name());
            if !meanings.contains(&meaning) {
                meanings.push(meaning);
            }
        }
    }
    if meanings.is_empty() {
        return Ok(None);
    }
    let table = by_meaning(meanings.iter().map(|(text, control)| (text.as_str(), *control)));
    let mut page = format!("{}: an answer of the control\n\n{table}", subject.to_ascii_lowercase());
    if !rules.is_empty() {
        // Writing to a string cannot fail.
        let _ = writeln!(page, "\nReported by {}.", rules.into_iter().collect::<Vec<_>>().join(", "));
    }
    Ok(Some(page))
}

/// A number without its letter: which codes there are of it.
fn without_letter(subject: &str) -> Problem {
    let is_known = |name: &String| {
        CodeNumber::parse(name).is_some_and(|number| all_controls().any(|c| c.code(number).is_some()))
    };
    let names = ["G", "M"].into_iter().map(|letter| format!("{letter}{subject}"));
    let codes: Vec<String> = names.filter(is_known).map(|name| format!("`{name}`")).collect();
    let near =
        if codes.is_empty() { String::new() } else { format!("; did you mean {}?", codes.join(" or ")) };
    Problem::new(format!("`{subject}` is neither a rule nor a code{near}"))
        .help("`gcheck rules` and `gcheck codes` list them")
}

/// What an address means on the controls.
fn explain_address(global: &Global, letter: Letter) -> Result<u8, Problem> {
    let chosen = chosen_control(global)?;
    let controls: Vec<Arc<Control>> = chosen.map_or_else(|| all_controls().collect(), |one| vec![one]);
    let named =
        controls.iter().filter_map(|control| Some((control.letter(letter)?.is.as_str(), control.name())));
    let meanings = by_meaning(named);
    if meanings.is_empty() {
        return Err(Problem::new(format!("no control that gcheck knows has the address `{letter}`")));
    }
    output::print(&format!("{letter}: an address\n\n{meanings}"))
}

/// A line for each meaning, with the controls that read it so.
fn by_meaning<'c>(named: impl Iterator<Item = (&'c str, &'c str)>) -> String {
    let mut meanings: Vec<(&str, Vec<&str>)> = Vec::new();
    for (meaning, control) in named {
        match meanings.iter_mut().find(|(known, _)| *known == meaning) {
            Some((_, controls)) => controls.push(control),
            None => meanings.push((meaning, vec![control])),
        }
    }
    // What most controls read comes first.
    meanings.sort_by_key(|(_, controls)| std::cmp::Reverse(controls.len()));
    let row = |(meaning, controls): (&str, Vec<&str>)| vec![format!("  {meaning}"), controls.join(", ")];
    columns(&meanings.into_iter().map(row).collect::<Vec<_>>())
}

fn explain_code(global: &Global, number: CodeNumber) -> Result<u8, Problem> {
    let having: Vec<Arc<Control>> = all_controls().filter(|control| control.code(number).is_some()).collect();
    let others =
        |own: &str| -> Vec<&str> { having.iter().map(|c| c.name()).filter(|name| *name != own).collect() };
    let chosen = chosen_control(global)?;
    let control = match (&chosen, having.as_slice()) {
        (Some(control), _) | (None, [control]) => control,
        (None, []) => return Err(Problem::new(format!("no control that gcheck knows has `{number}`"))),
        // Nobody named a control, and a code is not the same on all of them.
        (None, [first, ..]) => {
            let title =
                |control: &'_ Arc<Control>| control.code(number).map(|code| code.entry().title.clone());
            let named: Vec<(String, &str)> =
                having.iter().filter_map(|control| Some((title(control)?, control.name()))).collect();
            let meanings = by_meaning(named.iter().map(|(title, name)| (title.as_str(), *name)));
            return output::print(&format!(
                "{number} on {} controls\n\n{meanings}\n`gcheck explain {number} --control {}` prints its words, \
                 alarms and source there.\n",
                having.len(),
                first.name()
            ));
        }
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
        // Writing to a string cannot fail.
        let _ = writeln!(page, "Also a code of {}.", others.join(", "));
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
        without_fences(&meta.docs())
    )
}

/// Markdown for a terminal: programs are indented, and the fences around them are left out.
fn without_fences(docs: &str) -> String {
    let mut text = String::with_capacity(docs.len());
    let mut is_program = false;
    for line in docs.lines() {
        if line.starts_with("```") {
            is_program = !is_program;
            // A blank line before a program and after it.
            if !text.is_empty() && !text.ends_with("\n\n") {
                text.push('\n');
            }
            continue;
        }
        if is_program && !line.is_empty() {
            text.push_str("    ");
        }
        text.push_str(line);
        text.push('\n');
    }
    text
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
