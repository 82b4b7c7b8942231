//! Every request once, in its form.
//!
//! Knows: what the protocol wants an answer to look like. Must not know: how features come to their answers; what they say
//! is tested where they are made.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::session::{Session, in_bytes, range_of, shown, usual};

/// The document has changed since the request was sent.
const CONTENT_MODIFIED: i64 = -32801;

const PROGRAM: &str = "\
%
O1 (µ PLATE)
(gcheck: control=haas-mill)
G21 G17 G40 G49 G80 G90 G94
(POCKET)
T1 M6 (END MILL D10)
G54 G0 X0. Y0.
S5000 M3
G43 H1 Z50.
#100=2.5
G1 Z-1. F300.
N10 X#100 (日本 😀) Y10.
G2 X20. Y20. I10. J0.
IF [#100 LT 5.] GOTO 20
GOTO 10
N20 G0 Z50.
G81 X1. Y1. Z-5. R2. F200.
G80
M30
%
";

fn opened() -> Session {
    let mut session = Session::new(&[]);
    session.open("a.nc", PROGRAM);
    session
}

fn ask(session: &mut Session, method: &str, params: Value) -> Value {
    session.client.request(method, params)
}

#[test]
fn hover_tells_of_the_code() {
    let mut session = opened();
    let at = session.at("a.nc", 8, 1);
    let hover = ask(&mut session, "textDocument/hover", at);
    assert_eq!(hover["contents"]["kind"], "markdown");
    let text = hover["contents"]["value"].as_str().unwrap();
    assert!(text.contains("G43") && text.contains("gcheck explain G43 --control haas-mill"), "{hover}");
    assert_eq!(shown(&hover["range"]), "8:0-8:3");
}

#[test]
fn a_client_that_can_explain_is_given_a_link() {
    let mut able = usual();
    able["experimental"] = json!({ "gcheck": { "explainCommand": "gcheck.explain" } });
    let mut session = Session::with(&able, &[]);
    session.open("a.nc", PROGRAM);
    let at = session.at("a.nc", 8, 1);
    let hover = ask(&mut session, "textDocument/hover", at);
    let link = "(command:gcheck.explain?%5B%22G43%22,%22haas-mill%22%5D)";
    assert!(hover["contents"]["value"].as_str().unwrap().contains(link), "{hover}");
    session.edit("a.nc", 2, [10, 7, 10, 13], "");
    session.published("a.nc", 2);
    let offered = actions(&mut session, [10, 0, 10, 2], Some("quickfix"));
    let explain = offered.iter().find(|action| action["command"]["command"] == "gcheck.explain");
    assert_eq!(explain.unwrap()["command"]["arguments"], json!(["feed-missing"]), "{offered:#?}");
}

#[test]
fn a_hover_leaves_findings_to_the_editor() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "%\nO1\n(gcheck: control=haas-mill)\nG90 G1 G0 X1. F100.\nM30\n%\n");
    let found = session.published("a.nc", 1);
    assert!(!found.is_empty());
    let at = session.at("a.nc", 3, 5);
    let hover = ask(&mut session, "textDocument/hover", at);
    assert!(!hover["contents"]["value"].as_str().unwrap().contains("docs/rules"), "{hover}");
}

#[test]
fn columns_are_those_of_the_client() {
    // The word after an emoji: 3 characters beyond the ASCII before it, in 4 units of UTF-16 or 10 bytes.
    let at = |session: &Session, column| session.at("a.nc", 11, column);
    let column = |in_bytes: bool| {
        let line = PROGRAM.lines().nth(11).unwrap();
        let before = &line[..line.find("Y10").unwrap()];
        if in_bytes { before.len() } else { before.encode_utf16().count() }
    };
    let mut session = opened();
    let params = at(&session, u32::try_from(column(false)).unwrap() + 1);
    let hover = ask(&mut session, "textDocument/hover", params);
    assert_eq!(hover["range"]["start"]["character"], column(false), "{hover}");
    let mut session = Session::with(&in_bytes(), &[]);
    session.open("a.nc", PROGRAM);
    let params = at(&session, u32::try_from(column(true)).unwrap() + 1);
    let hover = ask(&mut session, "textDocument/hover", params);
    assert_eq!(hover["range"]["start"]["character"], column(true), "{hover}");
}

#[test]
fn completion_offers_codes_that_replace_what_is_typed() {
    let mut session = opened();
    session.edit("a.nc", 2, [17, 0, 17, 3], "G8");
    let at = session.at("a.nc", 17, 2);
    let list = ask(&mut session, "textDocument/completion", at);
    let items = list["items"].as_array().unwrap();
    let found = items.iter().find(|item| item["label"] == "G83").unwrap_or_else(|| panic!("{list}"));
    assert_eq!(shown(&found["textEdit"]["range"]), "17:0-17:2");
}

/// What most editors can do, and VS Code with their lists.
fn with_short_lists() -> Value {
    let mut all = usual();
    all["textDocument"]["completion"] = json!({
        "completionItem": {
            "snippetSupport": true,
            "labelDetailsSupport": true,
            "resolveSupport": { "properties": ["documentation", "detail"] },
        },
        "completionList": { "itemDefaults": ["editRange", "data"] },
    });
    all
}

/// A list, and its bytes on the wire.
fn listed(session: &mut Session, line: u32, character: u32) -> (Value, usize) {
    let at = session.at("a.nc", line, character);
    let list = ask(session, "textDocument/completion", at);
    let size = list.to_string().len();
    (list, size)
}

#[test]
fn a_list_of_all_g_codes_is_short_on_the_wire() {
    for control in gcheck_controls::names() {
        let mut session = Session::with(&with_short_lists(), &[]);
        session.open("a.nc", &format!("%\nO1\n(gcheck: control={control})\nG90\nG\n"));
        let (list, size) = listed(&mut session, 4, 1);
        assert!(size <= 10_240, "{control}: {size} bytes");
        let rows = list["items"].as_array().unwrap();
        let all = gcheck_controls::load(control).unwrap();
        let codes = all.codes().filter(|code| code.number().letter() == b'G').count();
        // Those that do not fit come with the next digit.
        assert!(rows.len() >= codes.min(90), "{control}: {} rows of {codes} codes", rows.len());
        session.edit("a.nc", 2, [4, 1, 4, 1], "9");
        let (narrow, _) = listed(&mut session, 4, 2);
        let highest = all.codes().filter(|code| code.number().to_string().starts_with("G9")).last().unwrap();
        let highest = highest.number().to_string();
        assert!(narrow["items"].as_array().unwrap().iter().any(|row| row["label"] == *highest), "{narrow}");
        assert_eq!(shown(&list["itemDefaults"]["editRange"]), "4:0-4:1");
        assert!(rows.iter().all(|row| row["documentation"].is_null()), "{list}");
        // An editor that knows nothing of short lists is sent the rows that fit best.
        let mut session = opened();
        session.edit("a.nc", 2, [17, 0, 17, 3], "G");
        let (list, size) = listed(&mut session, 17, 1);
        assert!(size <= 10_240 && list["items"].as_array().unwrap().len() > 30, "{size} bytes");
    }
}

#[test]
fn a_row_of_a_list_says_what_it_is_and_all_about_it_when_it_is_looked_at() {
    let mut session = Session::with(&with_short_lists(), &[]);
    session.open("a.nc", PROGRAM);
    session.edit("a.nc", 2, [17, 0, 17, 3], "G8");
    let (list, _) = listed(&mut session, 17, 2);
    let rows = list["items"].as_array().unwrap();
    let row = rows.iter().find(|row| row["label"] == "G83").unwrap_or_else(|| panic!("{list}"));
    assert_eq!(row["labelDetails"]["description"], "peck drilling", "{row}");
    assert!(row["textEdit"].is_null() && row["data"].is_null(), "{row}");
    // The editor puts our data into the row before it asks.
    let mut asked = row.clone();
    asked["data"] = list["itemDefaults"]["data"].clone();
    let resolved = ask(&mut session, "completionItem/resolve", asked);
    assert!(resolved["documentation"]["value"].as_str().unwrap().contains("peck"), "{resolved}");
    assert_eq!(resolved["label"], "G83");
    // A row of a document that was closed meanwhile stays as it is.
    let document = session.document("a.nc");
    session.client.notify("textDocument/didClose", document);
    let mut asked = row.clone();
    asked["data"] = list["itemDefaults"]["data"].clone();
    assert!(ask(&mut session, "completionItem/resolve", asked)["documentation"].is_null());
    assert!(
        ask(&mut session, "completionItem/resolve", json!({ "label": "G83" }))["documentation"].is_null()
    );
}

#[test]
fn a_blank_opens_no_list() {
    let session = opened();
    let triggers = &session.capabilities["completionProvider"]["triggerCharacters"];
    assert!(!triggers.as_array().unwrap().contains(&json!(" ")), "{triggers}");
}

#[test]
fn help_for_a_block_goes_when_it_is_complete_and_comes_when_it_is_asked_for() {
    let mut session = opened();
    let help = |session: &mut Session, character: u32, kind: u32| {
        let mut params = session.at("a.nc", 16, character);
        params["context"] = json!({ "triggerKind": kind, "isRetrigger": false });
        ask(session, "textDocument/signatureHelp", params)
    };
    assert_eq!(help(&mut session, 5, 2), Value::Null, "the block has all its words");
    assert!(help(&mut session, 5, 1)["signatures"].is_array(), "it is asked for");
    session.edit("a.nc", 2, [16, 0, 16, 30], "G81 X1. R2.0 ");
    assert!(help(&mut session, 13, 2)["signatures"].is_array(), "Z is missing");
}

#[test]
fn signature_help_names_the_words_of_a_cycle() {
    let mut session = opened();
    let at = session.at("a.nc", 16, 5);
    let help = ask(&mut session, "textDocument/signatureHelp", at);
    assert!(help["signatures"][0]["label"].as_str().unwrap().starts_with("G81"), "{help}");
    let parameters = help["signatures"][0]["parameters"].as_array().unwrap();
    assert!(parameters[0]["label"].is_array(), "{help}");
}

#[test]
fn a_label_is_found_marked_and_renamed() {
    let mut session = opened();
    let at = session.at("a.nc", 13, 22);
    let found = ask(&mut session, "textDocument/definition", at.clone());
    assert_eq!(found[0]["range"]["start"]["line"], 15, "{found}");
    let marks = ask(&mut session, "textDocument/documentHighlight", at.clone());
    let kinds: Vec<&Value> = marks.as_array().unwrap().iter().map(|mark| &mark["kind"]).collect();
    assert_eq!(kinds, [2, 3], "{marks}");
    let mut params = at.clone();
    params["context"] = json!({ "includeDeclaration": false });
    let uses = ask(&mut session, "textDocument/references", params);
    assert_eq!(uses.as_array().unwrap().len(), 1, "{uses}");
    let target = ask(&mut session, "textDocument/prepareRename", at.clone());
    assert!(target["placeholder"].as_str().unwrap().contains("20"), "{target}");
    let mut params = at;
    params["newName"] = json!("30");
    let edit = ask(&mut session, "textDocument/rename", params.clone());
    assert_eq!(edit["documentChanges"][0]["edits"].as_array().unwrap().len(), 2, "{edit}");
    params["newName"] = json!("10");
    let refused = session.client.refused("textDocument/rename", params);
    assert_eq!(refused["code"], -32803, "a name that is taken: {refused}");
}

#[test]
fn the_outline_is_a_tree_where_the_client_can_show_one() {
    let mut session = opened();
    let document = session.document("a.nc");
    let symbols = ask(&mut session, "textDocument/documentSymbol", document);
    assert!(symbols[0]["children"].is_array(), "{symbols}");
    assert!(symbols.to_string().contains("END MILL"), "{symbols}");
    let mut session = Session::with(&json!({}), &[]);
    session.open("a.nc", PROGRAM);
    let document = session.document("a.nc");
    let symbols = ask(&mut session, "textDocument/documentSymbol", document);
    assert!(symbols[0]["location"]["uri"].is_string(), "{symbols}");
}

#[test]
fn sections_fold_and_selections_grow() {
    let mut session = opened();
    let document = session.document("a.nc");
    let folds = ask(&mut session, "textDocument/foldingRange", document);
    assert!(!folds.as_array().unwrap().is_empty());
    let params = json!({
        "textDocument": { "uri": session.uri("a.nc") },
        "positions": [{ "line": 12, "character": 4 }, { "line": 99, "character": 0 }],
    });
    let ranges = ask(&mut session, "textDocument/selectionRange", params);
    assert_eq!(ranges.as_array().unwrap().len(), 2);
    assert_eq!(shown(&ranges[0]["range"]), "12:3-12:7");
    assert!(ranges[0]["parent"].is_object());
}

/// Tokens as `line:column length type`.
fn tokens(session: &Session, data: &Value) -> Vec<String> {
    let legend = session.capabilities["semanticTokensProvider"]["legend"]["tokenTypes"].clone();
    let (mut line, mut column) = (0, 0);
    let numbers: Vec<u64> = data["data"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    let one = |token: &[u64]| {
        if token[0] > 0 {
            column = 0;
        }
        line += token[0];
        column += token[1];
        let kind = legend[usize::try_from(token[3]).unwrap()].as_str().unwrap();
        format!("{line}:{column} {} {kind}", token[2])
    };
    numbers.chunks(5).map(one).collect()
}

#[test]
fn colours_are_told_for_the_whole_or_what_is_in_view() {
    let mut session = opened();
    let document = session.document("a.nc");
    let all = ask(&mut session, "textDocument/semanticTokens/full", document.clone());
    let all = tokens(&session, &all);
    assert!(all.iter().any(|token| token == "6:4 2 rapid"), "{all:?}");
    let mut params = document;
    params["range"] = range_of([11, 0, 12, 0]);
    let part = ask(&mut session, "textDocument/semanticTokens/range", params);
    let part = tokens(&session, &part);
    assert!(!part.is_empty() && part.iter().all(|token| token.starts_with("11:")), "{part:?}");
    assert!(part.iter().all(|token| all.contains(token)), "{part:?}");
}

#[test]
fn hints_stand_beside_the_text_where_they_are_switched_on() {
    let mut session = opened();
    let mut params = session.document("a.nc");
    params["range"] = range_of([0, 0, 30, 0]);
    let hints = ask(&mut session, "textDocument/inlayHint", params.clone());
    assert!(!hints.as_array().unwrap().is_empty());
    session.published("a.nc", 1);
    session.client.settings = json!({ "inlayHints": false });
    session.client.notify("workspace/didChangeConfiguration", json!({ "settings": null }));
    session.published("a.nc", 1);
    assert_eq!(ask(&mut session, "textDocument/inlayHint", params), json!([]));
}

#[test]
fn lenses_tell_what_a_tool_does() {
    let mut session = opened();
    let document = session.document("a.nc");
    let lenses = ask(&mut session, "textDocument/codeLens", document.clone());
    assert!(!lenses.as_array().unwrap().is_empty());
    assert!(lenses[0]["command"]["title"].is_string(), "{lenses}");
    // Once known they are there at once.
    assert_eq!(ask(&mut session, "textDocument/codeLens", document), lenses);
}

#[test]
fn a_run_for_lenses_ends_with_the_edit_that_outdates_it() {
    let mut session = Session::new(&[]);
    // It runs until its fuel is spent, which is a matter of many seconds.
    session.open("a.nc", "(gcheck: control=haas-mill)\nO1\nN1 G91 G0 X1.\nGOTO 1\nM30\n");
    let document = session.document("a.nc");
    let asked = session.client.send_request("textDocument/codeLens", document.clone());
    // Everything before it is done, so it runs.
    let at = session.at("a.nc", 0, 0);
    session.client.request("textDocument/hover", at);
    session.edit("a.nc", 2, [3, 0, 3, 6], "(NOTE)");
    let start = Instant::now();
    let answer = session.client.answer(asked);
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
    assert_eq!(answer["error"]["code"], CONTENT_MODIFIED, "{answer}");
    let lenses = ask(&mut session, "textDocument/codeLens", document);
    assert!(!lenses.as_array().unwrap().is_empty(), "{lenses}");
}

#[test]
fn lenses_asked_for_during_an_outdated_run_are_renewed() {
    let mut capabilities = usual();
    capabilities["workspace"]["codeLens"] = json!({ "refreshSupport": true });
    let mut session = Session::with(&capabilities, &[]);
    session.open("a.nc", "(gcheck: control=haas-mill)\nO1\nG54 G90 G21\nG4 P1.\nM30\n");
    let document = session.document("a.nc");
    let title = |lenses: &Value| lenses[0]["command"]["title"].clone();
    let first = ask(&mut session, "textDocument/codeLens", document.clone());
    assert_eq!(title(&first), "0:01 in all");
    // Now it would run until its fuel is spent.
    session.edit("a.nc", 2, [3, 0, 3, 6], "N1 G91 G0 X1.\nGOTO 1");
    assert_eq!(ask(&mut session, "textDocument/codeLens", document.clone()), first);
    session.edit("a.nc", 3, [3, 0, 4, 6], "G4 P2.");
    ask(&mut session, "textDocument/codeLens", document.clone());
    // The client does not ask again by itself: it is told when there is something new.
    let refreshed = |session: &Session| {
        session.client.requests.iter().any(|asked| asked["method"] == "workspace/codeLens/refresh")
    };
    let start = Instant::now();
    while !refreshed(&session) && start.elapsed() < Duration::from_secs(10) {
        let at = session.at("a.nc", 0, 0);
        session.client.request("textDocument/hover", at);
    }
    let second = ask(&mut session, "textDocument/codeLens", document);
    assert_eq!(title(&second), "0:02 in all");
    assert!(refreshed(&session));
}

fn actions(session: &mut Session, range: [u32; 4], only: Option<&str>) -> Vec<Value> {
    let mut params = session.document("a.nc");
    params["range"] = range_of(range);
    params["context"] = json!({ "diagnostics": [] });
    if let Some(only) = only {
        params["context"]["only"] = json!([only]);
    }
    let found = ask(session, "textDocument/codeAction", params);
    found.as_array().unwrap().clone()
}

#[test]
fn actions_fix_silence_and_explain() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "%\nO1\n(gcheck: control=haas-mill)\nG90 G1 G0 X1. F100.\nM30\n%\n");
    session.published("a.nc", 1);
    let all = actions(&mut session, [3, 4, 3, 8], None);
    let kinds: Vec<&str> = all.iter().map(|action| action["kind"].as_str().unwrap()).collect();
    assert!(kinds.contains(&"quickfix"), "{all:#?}");
    let silence = all.iter().find(|action| action["edit"].to_string().contains("gcheck: ignore")).unwrap();
    assert_eq!(silence["edit"]["documentChanges"][0]["textDocument"]["version"], 1);
    let page = all.iter().find(|action| action["command"]["command"] == "gcheck.openPage").unwrap();
    let command = json!({ "command": "gcheck.openPage", "arguments": page["command"]["arguments"] });
    ask(&mut session, "workspace/executeCommand", command);
    assert!(session.client.requests.iter().any(|request| request["method"] == "window/showDocument"));
    let of_source = actions(&mut session, [0, 0, 6, 0], Some("source"));
    assert!(
        of_source.iter().all(|action| action["kind"].as_str().unwrap().starts_with("source")),
        "{of_source:#?}"
    );
}

#[test]
fn text_is_formatted_whole_in_part_and_while_it_is_typed() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "%\nO1\ng0x1.y2.\ng1x2.f100.\nM30\n%\n");
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let mut params = session.document("a.nc");
    params["options"] = options.clone();
    let whole = ask(&mut session, "textDocument/formatting", params.clone());
    assert!(!whole.as_array().unwrap().is_empty());
    params["range"] = range_of([3, 0, 3, 4]);
    let part = ask(&mut session, "textDocument/rangeFormatting", params);
    let lines: Vec<&Value> =
        part.as_array().unwrap().iter().map(|edit| &edit["range"]["start"]["line"]).collect();
    assert!(!lines.is_empty() && lines.iter().all(|line| **line == 3), "{part}");
    let mut params = session.at("a.nc", 3, 0);
    params["ch"] = json!("\n");
    params["options"] = options;
    let typed = ask(&mut session, "textDocument/onTypeFormatting", params);
    let lines: Vec<&Value> =
        typed.as_array().unwrap().iter().map(|edit| &edit["range"]["start"]["line"]).collect();
    assert!(!lines.is_empty() && lines.iter().all(|line| **line == 2), "{typed}");
}

#[test]
fn our_own_requests_answer() {
    let mut session = opened();
    let at = session.at("a.nc", 11, 5);
    let state = ask(&mut session, "gcheck/stateAt", at);
    assert!(state.is_object(), "{state}");
    for side in ["before", "after"] {
        let modes = state[side]["modes"].as_array().unwrap();
        let of = |code: &str| {
            modes.iter().find(|mode| mode["codes"] == json!([code])).unwrap_or_else(|| panic!("{state}"))
        };
        assert_eq!(of("G90")["setAt"], json!({ "line": 3, "character": 0 }), "{side}");
        assert_eq!(of("G54")["setAt"], json!({ "line": 6, "character": 0 }), "{side}");
        assert_eq!(of("G1")["setAt"], json!({ "line": 10, "character": 0 }), "{side}");
    }
    let document = session.document("a.nc");
    let path = ask(&mut session, "gcheck/toolpath", document.clone());
    assert!(path.is_object(), "{path}");
    assert_eq!(session.text("a.nc"), PROGRAM);
    let at = session.at("a.nc", 12, 0);
    let block = ask(&mut session, "gcheck/syntaxTree", at);
    assert!(block.as_str().unwrap().starts_with("BLOCK"), "{block}");
}

#[test]
fn a_faulty_program_has_a_picture_with_marks() {
    let mut session = Session::new(&[]);
    let text = "%\nO1\nG21 G90 G54 G0 X0. Y0. Z50.\nG1 X5. F100.\nG83\nG83 X9.\nG80\nGOTO 77\nG1 X50. Y50.\nM30\n%\n";
    session.open("faulty.nc", &format!("(gcheck: control=haas-mill)\n{text}"));
    let document = session.document("faulty.nc");
    let path = ask(&mut session, "gcheck/toolpath", document);
    assert_eq!(path["data"]["all"], json!([[0.0, 0.0, 50.0], [50.0, 50.0, 50.0]]), "{path}");
    let alarms: Vec<_> =
        path["alarms"].as_array().unwrap().iter().map(|alarm| alarm["line"].clone()).collect();
    assert_eq!(alarms, [json!(6), json!(7), json!(9)], "{path}");
    let marked: Vec<_> =
        path["data"]["alarms"].as_array().unwrap().iter().map(|mark| mark["at"].clone()).collect();
    let before = json!([5.0, 0.0, 50.0]);
    assert_eq!(marked, [before.clone(), before, json!([9.0, 0.0, 50.0])], "{path}");
}

#[test]
fn five_axis_programs_are_drawn_where_they_were_posted() {
    let mut session = Session::new(&[]);
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures");
    for (name, low, high) in [("tour/impeller.nc", 0.0, 1.31), ("clean/haas-mill/blade.nc", 1.1544, 1.25)] {
        let opened = name.replace('/', "-");
        session.open(&opened, &std::fs::read_to_string(format!("{root}/{name}")).unwrap());
        let document = session.document(&opened);
        let path = ask(&mut session, "gcheck/toolpath", document);
        let [from, to] = [0, 1].map(|side| path["data"]["all"][side][0].as_f64().unwrap() / 25.4);
        assert!((from - low).abs() < 1e-6 && (to - high).abs() < 1e-6, "{name}: X {from} to {to}");
        let notes = path["notes"].to_string();
        assert!(notes.contains("posted points"), "{name}: {notes}");
    }
}

#[test]
fn rules_and_codes_are_explained() {
    let mut session = opened();
    let mut about = |params: Value| ask(&mut session, "gcheck/explain", params);
    let page = about(json!({ "subject": "feed-missing" }));
    assert!(page.as_str().unwrap().starts_with("# feed-missing"), "{page}");
    let page = about(json!({ "subject": "G71", "control": "haas-lathe" }));
    assert!(page.as_str().unwrap().starts_with("# G71"), "{page}");
    assert_eq!(about(json!({ "subject": "G4711", "control": "haas-lathe" })), Value::Null);
    let uri = session.uri("a.nc");
    let page =
        ask(&mut session, "gcheck/explain", json!({ "subject": "G143", "textDocument": { "uri": uri } }));
    assert!(page.as_str().unwrap().contains("Haas mill"), "{page}");
    session.client.refused("gcheck/explain", json!({ "subject": "G1", "control": "no-such" }));
}

#[test]
fn long_work_is_shown_where_the_client_agrees() {
    let mut session = Session::new(&[]);
    // Each block asks whether it is the one, so the analysis has a while to go.
    session.open("a.nc", &gcheck_testkit::inputs::macros(60_000));
    session.published("a.nc", 1);
    session.client.receive_waiting();
    let creates = session.client.requests.iter().filter(|r| r["method"] == "window/workDoneProgress/create");
    let tokens: Vec<&Value> = creates.map(|request| &request["params"]["token"]).collect();
    let told: Vec<&Value> =
        session.client.notifications.iter().filter(|m| m["method"] == "$/progress").collect();
    for message in &told {
        assert!(tokens.contains(&&message["params"]["token"]), "{message}");
    }
    let kind = |kind: &str| told.iter().filter(|m| m["params"]["value"]["kind"] == kind).count();
    assert_eq!(kind("begin"), kind("end"));
}

/// A client that has an action's edit when the action is chosen.
fn resolving() -> Value {
    let mut able = usual();
    able["textDocument"]["codeAction"]["dataSupport"] = json!(true);
    able["textDocument"]["codeAction"]["resolveSupport"] = json!({ "properties": ["edit"] });
    able
}

const DRILLED: &str = "%\nO1\n(gcheck: control=haas-mill)\nG21 G17 G90 G94 G54 G40 G80\nG0 X1. Y2. Z5.\nG99 G81 X5. Z-3. R2. F80.\nG80\nM30\n%\n";

#[test]
fn changes_of_the_path_are_proved_when_they_are_chosen() {
    let mut session = Session::with(&resolving(), &[]);
    session.open("a.nc", DRILLED);
    let here = actions(&mut session, [4, 0, 4, 0], None);
    assert!(!here.iter().any(|action| action["data"].is_object()), "not at every move of the cursor");
    let all = actions(&mut session, [4, 0, 4, 0], Some("refactor"));
    let named = |all: &[Value], start: &str| {
        all.iter().find(|action| action["title"].as_str().unwrap().starts_with(start)).unwrap().clone()
    };
    let mirror = named(&all, "Mirror the path at X0");
    assert!(mirror["edit"].is_null() && mirror["kind"] == "refactor.rewrite", "{mirror}");
    let chosen = ask(&mut session, "codeAction/resolve", mirror);
    assert_eq!(
        chosen["title"],
        "Mirror the path at X0 (climb milling becomes conventional), with proof: every move is mirrored at X0, within 0.001 mm (5 moves compared)"
    );
    let edits = chosen["edit"]["documentChanges"][0]["edits"].as_array().unwrap();
    assert_eq!(edits.len(), 2, "{edits:?}");
    // Of a selection, the lines alone.
    let all = actions(&mut session, [5, 2, 5, 4], None);
    let feeds =
        ask(&mut session, "codeAction/resolve", named(&all, "Scale the feeds to 90 % in the selected lines"));
    assert_eq!(feeds["edit"]["documentChanges"][0]["edits"][0]["newText"], "72.");
    // The moves of selected holes become a cycle.
    let holes = "G0 Z2.\nG1 Z-3. F80.\nG0 Z2.\nX5.\nG1 Z-3.\nG0 Z2.\n";
    let mut session = Session::with(&resolving(), &[]);
    session.open("a.nc", &DRILLED.replace("G99 G81 X5. Z-3. R2. F80.\n", holes));
    let all = actions(&mut session, [5, 0, 10, 2], Some("refactor"));
    let fold = ask(&mut session, "codeAction/resolve", named(&all, "Write drilled holes"));
    assert_eq!(
        fold["title"],
        "Write drilled holes as canned cycles in the selected lines, with proof: every move is as before, within 0.001 mm (7 moves compared)"
    );
    assert_eq!(
        fold["edit"]["documentChanges"][0]["edits"][0]["newText"],
        "G99 G81 X1. Y2. Z-3. R2. F80.\nX5."
    );
}

#[test]
fn a_change_that_cannot_be_proved_answers_with_the_reason() {
    let mut session = Session::with(&resolving(), &[]);
    session.open("a.nc", &DRILLED.replace("F80.", ""));
    let all = actions(&mut session, [4, 0, 4, 0], Some("refactor"));
    let mirror =
        all.iter().find(|action| action["title"].as_str().unwrap().starts_with("Mirror")).unwrap().clone();
    let asked = session.client.send_request("codeAction/resolve", mirror.clone());
    let answer = session.client.answer(asked);
    assert_eq!(
        answer["error"]["message"],
        "cannot mirror the path: the run stops in line 6 before the end of the program, so nothing is proved of it"
    );
    // A change of a text that is another one by now.
    session.edit("a.nc", 2, [4, 0, 4, 0], "G0 Z9.\n");
    let asked = session.client.send_request("codeAction/resolve", mirror);
    assert_eq!(session.client.answer(asked)["error"]["code"], CONTENT_MODIFIED);
    // A client that does not resolve actions is not offered them.
    let mut session = Session::new(&[]);
    session.open("a.nc", DRILLED);
    let all = actions(&mut session, [4, 0, 4, 0], Some("refactor"));
    assert!(!all.iter().any(|action| action["title"].as_str().unwrap().contains("with proof")), "{all:?}");
}

#[test]
fn a_shift_and_new_numbers_are_made_with_their_proof() {
    let mut able = resolving();
    able["experimental"] = json!({ "gcheck": { "changeCommand": "own.ask" } });
    let mut session = Session::with(&able, &[]);
    session.open("a.nc", &DRILLED.replace("G80\nM30", "G80\nN5 G0 Z50.\nM30"));
    // The client asks for the figures, with what it is told.
    let all = actions(&mut session, [5, 2, 5, 4], None);
    let shift =
        all.iter().find(|action| action["title"] == "Shift the path in the selected lines …, with proof");
    let command = &shift.unwrap()["command"];
    assert_eq!(command["command"], "own.ask");
    let mut argument = command["arguments"][0].clone();
    assert_eq!((&argument["change"], &argument["uri"]), (&json!("translate"), &json!(session.uri("a.nc"))));
    argument["z"] = json!("-1");
    let change = |argument: &Value| json!({ "command": "gcheck.changePath", "arguments": [argument] });
    let done = ask(&mut session, "workspace/executeCommand", change(&argument));
    assert_eq!(done["claim"], "every move is shifted by Z-1, within 0.001 mm (6 moves compared)");
    let applied = |session: &Session| {
        let asked =
            session.client.requests.iter().rev().find(|request| request["method"] == "workspace/applyEdit");
        let edit = asked.unwrap()["params"]["edit"]["documentChanges"][0].clone();
        assert_eq!(edit["textDocument"]["version"], 1);
        let texts: Vec<String> = edit["edits"]
            .as_array()
            .unwrap()
            .iter()
            .map(|edit| edit["newText"].as_str().unwrap().to_owned())
            .collect();
        texts
    };
    assert_eq!(applied(&session), ["Z-4.", "R1."]);
    let numbers = json!({ "uri": session.uri("a.nc"), "change": "renumber", "start": 100, "step": 5 });
    let done = ask(&mut session, "workspace/executeCommand", change(&numbers));
    assert!(done["claim"].as_str().unwrap().starts_with("every move is as before"), "{done}");
    assert_eq!(applied(&session), ["100"]);
    // What cannot be done answers with the reason, and changes nothing.
    let count = session.client.requests.len();
    let uri = session.uri("a.nc");
    for (argument, reason) in [
        (json!({ "uri": uri, "change": "translate", "x": "far" }), "write a length such as 10"),
        (json!({ "uri": uri, "change": "translate" }), "a shift needs a length"),
        (json!({ "uri": uri, "change": "renumber", "start": 0 }), "whole numbers from 1"),
        (json!({ "uri": uri, "change": "dance" }), "there is no change `dance`"),
        (json!({ "uri": "file:///nowhere.nc", "change": "mirror-x" }), "is not open"),
        (json!("what"), "invalid type"),
    ] {
        let refused = session.client.refused("workspace/executeCommand", change(&argument));
        assert!(refused["message"].as_str().unwrap().contains(reason), "{refused}");
    }
    assert_eq!(session.client.requests.len(), count, "nothing is written");
    // A client that cannot ask for figures is not offered what needs them.
    let mut session = Session::with(&resolving(), &[]);
    session.open("a.nc", DRILLED);
    let all = actions(&mut session, [5, 2, 5, 4], None);
    assert!(!all.iter().any(|action| action["title"].as_str().unwrap().contains('…')), "{all:?}");
}

#[test]
fn a_change_of_an_empty_range_is_one_of_its_line() {
    let mut session = Session::new(&[]);
    let text = DRILLED.replace("G80\nM30", "G80\nG0 Z50.\nM30");
    session.open("a.nc", &text);
    let uri = session.uri("a.nc");
    let asked = |range: Option<[u32; 4]>| {
        let range = range.map(range_of);
        let argument = json!({ "uri": uri, "change": "translate", "z": "1", "range": range });
        json!({ "command": "gcheck.changePath", "arguments": [argument] })
    };
    let mut lines = |range| {
        ask(&mut session, "workspace/executeCommand", asked(range));
        let edit =
            session.client.requests.iter().rev().find(|asked| asked["method"] == "workspace/applyEdit");
        let edit = edit.unwrap()["params"]["edit"]["documentChanges"][0].clone();
        let edits = edit["edits"].as_array().unwrap();
        edits.iter().map(|edit| edit["range"]["start"]["line"].as_u64().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(lines(Some([4, 3, 4, 3])), [4], "an empty range");
    assert_eq!(lines(Some([4, 0, 5, 0])), [4], "a whole line");
    assert_eq!(lines(None), [4, 5, 5, 7]);
    assert_eq!(lines(Some([0, 0, 11, 0])), [4, 5, 5, 7], "all lines, to the end of the last");
    let count = session.client.requests.len();
    for (range, reason) in [
        ([40, 0, 50, 3], "the range is not in the program, which has 11 lines"),
        ([4, 0, 40, 0], "the range is not in the program"),
        ([11, 0, 11, 0], "the range is not in the program"),
        ([5, 0, 4, 0], "the range ends before it begins"),
        ([4, 5, 4, 2], "the range ends before it begins"),
    ] {
        let refused = session.client.refused("workspace/executeCommand", asked(Some(range)));
        assert!(refused["message"].as_str().unwrap().contains(reason), "{range:?}: {refused}");
    }
    assert_eq!(session.client.requests.len(), count, "nothing is written");
}

#[test]
fn a_change_that_the_editor_does_not_write_is_refused() {
    let mut session = Session::new(&[]);
    session.open("a.nc", DRILLED);
    session.client.refuses_edits = Some("the file is read-only".to_owned());
    let argument = json!({ "uri": session.uri("a.nc"), "change": "translate", "z": "1" });
    let command = json!({ "command": "gcheck.changePath", "arguments": [argument] });
    let refused = session.client.refused("workspace/executeCommand", command.clone());
    assert_eq!(refused["message"], "the editor did not write the change: the file is read-only");
    session.client.refuses_edits = None;
    let done = ask(&mut session, "workspace/executeCommand", command);
    assert_eq!(done["changes"], true, "{done}");
}

/// A configuration that each step of somebody who types makes broken and whole again.
const SHOP: &str = "control = \"haas-mill\"\n[machine]\nunits = \"mm\"\nmax_rpm = 8000\n[tools]\n3 = { length = 80.0 }\n[offsets]\nG54 = { X = -400.0 }\n\"G154 P2\" = { X = 1.0 }\n[codes]\nM51 = { title = \"door\", alias = \"O9010\" }\n";

#[test]
fn a_configuration_has_hover_completion_and_findings_while_it_is_typed() {
    let mut session = Session::new(&[("gcheck.toml", SHOP)]);
    session.open("gcheck.toml", SHOP);
    assert_eq!(session.published("gcheck.toml", 1), [] as [&str; 0]);
    let at = session.at("gcheck.toml", 3, 2);
    let hover = ask(&mut session, "textDocument/hover", at);
    let told = hover["contents"]["value"].as_str().unwrap();
    assert!(told.starts_with("**machine.max_rpm**: number\n\nHighest spindle speed, in 1/min."), "{told}");
    session.edit("gcheck.toml", 2, [2, 9, 2, 11], "inches");
    let found = session.published("gcheck.toml", 2);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("2:8-2:16"), "{found:?}");
    session.edit("gcheck.toml", 3, [2, 9, 2, 15], "i");
    session.published("gcheck.toml", 3);
    let at = session.at("gcheck.toml", 2, 10);
    let list = ask(&mut session, "textDocument/completion", at);
    assert_eq!(list["items"].as_array().unwrap().len(), 1, "{list}");
    assert_eq!(list["items"][0]["label"], "inch");
    session.edit("gcheck.toml", 4, [2, 9, 2, 10], "inch");
    assert_eq!(session.published("gcheck.toml", 4), [] as [&str; 0]);
    // Every key of somebody who types it anew has an answer, and soon.
    session.edit("gcheck.toml", 5, [0, 0, 99, 0], "");
    let (mut line, mut character) = (0, 0);
    let mut slowest = std::time::Duration::ZERO;
    let mut version = 5;
    for typed in SHOP.chars() {
        version += 1;
        session.edit("gcheck.toml", version, [line, character, line, character], &typed.to_string());
        (line, character) = if typed == '\n' { (line + 1, 0) } else { (line, character + 1) };
        let at = session.at("gcheck.toml", line, character);
        let start = std::time::Instant::now();
        ask(&mut session, "textDocument/completion", at.clone());
        ask(&mut session, "textDocument/hover", at);
        slowest = slowest.max(start.elapsed());
    }
    let most = if cfg!(debug_assertions) { 2_000 } else { 200 };
    assert!(slowest.as_millis() < most, "both within {slowest:?}");
    assert_eq!(session.published("gcheck.toml", version), [] as [&str; 0]);
}

#[test]
fn a_file_in_toml_that_is_not_ours_has_no_answers() {
    let mut session = Session::new(&[]);
    session.open("other.toml", SHOP);
    let at = session.at("other.toml", 3, 2);
    assert_eq!(ask(&mut session, "textDocument/hover", at.clone()), Value::Null);
    assert_eq!(ask(&mut session, "textDocument/completion", at)["items"], json!([]));
}

/// Where a word of `a.nc` leads, by name of the file.
fn places(session: &mut Session, line: u32, character: u32) -> Vec<String> {
    let at = session.at("a.nc", line, character);
    let found = ask(session, "textDocument/definition", at);
    let place = |found: &Value| {
        let (uri, range) = match &found["targetUri"] {
            Value::Null => (&found["uri"], &found["range"]),
            uri => (uri, &found["targetSelectionRange"]),
        };
        let name = uri.as_str().unwrap().rsplit('/').next().unwrap().to_owned();
        format!("{name} {}", crate::session::shown(range))
    };
    found.as_array().unwrap().iter().map(place).collect()
}

#[test]
fn words_of_a_program_lead_into_its_tool_table() {
    let program = "T3 M6\nG43 H3 Z5\nT4 M6\nT5 M6\nM2\n";
    let table = "; tools of the router\nT1 P1 D6\nT3 P3 Z40 D8 ;drill \nT5 oops\n";
    let shop = "control = \"linuxcnc\"\n[tools]\ntable = \"shop/tool.tbl\"\n";
    let mut session = Session::new(&[("gcheck.toml", shop), ("shop/tool.tbl", table)]);
    session.open("a.nc", program);
    assert_eq!(places(&mut session, 0, 1), ["tool.tbl 2:0-2:19"]);
    assert_eq!(places(&mut session, 1, 5), ["tool.tbl 2:0-2:19"], "`H3` is the same line");
    assert_eq!(places(&mut session, 2, 1), [] as [&str; 0], "a tool that is not in the table");
    assert_eq!(places(&mut session, 3, 1), [] as [&str; 0], "a line with a mistake is none of a tool");
    let mut at = session.at("a.nc", 0, 1);
    at["context"] = json!({ "includeDeclaration": true });
    let found = ask(&mut session, "textDocument/references", at);
    let uris: Vec<&str> =
        found.as_array().unwrap().iter().map(|place| place["uri"].as_str().unwrap()).collect();
    assert!(uris.iter().any(|uri| uri.ends_with("/shop/tool.tbl")), "{uris:?}");
    // The entry of the configuration wins, and comes first.
    let both = "control = \"linuxcnc\"\n[tools]\ntable = \"tools.csv\"\n3 = { length = 1 }\n";
    let mut session = Session::new(&[("gcheck.toml", both), ("tools.csv", "tool;length\nT3;40,5\n")]);
    session.open("a.nc", program);
    assert_eq!(places(&mut session, 0, 1), ["gcheck.toml 3:0-3:1", "tools.csv 1:0-1:7"]);
    // A file that is not text, or is not there, has no lines.
    let gone = "control = \"linuxcnc\"\n[tools]\ntable = \"gone.tbl\"\n";
    let mut session = Session::new(&[("gcheck.toml", gone)]);
    session.open("a.nc", program);
    assert_eq!(places(&mut session, 0, 1), [] as [&str; 0]);
}

#[test]
fn words_of_a_program_lead_into_its_configuration() {
    let program = "O1\nT3 M6\nG54 G43 H3 Z5.\nG154 P2\nM51\nT4 M6\nM30\n";
    let called = "O9010\nM99\n";
    let mut session = Session::new(&[("gcheck.toml", SHOP), ("O9010.nc", called)]);
    session.open("a.nc", program);
    assert_eq!(places(&mut session, 1, 1), ["gcheck.toml 5:0-5:1"]);
    assert_eq!(places(&mut session, 2, 9), ["gcheck.toml 5:0-5:1"]);
    assert_eq!(places(&mut session, 2, 1), ["gcheck.toml 7:0-7:3"]);
    assert_eq!(places(&mut session, 3, 2), ["gcheck.toml 8:0-8:9"]);
    assert_eq!(places(&mut session, 5, 1), [] as [&str; 0]);
    let of_code = places(&mut session, 4, 1);
    assert!(of_code.contains(&"gcheck.toml 10:0-10:3".to_owned()), "{of_code:?}");
    // What is in the editor counts, broken as it may be.
    session.open("gcheck.toml", &format!("control =\n{SHOP}"));
    assert_eq!(places(&mut session, 1, 1), ["gcheck.toml 6:0-6:1"]);
}
