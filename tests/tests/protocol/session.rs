//! A session of an editor with the server, in a folder of its own.
//!
//! Knows: how documents are opened, changed and looked at. Must not know: what any test expects.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};
use tempfile::TempDir;

/// A session.
pub(crate) struct Session {
    pub(crate) client: LanguageClient,
    /// What the server said that it can do.
    pub(crate) capabilities: Value,
    folder: TempDir,
}

/// A server that nobody has spoken to; `GCHECK_SERVER` names another build of it.
pub(crate) fn server(folder: &Path) -> LanguageClient {
    let other = env::var_os("GCHECK_SERVER");
    let mut command = Command::new(other.unwrap_or_else(|| env!("CARGO_BIN_EXE_gcheck-under-test").into()));
    LanguageClient::start(command.arg("lsp").current_dir(folder))
}

/// What most editors can do.
pub(crate) fn usual() -> Value {
    json!({
        "workspace": {
            "applyEdit": true,
            "configuration": true,
            "workspaceEdit": { "documentChanges": true },
            "didChangeConfiguration": { "dynamicRegistration": true },
            "didChangeWatchedFiles": { "dynamicRegistration": true },
        },
        "textDocument": {
            "publishDiagnostics": {
                "relatedInformation": true, "codeDescriptionSupport": true, "tagSupport": { "valueSet": [1] },
            },
            "completion": { "completionItem": { "snippetSupport": true } },
            "hover": { "contentFormat": ["markdown", "plaintext"] },
            "documentSymbol": { "hierarchicalDocumentSymbolSupport": true },
            "codeAction": {
                "codeActionLiteralSupport": { "codeActionKind": { "valueSet": ["quickfix"] } },
            },
        },
        "window": { "workDoneProgress": true, "showDocument": { "support": true } },
    })
}

/// The same, and that it asks for diagnostics.
pub(crate) fn pulling() -> Value {
    let mut all = usual();
    all["textDocument"]["diagnostic"] = json!({});
    all["workspace"]["diagnostics"] = json!({ "refreshSupport": true });
    all
}

/// The same, and that it counts columns in bytes.
pub(crate) fn in_bytes() -> Value {
    let mut all = usual();
    all["general"] = json!({ "positionEncodings": ["utf-16", "utf-8"] });
    all
}

impl Session {
    /// Begins a session of a usual editor over some files.
    pub(crate) fn new(files: &[(&str, &str)]) -> Self {
        Self::with(&usual(), files)
    }

    /// Begins a session of an editor with these capabilities.
    pub(crate) fn with(capabilities: &Value, files: &[(&str, &str)]) -> Self {
        Self::told(capabilities, &Value::Null, files)
    }

    /// Begins a session of an editor whose user has set something.
    pub(crate) fn told(capabilities: &Value, settings: &Value, files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let mut client = server(folder.path());
        client.settings = settings.clone();
        let root = uri_of(folder.path());
        let answer = client.initialize(json!({
            "processId": std::process::id(),
            "rootUri": root,
            "workspaceFolders": [{ "uri": root, "name": "work" }],
            "capabilities": capabilities,
        }));
        Self { client, capabilities: answer["capabilities"].clone(), folder }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn uri(&self, name: &str) -> String {
        uri_of(&self.path(name))
    }

    /// Names a document in a request.
    pub(crate) fn document(&self, name: &str) -> Value {
        json!({ "textDocument": { "uri": self.uri(name) } })
    }

    /// Names a place in a request.
    pub(crate) fn at(&self, name: &str, line: u32, character: u32) -> Value {
        json!({ "textDocument": { "uri": self.uri(name) }, "position": { "line": line, "character": character } })
    }

    pub(crate) fn open(&mut self, name: &str, text: &str) {
        let uri = self.uri(name);
        let document = json!({ "uri": uri, "languageId": "gcode", "version": 1, "text": text });
        self.client.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Changes a range, given as lines and columns.
    pub(crate) fn edit(&mut self, name: &str, version: i32, range: [u32; 4], text: &str) {
        self.change(name, version, &json!([{ "range": range_of(range), "text": text }]));
    }

    /// Sends changes as they are.
    pub(crate) fn change(&mut self, name: &str, version: i32, changes: &Value) {
        let document = json!({ "uri": self.uri(name), "version": version });
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.client.notify("textDocument/didChange", params);
    }

    /// What is published for a version of a document, each as `line:column-line:column severity rule`.
    pub(crate) fn published(&mut self, name: &str, version: i32) -> Vec<String> {
        let all = self.published_whole(name, version);
        all.iter().map(brief).collect()
    }

    /// What is published for a version of a document.
    pub(crate) fn published_whole(&mut self, name: &str, version: i32) -> Vec<Value> {
        let uri = self.uri(name);
        let published = self.client.notification("textDocument/publishDiagnostics", |params| {
            params["uri"] == uri.as_str() && params["version"] == version
        });
        published["diagnostics"].as_array().unwrap().clone()
    }

    /// What is answered to a question for diagnostics, each as in [`Self::published`].
    pub(crate) fn pulled(&mut self, name: &str) -> Vec<String> {
        let params = self.document(name);
        let report = self.pull(&params);
        report["items"].as_array().unwrap().iter().map(brief).collect()
    }

    /// Asks for diagnostics, again where the server wants it.
    pub(crate) fn pull(&mut self, params: &Value) -> Value {
        loop {
            let id = self.client.send_request("textDocument/diagnostic", params.clone());
            let answer = self.client.answer(id);
            match answer.get("error") {
                Some(error) => assert_eq!(error["data"]["retriggerRequest"], true, "{answer}"),
                None => return answer["result"].clone(),
            }
        }
    }

    /// The text as the server has it, taken from its tree.
    pub(crate) fn text(&mut self, name: &str) -> String {
        let params = self.document(name);
        let tree = self.client.request("gcheck/syntaxTree", params);
        text_of_tree(tree.as_str().unwrap())
    }
}

/// The address of a file.
pub(crate) fn uri_of(path: &Path) -> String {
    format!("file://{}", path.display())
}

pub(crate) fn range_of([line, character, end_line, end_character]: [u32; 4]) -> Value {
    json!({
        "start": { "line": line, "character": character },
        "end": { "line": end_line, "character": end_character },
    })
}

/// A range as text: `1:0-1:3`.
pub(crate) fn shown(range: &Value) -> String {
    let place = |place: &Value| format!("{}:{}", place["line"], place["character"]);
    format!("{}-{}", place(&range["start"]), place(&range["end"]))
}

fn brief(diagnostic: &Value) -> String {
    let severity = ["", "error", "warning", "info", "hint"];
    let severity = severity[usize::try_from(diagnostic["severity"].as_u64().unwrap()).unwrap()];
    let rule = diagnostic["code"].as_str().unwrap_or_else(|| diagnostic["message"].as_str().unwrap());
    format!("{} {severity} {rule}", shown(&diagnostic["range"]))
}

/// The text that a printed tree was made of.
fn text_of_tree(tree: &str) -> String {
    let tokens = tree.lines().filter_map(|line| line.trim_start().split_once(" \""));
    tokens.map(|(_, quoted)| unescaped(quoted.strip_suffix('"').unwrap())).collect()
}

/// Undoes what Rust's `{:?}` does to a text.
fn unescaped(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        if c != '\\' {
            out.push(c);
            continue;
        }
        match rest.next().unwrap() {
            'n' => out.push('\n'),
            'r' => out.push('\r'),
            't' => out.push('\t'),
            '0' => out.push('\0'),
            'u' => {
                let code: String = rest.by_ref().skip(1).take_while(|c| *c != '}').collect();
                out.push(char::from_u32(u32::from_str_radix(&code, 16).unwrap()).unwrap());
            }
            other => out.push(other),
        }
    }
    out
}

#[test]
fn trees_hold_their_text() {
    let tree = "CHUNK 0..9\n  BLOCK 0..9\n    COMMENT 0..5 \"(\\\"µ\\\\)\"\n    NEWLINE 5..6 \"\\r\\n\"\n";
    assert_eq!(text_of_tree(tree), "(\"µ\\)\r\n");
    assert_eq!(unescaped("\\u{1a}\\0\\t"), "\u{1a}\0\t");
}
