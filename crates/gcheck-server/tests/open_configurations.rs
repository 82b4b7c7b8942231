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

use gcheck_db::Settings;
use gcheck_lint::RuleTable;
use gcheck_server::{
    Choice, ConfigurationProblem, Ending, Host, InForce, ProgramFile, ProgramQuery, ProgramText,
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
        let refused = client.refused("textDocument/hover", at);
        assert!(refused["message"].as_str().unwrap().contains("not a program"), "{refused}");
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
