//! Several programs: what one names of another, open or on disk.
//!
//! Knows: how places of other files are told. Must not know: what calls what.

use std::fs;

use serde_json::{Value, json};

use crate::session::{Session, shown};

const CALLER: &str = "(gcheck: control=haas-mill)\n%\nO1\nG0 X1.\nM98 P100\nGOTO 10\nN10 M30\n%\n";
const CALLED: &str = "(gcheck: control=haas-mill)\nO100 (POCKET)\nG1 X1. F100.\nM99\n";

fn both() -> Session {
    let mut session = Session::new(&[("100.nc", CALLED), ("other/100.nc", CALLED)]);
    session.open("a.nc", CALLER);
    session
}

#[test]
fn a_call_leads_to_the_program_on_disk_or_as_it_is_typed() {
    let mut session = both();
    let at = session.at("a.nc", 4, 6);
    let found = session.client.request("textDocument/definition", at.clone());
    assert_eq!(found.as_array().unwrap().len(), 1, "{found}");
    assert_eq!(found[0]["uri"], session.uri("100.nc"));
    assert_eq!(found[0]["range"]["start"]["line"], 1);
    // In the editor it is a line lower.
    session.open("100.nc", &format!("(A)\n{CALLED}"));
    let found = session.client.request("textDocument/definition", at);
    assert_eq!(found[0]["range"]["start"]["line"], 2);
}

#[test]
fn links_lead_to_the_called_program() {
    let mut session = both();
    let document = session.document("a.nc");
    let links = session.client.request("textDocument/documentLink", document);
    let target = links[0]["target"].as_str().unwrap();
    assert_eq!(target, format!("{}#L2", session.uri("100.nc")));
}

#[test]
fn a_program_is_renamed_in_its_callers_too() {
    let mut session = both();
    session.open("100.nc", CALLED);
    let mut params = session.at("100.nc", 1, 2);
    params["newName"] = json!("O200");
    let edit = session.client.request("textDocument/rename", params);
    let mut changed: Vec<String> = edit["documentChanges"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|file| {
            let uri = file["textDocument"]["uri"].as_str().unwrap().rsplit('/').next().unwrap().to_owned();
            let edits = file["edits"].as_array().unwrap().clone();
            edits.into_iter().map(move |edit| format!("{uri} {} {}", shown(&edit["range"]), edit["newText"]))
        })
        .collect();
    changed.sort();
    expect_test::expect![[r#"
        100.nc 1:1-1:4 "200"
        a.nc 4:5-4:8 "200""#]]
    .assert_eq(&changed.join("\n"));
}

#[test]
fn references_are_found_in_all_files_of_the_folder() {
    let mut session = both();
    let mut params = session.at("a.nc", 4, 6);
    params["context"] = json!({ "includeDeclaration": true });
    let found = session.client.request("textDocument/references", params);
    let mut uris: Vec<String> =
        found.as_array().unwrap().iter().map(|place| place["uri"].as_str().unwrap().to_owned()).collect();
    uris.sort();
    assert_eq!(uris, [session.uri("100.nc"), session.uri("a.nc")]);
}

#[test]
fn calls_are_followed_both_ways() {
    let mut session = both();
    let at = session.at("a.nc", 4, 6);
    let callee = session.client.request("textDocument/prepareCallHierarchy", at);
    let callee = callee[0].clone();
    assert_eq!(callee["uri"], session.uri("100.nc"), "{callee}");
    let incoming = session.client.request("callHierarchy/incomingCalls", json!({ "item": callee }));
    assert_eq!(incoming[0]["from"]["uri"], session.uri("a.nc"), "{incoming}");
    assert_eq!(incoming[0]["fromRanges"][0]["start"]["line"], 4);
    let origin = incoming[0]["from"].clone();
    let calls = session.client.request("callHierarchy/outgoingCalls", json!({ "item": origin }));
    assert_eq!(calls[0]["to"]["uri"], session.uri("100.nc"), "{calls}");
}

#[test]
fn symbols_of_the_whole_workspace_are_found() {
    let mut session = both();
    let found = session.client.request("workspace/symbol", json!({ "query": "100" }));
    let mut uris: Vec<&Value> =
        found.as_array().unwrap().iter().map(|symbol| &symbol["location"]["uri"]).collect();
    uris.sort_by_key(ToString::to_string);
    uris.dedup();
    assert_eq!(uris, [&json!(session.uri("100.nc")), &json!(session.uri("other/100.nc"))]);
}

#[test]
fn a_program_of_an_old_code_page_is_read_as_people_wrote_it() {
    let called: &[u8] = b"(f\xFCr K\xF6ln) O100 (Fr\xE4sen)\nT1 M6 (\xD8 5)\nG1 X1.\nM99\n";
    let mut session = Session::new(&[("gcheck.toml", "control = \"haas-mill\"\n")]);
    fs::write(session.path("100.nc"), called).unwrap();
    session.open("a.nc", CALLER);
    let found = session.client.request("workspace/symbol", json!({ "query": "" }));
    let names: Vec<&str> =
        found.as_array().unwrap().iter().map(|symbol| symbol["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"T1 \u{d8} 5"), "{names:?}");
    assert!(names.iter().all(|name| !name.contains('\u{1a}')), "{names:?}");
    // Columns are those of an editor that shows one character for each byte.
    let at = session.at("a.nc", 4, 6);
    let found = session.client.request("textDocument/definition", at);
    assert_eq!(shown(&found[0]["range"]), "0:11-0:15", "{found}");
}
