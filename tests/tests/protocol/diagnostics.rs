//! Findings in the editor: when they come, what they look like, when they go.
//!
//! Knows: the protocol's two ways of diagnostics. Must not know: rules, but for the few that the programs here show.

use std::fs;

use expect_test::expect;
use serde_json::{Value, json};

use crate::session::{Session, pulling, usual};

/// Nobody has said a feed.
const NO_FEED: &str = "%\nO1\nG21 G17 G40 G49 G80 G90 G94\nG54\nG0 X0.\nG1 X1.\nM30\n%\n";

#[test]
fn findings_follow_the_text() {
    let mut session = Session::new(&[]);
    session.open("a.nc", NO_FEED);
    expect!["5:0-5:6 warning feed-missing"].assert_eq(&session.published("a.nc", 1).join("\n"));
    session.edit("a.nc", 2, [5, 6, 5, 6], " F100.");
    expect![[r""]].assert_eq(&session.published("a.nc", 2).join("\n"));
    session.edit("a.nc", 3, [5, 6, 5, 12], "");
    assert!(session.published("a.nc", 3).join("\n").contains("feed-missing"));
}

#[test]
fn a_diagnostic_says_where_why_and_where_to_read_more() {
    let mut session = Session::new(&[]);
    session.open("a.nc", "(gcheck: control=haas-mill)\n%\nO1\nG90 G1 G0 X1. F100.\nM30\n%\n");
    let all = session.published_whole("a.nc", 1);
    let found = all.iter().find(|found| found["code"] == "two-codes-of-one-group").unwrap();
    let shown = serde_json::to_string_pretty(found).unwrap().replace(&session.uri(""), "file:///work/");
    expect![[r#"
        {
          "code": "two-codes-of-one-group",
          "codeDescription": {
            "href": "https://github.com/gcheck/gcheck/blob/main/docs/rules/two-codes-of-one-group.md"
          },
          "message": "`G1` and `G0` belong to one modal group\nrapid positioning, the same group\nnote: `G1` and `G0` both set motion (group 01); only one can be active  [HM17 p.243; general knowledge (default)]\nhelp: keep one of the two, or put them in separate blocks",
          "range": {
            "end": {
              "character": 9,
              "line": 3
            },
            "start": {
              "character": 7,
              "line": 3
            }
          },
          "relatedInformation": [
            {
              "location": {
                "range": {
                  "end": {
                    "character": 6,
                    "line": 3
                  },
                  "start": {
                    "character": 4,
                    "line": 3
                  }
                },
                "uri": "file:///work/a.nc"
              },
              "message": "straight cut at feed"
            }
          ],
          "severity": 1,
          "source": "gcheck"
        }"#]].assert_eq(&shown);
}

#[test]
fn a_client_without_them_gets_no_related_places_tags_or_links() {
    let mut session = Session::with(&json!({}), &[]);
    session.open("a.nc", "(gcheck: control=haas-mill)\n%\nO1\nG90 G1 G0 X1. F100.\nM30\nG0 X1.\n%\n");
    for found in session.published_whole("a.nc", 1) {
        for member in ["relatedInformation", "tags", "codeDescription"] {
            assert!(found.get(member).is_none(), "{found}");
        }
    }
}

#[test]
fn a_document_that_is_closed_has_no_findings() {
    let mut session = Session::new(&[]);
    session.open("a.nc", NO_FEED);
    assert!(!session.published("a.nc", 1).is_empty());
    let uri = session.uri("a.nc");
    session.client.notify("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    session.client.notification("textDocument/publishDiagnostics", |params| {
        params["uri"] == uri.as_str() && params["diagnostics"] == json!([])
    });
}

#[test]
fn no_more_than_a_thousand_are_shown_and_the_rest_counted() {
    let mut session = Session::told(&usual(), &json!({ "foldRepeats": false }), &[]);
    let text = format!("(gcheck: control=haas-mill)\n%\nO1\n{}M30\n%\n", "G0 G1 X1. F100.\n".repeat(1_500));
    session.open("a.nc", &text);
    let all = session.published_whole("a.nc", 1);
    assert_eq!(all.len(), 1_001);
    let last = all.last().unwrap();
    assert_eq!(last["severity"], 3);
    let message = last["message"].as_str().unwrap();
    assert!(message.contains("not shown: two-codes-of-one-group"), "{message}");
}

#[test]
fn repeats_of_a_rule_are_one_finding_unless_the_user_wants_all() {
    let text = format!("(gcheck: control=haas-mill)\n%\nO1\n{}M30\n%\n", "G0 G1 X1. F100.\n".repeat(40));
    let of_the_rule = |session: &mut Session| -> Vec<Value> {
        let mut all = session.published_whole("a.nc", 1);
        all.retain(|found| found["code"] == "two-codes-of-one-group");
        all
    };
    let mut session = Session::new(&[]);
    session.open("a.nc", &text);
    let folded = of_the_rule(&mut session);
    assert_eq!(folded.len(), 6);
    let last = &folded[5];
    let message = last["message"].as_str().unwrap();
    assert!(message.starts_with("… and 35 more of two-codes-of-one-group, lines 9 to 43\n"), "{message}");
    assert_eq!((&last["severity"], &last["range"]["start"]["line"]), (&folded[0]["severity"], &json!(8)));
    // What is set takes effect at once.
    session.client.settings = json!({ "foldRepeats": false });
    session.client.notify("workspace/didChangeConfiguration", json!({ "settings": null }));
    assert_eq!(of_the_rule(&mut session).len(), 40);
}

#[test]
fn of_a_large_program_the_first_lines_are_told_before_the_rest() {
    let head =
        "%\n(gcheck: control=haas-mill)\nO1\nG21 G17 G40 G49 G80 G90 G94\nG54\nG0 X0.\nG1 X1.\nG0 X2.\n";
    let text = format!("{head}{}G999\nM30\n%\n", "X1.5 Y2.25\nX2.5 Y3.25\n".repeat(120_000));
    let mut session = Session::new(&[]);
    session.open("a.nc", &text);
    // What is asked about the first lines does not have to wait for the rest either.
    let hover = session.at("a.nc", 6, 0);
    let hover = session.client.send_request("textDocument/hover", hover);
    let first = session.published("a.nc", 1);
    expect!["6:0-6:6 error feed-missing"].assert_eq(&first.join("\n"));
    let all = session.published("a.nc", 1);
    assert!(first.iter().all(|finding| all.contains(finding)), "{all:?}");
    assert!(all.iter().any(|finding| finding.ends_with("unknown-code")), "{all:?}");
    assert!(session.client.answer(hover)["result"].to_string().contains("in effect:"));
    // After that, findings come at once.
    session.edit("a.nc", 2, [6, 6, 6, 6], " F100.");
    assert!(!session.published("a.nc", 2).iter().any(|finding| finding.ends_with("feed-missing")));
}

#[test]
fn who_asks_for_findings_is_not_sent_them() {
    let mut session = Session::with(&pulling(), &[]);
    assert_eq!(session.capabilities["diagnosticProvider"]["workspaceDiagnostics"], true);
    session.open("a.nc", NO_FEED);
    let document = session.document("a.nc");
    let report = session.pull(&document);
    assert_eq!(report["kind"], "full");
    let findings = session.pulled("a.nc");
    assert!(findings.iter().any(|finding| finding.contains("feed-missing")), "{findings:?}");

    let asked_again = json!({
        "textDocument": { "uri": session.uri("a.nc") }, "previousResultId": report["resultId"],
    });
    let report = session.pull(&asked_again);
    assert_eq!(report["kind"], "unchanged");
    session.edit("a.nc", 2, [5, 6, 5, 6], " F100.");
    let report = session.pull(&asked_again);
    assert_eq!(report["kind"], "full");
    assert!(!session.pulled("a.nc").iter().any(|finding| finding.contains("feed-missing")));
    session.client.receive_waiting();
    let pushed = |message: &Value| {
        message["method"] == "textDocument/publishDiagnostics"
            && message["params"]["uri"] == session.uri("a.nc")
    };
    assert!(!session.client.notifications.iter().any(pushed));
    let other = Session::with(&usual(), &[]);
    assert!(other.capabilities.get("diagnosticProvider").is_none());
}

#[test]
fn programs_of_the_workspace_are_checked_without_being_open() {
    let files = [("a.nc", NO_FEED), ("sub/b.nc", "%\nO2\nM30\n%\n"), ("sub/read.me", "G1 X1.")];
    let mut session = Session::with(&pulling(), &files);
    let report = session.client.request("workspace/diagnostic", json!({ "previousResultIds": [] }));
    let items = report["items"].as_array().unwrap().clone();
    let of = |items: &[Value], uri: &str| items.iter().find(|item| item["uri"] == uri).cloned();
    assert_eq!(items.len(), 2, "{items:?}");
    let first = of(&items, &session.uri("a.nc")).unwrap();
    let rules: Vec<&Value> = first["items"].as_array().unwrap().iter().map(|found| &found["code"]).collect();
    assert!(rules.contains(&&json!("feed-missing")), "{rules:?}");

    // What has not changed is not said again.
    fs::write(session.path("sub/b.nc"), "%\nO2\nG1 X1.\nM30\n%\n").unwrap();
    std::thread::sleep(std::time::Duration::from_millis(2_100));
    let known: Vec<Value> =
        items.iter().map(|item| json!({ "uri": item["uri"], "value": item["resultId"] })).collect();
    let report = session.client.request("workspace/diagnostic", json!({ "previousResultIds": known }));
    let items = report["items"].as_array().unwrap().clone();
    assert_eq!(of(&items, &session.uri("a.nc")).unwrap()["kind"], "unchanged");
    assert_eq!(of(&items, &session.uri("sub/b.nc")).unwrap()["kind"], "full");
}

#[test]
fn a_caller_is_checked_again_when_what_it_calls_is_typed() {
    let caller = "%\nO1\nG21 G17 G40 G49 G80 G90 G94\nG54\nM98 P100\nM30\n%\n";
    let mut session = Session::new(&[]);
    session.open("a.nc", caller);
    assert!(session.published("a.nc", 1).join("\n").contains("subprogram-missing"));
    session.open("b.nc", "%\nO100\nM99\n%\n");
    let uri = session.uri("a.nc");
    session.client.notification("textDocument/publishDiagnostics", |params| {
        let all = params["diagnostics"].to_string();
        params["uri"] == uri.as_str() && !all.contains("subprogram-missing")
    });
    session.edit("b.nc", 2, [1, 1, 1, 4], "200");
    session.client.notification("textDocument/publishDiagnostics", |params| {
        let all = params["diagnostics"].to_string();
        params["uri"] == uri.as_str() && all.contains("subprogram-missing")
    });
}

#[test]
fn a_caller_is_checked_again_when_its_own_head_is_typed_after_what_it_calls() {
    let caller = "O1\nG21 G90 G54\nG0 X0. Y0.\nM98 P9010\nG0 Z50.\nM30\n";
    let mut session = Session::with(&pulling(), &[]);
    session.open("callee.nc", "O9010\nG4 P100\nM99\n");
    session.open("a.nc", caller);
    assert!(!session.pulled("a.nc").join("\n").contains("incremental-left-on"));
    // Nothing is asked between the two: the choice of the control and the programs that are called are looked at together.
    session.change("callee.nc", 2, &json!([{ "text": "O9010\nG91 G1 X1. F200.\nM99\n" }]));
    session.edit("a.nc", 2, [2, 0, 2, 0], " ");
    let found = session.pulled("a.nc").join("\n");
    assert!(found.contains("incremental-left-on"), "{found}");
}
