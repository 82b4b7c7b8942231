//! The language server: the protocol, the order of messages, position encodings.
//!
//! Knows: LSP. Must not know: how anything is computed, where configuration comes from.
