//! A configuration that is open in the editor: what is wrong with it comes from its text there, and it is never read as a program.
//!
//! Knows: a host that finds fault with every line that holds a word. Must not know: the form of configurations.

#![expect(
    clippy::indexing_slicing,
    clippy::unwrap_used,
    reason = "a test that meets the unexpected is to fail"
)]

mod served;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_db::Settings;
use gcheck_lint::RuleTable;
use gcheck_server::{
    Choice, ConfigurationHover, ConfigurationOffer, ConfigurationProblem, Configured, ConfiguredPlace,
    Ending, Host, InForce, ProgramFile, ProgramQuery, ProgramText,
};
use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};

struct FaultFinder;

impl Host for FaultFinder {
    fn in_force(&self, program: &ProgramQuery<'_>) -> InForce {
        assert!(program.path.extension().is_none_or(|extension| extension != "toml"), "it is not a program");
        let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
        InForce {
            settings: Some(Settings::new(control, gcheck_rules::RULES)),
            choice: Choice::default(),
            style: None,
            folders: vec![PathBuf::from("/work")],
            configuration: None,
            problems: Vec::new(),
        }
    }

    fn configuration_problems(&self, path: &Path, text: &str) -> Option<Vec<ConfigurationProblem>> {
        let at = |(line, text): (usize, &str)| {
            let column = text.find("FAULT")? as u32;
            let message = "a fault".to_owned();
            let path = Some(path.to_owned());
            Some(ConfigurationProblem { path, line: line as u32, column, length: 5, message })
        };
        Some(text.lines().enumerate().filter_map(at).collect())
    }

    fn configuration_hover(&self, _: &Path, text: &str, offset: usize) -> Option<ConfigurationHover> {
        let range = text.find("FAULT").map(|start| start..start + 5)?;
        range.contains(&offset).then(|| ConfigurationHover { markdown: "a **fault**".to_owned(), range })
    }

    fn configuration_completion(&self, _: &Path, _: &str, offset: usize) -> Vec<ConfigurationOffer> {
        let offer = |label: &str, snippet: Option<&str>| ConfigurationOffer {
            label: label.to_owned(),
            description: format!("what {label} is"),
            is_key: snippet.is_some(),
            range: offset..offset,
            filter: label.to_owned(),
            text: format!("{label} = "),
            snippet: snippet.map(str::to_owned),
        };
        vec![offer("key", Some("key = \"$1\"")), offer("value", None)]
    }

    fn configured(
        &self,
        program: &ProgramQuery<'_>,
        _: &Control,
        named: Configured,
        open: &dyn Fn(&Path) -> Option<String>,
    ) -> Vec<ConfiguredPlace> {
        assert_eq!(program.path, path(PART));
        let path = path(URI);
        let text: Arc<str> = open(&path).unwrap_or_else(|| "# é\n[tools]\n3 = 1\n".to_owned()).into();
        let Configured::Tool(number) = named else { return Vec::new() };
        let start = text.find(&format!("{number} =")).unwrap();
        vec![ConfiguredPlace { path, text, key: start..start + 1 }]
    }

    fn programs_in(&self, _: &Path) -> Vec<ProgramFile> {
        Vec::new()
    }

    fn programs_below(&self, _: &Path) -> Vec<ProgramFile> {
        Vec::new()
    }

    fn read(&self, _: &Path) -> Option<ProgramText> {
        None
    }

    fn rules(&self) -> RuleTable {
        gcheck_rules::RULES
    }

    fn forget(&self) {}

    fn watched(&self) -> Vec<String> {
        Vec::new()
    }
}

const URI: &str = "file:///work/gcheck.toml";
const PART: &str = "file:///work/part.nc";

fn path(uri: &str) -> PathBuf {
    PathBuf::from(uri.trim_start_matches("file://"))
}

fn session(language: &str, capabilities: &Value) -> (LanguageClient, std::thread::JoinHandle<Ending>) {
    let text = "a = FAULT\nG999 X1\nb = \"FAULT\"\n";
    served::session(FaultFinder, (URI, language), text, capabilities)
}

/// Each as `line:column message`.
fn places(list: &Value) -> Vec<String> {
    let place = |found: &Value| {
        let start = &found["range"]["start"];
        format!("{}:{} {}", start["line"], start["character"], found["message"].as_str().unwrap())
    };
    list.as_array().unwrap().iter().map(place).collect()
}

fn published(client: &mut LanguageClient, version: i32) -> Vec<String> {
    let told = client.notification("textDocument/publishDiagnostics", |params| params["version"] == version);
    places(&told["diagnostics"])
}

fn end(mut client: LanguageClient, server: std::thread::JoinHandle<Ending>) {
    client.request("shutdown", Value::Null);
    client.notify("exit", Value::Null);
    assert_eq!(server.join().unwrap(), Ending::Orderly);
}

#[test]
fn all_that_is_wrong_is_told_at_its_place_in_the_open_text() {
    for language in ["toml", "gcode"] {
        let (mut client, server) = session(language, &json!({}));
        assert_eq!(published(&mut client, 1), ["0:4 a fault", "2:5 a fault"]);
        let document = json!({ "uri": URI, "version": 2 });
        let params = json!({ "textDocument": document, "contentChanges": [{ "text": "\nb = FAULT\n" }] });
        client.notify("textDocument/didChange", params);
        assert_eq!(published(&mut client, 2), ["1:4 a fault"]);
        client.notify("textDocument/didSave", json!({ "textDocument": { "uri": URI } }));
        let at = json!({ "textDocument": { "uri": URI }, "position": { "line": 0, "character": 0 } });
        assert_eq!(
            client.request("textDocument/hover", at),
            Value::Null,
            "this host knows no key at the place"
        );
        end(client, server);
    }
}

#[test]
fn a_client_that_asks_for_diagnostics_gets_the_same() {
    let (mut client, server) = session("toml", &json!({ "textDocument": { "diagnostic": {} } }));
    let report = client.request("textDocument/diagnostic", json!({ "textDocument": { "uri": URI } }));
    assert_eq!(places(&report["items"]), ["0:4 a fault", "2:5 a fault"]);
    end(client, server);
}

fn at(uri: &str, line: u32, character: u32) -> Value {
    json!({ "textDocument": { "uri": uri }, "position": { "line": line, "character": character } })
}

#[test]
fn hover_and_completion_are_the_hosts() {
    let snippets =
        json!({ "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } } });
    for (capabilities, written) in [(json!({}), "key = "), (snippets, "key = \"$1\"")] {
        let (mut client, server) = session("toml", &capabilities);
        let hover = client.request("textDocument/hover", at(URI, 0, 6));
        assert_eq!(hover["contents"]["value"], "a **fault**");
        assert_eq!(hover["range"]["start"], json!({ "line": 0, "character": 4 }));
        let list = client.request("textDocument/completion", at(URI, 3, 0));
        let labels: Vec<&Value> =
            list["items"].as_array().unwrap().iter().map(|item| &item["label"]).collect();
        assert_eq!(labels, ["key", "value"]);
        let first = &list["items"][0];
        assert_eq!(
            (&first["textEdit"]["newText"], &first["insertTextFormat"] == 2),
            (&json!(written), written.contains('$'))
        );
        let whole = client.request("completionItem/resolve", first.clone());
        assert_eq!(whole["documentation"]["value"], "what key is");
        end(client, server);
    }
}

#[test]
fn what_has_no_answer_in_a_configuration_is_no_error() {
    let (mut client, server) = session("toml", &json!({}));
    for (method, more) in [
        ("textDocument/definition", json!({})),
        ("textDocument/references", json!({ "context": { "includeDeclaration": true } })),
        ("textDocument/documentHighlight", json!({})),
        ("textDocument/signatureHelp", json!({})),
        ("textDocument/prepareRename", json!({})),
        ("textDocument/rename", json!({ "newName": "x" })),
        ("textDocument/prepareCallHierarchy", json!({})),
        ("gcheck/stateAt", json!({})),
    ] {
        let mut params = at(URI, 1, 1);
        params.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        assert_eq!(client.request(method, params), Value::Null, "{method}");
    }
    end(client, server);
}

#[test]
fn a_program_leads_into_its_configuration_as_it_is_in_the_editor() {
    let text = "O1\nT3 M6\nM30\n";
    let (mut client, server) = served::session(FaultFinder, (PART, "gcode"), text, &json!({}));
    let place = |found: &Value| format!("{} {}", found["uri"].as_str().unwrap(), found["range"]["start"]);
    let found = client.request("textDocument/definition", at(PART, 1, 1));
    assert_eq!(place(&found[0]), format!("{URI} {}", json!({ "line": 2, "character": 0 })));
    let document =
        json!({ "uri": URI, "languageId": "toml", "version": 1, "text": "x = \"é\" # FAULT 3 = 1\n" });
    client.notify("textDocument/didOpen", json!({ "textDocument": document }));
    let mut params = at(PART, 1, 1);
    params["context"] = json!({ "includeDeclaration": true });
    let found = client.request("textDocument/references", params.clone());
    let places: Vec<String> = found.as_array().unwrap().iter().map(place).collect();
    let word = format!("{PART} {}", json!({ "line": 1, "character": 0 }));
    let entry = format!("{URI} {}", json!({ "line": 0, "character": 16 }));
    assert_eq!(places, [word.clone(), entry]);
    params["context"] = json!({ "includeDeclaration": false });
    let found = client.request("textDocument/references", params);
    assert_eq!(found.as_array().unwrap().iter().map(place).collect::<Vec<_>>(), [word]);
    end(client, server);
}

#[test]
fn nothing_colours_formats_or_outlines_it_as_a_program() {
    let (mut client, server) = session("toml", &json!({}));
    let document = json!({ "uri": URI });
    let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 2, "character": 0 } });
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    for (method, params) in [
        ("semanticTokens/full", json!({ "textDocument": document })),
        ("semanticTokens/range", json!({ "textDocument": document, "range": whole })),
        ("documentSymbol", json!({ "textDocument": document })),
        ("foldingRange", json!({ "textDocument": document })),
        ("codeLens", json!({ "textDocument": document })),
        ("documentLink", json!({ "textDocument": document })),
        ("inlayHint", json!({ "textDocument": document, "range": whole })),
        ("codeAction", json!({ "textDocument": document, "range": whole, "context": { "diagnostics": [] } })),
        ("selectionRange", json!({ "textDocument": document, "positions": [{ "line": 0, "character": 0 }] })),
        ("formatting", json!({ "textDocument": document, "options": options })),
        ("rangeFormatting", json!({ "textDocument": document, "range": whole, "options": options })),
    ] {
        assert_eq!(client.request(&format!("textDocument/{method}"), params), Value::Null, "{method}");
    }
    end(client, server);
}
