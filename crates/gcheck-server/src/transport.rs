//! From the stream of messages to the handlers and back.
//!
//! Knows: threads, what is answered at once and what later, when it is over. Must not know: what messages mean, but for those
//! that begin and end a session.
//!
//! `tower-lsp` has a loop of its own, which ends at the first message that is none, so the loop is here and its service is
//! what it drives.

use std::future::poll_fn;
use std::io::{BufReader, Read, Write};
use std::sync::Arc;
use std::task::Poll;
use std::thread;

use tokio::sync::mpsc::{Sender, channel};
use tower_service::Service;

use crate::Host;
use crate::framing::{self, Incoming, Kind as Came, Malformed};
use crate::handlers::{Handlers, as_handled};
use crate::mailbox::{Kind, STACK, mailbox};
use crate::outbox::Outbox;
use crate::owner::Owner;
use crate::parent::Parent;
use crate::proto::{Error, Id, LspService, Message, MessageType, Response};

/// Messages that are read ahead.
const AHEAD: usize = 256;
/// What the loop is told.
enum Event {
    Incoming(Incoming),
    /// There is nobody left at the other side.
    Gone,
}

/// How a session ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The client said `shutdown` and `exit`, as it should.
    Orderly,
    /// The client said `exit` alone.
    Abrupt,
    /// The client went away without a word.
    Vanished,
}

impl Ending {
    /// The exit code: the protocol wants 1 for `exit` without `shutdown`; that a client vanished is not a failure of ours.
    pub fn code(self) -> u8 {
        u8::from(self == Self::Abrupt)
    }
}

/// Serves a client until one of both ends it.
///
/// # Errors
/// When the system gives no threads.
pub fn serve(
    host: Arc<dyn Host>,
    input: impl Read + Send + 'static,
    output: impl Write + Send + 'static,
) -> std::io::Result<Ending> {
    let outbox = Arc::new(Outbox::new(output));
    let (mailbox, inbox) = mailbox();
    // Analyses that are kept between edits never leave the thread that makes them.
    let (to_client, to_self) = (Arc::clone(&outbox), mailbox.clone());
    let owner = move || Owner::new(host, to_client, to_self, &inbox).run(&inbox);
    thread::Builder::new().name("owner".to_owned()).stack_size(STACK).spawn(owner)?;

    let (events, mut incoming) = channel(AHEAD);
    let gone = events.clone();
    let parent = Arc::new(Parent::new(move || {
        let _ = gone.blocking_send(Event::Gone);
    }));
    thread::Builder::new().name("input".to_owned()).spawn(move || read_all(input, &events))?;

    // What the service's own way to the client would be stays unused: answers and notifications share one.
    let to_owner = mailbox.clone();
    let (mut service, _socket) = Handlers::service(mailbox, parent);
    let runtime = tokio::runtime::Builder::new_current_thread().build()?;
    let ending = runtime.block_on(async {
        let mut is_shut_down = false;
        while let Some(event) = incoming.recv().await {
            match event {
                Event::Gone => return Ending::Vanished,
                Event::Incoming(Incoming::Answer(answer)) => outbox.answered(answer),
                Event::Incoming(Incoming::Malformed(malformed)) => refuse(&outbox, malformed),
                Event::Incoming(Incoming::Message(message)) => {
                    let is_exit = message.method() == "exit";
                    let asks_for_end = message.method() == "shutdown";
                    let answered = call(&mut service, message, &outbox).await;
                    is_shut_down |= asks_for_end && answered;
                    if is_exit {
                        return if is_shut_down { Ending::Orderly } else { Ending::Abrupt };
                    }
                }
            }
        }
        Ending::Vanished
    });
    // The owner holds a way to itself, so it would wait for ever. What it works out at the moment is given up.
    to_owner.post("exit", Kind::Change, Owner::end);
    Ok(ending)
}

/// Reads messages until there are no more.
fn read_all(input: impl Read, events: &Sender<Event>) {
    let mut input = BufReader::with_capacity(1 << 16, input);
    loop {
        let event = match framing::read(&mut input) {
            Ok(Some(message)) => Event::Incoming(message),
            Ok(None) | Err(_) => Event::Gone,
        };
        let is_over = matches!(event, Event::Gone);
        if events.blocking_send(event).is_err() || is_over {
            return;
        }
    }
}

/// Hands a message to its handler, which posts it before this returns; the answer may come later. True if it came at once,
/// and was none of refusal.
async fn call(service: &mut LspService<Handlers>, message: Message, outbox: &Arc<Outbox>) -> bool {
    if poll_fn(|cx| service.poll_ready(cx)).await.is_err() {
        return false;
    }
    // Until these are answered, nothing else may be.
    let is_awaited = matches!(message.method(), "initialize" | "shutdown");
    let id = message.id().cloned();
    let mut answer = service.call(as_handled(message));
    let first = poll_fn(|cx| Poll::Ready(answer.as_mut().poll(cx))).await;
    let answered = match first {
        Poll::Ready(answered) => answered,
        Poll::Pending if is_awaited => answer.await,
        Poll::Pending => {
            let outbox = Arc::clone(outbox);
            tokio::spawn(async move {
                if let Ok(Some(response)) = answer.await {
                    outbox.answer(&response);
                }
            });
            return false;
        }
    };
    let Ok(response) = answered else { return false };
    // The service passes over unknown methods that begin with `$/`, requests among them; a request is always answered.
    let unanswered = || Some(Response::from_error(id?, Error::method_not_found()));
    let Some(response) = response.or_else(unanswered) else { return false };
    outbox.answer(&response);
    response.is_ok()
}

/// Answers what is not a message.
fn refuse(outbox: &Outbox, malformed: Malformed) {
    let Malformed { kind, id, reason } = malformed;
    let id = id.and_then(|id| serde_json::from_value::<Id>(id).ok()).unwrap_or_default();
    let error = if kind == Came::Json { Error::invalid_request() } else { Error::parse_error() };
    if kind == Came::TooLong {
        // The user opened a program, and waits for its findings.
        outbox.show(MessageType::WARNING, reason.clone());
    }
    outbox.log(MessageType::ERROR, reason.clone());
    outbox.answer(&Response::from_error(id, Error { message: reason.into(), ..error }));
}
