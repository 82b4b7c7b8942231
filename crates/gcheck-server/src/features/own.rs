//! Requests of our own, beside those of the protocol: what no other language server has to tell.
//!
//! Knows: their parameters and answers. Must not know: how they are worked out.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::given_up;
use crate::mailbox::Reply;
use crate::owner::Owner;
use crate::position::Places;
use crate::proto::{Error, Position, Result, TextDocumentIdentifier, TextDocumentPositionParams, Uri};

/// A document, and a place in it where one is meant.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct OwnParams {
    text_document: TextDocumentIdentifier,
    position: Option<Position>,
}

/// What `gcheck/explain` is given.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ExplainParams {
    /// A rule or a code.
    subject: String,
    /// The document whose control reads the code.
    text_document: Option<TextDocumentIdentifier>,
    /// The control, where no document is named.
    control: Option<String>,
}

/// A control that programs may be written for.
#[derive(Debug, Serialize)]
pub(crate) struct ControlEntry {
    name: &'static str,
    title: String,
}

/// The controls, for a list to choose from.
pub(crate) fn controls() -> Vec<ControlEntry> {
    let names = gcheck_controls::names().iter();
    names
        .map(|name| {
            let title = gcheck_controls::load(name).map(|control| control.title().to_owned());
            ControlEntry { name, title: title.unwrap_or_default() }
        })
        .collect()
}

impl Owner {
    /// `gcheck/stateAt`: modes, positions, variables before and after the block at a position.
    pub(crate) fn state_at(&mut self, params: &OwnParams, stop: &dyn Fn() -> bool) -> Result<Value> {
        let uri = params.text_document.uri.clone();
        let position = params.position.unwrap_or_default();
        let at = TextDocumentPositionParams { text_document: params.text_document.clone(), position };
        let Some((id, offset)) = self.place(&at)? else { return Ok(Value::Null) };
        let state = gcheck_ide::state_at(&mut self.database, id, offset, stop).map_err(given_up)?;
        let snapshot = self.snapshot(&uri)?;
        let mut value = serde_json::to_value(state).unwrap_or_default();
        place_bytes(&mut value, &mut self.places(&snapshot));
        Ok(value)
    }

    /// `gcheck/explain`: all about a rule or a code in Markdown; `null` for what nobody knows.
    pub(crate) fn explain(&mut self, params: &ExplainParams) -> Result<Option<String>> {
        let subject = params.subject.trim();
        if let Some(document) = &params.text_document {
            self.choose_settings(&document.uri);
            // The codes of the shop are those of the document's configuration.
            let snapshot = self.snapshot(&document.uri)?;
            return Ok(gcheck_ide::explain(self.host.0.rules(), snapshot.control(), subject));
        }
        let name = params.control.as_deref().unwrap_or(gcheck_controls::fallback());
        let control =
            gcheck_controls::load(name).map_err(|error| Error::invalid_params(error.to_string()))?;
        Ok(gcheck_ide::explain(self.host.0.rules(), &control, subject))
    }

    /// `gcheck/syntaxTree`: the tree of the block at a position, or of the document, as text.
    pub(crate) fn syntax_tree(&mut self, params: &OwnParams) -> Result<String> {
        let snapshot = self.snapshot(&params.text_document.uri)?;
        let places = self.places(&snapshot);
        Ok(gcheck_ide::syntax_tree(&snapshot, params.position.map(|position| places.offset(position))))
    }

    /// A call of the program by another one of the workspace.
    pub(crate) fn caller(&mut self, uri: &Uri) -> Option<gcheck_ide::Caller> {
        let id = self.document(uri).ok()?.id;
        let files = self.workspace_of(uri).ok()?;
        gcheck_ide::caller(&files.workspace, id)
    }

    /// `gcheck/toolpath`: the moves of one run, for a picture.
    pub(crate) fn toolpath(&mut self, params: &OwnParams, reply: Reply<Value>) {
        let uri: &Uri = &params.text_document.uri;
        self.choose_settings(uri);
        let snapshot = match self.snapshot(uri) {
            Ok(snapshot) => snapshot,
            Err(error) => return reply.send(Err(error)),
        };
        let caller = self.caller(uri);
        self.answer_elsewhere(uri, true, reply, move |stop| {
            let fuel = snapshot.settings().execution.fuel;
            let path = gcheck_ide::toolpath(&snapshot, caller.as_ref(), fuel, gcheck_ide::MAX_SEGMENTS, stop);
            let path = path.map_err(given_up)?;
            Ok(serde_json::to_value(path).unwrap_or_default())
        });
    }
}

/// Members that tell a place in bytes.
const PLACES: [&str; 3] = ["start", "end", "setAt"];

/// Puts lines and columns in the place of bytes, as the client counts.
fn place_bytes(value: &mut Value, places: &mut Places<'_>) {
    match value {
        Value::Array(list) => list.iter_mut().for_each(|value| place_bytes(value, places)),
        Value::Object(members) => {
            for (name, value) in members.iter_mut() {
                let offset = value.as_u64().filter(|_| PLACES.contains(&name.as_str()));
                match offset.and_then(|offset| u32::try_from(offset).ok()) {
                    Some(offset) => {
                        *value = serde_json::to_value(places.position(offset)).unwrap_or_default();
                    }
                    None => place_bytes(value, places),
                }
            }
        }
        _ => {}
    }
}
