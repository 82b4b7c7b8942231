//! What is in force: the workspace's configuration, what the user has set, comments in programs.
//!
//! Knows: how each is said and changed. Must not know: what controls make of programs.

use std::fs;

use serde_json::{Value, json};

use crate::session::{Session, pulling, usual};

const PROGRAM: &str = "%\nO1\nG21 G17 G40 G49 G80 G90 G94\nG54\nG0 X0.\nG1 X1.\nM30\n%\n";

fn status(session: &mut Session, name: &str) -> (String, String) {
    let uri = session.uri(name);
    let status = session.client.notification("gcheck/status", |params| params["uri"] == uri.as_str());
    let text = |member: &str| status[member].as_str().unwrap().to_owned();
    (text("control"), text("source"))
}

#[test]
fn the_control_is_told_with_its_title() {
    let mut session = Session::new(&[("gcheck.toml", "control = \"haas-mill\"\n")]);
    session.open("a.nc", PROGRAM);
    let status = session.client.notification("gcheck/status", |params| params["control"] == "haas-mill");
    assert_eq!(status["title"], "Haas mill (classic control and NGC)");
}

fn pair(control: &str, source: &str) -> (String, String) {
    (control.to_owned(), source.to_owned())
}

/// Tells the server that a file has changed.
fn touched(session: &mut Session, name: &str) {
    let changes = json!({ "changes": [{ "uri": session.uri(name), "type": 2 }] });
    session.client.notify("workspace/didChangeWatchedFiles", changes);
}

#[test]
fn the_control_is_told_with_how_it_was_chosen() {
    let mut session = Session::new(&[("sub/gcheck.toml", "control = \"fanuc-mill\"\n")]);
    session.open("sub/a.nc", PROGRAM);
    assert_eq!(status(&mut session, "sub/a.nc"), pair("fanuc-mill", "configuration"));
    session.edit("sub/a.nc", 2, [1, 2, 1, 2], " (gcheck: control=linuxcnc)");
    session.published("sub/a.nc", 2);
    assert_eq!(status(&mut session, "sub/a.nc"), pair("linuxcnc", "comment"));
    session.open("b.nc", "G0 X1.\n");
    assert_eq!(status(&mut session, "b.nc").1, "default");
}

#[test]
fn the_user_may_set_a_control_for_all_programs() {
    let settings = json!({ "control": "haas-mill" });
    let mut session = Session::told(&usual(), &settings, &[("gcheck.toml", "control = \"fanuc-mill\"\n")]);
    session.open("a.nc", PROGRAM);
    let uri = session.uri("a.nc");
    session.client.notification("gcheck/status", |params| {
        params["uri"] == uri.as_str() && params["control"] == "haas-mill" && params["source"] == "option"
    });
    session.client.settings = json!({ "control": "" });
    session.client.notify("workspace/didChangeConfiguration", json!({ "settings": null }));
    assert_eq!(status(&mut session, "a.nc"), pair("fanuc-mill", "configuration"));
}

#[test]
fn settings_come_when_the_session_begins_or_changes_where_the_client_cannot_be_asked() {
    let mut session = Session::with(&json!({}), &[]);
    session.open("a.nc", PROGRAM);
    let settings = json!({ "settings": { "gcheck": { "control": "linuxcnc" } } });
    session.client.notify("workspace/didChangeConfiguration", settings);
    let uri = session.uri("a.nc");
    session.client.notification("gcheck/status", |params| {
        params["uri"] == uri.as_str() && params["control"] == "linuxcnc"
    });
}

#[test]
fn a_setting_that_nobody_understands_is_said() {
    let settings = json!({ "control": "no-such-control", "run": "sometimes" });
    let mut session = Session::told(&usual(), &settings, &[]);
    session.client.notification("window/showMessage", |params| {
        params["message"].as_str().unwrap().contains("`sometimes`")
    });
    session.client.notification("window/showMessage", |params| {
        params["message"].as_str().unwrap().contains("no-such-control")
    });
    session.open("a.nc", PROGRAM);
    assert!(!session.published("a.nc", 1).is_empty());
}

#[test]
fn programs_may_be_checked_when_they_are_saved_only() {
    let mut session = Session::told(&usual(), &json!({ "run": "onSave" }), &[]);
    session.open("a.nc", PROGRAM);
    assert!(!session.published("a.nc", 1).is_empty());
    session.edit("a.nc", 2, [5, 6, 5, 6], " F100.");
    session.edit("a.nc", 3, [5, 6, 5, 6], "00");
    let at = session.at("a.nc", 0, 0);
    session.client.request("textDocument/hover", at);
    session.client.receive_waiting();
    // What was known of the text as it was opened may be said twice.
    let of_edited = |message: &&Value| {
        message["method"] == "textDocument/publishDiagnostics" && message["params"]["version"] != 1
    };
    let published: Vec<&Value> = session.client.notifications.iter().filter(of_edited).collect();
    assert!(published.is_empty(), "{published:?}");
    let document = session.document("a.nc");
    session.client.notify("textDocument/didSave", document);
    session.published("a.nc", 3);
}

#[test]
fn a_client_that_asks_for_findings_is_told_those_of_the_saved_text() {
    let mut session = Session::told(&pulling(), &json!({ "run": "onSave" }), &[]);
    session.open("a.nc", PROGRAM);
    // The settings are known once anything is answered after them.
    let at = session.at("a.nc", 0, 0);
    session.client.request("textDocument/hover", at);
    let params = session.document("a.nc");
    let first = session.pull(&params);
    session.edit("a.nc", 2, [5, 0, 5, 2], "G999");
    let mut again = params.clone();
    again["previousResultId"] = first["resultId"].clone();
    assert_eq!(session.pull(&again)["kind"], "unchanged");
    // That some file has changed makes no difference.
    touched(&mut session, "other.nc");
    assert_eq!(session.pull(&again)["kind"], "unchanged");
    session.client.notify("textDocument/didSave", params);
    let saved = session.pull(&again);
    assert!(saved["items"].to_string().contains("unknown-code"), "{saved}");
    assert!(session.client.requests.iter().any(|asked| asked["method"] == "workspace/diagnostic/refresh"));
}

#[test]
fn a_configuration_that_changes_is_read_again() {
    let mut session = Session::new(&[("gcheck.toml", "control = \"haas-mill\"\n")]);
    session.open("a.nc", PROGRAM);
    assert!(session.published("a.nc", 1).join("\n").contains("feed-missing"));
    fs::write(session.path("gcheck.toml"), "control = \"haas-mill\"\n[rules]\nfeed-missing = \"off\"\n")
        .unwrap();
    touched(&mut session, "gcheck.toml");
    assert!(!session.published("a.nc", 1).join("\n").contains("feed-missing"));
}

#[test]
fn a_configuration_that_cannot_be_read_is_said_at_its_place_and_silences_the_rest() {
    let mut session =
        Session::new(&[("gcheck.toml", "control = \"haas-mill\"\n[rules]\nfeed-mising = \"off\"\n")]);
    session.open("a.nc", PROGRAM);
    let toml = session.uri("gcheck.toml");
    let said = session.client.notification("textDocument/publishDiagnostics", |p| p["uri"] == toml.as_str());
    let said = &said["diagnostics"][0];
    assert_eq!(crate::session::shown(&said["range"]), "2:0-2:11", "{said}");
    assert!(said["message"].as_str().unwrap().contains("feed-missing"), "{said}");
    let all = session.published("a.nc", 1);
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(all[0].contains("is not checked"), "{all:?}");
    let uri = session.uri("a.nc");
    session.client.notification("gcheck/status", |p| p["uri"] == uri.as_str() && p["problem"].is_string());

    fs::write(session.path("gcheck.toml"), "control = \"haas-mill\"\n").unwrap();
    touched(&mut session, "gcheck.toml");
    session.client.notification("textDocument/publishDiagnostics", |params| {
        params["uri"] == toml.as_str() && params["diagnostics"] == json!([])
    });
    assert!(session.published("a.nc", 1).join("\n").contains("feed-missing"));
}

#[test]
fn a_comment_that_names_no_control_is_said_at_its_place() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "%\nO1 (gcheck: control=linuxcn)\nG1 X1.\nM30\n%\n");
    let all = session.published("a.nc", 1);
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(all[0].starts_with("1:20-1:27 error no control is called `linuxcn`"), "{all:?}");
}

#[test]
fn each_folder_of_the_workspace_has_its_own_configuration() {
    let files = [
        ("mill/gcheck.toml", "control = \"haas-mill\"\n"),
        ("lathe/gcheck.toml", "control = \"haas-lathe\"\n"),
    ];
    let mut session = Session::new(&files);
    session.open("mill/a.nc", PROGRAM);
    session.open("lathe/a.nc", PROGRAM);
    assert_eq!(status(&mut session, "mill/a.nc").0, "haas-mill");
    assert_eq!(status(&mut session, "lathe/a.nc").0, "haas-lathe");
    let added =
        json!({ "event": { "added": [{ "uri": session.uri("mill"), "name": "mill" }], "removed": [] } });
    session.client.notify("workspace/didChangeWorkspaceFolders", added);
    assert!(!session.published("mill/a.nc", 1).is_empty());
}

#[test]
fn the_server_asks_to_be_told_of_changes() {
    let mut session = Session::new(&[]);
    let at = session.document("a.nc");
    session.client.refused("gcheck/syntaxTree", at);
    let asked =
        session.client.requests.iter().find(|request| request["method"] == "client/registerCapability");
    let registrations = asked.unwrap()["params"]["registrations"].as_array().unwrap();
    let methods: Vec<&str> = registrations.iter().map(|one| one["method"].as_str().unwrap()).collect();
    assert_eq!(methods, ["workspace/didChangeWatchedFiles", "workspace/didChangeConfiguration"]);
    let globs = registrations[0]["registerOptions"]["watchers"].to_string();
    assert!(globs.contains("gcheck.toml"), "{globs}");
    // Programs are called as their shop does: `PART.NC`, `part.nc`, `o1234`.
    for pattern in ["[nN][cC]", "[nN][gG][cC]", "[tT][aA][pP]", "**/[oO][0-9]*"] {
        assert!(globs.contains(pattern), "{pattern} in {globs}");
    }
}

#[test]
fn the_control_can_be_written_into_the_program() {
    let mut session = Session::new(&[]);
    session.open("a.nc", PROGRAM);
    let entries = session.client.request("gcheck/controls", Value::Null);
    // Some clients always send parameters.
    assert_eq!(session.client.request("gcheck/controls", json!({})), entries);
    assert!(entries.as_array().unwrap().iter().any(|one| one["name"] == "haas-lathe"), "{entries}");
    let set = |uri: &str, control: &str| json!({ "command": "gcheck.setControl", "arguments": [{ "uri": uri, "control": control }] });
    let uri = session.uri("a.nc");
    session.client.request("workspace/executeCommand", set(&uri, "haas-lathe"));
    let asked = session.client.requests.iter().find(|request| request["method"] == "workspace/applyEdit");
    let edit = &asked.unwrap()["params"]["edit"]["documentChanges"][0];
    assert_eq!(edit["textDocument"]["version"], 1);
    assert_eq!(edit["edits"][0]["newText"], "(gcheck: control=haas-lathe)\n");
    assert_eq!(crate::session::shown(&edit["edits"][0]["range"]), "2:0-2:0");
    session.client.refused("workspace/executeCommand", set(&uri, "no-such"));
    session.client.refused("workspace/executeCommand", json!({ "command": "gcheck.dance" }));
}
