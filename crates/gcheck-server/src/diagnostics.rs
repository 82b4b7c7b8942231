//! Findings as the protocol's diagnostics.
//!
//! Knows: severities, tags, places of the protocol. Must not know: when findings are worked out.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::str::FromStr as _;
use std::time::Duration;

use gcheck_db::Snapshot;
use gcheck_diagnostics::{RuleMeta, Severity};
use gcheck_ide::Diagnostics;

use crate::ConfigurationProblem;
use crate::client::Abilities;
use crate::documents::Document;
use crate::position::{Encoding, Places};
use crate::proto::{
    CodeDescription, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Location,
    NumberOrString, Position, Range, Uri,
};

/// What the client calls us.
const SOURCE: &str = "gcheck";
/// The code of a diagnostic that says that the analysis was given up; it is the rule's that says so on the command line.
const INCOMPLETE: &str = "analysis-incomplete";
/// Rules named when findings are too many to be shown.
const NAMED: usize = 5;

/// The diagnostics of a document; `elsewhere` finds a place in another file.
pub(crate) fn convert(
    abilities: &Abilities,
    uri: &Uri,
    snapshot: &Snapshot,
    shown: &Diagnostics,
    elsewhere: &mut dyn FnMut(&Path, &std::ops::Range<u32>) -> Option<Location>,
) -> Vec<Diagnostic> {
    let mut places = Places::new(snapshot, abilities.encoding);
    let mut list = Vec::with_capacity(shown.list.len());
    for found in &shown.list {
        let related = abilities.related_information.then(|| {
            let mut related = Vec::new();
            for other in &found.related {
                let location = match &other.file {
                    None => Some(Location::new(uri.clone(), places.range(&other.range))),
                    Some(file) => elsewhere(Path::new(&**file), &other.range),
                };
                let message = other.message.clone();
                related.extend(location.map(|location| DiagnosticRelatedInformation { location, message }));
            }
            related
        });
        let docs = abilities.code_description.then(|| Uri::from_str(&found.docs).ok()).flatten();
        list.push(Diagnostic {
            range: places.range(&found.range),
            severity: Some(severity(found.severity)),
            code: Some(NumberOrString::String(found.rule.to_owned())),
            code_description: docs.map(|href| CodeDescription { href }),
            source: Some(SOURCE.to_owned()),
            message: match &found.repeats {
                None => found.message.clone(),
                Some(repeats) => {
                    let lines = [found.range.start, repeats.last]
                        .map(|byte| places.range(&(byte..byte)).start.line + 1);
                    folded(repeats.count, lines, found.rule, &found.message)
                }
            },
            related_information: related.filter(|related| !related.is_empty()),
            tags: (abilities.diagnostic_tags && found.unnecessary).then(|| vec![DiagnosticTag::UNNECESSARY]),
            data: None,
        });
    }
    if !shown.omitted.is_empty() {
        list.push(at_the_top(DiagnosticSeverity::INFORMATION, omitted(shown)));
    }
    list
}

fn severity(severity: Severity) -> DiagnosticSeverity {
    match severity {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
        Severity::Info => DiagnosticSeverity::INFORMATION,
        Severity::Hint => DiagnosticSeverity::HINT,
    }
}

/// Says how often a rule repeats, between which lines, and how each of its findings is shown.
fn folded(count: usize, [first, last]: [u32; 2], rule: &str, summary: &str) -> String {
    let lines = if first == last { format!("line {first}") } else { format!("lines {first} to {last}") };
    format!(
        "… and {count} more of {rule}, {lines}\n{summary}\nhelp: the setting `gcheck.foldRepeats` set to `false` shows each of them"
    )
}

/// Says how many findings are not shown.
fn omitted(shown: &Diagnostics) -> String {
    let count: usize = shown.omitted.iter().map(|omitted| omitted.count).sum();
    let named: Vec<String> = shown
        .omitted
        .iter()
        .take(NAMED)
        .map(|omitted| format!("{} {} times", omitted.rule, omitted.count))
        .collect();
    let more = if shown.omitted.len() > NAMED { ", and others" } else { "" };
    let findings = if count == 1 { "1 more finding is" } else { &format!("{count} more findings are") };
    format!("{findings} not shown: {}{more}; `gcheck check` shows them", named.join(", "))
}

/// Says that the analysis did not come to its end, so that an empty list is not taken for a program without mistakes.
pub(crate) fn given_up(after: Duration) -> Diagnostic {
    let message = format!(
        "the analysis was given up after {} s, so mistakes of this program are not shown; `gcheck check` takes more time, and \
         says where the time goes",
        after.as_secs()
    );
    let code = Some(NumberOrString::String(INCOMPLETE.to_owned()));
    Diagnostic { code, ..at_the_top(DiagnosticSeverity::WARNING, message) }
}

/// Says that a rule failed, so that its silence is not taken for a program without its mistakes.
pub(crate) fn failed(rule: &RuleMeta) -> Diagnostic {
    let message = format!(
        "the rule `{}` failed by a mistake in gcheck: its findings in this program are missing",
        rule.id
    );
    let code = Some(NumberOrString::String(rule.id.to_owned()));
    Diagnostic { code, ..at_the_top(DiagnosticSeverity::WARNING, message) }
}

fn at_the_top(severity: DiagnosticSeverity, message: String) -> Diagnostic {
    Diagnostic { severity: Some(severity), source: Some(SOURCE.to_owned()), message, ..Diagnostic::default() }
}

/// What keeps a program from being checked, among its own diagnostics.
pub(crate) fn of_problems(document: &Document, encoding: Encoding, snapshot: &Snapshot) -> Vec<Diagnostic> {
    let mut places = Places::new(snapshot, encoding);
    let mut list = Vec::new();
    for problem in &document.in_force.problems {
        if problem.path.as_ref() == Some(&document.path) {
            let line = snapshot.line_range(problem.line);
            let start = line.start + bytes_of(&snapshot.slice(line.clone()), problem.column);
            let end = start + bytes_of(&snapshot.slice(start..line.end.max(start)), problem.length);
            let range = places.range(&(start..end));
            list.push(Diagnostic { range, ..at_the_top(DiagnosticSeverity::ERROR, problem.message.clone()) });
        } else if document.in_force.settings.is_none() {
            let place = problem
                .path
                .as_ref()
                .map_or_else(String::new, |path| format!("{}:{}: ", path.display(), problem.line + 1));
            let message = format!(
                "this program is not checked, because its configuration cannot be read: {place}{}",
                problem.message
            );
            list.push(at_the_top(DiagnosticSeverity::ERROR, message));
        }
    }
    list
}

/// Bytes of the first characters of a text.
fn bytes_of(text: &str, characters: u32) -> u32 {
    text.chars().take(characters as usize).map(|c| c.len_utf8() as u32).sum()
}

/// What is wrong with configuration files, by file.
pub(crate) fn of_configurations<'p>(
    problems: impl Iterator<Item = &'p ConfigurationProblem>,
) -> BTreeMap<PathBuf, Vec<Diagnostic>> {
    let mut by_file: BTreeMap<PathBuf, Vec<Diagnostic>> = BTreeMap::new();
    for problem in problems {
        let Some(path) = &problem.path else { continue };
        let start = Position::new(problem.line, problem.column);
        let end = Position::new(problem.line, problem.column + problem.length);
        let found = Diagnostic {
            range: Range { start, end },
            ..at_the_top(DiagnosticSeverity::ERROR, problem.message.clone())
        };
        let list = by_file.entry(path.clone()).or_default();
        // All programs under one configuration say the same of it.
        if !list.contains(&found) {
            list.push(found);
        }
    }
    by_file
}
