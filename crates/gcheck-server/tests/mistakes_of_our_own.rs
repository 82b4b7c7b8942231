//! A panic anywhere answers its request with an error, is written to the log, and the server lives on with the right
//! text; work without end is given up.
//!
//! Knows: a host that panics or sleeps when it is told to. Must not know: what answers say.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod served;

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use gcheck_db::Settings;
use gcheck_engine::SourceFile;
use gcheck_lint::{Programs, RuleTable};
use gcheck_server::{Choice, Ending, Host, InForce, ProgramFile, ProgramQuery, ProgramText, serve};
use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};

/// Panics where a program or its surroundings say so.
struct Fragile;

/// Panics when a rule asks for program 666 or an analysis for the text of program 665, and takes longer than an analysis may to
/// find out that program 777 does not exist.
#[derive(Default)]
struct FragilePrograms {
    has_looked: AtomicBool,
}

impl Programs for FragilePrograms {
    fn has_number(&self, number: u32) -> bool {
        assert_ne!(number, 666, "asked for the wrong program");
        if number == 777 && !self.has_looked.swap(true, Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(2_500));
        }
        false
    }

    fn has_name(&self, _: &str) -> bool {
        false
    }

    fn source_of_number(&self, number: u32) -> Option<SourceFile> {
        assert_ne!(number, 665, "asked for the wrong text");
        None
    }
}

impl Host for Fragile {
    fn in_force(&self, program: &ProgramQuery<'_>) -> InForce {
        assert!(!program.head.contains("PANIC"), "the head holds the word");
        let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
        InForce {
            settings: Some(Settings {
                programs: Arc::new(FragilePrograms::default()),
                ..Settings::new(control, gcheck_rules::RULES)
            }),
            choice: Choice::default(),
            style: None,
            folders: vec![PathBuf::from("/work")],
            configuration: None,
            problems: Vec::new(),
        }
    }

    fn programs_in(&self, _: &Path) -> Vec<ProgramFile> {
        panic!("no folder can be read")
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

const URI: &str = "file:///work/a.nc";

fn session(text: &str) -> (LanguageClient, std::thread::JoinHandle<Ending>) {
    // With a trace of all calls, a panic may take longer than an analysis may.
    std::panic::set_hook(Box::new(|panic| drop(writeln!(std::io::stderr(), "{panic}"))));
    served::session(Fragile, (URI, "gcode"), text, &json!({}))
}

fn change(client: &mut LanguageClient, version: i32, text: &str) {
    let document = json!({ "uri": URI, "version": version });
    let params = json!({ "textDocument": document, "contentChanges": [{ "text": text }] });
    client.notify("textDocument/didChange", params);
}

fn published(client: &mut LanguageClient, version: i32) -> Value {
    client.notification("textDocument/publishDiagnostics", |params| params["version"] == version)
}

fn logged(client: &mut LanguageClient, part: &str) {
    client.notification("window/logMessage", |p| p["message"].as_str().unwrap().contains(part));
}

fn end(mut client: LanguageClient, server: std::thread::JoinHandle<Ending>) {
    client.request("shutdown", Value::Null);
    client.notify("exit", Value::Null);
    assert_eq!(server.join().unwrap(), Ending::Orderly);
}

#[test]
fn a_request_that_meets_one_is_refused_and_the_next_answered() {
    let (mut client, server) = session("G0 X1.\n");
    let at = json!({ "textDocument": { "uri": URI }, "position": { "line": 0, "character": 1 } });
    let refused = client.refused("textDocument/definition", at.clone());
    assert_eq!(refused["code"], -32603);
    assert!(refused["message"].as_str().unwrap().contains("an error inside gcheck"), "{refused}");
    logged(&mut client, "no folder can be read");
    let tree = client.request("gcheck/syntaxTree", json!({ "textDocument": { "uri": URI } }));
    assert!(tree.as_str().unwrap().contains("X1."), "the text is still there: {tree}");
    client.request("textDocument/hover", at);
    end(client, server);
}

#[test]
fn an_analysis_that_meets_one_is_not_tried_again_until_the_text_changes() {
    let (mut client, server) = session("%\nO1\nM98 P665\nM30\n%\n");
    logged(&mut client, "asked for the wrong text");
    client.notification("window/showMessage", |p| p["message"].as_str().unwrap().contains("is not checked"));
    change(&mut client, 2, "%\nO1\nM98 P667\nM30\n%\n");
    published(&mut client, 2);
    end(client, server);
}

#[test]
fn a_rule_that_meets_one_is_named_and_the_others_are_heard() {
    let (mut client, server) = session("%\nO1\nG999\nM98 P666\nM30\n%\n");
    let shown = published(&mut client, 1).to_string();
    assert!(shown.contains("failed by a mistake in gcheck"), "{shown}");
    assert!(shown.contains("unknown-code"), "{shown}");
    change(&mut client, 2, "%\nO1\nG999\nM98 P667\nM30\n%\n");
    let shown = published(&mut client, 2).to_string();
    assert!(!shown.contains("failed by a mistake in gcheck"), "{shown}");
    end(client, server);
}

#[test]
fn settings_that_meet_one_leave_the_text_as_it_is() {
    let (mut client, server) = session("(PANIC)\nG0 X1.\n");
    logged(&mut client, "the head holds the word");
    change(&mut client, 2, "%\nO1\nG0 X1.\nM30\n%\n");
    published(&mut client, 2);
    end(client, server);
}

#[test]
fn an_analysis_that_takes_too_long_is_given_up_and_says_so() {
    let around =
        |number: u32| format!("%\nO1\nM98 P{number}\n#1=0\nN1 #1=#1+1\nIF[#1LT100000]GOTO1\nM30\n%\n");
    let (mut client, server) = session(&around(777));
    let shown = published(&mut client, 1);
    assert_eq!(shown["diagnostics"][0]["code"], "analysis-incomplete", "{shown}");
    let tree = client.request("gcheck/syntaxTree", json!({ "textDocument": { "uri": URI } }));
    assert!(tree.as_str().unwrap().contains("P777"), "the next question is answered: {tree}");
    change(&mut client, 2, &around(778));
    let shown = published(&mut client, 2);
    assert!(!shown.to_string().contains("analysis-incomplete"), "another text is analysed again: {shown}");
    end(client, server);
}

#[test]
fn a_hover_does_not_wait_for_the_state_and_the_next_one_has_it() {
    let (mut client, server) = session("%\nO1\nM98 P777\nS500 M3\nG4 P1.\nM30\n%\n");
    let at = json!({ "textDocument": { "uri": URI }, "position": { "line": 4, "character": 1 } });
    let mut hover = || client.request("textDocument/hover", at.clone())["contents"]["value"].to_string();
    let first = hover();
    assert!(first.contains("Waits") && first.contains("still being worked out"), "{first}");
    // Nobody asks for anything meanwhile.
    let mut shown = (0..20).map(|_| {
        std::thread::sleep(Duration::from_millis(500));
        hover()
    });
    let last = shown.find(|shown| !shown.contains("still being worked out")).unwrap();
    assert!(last.contains("Waits") && last.contains("S500"), "{last}");
    end(client, server);
}

#[test]
fn a_session_that_ends_leaves_no_thread_behind() {
    let (input, mut to_server) = std::io::pipe().unwrap();
    let (mut from_server, output) = std::io::pipe().unwrap();
    let server = std::thread::spawn(move || serve(Arc::new(Fragile), input, output).unwrap());
    let body = r#"{"jsonrpc":"2.0","method":"exit"}"#;
    write!(to_server, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
    assert_eq!(server.join().unwrap(), Ending::Abrupt);
    // The stream ends when the last thread that could write to it has ended.
    let mut said = String::new();
    from_server.read_to_string(&mut said).unwrap();
}
