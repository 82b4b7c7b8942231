//! What editors ask: each request from the protocol's words to a feature and back.
//!
//! Knows: the protocol's form of each feature. Must not know: how features come to their answers.

mod changing;
mod commands;
mod completing;
mod configuring;
mod looking;
mod navigating;
mod own;
mod pulling;
mod structure;

pub(crate) use changing::action_kinds;
pub(crate) use commands::COMMANDS;
pub(crate) use completing::CompletionList;
pub(crate) use own::{ControlEntry, ExplainParams, OwnParams, controls};

use std::ops::Range;

use gcheck_db::Cancelled;
use gcheck_diagnostics::Edit;

use crate::documents::Clock;
use crate::mailbox::Reply;
use crate::owner::Owner;
use crate::position::Places;
use crate::proto::{
    Error, ErrorCode, MarkupContent, MarkupKind, Result, TextDocumentPositionParams, TextEdit, Uri,
};

/// A document of more bytes is worked on by another thread, so that edits need not wait.
const LARGE: u32 = 1 << 20;

/// The answer when work was given up.
fn given_up(_: Cancelled) -> Error {
    Error::content_modified()
}

impl Owner {
    /// The program and the byte that a request is about; `None` for a configuration, of which most requests have nothing to say.
    fn place(&mut self, params: &TextDocumentPositionParams) -> Result<Option<(gcheck_db::DocumentId, u32)>> {
        let uri = &params.text_document.uri;
        self.choose_settings(uri);
        self.look_ahead(uri, &|| false);
        let snapshot = self.snapshot(uri)?;
        let offset = self.places(&snapshot).offset(params.position);
        let document = self.document(uri)?;
        Ok(document.is_program.then_some((document.id, offset)))
    }

    /// Answers on another thread where a document is large. What an edit has made stale meanwhile is not sent.
    fn answer_elsewhere<T: Send + 'static>(
        &self,
        uri: &Uri,
        is_large: bool,
        reply: Reply<T>,
        work: impl FnOnce(&dyn Fn() -> bool) -> Result<T> + Send + 'static,
    ) {
        self.finish_elsewhere(uri, is_large, reply, work, |answer, reply| reply.send(Ok(answer)));
    }

    /// As [`Self::answer_elsewhere`], where `then` gives the answer from what the work found.
    fn finish_elsewhere<T: Send + 'static, F: 'static>(
        &self,
        uri: &Uri,
        is_large: bool,
        reply: Reply<T>,
        work: impl FnOnce(&dyn Fn() -> bool) -> Result<F> + Send + 'static,
        then: impl FnOnce(F, Reply<T>) + Send + 'static,
    ) {
        let clock = self.documents.get(uri).map(|document| document.clock.clone()).unwrap_or_default();
        if is_large {
            self.workers.start_work(move || finish_if_fresh(&clock, reply, work, then));
        } else {
            finish_if_fresh(&clock, reply, work, then);
        }
    }
}

fn finish_if_fresh<T, F>(
    clock: &Clock,
    reply: Reply<T>,
    work: impl FnOnce(&dyn Fn() -> bool) -> Result<F>,
    then: impl FnOnce(F, Reply<T>),
) {
    let before = clock.now();
    if reply.is_cancelled() {
        return;
    }
    let found = work(&|| reply.is_cancelled() || clock.now() != before);
    match found {
        _ if clock.now() != before => reply.send(Err(Error::content_modified())),
        Ok(found) => then(found, reply),
        Err(error) => reply.send(Err(error)),
    }
}

/// A refusal in words for people.
fn refused(reason: String) -> Error {
    Error { code: ErrorCode::ServerError(crate::proto::REQUEST_FAILED), message: reason.into(), data: None }
}

fn markdown(text: String) -> MarkupContent {
    MarkupContent { kind: MarkupKind::Markdown, value: text }
}

fn text_edit(edit: Edit, places: &mut Places<'_>) -> TextEdit {
    TextEdit::new(places.range(&edit.range), edit.text)
}

fn text_edits(edits: Vec<Edit>, places: &mut Places<'_>) -> Vec<TextEdit> {
    edits.into_iter().map(|edit| text_edit(edit, places)).collect()
}

/// The part of a range that lies in the first bytes of a document.
fn within(range: &Range<u32>, len: u32) -> Range<u32> {
    range.start.min(len)..range.end.min(len)
}
