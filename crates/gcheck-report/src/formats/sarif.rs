//! `sarif`: SARIF 2.1.0, for code hosts and result viewers.
//!
//! Knows: the standard's objects that we fill, and the limits of the hosts that read them. Must not know: colours.
//!
//! Structures of our own instead of a crate for all of SARIF: we fill a tenth of it.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{self, Write};

use gcheck_diagnostics::{Finding, Fix, Label, RuleMeta, Severity};
use serde::Serialize;

use super::remarks::{HOME, remarks};
use crate::report::{File, Skipped};
use crate::shown::number;
use crate::source::Source;
use crate::{ControlChoice, Fingerprint, Report};

/// GitHub refuses a run with more results.
const MOST_RESULTS: usize = 25_000;
/// And a result with more locations.
const MOST_LOCATIONS: usize = 1_000;

const SCHEMA: &str =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
const SOURCE_ROOT: &str = "%SRCROOT%";

#[derive(Serialize)]
struct Log<'r> {
    #[serde(rename = "$schema")]
    schema: &'static str,
    version: &'static str,
    runs: [Run<'r>; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Run<'r> {
    tool: Tool,
    invocations: [Invocation<'r>; 1],
    original_uri_base_ids: BTreeMap<&'static str, UriBase>,
    artifacts: Vec<Artifact<'r>>,
    results: Vec<ResultObject<'r>>,
    newline_sequences: [&'static str; 3],
    column_kind: &'static str,
}

#[derive(Serialize)]
struct Tool {
    driver: Driver,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Driver {
    name: &'static str,
    version: &'static str,
    semantic_version: &'static str,
    information_uri: &'static str,
    rules: Vec<Rule>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Rule {
    id: &'static str,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    deprecated_ids: &'static [&'static str],
    short_description: Message,
    full_description: Message,
    help: Help,
    help_uri: String,
    default_configuration: RuleConfiguration,
    properties: RuleProperties,
}

#[derive(Serialize)]
struct Help {
    text: String,
    markdown: String,
}

#[derive(Serialize)]
struct RuleConfiguration {
    enabled: bool,
    level: &'static str,
}

#[derive(Serialize)]
struct RuleProperties {
    tags: [&'static str; 1],
    since: &'static str,
    /// GitHub sorts alerts by it.
    #[serde(rename = "problem.severity")]
    problem_severity: &'static str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Invocation<'r> {
    execution_successful: bool,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tool_execution_notifications: Vec<Notification<'r>>,
}

#[derive(Serialize)]
struct Notification<'r> {
    level: &'static str,
    message: Message,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    locations: Vec<Location<'r>>,
}

#[derive(Serialize)]
struct UriBase {
    description: Message,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Artifact<'r> {
    location: ArtifactLocation,
    roles: [&'static str; 1],
    source_language: &'static str,
    properties: ArtifactProperties<'r>,
}

#[derive(Serialize)]
struct ArtifactProperties<'r> {
    control: &'r ControlChoice,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ArtifactLocation {
    uri: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    uri_base_id: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<usize>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ResultObject<'r> {
    rule_id: &'r str,
    rule_index: usize,
    level: &'static str,
    message: Message,
    locations: [Location<'r>; 1],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    related_locations: Vec<Location<'r>>,
    partial_fingerprints: PartialFingerprints,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fixes: Vec<FixObject<'r>>,
    properties: ResultProperties<'r>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PartialFingerprints {
    /// The name under which GitHub looks.
    primary_location_line_hash: Fingerprint,
}

#[derive(Serialize)]
struct ResultProperties<'r> {
    control: &'r str,
    certainty: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    alarm: Option<&'r str>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    assumptions: &'r [String],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
#[expect(clippy::struct_field_names, reason = "the standard's names")]
struct Location<'r> {
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<usize>,
    physical_location: PhysicalLocation,
    #[serde(skip_serializing_if = "Option::is_none")]
    message: Option<MessageRef<'r>>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct PhysicalLocation {
    artifact_location: ArtifactLocation,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<Region>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Region {
    start_line: u32,
    start_column: u32,
    end_line: u32,
    end_column: u32,
    byte_offset: u32,
    byte_length: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct FixObject<'r> {
    description: MessageRef<'r>,
    artifact_changes: [ArtifactChange<'r>; 1],
    properties: FixProperties,
}

#[derive(Serialize)]
struct FixProperties {
    safe: bool,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ArtifactChange<'r> {
    artifact_location: ArtifactLocation,
    replacements: Vec<Replacement<'r>>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Replacement<'r> {
    deleted_region: Region,
    inserted_content: MessageRef<'r>,
}

#[derive(Serialize)]
struct Message {
    text: String,
}

#[derive(Serialize)]
struct MessageRef<'r> {
    text: &'r str,
}

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, &log(report, MOST_RESULTS))?;
    writeln!(out)
}

fn log(report: &Report, most: usize) -> Log<'_> {
    let rules = report.rules();
    let rule_index: BTreeMap<&str, usize> =
        rules.iter().enumerate().map(|(at, rule)| (rule.id, at)).collect();
    let (kept, left_out) = kept(report, most);
    let mut notifications = Vec::new();
    if left_out > 0 {
        notifications.push(of_left_out(left_out, most));
    }
    let mut artifacts = Vec::new();
    let mut results = Vec::new();
    let mut kept = kept.into_iter();
    for (file_index, file) in report.files().iter().enumerate() {
        let place = || ArtifactLocation { index: Some(file_index), ..artifact_location(file.rooted()) };
        artifacts.push(Artifact {
            location: artifact_location(file.rooted()),
            roles: ["analysisTarget"],
            source_language: "gcode",
            properties: ArtifactProperties { control: &file.control },
        });
        notifications.extend(of_file(file, &place));
        for (finding, fingerprint) in file.findings.iter().zip(file.fingerprints()) {
            if kept.next() == Some(true) {
                let rule_index = rule_index.get(finding.rule.id).copied().unwrap_or_default();
                results.push(result(report, file, finding, fingerprint, rule_index, &place));
            }
        }
    }
    notifications.extend(report.skipped().iter().map(|skipped| of_skipped(report, skipped)));
    let base = UriBase { description: Message { text: "The folder that paths are relative to.".to_owned() } };
    let version = env!("CARGO_PKG_VERSION");
    let driver = Driver {
        name: "gcheck",
        version,
        semantic_version: version,
        information_uri: HOME,
        rules: rules.into_iter().map(rule).collect(),
    };
    let run = Run {
        tool: Tool { driver },
        invocations: [Invocation {
            execution_successful: report.skipped().is_empty(),
            tool_execution_notifications: notifications,
        }],
        original_uri_base_ids: BTreeMap::from([(SOURCE_ROOT, base)]),
        artifacts,
        results,
        newline_sequences: ["\r\n", "\n", "\r"],
        column_kind: "unicodeCodePoints",
    };
    Log { schema: SCHEMA, version: "2.1.0", runs: [run] }
}

fn of_left_out(left_out: usize, most: usize) -> Notification<'static> {
    let text = format!(
        "{} of {} findings are left out, the mildest first: a run holds at most {}.",
        number(left_out),
        number(left_out + most),
        number(most)
    );
    Notification { level: "warning", message: Message { text }, locations: Vec::new() }
}

/// What was not done of the check of a file.
fn of_file(file: &File, place: &dyn Fn() -> ArtifactLocation) -> Vec<Notification<'static>> {
    let notification = |level, text: String| {
        let physical_location = PhysicalLocation { artifact_location: place(), region: None };
        let locations = vec![Location { id: None, physical_location, message: None }];
        Notification { level, message: Message { text }, locations }
    };
    let mut notifications = Vec::new();
    if file.out_of_fuel {
        let text = "The analysis ended before the program did: out of fuel.";
        notifications.push(notification("warning", text.to_owned()));
    }
    for rule in &file.failed_rules {
        let text = format!("The rule `{rule}` failed by a mistake in gcheck: its findings are missing.");
        notifications.push(notification("error", text));
    }
    notifications
}

fn of_skipped(report: &Report, skipped: &Skipped) -> Notification<'static> {
    let locations = if skipped.file.is_empty() {
        Vec::new()
    } else {
        let artifact_location = artifact_location(&report.rooted(&skipped.file));
        let physical_location = PhysicalLocation { artifact_location, region: None };
        vec![Location { id: None, physical_location, message: None }]
    };
    let text = format!("The file could not be checked: {}.", skipped.reason);
    Notification { level: "error", message: Message { text }, locations }
}

/// For every finding in order, whether it is among the `most` that are written; and how many are not. The most severe
/// stay, in the order of the report.
fn kept(report: &Report, most: usize) -> (Vec<bool>, usize) {
    let mut order: Vec<(Severity, usize)> =
        report.findings().enumerate().map(|(at, (_, finding))| (finding.severity, at)).collect();
    let mut kept = vec![true; order.len()];
    order.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
    let left_out = order.get(most..).unwrap_or_default();
    for (_, at) in left_out {
        if let Some(kept) = kept.get_mut(*at) {
            *kept = false;
        }
    }
    (kept, left_out.len())
}

fn rule(meta: &'static RuleMeta) -> Rule {
    let summary = sentence(meta.summary);
    let docs = meta.docs();
    let about = first_paragraph(&docs).unwrap_or_else(|| summary.clone());
    let help_uri = meta.page();
    let markdown = if docs.trim().is_empty() { about.clone() } else { docs.trim().to_owned() };
    Rule {
        id: meta.id,
        deprecated_ids: meta.aliases,
        short_description: Message { text: summary },
        help: Help { text: about.clone(), markdown },
        full_description: Message { text: about },
        help_uri,
        default_configuration: RuleConfiguration { enabled: meta.recommended, level: level(meta.severity) },
        properties: RuleProperties {
            tags: [meta.group],
            since: meta.since,
            problem_severity: match meta.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Info | Severity::Hint => "recommendation",
            },
        },
    }
}

fn result<'r>(
    report: &'r Report,
    file: &'r File,
    finding: &'r Finding,
    fingerprint: Fingerprint,
    rule_index: usize,
    place: &dyn Fn() -> ArtifactLocation,
) -> ResultObject<'r> {
    let physical_location =
        PhysicalLocation { artifact_location: place(), region: Some(region(&file.source, &finding.range)) };
    let message = (!finding.label.is_empty()).then_some(MessageRef { text: &finding.label });
    let related = finding.labels.iter().take(MOST_LOCATIONS - 1).enumerate();
    ResultObject {
        rule_id: finding.rule.id,
        rule_index,
        level: level(finding.severity),
        message: Message { text: text(finding) },
        locations: [Location { id: None, physical_location, message }],
        related_locations: related
            .map(|(at, label)| related_location(report, file, label, at + 1, place))
            .collect(),
        partial_fingerprints: PartialFingerprints { primary_location_line_hash: fingerprint },
        // A change without replacements is not allowed.
        fixes: finding
            .fixes
            .iter()
            .filter(|fix| !fix.edits.is_empty())
            .map(|fix| fix_object(file, fix, place()))
            .collect(),
        properties: ResultProperties {
            control: &file.control.name,
            certainty: finding.certainty.name(),
            alarm: finding.alarm.as_deref(),
            assumptions: &finding.assumptions,
        },
    }
}

fn related_location<'r>(
    report: &'r Report,
    file: &'r File,
    label: &'r Label,
    id: usize,
    place: &dyn Fn() -> ArtifactLocation,
) -> Location<'r> {
    let other = label.file.as_deref().filter(|path| *path != file.path);
    let (artifact_location, source) = match other {
        None => (place(), Some(&file.source)),
        Some(path) => (artifact_location(&report.rooted(path)), report.source(path)),
    };
    let region = source.map(|source| region(source, &label.range));
    Location {
        id: Some(id),
        physical_location: PhysicalLocation { artifact_location, region },
        message: Some(MessageRef { text: &label.message }),
    }
}

fn fix_object<'r>(file: &File, fix: &'r Fix, artifact_location: ArtifactLocation) -> FixObject<'r> {
    let replacements = fix.edits.iter().map(|edit| Replacement {
        deleted_region: region(&file.source, &edit.range),
        inserted_content: MessageRef { text: &edit.text },
    });
    FixObject {
        description: MessageRef { text: &fix.title },
        artifact_changes: [ArtifactChange { artifact_location, replacements: replacements.collect() }],
        properties: FixProperties { safe: fix.safe },
    }
}

/// The message as a sentence: viewers with little room show the first one. Notes and help follow on lines of their own.
fn text(finding: &Finding) -> String {
    let mut text = sentence(&finding.message);
    for remark in remarks(finding) {
        text.push('\n');
        text.push_str(&remark);
    }
    text
}

/// SARIF wants sentences where our own formats want lines.
fn sentence(line: &str) -> String {
    let stop = if line.ends_with(['.', '!', '?', ':']) { "" } else { "." };
    format!("{line}{stop}")
}

/// The text up to the first empty line, in one line; nothing if the documentation opens with a heading or a fence.
fn first_paragraph(docs: &str) -> Option<String> {
    let lines = docs.lines().map(str::trim).skip_while(|line| line.is_empty());
    let lines: Vec<&str> = lines
        .take_while(|line| !line.is_empty() && !line.starts_with('#') && !line.starts_with("```"))
        .collect();
    (!lines.is_empty()).then(|| lines.join(" "))
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info | Severity::Hint => "note",
    }
}

fn region(source: &Source, range: &std::ops::Range<u32>) -> Region {
    let span = source.span(range);
    Region {
        start_line: span.start.line,
        start_column: span.start.column,
        end_line: span.end.line,
        end_column: span.end.column,
        byte_offset: span.start.offset,
        byte_length: span.end.offset - span.start.offset,
    }
}

/// A relative path is relative to the source root; an absolute one becomes a `file:` URI.
fn artifact_location(path: &str) -> ArtifactLocation {
    let path = path.strip_prefix("./").unwrap_or(path);
    let drive = matches!(path.as_bytes(), [letter, b':', b'/', ..] if letter.is_ascii_alphabetic());
    let uri = encoded(path);
    let (uri, uri_base_id) = match path {
        _ if drive => (format!("file:///{}", uri.replacen("%3A", ":", 1)), None),
        _ if path.starts_with("//") => (format!("file:{uri}"), None),
        _ if path.starts_with('/') => (format!("file://{uri}"), None),
        _ => (uri, Some(SOURCE_ROOT)),
    };
    ArtifactLocation { uri, uri_base_id, index: None }
}

/// Percent-encoded but for slashes.
fn encoded(path: &str) -> String {
    let mut uri = String::with_capacity(path.len());
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte) {
            uri.push(byte.into());
        } else {
            // Writing into a string does not fail.
            let _ = write!(uri, "%{byte:02X}");
        }
    }
    uri
}

#[cfg(test)]
mod tests;
