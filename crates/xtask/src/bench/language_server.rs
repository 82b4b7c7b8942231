//! The language server as an editor meets it: from a keystroke to its findings, through the streams.
//!
//! Knows: what an editor sends, and what people wait for. Must not know: how the server works.

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use gcheck_testkit::inputs;
use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};

use super::in_process::CONTROL;
use super::row::{Limit, Row};

/// Keystrokes of a measurement; half of them undo the other half.
const KEYSTROKES: usize = 200;
/// Keystrokes that change labels take long in a large file.
const FEW_KEYSTROKES: usize = 20;
/// Of a document of more bytes the findings of the first lines come ahead of the others.
const LARGE: usize = 2 << 20;
const URI: &str = "file:///bench/a.nc";

/// Measures.
pub(super) fn rows(gcheck: &Path) -> Vec<Row> {
    let mut rows = Vec::new();
    for (lines, limit) in [(1_000, 2.0), (200_000, 10.0), (1_000_000, 20.0)] {
        let mut editor = Editor::open(gcheck, &inputs::surfacing(lines));
        let what = format!("{} lines", grouped(lines));
        if lines == 1_000_000 {
            rows.push(row(format!("lsp, open to first findings, {what}"), editor.first_seen, 1.0, "s"));
            rows.push(row(format!("lsp, open to findings, {what}"), editor.opened, 2.0, "s"));
        }
        let middle = u32::try_from(lines / 2).unwrap_or(u32::MAX);
        let typed = editor.keystrokes(middle, "G01 ", KEYSTROKES);
        rows.push(row(format!("lsp, keystroke to findings, {what} (95 %)"), typed, limit, "ms"));
        if lines > 1_000 {
            let label = editor.keystrokes(middle, "N10 ", FEW_KEYSTROKES);
            rows.push(row(format!("lsp, label typed to findings, {what} (95 %)"), label, 1_000.0, "ms"));
        }
        let hover = editor.questions("textDocument/hover", middle);
        rows.push(row(format!("lsp, hover, {what} (95 %)"), hover, 5.0, "ms"));
        let completion = editor.questions("textDocument/completion", middle);
        rows.push(row(format!("lsp, completion, {what} (95 %)"), completion, 10.0, "ms"));
        if lines == 1_000_000 {
            let memory = editor.memory();
            rows.push(Row {
                name: format!("lsp, memory, {what}"),
                measured: memory,
                limit: Limit::AtMost(10.0),
                unit: "x file",
            });
        }
    }
    rows
}

fn row(name: String, measured: f64, limit: f64, unit: &'static str) -> Row {
    Row { name, measured: Some(measured), limit: Limit::AtMost(limit), unit }
}

/// A number with commas.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let (head, tail) = digits.split_at(digits.len() % 3);
    let groups = tail.as_bytes().chunks(3).map(String::from_utf8_lossy);
    let all: Vec<String> =
        std::iter::once(head.to_owned()).chain(groups.map(std::borrow::Cow::into_owned)).collect();
    all.iter().filter(|group| !group.is_empty()).cloned().collect::<Vec<_>>().join(",")
}

/// An editor with one document.
struct Editor {
    client: LanguageClient,
    version: i64,
    bytes: usize,
    /// Seconds from opening to the findings that are shown first.
    first_seen: f64,
    /// Seconds from opening to findings.
    opened: f64,
}

impl Editor {
    fn open(gcheck: &Path, text: &str) -> Self {
        let mut command = Command::new(gcheck);
        let mut client = LanguageClient::start(command.args(["lsp", "--isolated", "--control", CONTROL]));
        client.initialize(json!({ "processId": null, "rootUri": null, "capabilities": {} }));
        let document = json!({ "uri": URI, "languageId": "gcode", "version": 1, "text": text });
        let mut editor = Self { client, version: 1, bytes: text.len(), first_seen: 0.0, opened: 0.0 };
        let start = Instant::now();
        editor.client.notify("textDocument/didOpen", json!({ "textDocument": document }));
        editor.wait();
        editor.first_seen = start.elapsed().as_secs_f64();
        if text.len() > LARGE {
            editor.wait();
        }
        editor.opened = start.elapsed().as_secs_f64();
        editor
    }

    fn wait(&mut self) {
        let version = self.version;
        self.client.notification("textDocument/publishDiagnostics", |params| params["version"] == version);
    }

    /// Types a text at the head of a line and takes it away again; gives milliseconds until findings are there.
    fn keystrokes(&mut self, line: u32, text: &str, count: usize) -> f64 {
        let mut taken = Vec::with_capacity(count);
        for stroke in 0..count {
            self.version += 1;
            let (end, text) = if stroke % 2 == 0 { (0, text) } else { (text.len(), "") };
            let range = json!({
                "start": { "line": line, "character": 0 }, "end": { "line": line, "character": end },
            });
            let params = json!({
                "textDocument": { "uri": URI, "version": self.version },
                "contentChanges": [{ "range": range, "text": text }],
            });
            let start = Instant::now();
            self.client.notify("textDocument/didChange", params);
            self.wait();
            taken.push(start.elapsed().as_secs_f64() * 1e3);
        }
        most(taken)
    }

    /// Asks about many places; gives milliseconds until the answer is there.
    fn questions(&mut self, method: &str, line: u32) -> f64 {
        let mut taken = Vec::with_capacity(KEYSTROKES);
        for step in 0..u32::try_from(KEYSTROKES).unwrap_or(0) {
            let place: Value = json!({ "line": line + step, "character": 1 });
            let start = Instant::now();
            self.client.request(method, json!({ "textDocument": { "uri": URI }, "position": place }));
            taken.push(start.elapsed().as_secs_f64() * 1e3);
        }
        most(taken)
    }

    /// Memory of the server as a multiple of the file.
    fn memory(&self) -> Option<f64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.client.process())).ok()?;
        let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
        let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
        #[expect(clippy::cast_precision_loss, reason = "some megabytes")]
        Some(kilobytes * 1024.0 / self.bytes as f64)
    }
}

/// What 95 of a hundred do not exceed.
fn most(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() * 95 / 100).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::{grouped, most};

    #[test]
    fn numbers_are_grouped() {
        assert_eq!(
            [grouped(1_000), grouped(200_000), grouped(1_000_000), grouped(7)],
            ["1,000", "200,000", "1,000,000", "7"]
        );
    }

    #[test]
    fn one_of_twenty_may_be_slower() {
        assert!((most((1..=100).rev().map(f64::from).collect()) - 96.0).abs() < f64::EPSILON);
    }
}
