//! A server that is sent anything answers every request once, and in the end answers each as a fresh one does.
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
use gcheck_engine::SourceFile;
use gcheck_lint::{Programs, RuleTable};
use gcheck_server::{
    Choice, Ending, Host, InForce, OpenPrograms, ProgramFile, ProgramQuery, ProgramText, serve,
};
use gcheck_testkit::language_questions::{self, Question};
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
/// Places of a document that are asked about.
const PLACES: usize = 3;

/// Names the control of all programs, as a file.
const CONFIGURATION: &str = "control";

/// Files that are only in memory, and change.
#[derive(Default, Clone)]
struct Files(Arc<Mutex<Vec<(PathBuf, String)>>>);

impl Files {
    fn get(&self, path: &Path) -> Option<String> {
        let files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.iter().find(|(other, _)| other == path).map(|(_, text)| text.clone())
    }

    fn put(&self, name: &str, text: Option<String>) {
        let path = Path::new(FOLDER).join(name);
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        files.retain(|(other, _)| *other != path);
        files.extend(text.map(|text| (path, text)));
        files.sort();
    }
}

/// The programs that others call: in the editor, else among the files.
struct Callable {
    files: Files,
    open: Arc<dyn OpenPrograms>,
}

impl Callable {
    fn text(&self, number: u32) -> Option<(String, String)> {
        let name = format!("O{number}.nc");
        let path = Path::new(FOLDER).join(&name);
        let text = self.open.text(&path).or_else(|| self.files.get(&path))?;
        Some((name, text))
    }
}

impl Programs for Callable {
    fn has_number(&self, number: u32) -> bool {
        self.text(number).is_some()
    }

    fn has_name(&self, _: &str) -> bool {
        false
    }

    fn source_of_number(&self, number: u32) -> Option<SourceFile> {
        let (name, text) = self.text(number)?;
        Some(SourceFile { name: name.into(), text })
    }
}

impl Host for Files {
    fn in_force(&self, program: &ProgramQuery<'_>) -> InForce {
        let configured = self.get(&Path::new(FOLDER).join(CONFIGURATION));
        let wanted = program.control.or(configured.as_deref()).unwrap_or(fallback());
        let control = gcheck_controls::load(wanted).or_else(|_| gcheck_controls::load(fallback()));
        let callable = Callable { files: self.clone(), open: Arc::clone(program.open) };
        let settings = control.ok().map(|control| {
            let mut settings = Settings::new(control, gcheck_rules::RULES);
            settings.execution.fuel = super::WORK;
            settings.programs = Arc::new(callable);
            settings
        });
        InForce {
            settings,
            choice: Choice { control: wanted.to_owned(), ..Choice::default() },
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
            .filter(|(path, _)| path.extension().is_some())
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
        Some(ProgramText { text: self.get(path)?, replaced: Vec::new() })
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
    fn new(files: &Files) -> io::Result<Self> {
        let (reader, input) = io::pipe()?;
        let (from_server, writer) = io::pipe()?;
        let host = Arc::new(files.clone());
        let server = thread::spawn(move || serve(host, reader, writer));
        let (sender, output) = channel();
        thread::spawn(move || read_all(from_server, &sender));
        let mut session = Self { input, output, server, sent: 0, said: Vec::new() };
        let folder = format!("file://{FOLDER}");
        session.request(
            "initialize",
            &json!({
                "processId": null, "rootUri": folder, "workspaceFolders": [{ "uri": folder, "name": "work" }],
                "capabilities": {
                    "textDocument": {
                        "diagnostic": {},
                        "codeAction": {
                            "codeActionLiteralSupport": { "codeActionKind": { "valueSet": ["quickfix"] } },
                            "dataSupport": true,
                            "resolveSupport": { "properties": ["edit"] },
                        },
                        "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
                    },
                    "workspace": { "workspaceEdit": { "documentChanges": true } },
                },
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
    fn answers(&mut self, questions: &[Question]) -> Vec<Value> {
        let first = u64::from(self.sent) + 1;
        for (method, params) in questions {
            self.request(method, params);
        }
        self.wait();
        let answer = |id: u64| self.said.iter().find(|message| answer_to(message) == Some(id));
        (first..=u64::from(self.sent)).map(|id| answer(id).cloned().unwrap_or_default()).collect()
    }

    /// The answers to questions, where they are known: those that are to come are asked for again.
    fn final_answers(&mut self, questions: &[Question], expected: Option<&[Value]>) -> Vec<Value> {
        let mut answers = self.answers(questions);
        for _ in 0..MOST_QUESTIONS {
            let is_open = |at: usize| {
                let (Some((method, _)), Some(answer)) = (questions.get(at), answers.get(at)) else {
                    return false;
                };
                let is_expected = expected.and_then(|all| all.get(at)).is_some_and(|expected| {
                    language_questions::comparable(answer.clone())
                        == language_questions::comparable(expected.clone())
                });
                !is_expected && language_questions::is_to_come(method, answer)
            };
            // Without a session to compare with, lenses are those of the only run that there was.
            let open: Vec<usize> = (0..questions.len())
                .filter(|at| is_open(*at))
                .filter(|at| expected.is_some() || questions.get(*at).is_some_and(|(m, _)| *m != LENSES))
                .collect();
            if open.is_empty() {
                break;
            }
            thread::sleep(BETWEEN_QUESTIONS);
            let again: Vec<Question> = open.iter().filter_map(|at| questions.get(*at).cloned()).collect();
            for (at, answer) in open.into_iter().zip(self.answers(&again)) {
                if let Some(place) = answers.get_mut(at) {
                    *place = answer;
                }
            }
        }
        answers
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

/// Whose answers are of the text as it was until a run of it is over.
const LENSES: &str = "textDocument/codeLens";

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

/// What a client has: its documents, what its user has set, the versions that it counts.
struct Client {
    texts: Vec<Option<String>>,
    versions: Vec<i32>,
    settings: Value,
}

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let files = Files::default();
    let Ok(mut session) = Session::new(&files) else { return };
    let mut client = Client {
        texts: vec![None; DOCUMENTS.len()],
        versions: vec![0; DOCUMENTS.len()],
        settings: json!({ "gcheck": {} }),
    };
    for _ in 0..MOST {
        if choices.is_empty() {
            break;
        }
        let at = choices.below(DOCUMENTS.len());
        step(&mut session, &mut choices, &files, &mut client, at);
    }
    let Ok(mut fresh) = Session::new(&files) else { return };
    fresh.notify("workspace/didChangeConfiguration", &json!({ "settings": client.settings }));
    for ((name, text), version) in DOCUMENTS.iter().zip(&client.texts).zip(&client.versions) {
        if let Some(text) = text {
            fresh.notify("textDocument/didOpen", &opened(name, *version, text));
        }
    }
    assert_same_answers(&mut session, &mut fresh, &client.texts);
    for session in [session, fresh] {
        let asked = session.sent + 1;
        for (id, count) in session.end() {
            assert_eq!(count, 1, "request {id} of {asked} has so many answers");
        }
    }
}

/// A server that has seen edits answers each question as a fresh one does.
fn assert_same_answers(session: &mut Session, fresh: &mut Session, texts: &[Option<String>]) {
    session.wait();
    let questions = questions(texts);
    let expected = fresh.final_answers(&questions, None);
    let answers = session.final_answers(&questions, Some(&expected));
    assert_same(&questions, &answers, &expected);
    // Each server is asked of the thing that it named itself.
    let about = |answers: &[Value]| -> Vec<Question> {
        let all = questions.iter().zip(answers);
        all.flat_map(|((method, _), answer)| language_questions::about_the_first(method, answer)).collect()
    };
    let (of_session, of_fresh) = (about(&answers), about(&expected));
    let expected = fresh.final_answers(&of_fresh, None);
    let answers = session.final_answers(&of_session, Some(&expected));
    assert_same(&of_session, &answers, &expected);
}

fn assert_same(questions: &[Question], answers: &[Value], expected: &[Value]) {
    for ((method, params), (answer, expected)) in questions.iter().zip(answers.iter().zip(expected)) {
        assert_eq!(
            language_questions::comparable(answer.clone()),
            language_questions::comparable(expected.clone()),
            "{method} of {params} is what a fresh server answers"
        );
    }
    assert_eq!(answers.len(), expected.len(), "as many answers");
}

/// Every question about the open documents, at some of their places.
fn questions(texts: &[Option<String>]) -> Vec<Question> {
    let mut questions = Vec::new();
    for (name, text) in DOCUMENTS.iter().zip(texts).filter_map(|(name, text)| Some((*name, text.as_ref()?))) {
        let uri = uri(name);
        if questions.is_empty() {
            questions.extend(language_questions::of_workspace(&uri));
        }
        questions.extend(language_questions::of_document(&uri, &position(text, text.len())));
        for part in 0..PLACES {
            let at = on_border(text, text.len() * part / PLACES);
            questions.extend(language_questions::at_place(&uri, &position(text, at)));
        }
    }
    questions
}

/// The nearest border of characters before a byte, and not inside the end of a line.
fn on_border(text: &str, mut at: usize) -> usize {
    let is_inside = |at: usize| {
        !text.is_char_boundary(at) || text.as_bytes().get(at.wrapping_sub(1)..=at) == Some(b"\r\n")
    };
    while at > 0 && is_inside(at) {
        at -= 1;
    }
    at
}

/// Line and column of a border, as the protocol counts them: in units of UTF-16.
fn position(text: &str, at: usize) -> Value {
    let before = text.get(..at).unwrap_or_default();
    let breaks = before.matches('\n').count() + before.matches('\r').count() - before.matches("\r\n").count();
    let column = before.rsplit(['\n', '\r']).next().unwrap_or_default();
    json!({ "line": breaks, "character": column.encode_utf16().count() })
}

fn uri(name: &str) -> String {
    format!("file://{FOLDER}/{name}")
}

fn opened(name: &str, version: i32, text: &str) -> Value {
    json!({ "textDocument": { "uri": uri(name), "languageId": "gcode", "version": version, "text": text } })
}

fn step(session: &mut Session, choices: &mut Choices<'_>, files: &Files, client: &mut Client, at: usize) {
    let name = DOCUMENTS.get(at).copied().unwrap_or_default();
    let (Some(text), Some(version)) = (client.texts.get_mut(at), client.versions.get_mut(at)) else { return };
    let place = json!({ "line": choices.below(40), "character": choices.below(30) });
    let document = json!({ "uri": uri(name) });
    match choices.below(13) {
        0 => open_or_close(session, choices, name, text, version),
        1..=3 => {
            let Some(text) = text else { return };
            *version += 1;
            let change = edit(text, choices);
            let versioned = json!({ "uri": uri(name), "version": version });
            session.notify(
                "textDocument/didChange",
                &json!({ "textDocument": versioned, "contentChanges": [change] }),
            );
        }
        4 => change_file(session, choices, files, name),
        5 => session.notify("$/cancelRequest", &json!({ "id": session.sent })),
        6 => {
            client.settings = json!({ "gcheck": chosen_settings(choices) });
            session.notify("workspace/didChangeConfiguration", &json!({ "settings": client.settings }));
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
        11 => session.notify("textDocument/didSave", &json!({ "textDocument": document })),
        _ => ask_with_range(session, choices, &document, &place),
    }
}

/// Writes, replaces or deletes a program or the configuration, and reports it.
fn change_file(session: &mut Session, choices: &mut Choices<'_>, files: &Files, name: &str) {
    let length = choices.below(24);
    let kind = 1 + choices.below(3);
    let name = if length == 23 {
        files.put(CONFIGURATION, choices.one(gcheck_controls::names()).map(|&name| name.to_owned()));
        CONFIGURATION
    } else {
        let program = programs::case(choices.take(length)).text;
        files.put(name, (length > 3).then_some(program));
        name
    };
    let changes = json!([{ "uri": uri(name), "type": kind }]);
    session.notify("workspace/didChangeWatchedFiles", &json!({ "changes": changes }));
}

/// What a user sets in the editor.
fn chosen_settings(choices: &mut Choices<'_>) -> Value {
    match choices.below(6) {
        0 => json!({}),
        1 => json!({ "control": choices.one(gcheck_controls::names()) }),
        2 => json!({ "control": "no such control" }),
        3 => json!({ "codeLens": { "enable": false } }),
        4 => json!({ "inlayHints": false }),
        _ => json!({ "foldRepeats": false }),
    }
}

fn open_or_close(
    session: &mut Session,
    choices: &mut Choices<'_>,
    name: &str,
    text: &mut Option<String>,
    version: &mut i32,
) {
    if text.is_none() {
        let length = 8 + choices.below(64);
        let program = programs::case(choices.take(length)).text;
        *version += 1;
        session.notify("textDocument/didOpen", &opened(name, *version, &program));
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
        "G65 P9010 A1. B2.\n",
        "#1=#1+1\n",
        "GOTO 10\n",
        "N10 ",
    ]);
    match choices.below(4) {
        0 => {
            text.insert_str(0, insert);
            let start = json!({ "line": 0, "character": 0 });
            json!({ "range": { "start": start, "end": start }, "text": insert })
        }
        1 => {
            *text = insert.repeat(1 + choices.below(20));
            json!({ "text": text })
        }
        2 => {
            text.push_str(insert);
            // A place after the end is the end.
            let end = json!({ "line": 4_000_000, "character": 0 });
            json!({ "range": { "start": end, "end": end }, "text": insert })
        }
        _ => {
            let start = on_border(text, choices.below(text.len() + 1));
            let end = on_border(text, (start + choices.below(8)).min(text.len())).max(start);
            let range = json!({ "start": position(text, start), "end": position(text, end) });
            text.replace_range(start..end, insert);
            json!({ "range": range, "text": insert })
        }
    }
}
