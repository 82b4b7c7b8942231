//! The thread that owns everything: it edits documents, chooses settings and computes findings, one after the other.
//!
//! Knows: the order of work, what is stale, when work is cancelled for something more urgent. Must not know: how features
//! answer, how messages travel.
//!
//! Tasks are run in the order in which they came. Findings are computed only while none waits, and that is cancelled when an
//! edit comes in; so an edit never waits, and no finding of an old text is shown.

mod diagnosing;
mod disk;
mod settings;
mod synchronizing;
mod workspace;

use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use gcheck_db::{Database, Settings, Snapshot};
use gcheck_lint::RuleTable;

use crate::client::{Abilities, ClientSettings};
use crate::documents::{Document, OpenTexts};
use crate::late_hover::LateHover;
use crate::mailbox::{Inbox, Kind, Mailbox, Reply, Task, Waiting, Workers};
use crate::outbox::Outbox;
use crate::position::Places;
use crate::proto::{Error, MessageType, Result, Uri};
use crate::{Host, OpenPrograms};
use disk::Disk;

pub(crate) use settings::Unopened;
pub(crate) use synchronizing::path_of;
pub(crate) use workspace::Addressed;

/// How long nothing may happen before the owner looks up; nothing depends on it.
const IDLE: Duration = Duration::from_mins(10);
/// A question that takes longer is given up when an edit comes in.
const PATIENCE: Duration = Duration::from_millis(50);
/// A question that takes longer is given up in any case: nobody waits for the answer any more, and other questions do.
const MOST_PATIENCE: Duration = Duration::from_secs(10);
/// What a person asks while typing or pointing is answered from the text when the state takes longer: an answer within a tenth of
/// a second reads as one at once. A build without optimisation has as much more as it is slower.
const SOON: Duration = Duration::from_millis(if cfg!(debug_assertions) { 1_600 } else { 80 });

/// Everything the server knows.
#[derive(Debug)]
pub(crate) struct Owner {
    pub(crate) outbox: Arc<Outbox>,
    pub(crate) mailbox: Mailbox<Self>,
    pub(crate) workers: Workers,
    pub(crate) abilities: Abilities,
    pub(crate) database: Database,
    /// Open documents.
    pub(crate) documents: BTreeMap<Uri, Document>,
    pub(crate) host: HostHandle,
    waiting: Arc<Waiting>,
    disk: Disk,
    open: Arc<OpenTexts>,
    /// Folders of the workspace.
    pub(crate) folders: Vec<PathBuf>,
    /// What the user has set: for each folder of the workspace where the client tells it so, then for all.
    client_settings: Vec<(Option<PathBuf>, ClientSettings)>,
    /// Files with problems of configuration that the client was told of.
    shown_problems: Vec<PathBuf>,
    /// The last hover that was answered without the state.
    pub(crate) late_hover: Option<LateHover>,
    /// What is told of the rows of the last list for a configuration, by their labels.
    pub(crate) offered: BTreeMap<String, String>,
    /// Counts changes of documents.
    touches: u64,
    /// Counts changes of files and configuration.
    world: u64,
    /// The client has said `initialized`, and may be told things.
    is_ready: bool,
    /// The session has ended.
    is_over: bool,
}

/// The host in a type of its own, because a trait object cannot be printed.
#[derive(Clone)]
pub(crate) struct HostHandle(pub(crate) Arc<dyn Host>);

impl std::fmt::Debug for HostHandle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Host")
    }
}

impl Owner {
    pub(crate) fn new(
        host: Arc<dyn Host>,
        outbox: Arc<Outbox>,
        mailbox: Mailbox<Self>,
        inbox: &Inbox<Self>,
    ) -> Self {
        Self {
            outbox,
            mailbox,
            workers: Workers::start(),
            abilities: Abilities::default(),
            database: Database::new(),
            documents: BTreeMap::new(),
            host: HostHandle(host),
            waiting: inbox.waiting(),
            disk: Disk::default(),
            open: Arc::default(),
            folders: Vec::new(),
            client_settings: vec![(None, ClientSettings::read(&serde_json::Value::Null).0)],
            shown_problems: Vec::new(),
            late_hover: None,
            offered: BTreeMap::new(),
            touches: 0,
            world: 0,
            is_ready: false,
            is_over: false,
        }
    }

    /// The session has ended: nobody waits for anything any more.
    pub(crate) fn end(&mut self) {
        self.is_over = true;
    }

    /// Works until the session ends.
    pub(crate) fn run(mut self, inbox: &Inbox<Self>) {
        while !self.is_over {
            let next = self.next_to_diagnose();
            let is_idle = next.is_none() && !self.has_late_hover();
            match (inbox.next(if is_idle { IDLE } else { Duration::ZERO }), next) {
                (Ok(task), _) => self.run_task(task),
                (Err(RecvTimeoutError::Timeout), Some(uri)) => {
                    if !self.guarded("analysis", |owner| owner.diagnose(&uri)) {
                        self.give_up_on(&uri);
                    }
                }
                (Err(RecvTimeoutError::Timeout), None) => self.use_the_pause(),
                (Err(RecvTimeoutError::Disconnected), _) => return,
            }
        }
    }

    /// Nobody asks for anything, and all findings are known.
    fn use_the_pause(&mut self) {
        if self.has_late_hover() {
            let (start, waiting) = (Instant::now(), Arc::clone(&self.waiting));
            let stop = || waiting.has_any() || start.elapsed() > MOST_PATIENCE;
            self.guarded("late hover", |owner| owner.finish_late_hover(&stop));
        }
    }

    fn run_task(&mut self, task: Task<Self>) {
        let Task { name, work, .. } = task;
        let start = self.is_traced().then(Instant::now);
        self.guarded(name, work);
        if let Some(start) = start {
            let milliseconds = start.elapsed().as_secs_f64() * 1e3;
            self.outbox.log(MessageType::LOG, format!("{name}: {milliseconds:.1} ms"));
        }
    }

    fn is_traced(&self) -> bool {
        self.is_ready && self.client_settings.iter().any(|(_, settings)| settings.trace)
    }

    /// Does work. A panic ends it and is reported; the data of the work may be broken and is made again.
    fn guarded(&mut self, name: &str, work: impl FnOnce(&mut Self)) -> bool {
        let Err(payload) = catch_unwind(AssertUnwindSafe(|| work(self))) else { return true };
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let what = text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no words");
        let message = format!(
            "a mistake of gcheck itself in {name}: {what}; please report it with the program, or as much of it as \
             you can show"
        );
        self.outbox.log(MessageType::ERROR, message);
        self.rebuild();
        false
    }

    /// Makes the database again from the texts of the open documents.
    fn rebuild(&mut self) {
        let mut database = Database::new();
        let open = self.open_programs();
        self.disk = Disk::default();
        for document in self.documents.values_mut() {
            let settings = document.in_force.settings.clone().unwrap_or_else(fallback_settings);
            // The panic may have left the database in any state; a copy of each text is kept beside it.
            let snapshot = AssertUnwindSafe(|| self.database.snapshot(document.id).map(|text| text.text()));
            let text = catch_unwind(snapshot).ok().flatten().or_else(|| open.text(&document.path));
            let text = text.unwrap_or_default();
            document.id = database.open(&text, settings);
            document.figures = None;
        }
        self.database = database;
    }

    /// Answers a question at once, on this thread.
    pub(crate) fn answer<T>(
        &mut self,
        reply: Reply<T>,
        work: impl FnOnce(&mut Self, &dyn Fn() -> bool) -> Result<T>,
    ) {
        let start = Instant::now();
        let waiting = Arc::clone(&self.waiting);
        let answer = work(self, &|| is_given_up(&reply, &waiting, start) || start.elapsed() > MOST_PATIENCE);
        reply.send(answer);
    }

    /// The same for a question that has an answer without the state: it is given when the state is not known soon.
    pub(crate) fn answer_soon<T>(
        &mut self,
        reply: Reply<T>,
        work: impl FnOnce(&mut Self, &dyn Fn() -> bool) -> Result<T>,
    ) {
        let start = Instant::now();
        let waiting = Arc::clone(&self.waiting);
        let answer = work(self, &|| is_given_up(&reply, &waiting, start) || start.elapsed() > SOON);
        // Without the state for want of time is an answer, for an edit is none.
        let is_stale = is_given_up(&reply, &waiting, start);
        reply.send(if is_stale { Err(Error::content_modified()) } else { answer });
    }

    /// The same for a question that may need an analysis: it is put off while a person waits for another answer. `asked` is when
    /// the question came.
    pub(crate) fn answer_patiently<T: Send + 'static>(
        &mut self,
        name: &'static str,
        asked: Instant,
        reply: Reply<T>,
        mut work: impl FnMut(&mut Self, &dyn Fn() -> bool) -> Result<T> + Send + 'static,
    ) {
        let start = Instant::now();
        let waiting = Arc::clone(&self.waiting);
        let is_put_off = Cell::new(false);
        let answer = work(self, &|| {
            is_put_off.set(waiting.has_urgent());
            is_put_off.get() || is_given_up(&reply, &waiting, start) || start.elapsed() > MOST_PATIENCE
        });
        // After an edit the answer would be of another text.
        let is_fresh = !reply.is_cancelled() && !waiting.has_changes() && asked.elapsed() < MOST_PATIENCE;
        if answer.is_err() && is_put_off.get() && is_fresh {
            let again = move |owner: &mut Self| owner.answer_patiently(name, asked, reply, work);
            self.mailbox.post(name, Kind::Question, again);
            return;
        }
        reply.send(answer);
    }

    /// An open document.
    pub(crate) fn document(&self, uri: &Uri) -> Result<&Document> {
        self.documents.get(uri).ok_or_else(|| not_open(uri))
    }

    /// Is it an open text that is not a program? What is asked of each open text has nothing to say of it, and must change
    /// nothing in it.
    pub(crate) fn is_configuration(&self, uri: &Uri) -> bool {
        self.documents.get(uri).is_some_and(|document| !document.is_program)
    }

    /// An open document with its text.
    pub(crate) fn snapshot(&mut self, uri: &Uri) -> Result<Snapshot> {
        let id = self.document(uri)?.id;
        self.database.snapshot(id).ok_or_else(|| not_open(uri))
    }

    /// The same for who asks for index or flow graph, which cost little after an edit.
    pub(crate) fn indexed(&mut self, uri: &Uri) -> Result<Snapshot> {
        let id = self.document(uri)?.id;
        self.database.indexed(id).ok_or_else(|| not_open(uri))
    }

    /// For translating places of a document.
    pub(crate) fn places<'s>(&self, snapshot: &'s Snapshot) -> Places<'s> {
        Places::new(snapshot, self.abilities.encoding)
    }

    /// What the user has set for a document.
    pub(crate) fn client_settings(&self, document: &Document) -> &ClientSettings {
        ClientSettings::nearest(&self.client_settings, &document.path)
    }

    /// Changes with files and configuration.
    pub(crate) fn world(&self) -> u64 {
        self.world
    }

    pub(crate) fn open_programs(&self) -> Arc<dyn OpenPrograms> {
        Arc::<OpenTexts>::clone(&self.open)
    }

    pub(crate) fn log(&self, kind: MessageType, message: impl Into<String>) {
        self.outbox.log(kind, message);
    }
}

/// Does nobody want the answer to a question that was begun at `start` any more?
fn is_given_up<T>(reply: &Reply<T>, waiting: &Waiting, start: Instant) -> bool {
    reply.is_cancelled() || (waiting.has_changes() && start.elapsed() > PATIENCE)
}

/// Settings for a text whose own nobody knows, so that it can be read at all.
fn fallback_settings() -> Settings {
    let control = gcheck_controls::load(gcheck_controls::fallback());
    #[expect(clippy::expect_used, reason = "the data of the fallback is built in and read by tests")]
    let control = control.expect("the fallback is a control");
    Settings::new(control, RuleTable::EMPTY)
}

pub(crate) fn not_open(uri: &Uri) -> Error {
    Error::invalid_params(format!("{} is not open", uri.as_str()))
}
