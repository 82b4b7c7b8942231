//! The language server: the protocol, the order of messages, position encodings.
//!
//! Knows: LSP. Must not know: how anything is computed, where configuration comes from.
//!
//! Three threads and a few more: one reads messages, one hands them to handlers and sends answers, one owns the documents and
//! does the work ([`owner`]); what takes long and needs no database goes to workers.

mod client;
mod diagnostics;
mod documents;
mod features;
mod framing;
mod handlers;
mod host;
mod late_hover;
mod mailbox;
mod outbox;
mod owner;
mod parent;
mod position;
mod program_text;
mod proto;
mod transport;

pub use gcheck_ide::Configured;
pub use host::{
    Choice, ConfigurationHover, ConfigurationOffer, ConfigurationProblem, ConfiguredPlace, Host, InForce,
    OpenPrograms, ProgramFile, ProgramQuery,
};
pub use program_text::ProgramText;
pub use transport::{Ending, serve};
