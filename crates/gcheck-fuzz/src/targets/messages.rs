//! A server that is sent anything answers every request once, and in the end knows what a fresh one does.
//!
//! Knows: the frames of messages, the methods by name. Must not know: what they answer.

use std::io::{self, BufRead as _, BufReader, PipeReader, PipeWriter, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use gcheck_controls::fallback;
use gcheck_db::Settings;
use gcheck_lint::RuleTable;
use gcheck_server::{Choice, Ending, Host, InForce, ProgramFile, ProgramQuery, ProgramText, serve};
use serde_json::{Value, json};

use crate::choices::Choices;
use crate::programs;

/// The folder of the workspace.
const FOLDER: &str = "/work";
/// An answer that takes longer is missing.
const PATIENCE: Duration = Duration::from_secs(20);
/// Before what may be out of date is asked for again.
const BETWEEN_QUESTIONS: Duration = Duration::from_millis(1);
/// So often it is asked for, which takes as long as an answer may.
const MOST_QUESTIONS: usize = 20_000;
/// Messages of an input.
const MOST: usize = 40;

/// Files that are only in memory, and change.
#[derive(Default)]
struct Files(Mutex<Vec<(PathBuf, String)>>);

impl Files {
    fn put(&self, name: &str, text: Option<String>) {
        let path = Path::new(FOLDER).join(name);
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.retain(|(other, _)| *other != path);
        files.extend(text.map(|text| (path, text)));
        files.sort();
    }
}

impl Host for Files {
    fn in_force(&self, program: &ProgramQuery<'_>) -> InForce {
        let wanted = program.control.unwrap_or(fallback());
        let control = gcheck_controls::load(wanted).or_else(|_| gcheck_controls::load(fallback()));
        let settings = control.ok().map(|control| {
            let mut settings = Settings::new(control, gcheck_rules::RULES);
            settings.execution.fuel = super::WORK;
            settings
        });
        InForce {
            settings,
            choice: Choice::default(),
            style: None,
            folders: vec![PathBuf::from(FOLDER)],
            configuration: None,
            problems: Vec::new(),
        }
    }

    fn programs_in(&self, _: &Path) -> Vec<ProgramFile> {
        let files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let stamp = |text: &str| text.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(31) + u64::from(byte));
        files
            .iter()
            .map(|(path, text)| ProgramFile {
                path: path.clone(),
                size: text.len() as u64,
                stamp: stamp(text),
            })
            .collect()
    }

    fn programs_below(&self, folder: &Path) -> Vec<ProgramFile> {
        self.programs_in(folder)
    }

    fn read(&self, path: &Path) -> Option<ProgramText> {
        let files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (_, text) = files.iter().find(|(other, _)| other == path)?;
        Some(ProgramText { text: text.clone(), replaced: Vec::new() })
    }

    fn rules(&self) -> RuleTable {
        gcheck_rules::RULES
    }

    fn forget(&self) {}

    fn watched(&self) -> Vec<String> {
        vec!["**/*.nc".to_owned()]
    }
}

/// A server and both ends of its streams.
struct Session {
    input: PipeWriter,
    output: Receiver<Value>,
    server: JoinHandle<io::Result<Ending>>,
    sent: u32,
    /// What the server said.
    said: Vec<Value>,
}

impl Session {
    fn new(files: Arc<Files>) -> io::Result<Self> {
        let (reader, input) = io::pipe()?;
        let (from_server, writer) = io::pipe()?;
        let server = thread::spawn(move || serve(files, reader, writer));
        let (sender, output) = channel();
        thread::spawn(move || read_all(from_server, &sender));
        let mut session = Self { input, output, server, sent: 0, said: Vec::new() };
        let folder = format!("file://{FOLDER}");
        session.request(
            "initialize",
            &json!({
                "processId": null, "rootUri": folder, "workspaceFolders": [{ "uri": folder, "name": "work" }],
                "capabilities": { "textDocument": { "diagnostic": {} } },
            }),
        );
        session.notify("initialized", &json!({}));
        Ok(session)
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        // A server that is gone takes nothing; what it said before is looked at in the end.
        let _ = write!(self.input, "Content-Length: {}\r\n\r\n{body}", body.len());
    }

    fn request(&mut self, method: &str, params: &Value) {
        self.sent += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.sent, "method": method, "params": params }));
    }

    fn notify(&mut self, method: &str, params: &Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Waits until every request has an answer, or for long.
    fn wait(&mut self) {
        while self.said.iter().filter(|message| answer_to(message).is_some()).count() < self.sent as usize {
            let Ok(message) = self.output.recv_timeout(PATIENCE) else { return };
            self.said.push(message);
        }
    }

    /// The answers to questions, in their order.
    fn answers(&mut self, questions: &[(&str, Value)]) -> Vec<Value> {
        let first = u64::from(self.sent) + 1;
        for (method, params) in questions {
            self.request(method, params);
        }
        self.wait();
        let answer = |id: u64| self.said.iter().find(|message| answer_to(message) == Some(id));
        let ids = first..=u64::from(self.sent);
        ids.map(|id| answer(id).and_then(|message| message.get("result")).cloned().unwrap_or_default())
            .collect()
    }

    /// Ends the session; gives every request with the number of its answers.
    fn end(mut self) -> Vec<(u64, usize)> {
        // A client that says `exit` does not wait for what it asked before.
        self.wait();
        self.request("shutdown", &Value::Null);
        self.wait();
        self.notify("exit", &Value::Null);
        let Self { input, output, server, sent, mut said } = self;
        drop(input);
        let ended = server.join();
        assert!(matches!(ended, Ok(Ok(Ending::Orderly))), "the session ends as it should: {ended:?}");
        // The stream ends when no thread of the server is left.
        said.extend(output);
        let answers = |id: u64| said.iter().filter(|message| answer_to(message) == Some(id)).count();
        (1..=u64::from(sent)).map(|id| (id, answers(id))).collect()
    }
}

/// The request that a message answers.
fn answer_to(message: &Value) -> Option<u64> {
    if message.get("method").is_some() { None } else { message.get("id")?.as_u64() }
}

/// Takes the stream apart.
fn read_all(from: PipeReader, to: &Sender<Value>) {
    let mut from = BufReader::new(from);
    loop {
        let mut length = 0;
        let mut line = String::new();
        while from.read_line(&mut line).is_ok_and(|read| read > 0) && !line.trim().is_empty() {
            if let Some(value) = line.to_ascii_lowercase().strip_prefix("content-length:") {
                length = value.trim().parse().unwrap_or(0);
            }
            line.clear();
        }
        let mut body = vec![0; length];
        if length == 0 || from.read_exact(&mut body).is_err() {
            return;
        }
        if let Ok(message) = serde_json::from_slice(&body)
            && to.send(message).is_err()
        {
            return;
        }
    }
}

const DOCUMENTS: &[&str] = &["a.nc", "b.nc", "O9010.nc"];

const AT_A_PLACE: &[&str] = &[
    "textDocument/hover",
    "textDocument/completion",
    "textDocument/definition",
    "textDocument/documentHighlight",
    "textDocument/signatureHelp",
    "textDocument/prepareRename",
    "textDocument/prepareCallHierarchy",
    "gcheck/stateAt",
    "gcheck/completion",
    "textDocument/references",
];

const OF_THE_WHOLE: &[&str] = &[
    "textDocument/documentSymbol",
    "textDocument/foldingRange",
    "textDocument/semanticTokens/full",
    "textDocument/codeLens",
    "textDocument/documentLink",
    "textDocument/diagnostic",
    "gcheck/syntaxTree",
    "gcheck/toolpath",
];

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let files = Arc::new(Files::default());
    let Ok(mut session) = Session::new(Arc::clone(&files)) else { return };
    let mut texts: Vec<Option<String>> = vec![None; DOCUMENTS.len()];
    let mut version = 0;
    for _ in 0..MOST {
        if choices.is_empty() {
            break;
        }
        version += 1;
        let at = choices.below(DOCUMENTS.len());
        let name = DOCUMENTS.get(at).copied().unwrap_or_default();
        let Some(text) = texts.get_mut(at) else { continue };
        step(&mut session, &mut choices, &files, name, text, version);
    }
    let Ok(mut fresh) = Session::new(files) else { return };
    for (name, text) in DOCUMENTS.iter().zip(&texts) {
        if let Some(text) = text {
            fresh.notify("textDocument/didOpen", &opened(name, 1, text));
        }
    }
    let expected = fresh.answers(&at_once(&texts));
    assert_eq!(session.answers(&at_once(&texts)), expected, "the server knows what a fresh one does");
    // Those of the last run are shown until the next is over.
    let expected = fresh.answers(&in_the_end(&texts));
    let mut last = session.answers(&in_the_end(&texts));
    for _ in 0..MOST_QUESTIONS {
        if last == expected {
            break;
        }
        thread::sleep(BETWEEN_QUESTIONS);
        last = session.answers(&in_the_end(&texts));
    }
    assert_eq!(last, expected, "the server comes to know what a fresh one does");
    for session in [session, fresh] {
        let asked = session.sent + 1;
        for (id, count) in session.end() {
            assert_eq!(count, 1, "request {id} of {asked} has so many answers");
        }
    }
}

/// Questions whose answers are of the text as it is.
fn at_once(texts: &[Option<String>]) -> Vec<(&'static str, Value)> {
    let mut questions = Vec::new();
    for (name, text) in open(texts) {
        for method in ["gcheck/syntaxTree", "textDocument/foldingRange", "textDocument/documentSymbol"] {
            questions.push((method, json!({ "textDocument": { "uri": uri(name) } })));
        }
        let place = json!({ "line": text.lines().count() / 2, "character": 1 });
        let hover = json!({ "textDocument": { "uri": uri(name) }, "position": place });
        questions.push(("textDocument/hover", hover));
    }
    questions
}

/// Questions whose answers are of the text as it was until a run of it is over.
fn in_the_end(texts: &[Option<String>]) -> Vec<(&'static str, Value)> {
    open(texts)
        .map(|(name, _)| ("textDocument/codeLens", json!({ "textDocument": { "uri": uri(name) } })))
        .collect()
}

fn open(texts: &[Option<String>]) -> impl Iterator<Item = (&'static str, &String)> {
    DOCUMENTS.iter().zip(texts).filter_map(|(name, text)| Some((*name, text.as_ref()?)))
}

fn uri(name: &str) -> String {
    format!("file://{FOLDER}/{name}")
}

fn opened(name: &str, version: i32, text: &str) -> Value {
    json!({ "textDocument": { "uri": uri(name), "languageId": "gcode", "version": version, "text": text } })
}

fn step(
    session: &mut Session,
    choices: &mut Choices<'_>,
    files: &Files,
    name: &str,
    text: &mut Option<String>,
    version: i32,
) {
    let place = json!({ "line": choices.below(40), "character": choices.below(30) });
    let document = json!({ "uri": uri(name) });
    match choices.below(12) {
        0 => open_or_close(session, choices, name, text, version),
        1..=3 => {
            let Some(text) = text else { return };
            let change = edit(text, choices);
            let versioned = json!({ "uri": uri(name), "version": version });
            session.notify(
                "textDocument/didChange",
                &json!({ "textDocument": versioned, "contentChanges": [change] }),
            );
        }
        4 => {
            let length = choices.below(24);
            let program = programs::case(choices.take(length)).text;
            files.put(name, (length > 3).then_some(program));
            let changes = json!([{ "uri": uri(name), "type": 1 + choices.below(3) }]);
            session.notify("workspace/didChangeWatchedFiles", &json!({ "changes": changes }));
        }
        5 => session.notify("$/cancelRequest", &json!({ "id": session.sent })),
        6 => {
            let setting = choices.text(&["", "generic-mill", "no such control"]);
            session.notify(
                "workspace/didChangeConfiguration",
                &json!({ "settings": { "gcheck": { "x": setting } } }),
            );
        }
        7 => {
            // Bytes that are not a message, with a frame that says where they end.
            let length = choices.below(32);
            let junk = choices.take(length);
            let _ = write!(session.input, "Content-Length: {}\r\n\r\n", junk.len());
            let _ = session.input.write_all(junk);
        }
        8 | 9 => {
            let method = choices.text(AT_A_PLACE);
            let context = json!({ "includeDeclaration": true });
            session
                .request(method, &json!({ "textDocument": document, "position": place, "context": context }));
        }
        10 => session.request(choices.text(OF_THE_WHOLE), &json!({ "textDocument": document })),
        _ => ask_with_range(session, choices, &document, &place),
    }
}

fn open_or_close(
    session: &mut Session,
    choices: &mut Choices<'_>,
    name: &str,
    text: &mut Option<String>,
    version: i32,
) {
    if text.is_none() {
        let length = 8 + choices.below(64);
        let program = programs::case(choices.take(length)).text;
        session.notify("textDocument/didOpen", &opened(name, version, &program));
        *text = Some(program);
    } else {
        session.notify("textDocument/didClose", &json!({ "textDocument": { "uri": uri(name) } }));
        *text = None;
    }
}

/// A question about a range, a name or the workspace; each method takes of the parameters what is its own.
fn ask_with_range(session: &mut Session, choices: &mut Choices<'_>, document: &Value, place: &Value) {
    let range = json!({ "start": { "line": 0, "character": 0 }, "end": place });
    let params = json!({
        "textDocument": document, "range": range, "context": { "diagnostics": [] }, "positions": [place],
        "position": place, "ch": "\n", "newName": "20", "query": "1",
        "options": { "tabSize": 4, "insertSpaces": true }, "previousResultIds": [],
    });
    let method = choices.text(&[
        "textDocument/inlayHint",
        "textDocument/codeAction",
        "textDocument/formatting",
        "textDocument/rangeFormatting",
        "textDocument/onTypeFormatting",
        "textDocument/selectionRange",
        "textDocument/rename",
        "textDocument/semanticTokens/range",
        "workspace/symbol",
        "workspace/diagnostic",
        "no/such",
    ]);
    session.request(method, &params);
}

/// Changes a text; gives the change as the protocol has it.
///
/// It edits at the ends and replaces all: places in between are the business of other targets.
fn edit(text: &mut String, choices: &mut Choices<'_>) -> Value {
    let insert = choices.text(&[
        "",
        "\n",
        "G1 X1.\n",
        "é",
        "(😀)",
        "%",
        "M30\n",
        "M98 P9010\n",
        "#1=#1+1\n",
        "GOTO 10\n",
        "N10 ",
    ]);
    // This client edits at the ends and replaces all: places in between are the business of another test.
    match choices.below(3) {
        0 => {
            text.insert_str(0, insert);
            let start = json!({ "line": 0, "character": 0 });
            json!({ "range": { "start": start, "end": start }, "text": insert })
        }
        1 => {
            *text = insert.repeat(1 + choices.below(20));
            json!({ "text": text })
        }
        _ => {
            text.push_str(insert);
            // A place after the end is the end.
            let end = json!({ "line": 4_000_000, "character": 0 });
            json!({ "range": { "start": end, "end": end }, "text": insert })
        }
    }
}
