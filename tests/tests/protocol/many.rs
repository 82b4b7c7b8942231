//! A workspace of many files with many open documents: what a keystroke costs there, and what is remembered.
//!
//! Knows: how large a workspace is, what people wait for. Must not know: what is found in it.
//!
//! The usual run is small; `GCHECK_WORKSPACE=50000` makes so many files, and `GCHECK_SERVER` names another build of gcheck to
//! measure. Both print what they measure with `--nocapture`.

use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};
use std::{env, fs};

use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::session::{server, uri_of, usual};

/// Files of the usual run: more than are loaded at a time.
const FEW: usize = 2_400;
/// One file of so many is open.
const OPEN_ONE_OF: usize = 25;
/// The line of each program that calls another one.
const CALL: usize = 27;
/// Files of a folder.
const A_FOLDER: usize = 100;
/// Keystrokes, and questions of each kind.
const TIMES: usize = 20;
/// Memory beside that of the documents, in kilobytes: allocators and the data of controls.
const EMPTY: u64 = 300 << 10;
/// Memory of a file of the workspace, in kilobytes: most are never loaded.
const A_FILE: u64 = 8;
/// Memory of an open document, in kilobytes, with all that is known of it.
const A_DOCUMENT: u64 = 1_000;
/// Longer nobody waits for findings of what is typed, or for what is asked at the cursor, on a busy machine.
const WAIT: Duration = Duration::from_secs(2);

fn program(number: usize) -> String {
    let (x, y) = (number % 97, number % 31);
    let moves: String =
        (0..20).map(|line| format!("G1 X{}. Y{}. F{}.\n", x + line, y + line, 100 + line)).collect();
    format!(
        "%\nO{}\n(PART {number})\nG21 G90 G17 G40 G49 G80\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 Z5. H1\n{moves}M98 P9000\nG0 \
         Z50.\nM5\nM30\n%\n",
        1 + number % 7_000
    )
}

/// An editor over a workspace, and what it was told.
struct Editor {
    client: LanguageClient,
    /// Addresses of open documents with their versions.
    open: Vec<(String, i32)>,
}

impl Editor {
    fn new(folder: &Path) -> Self {
        let mut client = server(folder);
        let root = uri_of(folder);
        client.initialize(json!({
            "processId": std::process::id(),
            "rootUri": root,
            "workspaceFolders": [{ "uri": root, "name": "work" }],
            "capabilities": usual(),
        }));
        Self { client, open: Vec::new() }
    }

    fn open(&mut self, path: &Path) {
        let uri = uri_of(path);
        let text = fs::read_to_string(path).unwrap();
        let document = json!({ "uri": uri, "languageId": "gcode", "version": 1, "text": text });
        self.client.notify("textDocument/didOpen", json!({ "textDocument": document }));
        self.open.push((uri, 1));
    }

    fn wait_for(&mut self, document: usize) {
        let (uri, version) = &self.open[document];
        self.client.notification("textDocument/publishDiagnostics", |params| {
            params["uri"] == uri.as_str() && params["version"] == *version
        });
    }

    /// Waits for findings of every document, whatever their order.
    fn wait_for_all(&mut self) {
        let mut missing: std::collections::BTreeSet<String> =
            self.open.iter().map(|(uri, _)| uri.clone()).collect();
        while !missing.is_empty() {
            let shown = self.client.notification("textDocument/publishDiagnostics", |_| true);
            missing.remove(shown["uri"].as_str().unwrap());
        }
    }

    /// Types a letter into a document; gives the time to its findings.
    fn type_into(&mut self, document: usize) -> Duration {
        let (uri, version) = &mut self.open[document];
        *version += 1;
        let text = if *version % 2 == 0 { "N10 " } else { "" };
        let start = json!({ "line": 9, "character": 0 });
        let end = json!({ "line": 9, "character": if *version % 2 == 0 { 0 } else { 4 } });
        let params = json!({
            "textDocument": { "uri": uri, "version": version },
            "contentChanges": [{ "range": { "start": start, "end": end }, "text": text }],
        });
        let start = Instant::now();
        self.client.notify("textDocument/didChange", params);
        self.wait_for(document);
        start.elapsed()
    }

    fn ask(&mut self, document: usize, method: &str) -> Duration {
        let place = json!({ "line": 9, "character": 1 });
        let params = json!({ "textDocument": { "uri": self.open[document].0 }, "position": place });
        let start = Instant::now();
        self.client.request(method, params);
        start.elapsed()
    }
}

/// Kilobytes of memory that a process holds.
fn memory(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

#[test]
fn many_files_and_documents_cost_a_keystroke_little() {
    let files: usize = env::var("GCHECK_WORKSPACE").ok().and_then(|n| n.parse().ok()).unwrap_or(FEW);
    let folder = TempDir::new().unwrap();
    let mut paths = Vec::new();
    for number in 0..files {
        let below = folder.path().join(format!("f{}", number / A_FOLDER));
        if number % A_FOLDER == 0 {
            fs::create_dir(&below).unwrap();
            fs::write(below.join("O9000.nc"), "O9000\nG4 P100\nM99\n").unwrap();
        }
        let path = below.join(format!("p{number}.nc"));
        fs::write(&path, program(number)).unwrap();
        if number % OPEN_ONE_OF == 0 {
            paths.push(path);
        }
    }
    let mut editor = Editor::new(folder.path());
    let mut said = format!("{files} files, {} documents\n", paths.len());
    let mut tell = |what: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(said, "{what:<50} {value}");
    };

    let start = Instant::now();
    editor.open(&paths[0]);
    editor.wait_for(0);
    tell("first document to its findings", format!("{:?}", start.elapsed()));
    let alone = median((0..TIMES).map(|_| editor.type_into(0)).collect());
    tell("keystroke to findings, one document", format!("{alone:?}"));

    let start = Instant::now();
    paths[1..].iter().for_each(|path| editor.open(path));
    // The first is not touched: its findings are there.
    let first = editor.open.remove(0);
    editor.wait_for_all();
    editor.open.insert(0, first);
    tell("all documents to their findings", format!("{:?}", start.elapsed()));

    let some = editor.open.len() / 2;
    let typed = median((0..TIMES).map(|_| editor.type_into(some)).collect());
    tell("keystroke to findings", format!("{typed:?}"));
    let mut asked = Duration::ZERO;
    for method in ["textDocument/hover", "textDocument/completion", "textDocument/definition"] {
        let times = median((0..TIMES).map(|_| editor.ask(some, method)).collect());
        tell(method, format!("{times:?}"));
        asked = asked.max(times);
    }
    let start = Instant::now();
    editor.client.request("workspace/symbol", json!({ "query": "O9000" }));
    tell("workspace/symbol", format!("{:?}", start.elapsed()));

    let start = Instant::now();
    let changed = folder.path().join("f0/O9000.nc");
    fs::write(&changed, "O9000\nG4 P200\nM99\n").unwrap();
    let change = json!({ "changes": [{ "uri": uri_of(&changed), "type": 2 }] });
    editor.client.notify("workspace/didChangeWatchedFiles", change);
    let after = editor.ask(some, "textDocument/hover");
    tell("hover, after a file has changed", format!("{after:?}"));
    editor.wait_for_all();
    tell("all findings again, after a file has changed", format!("{:?}", start.elapsed()));

    // The search loads as many files as it may, of other folders first.
    editor.client.request("workspace/symbol", json!({ "query": "O9000" }));
    let last = &editor.open[editor.open.len() - 1].0;
    let call = json!({ "textDocument": { "uri": last }, "position": { "line": CALL, "character": 6 } });
    let found = editor.client.request("textDocument/definition", call).to_string();
    assert!(found.contains("O9000.nc"), "a called program of the folder is found: {found}");
    let held = memory(editor.client.process());
    tell("memory", format!("{held:?} kB"));
    let documents = editor.open.len() as u64;
    let most = EMPTY + A_FILE * files as u64 + A_DOCUMENT * documents;
    println!("{said}");
    assert!(typed < WAIT && asked < WAIT && after < WAIT, "{said}");
    assert!(held.is_none_or(|held| held < most), "at most {most} kB: {said}");
    editor.client.request("shutdown", Value::Null);
    editor.client.notify("exit", Value::Null);
    assert_eq!(editor.client.exit_code(), Some(0));
}
