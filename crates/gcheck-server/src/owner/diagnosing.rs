//! Findings of open documents: when they are worked out, when that is given up, what becomes of them.
//!
//! Knows: what is fresh, progress that is shown. Must not know: how findings are made, how they look to the client.

use std::cell::Cell;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU32, Ordering};
use std::time::{Duration, Instant};

use gcheck_db::{Analysis, Cancelled};

use super::Owner;
use crate::diagnostics;
use crate::documents::Stale;
use crate::mailbox::Waiting;
use crate::outbox::Outbox;
use crate::proto::{
    Diagnostic, MessageType, NumberOrString, Progress, ProgressParams, ProgressParamsValue,
    PublishDiagnostics, PublishDiagnosticsParams, Uri, WorkDoneProgress, WorkDoneProgressBegin,
    WorkDoneProgressCreate, WorkDoneProgressCreateParams, WorkDoneProgressEnd,
};

/// An analysis that was given up this often for questions is brought to its end before they are answered, but for those that
/// a person waits for.
const MOST_GIVEN_UP: u32 = 20;
/// An analysis that takes longer is shown to be under way.
const SHOWN_AFTER: Duration = Duration::from_millis(500);

/// Time that the analysis of a document may take between two questions, whatever its program does.
const MOST_TIME: Duration = Duration::from_secs(2);
/// The same for each million bytes of its text: a long program is not a program without end.
const MOST_TIME_A_MEGABYTE: Duration = Duration::from_secs(1);

/// Of a document of more bytes the findings of its first lines are shown ahead of the others.
const LARGE: u32 = 2 << 20;
/// Bytes of lines that an editor may show when it opens a document: a few thousand lines.
const FIRST_LINES: usize = 64 << 10;

impl Owner {
    /// The open document whose findings are to be worked out next: the one that was touched last.
    pub(super) fn next_to_diagnose(&self) -> Option<Uri> {
        if !self.is_ready || self.abilities.pulls {
            return None;
        }
        let waiting = self.documents.values().filter(|document| {
            let now = Some(document.clock.now());
            document.wants_findings && document.published != now && document.failed != now
        });
        waiting.max_by_key(|document| document.touched).map(|document| document.uri.clone())
    }

    /// Works out the findings of a document and publishes them, unless something better comes up.
    pub(super) fn diagnose(&mut self, uri: &Uri) {
        let Some(document) = self.documents.get(uri) else { return };
        let for_questions = document.given_up < MOST_GIVEN_UP;
        let waiting = Arc::clone(&self.waiting);
        self.choose_settings(uri);
        let stop = || waiting.has_urgent() || (for_questions && waiting.has_questions());
        self.look_ahead(uri, &stop);
        let analysis = self.analyse(uri, &stop);
        if let Some(document) = self.documents.get_mut(uri) {
            // What a person waits for goes first in any case, and does not count against other questions.
            document.given_up = match &analysis {
                Ok(_) => 0,
                Err(_) if self.waiting.has_urgent() => document.given_up,
                Err(_) => document.given_up + 1,
            };
        }
        let Ok(analysis) = analysis else { return };
        let list = self.diagnostics_of(uri, analysis.as_deref());
        let Some(document) = self.documents.get_mut(uri) else { return };
        document.published = Some(document.clock.now());
        self.publish(uri, list);
    }

    /// Works out and publishes what is found in the first lines of a large document that was just opened, before anything is done
    /// that takes all of it: an editor shows these lines first. `stop` gives it up, and so does an edit.
    pub(crate) fn look_ahead(&mut self, uri: &Uri, stop: &dyn Fn() -> bool) {
        let Some(document) = self.documents.get(uri) else { return };
        let now = Some(document.clock.now());
        let is_asked_for = self.is_ready && document.wants_findings && document.in_force.settings.is_some();
        let is_new = document.published.is_none() && document.looked_ahead != now && document.failed != now;
        let id = document.id;
        if !is_asked_for || !is_new || self.database.snapshot(id).is_none_or(|text| text.len() <= LARGE) {
            return;
        }
        let waiting = Arc::clone(&self.waiting);
        let found = self.database.first_findings(id, FIRST_LINES, &|| stop() || waiting.has_changes());
        let Ok(found) = found else { return };
        if let Some(document) = self.documents.get_mut(uri) {
            document.looked_ahead = now;
        }
        // A client that asks for findings is answered once, with all of them.
        if let Some(found) = found
            && !self.abilities.pulls
        {
            let list = self.diagnostics_of(uri, Some(&found));
            self.publish(uri, list);
        }
    }

    fn publish(&self, uri: &Uri, list: Vec<Diagnostic>) {
        let version = self.documents.get(uri).map(|document| document.version);
        self.outbox.notify::<PublishDiagnostics>(PublishDiagnosticsParams::new(uri.clone(), list, version));
    }

    /// The analysis of a document as it is; `None` where nothing is in force. `stop` ends it, and so does an edit.
    ///
    /// # Errors
    /// [`Cancelled`] when it was given up.
    pub(crate) fn analyse(
        &mut self,
        uri: &Uri,
        stop: &dyn Fn() -> bool,
    ) -> Result<Option<Arc<Analysis>>, Cancelled> {
        self.choose_settings(uri);
        let document = self.documents.get(uri).ok_or(Cancelled)?;
        if document.in_force.settings.is_none() {
            return Ok(None);
        }
        if document.took_too_long() {
            return Ok(None);
        }
        let id = document.id;
        let most = time_for(self.database.snapshot(id).map_or(0, |text| text.len()));
        let waiting: &Waiting = &self.waiting;
        let shown = Shown::new(&self.outbox, self.abilities.has_progress, document.name());
        let is_over = Cell::new(false);
        let given_up = || {
            shown.look();
            is_over.set(shown.start.elapsed() > most);
            is_over.get() || stop() || waiting.has_changes()
        };
        let analysis = self.database.analysis(id, &given_up);
        drop(shown);
        if analysis.is_err() && is_over.get() {
            self.stop_trying(uri);
            return Ok(None);
        }
        analysis.map(Some)
    }

    /// The analysis used up its time: it is not tried again with this text.
    fn stop_trying(&mut self, uri: &Uri) {
        let Some(document) = self.documents.get_mut(uri) else { return };
        document.too_long = Some(document.clock.now());
        let message = format!("the analysis of {} is given up: it takes too long", document.name());
        self.outbox.log(MessageType::WARNING, message);
    }

    /// The analysis of a document if it is there already.
    pub(crate) fn known_analysis(&mut self, uri: &Uri) -> Option<Arc<Analysis>> {
        let document = self.documents.get(uri)?;
        if document.stale > Stale::No || document.in_force.settings.is_none() {
            return None;
        }
        self.database.analysis(document.id, &|| true).ok()
    }

    /// What the client is shown of an analysis, and of what kept it from being made.
    pub(crate) fn diagnostics_of(&mut self, uri: &Uri, analysis: Option<&Analysis>) -> Vec<Diagnostic> {
        let Ok(snapshot) = self.snapshot(uri) else { return Vec::new() };
        let Some(document) = self.documents.get(uri) else { return Vec::new() };
        let repeats = self.client_settings(document).shown_repeats();
        let mut list = match analysis {
            Some(analysis) => {
                let shown = gcheck_ide::diagnostics(analysis, repeats);
                let abilities = self.abilities.clone();
                let mut elsewhere = |path: &std::path::Path, bytes: &_| self.location_in(path, bytes);
                diagnostics::convert(&abilities, uri, &snapshot, &shown, &mut elsewhere)
            }
            None => Vec::new(),
        };
        let Some(document) = self.documents.get(uri) else { return list };
        list.extend(diagnostics::of_problems(document, self.abilities.encoding, &snapshot));
        list.extend(
            analysis.into_iter().flat_map(|analysis| &analysis.failed).map(|rule| diagnostics::failed(rule)),
        );
        if document.took_too_long() {
            list.push(diagnostics::given_up(time_for(snapshot.len())));
        }
        list
    }

    /// The analysis met a mistake of our own: it is not tried again with this text.
    pub(super) fn give_up_on(&mut self, uri: &Uri) {
        if let Some(document) = self.documents.get_mut(uri) {
            document.failed = Some(document.clock.now());
            let name = document.name();
            let message = format!("{name} is not checked: gcheck has an internal error");
            self.outbox.show(MessageType::WARNING, message);
        }
    }

    /// Takes back what was published of a document.
    pub(super) fn clear(&self, uri: Uri) {
        self.outbox.notify::<PublishDiagnostics>(PublishDiagnosticsParams::new(uri, Vec::new(), None));
    }

    /// Publishes what is wrong with configuration files, and takes back what no longer is.
    pub(super) fn show_problems(&mut self) {
        if !self.is_ready {
            return;
        }
        let programs = self.documents.values().filter(|document| document.is_program);
        let all = programs.flat_map(|document| &document.in_force.problems);
        let by_file = diagnostics::of_configurations(all);
        let own = |path: &PathBuf| self.documents.values().any(|document| document.path == *path);
        let gone: Vec<PathBuf> = self
            .shown_problems
            .iter()
            .filter(|path| !by_file.contains_key(*path) || own(path))
            .cloned()
            .collect();
        for path in gone {
            // What was published of it since it was opened is what counts.
            let is_told = self.documents.values().any(|d| d.path == path && d.published.is_some());
            if let Some(uri) = Uri::from_file_path(&path).filter(|_| !is_told) {
                self.clear(uri);
            }
        }
        self.shown_problems.clear();
        for (path, list) in by_file {
            // What is wrong in an open document is among its own diagnostics.
            if own(&path) {
                continue;
            }
            if let Some(uri) = Uri::from_file_path(&path) {
                self.outbox.notify::<PublishDiagnostics>(PublishDiagnosticsParams::new(uri, list, None));
                self.shown_problems.push(path);
            }
        }
    }
}

/// Time that an analysis of so many bytes may take.
fn time_for(bytes: u32) -> Duration {
    MOST_TIME + MOST_TIME_A_MEGABYTE * (bytes / 1_000_000)
}

/// Progress of one analysis: shown only when it takes long, and only after the client has agreed.
struct Shown<'o> {
    outbox: &'o Outbox,
    can: bool,
    /// Of the document.
    name: Arc<str>,
    start: Instant,
    stage: Arc<AtomicU8>,
    token: NumberOrString,
}

/// Each progress has a token of its own.
static TOKENS: AtomicU32 = AtomicU32::new(0);

const QUIET: u8 = 0;
const ASKED: u8 = 1;
const AGREED: u8 = 2;
const BEGUN: u8 = 3;
const OVER: u8 = 4;

impl<'o> Shown<'o> {
    fn new(outbox: &'o Outbox, can: bool, name: Arc<str>) -> Self {
        let start = Instant::now();
        let token = NumberOrString::String(format!("gcheck-{}", TOKENS.fetch_add(1, Ordering::Relaxed)));
        Self { outbox, can, name, start, stage: Arc::new(AtomicU8::new(QUIET)), token }
    }

    /// Takes the next step, if it is time for one.
    fn look(&self) {
        match self.stage.load(Ordering::Acquire) {
            QUIET if self.can && self.start.elapsed() > SHOWN_AFTER => {
                self.stage.store(ASKED, Ordering::Release);
                let stage = Arc::clone(&self.stage);
                let params = WorkDoneProgressCreateParams { token: self.token.clone() };
                self.outbox.ask::<WorkDoneProgressCreate>(params, move |answer| {
                    let next = if answer.is_ok() { AGREED } else { OVER };
                    // Too late when it is over already.
                    let _ = stage.compare_exchange(ASKED, next, Ordering::AcqRel, Ordering::Acquire);
                });
            }
            AGREED => {
                self.stage.store(BEGUN, Ordering::Release);
                self.tell(WorkDoneProgress::Begin(WorkDoneProgressBegin {
                    title: format!("Checking {}", self.name),
                    cancellable: Some(false),
                    message: None,
                    percentage: None,
                }));
            }
            _ => {}
        }
    }

    fn tell(&self, value: WorkDoneProgress) {
        let value = ProgressParamsValue::WorkDone(value);
        self.outbox.notify::<Progress>(ProgressParams { token: self.token.clone(), value });
    }
}

impl Drop for Shown<'_> {
    fn drop(&mut self) {
        if self.stage.swap(OVER, Ordering::AcqRel) == BEGUN {
            self.tell(WorkDoneProgress::End(WorkDoneProgressEnd { message: None }));
        }
    }
}
