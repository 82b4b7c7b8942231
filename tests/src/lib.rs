//! What the end-to-end tests share: a program is run by `gcheck run` and by the installed LinuxCNC interpreter (`rs274`), and
//! both print the canonical machining functions in one form, so that they can be compared.
//!
//! Knows: both command lines, the form, when two runs are equal. Must not know: how either of them executes anything, which
//! programs are run, what they are to prove.

#![expect(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "only tests call this, and a test that meets the unexpected is to fail"
)]

pub mod canonical;
pub mod process;
pub mod product;
pub mod reference;
pub mod setup;
