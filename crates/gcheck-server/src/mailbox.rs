//! The one channel to the thread that owns everything: tasks in the order in which they come.
//!
//! Knows: what waits there, so that current work can be cancelled for it. Must not know: what a task does, and to whom.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::sync::oneshot;

use crate::proto::{Error, Result};

/// What kind of task it is, as far as current work is concerned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Makes what is being worked out stale: edits.
    Change,
    /// A client waits for an answer, or a change is rare enough to wait for one.
    Question,
    /// A person waits for an answer at the cursor.
    Urgent,
    /// The result of work elsewhere.
    Result,
}

/// Work for the owner `O`, with a name for the log.
pub(crate) struct Task<O> {
    pub(crate) name: &'static str,
    kind: Kind,
    pub(crate) work: Box<dyn FnOnce(&mut O) + Send>,
}

/// The sending end of the channel to the owner `O`.
#[derive(Debug)]
pub(crate) struct Mailbox<O> {
    sender: Sender<Task<O>>,
    waiting: Arc<Waiting>,
}

impl<O> Clone for Mailbox<O> {
    fn clone(&self) -> Self {
        Self { sender: self.sender.clone(), waiting: Arc::clone(&self.waiting) }
    }
}

/// How much waits.
#[derive(Debug, Default)]
pub(crate) struct Waiting {
    changes: AtomicUsize,
    questions: AtomicUsize,
    urgent: AtomicUsize,
    results: AtomicUsize,
}

impl Waiting {
    /// Something waits that makes current work stale.
    pub(crate) fn has_changes(&self) -> bool {
        self.changes.load(Ordering::Acquire) > 0
    }

    /// A client waits for an answer.
    pub(crate) fn has_questions(&self) -> bool {
        self.has_urgent() || self.questions.load(Ordering::Acquire) > 0
    }

    /// A person waits for an answer.
    pub(crate) fn has_urgent(&self) -> bool {
        self.urgent.load(Ordering::Acquire) > 0
    }

    /// Anything waits.
    pub(crate) fn has_any(&self) -> bool {
        self.has_changes() || self.has_questions() || self.results.load(Ordering::Acquire) > 0
    }

    fn of(&self, kind: Kind) -> &AtomicUsize {
        match kind {
            Kind::Change => &self.changes,
            Kind::Question => &self.questions,
            Kind::Urgent => &self.urgent,
            Kind::Result => &self.results,
        }
    }
}

/// The owner's end.
#[derive(Debug)]
pub(crate) struct Inbox<O> {
    receiver: Receiver<Task<O>>,
    waiting: Arc<Waiting>,
}

/// Makes the channel.
pub(crate) fn mailbox<O>() -> (Mailbox<O>, Inbox<O>) {
    let (sender, receiver) = channel();
    let waiting = Arc::new(Waiting::default());
    (Mailbox { sender, waiting: Arc::clone(&waiting) }, Inbox { receiver, waiting })
}

impl<O: 'static> Mailbox<O> {
    /// Posts a task. It is dropped if the owner is gone.
    pub(crate) fn post(&self, name: &'static str, kind: Kind, work: impl FnOnce(&mut O) + Send + 'static) {
        self.waiting.of(kind).fetch_add(1, Ordering::AcqRel);
        let _ = self.sender.send(Task { name, kind, work: Box::new(work) });
    }

    /// Posts a question and waits for its answer.
    ///
    /// The question is posted before this awaits anything, so that the order of questions and edits is that of the client.
    pub(crate) async fn ask<T: Send + 'static>(
        &self,
        name: &'static str,
        work: impl FnOnce(&mut O, Reply<T>) + Send + 'static,
    ) -> Result<T> {
        self.ask_as(name, Kind::Question, work).await
    }

    /// The same for a question of some kind.
    pub(crate) async fn ask_as<T: Send + 'static>(
        &self,
        name: &'static str,
        kind: Kind,
        work: impl FnOnce(&mut O, Reply<T>) + Send + 'static,
    ) -> Result<T> {
        let (sender, receiver) = oneshot::channel();
        let reply = Reply(sender);
        self.post(name, kind, move |owner| {
            // Nothing waits for a cancelled question.
            if !reply.is_cancelled() {
                work(owner, reply);
            }
        });
        receiver.await.unwrap_or_else(|_| Err(own_mistake()))
    }
}

/// The answer to a request that failed by a bug of gcheck; the log has the message.
fn own_mistake() -> Error {
    Error { message: "an error inside gcheck; the log has the details".into(), ..Error::internal_error() }
}

impl<O> Inbox<O> {
    /// The next task.
    ///
    /// # Errors
    /// When no task came in time, or every sender is gone.
    pub(crate) fn next(&self, patience: Duration) -> std::result::Result<Task<O>, RecvTimeoutError> {
        let task = self.receiver.recv_timeout(patience)?;
        self.waiting.of(task.kind).fetch_sub(1, Ordering::AcqRel);
        Ok(task)
    }

    pub(crate) fn waiting(&self) -> Arc<Waiting> {
        Arc::clone(&self.waiting)
    }
}

/// The way back to the client that asked.
#[derive(Debug)]
pub(crate) struct Reply<T>(oneshot::Sender<Result<T>>);

impl<T> Reply<T> {
    /// The client does not wait any more.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.0.is_closed()
    }

    /// Answers.
    pub(crate) fn send(self, answer: Result<T>) {
        // A client that is gone needs no answer.
        let _ = self.0.send(answer);
    }
}

/// Threads for work that takes long and needs no database.
#[derive(Debug)]
pub(crate) struct Workers {
    sender: Sender<Box<dyn FnOnce() + Send>>,
}

/// Long work of two requests may go on side by side.
const WORKERS: usize = 2;
/// Stack of each thread that works on programs, in bytes: deep recursion of an analysis has room.
pub(crate) const STACK: usize = 64 << 20;

impl Workers {
    pub(crate) fn start() -> Self {
        let (sender, receiver) = channel::<Box<dyn FnOnce() + Send>>();
        let receiver = Arc::new(Mutex::new(receiver));
        for _ in 0..WORKERS {
            let receiver = Arc::clone(&receiver);
            // They end with the process, or when every sender is gone.
            let work = move || {
                loop {
                    let work = receiver.lock().unwrap_or_else(PoisonError::into_inner).recv();
                    let Ok(work) = work else { return };
                    // A panic drops the reply, which answers its request; the thread lives on.
                    let _ = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
                }
            };
            let started = std::thread::Builder::new().name("worker".to_owned()).stack_size(STACK).spawn(work);
            #[expect(clippy::expect_used, reason = "a server without threads cannot answer anything")]
            started.expect("the system gives threads");
        }
        Self { sender }
    }

    /// Hands work over.
    pub(crate) fn start_work(&self, work: impl FnOnce() + Send + 'static) {
        let _ = self.sender.send(Box::new(work));
    }
}
