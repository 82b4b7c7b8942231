//! Messages to the client, from whichever thread has one.
//!
//! Knows: how messages leave, which of our requests wait for an answer. Must not know: what they are about.

use std::collections::HashMap;
use std::fmt;
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;
use serde_json::Value;

use crate::framing;
use crate::proto::{
    Id, LogMessage, LogMessageParams, Message, MessageType, Notification, Request, Response, Result,
    ShowMessage, ShowMessageParams,
};

/// What is done with an answer.
type Then = Box<dyn FnOnce(Result<Value>) + Send>;

/// The way to the client.
pub(crate) struct Outbox {
    out: Mutex<Box<dyn Write + Send>>,
    /// The client went away.
    is_closed: AtomicBool,
    next: AtomicI64,
    asked: Mutex<HashMap<i64, Then>>,
}

impl fmt::Debug for Outbox {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Outbox").finish_non_exhaustive()
    }
}

impl Outbox {
    pub(crate) fn new(out: impl Write + Send + 'static) -> Self {
        Self {
            out: Mutex::new(Box::new(out)),
            is_closed: AtomicBool::new(false),
            next: AtomicI64::new(1),
            asked: Mutex::default(),
        }
    }

    fn send(&self, message: &impl Serialize) {
        if self.is_closed.load(Ordering::Relaxed) {
            return;
        }
        let mut out = self.out.lock().unwrap_or_else(PoisonError::into_inner);
        // Who does not read any more is not told anything any more; the end of its stream ends the server.
        if framing::write(&mut *out, message).is_err() {
            self.is_closed.store(true, Ordering::Relaxed);
        }
    }

    /// Answers a request of the client.
    pub(crate) fn answer(&self, response: &Response) {
        self.send(response);
    }

    /// Sends a notification.
    pub(crate) fn notify<N: Notification>(&self, params: N::Params) {
        self.notify_as(N::METHOD, params);
    }

    /// Sends a notification of a method that is our own.
    pub(crate) fn notify_as(&self, method: &'static str, params: impl Serialize) {
        // Parameters are made of texts, numbers and lists, which JSON can write.
        let params = serde_json::to_value(params).unwrap_or_default();
        self.send(&Message::build(method).params(params).finish());
    }

    /// Asks the client something; `then` gets the answer, on the thread that reads messages.
    pub(crate) fn ask<R: Request>(
        &self,
        params: R::Params,
        then: impl FnOnce(Result<R::Result>) + Send + 'static,
    ) {
        let id = self.next.fetch_add(1, Ordering::Relaxed);
        let then: Then = Box::new(|answer| {
            let read = |value| {
                serde_json::from_value(value)
                    .map_err(|error| crate::proto::Error::invalid_params(error.to_string()))
            };
            then(answer.and_then(read));
        });
        self.asked.lock().unwrap_or_else(PoisonError::into_inner).insert(id, then);
        let params = serde_json::to_value(params).unwrap_or_default();
        self.send(&Message::build(R::METHOD).id(id).params(params).finish());
    }

    /// Takes the answer to a request of ours. One that nobody waits for is passed over.
    pub(crate) fn answered(&self, response: Response) {
        let (Id::Number(id), answer) = response.into_parts() else { return };
        let then = self.asked.lock().unwrap_or_else(PoisonError::into_inner).remove(&id);
        if let Some(then) = then {
            then(answer);
        }
    }

    /// Writes a line into the client's log.
    pub(crate) fn log(&self, kind: MessageType, message: impl Into<String>) {
        self.notify::<LogMessage>(LogMessageParams { typ: kind, message: message.into() });
    }

    /// Shows a message to the user.
    pub(crate) fn show(&self, kind: MessageType, message: impl Into<String>) {
        self.notify::<ShowMessage>(ShowMessageParams { typ: kind, message: message.into() });
    }
}
