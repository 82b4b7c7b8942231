//! Diagnostics for clients that ask for them: of one document, and of the whole workspace.
//!
//! Knows: when an answer may be "as before". Must not know: how findings are made.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use gcheck_db::Database;

use crate::documents::Document;
use crate::mailbox::Reply;
use crate::owner::{Owner, Unopened};
use crate::proto::{
    DocumentDiagnosticParams, DocumentDiagnosticReport, DocumentDiagnosticReportResult, Error, ErrorCode,
    FullDocumentDiagnosticReport, RelatedFullDocumentDiagnosticReport,
    RelatedUnchangedDocumentDiagnosticReport, Result, SERVER_CANCELLED, UnchangedDocumentDiagnosticReport,
    Uri, WorkspaceDiagnosticParams, WorkspaceDiagnosticReport, WorkspaceDiagnosticReportResult,
    WorkspaceDocumentDiagnosticReport, WorkspaceFullDocumentDiagnosticReport,
    WorkspaceUnchangedDocumentDiagnosticReport,
};

/// The answer when a change came in between: the client is to ask again.
fn ask_again() -> Error {
    Error {
        code: ErrorCode::ServerError(SERVER_CANCELLED),
        message: "text or settings have changed meanwhile".into(),
        data: Some(serde_json::json!({ "retriggerRequest": true })),
    }
}

/// Stands for what findings of a document depend on.
fn result_id(document: &Document, world: u64) -> String {
    format!("{world}.{}", document.clock.now())
}

impl Owner {
    pub(crate) fn pull(
        &mut self,
        params: &DocumentDiagnosticParams,
        stop: &dyn Fn() -> bool,
    ) -> Result<DocumentDiagnosticReportResult> {
        let uri = &params.text_document.uri;
        self.choose_settings(uri);
        let id = result_id(self.document(uri)?, self.world());
        if params.previous_result_id.as_ref() == Some(&id) {
            let report = RelatedUnchangedDocumentDiagnosticReport {
                related_documents: None,
                unchanged_document_diagnostic_report: UnchangedDocumentDiagnosticReport { result_id: id },
            };
            return Ok(DocumentDiagnosticReport::Unchanged(report).into());
        }
        // A user who wants findings when a program is saved is shown those of the text that was saved last.
        if !self.document(uri)?.wants_findings
            && let Some(previous) = &params.previous_result_id
        {
            let unchanged = UnchangedDocumentDiagnosticReport { result_id: previous.clone() };
            let report = RelatedUnchangedDocumentDiagnosticReport {
                related_documents: None,
                unchanged_document_diagnostic_report: unchanged,
            };
            return Ok(DocumentDiagnosticReport::Unchanged(report).into());
        }
        let analysis = self.analyse(uri, stop).map_err(|_| ask_again())?;
        let items = self.diagnostics_of(uri, analysis.as_deref());
        let report = RelatedFullDocumentDiagnosticReport {
            related_documents: None,
            full_document_diagnostic_report: FullDocumentDiagnosticReport { result_id: Some(id), items },
        };
        Ok(DocumentDiagnosticReport::Full(report).into())
    }

    /// Open documents answer for themselves; here are the programs on disk, checked on another thread one by one.
    pub(crate) fn pull_workspace(
        &mut self,
        params: WorkspaceDiagnosticParams,
        reply: Reply<WorkspaceDiagnosticReportResult>,
    ) {
        let known: BTreeMap<Uri, String> =
            params.previous_result_ids.into_iter().map(|previous| (previous.uri, previous.value)).collect();
        let open: Vec<PathBuf> = self.documents.values().map(|document| document.path.clone()).collect();
        let mut files = BTreeMap::new();
        for folder in self.folders.clone() {
            for file in self.list(&folder, true) {
                if !open.contains(&file.path) {
                    files.insert(file.path.clone(), file);
                }
            }
        }
        let checker = self.unopened();
        self.workers.start_work(move || {
            let mut items: Vec<WorkspaceDocumentDiagnosticReport> = Vec::new();
            // What is gone or open by now has nothing to say here any more.
            for uri in known.keys() {
                let is_there = crate::owner::path_of(uri).is_some_and(|path| files.contains_key(&path));
                if !is_there {
                    items.push(full(uri.clone(), FullDocumentDiagnosticReport::default()));
                }
            }
            let mut bytes = 0;
            for (path, file) in files {
                if reply.is_cancelled() {
                    return;
                }
                let Some(uri) = Uri::from_file_path(&path) else { continue };
                let id = format!("{}.{}", checker.world, file.stamp);
                if known.get(&uri) == Some(&id) {
                    items.push(unchanged(uri, id));
                    continue;
                }
                bytes += file.size;
                if items.len() >= MOST_FILES || bytes > MOST_BYTES {
                    break;
                }
                if let Some(list) = checker.check(&uri, &path, &|| reply.is_cancelled()) {
                    items.push(full(uri, FullDocumentDiagnosticReport { result_id: Some(id), items: list }));
                }
            }
            reply.send(Ok(WorkspaceDiagnosticReport { items }.into()));
        });
    }
}

/// Programs of an answer.
const MOST_FILES: usize = 2_000;
/// Bytes of programs that are checked for an answer.
const MOST_BYTES: u64 = 256 << 20;

fn full(uri: Uri, report: FullDocumentDiagnosticReport) -> WorkspaceDocumentDiagnosticReport {
    WorkspaceFullDocumentDiagnosticReport { uri, version: None, full_document_diagnostic_report: report }
        .into()
}

fn unchanged(uri: Uri, result_id: String) -> WorkspaceDocumentDiagnosticReport {
    WorkspaceUnchangedDocumentDiagnosticReport {
        uri,
        version: None,
        unchanged_document_diagnostic_report: UnchangedDocumentDiagnosticReport { result_id },
    }
    .into()
}

impl Unopened {
    /// The diagnostics of a program on disk; `None` when it cannot be read, or `stop` said yes.
    fn check(
        &self,
        uri: &Uri,
        path: &std::path::Path,
        stop: &dyn Fn() -> bool,
    ) -> Option<Vec<crate::proto::Diagnostic>> {
        let text = self.host.0.read(path)?.text;
        let mut database = Database::new();
        let settings = self.settings(path, &text)?;
        let id = database.open(&text, settings);
        let analysis = database.analysis(id, stop).ok()?;
        let snapshot = database.snapshot(id)?;
        let shown = gcheck_ide::diagnostics(&analysis, self.shown_repeats(path));
        let abilities = Arc::clone(&self.abilities);
        // Places in other files would have to be looked up by the owner.
        Some(crate::diagnostics::convert(&abilities, uri, &snapshot, &shown, &mut |_, _| None))
    }
}
