//! Help in a configuration: what a key means, what may be written, where an entry is.
//!
//! Knows: the text as it is, half-typed and broken too, the schema, and the forms in which the server is answered. Must not know: files,
//! editors.

mod completion;
mod entries;
mod hover;
mod open_keys;
mod outline;
mod shape;

pub(crate) use completion::completion;
pub(crate) use entries::entries;
pub(crate) use hover::hover;
