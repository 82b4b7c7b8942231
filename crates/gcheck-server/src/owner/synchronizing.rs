//! Documents as the client opens, changes, saves and closes them.
//!
//! Knows: what the protocol says of texts. Must not know: findings.

use std::path::{Path, PathBuf};

use gcheck_db::Snapshot;

use super::{Owner, fallback_settings};
use crate::client::Moment;
use crate::documents::{Callees, Clock, Document, Stale, StatisticsRun, is_program};
use crate::proto::{
    DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams,
    DidSaveTextDocumentParams, MessageType, TextDocumentContentChangeEvent, Uri, WorkspaceDiagnosticRefresh,
};
use crate::{Choice, InForce};

impl Owner {
    pub(crate) fn did_open(&mut self, params: DidOpenTextDocumentParams) {
        let opened = params.text_document;
        let uri = opened.uri;
        self.touches += 1;
        let touched = self.touches;
        if let Some(document) = self.documents.get_mut(&uri) {
            let message = format!("{} is opened though it is open: its text is taken again", uri.as_str());
            self.outbox.log(MessageType::WARNING, message);
            self.database.set_text(document.id, &opened.text);
            document.version = opened.version;
            document.touched = touched;
            document.wants_findings = true;
            document.changed(Stale::Settings);
            self.text_changed(&uri);
            return;
        }
        let path = self.path_of(&uri);
        // Its text counts from here on, not that of the file.
        self.disk.forget_file(&path, &mut self.database);
        let id = self.database.open(&opened.text, fallback_settings());
        let document = Document {
            uri: uri.clone(),
            id,
            number: touched,
            version: opened.version,
            in_force: InForce {
                settings: None,
                choice: Choice::default(),
                style: None,
                folders: Vec::new(),
                configuration: None,
                problems: Vec::new(),
            },
            stale: Stale::Settings,
            callees: Callees::Kept,
            clock: Clock::default(),
            wants_findings: true,
            is_edited: false,
            published: None,
            looked_ahead: None,
            given_up: 0,
            failed: None,
            too_long: None,
            figures: None,
            run: StatisticsRun::Idle,
            touched,
            is_program: is_program(&opened.language_id, &path),
            path,
        };
        self.documents.insert(uri.clone(), document);
        self.text_changed(&uri);
        self.choose_settings(&uri);
    }

    pub(crate) fn did_change(&mut self, params: DidChangeTextDocumentParams) {
        let uri = params.text_document.uri;
        let version = params.text_document.version;
        self.touches += 1;
        let touched = self.touches;
        let Some(document) = self.documents.get_mut(&uri) else {
            self.log(MessageType::ERROR, format!("{} is changed, but is not open", uri.as_str()));
            return;
        };
        // The client's text is the truth in any case: an edit that is left out would make every later one wrong.
        if version <= document.version {
            let message = format!(
                "{}: version {version} comes after {}; its changes are taken all the same",
                uri.as_str(),
                document.version
            );
            self.outbox.log(MessageType::WARNING, message);
        }
        document.version = version;
        document.touched = touched;
        document.wants_findings = false;
        document.is_edited = true;
        for change in &params.content_changes {
            self.apply(&uri, change);
        }
        self.text_changed(&uri);
        let Some(document) = self.documents.get(&uri) else { return };
        let wants_findings = self.wants_findings(document);
        if let Some(document) = self.documents.get_mut(&uri) {
            document.wants_findings = wants_findings;
        }
    }

    /// Does the user want to see findings of the text as it is?
    pub(super) fn wants_findings(&self, document: &Document) -> bool {
        self.client_settings(document).run == Moment::OnType || !document.is_edited
    }

    fn apply(&mut self, uri: &Uri, change: &TextDocumentContentChangeEvent) {
        let Ok(snapshot) = self.snapshot(uri) else { return };
        let places = self.places(&snapshot);
        let bytes = change.range.map(|range| places.bytes(range));
        // What chooses the control reads whole lines.
        let line = bytes.as_ref().map(|bytes| snapshot.line_range(snapshot.line_at(bytes.start)).start);
        let in_head = line.is_none_or(|start| start as usize <= gcheck_program::EVIDENCE_BYTES);
        let Some(document) = self.documents.get_mut(uri) else { return };
        match bytes {
            None => {
                self.database.set_text(document.id, &change.text);
                document.changed(Stale::Head);
            }
            Some(bytes) => {
                // Positions are on the borders of characters, and in the text.
                if self.database.edit(document.id, bytes, &change.text).is_err() {
                    let message = format!("{}: an edit lies outside of the text", uri.as_str());
                    self.outbox.log(MessageType::ERROR, message);
                }
                document.changed(if in_head { Stale::Head } else { Stale::No });
            }
        }
    }

    pub(crate) fn did_save(&mut self, params: &DidSaveTextDocumentParams) {
        let Some(document) = self.documents.get_mut(&params.text_document.uri) else { return };
        let had_waited = !document.wants_findings;
        document.wants_findings = true;
        document.is_edited = false;
        if !document.is_program {
            // The programs that it rules over read it from disk.
            self.everything_changed();
            return;
        }
        // A client that asks for findings does so when the text changes, not when it is saved.
        if had_waited && self.abilities.pulls && self.abilities.refreshes_diagnostics {
            self.outbox.ask::<WorkspaceDiagnosticRefresh>((), |_| ());
        }
    }

    pub(crate) fn did_close(&mut self, params: DidCloseTextDocumentParams) {
        let uri = params.text_document.uri;
        let Some(document) = self.documents.remove(&uri) else {
            self.log(MessageType::WARNING, format!("{} is closed, but is not open", uri.as_str()));
            return;
        };
        self.database.close(document.id);
        self.open.remove(&document.path);
        self.callees_changed(&document.path);
        // What was pushed would stay for ever.
        if document.published.is_some() {
            self.clear(uri);
        }
        self.show_problems();
    }

    /// The text of a document has changed: who calls it has to be looked at again, and the host is to see the new text.
    fn text_changed(&mut self, uri: &Uri) {
        let Ok(snapshot) = self.snapshot(uri) else { return };
        let Some(document) = self.documents.get(uri).filter(|document| document.is_program) else { return };
        self.open.put(&document.path, snapshot);
        let path = document.path.clone();
        self.callees_changed(&path);
    }

    /// Marks the other open documents that may call a program at `path`.
    fn callees_changed(&mut self, path: &Path) {
        let folder = path.parent().unwrap_or(path);
        let callers: Vec<Uri> = self
            .documents
            .values()
            .filter(|other| other.path != path && other.in_force.folders.iter().any(|f| f == folder))
            .map(|other| other.uri.clone())
            .collect();
        for uri in callers {
            let Ok(snapshot) = self.snapshot(&uri) else { continue };
            if calls_others(&snapshot)
                && let Some(document) = self.documents.get_mut(&uri)
            {
                document.changed(Stale::Callees);
            }
        }
    }

    /// Where a document is on disk, or would be: what is not a file is taken for one in the first folder of the workspace.
    fn path_of(&self, uri: &Uri) -> PathBuf {
        path_of(uri).unwrap_or_else(|| {
            let text = uri.as_str();
            let name = text.rsplit(['/', ':']).next().unwrap_or(text);
            self.folders.first().cloned().unwrap_or_default().join(name)
        })
    }
}

/// Where a file of the client is.
pub(crate) fn path_of(uri: &Uri) -> Option<PathBuf> {
    let is_file = uri.scheme().as_str().eq_ignore_ascii_case("file");
    uri.to_file_path().filter(|_| is_file).map(std::borrow::Cow::into_owned)
}

/// Does a program call anything that may lie in another file?
fn calls_others(snapshot: &Snapshot) -> bool {
    let file_index = snapshot.file_index();
    !file_index.calls.is_empty() || !file_index.o_words.is_empty()
}
