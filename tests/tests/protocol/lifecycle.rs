//! How sessions begin and end.
//!
//! Knows: the order that the protocol wants, and what happens out of it. Must not know: documents.

use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::session::{Session, in_bytes, server, usual};

const NOT_INITIALIZED: i64 = -32002;
const INVALID_REQUEST: i64 = -32600;

fn begin() -> Value {
    json!({ "processId": null, "rootUri": null, "capabilities": usual() })
}

#[test]
fn a_session_that_ends_in_order_ends_well() {
    let session = Session::new(&[]);
    assert_eq!(session.client.end(), Some(0));
}

#[test]
fn exit_alone_is_no_good_end() {
    let mut session = Session::new(&[]);
    session.client.notify("exit", Value::Null);
    assert_eq!(session.client.exit_code(), Some(1));

    let mut client = server(&std::env::temp_dir());
    client.notify("exit", Value::Null);
    assert_eq!(client.exit_code(), Some(1));
}

#[test]
fn a_client_that_vanishes_takes_the_server_with_it() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "%\nO1\nG0 X1.\nM30\n%\n");
    session.client.close_input();
    assert_eq!(session.client.exit_code(), Some(0));
}

#[test]
fn a_client_whose_process_is_gone_takes_the_server_with_it() {
    let mut owner = Command::new("sleep").arg("600").spawn().unwrap();
    let mut client = server(&std::env::temp_dir());
    client.initialize(json!({ "processId": owner.id(), "rootUri": null, "capabilities": usual() }));
    owner.kill().unwrap();
    owner.wait().unwrap();
    assert_eq!(client.exit_code(), Some(0));
}

#[test]
fn before_initialize_there_is_nothing_to_ask() {
    let mut client = server(&std::env::temp_dir());
    let at = json!({ "textDocument": { "uri": "file:///a.nc" }, "position": { "line": 0, "character": 0 } });
    assert_eq!(client.refused("textDocument/hover", at.clone())["code"], NOT_INITIALIZED);
    assert_eq!(client.refused("shutdown", Value::Null)["code"], NOT_INITIALIZED);
    // Notifications are passed over.
    client.notify("textDocument/didOpen", json!({ "textDocument": {} }));
    client.initialize(begin());
    assert_eq!(client.refused("initialize", begin())["code"], INVALID_REQUEST, "twice");
    assert_eq!(client.end(), Some(0));
}

#[test]
fn after_shutdown_there_is_nothing_to_ask() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "G0 X1.\n");
    session.client.request("shutdown", Value::Null);
    let at = session.at("a.nc", 0, 0);
    assert_eq!(session.client.refused("textDocument/hover", at)["code"], INVALID_REQUEST);
    assert_eq!(session.client.refused("shutdown", Value::Null)["code"], INVALID_REQUEST);
    session.client.notify("exit", Value::Null);
    assert_eq!(session.client.exit_code(), Some(0));
}

#[test]
fn a_server_ends_at_once_though_it_has_work() {
    let mut session = Session::new(&[]);
    session.open("a.nc", &gcheck_testkit::inputs::surfacing(300_000));
    let start = Instant::now();
    session.client.notify("exit", Value::Null);
    assert_eq!(session.client.exit_code(), Some(1));
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

#[test]
fn the_server_says_what_it_can_do() {
    let session = Session::new(&[]);
    let mut names: Vec<&str> = session.capabilities.as_object().unwrap().keys().map(String::as_str).collect();
    names.sort_unstable();
    expect_test::expect![[r#"
        callHierarchyProvider
        codeActionProvider
        codeLensProvider
        completionProvider
        definitionProvider
        documentFormattingProvider
        documentHighlightProvider
        documentLinkProvider
        documentOnTypeFormattingProvider
        documentRangeFormattingProvider
        documentSymbolProvider
        executeCommandProvider
        foldingRangeProvider
        hoverProvider
        inlayHintProvider
        positionEncoding
        referencesProvider
        renameProvider
        selectionRangeProvider
        semanticTokensProvider
        signatureHelpProvider
        textDocumentSync
        workspace
        workspaceSymbolProvider
    "#]]
    .assert_eq(&format!("{}\n", names.join("\n")));
    assert_eq!(session.capabilities["positionEncoding"], "utf-16");
    assert_eq!(Session::with(&in_bytes(), &[]).capabilities["positionEncoding"], "utf-8");
}

#[test]
fn a_server_started_again_knows_nothing_of_the_last_one() {
    let text = "%\nO1\nG21 G90 G94 G54\nG1 X1.\nM30\n%\n";
    let mut first = Session::new(&[]);
    first.open("a.nc", text);
    let findings = first.published("a.nc", 1);
    assert!(!findings.is_empty());
    assert_eq!(first.client.end(), Some(0));
    let mut second = Session::new(&[]);
    second.open("a.nc", text);
    assert_eq!(second.published("a.nc", 1), findings);
}
