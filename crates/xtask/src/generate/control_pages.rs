//! `docs/controls/`: what the knowledge base holds on each control, with how sure every fact is.
//!
//! Knows: the shape of the pages. Must not know: any control.

use std::fmt::Write as _;
use std::path::Path;

use gcheck_controls::{
    Access, Confidence, Control, LetterEntry, Limits, LineCounts, Machine, Motion, Need, NumberRules,
    OverrideSwitch, Semicolon, SyntaxRules, Unpointed, VariableEntry, VariableKind, WordEntry, load, names,
};

use super::generated::Generated;
use super::markdown;

const FOLDER: &str = "docs/controls";
const DATA: &str = "crates/gcheck-controls/data";

/// All pages.
pub(super) fn generate() -> anyhow::Result<Generated> {
    let mut files = Generated::new();
    let mut rows = Vec::new();
    for name in names() {
        let control = load(name)?;
        rows.push(index_row(&control));
        files.push((Path::new(FOLDER).join(format!("{name}.md")), page(&control)));
    }
    let mut index = markdown::header(DATA);
    index.push_str("# Controls\n\nWhat gcheck knows about each control.\n");
    index.push_str("`manual` facts are in a manual or in the control's own source, `observed` ones were seen in real programs, ");
    index.push_str("`assumed` ones are general knowledge and never the ground of an error.\n\n");
    index.push_str(&markdown::table(&["control", "for", "G codes", "M codes", "by confidence"], &rows));
    files.push((Path::new(FOLDER).join("README.md"), index));
    Ok(files)
}

fn index_row(control: &Control) -> Vec<String> {
    let count =
        |letter: u8| control.codes().filter(|code| code.number().letter() == letter).count().to_string();
    let sure: Vec<String> = [Confidence::Manual, Confidence::Observed, Confidence::Assumed]
        .into_iter()
        .map(|confidence| {
            let count = control.codes().filter(|code| code.entry().confidence == confidence).count();
            format!("{count} {}", confidence_name(confidence))
        })
        .collect();
    let link = format!("[{name}]({name}.md)", name = control.name());
    vec![link, control.title().to_owned(), count(b'G'), count(b'M'), sure.join(", ")]
}

fn page(control: &Control) -> String {
    let mut text = markdown::header(&format!("{DATA}/{} and its bases", control.name()));
    let machine = match control.machine() {
        Machine::Mill => "A mill",
        Machine::Lathe => "A lathe (`X` is a diameter)",
    };
    let axes: Vec<String> = control.axes().iter().map(|axis| axis.to_string()).collect();
    let _ = writeln!(
        text,
        "# {}\n\n{}. {machine}; axes {}.\n",
        control.name(),
        control.title(),
        markdown::codes(axes)
    );
    text.push_str("Whatever gcheck says about a program for this control rests on the facts below.\n");
    text.push_str("The certainty of a fact is beside it: see [the list of controls](README.md).\n");
    section(&mut text, "How text is read", &syntax(control.syntax()));
    section(&mut text, "How numbers are read", &numbers(control.numbers()));
    section(&mut text, "Limits", &limits(control.limits()));
    section(&mut text, "Order of execution in a block", &format!("{}.\n", control.phases().join(", ")));
    section(&mut text, "Modal groups", &groups(control));
    section(&mut text, "G codes", &codes(control, b'G'));
    section(&mut text, "M codes", &codes(control, b'M'));
    section(&mut text, "Addresses", &letters(control));
    section(&mut text, "Variables", &variables(control.variables()));
    section(&mut text, "Functions", &functions(control));
    section(&mut text, "Settings", &settings(control));
    section(&mut text, "Alarms of findings", &alarms(control));
    section(&mut text, "References", &references(control));
    text
}

fn section(text: &mut String, title: &str, content: &str) {
    if !content.is_empty() {
        let _ = write!(text, "\n## {title}\n\n{content}");
    }
}

fn syntax(rules: &SyntaxRules) -> String {
    let semicolon = match rules.semicolon {
        Semicolon::Comment => "a comment to the end of the line",
        Semicolon::EndOfBlock => "the end of the block",
    };
    let facts = [
        ("blanks inside numbers", rules.blanks_in_numbers),
        ("O-words (`O100 SUB`)", rules.o_words),
        ("macro statements (`IF`, `WHILE`)", rules.macro_statements),
        ("variables (`#1`) and expressions", rules.variables),
        ("named parameters (`#<name>`)", rules.named_parameters),
        ("expressions without brackets", rules.bare_expressions),
        ("several assignments in a block", rules.several_assignments),
        ("`:1234` as a program number", rules.colon_program),
        ("`O1234` as a program number", rules.program_number),
        ("block delete (`/`)", rules.block_delete),
        ("block delete levels (`/1` to `/9`)", rules.block_delete_levels),
        ("`/` after the first word", rules.block_delete_inside),
        ("lower-case letters", rules.lower_case),
        ("`**`", rules.power_operator),
        ("tape marks (`%`)", !rules.tape_marks_refused),
        ("lines for the firmware (`$H`)", rules.system_commands),
    ];
    let mut rows = vec![vec!["`;`".to_owned(), semicolon.to_owned()]];
    rows.extend(facts.map(|(what, has)| vec![what.to_owned(), if has { "yes" } else { "no" }.to_owned()]));
    markdown::table(&["form", "read"], &rows)
}

fn numbers(rules: &NumberRules) -> String {
    let unpointed = match rules.unpointed {
        Unpointed::LeastIncrement => "one least increment",
        Unpointed::AsWritten => "the number as it is written",
        Unpointed::ByParameter => "either, by a parameter",
    };
    let mut text = format!("A length without a decimal point (`X1`) is {unpointed}");
    if let Some(setting) = &rules.unpointed_setting {
        let _ = write!(text, "; {setting} changes this");
    }
    let _ = write!(
        text,
        ".\nLeast increments: {} inch, {} mm, {} degrees.\n",
        rules.least_inch, rules.least_mm, rules.least_angle
    );
    if let Some(digits) = rules.max_digits {
        let sure = rules.max_digits_confidence.unwrap_or(rules.confidence);
        let _ = writeln!(text, "At most {digits} digits ({}).", confidence_name(sure));
    }
    let _ = writeln!(text, "Source: {} ({}).", rules.source, confidence_name(rules.confidence));
    text
}

fn limits(limits: &Limits) -> String {
    let range = |[low, high]: [u32; 2]| format!("{low} to {high}");
    let facts = [
        (
            "characters in a line",
            limits.line_length.map(|n| match limits.line_counts {
                LineCounts::Everything => n.to_string(),
                LineCounts::Code => format!("{n}, without blanks and comments"),
            }),
        ),
        ("M codes in a block", limits.m_codes_per_block.map(|n| n.to_string())),
        ("nesting of brackets", limits.bracket_depth.map(|n| n.to_string())),
        ("nesting of calls", limits.call_depth.map(|n| n.to_string())),
        ("highest sequence number", limits.max_sequence_number.map(|n| n.to_string())),
        ("program numbers", limits.program_numbers.map(range)),
        ("feed override", limits.feed_override.as_ref().map(OverrideSwitch::positions)),
        ("numbers after `DO`", limits.do_numbers.map(|[low, high]| range([low.into(), high.into()]))),
    ];
    let rows: Vec<Vec<String>> =
        facts.into_iter().filter_map(|(what, value)| Some(vec![what.to_owned(), value?])).collect();
    let mut text = markdown::table(&["limit", "value"], &rows);
    if let Some(source) = limits.source.as_ref().filter(|_| !rows.is_empty()) {
        let _ = writeln!(text, "\nSource: {source}.");
    }
    text
}

/// What the control answers to what rules find.
fn alarms(control: &Control) -> String {
    let rows: Vec<Vec<String>> = control
        .alarms_of_rules()
        .map(|(rule, of, alarm)| {
            vec![
                format!("[{rule}](../rules/{rule}.md)"),
                markdown::codes(of.to_vec()),
                alarm.number.clone().unwrap_or_default(),
                alarm.text.clone(),
                confidence_name(alarm.confidence).to_owned(),
            ]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    markdown::table(&["finding", "of", "alarm", "meaning", "confidence"], &rows)
}

fn groups(control: &Control) -> String {
    let rows: Vec<Vec<String>> = control
        .groups()
        .iter()
        .map(|group| {
            vec![
                format!("`{}`", group.id),
                group.number.clone().unwrap_or_default(),
                group.title.clone(),
                if group.modal { "yes" } else { "no" }.to_owned(),
                group.default.as_ref().map(|code| format!("`{code}`")).unwrap_or_default(),
                confidence_name(group.confidence).to_owned(),
            ]
        })
        .collect();
    markdown::table(&["group", "number", "decides", "modal", "at power-on", "confidence"], &rows)
}

fn codes(control: &Control, letter: u8) -> String {
    let rows: Vec<Vec<String>> = control
        .codes()
        .filter(|code| code.number().letter() == letter)
        .map(|code| {
            let entry = code.entry();
            let words: Vec<String> = entry.words.iter().map(word).collect();
            let mut title = entry.title.clone();
            if let Some(option) = &entry.option {
                let _ = write!(title, " (option: {option})");
            }
            vec![
                format!("`{}`", entry.code),
                title,
                format!("`{}`", entry.group),
                motion_name(entry.motion).to_owned(),
                if entry.any_words { "any".to_owned() } else { words.join(" ") },
                format!("`{}`", entry.example),
                confidence_name(entry.confidence).to_owned(),
                entry.source.clone(),
            ]
        })
        .collect();
    markdown::table(&["code", "title", "group", "moves", "words", "example", "confidence", "source"], &rows)
}

/// A word with its need: `X`, required; `[X]`, optional; `X?`, depends.
fn word(entry: &WordEntry) -> String {
    match entry.need {
        Need::Required => format!("`{}`", entry.letter),
        Need::Modal | Need::Conditional => format!("`{}?`", entry.letter),
        Need::Optional => format!("`[{}]`", entry.letter),
    }
}

fn letters(control: &Control) -> String {
    let entries = ('A'..='Z')
        .map(|letter| letter.to_string())
        .chain([",A", ",C", ",R", "@", "^", "$"].map(str::to_owned))
        .filter_map(|name| control.letter(gcheck_controls::Letter::parse(&name)?));
    let rows: Vec<Vec<String>> = entries
        .map(|entry: &LetterEntry| {
            vec![
                format!("`{}`", entry.letter),
                entry.is.clone(),
                bounds(entry.min, entry.max),
                if entry.scaled { "scales" } else { "" }.to_owned(),
                confidence_name(entry.confidence).to_owned(),
                entry.source.clone(),
            ]
        })
        .collect();
    markdown::table(&["address", "meaning", "range", "without a point", "confidence", "source"], &rows)
}

fn bounds(min: Option<f64>, max: Option<f64>) -> String {
    match (min, max) {
        (None, None) => String::new(),
        (Some(min), None) => format!("from {min}"),
        (None, Some(max)) => format!("to {max}"),
        (Some(min), Some(max)) => format!("{min} to {max}"),
    }
}

fn variables(entries: &[VariableEntry]) -> String {
    let mut entries: Vec<&VariableEntry> = entries.iter().collect();
    entries.sort_by(|a, b| (&a.range, &a.name).cmp(&(&b.range, &b.name)));
    let rows: Vec<Vec<String>> = entries
        .into_iter()
        .map(|entry| {
            let name = match (entry.range, &entry.name) {
                (Some([first, last]), _) if first == last => format!("`#{first}`"),
                (Some([first, last]), _) => format!("`#{first}`–`#{last}`"),
                (None, name) => format!("`#<{}>`", name.as_deref().unwrap_or_default()),
            };
            let access = match entry.access {
                Access::ReadWrite => "read, write",
                Access::Read => "read",
                Access::Write => "write",
            };
            let kind = match entry.kind {
                VariableKind::Local => "one macro level",
                VariableKind::Common => "until power off",
                VariableKind::Retained => "over power off",
                VariableKind::System => "the control's own",
            };
            vec![
                name,
                entry.title.clone(),
                access.to_owned(),
                kind.to_owned(),
                confidence_name(entry.confidence).to_owned(),
                entry.source.clone(),
            ]
        })
        .collect();
    markdown::table(&["variable", "holds", "programs may", "lives", "confidence", "source"], &rows)
}

fn functions(control: &Control) -> String {
    let rows: Vec<Vec<String>> = control
        .functions()
        .iter()
        .map(|entry| {
            let name = format!("`{}`", entry.name);
            vec![
                name,
                entry.title.clone(),
                confidence_name(entry.confidence).to_owned(),
                entry.source.clone(),
            ]
        })
        .collect();
    markdown::table(&["function", "gives", "confidence", "source"], &rows)
}

fn settings(control: &Control) -> String {
    let rows: Vec<Vec<String>> = control
        .settings()
        .iter()
        .map(|entry| {
            vec![
                entry.number.clone(),
                entry.title.clone(),
                entry.values.join(", "),
                entry.default.clone().unwrap_or_default(),
                entry.changes.clone(),
                confidence_name(entry.confidence).to_owned(),
                entry.source.clone(),
            ]
        })
        .collect();
    markdown::table(&["setting", "name", "values", "assumed", "changes", "confidence", "source"], &rows)
}

fn references(control: &Control) -> String {
    let rows: Vec<Vec<String>> =
        control.references().iter().map(|entry| vec![entry.id.clone(), entry.title.clone()]).collect();
    markdown::table(&["in `source`", "is"], &rows)
}

fn confidence_name(confidence: Confidence) -> &'static str {
    match confidence {
        Confidence::Manual => "manual",
        Confidence::Observed => "observed",
        Confidence::Assumed => "assumed",
    }
}

fn motion_name(motion: Motion) -> &'static str {
    match motion {
        Motion::None => "",
        Motion::Rapid => "rapid",
        Motion::Feed => "feed",
        Motion::Arc => "arc",
        Motion::Thread => "thread",
        Motion::Cycle => "cycle",
        Motion::Operation => "operation",
        Motion::Probe => "probe",
        Motion::Reference => "reference",
        Motion::Dwell => "dwell",
        Motion::Curve => "curve",
    }
}
