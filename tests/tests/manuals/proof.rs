//! What proves that gcheck keeps to a sentence of a manual.
//!
//! Knows: programs, kinds of proof. Must not know: sentences, how the product is reached.

use std::fmt::Write as _;

use serde_json::Value;

use gcheck_tests::canonical::{End, Outcome, compare, hold_in_order};

use crate::{interpreter, product};

/// A program and where it runs.
#[derive(Clone, Copy)]
pub(crate) struct Program {
    pub(crate) control: &'static str,
    pub(crate) text: &'static str,
    /// Keys of a configuration: `machine.bar_length=1000`.
    pub(crate) config: &'static [&'static str],
    /// Programs in other files of the same folder, or below it: name and text.
    pub(crate) files: &'static [(&'static str, &'static str)],
    /// A run passes over the blocks with a slash.
    pub(crate) skips: bool,
}

impl Program {
    /// With keys of a configuration.
    pub(crate) const fn with(self, config: &'static [&'static str]) -> Self {
        Self { config, ..self }
    }

    /// With programs in other files of the same folder, or below it.
    pub(crate) const fn beside(self, files: &'static [(&'static str, &'static str)]) -> Self {
        Self { files, ..self }
    }

    /// With block delete on.
    pub(crate) const fn skipping(self) -> Self {
        Self { skips: true, ..self }
    }
}

/// A program for a control.
pub(crate) const fn on(control: &'static str, text: &'static str) -> Program {
    Program { control, text, config: &[], files: &[], skips: false }
}

/// What proves a sentence of a manual.
pub(crate) enum Proof {
    /// A rule speaks of the first program and is silent about the second. It is named with its severity:
    /// `error[dwell-zero]`.
    Rule { finding: &'static str, violates: Program, conforms: Program },
    /// The program is legal: no finding of warning or error.
    Legal { program: Program },
    /// `gcheck run --output-format text` prints these lines, in this order, with others between them. Runs of blanks
    /// count as one.
    Run { program: Program, prints: &'static [&'static str] },
    /// `gcheck run` makes exactly these moves, each by its kind and the words that count: `feed X1. Z-0.5 F10.`.
    ///
    /// `X` to `W` are where it ends in work coordinates and, after an `M`, in machine coordinates (`MX-4.`); `I J K` the
    /// centre of an arc, `S` its degrees, `F` the feed, `T` seconds, `N` the line. `?` is an unknown number. A word
    /// that is left out may be anything.
    Moves { program: Program, are: &'static [&'static str] },
    /// `gcheck run` is stopped with these words.
    Stops { program: Program, says: &'static str },
    /// These errors and warnings and no others, each with its line: `error[feed-missing] 3`.
    Reports { program: Program, findings: &'static [&'static str] },
    /// Message, label, note, help or assumption of this finding (`error[feed-missing]`) has these words, or it names this
    /// alarm of the control.
    Says { program: Program, finding: &'static str, words: &'static str },
    /// `gcheck stats` prints these lines, likewise.
    Stats { program: Program, prints: &'static [&'static str] },
    /// The installed LinuxCNC interpreter and `gcheck run` print the same canonical functions, and come to the program's end;
    /// these are among them, in this order: `STRAIGHT_FEED(1.0000, 2.0000`. Without the interpreter only `gcheck run` is judged.
    AsInterpreter { program: Program, prints: &'static [&'static str] },
    /// The interpreter and `gcheck run` refuse the first program and run the second to its end, with the same functions; of
    /// the first a rule speaks, as in [`Proof::Rule`].
    Refused { finding: &'static str, violates: Program, conforms: Program },
    /// The interpreter and `gcheck run` refuse the program at the same block; whether `gcheck check` speaks is not judged.
    RunRefused { program: Program },
    /// `gcheck check` closes with this assumption.
    Assumes { program: Program, says: &'static str },
    /// The control's table, which hover, completion and rules read, lists each of these variables with this title and this
    /// access (`read`, `write`, `read-write`).
    Variables { control: &'static str, numbers: [u32; 2], title: &'static str, access: &'static str },
    /// `gcheck explain` (and so hover) says this of a code.
    Explains { control: &'static str, code: &'static str, says: &'static str },
    /// A rule is silent about a program, whatever others say.
    Silent { rule: &'static str, program: Program },
    /// The block with exactly this text makes these events and no others, in this order: moves as in [`Proof::Moves`], of
    /// which every axis that moves is named, and `dwell T0.5`, `spindle clockwise`, `spindle 900`, `coolant flood-on`,
    /// `tool 12`. The last of four decimals counts.
    Makes { program: Program, block: &'static str, events: &'static [&'static str] },
    /// After the block with exactly this text the axes are here, in the words of [`Proof::Moves`]: `X1 MZ-4.5`.
    Stands { program: Program, after: &'static str, at: &'static str },
    /// Two programs make the same events.
    Same { one: Program, other: Program },
    /// Some rule of this severity (`warning`) or a higher one speaks of the first program and is silent about the second.
    /// For what has no rule yet: a proof that holds names its rule.
    Noticed { least: &'static str, violates: Program, conforms: Program },
    /// `gcheck check` refuses the configuration, in these words.
    Refuses { program: Program, says: &'static str },
    /// `gcheck check` takes the configuration.
    Accepts { program: Program },
    /// What the manual demands and gcheck does not do yet, with the sentence that a reader gets. The proof fails when the
    /// demand is met.
    Open { says: &'static str, demand: &'static Proof },
}

/// A rule speaks of the first program and is silent about the second.
pub(crate) const fn rule(finding: &'static str, violates: Program, conforms: Program) -> Proof {
    Proof::Rule { finding, violates, conforms }
}

/// No finding of warning or error.
pub(crate) const fn legal(program: Program) -> Proof {
    Proof::Legal { program }
}

/// A run prints these lines.
pub(crate) const fn run(program: Program, prints: &'static [&'static str]) -> Proof {
    Proof::Run { program, prints }
}

/// Two programs make the same events.
pub(crate) const fn same(one: Program, other: Program) -> Proof {
    Proof::Same { one, other }
}

/// Some warning or error about the first program and none about the second.
pub(crate) const fn noticed(least: &'static str, violates: Program, conforms: Program) -> Proof {
    Proof::Noticed { least, violates, conforms }
}

/// What gcheck does not do yet.
#[expect(dead_code, reason = "no proof is open; the next one that is found is stated with this")]
pub(crate) const fn open(says: &'static str, demand: &'static Proof) -> Proof {
    Proof::Open { says, demand }
}

/// Does the product do what the proof demands? If not, what it does instead.
pub(crate) fn holds(proof: &Proof) -> Result<(), String> {
    match proof {
        Proof::Rule { finding, violates, conforms } => {
            let rule = finding.split_once('[').map_or(*finding, |(_, rest)| rest.trim_end_matches(']'));
            let found = product::check(violates);
            if !found.contains(&(*finding).to_owned()) {
                return Err(format!("{finding} is not reported in\n{}\nbut {found:?}", violates.text));
            }
            let found = product::check(conforms);
            let same = |other: &String| other.ends_with(&format!("[{rule}]"));
            if found.iter().any(same) {
                return Err(format!("{rule} is reported in\n{}", conforms.text));
            }
            Ok(())
        }
        Proof::Legal { program } => {
            let found = product::check(program);
            let grave = |one: &String| one.starts_with("error") || one.starts_with("warning");
            if found.iter().any(grave) {
                return Err(format!("{found:?} in\n{}", program.text));
            }
            Ok(())
        }
        Proof::Run { program, prints } => in_order(&product::run(program), prints),
        Proof::Moves { program, are } => moves(program, are),
        Proof::Stops { program, says } => {
            let why = squeeze(&product::stopped(program).unwrap_or_default());
            if why.contains(&squeeze(says)) {
                return Ok(());
            }
            Err(format!("stops for {why:?}, not for {says:?}, in\n{}", program.text))
        }
        Proof::Reports { program, findings } => {
            let found: Vec<String> = product::findings(program)
                .iter()
                .filter(|one| matches!(one["severity"].as_str(), Some("error" | "warning")))
                .map(|one| format!("{} {}", product::severity_and_rule(one), one["range"]["start"]["line"]))
                .collect();
            if found == *findings { Ok(()) } else { Err(format!("{found:?} in\n{}", program.text)) }
        }
        Proof::Says { program, finding, words } => says(program, finding, words),
        Proof::Stats { program, prints } => in_order(&product::stats(program), prints),
        Proof::AsInterpreter { program, prints } => as_interpreter(program, Some(prints)),
        Proof::Refused { finding, violates, conforms } => {
            as_interpreter(violates, None)?;
            as_interpreter(conforms, Some(&[]))?;
            holds(&Proof::Rule { finding, violates: *violates, conforms: *conforms })
        }
        Proof::RunRefused { program } => as_interpreter(program, None),
        Proof::Assumes { program, says } => {
            let assumed = product::assumptions(program);
            if assumed.iter().any(|one| one.contains(says)) {
                return Ok(());
            }
            Err(format!("assumes {assumed:?}, not {says:?}, in\n{}", program.text))
        }
        Proof::Variables { control, numbers: [first, last], title, access } => {
            let differs = (*first..=*last).find_map(|number| {
                let (is, may) = product::variable(control, number).unwrap_or_default();
                (!is.contains(title) || may != *access).then(|| format!("#{number}: {is:?}, {may}"))
            });
            differs.map_or(Ok(()), |one| Err(format!("not {title:?}, {access}, but {one}")))
        }
        Proof::Explains { control, code, says } => {
            let text = squeeze(&product::explain(control, code));
            if text.contains(&squeeze(says)) { Ok(()) } else { Err(format!("`{says}` is not in\n{text}")) }
        }
        Proof::Silent { rule, program } => {
            let found = product::check(program);
            let speaks = found.iter().any(|one| one.ends_with(&format!("[{rule}]")));
            if speaks { Err(format!("{found:?} in\n{}", program.text)) } else { Ok(()) }
        }
        Proof::Makes { program, block, events } => makes(program, block, events),
        Proof::Stands { program, after, at } => ends_at(program, after, at),
        Proof::Same { one, other } => makes_same(one, other),
        Proof::Noticed { least, violates, conforms } => is_noticed(least, violates, conforms),
        Proof::Refuses { program, says } => match product::refused(program) {
            Some(why) if squeeze(&why).contains(says) => Ok(()),
            why => Err(format!("{:?}: {why:?}, not {says:?}", program.config)),
        },
        Proof::Accepts { program } => match product::refused(program) {
            Some(why) => Err(format!("{:?}: {why}", program.config)),
            None => Ok(()),
        },
        Proof::Open { demand, .. } => match holds(demand) {
            Ok(()) => {
                Err(format!("this is open no longer: take the proof out of `open`\n{}", noticing(demand)))
            }
            Err(_) => Ok(()),
        },
    }
}

/// Does the proof speak of the installed interpreter, and there is none?
pub(crate) fn is_without_judge(proof: &Proof) -> bool {
    let judged =
        matches!(proof, Proof::AsInterpreter { .. } | Proof::Refused { .. } | Proof::RunRefused { .. });
    judged && interpreter::find().is_none()
}

/// The proof in a table of a page under `docs/`; `to_rules` leads from that page to the pages of the rules.
#[expect(clippy::match_same_arms, reason = "one arm a kind of proof")]
pub(crate) fn in_words(proof: &Proof, to_rules: &str) -> String {
    match proof {
        Proof::Rule { finding, .. } => rule_in_words(finding, to_rules),
        Proof::Legal { .. } | Proof::Reports { findings: [], .. } => "no finding".to_owned(),
        Proof::Run { .. } | Proof::Moves { .. } => "motion".to_owned(),
        Proof::Stops { says, .. } => format!("a run stops: “{says}”"),
        Proof::Reports { findings, .. } => {
            let rules = findings.iter().map(|one| rule_in_words(one.split(' ').next().unwrap(), to_rules));
            rules.collect::<Vec<_>>().join(", ")
        }
        Proof::Says { finding, words, .. } => format!("{}: “{words}”", rule_in_words(finding, to_rules)),
        Proof::Stats { .. } => "figures".to_owned(),
        Proof::AsInterpreter { .. } => "motion as the interpreter's".to_owned(),
        Proof::RunRefused { .. } => "a run is refused as by the interpreter".to_owned(),
        Proof::Refused { finding, .. } => {
            format!("refused as by the interpreter, {}", rule_in_words(finding, to_rules))
        }
        Proof::Assumes { says, .. } => format!("assumption “{says}”"),
        Proof::Variables { numbers: [first, last], .. } => format!("table of variables, #{first} to #{last}"),
        Proof::Explains { control, code, .. } => format!("explanation of `{code}` ({control})"),
        Proof::Silent { rule, .. } => format!("rule [`{rule}`]({to_rules}/{rule}.md) is silent"),
        Proof::Makes { .. } | Proof::Stands { .. } | Proof::Same { .. } => "motion".to_owned(),
        Proof::Noticed { .. } => "a finding".to_owned(),
        Proof::Refuses { says, .. } => format!("configuration refused: “{says}”"),
        Proof::Accepts { .. } => "configuration accepted".to_owned(),
        Proof::Open { says, .. } => format!("**open**: {says}"),
    }
}

fn rule_in_words(finding: &str, to_rules: &str) -> String {
    let (severity, rule) = finding.split_once('[').unwrap();
    let rule = rule.trim_end_matches(']');
    format!("rule [`{rule}`]({to_rules}/{rule}.md) ({severity})")
}

/// Exactly these moves: see [`Proof::Moves`].
fn moves(program: &Program, wanted: &[&str]) -> Result<(), String> {
    let made = product::moves(program);
    let shown = || made.iter().map(told).collect::<Vec<_>>().join("\n");
    if made.len() != wanted.len() {
        return Err(format!(
            "{} moves, not {}, in\n{}\nthey are\n{}",
            made.len(),
            wanted.len(),
            program.text,
            shown()
        ));
    }
    for (one, words) in made.iter().zip(wanted) {
        let mut words = words.split(' ');
        let kind = words.next().unwrap();
        if one["kind"].as_str() != Some(kind) || !words.all(|word| has(one, word)) {
            return Err(format!("`{}` in\n{}\nis among\n{}", told(one), program.text, shown()));
        }
    }
    Ok(())
}

/// Does a move have this word? Half a unit of the fifth decimal makes no difference.
fn has(one: &Value, word: &str) -> bool {
    has_within(one, word, 5e-6)
}

/// Does a move have this word, give or take so much?
fn has_within(one: &Value, word: &str, slack: f64) -> bool {
    let (name, number) = word.split_at(word.find(|at: char| !at.is_ascii_alphabetic()).unwrap());
    let number: Option<f64> = (number != "?").then(|| number.parse().unwrap());
    let is = of(one, name);
    match (is.as_f64(), number) {
        (Some(is), Some(number)) => (is - number).abs() < slack,
        (None, None) => is.is_null(),
        _ => false,
    }
}

/// What a word of [`Proof::Moves`] names.
fn of<'move_>(one: &'move_ Value, name: &str) -> &'move_ Value {
    match name {
        "F" => &one["feed"],
        "T" => &one["seconds"],
        "N" => &one["line"],
        "S" => &one["arc"]["sweep_deg"],
        "I" => &one["arc"]["centre"]["X"],
        "J" => &one["arc"]["centre"]["Y"],
        "K" => &one["arc"]["centre"]["Z"],
        _ => match name.strip_prefix('M') {
            Some(axis) => &one["machine"][axis],
            None => &one["to"][name],
        },
    }
}

/// A move as [`Proof::Moves`] writes it, with what is known of it.
fn told(one: &Value) -> String {
    let mut text = one["kind"].as_str().unwrap().to_owned();
    for name in ["X", "Y", "Z", "A", "B", "C", "S", "F", "N"] {
        if !of(one, name).is_null() {
            let _ = write!(text, " {name}{}", of(one, name));
        }
    }
    text
}

/// What numbers with four decimals cannot tell apart.
const FOURTH_DECIMAL: f64 = 5.1e-5;

/// Exactly these events of a block: see [`Proof::Makes`].
fn makes(program: &Program, block: &str, wanted: &[&str]) -> Result<(), String> {
    let line = line_of(program, block)?;
    let mut made = product::events(program);
    made.retain(|one| one["line"] == line);
    if made.len() == wanted.len() && made.iter().zip(wanted).all(|(one, words)| is_event(one, words)) {
        return Ok(());
    }
    let made: Vec<String> = made.iter().map(Value::to_string).collect();
    Err(format!("`{block}` makes\n{}\nnot {wanted:?} in\n{}", made.join("\n"), program.text))
}

/// Where the axes are after a block: see [`Proof::Is`].
fn ends_at(program: &Program, after: &str, at: &str) -> Result<(), String> {
    let line = line_of(program, after)?;
    let moves = product::moves(program);
    let Some(last) = moves.iter().rfind(|one| one["line"] == line) else {
        return Err(format!("`{after}` moves nothing in\n{}", program.text));
    };
    if at.split(' ').all(|word| has_within(last, word, FOURTH_DECIMAL)) {
        return Ok(());
    }
    Err(format!("`{after}` ends at {last}, not {at} in\n{}", program.text))
}

/// Is there a finding of this severity or a higher one, of a rule that the second program does not meet?
fn is_noticed(least: &str, violates: &Program, conforms: &Program) -> Result<(), String> {
    let [found, quiet] = [violates, conforms].map(product::check);
    let grades = ["info", "warning", "error"];
    let grade = |one: &str| grades.iter().position(|grade| one.starts_with(grade));
    if let Some(grave) = quiet.iter().find(|one| grade(one) > grade("info")) {
        return Err(format!("{grave} in\n{}", conforms.text));
    }
    if found.iter().any(|one| grade(one) >= grade(least) && !quiet.contains(one)) {
        return Ok(());
    }
    Err(format!("no {least}, only {found:?} in\n{}", violates.text))
}

/// What a proof that names no rule is met by.
fn noticing(demand: &Proof) -> String {
    let Proof::Noticed { violates, conforms, .. } = demand else { return String::new() };
    format!("noticed: {:?}, not in the other: {:?}", product::check(violates), product::check(conforms))
}

/// The same events, from whatever line.
fn makes_same(one: &Program, other: &Program) -> Result<(), String> {
    let [one, other] = [one, other].map(|program| {
        let mut events = product::events(program);
        for event in &mut events {
            let fields = event.as_object_mut().unwrap();
            fields.remove("n");
            fields.remove("line");
        }
        events
    });
    if one == other && !one.is_empty() { Ok(()) } else { Err(format!("{one:?}\nand\n{other:?}")) }
}

/// The line of a block, from 1.
fn line_of(program: &Program, block: &str) -> Result<usize, String> {
    let found = program.text.lines().position(|line| line == block);
    found.map(|index| index + 1).ok_or_else(|| format!("there is no block `{block}` in\n{}", program.text))
}

/// Is it this event, in the words of [`Proof::Makes`]?
fn is_event(one: &Value, words: &str) -> bool {
    let (kind, rest) = words.split_once(' ').unwrap_or((words, ""));
    if one["kind"].as_str() != Some(kind) {
        return false;
    }
    let action = one["action"].as_str().unwrap_or_default();
    match (kind, action) {
        ("spindle", "speed") => rest.parse().ok() == one["rpm"].as_f64(),
        ("tool", _) => rest.parse().ok() == one["tool"].as_f64(),
        _ if one["to"].is_null() && kind != "dwell" => action == rest,
        _ => {
            let named = |axis: &str| rest.split(' ').any(|word| word.starts_with(axis));
            let moves = |axis: &str| match (one["from"][axis].as_f64(), one["to"][axis].as_f64()) {
                (Some(from), Some(to)) => (from - to).abs() >= 5e-5,
                (from, to) => from != to,
            };
            let axes = ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"];
            axes.iter().all(|axis| named(axis) || !moves(axis))
                && rest
                    .split(' ')
                    .filter(|word| !word.is_empty())
                    .all(|word| has_within(one, word, FOURTH_DECIMAL))
        }
    }
}

/// Does a finding say this?
fn says(program: &Program, finding: &str, words: &str) -> Result<(), String> {
    let all = product::findings(program);
    let texts: Vec<String> = all
        .iter()
        .filter(|one| product::severity_and_rule(one) == finding)
        .map(|one| {
            let parts = ["message", "label", "labels", "notes", "help", "alarm", "assumptions"];
            let texts = parts.iter().map(|part| match &one[part] {
                Value::String(text) => text.clone(),
                Value::Null => String::new(),
                other => other.to_string(),
            });
            texts.collect::<Vec<_>>().join("\n")
        })
        .collect();
    if texts.iter().any(|text| text.contains(words)) {
        return Ok(());
    }
    Err(format!("{finding} does not say {words:?} but {texts:?} in\n{}", program.text))
}

/// Both sides run the program alike: to its end, with these functions; without any given, to a refusal.
fn as_interpreter(program: &Program, prints: Option<&[&str]>) -> Result<(), String> {
    let (ours, reference) = interpreter::both(program);
    for (who, outcome) in [("the interpreter", reference.as_ref()), ("gcheck run", Some(&ours))] {
        let Some(Outcome { calls, end }) = outcome else { continue };
        let as_wanted = match prints {
            Some(_) => *end == End::Ended,
            None => matches!(end, End::Refused(_)),
        };
        if !as_wanted {
            return Err(format!("{who}: {end:?} in\n{}", program.text));
        }
        if !hold_in_order(calls, prints.unwrap_or_default()) {
            let calls: Vec<String> = calls.iter().map(ToString::to_string).collect();
            return Err(format!("{who} prints\n{}\nfor\n{}", calls.join("\n"), program.text));
        }
    }
    match reference.and_then(|reference| compare(&reference, &ours)) {
        Some(difference) => Err(format!("{} in\n{}", difference.text, program.text)),
        None => Ok(()),
    }
}

/// Each wanted text is in a line after the line of the one before.
fn in_order(output: &str, wanted: &[&str]) -> Result<(), String> {
    let mut lines = output.lines().map(squeeze);
    for text in wanted {
        if !lines.any(|line| line.contains(&squeeze(text))) {
            return Err(format!("`{text}` is not printed, or not in its place:\n{output}"));
        }
    }
    Ok(())
}

fn squeeze(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
