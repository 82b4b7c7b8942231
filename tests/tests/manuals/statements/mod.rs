//! Whole manuals, statement by statement: what the control does, requires, refuses or ignores, and what in gcheck holds it.
//!
//! Knows: one module a manual, one file a chapter, with its statements. Must not know: how anything is checked or computed.
//!
//! The pages under `docs/dev/statements/` are written from these tables
//! (`UPDATE_EXPECT=1 cargo test -p gcheck-tests --test manuals`).

mod haas_mill;
mod linuxcnc;
mod page;
mod statement;
