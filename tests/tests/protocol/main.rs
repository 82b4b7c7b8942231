//! The language server over its streams: a scripted client against the real program.
//!
//! Knows: the protocol as a client speaks it. Must not know: how the server is made, how features come to their answers.
//!
//! * [`lifecycle`]: how sessions begin and end, in order or not.
//! * [`synchronizing`]: texts at the server are texts at the client, whatever the encoding and the hurry.
//! * [`diagnostics`]: findings that are pushed or asked for, when they come and when they go.
//! * [`settings`]: configuration of the workspace and of the editor.
//! * [`features`]: every request once, in its form.
//! * [`files`]: several programs, open and on disk.
//! * [`bad_input`]: what no client should send.
//! * [`fresh`]: whatever happened, every answer is that of a fresh server; `GCHECK_SOAK=N` for N steps.
//! * [`many`]: thousands of files and documents; `GCHECK_WORKSPACE=N` for N files.
//! * [`soak`]: thousands of random edits and requests; `GCHECK_SOAK=N` for N of them.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

mod bad_input;
mod diagnostics;
mod features;
mod files;
mod fresh;
mod lifecycle;
mod many;
mod session;
mod settings;
mod soak;
mod synchronizing;
