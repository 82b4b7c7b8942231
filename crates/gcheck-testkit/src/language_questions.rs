//! Every question that an editor asks a language server about its programs, and what of the answers belongs to one session
//! alone.
//!
//! Knows: methods and their parameters, which members of an answer count or name what a session has. Must not know: what is
//! answered.

use serde_json::{Value, json};

/// A request: its method and its parameters.
pub type Question = (&'static str, Value);

/// What the server says of a place whose state takes longer than a person waits.
const TO_COME: &str = "still being worked out";
/// Codes of answers that tell the client to ask again: the text has changed, the server has given the work up.
const ASK_AGAIN: [i64; 2] = [-32801, -32802];
/// Members that count or name what a session has: the number of a document, that of an answer. A list is not such a number: the
/// tokens of a text are called `data` too.
const OF_THE_SESSION: [&str; 2] = ["data", "resultId"];

/// Questions about a document as a whole, whose text ends at this place.
pub fn of_document(uri: &str, end: &Value) -> Vec<Question> {
    let range = json!({ "start": { "line": 0, "character": 0 }, "end": end });
    let params = json!({
        "textDocument": { "uri": uri }, "range": range, "context": { "diagnostics": [] },
        "options": { "tabSize": 4, "insertSpaces": true },
    });
    let methods = [
        "textDocument/documentSymbol",
        "textDocument/foldingRange",
        "textDocument/semanticTokens/full",
        "textDocument/semanticTokens/range",
        "textDocument/inlayHint",
        "textDocument/codeLens",
        "textDocument/documentLink",
        "textDocument/formatting",
        "textDocument/rangeFormatting",
        "textDocument/codeAction",
        "textDocument/diagnostic",
        "gcheck/syntaxTree",
        "gcheck/toolpath",
    ];
    methods.into_iter().map(|method| (method, params.clone())).collect()
}

/// Questions about a place in a document.
pub fn at_place(uri: &str, place: &Value) -> Vec<Question> {
    let range = json!({ "start": place, "end": place });
    let params = json!({
        "textDocument": { "uri": uri }, "position": place, "positions": [place], "range": range, "ch": "\n",
        "context": { "includeDeclaration": true, "diagnostics": [], "triggerKind": 1, "isRetrigger": false },
        "newName": "20", "options": { "tabSize": 4, "insertSpaces": true },
    });
    let methods = [
        "textDocument/hover",
        "textDocument/completion",
        "gcheck/completion",
        "textDocument/signatureHelp",
        "textDocument/definition",
        "textDocument/references",
        "textDocument/documentHighlight",
        "textDocument/prepareRename",
        "textDocument/rename",
        "textDocument/selectionRange",
        "textDocument/prepareCallHierarchy",
        "textDocument/onTypeFormatting",
        "textDocument/codeAction",
        "gcheck/stateAt",
    ];
    methods.into_iter().map(|method| (method, params.clone())).collect()
}

/// Questions about all programs at once, and about what is in no document.
pub fn of_workspace(uri: &str) -> Vec<Question> {
    vec![
        ("workspace/symbol", json!({ "query": "" })),
        ("workspace/diagnostic", json!({ "previousResultIds": [] })),
        ("gcheck/controls", json!({})),
        ("gcheck/explain", json!({ "subject": "G83", "textDocument": { "uri": uri } })),
    ]
}

/// What an editor asks of the first thing in an answer.
pub fn about_the_first(method: &str, answer: &Value) -> Vec<Question> {
    let Some(result) = answer.get("result") else { return Vec::new() };
    match method {
        "textDocument/completion" => {
            let Some(mut item) = result.pointer("/items/0").cloned() else { return Vec::new() };
            if let (Some(data), Some(members)) = (result.pointer("/itemDefaults/data"), item.as_object_mut())
            {
                members.entry("data").or_insert_with(|| data.clone());
            }
            vec![("completionItem/resolve", item)]
        }
        "textDocument/codeAction" => {
            let actions = result.as_array().map(Vec::as_slice).unwrap_or_default();
            let proved = actions.iter().find(|action| action.get("data").is_some());
            proved.map(|action| ("codeAction/resolve", action.clone())).into_iter().collect()
        }
        "textDocument/prepareCallHierarchy" => {
            let Some(item) = result.pointer("/0") else { return Vec::new() };
            vec![
                ("callHierarchy/incomingCalls", json!({ "item": item })),
                ("callHierarchy/outgoingCalls", json!({ "item": item })),
            ]
        }
        _ => Vec::new(),
    }
}

/// Is a client to ask again, because the answer is not yet known? Lenses are those of the last run until the next is over.
pub fn is_to_come(method: &str, answer: &Value) -> bool {
    let code = answer.pointer("/error/code").and_then(Value::as_i64);
    let hover = answer.pointer("/result/contents/value").and_then(Value::as_str);
    method == "textDocument/codeLens"
        || code.is_some_and(|code| ASK_AGAIN.contains(&code))
        || hover.is_some_and(|text| text.contains(TO_COME))
}

/// An answer without what belongs to one session alone.
#[must_use]
pub fn comparable(mut answer: Value) -> Value {
    if let Some(members) = answer.as_object_mut() {
        members.remove("id");
    }
    forget_session(&mut answer);
    answer
}

fn forget_session(value: &mut Value) {
    match value {
        Value::Array(list) => list.iter_mut().for_each(forget_session),
        Value::Object(members) => {
            members.retain(|name, value| value.is_array() || !OF_THE_SESSION.contains(&name.as_str()));
            members.values_mut().for_each(forget_session);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{about_the_first, comparable, is_to_come};

    #[test]
    fn numbers_of_a_session_are_not_compared() {
        let answer = |id: u32, name: &str| json!({ "id": id, "result": { "resultId": id, "items": [{ "label": name, "data": { "n": id } }] } });
        assert_eq!(comparable(answer(1, "G0")), comparable(answer(2, "G0")));
        assert_ne!(comparable(answer(1, "G0")), comparable(answer(1, "G1")));
        let tokens =
            |length: u32| json!({ "id": 1, "result": { "resultId": 1, "data": [0, 0, length, 0, 0] } });
        assert_ne!(comparable(tokens(2)), comparable(tokens(3)));
    }

    #[test]
    fn a_row_is_asked_for_with_the_data_of_its_list() {
        let list = json!({ "result": { "itemDefaults": { "data": 7 }, "items": [{ "label": "G0" }] } });
        let asked = about_the_first("textDocument/completion", &list);
        assert_eq!(asked, [("completionItem/resolve", json!({ "label": "G0", "data": 7 }))]);
    }

    #[test]
    fn an_answer_that_is_not_final_says_so() {
        assert!(is_to_come("textDocument/inlayHint", &json!({ "error": { "code": -32801 } })));
        assert!(!is_to_come("textDocument/inlayHint", &json!({ "error": { "code": -32602 } })));
        assert!(!is_to_come("textDocument/hover", &json!({ "result": null })));
    }
}
