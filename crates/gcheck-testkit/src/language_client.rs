//! A client of a language server, driven by a script: it starts the server, sends what it is told to, and waits.
//!
//! Knows: JSON-RPC over standard streams, what a client has to answer. Must not know: which server it talks to, or what
//! anybody expects of the answers.
//!
//! Every wait has an end: a server that does not answer fails the script with what it did say.

use std::collections::HashMap;
use std::fmt;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// Longer than any answer takes on a busy machine.
const PATIENCE: Duration = Duration::from_mins(2);

/// A client with its server.
pub struct LanguageClient {
    /// The server's process, unless it is a thread of ours.
    child: Option<Child>,
    input: Option<Box<dyn Write + Send>>,
    incoming: Receiver<Value>,
    next: i64,
    answers: HashMap<i64, Value>,
    /// Notifications that nobody has waited for yet, in order.
    pub notifications: Vec<Value>,
    /// Requests of the server, in order; all are answered.
    pub requests: Vec<Value>,
    /// What the user has set, as `workspace/configuration` tells it, whatever the scope.
    pub settings: Value,
    /// Why edits of the server are not written; `None` where they are.
    pub refuses_edits: Option<String>,
}

impl LanguageClient {
    /// Starts a server.
    ///
    /// # Panics
    /// When it does not start.
    #[expect(clippy::unwrap_used, reason = "a script that meets the unexpected is to fail")]
    pub fn start(command: &mut Command) -> Self {
        let mut child =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::inherit()).spawn().unwrap();
        let (input, output) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut client = Self::over(input, output);
        client.child = Some(child);
        client
    }

    /// Talks to a server over streams: `input` is what it reads, `output` what it writes.
    pub fn over(input: impl Write + Send + 'static, output: impl Read + Send + 'static) -> Self {
        let (sender, incoming) = channel();
        thread::spawn(move || {
            let mut output = BufReader::with_capacity(1 << 16, output);
            while let Some(message) = read(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Self {
            child: None,
            input: Some(Box::new(input)),
            incoming,
            next: 0,
            answers: HashMap::new(),
            notifications: Vec::new(),
            requests: Vec::new(),
            settings: Value::Null,
            refuses_edits: None,
        }
    }

    /// Number of the server's process, or of ours.
    pub fn process(&self) -> u32 {
        self.child.as_ref().map_or_else(std::process::id, Child::id)
    }

    /// Sends bytes as they are. A server that is gone takes none.
    pub fn send_bytes(&mut self, bytes: &[u8]) {
        if let Some(input) = &mut self.input {
            let _ = input.write_all(bytes).and_then(|()| input.flush());
        }
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        let mut framed = format!("Content-Length: {}\r\n\r\n", body.len()).into_bytes();
        framed.extend_from_slice(body.as_bytes());
        self.send_bytes(&framed);
    }

    /// Sends a notification.
    #[expect(clippy::needless_pass_by_value, reason = "callers write the parameters in place")]
    pub fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request; its number is what [`Self::answer`] waits for.
    #[expect(clippy::needless_pass_by_value, reason = "callers write the parameters in place")]
    pub fn send_request(&mut self, method: &str, params: Value) -> i64 {
        self.next += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.next, "method": method, "params": params }));
        self.next
    }

    /// Waits for an answer: the whole message with `result` or `error`.
    ///
    /// # Panics
    /// When it does not come.
    pub fn answer(&mut self, id: i64) -> Value {
        let until = Instant::now() + PATIENCE;
        loop {
            if let Some(answer) = self.answers.remove(&id) {
                return answer;
            }
            assert!(self.receive(until), "no answer to request {id}; {}", self.story());
        }
    }

    /// Sends a request and waits for its result.
    ///
    /// # Panics
    /// When it does not come, or is an error.
    pub fn request(&mut self, method: &str, params: Value) -> Value {
        let id = self.send_request(method, params);
        let mut answer = self.answer(id);
        assert!(answer.get("error").is_none(), "{method} fails: {answer}");
        answer.get_mut("result").map(Value::take).unwrap_or_default()
    }

    /// Sends a request and waits for its error.
    ///
    /// # Panics
    /// When it does not come, or is none.
    pub fn refused(&mut self, method: &str, params: Value) -> Value {
        let id = self.send_request(method, params);
        let mut answer = self.answer(id);
        assert!(answer.get("error").is_some(), "{method} does not fail: {answer}");
        answer.get_mut("error").map(Value::take).unwrap_or_default()
    }

    /// Waits for a notification that fits, and takes it with all of the same method before it.
    ///
    /// # Panics
    /// When it does not come.
    pub fn notification(&mut self, method: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let until = Instant::now() + PATIENCE;
        loop {
            let is_method = |message: &Value| message.get("method").and_then(Value::as_str) == Some(method);
            let params = |message: &Value| message.get("params").cloned().unwrap_or_default();
            let found =
                self.notifications.iter().position(|message| is_method(message) && fits(&params(message)));
            if let Some(at) = found {
                let found = self.notifications.get(at).map(params).unwrap_or_default();
                let mut place = 0;
                self.notifications.retain(|message| {
                    place += 1;
                    place > at + 1 || !is_method(message)
                });
                return found;
            }
            assert!(self.receive(until), "no {method} that fits; {}", self.story());
        }
    }

    /// Waits for the next message of any kind; false when none comes in time.
    fn receive(&mut self, until: Instant) -> bool {
        let left = until.saturating_duration_since(Instant::now());
        let Ok(message) = self.incoming.recv_timeout(left) else { return false };
        self.sort_in(message);
        true
    }

    /// Takes what has come so far.
    pub fn receive_waiting(&mut self) {
        while let Ok(message) = self.incoming.try_recv() {
            self.sort_in(message);
        }
    }

    fn sort_in(&mut self, message: Value) {
        let has_method = message.get("method").is_some();
        match (message.get("id").cloned(), has_method) {
            (Some(id), true) => {
                let result = self.answer_to(&message);
                self.send(&json!({ "jsonrpc": "2.0", "id": id, "result": result }));
                self.requests.push(message);
            }
            (Some(id), false) if id.is_i64() => {
                self.answers.insert(id.as_i64().unwrap_or_default(), message);
            }
            // An answer to nobody: a message of ours was none.
            (_, _) => self.notifications.push(message),
        }
    }

    /// What this client answers to a request of the server.
    fn answer_to(&self, message: &Value) -> Value {
        match message.get("method").and_then(Value::as_str) {
            Some("workspace/configuration") => {
                let items = message.pointer("/params/items").and_then(Value::as_array).map_or(0, Vec::len);
                Value::Array(vec![self.settings.clone(); items])
            }
            Some("workspace/applyEdit") => match &self.refuses_edits {
                None => json!({ "applied": true }),
                Some(reason) => json!({ "applied": false, "failureReason": reason }),
            },
            Some("window/showDocument") => json!({ "success": true }),
            _ => Value::Null,
        }
    }

    /// Begins a session; gives what the server can do.
    pub fn initialize(&mut self, params: Value) -> Value {
        let answer = self.request("initialize", params);
        self.notify("initialized", json!({}));
        answer
    }

    /// Ends the session as it should be; gives the exit code.
    pub fn end(mut self) -> Option<i32> {
        self.request("shutdown", Value::Null);
        self.notify("exit", Value::Null);
        self.exit_code()
    }

    /// Closes the server's standard input.
    pub fn close_input(&mut self) {
        self.input = None;
    }

    /// Waits for the server to end; `None` when a signal ended it, or it is not a process.
    ///
    /// # Panics
    /// When it does not.
    #[expect(clippy::unwrap_used, reason = "a script that meets the unexpected is to fail")]
    pub fn exit_code(&mut self) -> Option<i32> {
        let until = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.child.as_mut()?.try_wait().unwrap() {
                return status.code();
            }
            assert!(Instant::now() < until, "the server does not end; {}", self.story());
            thread::sleep(Duration::from_millis(5));
        }
    }

    /// What the server has said that nobody has waited for, for messages of failures.
    fn story(&self) -> String {
        let last: Vec<String> = self.notifications.iter().rev().take(5).map(Value::to_string).collect();
        format!("the last it said: {}", last.join("\n"))
    }
}

impl fmt::Debug for LanguageClient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LanguageClient").field("process", &self.process()).finish_non_exhaustive()
    }
}

impl Drop for LanguageClient {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            // A server that has ended cannot be killed, and need not be.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// The next message; `None` at the end.
fn read(from: &mut impl BufRead) -> Option<Value> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if from.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim().split_once(':') {
            Some((name, value)) if name.eq_ignore_ascii_case("content-length") => {
                length = value.trim().parse::<u64>().ok();
            }
            _ if line.trim().is_empty() => break,
            _ => {}
        }
    }
    let mut body = Vec::new();
    from.take(length?).read_to_end(&mut body).ok()?;
    serde_json::from_slice(&body).ok()
}
