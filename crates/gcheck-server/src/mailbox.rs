//! The one channel to the thread that owns everything.
//!
//! Knows: what waits there, so that work in hand can be given up for it. Must not know: what the work is.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::sync::oneshot;

use crate::owner::Owner;
use crate::proto::{Error, Result};

/// Work for the owner.
type Work = Box<dyn FnOnce(&mut Owner) + Send>;

/// What kind of work it is, as far as work in hand is concerned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Makes what is being worked out stale: edits.
    Change,
    /// Somebody waits for an answer, or a change is rare enough to wait for one.
    Question,
    /// The result of work elsewhere.
    Result,
}

/// A piece of work with its name for the log.
pub(crate) struct Letter {
    pub(crate) name: &'static str,
    kind: Kind,
    pub(crate) work: Work,
}

/// The way to the owner.
#[derive(Debug, Clone)]
pub(crate) struct Mailbox {
    sender: Sender<Letter>,
    waiting: Arc<Waiting>,
}

/// How much waits.
#[derive(Debug, Default)]
pub(crate) struct Waiting {
    changes: AtomicUsize,
    questions: AtomicUsize,
}

impl Waiting {
    /// Something waits that makes work in hand stale.
    pub(crate) fn has_changes(&self) -> bool {
        self.changes.load(Ordering::Acquire) > 0
    }

    /// Somebody waits for an answer.
    pub(crate) fn has_questions(&self) -> bool {
        self.questions.load(Ordering::Acquire) > 0
    }

    fn of(&self, kind: Kind) -> Option<&AtomicUsize> {
        match kind {
            Kind::Change => Some(&self.changes),
            Kind::Question => Some(&self.questions),
            Kind::Result => None,
        }
    }
}

/// The owner's end.
#[derive(Debug)]
pub(crate) struct Inbox {
    receiver: Receiver<Letter>,
    waiting: Arc<Waiting>,
}

/// Makes the channel.
pub(crate) fn mailbox() -> (Mailbox, Inbox) {
    let (sender, receiver) = channel();
    let waiting = Arc::new(Waiting::default());
    (Mailbox { sender, waiting: Arc::clone(&waiting) }, Inbox { receiver, waiting })
}

impl Mailbox {
    /// Posts work. With the owner gone there is nobody left to do it.
    pub(crate) fn post(
        &self,
        name: &'static str,
        kind: Kind,
        work: impl FnOnce(&mut Owner) + Send + 'static,
    ) {
        if let Some(count) = self.waiting.of(kind) {
            count.fetch_add(1, Ordering::AcqRel);
        }
        let _ = self.sender.send(Letter { name, kind, work: Box::new(work) });
    }

    /// Posts a question and waits for its answer.
    ///
    /// The question is posted before this awaits anything, so that the order of questions and edits is that of the client.
    pub(crate) async fn ask<T: Send + 'static>(
        &self,
        name: &'static str,
        work: impl FnOnce(&mut Owner, Reply<T>) + Send + 'static,
    ) -> Result<T> {
        let (sender, receiver) = oneshot::channel();
        let reply = Reply(sender);
        self.post(name, Kind::Question, move |owner| {
            // Nobody waits any more for what was cancelled meanwhile.
            if !reply.is_cancelled() {
                work(owner, reply);
            }
        });
        receiver.await.unwrap_or_else(|_| Err(own_mistake()))
    }
}

/// What a request is answered with that met a mistake of our own; the log has its words.
fn own_mistake() -> Error {
    Error { message: "gcheck met a mistake of its own; the log says which".into(), ..Error::internal_error() }
}

impl Inbox {
    /// The next letter; `None` when everybody is gone, or nothing came in time.
    pub(crate) fn next(&self, patience: Duration) -> std::result::Result<Letter, RecvTimeoutError> {
        let letter = self.receiver.recv_timeout(patience)?;
        if let Some(count) = self.waiting.of(letter.kind) {
            count.fetch_sub(1, Ordering::AcqRel);
        }
        Ok(letter)
    }

    pub(crate) fn waiting(&self) -> Arc<Waiting> {
        Arc::clone(&self.waiting)
    }
}

/// The way back to who asked.
#[derive(Debug)]
pub(crate) struct Reply<T>(oneshot::Sender<Result<T>>);

impl<T> Reply<T> {
    /// Nobody waits any more.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.0.is_closed()
    }

    /// Answers.
    pub(crate) fn send(self, answer: Result<T>) {
        // Who has gone away meanwhile needs no answer.
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

impl Workers {
    pub(crate) fn start() -> Self {
        let (sender, receiver) = channel::<Box<dyn FnOnce() + Send>>();
        let receiver = Arc::new(Mutex::new(receiver));
        for _ in 0..WORKERS {
            let receiver = Arc::clone(&receiver);
            // They end with the process, or when there is nobody left to send them anything.
            std::thread::spawn(move || {
                loop {
                    let work = receiver.lock().unwrap_or_else(PoisonError::into_inner).recv();
                    let Ok(work) = work else { return };
                    // A panic drops the reply, which answers its request; the thread lives on.
                    let _ = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
                }
            });
        }
        Self { sender }
    }

    /// Hands work over.
    pub(crate) fn start_work(&self, work: impl FnOnce() + Send + 'static) {
        let _ = self.sender.send(Box::new(work));
    }
}
