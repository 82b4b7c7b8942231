//! What tests and measurements of several crates share.
//!
//! Knows: programs as text. Must not know: what anybody expects of them. Never part of a release.

pub mod blind;
pub mod corpus;
pub mod inputs;
pub mod language_client;
pub mod language_questions;
pub mod pieces;
pub mod skips;
