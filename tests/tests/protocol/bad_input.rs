//! What no client should send: it is refused, or the best is made of it, and the server lives on.
//!
//! Knows: ways to be wrong. Must not know: features beyond those it needs to see the server alive.

use std::fs;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::session::{Session, usual};

const PARSE_ERROR: i64 = -32700;
const INVALID_REQUEST: i64 = -32600;
const METHOD_NOT_FOUND: i64 = -32601;
const INVALID_PARAMS: i64 = -32602;
const CANCELLED: i64 = -32800;

const PROGRAM: &str = "%\nO1\nG21 G90 G94 G54\nG0 X1.\nG1 X2. F100.\nM30\n%\n";

/// The server lives, and has the text that it should have.
fn is_alive(session: &mut Session, text: &str) {
    assert_eq!(session.text("a.nc"), text);
}

fn opened() -> Session {
    let mut session = Session::new(&[]);
    session.open("a.nc", PROGRAM);
    session
}

/// Waits for a line of the log.
fn logged(session: &mut Session, part: &str) {
    session
        .client
        .notification("window/logMessage", |params| params["message"].as_str().unwrap().contains(part));
}

#[test]
fn bytes_that_are_no_message_are_passed_over() {
    let mut session = opened();
    let bodies: [(&[u8], i64); 6] = [
        (b"{\"jsonrpc\":\"2.0\",", PARSE_ERROR),
        (b"\xFF\xFE", PARSE_ERROR),
        (b"", PARSE_ERROR),
        (b"[]", INVALID_REQUEST),
        (b"{\"jsonrpc\":\"2.0\"}", INVALID_REQUEST),
        (b"{\"jsonrpc\":\"1.0\",\"method\":\"shutdown\"}", INVALID_REQUEST),
    ];
    for (body, code) in bodies {
        session.client.send_bytes(format!("Content-Length: {}\r\n\r\n", body.len()).as_bytes());
        session.client.send_bytes(body);
        is_alive(&mut session, PROGRAM);
        let is_it = |message: &Value| message["id"].is_null() && message["error"]["code"] == code;
        assert!(session.client.notifications.iter().any(is_it), "{}", String::from_utf8_lossy(body));
        session.client.notifications.clear();
    }
    session.client.send_bytes(b"nonsense\r\n\r\nContent-Length: many\r\n\r\n");
    session.client.send_bytes(b"Content-Length: 99999999999999999999\r\n\r\n");
    is_alive(&mut session, PROGRAM);
}

#[test]
fn a_program_of_300_megabytes_is_passed_over_and_the_user_told() {
    let mut session = opened();
    let uri = session.uri("huge.nc");
    let head = format!(
        r#"{{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{{"textDocument":{{"uri":"{uri}","languageId":"gcode","version":1,"text":""#
    );
    let lines = "G1 X1. Y2. F100.\\n".repeat(1 << 16);
    let tail = r#""}}}"#;
    let times = 300_000_000 / lines.len();
    let length = head.len() + times * lines.len() + tail.len();
    session.client.send_bytes(format!("Content-Length: {length}\r\n\r\n{head}").as_bytes());
    for _ in 0..times {
        session.client.send_bytes(lines.as_bytes());
    }
    session.client.send_bytes(tail.as_bytes());
    session.client.notification("window/showMessage", |params| {
        let message = params["message"].as_str().unwrap();
        message.contains("reads at most 256 MB") && message.contains("`gcheck check`")
    });
    is_alive(&mut session, PROGRAM);
}

#[test]
fn an_answer_that_nobody_waits_for_is_passed_over() {
    let mut session = opened();
    let body = r#"{"jsonrpc":"2.0","id":4711,"result":null}"#;
    session.client.send_bytes(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    is_alive(&mut session, PROGRAM);
}

#[test]
fn unknown_methods_are_refused_and_unknown_notifications_passed_over() {
    let mut session = opened();
    for method in ["textDocument/moonPhase", "gcheck/moonPhase", "$/moonPhase", "moonPhase", ""] {
        assert_eq!(session.client.refused(method, json!({}))["code"], METHOD_NOT_FOUND, "{method}");
        assert_eq!(session.client.refused(method, Value::Null)["code"], METHOD_NOT_FOUND, "{method}");
    }
    session.client.notify("workspace/didDance", json!({}));
    session.client.notify("$/moonRise", json!({}));
    session.client.notify("$/setTrace", json!({ "value": "verbose" }));
    is_alive(&mut session, PROGRAM);
}

#[test]
fn parameters_of_another_shape_are_refused() {
    let mut session = opened();
    for params in [Value::Null, json!([]), json!({ "textDocument": 5 }), json!({ "position": {} })] {
        assert_eq!(session.client.refused("textDocument/hover", params)["code"], INVALID_PARAMS);
    }
    session.client.notify("textDocument/didChange", json!({ "textDocument": null }));
    session.client.notify("textDocument/didOpen", json!(7));
    is_alive(&mut session, PROGRAM);
}

#[test]
fn a_document_that_is_not_open_cannot_be_asked_about() {
    let mut session = opened();
    for method in [
        "textDocument/hover",
        "textDocument/completion",
        "textDocument/definition",
        "textDocument/prepareRename",
        "textDocument/documentHighlight",
        "gcheck/stateAt",
        "gcheck/toolpath",
        "gcheck/syntaxTree",
    ] {
        let at = session.at("b.nc", 0, 0);
        assert_eq!(session.client.refused(method, at)["code"], INVALID_PARAMS, "{method}");
    }
    session.edit("b.nc", 2, [0, 0, 0, 0], "G0");
    logged(&mut session, "is not open");
    let document = session.document("b.nc");
    session.client.notify("textDocument/didClose", document);
    logged(&mut session, "is not open");
    is_alive(&mut session, PROGRAM);
}

#[test]
fn positions_that_the_text_does_not_have_are_the_nearest() {
    let mut session = opened();
    let far = 1_000_000;
    for (line, character) in [(far, 0), (0, far), (far, far), (u32::MAX, u32::MAX), (7, 0)] {
        for method in
            ["textDocument/hover", "textDocument/completion", "textDocument/definition", "gcheck/stateAt"]
        {
            let at = session.at("a.nc", line, character);
            session.client.request(method, at);
        }
    }
    session.edit("a.nc", 2, [3, 3, 3, far], "Y1.");
    session.edit("a.nc", 3, [far, 0, far, far], "(END)\n");
    session.edit("a.nc", 4, [1, 2, 1, 1], "7");
    let text = PROGRAM.replace("X1.", "Y1.").replace("O1", "O7") + "(END)\n";
    is_alive(&mut session, &text);
}

#[test]
fn a_version_that_goes_back_is_logged_and_its_text_taken() {
    let mut session = opened();
    session.edit("a.nc", 5, [3, 3, 3, 6], "X5.");
    session.edit("a.nc", 3, [3, 3, 3, 6], "X3.");
    logged(&mut session, "version 3 comes after 5");
    is_alive(&mut session, &PROGRAM.replace("X1.", "X3."));
}

#[test]
fn a_document_opened_twice_has_the_second_text() {
    let mut session = opened();
    session.open("a.nc", "M30\n");
    logged(&mut session, "though it is open");
    is_alive(&mut session, "M30\n");
    let document = session.document("a.nc");
    session.client.notify("textDocument/didClose", document.clone());
    assert_eq!(session.client.refused("gcheck/syntaxTree", document)["code"], INVALID_PARAMS);
}

#[test]
fn files_that_vanish_and_files_that_are_no_utf_8_disturb_nothing() {
    let caller = "%\nO1\nM98 P100\nM98 P200\nM98 P300\nM30\n%\n";
    let mut session = Session::new(&[("O100.nc", "O100\nM99\n"), ("O200.nc", "")]);
    fs::write(session.path("O200.nc"), b"O200 (Fr\xE4sen)\nG0 X1.\nM99\n").unwrap();
    fs::create_dir(session.path("O300.nc")).unwrap();
    session.open("a.nc", caller);
    session.published("a.nc", 1);
    let at = session.at("a.nc", 3, 6);
    let target = session.client.request("textDocument/definition", at);
    assert_eq!(target[0]["uri"], session.uri("O200.nc"));
    fs::remove_file(session.path("O100.nc")).unwrap();
    let changed = json!({ "changes": [{ "uri": session.uri("O100.nc"), "type": 3 }] });
    session.client.notify("workspace/didChangeWatchedFiles", changed);
    let at = session.at("a.nc", 2, 6);
    assert_eq!(session.client.request("textDocument/definition", at), json!([]));
    is_alive(&mut session, caller);
}

#[test]
fn addresses_that_are_no_files_are_documents_like_others() {
    let mut session = Session::new(&[]);
    for uri in ["untitled:Untitled-1", "git:/shop/a.nc?x", "file:///no/such/folder/%20a%25.nc", "x:"] {
        let document =
            json!({ "uri": uri, "languageId": "gcode", "version": 1, "text": "%\nO1\nG1 X1.\nM30\n%\n" });
        session.client.notify("textDocument/didOpen", json!({ "textDocument": document }));
        let published = session.client.notification("textDocument/publishDiagnostics", |p| p["uri"] == uri);
        assert!(!published["diagnostics"].as_array().unwrap().is_empty(), "{uri}");
    }
}

#[test]
fn what_is_cancelled_is_answered_all_the_same() {
    let mut session = Session::with(&usual(), &[]);
    session.open("a.nc", &gcheck_testkit::inputs::macros(3_000));
    let mut asked = Vec::new();
    for line in 0..200 {
        let at = session.at("a.nc", line, 1);
        let method = ["textDocument/hover", "gcheck/stateAt", "gcheck/toolpath"][line as usize % 3];
        asked.push(session.client.send_request(method, at));
    }
    for id in &asked {
        session.client.notify("$/cancelRequest", json!({ "id": id }));
    }
    session.client.notify("$/cancelRequest", json!({ "id": 999_999 }));
    session.client.notify("$/cancelRequest", json!({ "id": "none" }));
    let mut cancelled = 0;
    for id in asked {
        let answer = session.client.answer(id);
        match answer.get("error") {
            Some(error) => {
                assert_eq!(error["code"], CANCELLED, "{answer}");
                cancelled += 1;
            }
            None => assert!(answer.get("result").is_some(), "{answer}"),
        }
    }
    assert!(cancelled > 0, "the last of them waited long enough to be cancelled");
    let at = session.at("a.nc", 0, 0);
    session.client.request("textDocument/hover", at);
}

#[test]
fn the_same_number_for_two_requests_at_once_is_refused() {
    let mut session = Session::new(&[]);
    session.open("a.nc", &gcheck_testkit::inputs::macros(3_000));
    let body = json!({
        "jsonrpc": "2.0", "id": "twice", "method": "gcheck/toolpath",
        "params": session.document("a.nc"),
    })
    .to_string();
    let framed = format!("Content-Length: {}\r\n\r\n{body}", body.len());
    session.client.send_bytes((framed.clone() + &framed).as_bytes());
    // Whatever comes of the second, the server goes on.
    let at = session.at("a.nc", 0, 0);
    session.client.request("textDocument/hover", at);
}

#[test]
fn a_run_that_nobody_waits_for_any_more_makes_way() {
    let mut session = Session::new(&[]);
    // It would run for a minute.
    session.open("endless.nc", "(gcheck: control=haas-mill)\nO1\nN1 G91 G0 X1.\nGOTO 1\nM30\n");
    session.open("short.nc", "(gcheck: control=haas-mill)\nO2\nG21 G90 G54 G0 X1. Y1.\nX2.\nM30\n");
    let endless = session.document("endless.nc");
    let start = Instant::now();
    // As many as run side by side.
    let ids = [(); 2].map(|()| session.client.send_request("gcheck/toolpath", endless.clone()));
    for id in ids {
        session.client.notify("$/cancelRequest", json!({ "id": id }));
    }
    let short = session.document("short.nc");
    let path = session.client.request("gcheck/toolpath", short);
    assert!(path["moves"].as_u64().unwrap() > 0, "{path}");
    assert!(start.elapsed() < Duration::from_secs(15), "{:?}", start.elapsed());
    for id in ids {
        assert_eq!(session.client.answer(id)["error"]["code"], CANCELLED);
    }
}
