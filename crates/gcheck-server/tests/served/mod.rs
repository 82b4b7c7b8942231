//! A server in a thread of its own, with a client that has opened one text.
//!
//! Knows: pipes, how a session begins. Must not know: what a host says, what is tested.

use std::sync::Arc;
use std::thread::{self, JoinHandle};

use gcheck_server::{Ending, Host, serve};
use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};

/// Serves a host, and opens a text.
pub(crate) fn session(
    host: impl Host,
    (uri, language): (&str, &str),
    text: &str,
    capabilities: &Value,
) -> (LanguageClient, JoinHandle<Ending>) {
    let (input, to_server) = std::io::pipe().unwrap();
    let (from_server, output) = std::io::pipe().unwrap();
    let server = thread::spawn(move || serve(Arc::new(host), input, output).unwrap());
    let mut client = LanguageClient::over(to_server, from_server);
    client.initialize(json!({ "processId": null, "rootUri": null, "capabilities": capabilities }));
    let document = json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
    client.notify("textDocument/didOpen", json!({ "textDocument": document }));
    (client, server)
}
